// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "catch.hpp"
#include "sample.hpp"

#include <sinew/core/assembly.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include <array>

namespace laws {

using namespace sinew;
using sample::Random;

/// `Component`: what a sample is made of, M or a base of it.
template <class M, class Component = M>
struct MappingSuite {
  using In = typename M::In;
  using Out = typename M::Out;
  static constexpr bool isDouble = sizeof(typename In::Real) == 8 && sizeof(typename Out::Real) == 8;
  static constexpr double rounding = isDouble ? 1e-12 : 1e-5;

  Random random{20070102};
  sample::Body body{random};
  typename In::VecCoord parentRest = sample::positions<In>(body, random);

  void run() {
    INFO(component_name<M>());
    sample::for_each_variant<Component>(random, [&](Component const& sampled) {
      M mapping{};
      static_cast<Component&>(mapping) = sampled;
      typename Out::VecCoord child;
      for (std::size_t i = 0; i < sample::child_points(sampled); ++i)
        child.push_back(sample::coord<Out>(random, 1.5));
      const typename Out::VecCoord childRest = child;
      std::vector<double> masses;
      for (std::size_t i = 0; i < parentRest.size(); ++i) masses.push_back(random(0.5, 2));
      mapping.init(InitContext<In>{"parent", parentRest, body.topology(), masses},
                   InitContext<Out>{"child", childRest, {}},
                   child);
      typename In::VecCoord x = parentRest;
      vec::increment<In>(x, sample::derivs<In>(x.size(), random, 0.3), typename In::Real(1));
      mapping.apply(child, x);

      if constexpr (isDouble) jacobian(mapping, x, child);
      adjoint(mapping, x.size(), child.size());
      blocks(mapping, x.size(), child.size());
      if constexpr (HasGeometricStiffness<M>) geometricStiffness(mapping, x, child);
    });
  }

  // J v by differences of apply over 2e-5: truncation 1e-10, rounding 1e-11
  void jacobian(M& mapping, typename In::VecCoord const& x, typename Out::VecCoord const& at) {
    const double h = 1e-5;
    const auto v = sample::derivs<In>(x.size(), random);
    typename In::VecCoord forward = x, backward = x;
    vec::increment<In>(forward, v, h);
    vec::increment<In>(backward, v, -h);
    typename Out::VecCoord plus = at, minus = at, again = at;
    mapping.apply(plus, forward);
    mapping.apply(minus, backward);
    mapping.apply(again, x);
    typename Out::VecDeriv jv(at.size());
    mapping.applyJ(jv, v);
    for (std::size_t i = 0; i < at.size(); ++i)
      CHECK((Out::difference(minus[i], plus[i]) / (2 * h) - jv[i]).norm() <= 1e-7 * (1 + jv[i].norm()));
  }

  // virtual work: <J u, w> = <u, J' w>
  void adjoint(M& mapping, std::size_t parents, std::size_t children) {
    const auto u = sample::derivs<In>(parents, random);
    const auto w = sample::derivs<Out>(children, random);
    typename Out::VecDeriv ju(children);
    typename In::VecDeriv jtw(parents, In::Deriv::Zero());
    mapping.applyJ(ju, u);
    mapping.applyJT(jtw, w);
    CHECK(vec::dot(ju, w) ==
          Approx(vec::dot(u, jtw)).margin(rounding * double(vec::flat(ju).norm() * vec::flat(w).norm())));
  }

  // the blocks that go into assembled matrices are those of J
  void blocks(M& mapping, std::size_t parents, std::size_t children) {
    const auto u = sample::derivs<In>(parents, random);
    typename Out::VecDeriv ju(children);
    mapping.applyJ(ju, u);
    for (std::size_t i = 0; i < children; ++i) {
      typename Out::Deriv sum = Out::Deriv::Zero();
      mapping.forEachJacobianBlock(int(i), [&](int above, auto const& block) {
        sum += block * u[std::size_t(above)].template cast<typename Out::Real>();
      });
      CHECK(double((sum - ju[i]).norm()) <= rounding * (1 + double(ju[i].norm())));
    }
  }

  static typename In::VecDeriv product(M const& mapping, typename In::VecDeriv const& dx, double k) {
    typename In::VecDeriv df(dx.size(), In::Deriv::Zero());
    mapping.addKx(df, dx, k);
    return df;
  }

