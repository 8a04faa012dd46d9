// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <sinew/core/assembly.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <memory>

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

/// What the suite asks of a force field over D, so that the suite is compiled once for all of them.
template <class D>
struct Subject {
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Scalars = CompressedRowSparseMatrix<typename D::Real, 1>;
  using Blocks = CompressedRowSparseMatrix<typename D::Real, D::size>;

  virtual ~Subject() = default;
  virtual void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) = 0;
  virtual void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) = 0;
  virtual double energy(VecCoord const& x) = 0;
};

/// A force field over D as it is.
template <class D>
struct FieldSubject : Subject<D> {
  ForceProperties claims{};
  bool implicitDamping = true;  // whether addDForce has the damping too

  virtual void assemble(MechanicalParams const& p, std::size_t points,
                        typename Subject<D>::Scalars& matrix) = 0;
  virtual void assembleBlocks(MechanicalParams const& p, std::size_t points,
                              typename Subject<D>::Blocks& matrix) = 0;
  virtual std::unique_ptr<Subject<D>> oneLane() = 0;  // null where there are no lanes
};

template <class C, class D = typename C::DataTypes>
struct SubjectOf : FieldSubject<D> {
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  C c;

  SubjectOf(C component, InitContext<D> const& context) : c(std::move(component)) {
    check_fields(c, "sample");
    c.init(context);
    this->claims = properties_of(c);
    if constexpr (requires { c.implicit; }) this->implicitDamping = c.implicit;
  }
  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) override {
    add_force(c, p, f, x, v);
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) override {
    add_dforce(c, p, df, dx);
  }
  double energy(VecCoord const& x) override { return potential_energy(c, x); }
  void assemble(MechanicalParams const& p, std::size_t points,
                typename Subject<D>::Scalars& matrix) override {
    assembleInto(p, points, matrix);
  }
  void assembleBlocks(MechanicalParams const& p, std::size_t points,
                      typename Subject<D>::Blocks& matrix) override {
    assembleInto(p, points, matrix);
  }
  std::unique_ptr<Subject<D>> oneLane() override {
    if constexpr (requires { c.driver; })
      return std::make_unique<OneLane>(c);
    else
      return nullptr;
  }

 private:
  template <class Matrix>
  void assembleInto(MechanicalParams const& p, std::size_t points, Matrix& matrix) {
    using Dofs = DirectDofs<D::size>;
    const Dofs dofs{0};
    matrix.startPattern(int(points) * D::size);
    add_to_matrix(c, p, MatrixSink<AssemblyPhase::pattern, Matrix, Dofs>{matrix, dofs, dofs});
    matrix.finishPattern();
    add_to_matrix(c, p, MatrixSink<AssemblyPhase::bind, Matrix, Dofs>{matrix, dofs, dofs});
    matrix.setZero();
    add_to_matrix(c, p, MatrixSink<AssemblyPhase::add, Matrix, Dofs>{matrix, dofs, dofs});
  }

  struct OneLane : Subject<D> {
    decltype(scalar_driver(std::declval<C&>().driver)) driver;
    typename decltype(driver)::Law law{};

    explicit OneLane(C& c) : driver(scalar_driver(c.driver)) {
      if constexpr (requires { law.method = c.method; }) law.method = c.method;
      if constexpr (requires { c.template law<decltype(law)>(); }) law = c.template law<decltype(law)>();
    }
    void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) override {
      driver.addForce(law, f, x, v);
    }
    void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) override {
      using Real = typename D::Real;
      driver.addDForce(law, df, dx, Real(p.k), Real(p.b));
    }
    double energy(VecCoord const& x) override { return driver.energy(law, x); }
  };
};

template <class D>
struct ForceSuite {
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

