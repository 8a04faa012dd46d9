// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

namespace sinew {

/// A surface to look at, whose vertices follow a mapping and take no part in the mechanics.
struct VisualModel {
  using Role = role::VisualModel;
  using DataTypes = Vec3f;
  using VecCoord = Vec3f::VecCoord;
  static constexpr std::string_view className = "VisualModel",
                                    aliases = "OglModel VisualModelImpl OglTetrahedralModel";

  Mesh mesh{};  // its positions are those at init

  static constexpr auto fields() { return field_list(); }

  VecCoord position{};

  std::size_t size() const { return position.size(); }

  /// The mesh with its vertices where they are now.
  Mesh current() const;

  /// Vertices that go take their faces with them.
  void follow(Renumbering const& points);

  void init(std::string const& where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <vector>

namespace sinew {

SINEW_ONCE Mesh VisualModel::current() const {
  Mesh now{.positions = {},
           .edges = mesh.edges,
           .triangles = mesh.triangles,
           .quads = mesh.quads,
           .tetrahedra = mesh.tetrahedra,
           .hexahedra = mesh.hexahedra};
  now.positions.reserve(position.size());
  for (auto const& x : position) now.positions.emplace_back(x[0], x[1], x[2]);
  return now;
}

SINEW_ONCE void VisualModel::follow(Renumbering const& points) {
  points.filter(mesh.positions);
  auto faces = [&points](auto& list) {
    std::erase_if(list, [&](auto const& face) {
      return std::any_of(face.begin(), face.end(), [&](Index i) { return !points.stays(i); });
    });
    for (auto& face : list)
      for (Index& i : face) points.renumber(i);
  };
  faces(mesh.edges), faces(mesh.triangles), faces(mesh.quads), faces(mesh.tetrahedra);
  faces(mesh.hexahedra);
}

SINEW_ONCE void VisualModel::init(std::string const& where) {
  check_mesh(text(where, ": VisualModel"), mesh);
  position.clear();
  for (auto const& p : mesh.positions) position.emplace_back(float(p[0]), float(p[1]), float(p[2]));
}

}  // namespace sinew
#endif
