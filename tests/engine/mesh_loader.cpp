// SPDX-License-Identifier: BSL-1.0
#include <sinew/engine/mesh_loader.hpp>
#include <sinew/topology/element_checks.hpp>

#include "io/files.hpp"
#include "io/samples.hpp"

namespace test_mesh_loader {

using namespace sinew;
using files::check_says;

namespace {

static_assert(Engine<MeshGmshLoader> && Engine<MeshOBJLoader> && Engine<MeshSTLLoader>);

const std::string cube = R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
v 9 9 9
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)";

template <class L>
L loaded(L loader) {
  loader.update("/root");
  return loader;
}

// six times the volume inside a closed surface of triangles that look outwards
double volume6(MeshOBJLoader const& mesh) {
  double v = 0;
  for (auto const& t : mesh.triangles)
    v += mesh.position[std::size_t(t[0])].dot(
        mesh.position[std::size_t(t[1])].cross(mesh.position[std::size_t(t[2])]));
  return v;
}

}  // namespace

TEST_CASE("loaders bring what is in the file") {
  const files::TempFolder folder;
  const auto gmsh = loaded(MeshGmshLoader{.filename = {folder.write("a.msh", samples::gmsh4)}});
  const Mesh all = samples::mesh();
  CHECK(gmsh.position == all.positions);
  CHECK(gmsh.edges == all.edges);
  CHECK(gmsh.triangles == all.triangles);
  CHECK(gmsh.quads == all.quads);
  CHECK(gmsh.tetrahedra == all.tetrahedra);
  CHECK(gmsh.normals.size() == 5);
  const auto stl = loaded(MeshSTLLoader{.filename = {folder.write("a.stl", samples::stl_binary())}});
  CHECK(stl.triangles == samples::stlTriangles);
  CHECK(stl.position == all.positions);
}

TEST_CASE("a mesh is scaled, turned and moved, in this order") {
  const files::TempFolder folder;
  const std::string file = folder.write("a.obj", "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n");
  const auto mesh = loaded(MeshOBJLoader{.filename = {file},
                                         .translation = {10, 20, 30},
                                         .rotation = {90, 0, 90},
                                         .scale3d = {1, 2, 3},
                                         .scale = 2});
  // 2 x stays; a quarter turn about x takes it nowhere, one about z to y
  CHECK(mesh.position[0].isApprox(Eigen::Vector3d(10, 22, 30)));
  // 4 y, about x to z, about z stays
  CHECK(mesh.position[1].isApprox(Eigen::Vector3d(10, 20, 34)));
  // 6 z, about x to -y, about z to x
  CHECK(mesh.position[2].isApprox(Eigen::Vector3d(16, 20, 30)));
  // the quaternion of Rz Ry Rx, as roll, pitch and yaw are joined
  const Eigen::Quaterniond q = rotation_of_degrees({30, 50, -70});
  const double r = 30 * std::numbers::pi / 360, p = 50 * std::numbers::pi / 360,
               y = -70 * std::numbers::pi / 360;
  CHECK(q.w() == Approx(std::cos(r) * std::cos(p) * std::cos(y) + std::sin(r) * std::sin(p) * std::sin(y)));
  CHECK(q.x() == Approx(std::sin(r) * std::cos(p) * std::cos(y) - std::cos(r) * std::sin(p) * std::sin(y)));
  CHECK(q.y() == Approx(std::cos(r) * std::sin(p) * std::cos(y) + std::sin(r) * std::cos(p) * std::sin(y)));
  CHECK(q.z() == Approx(std::cos(r) * std::cos(p) * std::sin(y) - std::sin(r) * std::sin(p) * std::cos(y)));
}

TEST_CASE("quads become triangles, fronts are turned over, unused points left out, sides added") {
  const files::TempFolder folder;
  const DataFile file{folder.write("cube.obj", cube)};
  const auto plain = loaded(MeshOBJLoader{.filename = file});
  CHECK(plain.quads.size() == 6);
  CHECK(plain.position.size() == 9);
  CHECK(plain.edges.empty());

  const auto triangles =
      loaded(MeshOBJLoader{.filename = file, .triangulate = true, .onlyAttachedPoints = true});
  CHECK(triangles.quads.empty());
  CHECK(triangles.triangles.size() == 12);
  CHECK(triangles.position.size() == 8);
  CHECK(volume6(triangles) == Approx(6));
  const auto flipped = loaded(MeshOBJLoader{.filename = file, .flipNormals = true, .triangulate = true});
  CHECK(volume6(flipped) == Approx(-6));
  const auto mirrored = loaded(MeshOBJLoader{.filename = file, .scale3d = {1, -2, 1}, .triangulate = true});
  CHECK(volume6(mirrored) == Approx(12));

  // twelve sides, once each, and not those that are there
  const auto sides = loaded(MeshOBJLoader{.filename = file, .createSubelements = true});
  CHECK(sides.edges.size() == 12);
  const auto half = loaded(
      MeshOBJLoader{.filename = {folder.write("half.obj", cube + "l 6 5\n")}, .createSubelements = true});
  CHECK(half.edges.size() == 12);
  CHECK(half.edges.front() == Edge{5, 4});
  const auto solid =
      loaded(MeshGmshLoader{.filename = {folder.write("a.msh", samples::gmsh2)}, .createSubelements = true});
  CHECK(solid.triangles.size() == 4);  // one of the tetrahedron's four was there
  CHECK(solid.edges.size() == 1 + 4 + 4);
  // the sides of its triangles, in SOFA's order
  const auto lone =
      loaded(MeshGmshLoader{.filename = {folder.write("lone.msh",
                                                      "$NOD\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$ENDNOD\n"
                                                      "$ELM\n1\n1 4 1 1 4 1 2 3 4\n$ENDELM\n")},
                            .createSubelements = true});
  CHECK(lone.triangles == std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  CHECK(lone.edges == std::vector<Edge>{{2, 1}, {1, 0}, {0, 2}, {1, 3}, {3, 0}, {3, 2}});
}

TEST_CASE("normals look outwards; points of no face have none") {
  const files::TempFolder folder;
  const auto mesh = loaded(MeshOBJLoader{.filename = {folder.write("cube.obj", cube)}});
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector3d outwards = (mesh.position[i] - Eigen::Vector3d::Constant(0.5)).normalized();
    CHECK((mesh.normals[i] - outwards).norm() < 1e-14);
  }
  CHECK(mesh.normals[8] == Eigen::Vector3d(0, 0, 0));
  const auto flipped = loaded(MeshOBJLoader{.filename = {folder / "cube.obj"}, .flipNormals = true});
  CHECK((mesh.normals[3] + flipped.normals[3]).norm() < 1e-14);
}

