// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/topology/point_cells.hpp>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace sinew {

/// The surface around particles: where
///   phi(x) = sum_i w(|x - x_i|) / sum_j w(|x_i - x_j|),   w(r) = (1 - r^2/h^2)^3 for r < h,
/// has a value between 0 and 1. It is about 1 where particles are as dense as around any other, and 0 beyond
/// h. The function is known on a lattice, in blocks of it that are near particles; in each cell of it that
/// the surface meets there is one point, the mean of where its edges meet it, and four cells around such an
/// edge have a face (Gibson 1998). The error falls with the square of the step.
class ParticleSurface {
 public:
  static constexpr int mostSteps = 16;  // in a radius

  /// Points and quads, which look outwards, of the surface around particles: of radius h [m], on a lattice of
  /// `step` [m], at the value iso. Throws Error where particles are nowhere, or where the lattice would not
  /// fit memory_limit.
  void find(std::span<Eigen::Vector3d const> particles, double radius, double step, double iso,
            std::string_view where);

  std::vector<Eigen::Vector3d> points{};
  std::vector<Quad> quads{};

 private:
  static constexpr int width = 8;  // of a block, in steps
  using Place = std::array<std::int64_t, 3>;
  struct Block {
    Place at;  // in blocks
    std::array<double, width * width * width> value{};
    std::array<Index, width * width * width> point{};  // of the cell above each lattice point
  };
  std::vector<Block> blocks_{};
  std::unordered_map<std::uint64_t, int> known_{};
  PointCells cells_{};
  Place low_{};  // of the blocks
  double step_ = 1, iso_ = 0.5;

  static int numberIn(Place const& at) {
    auto inside = [](std::int64_t x) { return int(x & (width - 1)); };
    return (inside(at[2]) * width + inside(at[1])) * width + inside(at[0]);
  }
  static Eigen::Vector3d vector(Place const& at) { return {double(at[0]), double(at[1]), double(at[2])}; }
  static std::int64_t blockOf(std::int64_t x) { return x >> 3; }
  std::uint64_t key(Place const& block) const;
  Block* find(Place const& at);
  void addBlocks(Place const& from, Place const& to, std::string_view where);
  double value(Place const& at);
  Index pointOf(Place const& cell);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>
#include <sinew/core/memory_limit.hpp>

#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE std::uint64_t ParticleSurface::key(Place const& block) const {
  std::uint64_t all = 0;
  for (std::size_t c = 0; c < 3; ++c) all = all << 21 | std::uint64_t(block[c] - low_[c]);
  return all;
}
// the block of a lattice point; null where no particle is near
SINEW_ONCE ParticleSurface::Block* ParticleSurface::find(Place const& at) {
  const auto found = known_.find(key({blockOf(at[0]), blockOf(at[1]), blockOf(at[2])}));
  return found == known_.end() ? nullptr : &blocks_[std::size_t(found->second)];
}
SINEW_ONCE void ParticleSurface::addBlocks(Place const& from, Place const& to, std::string_view where) {
  Place at;
  for (at[2] = blockOf(from[2]); at[2] <= blockOf(to[2]); ++at[2])
    for (at[1] = blockOf(from[1]); at[1] <= blockOf(to[1]); ++at[1])
      for (at[0] = blockOf(from[0]); at[0] <= blockOf(to[0]); ++at[0]) {
        const auto [_, isNew] = known_.try_emplace(key(at), int(blocks_.size()));
        if (!isNew) continue;
        if (blocks_.size() == blocks_.capacity())
          check_memory(where,
                       "the lattice of the surface",
                       2. * double(blocks_.size() * sizeof(Block)) / double(bytesOfGridPoint));
        blocks_.emplace_back().at = at;
        blocks_.back().point.fill(-1);
      }
}
SINEW_ONCE double ParticleSurface::value(Place const& at) {
  Block const* block = find(at);
  return block ? block->value[std::size_t(numberIn(at))] : 0;
}
// of a cell that the surface meets, which has a block
SINEW_ONCE Index ParticleSurface::pointOf(Place const& cell) {
  Index& number = find(cell)->point[std::size_t(numberIn(cell))];
  if (number >= 0) return number;
  std::array<double, 8> corners;
  for (std::size_t k = 0; k < 8; ++k)
    corners[k] = value({cell[0] + int(k & 1), cell[1] + int(k >> 1 & 1), cell[2] + int(k >> 2)}) - iso_;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int crossings = 0;
  for (std::size_t k = 0; k < 8; ++k)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t other = k | std::size_t(1) << c;
      if (other == k || (corners[k] > 0) == (corners[other] > 0)) continue;
      Eigen::Vector3d x(double(k & 1), double(k >> 1 & 1), double(k >> 2));
      x[Eigen::Index(c)] = corners[k] / (corners[k] - corners[other]);
      sum += x;
      ++crossings;
    }
  number = Index(points.size());
  points.push_back(step_ * (vector(cell) + sum / crossings));
  return number;
}

