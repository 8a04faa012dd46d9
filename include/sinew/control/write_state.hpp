// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/io/state_writer.hpp>

#include <memory>
#include <vector>

namespace sinew {

/// text: the format of SOFA's WriteState. binary: that of io/state_file.hpp, exact, and faster to read.
enum class StateFormat { text, binary };
inline constexpr std::array<std::string_view, 2> enum_names(StateFormat) { return {"text", "binary"}; }

/// Writes a state to a file at the start and after each step, or at given times: what ReadState replays.
/// (SOFA writes at the beginning of a step, and so never the last state of a run.) A relative name is from
/// the folder in which the program runs.
///
/// The file is "filename.part" until Simulation::finish(), or the end of the simulation, completes it and
/// gives it its name, in the place of an older one. After a reset the record starts anew; a checkpoint goes
/// on with the file that it finds under the name. Copies of a scene that all go on need a file each.
template <class D>
struct WriteState {
  using Role = role::StepCallback;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  static constexpr std::string_view className = "WriteState";
  static constexpr bool actsBeforeStep = true;

  std::string filename{};
  bool writeX = true, writeX0 = false, writeV = false, writeF = false;
  std::vector<double> time{};
  double period = 0, stopAt = 0, keperiod = 0;
  StateFormat format = StateFormat::text;

  static constexpr auto fields() {
    using F = WriteState;
    return field_list(
        field("filename", &F::filename, "", "file that is written"),
        field("writeX", &F::writeX, "", "writes positions"),
        field("writeX0", &F::writeX0, "", "writes rest positions"),
        field("writeV", &F::writeV, "", "writes velocities"),
        field("writeF", &F::writeF, "", "writes forces, as the solver left them"),
        field("time",
              &F::time,
              "s",
              "times to write at, in rising order, each in the first step that reaches it; every step where "
              "neither they nor a period are given",
              range::nonNegative),
        field("period",
              &F::period,
              "s",
              "time between frames, after the last of the times given, or from 0 on; 0: none",
              range::nonNegative)
            .also("interval"),
        field("stopAt",
              &F::stopAt,
              "J",
              "ends the record when the kinetic energy has changed by less than that; 0: never",
              range::nonNegative),
        field("keperiod",
              &F::keperiod,
              "s",
              "time between two checks of the kinetic energy",
              range::nonNegative),
        field("format", &F::format, "", "format of the file"));
  }

  // for checkpoints
  int recorded = 0;  // frames
  bool stopped = false;
  double lastEnergy = 0, nextLook = -1;
  static constexpr auto state() {
    using F = WriteState;
    return field_list(field("recorded", &F::recorded, "", "frames that were written", range::nonNegative),
                      field("stopped", &F::stopped, "", "whether the record has ended"),
                      field("lastEnergy", &F::lastEnergy, "J", "kinetic energy at the last check"),
                      field("nextLook", &F::nextLook, "s", "time of the next check; -1: not known yet"));
  }

  // after init
  std::shared_ptr<io::StateWriter<Real>> writer{};
  double nextDue = 0;  // number of the next of the times at which a frame is due
  long stamp = 0;
  std::string where{};
  std::vector<Real> restNumbers{}, positionNumbers{};  // without gaps
  std::size_t pointsBefore = 0;  // that the state had in frames that are there; 0: as many as now

