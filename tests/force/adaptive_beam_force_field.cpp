// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <Eigen/Eigenvalues>
#include <numbers>

namespace test_adaptive_beam_force_field {

using namespace sinew;
using Eigen::MatrixXd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using frames::frame;
using frames::moved;
using frames::wave;
using one::force;
using one::product;
using one::ready;
using one::refuses;
using std::numbers::pi;
using Rod = AdaptiveBeamForceField<Rigid3d>;
using Mass = AdaptiveBeamMass<Rigid3d>;
using VecCoord = Rigid3d::VecCoord;
using VecDeriv = Rigid3d::VecDeriv;
using Deriv = Rigid3d::Deriv;

namespace {

// 1 m long, of 4 mm
const RodSection wire{.length = 1,
                      .youngModulus = 2e9,
                      .poissonRatio = 0.25,
                      .massDensity = 1000,
                      .radius = 2e-3,
                      .nbBeams = 8};
const BeamSection round = circular_section(2e-3, 0, 0.25);
const double EI = 2e9 * round.aboutY, GJ = 8e8 * round.torsion, line = 1000 * round.area;

/// The frames of beams at rest, the first at the origin.
VecCoord at_rest(std::vector<RodBeam> const& beams) {
  VecCoord x{frame({0, 0, 0})};
  for (RodBeam const& b : beams) {
    auto const& last = x.back();
    x.push_back(frame(last.center + last.orientation * b.chord, Quaterniond(last.orientation * b.turn())));
  }
  return x;
}
std::vector<RodBeam> beams_of(RodSection section, int n) {
  section.nbBeams = n;
  return rod_beams("wire", {section});
}
Rod rod(std::vector<RodBeam> const& beams, bool shear = false) {
  return ready(Rod{.interpolation = beams, .shearStressComputation = shear}, at_rest(beams));
}
Mass mass_of(std::vector<RodBeam> const& beams, bool shear = false) {
  return ready(Mass{.interpolation = beams, .shearStressComputation = shear}, at_rest(beams));
}
/// The matrix of f(dx), without the first frame.
template <class F>
MatrixXd matrix(std::size_t frames, F&& f) {
  const long n = long(6 * frames);
  MatrixXd m(n, n);
  for (long j = 0; j < n; ++j) {
    VecDeriv dx(frames, Deriv::Zero());
    dx[std::size_t(j / 6)][j % 6] = 1;
    const VecDeriv r = f(dx);
    for (long i = 0; i < n; ++i) m(i, j) = r[std::size_t(i / 6)][i % 6];
  }
  return m.bottomRightCorner(n - 6, n - 6);
}
MatrixXd stiffness(Rod& c, VecCoord const& x) {
  force(c, x);
  return matrix(x.size(), [&](VecDeriv const& dx) { return product(c, dx, -1, 0); });
}
MatrixXd mass(Mass const& c, VecCoord const& x) {
  return matrix(x.size(), [&](VecDeriv const& dx) {
    VecDeriv f(dx.size(), Deriv::Zero());
    c.addMDx(f, x, dx, 1);
    return f;
  });
}

auto scene(std::vector<RodBeam> const& beams, VecCoord const& x, Deriv const& tip, Vector3d const& gravity,
           double damping) {
  return Simulation{node<"root">(Gravity{gravity},
                                 EulerImplicitSolver{.rayleighStiffness = damping},
                                 SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                 MechanicalObject<Rigid3d>{.position = x},
                                 Rod{.interpolation = beams},
                                 Mass{.interpolation = beams},
                                 ConstantForceField<Rigid3d>{.indices = {int(beams.size())}, .forces = {tip}},
                                 FixedConstraint<Rigid3d>{.indices = {0}})};
}
/// At rest after steps so long that each is all but one of Newton's method.
VecCoord settled(std::vector<RodBeam> const& beams, VecCoord const& x, Deriv const& tip,
                 Vector3d const& gravity = {0, 0, 0}, double dt = 10, int steps = 200) {
  auto sim = scene(beams, x, tip, gravity, 0);
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
  auto const& v = sim.root().state().velocity;
  for (auto const& one : v) CHECK(one.norm() < 1e-9);
  return sim.root().state().position;
}

}  // namespace

// A helix of radius r and rise 2 pi c has the curvature r / (r^2 + c^2) and the torsion c / (r^2 + c^2): the
// frames of its beams are on it, at equal angles, and its own axes turn by their norm along the length.
TEST_CASE("a section that is a helix has its frames at rest on it") {
  const double r = 0.05, c = 0.01, length = 0.4;
  const int n = 10;
  const auto beams = rod_beams(
      "wire",
      {{.length = length, .radius = 1e-3, .nbBeams = n, .spireDiameter = 2 * r, .spireHeight = 2 * pi * c}});
  const VecCoord x = at_rest(beams);
  const double step = length / n / std::hypot(r, c);
  for (int i = 0; i < n; ++i) {
    CHECK((x[std::size_t(i) + 1].center - x[std::size_t(i)].center).norm() ==
          Approx(std::hypot(2 * r * std::sin(step / 2), c * step)));
    // the screw that takes a frame to the next turns by `step`
    CHECK(Eigen::AngleAxisd(beams[std::size_t(i)].turn()).angle() == Approx(step));
  }
  const Vector3d axis = Eigen::AngleAxisd(beams[0].turn()).axis();
  CHECK(std::abs(axis.dot(Vector3d::UnitX())) == Approx(c / std::hypot(r, c)));
  CHECK(beams[0].length == Approx(length / n));
  const double rise = (x.back().center - x[0].center).dot(axis);
  CHECK(std::abs(rise) == Approx(c * n * step));
  // it starts along x and bends towards -z
  CHECK(x[1].center[2] < 0);
}

TEST_CASE("a rod is stiff as its section is, and a helix at rest has no forces") {
  const auto straight = beams_of(wire, 4);
  Rod c = rod(straight);
  VecCoord x = at_rest(straight);
  CHECK(potential_energy(c, x) == 0);
  for (std::size_t i = 0; i < x.size(); ++i) x[i].center[0] *= 1.001;
  CHECK(potential_energy(c, x) == Approx(2e9 * round.area * 1e-6 / 2));
  RodSection curl = wire;
  curl.spireDiameter = 0.3, curl.spireHeight = 0.05;
  Rod curled = rod(beams_of(curl, 8));
  const auto f = force(curled, at_rest(curled.interpolation));
  for (auto const& one : f) CHECK(one.norm() < 1e-9);
  CHECK(potential_energy(curled, at_rest(curled.interpolation)) < 1e-20);
}

TEST_CASE(
    "internal forces of a rod that is curved at rest keep momentum, and their tangent is their derivative") {
  RodSection curl = wire;
  curl.spireDiameter = 0.3, curl.spireHeight = 0.05;
  for (const bool shear : {false, true}) {
    Rod c = rod(beams_of(curl, 3), shear);
    const VecCoord x = moved(at_rest(c.interpolation), wave(4, 0.1, 3));
    const auto f = force(c, x);
    Vector3d sum(0, 0, 0), turning(0, 0, 0);
    double size = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      sum += f[i].head<3>();
      turning += x[i].center.cross(f[i].head<3>()) + f[i].tail<3>();
      size += f[i].norm();
    }
    CHECK(sum.norm() < 1e-13 * size);
    CHECK(turning.norm() < 1e-13 * size);
    for (int trial = 0; trial < 3; ++trial) {
      const double h = 1e-6;
      const auto dx = wave(4, 1, trial);
      const VecCoord plus = moved(x, dx, h), minus = moved(x, dx, -h);
      double work = 0;
      for (std::size_t i = 0; i < x.size(); ++i) work += f[i].dot(dx[i]);
      // energies of order E A / 100, of which 1e-16 is lost over 2e-6, and truncation of the order h^2
      CHECK(work == Approx((potential_energy(c, minus) - potential_energy(c, plus)) / (2 * h)).epsilon(1e-6));
      const auto ahead = force(c, plus), back = force(c, minus);
      force(c, x);
      const auto df = product(c, dx, 1, 0);
      double slope = 0, tangent = 0;
      for (std::size_t i = 0; i < x.size(); ++i) {
        slope += dx[i].dot(ahead[i] - back[i]) / (2 * h);
        tangent += dx[i].dot(df[i]);
      }
      CHECK(tangent == Approx(slope).epsilon(1e-6));
    }
  }
}

