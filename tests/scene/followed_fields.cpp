// SPDX-License-Identifier: BSL-1.0
// How the fields of components follow when points and elements are removed.
#include <sinew/registry.hpp>

#include <set>

#include "catch.hpp"

namespace test_followed_fields {

using namespace sinew;

namespace {

template <class C>
constexpr bool acts_on_points =
    HasRole<C, role::Mass> || HasRole<C, role::ForceField> || HasRole<C, role::InteractionForceField> ||
    HasRole<C, role::ProjectiveConstraint> || HasRole<C, role::Mapping>;

bool says(std::string_view documentation, std::string_view words) {
  return documentation.find(words) != std::string_view::npos;
}

Renumbering without(std::size_t n, std::set<std::size_t> const& gone) {
  std::vector<bool> stays(n, true);
  for (const std::size_t i : gone) stays[i] = false;
  return Renumbering::of(stays);
}

}  // namespace

TEST_CASE("every list of a component says what its entries stand for") {
  // lists of integers that number neither points nor elements
  const std::set<std::string_view> free{"coordinates"};
  int lists = 0;
  for_each_registered<Standard>([&]<class C>() {
    if constexpr (acts_on_points<C>)
      for_each_field_of<C>([&]<class T>(Field<C, T> const& fd) {
        INFO(component_name<C>() << ": " << fd.name);
        if constexpr (std::is_same_v<T, std::vector<int>>) {
          constexpr bool byHand = requires(C c, Followed change) { c.follow(change); } ||
                                  requires(C c, Renumbering child, std::vector<Renumbering const*> above) {
                                    c.follow(child, above);
                                  };
          CHECK((byHand || fd.entries != Of::nothing || free.contains(fd.name)));
          ++lists;
        } else if constexpr (requires(T list) { list.resize(0), list[0]; }) {
          const bool each = says(fd.documentation, "for each") || says(fd.documentation, "or each") ||
                            says(fd.documentation, "one a ");
          if (each) CHECK(fd.entries != Of::nothing);
        }
      });
  });
  CHECK(lists > 20);
}

TEST_CASE("polynomial springs take their coefficients with them") {
  PolynomialSpringsForceField<Vec3d> springs{.firstObjectPoints = {0, 1, 2},
                                             .secondObjectPoints = {1, 2, 3},
                                             .polynomialStiffness = {1, 2, 3, 4, 5, 6},
                                             .polynomialDegree = {1, 2, 3},
                                             .zeroLength = {7, 8, 9}};
  const Renumbering points = without(5, {3});
  follow_fields(springs, {points, points, {}, {}});
  CHECK(springs.polynomialStiffness == std::vector<double>{1, 2, 3});
  CHECK(springs.polynomialDegree == std::vector<int>{1, 2});
  CHECK(springs.zeroLength == std::vector<double>{7, 8});
  CHECK(springs.secondObjectPoints == std::vector<int>{1, 2});
  const Renumbering rest = without(4, {0, 1, 2});
  follow_fields(springs, {rest, rest, {}, {}});
  CHECK(springs.none);
  springs.init({"there", {{0, 0, 0}}, {}});
  CHECK(springs.driver.packs.empty());
}

TEST_CASE("an angular spring goes with either of its bodies, and the others stay") {
  using Springs = AngularSpringForceField<Rigid3d>;
  auto follow = [](std::set<std::size_t> const& gone) {
    Springs springs{.indices = {0, 1, 2, 4, 5}, .angularStiffness = {1, 2, 3, 4, 5}};
    const Renumbering points = without(6, gone);
    follow_fields(springs, {points, points, {}, {}});
    return springs;
  };
  CHECK(follow({2}).indices == std::vector<int>{0, 1, 3, 4});
  CHECK(follow({2}).angularStiffness == std::vector<double>{1, 2, 4, 5});
  CHECK(follow({3}).indices == std::vector<int>{0, 1, 2, 4});
  // the first of the indices has no spring: another stands in for it
  CHECK(follow({0}).indices == std::vector<int>{1, 1, 3, 4});
  CHECK(follow({0}).angularStiffness == std::vector<double>{1, 3, 4, 5});
  CHECK(follow({0, 2, 4}).none);
}

TEST_CASE("tetrahedra that stay keep their past; values of elements split from hexahedra go with these") {
  using Force = TetrahedronViscoelasticityFEMForceField<Vec3d>;
  Force force{};
  const std::size_t size = 2 * sizeof(TetrahedronViscoelasticity<Vec3d>::Memory) / sizeof(double);
  for (std::size_t e = 0; e < 3; ++e) force.memory.insert(force.memory.end(), size, double(e));
  TopologyChange change;
  change.elements[3] = without(3, {1});
  follow_fields(force, {{}, {}, {}, change});
  REQUIRE(force.memory.size() == 2 * size);
  CHECK(force.memory[size - 1] == 0);
  CHECK(force.memory[size] == 2);

  TetrahedronFEMForceField<Vec3d> split{.youngModulus = std::vector<double>(12, 1)};
  for (std::size_t i = 6; i < 12; ++i) split.youngModulus[i] = 2;
  change.elements[3] = {};
  change.elements[4] = without(2, {0});
  follow_fields(split, {{}, {}, {}, change});
  CHECK(split.youngModulus == std::vector<double>(6, 2));

  // the plastic strain of each has six entries
  TetrahedronFEMForceField<Vec3d> plastic{.plasticMaxThreshold = 1};
  for (std::size_t i = 0; i < 18; ++i) plastic.plasticStrain.push_back(double(i));
  change.elements[4] = {};
  change.elements[3] = without(3, {1});
  change.elements[3].come = {{2, 2, 0.5}};
  follow_fields(plastic, {{}, {}, {}, change});
  REQUIRE(plastic.plasticStrain.size() == 18);
  CHECK(plastic.plasticStrain[5] == 5);
  CHECK(plastic.plasticStrain[6] == 12);
  CHECK(plastic.plasticStrain[12] == 12);
  CHECK(plastic.plasticStrain[17] == 17);
}

TEST_CASE("values of elements stay where no element of the topology goes") {
  MeshMatrixMass<Vec3d> mass{.massDensity = {1, 2, 3}};
  follow_fields(mass, {{}, {}, {}, {}});
  CHECK(mass.massDensity == std::vector<double>{1, 2, 3});
}

TEST_CASE("pressure goes with the triangles that are named, and does not turn to all") {
  SurfacePressureForceField<Vec3d> pressure{.pressure = 1, .triangleIndices = {2}};
  TopologyChange change;
  change.elements[1] = without(3, {2});
  follow_fields(pressure, {{}, {}, {}, change});
  CHECK(pressure.none);
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  pressure.init({"there", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {.triangles = triangles}});
  CHECK(pressure.driver.packs.empty());
}

}  // namespace test_followed_fields
