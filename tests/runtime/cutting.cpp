// SPDX-License-Identifier: BSL-1.0
// Blades of scene files: an incision that opens, a flap that is lifted.
#include "catch.hpp"
#include "topology/cut_bodies.hpp"

#include <sinew/contact.hpp>
#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/precompiled.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

#include <fstream>
#include <iterator>

namespace test_cutting_scenes {

using namespace sinew;

namespace {

using Few = Standard;
using Sim = Simulation<RuntimeNode<Few>>;

struct Started {
  Sim sim;
  double dt;
};
Started started(std::string const& text) {
  auto read = parse_scene<Few>("cutting.scn", text);
  const double dt = read.dt;
  Started s{Sim(std::move(read.root)), dt};
  s.sim.init(read.time, read.step);
  return s;
}
std::string scene_of(std::string const& name) {
  std::ifstream file(std::string(SINEW_EXAMPLE_SCENES) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}
cutting::Body body_of(Sim& sim, std::string const& path) {
  auto* const body = sim.root().find_node(path);
  auto const& topology = *body->template get<MeshTopology>();
  return {body->template get<MechanicalObject<Vec3d>>()->restPosition,
          topology.tetrahedra,
          body->find_node("surface")->template get<MeshTopology>()->triangles};
}

}  // namespace

TEST_CASE("an incision opens under the tension of the skin", "[long]") {
  auto [sim, dt] = started(scene_of("incision.scn"));
  const auto before = body_of(sim, "skin");
  while (sim.time() < 2.5) sim.animate(dt);
  const auto now = body_of(sim, "skin");
  CHECK(sim.root().get<CuttingManager>()->refused == 0);
  CHECK(now.points.size() > before.points.size() + 30);
  CHECK(cutting::volume(now) == Approx(cutting::volume(before)).epsilon(1e-12));
  CHECK(cutting::worst(now) >= 0.1);
  CHECK(cutting::has_its_skin(now));
  CHECK(cutting::pieces(now) == 1);
  // the lips are apart: points that are one at rest
  double gap = 0;
  auto const& x = sim.root().find_node("skin")->get<MechanicalObject<Vec3d>>()->position;
  for (std::size_t i = before.points.size(); i < now.points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((now.points[i] - now.points[j]).norm() < 1e-9) gap = std::max(gap, (x[i] - x[j]).norm());
  CHECK(gap > 0.004);
  CHECK(gap < 0.03);
}

TEST_CASE("a flap is cut free and lifted; a scene that is saved then goes on") {
  auto [sim, dt] = started(scene_of("flap.scn"));
  const auto before = body_of(sim, "tissue");
  while (sim.time() < 2.5) sim.animate(dt);
  const auto now = body_of(sim, "tissue");
  CHECK(sim.root().get<CuttingManager>()->refused == 0);
  CHECK(cutting::pieces(now) == 1);
  CHECK(cutting::volume(now) == Approx(cutting::volume(before)).epsilon(1e-12));
  CHECK(cutting::has_its_skin(now));
  auto const& x = sim.root().find_node("tissue")->get<MechanicalObject<Vec3d>>()->position;
  double high = 0;
  for (auto const& p : x) high = std::max(high, p[2]);
  CHECK(high > 0.03);

  auto again = started(scene_text(sim, dt));
  CHECK(body_of(again.sim, "tissue").tetrahedra == now.tetrahedra);
  for (int i = 0; i < 5; ++i) sim.animate(dt), again.sim.animate(dt);
  auto const& y = again.sim.root().find_node("tissue")->get<MechanicalObject<Vec3d>>()->position;
  REQUIRE(x.size() == y.size());
  for (std::size_t i = 0; i < x.size(); ++i) CHECK((x[i] - y[i]).norm() < 1e-6);
}

}  // namespace test_cutting_scenes
