// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/mesh_spring.hpp>
#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/stiff_spring.hpp>

namespace test_stiff_spring {

using namespace sinew;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

using Springs = StiffSpringForceField<Vec3d>;
const Vec3d::VecCoord line{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};

// the whole of the line stretched or shortened about the origin
Vec3d::VecCoord scaled(double factor) {
  Vec3d::VecCoord x = line;
  for (auto& p : x) p *= factor;
  return x;
}

}  // namespace

TEST_CASE("springs may be given as lists, as SOFA does since 24.12") {
  auto lists = ready(Springs{.springsIndices1 = {0, 1},
                             .springsIndices2 = {1, 2},
                             .stiffness = {10, 20},
                             .damping = {0, 1},
                             .lengths = {1, 1.5}},
                     line);
  auto single =
      ready(Springs{.springs = {{.first = 0, .second = 1, .stiffness = 10, .length = 1},
                                {.first = 1, .second = 2, .stiffness = 20, .damping = 1, .length = 1.5}}},
            line);
  const Vec3d::VecDeriv v{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  for (const double factor : {0.5, 1.0, 2.0}) {
    const auto x = scaled(factor);
    CHECK(force(lists, x, v) == force(single, x, v));
    CHECK(potential_energy(lists, x) == potential_energy(single, x));
  }
  // one value for all; without lengths they are 0
  auto same = ready(Springs{.springsIndices1 = {0, 1}, .springsIndices2 = {1, 2}}, line);
  CHECK((force(same, line)[0] - Vector3d(100, 0, 0)).norm() < 1e-12);
  CHECK((force(same, line)[2] - Vector3d(-200, 0, 0)).norm() < 1e-12);
  // behind those given one by one
  Springs both{.springs = {{.first = 0, .second = 1}}, .springsIndices1 = {0}, .springsIndices2 = {2}};
  CHECK(ready(both, line).driver.size() == 2);
}

TEST_CASE("strings pull and never push, each by its own mark") {
  auto mixed = ready(Springs{.springs = {{.first = 0, .second = 1, .stiffness = 10},
                                         {.first = 1, .second = 2, .stiffness = 10, .damping = 1}},
                             .elongationOnly = {false, true}},
                     line);
  // shorter than at rest, and getting shorter: only the spring 01 is there
  auto x = scaled(0.5);
  const Vec3d::VecDeriv v{{0, 0, 0}, {0, 0, 0}, {-1, 0, 0}};
  auto f = force(mixed, x, v);
  CHECK((f[0] - Vector3d(-5, 0, 0)).norm() < 1e-14);
  CHECK((f[1] - Vector3d(5, 0, 0)).norm() < 1e-14);
  CHECK(f[2].norm() == 0);
  CHECK(potential_energy(mixed, x) == Approx(0.5 * 10 * 0.25));
  const auto df = one::product(mixed, {{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}, 1, 1);
  for (auto const& d : df) CHECK(d.norm() == 0);
  // longer: the string pulls with 10 * 1 - 1 * 1
  x = scaled(1.5);
  f = force(mixed, x, v);
  CHECK((f[2] - Vector3d(-(10 * 1 - 1), 0, 0)).norm() < 1e-13);
  CHECK(potential_energy(mixed, x) == Approx(0.5 * 10 * (0.25 + 1)));
  CHECK((one::product(mixed, {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}}, 1, 0)[2] - Vector3d(-10, 0, 0)).norm() <
        1e-13);

  // a string without length is always longer than that
  auto none = ready(
      Springs{.springs = {{.first = 0, .second = 1, .stiffness = 10, .length = 0}}, .elongationOnly = {true}},
      line);
  CHECK((force(none, line)[0] - Vector3d(10, 0, 0)).norm() < 1e-14);
  CHECK(potential_energy(none, line) == Approx(5));
  CHECK(force(none, scaled(0))[0].norm() == 0);
}

TEST_CASE("springs that are not enabled are not there") {
  auto some =
      ready(Springs{.springsIndices1 = {0, 1}, .springsIndices2 = {1, 2}, .enabled = {false, true}}, line);
  CHECK(force(some, line)[0].norm() == 0);
  CHECK((force(some, line)[2] - Vector3d(-200, 0, 0)).norm() < 1e-12);
  auto off = ready(Springs{.springs = {{.first = 0, .second = 1, .length = 5}}, .enabled = {false}}, line);
  for (auto const& f : force(off, line)) CHECK(f.norm() == 0);
}

TEST_CASE("a grid of strings carries tension alone") {
  const Vec3d::VecCoord square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const TopologyView grid{.grid = {2, 2, 1}};
  auto strings =
      ready(RegularGridSpringForceField<Vec3d>{.stiffness = 10, .damping = 1, .elongationOnly = true},
            square,
            grid);
  auto springs = ready(RegularGridSpringForceField<Vec3d>{.stiffness = 10, .damping = 1}, square, grid);
  auto x = square;
  for (auto& p : x) p *= 0.9;
  for (auto const& f : force(strings, x, {{1, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}})) CHECK(f.norm() == 0);
  CHECK(potential_energy(strings, x) == 0);
  CHECK(force(springs, x)[0].norm() > 1);
  for (auto& p : x) p *= 2;
  CHECK(force(strings, x) == force(springs, x));
  CHECK(potential_energy(strings, x) == potential_energy(springs, x));
}

TEST_CASE("lists of springs that do not fit are refused") {
  refuses(Springs{.springsIndices1 = {0}, .springsIndices2 = {}},
          line,
          {},
          {"body", "StiffSpringForceField<Vec3d>", "springsIndices1 has 1 points and springsIndices2 0"});
  refuses(Springs{.springsIndices1 = {0}, .springsIndices2 = {3}},
          line,
          {},
          {"springs[0] refers to point 3", "3 points"});
  refuses(Springs{.springsIndices1 = {2}, .springsIndices2 = {2}}, line, {}, {"joins point 2 to itself"});
  refuses(Springs{.springsIndices1 = {-2}, .springsIndices2 = {2}}, line, {}, {"springsIndices1[0] is -2"});
  const std::vector<int> first{0, 1}, second{1, 2};
  refuses(Springs{.springsIndices1 = first, .springsIndices2 = second, .stiffness = {1, 2, 3}},
          line,
          {},
          {"stiffness has 3 values for 2 springs"});
  refuses(Springs{.springsIndices1 = first, .springsIndices2 = second, .damping = {1, -2}},
          line,
          {},
          {"damping[1] is -2 N s/m"});
  refuses(Springs{.springsIndices1 = first, .springsIndices2 = second, .lengths = {1, one::notANumber}},
          line,
          {},
          {"lengths[1] is nan"});
  refuses(Springs{.springsIndices1 = first, .springsIndices2 = second, .elongationOnly = {true, false, true}},
          line,
          {},
          {"elongationOnly has 3 values for 2 springs"});
  refuses(Springs{.springsIndices1 = first, .springsIndices2 = second, .enabled = {true, false, true}},
          line,
          {},
          {"enabled has 3 values for 2 springs"});
}

}  // namespace test_stiff_spring
