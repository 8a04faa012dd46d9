// SPDX-License-Identifier: BSL-1.0
#pragma once

// Elements removed while a scene runs: against scenes built afresh from what is left.
#include <sinew/sinew.hpp>

#include <cstring>
#include <random>
#include <set>

#include "catch.hpp"

namespace removal {

using namespace sinew;

/// A block of n^3 cells, six tetrahedra each, its surface as triangles, and what a scene says of it by
/// numbers of points and elements: built afresh for any part of its tetrahedra.
struct Block {
  std::vector<Eigen::Vector3d> points{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Triangle> triangles{};
  std::vector<double> stiffness{};
  std::vector<int> fixed{}, pushed{};
  std::vector<Eigen::Vector3d> push{};
  std::vector<Spring> springs{};

  explicit Block(int n) {
    RegularGridTopology grid{.n = {n + 1, n + 1, n + 1}, .min = {0, 0, 0}, .max = {1, 1, 1}};
    grid.generate("grid");
    points = grid.position;
    tetrahedra = hexahedra_to_tetrahedra(grid.hexahedra);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> part(0, 1);
    for (std::size_t e = 0; e < tetrahedra.size(); ++e) stiffness.push_back(1000 * (1 + part(random)));
    std::map<Triangle, std::pair<int, Triangle>> faces;
    for (auto const& t : tetrahedra)
      for (Triangle f : {Triangle{t[1], t[2], t[3]},
                         Triangle{t[0], t[3], t[2]},
                         Triangle{t[0], t[1], t[3]},
                         Triangle{t[0], t[2], t[1]}}) {
        Triangle key = f;
        std::sort(key.begin(), key.end());
        ++faces[key].first;
        faces[key].second = f;
      }
    for (auto const& [key, face] : faces)
      if (face.first == 1) triangles.push_back(face.second);
    for (int i = 0; i < int(points.size()); ++i) {
      if (points[std::size_t(i)].z() == 0) fixed.push_back(i);
      if (points[std::size_t(i)].z() == 1) {
        pushed.push_back(i);
        push.push_back({part(random), 0, 0});
      }
    }
    const int last = int(points.size()) - 1;
    for (int i = 0; i < 12; ++i)
      springs.push_back({.first = i, .second = last - i, .stiffness = 20, .damping = 0.1});
  }

  /// The block with some of its tetrahedra only; `was` are the numbers of its points in this one.
  Block part(std::vector<bool> const& stays, std::vector<int>& was) const {
    Block left = *this;
    left.tetrahedra.clear(), left.triangles.clear(), left.stiffness.clear(), left.fixed.clear();
    left.pushed.clear(), left.push.clear(), left.springs.clear(), left.points.clear(), was.clear();
    std::set<int> used;
    std::set<std::set<int>> faces;
    for (std::size_t e = 0; e < tetrahedra.size(); ++e)
      if (stays[e]) {
        auto const& t = tetrahedra[e];
        used.insert(t.begin(), t.end());
        left.tetrahedra.push_back(t);
        left.stiffness.push_back(stiffness[e]);
        for (std::size_t k = 0; k < 4; ++k) faces.insert({t[k], t[(k + 1) % 4], t[(k + 2) % 4]});
      }
    std::map<int, int> now;
    for (const int i : used) {
      now[i] = int(was.size());
      was.push_back(i);
      left.points.push_back(points[std::size_t(i)]);
    }
    for (auto& t : left.tetrahedra)
      for (int& i : t) i = now[i];
    for (Triangle t : triangles)
      if (faces.contains({t[0], t[1], t[2]})) {
        for (int& i : t) i = now[i];
        left.triangles.push_back(t);
      }
    for (const int i : fixed)
      if (now.contains(i)) left.fixed.push_back(now[i]);
    for (std::size_t k = 0; k < pushed.size(); ++k)
      if (now.contains(pushed[k])) {
        left.pushed.push_back(now[pushed[k]]);
        left.push.push_back(push[k]);
      }
    for (Spring s : springs)
      if (now.contains(s.first) && now.contains(s.second)) {
        s.first = now[s.first], s.second = now[s.second];
        left.springs.push_back(s);
      }
    return left;
  }
};

inline Mesh skin_of(Block const& whole) {
  Mesh skin{.positions = whole.points};
  skin.triangles = whole.triangles;
  for (auto& p : skin.positions) p += Eigen::Vector3d(1e-3, 2e-3, -1e-3);
  return skin;
}

template <class Linear>
auto scene(Block const& block, Mesh const& skin, Linear linear) {
  return Simulation{node<"root">(
      Gravity{{0, 0, -1}},
      EulerImplicitSolver{.rayleighStiffness = 0.05, .rayleighMass = 0.5},
      linear,
      node<"block">(TetrahedronTopology{block.tetrahedra},
                    MechanicalObject<Vec3d>{.position = block.points},
                    DiagonalMass<Vec3d>{.massDensity = 2},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = block.stiffness, .poissonRatio = 0.3},
                    StiffSpringForceField<Vec3d>{.springs = block.springs},
                    ConstantForceField<Vec3d>{.indices = block.pushed, .forces = block.push},
                    FixedConstraint<Vec3d>{.indices = block.fixed},
                    node<"surface">(MeshTopology{.triangles = block.triangles},
                                    SurfacePressureForceField<Vec3d>{.pressure = 3}),
                    node<"skin">(VisualModel{skin}, BarycentricMapping<Vec3d, Vec3f>{}),
                    node<"top">(MechanicalObject<Vec3d>{},
                                SubsetMapping<Vec3d, Vec3d>{.indices = block.pushed},
                                UniformVelocityDampingForceField<Vec3d>{.dampingCoefficient = 0.1})))};
}

template <class List>
bool same(List const& a, List const& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(typename List::value_type)) == 0;
}

