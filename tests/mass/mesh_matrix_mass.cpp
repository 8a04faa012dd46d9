// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "quadratic_mesh.hpp"

#include <sinew/mass/mesh_matrix_mass.hpp>
#include <sinew/sinew.hpp>
#include <sinew/solver/newmark_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace test_mesh_matrix_mass {

using namespace sinew;

namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A box [0,2] x [0,1] x [0,1], or its side z = 0, or its edge along x, in elements that are shaken inside.
struct Box {
  Points x;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Hexahedron> hexahedra;
  TopologyView view() const {
    return {.edges = edges,
            .triangles = triangles,
            .quads = quads,
            .tetrahedra = tetrahedra,
            .hexahedra = hexahedra};
  }
};
/// `kind`: the number of corners of the elements, 4 for quads and -4 for tetrahedra.
Box box(int kind) {
  const int n = 4;
  Box b;
  const int ny = kind == 2 ? 1 : n, nz = kind == 8 || kind == -4 ? n : 1;
  auto at = [&](int i, int j, int k) { return i + n * (j + ny * k); };
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < n; ++i) {
        Eigen::Vector3d p(2.0 * i / (n - 1), double(j) / (n - 1), double(k) / (n - 1));
        auto shake = [&](int c, int index, int size, double phase) {
          if (size > 1 && index > 0 && index + 1 < size) p[c] += 0.06 * std::sin(phase);
        };
        shake(0, i, n, i + 2.0 * j + 3 * k);
        shake(1, j, ny, 5.0 * i + j + k);
        shake(2, k, nz, i + 7.0 * j + k);
        b.x.push_back(p);
      }
  for (int k = 0; k < std::max(1, nz - 1); ++k)
    for (int j = 0; j < std::max(1, ny - 1); ++j)
      for (int i = 0; i + 1 < n; ++i) {
        if (kind == 2) b.edges.push_back({at(i, 0, 0), at(i + 1, 0, 0)});
        const Quad q{at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)};
        if (kind == 4) b.quads.push_back(q);
        if (kind == 3) b.triangles.insert(b.triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
        if (kind == 8 || kind == -4)
          b.hexahedra.push_back({q[0],
                                 q[1],
                                 q[2],
                                 q[3],
                                 at(i, j, k + 1),
                                 at(i + 1, j, k + 1),
                                 at(i + 1, j + 1, k + 1),
                                 at(i, j + 1, k + 1)});
      }
  if (kind == -4) {
    b.tetrahedra = hexahedra_to_tetrahedra(b.hexahedra);
    b.hexahedra.clear();
  }
  return b;
}
/// A topology of this test's own: n edges one after the other.
struct EdgeChain {
  using Role = role::Topology;
  static constexpr std::string_view className = "EdgeChain";
  static constexpr auto fields() { return field_list(); }
  int n;
  std::vector<Edge> edges{};
  template <class D>
  void init(InitContext<D> const&) {
    for (int i = 0; i < n; ++i) edges.push_back({i, i + 1});
  }
  TopologyView view() const { return {.edges = edges}; }
};

const int kinds[] = {2, 3, 4, -4, 8};

MeshMatrixMass<Vec3d> made(Box const& b, MeshMatrixMass<Vec3d> mass = {.massDensity = {3}}) {
  mass.init(InitContext<Vec3d>{"box", b.x, b.view()});
  return mass;
}
/// Integral of g h over the box, for linear g and h given by their values at the points.
double integral(MeshMatrixMass<Vec3d> const& mass, Points const& g, Points const& h) {
  Points m(g.size(), Eigen::Vector3d::Zero());
  mass.addMDx(m, g, h, 1);
  return vec::dot(g, m);
}
template <class F>
Points field_of(Box const& b, F&& f) {
  Points g;
  for (auto const& p : b.x) g.push_back(f(p));
  return g;
}

}  // namespace

TEST_CASE("the total mass is density times volume, area or length") {
  for (const int kind : kinds) {
    const Box b = box(kind);
    const Points one = field_of(b, [](auto const&) { return Eigen::Vector3d(1, 0, 0); });
    for (const bool lumping : {false, true}) {
      // 3 kg a unit on a box of 2 x 1 x 1; shaken grids fill it all the same, since their outside is not
      // shaken but along itself
      CHECK(integral(made(b, {.massDensity = {3}, .lumping = lumping}), one, one) ==
            Approx(6).epsilon(1e-13));
      CHECK(integral(made(b, {.totalMass = 7, .lumping = lumping}), one, one) == Approx(7).epsilon(1e-13));
      CHECK(integral(made(b, {.lumping = lumping}), one, one) == Approx(1).epsilon(1e-13));
    }
  }
}

