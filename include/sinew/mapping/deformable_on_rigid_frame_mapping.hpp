// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/cross_matrix.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>
#include <sinew/mapping/rigid_frame.hpp>

#include <numeric>
#include <vector>

namespace sinew {

/// A body that deforms in the frame of a rigid one: its points p are in the axes of the frame, and those of
/// the child in the world:
///   x = c + r,  r = R p       v = c' + w x r + R p'       f_p += R' f,  f_c += f,  torque += r x f
/// The first parent has the points, the second the frame, one of its rigid bodies or, by `repartition`,
/// several. Both stand before the node of the mapping in the tree; they are named by paths from it (`P` =
/// Parents<"..", "../../frame">), or at run time (`P` = LinkedParents). The two bodies together have the
/// inertia of both: what the deformation does to the moments of inertia of the frame, and Coriolis forces on
/// the points, are left out, as in SOFA. As the frame turns, so do forces in its axes, which
/// `geometricStiffness` adds:
///   K_g = R' [f]x between p and the angle, 1/2 ([f]x [r]x + [r]x [f]x) of the angle; in the plane R' (f_y,
///   -f_x) and -f.r
template <class I, class R, class O, class P = LinkedParents>
struct DeformableOnRigidFrameMapping {
  using Role = role::Mapping;
  using In = I;
  using In2 = R;
  using Out = O;
  using Parents = P;
  template <class Other>
  using WithParents = DeformableOnRigidFrameMapping<I, R, O, Other>;
  using Real = typename Out::Real;
  using Frame = RigidFrame<In2, Out>;
  static constexpr int N = In2::spatial, angular = Frame::angular;
  static_assert(In2::rigid && !In::rigid && !Out::rigid && In::size == N && Out::size == N,
                "DeformableOnRigidFrameMapping carries points of a body by rigid bodies of their space");
  static constexpr std::string_view className = "DeformableOnRigidFrameMapping";

  int index = 0;
  bool indexFromEnd = false;
  std::vector<int> repartition{};
  RotationalStiffness geometricStiffness = RotationalStiffness::none;
  [[no_unique_address]] P parents{};

  static constexpr auto fields() {
    using M = DeformableOnRigidFrameMapping;
    return field_list(
        field("index", &M::index, "", "the rigid body that is the frame", range::nonNegative),
        field("indexFromEnd", &M::indexFromEnd, "", "rigid bodies are counted from the last one"),
        field("repartition",
              &M::repartition,
              "",
              "how many points each rigid body carries, one body after the other; one entry: as many for "
              "each; none: `index` carries all",
              range::nonNegative),
        field("geometricStiffness",
              &M::geometricStiffness,
              "",
              "geometric stiffness: what a frame that turns adds to the stiffness"));
  }

  std::vector<int> bodies{};                     // of each point
  std::vector<Vec<Real, N>> local{}, rotated{};  // p, and r at the last apply
  std::vector<Mat<Real, N>> rotations{};         // R of each body
  std::vector<Vec<Real, N>> forces{};            // on each point, at the last updateK
  std::vector<Vec<Real, N>> pointMotions{};      // dp, and dw of each body: those of the last gather
  std::vector<Vec<Real, angular>> turns{};

  /// What concerns the points, of a mapping `M`, which may be constant.
  template <class M>
  struct Points {
    using In = typename M::In;
    using Out = typename M::Out;
    M& of;

