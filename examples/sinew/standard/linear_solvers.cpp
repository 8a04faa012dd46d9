// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew {
template void MechanicalOperations<RuntimeScope<Standard>>::split();
template void MechanicalOperations<RuntimeScope<Standard>>::formPattern();
template void MechanicalOperations<RuntimeScope<Standard>>::solveSystem(MatrixFactors, MultiVecDeriv&,
                                                                        MultiVecDeriv&);
template bool MechanicalOperations<RuntimeScope<Standard>>::solveSystemIfAny(MatrixFactors, MultiVecDeriv&,
                                                                             MultiVecDeriv&);
template bool MechanicalOperations<RuntimeScope<Standard>>::solveSystemAgain(MatrixFactors, MultiVecDeriv&,
                                                                             MultiVecDeriv&);
}  // namespace sinew
