// SPDX-License-Identifier: BSL-1.0
// Tetrahedra of 10 nodes, hexahedra of 20 and 27.
#include "free_motions.hpp"
#include "quadratic_mesh.hpp"

#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/quadratic_hexahedron_fem.hpp>
#include <sinew/force/quadratic_tetrahedron_fem.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/triquadratic_hexahedron_fem.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace test_quadratic_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

struct Tet10 {
  using Element = QuadraticTetrahedron;
  using Shape = QuadraticTetrahedronShape;
  using Force = QuadraticTetrahedronFEMForceField<Vec3d>;
  using Single = QuadraticTetrahedronFEMForceField<Vec3f>;
  using Linear = TetrahedronFEMForceField<Vec3d>;
  static TopologyView view(std::vector<Element> const& list) { return {.quadraticTetrahedra = list}; }
};
struct Hex20 {
  using Element = QuadraticHexahedron;
  using Shape = QuadraticHexahedronShape;
  using Force = QuadraticHexahedronFEMForceField<Vec3d>;
  using Linear = HexahedronFEMForceField<Vec3d>;
  static TopologyView view(std::vector<Element> const& list) { return {.quadraticHexahedra = list}; }
};
struct Hex27 {
  using Element = TriquadraticHexahedron;
  using Shape = TriquadraticHexahedronShape;
  using Force = TriquadraticHexahedronFEMForceField<Vec3d>;
  using Linear = HexahedronFEMForceField<Vec3d>;
  static TopologyView view(std::vector<Element> const& list) { return {.triquadraticHexahedra = list}; }
};

template <class Kind>
struct Cube {
  Mesh mesh;
  std::vector<bool> inside{};

  explicit Cube(int n, double shaken = 0)
      : mesh(one::quadratic_box<typename Kind::Element>(n, n, n, {0, 0, 0}, {1, 1, 1})) {
    for (std::size_t i = 0; i < x().size(); ++i) {
      inside.push_back((x()[i].array() > 1e-9).all() && (x()[i].array() < 1 - 1e-9).all());
      const double k = double(i);
      if (inside.back())
        mesh.positions[i] += shaken / n * Vector3d(std::sin(3 * k), std::cos(5 * k), std::sin(7 * k));
    }
  }
  std::vector<Vector3d> const& x() const { return mesh.positions; }
  std::vector<typename Kind::Element> const& elements() const {
    return one::elements_of<typename Kind::Element>(mesh);
  }
  TopologyView view() const { return Kind::view(elements()); }
};

// Solves for the coordinates that are not held, of a force that is linear in x.
template <class Force>
void solve(Force& fem, Vec3d::VecCoord& x, std::vector<bool> const& held, Vec3d::VecDeriv const& load) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) free.push_back(Eigen::Index(i));
  const auto f = force(fem, x);
  Eigen::MatrixXd k(long(free.size()), long(free.size()));
  Eigen::VectorXd residual(long(free.size()));
  for (std::size_t c = 0; c < free.size(); ++c) {
    const auto at = [](auto& list, Eigen::Index i) -> auto& { return list[std::size_t(i / 3)][i % 3]; };
    Vec3d::VecDeriv dx(x.size(), Vector3d::Zero());
    at(dx, free[c]) = 1;
    const auto df = one::product(fem, dx, 1, 0);
    for (std::size_t r = 0; r < free.size(); ++r) k(long(r), long(c)) = -at(df, free[r]);
    residual[long(c)] = at(f, free[c]) + at(load, free[c]);
  }
  const Eigen::VectorXd dx = k.llt().solve(residual);
  for (std::size_t c = 0; c < free.size(); ++c) x[std::size_t(free[c] / 3)][free[c] % 3] += dx[long(c)];
}

}  // namespace

