// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/error.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <span>

namespace sinew {

/// Called with each block of the Jacobian of a point: the first degree of freedom, the number of columns (0
/// for the identity), and the entries column by column.
struct JacobianVisitor {
  void* self;
  void (*call)(void* self, int dof, int columns, double const* entries);
};

namespace detail {

template <class F>
JacobianVisitor jacobian_visitor(F& f) {
  return {&f, [](void* self, int dof, int columns, double const* entries) {
            (*static_cast<F*>(self))(dof, columns, entries);
          }};
}
template <class J>
void emit(JacobianVisitor const& visitor, int dof, J const& j) {
  if constexpr (std::is_same_v<J, IdentityJacobian>) {
    visitor.call(visitor.self, dof, 0, nullptr);
  } else {
    const Eigen::Matrix<double, J::RowsAtCompileTime, J::ColsAtCompileTime> entries =
        j.template cast<double>();
    visitor.call(visitor.self, dof, int(entries.cols()), entries.data());
  }
}

// f(Jacobian of N rows), of the type that typed trees have in its place
template <class Real, int N, class F>
void with_jacobian(int columns, double const* entries, F&& f) {
  auto fixed = [&]<int C>() {
    f(Mat<Real, N, C>(Eigen::Map<Mat<double, N, C> const>(entries).template cast<Real>()));
  };
  switch (columns) {
    case 0:
      return f(IdentityJacobian{});
    case 1:
      return fixed.template operator()<1>();
    case 2:
      return fixed.template operator()<2>();
    case 3:
      return fixed.template operator()<3>();
    default:
      return fixed.template operator()<6>();
  }
}

// where a block goes, whatever the matrix
struct BlockTarget {
  void* matrix;
  void (*preallocate)(void*, int row, int column, int h, int w);
  void (*addDouble)(void*, int row, int column, int h, int w, double const*);
  void (*addFloat)(void*, int row, int column, int h, int w, float const*);
};
template <class Matrix>
BlockTarget block_target(Matrix& matrix) {
  auto add = []<class Real>(void* m, int row, int column, int h, int w, Real const* k) {
    static_cast<Matrix*>(m)->add(row, column, Eigen::Map<Eigen::Matrix<Real, -1, -1> const>(k, h, w));
  };
  return {&matrix,
          [](void* m, int row, int column, int h, int w) {
            static_cast<Matrix*>(m)->preallocate(row, column, h, w);
          },
          add,
          add};
}

// what constraints do with a matrix
struct ProjectionTarget {
  void (*fix)(void*, int dof);
  void (*project)(void*, int dof, int n, double const* p);  // n: 1, 2, 3 or 6
  void (*preallocateMean)(void*, std::span<int const> dofs, int coordinates);
  void (*projectToMean)(void*, std::span<int const> dofs, int coordinates);
};
template <class Matrix>
ProjectionTarget projection_target() {
  auto project = [](void* m, int dof, int n, double const* p) {
    auto fixed = [&]<int N>() { static_cast<Matrix*>(m)->project(dof, Eigen::Map<Mat<double, N> const>(p)); };
    n == 1   ? fixed.template operator()<1>()
    : n == 2 ? fixed.template operator()<2>()
    : n == 3 ? fixed.template operator()<3>()
             : fixed.template operator()<6>();
  };
  return {
      [](void* m, int dof) { static_cast<Matrix*>(m)->fix(dof); },
      project,
      [](void* m, std::span<int const> dofs, int n) { static_cast<Matrix*>(m)->preallocateMean(dofs, n); },
      [](void* m, std::span<int const> dofs, int n) { static_cast<Matrix*>(m)->projectToMean(dofs, n); }};
}

// row.. += Ji' K Jj
template <AssemblyPhase Phase, class Real, int N, int M>
void place_block(BlockTarget const& target, int row, int column, int columnsI, double const* ji, int columnsJ,
                 double const* jj, Mat<Real, N, M> const& k) {
  auto put = [&](auto const& block) {
    if constexpr (Phase == AssemblyPhase::add) {
      if constexpr (sizeof(Real) == 8)
        target.addDouble(target.matrix, row, column, int(block.rows()), int(block.cols()), block.data());
      else
        target.addFloat(target.matrix, row, column, int(block.rows()), int(block.cols()), block.data());
    }
  };
  if constexpr (Phase == AssemblyPhase::pattern) {
    target.preallocate(
        target.matrix, row, column, columnsI == 0 ? N : columnsI, columnsJ == 0 ? M : columnsJ);
  } else {
    with_jacobian<Real, N>(columnsI, ji, [&](auto const& left) {
      with_jacobian<Real, M>(columnsJ, jj, [&](auto const& right) {
        using Left = std::decay_t<decltype(left)>;
        using Right = std::decay_t<decltype(right)>;
        if constexpr (std::is_same_v<Left, IdentityJacobian> && std::is_same_v<Right, IdentityJacobian>)
          put(k);
        else if constexpr (std::is_same_v<Left, IdentityJacobian>)
          put((k * right).eval());
        else if constexpr (std::is_same_v<Right, IdentityJacobian>)
          put((left.transpose() * k).eval());
        else
          put((left.transpose() * k * right).eval());
      });
    });
  }
}

}  // namespace detail

/// Degrees of freedom of a state that is found at run time: mapped, through however many mappings, or not.
struct ErasedDofs {
  void const* self;
  void (*expand)(void const* self, int point, JacobianVisitor const&);
  int offset = 0, size = 0;  // of an independent state, whose `expand` is null
};

template <class F>
void expand_point(ErasedDofs const& dofs, int point, F&& f) {
  if (dofs.expand)
    dofs.expand(dofs.self, point, detail::jacobian_visitor(f));
  else
    f(dofs.offset + point * dofs.size, 0, static_cast<double const*>(nullptr));
}

namespace detail {

// the Jacobian j of a point with respect to one above, times what that depends on
template <class J>
void expand_behind(J const& j, ErasedDofs const& above, int point, JacobianVisitor const& visitor) {
  if constexpr (std::is_same_v<J, IdentityJacobian>) {
    above.expand(above.self, point, visitor);
  } else if constexpr (std::is_same_v<J, typename J::PlainObject>) {
    auto chain = [&](int dof, int columns, double const* entries) {
      with_jacobian<typename J::Scalar, J::ColsAtCompileTime>(
          columns, entries, [&](auto const& jAbove) { emit(visitor, dof, (j * jAbove).eval()); });
    };
    above.expand(above.self, point, jacobian_visitor(chain));
  } else {
    expand_behind<typename J::PlainObject>(j, above, point, visitor);
  }
}

}  // namespace detail

/// What MatrixSink is to typed trees, with the Jacobians found at run time and the matrix out of sight: one
/// instantiation serves all mappings and matrices, and computes the same bits.
template <AssemblyPhase Phase>
struct ErasedSink {
  struct NoMatrix {
    static constexpr int blockSize = 0;
  };
  using MatrixType = NoMatrix;
  static constexpr AssemblyPhase phase = Phase;
  static constexpr bool direct = false;
  detail::BlockTarget target;
  ErasedDofs first, second;

