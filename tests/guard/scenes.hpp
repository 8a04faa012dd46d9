// SPDX-License-Identifier: BSL-1.0
#pragma once

// The steps whose instructions are counted; each function makes a scene and runs it.
namespace guard {

void fem_assembled(int steps);
void fem_matrix_free(int steps);
void spring_grid(int steps);
void contacts(int steps);
void string(int steps);

template <class Sim>
void run(Sim sim, int steps, double dt) {
  sim.init();
  for (int i = 0; i < steps; ++i) sim.animate(dt);
}

}  // namespace guard