    void apply(typename Out::VecCoord&, typename In::VecCoord const& in) const {
      for (std::size_t i = 0; i < in.size(); ++i) of.local[i] = in[i].template cast<Real>();
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      for (std::size_t i = 0; i < in.size(); ++i) out[i] = of.rotation(i) * in[i].template cast<Real>();
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      for (std::size_t i = 0; i < out.size(); ++i)
        in[i] += (of.rotation(i).transpose() * out[i]).template cast<typename In::Real>();
    }
    template <class F>
    void forEachJacobianBlock(int point, F&& f) const {
      f(point, of.rotation(std::size_t(point)));
    }
    void updateK(typename Out::VecDeriv const&) const {}
    void gather(typename In::VecDeriv const& dx) const {
      if (of.geometricStiffness == RotationalStiffness::none) return;
      for (std::size_t i = 0; i < dx.size(); ++i) of.pointMotions[i] = dx[i].template cast<Real>();
    }
    void addKx(typename In::VecDeriv& df, typename In::VecDeriv const&, double k) const {
      if (of.geometricStiffness == RotationalStiffness::none) return;
      for (std::size_t i = 0; i < df.size(); ++i)
        df[i] += (Real(k) * (of.coupling(i) * of.turns[std::size_t(of.bodies[i])]))
                     .template cast<typename In::Real>();
    }
    std::vector<bool> pointsThatStay(Renumbering const& parent) const {
      std::vector<bool> stays;
      for (std::size_t i = 0; i < of.bodies.size(); ++i) stays.push_back(parent.stays(int(i)));
      return stays;
    }
  };
  /// What concerns the frame.
  template <class M>
  struct Frames {
    using In = typename M::In2;
    using Out = typename M::Out;
    M& of;

    void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
      for (std::size_t b = 0; b < in.size(); ++b) of.rotations[b] = Frame::rotation(in[b]);
      for (std::size_t i = 0; i < out.size(); ++i) {
        of.rotated[i] = of.rotation(i) * of.local[i];
        out[i] = in[body(i)].center.template cast<Real>() + of.rotated[i];
      }
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      for (std::size_t i = 0; i < out.size(); ++i)
        out[i] += Frame::jacobian(of.rotated[i]) * in[body(i)].template cast<Real>();
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      for (std::size_t i = 0; i < out.size(); ++i)
        in[body(i)] +=
            (Frame::jacobian(of.rotated[i]).transpose() * out[i]).template cast<typename In::Real>();
    }
    template <class F>
    void forEachJacobianBlock(int point, F&& f) const {
      f(of.bodies[std::size_t(point)], Frame::jacobian(of.rotated[std::size_t(point)]));
    }
    void updateK(typename Out::VecDeriv const& f) const {
      if (of.geometricStiffness == RotationalStiffness::none) return;
      for (std::size_t i = 0; i < f.size(); ++i) of.forces[i] = f[i];
    }
    void gather(typename In::VecDeriv const& dx) const {
      if (of.geometricStiffness == RotationalStiffness::none) return;
      for (std::size_t b = 0; b < dx.size(); ++b)
        of.turns[b] = dx[b].template tail<angular>().template cast<Real>();
    }
    void addKx(typename In::VecDeriv& df, typename In::VecDeriv const&, double k) const {
      if (of.geometricStiffness == RotationalStiffness::none) return;
      for (std::size_t i = 0; i < of.bodies.size(); ++i)
        df[body(i)].template tail<angular>() +=
            (Real(k) * (of.coupling(i).transpose() * of.pointMotions[i] + of.turning(i) * of.turns[body(i)]))
                .template cast<typename In::Real>();
    }
    std::vector<bool> pointsThatStay(Renumbering const& parent) const {
      std::vector<bool> stays;
      for (const int b : of.bodies) stays.push_back(parent.stays(b));
      return stays;
    }

   private:
    std::size_t body(std::size_t i) const { return std::size_t(of.bodies[i]); }
  };
  Points<DeformableOnRigidFrameMapping> part(std::integral_constant<std::size_t, 0>) { return {*this}; }
  Frames<DeformableOnRigidFrameMapping> part(std::integral_constant<std::size_t, 1>) { return {*this}; }
  Points<DeformableOnRigidFrameMapping const> part(std::integral_constant<std::size_t, 0>) const {
    return {*this};
  }
  Frames<DeformableOnRigidFrameMapping const> part(std::integral_constant<std::size_t, 1>) const {
    return {*this};
  }

