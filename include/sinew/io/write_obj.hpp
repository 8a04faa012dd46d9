// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

namespace sinew::io {

/// Writes points (v), edges (l), triangles and quads (f) as a Wavefront OBJ file, whole or not at all.
/// Coordinates read back with the same bits. Throws Error if the mesh has elements in space, which OBJ cannot
/// hold, as check_mesh() does, and as write_file() does.
void write_obj(std::string const& path, Mesh const& mesh);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/output_file.hpp>

#include <cstdint>

namespace sinew::io {

SINEW_ONCE void write_obj(std::string const& path, Mesh const& mesh) {
  check_mesh(path, mesh);
  if (!mesh.tetrahedra.empty() || !mesh.hexahedra.empty())
    throw Error(path,
                text("OBJ files hold surfaces, but the mesh has ",
                     mesh.tetrahedra.size(),
                     " tetrahedra and ",
                     mesh.hexahedra.size(),
                     " hexahedra; write its boundary, or use write_vtu"));
  for_each_kind(mesh, [&](int kind, auto const& list) {
    if (dimension_of_kind(kind) == 3 && !list.empty())
      throw Error(path,
                  text("OBJ files hold surfaces, but the mesh has a ",
                       element_kind_name(kind),
                       "; write its boundary, or use write_vtu"));
  });
  std::string out = "# Sinew\n";
  for (auto const& p : mesh.positions) {
    out += 'v';
    for (const double c : p) out += ' ', append_number(out, c);
    out += '\n';
  }
  auto elements = [&out](char key, auto const& list) {
    for (auto const& e : list) {
      out += key;
      for (const Index i : e) out += ' ', append_number(out, std::int64_t(i) + 1);
      out += '\n';
    }
  };
  elements('l', mesh.edges);
  elements('f', mesh.triangles);
  elements('f', mesh.quads);
  write_file(path, out);
}

}  // namespace sinew::io
#endif