TEST_CASE("elements of one kind may have the mass alone") {
  auto total = [](Box const& b, MassElements kind) {
    const Points one = field_of(b, [](auto const&) { return Eigen::Vector3d(1, 0, 0); });
    return integral(made(b, {.massDensity = {1}, .elements = kind}), one, one);
  };
  // the same points with elements of two kinds
  Box volume = box(8);
  volume.tetrahedra = box(-4).tetrahedra;
  volume.edges = {{0, 1}};
  CHECK(total(volume, MassElements::hexahedra) == Approx(2).epsilon(1e-13));
  CHECK(total(volume, MassElements::tetrahedra) == Approx(2).epsilon(1e-12));
  CHECK(total(volume, MassElements::highest) == Approx(4).epsilon(1e-12));
  Box surface = box(4);
  surface.triangles = box(3).triangles;
  CHECK(total(surface, MassElements::quads) == Approx(2).epsilon(1e-13));
  CHECK(total(surface, MassElements::triangles) == Approx(2).epsilon(1e-13));
  CHECK(total(surface, MassElements::highest) == Approx(4).epsilon(1e-13));
  CHECK(total(box(2), MassElements::edges) == Approx(2).epsilon(1e-13));
  CHECK_THROWS_WITH(made(volume, {.elements = MassElements::quads}),
                    Catch::Contains("the mass is that of quads"));
  // points that no element of the kind has would have no mass
  CHECK_THROWS_AS(made(volume, {.elements = MassElements::edges}), Error);
}

// Of a prism A h: rho A h (1 + delta_ab)(1 + delta_tu)/72 for corners a, b of the triangle and its sides t,
// u. Of a pyramid with a parallelogram as base: rho V times 1/15, 1/30 along a side of the base, 1/60 across
// it, 3/80 with the apex, and 1/10 of that.
TEST_CASE("prisms and pyramids have the masses of their shape functions") {
  const double rho = 3;
  auto matrix = [&](Box const& b, TopologyView const& view, MassElements kind) {
    MeshMatrixMass<Vec3d> mass{.massDensity = {rho}, .elements = kind};
    mass.init(InitContext<Vec3d>{"element", b.x, view});
    const auto n = Eigen::Index(b.x.size());
    Eigen::MatrixXd m(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
      Points unit(b.x.size(), Eigen::Vector3d::Zero()), product = unit;
      unit[std::size_t(j)][0] = 1;
      mass.addMDx(product, unit, unit, 1);
      for (Eigen::Index i = 0; i < n; ++i) m(i, j) = product[std::size_t(i)][0];
    }
    return m;
  };
  Box prism;
  prism.x = {{0, 0, 0}, {2, 0, 0}, {0.5, 1.5, 0}, {0, 0.3, 4}, {2, 0.3, 4}, {0.5, 1.8, 4}};
  const std::vector<Prism> prisms{{0, 1, 2, 3, 4, 5}};
  for (const MassElements kind : {MassElements::highest, MassElements::prisms}) {
    const Eigen::MatrixXd m = matrix(prism, {.prisms = prisms}, kind);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const int same = (i % 3 == j % 3 ? 2 : 1) * (i / 3 == j / 3 ? 2 : 1);
        CHECK(m(i, j) == Approx(rho * 1.5 * 4 * same / 72).epsilon(1e-13));
      }
  }
  Box pyramid;
  pyramid.x = {{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0.5, 1, 0}, {3, 4, 3}};
  const std::vector<Pyramid> pyramids{{0, 1, 2, 3, 4}};
  const double whole = rho * 2;  // 2 x 1 x 3 / 3
  for (const MassElements kind : {MassElements::highest, MassElements::pyramids}) {
    const Eigen::MatrixXd m = matrix(pyramid, {.pyramids = pyramids}, kind);
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 5; ++j) {
        const int around = std::abs(i - j) % 2 == 1 ? 30 : i == j ? 15 : 60;
        const double part = i == 4 && j == 4 ? 0.1 : i == 4 || j == 4 ? 3. / 80 : 1. / around;
        CHECK(m(i, j) == Approx(whole * part).epsilon(1e-13));
      }
  }
  CHECK_THROWS_WITH(matrix(prism, {.prisms = prisms}, MassElements::pyramids),
                    Catch::Contains("the mass is that of pyramids"));
}

