// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/cross_matrix.hpp>
#include <sinew/core/follow.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace sinew {

/// How the motions of several frames are blended.
enum class SkinningMethod { linear, dualQuaternion };
inline constexpr std::array<std::string_view, 2> enum_names(SkinningMethod) {
  return {"linear", "dualQuaternion"};
}
inline constexpr std::array<std::array<std::string_view, 2>, 2> enum_aliases(SkinningMethod) {
  return {{{"0", "linear"}, {"1", "dualQuaternion"}}};
}

/// Points carried by several rigid frames, each with a weight; sum_j w_j = 1. With the motion of frame j from
/// rest, x0 -> R_j x0 + t_j:
///   linear          x = sum_j w_j (R_j x0 + t_j)
///   dualQuaternion  x = the motion b / |b| of x0, b = sum_j w_j (q_j + e t_j q_j / 2): a rigid one, in which
///                   the skin does not shrink where frames twist (Kavan, Collins, Zara, O'Sullivan 2008)
/// Quaternions q_j are blended with the signs that bring them next to that of the first frame of a point.
/// Where no weights are given, each point has its `nbRef` nearest frames, by 1/d^2.
template <class I, class O>
struct SkinningMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static_assert(In::rigid && In::spatial == 3 && !Out::rigid && Out::size == 3,
                "SkinningMapping carries points in space by rigid frames");
  static constexpr std::string_view className = "SkinningMapping";

  typename Out::VecCoord initPos{};
  std::vector<int> nbRef{4}, indices{};
  std::vector<double> weight{};
  SkinningMethod method = SkinningMethod::linear;

  static constexpr auto fields() {
    using M = SkinningMapping;
    return field_list(
        field("initPos", &M::initPos, "m", "places of the points at rest; those of the child when not given")
            .oneEach(Of::points),
        field("nbRef",
              &M::nbRef,
              "",
              "how many frames carry a point: one number for all, or one for each",
              range::atLeast(1))
            .oneEach(Of::points),
        field("indices",
              &M::indices,
              "",
              "frames of each point, one point after the other",
              range::nonNegative),
        field("weight", &M::weight, "", "weights of these; scaled to the sum 1", range::nonNegative),
        field("method", &M::method, "", "how motions are blended"));
  }

  /// A point goes with the last of the frames that it was given; one that was given none finds others.
  std::vector<bool> pointsThatStay(Renumbering const& frames) const {
    std::vector<bool> stays(restPoints.size(), indices.empty());
    for (std::size_t i = 0; i < stays.size(); ++i)
      for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
        stays[i] = stays[i] || frames.stays(influences[k].frame);
    return stays;
  }
  void follow(Followed const& change) {
    if (indices.empty()) return;
    std::vector<bool> stays;
    std::vector<int> references;
    for (std::size_t i = 0; i < restPoints.size(); ++i) {
      int left = 0;
      for (std::size_t k = starts[i]; k < starts[i + 1]; ++k) {
        stays.push_back(change.parentPoints.stays(indices[k]));
        left += stays.back();
      }
      if (left > 0) references.push_back(left);
    }
    const Renumbering entries = Renumbering::of(stays);
    entries.filter(indices), entries.filter(weight);
    for (int& frame : indices) change.parentPoints.renumber(frame);
    nbRef = references;
  }

  struct Influence {
    int frame;
    Real weight;
    Vec<Real, 3> arm;          // from the frame to the point at rest, in axes of the frame
    Mat<Real, 3, 6> jacobian;  // at the last apply
  };
  std::vector<Influence> influences{};  // point by point
  std::vector<std::size_t> starts{0};   // where those of each point begin, and the end
  typename In::VecCoord restFrames{};
  std::vector<Vec<Real, 3>> restPoints{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<SkinningMapping>());
    if (parent.rest.empty()) throw Error(where, "the parent has no frames; give it some");
    if (positions.empty()) positions = initPos;
    if (!initPos.empty() && initPos.size() != positions.size())
      throw Error(where,
                  text("initPos has ",
                       initPos.size(),
                       " places for ",
                       positions.size(),
                       " points; give one for each, or none"));
    const std::size_t n = positions.size();
    if (nbRef.size() != 1 && nbRef.size() != n)
      throw Error(where,
                  text("nbRef has ", nbRef.size(), " entries for ", n, " points; give one, or one for each"));
    restFrames = parent.rest;
    restPoints.clear();
    for (std::size_t i = 0; i < n; ++i)
      restPoints.push_back((initPos.empty() ? positions[i] : initPos[i]).template cast<Real>());
    influences.clear();
    starts.assign(1, 0);
    if (indices.empty() && weight.empty())
      for (std::size_t i = 0; i < n; ++i) addNearest(i);
    else
      addGiven(where);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = starts[i]; k < starts[i + 1]; ++k) {
        auto const& frame = restFrames[std::size_t(influences[k].frame)];
        influences[k].arm = frame.orientation.conjugate() * Vec<Real, 3>(restPoints[i] - frame.center);
      }
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
      const Vec<Real, 3> x = method == SkinningMethod::linear ? blendLinear(i, in) : blendDual(i, in);
      out[i] = x.template cast<typename Out::Real>();
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
      Vec<Real, 3> v = Vec<Real, 3>::Zero();
      for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
        v += influences[k].jacobian * in[std::size_t(influences[k].frame)];
      out[i] = v.template cast<typename Out::Real>();
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i + 1 < starts.size(); ++i)
      for (std::size_t k = starts[i]; k < starts[i + 1]; ++k)
        in[std::size_t(influences[k].frame)] +=
            influences[k].jacobian.transpose() * out[i].template cast<Real>();
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    using J = Mat<typename Out::Real, 3, 6>;
    for (std::size_t k = starts[std::size_t(point)]; k < starts[std::size_t(point) + 1]; ++k)
      f(influences[k].frame, J(influences[k].jacobian.template cast<typename Out::Real>()));
  }

 private:
  std::size_t references(std::size_t point) const {
    return std::size_t(nbRef[nbRef.size() == 1 ? 0 : point]);
  }

  // of frames as near as each other the first
  void addNearest(std::size_t point) {
    std::vector<Influence> all;
    for (std::size_t f = 0; f < restFrames.size(); ++f) {
      const Real square = (restPoints[point] - restFrames[f].center).squaredNorm();
      all.push_back({int(f), square, {}, {}});
    }
    std::stable_sort(
        all.begin(), all.end(), [](auto const& a, auto const& b) { return a.weight < b.weight; });
    all.resize(std::min(all.size(), references(point)));
    // a frame at the very point carries it alone
    const Real nearest = all[0].weight;
    const bool alone = nearest <= std::numeric_limits<Real>::min();
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k].weight = alone ? Real(k == 0) : nearest / all[k].weight;
    add(all);
  }
  void addGiven(std::string const& where) {
    std::size_t needed = 0;
    for (std::size_t i = 0; i < restPoints.size(); ++i) needed += references(i);
    if (indices.size() != needed || weight.size() != needed)
      throw Error(where,
                  text("there are ",
                       indices.size(),
                       " indices and ",
                       weight.size(),
                       " weights, but nbRef asks for ",
                       needed,
                       "; give one of each for each frame of each point, or neither"));
    std::size_t next = 0;
    for (std::size_t i = 0; i < restPoints.size(); ++i) {
      std::vector<Influence> all;
      double sum = 0;
      for (std::size_t k = 0; k < references(i); ++k, ++next) {
        if (std::size_t(indices[next]) >= restFrames.size())
          throw Error(where,
                      text("indices has ",
                           indices[next],
                           ", but the parent has ",
                           restFrames.size(),
                           " frames, numbered from 0; correct the index"));
        sum += weight[next];
        if (weight[next] > 0) all.push_back({indices[next], Real(weight[next]), {}, {}});
      }
      if (!(sum > 0))
        throw Error(where, text("the weights of point ", i, " are all 0; give one that is greater"));
      add(all);
    }
  }
  void add(std::vector<Influence>& all) {
    Real sum = 0;
    for (auto const& one : all) sum += one.weight;
    for (auto& one : all) {
      one.weight /= sum;
      influences.push_back(one);
    }
    starts.push_back(influences.size());
  }

  Vec<Real, 3> blendLinear(std::size_t point, typename In::VecCoord const& in) {
    Vec<Real, 3> x = Vec<Real, 3>::Zero();
    for (std::size_t k = starts[point]; k < starts[point + 1]; ++k) {
      Influence& one = influences[k];
      auto const& frame = in[std::size_t(one.frame)];
      const Vec<Real, 3> arm = frame.orientation * one.arm;
      x += one.weight * (frame.center + arm);
      one.jacobian.template leftCols<3>() = one.weight * Mat<Real, 3>::Identity();
      one.jacobian.template rightCols<3>() = -one.weight * cross_matrix(arm);
    }
    return x;
  }

  // A product p q of quaternions (x, y, z, w) as matrices, left(p) q = right(q) p.
  using Four = Vec<Real, 4>;
  static Mat<Real, 4> left(Four const& p) { return product(p, Real(1)); }
  static Mat<Real, 4> right(Four const& q) { return product(q, Real(-1)); }
  static Mat<Real, 4> product(Four const& p, Real sign) {
    Mat<Real, 4> m;
    m.template topLeftCorner<3, 3>() =
        p[3] * Mat<Real, 3>::Identity() + sign * cross_matrix(Vec<Real, 3>(p.template head<3>()));
    m.template topRightCorner<3, 1>() = p.template head<3>();
    m.template bottomLeftCorner<1, 3>() = -p.template head<3>().transpose();
    m(3, 3) = p[3];
    return m;
  }
  static Four conjugate(Four q) {
    q.template head<3>() *= Real(-1);
    return q;
  }
  static Four pure(Vec<Real, 3> const& v) { return Four(v[0], v[1], v[2], 0); }

  struct Motion {
    Four q;                // rotation from rest, its sign that of the blend
    Vec<Real, 3> rotated;  // the centre at rest, rotated
    Four shift;            // t
  };
  Motion motion(Influence const& one, typename In::VecCoord const& in, Four const& pivot) const {
    auto const& frame = in[std::size_t(one.frame)];
    auto const& rest = restFrames[std::size_t(one.frame)];
    const Quat<Real> rotation = frame.orientation * rest.orientation.conjugate();
    Motion m{rotation.coeffs(), rotation * rest.center, {}};
    if (m.q.dot(pivot) < 0) m.q = -m.q;
    m.shift = pure(frame.center - m.rotated);
    return m;
  }

  // With n = |b|^2, b and d the real and the dual part of the blend, and the products of quaternions:
  //   x = vec(b x0 b* + 2 d b*) / n,   dx = 2/n (vec(db x0 b* + dd b* + d db*) - x b.db)
  Vec<Real, 3> blendDual(std::size_t point, typename In::VecCoord const& in) {
    Four pivot = Four::Zero(), b = Four::Zero(), d = Four::Zero();
    for (std::size_t k = starts[point]; k < starts[point + 1]; ++k) {
      const Motion m = motion(influences[k], in, pivot);
      if (k == starts[point]) pivot = m.q;
      b += influences[k].weight * m.q;
      d += influences[k].weight / 2 * (left(m.shift) * m.q);
    }
    const Real n = b.squaredNorm();
    const Mat<Real, 4> back = right(conjugate(b)), carried = back * right(pure(restPoints[point]));
    const Vec<Real, 3> x = (carried * b + 2 * (back * d)).template head<3>() / n;
    Mat<Real, 4> conjugation = -Mat<Real, 4>::Identity();
    conjugation(3, 3) = 1;
    // of b and of d
    const Mat<Real, 3, 4> byReal =
        2 / n * ((carried + left(d) * conjugation).template topRows<3>() - x * b.transpose());
    const Mat<Real, 3, 4> byDual = 2 / n * back.template topRows<3>();
    for (std::size_t k = starts[point]; k < starts[point + 1]; ++k) {
      Influence& one = influences[k];
      const Motion m = motion(one, in, pivot);
      // dq = w q / 2, dt = v - w x rotated, d(t q / 2) = dt q / 2 + t dq / 2
      const Mat<Real, 4, 3> half = right(m.q).template leftCols<3>() / 2;
      const Mat<Real, 4, 3> dual = half * cross_matrix(m.rotated) + left(m.shift) * half / 2;
      one.jacobian.template leftCols<3>() = one.weight * (byDual * half);
      one.jacobian.template rightCols<3>() = one.weight * (byReal * half + byDual * dual);
    }
    return x;
  }
};

}  // namespace sinew
