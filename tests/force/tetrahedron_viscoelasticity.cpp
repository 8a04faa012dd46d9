// SPDX-License-Identifier: BSL-1.0
#include "one_component.hpp"

#include <sinew/force/tetrahedron_viscoelasticity.hpp>

#include <Eigen/Geometry>
#include <cmath>

namespace test_tetrahedron_viscoelasticity {

using namespace sinew;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using one::ready;
using one::refuses;

namespace {

using Body = TetrahedronViscoelasticityFEMForceField<Vec3d>;
using Material = ViscoelasticMaterial;

const std::vector<Tetrahedron> single{{0, 1, 2, 3}};
const Vec3d::VecCoord corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const double volume = 1.0 / 6;

Body of(Material material, std::vector<double> const& parameters) {
  Body body;
  body.materialName = material;
  body.parameterSet = parameters;
  return ready(body, corners, {.tetrahedra = single});
}
Vec3d::VecCoord deformed(Matrix3d const& f) {
  Vec3d::VecCoord x;
  for (auto const& p : corners) x.push_back(f * p);
  return x;
}
/// F with a Green strain of these entries.
Matrix3d of_strain(Matrix3d const& e) {
  const Matrix3d c = Matrix3d::Identity() + 2 * e;
  return Eigen::LLT<Matrix3d>(c).matrixU();
}
/// Second Piola-Kirchhoff stress of the element: f_k = -V F S g_k, and the g_k are the axes.
Matrix3d stress(Body& body, Matrix3d const& f, double time, double dt,
                Matrix3d const& rate = Matrix3d::Zero()) {
  Vec3d::VecDeriv force(4, Vector3d::Zero()), v = deformed(rate);
  add_force(body, {.time = time, .dt = dt}, force, deformed(f), v);
  Matrix3d p;
  for (int k = 0; k < 3; ++k) p.col(k) = -force[std::size_t(k) + 1] / volume;
  return f.inverse() * p;
}
Matrix3d shear_strain(double e) {
  Matrix3d strain = Matrix3d::Zero();
  strain(0, 1) = strain(1, 0) = e;
  return strain;
}
Matrix3d sample_strain() {
  Matrix3d e;
  e << 0.1, 0.03, -0.02, 0.03, -0.05, 0.04, -0.02, 0.04, 0.07;
  return e;
}

}  // namespace

TEST_CASE("the stress of Kelvin and Voigt is that of a spring and a damper side by side") {
  Body body = of(Material::KelvinVoigtFirstOrder, {20, 0.3, 35});
  const Matrix3d e = sample_strain(), f = of_strain(e);
  Matrix3d rate;
  rate << 1, 2, 3, -1, 0.5, 2, 0, 1, -2;
  const Matrix3d de = 0.5 * (f.transpose() * rate + rate.transpose() * f);
  const Matrix3d wanted = 35 * e.trace() * Matrix3d::Identity() + 2 * 20 * (e + 0.3 * de);
  CHECK((stress(body, f, 0, 0.1, rate) - wanted).norm() < 1e-13 * wanted.norm());
  // a turn of the whole, at any speed, is no strain
  const Matrix3d rotation = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3).matrix();
  Matrix3d spin;
  spin << 0, -3, 2, 3, 0, -1, -2, 1, 0;
  CHECK((stress(body, rotation * f, 0, 0.1, spin * rotation * f) - stress(body, f, 0, 0.1)).norm() <
        1e-13 * wanted.norm());
}

TEST_CASE("each name stands for its springs and dampers") {
  const Matrix3d e = sample_strain(), dev = e - e.trace() / 3 * Matrix3d::Identity(), f = of_strain(e),
                 i = Matrix3d::Identity() * e.trace();
  // at once, and after one step of 0.2 s
  auto check =
      [&](Material material, std::vector<double> const& p, Matrix3d const& now, Matrix3d const& then) {
        INFO(enum_names(Material{})[std::size_t(material)]);
        Body body = of(material, p);
        CHECK((stress(body, f, 0, 0.2) - now).norm() < 1e-13 * now.norm());
        CHECK((stress(body, f, 0.2, 0.2) - then).norm() < 1e-13 * now.norm());
      };
  const double a = std::exp(-0.2 / 0.5), b = std::exp(-0.2 / 3);
  check(Material::MaxwellFirstOrder, {10, 0.5, 7}, 7 * i + 20 * dev, 7 * i + 20 * a * dev);
  check(Material::MaxwellSecondOrder, {10, 0.5, 4, 3, 7}, 7 * i + 28 * dev, 7 * i + (20 * a + 8 * b) * dev);
  check(Material::SLSMaxwellFirstOrder,
        {6, 10, 0.5, 7},
        7 * i + 12 * e + 20 * dev,
        7 * i + 12 * e + 20 * a * dev);
  check(Material::SLSMaxwellSecondOrder,
        {6, 10, 0.5, 4, 3, 7},
        7 * i + 12 * e + 28 * dev,
        7 * i + 12 * e + (20 * a + 8 * b) * dev);
  check(Material::Prony, {6, 7}, 7 * i + 12 * e, 7 * i + 12 * e);
  check(Material::Prony,
        {6, 10, 0.5, 4, 3, 2, 0.5, 7},
        7 * i + 12 * e + 32 * dev,
        7 * i + 12 * e + (24 * a + 8 * b) * dev);
}