TEST_CASE("mirrored volumes stay positive") {
  const files::TempFolder folder;
  std::string inverted = samples::gmsh2;  // its tetrahedron is inside out
  auto mesh = loaded(MeshGmshLoader{.filename = {folder.write("a.msh", inverted)}, .scale3d = {1, 1, -1}});
  CHECK(error_of([&] { check_tetrahedra<Vec3d>("x", mesh.tetrahedra, mesh.position); }) == error_of([&] {
          check_tetrahedra<Vec3d>("x", samples::mesh().tetrahedra, samples::mesh().positions);
        }));
}

TEST_CASE("prisms and pyramids are loaded, turned where they are mirrored, and have sides") {
  const files::TempFolder folder;
  const std::string path =
      folder.write("a.msh",
                   "$NOD\n7\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n7 2 2 0.5\n"
                   "$ENDNOD\n$ELM\n2\n1 6 1 1 6 1 2 3 4 5 6\n2 7 1 1 5 2 3 6 5 7\n$ENDELM");
  const auto mesh =
      loaded(MeshGmshLoader{.filename = {path}, .scale3d = {1, 1, -1}, .createSubelements = true});
  CHECK(mesh.prisms == std::vector<Prism>{{3, 4, 5, 0, 1, 2}});
  CHECK(mesh.pyramids == std::vector<Pyramid>{{1, 4, 5, 2, 6}});
  CHECK(mesh.quads.size() == 3);  // one of them is of both
  CHECK(mesh.triangles.size() == 2 + 4);
  CHECK(mesh.edges.size() == 9 + 4);
}

TEST_CASE("tetrahedra of second order are loaded, turned where they are mirrored, and have parts of sides") {
  const files::TempFolder folder;
  const std::string path = folder.write(
      "a.msh",
      "$NOD\n10\n1 0 0 0\n2 2 0 0\n3 0 2 0\n4 0 0 2\n5 1 0 0\n6 1 1 0\n7 0 1 0\n8 0 0 1\n9 0 1 1\n10 1 0 1\n"
      "$ENDNOD\n$ELM\n1\n1 11 1 1 10 1 2 3 4 5 6 7 8 9 10\n$ENDELM");
  const auto mesh = loaded(MeshGmshLoader{.filename = {path}, .createSubelements = true});
  CHECK(mesh.quadraticTetrahedra == std::vector<QuadraticTetrahedron>{{0, 1, 2, 3, 4, 5, 6, 7, 9, 8}});
  CHECK(mesh.triangles.size() == 16);
  CHECK(mesh.edges.size() == 24);
  const auto mirrored = loaded(MeshGmshLoader{.filename = {path}, .scale3d = {1, 1, -1}});
  CHECK(mirrored.quadraticTetrahedra == std::vector<QuadraticTetrahedron>{{0, 1, 3, 2, 4, 9, 7, 6, 5, 8}});
  auto const& e = mirrored.quadraticTetrahedra[0];
  for (auto const& [i, j, middle] : sinew::detail::quadraticTetrahedronEdges)
    CHECK(mirrored.position[std::size_t(e[middle])] ==
          (mirrored.position[std::size_t(e[i])] + mirrored.position[std::size_t(e[j])]) / 2);
}

TEST_CASE("loaders say what is wrong, and keep what they had") {
  const files::TempFolder folder;
  auto mesh = loaded(MeshOBJLoader{.filename = {folder.write("cube.obj", cube)}});
  const auto before = mesh.position;
  auto refused = [&](std::string_view words) {
    const std::string said = error_of([&] { mesh.update("/root/body"); });
    check_says(said, "/root/body: MeshOBJLoader", words);
    CHECK(mesh.position == before);
    CHECK(mesh.quads.size() == 6);
  };
  mesh.scale = 0;
  refused("scale or scale3d is 0");
  mesh.scale = 1, mesh.scale3d = {1, 0, 1};
  refused("scale or scale3d is 0");
  mesh.scale3d = {1, 1, 1}, mesh.rotation[1] = std::nan("");
  refused("rotation is nan degrees");
  mesh.rotation = {0, 0, 0}, mesh.filename.path = "";
  refused("filename is empty");
  mesh.filename.path = folder / "missing.obj";
  refused("missing.obj: cannot be read: No such file");
  mesh.filename.path = folder.write("bad.obj", "v 0 0 0\nf 1 2 3\n");
  refused("bad.obj:2: vertex 3 does not exist");
}

}  // namespace test_mesh_loader
