// SPDX-License-Identifier: BSL-1.0
// The equations of pressure: iterations that do not grow with the grid, residuals computed again here, bits
// on threads.
#include "catch.hpp"

#include <sinew/fluid/poisson_multigrid.hpp>

#include <algorithm>
#include <random>

namespace test_poisson_multigrid {

using namespace sinew;
using namespace sinew::fluid;

namespace {

struct Problem {
  int n = 16;
  bool surface = false, hole = false, periodic = false;
};
struct Answer {
  int iterations = 0, levels = 0;
  bool converged = false;
  double residual = 0, recomputed = 0, energyError = 0;
  std::vector<double> x{};
};

// b = A of known random values; a wavy surface a third of a cell behind the last fluid cell, and a ball of
// solid
template <class Real, int N>
Answer solve(Problem const& p, double tolerance, Workers* workers = nullptr) {
  Each<int, N> cells;
  cells.fill(p.n);
  Each<bool, N> periodic{};
  periodic[0] = p.periodic;
  const CellGrid<N> grid(cells, periodic);
  PoissonMultigrid<Real, N> multigrid;
  multigrid.init(grid);
  auto& top = multigrid.finest();
  enum { fluid, air, solid };
  std::vector<int> kind(grid.size, solid);
  grid.forRows(WorkShare{}, [&](std::size_t row, std::ptrdiff_t first) {
    auto at = grid.place(row);
    for (; at[0] <= p.n; ++at[0]) {
      const double x = double(at[0]) / p.n, y = double(at[1]) / p.n;
      double distance = 0;
      for (const int k : at) distance += (k / double(p.n) - 0.4) * (k / double(p.n) - 0.4);
      const bool above = p.surface && y > 0.6 + 0.1 * std::sin(6.283185307179586 * x);
      kind[std::size_t(first + at[0] - 1)] = p.hole && distance < 0.04 ? solid : above ? air : fluid;
    }
  });
  grid.wrap(std::span<int>(kind));
  auto at = [](std::ptrdiff_t i) { return std::size_t(i); };
  grid.forCells({}, [&](std::ptrdiff_t i) {
    top.open[at(i)] = kind[at(i)] != solid;
    if (kind[at(i)] != fluid) return;
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = grid.stride[c];
      if (kind[at(i - s)] == fluid) top.face[c][at(i)] = 1;
      for (const std::ptrdiff_t j : {i - s, i + s})
        if (kind[at(j)] == air) top.surface[at(i)] += Real(3);
    }
  });
  multigrid.prepare({workers});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<Real> known(grid.size, Real(0)), x(grid.size, Real(0));
  grid.forCells({}, [&](std::ptrdiff_t i) {
    if (kind[at(i)] == fluid) known[at(i)] = Real(value(random));
  });
  grid.wrap(std::span<Real>(known));
  auto product = [&](std::vector<Real> const& v, std::ptrdiff_t i) {
    double sum = double(top.surface[at(i)]) * double(v[at(i)]);
    for (std::size_t c = 0; c < axes<N>; ++c) {
      const std::ptrdiff_t s = grid.stride[c];
      sum += double(top.face[c][at(i)]) * (double(v[at(i)]) - double(v[at(i - s)])) +
             double(top.face[c][at(i + s)]) * (double(v[at(i)]) - double(v[at(i + s)]));
    }
    return sum;
  };
  double size = 0, rest = 0;
  std::vector<double> right(grid.size, 0.0);
  grid.forCells({}, [&](std::ptrdiff_t i) {
    right[at(i)] = product(known, i);
    top.b[at(i)] = Real(right[at(i)]);
    size += right[at(i)] * right[at(i)];
  });
  const auto result = multigrid.solve(x, tolerance, 100, {workers});
  grid.forCells({}, [&](std::ptrdiff_t i) {
    const double r = right[at(i)] - product(x, i);
    rest += r * r;
  });
  Answer answer{result.iterations,
                int(multigrid.levelCount()),
                result.converged,
                result.residual,
                std::sqrt(rest / size)};
  answer.x.assign(x.begin(), x.end());
  return answer;
}

}  // namespace