TEST_CASE("a rod has the mass, the inertia and the weight of a bar") {
  const auto beams = beams_of(wire, 4);
  const Mass c = mass_of(beams);
  const VecCoord x = at_rest(beams);
  const double m = line;
  auto rigid = [&](Vector3d const& u, Vector3d const& w) {
    VecDeriv v(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) v[i] << u + w.cross(x[i].center), w;
    return v;
  };
  CHECK(c.kineticEnergy(x, rigid({1, 2, 3}, {0, 0, 0})) == Approx(7 * m));
  // m L^2 / 3 about its end, and the rotary inertia of its sections
  CHECK(c.kineticEnergy(x, rigid({0, 0, 0}, {0, 2, 0})) == Approx(2 * (m / 3 + 1000 * round.aboutY)));
  CHECK(c.kineticEnergy(x, rigid({0, 0, 0}, {2, 0, 0})) == Approx(2 * 1000 * round.torsion));
  // whatever its axes, and with shear too
  const Quaterniond q = Quaterniond(0.3, 0.5, -0.4, 0.7).normalized();
  VecCoord turned = x;
  for (auto& one : turned) one = frame(q * one.center, Quaterniond(q * one.orientation));
  auto v = rigid({0, 0, 0}, {0, 2, 0});
  for (auto& one : v) one << q * one.head<3>(), q * one.tail<3>();
  CHECK(mass_of(beams, true).kineticEnergy(turned, v) == Approx(2 * (m / 3 + 1000 * round.aboutY)));
  VecDeriv f(x.size(), Deriv::Zero());
  MechanicalParams p;
  p.gravity = {0, 0, -10};
  c.addForce(p, f, x, VecDeriv(x.size(), Deriv::Zero()));
  Vector3d sum(0, 0, 0), turning(0, 0, 0);
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += f[i].head<3>(), turning += x[i].center.cross(f[i].head<3>()) + f[i].tail<3>();
  CHECK((sum - Vector3d(0, 0, -10 * m)).norm() < 1e-14);
  CHECK((turning - Vector3d(0, 5 * m, 0)).norm() < 1e-14);
}

