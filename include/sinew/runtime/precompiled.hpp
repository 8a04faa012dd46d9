// SPDX-License-Identifier: BSL-1.0
#pragma once

// Runtime scenes of the standard registry, instantiated once in the library sinew::standard of the CMake
// project, so that a program which links it compiles in seconds. Without it, and for another registry,
// include sinew/runtime/runtime.hpp and, as needed, read_scene.hpp, save_scene.hpp and bake.hpp.
#include <sinew/runtime/class_table.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/scene_files.hpp>
#include <sinew/runtime/standard_flags.hpp>

namespace sinew {

// kept in each file, also by --gc-sections, so that the linker looks for it
[[gnu::used
#if __has_cpp_attribute(gnu::retain)
  ,
  gnu::retain
#endif
]] static char const* const asked_of_sinew_standard = &StandardFlags::here;

using StandardSimulation = Simulation<RuntimeNode<Standard>>;

extern template detail::ComponentOperations const& AnyComponent<Standard>::operations(int);
extern template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixMat3x3d&);
extern template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixMat3x3f&);
extern template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixd&);
extern template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixMat3x3d>();
extern template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixMat3x3f>();
extern template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixd>();
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<double, 1> const&);
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<double, 2> const&);
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<double, 3> const&);
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<double, 6> const&);
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<float, 3> const&);
extern template void detail::place_block<AssemblyPhase::add>(detail::BlockTarget const&, int, int, int,
                                                             double const*, int, double const*,
                                                             Mat<float, 6> const&);
extern template void RuntimeScope<Standard>::expand(int, JacobianVisitor const&) const;

extern template struct StateVectors<RuntimeScope<Standard>>;
extern template void StateVectors<RuntimeScope<Standard>>::eq(CoordId, CoordId) const;
extern template void StateVectors<RuntimeScope<Standard>>::eq(DerivId, DerivId) const;
extern template void StateVectors<RuntimeScope<Standard>>::gather(Eigen::VectorXd&, DerivId) const;
extern template void StateVectors<RuntimeScope<Standard>>::scatter(DerivId, Eigen::VectorXd const&) const;
extern template void MechanicalOperations<RuntimeScope<Standard>>::propagate(CoordId, DerivId);
extern template void MechanicalOperations<RuntimeScope<Standard>>::propagate(DerivId);
extern template void MechanicalOperations<RuntimeScope<Standard>>::computeForce(DerivId, CoordId, DerivId,
                                                                                double);
extern template void MechanicalOperations<RuntimeScope<Standard>>::accFromF(DerivId, DerivId, CoordId);
extern template void MechanicalOperations<RuntimeScope<Standard>>::projectResponse(DerivId);
extern template void MechanicalOperations<RuntimeScope<Standard>>::projectPositionAndVelocity(double, CoordId,
                                                                                              DerivId);
extern template void MechanicalOperations<RuntimeScope<Standard>>::addMBKdx(DerivId, DerivId, MatrixFactors);
extern template void MechanicalOperations<RuntimeScope<Standard>>::split();
extern template void MechanicalOperations<RuntimeScope<Standard>>::formPattern();
extern template void MechanicalOperations<RuntimeScope<Standard>>::solveSystem(MatrixFactors, MultiVecDeriv&,
                                                                               MultiVecDeriv&);
extern template bool MechanicalOperations<RuntimeScope<Standard>>::solveSystemIfAny(MatrixFactors,
                                                                                    MultiVecDeriv&,
                                                                                    MultiVecDeriv&);
extern template bool MechanicalOperations<RuntimeScope<Standard>>::solveSystemAgain(MatrixFactors,
                                                                                    MultiVecDeriv&,
                                                                                    MultiVecDeriv&);
extern template double MechanicalOperations<RuntimeScope<Standard>>::kineticEnergy();
extern template double MechanicalOperations<RuntimeScope<Standard>>::potentialEnergy();
extern template void SystemMatrix<RuntimeScope<Standard>>::preallocate(AnyMatrix&,
                                                                       MechanicalParams const&) const;
extern template void SystemMatrix<RuntimeScope<Standard>>::bind(AnyMatrix&, MechanicalParams const&) const;
extern template void SystemMatrix<RuntimeScope<Standard>>::fill(AnyMatrix&, MechanicalParams const&) const;

extern template void Simulation<RuntimeNode<Standard>>::init(double, long);
extern template void Initialisation<RuntimeScope<Standard>>::run();
extern template void Initialisation<RuntimeScope<Standard>>::checkFields();
extern template void Initialisation<RuntimeScope<Standard>>::initStates();
extern template void Initialisation<RuntimeScope<Standard>>::initComponents();
extern template void Initialisation<RuntimeScope<Standard>>::initSolvers();
extern template void ConstrainedStep<RuntimeScope<Standard>>::integrate(ConstrainedMotion&, bool, bool) const;
extern template void ConstrainedStep<RuntimeScope<Standard>>::findCompliance(ConstrainedMotion&, bool) const;
extern template void Step<RuntimeScope<Standard>>::detectContacts() const;
extern template TopologyChange Simulation<RuntimeNode<Standard>>::removeElements(std::string_view,
                                                                                 ElementNumbers const&);
extern template TopologyChange Simulation<RuntimeNode<Standard>>::addElements(std::string_view,
                                                                              AddedElements const&);
extern template void Simulation<RuntimeNode<Standard>>::animate(double);
extern template void Simulation<RuntimeNode<Standard>>::reset();
extern template void Simulation<RuntimeNode<Standard>>::finish();
extern template void Simulation<RuntimeNode<Standard>>::propagate();
extern template void Simulation<RuntimeNode<Standard>>::updateVisual();
extern template double Simulation<RuntimeNode<Standard>>::kineticEnergy();
extern template double Simulation<RuntimeNode<Standard>>::potentialEnergy();

extern template std::vector<ClassInfo> make_class_table<Standard>();
extern template ReadScene<Standard> read_scene<Standard>(std::string const&, ReadSceneOptions const&,
                                                         checks::Right);
extern template ReadScene<Standard> parse_scene<Standard>(std::string const&, std::string,
                                                          ReadSceneOptions const&, checks::Right);
extern template std::string scene_text<Standard>(Simulation<RuntimeNode<Standard>>&, double);
extern template std::string bake_text<Standard>(ReadScene<Standard>, std::string const&, BakeOptions const&);

}  // namespace sinew