  // K_g is symmetric, the same assembled, and the derivative of J' f; where it is not all of that, what its
  // option says
  void geometricStiffness(M& mapping, typename In::VecCoord const& x, typename Out::VecCoord const& at) {
    const auto f = sample::derivs<Out>(at.size(), random);
    mapping.updateK(f);
    const auto u = sample::derivs<In>(x.size(), random), w = sample::derivs<In>(x.size(), random);
    const auto ku = product(mapping, u, 1), kw = product(mapping, w, 1);
    const double size = double(vec::flat(ku).norm() * vec::flat(w).norm());
    CHECK(vec::dot(ku, w) == Approx(vec::dot(u, kw)).margin(rounding * (1 + size)));
    using Option = decltype(mapping.geometricStiffness);
    if (mapping.geometricStiffness == Option::none) {
      CHECK(size == 0);
      return;
    }
    CHECK(size > 0.1);
    assembled(mapping, u);

    if constexpr (std::is_same_v<Option, GeometricStiffness>)
      if (sample::stabilizes(mapping) && mapping.geometricStiffness == GeometricStiffness::stabilized)
        CHECK(vec::dot(ku, u) < 0);  // of what pulls alone
    if constexpr (isDouble) {
      typename In::VecDeriv du = derivative(mapping, x, at, f, u), dw = derivative(mapping, x, at, f, w);
      // differences over 2e-5: truncation 1e-10, rounding 1e-11
      if constexpr (std::is_same_v<Option, GeometricStiffness>) {
        if (mapping.geometricStiffness != Option::exact) return;
        CHECK(double((vec::flat(du) - vec::flat(ku)).norm()) <= 1e-7 * (1 + double(vec::flat(ku).norm())));
      }
      CHECK((vec::dot(du, w) + vec::dot(u, dw)) / 2 == Approx(vec::dot(ku, w)).margin(1e-7 * (1 + size)));
    }
  }
  // d/dh J(x + h u)' f
  static typename In::VecDeriv derivative(M mapping, typename In::VecCoord const& x,
                                          typename Out::VecCoord at, typename Out::VecDeriv const& f,
                                          typename In::VecDeriv const& u) {
    const double h = 1e-5;
    typename In::VecDeriv sum(x.size(), In::Deriv::Zero());
    for (const double sign : {1.0, -1.0}) {
      typename In::VecCoord moved = x;
      vec::increment<In>(moved, u, sign * h);
      mapping.apply(at, moved);
      typename In::VecDeriv force(x.size(), In::Deriv::Zero());
      mapping.applyJT(force, f);
      vec::peq(sum, force, sign / (2 * h));
    }
    return sum;
  }
  void assembled(M& mapping, typename In::VecDeriv const& u) {
    using Real = typename In::Real;
    using Matrix = CompressedRowSparseMatrix<Real, In::size>;
    const DirectDofs<In::size> dofs{0};
    MechanicalParams p;
    p.k = -2.5;
    Matrix a;
    a.startPattern(int(u.size()) * In::size);
    mapping.addToMatrix(p, MatrixSink<AssemblyPhase::pattern, Matrix, DirectDofs<In::size>>{a, dofs, dofs});
    a.finishPattern();
    mapping.addToMatrix(p, MatrixSink<AssemblyPhase::add, Matrix, DirectDofs<In::size>>{a, dofs, dofs});
    typename In::VecDeriv in = u, out(u.size() + 1, In::Deriv::Zero());
    in.push_back(In::Deriv::Zero());  // multiply reads behind it
    a.multiply(in[0].data(), out[0].data());
    out.pop_back();
    const auto expected = product(mapping, u, p.k);
    CHECK(double((vec::flat(out) - vec::flat(expected)).norm()) <=
          10 * rounding * (1 + double(vec::flat(expected).norm())));
  }
};

/// What of a joint mapping is the same whatever its parents are: the suite sees one parent, whose points are
/// those of all parents one behind the other, and `Self` says where they are (forEachPart).
template <class Self, class M, class One>
struct OfOneParent : M {
  using In = One;
  using Out = typename M::Out;

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    self().forEachPart([&](auto& part, auto const& cut) { part.apply(out, cut.coords(in)); });
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) {
    self().forEachPart([&](auto& part, auto const& cut) { part.applyJ(out, cut.derivs(in)); });
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) {
    self().forEachPart([&](auto& part, auto const& cut) {
      auto own = cut.derivs(in);
      part.applyJT(own, out);
      cut.giveBack(in, own);
    });
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    const_cast<OfOneParent*>(this)->self().forEachPart([&](auto& part, auto const& cut) {
      part.forEachJacobianBlock(point,
                                [&](int above, auto const& j) { f(cut.first + above, cut.widened(j)); });
    });
  }
  void updateK(typename Out::VecDeriv const& f)
  requires(GathersParents<PartOf<M>>)
  {
    self().forEachPart([&](auto& part, auto const&) { part.updateK(f); });
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const
  requires(GathersParents<PartOf<M>>)
  {
    auto& own = const_cast<OfOneParent*>(this)->self();
    own.forEachPart([&](auto& part, auto const& cut) { part.gather(cut.derivs(dx)); });
    own.forEachPart([&](auto& part, auto const& cut) {
      auto sum = cut.derivs(df);
      part.addKx(sum, cut.derivs(dx), k);
      cut.giveBack(df, sum);
    });
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    auto& own = const_cast<OfOneParent*>(this)->self();
    M const& mapping = *this;
    std::size_t a = 0;
    own.forEachPart([&](auto&, auto const& rows) {
      std::size_t b = 0;
      own.forEachPart([&](auto&, auto const& columns) {
        using Block = Between<Sink, std::decay_t<decltype(rows)>, std::decay_t<decltype(columns)>>;
        mapping.addToMatrix(p, a, b, Block{sink, rows, columns});
        ++b;
      });
      ++a;
    });
  }

 private:
  Self& self() { return static_cast<Self&>(*this); }
  template <class Sink, class Rows, class Columns>
  struct Between {
    Sink const& sink;
    Rows const& rows;
    Columns const& columns;
    template <int, int, class K>
    void add(int i, int j, K const& k) const {
      Mat<typename In::Real, In::size> block = Mat<typename In::Real, In::size>::Zero();
      block.template topLeftCorner<K::RowsAtCompileTime, K::ColsAtCompileTime>() = k;
      sink.add(rows.first + i, columns.first + j, block);
    }
  };
};

/// The points of one parent among those of all; over D, where those of all are over In, or their centres, or
/// first coordinates of these, are these points.
template <class In, class D>
struct Cut {
  int first, count;

