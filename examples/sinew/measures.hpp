// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scene.hpp"

#include <sinew/runtime/record.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cli {

/// What is read from a scene: "liver/dofs.position[3][1]", a field of a component or a quantity of it or of a
/// node, and which entry of a list, and which number of that.
///   fields and what links may take            as 'sinew list NAME' shows them
///   residual         of a solver              of the last step: relative of linear ones, otherwise absolute
///   kineticEnergy    of a node                of it and all below [J]
///   potentialEnergy  of a node                of the force fields there, without gravity [J]
///   largestDisplacement  of a node            how far a point of it or below is from where it started [m]
///   reaction         of a node                force of its constraints and those below, over the last step
///   [N]
struct Measure {
  std::string words, path, name;
  std::vector<std::size_t> entry{};  // one number, or two

  /// Throws Failure where the words are none of these.
  explicit Measure(std::string asked);
};

/// Names of columns, and what stands in them: nothing where there is no number.
using Cells = std::vector<std::pair<std::string, std::string>>;

/// Whether forces have to be kept for it.
bool needs_forces(Measure const& measure);
/// Adds what is measured, in columns of one number each but for whole lists. `start`: the scene as it began.
/// Throws Failure where the path leads nowhere, with the nearest names.
void add_measured(Cells& cells, Measure const& measure, Scene& scene, sinew::RecordedFrame const& start);

/// Whether all solvers of the last step reached what they were told to: linear ones and Newton's method their
/// tolerances, those of constraints theirs.
bool converged(Scene& scene);
/// How far a point is from where it started, of states at or below a path of records ("/liver"); nan where
/// points have come or gone.
double largest_displacement(sinew::RecordedFrame const& start, sinew::RecordedFrame const& now,
                            std::string_view below);
/// A number of a table; nothing where it is not finite.
std::string cell_of(double value);

}  // namespace cli
