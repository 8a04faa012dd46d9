// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/gpu/data_types.hpp>
#include <sinew/gpu/reduction.hpp>
#include <sinew/gpu/solver_workspace.hpp>
#include <sinew/state/vector_operations.hpp>

namespace sinew {

namespace gpu {

/// The numbers of one solve by conjugate gradients, on the device: r.r and r.z, z the residual after
/// preconditioning, at the start and after each iteration, and the curvatures p.Ap. An iteration i that has
/// nothing left to do changes nothing: its step is 0.
struct CgScalars {
  double* size;
  double* rho;  // the same as `size` where there is no preconditioner
  double* curvature;
  double tolerance2, threshold;

  SINEW_INLINE bool goesOn(int i) const {
    return size[i] > tolerance2 * size[0] && (curvature[i] > threshold || curvature[i] < -threshold);
  }
  SINEW_INLINE double alpha(int i) const { return goesOn(i) ? rho[i] / curvature[i] : 0; }
  SINEW_INLINE double beta(int i) const { return rho[i + 1] / rho[i]; }
};

template <class Operations, class Solver, class MultiVec>
void conjugate_gradients(Operations&, Solver&, MatrixFactors, MultiVec&, MultiVec&, DeviceVector<double>&);
template <class D, class Operations, class Solver, class MultiVec>
bool multigrid_gradients(Operations&, Solver&, MatrixFactors, MultiVec&, MultiVec&, bool, bool);
template <class Operations>
bool can_assemble(Operations&, bool);

}  // namespace gpu

/// Vectors of states on the device: one thread a scalar, or a point.
template <class H>
struct VectorOperations<CudaTypes<H>> {
  using D = CudaTypes<H>;
  using Real = typename D::Real;
  static constexpr bool solvesSystems = true;
  static constexpr bool solvesMotions = !D::rigid && D::size == 3;
  static constexpr bool findsContacts = solvesMotions;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;

  template <class Run>
  static void clear(Run const&, VecDeriv& r) {
    gpu::for_each_index(scalars(r), Set{overwritten(r)});
  }
  template <class Run, class V>
  static void eq(Run const&, V& r, V const& a) {
    gpu::copy_on_device(r.overwrite(), a.device(), a.size());
  }
  static void eq(VecDeriv& r, VecDeriv const& a, Real f) {
    Real const* const from = flat(a);
    gpu::for_each_index(scalars(r), Scale{&r == &a ? flat(r) : overwritten(r), from, f});
  }
  template <class Run>
  static void peq(Run const&, VecDeriv& r, VecDeriv const& a, Real f) {
    gpu::for_each_index(scalars(r), Add{flat(r), flat(a), f});
  }
  static void move(VecCoord& x, VecDeriv const& a, Real f) {
    gpu::for_each_index(x.size(), Move{x.device(), a.device(), f});
  }
  static void difference(VecDeriv& r, VecCoord const& a, VecCoord const& b) {
    gpu::for_each_index(r.size(), Difference{r.overwrite(), a.device(), b.device()});
  }
  template <class V>
  static void bringToHost(V const& v) {
    v.bringToHost();
  }
  static void teq(VecDeriv& r, Real f) {
    Real* const to = flat(r);
    gpu::for_each_index(scalars(r), Scale{to, to, f});
  }
  template <class Run>
  static double dot(Run const&, VecDeriv const& a, VecDeriv const& b) {
    return gpu::sum_on_host(scalars(a), product(a, b));
  }
  template <class Run>
  static void xpay(Run const&, VecDeriv& r, VecDeriv const& a, Real f) {
    gpu::for_each_index(scalars(r), Xpay{flat(r), flat(a), f});
  }
  template <class Run>
  static double advance(Run const&, VecDeriv& x, VecDeriv const& p, VecDeriv& r, VecDeriv const& q, Real f) {
    return gpu::sum_on_host(scalars(x), Advance{flat(x), flat(r), flat(p), flat(q), f});
  }
  static void chartRate(VecDeriv& rate, VecDeriv const& theta, VecDeriv const& v) {
    gpu::for_each_index(rate.size(), ChartRate{rate.device(), theta.device(), v.device()});
  }
  static int findNotFinite(VecCoord const& x) {
    if (gpu::recording()) return -1;
    if (!x.isOnHost() && gpu::sum_on_host(x.size(), NotFinite{x.device()}) == 0) return -1;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!D::finite(x[i])) return int(i);
    return -1;
  }

  // conjugate gradients whose numbers stay on the device

