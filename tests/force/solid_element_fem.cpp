// SPDX-License-Identifier: BSL-1.0
// Prisms and pyramids, by the law of elements over shape functions.
#include "free_motions.hpp"

#include <sinew/engine/topological_mapping.hpp>
#include <sinew/force/prism_fem.hpp>
#include <sinew/force/pyramid_fem.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace test_solid_element_fem {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::force;
using one::ready;
using one::refuses;

namespace {

bool inside(Vector3d const& p) { return (p.array() > 1e-9).all() && (p.array() < 1 - 1e-9).all(); }

// The unit cube in n^3 cells, each of two prisms, or of six pyramids around its middle; points inside are
// shaken, so that faces are warped.
template <class D>
struct Prisms {
  using Force = PrismFEMForceField<D>;
  static constexpr double oneVolume = 0.5;
  static Vec3d::VecCoord oneElement() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  }
  std::vector<Prism> elements{};
  Vec3d::VecCoord x{};

  explicit Prisms(int n) {
    const Mesh mesh = regular_grid(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
    elements = detail::Hexa2Prism::convert(mesh.hexahedra);
    x = mesh.positions;
    shake(x, n);
  }
  static void shake(Vec3d::VecCoord& x, int n) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (inside(x[i]))
        x[i] += 0.15 / n *
                Vector3d(std::sin(3.0 * double(i)), std::cos(5.0 * double(i)), std::sin(7.0 * double(i)));
  }
  TopologyView view() const { return {.prisms = elements}; }
  static TopologyView view(std::vector<Prism> const& list) { return {.prisms = list}; }
};
template <class D>
struct Pyramids {
  using Force = PyramidFEMForceField<D>;
  static constexpr double oneVolume = 1. / 3;
  static Vec3d::VecCoord oneElement() { return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.4, 1}}; }
  std::vector<Pyramid> elements{};
  Vec3d::VecCoord x{};

  explicit Pyramids(int n) {
    const Mesh mesh = regular_grid(n + 1, n + 1, n + 1, {0, 0, 0}, {1, 1, 1});
    x = mesh.positions;
    for (Hexahedron const& h : mesh.hexahedra) {
      const auto middle = Index(x.size());
      x.push_back((mesh.positions[std::size_t(h[0])] + mesh.positions[std::size_t(h[6])]) / 2);
      for (auto const& f : hexahedronFaces)  // counter-clockwise from outside, so clockwise from the apex
        elements.push_back({h[f[0]], h[f[3]], h[f[2]], h[f[1]], middle});
    }
    if (n > 1) Prisms<D>::shake(x, 2 * n);
  }
  TopologyView view() const { return {.pyramids = elements}; }
  static TopologyView view(std::vector<Pyramid> const& list) { return {.pyramids = list}; }
};

}  // namespace

TEMPLATE_TEST_CASE("an affine strain has the energy of the continuum, and its force", "", Prisms<Vec3d>,
                   Pyramids<Vec3d>) {
  const TestType body(2);
  const double E = 1000, nu = 0.3;
  const LameModuli m = lame_moduli(E, nu);
  Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  const Matrix3d e = 0.5 * (f + f.transpose()) - Matrix3d::Identity(),
                 s = 2 * m.mu * e + m.lambda * e.trace() * Matrix3d::Identity();
  auto fem = ready(
      typename TestType::Force{.youngModulus = {E}, .poissonRatio = nu, .method = ElementRotation::small},
      body.x,
      body.view());
  Vec3d::VecCoord moved = body.x;
  for (auto& p : moved) p = f * p;
  // the volume is 1: weights are exact for warped elements
  CHECK(potential_energy(fem, moved) ==
        Approx(m.mu * e.squaredNorm() + m.lambda / 2 * e.trace() * e.trace()).epsilon(1e-12));
  const auto forces = force(fem, moved);
  Matrix3d virial = Matrix3d::Zero();  // sum_i f_i x_i' = -s V
  for (std::size_t i = 0; i < forces.size(); ++i) {
    if (inside(body.x[i])) CHECK(forces[i].norm() < 1e-12 * E);
    virial += forces[i] * body.x[i].transpose();
  }
  CHECK((virial + s).norm() < 1e-12 * E);
}

TEMPLATE_TEST_CASE("patch test of prisms and pyramids: points settle to the affine map of their boundary", "",
                   Prisms<Vec3d>, Pyramids<Vec3d>) {
  const TestType body(2);
  Matrix3d f;
  f << 1.05, 0.02, -0.01, 0.03, 0.98, 0.02, 0.01, -0.02, 1.04;
  // `polar` takes another rotation in each distorted element, and meets the test in the limit of small strain
  for (const ElementRotation method : {ElementRotation::small, ElementRotation::nearest}) {
    auto fem = ready(typename TestType::Force{.youngModulus = {1e4}, .poissonRatio = 0.3, .method = method},
                     body.x,
                     body.view());
    Vec3d::VecCoord x = body.x;
    std::vector<bool> held;
    for (auto& p : x) {
      held.insert(held.end(), 3, !inside(p));
      if (!inside(p)) p = f * p;
    }
    CHECK(one::settle(fem, x, held, Vec3d::VecDeriv(x.size(), Vector3d::Zero()), 12) < 1e-9);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - f * body.x[i]).norm() < 1e-11);
  }
}