  void init(InitContext<In> const& points, InitContext<In2> const& frames, InitContext<Out> const& child,
            typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<DeformableOnRigidFrameMapping>());
    const std::size_t n = points.rest.size(), count = frames.rest.size();
    if (repartition.empty()) {
      check_numbers(where, "index", std::vector<int>{index}, count, "rigid bodies", frames.where);
      bodies.assign(n, indexFromEnd ? int(count) - 1 - index : index);
    } else {
      if (repartition.size() != 1 && repartition.size() != count)
        throw Error(where,
                    text("repartition has ",
                         repartition.size(),
                         " entries for ",
                         count,
                         " rigid bodies of ",
                         frames.where,
                         "; give one, or one for each body"));
      bodies.clear();
      for (std::size_t b = 0; b < count; ++b)
        bodies.insert(bodies.end(), std::size_t(repartition[repartition.size() == 1 ? 0 : b]), int(b));
      if (bodies.size() != n)
        throw Error(where,
                    text("repartition gives the rigid bodies ",
                         bodies.size(),
                         " points, and ",
                         points.where,
                         " has ",
                         n,
                         "; let each point be with one body"));
    }
    if (positions.empty()) positions.resize(n);
    if (positions.size() != n)
      throw Error(where,
                  text("the child has ",
                       positions.size(),
                       " points, and ",
                       points.where,
                       " has ",
                       n,
                       "; give the child as many, or none"));
    for (auto* list : {&local, &rotated, &forces, &pointMotions}) list->assign(n, Vec<Real, N>::Zero());
    rotations.assign(count, Mat<Real, N>::Identity());
    turns.assign(count, Vec<Real, angular>::Zero());
  }

  template <class Sink>
  void addToMatrix(MechanicalParams const& p, std::size_t a, std::size_t b, Sink const& sink) const {
    if (geometricStiffness == RotationalStiffness::none || (a == 0 && b == 0)) return;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Mat<typename In2::Real, N, In2::size> toPoint = Mat<typename In2::Real, N, In2::size>::Zero();
      toPoint.template rightCols<angular>() = (Real(p.k) * coupling(i)).template cast<typename In2::Real>();
      add(p, i, a, b, toPoint, sink);
    }
  }

  /// Points go with those of the parents.
  void follow(Renumbering const& child, std::vector<Renumbering const*> const& above) {
    if (!repartition.empty()) {
      std::vector<int> left(rotations.size(), 0);
      for (std::size_t i = 0; i < bodies.size(); ++i)
        if (child.stays(int(i))) ++left[std::size_t(bodies[i])];
      above[1]->filter(left);
      repartition = left;
    } else if (!bodies.empty()) {
      int body = indexFromEnd ? int(rotations.size()) - 1 - index : index;
      above[1]->renumber(body);
      index = body;
      indexFromEnd = false;
    }
  }

  // R of the body of a point
  Mat<Real, N> const& rotation(std::size_t i) const { return rotations[std::size_t(bodies[i])]; }
  // what a turn of the frame adds to the force on p: R' [f]x
  Mat<Real, N, angular> coupling(std::size_t i) const {
    Vec<Real, N> const& f = forces[i];
    Mat<Real, N, angular> cross;
    if constexpr (N == 3)
      cross = cross_matrix(f);
    else
      cross << f[1], -f[0];
    return rotation(i).transpose() * cross;
  }
  Mat<Real, angular> turning(std::size_t i) const { return Frame::stiffness(rotated[i], forces[i]); }

 private:
  template <class Block, class Sink>
  void add(MechanicalParams const& p, std::size_t i, std::size_t a, std::size_t b, Block const& toPoint,
           Sink const& sink) const {
    if (a == 0)
      sink.template add<0, 1>(int(i), bodies[i], toPoint);
    else if (b == 0)
      sink.template add<0, 1>(bodies[i], int(i), Mat<typename In2::Real, In2::size, N>(toPoint.transpose()));
    else {
      Mat<typename In2::Real, In2::size> turn = Mat<typename In2::Real, In2::size>::Zero();
      turn.template bottomRightCorner<angular, angular>() =
          (Real(p.k) * turning(i)).template cast<typename In2::Real>();
      sink.template add<0, 1>(bodies[i], bodies[i], turn);
    }
  }
};

}  // namespace sinew
