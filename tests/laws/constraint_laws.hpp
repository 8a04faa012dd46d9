// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <sinew/core/assembly.hpp>
#include <sinew/linalg/block_matrix.hpp>

namespace laws {

using namespace sinew;
using sample::Random;

/// What the suite asks of a constraint over D, so that the suite is compiled once for all of them.
template <class D>
struct Subject {
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  template <int B>
  using Matrix = CompressedRowSparseMatrix<typename D::Real, B>;
  bool prescribes = false;  // positions and velocities
  bool follows = false;     // one point has the velocity of another

  virtual ~Subject() = default;
  virtual void projectResponse(VecDeriv& dx) const = 0;
  virtual void preallocate(Matrix<1>& matrix) = 0;
  virtual void preallocateBlocksOfThree(Matrix<3>& matrix) = 0;
  virtual void preallocateBlocks(Matrix<D::size>& matrix) = 0;
  virtual void projectMatrix(Matrix<1>& matrix) = 0;
  virtual void projectBlocksOfThree(Matrix<3>& matrix) = 0;
  virtual void projectBlocks(Matrix<D::size>& matrix) = 0;
  virtual void projectPosition(double time, VecCoord& x) = 0;
  virtual void projectVelocity(double time, VecDeriv& v) = 0;
};

/// One between two states is looked at as one over both, the second behind the first.
template <class C, class D = typename C::DataTypes>
struct SubjectOf : Subject<D> {
  using typename Subject<D>::VecCoord;
  using typename Subject<D>::VecDeriv;
  C c;

  SubjectOf(C component, InitContext<D> const& context) : c(std::move(component)) {
    check_fields(c, "sample");
    if constexpr (JoinsTwo<C>)
      c.init(context, context);
    else
      c.init(context);
    apply(VecCoord(2 * context.rest.size(), D::zero()),
          [&](auto&... x) { this->prescribes = requires { c.projectPosition(0.0, x...); }; });
    this->follows = requires { c.twoWay; };
  }
  // f(vector), or f(first half, second half)
  template <class V, class F>
  static V apply(V all, F&& f) {
    if constexpr (JoinsTwo<C>) {
      const auto half = all.begin() + std::ptrdiff_t(all.size() / 2);
      V a(all.begin(), half), b(half, all.end());
      f(a, b);
      a.insert(a.end(), b.begin(), b.end());
      return a;
    } else {
      f(all);
      return all;
    }
  }
  void projectResponse(VecDeriv& dx) const override {
    dx = apply(dx, [&](auto&... d) { c.projectResponse(d...); });
  }
  void preallocate(CompressedRowSparseMatrix<typename D::Real, 1>& matrix) override { room(matrix); }
  void preallocateBlocksOfThree(CompressedRowSparseMatrix<typename D::Real, 3>& matrix) override {
    room(matrix);
  }
  void preallocateBlocks(CompressedRowSparseMatrix<typename D::Real, D::size>& matrix) override {
    room(matrix);
  }
  void projectMatrix(CompressedRowSparseMatrix<typename D::Real, 1>& matrix) override { project(matrix); }
  void projectBlocksOfThree(CompressedRowSparseMatrix<typename D::Real, 3>& matrix) override {
    project(matrix);
  }
  void projectBlocks(CompressedRowSparseMatrix<typename D::Real, D::size>& matrix) override {
    project(matrix);
  }
  void projectPosition(double time, VecCoord& x) override {
    x = apply(x, [&](auto&... p) {
      if constexpr (requires { c.projectPosition(time, p...); }) c.projectPosition(time, p...);
    });
  }
  void projectVelocity(double time, VecDeriv& v) override {
    v = apply(v, [&](auto&... d) {
      if constexpr (requires { c.projectVelocity(time, d...); }) c.projectVelocity(time, d...);
    });
  }

 private:
  using Dofs = DirectDofs<D::size>;
  static constexpr Dofs first{0}, second{JoinsTwo<C> ? sample::Body::n * D::size : 0};

  template <class Matrix>
  void room(Matrix& matrix) {
    const MatrixSink<AssemblyPhase::pattern, Matrix, Dofs> sink{matrix, first, second};
    if constexpr (requires { c.preallocate(sink); }) c.preallocate(sink);
  }
  template <class Matrix>
  void project(Matrix& matrix) {
    c.projectMatrix(MatrixSink<AssemblyPhase::pattern, Matrix, Dofs>{matrix, first, second});  // does nothing
    c.projectMatrix(MatrixSink<AssemblyPhase::add, Matrix, Dofs>{matrix, first, second});
  }
};

template <class D>
struct ConstraintSuite {
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr double rounding = sizeof(Real) == 8 ? 1e-12 : 1e-5;
  static constexpr double time = 0.7;  // between two key times

  Random random{20070103};
  sample::Body body{random};
  VecCoord rest = sample::positions<D>(body, random);
  std::vector<Tetrahedron> elements = body.tetrahedra;
  std::size_t n = rest.size();

