// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/block_rows.hpp>
#include <sinew/gpu/whole_team.hpp>

#include <cstddef>

namespace sinew::gpu {

/// Three numbers a point.
SINEW_INLINE Eigen::Vector3d vector_at(double const* of, int i) {
  return {of[3 * i], of[3 * i + 1], of[3 * i + 2]};
}
SINEW_INLINE void put_vector(double* of, int i, Eigen::Vector3d const& v) {
  for (int c = 0; c < 3; ++c) of[3 * i + c] = v[c];
}

/// The assembled matrix of one body of points among those of a system.
template <class D>
struct SystemBody {
  typename BlockRows<D>::RowProduct product;  // x and r are not read
  int const* diagonal;                        // place of each row's
  int begin, points;                          // among the points of all bodies
  double scale;                               // S = scale A
  // of each point the directions, as bits, in which projective constraints hold it; null where there are none
  unsigned char const* held;
  // what the free motion has left of its equation, three numbers a point, times restScale; null where there
  // is nothing
  double const* rest;
  double restScale;
};

template <class D, class Team>
class TeamRows;

/// The matrix S of several bodies of points, one after the other, all in memory of the device; behind them
/// points whose first coordinate alone has a number of its own, `slack`.
template <class D>
struct SystemOfBodies {
  SystemBody<D> const* body;
  int bodies, points, all;  // all: with slack
  double const* slack;

  static constexpr bool alone = false;
  static constexpr std::size_t entryBytes = 9 * sizeof(typename D::Real) + sizeof(int);
  template <class Team>
  using Rows = TeamRows<D, Team>;

  SINEW_INLINE SystemBody<D> const& bodyOf(int i) const {
    SystemBody<D> const* b = body;
    while (i >= b->begin + b->points) ++b;
    return *b;
  }
  SINEW_INLINE int heldBits(int i) const {
    if (i >= points) return 0;
    SystemBody<D> const& b = bodyOf(i);
    return b.held ? b.held[i - b.begin] : 0;
  }
  SINEW_INLINE Eigen::Vector3d restOf(int i) const {
    if (i < points)
      if (SystemBody<D> const& b = bodyOf(i); b.rest) return b.restScale * vector_at(b.rest, i - b.begin);
    return Eigen::Vector3d::Zero();
  }

  /// Which degrees of freedom of a body projective constraints leave; where these make something else of a
  /// motion than 0 or itself, 1 is returned.
  struct TakeHeld {
    typename D::Deriv const* projected;  // of numbersOf
    unsigned char* held;
    SINEW_HD double operator()(int i) const {
      int bits = 0;
      bool mixes = false;
      for (int c = 0; c < 3; ++c) {
        bits |= projected[i][c] == 0 ? 1 << c : 0;
        mixes = mixes || (projected[i][c] != 0 && projected[i][c] != number(3 * i + c));
      }
      held[i] = static_cast<unsigned char>(bits);
      return mixes ? 1 : 0;
    }
  };
  /// Numbers that no two neighbours share, exact in single precision.
  struct SetNumbers {
    typename D::Deriv* to;
    SINEW_HD void operator()(int i) const {
      to[i] = typename D::Deriv(number(3 * i), number(3 * i + 1), number(3 * i + 2));
    }
  };

 private:
  SINEW_INLINE static typename D::Real number(int i) {
    return typename D::Real(1 + double(i * 619 % 1024) / 1024);
  }
};

/// The rows of a system as a team multiplies them: the first entries of the first row of each thread are in
/// shared memory, since what is read from that of the GPU comes from far behind each sum.
template <class D, class Team>
class TeamRows {
  using Rows = BlockRows<D>;
  using Real = typename D::Real;
  using Vector = Eigen::Vector3d;

 public:
  static constexpr std::size_t entryBytes = SystemOfBodies<D>::entryBytes;

