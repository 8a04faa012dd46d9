// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"
#include "registry_scene.hpp"

#include <sinew/sinew.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <set>

namespace test_fem {

using namespace sinew;

namespace {

using Matrix3d = CompressedRowSparseMatrixMat3x3d;

template <class... Extra>
auto body(Mesh const& mesh, TetrahedronFEMForceField<Vec3d> fem, EulerImplicitSolver ode, Extra... extra) {
  return RegistryScene{node<"root">(ode,
                                    CGLinearSolver<Matrix3d>{.iterations = 3000, .tolerance = 1e-13},
                                    TetrahedronTopology{mesh.tetrahedra},
                                    MechanicalObject<Vec3d>{mesh.positions},
                                    DiagonalMass<Vec3d>{.massDensity = 1000},
                                    fem,
                                    extra...)};
}

Mesh shaken_block(int n) {  // n cells a side
  Mesh mesh = regular_grid_tetrahedra(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    auto& p = mesh.positions[i];
    const bool inside = (p.array() > 1e-9).all() && (p.array() < 1 - 1e-9).all();
    if (inside)
      p += 0.15 / n *
           Eigen::Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), std::sin(7.0 * double(i)));
  }
  return mesh;
}

std::vector<int> boundary_points(Mesh const& mesh) {
  std::set<int> points;
  for (auto const& t : boundary_triangles(mesh.tetrahedra)) points.insert(t.begin(), t.end());
  return {points.begin(), points.end()};
}

}  // namespace

TEST_CASE("patch test: points inside an affine boundary settle to the same affine map") {
  const Mesh mesh = shaken_block(3);
  const std::vector<int> boundary = boundary_points(mesh);
  REQUIRE(boundary.size() < mesh.positions.size());
  Eigen::Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  // `large` takes another frame in each element, and is left out: it meets the test in the limit of small
  // strain only
  for (const RotationMethod method :
       {RotationMethod::small, RotationMethod::nearest, RotationMethod::gradient}) {
    auto sim = body(mesh,
                    {.youngModulus = {1e4}, .poissonRatio = 0.3, .method = method},
                    EulerImplicitSolver{.rayleighMass = 1},
                    FixedConstraint<Vec3d>{.indices = boundary});
    auto& state = sim.root().state();
    state.restPosition = mesh.positions;
    for (const int i : boundary) state.position[std::size_t(i)] = f * mesh.positions[std::size_t(i)];
    sim.init();
    for (int i = 0; i < 60; ++i) sim.animate(10);  // long steps: Newton's method on the equilibrium
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      CHECK((state.position[i] - f * mesh.positions[i]).norm() < 1e-9);
  }
}

TEST_CASE("a cylinder under traction stretches by p/E and thins by nu p/E") {
  const Mesh mesh = cylinder_tetrahedra(2, 0, 2, 0.5, 3, 6);
  // frames on the edges of an element turn by the order of the strain, with a relative error of that
  // order: a strain of 1e-5 holds `large` and `gradient` to the 1e-4 that the others meet at any load
  const double E = 1e5, nu = 0.3, p = 1;
  // a dead load p on both end planes: each triangle gives a third of its load to its points
  std::vector<int> loaded;
  Vec3d::VecDeriv loads;
  for (auto const& t : boundary_triangles(mesh.tetrahedra)) {
    Eigen::Vector3d x[3];
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.positions[std::size_t(t[k])];
    for (const double end : {0.0, 2.0})
      if (std::abs(x[0][2] - end) < 1e-12 && std::abs(x[1][2] - end) < 1e-12 &&
          std::abs(x[2][2] - end) < 1e-12)
        for (const int i : t) {
          loaded.push_back(i);
          loads.push_back(Eigen::Vector3d(
              0, 0, (end > 1 ? 1 : -1) * p * 0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm() / 3));
        }
  }
  REQUIRE(loaded.size() > 20);
  for (const RotationMethod method :
       {RotationMethod::small, RotationMethod::large, RotationMethod::nearest, RotationMethod::gradient}) {
    auto sim = body(mesh,
                    {.youngModulus = {E}, .poissonRatio = nu, .method = method},
                    EulerImplicitSolver{.rayleighMass = 1},
                    ConstantForceField<Vec3d>{.indices = loaded, .forces = loads});
    sim.init();
    for (int i = 0; i < 40; ++i) sim.animate(1);
    // lengths between pairs of points, which a drift of the free body does not change
    auto strain = [&](Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
      auto at = [&](Eigen::Vector3d const& x) {
        std::size_t best = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
          if ((mesh.positions[i] - x).norm() < (mesh.positions[best] - x).norm()) best = i;
        return best;
      };
      auto const& now = sim.root().state().position;
      return (now[at(a)] - now[at(b)]).norm() / (mesh.positions[at(a)] - mesh.positions[at(b)]).norm() - 1;
    };
    CHECK(strain({0, 0, 0}, {0, 0, 2}) == Approx(p / E).epsilon(1e-4));
    CHECK(strain({0.5, 0, 1}, {-0.5, 0, 1}) == Approx(-nu * p / E).epsilon(1e-4));
    CHECK(strain({0.25, 0.433, 2}, {-0.25, -0.433, 2}) == Approx(-nu * p / E).epsilon(1e-4));
  }
}

