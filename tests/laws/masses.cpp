// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "sample.hpp"

using namespace sinew;
using sample::Random;

namespace {

template <class C>
void check_mass() {
  using D = typename C::DataTypes;
  using Real = typename D::Real;
  using VecDeriv = typename D::VecDeriv;
  const double rounding = sizeof(Real) == 8 ? 1e-12 : 1e-4;
  INFO(component_name<C>());
  Random random{20070103};
  const sample::Body body{random};
  const auto x = sample::positions<D>(body, random);
  const std::size_t n = x.size();
  const VecDeriv zero(n, D::Deriv::Zero()), u = sample::derivs<D>(n, random),
                                            w = sample::derivs<D>(n, random);

  C mass{};
  if constexpr (requires { mass.vertexMass.resize(n); }) {
    mass.vertexMass.resize(n);
    for (auto& m : mass.vertexMass) sample::randomise(m, range::positive, random);
  } else if constexpr (requires { mass.vertexMass.emplace(); }) {
    mass.vertexMass.emplace();
    sample::randomise(*mass.vertexMass, range::positive, random);
  }
  // tetrahedra are for three dimensions; in fewer, the mass of elements is that of edges
  std::vector<Edge> chain;
  for (int i = 0; i + 1 < int(n); ++i) chain.push_back({i, i + 1});
  mass.init(InitContext<D>{"sample", x, D::spatial == 3 ? body.topology() : TopologyView{.edges = chain}});

  // M^-1 undoes M (or the row sums of M), and M is symmetric and positive
  VecDeriv mu = zero, mw = zero, back = zero;
  mass.addMDx(mu, x, u, 1.0);
  mass.addMDx(mw, x, w, 1.0);
  mass.accFromF(back, x, mu);
  bool exact = true;
  if constexpr (requires { mass.exactInverse(); }) exact = mass.exactInverse();
  if (exact) {
    CHECK(double((vec::flat(back) - vec::flat(u)).norm()) <= 100 * rounding * double(vec::flat(u).norm()));
  } else {
    VecDeriv one(n, D::Deriv::Ones()), m = zero, again = zero;
    mass.addMDx(m, x, one, 1.0);
    mass.accFromF(again, x, m);
    CHECK(double((vec::flat(again) - vec::flat(one)).norm()) <=
          100 * rounding * double(vec::flat(one).norm()));
  }
  CHECK(vec::dot(w, mu) == Approx(vec::dot(u, mw)).epsilon(100 * rounding).margin(rounding));
  CHECK(mass.kineticEnergy(x, u) == Approx(0.5 * vec::dot(u, mu)).epsilon(100 * rounding));
  CHECK(mass.kineticEnergy(x, u) > 0);

  // the blocks of the matrix are M
  CompressedRowSparseMatrix<Real, 1> matrix;
  const DirectDofs<D::size> dofs{0};
  const MechanicalParams p{.m = 1};
  using Matrix = decltype(matrix);
  matrix.startPattern(int(n) * D::size);
  mass.addToMatrix(p, x, MatrixSink<AssemblyPhase::pattern, Matrix, DirectDofs<D::size>>{matrix, dofs, dofs});
  matrix.finishPattern();
  mass.addToMatrix(p, x, MatrixSink<AssemblyPhase::add, Matrix, DirectDofs<D::size>>{matrix, dofs, dofs});
  matrix.mirror();
  Eigen::Matrix<Real, Eigen::Dynamic, 1> out(matrix.dofs());
  matrix.multiply(u[0].data(), out.data());
  CHECK(double((out - vec::flat(mu)).norm()) <= 100 * rounding * double(vec::flat(mu).norm()));

  // the weight is the mass times gravity, and does no work on a body that turns where it stands
  VecDeriv f = zero;
  MechanicalParams gravity;
  gravity.gravity = {1, 2, 3};
  mass.addForce(gravity, f, x, zero);
  VecDeriv falling = zero, weight = zero;
  for (auto& d : falling)
    d.template head<D::spatial>() = gravity.gravity.head<D::spatial>().template cast<Real>();
  mass.addMDx(weight, x, falling, 1.0);
  CHECK(double((vec::flat(f) - vec::flat(weight)).norm()) <= 100 * rounding * double(vec::flat(f).norm()));
  if constexpr (D::rigid) {
    VecDeriv gyroscopic = zero;
    mass.addForce({}, gyroscopic, x, u);
    CHECK(std::abs(vec::dot(gyroscopic, u)) <= 100 * rounding * double(vec::flat(gyroscopic).norm() + 1));
  }
}

}  // namespace

TEST_CASE("every mass is symmetric, positive and undone by its inverse") {
  int found = 0;
  for_each_registered<Extended>([&]<class C>() {
    if constexpr (HasRole<C, role::Mass>) {
      check_mass<C>();
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