TEST_CASE("the pressure takes as many iterations on fine grids as on coarse ones") {
  for (const bool surface : {false, true})
    for (const bool hole : {false, true}) {
      CAPTURE(surface, hole);
      for (const int n : {16, 32, 64, 100, 128}) {
        CAPTURE(n);
        const Answer answer = solve<double, 2>({n, surface, hole}, 1e-6);
        CHECK(answer.converged);
        CHECK(answer.iterations <= 10);
        CHECK(answer.recomputed <= 1.01e-6);
        CHECK(answer.recomputed == Approx(answer.residual).epsilon(1e-4));
      }
      for (const int n : {8, 16, 32}) {
        CAPTURE(n);
        const Answer answer = solve<double, 3>({n, surface, hole}, 1e-6);
        CHECK(answer.converged);
        CHECK(answer.iterations <= 11);
        CHECK(answer.recomputed <= 1.01e-6);
      }
    }
}

TEST_CASE("the pressure on a grid that is periodic, on odd ones, and in single precision") {
  const Answer periodic = solve<double, 2>({64, true, true, true}, 1e-6);
  CHECK(periodic.iterations <= 10);
  CHECK(periodic.recomputed <= 1.01e-6);
  // 33 cells along a periodic axis are not halved, 50 are once
  for (const int n : {33, 50}) CHECK(solve<double, 2>({n, false, true, true}, 1e-6).recomputed <= 1.01e-6);
  for (const int n : {5, 7, 31}) CHECK(solve<double, 3>({n, true, true}, 1e-6).recomputed <= 1.01e-6);
  const Answer single = solve<float, 3>({16, true, true}, 1e-5);
  CHECK(single.converged);
  CHECK(single.recomputed <= 2e-5);
}

TEST_CASE("the pressure has the same bits on any number of threads") {
  Workers two(2), three(3);
  const Answer one = solve<double, 3>({20, true, true}, 1e-8);
  CHECK(solve<double, 3>({20, true, true}, 1e-8, &two).x == one.x);
  CHECK(solve<double, 3>({20, true, true}, 1e-8, &three).x == one.x);
}

TEST_CASE("the pressure of nothing is nothing, and too few iterations are told") {
  const CellGrid<2> grid({8, 8}, {});
  PoissonMultigrid<double, 2> multigrid;
  multigrid.init(grid);
  multigrid.prepare({});
  std::vector<double> x(grid.size, 1.0);
  CHECK(multigrid.solve(x, 1e-6, 10, {}).converged);
  CHECK(std::all_of(x.begin(), x.end(), [](double v) { return v == 0; }));
  auto& top = multigrid.finest();
  grid.forCells({}, [&](std::ptrdiff_t i) {
    const auto k = std::size_t(i);
    top.open[k] = 1;
    top.surface[k] = 1;
    top.b[k] = double(i % 5);
    for (std::size_t c = 0; c < 2; ++c) top.face[c][k] = i % 7 > 0 ? 1 : 0;
  });
  grid.forSides(0, true, [&](std::ptrdiff_t, std::ptrdiff_t inner, std::ptrdiff_t, int side) {
    if (side == 0) top.face[0][std::size_t(inner)] = 0;
  });
  grid.forSides(1, true, [&](std::ptrdiff_t, std::ptrdiff_t inner, std::ptrdiff_t, int side) {
    if (side == 0) top.face[1][std::size_t(inner)] = 0;
  });
  multigrid.prepare({});
  const auto result = multigrid.solve(x, 1e-12, 1, {});
  CHECK_FALSE(result.converged);
  CHECK(result.iterations == 1);
  CHECK(result.residual > 1e-12);
}

}  // namespace test_poisson_multigrid