  template <class C>
  void run() {
    INFO(component_name<C>());
    if (!sample::has_laws(C{})) return;
    const VecCoord own = rest;
    std::vector<double> masses;
    for (std::size_t i = 0; i < n; ++i) masses.push_back(random(0.5, 2));
    if constexpr (JoinsTwo<C>) {  // a second body
      for (auto const& x : own) rest.push_back(x);
      vec::increment<D>(rest, sample::derivs<D>(2 * n, random, 0.2), Real(1));
      for (auto t : body.tetrahedra) {
        for (int& i : t) i += int(n);
        elements.push_back(t);
      }
      n = rest.size();
    }
    sample::for_each_variant<C>(random, [&](C const& sampled) {
      SubjectOf<C> subject(sampled, InitContext<D>{"sample", own, body.topology(), masses});
      check(subject);
    });
  }
  void check(Subject<D>& c) {
    if (c.prescribes) prescribed(c);
    projector(c);
    projectedMatrix<1>(
        c, [&](auto& a) { c.preallocate(a); }, [&](auto& a) { c.projectMatrix(a); });
    projectedMatrix<3>(
        c, [&](auto& a) { c.preallocateBlocksOfThree(a); }, [&](auto& a) { c.projectBlocksOfThree(a); });
    projectedMatrix<D::size>(
        c, [&](auto& a) { c.preallocateBlocks(a); }, [&](auto& a) { c.projectBlocks(a); });
  }

  static double distance(VecDeriv const& a, VecDeriv const& b) {
    return double((vec::flat(a) - vec::flat(b)).norm());
  }
  static VecDeriv projected(Subject<D> const& c, VecDeriv dx) {
    c.projectResponse(dx);
    return dx;
  }
  // what the constraint takes away
  static VecDeriv rejected(Subject<D> const& c, VecDeriv dx) {
    const VecDeriv kept = projected(c, dx);
    vec::peq(dx, kept, Real(-1));
    return dx;
  }

  // P P = P = P', and something is held
  void projector(Subject<D> const& c) {
    const VecDeriv u = sample::derivs<D>(n, random), w = sample::derivs<D>(n, random), pu = projected(c, u);
    CHECK(distance(projected(c, pu), pu) <= rounding);
    CHECK(vec::dot(pu, w) == Approx(vec::dot(u, projected(c, w))).margin(10 * rounding));
    CHECK(distance(pu, u) > 0.1);
  }

  // the assembled P A P + I - P against products one after the other
  template <int B, class Room, class F>
  void projectedMatrix(Subject<D> const& c, Room&& preallocate, F&& project) {
    constexpr int size = D::size;
    using Matrix = CompressedRowSparseMatrix<Real, B>;
    Matrix a;
    a.startPattern(int(n) * size);
    for (auto const& t : elements)
      for (const int i : t)
        for (const int j : t) a.preallocate(i * size, j * size, size, size);
    preallocate(a);
    a.finishPattern();
    for (auto const& t : elements)
      for (const int i : t)
        for (const int j : t)
          if (i <= j) {
            Mat<Real, size> k;
            for (int r = 0; r < size * size; ++r) k(r) = Real(random());
            if (i == j) k = (k * k.transpose()).eval();
            a.add(i * size, j * size, k);
            if (i != j) a.add(j * size, i * size, k.transpose().eval());
          }
    auto times = [&](VecDeriv const& x) {
      VecDeriv in = x, out(n + 3, D::Deriv::Zero());
      in.resize(n + 3, D::Deriv::Zero());  // the last block may be filled up, and multiply reads behind it
      a.multiply(in[0].data(), out[0].data());
      out.resize(n);
      return out;
    };
    const VecDeriv u = sample::derivs<D>(n, random);
    VecDeriv expected = projected(c, times(projected(c, u)));
    vec::peq(expected, rejected(c, u), Real(1));
    project(a);
    CHECK(distance(times(u), expected) <= 10 * rounding * double(vec::flat(expected).norm()));
  }

  // positions and velocities that are given stay so when given again, and the velocity is that of the
  // positions
  void prescribed(Subject<D>& c) {
    VecCoord moved = rest;
    vec::increment<D>(moved, sample::derivs<D>(n, random, 0.1), Real(1));
    auto at = [&](double t, VecCoord x) {
      c.projectPosition(t, x);
      return x;
    };
    auto difference = [&](VecCoord const& a, VecCoord const& b) {
      VecDeriv d(n);
      for (std::size_t i = 0; i < n; ++i) d[i] = D::difference(a[i], b[i]);
      return d;
    };
    VecDeriv v = sample::derivs<D>(n, random);
    const VecCoord x = at(time, moved);
    CHECK(double(vec::flat(difference(x, at(time, x))).norm()) <= 10 * rounding);
    CHECK(double(vec::flat(difference(x, moved)).norm()) > 1e-3);
    c.projectVelocity(time, v);
    VecDeriv again = v;
    c.projectVelocity(time, again);
    CHECK(distance(v, again) <= 10 * rounding);
    if constexpr (sizeof(Real) == 8) {
      if (c.follows) return;
      // differences over 2e-5 of movements of order 1: truncation 1e-10, rounding 1e-11
      const double h = 1e-5;
      VecDeriv rate = difference(at(time - h, moved), at(time + h, moved));
      vec::flat(rate) /= 2 * h;
      CHECK(distance(rejected(c, v), rejected(c, rate)) <= 1e-8 * (1 + double(vec::flat(rate).norm())));
    }
  }
};

/// Runs the suite on every projective constraint over D in a registry.
template <class R, class D>
void check_constraints() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::ProjectiveConstraint>)
      if constexpr (std::is_same_v<typename C::DataTypes, D>) {
        ConstraintSuite<D>{}.template run<C>();
        ++found;
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
