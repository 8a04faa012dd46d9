// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/control/trajectory.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/placement.hpp>
#include <sinew/io/state_file.hpp>

#include <vector>

namespace sinew {

/// Moves all points of a state as recorded in a file (that of a WriteState, here or of SOFA), or as given at
/// key times in the scene: a tool that replays a movement, say.
///
/// A state that no ODE solver moves is put, before the solvers of other bodies work, where it is at the end
/// of the step, with the velocity that it arrives with; springs to it and what is mapped from it are there in
/// that step. It rests at the first key until its time comes, and at the last one after that. (SOFA, at the
/// beginning of a step, takes what is recorded for that time: `atBegin`.)
///
/// A state under an ODE solver is held as by a projective constraint from the first time to the last, and is
/// free before and after: a file with the one time 0 is where it starts.
///
/// Frames at the times of steps are taken bit by bit: with velocities in the file, the replay of a movement
/// gives the bits of the run that was recorded.
template <class D>
struct ReadState {
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ReadState";
  static constexpr bool actsBeforeStep = true, movesState = true;

  DataFile filename{};
  double interval = 0, shift = 0;
  bool loop = false;
  double scalePos = 1;
  Eigen::Vector3d rotation{0, 0, 0}, translation{0, 0, 0};
  std::vector<double> keyTimes{};
  VecCoord keyPositions{};
  VecDeriv keyVelocities{};
  Interpolation interpolation = Interpolation::linear;
  bool atBegin = false, allowTruncated = false;

  static constexpr auto fields() {
    using F = ReadState;
    return field_list(
        field("filename", &F::filename, "", "file of the recorded states, as text or binary; or none"),
        field(
            "interval", &F::interval, "s", "time between keys, where no times are given", range::nonNegative),
        field("shift", &F::shift, "s", "time of the trajectory at time 0 of the scene"),
        field("loop", &F::loop, "", "starts again after the last time"),
        field("scalePos", &F::scalePos, "", "stretches the trajectory"),
        field("rotation", &F::rotation, "degree", "rotates the trajectory, about x, then y, then z"),
        field("translation", &F::translation, "m", "moves the trajectory"),
        field("keyTimes", &F::keyTimes, "s", "times of the keys, where there is no file, in rising order"),
        field("keyPositions", &F::keyPositions, "m", "positions of all points at each key time"),
        field("keyVelocities",
              &F::keyVelocities,
              "m/s",
              "velocities of all points at each key time; those of the movement where none are given"),
        field("interpolation", &F::interpolation, "", "how the state moves between two times"),
        field("atBegin", &F::atBegin, "", "in a step the state is where it is at the beginning of the step"),
        field("allowTruncated",
              &F::allowTruncated,
              "",
              "reads a file that was cut off up to its last whole frame"));
  }

