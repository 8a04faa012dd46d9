// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <CLI/CLI.hpp>

namespace examples {

/// Reads the words of a program. False where it is to end with `status`: after help, or words that are wrong.
inline bool parsed(CLI::App& app, int argc, char** argv, int& status) {
  try {
    app.parse(argc, argv);
  } catch (CLI::ParseError const& e) {
    status = app.exit(e);
    return false;
  }
  return true;
}

/// Options of a simulation over time that draws each of some steps.
template <class Options>
void add_times(CLI::App& app, Options& options, char const* time = "Seconds to simulate") {
  app.add_option("--time", options.time, time)->capture_default_str();
  app.add_option("--dt", options.dt, "Seconds a step")->capture_default_str();
}
template <class Options>
void add_every(CLI::App& app, Options& options) {
  app.add_option("--every", options.every, "Steps from one picture to the next")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
}
template <class Options>
void check_times(Options const& options) {
  const double steps = options.time / options.dt;
  if (!(options.dt > 0) || !(options.time > 0) || !(steps < 1e9))
    throw sinew::Error("--time and --dt",
                       sinew::text("are ",
                                   options.time,
                                   " s and ",
                                   options.dt,
                                   " s, but must be greater than 0 and make less than 1e9 steps"));
}

}  // namespace examples
