// SPDX-License-Identifier: BSL-1.0
// The vitrectomy as a typed scene against the same simulation written by hand, which take turns: the whole
// surgery, again and again. Prints the time a step of both and the ratio, as medians of the rounds (default
// 5). The scene takes springs one by one, as the program by hand does, and in lanes. Both are compiled here,
// with the same options.
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
  double furthest = 0, inTheEnd = 0, first = 0;  // first: until the cut begins
  auto& x = scene.template at<"eye">().state().position;
  auto& springs = scene.template at<"eye">().template get<examples::CuttableSpringForceField<D>>().springs;
  bool same = true;
  for (int i = 0; i < steps; ++i) {
    scene.animate(dt);
    hand.step(dt);
    inTheEnd = 0;
    for (std::size_t k = 0; k < std::size_t(eye.retinaPoints); ++k)
      inTheEnd = std::max(inTheEnd, (x[k] - hand.x[k]).norm());
    furthest = std::max(furthest, inTheEnd);
    if (scene.time() < eye.times[1]) first = furthest;
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
      "  %-11s scene %9.1f us/step, by hand %9.1f us/step, ratio %.3f; the same springs are cut: %s; points "
      "of the retina "
      "differ by %.0e m before the cut, %.0e during it, %.0e in the end\n",
      name,
      1e6 * pair.first / steps,
      1e6 * pair.second / steps,
      pair.ratio,
      same ? "yes" : "no",
      first,
      furthest,
      inTheEnd);
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
    compare<Vec3d>("one by one", eye, rounds);
    compare<WithLanes<Vec3d, std::min(4, native_width<double>)>>("four lanes", eye, rounds);
    compare<WithLanes<Vec3d, native_width<double>>>("lanes", eye, rounds);
  }
  return 0;
}
