// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/core/point_loop.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>
#include <sinew/mapping/rigid_frame.hpp>
#include <sinew/mapping/rigid_loops.hpp>

#include <vector>

namespace sinew {

/// Points, or frames, carried by rigid bodies:
///   x = c + r,  r = R p      v = c' + w x r      f_c += f,  torque += r x f
/// and, for frames, orientations q o, angular velocities w, and torques that are added. The positions given
/// to the child are the p (and o) in body axes, or those in the world with `globalToLocalCoords`; with
/// `initialPoints` these are the p. In the
/// plane w x r = w (-r_y, r_x). As bodies rotate, so do the lever arms of forces, which `geometricStiffness`
/// adds:
///   K_g = 1/2 ([f]x [r]x + [r]x [f]x) on angular coordinates, in the plane -f.r
/// What the symmetric part leaves out is 1/2 [f x r]x, and vanishes together with the torque on a body.
template <class I, class O>
struct RigidMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  using Frame = RigidFrame<In, Out>;
  static constexpr int N = In::spatial;
  static_assert(In::rigid && Out::spatial == N && (Out::rigid || Out::size == N),
                "RigidMapping carries points or frames by rigid bodies of their space");
  static constexpr std::string_view className = "RigidMapping", aliases = "RigidRigidMapping";

  std::vector<int> rigidIndices{0};
  bool globalToLocalCoords = false;
  std::vector<typename Out::Coord> initialPoints{};
  RotationalStiffness geometricStiffness = RotationalStiffness::none;

  static constexpr auto fields() {
    return field_list(field("rigidIndexPerPoint",
                            &RigidMapping::rigidIndices,
                            "",
                            "the body that carries each point; one entry for all points",
                            range::nonNegative)
                          .numbersOf(Of::parentPoints)
                          .also("index"),
                      field("globalToLocalCoords",
                            &RigidMapping::globalToLocalCoords,
                            "",
                            "the positions of the child are given in the world, not in the body"),
                      field("initialPoints",
                            &RigidMapping::initialPoints,
                            "m",
                            "the points in body axes, in place of the positions of the child")
                          .oneEach(Of::entries),
                      field("geometricStiffness",
                            &RigidMapping::geometricStiffness,
                            "",
                            "geometric stiffness: what rotating lever arms add to the stiffness"));
  }
  static constexpr int angular = In::size - N;

  typename Out::VecCoord local{};                            // p, and o
  typename Out::template Array<Vec<Real, N>> rotated{};      // r at the last apply
  std::vector<Mat<typename In::Real, angular>> stiffness{};  // K_g of each body at the last updateK
  RigidLoops<In, Out> loops{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<RigidMapping>());
    if (!initialPoints.empty()) positions.assign(initialPoints.begin(), initialPoints.end());
    if (rigidIndices.size() != 1 && rigidIndices.size() != positions.size())
      throw Error(where,
                  text("rigidIndexPerPoint has ",
                       rigidIndices.size(),
                       " entries for ",
                       positions.size(),
                       " points; give one, or one for each point"));
    check_numbers(
        where, "rigidIndexPerPoint", rigidIndices, parent.rest.size(), "rigid bodies", "the parent");
    local = positions;
    if (globalToLocalCoords && initialPoints.empty())
      for (std::size_t i = 0; i < local.size(); ++i) {
        auto const& body = parent.rest[body_of(i)];
        const Vec<Real, N> arm = Out::center(positions[i]) - body.center.template cast<Real>();
        Out::setCenter(local[i], Frame::rotation(body).transpose() * arm);
        if constexpr (Out::rigid && N == 3)
          local[i].orientation =
              body.orientation.conjugate().template cast<Real>() * positions[i].orientation;
        else if constexpr (Out::rigid)
          local[i].orientation = positions[i].orientation - Real(body.orientation);
      }
    rotated.resize(local.size());
    stiffness.assign(parent.rest.size(), Mat<typename In::Real, angular>::Zero());
    loops.init(parent.rest.size(), local.size(), rigidIndices);
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    each_point<Out>(local.size(),
                    Place{loops.bodies(in),
                          loops.indices(rigidIndices),
                          rigidIndices.size() == 1,
                          entries(std::as_const(local)),
                          overwritten(rotated),
                          overwritten(out)});
  }
  struct Place {
    typename In::Coord const* bodies;
    int const* indices;
    bool one;
    typename Out::Coord const* local;
    Vec<Real, N>* rotated;
    typename Out::Coord* to;
    SINEW_HD void operator()(int i) const {
      auto const& body = bodies[indices[one ? 0 : i]];
      rotated[i] = Frame::rotation(body) * Out::center(local[i]);
      Out::setCenter(to[i], body.center.template cast<Real>() + rotated[i]);
      if constexpr (Out::rigid && N == 3)
        to[i].orientation = (body.orientation.template cast<Real>() * local[i].orientation).normalized();
      else if constexpr (Out::rigid)
        to[i].orientation = Real(body.orientation) + local[i].orientation;
    }
  };
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    each_point<Out>(local.size(),
                    Move{loops.bodies(in),
                         loops.indices(rigidIndices),
                         rigidIndices.size() == 1,
                         entries(rotated),
                         overwritten(out)});
  }
  struct Move {
    typename In::Deriv const* bodies;
    int const* indices;
    bool one;
    Vec<Real, N> const* rotated;
    typename Out::Deriv* to;
    SINEW_HD void operator()(int i) const {
      to[i] = Frame::jacobian(rotated[i]) * bodies[indices[one ? 0 : i]].template cast<Real>();
    }
  };
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    loops.addLoads(in, out, rotated, rigidIndices, Load{});
  }
  // what a force on a point at r adds to its body
  struct Load {
    SINEW_HD void operator()(typename In::Deriv& to, Vec<Real, N> const& r,
                             typename Out::Deriv const& f) const {
      to += (Frame::jacobian(r).transpose() * f).template cast<typename In::Real>();
    }
  };
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    f(int(body_of(std::size_t(point))), Frame::jacobian(rotated[std::size_t(point)]));
  }

  void updateK(typename Out::VecDeriv const& f) {
    if (geometricStiffness == RotationalStiffness::none) return;
    for (auto& k : stiffness) k.setZero();
    for (std::size_t i = 0; i < local.size(); ++i) {
      stiffness[body_of(i)] +=
          Frame::stiffness(rotated[i], f[i].template head<N>()).template cast<typename In::Real>();
    }
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness == RotationalStiffness::none) return;
    for (std::size_t b = 0; b < stiffness.size(); ++b)
      df[b].template tail<angular>() +=
          typename In::Real(k) * (stiffness[b] * dx[b].template tail<angular>());
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness == RotationalStiffness::none) return;
    using Block = Mat<typename In::Real, In::size>;
    for (std::size_t b = 0; b < stiffness.size(); ++b) {
      Block block = Block::Zero();
      block.template bottomRightCorner<angular, angular>() = typename In::Real(p.k) * stiffness[b];
      sink.add(int(b), int(b), block);
    }
  }

 private:
  std::size_t body_of(std::size_t i) const {
    return std::size_t(rigidIndices.size() == 1 ? rigidIndices[0] : rigidIndices[i]);
  }
};

}  // namespace sinew
