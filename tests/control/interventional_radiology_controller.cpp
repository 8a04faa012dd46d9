// SPDX-License-Identifier: BSL-1.0
#include "curved_wire.hpp"
#include "error_of.hpp"
#include "one_component.hpp"

#include <sinew/control/interventional_radiology_controller.hpp>
#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

#include <numbers>

namespace test_interventional_radiology_controller {

using namespace sinew;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::numbers::pi;
using Controller = InterventionalRadiologyController<Rigid3d>;
using Frames = Rigid3d::VecCoord;

namespace {

auto alone(Controller const& controller) {
  const auto shape = curved_wire();
  Controller own = controller;
  own.instruments = shape.beams;
  return Simulation{node<"root">(EulerImplicitSolver{.rayleighStiffness = 0.02},
                                 SparseLDLSolver<CompressedRowSparseMatrixd>{},
                                 MechanicalObject<Rigid3d>{.position = Frames(16, Rigid3d::zero())},
                                 AdaptiveBeamForceField<Rigid3d>{.interpolation = shape.beams},
                                 AdaptiveBeamMass<Rigid3d>{.interpolation = shape.beams},
                                 own)};
}
double length_of(Frames const& x) {
  double length = 0;
  for (std::size_t i = 1; i < x.size(); ++i) length += (x[i].center - x[i - 1].center).norm();
  return length;
}
/// How far a frame is from where the beam before it has it at rest [m, and half of the rad].
double strain(Frames const& x, std::vector<RodBeam> const& beams, std::size_t i) {
  const Quaterniond turn = beams[i - 1].turn();
  return (x[i - 1].orientation.conjugate() * (x[i].center - x[i - 1].center) - beams[i - 1].chord).norm() +
         ((x[i - 1].orientation * turn).conjugate() * x[i].orientation).vec().norm();
}

}  // namespace

TEST_CASE("a wire is pushed out of its sheath, keeps its length, and its tip curls as it comes out") {
  const auto shape = curved_wire();
  Rigid3d::Coord start = Rigid3d::zero();
  start.center = {0.1, 0.2, 0.3};
  start.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
  auto sim = alone({.startingPos = start, .speed = 0.1});
  sim.init();
  auto const& x = sim.root().state().position;
  auto& controller = sim.root().get<Controller>();
  const Vector3d along = start.orientation * Vector3d::UnitX();
  // in chords: those of the tip are shorter than their arcs by 1 - sin(0.2)/0.2 = 7e-3
  const double whole = controller.length();
  CHECK(whole == Approx(0.2 + 0.04 * std::sin(0.2) / 0.2));
  for (int i = 1; i <= 100; ++i) {
    sim.animate(0.01);
    CHECK(controller.xtip == Approx(0.001 * i));
    for (std::size_t k = 0; k < controller.held; ++k) {
      const double at = controller.abscissas[k] - whole + 0.001 * i;
      CHECK(at < 1e-9);
      CHECK((x[k].center - start.center - at * along).norm() < 1e-14);
      CHECK((sim.root().state().velocity[k].head<3>() - 0.1 * along).norm() < 1e-12);
    }
    CHECK(controller.abscissas[std::min<std::size_t>(controller.held, 15)] - whole + 0.001 * i >
          (controller.held < 16 ? 0 : -1));
    // chords that turn by the angle a in a step grow by a^2 / 2 of it, which a stiff beam takes back in the
    // next: the tip springs out by 0.02 rad in a step
    CHECK(length_of(x) == Approx(whole).epsilon(3e-4));
  }
  controller.speed = 0;
  for (int i = 0; i < 400; ++i) sim.animate(0.01);
  // with 0.1 m out nothing loads what is beyond the beam across the end of the sheath
  CHECK(controller.held == 7);
  CHECK(length_of(x) == Approx(whole).epsilon(1e-8));
  for (std::size_t i = controller.held; i < 16; ++i) CHECK(strain(x, shape.beams, i) < 1e-6);
  // the tip, turned by half a turn, is on the other side
  const Vector3d before = start.orientation.conjugate() * (x.back().center - start.center);
  CHECK(before[2] < -0.01);
  for (int i = 0; i < 20; ++i) {
    controller.turn(1);
    sim.animate(0.01);
  }
  for (int i = 0; i < 400; ++i) sim.animate(0.01);
  const Vector3d after = start.orientation.conjugate() * (x.back().center - start.center);
  CHECK((after - Vector3d(before[0], -before[1], -before[2])).norm() < 1e-6);
  // drawn back, it is straight in the sheath, as it was
  controller.speed = -0.1;
  for (int i = 0; i < 120; ++i) sim.animate(0.01);
  CHECK(controller.xtip == 0);
  CHECK(controller.held == 16);
  for (std::size_t k = 0; k < 16; ++k)
    CHECK((x[k].center - start.center - (controller.abscissas[k] - whole) * along).norm() < 1e-12);
}

TEST_CASE("a wire that starts with a part out starts as it rests, and after a reset goes the same way") {
  const auto shape = curved_wire();
  auto sim = alone({.xtip = 0.08, .speed = 0.05});
  sim.init();
  auto const& x = sim.root().state().position;
  sim.animate(1e-6);
  for (std::size_t i = sim.root().get<Controller>().held; i < 16; ++i)
    CHECK(strain(x, shape.beams, i) < 1e-6);
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  const Frames first = x;
  sim.reset();
  sim.animate(1e-6);
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  for (std::size_t i = 0; i < 16; ++i) {
    CHECK(x[i].center == first[i].center);
    CHECK(x[i].orientation.coeffs() == first[i].orientation.coeffs());
  }
}

TEST_CASE("wires that cannot be pushed are refused") {
  const auto shape = curved_wire();
  const Frames x(16, Rigid3d::zero());
  auto refuses = [&](Controller c, Frames const& frames, std::initializer_list<std::string_view> words) {
    one::refuses(c, frames, {}, words);
  };
  refuses({}, x, {"InterventionalRadiologyController<Rigid3d>", "no wire", "WireBeamInterpolation"});
  refuses({.instruments = shape.beams}, Frames(3, Rigid3d::zero()), {"15 beams", "3 frames", "nx=\"16\""});
  refuses({.instruments = shape.beams, .xtip = 1}, x, {"xtip is 1 m", "0.2397"});
  refuses({.instruments = shape.beams, .xtip = -1}, x, {"xtip is -1 m"});
  refuses({.instruments = shape.beams, .speed = one::notANumber}, x, {"speed is nan"});
  Rigid3d::Coord start = Rigid3d::zero();
  start.orientation.coeffs().setZero();
  refuses({.instruments = shape.beams, .startingPos = start}, x, {"orientation of startingPos is zero"});
}

}  // namespace test_interventional_radiology_controller
