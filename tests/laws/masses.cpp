// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "sample.hpp"

using namespace sinew;
using sample::Random;

namespace {

/// What the laws ask of a mass over D, so that they are compiled once for all of them.
template <class D>
struct Subject {
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Matrix = CompressedRowSparseMatrix<typename D::Real, 1>;
  bool exactInverse = true;  // of the mass, or of its row sums
  bool rowSums = true;       // else of masses at points

  virtual ~Subject() = default;
  virtual void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) = 0;
  virtual void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx) = 0;
  virtual void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) = 0;
  virtual double kineticEnergy(VecCoord const& x, VecDeriv const& v) = 0;
  virtual void assemble(VecCoord const& x, Matrix& matrix) = 0;
};

template <class C, class D = typename C::DataTypes>
struct SubjectOf : Subject<D> {
  using typename Subject<D>::VecCoord;
  using typename Subject<D>::VecDeriv;
  using typename Subject<D>::Matrix;
  C mass{};

  SubjectOf(InitContext<D> const& context, Random& random) {
    sample::give_masses(mass, context.rest.size(), random);
    mass.init(context);
    if constexpr (requires { mass.exactInverse(); }) this->exactInverse = mass.exactInverse();
    this->rowSums = sample::has_row_sums(mass);
  }
  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) override {
    mass.addForce(p, f, x, v);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx) override { mass.addMDx(f, x, dx, 1.0); }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) override { mass.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) override { return mass.kineticEnergy(x, v); }
  void assemble(VecCoord const& x, Matrix& matrix) override {
    using Dofs = DirectDofs<D::size>;
    const Dofs dofs{0};
    const MechanicalParams p{.m = 1};
    matrix.startPattern(int(x.size()) * D::size);
    mass.addToMatrix(p, x, MatrixSink<AssemblyPhase::pattern, Matrix, Dofs>{matrix, dofs, dofs});
    matrix.finishPattern();
    mass.addToMatrix(p, x, MatrixSink<AssemblyPhase::add, Matrix, Dofs>{matrix, dofs, dofs});
  }
};

template <class D>
struct MassSuite {
  using Real = typename D::Real;
  using VecDeriv = typename D::VecDeriv;
  static constexpr double rounding = sizeof(Real) == 8 ? 1e-12 : 1e-4;
  Random random{20070103};
  const sample::Body body{random};
  const typename D::VecCoord x = sample::positions<D>(body, random);
  const std::size_t n = x.size();
  const VecDeriv zero = VecDeriv(n, D::Deriv::Zero()), u = sample::derivs<D>(n, random),
                 w = sample::derivs<D>(n, random);

  template <class C>
  void run() {
    INFO(component_name<C>());
    // tetrahedra are for three dimensions; in fewer, the mass of elements is that of edges
    std::vector<Edge> chain;
    for (int i = 0; i + 1 < int(n); ++i) chain.push_back({i, i + 1});
    SubjectOf<C> mass(
        InitContext<D>{"sample", x, D::spatial == 3 ? body.topology() : TopologyView{.edges = chain}},
        random);
    check(mass);
    if constexpr (over_body<C>) {
      SubjectOf<C> ofBody(InitContext<D>{"sample", x, body.topology(), {}, body.points}, random);
      check(ofBody);
    }
  }

  static double norm(VecDeriv const& a) { return double(vec::flat(a).norm()); }
  static double distance(VecDeriv const& a, VecDeriv const& b) {
    return double((vec::flat(a) - vec::flat(b)).norm());
  }

  void check(Subject<D>& mass) {
    // M^-1 undoes M (or the row sums of M), and M is symmetric and positive
    VecDeriv mu = zero, mw = zero, back = zero;
    mass.addMDx(mu, x, u);
    mass.addMDx(mw, x, w);
    mass.accFromF(back, x, mu);
    if (mass.exactInverse) {
      CHECK(distance(back, u) <= 100 * rounding * norm(u));
    } else if (mass.rowSums) {
      VecDeriv one(n, D::Deriv::Ones()), m = zero, again = zero;
      mass.addMDx(m, x, one);
      mass.accFromF(again, x, m);
      CHECK(distance(again, one) <= 100 * rounding * norm(one));
    }
    CHECK(vec::dot(w, mu) == Approx(vec::dot(u, mw)).epsilon(100 * rounding).margin(rounding));
    CHECK(mass.kineticEnergy(x, u) == Approx(0.5 * vec::dot(u, mu)).epsilon(100 * rounding));
    CHECK(mass.kineticEnergy(x, u) > 0);

    // the blocks of the matrix are M
    typename Subject<D>::Matrix matrix;
    mass.assemble(x, matrix);
    VecDeriv out = zero;
    matrix.multiply(u[0].data(), out[0].data());
    CHECK(distance(out, mu) <= 100 * rounding * norm(mu));

    // the weight is the mass times gravity, and does no work on a body that turns where it stands
    VecDeriv f = zero;
    MechanicalParams gravity;
    gravity.gravity = {1, 2, 3};
    mass.addForce(gravity, f, x, zero);
    VecDeriv falling = zero, weight = zero;
    for (auto& d : falling)
      for (int c = 0; c < D::spatial; ++c) d[c] = Real(gravity.gravity[c]);
    mass.addMDx(weight, x, falling);
    CHECK(distance(f, weight) <= 100 * rounding * norm(f));
    if constexpr (D::rigid) {
      VecDeriv gyroscopic = zero;
      mass.addForce({}, gyroscopic, x, u);
      CHECK(std::abs(vec::dot(gyroscopic, u)) <= 100 * rounding * (norm(gyroscopic) + 1));
    }
  }
};

}  // namespace

TEST_CASE("every mass is symmetric, positive and undone by its inverse") {
  int found = 0;
  for_each_registered<Extended>([&]<class C>() {
    if constexpr (HasRole<C, role::Mass>) {
      MassSuite<typename C::DataTypes>{}.template run<C>();
      ++found;
    }
  });
  CHECK(found > 0);
}

TEST_CASE("DiagonalMass shares density out over tetrahedra") {
  const std::vector<Eigen::Vector3d> x{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<Tetrahedron> t{{0, 1, 2, 3}, {1, 2, 3, 4}};
  DiagonalMass<Vec3d> mass{.massDensity = 12};
  mass.init(InitContext<Vec3d>{"sample", x, {.tetrahedra = t}});
  // volumes 1/6 and 1/3: points 0 and 4 have one quarter of one element, the others of both
  CHECK(mass.lumped.at(0) == Approx(0.5));
  CHECK(mass.lumped.at(1) == Approx(1.5));
  CHECK(mass.lumped.at(4) == Approx(1.0));
  DiagonalMass<Vec3d> total{.totalMass = 3};
  total.init(InitContext<Vec3d>{"sample", x, {.tetrahedra = t}});
  CHECK(total.lumped.totalMass(5) == Approx(3));
}
