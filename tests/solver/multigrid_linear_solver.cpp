// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "solver/fem_bar.hpp"

#include <sinew/control/threads.hpp>
#include <sinew/solver/multigrid_linear_solver.hpp>
#include <sinew/solver/pcg_linear_solver.hpp>

#include <cstring>
#include <limits>

namespace test_multigrid_linear_solver {

using namespace sinew;

namespace {

using Scalars = CompressedRowSparseMatrixd;

/// To rounding, with several levels also where there are few points.
template <class Matrix = CompressedRowSparseMatrixMat3x3d>
MultigridLinearSolver<Matrix> exact(int coarsestSize = 30) {
  return {.iterations = 300, .tolerance = 1e-12, .coarsestSize = coarsestSize};
}

template <class Solver, class Sim>
Solver& solver_of(Sim& sim) {
  return sim.root().template get<Solver>();
}

enum class Stiff { even, halves, layers, core, random };

struct Beam {
  int cells = 6;
  double young = 1e7, poisson = 0.3;
  Stiff stiff = Stiff::even;
  bool held = true;
};

/// Iterations of the third step of a beam, four times as long as wide, with implicit Euler; parts of it are
/// 10,000 times as stiff as others.
int iterations(Beam const& beam, MultigridLinearSolver<> linear = {}) {
  const int n = beam.cells;
  const Mesh mesh = regular_grid_tetrahedra(4 * n + 1, n + 1, n + 1, {0, 0, 0}, {4, 1, 1});
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (beam.held && mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
  std::vector<double> young;
  std::uint32_t seed = 1;
  for (auto const& t : mesh.tetrahedra) {
    Eigen::Vector3d const& x = mesh.positions[std::size_t(t[0])];
    seed = seed * 1664525u + 1013904223u;
    const bool more = beam.stiff == Stiff::halves   ? x[0] > 2
                      : beam.stiff == Stiff::layers ? int(4 * x[0]) % 2 == 0
                      : beam.stiff == Stiff::core ? std::abs(x[1] - 0.5) < 0.26 && std::abs(x[2] - 0.5) < 0.26
                                                  : beam.stiff == Stiff::random && seed >> 31;
    young.push_back(more ? 1e4 * beam.young : beam.young);
  }
  Simulation sim{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                   linear,
                   TetrahedronTopology{mesh.tetrahedra},
                   MechanicalObject<Vec3d>{mesh.positions},
                   DiagonalMass<Vec3d>{.massDensity = 1000},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = young, .poissonRatio = beam.poisson},
                   FixedConstraint<Vec3d>{.indices = fixed})};
  sim.init();
  for (int i = 0; i < 3; ++i) sim.animate(0.02);
  auto const& residuals = solver_of<MultigridLinearSolver<>>(sim).residuals;
  CHECK(residuals.back() <= 1e-6);
  return int(residuals.size()) - 1;
}

template <class Linear>
Eigen::VectorXd bar(Linear linear, bool held = true, bool graded = false) {
  auto sim = fem_bar::simulation(linear, 8, held, graded);
  return fem_bar::velocities(sim);
}

/// A chain of beams, a net in a plane, points of one and six coordinates, a body on rigid ones, and what
/// joins two bodies, in one system.
template <class Linear>
auto joints(Linear linear) {
  std::vector<Eigen::Vector3d> wire;
  std::vector<Eigen::Vector2d> net;
  StiffSpringForceField<Vec3d> links;
  StiffSpringForceField<Vec2d> threads;
  for (int i = 0; i < 40; ++i) wire.push_back({0.1 * i, 0.01 * (i % 2), 0});
  for (int i = 0; i + 1 < 40; ++i) {
    links.springs.push_back({.first = i, .second = i + 1, .stiffness = 1e4, .length = 0.1});
    if (i + 2 < 40) links.springs.push_back({.first = i, .second = i + 2, .stiffness = 1e3, .length = 0.2});
  }
  for (int i = 0; i < 36; ++i) net.push_back({double(i % 6), double(i / 6)});
  for (int i = 0; i < 36; ++i) {
    if (i % 6 < 5) threads.springs.push_back({.first = i, .second = i + 1, .stiffness = 500, .length = 0.9});
    if (i < 30) threads.springs.push_back({.first = i, .second = i + 6, .stiffness = 500, .length = 0.9});
  }
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{},
      linear,
      AttachProjectiveConstraint<Vec3d, Between<"wire", "body">>{
          .indices1 = {39}, .indices2 = {0}, .twoWay = true},
      node<"wire">(MechanicalObject<Vec3d>{wire},
                   UniformMass<Vec3d>{.vertexMass = 0.1},
                   links,
                   FixedConstraint<Vec3d>{.indices = {0}},
                   PartialFixedConstraint<Vec3d>{.indices = {5, 6}, .fixedDirections = {false, false, true}}),
      node<"body">(
          TetrahedronTopology{mesh.tetrahedra},
          MechanicalObject<Vec3d>{mesh.positions},
          UniformMass<Vec3d>{.totalMass = 3},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {1e5}, .poissonRatio = 0.3},
          ProjectToPlaneConstraint<Vec3d>{.indices = {20, 21}, .origin = {1, 1, 0}, .normal = {1, 1, 0}}),
      node<"net">(MechanicalObject<Vec2d>{net}, UniformMass<Vec2d>{.vertexMass = 0.1}, threads),
      node<"row">(MechanicalObject<Vec1d>{.position = Vec1d::VecCoord(7)},
                  UniformMass<Vec1d>{.vertexMass = 1},
                  RestShapeSpringsForceField<Vec1d>{}),
      node<"tool">(MechanicalObject<Rigid3d>{.position = {{{0, 0, 0}}, {{1, 0, 0}}, {{2, 0, 0}}}},
                   UniformMass<Rigid3d>{},
                   node<"skin">(MechanicalObject<Vec3d>{.position = {{0.3, 0.2, 0}, {1.1, -0.2, 0.3}}},
                                RigidMapping<Rigid3d, Vec3d>{.rigidIndices = {0, 2}},
                                StiffSpringForceField<Vec3d>{
                                    {{.first = 0, .second = 1, .stiffness = 300, .length = 1}}})))};
}

}  // namespace