TEMPLATE_TEST_CASE("shape functions sum to one, are one at their nodes, and have the slopes that they say",
                   "", Tet10, Hex20, Hex27) {
  using S = typename TestType::Shape;
  double volume = 0;
  for (std::size_t g = 0; g < S::points; ++g) {
    volume += S::weight(g);
    double sum = 0;
    Vector3d slopes = Vector3d::Zero();
    for (int i = 0; i < int(S::nodes); ++i) {
      sum += S::value(i, S::places[g]);
      for (int k = 0; k < 3; ++k) {
        slopes[k] += S::slope(i, k, S::places[g]);
        auto before = S::places[g], after = before;
        before[std::size_t(k)] -= 1e-5, after[std::size_t(k)] += 1e-5;
        CHECK(S::slope(i, k, S::places[g]) ==
              Approx((S::value(i, after) - S::value(i, before)) / 2e-5).margin(1e-9));
      }
    }
    CHECK(sum == Approx(1).epsilon(1e-14));
    CHECK(slopes.norm() < 1e-14);
  }
  CHECK(volume == Approx(S::nodes == 10 ? 1. / 6 : 8).epsilon(1e-14));
  // at the nodes of a straight element
  const Cube<TestType> cube(1);
  auto const& e = cube.elements()[0];
  const Vector3d low = cube.x()[std::size_t(e[0])];
  Matrix3d sides;
  for (int c = 0; c < 3; ++c)
    sides.col(c) = cube.x()[std::size_t(e[std::size_t(S::nodes == 10 ? c + 1
                                                      : c == 0       ? 1
                                                      : c == 1       ? 3
                                                                     : 4)])] -
                   low;
  for (std::size_t j = 0; j < S::nodes; ++j) {
    Vector3d q = sides.inverse() * (cube.x()[std::size_t(e[j])] - low);
    if (S::nodes > 10) q = 2 * q - Vector3d::Ones();
    for (std::size_t i = 0; i < S::nodes; ++i)
      CHECK(S::value(int(i), {q[0], q[1], q[2]}) == Approx(i == j ? 1 : 0).margin(1e-14));
  }
}

TEMPLATE_TEST_CASE("patch test of elements with straight and with curved edges", "", Tet10, Hex20, Hex27) {
  const double E = 1000, nu = 0.3;
  const LameModuli m = lame_moduli(E, nu);
  Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  const Matrix3d e = 0.5 * (f + f.transpose()) - Matrix3d::Identity(),
                 s = 2 * m.mu * e + m.lambda * e.trace() * Matrix3d::Identity();
  for (const double shaken : {0.0, 0.04}) {
    const Cube<TestType> cube(2, shaken);
    auto fem = ready(
        typename TestType::Force{.youngModulus = {E}, .poissonRatio = nu, .method = ElementRotation::small},
        cube.x(),
        cube.view());
    Vec3d::VecCoord moved = cube.x();
    for (auto& p : moved) p = f * p;
    // the volume is 1: determinants are summed exactly
    CHECK(potential_energy(fem, moved) ==
          Approx(m.mu * e.squaredNorm() + m.lambda / 2 * e.trace() * e.trace()).epsilon(1e-12));
    const auto forces = force(fem, moved);
    Matrix3d virial = Matrix3d::Zero();
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < forces.size(); ++i) {
      if (cube.inside[i]) CHECK(forces[i].norm() < 1e-12 * E);
      virial += forces[i] * cube.x()[i].transpose();
      sum += forces[i];
    }
    CHECK((virial + s).norm() < 1e-12 * E);
    CHECK(sum.norm() < 1e-12 * E);
    // from where they are the nodes inside settle to the affine map of the boundary
    Vec3d::VecCoord x = cube.x();
    std::vector<bool> held;
    for (std::size_t i = 0; i < x.size(); ++i) {
      held.insert(held.end(), 3, !cube.inside[i]);
      if (!cube.inside[i]) x[i] = moved[i];
    }
    solve(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()));
    for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - moved[i]).norm() < 1e-12);
  }
}

TEMPLATE_TEST_CASE("one element of second order resists all but rigid motions", "", Tet10, Hex20, Hex27) {
  const Cube<TestType> cube(1);
  typename TestType::Element numbers{};
  Vec3d::VecCoord x;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    numbers[i] = Index(i);
    x.push_back(cube.x()[std::size_t(cube.elements()[0][i])]);
  }
  const std::vector list{numbers};
  auto fem =
      ready(typename TestType::Force{.youngModulus = {1}, .poissonRatio = 0.3}, x, TestType::view(list));
  force(fem, x);
  one::check_six_free_motions(one::stiffness(fem, x.size()), 1e-13);
}

