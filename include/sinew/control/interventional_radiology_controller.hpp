// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <algorithm>
#include <numbers>
#include <vector>

namespace sinew {

/// Pushes a wire through the point where it is inserted, and turns it. The wire behind that point is in a
/// straight sheath along the x axis of startingPos, without play or friction: frames in there are held, frame
/// i at
///   c + (s_i - L + xtip) R e_x,   R = (orientation of startingPos) (rotation by rotationInstrument about x)
/// where s_i is how far along the wire, of the length L, it is, in chords of its beams at rest, which are
/// what keeps its length, c is the place of startingPos, and xtip how much of the wire is out. They move with
/// it as a projective constraint has it; a frame that comes out is free, and one that is drawn back is held
/// again, from the step on in which it passes the point. The beam across the point bends as if it were
/// clamped at its frame behind it: the sheath ends within the length of one beam.
///
/// Beams keep their lengths at rest, so that the wire keeps its own. In the first step frames are put into
/// the sheath, and those that are out already along the shape at rest from there, unless they stand in the
/// sheath and apart from each other beyond it. (In SOFA all frames that are in are at startingPos, and the
/// first beam grows longer at rest while the wire is pushed.)
template <class D>
struct InterventionalRadiologyController {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: InterventionalRadiologyController is for frames in space (Rigid3d).");
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "InterventionalRadiologyController";
  static constexpr bool actsBeforeStep = true;

  std::vector<RodBeam> instruments{};
  double xtip = 0, rotationInstrument = 0;
  Coord startingPos = D::zero();
  double speed = 0, step = 0.1, angularStep = std::numbers::pi / 20;
  int indexFirstNode = 0;

  static constexpr auto fields() {
    using C = InterventionalRadiologyController;
    return field_list(
        field(
            "instruments", &C::instruments, "", "the beams of the wire, those of its WireBeamInterpolation"),
        field("xtip", &C::xtip, "m", "how much of the wire is out", range::nonNegative).whileRunning(),
        field(
            "rotationInstrument", &C::rotationInstrument, "rad", "by which the wire is turned in the sheath")
            .whileRunning(),
        field("startingPos",
              &C::startingPos,
              "m",
              "where the wire is inserted; the wire is along x of the frame"),
        field("speed", &C::speed, "m/s", "with which it is pushed, or, below 0, drawn back").whileRunning(),
        field("step", &C::step, "m", "of push(), on a key", range::positive),
        field("angularStep", &C::angularStep, "rad", "of turn(), on a key", range::positive),
        field("indexFirstNode",
              &C::indexFirstNode,
              "",
              "the last frame that is held, as the controller says it",
              range::nonNegative));
  }

  /// Pushes the wire by so many steps, or draws it back.
  void push(double steps) { xtip = std::clamp(xtip + steps * step, 0.0, length()); }
  /// Turns it by so many angular steps.
  void turn(double steps) { rotationInstrument += steps * angularStep; }

  std::vector<double> abscissas{};  // s_i
  std::size_t held = 0;             // frames, from the first on
  double from = 0, to = 0;          // xtip at the begin and the end of the step
  double fromAngle = 0, toAngle = 0;
  double begin = 0, dt = 0;  // of the step
  double firstTip = 0, firstAngle = 0;
  bool placed = false;  // frames are where they start

  static constexpr auto state() {
    using C = InterventionalRadiologyController;
    return field_list(field("xtip", &C::xtip, "m", "how much of the wire is out"),
                      field("rotationInstrument", &C::rotationInstrument, "rad", "by which it is turned"),
                      field("to", &C::to, "m", "how much was out at the end of the step"),
                      field("toAngle", &C::toAngle, "rad", "by which it was turned then"),
                      field("placed", &C::placed, "", "frames were put to where they start"));
  }

