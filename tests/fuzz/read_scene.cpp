// SPDX-License-Identifier: BSL-1.0
// libFuzzer: whatever the bytes of a scene file, reading, initialising and stepping it ends in a scene or in
// a SceneError. `fuzz_read_scene tests/fuzz/corpus` goes on from the corpus; `-runs=0` only runs that.
#include <sinew/registry.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>

#include <cstdlib>

namespace {

using namespace sinew;

struct Fuzzed
    : Registry<Gravity, MeshTopology, RegularGridTopology, TetrahedronTopology, VisualModel, MeshOBJLoader,
               BoxROI<Vec3d>, TransformEngine<Vec3d>, MechanicalObject<Vec3d>, MechanicalObject<Rigid3d>,
               MechanicalObject<Vec3f>, UniformMass<Vec3d>, UniformMass<Rigid3d>, DiagonalMass<Vec3d>,
               StiffSpringForceField<Vec3d>, StiffSpringForceField<Vec3d, Linked>, ConstantForceField<Vec3d>,
               TetrahedronFEMForceField<Vec3d>, FixedConstraint<Vec3d>, RigidMapping<Rigid3d, Vec3d>,
               IdentityMapping<Vec3d, Vec3d>, BarycentricMapping<Vec3d, Vec3f>, EulerImplicitSolver,
               EulerExplicitSolver, CGLinearSolver<>> {};

std::size_t points(RuntimeNode<Fuzzed> const& node) {
  std::size_t all = 0;
  for (auto const& entry : node.components())
    entry.component.visit<role::State, role::VisualModel>([&](auto const& s) { all += s.position.size(); });
  for (auto const& child : node.children()) all += points(*child);
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(unsigned char const* data, std::size_t size) {
  try {
    auto scene = parse_scene<Fuzzed>("fuzz.scn", std::string(reinterpret_cast<char const*>(data), size));
    const double dt = scene.dt;
    auto sim = start(std::move(scene));
    if (points(sim.root()) > 1000) return 0;
    for (int i = 0; i < 2; ++i) sim.animate(dt);
    // what was written is read again
    const std::string saved = scene_text(sim, dt);
    try {
      auto again = parse_scene<Fuzzed>("saved.scn", saved);
    } catch (SceneError const& error) {
      std::fprintf(stderr, "%s\n%s\n", error.what(), saved.c_str());
      std::abort();
    }
  } catch (Error const&) {
  }
  return 0;
}