  template <int SideI = 0, int SideJ = 0, class K>
  void add(int i, int j, K const& k) const {
    if constexpr (Phase != AssemblyPhase::bind) {
      using Real = typename K::Scalar;
      constexpr int n = K::RowsAtCompileTime, m = K::ColsAtCompileTime;
      const Mat<Real, n, m> block = k;
      expand_point(SideI == 0 ? first : second, i, [&](int row, int columnsI, double const* ji) {
        expand_point(SideJ == 0 ? first : second, j, [&](int column, int columnsJ, double const* jj) {
          detail::place_block<Phase, Real, n, m>(target, row, column, columnsI, ji, columnsJ, jj, block);
        });
      });
    }
  }
  // constraints act on independent states
  void fix(int) const {}
};

namespace detail {
inline ErasedDofs erased(ErasedDofs const& dofs) { return dofs; }
template <int N>
ErasedDofs erased(DirectDofs<N> const& dofs) {
  return {nullptr, nullptr, dofs.offset, N};
}
// a chain of typed mappings, as one end of an interaction may have
template <class M, class P>
ErasedDofs erased(MappedDofs<M, P> const& dofs) {
  return {&dofs, [](void const* self, int point, JacobianVisitor const& visitor) {
            static_cast<MappedDofs<M, P> const*>(self)->expand(
                point, [&](int dof, auto const& j) { emit(visitor, dof, j); });
          }};
}
template <class M, class... P>
ErasedDofs erased(MultiMappedDofs<M, P...> const& dofs) {
  return {&dofs, [](void const* self, int point, JacobianVisitor const& visitor) {
            static_cast<MultiMappedDofs<M, P...> const*>(self)->expand(
                point, [&](int dof, auto const& j) { emit(visitor, dof, j); });
          }};
}
}  // namespace detail

/// Degrees of freedom of an independent state of a runtime tree.
template <int N, class Real>
struct RuntimeDofs {
  DirectDofs<N> direct;
};
template <int N, class Real, class F>
void expand_point(RuntimeDofs<N, Real> const& dofs, int point, F&& f) {
  expand_point(dofs.direct, point, f);
}
namespace detail {
template <int N, class Real>
ErasedDofs erased(RuntimeDofs<N, Real> const& dofs) {
  return erased(dofs.direct);
}
template <class Dofs>
inline constexpr bool is_runtime_dofs = std::is_same_v<Dofs, ErasedDofs>;
template <int N, class Real>
inline constexpr bool is_runtime_dofs<RuntimeDofs<N, Real>> = true;
}  // namespace detail

/// The matrix of a solver of a runtime tree, whichever it is: components are instantiated for this one, and,
/// where it has to be fast, for blocks of three rows of their own Real.
class AnyMatrix {
 public:
  template <class Matrix>
  explicit AnyMatrix(Matrix& matrix)
      : target_(detail::block_target(matrix)), projection_(detail::projection_target<Matrix>()) {
    if constexpr (std::is_same_v<Matrix, CompressedRowSparseMatrixMat3x3d>)
      blocksOfDouble_ = &matrix;
    else if constexpr (std::is_same_v<Matrix, CompressedRowSparseMatrixMat3x3f>)
      blocksOfFloat_ = &matrix;
  }