TEST_CASE("forces may be asked for again, inside a step and after it: the past is that of whole steps") {
  const double dt = 0.1;
  auto strain = [](double t) { return of_strain(shear_strain(0.3 * t)); };
  Body plain = of(Material::MaxwellFirstOrder, {10, 0.5, 7}), busy = plain;
  for (int n = 0; n < 5; ++n) {
    const double t = n * dt;
    const Matrix3d wanted = stress(plain, strain(t), t, dt);
    // a guess of the end of a step before its true end, as Newton's iterations and Runge-Kutta's stages make
    stress(busy, strain(0.9 * t), t, dt);
    CHECK((stress(busy, strain(t), t, dt) - wanted).norm() < 1e-14);
    for (const double part : {0.5, 0.25, 0.75}) {
      // exact where the strain grows evenly
      const double s = t + part * dt, g = 2 * 10 * 0.3 * 0.5 * (1 - std::exp(-s / 0.5));
      CHECK(stress(busy, strain(s), s, dt)(0, 1) == Approx(g));
    }
  }
  // a step that is tried again from its start
  Body again = busy;
  stress(again, strain(0.5), 0.5, dt);
  CHECK((stress(again, strain(0.45), 0.45, dt) - stress(busy, strain(0.45), 0.45, dt)).norm() < 1e-14);
  // and all from the beginning
  Body fresh = of(Material::MaxwellFirstOrder, {10, 0.5, 7});
  CHECK((stress(busy, strain(0.2), 0, dt) - stress(fresh, strain(0.2), 0, dt)).norm() < 1e-14);
}

TEST_CASE("a body goes on from what was kept of it") {
  auto strain = [](double t) { return of_strain(shear_strain(0.3 * std::sin(t))); };
  Body body = of(Material::Prony, {5, 10, 0.5, 3, 2, 7});
  for (int n = 0; n < 4; ++n) stress(body, strain(0.1 * n), 0.1 * n, 0.1);
  Body kept;
  kept.materialName = body.materialName;
  kept.parameterSet = body.parameterSet;
  boost::hana::for_each(Body::state(), [&](auto const& fd) { kept.*fd.member = body.*fd.member; });
  kept = ready(kept, corners, {.tetrahedra = single});
  for (int n = 4; n < 8; ++n) {
    const Matrix3d a = stress(body, strain(0.1 * n), 0.1 * n, 0.1),
                   b = stress(kept, strain(0.1 * n), 0.1 * n, 0.1);
    CHECK(a == b);
  }
}

TEST_CASE("viscoelastic bodies are checked") {
  auto wrong =
      [&](Material material, std::vector<double> parameters, std::initializer_list<std::string_view> words) {
        one::says([&] { of(material, parameters); }, words);
      };
  wrong(Material::KelvinVoigtFirstOrder,
        {},
        {"body",
         "TetrahedronViscoelasticityFEMForceField<Vec3d>",
         "ParameterSet has 0 values",
         "KelvinVoigtFirstOrder takes G1 tau lambda"});
  wrong(
      Material::SLSMaxwellFirstOrder, {1, 2, 3}, {"3 values", "SLSMaxwellFirstOrder takes G0 G1 tau lambda"});
  wrong(Material::Prony, {1, 2, 3}, {"3 values", "Prony takes G0 [G1 tau1"});
  wrong(Material::MaxwellFirstOrder, {1, 0, 1}, {"tau is not greater than 0", "G1 tau lambda"});
  wrong(Material::MaxwellFirstOrder, {-1, 1, 1}, {"a modulus G is negative"});
  wrong(Material::MaxwellFirstOrder, {0, 1, 1}, {"all moduli G are 0"});
  wrong(Material::SLSMaxwellFirstOrder, {-1, 2, 1, 1}, {"a modulus G is negative"});
  wrong(Material::KelvinVoigtFirstOrder, {1, -1, 1}, {"tau is negative"});
  wrong(Material::KelvinVoigtFirstOrder, {1, 1, -1}, {"lambda is less than -2/3"});
  wrong(Material::Prony, {one::notANumber, 1}, {"ParameterSet[0] is nan", "finite"});

  Body good;
  good.parameterSet = {1, 1, 1};
  refuses(good, corners, {}, {"no tetrahedron", "give the node a topology"});
  const std::vector<Tetrahedron> insideOut{{0, 2, 1, 3}}, far{{0, 1, 2, 4}};
  refuses(good, corners, {.tetrahedra = insideOut}, {"tetrahedron 0 is inside out"});
  refuses(good, corners, {.tetrahedra = far}, {"tetrahedron 0 refers to point 4", "4 points"});
}

}  // namespace test_tetrahedron_viscoelasticity