SINEW_ONCE void ParticleSurface::find(std::span<Eigen::Vector3d const> particles, double radius, double step,
                                      double iso, std::string_view where) {
  points.clear();
  quads.clear();
  blocks_.clear();
  known_.clear();
  step_ = step, iso_ = iso;
  if (particles.empty()) return;
  auto weight = [&](double square) {
    const double a = std::max(0., 1 - square / (radius * radius));
    return a * a * a;
  };
  // weights of the particles
  cells_.sort(particles, radius, where);
  std::vector<double> sums(particles.size(), 0.);
  auto const& order = cells_.order();
  cells_.forEachCell({}, [&](PointCells::Range const& cell, std::array<PointCells::Range, 9> const& around) {
    for (int i = cell.first; i < cell.second; ++i) {
      const auto own = std::size_t(order[std::size_t(i)]);
      for (auto const& [begin, end] : around)
        for (int j = begin; j < end; ++j)
          sums[own] += weight((particles[own] - particles[std::size_t(order[std::size_t(j)])]).squaredNorm());
    }
  });
  // the blocks, one lattice point beyond what particles reach, so that all cells at the surface have one
  constexpr double most = 1e15;  // steps, which are whole numbers
  std::vector<std::array<Place, 2>> reach(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double x = particles[i][Eigen::Index(c)] / step, h = radius / step;
      if (!(std::abs(x) < most))
        throw Error(where,
                    text("particle ", i, " is at ", x * step, " m, too far away for steps of ", step, " m"));
      reach[i][0][c] = std::int64_t(std::floor(x - h));
      reach[i][1][c] = std::int64_t(std::ceil(x + h));
      const std::int64_t block = blockOf(reach[i][0][c] - 1);
      low_[c] = i == 0 ? block : std::min(low_[c], block);
    }
  for (auto const& [from, to] : reach)
    addBlocks({from[0] - 1, from[1] - 1, from[2] - 1}, {to[0] + 1, to[1] + 1, to[2] + 1}, where);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    auto const& [from, to] = reach[i];
    Place at;
    for (at[2] = from[2]; at[2] <= to[2]; ++at[2])
      for (at[1] = from[1]; at[1] <= to[1]; ++at[1]) {
        Block* block = nullptr;
        for (at[0] = from[0]; at[0] <= to[0]; ++at[0]) {
          if (!block || numberIn(at) % width == 0) block = find(at);
          block->value[std::size_t(numberIn(at))] +=
              weight((step * vector(at) - particles[i]).squaredNorm()) / sums[i];
        }
      }
  }
  // a face around each edge of the lattice that the surface meets
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    Place const first{blocks_[b].at[0] * width, blocks_[b].at[1] * width, blocks_[b].at[2] * width};
    for (int k = 0; k < width * width * width; ++k) {
      const Place at{first[0] + k % width, first[1] + k / width % width, first[2] + k / (width * width)};
      const bool inside = blocks_[b].value[std::size_t(k)] > iso;
      for (std::size_t c = 0; c < 3; ++c) {
        Place next = at;
        ++next[c];
        if (inside == (value(next) > iso)) continue;
        // the four cells around it, counterclockwise seen from above
        const std::size_t u = (c + 1) % 3, v = (c + 2) % 3;
        std::array<Place, 4> around{at, at, at, at};
        --around[0][u], --around[0][v];
        --around[1][v];
        --around[3][u];
        Quad quad;
        for (std::size_t q = 0; q < 4; ++q) quad[q] = pointOf(around[inside ? q : 3 - q]);
        quads.push_back(quad);
      }
    }
  }
}

}  // namespace sinew
#endif
