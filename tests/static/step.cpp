// SPDX-License-Identifier: BSL-1.0
// One step of a scene with springs, a rigid, mappings (one of them not linear, one with two parents), an
// interaction, an attachment, a state that is replayed and recorded, and an implicit solver, and nothing
// else: what the compiler makes of it is searched for indirect calls.
#include <sinew/sinew.hpp>

using namespace sinew;

inline auto scene() {
  return node<"root">(
      Gravity{},
      EulerImplicitSolver{},
      CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{},
      StiffSpringForceField<Vec3d, Between<"string", "brick/corner">>{},
      AttachProjectiveConstraint<Vec3d, Between<"string", "other">>{},
      node<"tool">(MechanicalObject<Rigid3d>{}, ReadState<Rigid3d>{}, WriteState<Rigid3d>{}),
      node<"string">(MechanicalObject<Vec3d>{},
                     UniformMass<Vec3d>{},
                     StiffSpringForceField<Vec3d>{},
                     FixedConstraint<Vec3d>{}),
      node<"brick">(MechanicalObject<Rigid3d>{},
                    UniformMass<Rigid3d>{},
                    node<"corner">(MechanicalObject<Vec3d>{}, RigidMapping<Rigid3d, Vec3d>{})),
      node<"other">(MechanicalObject<Vec3d>{},
                    UniformMass<Vec3d>{},
                    node<"length">(MechanicalObject<Vec1d>{},
                                   DistanceMapping<Vec3d, Vec1d>{},
                                   RestShapeSpringsForceField<Vec1d>{})),
      node<"both">(MechanicalObject<Vec3d>{},
                   SubsetMultiMapping<Vec3d, Vec3d, Parents<"../brick/corner", "../other">>{},
                   StiffSpringForceField<Vec3d>{}));
}

void step(Simulation<decltype(scene())>& sim);
void step(Simulation<decltype(scene())>& sim) { sim.animate(0.01); }