// Of a beam that is bent by a moment, u = c (x y, -(x^2 + nu (y^2 - z^2))/2, -nu y z) is the whole truth, and
// of degree two: elements have it exactly, also where the material is nearly incompressible. Its strain is
// c y along x, and -nu times that across.
TEMPLATE_TEST_CASE("pure bending is exact, and does not lock", "", Tet10, Hex20, Hex27) {
  const double E = 1e4, c = 1e-2, L = 4;
  const Mesh mesh = one::quadratic_box<typename TestType::Element>(2, 1, 1, {0, -0.5, -0.5}, {L, 0.5, 0.5});
  for (const double nu : {0.0, 0.3, 0.4999}) {
    auto fem = ready(
        typename TestType::Force{.youngModulus = {E}, .poissonRatio = nu, .method = ElementRotation::small},
        mesh.positions,
        TestType::view(one::elements_of<typename TestType::Element>(mesh)));
    Vec3d::VecCoord x = mesh.positions;
    for (auto& p : x) {
      const double y = p[1], z = p[2];
      p += c * Vector3d(p[0] * y, -(p[0] * p[0] + nu * (y * y - z * z)) / 2, -nu * y * z);
    }
    // E I c^2 L / 2, I = 1/12
    CHECK(potential_energy(fem, x) == Approx(E / 12 * c * c * L / 2).epsilon(1e-9));
    const auto forces = force(fem, x);
    double moment = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (const double at = mesh.positions[i][0]; at == L)
        moment -= forces[i][0] * mesh.positions[i][1];
      else if (at > 0)
        CHECK(forces[i].norm() < 1e-9 * E * c);  // rounding times the bulk modulus
    CHECK(moment == Approx(E / 12 * c).epsilon(1e-9));
  }
}

// A cantilever under a force at its end, against Timoshenko's beam: F L^3/(3 E I) + F L/(kappa G A), kappa =
// 5/6 without lateral contraction. Its length is 10 times its height, of which one element is left.
TEMPLATE_TEST_CASE(
    "a cantilever of a few elements deflects as Timoshenko's beam, and one of linear ones locks", "", Tet10,
    Hex20, Hex27) {
  const double E = 1e5, L = 10, F = 1;
  const Mesh mesh = one::quadratic_box<typename TestType::Element>(5, 1, 1, {0, 0, 0}, {L, 1, 1});
  auto deflection = [&](auto fem, Mesh const& of) {
    Vec3d::VecCoord x = of.positions;
    std::vector<bool> held;
    Vec3d::VecDeriv load(x.size(), Vector3d::Zero());
    double atEnd = 0, sum = 0;
    for (auto const& p : x) {
      held.insert(held.end(), 3, p[0] == 0);
      atEnd += p[0] == L;
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i][0] == L) load[i][1] = F / atEnd;
    solve(fem, x, held, load);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (of.positions[i][0] == L) sum += (x[i] - of.positions[i])[1] / atEnd;
    return sum;
  };
  const double beam = F * L * L * L / (3 * E / 12) + F * L / (5. / 6 * E / 2);
  const double found = deflection(
      ready(
          typename TestType::Force{.youngModulus = {E}, .poissonRatio = 0, .method = ElementRotation::small},
          mesh.positions,
          TestType::view(one::elements_of<typename TestType::Element>(mesh))),
      mesh);
  CHECK(found == Approx(beam).epsilon(0.01));
  Mesh linear = regular_grid(11, 3, 3, {0, 0, 0}, {L, 1, 1});  // as many nodes, or more
  linear.tetrahedra = hexahedra_to_tetrahedra(linear.hexahedra);
  typename TestType::Linear first{};
  first.youngModulus = {E}, first.poissonRatio = 0;
  first.method = decltype(first.method)::small;
  const double before = deflection(
      ready(first, linear.positions, {.tetrahedra = linear.tetrahedra, .hexahedra = linear.hexahedra}),
      linear);
  CHECK(std::abs(before - beam) > 5 * std::abs(found - beam));
}

