// SPDX-License-Identifier: BSL-1.0
// Whatever stands in the fields of a typed scene, it is refused by an Error or stays finite: numbers that
// nobody means, lists that are empty, cut, longer or doubled, indices of anything.

#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/sinew.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace test_random_fields {

using namespace sinew;

namespace {

// f(component) for all in and below a node
template <class Node, class F>
void each(Node& node, F& f) {
  node.forEachComponent(on<AnyRole>([&](auto& component) { f(component); }));
  hana::for_each(node.children, [&](auto& child) { each(child, f); });
}

struct Scrambler {
  std::mt19937 random;
  int changes = 0;

  int upTo(int n) { return int(random() % unsigned(n)); }
  double number() {
    constexpr double odd[] = {0, -0.0, 1, -1, 2, 7, 0.5, 1e-300, 1e-9, 1e9, 1e300, -1e300, 99999, -99999};
    constexpr double none[] = {std::numeric_limits<double>::quiet_NaN(),
                               std::numeric_limits<double>::infinity()};
    return upTo(8) == 0 ? none[upTo(2)] : odd[upTo(int(std::size(odd)))];
  }
  int whole() {
    constexpr int odd[] = {0, 1, 2, 3, -1, 4, 7, 100, 99999, 2147483647, -2147483647 - 1};
    return odd[upTo(int(std::size(odd)))];
  }

  template <class T>
  void change(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = !value;
    } else if constexpr (std::is_enum_v<T>) {
      value = T(upTo(int(enum_names(T{}).size())));
    } else if constexpr (std::is_floating_point_v<T>) {
      value = T(number());
    } else if constexpr (std::is_integral_v<T>) {
      value = T(whole());
    } else if constexpr (std::is_convertible_v<T, std::string_view>) {
      value = upTo(2) ? "" : "nothing";
    } else if constexpr (requires {
                           value.has_value();
                           value.emplace();
                         }) {
      if (upTo(3) == 0)
        value.reset();
      else
        change(value ? *value : value.emplace());
    } else if constexpr (HasFields<T>) {
      changeField(value);
    } else if constexpr (requires { value.resize(0), value.push_back(value[0]); }) {
      changeList(value);
    } else if constexpr (requires {
                           value.rows();
                           value.coeffRef(0);
                         }) {
      if (value.size() > 0) change(value.coeffRef(upTo(int(value.size()))));
    } else if constexpr (requires { value[0], value.size(); }) {
      change(value[std::size_t(upTo(int(value.size())))]);
    } else {
      return;
    }
    ++changes;
  }
  template <class List>
  void changeList(List& list) {
    const std::size_t n = list.size();
    const int kind = upTo(6);
    if (kind == 0) {
      list.clear();
    } else if (kind == 1) {
      list.resize(std::size_t(upTo(int(n) + 1)));
    } else if (kind == 2) {
      list.resize(n + 1 + std::size_t(upTo(5)));
    } else if (kind == 3) {
      for (std::size_t i = 0; i < n; ++i) list.push_back(typename List::value_type(list[i]));
    } else {
      if (n == 0) list.resize(1);
      typename List::value_type one = list[std::size_t(upTo(int(list.size())))];
      change(one);
      list[std::size_t(upTo(int(list.size())))] = one;
    }
  }
  // one of the fields of a struct
  template <class T>
  void changeField(T& owner) {
    int count = 0;
    for_each_field(owner, [&](auto const&, auto&) { ++count; });
    if (count == 0) return;
    int which = upTo(count);
    for_each_field(owner, [&](auto const& field, auto& value) {
      if (which-- != 0) return;
      change(value);
      // where Newton's method or its line search does not converge it goes on as long as it is told to
      if constexpr (std::is_same_v<std::decay_t<decltype(value)>, int>)
        if (field.name.starts_with("maxNbIterations")) value = std::min(value, 1000);
    });
  }
  template <class Simulation>
  void changeScene(Simulation& sim) {
    int count = 0;
    auto counted = [&](auto&) { ++count; };
    each(sim.root(), counted);
    REQUIRE(count > 0);
    for (int n = 1 + upTo(3); n > 0; --n) {
      int which = upTo(count);
      auto changed = [&](auto& component) {
        if (which-- == 0) changeField(component);
      };
      each(sim.root(), changed);
    }
  }
};

