// SPDX-License-Identifier: BSL-1.0
// Points carried by several frames.
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>

#include "one_component.hpp"

namespace test_skinning_mapping {

using namespace sinew;
using one::says;

namespace {

using SkinFrames = Rigid3d::VecCoord;
using Points = Vec3d::VecCoord;
using Skin = SkinningMapping<Rigid3d, Vec3d>;

Rigid3d::Coord frame(Eigen::Vector3d const& center,
                     Eigen::Vector3d const& rotation = Eigen::Vector3d::Zero()) {
  Rigid3d::Coord c;
  Rigid3d::increment(c, (Rigid3d::Deriv() << center, rotation).finished());
  return c;
}
Skin ready(Skin skin, SkinFrames const& frames, Points points) {
  check_fields(skin, "skin");
  const Points given = points;
  skin.init({"/bones", frames, {}}, {"/bones/skin", given, {}}, points);
  return skin;
}
Points applied(Skin& skin, SkinFrames const& frames) {
  Points x(skin.restPoints.size());
  skin.apply(x, frames);
  return x;
}

const SkinFrames bones{
    frame({0, 0, 0}, {0.1, 0.2, 0.3}), frame({1, 0, 0}, {0, -1, 0.5}), frame({2, 0.5, 0}), frame({2, 2, 1})};
const Points skin{{0.1, 0.2, 0}, {0.5, -0.3, 0.1}, {1.2, 0.4, 0.2}, {2, 1, 0.5}, {1, 0, 0}};

}  // namespace

TEST_CASE("frames at rest leave the skin as it is, and carry it along as one body, for both methods") {
  for (const auto method : {SkinningMethod::linear, SkinningMethod::dualQuaternion}) {
    Skin mapping = ready({.nbRef = {3}, .method = method}, bones, skin);
    const Points still = applied(mapping, bones);
    for (std::size_t i = 0; i < skin.size(); ++i) CHECK((still[i] - skin[i]).norm() < 1e-15);
    // one motion of all frames
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 2, -1).normalized()));
    const Eigen::Vector3d shift(3, -1, 2);
    SkinFrames moved = bones;
    for (auto& f : moved) {
      f.center = rotation * f.center + shift;
      f.orientation = rotation * f.orientation;
    }
    const Points x = applied(mapping, moved);
    for (std::size_t i = 0; i < skin.size(); ++i) CHECK((x[i] - (rotation * skin[i] + shift)).norm() < 1e-14);
  }
}

TEST_CASE("two frames of equal weight, one turned: linear skin shrinks, that of dual quaternions does not") {
  const SkinFrames rest{frame({0, 0, 0}), frame({0, 0, 0})};
  const Points point{{0, 1, 0.7}};
  for (const double angle : {0.5, 2.0, 3.0}) {
    const SkinFrames turned{rest[0], frame({0, 0, 0}, {0, 0, angle})};
    Skin linear = ready({.nbRef = {2}, .indices = {0, 1}, .weight = {3, 3}}, rest, point);
    Skin dual =
        ready({.nbRef = {2}, .indices = {0, 1}, .weight = {1, 1}, .method = SkinningMethod::dualQuaternion},
              rest,
              point);
    // half way, on the circle or on its chord
    const Eigen::Vector3d across(-std::sin(angle / 2), std::cos(angle / 2), 0);
    CHECK((applied(linear, turned)[0] - (std::cos(angle / 2) * across + Eigen::Vector3d(0, 0, 0.7))).norm() <
          1e-14);
    CHECK((applied(dual, turned)[0] - (across + Eigen::Vector3d(0, 0, 0.7))).norm() < 1e-14);
  }
  // turned by more than half a turn from rest the nearer way is taken
  Skin dual =
      ready({.nbRef = {2}, .indices = {0, 1}, .weight = {1, 1}, .method = SkinningMethod::dualQuaternion},
            rest,
            point);
  const SkinFrames turned{rest[0], frame({0, 0, 0}, {0, 0, 4.0})};
  const double back = (4.0 - 2 * 3.14159265358979323846) / 2;
  CHECK((applied(dual, turned)[0] - Eigen::Vector3d(-std::sin(back), std::cos(back), 0.7)).norm() < 1e-14);
}

