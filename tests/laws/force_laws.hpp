// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <sinew/core/assembly.hpp>
#include <sinew/linalg/block_matrix.hpp>

namespace laws {

using namespace sinew;
using sample::Random;

template <class D>
double norm(std::vector<D> const& a) {
  return std::sqrt(vec::dot(a, a));
}
template <class D>
double distance(std::vector<D> const& a, std::vector<D> const& b) {
  return double((vec::flat(a) - vec::flat(b)).norm());
}

/// The same driver with one element a pack.
template <template <class> class LawOf, class D, int W>
ElementDriver<LawOf, D, 1> scalar_driver(ElementDriver<LawOf, D, W> const& packed) {
  using Real = typename D::Real;
  using Rest = typename LawOf<D>::Rest;
  std::vector<std::array<int, LawOf<D>::arity>> elements;
  std::vector<Rest> rest;
  for (auto const& pack : packed.packs)
    for (int l = 0; l < pack.active; ++l) {
      constexpr std::size_t reals = sizeof(Rest) / sizeof(Real);
      Real all[reals * std::size_t(W)], one[reals];
      std::memcpy(all, static_cast<void const*>(&pack.rest), sizeof all);
      for (std::size_t r = 0; r < reals; ++r) one[r] = all[r * std::size_t(W) + std::size_t(l)];
      rest.emplace_back();
      std::memcpy(static_cast<void*>(&rest.back()), one, sizeof one);
      elements.emplace_back();
      for (std::size_t k = 0; k < elements.back().size(); ++k) elements.back()[k] = pack.index[k][l];
    }
  ElementDriver<LawOf, D, 1> driver;
  driver.init(elements, rest);
  return driver;
}

template <class C>
struct ForceSuite {
  using D = typename C::DataTypes;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr bool isDouble = sizeof(Real) == 8;
  // differences over 2e-5 of values of order 1: rounding 1e-16 / 1e-5 = 1e-11, truncation 1e-10 of the third
  // derivative
  static constexpr double differences = 1e-6;
  static constexpr double rounding = isDouble ? 1e-12 : 2e-4;

  Random random{20070101};
  sample::Body body{random};
  VecCoord rest = sample::positions<D>(body, random);
  std::size_t n = rest.size();
  VecDeriv zero = VecDeriv(n, D::Deriv::Zero());
  MechanicalParams params{.time = 10};  // after the key times of forces that have them

  void run() {
    sample::for_each_variant<C>(random, [&](C sampled) {
      INFO(component_name<C>());
      C c = sampled;
      check_fields(c, "sample");
      c.init(InitContext<D>{"sample", rest, body.topology()});
      VecCoord x = rest;
      VecDeriv shake = sample::derivs<D>(n, random, 0.1), v = sample::derivs<D>(n, random);
      vec::increment<D>(x, shake, Real(1));
      const auto claims = properties_of(c);
      REQUIRE(norm(force(c, x, v)) > 1e-3);  // the sample is not empty

      if constexpr (isDouble) {
        if (claims.conservative) energyGradient(c, x);
        tangent(c, claims.exactTangent ? x : turned(rest), v);
      }
      symmetry(c, x, v);
      assembled(c, x, v);
      if (claims.internal) wholeMotion(c, claims, x, v);
      if constexpr (requires { c.driver; }) lanesAgree(c, x, v);
    });
  }

  VecDeriv force(C& c, VecCoord const& x, VecDeriv const& v) const {
    VecDeriv f = zero;
    c.addForce(params, f, x, v);
    return f;
  }
  VecDeriv product(C& c, VecDeriv const& dx, double k, double b) const {
    VecDeriv df = zero;
    MechanicalParams p = params;
    p.k = k, p.b = b;
    c.addDForce(p, df, dx);
    return df;
  }
  VecCoord moved(VecCoord x, VecDeriv const& dx, double h) const {
    vec::increment<D>(x, dx, Real(h));
    return x;
  }
  VecCoord turned(VecCoord x) {
    if constexpr (D::rigid) {
      return x;
    } else {
      const auto q = rotation();
      for (auto& p : x) p = q * p + D::Deriv::Constant(Real(0.5));
      return x;
    }
  }
  Mat<Real, D::size> rotation() const {
    Mat<Real, D::size> m;
    for (int i = 0; i < D::size; ++i)
      for (int j = 0; j < D::size; ++j) m(i, j) = Real(std::sin(1 + 3 * i + 7 * j * j));
    Mat<Real, D::size> q = Eigen::HouseholderQR<Mat<Real, D::size>>(m).householderQ();
    if (q.determinant() < 0) q.col(0) = -q.col(0);
    return q;
  }

  // f.dx = -(E(x + h dx) - E(x - h dx)) / 2h
  void energyGradient(C& c, VecCoord const& x) {
    const double h = 1e-5;
    for (int trial = 0; trial < 3; ++trial) {
      const VecDeriv dx = sample::derivs<D>(n, random);
      const double slope =
          (c.potentialEnergy(moved(x, dx, h)) - c.potentialEnergy(moved(x, dx, -h))) / (2 * h);
      const VecDeriv f = force(c, x, zero);
      CHECK(vec::dot(f, dx) == Approx(-slope).margin(differences * norm(f) * norm(dx)));
    }
  }