// how many of `count` scenes ran to their end
template <class Make>
int run(Make const& make, unsigned seed, int count) {
  const std::size_t limit = memory_limit.exchange(std::size_t(100) << 20);
  int ran = 0;
  for (int k = 0; k < count; ++k) {
    CAPTURE(seed, k);
    Scrambler scrambler{std::mt19937(seed * 100003 + unsigned(k))};
    auto sim = make();
    while (scrambler.changes == 0) scrambler.changeScene(sim);
    const std::string said = error_of([&] {
      sim.init();
      for (int i = 0; i < 3; ++i) sim.animate(0.01);
    });
    if (!said.empty()) continue;
    ++ran;
    auto finite = [](auto& component) {
      if constexpr (HasRole<std::decay_t<decltype(component)>, role::State>)
        for (auto const& v : component.velocity) CHECK(all_finite(v));
    };
    each(sim.root(), finite);
  }
  memory_limit = limit;
  return ran;
}

const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

}  // namespace

TEST_CASE(
    "random fields of an elastic body with a skin and constraints end in an Error or in finite states") {
  auto make = [] {
    return Simulation{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
        CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{},
        node<"body">(TetrahedronTopology{{{0, 1, 2, 3}}},
                     MechanicalObject<Vec3d>{corners},
                     DiagonalMass<Vec3d>{.massDensity = 1},
                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                     FixedConstraint<Vec3d>{.indices = {0}},
                     node<"skin">(MechanicalObject<Vec3d>{.position = {{0.2, 0.2, 0.2}, {0.1, 0.5, 0.1}}},
                                  BarycentricMapping<Vec3d, Vec3d>{},
                                  ConstantForceField<Vec3d>{.indices = {1}, .forces = {{0, 1, 0}}})))};
  };
  CHECK(run(make, 1, 1000) > 100);
}

TEST_CASE("random fields of springs and a rigid body end in an Error or in finite states") {
  auto make = [] {
    return Simulation{node<"root">(
        EulerExplicitSolver{},
        node<"string">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
                       UniformMass<Vec3d>{.totalMass = 3},
                       StiffSpringForceField<Vec3d>{
                           {{.first = 0, .second = 1, .stiffness = 100, .damping = 1, .length = 1},
                            {.first = 1, .second = 2, .stiffness = 100, .damping = 1, .length = 1}}},
                       PlaneForceField<Vec3d>{.normal = {0, 1, 0}, .stiffness = 10},
                       PartialFixedConstraint<Vec3d>{.indices = {0}}),
        node<"rigid">(MechanicalObject<Rigid3d>{.position = {{}}},
                      UniformMass<Rigid3d>{},
                      node<"points">(MechanicalObject<Vec3d>{.position = {{1, 0, 0}}},
                                     RigidMapping<Rigid3d, Vec3d>{})))};
  };
  CHECK(run(make, 2, 1000) > 100);
}

TEST_CASE("random fields of bodies in contact end in an Error or in finite states") {
  auto make = [] {
    return Simulation{node<"root">(
        DefaultPipeline{},
        BruteForceBroadPhase{},
        BVHNarrowPhase{},
        MinProximityIntersection{.alarmDistance = 0.2, .contactDistance = 0.1},
        DefaultContactManager{},
        EulerImplicitSolver{},
        CGLinearSolver<>{},
        node<"body">(TetrahedronTopology{{{0, 1, 2, 3}}},
                     MechanicalObject<Vec3d>{corners},
                     UniformMass<Vec3d>{.totalMass = 1},
                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                     TriangleCollisionModel<Vec3d>{},
                     PointCollisionModel<Vec3d>{}),
        node<"floor">(MeshTopology{.triangles = {{0, 1, 2}}},
                      MechanicalObject<Vec3d>{.position = {{-3, -0.05, -3}, {0, -0.05, 5}, {5, -0.05, 0}}},
                      TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}))};
  };
  CHECK(run(make, 3, 1000) > 100);
}

}  // namespace test_random_fields
