// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#include <sinew/io/mesh_file.hpp>
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/surface_mesh.hpp>

namespace examples {

LiverBody make_body(LiverOptions& options) {
  using namespace sinew;
  LiverBody body;
  if (options.mesh.empty()) {
    const LiverShape shape;
    body.volume = tetrahedralize_count(shape, shape.box_min(), shape.box_max(), options.tetrahedra);
    body.skin = surface(shape, shape.box_min(), shape.box_max(), 0.006);
    if (options.density == 0) options.density = 1000;
    // the liver hangs from the diaphragm: the points on the upper back of the right lobe
    if (options.fixed.empty())
      for (std::size_t i = 0; i < body.volume.positions.size(); ++i)
        if (auto const& p = body.volume.positions[i]; p.y() > 0.035 && p.z() < 0)
          options.fixed.push_back(int(i));
  } else {
    body.volume = io::read_mesh(options.mesh);
    if (body.volume.tetrahedra.empty())
      throw Error(options.mesh, "the file has no tetrahedra; the liver needs a volume mesh, not a surface");
    body.skin = boundary_surface(body.volume);
    if (options.density == 0) options.density = 1;
    if (options.fixed.empty()) options.fixed = {3, 39, 64};
  }
  return body;
}

}  // namespace examples