TEST_CASE("multigrid finds what a factor finds") {
  for (const bool held : {true, false}) {
    const Eigen::VectorXd ldl = bar(SparseLDLSolver<>{}, held);
    INFO("held: " << held);
    CHECK((bar(exact(), held) - ldl).norm() < 1e-9 * ldl.norm());
    CHECK((bar(exact<Scalars>(), held) - ldl).norm() < 1e-9 * ldl.norm());
    CHECK((bar(exact(100000), held) - ldl).norm() < 1e-9 * ldl.norm());  // one level, by its factor
  }
  const Eigen::VectorXd graded = bar(SparseLDLSolver<>{}, true, true);
  CHECK((bar(exact(), true, true) - graded).norm() < 1e-8 * graded.norm());
  // of float only the cycle could do with: the system is double, or as its matrix says
  const Eigen::VectorXd floats =
      bar(MultigridLinearSolver<CompressedRowSparseMatrixMat3x3f>{.tolerance = 1e-5});
  CHECK((floats - bar(SparseLDLSolver<>{})).norm() < 1e-3 * floats.norm());
}

TEST_CASE("states of all kinds, mappings and constraints are in one system") {
  auto all = [](auto linear) {
    auto sim = joints(linear);
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(0.01);
    std::vector<double> v;
    auto add = [&](auto const& list) {
      for (auto const& x : list) v.insert(v.end(), x.data(), x.data() + x.size());
    };
    add(sim.template at<"wire">().state().velocity);
    add(sim.template at<"body">().state().velocity);
    add(sim.template at<"net">().state().velocity);
    add(sim.template at<"row">().state().velocity);
    add(sim.template at<"tool">().state().velocity);
    return Eigen::VectorXd(Eigen::Map<Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  const Eigen::VectorXd ldl = all(SparseLDLSolver<Scalars>{});
  REQUIRE(ldl.norm() > 0.1);
  CHECK((all(exact<Scalars>()) - ldl).norm() < 1e-8 * ldl.norm());
  CHECK((all(exact()) - ldl).norm() < 1e-8 * ldl.norm());
}

TEST_CASE("iterations hardly grow with the points, nor with stiffness that jumps", "[long]") {
  // each eight times as many tetrahedra
  const int small = iterations({.cells = 3}), medium = iterations({.cells = 6}),
            large = iterations({.cells = 12});
  INFO(small << ", " << medium << ", " << large);
  CHECK(large <= 16);
  CHECK(large <= small + 6);
  CHECK(iterations({.young = 1e3}) <= 5);
  CHECK(iterations({.young = 1e12}) <= 20);
  CHECK(iterations({.young = 1e12, .held = false}) <= 20);
  for (const Stiff stiff : {Stiff::halves, Stiff::layers, Stiff::core})
    CHECK(iterations({.young = 1e5, .stiff = stiff}) <= 16);
  CHECK(iterations({.young = 1e5, .stiff = Stiff::random}) <= 24);
  // volume nearly kept: more of the smoother, and coarse levels solved better
  for (const int cells : {6, 12})
    CHECK(iterations({.cells = cells, .poisson = 0.49}, {.smootherDegree = 6, .coarseCycles = 2}) <= 20);
  CHECK(iterations({.poisson = 0.49}) <= 40);
}

TEST_CASE("a static solver and Newton's method find their equilibrium") {
  auto rest = [](auto linear) {
    const Mesh mesh = regular_grid_tetrahedra(9, 3, 3, {0, 0, 0}, {4, 1, 1});
    std::vector<int> fixed;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (mesh.positions[i][0] < 1e-9) fixed.push_back(int(i));
    Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                                StaticSolver{.maxNbIterationsNewton = 30},
                                linear,
                                TetrahedronTopology{mesh.tetrahedra},
                                MechanicalObject<Vec3d>{mesh.positions},
                                DiagonalMass<Vec3d>{.massDensity = 1000},
                                TetrahedronFEMForceField<Vec3d>{.youngModulus = {2e6}, .poissonRatio = 0.4},
                                FixedConstraint<Vec3d>{.indices = fixed})};
    sim.init();
    sim.animate(1);
    CHECK(sim.root().template first<role::OdeSolver>().newton.converged());
    return Eigen::VectorXd(vec::flat(sim.root().state().position));
  };
  const Eigen::VectorXd ldl = rest(SparseLDLSolver<>{});
  CHECK((rest(exact()) - ldl).norm() < 1e-6 * ldl.norm());
}