  double length() const { return abscissas.empty() ? 0 : abscissas.back(); }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<InterventionalRadiologyController>());
    if (instruments.empty())
      throw Error(where, "there is no wire; give instruments the beams of a WireBeamInterpolation");
    check_beams(where, instruments);
    if (context.rest.size() != instruments.size() + 1)
      throw Error(where,
                  text("the wire has ",
                       instruments.size(),
                       " beams, but the state has ",
                       context.rest.size(),
                       " frames; give it ",
                       instruments.size() + 1,
                       ", as RegularGridTopology does with nx=\"",
                       instruments.size() + 1,
                       "\""));
    abscissas.assign(1, 0.0);
    for (RodBeam const& beam : instruments) abscissas.push_back(abscissas.back() + beam.chord.norm());
    if (!(xtip <= length()))
      throw Error(where, text("xtip is ", xtip, " m, but the wire is ", length(), " m long; lower it"));
    const double norm = double(startingPos.orientation.norm());
    if (!(norm > 1e-6))
      throw Error(where, "the orientation of startingPos is zero; give a quaternion of length 1");
    startingPos.orientation.normalize();
    firstTip = xtip, firstAngle = rotationInstrument;
    reset();
  }
  void reset() {
    from = to = xtip = firstTip;
    fromAngle = toAngle = rotationInstrument = firstAngle;
    begin = dt = 0;
    placed = false;
    hold();
  }

  template <class State>
  bool beginStep(StepAhead const& ahead, State& state) {
    if (!placed) start(state.position);
    placed = true;
    begin = ahead.begin, dt = ahead.dt;
    from = to, fromAngle = toAngle;
    to = xtip = std::clamp(xtip + speed * dt, 0.0, length());
    toAngle = rotationInstrument;
    hold();
    projectVelocity(ahead.begin, state.velocity);
    return true;
  }

  void projectResponse(VecDeriv& dx) const {
    for (std::size_t i = 0; i < held; ++i) dx[i].setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    for (std::size_t i = 0; i < held; ++i) sink.fix(int(i));
  }
  void projectPosition(double time, VecCoord& x) const {
    if (!placed) return;
    const double part = dt > 0 ? std::clamp((time - begin) / dt, 0.0, 1.0) : 1;
    place(x, from + part * (to - from), fromAngle + part * (toAngle - fromAngle));
  }
  void projectVelocity(double, VecDeriv& v) const {
    if (!placed) return;
    const Vec<Real, 3> along = startingPos.orientation * Vec<Real, 3>::UnitX();
    Deriv rate = Deriv::Zero();
    if (dt > 0) rate << Real((to - from) / dt) * along, Real((toAngle - fromAngle) / dt) * along;
    for (std::size_t i = 0; i < held; ++i) v[i] = rate;
  }

 private:
  // the frames that are in at the end of the step; sums of lengths miss the whole by rounding
  void hold() {
    const double inside = length() - to + 1e-9 * length();
    held = std::size_t(std::upper_bound(abscissas.begin(), abscissas.end(), inside) - abscissas.begin());
    indexFirstNode = int(held) - 1;
  }
  void place(VecCoord& x, double out, double angle) const {
    const Quat<Real> turned =
        startingPos.orientation * Quat<Real>(Eigen::AngleAxis<Real>(Real(angle), Vec<Real, 3>::UnitX()));
    for (std::size_t i = 0; i < held; ++i) {
      x[i].center = inSheath(i, out);
      x[i].orientation = turned;
    }
  }
  Vec<Real, 3> inSheath(std::size_t i, double out) const {
    return startingPos.center +
           startingPos.orientation * Vec<Real, 3>(Real(abscissas[i] - length() + out), Real(0), Real(0));
  }
  // puts frames to where they may start, unless they stand so
  void start(VecCoord& x) const {
    bool stands = true;
    for (std::size_t i = 0; i < held; ++i)
      stands = stands && (x[i].center - inSheath(i, to)).norm() <= Real(1e-6 * length());
    for (std::size_t i = held; i < x.size(); ++i)
      stands = stands && (x[i].center - x[i - 1].center).norm() > Real(0.1 * instruments[i - 1].length);
    if (stands) return;
    place(x, to, toAngle);
    for (std::size_t i = held; i < x.size(); ++i) {
      Coord const& last = x[i - 1];
      RodBeam const& beam = instruments[i - 1];
      x[i].center = last.center + last.orientation * beam.chord.template cast<Real>();
      x[i].orientation = last.orientation * beam.turn().template cast<Real>();
    }
  }
};

}  // namespace sinew
