// SPDX-License-Identifier: BSL-1.0
#include "beams.hpp"
#include "elastica.hpp"
#include "record.hpp"

#include <numbers>

namespace test_beams_static {

using namespace beams;
using std::numbers::pi;

namespace {

Deriv wrench(Vector3d const& force, Vector3d const& torque = Vector3d::Zero()) {
  Deriv f;
  f << force, torque;
  return f;
}
BeamSection section_of(Beam const& b) { return rectangular_section(b.lengthY, b.lengthZ, b.poissonRatio); }
const Vector3d X = Vector3d::UnitX(), Y = Vector3d::UnitY(), Z = Vector3d::UnitZ();

// 1 m long, 0.06 m x 0.1 m
const Beam stubby{.poissonRatio = 0.3,
                  .youngModulus = 1e6,
                  .crossSectionShape = CrossSectionShape::rectangular,
                  .lengthY = 0.06,
                  .lengthZ = 0.1};

}  // namespace

// The stiffness of an element is exact for loads at its ends: one is as good as many.
TEST_CASE("a cantilever under small loads at its tip has the closed forms of Timoshenko's beam") {
  for (const bool shear : {true, false})
    for (const int n : {1, 7}) {
      INFO("elements " << n << " shear " << shear);
      Beam beam = stubby;
      beam.shearStressComputation = shear;
      const BeamSection s = section_of(beam);
      const double E = 1e6, G = E / 2.6, P = 1e-5;
      const double yield = shear ? P / (s.shear * G * s.area) : 0;
      auto tip = [&](Deriv const& load) { return tip_load(beam, straight(n, 1), load, 1, 1e-13).x.back(); };
      // nonlinear terms: squares of slopes of 1e-5; Newton's tolerance 1e-13 of 1e-6
      CHECK(tip(wrench(P * Y)).center[1] == Approx(P / (3 * E * s.aboutZ) + yield).epsilon(1e-5));
      CHECK(tip(wrench(P * Z)).center[2] == Approx(P / (3 * E * s.aboutY) + yield).epsilon(1e-5));
      CHECK(tip(wrench(1e3 * P * X)).center[0] - 1 == Approx(1e3 * P / (E * s.area)).epsilon(1e-5));
      auto rotation = [&](Vector3d const& torque) {
        return Vector3d(2 * tip(wrench(Vector3d::Zero(), torque)).orientation.vec());
      };
      CHECK(rotation(P * X)[0] == Approx(P / (G * s.torsion)).epsilon(1e-5));
      CHECK(rotation(P * Y)[1] == Approx(P / (E * s.aboutY)).epsilon(1e-5));
      CHECK(rotation(P * Z)[2] == Approx(P / (E * s.aboutZ)).epsilon(1e-5));
      CHECK(tip(wrench(Vector3d::Zero(), P * Z)).center[1] == Approx(P / (2 * E * s.aboutZ)).epsilon(1e-5));
    }
}

// Weight is carried to the frames, half an element each: exact at the frames up to h^2.
TEST_CASE("a cantilever under its weight comes to q L^4 / 8EI with order 2") {
  Beam beam = stubby;
  beam.shearStressComputation = false;
  const double q = 1e-5, exact = q / (8 * 1e6 * section_of(beam).aboutZ);
  double last = 0;
  for (const int n : {4, 8, 16}) {
    Rigid3d::VecDeriv loads(std::size_t(n) + 1, wrench(q / n * Y));
    loads.front() *= 0.5, loads.back() *= 0.5;
    const double error = load(beam, straight(n, 1), loads, 1, 1e-13).x.back().center[1] / exact - 1;
    CHECK(std::abs(error) < 1.0 / (n * n));
    if (last != 0) CHECK(last / error == Approx(4).epsilon(0.02));
    last = error;
  }
}

namespace {

// EI = 1, and so thin that the stretch, a (h/L)^2 / 12 = 3e-7 a, does not count
Beam slender() {
  const double h = 2e-3;
  return {.poissonRatio = 0,
          .youngModulus = 12 / std::pow(h, 4),
          .crossSectionShape = CrossSectionShape::rectangular,
          .lengthY = h,
          .lengthZ = h,
          .shearStressComputation = false};
}

}  // namespace

TEST_CASE("a cantilever bends into the elastica with order 2", "[page]") {
  Record convergence("elastica_convergence", {"load", "h", "error"});
  // values of the paper's table, as they are quoted: 3 digits
  CHECK(elastica::tip(1).deflection == Approx(0.302).margin(5e-4));
  CHECK(elastica::tip(10).deflection == Approx(0.811).margin(5e-4));
  CHECK(elastica::tip(10).reach == Approx(0.445).margin(5e-4));
  // in any direction: the same beam along the turned x axis
  const Eigen::Quaterniond any = Eigen::Quaterniond(0.3, 0.5, -0.4, 0.7).normalized();
  for (const double a : {1.0, 10.0}) {
    const elastica::Tip exact = elastica::tip(a);
    double last = 0;
    for (const int n : {5, 10, 20}) {
      auto x = straight(n, 1);
      for (auto& f : x) f = frame(any * f.center, any);
      const auto bent = tip_load(slender(), x, wrench(any * (a * Y)), 5);
      const Coord tip =
          frame(any.conjugate() * bent.x.back().center, any.conjugate() * bent.x.back().orientation);
      const double angle = 2 * std::atan2(tip.orientation.vec()[2], tip.orientation.w());
      const double error = std::hypot(tip.center[1] - exact.deflection, tip.center[0] - exact.reach);
      INFO("a " << a << " elements " << n << " error " << error << " angle " << angle - exact.angle
                << " iterations " << bent.corrections.size());
      convergence.row(text("PL²/EI = ", a), 1.0 / n, error);
      CHECK(error < 0.06 * a / (n * n));
      CHECK(std::abs(angle - exact.angle) < 0.06 * a / (n * n));
      CHECK(std::abs(tip.center[2]) < 1e-9);
      CHECK(bent.corrections.size() < 40);
      if (last != 0) CHECK(last / error == Approx(4).epsilon(0.15));
      last = error;
    }
  }
}

TEST_CASE("the tip of the elastica from small to large loads, for the page", "[page]") {
  Record curve("elastica", {"coordinate", "load", "tip", "closed form"});
  std::vector<std::array<double, 3>> reach;
  for (const double a : {0.25, 0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0}) {
    if (!Record::wanted() && a != 4) continue;
    const elastica::Tip exact = elastica::tip(a);
    const Vector3d tip = tip_load(slender(), straight(20, 1), wrench(a * Y), 5).x.back().center;
    CHECK(std::hypot(tip[1] - exact.deflection, tip[0] - exact.reach) < 0.06 * a / 400);
    curve.row("across", a, tip[1], exact.deflection);
    reach.push_back({a, tip[0], exact.reach});
  }
  for (auto const& r : reach) curve.row("along", r[0], r[1], r[2]);
}

// M = 2 pi EI / L. Each element turns by 2 pi / n exactly, and stays as long as it was: frames on a circle
// whose chords are L / n.
TEST_CASE("a moment at its tip rolls a beam into a circle") {
  // wide, so that it does not buckle sideways on its way
  Beam beam = slender();
  beam.lengthZ *= 20, beam.youngModulus /= 20;
  for (const int n : {6, 20}) {
    const auto bent = tip_load(beam, straight(n, 1), wrench(Vector3d::Zero(), 2 * pi * Z), 2 * n);
    INFO("iterations " << bent.corrections.size());
    CHECK(bent.x.back().center.norm() < 1e-8);
    CHECK(std::abs(bent.x.back().orientation.w()) == Approx(1).epsilon(1e-12));
    const double radius = 0.5 / n / std::sin(pi / n);
    for (std::size_t i = 0; i < bent.x.size(); ++i) {
      const double angle = 2 * pi * double(i) / n;
      CHECK((bent.x[i].center - radius * Vector3d(std::sin(angle), 1 - std::cos(angle), 0)).norm() < 1e-8);
    }
  }
}

// Bathe & Bolourchi 1979: an eighth of a circle of radius 100, clamped, of unit square cross-section, E =
// 1e7, nu = 0, is pulled out of its plane by 600. Tips in the literature, with 8 straight
// elements: 47.2, 15.9, 53.4 (Bathe & Bolourchi), 47.23, 15.79, 53.37 (Simo & Vu-Quoc
// 1986), 46.84, 15.61, 53.71 (Crisfield 1990).
TEST_CASE("a bent beam pulled out of its plane comes to where the literature has it", "[page]") {
  Record table("bent_beam", {"who", "x", "y", "z"});
  table.row("Bathe and Bolourchi 1979, 8", 47.2, 15.9, 53.4);
  table.row("Simo and Vu-Quoc 1986, 8", 47.23, 15.79, 53.37);
  table.row("Crisfield 1990, 8", 46.84, 15.61, 53.71);
  Vector3d tip[3];
  for (const int k : {0, 1, 2}) {
    const int n = 8 << k;
    Rigid3d::VecCoord x;
    for (int i = 0; i <= n; ++i) {
      const double angle = pi / 4 * i / n;
      x.push_back(frame({100 * std::sin(angle), 100 * (1 - std::cos(angle)), 0},
                        Eigen::Quaterniond(Eigen::AngleAxisd(angle, Z))));
    }
    Beam beam = stubby;
    beam.poissonRatio = 0, beam.youngModulus = 1e7, beam.lengthY = beam.lengthZ = 1;
    const auto bent = tip_load(beam, x, wrench(600 * Z), 6);
    INFO(bent.x.back().center.transpose() << " iterations " << bent.corrections.size());
    CHECK((bent.x.back().center - Vector3d(47.0, 15.7, 53.5)).norm() < 0.3);
    CHECK(bent.corrections.size() < 10);
    tip[k] = bent.x.back().center;
    table.row(text("BeamFEMForceField, ", n), tip[k][0], tip[k][1], tip[k][2]);
  }
  CHECK((tip[1] - tip[0]).norm() / (tip[2] - tip[1]).norm() == Approx(4).epsilon(0.1));
}

// near the equilibrium the symmetric tangent is the whole one: dead loads are conservative
TEST_CASE("Newton's method converges quadratically on a bent beam") {
  const auto bent = tip_load(slender(), straight(10, 1), wrench(3 * Y), 3, 1e-11);
  auto const& c = bent.corrections;
  INFO(Catch::Detail::stringify(c));
  REQUIRE(c.size() >= 5);
  CHECK(c.size() <= 10);
  // bending and stretch take turns to be out of balance: two iterations square the correction
  for (std::size_t i = 4; i < c.size(); ++i) CHECK(c[i] < 2 * std::pow(c[i - 2], 2) + 1e-10);
}

}  // namespace test_beams_static
