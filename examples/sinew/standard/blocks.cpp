// SPDX-License-Identifier: BSL-1.0
#include <sinew/runtime/precompiled.hpp>

namespace sinew::detail {
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<double, 1> const&);
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<double, 2> const&);
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<double, 3> const&);
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<double, 6> const&);
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<float, 3> const&);
template void place_block<AssemblyPhase::add>(BlockTarget const&, int, int, int, double const*, int,
                                              double const*, Mat<float, 6> const&);
}  // namespace sinew::detail
