// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>

#include "catch.hpp"
#include "io/files.hpp"
#include "io/samples.hpp"
#include "mesh_checks.hpp"

namespace test_mesh_topology {

using namespace sinew;

namespace {

const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

template <class D = Vec3d, class Topology>
std::string init_error(Topology const& topology, typename D::VecCoord const& rest) {
  return error_of([&] { topology.init(InitContext<D>{"/root/body", rest, topology.view()}); });
}

}  // namespace

TEST_CASE("MeshTopology shows its lists") {
  const MeshTopology mesh{.position = corners,
                          .edges = {{0, 1}},
                          .triangles = {{0, 1, 2}, {0, 1, 3}},
                          .quads = {{0, 1, 2, 3}},
                          .tetrahedra = {{0, 1, 2, 3}},
                          .hexahedra = {{0, 1, 2, 3, 0, 1, 2, 3}},
                          .pyramids = {{0, 1, 2, 3, 0}},
                          .prisms = {{0, 1, 2, 3, 0, 1}}};
  const TopologyView view = mesh.view();
  CHECK(view.positions.size() == 4);
  CHECK(view.positions.data() == mesh.position.data());
  CHECK(view.edges.data() == mesh.edges.data());
  CHECK(view.triangles.data() == mesh.triangles.data());
  CHECK(view.quads.data() == mesh.quads.data());
  CHECK(view.tetrahedra.data() == mesh.tetrahedra.data());
  CHECK(view.hexahedra.data() == mesh.hexahedra.data());
  CHECK(view.pyramids.data() == mesh.pyramids.data());
  CHECK(view.prisms.data() == mesh.prisms.data());
  CHECK(view.grid == std::array<int, 3>{0, 0, 0});
  CHECK(init_error(mesh, corners).empty());
  // an empty one over points is no mistake; nor are points that no element uses, nor fewer positions than
  // those
  CHECK(init_error(MeshTopology{}, corners).empty());
  CHECK(init_error(MeshTopology{.position = {{0, 0, 0}}, .edges = {{2, 3}}}, corners).empty());
}

TEST_CASE("MeshTopology refuses indices that the state has no point for") {
  auto refused = [](MeshTopology const& mesh, std::string_view words) {
    const std::string said = init_error(mesh, corners);
    INFO(said);
    CHECK(contains(said, "/root/body: MeshTopology: "));
    CHECK(contains(said, words));
  };
  refused({.edges = {{0, 1}, {3, 4}}}, "edge 1 refers to point 4, but there are 4 points");
  refused({.edges = {{-1, 1}}}, "edge 0 refers to point -1");
  refused({.triangles = {{0, 1, 7}}}, "triangle 0 refers to point 7");
  refused({.quads = {{0, 1, 7, 2}}}, "quad 0 refers to point 7");
  refused({.tetrahedra = {{0, 1, 2, 4}}}, "tetrahedron 0 refers to point 4");
  refused({.hexahedra = {{0, 1, 2, 3, 4, 5, 6, 7}}}, "hexahedron 0 refers to point 4");
  refused({.pyramids = {{0, 1, 2, 3, 4}}}, "pyramid 0 refers to point 4");
  refused({.prisms = {{0, 1, 2, 3, 0, 9}}}, "prism 0 refers to point 9");
  refused({.quadraticTetrahedra = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}}},
          "quadratic tetrahedron 0 refers to point 4");
  refused({.quadraticTetrahedra = {{0, 1, 2, 3, 0, 1, 2, 3, 0, 1}}},
          "quadratic tetrahedron 0 has point 0 twice; give it 10 different points");
  refused({.quadraticHexahedra = {QuadraticHexahedron{}}}, "quadratic hexahedron 0 has point 0 twice");
  refused({.triquadraticHexahedra = {TriquadraticHexahedron{}}},
          "triquadratic hexahedron 0 has point 0 twice");
  // more positions of its own do not help
  refused({.position = std::vector<Eigen::Vector3d>(5), .edges = {{0, 4}}}, "edge 0 refers to point 4");

  CHECK(contains(error_of([] { check_fields(MeshTopology{.edges = {{0, -2}}}, "s"); }), "edges[0][1] is -2"));
  CHECK(contains(error_of([] {
                   check_fields(MeshTopology{.position = {{0, std::nan(""), 0}}}, "s");
                 }),
                 "position[0] is nan"));
}

TEST_CASE("both topologies refuse flat tetrahedra and those inside out") {
  const std::vector<Tetrahedron> mirrored{{0, 1, 2, 3}, {0, 2, 1, 3}}, flat{{0, 1, 2, 2}};
  for (const std::string& said : {init_error(MeshTopology{.tetrahedra = mirrored}, corners),
                                  init_error(TetrahedronTopology{.tetrahedra = mirrored}, corners)})
    CHECK(contains(said, "tetrahedron 1 is inside out (volume -0.166666667 m^3)"));
  for (const std::string& said : {init_error(MeshTopology{.tetrahedra = flat}, corners),
                                  init_error(TetrahedronTopology{.tetrahedra = flat}, corners)})
    CHECK(contains(said, "tetrahedron 0 has no volume"));
  // there is no volume in the plane to ask for
  CHECK(init_error<Vec2d>(MeshTopology{.tetrahedra = mirrored}, {{0, 0}, {1, 0}, {0, 1}, {1, 1}}).empty());
}

TEST_CASE("MeshTopology takes from a file what it is not given") {
  const files::TempFolder folder;
  MeshTopology mesh{.triangles = {{0, 1, 2}}, .filename = {folder.write("a.msh", samples::gmsh2)}};
  for (int round = 0; round < 2; ++round) {
    mesh.generate("/root");
    CHECK(mesh.position == samples::mesh().positions);
    CHECK(mesh.tetrahedra == samples::mesh().tetrahedra);
    CHECK(mesh.edges == samples::mesh().edges);
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  }
  MeshTopology none{.edges = {{0, 1}}};
  none.generate("/root");
  CHECK((none.position.empty() && none.edges.size() == 1));
  none.filename.path = folder / "missing.obj";
  const std::string said = error_of([&] { none.generate("/root"); });
  CHECK(contains(said, "/root: MeshTopology: "));
  CHECK(contains(said, "missing.obj: cannot be read"));
}

}  // namespace test_mesh_topology