TEST_CASE("conjugate gradients take multigrid as a preconditioner") {
  auto solve = [](auto linear, bool held) {
    auto sim = fem_bar::simulation(linear, 16, held);
    const Eigen::VectorXd v = fem_bar::velocities(sim);
    CHECK(sim.root().template get<decltype(linear)>().residuals.size() < 25);
    return v;
  };
  using enum PreconditionerMethod;
  ShewchukPCGLinearSolver<CompressedRowSparseMatrixMat3x3d> assembled{
      .iterations = 100, .tolerance = 1e-10, .precondition = multigrid, .coarsestSize = 60};
  ShewchukPCGLinearSolver<> free{.iterations = 100,
                                 .tolerance = 1e-10,
                                 .updateStep = 2,
                                 .precondition = multigrid,
                                 .warp = true,
                                 .coarsestSize = 60};
  for (const bool held : {true, false}) {
    const Eigen::VectorXd one = solve(exact(), held);
    CHECK((solve(assembled, held) - one).norm() < 1e-7 * one.norm());
    CHECK((solve(free, held) - one).norm() < 1e-7 * one.norm());
  }
}

TEST_CASE("a cycle that is kept serves a body that turns") {
  auto steps = [](MultigridLinearSolver<> linear) {
    auto sim = fem_bar::simulation(linear, 16);
    int sum = 0;
    for (int i = 0; i < 60; ++i) {
      sim.animate(0.02);
      sum += int(solver_of<MultigridLinearSolver<>>(sim).residuals.size()) - 1;
    }
    return std::pair{sum, sim.root().state().position.back()};
  };
  const auto [always, x0] = steps({.tolerance = 1e-9, .coarsestSize = 50});
  const auto [kept, x1] = steps({.tolerance = 1e-9, .refresh = 10, .warp = true, .coarsestSize = 50});
  const auto [once, x2] = steps({.iterations = 500, .tolerance = 1e-9, .refresh = 0, .coarsestSize = 50});
  INFO("always " << always << ", in each tenth step " << kept << ", once " << once);
  CHECK(x0[1] < -5);  // it hangs down, of a length of 8
  CHECK((x1 - x0).norm() < 1e-5);
  CHECK((x2 - x0).norm() < 1e-5);
  CHECK(2 * kept < 3 * always);
  CHECK(kept < once);
}