  detail::BlockTarget const& target() const { return target_; }
  /// The matrix itself, where it has blocks of N rows of Real; else null.
  template <int N, class Real>
  CompressedRowSparseMatrix<Real, 3>* blocks() const {
    if constexpr (N != 3)
      return nullptr;
    else if constexpr (std::is_same_v<Real, double>)
      return blocksOfDouble_;
    else
      return blocksOfFloat_;
  }

  void preallocate(int row, int column, int h, int w) {
    target_.preallocate(target_.matrix, row, column, h, w);
  }
  template <class K>
  void add(int row, int column, K const& k) {
    target_.addDouble(target_.matrix, row, column, int(k.rows()), int(k.cols()), k.data());
  }
  void fix(int dof) { projection_.fix(target_.matrix, dof); }
  template <class P>
  void project(int dof, P const& p) {
    constexpr int n = P::RowsAtCompileTime;
    const Mat<double, n> projector = p.template cast<double>();
    projection_.project(target_.matrix, dof, n, projector.data());
  }
  void preallocateMean(std::span<int const> dofs, int coordinates) {
    projection_.preallocateMean(target_.matrix, dofs, coordinates);
  }
  void projectToMean(std::span<int const> dofs, int coordinates) {
    projection_.projectToMean(target_.matrix, dofs, coordinates);
  }

 private:
  detail::BlockTarget target_;
  detail::ProjectionTarget projection_;
  CompressedRowSparseMatrixMat3x3d* blocksOfDouble_ = nullptr;
  CompressedRowSparseMatrixMat3x3f* blocksOfFloat_ = nullptr;
};

/// f(sink) where degrees of freedom are found at run time, of whichever tree the matrix is.
template <AssemblyPhase Phase, class Matrix, class A, class B, class F>
requires(detail::is_runtime_dofs<A> || detail::is_runtime_dofs<B>)
void with_sink(Matrix& matrix, A const& first, B const& second, F&& f) {
  detail::BlockTarget target;
  if constexpr (std::is_same_v<Matrix, AnyMatrix>)
    target = matrix.target();
  else
    target = detail::block_target(matrix);
  f(ErasedSink<Phase>{target, detail::erased(first), detail::erased(second)});
}
template <AssemblyPhase Phase, int N, class Real, class F>
void with_sink(AnyMatrix& matrix, RuntimeDofs<N, Real> const& first, RuntimeDofs<N, Real> const& second,
               F&& f) {
  if constexpr (Phase != AssemblyPhase::pattern && N == 3)
    if (auto* blocks = matrix.blocks<N, Real>())
      return with_sink<Phase>(*blocks, first.direct, second.direct, f);
  f(ErasedSink<Phase>{matrix.target(), detail::erased(first), detail::erased(second)});
}
template <AssemblyPhase Phase, class Matrix, int N, class Real, class F>
void with_sink(Matrix& matrix, RuntimeDofs<N, Real> const& first, RuntimeDofs<N, Real> const& second, F&& f) {
  if constexpr (Phase != AssemblyPhase::pattern && Matrix::blockSize == N)
    with_sink<Phase>(matrix, first.direct, second.direct, f);
  else
    f(ErasedSink<Phase>{detail::block_target(matrix), detail::erased(first), detail::erased(second)});
}

}  // namespace sinew
