// SPDX-License-Identifier: BSL-1.0
// Mappings that measure: lengths, volumes, the centre of mass.
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/topology/regular_grid.hpp>

#include "one_component.hpp"

namespace test_measuring_mappings {

using namespace sinew;
using one::says;

namespace {

const Vec3d::VecCoord rest{{0, 0, 0}, {1.2, 0.1, 0}, {0.1, 0.9, -0.2}, {0.2, 0.1, 1.3}, {1, 1, 1}};
const Vec3d::VecCoord points{{0, 0, 0}, {1.5, 0.1, 0.3}, {0.1, 0.7, -0.2}, {0.2, 0.4, 1.1}, {1.3, 1, 1}};
const std::vector<Edge> edges{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}, {3, 4}, {4, 1}};
constexpr double stiffness = 35;

const EulerImplicitSolver implicitEuler{.rayleighStiffness = 0.02, .rayleighMass = 0.1};

auto body() {
  return MechanicalObject<Vec3d>{.position = points, .velocity = {{0.3, -0.2, 0.1}}, .restPosition = rest};
}
template <class Linear>
auto with_springs(Linear linear) {
  StiffSpringForceField<Vec3d> springs;
  for (auto const& [a, b] : edges) springs.springs.push_back({a, b, stiffness, 0, {}});
  return RegistryScene{node<"root">(Gravity{{0, -9.81, 0}},
                                    implicitEuler,
                                    linear,
                                    node<"body">(body(), UniformMass<Vec3d>{.totalMass = 2}, springs))};
}
template <class Linear>
auto with_lengths(Linear linear, GeometricStiffness option = GeometricStiffness::exact) {
  return RegistryScene{node<"root">(
      Gravity{{0, -9.81, 0}},
      implicitEuler,
      linear,
      node<"body">(body(),
                   UniformMass<Vec3d>{.totalMass = 2},
                   node<"lengths">(MeshTopology{.edges = edges},
                                   MechanicalObject<Vec1d>{},
                                   DistanceMapping<Vec3d, Vec1d>{.geometricStiffness = option},
                                   RestShapeSpringsForceField<Vec1d>{.stiffness = {stiffness}})))};
}

double distance(Vec3d::VecDeriv const& a, Vec3d::VecDeriv const& b) {
  return (vec::flat(a) - vec::flat(b)).norm();
}

// forces, and products with K, of a scene
template <class Sim>
std::array<Vec3d::VecDeriv, 2> force_and_product(Sim& sim) {
  const NoScope above;
  const typename Sim::RootScope scope{sim.root(), above};
  MechanicalOperations operations(scope);
  auto& s = sim.template at<"body">().state();
  operations.computeForce(vec_id::force, vec_id::position, vec_id::velocity);
  const Vec3d::VecDeriv force = s.force;
  for (std::size_t i = 0; i < s.dx.size(); ++i)
    s.dx[i] = {std::sin(double(i)), 0.3, std::cos(3.0 * double(i))};
  vec::clear(s.force);
  operations.addMBKdx(vec_id::force, vec_id::dx, {.k = 1.7});
  return {force, s.force};
}

template <class Linear>
Vec3d::VecCoord after_steps(Linear linear, bool mapped, int steps = 1) {
  linear.tolerance = 1e-15, linear.iterations = 200;
  auto run = [&](auto sim) {
    sim.init();
    for (int i = 0; i < steps; ++i) sim.animate(0.02);
    return sim.template at<"body">().state().position;
  };
  return mapped ? run(with_lengths(linear)) : run(with_springs(linear));
}

}  // namespace

TEST_CASE("springs on mapped lengths are springs between the points: force and tangent") {
  auto springs = with_springs(CGLinearSolver<>{});
  auto mapped = with_lengths(CGLinearSolver<>{});
  springs.init();
  mapped.init();
  const auto expected = force_and_product(springs), found = force_and_product(mapped);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(vec::flat(expected[k]).norm() > 10);
    CHECK(distance(expected[k], found[k]) < 1e-13 * vec::flat(expected[k]).norm());
  }
  // what the lengths alone would give
  auto stiff = with_lengths(CGLinearSolver<>{}, GeometricStiffness::none);
  stiff.init();
  CHECK(distance(expected[1], force_and_product(stiff)[1]) > 1);
}