// w = (1.875 / L)^2 sqrt(EI / r A), and the next ones; rotary inertia adds I k^2 / A to the mass, of which
// the whole is 1e-4 at most. The errors of the cubic beam with its consistent mass are (k h)^4 / 720 and a
// little more.
TEST_CASE("a clamped rod swings at the frequencies of the closed form, with errors of order 4") {
  auto frequencies = [](int n) {
    RodSection thin = wire;
    thin.radius = 2e-4;
    const auto beams = beams_of(thin, n);
    Rod c = rod(beams);
    const VecCoord x = at_rest(beams);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(
        stiffness(c, x), mass(mass_of(beams), x), Eigen::EigenvaluesOnly);
    std::vector<double> w;
    // each twice, in both planes
    for (int k = 0; k < 3; ++k) w.push_back(std::sqrt(solver.eigenvalues()[2 * k]));
    return w;
  };
  const BeamSection thin = circular_section(2e-4, 0, 0.25);
  const auto coarse = frequencies(4), fine = frequencies(8);
  const double k[]{1.87510407, 4.69409113, 7.85475744};
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = k[i] * k[i] * std::sqrt(2e9 * thin.aboutY / (1000 * thin.area));
    const double e = coarse[i] / exact - 1, f = fine[i] / exact - 1;
    INFO(i << " " << e << " " << f);
    CHECK(std::abs(f) < 2 * std::pow(k[i] / 8, 4) / 720);
    // the first ends in the rotary inertia, and four beams are few for the third
    if (i == 1) CHECK(e / f == Approx(16).epsilon(0.2));
  }
}

// The load P of Euler, pi^2 EI / 4 L^2, above which the stiffness of a clamped rod that it presses is no
// longer positive. The beams are cubic within straight chords: their error is of order (k h)^2.
TEST_CASE("a pressed rod buckles at Euler's load") {
  const double euler = pi * pi * EI / 4;
  auto critical = [&](int n) {
    const auto beams = beams_of(wire, n);
    Rod c = rod(beams);
    double low = 0.8 * euler, high = 1.2 * euler;
    for (int i = 0; i < 40; ++i) {
      const double load = (low + high) / 2;
      VecCoord x = at_rest(beams);
      for (auto& one : x) one.center[0] *= 1 - load / (2e9 * round.area);
      const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(stiffness(c, x), Eigen::EigenvaluesOnly);
      (solver.eigenvalues()[0] > 0 ? low : high) = load;
    }
    return low / euler - 1;
  };
  const double coarse = critical(4), fine = critical(8);
  INFO(coarse << " " << fine);
  // and the rod is shorter then by P / EA = 2.5e-6
  CHECK(std::abs(fine) < std::pow(pi / 2 / 8, 2) / 6);
  CHECK(coarse / fine == Approx(4).epsilon(0.1));
}

// FL^3 / 3EI + FL / kGA, to the square of the slope, and its weight w L^4 / 8 EI; a torque turns it by TL /
// GJ.
TEST_CASE("a rod bends and twists as the closed forms say") {
  const auto beams = beams_of(wire, 8);
  const VecCoord x = at_rest(beams);
  Deriv tip = Deriv::Zero();
  tip[1] = 1e-5;
  const VecCoord bent = settled(beams, x, tip);
  const double shear = tip[1] / (round.shear * 8e8 * round.area);
  CHECK(bent.back().center[1] == Approx(tip[1] / (3 * EI) + shear).epsilon(1e-6));
  CHECK(2 * bent.back().orientation.z() == Approx(tip[1] / (2 * EI)).epsilon(1e-6));
  tip.setZero();
  tip[3] = 0.1 * GJ;
  const VecCoord twisted = settled(beams, x, tip);
  for (std::size_t i = 0; i < x.size(); ++i)
    CHECK(2 * std::asin(twisted[i].orientation.x()) == Approx(0.1 * double(i) / 8).margin(1e-10));
  const VecCoord sagged = settled(beams, x, Deriv::Zero(), {0, 0, -1e-3});
  CHECK(sagged.back().center[2] ==
        Approx(-line * 1e-3 * (1 / (8 * EI) + 1 / (2 * round.shear * 8e8 * round.area))).epsilon(1e-5));
}

