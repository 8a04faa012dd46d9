// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/engine/generate_rigid_mass.hpp>

namespace test_generate_rigid_mass {

using namespace sinew;

namespace {

using Generate = GenerateRigidMass<Rigid3d>;
static_assert(Engine<Generate> && Engine<GenerateRigidMass<Rigid3f>>);

/// A box of 1 x 2 x 3 around (4, 5, 6).
Generate box() {
  Generate g{.density = 10};
  for (int k = 0; k < 8; ++k) g.position.push_back({3.5 + k % 2, 4.0 + 2 * (k / 2 % 2), 4.5 + 3 * (k / 4)});
  g.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return g;
}
std::string message(Generate g) {
  try {
    g.update("/root/g");
  } catch (Error const& error) {
    return error.what();
  }
  return "";
}
bool says(Generate const& g, std::string_view words) {
  const std::string said = message(g);
  INFO(said);
  CHECK(said.find("/root/g: GenerateRigidMass<Rigid3d>: ") == 0);
  return said.find(words) != said.npos;
}

}  // namespace

TEST_CASE("the mass of a box is that of a rigid body about its centre") {
  Generate g = box();
  // one side as two triangles
  g.quads.pop_back();
  g.triangles = {{1, 3, 7}, {1, 7, 5}};
  g.update("g");
  CHECK(g.volume == Approx(6));
  CHECK(g.mass == Approx(60));
  CHECK(g.rigidMass.mass == g.mass);
  const Eigen::Matrix3d perMass = Eigen::Vector3d((4 + 9) / 12., (1 + 9) / 12., (1 + 4) / 12.).asDiagonal();
  CHECK((g.inertiaMatrix - perMass).norm() < 1e-13);
  CHECK((g.rigidMass.inertia - 60 * perMass).norm() < 1e-12);
  CHECK((g.massCenter - Eigen::Vector3d(4, 5, 6)).norm() < 1e-14);
  CHECK(g.centerToOrigin == -g.massCenter);
}

TEST_CASE("bodies that have no mass are refused, and what was made stays") {
  Generate g = box();
  g.update("g");
  Generate open = g;
  open.quads.pop_back();
  CHECK(says(open, "not closed"));
  CHECK_THROWS(open.update(""));
  CHECK(open.mass == g.mass);
  CHECK(says(Generate{}, "there is no triangle"));
  Generate other = g;
  other.density = 0;
  CHECK(says(other, "density is 0 kg/m^3"));
  other = g;
  other.position[2][1] = std::nan("");
  CHECK(says(other, "position[2] is nan m"));
  other = g;
  other.quads[0][0] = 9;
  CHECK(says(other, "quad 0 refers to point 9"));
}

}  // namespace test_generate_rigid_mass
