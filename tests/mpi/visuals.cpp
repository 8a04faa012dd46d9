// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "mpi/ranks.hpp"

#include <sinew/visual/visual_model.hpp>

namespace test_visuals {

using namespace ranks_test;

/// Vertices inside the bar, on its points, and on some of them, beside one that nothing moves.
auto looked_at() {
  const Mesh inside = regular_grid_tetrahedra(9, 3, 3, {0.1, 0.1, 0.1}, {2.9, 0.8, 0.9});
  Mesh skin{.positions = inside.positions, .triangles = {{0, 1, 9}, {70, 71, 80}}};
  const Mesh tips{.positions = {{3, 0, 0}, {3, 1, 0}, {3, 1, 1}}, .triangles = {{0, 1, 2}}};
  return bar(EulerExplicitSolver{},
             CGLinearSolver<>{},
             node<"skin">(VisualModel{.mesh = skin,
                                      .texcoords = {{0, 0}, {1, 0}, {0, 1}},
                                      .textureTriangles = {{0, 1, 2}, {2, 1, 0}}},
                          BarycentricMapping<Vec3d, Vec3f>{},
                          // faces over the vertices, not over the points of the bar
                          MeshTopology{.triangles = skin.triangles}),
             node<"points">(VisualModel{}, IdentityMapping<Vec3d, Vec3f>{}),
             node<"tips">(VisualModel{.mesh = tips}, SubsetMapping<Vec3d, Vec3f>{.radius = 0.01}),
             node<"ground">(VisualModel{.mesh = tips}));
}

double apart(Vec3f::VecCoord const& a, Vec3f::VecCoord const& b) {
  double most = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    most = std::max(most, double((a[i] - b[i]).norm()));
  return most;
}

TEST_CASE("what is only looked at takes no part in steps, and the whole scene has it where it is") {
  Simulation one{looked_at()};
  mpi::DistributedSimulation many{looked_at(), std::make_shared<mpi::Communicator>()};
  many.keepWhole();
  one.init(), many.init();
  for (int i = 0; i < 20; ++i) one.animate(1e-3), many.animate(1e-3);
  const Positions v = many.everywhere(many.root().state(), vec_id::velocity);
  CHECK(v == velocities(bar(EulerExplicitSolver{}, CGLinearSolver<>{}), 20, 1e-3));
  CHECK(distance(one.root().state().velocity, v) < 1e-11 * length(v));
  hana::for_each(many.root().children, [](auto& child) { CHECK(child.visual().mesh.positions.empty()); });

  auto compare = [&](auto const& whole, auto& expected) {
    // float
    CHECK(apart(whole.visual().position, expected.visual().position) < 2e-6);
    CHECK(whole.visual().mesh.triangles == expected.visual().mesh.triangles);
    CHECK(whole.visual().texcoords == expected.visual().texcoords);
  };
  bool seen = false;
  many.look([&](auto const& whole) {
    seen = true;
    auto& bodies = whole.node.children;
    compare(hana::at_c<0>(bodies), one.at<"skin">());
    compare(hana::at_c<1>(bodies), one.at<"points">());
    compare(hana::at_c<2>(bodies), one.at<"tips">());
    compare(hana::at_c<3>(bodies), one.at<"ground">());
    auto const& skin = hana::at_c<0>(bodies).visual();
    CHECK(skin.position.size() == 81);
    CHECK((skin.position[80] - skin.mesh.positions[80].template cast<float>()).norm() > 1e-4);
  });
  CHECK(seen == (many.ranks().rank() == 0));
  // of a checkpoint
  auto const* const whole = many.whole();
  if (whole) CHECK(hana::at_c<0>(whole->children).visual().mesh.positions.size() == 81);

  CHECK(says(error_of([&] {
               mpi::DistributedSimulation{looked_at(), std::make_shared<mpi::Communicator>()}.look(
                   [](auto const&) {});
             }),
             {"DistributedSimulation::whole", "keepWhole()"}));
}

}  // namespace test_visuals