  typename D::VecCoord coords(typename In::VecCoord const& all) const {
    typename D::VecCoord own;
    for (int i = first; i < first + count; ++i)
      if constexpr (std::is_same_v<In, D>)
        own.push_back(all[std::size_t(i)]);
      else
        own.push_back(In::center(all[std::size_t(i)]).template head<D::size>());
    return own;
  }
  typename D::VecDeriv derivs(typename In::VecDeriv const& all) const {
    typename D::VecDeriv own;
    for (int i = first; i < first + count; ++i) own.push_back(all[std::size_t(i)].template head<D::size>());
    return own;
  }
  void giveBack(typename In::VecDeriv& all, typename D::VecDeriv const& own) const {
    for (int i = 0; i < count; ++i)
      all[std::size_t(first + i)].template head<D::size>() = own[std::size_t(i)];
  }
  template <class J>
  Mat<typename J::Scalar, J::RowsAtCompileTime, In::size> widened(J const& j) const {
    using Wide = Mat<typename J::Scalar, J::RowsAtCompileTime, In::size>;
    Wide wide = Wide::Zero();
    wide.template leftCols<D::size>() = j;
    return wide;
  }
};

/// A mapping with several parents, three of them.
template <class M>
struct Joined : OfOneParent<Joined<M>, M, typename M::In> {
  using One = typename M::In;
  int each = 0;

  void init(InitContext<One> const& parent, InitContext<typename M::Out> const& child,
            typename M::Out::VecCoord& positions) {
    each = int(parent.rest.size()) / 3;
    std::vector<typename One::VecCoord> rest;
    std::vector<InitContext<One>> contexts;
    for (int k = 0; k < 3; ++k) rest.push_back(Cut<One, One>{k * each, each}.coords(parent.rest));
    for (auto const& own : rest) contexts.push_back({"parent", own, {}});
    M::init(contexts, context(child), positions);
  }
  template <class F>
  void forEachPart(F&& f) {
    for (int k = 0; k < 3; ++k) {
      auto&& part = this->part(std::size_t(k));
      f(part, Cut<One, One>{k * each, each});
    }
  }

 private:
  static auto context(InitContext<typename M::Out> child) {
    if constexpr (over_entries<M>) child.topology.edges = sample_edges;
    return child;
  }
  static constexpr std::array<Edge, 6> sample_edges{Edge{0, 1}, {1, 2}, {0, 3}, {4, 1}, {5, 6}, {2, 6}};
};

/// One with a parent over points, of which 18 are the centres, and one over rigid bodies.
template <class M>
struct JoinedKinds : OfOneParent<JoinedKinds<M>, M, typename M::In2> {
  using One = typename M::In2;
  static constexpr int points = 18;
  int bodies = 0;

  void init(InitContext<One> const& parent, InitContext<typename M::Out> const& child,
            typename M::Out::VecCoord& positions) {
    bodies = int(parent.rest.size()) - points;
    const auto first = Cut<One, typename M::In>{0, points}.coords(parent.rest);
    const auto second = Cut<One, One>{points, bodies}.coords(parent.rest);
    M::init({"points", first, {}}, {"frames", second, {}}, child, positions);
  }
  template <class F>
  void forEachPart(F&& f) {
    auto ofPoints = this->part(ParentNumber<0>{});
    f(ofPoints, Cut<One, typename M::In>{0, points});
    auto ofBodies = this->part(ParentNumber<1>{});
    f(ofBodies, Cut<One, One>{points, bodies});
  }
};

/// Runs the suite on every mapping in a registry from points, or from rigid bodies.
template <class R, bool Rigid>
void check_mappings() {
  int found = 0;
  for_each_registered<R>([&]<class C>() {
    if constexpr (HasRole<C, role::Mapping> && !MakesFaces<C>)  // a surface has no velocities
      if constexpr (C::In::rigid == Rigid) {
        ++found;
        if constexpr (HasTwoKindsOfParents<C>)
          MappingSuite<JoinedKinds<C>, C>{}.run();
        else if constexpr (HasParents<C>)
          MappingSuite<Joined<C>, C>{}.run();
        else
          MappingSuite<C>{}.run();
      }
  });
  CHECK(found > 0);
}

}  // namespace laws