  static void dot(VecDeriv const& a, VecDeriv const& b, double* to) {
    gpu::sum_indices(scalars(a), product(a, b), to);
  }
  /// x += alpha p, r -= alpha q of iteration i; *to = r.r.
  static void advance(VecDeriv& x, VecDeriv const& p, VecDeriv& r, VecDeriv const& q, gpu::CgScalars const& s,
                      int i, double* to) {
    gpu::sum_indices(scalars(x), AdvanceOfIteration{flat(x), flat(r), flat(p), flat(q), s, i}, to);
  }
  /// p = r + beta p of iteration i
  static void xpay(VecDeriv& p, VecDeriv const& r, gpu::CgScalars const& s, int i) {
    gpu::for_each_index(scalars(p), XpayOfIteration{flat(p), flat(r), s, i});
  }

  /// Whether the matrix of a solver can be assembled on the device.
  template <class Operations>
  static bool assembles(Operations& operations) {
    return gpu::can_assemble(operations, false);
  }
  /// The same in this step, for the motion with multipliers.
  template <class Operations>
  static bool assemblesMotion(Operations& operations) {
    return gpu::can_assemble(operations, true);
  }
  /// Solves with conjugate gradients for states that are all on the device.
  template <class Solver, class Operations, class MultiVec>
  static void solve(Solver& solver, Operations& operations, MatrixFactors factors, MultiVec& x, MultiVec& b,
                    gpu::DeviceVector<double>& numbers) {
    gpu::conjugate_gradients(operations, solver, factors, x, b, numbers);
  }
  /// Solves with multigrid; false where that has to be done by the host.
  template <class Solver, class Operations, class MultiVec>
  static bool solveByMultigrid(Solver& solver, Operations& operations, MatrixFactors factors, MultiVec& x,
                               MultiVec& b, bool update, bool again) {
    if constexpr (solvesMotions)
      return gpu::multigrid_gradients<D>(operations, solver, factors, x, b, update, again);
    else
      return false;
  }

  static std::size_t scalars(VecDeriv const& v) { return v.size() * std::size_t(D::size); }
  static Real* flat(VecDeriv& v) { return reinterpret_cast<Real*>(v.device()); }
  static Real const* flat(VecDeriv const& v) { return reinterpret_cast<Real const*>(v.device()); }
  static Real* overwritten(VecDeriv& v) { return reinterpret_cast<Real*>(v.overwrite()); }
  static auto product(VecDeriv const& a, VecDeriv const& b) { return Product{flat(a), flat(b)}; }

  // what threads do; no lambdas, since those of a template that nvcc has compiled in two files are mixed up

  struct Set {
    Real* to;
    SINEW_HD void operator()(int i) const { to[i] = Real(0); }
  };
  struct Scale {
    Real* to;
    Real const* from;
    Real f;
    SINEW_HD void operator()(int i) const { to[i] = f * from[i]; }
  };
  struct Add {
    Real* to;
    Real const* from;
    Real f;
    SINEW_HD void operator()(int i) const { to[i] += f * from[i]; }
  };
  struct Move {
    Coord* to;
    Deriv const* from;
    Real f;
    SINEW_HD void operator()(int i) const { D::increment(to[i], Deriv(f * from[i])); }
  };
  struct Difference {
    Deriv* to;
    Coord const *a, *b;
    SINEW_HD void operator()(int i) const { to[i] = D::difference(a[i], b[i]); }
  };
  struct Xpay {
    Real* p;
    Real const* r;
    Real beta;
    SINEW_HD void operator()(int i) const { p[i] = r[i] + beta * p[i]; }
  };
  struct XpayOfIteration {
    Real* p;
    Real const* r;
    gpu::CgScalars s;
    int iteration;
    SINEW_HD void operator()(int i) const {
      if (s.goesOn(iteration)) p[i] = r[i] + Real(s.beta(iteration)) * p[i];
    }
  };
  struct Advance {
    Real *x, *r;
    Real const *p, *q;
    Real alpha;
    SINEW_HD double operator()(int i) const {
      x[i] += alpha * p[i];
      const Real left = r[i] - alpha * q[i];
      r[i] = left;
      return double(left) * double(left);
    }
  };
  struct AdvanceOfIteration {
    Real *x, *r;
    Real const *p, *q;
    gpu::CgScalars s;
    int iteration;
    SINEW_HD Advance ofThread() const { return {x, r, p, q, Real(s.alpha(iteration))}; }
  };
  struct ChartRate {
    Deriv* to;
    Deriv const *angle, *velocity;
    SINEW_HD void operator()(int i) const { to[i] = D::chart_rate(angle[i], velocity[i]); }
  };
  struct NotFinite {
    Coord const* x;
    SINEW_HD double operator()(int i) const {
      constexpr int n = int(sizeof(Coord) / sizeof(Real));
      Real const* const c = reinterpret_cast<Real const*>(x + i);
      bool finite = true;
      for (int k = 0; k < n; ++k) finite = finite && c[k] - c[k] == Real(0);
      return finite ? 0.0 : 1.0;
    }
  };
  struct Product {
    Real const *a, *b;
    SINEW_HD double operator()(int i) const { return double(a[i]) * double(b[i]); }
  };
};

}  // namespace sinew