  void init(InitContext<D> const& context) {
    where = text(context.where, ": ", component_name<WriteState>());
    if (!writeX && !writeX0 && !writeV && !writeF)
      throw Error(where, "writes nothing; set writeX, writeX0, writeV or writeF");
    for (std::size_t k = 1; k < time.size(); ++k)
      if (!(time[k] > time[k - 1]))
        throw Error(
            where,
            text("time[", k, "] is ", time[k], " s, not after time[", k - 1, "]; put them in rising order"));
    auto layout = io::state_layout<D>(context.rest.size());
    layout.has = {writeX0, writeX, writeV, writeF};
    if (!io::dense_coord<D>)
      for (auto* dense : {&restNumbers, &positionNumbers})
        dense->resize(layout.numbers(io::StateLayout::position));
    const bool binary = format == StateFormat::binary;
    if (writer && writer->writes(filename, layout, binary)) return;
    pointsBefore = writer ? writer->points() : 0;
    try {
      writer = std::make_shared<io::StateWriter<Real>>(filename, std::move(layout), binary);
    } catch (Error const& error) {
      throw Error(where, error.what());
    }
    stamp = 0;
  }

  /// The state from which a record starts.
  template <class State>
  void beforeStep(StepAhead const& step, State const& state) {
    if (step.step == 1) {
      recorded = 0, stopped = false, lastEnergy = 0, nextLook = -1;
      nextDue = 0, pointsBefore = 0;
    }
    if (recorded > 0 && pointsBefore > 0 && pointsBefore != writer->points())
      throw Error(
          where,
          text("the state has ",
               writer->points(),
               " points, and had ",
               pointsBefore,
               " when the record began; all frames of a file have the same points. Take this component out "
               "of the scene (Simulation::change), or put another one there"));
    if (recorded == 0 && step.step == 1) {
      if (due(step.begin, step.dt)) record(step.begin, state);
    } else if (nextDue == 0 && !everyStep()) {
      due(step.begin, step.dt);  // what a checkpoint has behind it
    }
  }
  template <class State, class Energy>
  void endStep(StepInfo const& step, State const& state, Energy&& kineticEnergy) {
    if (stopped) return;
    if (stopAt > 0) {
      if (nextLook < 0) nextLook = keperiod;
      if (step.time > nextLook) {
        const double energy = kineticEnergy();
        stopped = std::abs(energy - lastEnergy) < stopAt;
        if (stopped) return;
        lastEnergy = energy;
        nextLook += keperiod;
      }
    }
    if (due(step.time, step.dt)) record(step.time, state);
  }
  /// Completes the file.
  void finish() {
    if (writer) writer->finish();
  }

 private:
  bool everyStep() const { return time.empty() && period == 0; }
  // the time of a frame, of which one is due that is reached but for a tenth of a step, as in SOFA
  bool due(double now, double dt) {
    if (everyStep()) return true;
    const double reached = now + 0.1 * dt, given = double(std::max<std::size_t>(time.size(), 1));
    const double before = nextDue, last = time.empty() ? 0 : time.back();
    while (nextDue < double(time.size()) && reached >= time[std::size_t(nextDue)]) ++nextDue;
    if (time.empty() && nextDue == 0 && reached >= 0) ++nextDue;
    if (nextDue >= given && period > 0)
      nextDue = std::max(nextDue, given + std::floor((reached - last) / std::max(period, 1e-6 * dt)));
    return nextDue > before;
  }
  template <class State>
  void record(double now, State const& state) {
    auto numbers = [](auto const& vector) { return reinterpret_cast<Real const*>(vector.data()); };
    auto places = [&](VecCoord const& x, std::vector<Real>& dense) {
      if constexpr (io::dense_coord<D>) {
        return numbers(x);
      } else {
        for (std::size_t i = 0; i < x.size(); ++i)
          dense[3 * i] = x[i].center[0], dense[3 * i + 1] = x[i].center[1],
                    dense[3 * i + 2] = x[i].orientation;
        return static_cast<Real const*>(dense.data());
      }
    };
    try {
      writer->add(std::size_t(recorded),
                  stamp,
                  now,
                  {places(state.restPosition, restNumbers),
                   places(state.position, positionNumbers),
                   numbers(state.velocity),
                   numbers(state.force)});
    } catch (Error const& error) {
      throw Error(where, error.std::runtime_error::what());  // no indirect call in a step
    }
    ++recorded;
  }
};

}  // namespace sinew