TEST_CASE("a body settles under gravity to the solution of linear statics") {
  const Mesh mesh = shaken_block(3);
  const double E = 3e6, nu = 0.3, g = 9.81;
  const std::size_t n = mesh.positions.size();
  std::vector<int> fixed;
  for (std::size_t i = 0; i < n; ++i)
    if (mesh.positions[i][1] < 1e-9) fixed.push_back(int(i));

  // K u = m g by a dense factorisation of K_ij = V (lambda g_i g_j' + mu g_j g_i' + mu g_i.g_j I), made here
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * long(n), 3 * long(n));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3 * long(n));
  for (auto const& t : mesh.tetrahedra) {
    Eigen::Matrix3d edges;
    for (int c = 0; c < 3; ++c)
      edges.col(c) = mesh.positions[std::size_t(t[std::size_t(c) + 1])] - mesh.positions[std::size_t(t[0])];
    const double volume = edges.determinant() / 6;
    Eigen::Matrix<double, 3, 4> grad;
    grad.rightCols<3>() = edges.inverse().transpose();
    grad.col(0) = -grad.rightCols<3>().rowwise().sum();
    for (int i = 0; i < 4; ++i) {
      load[3 * t[std::size_t(i)] + 1] -= 1000 * volume / 4 * g;
      for (int j = 0; j < 4; ++j)
        K.block<3, 3>(3 * t[std::size_t(i)], 3 * t[std::size_t(j)]) +=
            volume *
            (lambda * grad.col(i) * grad.col(j).transpose() + mu * grad.col(j) * grad.col(i).transpose() +
             mu * grad.col(i).dot(grad.col(j)) * Eigen::Matrix3d::Identity());
    }
  }
  for (const int i : fixed)
    for (int c = 0; c < 3; ++c) {
      K.row(3 * i + c).setZero();
      K.col(3 * i + c).setZero();
      K(3 * i + c, 3 * i + c) = 1;
      load[3 * i + c] = 0;
    }
  const Eigen::VectorXd u = K.ldlt().solve(load);

  auto sim = body(mesh,
                  {.youngModulus = {E}, .poissonRatio = nu, .method = RotationMethod::small},
                  EulerImplicitSolver{.rayleighMass = 1},
                  FixedConstraint<Vec3d>{.indices = fixed},
                  Gravity{{0, -g, 0}});
  sim.init();
  for (int i = 0; i < 40; ++i) sim.animate(1);
  double error = 0;
  for (std::size_t i = 0; i < n; ++i)
    error = std::max(error,
                     (sim.root().state().position[i] - mesh.positions[i] - u.segment<3>(3 * long(i))).norm());
  CHECK(u.cwiseAbs().maxCoeff() > 1e-3);
  CHECK(error < 1e-9 * u.norm());
}

TEST_CASE("a body at rest stays at rest without gravity") {
  const Mesh mesh = shaken_block(3);
  for (const RotationMethod method : {RotationMethod::small,
                                      RotationMethod::large,
                                      RotationMethod::polar,
                                      RotationMethod::nearest,
                                      RotationMethod::gradient}) {
    auto sim = body(mesh,
                    {.youngModulus = {3000}, .poissonRatio = 0.3, .method = method},
                    EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1});
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(0.02);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      REQUIRE((sim.root().state().position[i] - mesh.positions[i]).norm() < 1e-12);
  }
}

