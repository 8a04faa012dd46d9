// SPDX-License-Identifier: BSL-1.0
// Compiled once for each scene, with
//   BAKED_HEADER  "springs.hpp", which the generator wrote
//   BAKED_NAME    springs, the function in it
//   BAKED_DT      its time step: springsDt
//   BAKED_SCENE   "/path/springs.scn"
//   BAKED_ENGINES where it needs the registry of point_engine.hpp
#include "catch.hpp"

#ifdef BAKED_ENGINES
#include "runtime/bake/point_engine.hpp"

#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
using Registered = sinew::Tested;
#else
#include <sinew/runtime/precompiled.hpp>
using Registered = sinew::Standard;
#endif

#include BAKED_HEADER

using namespace sinew;

namespace {

// their words are those of the same bits; structs may have gaps between members, so memory does not say
template <class X>
bool same_bits(std::vector<X> const& a, std::vector<X> const& b) {
  return a.size() == b.size() && write_value(a) == write_value(b);
}

struct Counts {
  int nodes = 0, components = 0, states = 0, visuals = 0;
};

// the same nodes with the same components, and states of the same bits
template <class N>
void compare(N const& typed, RuntimeNode<Registered> const& runtime, Counts& counts) {
  INFO(runtime.path());
  ++counts.nodes;
  CHECK(N::name.view() == runtime.name);
  REQUIRE(std::size_t(N::childCount) == runtime.children().size());
  hana::for_each(typed.components, [&](auto const& c) {
    using C = std::decay_t<decltype(c)>;
    counts.components += !HasRole<C, role::Engine> && !HasRole<C, role::DataLink>;
    if constexpr (HasRole<C, role::State>) {
      auto const* other = runtime.template get<C>();
      REQUIRE(other != nullptr);
      ++counts.states;
      CHECK(same_bits(c.position, other->position));
      CHECK(same_bits(c.velocity, other->velocity));
      CHECK(same_bits(c.restPosition, other->restPosition));
    } else if constexpr (HasRole<C, role::VisualModel>) {
      auto const* other = runtime.template get<C>();
      REQUIRE(other != nullptr);
      ++counts.visuals;
      CHECK(same_bits(c.position, other->position));
      CHECK(c.mesh == other->mesh);
    }
  });
  std::size_t i = 0;
  hana::for_each(typed.children,
                 [&](auto const& child) { compare(child, *runtime.children()[i++], counts); });
}

Counts count(RuntimeNode<Registered> const& node, std::vector<ClassInfo> const& table) {
  Counts counts{.nodes = 1};
  for (auto const& entry : node.components()) {
    const RoleKind role = table[std::size_t(entry.component.type())].role;
    counts.components += role != RoleKind::engine;
    counts.states += role == RoleKind::state;
    counts.visuals += role == RoleKind::visualModel;
  }
  for (auto const& child : node.children()) {
    const Counts more = count(*child, table);
    counts.nodes += more.nodes, counts.components += more.components;
    counts.states += more.states, counts.visuals += more.visuals;
  }
  return counts;
}

}  // namespace

TEST_CASE("a baked scene and its file give the same bits") {
  auto baked_ = baked::BAKED_NAME();
  auto read = read_scene<Registered>(BAKED_SCENE, {});
  CHECK(read.dt == baked::BAKED_DT);
  const double dt = read.dt;
  Simulation<RuntimeNode<Registered>> run{std::move(read.root)};
  baked_.init();
  run.init();
  for (int step = 0; step < 300; ++step) {
    baked_.animate(dt);
    run.animate(dt);
  }
  baked_.updateVisual();
  run.updateVisual();
  Counts counts;
  compare(baked_.root(), run.root(), counts);
  const Counts all = count(run.root(), make_class_table<Registered>());
  CHECK(counts.nodes == all.nodes);
  CHECK(counts.components == all.components);
  CHECK(counts.states == all.states);
  CHECK(counts.visuals == all.visuals);
  // and something moved
  const double energy = run.kineticEnergy();
  CHECK(energy > 0);
  CHECK(energy == baked_.kineticEnergy());
}