TEST_CASE("springs on mapped lengths are springs between the points: implicit steps") {
  // solves are good to 1e-15 of their right-hand side, the matrix has a condition below 1e3
  const auto expected = after_steps(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}, false);
  CHECK(distance(expected, points) > 0.01);
  CHECK(distance(expected, after_steps(CGLinearSolver<>{}, true)) < 1e-14);
  CHECK(distance(expected, after_steps(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{}, true)) < 1e-14);
  CHECK(distance(expected, after_steps(CGLinearSolver<CompressedRowSparseMatrixd>{}, true)) < 1e-14);
  // and on
  CHECK(distance(after_steps(CGLinearSolver<>{}, false, 50), after_steps(CGLinearSolver<>{}, true, 50)) <
        1e-11);
}

TEST_CASE("lengths: rest lengths, rigid bodies, points in one place") {
  auto mapped = [](DistanceMapping<Vec3d, Vec1d> m, Vec3d::VecCoord const& x, TopologyView topology) {
    Vec1d::VecCoord c;
    m.init({"/parent", rest, topology}, {"/parent/child", c, {}}, c);
    m.apply(c, x);
    return c;
  };
  const std::vector<Edge> one{{0, 1}};
  const double l = points[1].norm(), l0 = rest[1].norm();
  CHECK(mapped({}, points, {.edges = one})[0][0] == Approx(l - l0));
  CHECK(mapped({.computeDistance = true}, points, {.edges = one})[0][0] == Approx(l));
  CHECK(mapped({.computeDistance = true, .restLengths = {0.5}}, points, {.edges = one})[0][0] ==
        Approx(l - 0.5));
  // the sides of elements, each once
  const std::vector<Tetrahedron> two{{0, 1, 2, 3}, {1, 2, 3, 4}};
  CHECK(mapped({}, points, {.tetrahedra = two}).size() == 9);
  // in one place there is no direction, so no velocity and no force
  DistanceMapping<Vec3d, Vec1d> m{.geometricStiffness = GeometricStiffness::exact};
  Vec1d::VecCoord c;
  m.init({"/parent", rest, {.edges = one}}, {"/parent/child", c, {}}, c);
  m.apply(c, Vec3d::VecCoord(5, {1, 2, 3}));
  CHECK(c[0][0] == -l0);
  Vec1d::VecDeriv v(1);
  m.applyJ(v, points);
  CHECK(v[0][0] == 0);
  Vec3d::VecDeriv f(5, Eigen::Vector3d::Zero());
  m.applyJT(f, {Vec1d::Deriv(3)});
  m.updateK({Vec1d::Deriv(3)});
  m.addKx(f, points, 1);
  CHECK(vec::flat(f).norm() == 0);
}

TEST_CASE("volumes: a tetrahedron, and one inside out") {
  const std::vector<Tetrahedron> cells{{0, 1, 2, 3}, {0, 2, 1, 3}};
  const Vec3d::VecCoord x{{1, 1, 1}, {3, 1, 1}, {1, 4, 1}, {1, 1, 5}};
  VolumeMapping<Vec3d, Vec1d> m;
  Vec1d::VecCoord c;
  m.init({"/parent", x, {.tetrahedra = cells}}, {"/parent/child", c, {}}, c);
  m.apply(c, x);
  CHECK(c[0][0] == Approx(4));
  CHECK(c[1][0] == Approx(-4));
}

TEST_CASE("a stiff penalty on volumes keeps them where the body alone does not") {
  // a block of soft material that a weight stretches by much: each tetrahedron keeps its volume
  const Mesh mesh = regular_grid_tetrahedra(3, 3, 4, {0, 0, 0}, {1, 1, 1.5});
  auto change = [&](double penalty) {
    ConstantForceField<Vec3d> weight;
    for (int i = 27; i < 36; ++i) weight.indices.push_back(i);
    weight.forces = {{0, 0, 10}};
    FixedPlaneConstraint<Vec3d> floor{.indices = {0, 1, 2, 3, 4, 5, 6, 7, 8}};
    floor.direction = {0, 0, 1};
    RegistryScene sim{node<"root">(
        Gravity{{0, 0, 0}},
        EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 1},
        SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{},
        node<"body">(
            TetrahedronTopology{mesh.tetrahedra},
            MechanicalObject<Vec3d>{mesh.positions},
            UniformMass<Vec3d>{.totalMass = 1},
            TetrahedronFEMForceField<Vec3d>{.youngModulus = {300}, .poissonRatio = 0.1},
            weight,
            floor,
            FixedConstraint<Vec3d>{.indices = {4}},
            node<"volumes">(MechanicalObject<Vec1d>{},
                            VolumeMapping<Vec3d, Vec1d>{.geometricStiffness = GeometricStiffness::exact},
                            RestShapeSpringsForceField<Vec1d>{.stiffness = {penalty}})))};
    sim.init();
    for (int i = 0; i < 200; ++i) sim.animate(0.05);
    auto const& volumes = sim.template at<"body/volumes">().state();
    double sum = 0, before = 0;
    for (std::size_t e = 0; e < volumes.size(); ++e)
      sum += volumes.position[e][0], before += volumes.restPosition[e][0];
    CHECK(before == Approx(1.5));
    const double top = sim.template at<"body">().state().position[31].z();
    CHECK(top > 1.8);
    return std::abs(sum - before);
  };
  const double soft = change(0), hard = change(1e6);
  CHECK(soft > 0.3);
  CHECK(hard < 0.003);
}

