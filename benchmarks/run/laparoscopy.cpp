// SPDX-License-Identifier: BSL-1.0
// Steps of the laparoscopy a second of processor time, on one thread, at the resolutions of the paper of
// 2007. Prints lines of: model; resolution of the liver; steps a second; shares of detection, contact forces
// and the rest (the solvers with all other forces).
#include "laparoscopy.hpp"

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  const long steps = argc > 1 ? std::atol(argv[1]) : 1000;
  if (steps < 1) {
    std::fprintf(stderr, "usage: laparoscopy [STEPS]\n");
    return 2;
  }
  auto print = [](char const* model, char const* resolution, long n, bench::Laparoscopy const& r) {
    const double detection = r.shares.detection / r.seconds, response = r.shares.response / r.seconds;
    std::printf("%s; %s; %.2f; %.4f; %.4f; %.4f\n",
                model,
                resolution,
                double(n) / r.seconds,
                detection,
                response,
                1 - detection - response);
    std::fflush(stdout);
  };
  print("FEM", "1800", steps, bench::time_fem(examples::make_bodies(1800), steps));
  print("FEM", "30000", (steps + 9) / 10, bench::time_fem(examples::make_bodies(30000), (steps + 9) / 10));
  print("grid", "17x8x10", steps, bench::time_grid(examples::make_bodies({17, 8, 10}), steps));
  print("grid", "20x10x12", steps, bench::time_grid(examples::make_bodies({20, 10, 12}), steps));
  print("grid", "24x13x15", steps, bench::time_grid(examples::make_bodies({24, 13, 15}), steps));
}