  template <class C>
  std::span<Eigen::Vector3d const> bodyOf() const {
    if constexpr (over_body<C>)
      return body.points;
    else
      return {};
  }
  // elements of second order where it is over these
  template <class C>
  TopologyView elementsOf() const {
    if constexpr (requires { requires(C::Driver::arity > 8); })
      return body.whole();
    else
      return body.topology();
  }
  template <class C>
  void run() {
    sample::for_each_variant<C>(random, [&](C const& sampled) {
      INFO(component_name<C>());
      C own = sampled;
      sample::rest_at(own, rest, body);
      SubjectOf<C> subject(own, InitContext<D>{"sample", rest, elementsOf<C>(), {}, bodyOf<C>()});
      check(subject);
    });
  }
  void check(FieldSubject<D>& c) {
    VecCoord x = rest;
    VecDeriv shake = sample::derivs<D>(n, random, 0.1), v = sample::derivs<D>(n, random);
    vec::increment<D>(x, shake, Real(1));
    REQUIRE(norm(force(c, x, v)) > 1e-3);  // the sample is not empty

    if constexpr (isDouble) {
      if (c.claims.conservative) energyGradient(c, x);
      if (c.claims.implicit)
        tangent(c, c.claims.exactTangent ? x : D::rigid && !c.claims.objective ? rest : turned(rest), v);
    }
    if (!c.claims.implicit) CHECK(norm(product(c, shake, -1, -1)) == 0);
    symmetry(c, x, v);
    assembled(c, x, v);
    if (c.claims.internal) wholeMotion(c, x, v);
    if (auto const scalar = c.oneLane()) lanesAgree(c, *scalar, x, v);
  }

