// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/io/read_rigid.hpp>

namespace test_read_rigid {

using namespace sinew;

namespace {

std::string message(std::string_view content) {
  try {
    io::parse_rigid("a.rigid", content);
  } catch (Error const& error) {
    return error.what();
  }
  return "";
}
bool says(std::string_view content, std::string_view words) {
  const std::string said = message(content);
  INFO(said);
  CHECK(said.find("a.rigid:") == 0);
  return said.find(words) != said.npos;
}

}  // namespace

TEST_CASE("rigid masses are read, with the inertia divided by the mass") {
  const auto body = io::parse_rigid("a.rigid",
                                    "Xsp 3.0\n"
                                    "# a comment\n"
                                    "mass 2.5\n"
                                    "volm 8\n"
                                    "cntr 0 0.1 0\n"
                                    "frme 0 0 0 1\n"
                                    "inrt 1 0.1 0\n"
                                    "     0.1 2 0\r\n"
                                    "     0 0 3\n"
                                    "grav 0 0 -9.81\n"
                                    "visc 0\nstck 0\nstep 0.01\nprec 1e-3");
  CHECK(body.mass == 2.5);
  Eigen::Matrix3d expected;
  expected << 2.5, 0.25, 0, 0.25, 5, 0, 0, 0, 7.5;
  CHECK((body.inertia - expected).norm() < 1e-15);

  const auto other = io::parse_rigid("a.rigid", "Xsp 4.0 rigid\nvertexMass 3\n");
  CHECK(other.mass == 3);
  CHECK(other.inertia == 3 * Eigen::Matrix3d::Identity());
  CHECK(io::parse_rigid("a.rigid", "Xsp 3.0\n").mass == 1);
}

TEST_CASE("an inertia beyond the largest number is refused, not kept as infinite") {
  CHECK(says("Xsp 3.0\nmass 1e200\ninrt 1e200 0 0 0 1 0 0 0 1\n",
             "the mass of 1e+200 kg times the inertia is beyond"));
}

TEST_CASE("broken files of rigid masses are refused with their line") {
  CHECK(says("mass 1", "a.rigid:1: expected Xsp"));
  CHECK(says("Xsp 3.0\nmass -1", "a.rigid:2: the mass is -1 kg"));
  CHECK(says("Xsp 3.0\nmass nan", "not a finite number"));
  CHECK(says("Xsp 3.0\nmass\n", "a mass is expected"));
  CHECK(says("Xsp 3.0\ninrt 1 0 0 0 1 0 0 0", "the data end where an entry of the inertia is expected"));
  CHECK(says("Xsp 3.0\ninrt 1 0 0 0 x 0 0 0 1", "found \"x\""));
  CHECK(says("Xsp 3.0\ncntr 0 0", "a coordinate is expected"));
  CHECK(says("Xsp 3.0\n\nmas 1", "a.rigid:3: expected mass, inrt, cntr"));
  CHECK(says(std::string_view("Xsp 3.0\nmass \0 1", 16), "holds the byte 0"));
}

}  // namespace test_read_rigid