  SINEW_INLINE TeamRows(Team& team, SystemOfBodies<D> const& system) : team_(team), system_(system) {
    own_ = team.firstRow();
    if (own_ < 0 || own_ >= system.all) own_ = -1;
    if (own_ < 0) return;
    bits_ = system.heldBits(own_);
    if (own_ >= system.points) return;
    SystemBody<D> const& b = system.bodyOf(own_);
    at_ = placesOf(b, own_, team.lane());
    // always an even number, with zeros
    for (int k = 0; k < team.kept(); ++k) {
      const bool is = at_.from < at_.end;
      if (!is && k % 2 == 0) break;
      for (int c = 0; c < 9; ++c)
        team.template keeps<Real>(0, 9 * k + c) = is ? Rows::at(b.product.values, at_.from, c) : Real(0);
      team.template keeps<int>(columns(), k) = is ? b.begin + b.product.column[at_.from] : own_;
      used_ = k + 1;
      if (is) at_.from += Team::lanes * Rows::slice;
    }
    scale_ = b.scale;
  }

  /// Adds the part of a lane of S p in a point.
  template <class P>
  SINEW_INLINE void add(int i, int lane, P&& p, double (&sum)[3]) const {
    if (i >= system_.points) {
      if (lane != 0) return;
      const Vector v = p(i);
      sum[0] += system_.slack[i - system_.points] * v[0];
      sum[1] += v[1];
      sum[2] += v[2];
      return;
    }
    double own[3] = {0, 0, 0};
    if (i != own_) {
      SystemBody<D> const& b = system_.bodyOf(i);
      addPlaces(b, placesOf(b, i, lane), p, own);
      for (int c = 0; c < 3; ++c) sum[c] += b.scale * own[c];
      return;
    }
    for (int k = 0; k < used_; k += 2) {
      const Vector one = p(team_.template keeps<int>(columns(), k)),
                   other = p(team_.template keeps<int>(columns(), k + 1));
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          own[r] += double(team_.template keeps<Real>(0, 9 * k + 3 * r + c)) * one[c] +
                    double(team_.template keeps<Real>(0, 9 * (k + 1) + 3 * r + c)) * other[c];
    }
    if (at_.from < at_.end) addPlaces(system_.bodyOf(i), at_, p, own);
    for (int c = 0; c < 3; ++c) sum[c] += scale_ * own[c];
  }
  /// The diagonal block of a point, with 1 in the place of what is held.
  SINEW_INLINE Eigen::Matrix3d diagonal(int i) const {
    Eigen::Matrix3d d = Eigen::Matrix3d::Identity();
    if (i >= system_.points) {
      d(0, 0) = system_.slack[i - system_.points];
      return d;
    }
    SystemBody<D> const& b = system_.bodyOf(i);
    const int place = b.diagonal[i - b.begin], held = system_.heldBits(i);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        if (!(held >> r & 1) && !(held >> c & 1))
          d(r, c) = b.scale * double(Rows::at(b.product.values, place, 3 * r + c));
    return d;
  }
  /// Without what projective constraints hold.
  SINEW_INLINE void hold(int i, double (&v)[3]) const {
    const int bits = i == own_ ? bits_ : system_.heldBits(i);
    for (int c = 0; c < 3; ++c)
      if (bits >> c & 1) v[c] = 0;
  }

 private:
  struct Places {
    int from, end;
  };
  Team& team_;
  SystemOfBodies<D> const& system_;
  int own_ = -1, bits_ = 0, used_ = 0;
  Places at_{0, 0};  // what is not kept
  double scale_ = 0;

  SINEW_INLINE std::size_t columns() const { return std::size_t(team_.kept()) * 9 * sizeof(Real); }
  SINEW_INLINE static Places placesOf(SystemBody<D> const& b, int i, int lane) {
    const int row = i - b.begin, slice = row / Rows::slice;
    return {b.product.sliceFirst[slice] + row % Rows::slice + lane * Rows::slice,
            b.product.sliceFirst[slice + 1]};
  }
  template <class P>
  SINEW_INLINE static void addPlaces(SystemBody<D> const& b, Places at, P&& p, double (&own)[3]) {
    for (int place = at.from; place < at.end; place += Team::lanes * Rows::slice) {
      const Vector v = p(b.begin + b.product.column[place]);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) own[r] += double(Rows::at(b.product.values, place, 3 * r + c)) * v[c];
    }
  }
};

}  // namespace sinew::gpu