TEST_CASE("the centre of mass falls as a point, and carries a force to all") {
  RegistryScene sim{node<"root">(
      Gravity{{0, -10, 0}},
      EulerExplicitSolver{},
      node<"body">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {3, 0, 0}}},
                   DiagonalMass<Vec3d>{.vertexMass = {1, 2}},
                   StiffSpringForceField<Vec3d>{{{.first = 0, .second = 1, .stiffness = 10, .length = 1}}},
                   node<"center">(MechanicalObject<Vec3d>{},
                                  CenterOfMassMapping<Vec3d, Vec3d>{},
                                  ConstantForceField<Vec3d>{.indices = {0}, .forces = {{0, 36, 0}}})))};
  sim.init();
  auto const& center = sim.at<"body/center">().state();
  CHECK(center.position[0] == Eigen::Vector3d(2, 0, 0));
  for (int i = 0; i < 100; ++i) sim.animate(0.01);
  // a = -10 + 36 / 3, symplectic Euler: y = a h^2 n (n + 1) / 2
  CHECK((center.position[0] - Eigen::Vector3d(2, 2 * 0.5 * 1.01, 0)).norm() < 1e-12);
  CHECK((center.velocity[0] - Eigen::Vector3d(0, 2, 0)).norm() < 1e-12);
  CHECK(std::abs(sim.at<"body">().state().velocity[0].x()) > 0.01);
}

TEST_CASE("the centre of mass of rigid bodies, and with a consistent mass of a mesh") {
  const Mesh mesh = regular_grid_tetrahedra(2, 3, 3, {0, 0, 0}, {2, 2, 2});
  RegistryScene sim{node<"root">(
      EulerExplicitSolver{},
      node<"mesh">(TetrahedronTopology{mesh.tetrahedra},
                   MechanicalObject<Vec3d>{mesh.positions},
                   MeshMatrixMass<Vec3d>{.massDensity = {2}},
                   node<"center">(MechanicalObject<Vec3d>{}, CenterOfMassMapping<Vec3d, Vec3d>{})),
      node<"bodies">(
          MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{.center = {4, 0, 0}}, Rigid3d::Coord{}}},
          UniformMass<Rigid3d>{.totalMass = 6},
          node<"center">(MechanicalObject<Vec3d>{}, CenterOfMassMapping<Rigid3d, Vec3d>{})))};
  sim.init();
  CHECK((sim.at<"mesh/center">().state().position[0] - Eigen::Vector3d(1, 1, 1)).norm() < 1e-12);
  CHECK(sim.at<"bodies/center">().state().position[0] == Eigen::Vector3d(2, 0, 0));
}

TEST_CASE("a rigid body held by forces on its points: the stiffness of turning arms") {
  // a pendulum of one body, point r below the centre pulled down by f: its small swings have the stiffness r
  // f, all of which is geometric
  auto frequency = [](RotationalStiffness option) {
    RegistryScene sim{node<"root">(
        Gravity{{0, 0, 0}},
        NewmarkImplicitSolver{.gamma = 0.5, .beta = 0.25},
        CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
        MechanicalObject<Rigid3d>{.position = {Rigid3d::Coord{}}, .velocity = {{0, 0, 0, 0, 0, 0.001}}},
        UniformMass<Rigid3d>{},
        FixedRotationConstraint<Rigid3d>{.fixedXRotation = true, .fixedYRotation = true},
        PartialFixedConstraint<Rigid3d>{.indices = {0}, .fixedDirections = {1, 1, 1, 0, 0, 0}},
        node<"tip">(MechanicalObject<Vec3d>{{{0, -2, 0}}},
                    RigidMapping<Rigid3d, Vec3d>{.geometricStiffness = option},
                    ConstantForceField<Vec3d>{.indices = {0}, .forces = {{0, -8, 0}}}))};
    sim.init();
    // from one zero to the next
    double last = 0, time = 0;
    auto& tip = sim.template at<"tip">().state();
    for (int i = 0; i < 200; ++i) {
      sim.animate(0.02);
      const double x = tip.position[0].x();
      if (i > 5 && last > 0 && x <= 0) return time + 0.02 * last / (last - x);
      last = x, time = sim.time();
    }
    return 0.0;
  };
  // omega = 4 1/s, and the trapezoidal rule has tan(omega' h / 2) = omega h / 2, so that it is 0.05 % slower
  const double half = 3.14159265358979 / 4 * (1 + 0.08 * 0.08 / 12);
  CHECK(frequency(RotationalStiffness::symmetrized) == Approx(half).epsilon(1e-4));
  // without it the force of the end of the step is that of its start: too fast by as much as the other is
  // slow
  CHECK(std::abs(frequency(RotationalStiffness::none) - half) > 0.001);
}

