// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/carving_manager.hpp>
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/tetrahedron_topology.hpp>
#include <sinew/visual/visual_model.hpp>

#include "collision/contact_scene.hpp"

#include <numeric>
#include <random>
#include <set>

namespace carving {

using namespace sinew;
using Point = Eigen::Vector3d;

constexpr MinProximityIntersection near{.alarmDistance = 0.1, .contactDistance = 0.05};

/// A block of n x n x m cells of 0.1 m, six tetrahedra each, its underside fixed.
struct Block {
  std::vector<Point> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<int> fixed{};

  Block(int n, int m) {
    auto number = [&](int i, int j, int k) { return (k * (n + 1) + j) * (n + 1) + i; };
    std::vector<Hexahedron> cells;
    for (int k = 0; k <= m; ++k)
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
          if (k == 0) fixed.push_back(number(i, j, k));
          points.push_back({0.1 * i, 0.1 * j, 0.1 * k});
          if (i == n || j == n || k == m) continue;
          cells.push_back({number(i, j, k),
                           number(i + 1, j, k),
                           number(i + 1, j + 1, k),
                           number(i, j + 1, k),
                           number(i, j, k + 1),
                           number(i + 1, j, k + 1),
                           number(i + 1, j + 1, k + 1),
                           number(i, j + 1, k + 1)});
        }
    tetrahedra = hexahedra_to_tetrahedra(cells);
  }
};

/// A block under a ball that nothing moves but the test, with a skin to look at, and a surface of its own in
/// a node below, as scenes of SOFA have it.
inline auto scene(std::vector<Point> const& points, std::vector<Tetrahedron> const& tetrahedra,
                  std::vector<int> const& fixed, std::vector<Triangle> const& skin,
                  std::vector<Triangle> const& surface, Point const& tool, bool surfaceCollides,
                  bool carves = true, std::optional<double> distance = {}) {
  MeshTopology triangles;
  triangles.triangles = surface;
  return contact_scene(
      near,
      1,
      CarvingManager{.active = carves, .carvingDistance = distance, .toolModel = "tool"},
      node<"block">(
          EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
          CGLinearSolver<>{.iterations = 20},
          TetrahedronTopology{tetrahedra},
          MechanicalObject<Vec3d>{.position = points},
          DiagonalMass<Vec3d>{.massDensity = 1000},
          TetrahedronFEMForceField<Vec3d>{.youngModulus = {20000}, .poissonRatio = 0.3},
          FixedConstraint<Vec3d>{.indices = fixed},
          TriangleCollisionModel<Vec3d>{.active = !surfaceCollides, .contactStiffness = 10},
          node<"skin">(VisualModel{Mesh{.positions = points, .triangles = skin}},
                       IdentityMapping<Vec3d, Vec3f>{}),
          node<"surface">(triangles,
                          MechanicalObject<Vec3d>{},
                          IdentityMapping<Vec3d, Vec3d>{},
                          TriangleCollisionModel<Vec3d>{.active = surfaceCollides, .contactStiffness = 10})),
      node<"tool">(MechanicalObject<Vec3d>{.position = {tool}},
                   SphereCollisionModel<Vec3d>{.simulated = false, .contactStiffness = 10, .radius = 0.1}));
}
inline auto scene(Block const& block, Point const& tool, bool surfaceCollides, bool carves = true,
                  std::optional<double> distance = {}) {
  const auto skin = border_of(block.tetrahedra, {}).triangles;
  return scene(
      block.points, block.tetrahedra, block.fixed, skin, skin, tool, surfaceCollides, carves, distance);
}

