// SPDX-License-Identifier: BSL-1.0
// The vitrectomy as a typed scene against the same simulation written by hand, which take turns: the whole
// surgery, again and again. Prints the time a step of both and the ratio, as medians of the rounds (default
// 5). The scene takes springs in lanes, and one by one as the program by hand does.
#include "vitrectomy.hpp"

#include "paired.hpp"
#include "vitrectomy/scene.hpp"

#include <cstdlib>

using namespace sinew;

namespace {

constexpr double dt = 0.005;
constexpr int steps = 1200;  // 6 s

template <class D>
void compare(char const* name, examples::Eye const& eye, int rounds) {
  auto scene = examples::vitrectomy_scene<D>(eye);
  scene.init();
  const auto start = scene;
  const HandVitrectomy handStart(eye);
  HandVitrectomy hand = handStart;
  double furthest = 0;
  auto& x = scene.template at<"eye">().state().position;
  auto& springs = scene.template at<"eye">().template get<examples::CuttableSpringForceField<D>>().springs;
  bool same = true;
  for (int i = 0; i < steps; ++i) {
    scene.animate(dt);
    hand.step(dt);
    for (std::size_t k = 0; k < x.size(); ++k) furthest = std::max(furthest, (x[k] - hand.x[k]).norm());
    same = same && springs.size() == hand.cuttable.size();
  }
  const auto pair = bench::paired(
      rounds,
      [&] {
        scene = start;
        for (int i = 0; i < steps; ++i) scene.animate(dt);
      },
      [&] {
        hand = handStart;
        for (int i = 0; i < steps; ++i) hand.step(dt);
      });
  std::printf(
      "%-12s scene %9.3f us/step, by hand %9.3f us/step, ratio %.3f, positions differ by %.1e m, the same "
      "springs were cut: "
      "%s\n",
      name,
      1e6 * pair.first / steps,
      1e6 * pair.second / steps,
      pair.ratio,
      furthest,
      same ? "yes" : "no");
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  for (const int sectors : {24, 48}) {
    const examples::Eye eye = examples::make_eye({.sectors = sectors});
    std::printf("%zu points, %zu springs, %zu to cut\n",
                eye.position.size(),
                eye.springs.size(),
                eye.cuttable.size());
    compare<Vec3d>("lanes", eye, rounds);
    compare<WithLanes<Vec3d, 1>>("one by one", eye, rounds);
  }
  return 0;
}
