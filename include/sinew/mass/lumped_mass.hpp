// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/point_loop.hpp>

#include <Eigen/LU>
#include <cmath>
#include <type_traits>
#include <vector>

namespace sinew {

/// Gives points of no element, on which values lie, the mean capacity of all: nothing flows to them, so that
/// they keep their values with any. Returns which points these are.
inline std::vector<std::size_t> fill_unused(std::vector<double>& capacities) {
  double mean = 0;
  for (const double c : capacities) mean += c / double(capacities.size());
  std::vector<std::size_t> unused;
  for (std::size_t i = 0; i < capacities.size(); ++i)
    if (capacities[i] == 0) capacities[i] = mean, unused.push_back(i);
  return unused;
}

/// Masses lumped at the points, one for all or one for each: the loops behind UniformMass and DiagonalMass.
/// The mass of a point is a scalar, that of a rigid body also has an inertia I in body axes; R rotates it to
/// the world.
template <class D>
struct LumpedMass {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr int linear = D::spatial, angular = D::rigid ? D::size - D::spatial : 0;
  // whether loops find the scalars of all points one behind the other
  static constexpr bool flat = !D::rigid && std::is_same_v<VecDeriv, std::vector<Deriv>>;

  typename D::template Array<MassType> mass{}, inverse{};
  std::vector<int> massless{};  // points without mass, which nothing may accelerate
  std::string place{};          // of the component, for messages

  /// `maybeMassless`: which points may have no mass, where some may.
  void init(std::string const& where, std::vector<MassType> const& given,
            std::vector<bool> const& maybeMassless = {}) {
    mass = given;
    inverse.clear();
    massless.clear();
    place = where;
    for (std::size_t i = 0; i < mass.size(); ++i) {
      if constexpr (D::rigid) {
        auto const& inertia = mass[i].inertia;
        // positive definite: all leading minors positive
        bool positive = inertia.allFinite() && inertia(0, 0) > 0 && inertia.determinant() > 0 &&
                        (inertia - inertia.transpose()).norm() <= Real(1e-5) * inertia.norm();
        if constexpr (angular == 3)
          positive = positive && inertia.template topLeftCorner<2, 2>().determinant() > 0;
        if (!(mass[i].mass > 0) || !std::isfinite(mass[i].mass) || !positive)
          throw Error(
              where,
              text("mass ",
                   i,
                   " is ",
                   mass[i].mass,
                   " kg; the mass of a rigid body must be greater than 0, and its inertia symmetric and "
                   "positive definite"));
        inverse.push_back({1 / mass[i].mass, inertia.inverse()});
      } else {
        if (flat && mass[i] == 0 && i < maybeMassless.size() && maybeMassless[i]) {
          massless.push_back(int(i));
          inverse.push_back(0);
          continue;
        }
        if (!(mass[i] > 0) || !std::isfinite(mass[i]))
          throw Error(
              where,
              text("the mass of point ",
                   i,
                   " is ",
                   mass[i],
                   " kg, but must be greater than 0; correct it, or give the point an element or a mass"));
        inverse.push_back(1 / mass[i]);
      }
    }
  }

  MassType const& at(std::size_t i) const { return mass.size() == 1 ? mass[0] : mass[i]; }
  MassType const& inverseAt(std::size_t i) const { return inverse.size() == 1 ? inverse[0] : inverse[i]; }

  /// f += m g, and the gyroscopic torque -w x (I w) of bodies that rotate.
  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    const Vec<Real, linear> g = p.gravity.head<linear>().template cast<Real>();
    if constexpr (!flat)
      each_point<D>(
          f.size(),
          Weigh{
              g, entries(f), entries(mass), entries(x), entries(v), mass.size() > 1, Real(p.gyroscopicStep)});
    else
      for (std::size_t i = 0; i < f.size(); ++i)
        for (int c = 0; c < linear; ++c) f[i][c] += at(i) * g[c];
  }