TEST_CASE("a large rotation costs no elastic energy") {
  const Mesh mesh = shaken_block(2);
  for (const RotationMethod method :
       {RotationMethod::large, RotationMethod::polar, RotationMethod::nearest, RotationMethod::gradient}) {
    auto sim =
        body(mesh, {.youngModulus = {3000}, .poissonRatio = 0.3, .method = method}, EulerImplicitSolver{});
    sim.init();
    for (const double angle : {0.5, 1.6, 3.1}) {
      const Eigen::AngleAxisd rotation(angle, Eigen::Vector3d(1, 2, -2) / 3);
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        sim.root().state().position[i] = rotation * mesh.positions[i];
      CHECK(sim.potentialEnergy() < 1e-24 * 3000);  // (rounding of the strain)^2 times the modulus
    }
  }
}

// SOFA's method="polar": f = -R K (R' x - R0' X), with the orthogonal factors R and R0 of the edges now and
// at rest, and the stiffness K of the element turned by R0'.
struct EdgePolar {
  double lambda, mu, energy = 0;
  Vec3d::VecDeriv force{};

  static Eigen::Matrix3d edges(Vec3d::VecCoord const& x, Tetrahedron const& t) {
    Eigen::Matrix3d a;
    for (int c = 0; c < 3; ++c) a.col(c) = x[std::size_t(t[std::size_t(c) + 1])] - x[std::size_t(t[0])];
    return a;
  }
  static Eigen::Matrix3d orthogonal(Eigen::Matrix3d const& a) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return svd.matrixU() * svd.matrixV().transpose();
  }
  void add(Vec3d::VecCoord const& X, Vec3d::VecCoord const& x, Tetrahedron const& t) {
    force.resize(X.size(), Eigen::Vector3d::Zero());
    const Eigen::Matrix3d R0 = orthogonal(edges(X, t)), R = orthogonal(edges(x, t));
    Eigen::Matrix<double, 3, 4> h;
    h.rightCols<3>() = R0.transpose() * edges(X, t).inverse().transpose();
    h.col(0) = -h.rightCols<3>().rowwise().sum();
    const double volume = std::abs(edges(X, t).determinant()) / 6;
    auto way = [&](std::size_t k) -> Eigen::Vector3d {
      return R.transpose() * x[std::size_t(t[k])] - R0.transpose() * X[std::size_t(t[k])];
    };
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Eigen::Matrix3d K =
            volume * (lambda * h.col(i) * h.col(j).transpose() + mu * h.col(j) * h.col(i).transpose() +
                      mu * h.col(i).dot(h.col(j)) * Eigen::Matrix3d::Identity());
        const Eigen::Vector3d pull = K * way(std::size_t(j));
        force[std::size_t(t[std::size_t(i)])] -= R * pull;
        energy += 0.5 * way(std::size_t(i)).dot(pull);
      }
  }
};

TEST_CASE("polar takes the rotation of the edges of a tetrahedron, against that at rest") {
  using one::force;
  using one::ready;
  const double E = 100, nu = 0.3;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const std::vector<Tetrahedron> element{{0, 1, 2, 3}};
  for (int sample = 0; sample < 40; ++sample) {
    INFO("sample " << sample);
    // shapes of all sorts, every other one left-handed, deformed by up to a third and turned
    Vec3d::VecCoord X{{0.2, 0.1, -0.3}, {1.2, 0.3, -0.2}, {0.6, 1.3, 0.1}, {0.4, 0.2, 1.1}}, x;
    for (std::size_t i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c) X[i][c] += 0.35 * std::sin(1.3 * sample + 5.0 * double(i) + 11 * c);
    if (sample % 2 == 1) std::swap(X[1], X[2]);
    const Eigen::AngleAxisd rotation(0.4 * sample, Eigen::Vector3d(1, 2, -2) / 3);
    for (std::size_t i = 0; i < 4; ++i)
      x.push_back(rotation * (X[i] + 0.1 * Eigen::Vector3d(std::sin(3.0 * double(i) + sample),
                                                           std::cos(5.0 * double(i) + sample),
                                                           std::sin(7.0 * double(i)))));
    const double now = EdgePolar::edges(x, element[0]).determinant(),
                 rest = EdgePolar::edges(X, element[0]).determinant();
    REQUIRE((rest < 0) == (sample % 2 == 1));
    REQUIRE(now * rest > 0);

    EdgePolar expected{lambda, mu};
    expected.add(X, x, element[0]);
    auto fem = ready(
        TetrahedronFEMForceField<Vec3d>{
            .youngModulus = {E}, .poissonRatio = nu, .method = RotationMethod::polar},
        X,
        {.tetrahedra = element});
    const auto f = force(fem, x);
    for (std::size_t i = 0; i < 4; ++i) CHECK((f[i] - expected.force[i]).norm() < 1e-11 * E);
    CHECK(potential_energy(fem, x) == Approx(expected.energy).epsilon(1e-10).margin(1e-12));
    // the forces turn with the body
    const Eigen::AngleAxisd again(2.1, Eigen::Vector3d(2, -1, 2) / 3);
    for (auto& p : x) p = again * p;
    const auto g = force(fem, x);
    for (std::size_t i = 0; i < 4; ++i) CHECK((g[i] - again * f[i]).norm() < 1e-11 * E);
  }
}

