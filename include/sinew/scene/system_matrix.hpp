// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/scene/mapped_states.hpp>
#include <sinew/scene/mechanical_forces.hpp>
#include <sinew/scene/projections.hpp>
#include <sinew/scene/solver_contacts.hpp>
#include <sinew/scene/state_vectors.hpp>

namespace sinew {

/// The matrix of a linear solver, of all that is at and below a scope, `root`, over the degrees of freedom of
/// the independent states:
///   matrix = P (m M + b B + k K) P + (I - P)
template <class Root>
struct SystemMatrix {
  Root const& root;

  /// Numbers the degrees of freedom from blocks of `matrix` on, and fixes its pattern.
  template <class Matrix>
  void init(Matrix& matrix, MechanicalParams const& p) const {
    [[maybe_unused]] const auto span = root.span(Phase::pattern);
    const StateVectors<Root> vectors{root};
    const int dofs = vectors.numberDofs(Matrix::blockSize);
    matrix.startPattern(dofs);
    auto&& assembled = root.assembled(matrix);
    preallocate(assembled, p);
    matrix.finishPattern();
    if constexpr (Root::threaded && requires { matrix.split(1); }) {
      matrix.split(root.workers().count());
      vectors.reserveSums(std::size_t(dofs));
    }
    bind(assembled, p);
  }
  template <class Matrix>
  void assemble(Matrix& matrix, MechanicalParams const& p) const {
    [[maybe_unused]] const auto span = root.span(Phase::assembly);
    if constexpr (Root::threaded && requires { matrix.setZero(root.workers()); })
      matrix.setZero(root.workers());
    else
      matrix.setZero();
    auto&& assembled = root.assembled(matrix);
    fill(assembled, p);
    // the padding of the last block of a state belongs to no degree of freedom
    StateVectors<Root>{root}.forEachIndependent([&](auto& s) {
      const int end = s.dofOffset + int(s.size()) * std::decay_t<decltype(s)>::DataTypes::size;
      for (int dof = end; dof % Matrix::blockSize != 0; ++dof) matrix.fix(dof);
    });
  }

 private:
  template <class Matrix>
  void preallocate(Matrix& matrix, MechanicalParams const& p) const;
  template <class Matrix>
  void bind(Matrix& matrix, MechanicalParams const& p) const;
  template <class Matrix>
  void fill(Matrix& matrix, MechanicalParams const& p) const;

  template <AssemblyPhase Phase, class Matrix>
  void add(Matrix& matrix, MechanicalParams const& p) const {
    MappedStates<Root>{root}.template assemble<Phase>(matrix, p);
    MechanicalForces<Root>{root}.template assemble<Phase>(matrix, p);
    SolverContacts<Root>{root}.template assemble<Phase>(matrix, p);
  }
};

// Outside the class, so that a program may have them instantiated in one place: runtime/precompiled.hpp.

template <class Root>
template <class Matrix>
void SystemMatrix<Root>::preallocate(Matrix& matrix, MechanicalParams const& p) const {
  add<AssemblyPhase::pattern>(matrix, p);
  Projections<Root>{root}.preallocate(matrix);
}
template <class Root>
template <class Matrix>
void SystemMatrix<Root>::bind(Matrix& matrix, MechanicalParams const& p) const {
  add<AssemblyPhase::bind>(matrix, p);
}
template <class Root>
template <class Matrix>
void SystemMatrix<Root>::fill(Matrix& matrix, MechanicalParams const& p) const {
  add<AssemblyPhase::add>(matrix, p);
  Projections<Root>{root}.projectMatrix(matrix);
}

}  // namespace sinew
