// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/axis_box.hpp>
#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/local_minimum.hpp>
#include <sinew/gpu/sent_list.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sinew::gpu {

/// Boxes sorted into the cells of a grid: those of a cell are all that overlap it.
struct BoxGrid {
  Eigen::Vector3d low{0, 0, 0};
  double perMetre = 0;  // cells
  std::array<int, 3> cells{0, 0, 0};
  int const *first = nullptr, *members = nullptr;
  AxisBox const* boxes = nullptr;

  /// The cell along an axis; -1 where x is outside of the grid, or no number. It never falls as x rises, so
  /// that a point is in a cell of each box that contains it.
  SINEW_HD int cellOf(double x, int axis) const {
    const double c = (x - low[axis]) * perMetre;
    return c >= 0 && c < cells[std::size_t(axis)] ? int(c) : -1;
  }
  SINEW_HD int number(int i, int j, int k) const { return (k * cells[1] + j) * cells[0] + i; }

  /// f(box) for the boxes that contain a point, in rising order.
  template <class F>
  SINEW_HD void eachAt(Eigen::Vector3d const& x, F&& f) const {
    int c[3];
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = cellOf(x[axis], axis);
      if (c[axis] < 0) return;
    }
    const int cell = number(c[0], c[1], c[2]);
    for (int k = first[cell]; k < first[cell + 1]; ++k) {
      AxisBox const& box = boxes[members[k]];
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis)
        inside = inside && box.min[axis] <= x[axis] && x[axis] <= box.max[axis];
      if (inside) f(members[k]);
    }
  }
};

/// A surface that stands while contacts are looked for, in memory of the device, under the names that
/// CollisionSurface has.
struct StandingSurface : SurfaceShape {
  struct Settings {
    double proximity = 0;
    bool bothSide = true;
  };
  Settings settings{};
  Eigen::Vector3d const *position = nullptr, *velocity = nullptr;
  std::array<int, 3> const *elements = nullptr, *across = nullptr;
  std::span<std::array<int, 2> const> beside{};
  int const *firstAround = nullptr, *around = nullptr;
  double const* radii = nullptr;
  Eigen::Quaterniond const* orientation = nullptr;  // none: it is no rigid
  BoxGrid grid{};
  int number = -1;     // among the surfaces of the scene
  bool first = false;  // of the two in a contact

  SINEW_HD double radiusOf(int element) const { return radii ? radii[element] : 0; }
  template <std::size_t N>
  SINEW_HD std::array<Eigen::Vector3d, N> corner(Eigen::Vector3d const* of, int element) const {
    std::array<Eigen::Vector3d, N> all;
    for (std::size_t c = 0; c < N; ++c) all[c] = of[elements[element][c]];
    return all;
  }
  SINEW_HD bool isLocalMinimum(int element, std::array<int, 3> const& at, Eigen::Vector3d const& d,
                               double cone) const {
    return is_local_minimum(*this, element, at, d, cone);
  }
};

/// Brings such a surface to the device, again where its boxes have been made anew.
class StandingOnDevice {
 public:
  StandingSurface view{};

  /// `margin`: what is to be around its boxes.
  void take(CollisionSurface const& s, bool first, double margin) {
    static_cast<SurfaceShape&>(view) = s;
    view.settings = {s.settings.proximity, s.settings.bothSide};
    view.number = s.number;
    view.first = first;
    if (surface_ == &s && enclosures_ == s.enclosures && margin_ == margin) return;
    surface_ = &s;
    enclosures_ = s.enclosures;
    margin_ = margin;
    view.position = position_.send(s.position);
    view.velocity = velocity_.send(s.velocity);
    view.elements = elements_.send(s.elements);
    view.across = across_.send(s.across);
    view.beside = {beside_.send(s.beside), s.beside.size()};
    view.firstAround = firstAround_.send(s.firstAround);
    view.around = around_.send(s.around);
    view.radii = s.shape == Shape::sphere ? radii_.send(s.radius) : nullptr;
    makeGrid(s.boxes);
  }

 private:
  CollisionSurface const* surface_ = nullptr;
  long enclosures_ = -1;
  double margin_ = -1;
  SentList<Eigen::Vector3d> position_{}, velocity_{};
  SentList<std::array<int, 3>> elements_{}, across_{};
  SentList<std::array<int, 2>> beside_{};
  SentList<int> firstAround_{}, around_{}, first_{}, members_{};
  SentList<double> radii_{};
  SentList<AxisBox> boxes_{};
  std::vector<AxisBox> grown_{};
  std::vector<int> firstOf_{}, next_{}, memberList_{};

  // cells as long as boxes are on the average; longer ones where there would be many more entries than boxes
  void makeGrid(std::vector<AxisBox> const& boxes) {
    BoxGrid& grid = view.grid;
    grown_.clear();
    AxisBox all;
    double edge = 0;
    for (AxisBox const& b : boxes) {
      grown_.push_back(b.grown(margin_));
      all.include(grown_.back());
      edge += (grown_.back().max - grown_.back().min).maxCoeff() / double(boxes.size());
    }
    const std::size_t most = 16 * boxes.size() + 64;
    const Eigen::Vector3d extent = all.max - all.min;
    if (!(edge > 0) || !std::isfinite(edge)) edge = 1;
    grid.low = all.min;
    while (true) {
      grid.perMetre = 1 / edge;
      double cells = 1;
      for (int axis = 0; axis < 3; ++axis) cells *= std::floor(extent[axis] / edge) + 1;
      if (cells <= double(most)) {
        for (int axis = 0; axis < 3; ++axis)
          grid.cells[std::size_t(axis)] = int(std::floor(extent[axis] / edge)) + 1;
        if (count(most)) break;
      }
      edge *= 1.5;
    }
    next_.assign(firstOf_.begin(), firstOf_.end() - 1);
    memberList_.resize(std::size_t(firstOf_.back()));
    for (std::size_t b = 0; b < grown_.size(); ++b)
      eachCell(grown_[b], [&](int cell) { memberList_[std::size_t(next_[std::size_t(cell)]++)] = int(b); });
    grid.first = first_.send(firstOf_);
    grid.members = members_.send(memberList_);
    grid.boxes = boxes_.send(grown_);
  }
  template <class F>
  void eachCell(AxisBox const& box, F&& f) const {
    std::array<int, 3> from, to;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = std::size_t(axis);
      from[a] = view.grid.cellOf(box.min[axis], axis);
      to[a] = view.grid.cellOf(box.max[axis], axis);
    }
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) f(view.grid.number(i, j, k));
  }
  // how many boxes are in the cells before each; false where they are more than `most` in all
  bool count(std::size_t most) {
    std::array<int, 3> const& n = view.grid.cells;
    const std::size_t cells = std::size_t(n[0]) * std::size_t(n[1]) * std::size_t(n[2]);
    firstOf_.assign(cells + 1, 0);
    std::size_t entries = 0;
    for (AxisBox const& b : grown_) {
      eachCell(b, [&](int cell) {
        ++firstOf_[std::size_t(cell) + 1];
        ++entries;
      });
      if (entries > most && cells > 1) return false;
    }
    for (std::size_t c = 0; c < cells; ++c) firstOf_[c + 1] += firstOf_[c];
    return true;
  }
};

}  // namespace sinew::gpu