  Trajectory<D> trajectory{};
  bool active = false;  // under a solver: held in the next step

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ReadState>());
    trajectory = {};
    trajectory.points = context.rest.size();
    trajectory.loop = loop;
    trajectory.interpolation = interpolation;
    if (trajectory.points == 0)
      throw Error(where, "the state has no points; give it the positions to start from");
    if (filename.path.empty())
      takeKeys(where);
    else if (!keyTimes.empty() || !keyPositions.empty() || !keyVelocities.empty())
      throw Error(where, "there are a file and keys; give one of them");
    else
      takeFile(where);
    transform(where);
    if constexpr (D::rigid && D::spatial == 3)
      for (std::size_t i = 0; i < trajectory.positions.size(); ++i) {
        auto& q = trajectory.positions[i].orientation;
        const Real norm = q.norm();
        if (!(norm > Real(1e-6)))
          throw Error(where,
                      text("the orientation of point ",
                           i % trajectory.points,
                           " at ",
                           trajectory.times[i / trajectory.points],
                           " s is zero; give a quaternion of length 1"));
        // one that a simulation has left unit stays bit by bit what it was
        if (std::abs(norm - 1) > 4 * std::numeric_limits<Real>::epsilon()) q.coeffs() /= norm;
      }
    trajectory.prepare();
    active = trajectory.goesOn(shift);
  }

  // no solver moves the state
  template <class State>
  bool beginStep(StepAhead const& step, State& state) const {
    if (step.solved) return false;
    const double time = (atBegin ? step.begin : step.end) + shift;
    trajectory.place(time, state.position);
    trajectory.move(time, true, state.velocity);
    return true;
  }

  // a solver moves it
  void projectResponse(VecDeriv& dx) const {
    if (active)
      for (auto& d : dx) d.setZero();
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) const {
    if (active)
      for (std::size_t i = 0; i < trajectory.points; ++i) sink.fix(int(i));
  }
  void projectPosition(double time, VecCoord& x) {
    active = trajectory.goesOn(time + shift);
    if (trajectory.given(time + shift)) trajectory.place(time + shift, x);
  }
  void projectVelocity(double time, VecDeriv& v) {
    active = trajectory.goesOn(time + shift);
    if (trajectory.given(time + shift)) trajectory.move(time + shift, false, v);
  }

 private:
  void takeKeys(std::string const& where) {
    trajectory.times = keyTimes;
    trajectory.positions = keyPositions;
    trajectory.velocities = keyVelocities;
    const std::size_t n = trajectory.points;
    if (keyPositions.empty())
      throw Error(where, "has neither a file nor keys; give filename, or keyTimes and keyPositions");
    if (keyTimes.empty() && keyPositions.size() % n == 0 && interval > 0)
      for (std::size_t k = 0; k < keyPositions.size() / n; ++k)
        trajectory.times.push_back(double(k) * interval);
    const std::size_t keys = trajectory.times.size();
    if (keys == 0)
      throw Error(where, "keyTimes is empty; give a time for each key, or the interval between them");
    auto check = [&](std::size_t given, std::string_view name) {
      if (given == keys * n) return;
      throw Error(where,
                  text(name,
                       " has ",
                       given,
                       " entries; give one for each of ",
                       n,
                       " points at each of ",
                       keys,
                       " times"));
    };
    check(keyPositions.size(), "keyPositions");
    if (!keyVelocities.empty()) check(keyVelocities.size(), "keyVelocities");
    for (std::size_t k = 1; k < keyTimes.size(); ++k)
      if (!(keyTimes[k] > keyTimes[k - 1]))
        throw Error(where,
                    text("keyTimes[",
                         k,
                         "] is ",
                         keyTimes[k],
                         " s, not after keyTimes[",
                         k - 1,
                         "]; put them in rising order"));
  }

  void takeFile(std::string const& where) {
    try {
      auto frames =
          io::read_state_file<Real>(filename.path, io::state_layout<D>(trajectory.points), allowTruncated);
      trajectory.times = std::move(frames.times);
      for (std::size_t i = 0; i < frames.positions.size(); i += io::coord_numbers<D>)
        trajectory.positions.push_back(io::coord_of<D>(&frames.positions[i]));
      for (std::size_t i = 0; i < frames.velocities.size(); i += std::size_t(D::size))
        trajectory.velocities.push_back(Eigen::Map<typename D::Deriv const>(&frames.velocities[i]));
    } catch (Error const& error) {
      throw Error(where, error.what());
    }
  }
  // x -> R s x + t
  void transform(std::string const& where) {
    const Eigen::Vector3d none(0, 0, 0);
    if (scalePos == 1 && rotation == none && translation == none) return;
    if constexpr (D::spatial == 3) {
      const Eigen::Quaternion<Real> rotate = rotation_of_degrees(rotation).template cast<Real>();
      const Vec<Real, 3> move = translation.template cast<Real>();
      for (auto& x : trajectory.positions) {
        const Vec<Real, 3> p = rotate * Vec<Real, 3>(D::center(x) * Real(scalePos));
        D::setCenter(x, p + move);
        if constexpr (D::rigid) x.orientation = rotate * x.orientation;
      }
      for (auto& v : trajectory.velocities) {
        const Vec<Real, 3> linear = rotate * Vec<Real, 3>(v.template head<3>() * Real(scalePos));
        v.template head<3>() = linear;
        if constexpr (D::rigid) {
          const Vec<Real, 3> angular = rotate * Vec<Real, 3>(v.template tail<3>());
          v.template tail<3>() = angular;
        }
      }
    } else {
      throw Error(where, "scalePos, rotation and translation are for points in space; leave them out");
    }
  }
};

}  // namespace sinew
