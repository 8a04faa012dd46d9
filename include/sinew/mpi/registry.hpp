// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/registry.hpp>
#include <sinew/engine/mesh_vtk_loader.hpp>
#include <sinew/mpi/petsc_linear_solver.hpp>
#include <sinew/mpi/simulation.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>

namespace sinew::mpi {

/// What scene files may have that several processes step together: the classes that are distributed, and
/// engines that make their data before the scene starts.
struct Distributable : Registry<Gravity, MeshGmshLoader, MeshVTKLoader, MeshOBJLoader, BoxROI<Vec3d>,
                                SphereROI<Vec3d>, PlaneROI<Vec3d>, MeshTopology, TetrahedronTopology,
                                MechanicalObject<Vec3d>, UniformMass<Vec3d>, DiagonalMass<Vec3d>,
                                TetrahedronFEMForceField<Vec3d>, FixedConstraint<Vec3d>, EulerImplicitSolver,
                                EulerExplicitSolver, CGLinearSolver<>, PetscLinearSolver<>> {
  using Distribution = mpi::Distribution;
};

}  // namespace sinew::mpi
