// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <map>
#include <string_view>

namespace sinew {

/// Makes what is inside the closed surface of its node solid for all fluids on grids of the scene (Fluid3D,
/// in the plane Fluid2D): triangles and quads, in the plane edges, of the topology over its points. In a node
/// below a body, which a mapping moves, pressure and drag of the fluid go back to that body. Cells are cut by
/// the surface (Batty, Bertails, Bridson 2007), so that it need not follow them. A rigid body that one
/// mapping carries is a part of the equations of pressure, and may be as light as it likes; others, soft ones
/// among them, move in a step as at its start, and are to be heavier than the fluid that they carry along.
template <class D>
struct ImmersedSolid {
  using Role = role::ForceField;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static_assert(!D::rigid && D::spatial == D::size && D::size >= 2,
                "Sinew: the surface of a solid has points; take Vec3d, Vec3f or Vec2d.");
  static constexpr bool isLoad = true;
  static constexpr std::string_view className = "ImmersedSolid";

  static constexpr auto fields() { return field_list(); }

  /// V at the start of the last step, what the fluid added to dV/dt in it, the rest of dV/dt in the step
  /// before, and dt; empty before the first.
  std::vector<double> memory{};
  static constexpr auto state() {
    return field_list(field("memory", &ImmersedSolid::memory, "", "the motion of the last step"));
  }

  static constexpr ForceProperties properties() {
    return {.internal = false, .objective = false, .conservative = false};
  }

  /// The rigid body that carries the surface, if one does.
  struct Carrier {
    int body = -1;
    bool moved = false;  // by a solver
    ImmersedBody::Matrix6 inverseMass = ImmersedBody::Matrix6::Zero(), free = ImmersedBody::Matrix6::Zero();
  };
  Carrier carrier{};
  ImmersedBody body{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ImmersedSolid>());
    body.dimension = D::spatial;
    body.elements.clear();
    TopologyView const& t = context.topology;
    if constexpr (D::spatial == 2) {
      for (auto const& e : t.edges) body.elements.push_back({e[0], e[1], -1});
    } else {
      for (auto const& e : t.triangles) body.elements.push_back(e);
      for (auto const& q : t.quads) {
        body.elements.push_back({q[0], q[1], q[2]});
        body.elements.push_back({q[0], q[2], q[3]});
      }
    }
    constexpr std::string_view kind = D::spatial == 2 ? "edges" : "triangles or quads";
    if (body.elements.empty())
      throw Error(where,
                  text("the topology of its node has no ", kind, "; give it those of a closed surface"));
    for (auto const& element : body.elements)
      for (std::size_t k = 0; k < D::spatial; ++k)
        if (element[k] < 0 || std::size_t(element[k]) >= context.rest.size())
          throw Error(where,
                      text("an element of the surface refers to point ",
                           element[k],
                           ", but the state has ",
                           context.rest.size(),
                           " points; put it into the node of the surface"));
    // each point of a line, or edge of a surface, belongs to two elements
    std::map<std::array<Index, 2>, int> sides;
    for (auto const& e : body.elements)
      for (std::size_t k = 0; k < D::spatial; ++k) {
        if constexpr (D::spatial == 2)
          ++sides[{e[k], e[k]}];
        else
          ++sides[{std::min(e[k], e[(k + 1) % 3]), std::max(e[k], e[(k + 1) % 3])}];
      }
    for (auto const& [side, count] : sides)
      if (count % 2 != 0)
        throw Error(where,
                    text("the surface is not closed: ",
                         D::spatial == 2 ? text("point ", side[0])
                                         : text("the edge from point ", side[0], " to ", side[1]),
                         " belongs to ",
                         count,
                         " of its elements; close it, so that it has an inside"));
    memory.reserve(19);
    body.forces.resize(context.rest.size(), Eigen::Vector3d::Zero());
  }
  void reset() {
    std::fill(body.forces.begin(), body.forces.end(), Eigen::Vector3d(Eigen::Vector3d::Zero()));
    memory.clear();
  }

  /// Adds to the motion of the body what all but the fluid adds to it in a step.
  void foresee(Eigen::Vector3d const& gravity, double dt) {
    using Vector6 = ImmersedBody::Vector6;
    Vector6 rest = Vector6::Zero(), before = rest;
    rest.head<3>() = gravity;
    rest = (carrier.free * rest).eval();
    before = rest;
    const Vector6 now = body.motion;
    if (memory.size() == 19) {
      auto part = [&](std::size_t k) { return Vector6(Eigen::Map<Vector6 const>(memory.data() + 6 * k)); };
      rest = (now - part(0)) / memory[18] - part(1);
      before = part(2);
    }
    for (int k = 0; k < 6; ++k) {
      const double a = rest[k], b = before[k];
      if (a * b > 0) body.motion[k] += dt * (std::abs(a) < std::abs(b) ? a : b);
    }
    memory.resize(19);
    Eigen::Map<Vector6> parts[3] = {Eigen::Map<Vector6>(memory.data()),
                                    Eigen::Map<Vector6>(memory.data() + 6),
                                    Eigen::Map<Vector6>(memory.data() + 12)};
    parts[0] = now;
    parts[1].setZero();
    parts[2] = rest;
    memory[18] = dt;
  }
  /// What the fluid has added to dV/dt.
  void remember() {
    if (memory.size() != 19) return;
    const ImmersedBody::Vector6 gain = body.response * body.load;
    std::copy(gain.begin(), gain.end(), memory.begin() + 6);
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const&, VecDeriv const&) const {
    for (std::size_t i = 0; i < body.forces.size(); ++i)
      f[i] += body.forces[i].template head<D::spatial>().template cast<typename D::Real>();
  }
  void addDForce(MechanicalParams const&, VecDeriv&, VecDeriv const&) const {}
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const&) const { return 0; }
};

}  // namespace sinew