  // K dx and B dx by differences of the force, in the position at v = 0 and in the velocity
  void tangent(C& c, VecCoord const& x, VecDeriv const& v) {
    const double h = 1e-5;
    const VecDeriv dx = sample::derivs<D>(n, random);
    VecDeriv slope = force(c, moved(x, dx, h), zero), minus = force(c, moved(x, dx, -h), zero);
    for (std::size_t i = 0; i < n; ++i) slope[i] = (slope[i] - minus[i]) / Real(2 * h);
    force(c, x, zero);
    const VecDeriv k = product(c, dx, 1, 0);
    CHECK(distance(k, slope) <= differences * (norm(slope) + norm(force(c, x, zero))));

    // damping that the user keeps out of implicit steps
    if constexpr (requires { c.implicit; })
      if (!c.implicit) return;
    VecDeriv faster = v, slower = v;
    vec::peq(faster, dx, Real(h));
    vec::peq(slower, dx, Real(-h));
    slope = force(c, x, faster), minus = force(c, x, slower);
    for (std::size_t i = 0; i < n; ++i) slope[i] = (slope[i] - minus[i]) / Real(2 * h);
    force(c, x, v);
    CHECK(distance(product(c, dx, 0, 1), slope) <= differences * (norm(slope) + norm(force(c, x, v))));
  }

  void symmetry(C& c, VecCoord const& x, VecDeriv const& v) {
    force(c, x, v);
    const VecDeriv u = sample::derivs<D>(n, random), w = sample::derivs<D>(n, random);
    const VecDeriv ku = product(c, u, 0.7, 0.3), kw = product(c, w, 0.7, 0.3);
    CHECK(vec::dot(w, ku) == Approx(vec::dot(u, kw)).margin(10 * rounding * norm(ku) * norm(w)));
  }

  void assembled(C& c, VecCoord const& x, VecDeriv const& v) {
    force(c, x, v);
    assembledWith<CompressedRowSparseMatrix<Real, 1>>(c);
    if constexpr (D::size > 1) assembledWith<CompressedRowSparseMatrix<Real, D::size>>(c);
  }
  template <class Matrix>
  void assembledWith(C& c) {
    Matrix matrix;
    const DirectDofs<D::size> dofs{0};
    MechanicalParams p = params;
    p.k = 0.7, p.b = 0.3;
    matrix.startPattern(int(n) * D::size);
    c.addToMatrix(p, MatrixSink<AssemblyPhase::pattern, Matrix, DirectDofs<D::size>>{matrix, dofs, dofs});
    matrix.finishPattern();
    c.addToMatrix(p, MatrixSink<AssemblyPhase::bind, Matrix, DirectDofs<D::size>>{matrix, dofs, dofs});
    matrix.setZero();
    c.addToMatrix(p, MatrixSink<AssemblyPhase::add, Matrix, DirectDofs<D::size>>{matrix, dofs, dofs});
    matrix.mirror();
    const VecDeriv dx = sample::derivs<D>(n, random), free = product(c, dx, 0.7, 0.3);
    Eigen::Matrix<Real, Eigen::Dynamic, 1> in(matrix.dofs() + 1), out(matrix.dofs());
    in << vec::flat(dx), Real(0);
    matrix.multiply(in.data(), out.data());
    CHECK(double((out - vec::flat(free)).norm()) <= 10 * rounding * (norm(free) + norm(dx)));
  }

  // forces inside a body sum to zero and turn nothing; moving it as a whole costs nothing
  void wholeMotion(C& c, ForceProperties claims, VecCoord const& x, VecDeriv const& v) {
    const VecDeriv f = force(c, x, v);
    typename D::Deriv sum = D::Deriv::Zero();
    for (auto const& fi : f) sum += fi;
    CHECK(double(sum.norm()) <= 10 * rounding * norm(f));
    if (!claims.objective) return;
    const VecDeriv g = force(c, turned(x), zero);
    if constexpr (!D::rigid) {
      VecDeriv still = force(c, x, zero);
      const auto q = rotation();
      for (auto& fi : still) fi = (q * fi).eval();
      CHECK(distance(g, still) <= 100 * rounding * (norm(g) + norm(still)));
      CHECK(c.potentialEnergy(turned(x)) == Approx(c.potentialEnergy(x)).epsilon(1000 * rounding));
      if (claims.conservative) {
        Mat<Real, D::size> moment = Mat<Real, D::size>::Zero();
        for (std::size_t i = 0; i < n; ++i) moment += x[i] * f[i].transpose();
        CHECK(double((moment - moment.transpose()).norm()) <= 1000 * rounding * norm(f));
      }
    }
  }

  void lanesAgree(C& c, VecCoord const& x, VecDeriv const& v) {
    auto scalar = scalar_driver(c.driver);
    typename decltype(scalar)::Law law{};
    if constexpr (requires { law.method = c.method; }) law.method = c.method;
    if constexpr (requires { c.template law<decltype(law)>(); }) law = c.template law<decltype(law)>();
    VecDeriv f = zero, df = zero;
    scalar.addForce(law, f, x, v);
    CHECK(distance(f, force(c, x, v)) <= 10 * rounding * norm(f));
    const VecDeriv dx = sample::derivs<D>(n, random);
    scalar.addDForce(law, df, dx, Real(0.7), Real(0.3));
    CHECK(distance(df, product(c, dx, 0.7, 0.3)) <= 10 * rounding * norm(df));
    CHECK(scalar.energy(law, x) == Approx(c.potentialEnergy(x)).epsilon(100 * rounding));
  }
};

/// Number of force fields over D in a registry.
template <class R, class D>
constexpr int count_force_fields() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::ForceField>)
      if constexpr (std::is_same_v<typename C::DataTypes, D>) ++found;
  });
  return found;
}

/// Runs the suite on every force field over D in a registry.
template <class R, class D>
void check_force_fields() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::ForceField>)
      if constexpr (std::is_same_v<typename C::DataTypes, D>) {
        ForceSuite<C>{}.run();
        ++found;
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