  VecDeriv force(Subject<D>& c, VecCoord const& x, VecDeriv const& v) const {
    VecDeriv f = zero;
    c.addForce(params, f, x, v);
    return f;
  }
  VecDeriv product(Subject<D>& c, VecDeriv const& dx, double k, double b) const {
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
      if constexpr (D::spatial == 3)
        for (auto& p : x)
          p = {wholeTurn * p.center + Vec<Real, 3>::Constant(Real(0.5)), wholeTurn * p.orientation};
      return x;
    } else {
      const auto q = rotation();
      for (auto& p : x) p = q * p + D::Deriv::Constant(Real(0.5));
      return x;
    }
  }
  // of rigid bodies in space
  const Quat<Real> wholeTurn = Quat<Real>(Real(0.4), Real(-0.3), Real(0.6), Real(0.5)).normalized();
  // a turn in each of the planes of two axes that follow one another
  Mat<Real, D::size> rotation() const {
    Mat<Real, D::size> q = Mat<Real, D::size>::Identity();
    for (int i = 0; i + 1 < D::size; ++i) {
      const Real c = Real(std::cos(1.1 + i)), s = Real(std::sin(1.1 + i));
      const typename D::Deriv a = q.row(i), b = q.row(i + 1);
      q.row(i) = c * a - s * b;
      q.row(i + 1) = s * a + c * b;
    }
    return q;
  }

  // f.dx = -(E(x + h dx) - E(x - h dx)) / 2h
  void energyGradient(Subject<D>& c, VecCoord const& x) {
    const double h = 1e-5;
    for (int trial = 0; trial < 3; ++trial) {
      const VecDeriv dx = sample::derivs<D>(n, random);
      const double slope = (c.energy(moved(x, dx, h)) - c.energy(moved(x, dx, -h))) / (2 * h);
      const VecDeriv f = force(c, x, zero);
      CHECK(vec::dot(f, dx) == Approx(-slope).margin(differences * norm(f) * norm(dx)));
    }
  }

  // K dx and B dx by differences of the force, in the position at v = 0 and in the velocity
  void tangent(FieldSubject<D>& c, VecCoord const& x, VecDeriv const& v) {
    const double h = 1e-5;
    const VecDeriv dx = sample::derivs<D>(n, random);
    VecDeriv slope = force(c, moved(x, dx, h), zero), minus = force(c, moved(x, dx, -h), zero);
    for (std::size_t i = 0; i < n; ++i) slope[i] = (slope[i] - minus[i]) / Real(2 * h);
    force(c, x, zero);
    const VecDeriv k = product(c, dx, 1, 0);
    CHECK(distance(k, slope) <= differences * (norm(slope) + norm(force(c, x, zero))));

    // damping that the user keeps out of implicit steps
    if (!c.implicitDamping) return;
    VecDeriv faster = v, slower = v;
    vec::peq(faster, dx, Real(h));
    vec::peq(slower, dx, Real(-h));
    slope = force(c, x, faster), minus = force(c, x, slower);
    for (std::size_t i = 0; i < n; ++i) slope[i] = (slope[i] - minus[i]) / Real(2 * h);
    force(c, x, v);
    CHECK(distance(product(c, dx, 0, 1), slope) <= differences * (norm(slope) + norm(force(c, x, v))));
  }

  void symmetry(Subject<D>& c, VecCoord const& x, VecDeriv const& v) {
    force(c, x, v);
    const VecDeriv u = sample::derivs<D>(n, random), w = sample::derivs<D>(n, random);
    const VecDeriv ku = product(c, u, 0.7, 0.3), kw = product(c, w, 0.7, 0.3);
    CHECK(vec::dot(w, ku) == Approx(vec::dot(u, kw)).margin(10 * rounding * norm(ku) * norm(w)));
  }

  void assembled(FieldSubject<D>& c, VecCoord const& x, VecDeriv const& v) {
    force(c, x, v);
    MechanicalParams p = params;
    p.k = 0.7, p.b = 0.3;
    typename Subject<D>::Scalars scalars;
    c.assemble(p, n, scalars);
    productsAgree(c, scalars);
    typename Subject<D>::Blocks blocks;
    c.assembleBlocks(p, n, blocks);
    productsAgree(c, blocks);
  }
  template <class Matrix>
  void productsAgree(FieldSubject<D>& c, Matrix& matrix) {
    const VecDeriv dx = sample::derivs<D>(n, random),
                   free = c.claims.inMatrix ? product(c, dx, 0.7, 0.3) : zero;
    VecDeriv in = dx, out = zero;
    in.push_back(D::Deriv::Zero());  // multiply reads behind its end
    matrix.multiply(in[0].data(), out[0].data());
    CHECK(distance(out, free) <= 10 * rounding * (norm(free) + norm(dx)));
  }

  // forces inside a body sum to zero and turn nothing; moving it as a whole costs nothing
  void wholeMotion(FieldSubject<D>& c, VecCoord const& x, VecDeriv const& v) {
    const VecDeriv f = force(c, x, v);
    Vec<Real, D::rigid ? D::spatial : D::size> sum = sum.Zero();
    for (auto const& fi : f) sum += fi.template head<sum.RowsAtCompileTime>();
    CHECK(double(sum.norm()) <= 10 * rounding * norm(f));
    if (!c.claims.objective) return;
    const VecDeriv g = force(c, turned(x), zero);
    if constexpr (D::rigid && D::spatial == 3) {
      const Mat<Real, 3> q = wholeTurn.toRotationMatrix();
      Vec<Real, 3> moment = moment.Zero();
      VecDeriv still = force(c, x, zero);
      for (std::size_t i = 0; i < n; ++i) {
        moment += still[i].template tail<3>() + x[i].center.cross(still[i].template head<3>());
        still[i].template head<3>() = (q * still[i].template head<3>()).eval();
        still[i].template tail<3>() = (q * still[i].template tail<3>()).eval();
      }
      CHECK(distance(g, still) <= 100 * rounding * (norm(g) + norm(still)));
      CHECK(c.energy(turned(x)) == Approx(c.energy(x)).epsilon(1000 * rounding));
      if (c.claims.conservative) CHECK(double(moment.norm()) <= 1000 * rounding * norm(f));
    }
    if constexpr (!D::rigid) {
      VecDeriv still = force(c, x, zero);
      const auto q = rotation();
      for (auto& fi : still) fi = (q * fi).eval();
      CHECK(distance(g, still) <= 100 * rounding * (norm(g) + norm(still)));
      CHECK(c.energy(turned(x)) == Approx(c.energy(x)).epsilon(1000 * rounding));
      if (c.claims.conservative) {
        Mat<Real, D::size> moment = Mat<Real, D::size>::Zero();
        for (std::size_t i = 0; i < n; ++i) moment += x[i] * f[i].transpose();
        CHECK(double((moment - moment.transpose()).norm()) <= 1000 * rounding * norm(f));
      }
    }
  }

  void lanesAgree(Subject<D>& c, Subject<D>& scalar, VecCoord const& x, VecDeriv const& v) {
    const VecDeriv f = force(scalar, x, v);
    CHECK(distance(f, force(c, x, v)) <= 10 * rounding * norm(f));
    const VecDeriv dx = sample::derivs<D>(n, random), df = product(scalar, dx, 0.7, 0.3);
    CHECK(distance(df, product(c, dx, 0.7, 0.3)) <= 10 * rounding * norm(df));
    CHECK(scalar.energy(x) == Approx(c.energy(x)).epsilon(100 * rounding));
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
        ForceSuite<D>{}.template run<C>();
        ++found;
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