TEST_CASE("multigrid has the same bits with any number of threads", "[threads]") {
  auto bits = [](int threads) {
    const Mesh mesh = regular_grid_tetrahedra(13, 13, 20, {0, 0, 0}, {1, 1.1, 2});
    Simulation sim{node<"root">(Threads{.count = threads},
                                Gravity{},
                                EulerImplicitSolver{.rayleighStiffness = 0.01},
                                MultigridLinearSolver<>{},
                                TetrahedronTopology{mesh.tetrahedra},
                                MechanicalObject<Vec3d>{mesh.positions},
                                UniformMass<Vec3d>{.totalMass = 1},
                                TetrahedronFEMForceField<Vec3d>{},
                                FixedConstraint<Vec3d>{.indices = {0, 1, 14}})};
    sim.init();
    for (int i = 0; i < 2; ++i) sim.animate(0.01);
    auto const& v = sim.root().state().velocity;
    std::vector<unsigned char> all(v.size() * sizeof v[0]);
    std::memcpy(all.data(), v.data(), all.size());
    CHECK(solver_of<MultigridLinearSolver<>>(sim).residuals.back() <= 1e-6);
    return all;
  };
  const auto one = bits(1);
  CHECK(bits(2) == one);
  CHECK(bits(5) == one);
}

TEST_CASE("the smallest systems are solved by their factor") {
  // a point of one coordinate on a spring: (m + h^2 k) dv = h f
  Simulation one{node<"root">(EulerImplicitSolver{},
                              MultigridLinearSolver<Scalars>{},
                              MechanicalObject<Vec1d>{.position = {Vec1d::Coord(1)}},
                              UniformMass<Vec1d>{.vertexMass = 2},
                              RestShapeSpringsForceField<Vec1d>{.stiffness = {100}},
                              ConstantForceField<Vec1d>{.indices = {0}, .force = Vec1d::Deriv(3)})};
  one.init();
  one.animate(0.1);
  CHECK(one.root().state().velocity[0][0] == Approx(0.1 * 3 / (2 + 0.01 * 100)).epsilon(1e-6));
  // a body of one element
  auto tetrahedron = [](auto linear) {
    Simulation sim{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{},
                     linear,
                     TetrahedronTopology{.tetrahedra = {{0, 1, 2, 3}}},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                     DiagonalMass<Vec3d>{.massDensity = 1},
                     TetrahedronFEMForceField<Vec3d>{},
                     FixedConstraint<Vec3d>{.indices = {0}})};
    sim.init();
    sim.animate(0.01);
    return Eigen::VectorXd(vec::flat(sim.root().state().velocity));
  };
  const Eigen::VectorXd ldl = tetrahedron(SparseLDLSolver<>{});
  for (const int size : {1, 200}) CHECK((tetrahedron(exact(size)) - ldl).norm() < 1e-9 * ldl.norm());
}

TEST_CASE("points that nothing joins, and all points held, are solved") {
  Simulation apart{node<"root">(Gravity{{0, -10, 0}},
                                EulerImplicitSolver{},
                                MultigridLinearSolver<>{.coarsestSize = 1},
                                MechanicalObject<Vec3d>{.position = Vec3d::VecCoord(100, {0, 1, 0})},
                                UniformMass<Vec3d>{.vertexMass = 3})};
  apart.init();
  apart.animate(0.01);
  for (auto const& v : apart.root().state().velocity) CHECK(v[1] == Approx(-0.1).epsilon(1e-6));
  auto held = fem_bar::simulation(MultigridLinearSolver<>{.coarsestSize = 1}, 2, false);
  auto& solver = solver_of<MultigridLinearSolver<>>(held);
  solver.residuals.clear();
  held.animate(0.01);
  CHECK(std::isfinite(held.root().state().velocity[0][1]));
}

TEST_CASE("what is not finite does not hang, and is told") {
  auto sim = fem_bar::simulation(MultigridLinearSolver<>{.coarsestSize = 30});
  sim.animate(0.02);
  sim.root().state().velocity[20][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_of([&] { sim.animate(0.02); }).find("not a finite number") != std::string::npos);
}

TEST_CASE("settings of multigrid have ranges") {
  auto said = [](MultigridLinearSolver<> linear) { return error_of([&] { fem_bar::simulation(linear); }); };
  CHECK(said({.levels = 0}).find("levels") != std::string::npos);
  CHECK(said({.coarsestSize = 0}).find("coarsestSize") != std::string::npos);
  CHECK(said({.strengthThreshold = 1.5}).find("strengthThreshold") != std::string::npos);
  CHECK(said({.smootherDegree = 0}).find("smootherDegree") != std::string::npos);
  CHECK(said({.coarseCycles = 0}).find("coarseCycles") != std::string::npos);
  CHECK(said({.refresh = -1}).find("refresh") != std::string::npos);
}

}  // namespace test_multigrid_linear_solver