// A straight tetrahedron of ten nodes (Zienkiewicz & Taylor): in rho V/420, 6 at a corner, 1 between two, -4
// and -6 between a corner and an edge with it or without, 32 at an edge, 16 and 8 between edges with a common
// corner or without.
TEST_CASE("elements of second order have the masses of their shape functions") {
  const Mesh t = one::quadratic<QuadraticTetrahedron>(
      {.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, .tetrahedra = {{0, 1, 2, 3}}});
  MeshMatrixMass<Vec3d> mass{.massDensity = {420}};
  mass.init(InitContext<Vec3d>{"element", t.positions, {.quadraticTetrahedra = t.quadraticTetrahedra}});
  auto cornersOf = [](int i) {
    if (i < 4) return std::vector<std::size_t>{std::size_t(i)};
    auto const& edge = sinew::detail::quadraticTetrahedronEdges[std::size_t(i) - 4];
    return std::vector{edge[0], edge[1]};
  };
  for (int j = 0; j < 10; ++j) {
    Points unit(10, Eigen::Vector3d::Zero()), product = unit;
    unit[std::size_t(j)][0] = 1;
    mass.addMDx(product, unit, unit, 1);
    for (int i = 0; i < 10; ++i) {
      int common = 0;
      for (const std::size_t a : cornersOf(i))
        for (const std::size_t b : cornersOf(j)) common += a == b;
      const double expected = i < 4 && j < 4   ? (i == j ? 6 : 1)
                              : i < 4 || j < 4 ? (common ? -4 : -6)
                                               : (common == 2   ? 32
                                                  : common == 1 ? 16
                                                                : 8);
      CHECK(product[std::size_t(i)][0] == Approx(expected).epsilon(1e-12));
    }
  }
  // the weight is the row sum, -V/20 at corners and V/5 between them, and lumped the whole mass is positive
  Points weight(10, Eigen::Vector3d::Zero());
  MechanicalParams gravity;
  gravity.gravity = {0, 0, 1};
  mass.addForce(gravity, weight, t.positions, weight);
  for (std::size_t i = 0; i < 10; ++i) CHECK(weight[i][2] == Approx(i < 4 ? -21 : 84).epsilon(1e-12));
  Points a = weight;
  CHECK_THROWS_WITH(mass.accFromF(a, t.positions, weight), Catch::Contains("set lumping"));
  mass.lumping = true;
  mass.init(InitContext<Vec3d>{"element", t.positions, {.quadraticTetrahedra = t.quadraticTetrahedra}});
  for (std::size_t i = 0; i < 10; ++i)
    CHECK(mass.lumped.at(i) == Approx(i < 4 ? 6 * 420 / 216. : 32 * 420 / 216.).epsilon(1e-12));
  mass.accFromF(a, t.positions, weight);
  CHECK(a[0][2] == Approx(-21 / (6 * 420 / 216.)));
}

// integral of rho x^2 over a box, which fields of degree two have exactly; also where its edges are curved
// inside
TEST_CASE("products of quadratic elements are integrated exactly, and what they are lumped to is the mass") {
  auto check = [](auto element) {
    using Element = decltype(element);
    Mesh mesh = one::quadratic_box<Element>(2, 2, 1, {0, 0, 0}, {2, 1, 1});
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (auto& p = mesh.positions[i]; p[0] > 0.1 && p[0] < 1.9)
        p[0] += 0.1 * std::sin(3.0 * double(i));  // along the box: it stays one
    for (const MassElements kind : {MassElements::highest,
                                    std::tuple_size_v<Element> == 10   ? MassElements::quadraticTetrahedra
                                    : std::tuple_size_v<Element> == 20 ? MassElements::quadraticHexahedra
                                                                       : MassElements::triquadraticHexahedra})
      for (const bool lumping : {false, true}) {
        MeshMatrixMass<Vec3d> mass{.massDensity = {3}, .lumping = lumping, .elements = kind};
        mass.init(InitContext<Vec3d>{"body",
                                     mesh.positions,
                                     {.quadraticTetrahedra = mesh.quadraticTetrahedra,
                                      .quadraticHexahedra = mesh.quadraticHexahedra,
                                      .triquadraticHexahedra = mesh.triquadraticHexahedra}});
        Points x, one(mesh.positions.size(), Eigen::Vector3d(1, 0, 0));
        for (auto const& p : mesh.positions) x.emplace_back(p[0], 0, 0);
        CHECK(mass.kineticEnergy(x, one) == Approx(3 * 2 / 2.).epsilon(1e-12));
        if (!lumping) CHECK(mass.kineticEnergy(x, x) == Approx(3 * 8. / 3 / 2).epsilon(1e-12));
        for (std::size_t i = 0; i < x.size(); ++i) CHECK(mass.lumped.at(i) > 0);
      }
  };
  check(QuadraticTetrahedron{}), check(QuadraticHexahedron{}), check(TriquadraticHexahedron{});
}