// Directions without stiffness of a single element are its six rigid motions: none is an hourglass.
TEMPLATE_TEST_CASE("one element resists all but rigid motions", "", Prisms<Vec3d>, Pyramids<Vec3d>) {
  const auto x = TestType::oneElement();
  typename decltype(TestType::elements)::value_type numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = Index(i);
  const std::vector list{numbers};
  auto fem =
      ready(typename TestType::Force{.youngModulus = {1}, .poissonRatio = 0.3}, x, TestType::view(list));
  force(fem, x);
  one::check_six_free_motions(one::stiffness(fem, x.size()), 1e-14);
  // stretched along z: E/2 e^2 V where it is free to thin
  auto uniaxial = ready(
      typename TestType::Force{.youngModulus = {100}, .poissonRatio = 0, .method = ElementRotation::nearest},
      x,
      TestType::view(list));
  Vec3d::VecCoord longer = x;
  for (auto& p : longer) p[2] *= 1.02;
  CHECK(potential_energy(uniaxial, longer) == Approx(50 * 4e-4 * TestType::oneVolume).epsilon(1e-12));
}

TEMPLATE_TEST_CASE("a large rotation of elements costs no energy, and turns the forces of a strain", "",
                   Prisms<Vec3d>, Pyramids<Vec3d>) {
  const TestType body(2);
  Vec3d::VecCoord strained = body.x;
  for (std::size_t i = 0; i < strained.size(); ++i)
    strained[i] +=
        0.05 * Vector3d(std::cos(2.0 * double(i)), std::sin(3.0 * double(i)), std::cos(5.0 * double(i)));
  for (const double angle : {0.5, 1.6, -0.5, -3.1}) {
    const ElementRotation method = angle > 0 ? ElementRotation::polar : ElementRotation::nearest;
    auto fem = ready(typename TestType::Force{.youngModulus = {3000}, .poissonRatio = 0.3, .method = method},
                     body.x,
                     body.view());
    const Matrix3d rotation = Eigen::AngleAxisd(angle, Vector3d(1, 2, -2) / 3).matrix();
    Vec3d::VecCoord turned = body.x, both = strained;
    for (auto& x : turned) x = rotation * x + Vector3d(1, 2, 3);
    for (auto& x : both) x = rotation * x + Vector3d(1, 2, 3);
    CHECK(potential_energy(fem, turned) < 1e-24 * 3000);  // (rounding of the strain)^2 times the modulus
    CHECK(potential_energy(fem, both) == Approx(potential_energy(fem, strained)).epsilon(1e-12));
    const auto f = force(fem, strained), g = force(fem, both);
    for (std::size_t i = 0; i < f.size(); ++i) CHECK((g[i] - rotation * f[i]).norm() < 1e-11 * 3000);
  }
}

TEMPLATE_TEST_CASE("prisms and pyramids may differ in stiffness, and are checked", "", Prisms<Vec3d>,
                   Pyramids<Vec3d>) {
  using Force = typename TestType::Force;
  const TestType body(1);
  std::vector<double> moduli(body.elements.size(), 100);
  moduli[0] = 300;
  auto fem = ready(Force{.youngModulus = moduli, .poissonRatio = 0, .method = ElementRotation::nearest},
                   body.x,
                   body.view());
  Vec3d::VecCoord x = body.x;
  for (auto& p : x) p[0] *= 1.01;
  const double share = 1 / double(body.elements.size());
  CHECK(potential_energy(fem, x) == Approx(0.5 * 1e-4 * (100 + 200 * share)));

  const std::string noun(element_kind_name(body.elements[0].size() == 6 ? 6 : 5));
  refuses(Force{}, body.x, {}, {"body", "FEMForceField<Vec3d>", "the topology has no " + noun});
  moduli.push_back(1);
  refuses(Force{.youngModulus = moduli}, body.x, body.view(), {"values for"});
  refuses(Force{.youngModulus = {0}}, body.x, body.view(), {"youngModulus[0] is 0 Pa"});
  refuses(Force{.youngModulus = {one::notANumber}}, body.x, body.view(), {"youngModulus[0] is nan"});
  refuses(Force{.poissonRatio = 0.5}, body.x, body.view(), {"poissonRatio is 0.5", "less than 0.5"});
  // round the other way they are the same, as in SOFA
  auto turned = body.elements;
  for (auto& e : turned) std::swap(e[0], e[1]), std::swap(e[3], e[noun == "pyramid" ? 2 : 4]);
  auto same = ready(Force{.youngModulus = {100}, .poissonRatio = 0, .method = ElementRotation::nearest},
                    body.x,
                    TestType::view(turned));
  CHECK(potential_energy(same, x) == Approx(0.5 * 1e-4 * 100));
  auto bad = body.elements;
  std::swap(bad[1][0], bad[1][1]);
  refuses(Force{}, body.x, TestType::view(bad), {noun + " 1 is flat or twisted"});
  Vec3d::VecCoord flat = body.x;
  for (auto& p : flat) p[2] = 0;
  refuses(Force{}, flat, body.view(), {noun + " 0 is flat"});
  bad[1][0] = 99;
  refuses(Force{}, body.x, TestType::view(bad), {noun + " 1 refers to point 99"});
  bad[1][0] = -1;
  refuses(Force{}, body.x, TestType::view(bad), {noun + " 1 refers to point -1"});
}

}  // namespace test_solid_element_fem