TEST_CASE("bad input of mappings that measure is named") {
  auto with = [](auto mapping, MechanicalObject<Vec1d> child, MeshTopology topology) {
    return [=] {
      RegistryScene sim{node<"root">(
          EulerExplicitSolver{},
          node<"body">(
              MechanicalObject<Vec3d>{rest}, UniformMass<Vec3d>{}, node<"sub">(topology, child, mapping)))};
      sim.init();
    };
  };
  using Lengths = DistanceMapping<Vec3d, Vec1d>;
  using Volumes = VolumeMapping<Vec3d, Vec1d>;
  CHECK(error_of(with(Lengths{}, {}, {.edges = edges})).empty());
  says(with(Lengths{}, {}, {}),
       {"/root/body/sub", "DistanceMapping<Vec3d, Vec1d>", "no edges", "add a topology"});
  says(with(Lengths{.restLengths = {1, 2}}, {}, {.edges = edges}), {"restLengths has 2 entries for 8 edges"});
  says(with(Lengths{.restLengths = {-1}}, {}, {.edges = edges}), {"restLengths[0] is -1", "at least 0"});
  says(with(Lengths{.restLengths = {one::notANumber}}, {}, {.edges = edges}), {"restLengths[0] is nan"});
  says(with(Lengths{}, {}, {.edges = {{0, 9}}}), {"edge 0 refers to point 9", "5 points"});
  says(with(Lengths{}, {.position = {Vec1d::zero()}}, {.edges = edges}), {"1 points for 8 edges"});
  says(with(Volumes{}, {}, {}), {"no tetrahedra"});
  says(with(Volumes{}, {}, {.tetrahedra = {{0, 1, 2, 7}}}), {"tetrahedron 0 refers to point 7"});
  says(with(Volumes{}, {.position = {Vec1d::zero(), Vec1d::zero()}}, {.tetrahedra = {{0, 1, 2, 3}}}),
       {"2 points for 1 tetrahedra"});
  auto center = [](MechanicalObject<Vec3d> child) {
    RegistryScene sim{node<"root">(EulerExplicitSolver{},
                                   MechanicalObject<Vec3d>{rest},
                                   node<"sub">(child, CenterOfMassMapping<Vec3d, Vec3d>{}))};
    sim.init();
  };
  says([&] { center({}); }, {"/root/sub", "no mass in the node /root"});
}

namespace {

// numbers that a mapping measures of some points
template <class M>
std::vector<double> measured(M mapping, typename M::In::VecCoord const& x,
                             TopologyView const& topology = {}) {
  typename M::Out::VecCoord child;
  mapping.init({"body", x, topology}, {"child", child, {}}, child);
  mapping.apply(child, x);
  std::vector<double> values;
  for (auto const& value : child) values.push_back(value[0]);
  return values;
}
template <class M>
void refuses(M mapping, std::initializer_list<std::string_view> words, TopologyView const& topology = {}) {
  says([&] { measured(mapping, points, topology); }, words);
}

}  // namespace

TEST_CASE("areas, squares, and distances from places and planes") {
  const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 0}, {0, 1, 1}};
  const Vec3d::VecCoord x{{1, 1, 1}, {4, 1, 1}, {1, 5, 1}};
  const auto areas = measured(AreaMapping<Vec3d, Vec1d>{}, x, {.triangles = triangles});
  CHECK(areas == std::vector<double>{6, 6, 0});
  const std::vector<Edge> sides{{0, 1}, {1, 2}};
  CHECK(measured(SquareDistanceMapping<Vec3d, Vec1d>{}, x, {.edges = sides}) == std::vector<double>{9, 25});
  CHECK(measured(
            DistanceFromTargetMapping<Vec3d, Vec1d>{
                .indices = {2}, .targetPositions = {{1, 1, 1}, {4, 1, 5}}, .restLengths = {1}},
            x) == std::vector<double>{3, 4});
  CHECK(measured(DistanceToPlaneMapping<Vec3d, Vec1d>{.planeNormal = {0, 2, 0}, .planePoint = {7, 3, 7}},
                 x) == std::vector<double>{-2, -2, 2});
  CHECK(measured(SquareMapping<Vec1d, Vec1d>{}, {Vec1d::Coord(3), Vec1d::Coord(-2)}) ==
        std::vector<double>{9, 4});
}