template <class List>
std::vector<Triangle> keys(List const& list) {
  std::vector<Triangle> all;
  for (auto const& f : list) {
    Triangle t{f[0], f[1], f[2]};
    // which way round it goes is part of what it is
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  return all;
}
inline double volume_of(std::vector<Point> const& p, std::vector<Tetrahedron> const& tetrahedra) {
  double sum = 0;
  for (auto const& t : tetrahedra) {
    auto at = [&](std::size_t k) { return p[std::size_t(t[k])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
  }
  return sum;
}

/// All that refers to the block refers to what is left of it.
template <class Sim>
void check_whole(Sim& sim) {
  auto& block = sim.template at<"block">();
  auto const& state = block.state();
  auto const& tetrahedra = block.template get<TetrahedronTopology>().tetrahedra;
  const std::size_t n = state.size();
  std::vector<bool> used(n, false);
  for (auto const& t : tetrahedra)
    for (const int i : t) {
      REQUIRE(i >= 0);
      REQUIRE(std::size_t(i) < n);
      used[std::size_t(i)] = true;
    }
  REQUIRE(std::find(used.begin(), used.end(), false) == used.end());
  REQUIRE(state.velocity.size() == n);
  REQUIRE(state.restPosition.size() == n);
  for (const int i : block.template get<FixedConstraint<Vec3d>>().indices)
    REQUIRE(state.restPosition[std::size_t(i)][2] == 0);

  const auto border = keys(border_of(tetrahedra, {}).triangles);
  auto& surface = sim.template at<"block/surface">();
  REQUIRE(surface.state().size() == n);
  REQUIRE(keys(surface.template get<MeshTopology>().triangles) == border);
  for (auto* model : {&block.template get<TriangleCollisionModel<Vec3d>>(),
                      &surface.template get<TriangleCollisionModel<Vec3d>>()}) {
    REQUIRE(keys(model->surface.elements) == border);
    REQUIRE(model->surface.position.size() == n);
    REQUIRE(model->surface.across.size() == border.size());
    REQUIRE(model->surface.firstAround.size() == n + 1);
    for (const int v : model->surface.touched) REQUIRE(std::size_t(v) < n);
  }
  auto& skin = sim.template at<"block/skin">().visual();
  REQUIRE(skin.position.size() == n);
  REQUIRE(keys(skin.mesh.triangles) == border);
  for (std::size_t i = 0; i < n; ++i)
    REQUIRE((skin.position[i].template cast<double>() - state.position[i]).norm() < 1e-6);

  auto& manager = sim.root().template get<Contacts>();
  for (Contact const& c : manager.contacts)
    for (ContactSide const* side : {&c.a, &c.b})
      for (int k = 0; k < side->corners(); ++k)
        REQUIRE(std::size_t(side->vertices[std::size_t(k)]) < (side->surface == 2 ? 1 : n));
  for (Attachment const& a : manager.attachments)
    for (int k = 0; k < a.contact.b.corners(); ++k)
      REQUIRE(std::size_t(a.contact.b.vertices[std::size_t(k)]) < n);

  // M 1 . 1 is the mass of what is left
  std::vector<Point> f(n, Point::Zero()), one(n, Point(1, 0, 0));
  block.template get<DiagonalMass<Vec3d>>().addMDx(f, state.position, one, 1);
  double mass = 0;
  for (auto const& x : f) mass += x[0];
  REQUIRE(mass == Approx(1000 * volume_of(state.restPosition, tetrahedra)).epsilon(1e-12));
}

/// A scene built afresh from what is left goes on to the same bits.
template <class Sim>
void check_as_fresh(Sim& sim, bool surfaceCollides) {
  auto& block = sim.template at<"block">();
  auto const& state = block.state();
  auto fresh = scene(state.restPosition,
                     block.template get<TetrahedronTopology>().tetrahedra,
                     block.template get<FixedConstraint<Vec3d>>().indices,
                     sim.template at<"block/skin">().visual().mesh.triangles,
                     sim.template at<"block/surface">().template get<MeshTopology>().triangles,
                     sim.template at<"tool">().state().position[0],
                     surfaceCollides,
                     false);
  auto& there = fresh.root().template child<"block">().state();
  there.restPosition = state.restPosition;
  there.position = state.position;
  there.velocity = state.velocity;
  fresh.init();
  auto copy = sim;
  copy.root().template get<CarvingManager>().active = false;
  for (int k = 0; k < 2; ++k) copy.animate(0.01), fresh.animate(0.01);
  REQUIRE(copy.root().template get<Contacts>().contacts.size() ==
          fresh.root().template get<Contacts>().contacts.size());
  REQUIRE(copy.template at<"block">().state().position == there.position);
  REQUIRE(copy.template at<"block">().state().velocity == there.velocity);
}

}  // namespace carving
