// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>

#include <tuple>
#include <type_traits>
#include <utility>

namespace sinew {

/// The three traversals in which components meet the matrix of a solver: `pattern` and `bind` once at init,
/// `add` in each step. Components call the same `add` in all of them; drivers find the places of their blocks
/// in `bind`.
enum class AssemblyPhase { pattern, bind, add };

/// Jacobian of degrees of freedom that are the system's own.
struct IdentityJacobian {
  template <class J>
  friend J const& operator*(J const& j, IdentityJacobian) {
    return j;
  }
};

/// Degrees of freedom of an independent state: dofs offset, offset + 1, ... of the system, N a point.
template <int N>
struct DirectDofs {
  static constexpr int size = N;
  static constexpr bool direct = true;
  int offset;

  template <class F>
  void expand(int point, F&& f) const {
    f(offset + point * N, IdentityJacobian{});
  }
};

/// Degrees of freedom of a mapped state: each point depends, through the rows of J, on points of the parent.
template <class Mapping, class Parent>
struct MappedDofs {
  static constexpr int size = Mapping::Out::size;
  static constexpr bool direct = false;
  Mapping const& mapping;
  Parent parent;

  template <class F>
  void expand(int point, F&& f) const {
    mapping.forEachJacobianBlock(point, [&](int above, auto const& j) {
      parent.expand(above, [&](int dof, auto const& jAbove) { f(dof, (j * jAbove)); });
    });
  }
};

/// The same where each point depends on points of several parents.
template <class Mapping, class... Parent>
struct MultiMappedDofs {
  static constexpr int size = Mapping::Out::size;
  static constexpr bool direct = false;
  Mapping const& mapping;
  std::tuple<Parent...> parents;

  template <class F>
  void expand(int point, F&& f) const {
    expandParts(point, f, std::index_sequence_for<Parent...>{});
  }

 private:
  template <class F, std::size_t... K>
  void expandParts(int point, F& f, std::index_sequence<K...>) const {
    (expandPart(mapping.part(std::integral_constant<std::size_t, K>{}), std::get<K>(parents), point, f), ...);
  }
  template <class PartMapping, class P, class F>
  static void expandPart(PartMapping const& part, P const& parent, int point, F& f) {
    part.forEachJacobianBlock(point, [&](int above, auto const& j) {
      parent.expand(above, [&](int dof, auto const& jAbove) { f(dof, (j * jAbove)); });
    });
  }
};

/// f(dof, columns, entries) for each block of the Jacobian of a point, in doubles and column by column; no
/// columns and no entries for the identity. Other kinds of degrees of freedom have overloads.
template <class Dofs, class F>
void expand_point(Dofs const& dofs, int point, F&& f) {
  dofs.expand(point, [&](int dof, auto const& j) {
    using J = std::decay_t<decltype(j)>;
    if constexpr (std::is_same_v<J, IdentityJacobian>) {
      f(dof, 0, static_cast<double const*>(nullptr));
    } else {
      const Mat<double, J::RowsAtCompileTime, J::ColsAtCompileTime> entries = j.template cast<double>();
      f(dof, int(J::ColsAtCompileTime), entries.data());
    }
  });
}

/// Adds element blocks K between points i and j to A as J_i' K J_j. `A` and `B` are the degrees of freedom of
/// the two ends of an interaction; one body has the same twice.
template <AssemblyPhase Phase, class Matrix, class A, class B = A>
struct MatrixSink {
  static constexpr AssemblyPhase phase = Phase;
  static constexpr bool direct = A::direct && B::direct;
  using MatrixType = Matrix;
  Matrix& matrix;
  A first;
  B second;

  template <int SideI = 0, int SideJ = 0, class K>
  void add(int i, int j, K const& k) const {
    side<SideI>().expand(i, [&](int row, auto const& ji) {
      side<SideJ>().expand(j, [&](int column, auto const& jj) { place(row, column, ji, jj, k); });
    });
  }
  /// Row and column of each coordinate of a point become those of the identity.
  void fix(int point) const {
    if constexpr (Phase == AssemblyPhase::add && A::direct)
      for (int c = 0; c < A::size; ++c) matrix.fix(first.offset + point * A::size + c);
  }
  /// The same for the coordinates c of a point where mask[c] is not 0.
  template <class Mask>
  void fix(int point, Mask const& mask) const {
    if constexpr (Phase == AssemblyPhase::add && A::direct)
      for (int c = 0; c < A::size; ++c)
        if (mask[std::size_t(c)]) matrix.fix(first.offset + point * A::size + c);
  }
  /// A = P A P + (I - P) with a symmetric projector P of the coordinates of a point.
  template <class P>
  void project(int point, P const& p) const {
    if constexpr (Phase == AssemblyPhase::add && A::direct) matrix.project(first.offset + point * A::size, p);
  }
  /// First degree of freedom of a point of an independent state.
  template <int Side>
  int dof(int point) const {
    return side<Side>().offset + point * std::decay_t<decltype(side<Side>())>::size;
  }
  void fixDof(int dof) const {
    if constexpr (Phase == AssemblyPhase::add) matrix.fix(dof);
  }
  /// A = P A P + (I - P) with the P that gives each of the first coordinates of some points, which begin at
  /// `dofs`, their mean; and the room for it.
  template <class Dofs>
  void projectToMean(Dofs const& dofs, int coordinates) const {
    if constexpr (Phase == AssemblyPhase::add) matrix.projectToMean(dofs, coordinates);
  }
  template <class Dofs>
  void preallocateMean(Dofs const& dofs, int coordinates) const {
    if constexpr (Phase == AssemblyPhase::pattern) matrix.preallocateMean(dofs, coordinates);
  }
  template <int Side>
  auto const& side() const {
    if constexpr (Side == 0)
      return first;
    else
      return second;
  }

 private:
  template <class Ji, class Jj, class K>
  void place(int row, int column, Ji const& ji, Jj const& jj, K const& k) const {
    if constexpr (std::is_same_v<Ji, IdentityJacobian> && std::is_same_v<Jj, IdentityJacobian>)
      put(row, column, k);
    else if constexpr (std::is_same_v<Ji, IdentityJacobian>)
      put(row, column, (k * jj).eval());
    else if constexpr (std::is_same_v<Jj, IdentityJacobian>)
      put(row, column, (ji.transpose() * k).eval());
    else
      put(row, column, (ji.transpose() * k * jj).eval());
  }
  template <class K>
  void put(int row, int column, K const& k) const {
    if constexpr (Phase == AssemblyPhase::pattern)
      matrix.preallocate(row, column, K::RowsAtCompileTime, K::ColsAtCompileTime);
    else if constexpr (Phase == AssemblyPhase::add)
      matrix.add(row, column, k);
  }
};

/// f(the sink for two kinds of degrees of freedom); other kinds than the above have overloads of their own.
template <AssemblyPhase Phase, class Matrix, class A, class B, class F>
void with_sink(Matrix& matrix, A const& first, B const& second, F&& f) {
  f(MatrixSink<Phase, Matrix, A, B>{matrix, first, second});
}

}  // namespace sinew
