// SPDX-License-Identifier: BSL-1.0
// Which boxes overlap: a step of a scene from its coordinates to the pairs. Where Bullet and FCL are there
// they take turns with Sinew on the same coordinates, and must find as many pairs.
//   surfaces: two wavy sheets of triangles, both deforming; boxes of the triangles, refit, pairs of the two
//   balls on a surface: 100 balls fall on a sheet at rest; FCL has no such query of boxes
//   balls: each with each, in a cube that holds one ball, radius 0.25, a unit of volume; they fly up to
//     `speed` a step. Sinew and FCL start from the centres, Sinew sorts the pairs. Bullet tells pairs of
//     boxes that are wider by a margin, to move them less often; of FCL's two ways to move balls the faster
//     counts.
// Time is that of the processor, so that other work on the machine counts little.
// Prints lines of: scene; primitives; pairs; microseconds a step of Sinew, Bullet, FCL ("-" for none).
#include "collision.hpp"

#include "paired.hpp"

#include <sinew/collision/broad_phase.hpp>

#include <cstdlib>
#include <random>
#include <string>

namespace bench {

namespace {

using namespace sinew;

double short_fraction(double x) { return std::round(x * 65536) / 65536; }

AxisBox ball_box(Coordinates const& x, std::size_t i, double r) {
  return {{x[3 * i] - r, x[3 * i + 1] - r, x[3 * i + 2] - r},
          {x[3 * i] + r, x[3 * i + 1] + r, x[3 * i + 2] + r}};
}
void triangle_boxes(std::vector<std::array<int, 3>> const& triangles, Coordinates const& x,
                    std::vector<AxisBox>& boxes) {
  boxes.resize(triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const double p = x[std::size_t(3 * triangles[t][0] + c)], q = x[std::size_t(3 * triangles[t][1] + c)],
                   r = x[std::size_t(3 * triangles[t][2] + c)];
      boxes[t].min[c] = std::min({p, q, r}), boxes[t].max[c] = std::max({p, q, r});
    }
}

struct Surface {
  BoundingTree tree{};
  std::vector<AxisBox> boxes{};
};

Contender surfaces(Bodies const& start) {
  struct Two {
    Surface a, b;
    Bodies now;
    std::size_t pairs = 0;
  };
  auto two = std::make_shared<Two>();
  two->now = start;
  return {[two](Bodies const& now) { two->now = now; },
          [two] {
            triangle_boxes(two->now.triangles, two->now.first, two->a.boxes);
            triangle_boxes(two->now.triangles, two->now.second, two->b.boxes);
            two->a.tree.update(two->a.boxes);
            two->b.tree.update(two->b.boxes);
            two->pairs = 0;
            two->a.tree.pairs(two->b.tree, 0, [&](int, int) { ++two->pairs; });
          },
          [two] { return two->pairs; }};
}

Contender balls_on_surface(Bodies const& start) {
  struct All {
    Surface surface, balls;
    Bodies now;
    std::size_t pairs = 0;
  };
  auto all = std::make_shared<All>();
  triangle_boxes(start.triangles, start.first, all->surface.boxes);
  all->surface.tree.build(all->surface.boxes);
  return {[all](Bodies const& now) { all->now = now; },
          [all] {
            all->balls.boxes.resize(all->now.second.size() / 3);
            for (std::size_t i = 0; i < all->balls.boxes.size(); ++i)
              all->balls.boxes[i] = ball_box(all->now.second, i, all->now.radius);
            all->balls.tree.update(all->balls.boxes);
            all->pairs = 0;
            all->balls.tree.pairs(all->surface.tree, 0, [&](int, int) { ++all->pairs; });
          },
          [all] { return all->pairs; }};
}

Contender balls(Bodies const&) {
  struct All {
    BroadPhase phase;
    std::vector<AxisBox> boxes;
    Bodies now;
    std::size_t pairs = 0;
  };
  auto all = std::make_shared<All>();
  return {[all](Bodies const& now) { all->now = now; },
          [all] {
            all->boxes.resize(all->now.first.size() / 3);
            for (std::size_t i = 0; i < all->boxes.size(); ++i)
              all->boxes[i] = ball_box(all->now.first, i, all->now.radius);
            all->pairs = all->phase.pairs(all->boxes, 0).size();
          },
          [all] { return all->pairs; }};
}

// n x n cells of two triangles each
struct Sheets {
  int n;
  Bodies at(double t) const {
    Bodies bodies;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = i + (n + 1) * j;
        bodies.triangles.push_back({a, a + 1, a + n + 2});
        bodies.triangles.push_back({a, a + n + 2, a + n + 1});
      }
    bodies.first = sheet(0, 0, t);
    bodies.second = sheet(0.05, 1, -1.3 * t);
    return bodies;
  }
  Coordinates sheet(double height, double phase, double t) const {
    Coordinates x;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const double u = double(i) / n, v = double(j) / n;
        for (const double c : {u + 0.1 * std::sin(3 * v + t),
                               v,
                               height + 0.05 * std::sin(7 * u + phase + t) * std::cos(5 * v + phase - t)})
          x.push_back(short_fraction(c));
      }
    return x;
  }
};