// SOFA cuts the cells of a grid after it has exchanged the ends of their edges along x in every other cell,
// the first included, along y and z in every other one.
TEST_CASE("polar starts the edges in the cells of a grid where SOFA does") {
  const double E = 100, nu = 0.3;
  const int n[3] = {4, 3, 3};
  const Mesh mesh = regular_grid(n[0], n[1], n[2], {0, 0, 0}, {3, 1, 2.4});
  Vec3d::VecCoord x = mesh.positions;
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.05 *
            Eigen::Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), std::sin(7.0 * double(i)));
  const std::size_t ends[3][4][2] = {
      {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  const std::size_t parts[6][4] = {
      {0, 5, 1, 6}, {0, 1, 3, 6}, {1, 3, 6, 2}, {6, 3, 0, 7}, {6, 7, 0, 5}, {7, 5, 4, 0}};
  EdgePolar expected{E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
  for (int i = 0; i < int(mesh.hexahedra.size()); ++i) {
    Hexahedron c = mesh.hexahedra[std::size_t(i)];
    const int nx = n[0] - 1, ny = n[1] - 1;
    const bool exchanged[3] = {i % nx % 2 == 0, i / nx % ny % 2 == 1, i / (nx * ny) % 2 == 1};
    for (int axis = 0; axis < 3; ++axis)
      if (exchanged[axis])
        for (auto const& e : ends[axis]) std::swap(c[e[0]], c[e[1]]);
    for (auto const& t : parts) expected.add(mesh.positions, x, {c[t[0]], c[t[1]], c[t[2]], c[t[3]]});
  }
  TopologyView topology{.hexahedra = mesh.hexahedra};
  topology.grid = {n[0], n[1], n[2]};
  auto fem = one::ready(
      TetrahedronFEMForceField<Vec3d>{
          .youngModulus = {E}, .poissonRatio = nu, .method = RotationMethod::polar},
      mesh.positions,
      topology);
  const auto f = one::force(fem, x);
  for (std::size_t i = 0; i < f.size(); ++i) CHECK((f[i] - expected.force[i]).norm() < 1e-11 * E);
}

// A corner of a box of a x b x c sheared by s across y, F = (1 s; 0 1): the rotation of its edges (a s b; 0
// b) in the plane has tan t = -s b / (a + b), that of F itself tan t = -s / 2.
TEST_CASE("the rotation of a sheared corner is that of its edges, or of its deformation") {
  const double E = 100, nu = 0.3, a = 2, b = 0.5, c = 3, s = 0.4;
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
  const Vec3d::VecCoord X{{0, 0, 0}, {a, 0, 0}, {0, b, 0}, {0, 0, c}},
      x{{0, 0, 0}, {a, 0, 0}, {s * b, b, 0}, {0, 0, c}};
  const std::vector<Tetrahedron> element{{0, 1, 2, 3}};
  for (const bool polar : {true, false}) {
    const double t = polar ? std::atan2(-s * b, a + b) : std::atan2(-s, 2);
    Eigen::Matrix2d F, R;
    F << 1, s, 0, 1;
    R << std::cos(t), -std::sin(t), std::sin(t), std::cos(t);
    const Eigen::Matrix2d g = F * R.transpose(), e = 0.5 * (g + g.transpose()) - Eigen::Matrix2d::Identity();
    auto fem = one::ready(
        TetrahedronFEMForceField<Vec3d>{.youngModulus = {E},
                                        .poissonRatio = nu,
                                        .method = polar ? RotationMethod::polar : RotationMethod::nearest},
        X,
        {.tetrahedra = element});
    CHECK(potential_energy(fem, x) ==
          Approx(a * b * c / 6 * (mu * e.squaredNorm() + lambda / 2 * e.trace() * e.trace())).epsilon(1e-12));
  }
}

TEST_CASE("momentum is constant under internal forces") {
  const Mesh mesh = shaken_block(2);
  auto run = [&](auto ode, auto... linear) {
    auto sim = RegistryScene{node<"root">(
        ode,
        linear...,
        TetrahedronTopology{mesh.tetrahedra},
        MechanicalObject<Vec3d>{mesh.positions},
        UniformMass<Vec3d>{.vertexMass = 0.5},
        TetrahedronFEMForceField<Vec3d>{
            .youngModulus = {300}, .poissonRatio = 0.3, .method = RotationMethod::nearest},
        StiffSpringForceField<Vec3d>{
            .springs = {{.first = 0, .second = 20, .stiffness = 50, .damping = 1, .length = 0.1}}})};
    auto& s = sim.root().state();
    s.velocity.assign(mesh.positions.size(), Eigen::Vector3d(0.1, 0.2, 0.3));
    s.velocity[3] = {2, -1, 0};
    sim.init();
    auto momentum = [&] {
      Eigen::Matrix<double, 6, 1> p = Eigen::Matrix<double, 6, 1>::Zero();
      for (std::size_t i = 0; i < s.size(); ++i) {
        p.head<3>() += 0.5 * s.velocity[i];
        p.tail<3>() += 0.5 * s.position[i].cross(s.velocity[i]);
      }
      return p;
    };
    const auto start = momentum();
    for (int i = 0; i < 200; ++i) sim.animate(0.002);
    return (momentum() - start).cwiseAbs().eval();
  };
  // linear momentum to rounding; symplectic Euler keeps angular momentum too (forces act along the old
  // positions, and x' = v adds nothing)
  const auto explicitError = run(EulerExplicitSolver{});
  CHECK(explicitError.maxCoeff() < 1e-11);
  CHECK(run(RungeKutta4Solver{}).head<3>().maxCoeff() < 1e-11);
  CHECK(run(EulerImplicitSolver{}, CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14})
            .head<3>()
            .maxCoeff() < 1e-10);
}

TEST_CASE("matrix-free and assembled conjugate gradients agree") {
  const Mesh mesh = shaken_block(3);
  auto run = [&](auto cg) {
    cg.iterations = 25;
    cg.tolerance = 0;
    RegistryScene sim{
        node<"root">(Gravity{{0, -9.81, 0}},
                     EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                     cg,
                     TetrahedronTopology{mesh.tetrahedra},
                     MechanicalObject<Vec3d>{mesh.positions},
                     DiagonalMass<Vec3d>{.massDensity = 1},
                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                     FixedConstraint<Vec3d>{.indices = {0, 1, 2}})};
    sim.init();
    for (int i = 0; i < 50; ++i) sim.animate(0.02);
    CHECK(sim.root().template get<decltype(cg)>().residuals.size() == 26);
    CHECK(sim.root().template get<decltype(cg)>().residuals.front() == 1);
    CHECK(sim.root().template get<decltype(cg)>().residuals.back() < 0.1);
    return sim.root().state().position;
  };
  const auto free = run(CGLinearSolver<>{}), assembled = run(CGLinearSolver<Matrix3d>{}),
             scalar = run(CGLinearSolver<CompressedRowSparseMatrixd>{});
  for (std::size_t i = 0; i < free.size(); ++i) {
    CHECK((free[i] - assembled[i]).norm() < 1e-9);
    CHECK((free[i] - scalar[i]).norm() < 1e-9);
  }
}

}  // namespace test_fem