TEST_CASE("a screw of two frames is half a screw between them") {
  // the second frame is shifted along and turned about an axis through (2, 0, 0)
  const SkinFrames rest{frame({0, 0, 0}), frame({2, 0, 0})};
  const SkinFrames moved{rest[0], frame({2, 0, 0.6}, {0, 0, 1.0})};
  Skin dual =
      ready({.nbRef = {2}, .indices = {0, 1}, .weight = {1, 1}, .method = SkinningMethod::dualQuaternion},
            rest,
            {{1, 0, 0}});
  const Eigen::Vector3d expected =
      Eigen::Vector3d(2, 0, 0.3) +
      Eigen::AngleAxisd(0.5, Eigen::Vector3d(0, 0, 1)) * Eigen::Vector3d(-1, 0, 0);
  CHECK((applied(dual, moved)[0] - expected).norm() < 1e-14);
}

TEST_CASE("weights that are not given fall with the square of the distance, of the nearest frames") {
  const Skin mapping = ready({.nbRef = {2}}, bones, {{0.25, 0, 0}, {2, 0.5, 0}, {3, 3, 3}});
  auto const& all = mapping.influences;
  CHECK(mapping.starts == std::vector<std::size_t>{0, 2, 4, 6});
  CHECK(all[0].frame == 0);
  CHECK(all[1].frame == 1);
  CHECK(all[0].weight == Approx(9.0 / 10));  // 1/0.25^2 : 1/0.75^2
  CHECK(all[1].weight == Approx(1.0 / 10));
  CHECK(all[2].frame == 2);
  CHECK(all[2].weight == 1);
  CHECK(all[3].weight == 0);
  CHECK(all[4].frame == 3);
  // as many as there are
  CHECK(ready({.nbRef = {9}}, bones, skin).influences.size() == 20);
  // each its own
  CHECK(ready({.nbRef = {1, 2, 3, 4, 1}}, bones, skin).starts ==
        std::vector<std::size_t>{0, 1, 3, 6, 10, 11});
}

TEST_CASE("springs on a skin move its frames: matrix-free and assembled solvers agree") {
  auto moved = [](auto linear, SkinningMethod method) {
    linear.iterations = 300, linear.tolerance = 1e-14;
    RegistryScene sim{node<"root">(
        Gravity{{0, -1, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.01},
        linear,
        node<"bones">(MechanicalObject<Rigid3d>{.position = bones},
                      UniformMass<Rigid3d>{},
                      FixedConstraint<Rigid3d>{.indices = {0}},
                      node<"skin">(MechanicalObject<Vec3d>{.position = skin},
                                   Skin{.nbRef = {3}, .method = method},
                                   StiffSpringForceField<Vec3d>{
                                       {{0, 1, 50, 0, 0.2}, {1, 2, 50, 0, 1.2}, {2, 3, 50, 0, 0.5}}})))};
    sim.init();
    for (int i = 0; i < 20; ++i) sim.animate(0.02);
    return sim.template at<"bones/skin">().state().position;
  };
  for (const auto method : {SkinningMethod::linear, SkinningMethod::dualQuaternion}) {
    const Points a = moved(CGLinearSolver<>{}, method),
                 b = moved(CGLinearSolver<CompressedRowSparseMatrixd>{}, method);
    for (std::size_t i = 0; i < skin.size(); ++i) CHECK((a[i] - b[i]).norm() < 1e-11);
    CHECK((a[2] - skin[2]).norm() > 0.01);
  }
}

TEST_CASE("bad skins are named") {
  auto with = [](Skin mapping, SkinFrames const& frames = bones) {
    return [=] { ready(mapping, frames, skin); };
  };
  CHECK(error_of(with({})).empty());
  says(with({.initPos = {{0, 0, 0}}}),
       {"/bones/skin", "SkinningMapping<Rigid3d, Vec3d>", "initPos has 1 places for 5 points"});
  says(with({.nbRef = {1, 2}}), {"nbRef has 2 entries for 5 points"});
  says(with({.nbRef = {0}}), {"nbRef[0] is 0", "at least 1"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2, 3, 4}, .weight = {1, 1, 1, 1, 1}}),
       {"indices has 4", "4 frames"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2}, .weight = {1, 1, 1}}),
       {"3 indices and 3 weights", "asks for 5"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2, 3, 3}}), {"5 indices and 0 weights"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2, 3, 3}, .weight = {1, 1, 0, 1, 1}}),
       {"weights of point 2 are all 0"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2, 3, 3}, .weight = {1, 1, -1, 1, 1}}), {"weight[2] is -1"});
  says(with({.nbRef = {1}, .indices = {0, 1, 2, 3, -3}, .weight = {1, 1, 1, 1, 1}}), {"indices[4] is -3"});
  says(with({}, SkinFrames{}), {"the parent has no frames"});
}

}  // namespace test_skinning_mapping
