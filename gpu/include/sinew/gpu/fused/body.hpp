// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/gpu/fused/contacts.hpp>
#include <sinew/gpu/fused/team.hpp>

#include <cstdint>
#include <tuple>

namespace sinew::gpu {

/// The elements of one force field in a fused step. Elements of one point add to diagonal blocks. For those
/// of more points the diagonal follows from the others, since moving an element as a whole costs nothing:
/// block(i, i) = - sum_j block(i, j). Of elements of one or two points each row finds the force and the
/// tangent by itself, twice where there are two; of others they are found once, and blocks wait for them.
template <template <class> class LawOf, class D>
struct FusedElements {
  using Law = LawOf<D>;
  static constexpr int arity = Law::arity;
  static constexpr bool symmetricBlocks = requires { requires Law::symmetricBlocks; };
  static constexpr bool byRows = arity <= 2;

  Law law;
  int count;
  int const* index;                // point k of element e at k count + e
  typename Law::Rest const* rest;  // of all copies, one after the other
  typename Law::Tangent* tangent;
  typename D::Deriv* part;  // force on point k of element e at k count + e
  int nodes;                // that elements have, and the parts for each
  int const *partFirst, *partEntry;
  int const *entryFirst, *entryCode;  // for each entry of the matrix (BlockOfElement)
};

/// A body of points on the device that implicit Euler moves, with a matrix in the shared memory of a cluster;
/// Contacts: FusedContacts, or none.
template <class D, class ContactsOfBody, class... Elements>
struct FusedBody {
  using Contacts = ContactsOfBody;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr bool touches = Contacts::any;
  static constexpr bool symmetric = (Elements::symmetricBlocks && ...);
  static constexpr bool byRows = (Elements::byRows && ...);
  /// Entries of a row that a thread keeps in registers, at most: it multiplies as many also where there are
  /// fewer. Of a mesh of tetrahedra a row has about 15, for four or eight threads.
  static constexpr int keptEntries = 5;
  static constexpr int components = symmetric ? 6 : 9;
  static constexpr int bufferSize = sum_buffer_size + (touches ? joint_buffer_size : 0);

  std::tuple<Elements...> fields;
  Contacts contacts;
  // the plan
  int rows, widest, entriesOfWidest, longestVector;  // entriesOfWidest: in shared memory
  int const *order, *rowBegin, *entryFirst, *sharedFirst, *sendFirst;
  unsigned const* sends;
  std::uint16_t const* column;  // place in the vectors of a rank
  int const* columnRow;         // row
  // of all copies, one after the other
  Coord* x;
  Deriv* v;
  Real const* mass;
  int const* held;  // bit c: component c of the node is held
  Deriv const* gravity;
  Real* vectors;  // two of all rows, for teams that exchange them in the memory of the GPU
  int* wrong;     // step at which a position was no longer finite, from 1; 0 when all are

  Real h, rayleighStiffness, rayleighMass, keptSpeed;  // keptSpeed = exp(-h vdamping)
  int iterations, steps;
  double tolerance2, threshold;

  /// Bytes of shared memory that a block needs.
  template <class Team>
  std::size_t shared() const {
    const std::size_t vector = Team::global ? 0 : 2 * 3 * std::size_t(longestVector);
    return (std::size_t(entriesOfWidest) * components + vector) * sizeof(Real) +
           std::size_t(entriesOfWidest) * sizeof(typename Team::Column) + bufferSize * sizeof(double) + 64;
  }
};

}  // namespace sinew::gpu
