// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/core/mesh.hpp>
#include <sinew/core/work_share.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// The cells of a finer grid, and the hexahedron that each is a part of: several hexahedra may have one
/// place.
struct FinerCells {
  std::span<Eigen::Vector3d const> positions{};
  std::span<Hexahedron const> hexahedra{};
  std::span<Index const> parents{};
};

/// Cells of half the length of those one level above: the parts of a hexahedron of a grid over a surface.
/// They have points of their own, which cells share where they are joined.
struct CellLevel {
  std::vector<Hexahedron> hexahedra{};
  std::vector<Index> parents{};            // the cell above, or the hexahedron, of which each is an eighth
  std::vector<int> octants{};              // the corner of that at which it lies
  std::vector<double> fill{}, massFill{};  // the part that counts as filled, for its stiffness and its mass
};

/// Elements over the points of one node, as components see them at init. Empty where there is no topology. A
/// topology that has to be made first offers generate(where), which init calls before all else. One whose
/// elements may be removed while the scene runs offers edit(), its ElementLists.
struct TopologyView {
  std::span<Eigen::Vector3d const> positions{};  // for a state that is given none
  std::span<Edge const> edges{};
  std::span<Triangle const> triangles{};
  std::span<Quad const> quads{};
  std::span<Tetrahedron const> tetrahedra{};
  std::span<Hexahedron const> hexahedra{};
  std::span<Pyramid const> pyramids{};
  std::span<Prism const> prisms{};
  std::span<QuadraticTetrahedron const> quadraticTetrahedra{};
  std::span<QuadraticHexahedron const> quadraticHexahedra{};
  std::span<TriquadraticHexahedron const> triquadraticHexahedra{};
  std::array<int, 3> grid{0, 0, 0};  // points of a regular grid along x, y, z; zeros where there is none
  // of a grid of cells whose points are those of the state: where they lie before the state is moved
  std::span<Eigen::Vector3d const> places{};
  // of a grid of cells over a surface: the part of each hexahedron that counts as filled, for its stiffness
  // and its mass; empty where all are
  std::span<double const> fill{}, massFill{};
  FinerCells finer{};
  std::span<CellLevel const>
      levels{};        // of a grid over a surface: halves of the hexahedra, halves of these...
  bool grows = false;  // it may be without elements: some may come while the scene runs
};

/// What a component of a node is given at init: where it stands (for messages), the rest positions of the
/// node's state, and the nearest topology.
template <class D>
struct InitContext {
  std::string where;
  typename D::VecCoord const& rest;
  TopologyView topology;
  /// Of the points [kg], for a component that asks for them by `needsMasses`; empty where there is no mass.
  std::span<double const> masses{};
  /// Where the points of the body are at rest [m] on which the values of this state lie, for a component that
  /// asks for it by `overBody`; empty where the topology is over the points of this state.
  std::span<Eigen::Vector3d const> body{};
  /// The triangles over the points that a mapping moves, also those of a visual model, for that mapping.
  std::span<Triangle const> faces{};

  /// Where a point of the topology is at rest [m].
  Eigen::Vector3d place(Index i) const {
    if (!body.empty()) return body[std::size_t(i)];
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.template head<D::spatial>() = D::center(rest[std::size_t(i)]).template cast<double>();
    return x;
  }
  /// How many points the topology may refer to.
  std::size_t points() const { return body.empty() ? rest.size() : body.size(); }
};

/// The body on which the values of a state lie, such as temperatures: the nearest topology above it, where it
/// has none of its own, and the nearest state in space from there on. Nulls where there is none.
struct BodyView {
  TopologyView topology{};
  void const *topologyAddress = nullptr, *state = nullptr;
  void (*placesOf)(void const* state, std::vector<Eigen::Vector3d>& places) = nullptr;

  template <class S>
  static constexpr bool inSpace = !S::DataTypes::rigid && S::DataTypes::size == 3;
  template <class S>
  static BodyView over(S const& state) {
    static_assert(inSpace<S>);
    return {.state = &state, .placesOf = [](void const* s, std::vector<Eigen::Vector3d>& places) {
              for (auto const& x : static_cast<S const*>(s)->restPosition)
                places.push_back(x.template cast<double>());
            }};
  }
};
/// What is looked for next, on the way up from the values: their state, a topology above it, its state.
enum class BodySearch { values, topology, state };

/// Arguments of the mechanical operations. The product with a vector is (m M + b B + k K) dx, where
/// K = df/dx and B = df/dv, so an implicit step has negative b and k.
struct MechanicalParams {
  double time = 0, dt = 0;
  Eigen::Vector3d gravity{0, 0, 0};
  double m = 0, b = 0, k = 0;
  WorkShare share{};  // for a component that shares_work
  // not 0: forces are for a step v += h M^-1 f, x += h v of this length h, and gyroscopic ones those at its
  // end
  double gyroscopicStep = 0;
};

/// What an assembled or matrix-free system is made of: m M + b B + k K.
struct MatrixFactors {
  double m = 0, b = 0, k = 0;
};

/// The step that has just ended.
struct StepInfo {
  long step;
  double time, dt;
};

/// The step that is about to be made.
struct StepAhead {
  long step;              // its number, from 1
  double begin, end, dt;  // [s]
  bool solved;            // an ODE solver moves the state
};

/// What stands for those of all scenes where a concept asks for a function template over them.
struct AnyOperations {};
struct AnySink {};

}  // namespace sinew
