// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "io/files.hpp"
#include "vitrectomy/registry.hpp"

#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/save_scene.hpp>

namespace test_vitrectomy_scene {

using namespace sinew;

namespace {

template <class State>
void add_bits(std::string& bits, State const& state) {
  auto add = [&](auto const& v) {
    bits.append(reinterpret_cast<char const*>(v.data()), v.size() * sizeof(v[0]));
  };
  add(state.position), add(state.velocity);
}
std::string bits_of(Simulation<RuntimeNode<examples::VitrectomyComponents>>& sim) {
  std::string bits;
  add_bits(bits, *sim.root().find_node("eye")->template get<MechanicalObject<Vec3d>>());
  add_bits(bits, *sim.root().find_node("tool")->template get<MechanicalObject<Rigid3d>>());
  return bits;
}

}  // namespace

TEST_CASE(
    "vitrectomy.scn is the typed scene, to the bit, and goes on from a checkpoint in the middle of a cut") {
  using Components = examples::VitrectomyComponents;
  const files::TempFolder folder;
  const examples::Eye eye = examples::make_eye({.sectors = 24});
  examples::write_scene_data(eye, folder / "data");
  auto scene = read_scene<Components>(SINEW_VITRECTOMY_SCENE, {.dataPaths = {folder / "data"}});
  CHECK(scene.warnings.empty());
  const double dt = scene.dt;
  auto sim = start(std::move(scene));
  auto typed = examples::vitrectomy_scene(eye);
  typed.init();
  auto& cuttable = typed.at<"eye">().get<examples::CuttableSpringForceField<Vec3d>>();
  auto typed_bits = [&] {
    std::string bits;
    add_bits(bits, typed.at<"eye">().state());
    add_bits(bits, typed.at<"tool">().state());
    return bits;
  };
  for (int i = 0; i < 400; ++i) sim.animate(dt), typed.animate(dt);
  CHECK(cuttable.springs.size() < eye.cuttable.size());
  CHECK(bits_of(sim) == typed_bits());
  const std::string cut = bits_of(sim);

  const std::size_t half = cuttable.springs.size();
  auto again = start(parse_scene<Components>("checkpoint.scn", scene_text(sim, dt)));
  CHECK(again.root().find_node("eye")->get<examples::CuttableSpringForceField<Vec3d>>()->springs.size() ==
        half);
  for (int i = 0; i < 200; ++i) sim.animate(dt), typed.animate(dt), again.animate(dt);
  CHECK(cuttable.springs.size() < half);
  CHECK(bits_of(sim) == typed_bits());
  CHECK(bits_of(again) == typed_bits());

  // a reset brings the springs back, those too that were cut before the checkpoint
  sim.reset(), typed.reset(), again.reset();
  CHECK(cuttable.springs.size() == eye.cuttable.size());
  for (int i = 0; i < 400; ++i) sim.animate(dt), typed.animate(dt), again.animate(dt);
  CHECK(bits_of(sim) == cut);
  CHECK(bits_of(again) == cut);
  CHECK(typed_bits() == cut);
}

}  // namespace test_vitrectomy_scene