struct Flight {
  double side;
  Coordinates x{}, v{};
  Flight(int n, double speed) : side(std::cbrt(n)) {
    std::mt19937 random(1);
    for (int k = 0; k < 3 * n; ++k) {
      x.push_back(side * double(random()) / double(random.max()));
      v.push_back(speed * (2 * double(random()) / double(random.max()) - 1));
    }
  }
  Bodies next() {
    Bodies bodies;
    bodies.radius = 0.25;
    for (std::size_t k = 0; k < x.size(); ++k) {
      x[k] += v[k];
      if (x[k] < 0 || x[k] > side) v[k] = -v[k];
      bodies.first.push_back(short_fraction(x[k]));
    }
    return bodies;
  }
};

// each in turn through the same `steps` new states a round
template <class Next>
bool race(std::string const& scene, std::size_t primitives, int rounds, int steps, Next&& next,
          std::vector<Contender> contenders) {
  std::vector<std::vector<double>> times(contenders.size());
  std::size_t pairs = 0;
  for (int round = -1; round < rounds; ++round) {
    std::vector<Bodies> states;
    for (int s = 0; s < steps; ++s) states.push_back(next());
    for (std::size_t k = 0; k < contenders.size(); ++k) {
      if (!contenders[k].step) continue;
      double time = 0;
      for (Bodies const& state : states) {
        contenders[k].take(state);
        time += processor_seconds(contenders[k].step);
      }
      if (round >= 0) times[k].push_back(1e6 * time / steps);
      const std::size_t found = contenders[k].pairs();
      if (k == 0) pairs = found;
      if (found == pairs) continue;
      std::fprintf(stderr,
                   "%s: %zu pairs of Sinew, but %zu of %s\n",
                   scene.c_str(),
                   pairs,
                   found,
                   k == 1 ? "Bullet" : "FCL");
      return false;
    }
  }
  std::printf("%s; %zu; %zu", scene.c_str(), primitives, pairs);
  auto const figure = [&](std::size_t k) {
    return k < times.size() && !times[k].empty() ? median(times[k]) : 1e300;
  };
  for (const double t : {figure(0), figure(1), std::min(figure(2), figure(3))})
    if (t == 1e300)
      std::printf("; -");
    else
      std::printf("; %.1f", t);
  std::printf("\n");
  std::fflush(stdout);
  return true;
}

}  // namespace

#ifndef BENCH_BULLET
Contender bullet_surfaces(Bodies const&) { return {}; }
Contender bullet_balls(Bodies const&) { return {}; }
Contender bullet_balls_on_surface(Bodies const&) { return {}; }
#endif
#ifndef BENCH_FCL
Contender fcl_surfaces(Bodies const&) { return {}; }
Contender fcl_balls(Bodies const&, bool) { return {}; }
#endif

}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  if (rounds < 1) {
    std::fprintf(stderr, "usage: collision [ROUNDS]\n");
    return 2;
  }
  bool agree = true;
  for (const int n : {22, 71, 224}) {
    const Sheets sheets{n};
    double t = 0;
    const Bodies start = sheets.at(t);
    agree = agree && race("surfaces",
                          2 * start.triangles.size(),
                          rounds,
                          n < 100 ? 20 : 4,
                          [&] { return sheets.at(t += 0.01); },
                          {surfaces(start), bullet_surfaces(start), fcl_surfaces(start)});
  }
  {
    Bodies bodies = Sheets{71}.at(0);
    bodies.radius = 1.0 / 32;
    double t = 0;
    auto fall = [&] {
      bodies.second.clear();
      t += 0.01;
      for (int i = 0; i < 100; ++i)
        for (const double c :
             {0.05 + 0.1 * (i % 10), 0.05 + 0.1 * (i / 10), 0.3 - std::fmod(t + 0.003 * i, 0.3)})
          bodies.second.push_back(short_fraction(c));
      return bodies;
    };
    fall();
    agree = agree && race("balls on a surface",
                          100 + bodies.triangles.size(),
                          rounds,
                          30,
                          fall,
                          {balls_on_surface(bodies), bullet_balls_on_surface(bodies)});
  }
  for (auto const& [n, speed] : {std::pair{1000, 0.01}, {10000, 0.01}, {10000, 0.05}, {100000, 0.01}}) {
    Flight flight(n, speed);
    const Bodies start = flight.next();
    agree =
        agree && race("balls, speed " + std::string(speed < 0.03 ? "0.01" : "0.05"),
                      std::size_t(n),
                      rounds,
                      n > 50000 ? 4 : 20,
                      [&] { return flight.next(); },
                      {balls(start), bullet_balls(start), fcl_balls(start, true), fcl_balls(start, false)});
  }
  return agree ? 0 : 1;
}
