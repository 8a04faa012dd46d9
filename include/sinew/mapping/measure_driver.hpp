// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/child_points.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace sinew {

/// Numbers that are functions c of a few points of a parent, each a point of a child over Vec1:
///   J = (grad_0 c, grad_1 c, ...)        K_g = f d2c/dx2        with f the force on c
/// `Measure` has arity, the number of points; value(places), which keeps what the others need; slope(k), the
/// gradient by point k; second(i, j), the derivative of the gradient by point i with respect to point j.
template <class In, class Out, class Measure>
struct MeasureDriver {
  using Real = typename In::Real;
  static constexpr int N = In::spatial, arity = Measure::arity;
  static_assert(!Out::rigid && Out::size == 1, "Sinew: what is measured is a number: the child is over Vec1");

  struct One {
    std::array<Index, std::size_t(arity)> points;
    Measure measure;
    Real force{0};  // at the last updateK
  };
  std::vector<One> all{};

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t e = 0; e < all.size(); ++e) {
      std::array<Vec<Real, N>, std::size_t(arity)> x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = In::center(in[std::size_t(all[e].points[k])]);
      out[e][0] = typename Out::Real(all[e].measure.value(x));
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t e = 0; e < all.size(); ++e) {
      Real rate(0);
      for (int k = 0; k < arity; ++k) rate += all[e].measure.slope(k).dot(part(in, all[e], k));
      out[e][0] = typename Out::Real(rate);
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t e = 0; e < all.size(); ++e)
      for (int k = 0; k < arity; ++k) part(in, all[e], k) += all[e].measure.slope(k) * Real(out[e][0]);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    One const& one = all[std::size_t(point)];
    for (int k = 0; k < arity; ++k) {
      Mat<typename Out::Real, 1, In::size> row = Mat<typename Out::Real, 1, In::size>::Zero();
      row.template head<N>() = one.measure.slope(k).transpose().template cast<typename Out::Real>();
      f(one.points[std::size_t(k)], row);
    }
  }

  void updateK(typename Out::VecDeriv const& f, GeometricStiffness which) {
    for (std::size_t e = 0; e < all.size(); ++e) {
      const Real force = Real(f[e][0]);
      all[e].force = adds_stiffness(which, force) ? force : Real(0);
    }
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    forEachBlock(k, [&](One const& one, int i, int j, Mat<Real, N> const& block) {
      part(df, one, i) += block * part(dx, one, j);
    });
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    forEachBlock(p.k, [&](One const& one, int i, int j, Mat<Real, N> const& block) {
      Mat<Real, In::size> whole = Mat<Real, In::size>::Zero();
      whole.template topLeftCorner<N, N>() = block;
      sink.add(one.points[std::size_t(i)], one.points[std::size_t(j)], whole);
    });
  }

 private:
  static auto part(typename In::VecDeriv& v, One const& one, int k) {
    return v[std::size_t(one.points[std::size_t(k)])].template head<N>();
  }
  static Vec<Real, N> part(typename In::VecDeriv const& v, One const& one, int k) {
    return v[std::size_t(one.points[std::size_t(k)])].template head<N>();
  }
  template <class F>
  void forEachBlock(double factor, F const& f) const {
    for (One const& one : all)
      for (int i = 0; i < arity; ++i)
        for (int j = 0; j < arity; ++j)
          f(one, i, j, Mat<Real, N>(Real(factor) * one.force * one.measure.second(i, j)));
  }
};

}  // namespace sinew
