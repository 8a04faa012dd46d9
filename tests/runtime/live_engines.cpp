// SPDX-License-Identifier: BSL-1.0
// Engines of scene files that are evaluated again while the scene runs: what follows what, when, and what
// does not.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/registry.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

#include <algorithm>
#include <cmath>

namespace test_live_engines {

using namespace sinew;
using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

namespace {

/// Hands on its points and counts how often it was asked to; refuses points below the height `floor`.
struct CountedPoints {
  using Role = role::Engine;
  static constexpr std::string_view className = "CountedPoints";
  Points position{};
  double floor = -1e9;
  static constexpr auto fields() {
    return field_list(field("position", &CountedPoints::position, "m", "points"),
                      field("floor", &CountedPoints::floor, "m", "how low they may be"));
  }
  Points output{};
  int evaluations = 0;
  static constexpr auto outputs() {
    return field_list(field("output", &CountedPoints::output, "m", "the same points"));
  }
  void update(std::string_view where) {
    for (auto const& x : position)
      if (x[1] < floor) throw Error(text(where, ": CountedPoints"), "a point is too low; raise it");
    output = position;
    ++evaluations;
  }
};

struct Mine : Registry<Gravity, EulerImplicitSolver, CGLinearSolver<>, MeshTopology, MechanicalObject<Vec3d>,
                       MechanicalObject<Rigid3d>, UniformMass<Vec3d>, UniformMass<Rigid3d>,
                       FixedConstraint<Vec3d>, LinearVelocityConstraint<Vec3d>, StiffSpringForceField<Vec3d>,
                       ConstantForceField<Vec3d>, PlaneForceField<Vec3d>, RestShapeSpringsForceField<Vec3d>,
                       RigidMapping<Rigid3d, Vec3d>, IdentityMapping<Vec3d, Vec3d>, VisualModel,
                       PointsFromIndices<Vec3d>, AverageCoord<Vec3d>, BoxROI<Vec3d>, ValuesFromIndices,
                       DifferenceEngine, NormEngine, MergeVectors, TransformEngine<Vec3d>, CountedPoints> {};
using Running = Simulation<RuntimeNode<Mine>>;

ReadScene<Mine> read(std::string const& content) {
  return parse_scene<Mine>("test.scn", "<Node name='root' gravity='0 -10 0'>" + content + "</Node>");
}
template <class C>
C& at(Running& sim, std::string_view node) {
  RuntimeNode<Mine>* const found = sim.root().find_node(node);
  REQUIRE(found);
  REQUIRE(found->template get<C>());
  return *found->template get<C>();
}
Points& positions(Running& sim, std::string_view node) {
  return at<MechanicalObject<Vec3d>>(sim, node).position;
}
const std::string solver =
    "<EulerImplicitSolver/><CGLinearSolver iterations='50' tolerance='1e-14' threshold='1e-14'/>";
const std::string body =
    "<MechanicalObject name='dofs' position='0 0 0  1 0.5 0  2 0 1'/><UniformMass totalMass='3'/>";

}  // namespace

TEST_CASE("what is selected of a falling body follows it at each step, to the bit") {
  const std::string scene = "<Node name='body'>" + solver + body +
                            "<PointsFromIndices name='some' position='@dofs.position' indices='2 0'/>"
                            "<Node name='selection'><MechanicalObject position='@../some.indices_position'/>"
                            "</Node></Node>";
  auto read_ = read(scene);
  CHECK(read_.warnings.empty());
  auto sim = start(std::move(read_));
  for (int step = 0; step < 20; ++step) {
    sim.animate(0.01);
    auto const& x = positions(sim, "body");
    CHECK(positions(sim, "body/selection") == Points{x[2], x[0]});
  }
  CHECK(positions(sim, "body")[0][1] < -0.15);
  // a copy follows its own body
  Running copy = sim;
  copy.animate(0.01);
  auto const& y = positions(copy, "body");
  CHECK(positions(copy, "body/selection") == Points{y[2], y[0]});
  auto const& x = positions(sim, "body");
  CHECK(positions(sim, "body/selection") == Points{x[2], x[0]});
  // reset and the same steps again
  const Points before = positions(sim, "body/selection");
  sim.reset();
  CHECK(positions(sim, "body/selection") == Points{{2, 0, 1}, {0, 0, 0}});
  for (int step = 0; step < 20; ++step) sim.animate(0.01);
  CHECK(positions(sim, "body/selection") == before);
  // a checkpoint goes on with the same bits
  auto again = start(parse_scene<Mine>("saved.scn", scene_text(sim, 0.01)));
  CHECK(positions(again, "body/selection") == before);
  for (int step = 0; step < 5; ++step) sim.animate(0.01), again.animate(0.01);
  CHECK(positions(again, "body/selection") == positions(sim, "body/selection"));
  CHECK(positions(again, "body/selection")[1] == positions(again, "body")[0]);
}

TEST_CASE("the mean of a body that turns about its centre stays, and chains of engines follow") {
  // four equal masses held by springs turn with 2 rad/s about the middle; no force from outside
  auto sim = start(parse_scene<Mine>(
      "test.scn",
      "<Node name='root' gravity='0 0 0'>" + solver +
          "<MechanicalObject name='dofs' position='1 0 0 0 1 0 -1 0 0 0 -1 0' velocity='0 2 0 -2 0 0 0 -2 0 "
          "2 "
          "0 0'/>"
          "<UniformMass totalMass='4'/>"
          "<StiffSpringForceField spring='0 2 1000 0 2  1 3 1000 0 2'/>"
          "<AverageCoord name='mean'/>"
          "<ValuesFromIndices name='a' in='@dofs.position' indices='0 1'/>"
          "<ValuesFromIndices name='b' in='@dofs.position' indices='2 3'/>"
          "<DifferenceEngine name='d' input='@a.out' substractor='@b.out'/><NormEngine name='n' "
          "input='@d.output'/></Node>"));
  for (int step = 0; step < 50; ++step) {
    sim.animate(0.01);
    CHECK(at<AverageCoord<Vec3d>>(sim, "").average.norm() < 1e-12);
    auto const& x = positions(sim, "");
    auto const& norms = at<NormEngine>(sim, "").output;
    CHECK(norms == std::vector<double>{(x[0] - x[2]).norm(), (x[1] - x[3]).norm()});
  }
  CHECK(std::abs(positions(sim, "")[0][1]) > 0.5);
  CHECK(at<AverageCoord<Vec3d>>(sim, "").position == positions(sim, ""));
}

TEST_CASE("an engine is evaluated once a step where what it follows moves, and else once") {
  auto sim = start(read("<Node name='falls'>" + solver + body +
                        "<CountedPoints name='c' position='@dofs.position'/></Node>"
                        "<Node name='stays'><MechanicalObject name='dofs' position='0 0 0'/><CountedPoints "
                        "position='@dofs.position'/></Node>"
                        "<Node name='rests'>" +
                        solver + body +
                        "<CountedPoints position='@dofs.rest_position'/></Node>"
                        "<Node name='held'>" +
                        solver + body +
                        "<FixedConstraint fixAll='1'/><CountedPoints position='@dofs.position'/></Node>"));
  for (int step = 0; step < 10; ++step) sim.animate(0.01);
  CHECK(at<CountedPoints>(sim, "falls").evaluations == 11);
  CHECK(at<CountedPoints>(sim, "stays").evaluations == 1);
  CHECK(at<CountedPoints>(sim, "rests").evaluations == 1);
  CHECK(at<CountedPoints>(sim, "held").evaluations == 1);
  // one for which nothing has changed is not evaluated, though it stands behind one that is
  auto chosen =
      start(read("<Node name='body'>" + solver + body +
                 "<BoxROI name='box' box='-9 -9 -9 1.5 9 9' position='@dofs.position'/>"
                 "<ValuesFromIndices name='v' in='1 2 3 4 5 6 7 8 9' size='3' indices='@box.indices'/>"
                 "<CountedPoints name='c' position='@v.out'/></Node>"));
  for (int step = 0; step < 10; ++step) chosen.animate(0.01);
  CHECK(at<CountedPoints>(chosen, "body").evaluations == 1);
  CHECK(chosen.root().live.targets.size() == 3);
  CHECK(sim.root().live.targets.size() == 1);  // what is held does not move
  // no engine: nothing is kept
  CHECK(read("<Node name='body'>" + solver + body + "</Node>").root.live.targets.empty());
}

TEST_CASE("constraints, forces and pictures take what engines make") {
  // a point that comes below the plane y = -0.1 is held there from the next step on
  auto sim = start(read("<Node name='body'>" + solver + body +
                        "<BoxROI name='low' box='-9 -9 -9 9 -0.1 9' position='@dofs.position'/>"
                        "<FixedConstraint indices='@low.indices' activate_projectVelocity='1'/></Node>"));
  for (int step = 0; step < 60; ++step) sim.animate(0.01);
  auto const& x = positions(sim, "body");
  const double stop = x[0][1];
  CHECK(stop < -0.1);
  // it goes on for two steps: the one behind which it is found, and one whose velocity is lost at its end
  // only
  CHECK(stop > -0.1 - 2 * 0.01 * std::sqrt(2 * 10 * 0.15));
  CHECK(x[1][1] < -0.1);
  CHECK(x[1][1] > -0.1 - 2 * 0.01 * std::sqrt(2 * 10 * 0.7));
  CHECK(at<FixedConstraint<Vec3d>>(sim, "body").held.size() == 3);
  sim.reset();
  CHECK(at<FixedConstraint<Vec3d>>(sim, "body").held.empty());

  // a force that is the distance of two points, and a plane at the height of a body
  auto loads = start(
      read("<Node name='lift'>" + solver +
           "<MechanicalObject name='dofs' position='0 0 0'/><UniformMass totalMass='1'/></Node>"
           "<Node name='pushed'>" +
           solver +
           "<MechanicalObject position='0 0 0'/><UniformMass totalMass='1'/>"
           "<ConstantForceField forces='@/lift/dofs.velocity'/></Node>"
           "<Node name='seen'><VisualModel position='@../pick.indices_position'/></Node>"
           "<PointsFromIndices name='pick' template='Vec3' position='@lift/dofs.position' indices='0'/>"));
  for (int step = 0; step < 5; ++step) {
    const Eigen::Vector3d v = at<MechanicalObject<Vec3d>>(loads, "lift").velocity[0];
    const Eigen::Vector3d w = at<MechanicalObject<Vec3d>>(loads, "pushed").velocity[0];
    loads.animate(0.1);
    const Eigen::Vector3d after = at<MechanicalObject<Vec3d>>(loads, "pushed").velocity[0];
    CHECK((after - w - 0.1 * (v + Eigen::Vector3d(0, -10, 0))).norm() < 1e-12);
    CHECK(at<VisualModel>(loads, "seen").position[0] == positions(loads, "lift")[0].cast<float>());
  }
}

TEST_CASE("what is mapped from a state that follows moves with it, and engines behind that are last") {
  auto sim = start(
      read("<Node name='body'>" + solver + body +
           "<AverageCoord name='mean'/></Node>"
           "<PointsFromIndices name='end' template='Vec3' position='@frame/far/tip.position' indices='0'/>"
           "<Node name='frame'><MechanicalObject template='Rigid3' position='@../first.indices_position'/>"
           "<Node name='far'><MechanicalObject name='tip' position='1 0 0'/><RigidMapping/></Node></Node>"
           "<PointsFromIndices name='first' template='Vec3' position='@body/dofs.position' indices='1'/>"
           "<Node name='tip'><MechanicalObject position='@../end.indices_position'/></Node>"));
  for (int step = 0; step < 5; ++step) {
    sim.animate(0.01);
    const Eigen::Vector3d x = positions(sim, "body")[1];
    CHECK(at<MechanicalObject<Rigid3d>>(sim, "frame").position[0].center == x);
    CHECK((positions(sim, "tip")[0] - x - Eigen::Vector3d(1, 0, 0)).norm() < 1e-14);
    CHECK(positions(sim, "tip") == positions(sim, "frame/far"));
  }
}

TEST_CASE("what takes no value while the scene runs is said, with both names") {
  const std::string chosen =
      solver + body + "<BoxROI name='low' box='-9 -9 -9 9 9 9' position='@dofs.position'/>";
  auto deaf = read("<Node name='body'>" + chosen +
                   "<RestShapeSpringsForceField name='hold' points='@low.indices'/></Node>");
  REQUIRE(deaf.warnings.size() == 1);
  CHECK_THAT(deaf.warnings[0],
             Contains("test.scn:1:") &&
                 Contains("<RestShapeSpringsForceField>: points is read at the start only") &&
                 Contains("indices of 'low' (BoxROI)") && Contains("'hold' keeps the value of the start") &&
                 Contains("rest_position"));
  CHECK(deaf.root.live.targets.empty());
  CHECK(read("<Node name='body'>" + solver + body +
             "<BoxROI name='low' box='-9 -9 -9 9 9 9' position='@dofs.rest_position'/>"
             "<RestShapeSpringsForceField points='@low.indices'/></Node>")
            .warnings.empty());
  // one that is not to be evaluated again is not
  auto still = read("<Node name='body'>" + solver + body +
                    "<BoxROI name='low' box='-9 -9 -9 9 9 9' position='@dofs.position' doUpdate='0'/>"
                    "<RestShapeSpringsForceField points='@low.indices'/></Node>");
  CHECK(still.warnings.empty());
  CHECK(still.root.live.targets.empty());
  auto moved = read("<Node name='body'>" + solver + body +
                    "<PointsFromIndices name='p' position='@dofs.position' indices='0'/><Node name='v'>"
                    "<VisualModel position='@../p.indices_position' translation='1 0 0'/></Node></Node>");
  REQUIRE(moved.warnings.size() == 1);
  CHECK_THAT(moved.warnings[0], Contains("is moved where it is read, at the start only"));
}

TEST_CASE("an engine that fails while the scene runs stops it behind the last whole step") {
  auto sim = start(read("<Node name='body'>" + solver + body +
                        "<CountedPoints name='c' position='@dofs.position' floor='-0.03'/>"
                        "<Node name='s'><MechanicalObject position='@../c.output'/></Node></Node>"));
  // y = -10 h^2 n (n + 1) / 2 < -0.03 at n = 8
  for (int step = 0; step < 7; ++step) sim.animate(0.01);
  const Points followed = positions(sim, "body/s");
  const std::string error = error_of([&] { sim.animate(0.01); });
  CHECK_THAT(error,
             Contains("step 8 (time 0.08 s)") && Contains("/root/body: CountedPoints") &&
                 Contains("a point is too low; raise it"));
  CHECK(sim.step() == 8);
  CHECK(sim.time() == Approx(0.08));
  CHECK(positions(sim, "body")[0][1] == Approx(-0.036));
  CHECK(positions(sim, "body/s") == followed);
  // it is said again, and not forgotten
  CHECK_THAT(error_of([&] { sim.animate(0.01); }), Contains("step 9"));
  sim.reset();
  sim.animate(0.01);
  CHECK(positions(sim, "body/s") == positions(sim, "body"));

  // a state keeps its number of points: two of the selected ones meet
  auto meet = start(parse_scene<Mine>(
      "test.scn",
      "<Node name='root' gravity='0 0 0'><Node name='body'>" + solver +
          "<MechanicalObject name='dofs' position='0 0 0 1 0 0' velocity='1 0 0 0 0 0'/><UniformMass "
          "totalMass='1'/><PointsFromIndices name='p' position='@dofs.position' indices='0 1'/>"
          "<Node name='s'><MechanicalObject position='@../p.indices_position'/></Node></Node></Node>"));
  meet.animate(0.5);
  CHECK_THAT(error_of([&] { meet.animate(0.5); }),
             Contains("position has 6 numbers and would have 3 now, from 'p'") &&
                 Contains("keeps its number of points"));
}

TEST_CASE("links that lead in a circle are refused, through mappings as well") {
  CHECK_THAT(
      error_of([] {
        read("<Node name='a'>" + solver +
             "<MechanicalObject name='dofs' position='@p.indices_position'/><PointsFromIndices name='p' "
             "position='@dofs.position' indices='0'/></Node>");
      }),
      Contains("in a circle"));
  CHECK_THAT(
      error_of([] {
        read(
            "<Node name='a'><MechanicalObject name='dofs' template='Vec3' "
            "position='@below/p.indices_position'/>"
            "<Node name='below'><MechanicalObject name='m' position='1 2 3'/><IdentityMapping/>"
            "<PointsFromIndices name='p' template='Vec3' position='@m.position' indices='0'/></Node></Node>");
      }),
      Contains("in a circle back to") && Contains("test.scn:1:"));
}

TEST_CASE("an engine that is removed leaves what followed it where it was") {
  auto sim =
      start(read("<Node name='body'>" + solver + body +
                 "<PointsFromIndices name='p' position='@dofs.position' indices='0'/>"
                 "<Node name='s'><MechanicalObject position='@../p.indices_position'/></Node></Node>"));
  sim.animate(0.01);
  const Points there = positions(sim, "body/s");
  sim.change([](RuntimeNode<Mine>& root) { root.find_node("body")->remove("p"); });
  sim.animate(0.01);
  CHECK(positions(sim, "body/s") == there);
  REQUIRE(sim.root().warnings.size() == 1);
  CHECK_THAT(sim.root().warnings[0], Contains("position followed 'p', which is not there any more"));
}

TEST_CASE("engines that follow what moves see the elements that are left where some are removed") {
  auto sim = start(
      read("<Node name='body'>" + solver +
           "<MeshTopology name='mesh' position='0 0 0 1 0 0 0 1 0 0 0 1 1 1 1' tetrahedra='0 1 2 3 4 1 3 2'/>"
           "<MechanicalObject name='dofs'/><UniformMass totalMass='1'/>"
           "<BoxROI name='all' box='-9 -9 -9 9 9 9' position='@dofs.position'/></Node>"));
  sim.animate(0.01);
  auto const& all = at<BoxROI<Vec3d>>(sim, "body");
  CHECK(all.tetrahedraInROI.size() == 2);
  sim.removeElements("body", {.tetrahedra = {0}});
  auto const& left = at<BoxROI<Vec3d>>(sim, "body");
  CHECK(left.tetrahedraInROI == std::vector<Tetrahedron>{{3, 0, 2, 1}});
  CHECK(left.indices.size() == 4);
  sim.animate(0.01);
  CHECK(at<BoxROI<Vec3d>>(sim, "body").position == positions(sim, "body"));
}

}  // namespace test_live_engines