/// Removes tetrahedra at random over many steps; after each removal a scene built afresh from what is left,
/// in the same motion, must go on in the same way to the bit.
template <class Linear>
int remove_at_random(int cells, int steps, int every, Linear linear) {
  if (brief) steps /= 8, every /= 8;
  const Block whole(cells);
  const Mesh skin = skin_of(whole);
  auto sim = scene(whole, skin, linear);
  sim.init();
  std::vector<bool> stays(whole.tetrahedra.size(), true);
  std::vector<int> alive;  // numbers in the whole block, by those in what is left
  for (int e = 0; e < int(stays.size()); ++e) alive.push_back(e);
  std::mt19937 random(3);
  int removals = 0;
  for (int step = 0; step < steps && alive.size() > 3; ++step) {
    sim.animate(0.01);
    if (step % every != 0) continue;
    std::set<int> gone;
    const int count = 1 + int(random() % 2);
    while (int(gone.size()) < count) gone.insert(int(random() % alive.size()));
    const auto change = sim.removeElements("block", {.tetrahedra = {gone.begin(), gone.end()}});
    ++removals;
    for (auto e = gone.rbegin(); e != gone.rend(); ++e) {
      stays[std::size_t(alive[std::size_t(*e)])] = false;
      alive.erase(alive.begin() + *e);
    }
    CHECK(change.of(ElementKind::tetrahedron).kept.size() == alive.size());

    std::vector<int> was;
    const Block left = whole.part(stays, was);
    auto& block = sim.template at<"block">();
    REQUIRE(block.state().size() == left.points.size());
    REQUIRE(block.template get<TetrahedronTopology>().tetrahedra == left.tetrahedra);
    REQUIRE(sim.template at<"block/surface">().template get<MeshTopology>().triangles == left.triangles);
    if (left.pushed.empty() || left.triangles.empty()) break;  // a fresh scene would have no such component
    auto fresh = scene(left, skin, linear);
    auto& state = fresh.root().template child<"block">().state();
    state.restPosition = left.points;
    state.position = block.state().position;
    state.velocity = block.state().velocity;
    fresh.init();
    fresh.continueFrom(sim.time(), sim.step());
    auto copy = sim;
    for (int k = 0; k < 2; ++k) copy.animate(0.01), fresh.animate(0.01);
    REQUIRE(same(copy.template at<"block">().state().position, state.position));
    REQUIRE(same(copy.template at<"block">().state().velocity, state.velocity));
    REQUIRE(same(copy.template at<"block/skin">().visual().position,
                 fresh.template at<"block/skin">().visual().position));
    REQUIRE(copy.potentialEnergy() == fresh.potentialEnergy());
  }
  return removals;
}

}  // namespace removal
