// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/runtime/from_typed.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/scene/profiled.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/stage.hpp>

#include <chrono>
#include <pugixml.hpp>
#include <sstream>
#include <thread>

namespace test_plots {

using namespace sinew;
using view::Measures;

TEST_CASE("what is measured of a falling body, as a table and as a picture") {
  Simulation sim{node<"root">(
      Gravity{{0, -10, 0}},
      EulerExplicitSolver{},
      node<"body">(MechanicalObject<Vec3d>{.position = {{7, 0, 0}}}, UniformMass<Vec3d>{.totalMass = 2}))};
  sim.init();
  view::Stage stage(sim, 0.1, 0);
  const int state = 4;
  REQUIRE(stage.tree[std::size_t(state)].className == "MechanicalObject<Vec3d>");
  stage.measureField(state, "position");
  stage.measureField(state, "places");
  stage.settle();
  CHECK(stage.state().error.find("'places'") != std::string::npos);
  stage.measure(true);
  for (int i = 0; i < 3; ++i) stage.step();
  stage.measure(false);
  stage.step();
  Measures all;
  stage.measures([&](Measures const& m) { all = m; });
  stage.settle();
  REQUIRE(all.times.size() == 3);
  REQUIRE(all.series.size() == 4);
  CHECK(all.times[2] == Approx(0.3));
  // v = 1, 2, 3 m/s
  CHECK(all.series[1].values[0] == Approx(1));
  CHECK(all.series[1].values[2] == Approx(9));
  CHECK(all.series[0].values[1] > 0);
  CHECK(all.series[3].values == std::vector<double>{7, 7, 7});
  CHECK(all.series[3].name == "/root/body: MechanicalObject<Vec3d>: position");
  const std::string csv = view::csv_of(all);
  CHECK(
      csv.starts_with("time [s],time of a step [ms],kinetic energy [J],energy of the force fields [J],"
                      "/root/body: MechanicalObject<Vec3d>: position [m]\n0.1,"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 4);
  CHECK(std::count(csv.begin(), csv.end(), ',') == 16);
  // a picture that programs read, with a line for each series
  pugi::xml_document document;
  REQUIRE(document.load_string(view::svg_of(all).c_str()));
  int lines = 0;
  for (auto const& line : document.child("svg").children("polyline")) {
    std::istringstream points(line.attribute("points").value());
    int count = 0;
    for (std::string point; points >> point; ++count) {
      double x = 0, y = 0;
      CHECK(std::sscanf(point.c_str(), "%lf,%lf", &x, &y) == 2);
      CHECK((x >= 80 && x <= 700 && y >= 150 * lines && y <= 150 * (lines + 1)));
    }
    CHECK(count == 3);
    ++lines;
  }
  CHECK(lines == 4);
  // behind a reset all begins anew
  stage.measure(true);
  stage.reset();
  stage.step();
  stage.measures([&](Measures const& m) { all = m; });
  stage.settle();
  CHECK(all.times.size() == 1);
  // and the memory stays bounded
  Measures many;
  many.series.push_back({"a", "b"});
  for (std::size_t i = 0; i < 3 * Measures::most; ++i) {
    many.drop();
    many.times.push_back(double(i));
    many.series[0].values.push_back(0);
  }
  CHECK(many.times.size() <= Measures::most);
  CHECK(many.times.back() == double(3 * Measures::most - 1));
  CHECK(many.series[0].values.size() == many.times.size());
}

// a block that hangs, so that its force takes more than all else
auto hanging() {
  Mesh mesh = regular_grid_tetrahedra(6, 6, 6, {0, 0, 0}, {1, 1, 1});
  return node<"root">(
      Gravity{{0, -10, 0}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 20, .tolerance = 1e-12},
      node<"block">(TetrahedronTopology{mesh.tetrahedra},
                    MechanicalObject<Vec3d>{mesh.positions},
                    UniformMass<Vec3d>{.totalMass = 1},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {1000}, .poissonRatio = 0.3}));
}
view::StageState profiled_state(view::Stage& stage) {
  stage.profile(true);
  stage.settle();
  if (!stage.state().error.empty()) return stage.state();
  stage.play(true);
  for (int i = 0; i < 1000 && !stage.state().profile && stage.state().error.empty(); ++i) {
    stage.scene();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  stage.play(false);
  stage.settle();
  return stage.state();
}

TEST_CASE("the time of each component, as a table and as a picture") {
  Simulation sim{profiled(hanging())};
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  const view::StageState state = profiled_state(stage);
  REQUIRE(state.profile);
  CHECK(state.profiling);
  auto const& shares = state.profile->shares;
  CHECK(state.profile->steps > 1);
  double sum = 0, of = 0;
  for (auto const& one : shares) {
    sum += one.share;
    of += one.milliseconds;
    CHECK(one.milliseconds <= shares[0].milliseconds);
  }
  CHECK(sum == Approx(1));
  CHECK(of > 0);
  CHECK(shares[0].className == "TetrahedronFEMForceField<Vec3d>");
  CHECK(shares[0].share > 0.2);
  CHECK(shares[0].calls >= 2);
  const std::string csv = view::csv_of(*state.profile);
  CHECK(csv.starts_with("component or phase,class,time in a step [ms],share [%],calls in a step\n"));
  CHECK(std::count(csv.begin(), csv.end(), '\n') == long(shares.size()) + 1);
  CHECK(std::count(csv.begin(), csv.end(), ',') == 4 * (long(shares.size()) + 1));
  pugi::xml_document document;
  REQUIRE(document.load_string(view::svg_of(*state.profile).c_str()));
  std::vector<double> bars;
  for (auto const& bar : document.child("svg").children("rect"))
    bars.push_back(bar.attribute("width").as_double());
  REQUIRE(bars.size() == shares.size());
  CHECK(bars[0] == Approx(330));
  CHECK(bars[1] == Approx(330 * shares[1].milliseconds / shares[0].milliseconds).epsilon(1e-3));
  // and no more of it
  stage.profile(false);
  stage.settle();
  CHECK_FALSE(stage.state().profile);
  CHECK_FALSE(stage.state().profiling);
}

TEST_CASE("a runtime tree is timed through changes of its fields; a typed scene without timers says so") {
  Simulation sim{hanging()};
  sim.init();
  {
    view::Stage stage(sim, 0.01, 0);
    CHECK(profiled_state(stage).error.find("profiled(node<...>(...))") != std::string::npos);
    CHECK_FALSE(stage.state().profiling);
  }
  struct Mine : Registry<EulerImplicitSolver,
                         CGLinearSolver<>,
                         Gravity,
                         TetrahedronTopology,
                         MechanicalObject<Vec3d>,
                         UniformMass<Vec3d>,
                         TetrahedronFEMForceField<Vec3d>> {};
  Simulation tree{to_runtime<Mine>(hanging())};
  tree.init();
  {
    view::Stage stage(tree, 0.01, 0);
    for (int round = 0; round < 2; ++round) {
      const view::StageState state = profiled_state(stage);
      INFO("round " << round << ", step " << state.step << ": " << state.error);
      REQUIRE(state.profile);
      CHECK(state.profile->shares[0].className == "TetrahedronFEMForceField<Vec3d>");
      stage.profile(false);
      // a field makes it another tree
      for (std::size_t i = 0; i < stage.tree.size(); ++i)
        if (stage.tree[i].className == "UniformMass<Vec3d>") stage.setField(int(i), "totalMass", "2");
    }
    stage.profile(true);
  }
  CHECK(tree.root().profile == nullptr);  // nothing is left of it
}

}  // namespace test_plots