  /// f += factor M dx
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, Real factor) const {
    if constexpr (!flat)
      forEachPoint(f, mass, x, dx, Add{factor});
    else
      forEachScalar(
          f, mass, [&](Real& fi, Real m, Real d) { fi += factor * m * d; }, dx);
  }
  /// a = M^-1 f, and 0 for points without mass and force. Throws Error at one without mass that has a force.
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const {
    if constexpr (flat)
      for (const int i : massless)
        if (!f[std::size_t(i)].isZero(0))
          throw Error(place,
                      text("point ",
                           i,
                           " has a force and no mass, as no element has it; take an implicit solver, or give "
                           "the point an element or a mass"));
    if constexpr (!flat)
      forEachPoint(a, inverse, x, f, Set{});
    else
      forEachScalar(
          a, inverse, [](Real& ai, Real w, Real fi) { ai = w * fi; }, f);
  }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * double(v[i].dot(multiply(at(i), x[i], v[i])));
    return sum;
  }
  double totalMass(std::size_t points) const {
    double sum = 0;
    for (std::size_t i = 0; i < points; ++i) sum += double(scalar(at(i)));
    return sum;
  }

  /// The matrix gets factor M.
  template <class Sink>
  void addToMatrix(VecCoord const& x, Real factor, Sink const& sink) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
      Mat<Real, D::size> block = Mat<Real, D::size>::Zero();
      block.template topLeftCorner<linear, linear>().diagonal().setConstant(factor * scalar(at(i)));
      if constexpr (D::rigid)
        block.template bottomRightCorner<angular, angular>() = factor * worldInertia(at(i), x[i]);
      else
        block.diagonal().setConstant(factor * at(i));
      sink.add(int(i), int(i), block);
    }
  }

  SINEW_INLINE static Real scalar(MassType const& m) {
    if constexpr (D::rigid)
      return m.mass;
    else
      return m;
  }

  struct Weigh {
    Vec<Real, linear> g;
    Deriv* f;
    MassType const* mass;
    Coord const* x;
    Deriv const* v;
    bool each;            // has a mass of its own
    Real gyroscopicStep;  // see MechanicalParams
    SINEW_HD void operator()(int i) const {
      MassType const& own = mass[each ? i : 0];
      for (int c = 0; c < linear; ++c) f[i][c] += scalar(own) * g[c];
      if constexpr (angular == 3) {
        const Vec<Real, 3> w = v[i].template tail<3>();
        f[i].template tail<3>() += gyroscopic(worldInertia(own, x[i]), w, gyroscopicStep);
      }
    }
  };
  // change(to, M from) for each point
  struct Add {
    Real factor;
    SINEW_INLINE void operator()(Deriv& to, Deriv const& product) const { to += factor * product; }
  };
  struct Set {
    SINEW_INLINE void operator()(Deriv& to, Deriv const& product) const { to = product; }
  };
  template <class Masses, class Change>
  static void forEachPoint(VecDeriv& to, Masses const& masses, VecCoord const& x, VecDeriv const& from,
                           Change change) {
    each_point<D>(
        to.size(),
        Multiply<Change>{entries(to), entries(masses), entries(x), entries(from), masses.size() > 1, change});
  }
  template <class Change>
  struct Multiply {
    Deriv* to;
    MassType const* mass;
    Coord const* x;
    Deriv const* from;
    bool each;
    Change change;
    SINEW_HD void operator()(int i) const { change(to[i], multiply(mass[each ? i : 0], x[i], from[i])); }
  };
  // -w x (I w); of a step h that at its end: I (u - w)/h, where I (u - w) + h u x (I u) = 0. Then u.I u <=
  // w.I w, and a body that rotates by h u still has the energy of u (Catto, Numerical Methods, GDC 2015, with
  // one iteration of Newton's method). Where these do not converge, beyond a radian a step, u is made no
  // faster than w.
  SINEW_HD static Vec<Real, 3> gyroscopic(Mat<Real, 3> const& inertia, Vec<Real, 3> const& w, Real h) {
    using std::sqrt;
    const Vec<Real, 3> torque = -w.cross(inertia * w);
    if (h == Real(0) || torque.squaredNorm() == Real(0)) return torque;
    auto cross = [](Vec<Real, 3> const& a) {
      Mat<Real, 3> m;
      m << Real(0), -a[2], a[1], a[2], Real(0), -a[0], -a[1], a[0], Real(0);
      return m;
    };
    Vec<Real, 3> u = w;
    for (int i = 0; i < 4; ++i) {
      const Vec<Real, 3> momentum = inertia * u;
      const Mat<Real, 3> slope = inertia + (cross(u) * inertia - cross(momentum)) * h;
      u -= slope.inverse() * (momentum - inertia * w + u.cross(momentum) * h);
    }
    const Real before = w.dot(inertia * w), after = u.dot(inertia * u);
    if (after > before) u *= sqrt(before / after);
    return inertia * (u - w) * (1 / h);
  }

  // change(to, mass, from) for each component of each point: a loop that becomes one over registers
  template <class Change>
  static void forEachScalar(VecDeriv& to, std::vector<Real> const& mass, Change const& change,
                            VecDeriv const& from) {
    constexpr int n = D::size;
    const std::size_t points = to.size();
    if (points == 0) return;
    Real* const r = to.data()->data();
    Real const* const a = from.data()->data();
    if (mass.size() == 1) {
      const Real m = mass[0];
      for (std::size_t k = 0; k < points * n; ++k) change(r[k], m, a[k]);
    } else {
      Real const* const m = mass.data();
      for (std::size_t i = 0; i < points; ++i)
        for (std::size_t c = 0; c < n; ++c) change(r[n * i + c], m[i], a[n * i + c]);
    }
  }
  SINEW_HD static Deriv multiply(MassType const& m, Coord const& x, Deriv const& dx) {
    if constexpr (D::rigid) {
      Deriv r;
      r.template head<linear>() = m.mass * dx.template head<linear>();
      r.template tail<angular>() = worldInertia(m, x) * dx.template tail<angular>();
      return r;
    } else {
      (void)x;
      return m * dx;
    }
  }
  SINEW_HD static auto worldInertia(MassType const& m, Coord const& x) {
    if constexpr (angular == 3) {
      const Mat<Real, 3> r = x.orientation.toRotationMatrix();
      return Mat<Real, 3>(r * m.inertia * r.transpose());
    } else {
      (void)x;
      return m.inertia;
    }
  }
};

}  // namespace sinew