// u = grad phi, phi = exp(sqrt(2) x) sin y sin z / 2 has div u = 0 and laplacian u = 0: no load. Between n
// and 3/2 n elements a side the error of displacements falls by 1.5^3, that of linear elements by 1.5^2.
TEMPLATE_TEST_CASE("displacements converge by the third power of the size", "", Tet10, Hex20, Hex27) {
  using S = typename TestType::Shape;
  const double r = std::sqrt(2.);
  auto exact = [&](Vector3d const& p) -> Vector3d {
    return std::exp(r * p[0]) / 2 *
           Vector3d(r * std::sin(p[1]) * std::sin(p[2]),
                    std::cos(p[1]) * std::sin(p[2]),
                    std::sin(p[1]) * std::cos(p[2]));
  };
  auto solved = [&](auto fem, std::vector<Vector3d> const& rest, std::vector<bool> const& inside) {
    Vec3d::VecCoord x = rest;
    std::vector<bool> held;
    for (std::size_t i = 0; i < x.size(); ++i) {
      held.insert(held.end(), 3, !inside[i]);
      if (!inside[i]) x[i] += exact(rest[i]);
    }
    solve(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= rest[i];
    return x;
  };
  double errors[2], linear[2];
  for (const int n : {2, 3}) {
    const Cube<TestType> cube(n);
    const auto u = solved(ready(
                              typename TestType::Force{
                                  .youngModulus = {1}, .poissonRatio = 0.3, .method = ElementRotation::small},
                              cube.x(),
                              cube.view()),
                          cube.x(),
                          cube.inside);
    double sum = 0;
    for (auto const& e : cube.elements())
      for (std::size_t g = 0; g < S::points; ++g) {
        Vector3d place = Vector3d::Zero(), found = place;
        Matrix3d jacobian = Matrix3d::Zero();
        for (std::size_t i = 0; i < S::nodes; ++i) {
          auto const& at = cube.x()[std::size_t(e[i])];
          place += S::value(int(i), S::places[g]) * at;
          found += S::value(int(i), S::places[g]) * u[std::size_t(e[i])];
          for (int k = 0; k < 3; ++k) jacobian.col(k) += S::slope(int(i), k, S::places[g]) * at;
        }
        sum += S::weight(g) * jacobian.determinant() * (found - exact(place)).squaredNorm();
      }
    errors[n - 2] = std::sqrt(sum);
    Mesh mesh = regular_grid(2 * n + 1, 2 * n + 1, 2 * n + 1, {0, 0, 0}, {1, 1, 1});
    mesh.tetrahedra = hexahedra_to_tetrahedra(mesh.hexahedra);
    std::vector<bool> inside;
    for (auto const& p : mesh.positions)
      inside.push_back((p.array() > 1e-9).all() && (p.array() < 1 - 1e-9).all());
    typename TestType::Linear first{};
    first.youngModulus = {1}, first.poissonRatio = 0.3, first.method = decltype(first.method)::small;
    const auto v =
        solved(ready(first, mesh.positions, {.tetrahedra = mesh.tetrahedra, .hexahedra = mesh.hexahedra}),
               mesh.positions,
               inside);
    sum = 0;
    auto add = [&](auto const& e, auto const& weights, double volume) {
      Vector3d place = Vector3d::Zero(), found = place;
      for (std::size_t k = 0; k < e.size(); ++k) {
        place += weights[Eigen::Index(k)] * mesh.positions[std::size_t(e[k])];
        found += weights[Eigen::Index(k)] * v[std::size_t(e[k])];
      }
      sum += volume * (found - exact(place)).squaredNorm();
    };
    const double cell = 1 / double(mesh.hexahedra.size());
    if (S::nodes == 10) {
      for (auto const& t : mesh.tetrahedra)
        for (int k = 0; k < 4; ++k) {  // of degree two
          Eigen::Vector4d weights = Eigen::Vector4d::Constant((5 - std::sqrt(5.)) / 20);
          weights[k] = 1 - 3 * weights[k];
          add(t, weights, cell / 24);
        }
    } else {
      using Points = sinew::detail::TriquadraticPoints;
      for (auto const& h : mesh.hexahedra)
        for (std::size_t k = 0; k < 27; ++k) {
          const Vector3d q(Points::places[k].data());
          add(h, MultilinearShape<3>((q + Vector3d::Ones()) / 2).weights, cell * Points::weight(k) / 8);
        }
    }
    linear[n - 2] = std::sqrt(sum);
  }
  CAPTURE(errors[0], errors[1], linear[0], linear[1]);
  CHECK(std::log(errors[0] / errors[1]) / std::log(1.5) == Approx(3).margin(0.2));
  CHECK(std::log(linear[0] / linear[1]) / std::log(1.5) == Approx(2).margin(0.3));
  CHECK(errors[1] < linear[1] / 3);
}

TEMPLATE_TEST_CASE("a large rotation of curved elements costs no energy, and turns their forces", "", Tet10,
                   Hex20, Hex27) {
  const Cube<TestType> cube(1, 0.05);
  Vec3d::VecCoord strained = cube.x();
  for (std::size_t i = 0; i < strained.size(); ++i)
    strained[i] +=
        0.05 * Vector3d(std::cos(2.0 * double(i)), std::sin(3.0 * double(i)), std::cos(5.0 * double(i)));
  for (const ElementRotation method : {ElementRotation::polar, ElementRotation::nearest}) {
    auto fem = ready(typename TestType::Force{.youngModulus = {3000}, .poissonRatio = 0.3, .method = method},
                     cube.x(),
                     cube.view());
    const Matrix3d rotation = Eigen::AngleAxisd(2.5, Vector3d(1, 2, -2) / 3).matrix();
    Vec3d::VecCoord turned = cube.x(), both = strained;
    for (auto& x : turned) x = rotation * x + Vector3d(1, 2, 3);
    for (auto& x : both) x = rotation * x + Vector3d(1, 2, 3);
    CHECK(potential_energy(fem, turned) < 1e-24 * 3000);
    CHECK(potential_energy(fem, both) == Approx(potential_energy(fem, strained)).epsilon(1e-12));
    const auto f = force(fem, strained), g = force(fem, both);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK((g[i] - rotation * f[i]).norm() < 1e-10 * 3000);
  }
}

TEMPLATE_TEST_CASE("elements of second order are checked", "", Tet10, Hex20, Hex27) {
  using Force = typename TestType::Force;
  const Cube<TestType> cube(1);
  const std::string noun(element_kind_name(TestType::Shape::nodes == 10   ? 7
                                           : TestType::Shape::nodes == 20 ? 8
                                                                          : 9));
  refuses(Force{}, cube.x(), {}, {"body", "FEMForceField<Vec3d>", "the topology has no " + noun});
  refuses(Force{.youngModulus = {1, 2, 3}}, cube.x(), cube.view(), {"values for"});
  refuses(Force{.poissonRatio = 0.5}, cube.x(), cube.view(), {"poissonRatio is 0.5", "less than 0.5"});
  auto bad = cube.elements();
  bad[0][9] = bad[0][2];
  refuses(Force{}, cube.x(), TestType::view(bad), {noun + " 0 has point", "twice"});
  bad = cube.elements();
  bad[0][9] = 99;
  refuses(Force{}, cube.x(), TestType::view(bad), {noun + " 0 refers to point 99"});
  // inside out it is the same; of two corners that change places, or with a node far from between, it is not
  bad = cube.elements();
  for (auto& e : bad) turn_inside_out(e);
  auto same = ready(Force{}, cube.x(), TestType::view(bad)), whole = ready(Force{}, cube.x(), cube.view());
  Vec3d::VecCoord x = cube.x();
  for (auto& p : x) p[0] *= 1 + 0.1 * p[1];
  CHECK(potential_energy(same, x) == Approx(potential_energy(whole, x)).epsilon(1e-12));
  bad = cube.elements();
  std::swap(bad[0][0], bad[0][TestType::Shape::nodes == 10 ? 1 : 6]);
  refuses(Force{}, cube.x(), TestType::view(bad), {noun + " 0 is flat or twisted", "Gauss points"});
  Vec3d::VecCoord far = cube.x();
  auto const& e = cube.elements()[0];
  far[std::size_t(e[TestType::Shape::nodes == 10 ? 4 : 8])] =
      cube.x()[std::size_t(e[0])] * 2 - cube.x()[std::size_t(e[1])];
  refuses(Force{}, far, cube.view(), {noun + " 0 is flat or twisted", "Jacobian is not positive"});
}

}  // namespace test_quadratic_fem
