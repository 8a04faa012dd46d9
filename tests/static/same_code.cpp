// SPDX-License-Identifier: BSL-1.0
// One step of a scene that is not profiled: its code is compared with that from headers without timers.
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

using Scene = decltype(node<"root">(
    Gravity{}, EulerImplicitSolver{}, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{},
    node<"chain">(
        MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, StiffSpringForceField<Vec3d>{},
        FixedConstraint<Vec3d>{},
        node<"end">(MechanicalObject<Vec3d>{}, SubsetMapping<Vec3d, Vec3d>{}, UniformMass<Vec3d>{}))));

void step(Simulation<Scene>& sim);
void step(Simulation<Scene>& sim) { sim.animate(0.01); }
