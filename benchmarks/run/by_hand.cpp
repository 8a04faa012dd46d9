// SPDX-License-Identifier: BSL-1.0
// A typed scene against the same simulation written by hand: a string of 10 masses (explicit steps), and a
// liver (implicit steps). The string also takes four springs at a time. Prints the
// time a step of both, and the ratio, as medians of 21 rounds in turn.
#include "by_hand.hpp"

#include "paired.hpp"

using namespace sinew;

namespace {

constexpr int masses = 10;

template <class D>
auto string_scene() {
  typename D::VecCoord x;
  std::vector<Spring> springs;
  for (int i = 0; i < masses; ++i) {
    x.push_back({0.1 * i, 0, 0});
    if (i > 0)
      springs.push_back({.first = i - 1, .second = i, .stiffness = 100, .damping = 0.1, .length = 0.1});
  }
  Simulation sim{node<"root">(Gravity{{0, -9.81, 0}},
                              EulerExplicitSolver{},
                              MechanicalObject<D>{x},
                              UniformMass<D>{.vertexMass = 0.05},
                              StiffSpringForceField<D>{springs},
                              FixedConstraint<D>{.indices = {0}})};
  sim.init();
  return sim;
}

void report(char const* name, bench::Pair pair, int steps, double difference) {
  std::printf("%-8s scene %10.3f us/step, by hand %10.3f us/step, ratio %.3f, positions differ by %.1e\n",
              name,
              1e6 * pair.first / steps,
              1e6 * pair.second / steps,
              pair.ratio,
              difference);
}

template <class D>
void compare_string(char const* name) {
  auto scene = string_scene<D>();
  HandString hand(masses);
  const int steps = 20000;
  const auto pair = bench::paired(
      21,
      [&] {
        for (int i = 0; i < steps; ++i) scene.animate(0.0005);
      },
      [&] {
        for (int i = 0; i < steps; ++i) hand.step(0.0005);
      });
  report(name, pair, steps, (scene.root().state().position.back() - hand.x.back()).norm());
}

}  // namespace

int main() {
  compare_string<Vec3d>("string");
  compare_string<WithLanes<Vec3d, std::min(4, native_width<double>)>>("string-4");
  {
    const Mesh mesh = hand_mesh();
    auto scene = hand_liver_scene(mesh);
    HandLiver hand(mesh);
    const int steps = 100;
    const auto pair = bench::paired(
        21,
        [&] {
          for (int i = 0; i < steps; ++i) scene.animate(0.02);
        },
        [&] {
          for (int i = 0; i < steps; ++i) hand.step(0.02);
        });
    report("liver", pair, steps, (scene.root().state().position[100] - hand.x[100]).norm());
  }
  return 0;
}
