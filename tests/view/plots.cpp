// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/view/stage.hpp>

#include <pugixml.hpp>
#include <sstream>

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

}  // namespace test_plots