TEST_CASE("products of linear fields are integrated exactly") {
  for (const int kind : kinds) {
    INFO("kind " << kind);
    const Box b = box(kind);
    const auto mass = made(b);
    const bool wide = kind != 2, deep = kind == -4 || kind == 8;
    // rho times the integrals of x^2, x y, and (2 + x + y + z)^2 over [0,2] x [0,1] x [0,1], or where y, or
    // z, are 0
    auto along = [&](int c) {
      return field_of(b, [c](auto const& p) { return Eigen::Vector3d(p[c], 0, 0); });
    };
    CHECK(integral(mass, along(0), along(0)) == Approx(3 * 8. / 3).epsilon(1e-13));
    if (wide) CHECK(integral(mass, along(0), along(1)) == Approx(3 * 1).epsilon(1e-13));
    if (deep) CHECK(integral(mass, along(1), along(2)) == Approx(3 * 2 * 0.25).epsilon(1e-13));
    // and lumped they are not
    if (kind == 2) CHECK(integral(made(b, {.massDensity = {3}, .lumping = true}), along(0), along(0)) > 8.2);
  }
}

TEST_CASE("the kinetic energy of affine motions is that of the continuum") {
  const Eigen::Vector3d u(0.3, -0.2, 0.5), w(1, -2, 0.5);
  for (const int kind : {-4, 8}) {
    const Box b = box(kind);
    const auto mass = made(b);
    // turning about the origin with angular velocity w: w.I w / 2, with the inertia of the box about its
    // corner
    Eigen::Matrix3d I = Eigen::Matrix3d::Zero();
    const Eigen::Vector3d a(2, 1, 1);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        I(i, j) = i == j ? 6 * (a.squaredNorm() - a[i] * a[i]) / 3 : -6 * a[i] * a[j] / 4;
    const Points v = field_of(b, [&](auto const& p) { return Eigen::Vector3d(w.cross(p)); });
    CHECK(mass.kineticEnergy(b.x, v) == Approx(0.5 * w.dot(I * w)).epsilon(1e-13));
    // moving with u while stretching by s along x: E = m/2 (|u|^2 + 2 u_x s <x> + s^2 <x^2>)
    const double s = 0.7;
    const Points stretch =
        field_of(b, [&](auto const& p) { return Eigen::Vector3d(u + s * p[0] * Eigen::Vector3d::UnitX()); });
    CHECK(mass.kineticEnergy(b.x, stretch) ==
          Approx(3 * (u.squaredNorm() + 2 * u[0] * s * 1 + s * s * 4. / 3)).epsilon(1e-13));
  }
}

TEST_CASE("densities may differ from element to element") {
  Box b = box(2);
  const std::vector<double> densities{1, 2, 4};
  const auto mass = made(b, {.massDensity = densities});
  double expected = 0;
  for (std::size_t e = 0; e < 3; ++e)
    expected += densities[e] * (b.x[std::size_t(b.edges[e][1])] - b.x[std::size_t(b.edges[e][0])]).norm();
  CHECK(mass.lumped.totalMass(4) == Approx(expected));
  // one edge alone: rho L / 6 (2 1; 1 2)
  Box one;
  one.x = {{0, 0, 0}, {0, 3, 4}};
  one.edges = {{0, 1}};
  const auto edge = made(one, {.massDensity = {6}});
  Points m(2, Eigen::Vector3d::Zero());
  edge.addMDx(m, one.x, {{1, 0, 0}, {0, 0, 0}}, 1);
  CHECK(m[0][0] == Approx(10));
  CHECK(m[1][0] == Approx(5));
}

