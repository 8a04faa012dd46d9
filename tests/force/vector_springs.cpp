// SPDX-License-Identifier: BSL-1.0
// Springs that hold a vector, and springs that only push.
#include "one_component.hpp"

#include <sinew/force/repulsive_spring.hpp>
#include <sinew/force/vector_spring.hpp>

namespace test_vector_springs {

using namespace sinew;
using Vectors = VectorSpringForceField<Vec3d>;
using Repulsive = RepulsiveSpringForceField<Vec3d>;

const Vec3d::VecCoord rest = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};

TEST_CASE("a spring holds the vector between its points, not only the length") {
  auto given =
      one::ready(Vectors{.springs = {{0, 1, 10, 2, Eigen::Vector3d(1, 1, 0)}, {1, 2, 4, 0, {}}}}, rest);
  const Vec3d::VecCoord x = {{0, 0, 0}, {0, 1, 0}, {0, 3, 0}};  // turned: the lengths are those at rest
  const auto f = one::force(given, x, {{0, 0, 0}, {0, 0, 3}, {0, 0, 0}});
  CHECK(f[0].isApprox(Eigen::Vector3d(-10, 0, 6)));  // k (x1 - x0 - L) + c v1
  CHECK(f[2].isApprox(Eigen::Vector3d(0, 0, 0)));    // as at rest
  CHECK(potential_energy(given, x) == Approx(5));
  CHECK(one::product(given, {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 1, 0.5)[1].isApprox(
      Eigen::Vector3d(-11 - 4, 0, 0)));
}

TEST_CASE("edges of the topology, or points of the same number, are joined where none is given") {
  TopologyView view;
  static const std::vector<Edge> edges = {{0, 1}, {1, 2}};
  view.edges = edges;
  auto along = one::ready(Vectors{.stiffness = 3, .useTopology = true}, rest, view);
  for (auto const& f : one::force(along, rest)) CHECK(f.norm() == 0);
  CHECK(one::force(along, {{0, 0, 0}, {1, 0, 1}, {1, 2, 0}})[1].isApprox(Eigen::Vector3d(0, 0, -6)));
  VectorSpringForceField<Vec3d, Linked> pairs{.stiffness = 3, .viscosity = 0};
  const InitContext<Vec3d> a{"/a", rest, {}}, b{"/b", rest, {}};
  pairs.init(a, b);
  const Vec3d::VecCoord moved = {{0, 0, 0}, {1, 1, 0}, {1, 2, 0}};
  Vec3d::VecDeriv f(3, Vec3d::Deriv::Zero()), g = f;
  const Vec3d::VecDeriv still = f;
  add_force(pairs, MechanicalParams{}, f, g, rest, moved, still, still);
  CHECK(f[1].isApprox(Eigen::Vector3d(0, 3, 0)));
  CHECK(g[1].isApprox(Eigen::Vector3d(0, -3, 0)));
}

TEST_CASE("a repulsive spring acts while it is too short") {
  auto springs = one::ready(Repulsive{.springs = {{0, 1, 10, 2, 1.5}}}, rest);
  const Vec3d::VecDeriv parting = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  CHECK(one::force(springs, rest)[1].isApprox(Eigen::Vector3d(5, 0, 0)));
  CHECK(one::force(springs, rest, parting)[1].isApprox(Eigen::Vector3d(3, 0, 0)));
  CHECK(potential_energy(springs, rest) == Approx(1.25));
  const Vec3d::VecCoord apart = {{0, 0, 0}, {1.6, 0, 0}, {1, 2, 0}}, same = {{1, 0, 0}, {1, 0, 0}, {1, 2, 0}};
  CHECK(one::force(springs, apart, parting)[1].norm() == 0);
  CHECK(potential_energy(springs, apart) == 0);
  CHECK(one::product(springs, parting, 1, 1)[1].norm() == 0);
  CHECK(one::force(springs, same)[1].norm() == 0);  // no direction
  // lists, of which the second is switched off
  auto lists = one::ready(Repulsive{.springsIndices1 = {0, 1},
                                    .springsIndices2 = {1, 2},
                                    .stiffness = {10, 20},
                                    .lengths = {3},
                                    .enabled = {true, false}},
                          rest);
  CHECK(one::force(lists, rest)[1].isApprox(Eigen::Vector3d(20, 0, 0)));
}

TEST_CASE("vector and repulsive springs say what is wrong") {
  auto with = [](auto c) { return [c] { one::ready(c, rest); }; };
  one::says(with(Vectors{}), {"body: VectorSpringForceField<Vec3d", "there is no spring", "useTopology"});
  one::says(with(Vectors{.useTopology = true}), {"the topology has no edges"});
  one::says(with(Vectors{.springs = {{0, 3, 1, 1, {}}}}), {"springs[0] refers to point 3"});
  one::says(with(Vectors{.springs = {{1, 1, 1, 1, {}}}}), {"joins point 1 to itself"});
  one::says(with(Vectors{.springs = {{0, 1, -1, 1, {}}}}), {"stiffness"});
  one::says(
      [] {
        VectorSpringForceField<Vec3d, Linked> pairs;
        const Vec3d::VecCoord two(2, Eigen::Vector3d::Zero());
        const InitContext<Vec3d> a{"/a", rest, {}}, b{"/b", two, {}};
        pairs.init(a, b);
      },
      {"they have 3 and 2 points"});
  one::says(with(Repulsive{.springs = {{0, 1, 1, one::notANumber, 1}}}), {"damping"});
  one::says(with(Repulsive{.springs = {{0, 9, 1, 1, 1}}}), {"springs[0] refers to point 9"});
  one::says(with(Repulsive{.springsIndices1 = {0}}), {"give both ends of each spring"});
  one::says(with(Repulsive{.springsIndices1 = {0, 1}, .springsIndices2 = {1, 2}, .stiffness = {1, 2, 3}}),
            {"stiffness has 3 values for 2 springs"});
}

}  // namespace test_vector_springs
