// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/runtime/cpp_text.hpp>
#include <sinew/runtime/value_text.hpp>

#include <random>

namespace test_value_text {

using namespace sinew;
using Bodies = std::vector<RigidMass<double, 3>>;

namespace {

template <class T>
T read(std::string_view words, T value = {}) {
  read_value(words, value);
  return value;
}
template <class T>
std::string refusal(std::string_view words) {
  try {
    read<T>(words);
  } catch (Error const& error) {
    return error.what();
  }
  return "nothing was wrong";
}

}  // namespace

TEST_CASE("words become values") {
  CHECK(read<double>(" 1.5e3\n") == 1500);
  CHECK(read<double>("+2.") == 2);
  CHECK(read<double>("1e-400") == 0);
  CHECK(read<bool>("true"));
  CHECK_FALSE(read<bool>("0"));
  CHECK(read<RotationMethod>("polar") == RotationMethod::polar);
  CHECK(read<std::string>("  two words ") == "two words");
  CHECK(read<std::optional<double>>("3") == 3.0);
  CHECK(!read<std::optional<double>>("auto", 1.0));
  CHECK(read<Eigen::Vector3d>("1 2 3") == Eigen::Vector3d(1, 2, 3));
  CHECK(read<Eigen::Vector3d>("0", {1, 1, 1}) == Eigen::Vector3d(0, 0, 0));
  CHECK(read<Vec3d::VecCoord>("1 2 3\t4 5 6") == Vec3d::VecCoord{{1, 2, 3}, {4, 5, 6}});
  CHECK(read<std::vector<Tetrahedron>>("0 1 2 3 4 5 6 7") ==
        std::vector<Tetrahedron>{{0, 1, 2, 3}, {4, 5, 6, 7}});
  const auto rigid = read<Rigid3d::VecCoord>("1 2 3 0.5 0.5 0.5 0.5");
  CHECK(rigid[0].center == Eigen::Vector3d(1, 2, 3));
  CHECK(rigid[0].orientation.w() == 0.5);
  const auto mass = read<RigidMass<double, 3>>("2 1  3 0 0 0 4 0 0 0 5");
  CHECK(mass.mass == 2);
  CHECK(mass.inertia.diagonal() == Eigen::Vector3d(6, 8, 10));  // SOFA's inertia is by mass
  CHECK(read<RigidMass<double, 3>>("2").inertia(1, 1) == 2);
  const auto masses = read<Bodies>(" 15 15 [20 0 0,0 20 0,0 0 20] 1 [1 0 0,0 2 0,0 0 3]");
  REQUIRE(masses.size() == 2);
  CHECK(masses[0].mass == 15);
  CHECK(masses[0].inertia == 300 * Eigen::Matrix3d::Identity());
  CHECK(masses[1].mass == 1);
  CHECK(masses[1].inertia.diagonal() == Eigen::Vector3d(1, 2, 3));
  CHECK(read<Bodies>("2 1  3 0 0 0 4 0 0 0 5").size() == 1);
  CHECK(read<Bodies>("  ").empty());
  CHECK(read<std::vector<RigidMass<double, 2>>>("2 1 [3] 4 1 [5]")[1].inertia(0, 0) == 20);
  const auto springs = read<std::vector<Spring>>("0 1 100 5 0.1  1 2 200 6 auto");
  REQUIRE(springs.size() == 2);
  CHECK(springs[1].damping == 6);
  CHECK(springs[0].length == 0.1);
  CHECK(!springs[1].length);
}

TEST_CASE("lists of whole numbers have ranges") {
  using List = std::vector<int>;
  CHECK(read<List>("1-5") == List{1, 2, 3, 4, 5});
  CHECK(read<List>("7 1-3 9") == List{7, 1, 2, 3, 9});
  CHECK(read<List>("1-9-4") == List{1, 5, 9});
  CHECK(read<List>("-1") == List{-1});
  CHECK(read<List>("-3--1") == List{-3, -2, -1});
  CHECK(read<List>("") == List{});
  CHECK_THAT(refusal<List>("5-1"), Catch::Contains("leads nowhere"));
  CHECK_THAT(refusal<List>("0-2147483647"), Catch::Contains("shorten it"));
  CHECK_THAT(refusal<List>("0-1000000-0"), Catch::Contains("leads nowhere"));
  CHECK_THAT(refusal<List>("1-"), Catch::Contains("no whole number"));
}

TEST_CASE("what is no value is refused, with the word that is wrong") {
  CHECK_THAT(refusal<double>("12abc"), Catch::Contains("'12abc' is no number"));
  CHECK_THAT(refusal<double>(""), Catch::Contains("a number is expected"));
  CHECK_THAT(refusal<double>("1 2"), Catch::Contains("goes on with '2'"));
  CHECK_THAT(refusal<double>("1e999"), Catch::Contains("out of range"));
  CHECK_THAT(refusal<int>("1.5"), Catch::Contains("'1.5' is no whole number"));
  CHECK_THAT(refusal<int>("99999999999"), Catch::Contains("out of range"));
  CHECK_THAT(refusal<bool>("maybe"), Catch::Contains("neither true nor false"));
  CHECK_THAT(refusal<RotationMethod>("polr"), Catch::Contains("did you mean 'polar'?"));
  CHECK_THAT(refusal<Vec3d::VecCoord>("1 2 3 4"), Catch::Contains("ends where a number is expected"));
  const std::string one = refusal<RigidMass<double, 3>>("1 2 3");
  CHECK_THAT(one, Catch::Contains("here are 3 numbers"));
  CHECK_THAT(refusal<Bodies>("1 1 [1 0 0,0 1 0,0 0 1] 2 1"), Catch::Contains("here are 2 numbers"));
  CHECK_THAT(refusal<Bodies>("1 1 [1 0 0,0 1 0,0 0] 2 1 [1]"), Catch::Contains("here are 10 numbers"));
  CHECK_THAT(refusal<Bodies>("1 2 3"), Catch::Contains("here are 3 numbers"));
  CHECK_THAT(refusal<double>(std::string(1000, 'x')), Catch::Contains("...'"));
}

TEST_CASE("a value that is refused leaves the old one") {
  Vec3d::VecCoord positions{{1, 2, 3}};
  CHECK_THROWS_AS(read_value("4 5", positions), Error);
  CHECK(positions == Vec3d::VecCoord{{1, 2, 3}});
}

TEST_CASE("values go through words bit by bit") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const std::uint64_t bits = random();
    double d;
    std::memcpy(&d, &bits, sizeof d);
    if (!std::isfinite(d)) continue;
    CHECK(read<double>(write_value(d)) == d);
    const float f = float(d);
    if (std::isfinite(f)) CHECK(read<float>(write_value(f)) == f);
  }
  Rigid3d::VecCoord rigid(3);
  for (auto& r : rigid) r = {Eigen::Vector3d::Random(), Quat<double>(Eigen::Vector4d::Random().normalized())};
  CHECK(read<Rigid3d::VecCoord>(write_value(rigid)) == rigid);
  RigidMass<double, 3> mass{0.3, Eigen::Matrix3d::Random()};
  const auto again = read<RigidMass<double, 3>>(write_value(mass));
  CHECK(again.inertia == mass.inertia);
  CHECK(again.mass == mass.mass);
  const Bodies two{mass, {0.7, Eigen::Matrix3d::Random()}};
  const auto both = read<Bodies>(write_value(two));
  REQUIRE(both.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(both[i].inertia == two[i].inertia);
    CHECK(both[i].mass == two[i].mass);
  }
}

TEST_CASE("values are written as C++") {
  CHECK(cpp_value(true) == "true");
  CHECK(cpp_value(0.1f) == "0.1f");
  CHECK(cpp_value(RotationMethod::small) == "RotationMethod::small");
  CHECK(cpp_value(std::string("a\"b\\")) == "\"a\\\"b\\\\\"");
  CHECK(cpp_value(Vec3d::VecCoord{{0, 0.5, 1}}) == "{{0, 0.5, 1}}");
  CHECK(cpp_value(std::vector<Spring>{{.first = 1, .second = 2}}) ==
        "{{.first = 1, .second = 2, .stiffness = 100, .damping = 0}}");
}

}  // namespace test_value_text