TEST_CASE("bad masses say what is wrong") {
  auto said = [](Box const& b, MeshMatrixMass<Vec3d> mass) -> std::string {
    try {
      check_fields(mass, "/root");
      made(b, mass);
    } catch (Error const& error) {
      return error.what();
    }
    return "";
  };
  auto has = [](std::string const& text, std::string_view word) {
    return text.find(word) != std::string::npos;
  };
  const Box b = box(2);
  CHECK(said(b, {}).empty());
  CHECK(has(said(b, {.massDensity = {1}, .totalMass = 1}), "give one of them"));
  CHECK(has(said(b, {.massDensity = {1, 2}}), "2 values for 3 elements"));
  CHECK(has(said(b, {.massDensity = {1, 2, -1}}), "massDensity[2] is -1"));
  CHECK(has(said(b, {.totalMass = 0.0}), "totalMass is 0"));
  CHECK(has(said(b, {.totalMass = std::nan("")}), "totalMass is nan"));
  Box none = b;
  none.edges.clear();
  CHECK(has(said(none, {}), "MeshMatrixMass<Vec3d>: the mass is that of elements"));
  Box outside = b;
  outside.edges[1] = {0, 4};
  CHECK(has(said(outside, {}), "edge 1 refers to point 4"));
  Box lonely = b;
  lonely.x.push_back({9, 9, 9});
  CHECK(has(said(lonely, {}), "the mass of point 4 is 0"));
}

// A bar of length 1, fixed at one end, vibrates along itself in its first mode at (pi/2) sqrt(E/rho). With
// linear elements of length h = 1/n the consistent mass gives w^2 = 6/h^2 (1 - cos kh) / (2 + cos kh), k =
// pi/2; the lumped one 2/h^2 (1 - cos kh).
TEST_CASE("a bar of springs rings at the frequency of its mass matrix") {
  const int n = 10;
  const double h = 1.0 / n, k = std::acos(-1) / 2;
  MechanicalObject<Vec1d> state;
  StiffSpringForceField<Vec1d> springs;
  for (int i = 0; i <= n; ++i) state.position.push_back(Vec<double, 1>(i * h));
  state.restPosition = state.position;
  for (int i = 0; i <= n; ++i) state.position[std::size_t(i)][0] += 1e-3 * std::sin(k * i * h);
  for (int i = 0; i < n; ++i)
    springs.springs.push_back({.first = i, .second = i + 1, .stiffness = 1 / h, .length = h});
  for (const bool lumping : {false, true}) {
    const double w = std::sqrt(lumping ? 2 / (h * h) * (1 - std::cos(k * h))
                                       : 6 / (h * h) * (1 - std::cos(k * h)) / (2 + std::cos(k * h)));
    const double end = std::acos(-1) / w / 2;  // a quarter of the period: the end passes its rest position
    auto run = [&](auto solver, int steps) {
      Simulation sim{node<"root">(solver,
                                  SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                  state,
                                  springs,
                                  EdgeChain{n},
                                  MeshMatrixMass<Vec1d>{.totalMass = 1, .lumping = lumping},
                                  FixedConstraint<Vec1d>{.indices = {0}})};
      sim.init();
      for (int i = 0; i < steps; ++i) sim.animate(end / steps);
      return (sim.root().state().position[std::size_t(n)][0] - 1) / 1e-3;
    };
    // the amplitude is that of a cosine at its zero: the error of the phase, w dt^2 end / 12 and less
    CHECK(std::abs(run(NewmarkImplicitSolver{}, 400)) < 1e-5);
    if (lumping) CHECK(std::abs(run(RungeKutta4Solver{}, 400)) < 1e-7);
    // symplectic Euler, with the mass that is not lumped: x_k = cos((k + 1/2) t) / cos(t/2), cos t = 1 - (w
    // dt)^2/2
    const double t = std::acos(1 - 0.5 * w * w * end * end / (400.0 * 400));
    CHECK(std::abs(run(EulerExplicitSolver{}, 400) - std::cos(400.5 * t) / std::cos(t / 2)) < 1e-10);
  }
}

