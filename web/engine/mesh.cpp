// SPDX-License-Identifier: BSL-1.0
// Writes the meshes of the page's liver as a header, so that all that compile it have the same numbers: a
// mesh that is made where the page runs would differ by its rounding.
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/surface_mesh.hpp>

#include <cstdio>

namespace {

double at(Eigen::Vector3d const& p, int k) { return p[k]; }
template <class Element>
double at(Element const& element, int k) {
  return double(element[std::size_t(k)]);
}
template <class Elements>
void write(char const* type, char const* name, Elements const& elements, int size) {
  std::printf("inline constexpr %s %s[][%d]{\n", type, name, size);
  for (auto const& element : elements)
    for (int k = 0; k < size; ++k)
      std::printf("%s%.17g%s", k == 0 ? "{" : ",", double(at(element, k)), k + 1 == size ? "},\n" : "");
  std::printf("};\n");
}

}  // namespace

int main() {
  using namespace sinew;
  const LiverShape shape;
  const Mesh volume = tetrahedralize_count(shape, shape.box_min(), shape.box_max(), 1500);
  const Mesh skin = surface(shape, shape.box_min(), shape.box_max(), 0.006);
  std::printf("#pragma once\nnamespace page::mesh {\n");
  write("double", "positions", volume.positions, 3);
  write("int", "tetrahedra", volume.tetrahedra, 4);
  write("double", "skin", skin.positions, 3);
  write("int", "triangles", skin.triangles, 3);
  std::printf("}\n");
}