TEST_CASE("what is measured of nothing is told") {
  refuses(AreaMapping<Vec3d, Vec1d>{}, {"child: AreaMapping<Vec3d, Vec1d>", "there are no triangles"});
  const std::vector<Triangle> triangles{{0, 1, 5}};
  refuses(AreaMapping<Vec3d, Vec1d>{}, {"triangle 0"}, {.triangles = triangles});
  refuses(SquareDistanceMapping<Vec3d, Vec1d>{}, {"there are no edges"});
  refuses(DistanceFromTargetMapping<Vec3d, Vec1d>{}, {"there is no target"});
  refuses(DistanceFromTargetMapping<Vec3d, Vec1d>{.indices = {5}, .targetPositions = {{0, 0, 0}}},
          {"indices has 5", "5 points"});
  refuses(DistanceFromTargetMapping<Vec3d, Vec1d>{.indices = {0, 1}, .targetPositions = {{0, 0, 0}}},
          {"2 indices and 0 restLengths for 1 targetPositions"});
  refuses(DistanceToPlaneMapping<Vec3d, Vec1d>{}, {"planeNormal is zero"});
}

// m x'' = -2 k x (x^2 - q): about x = sqrt(q) with the frequency sqrt(4 k q / m)
TEST_CASE("a number that is held by its square swings about the root") {
  const double k = 3, q = 4, m = 0.5, small = 1e-3;
  Vec1d::VecCoord child;
  SquareMapping<Vec1d, Vec1d> square;
  Vec1d::VecCoord x{Vec1d::Coord(std::sqrt(q) + small)};
  square.init({"body", x, {}}, {"child", child, {}}, child);
  Vec1d::VecDeriv v{Vec1d::Deriv(0)}, force(1), up(1);
  const double period = 2 * std::acos(-1.) / std::sqrt(4 * k * q / m);
  const int steps = 4000;
  const double h = period / steps;
  for (int i = 0; i < steps; ++i) {  // velocity Verlet
    auto accelerate = [&](double dt) {
      square.apply(child, x);
      up[0][0] = -k * (child[0][0] - q);
      force[0][0] = 0;
      square.applyJT(force, up);
      v[0][0] += dt * force[0][0] / m;
    };
    accelerate(h / 2);
    x[0][0] += h * v[0][0];
    accelerate(h / 2);
  }
  // back where it was, but for the anharmonic part of the period, of the order small^2
  CHECK(x[0][0] - std::sqrt(q) == Approx(small).epsilon(1e-4));
}

// held at the height 0.2 where it starts from, and pulled to the plane y = 0 by springs of the mapped heights
TEST_CASE("springs of what is measured pull to the rest positions that are given") {
  auto scene = [](Vec1d::VecCoord given) {
    return RegistryScene{node<"root">(
        EulerImplicitSolver{},
        CGLinearSolver<>{.iterations = 20, .tolerance = 1e-12},
        node<"body">(MechanicalObject<Vec3d>{.position = {{1, 0.2, 3}}},
                     UniformMass<Vec3d>{.totalMass = 2},
                     node<"height">(MechanicalObject<Vec1d>{.restPosition = given},
                                    DistanceToPlaneMapping<Vec3d, Vec1d>{.planeNormal = {0, 1, 0}},
                                    RestShapeSpringsForceField<Vec1d>{.stiffness = {10}})))};
  };
  auto still = scene({}), pulled = scene({Vec1d::Coord(0)});
  for (auto* sim : {&still, &pulled}) {
    sim->init();
    sim->init();  // again from what was given
    // implicit Euler damps the swings, of 2.2 rad/s, to 2/3 a step
    for (int i = 0; i < 100; ++i) sim->animate(0.5);
  }
  CHECK(still.at<"body">().state().position[0][1] == Approx(0.2));
  CHECK(pulled.at<"body">().state().position[0][1] == Approx(0).margin(1e-6));
}

}  // namespace test_measuring_mappings