// An edge of 6 kg has M = (2 1; 1 2) kg, M^-1 = (2 -1; -1 2) / 3 kg; where point 1 is fixed, only 2 kg of it
// are left.
TEST_CASE("EulerExplicitSolver solves with the mass that is not lumped where a linear solver is in reach") {
  auto accelerations = [](bool lumping, bool fixed, auto... linear) {
    Simulation sim{node<"root">(
        linear...,
        node<"body">(EulerExplicitSolver{},
                     EdgeChain{1},
                     MechanicalObject<Vec1d>{.position = {Vec<double, 1>(0), Vec<double, 1>(1)}},
                     MeshMatrixMass<Vec1d>{.totalMass = 6, .lumping = lumping},
                     ConstantForceField<Vec1d>{.indices = {0}, .forces = {Vec<double, 1>(3)}},
                     FixedConstraint<Vec1d>{.indices = fixed ? std::vector<int>{1} : std::vector<int>{}}))};
    sim.init();
    sim.animate(0.5);
    sim.animate(0.5);
    auto const& state = sim.template at<"body">().state();
    CHECK(state.position[0][0] == Approx(0.75 * state.velocity[0][0]).epsilon(1e-12));  // dt (1/2 + 1) v
    return Eigen::Vector2d(state.velocity[0][0], state.velocity[1][0]);
  };
  auto near = [](Eigen::Vector2d const& a, double first, double second) {
    INFO(a.transpose());
    CHECK((a - Eigen::Vector2d(first, second)).norm() < 1e-12);
  };
  const SparseLDLSolver<CompressedRowSparseMatrixd> direct;
  const CGLinearSolver<> free{.iterations = 10, .tolerance = 1e-14};
  near(accelerations(false, false, direct), 2, -1);
  near(accelerations(false, false, free), 2, -1);
  near(accelerations(false, true, direct), 1.5, 0);
  near(accelerations(false, true, free), 1.5, 0);
  // of row sums nothing has to be solved, and without a linear solver they are taken
  near(accelerations(true, false, direct), 1, 0);
  near(accelerations(false, false), 1, 0);
}

TEST_CASE("EulerExplicitSolver counts masses of mapped states where a linear solver is in reach") {
  auto speed = [](auto... linear) {
    const Vec1d::VecCoord place{Vec<double, 1>(0)};
    Simulation sim{node<"root">(linear...,
                                EulerExplicitSolver{},
                                MechanicalObject<Vec1d>{.position = place},
                                UniformMass<Vec1d>{.vertexMass = 1},
                                ConstantForceField<Vec1d>{.indices = {0}, .forces = {Vec<double, 1>(12)}},
                                node<"mapped">(MechanicalObject<Vec1d>{.position = place},
                                               UniformMass<Vec1d>{.vertexMass = 3},
                                               IdentityMapping<Vec1d, Vec1d>{}))};
    sim.init();
    sim.animate(1);
    return sim.root().state().velocity[0][0];
  };
  CHECK(speed(SparseLDLSolver<CompressedRowSparseMatrixd>{}) == Approx(3).epsilon(1e-13));
  CHECK(speed(CGLinearSolver<>{}) == Approx(3).epsilon(1e-13));
  CHECK(speed() == Approx(12).epsilon(1e-13));
}

TEST_CASE("steps with the consistent mass do not depend on how the system is formed") {
  const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {2, 1, 1});
  auto run = [&](auto linear, int before) {
    Simulation sim{node<"root">(
        Gravity{{0, -9.81, 0}},
        EulerImplicitSolver{.rayleighMass = 0.1},
        linear,
        node<"one">(
            MechanicalObject<Vec1d>{.position = Vec1d::VecCoord(std::size_t(before), Vec<double, 1>(0))},
            UniformMass<Vec1d>{.vertexMass = 1}),
        node<"body">(TetrahedronTopology{mesh.tetrahedra},
                     MechanicalObject<Vec3d>{mesh.positions},
                     MeshMatrixMass<Vec3d>{.massDensity = {1000}},
                     FixedConstraint<Vec3d>{.indices = {0, 1}}))};
    sim.init();
    for (int i = 0; i < 10; ++i) sim.animate(0.02);
    return Eigen::VectorXd(vec::flat(sim.template at<"body">().state().velocity));
  };
  // behind one dof of another state, blocks of three do not fit the points; behind three they do
  for (const int before : {1, 3}) {
    const Eigen::VectorXd free = run(CGLinearSolver<>{.iterations = 1000, .tolerance = 1e-14}, before);
    REQUIRE(free.norm() > 1);
    CHECK((run(SparseLDLSolver<CompressedRowSparseMatrixd>{}, before) - free).norm() < 1e-10 * free.norm());
    CHECK((run(SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}, before) - free).norm() <
          1e-10 * free.norm());
  }
}

}  // namespace test_mesh_matrix_mass
