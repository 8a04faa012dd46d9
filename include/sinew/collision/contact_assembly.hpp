// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/assembly.hpp>
#include <sinew/core/compiled.hpp>

namespace sinew {

/// Adds contacts to the matrix of a solver, as J' (k K + b B) J with the Jacobian J of u = p_b - p_a: first
/// the models say on which degrees of freedom their touched vertices depend, then the contacts add their
/// blocks.
struct ContactAssembly {
  struct Entry {
    int surface, vertex, dof, columns;
    Eigen::Matrix<double, 6, 6> rows;  // of the linear and, of a rigid, the angular velocity of the vertex
  };
  std::vector<Entry> entries{};  // rising by surface and vertex

  /// The touched vertices of a surface, whose degrees of freedom are `dofs`.
  template <class D, class Dofs>
  void addVertices(CollisionSurface const& s, Dofs const& dofs) {
    for (const int vertex : s.touched)
      expand_point(dofs, vertex, [&](int dof, int columns, double const* j) {
        Entry e{s.number, vertex, dof, columns == 0 ? D::size : columns, {}};
        e.rows.setIdentity();
        for (int c = 0; c < columns; ++c)
          for (int r = 0; r < D::size; ++r) e.rows(r, c) = j[D::size * c + r];
        entries.push_back(e);
      });
  }
  void sort();

  /// The Jacobian of u in the degrees of freedom of a solver.
  struct Block {
    int solver, dof, columns;
    Eigen::Matrix<double, 3, 6> rows;
  };
  /// The Jacobian of the displacement of a contact.
  std::vector<Block> const& blocksOf(Contact const& c, std::vector<CollisionSurface*> const& surfaces) {
    blocks_.clear();
    if (c.a.surface >= 0) addSide(c.a, *surfaces[std::size_t(c.a.surface)], -1);
    addSide(c.b, *surfaces[std::size_t(c.b.surface)], 1);
    return blocks_;
  }

  template <AssemblyPhase Phase, class Matrix>
  void add(Matrix& matrix, Contact const& c, std::vector<CollisionSurface*> const& surfaces, double k,
           double b) {
    blocksOf(c, surfaces);
    const Eigen::Matrix3d kb = -(k * c.stiffnessMatrix + b * c.dampingMatrix);
    for (Block const& x : blocks_)
      for (Block const& y : blocks_) {
        if constexpr (Phase == AssemblyPhase::pattern) matrix.preallocate(x.dof, y.dof, x.columns, y.columns);
        if constexpr (Phase == AssemblyPhase::add) {
          const Eigen::Matrix<double, 6, 6> all = x.rows.transpose() * kb * y.rows;
          matrix.add(
              x.dof, y.dof, Eigen::Matrix<double, -1, -1, 0, 6, 6>(all.topLeftCorner(x.columns, y.columns)));
        }
      }
  }

 private:
  std::vector<Block> blocks_{};

  void addSide(ContactSide const& side, CollisionSurface const& s, double sign);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void ContactAssembly::sort() {
  // (stable_sort would allocate, and not as aligned as the matrices are where vectors are wide)
  std::sort(entries.begin(), entries.end(), [](Entry const& x, Entry const& y) {
    return std::array{x.surface, x.vertex, x.dof} < std::array{y.surface, y.vertex, y.dof};
  });
}

SINEW_ONCE void ContactAssembly::addSide(ContactSide const& side, CollisionSurface const& s, double sign) {
  for (int corner = 0; corner < side.corners(); ++corner) {
    const int vertex = side.vertices[std::size_t(corner)];
    const double w = sign * side.weights[std::size_t(corner)];
    auto e = std::lower_bound(
        entries.begin(),
        entries.end(),
        std::pair(side.surface, vertex),
        [](Entry const& x, std::pair<int, int> const& key) { return std::pair(x.surface, x.vertex) < key; });
    for (; e != entries.end() && e->surface == side.surface && e->vertex == vertex; ++e) {
      Block block{s.solver, e->dof, e->columns, {}};
      block.rows = w * e->rows.topRows<3>();
      if (s.rigid) {
        const Eigen::Vector3d r = lever_of(side, s);
        for (int column = 0; column < e->columns; ++column)
          block.rows.col(column) += w * e->rows.col(column).tail<3>().cross(r);
      }
      for (int column = e->columns; column < 6; ++column) block.rows.col(column).setZero();
      blocks_.push_back(block);
    }
  }
}

}  // namespace sinew
#endif
