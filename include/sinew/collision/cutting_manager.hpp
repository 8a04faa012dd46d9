// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/blade_crossings.hpp>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// Cuts a body along what a blade sweeps while the scene runs. The blade is a polyline: points of the state
/// of a tool, whatever moves that (a constraint, a device, a solver). Before each step the tetrahedra of the
/// body (of one without them, the triangles) through which it has gone are parted, as Simulation::cut does
/// it. An element that it has not gone through yet waits; a cut ends at faces and edges of elements. A cut
/// that cannot be made changes nothing and is counted.
struct CuttingManager {
  using Role = role::Cutting;
  static constexpr std::string_view className = "CuttingManager";

  bool active = true;
  std::string toolModel{};
  std::vector<int> indices{};
  std::string bodyModel{};
  double snapping = CutRules{}.snapping, quality = CutRules{}.quality;
  int capacity = 0;

  static constexpr auto fields() {
    using C = CuttingManager;
    return field_list(
        field("active", &C::active, "", "whether it cuts"),
        field("toolModel", &C::toolModel, "", "path of the node whose state has the points of the blade")
            .also("toolModelPath"),
        field("indices",
              &C::indices,
              "",
              "points of that state in their order along the blade; all of them when not given",
              range::nonNegative),
        field("bodyModel", &C::bodyModel, "", "path of the node with the topology that is cut")
            .also("surfaceModelPath surfaceModel"),
        field(
            "snapping",
            &C::snapping,
            "",
            "a cut passes through a point that is nearer to it than this part of an edge, which it does not "
            "split then",
            range::closed(0, 0.5)),
        field(
            "quality",
            &C::quality,
            "",
            "no element that comes is worse, unless the one is of which it is a part: volume over the cubed "
            "mean edge, 1 for a regular tetrahedron",
            range::closed(0, 1)),
        field("capacity",
              &C::capacity,
              "",
              "how many points the body may have; 0: four times as many as at the start",
              range::nonNegative));
  }

  // after init: paths from the root of the scene on, and the numbers of what is there
  std::string tool{}, body{};
  int toolState = -1, bodyTopology = -1;
  std::size_t mayHave = 0;
  // of the steps
  long cut = 0, refused = 0;  // elements through which it has gone, and cuts that could not be made
  std::string message{};      // why the last of these could not
  std::vector<Eigen::Vector3d> bladeNow{}, positionsNow{}, blade{}, positions{};  // of this and the last step
  CutFront front{};
  int stroke = 0;
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();  // what is in front of the blade in this stroke

  static constexpr auto state() {
    return field_list(field(
        "cut", &CuttingManager::cut, "", "elements through which the blade has gone", range::nonNegative));
  }

  /// What is cut stays so.
  void reset() {
    message.clear();
    blade.clear();
    forget();
  }

  void prepare() {
    blade.reserve(bladeNow.size());
    positions.reserve(positionsNow.size());
    if (mayHave == 0) mayHave = capacity > 0 ? std::size_t(capacity) : 4 * positionsNow.size();
  }
  CutRules rules() const { return {snapping, quality, mayHave}; }

  /// What the blade has swept since the last step, beside the body as it has moved meanwhile.
  struct Sweep {
    BladeStroke stroke;
    CutRules rules;
    CutFront front;
    std::vector<Eigen::Vector3d> before;
  };
  std::optional<Sweep> sweep() {
    blade.swap(bladeNow);
    positions.swap(positionsNow);
    auto &from = bladeNow, &before = positionsNow;  // of the last step
    if (before.size() != positions.size()) {        // others have gone or come
      before.clear();
      forget();
    }
    if (!active || from.size() != blade.size()) {
      forget();
      return {};
    }
    Eigen::AlignedBox3d box, swept;
    for (auto const* points : {&positions, &before})
      for (auto const& p : *points) box.extend(p);
    for (auto const* points : {&blade, &from})
      for (auto const& p : *points) swept.extend(p);
    // what it carries may lie beside it
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1 * box.diagonal().norm());
    box = {box.min() - margin, box.max() + margin};
    if (!box.intersects(swept)) {
      ++stroke;
      facing.setZero();
      return {};
    }
    SweptBlade surface({}, {from, blade});
    const Eigen::Vector3d normal = surface.normal();
    const bool turned = facing.dot(normal) < 0;
    if (normal.norm() > 0) facing = turned ? Eigen::Vector3d(-normal) : normal;
    return Sweep{{std::move(surface), stroke, turned}, rules(), front, before};
  }
  template <class Cut>
  void accept(Cut const& done) {
    cut += long(done.elements);
    front = done.front;
    done.change.points.filter(positions);
  }
  void refuse(std::string const& why) {
    ++refused;
    message = why;
  }

 private:
  void forget() {
    front = {};
    facing.setZero();
    ++stroke;
  }
};

}  // namespace sinew
