// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>
#include <sinew/version.hpp>

namespace sinew {

// What types and layouts depend on besides the source; each is a type of its own, since a linker prints its
// name: (sinew::bytes_of_lanes)32.
enum bytes_of_lanes : int {};         ///< -march
enum alignment_of_matrices : int {};  ///< -march, EIGEN_MAX_STATIC_ALIGN_BYTES
enum alignment_of_memory : int {};    ///< -march, EIGEN_MAX_ALIGN_BYTES
enum bytes_of_index : int {};         ///< EIGEN_DEFAULT_DENSE_INDEX_TYPE
enum checked_containers : int {};     ///< _GLIBCXX_DEBUG
enum version_of_eigen : int {};       ///< 30400 is 3.4.0
enum version_of_sinew : int {};       ///< 100 is 0.1.0

/// A compiled library defines `here` for its own flags, in a file that does not ask for it: `template <> char
/// const flags_of_this_file<the_library>::here = 0;`. Its header asks in each file for that of the file. A
/// program compiled otherwise then does not link, and the linker says this name. A check at start-up could
/// say more, but only after constructors that use the types already.
template <class Library, bytes_of_lanes, alignment_of_matrices, alignment_of_memory, bytes_of_index,
          checked_containers, version_of_eigen, version_of_sinew, auto... Further>
struct compile_with_the_same_flags_as {
  static char const here;
};

namespace detail {
inline constexpr int containers_are_checked =
#if defined(_GLIBCXX_DEBUG)
    1;
#else
    0;
#endif
}  // namespace detail

/// For a library whose types also depend on `Further`.
template <class Library, auto... Further>
using flags_of_this_file = compile_with_the_same_flags_as<
    Library, bytes_of_lanes(vector_bytes), alignment_of_matrices(EIGEN_MAX_STATIC_ALIGN_BYTES),
    alignment_of_memory(EIGEN_DEFAULT_ALIGN_BYTES), bytes_of_index(sizeof(Eigen::Index)),
    checked_containers(detail::containers_are_checked),
    version_of_eigen(EIGEN_WORLD_VERSION * 10000 + EIGEN_MAJOR_VERSION * 100 + EIGEN_MINOR_VERSION),
    version_of_sinew(SINEW_VERSION_MAJOR * 10000 + SINEW_VERSION_MINOR * 100 + SINEW_VERSION_PATCH),
    Further...>;

}  // namespace sinew
