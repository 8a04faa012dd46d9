// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixMat3x3d&);
template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixMat3x3f&);
template detail::BlockTarget detail::block_target(CompressedRowSparseMatrixd&);
template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixMat3x3d>();
template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixMat3x3f>();
template detail::ProjectionTarget detail::projection_target<CompressedRowSparseMatrixd>();
template void SystemMatrix<RuntimeScope<Standard>>::preallocate(AnyMatrix&, MechanicalParams const&) const;
template void SystemMatrix<RuntimeScope<Standard>>::bind(AnyMatrix&, MechanicalParams const&) const;
}  // namespace sinew