// A rod with the curvature 1/R at rest becomes an arc of the angle L/R: here three quarters of a circle, from
// straight.
TEST_CASE("a rod with a curvature at rest curls to its circle") {
  const double R = 1 / (1.5 * pi);
  RodSection curl = wire;
  curl.spireDiameter = 2 * R;
  const auto beams = beams_of(curl, 12);
  const VecCoord x = settled(beams, at_rest(beams_of(wire, 12)), Deriv::Zero(), {0, 0, 0}, 0.05, 2000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double angle = 1.5 * pi * double(i) / 12;
    CHECK((x[i].center - Vector3d(R * std::sin(angle), 0, R * (std::cos(angle) - 1))).norm() < 1e-8);
  }
  CHECK((x.back().center - Vector3d(0, 0, -R)).norm() == Approx(R));
}

TEST_CASE("a rod that is free keeps its momentum, and spins as a rigid bar does") {
  const auto beams = beams_of(wire, 4);
  auto sim = Simulation{node<"root">(EulerImplicitSolver{},
                                     SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                     MechanicalObject<Rigid3d>{.position = at_rest(beams)},
                                     Rod{.interpolation = beams},
                                     Mass{.interpolation = beams})};
  sim.init();
  auto& s = sim.root().state();
  const Vector3d w(0, 0, 0.2), middle(0.5, 0, 0), drift(0.1, 0.2, 0.3);
  for (std::size_t i = 0; i < s.size(); ++i)
    s.velocity[i] << drift + w.cross(s.position[i].center - middle), w;
  for (int i = 0; i < 1000; ++i) sim.animate(0.001);
  Vector3d center(0, 0, 0);
  for (std::size_t i = 0; i < s.size(); ++i) center += s.position[i].center / double(s.size());
  CHECK((center - middle - drift).norm() < 1e-9);
  // in an implicit step it grows longer by (w h)^2 / 2, and the force of that, EA times it, takes
  // h^2 EA (w h)^2 / 2 L w of the angular momentum m L^2 / 12 w: 5e-7 a step
  const double angle = Eigen::AngleAxisd(s.position[2].orientation).angle();
  CHECK(angle == Approx(0.2).epsilon(5e-4));
  CHECK(sim.kineticEnergy() ==
        Approx(line * drift.squaredNorm() / 2 + 0.02 * (line / 12 + 1000 * round.aboutY)).epsilon(1e-3));
}

TEST_CASE("rods that cannot be are refused") {
  const auto beams = beams_of(wire, 2);
  const VecCoord x = at_rest(beams);
  refuses(Rod{}, x, {}, {"body", "AdaptiveBeamForceField<Rigid3d>", "no beams", "WireBeamInterpolation"});
  refuses(Rod{.interpolation = beams}, at_rest(beams_of(wire, 3)), {}, {"2 beams for 3 edges", "3 frames"});
  refuses(Mass{.interpolation = beams, .massDensity = {1, 2, 3}}, x, {}, {"massDensity has 3"});
  refuses(Mass{.interpolation = beams, .massDensity = {-1}}, x, {}, {"massDensity[0] is -1"});
  TopologyView wrong;
  const std::vector<Edge> edges{{0, 1}, {1, 7}}, loose{{0, 1}, {0, 1}};
  wrong.edges = edges;
  refuses(Rod{.interpolation = beams}, x, wrong, {"edge 1 refers to point 7"});
  wrong.edges = loose;
  refuses(Mass{.interpolation = beams}, x, wrong, {"frame 2 is the end of no beam"});
  auto broken = beams;
  broken[1].youngModulus = one::notANumber;
  refuses(Rod{.interpolation = broken}, x, {}, {"interpolation[1].youngModulus is nan"});
  broken = beams;
  broken[0].chord.setZero();
  refuses(Rod{.interpolation = broken}, x, {}, {"beam 0", "one place at rest"});
  one::says([] { rod_beams("wire", {}); }, {"wire", "no section", "RodStraightSection"});
  one::says([] { rod_beams("wire", {{.radius = 1, .innerRadius = 1}}); },
            {"radiusInner is 1 m", "less than radius"});
  one::says([] { rod_beams("wire", {{.length = 10, .nbBeams = 2, .spireDiameter = 0.1}}); },
            {"turns at rest", "nbBeams"});
}

}  // namespace test_adaptive_beam_force_field
