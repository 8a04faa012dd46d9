// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping follows two parents of different kinds, and names another number
#include <sinew/mapping/deformable_on_rigid_frame_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

int main() {
  using Alone = DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d, Parents<"../a">>;
  Simulation sim{node<"root">(EulerExplicitSolver{},
                              node<"a">(MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}),
                              node<"c">(MechanicalObject<Vec3d>{}, Alone{}))};
  sim.init();
  sim.animate(0.1);
}
