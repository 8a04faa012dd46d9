// SPDX-License-Identifier: BSL-1.0
// The shortest element force, whole, and beside it one that does everything itself.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/core/element_driver.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/sinew.hpp>

namespace test_element_force {

using namespace sinew;
using Eigen::Vector3d;

/// Tension of a thread that has no length of its own.
///   E = k/2 |d|^2,  d = x1 - x0  [J]     f0 = -f1 = k d     df0/dx1 = k I
template <class D>
struct ThreadLaw {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real stiffness;
  };
  struct Tangent {};

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[2]) const {
    return Real(0.5) * rest.stiffness * (x[1] - x[0]).squaredNorm();
  }
  SINEW_HD void force(Rest const& rest, Coord const (&x)[2], Deriv const (&)[2], Deriv (&f)[2],
                      Tangent&) const {
    f[0] = (x[1] - x[0]) * rest.stiffness;
    f[1] = -f[0];
  }
  SINEW_HD void dforce(Rest const& rest, Tangent const&, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
                       Real /*b*/) const {
    df[0] = (dx[1] - dx[0]) * (k * rest.stiffness);
    df[1] = -df[0];
  }
  SINEW_HD Mat<Real, D::size> block(Rest const& rest, Tangent const&, int i, int j, Real k,
                                    Real /*b*/) const {
    Mat<Real, D::size> block;
    for (int c = 0; c < D::size * D::size; ++c) block(c) = Real(0);
    for (int c = 0; c < D::size; ++c) block(c, c) = k * rest.stiffness * Real(i == j ? -1 : 1);
    return block;
  }
};

/// Threads along the edges of the topology.
template <class D>
struct ThreadForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  static constexpr bool sharesWork = true;
  static constexpr std::string_view className = "ThreadForceField";

  std::vector<double> stiffness{1};

  static constexpr auto fields() {
    return field_list(field("stiffness",
                            &ThreadForceField::stiffness,
                            "N/m",
                            "force per length: one for all edges, or one for each",
                            range::nonNegative));
  }

  using Driver = ElementDriver<ThreadLaw, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<ThreadForceField>());
    auto const& edges = context.topology.edges;
    detail::check_indices(where, "edge", edges, context.rest.size());
    check_one_or_each(where, "stiffness", stiffness.size(), edges.size(), "edges");
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < edges.size(); ++e)
      rest.push_back({typename D::Real(one_or_each(stiffness, e))});
    driver.init({edges.begin(), edges.end()}, rest);
  }
};

/// The same thread between points 0 and 1, by functions of its own.
struct ByItself {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  using VecDeriv = Vec3d::VecDeriv;
  static constexpr std::string_view className = "ByItself";
  static constexpr auto fields() { return field_list(); }
  double stiffness = 1;

  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, VecDeriv& f, Vec3d::VecCoord const& x, VecDeriv const&) const {
    const Vector3d pull = (x[1] - x[0]) * stiffness;
    f[0] += pull, f[1] -= pull;
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    const Vector3d pull = (dx[1] - dx[0]) * (p.k * stiffness);
    df[0] += pull, df[1] -= pull;
  }
  double potentialEnergy(Vec3d::VecCoord const& x) const {
    return 0.5 * stiffness * (x[1] - x[0]).squaredNorm();
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    const Eigen::Matrix3d k = p.k * stiffness * Eigen::Matrix3d::Identity();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) sink.add(i, j, i == j ? Eigen::Matrix3d(-k) : k);
  }
};

/// An element force that scales its forces, and leaves all else to its driver.
struct Halved : ThreadForceField<Vec3d> {
  void addForce(MechanicalParams const& p, Vec3d::VecDeriv& f, Vec3d::VecCoord const& x,
                Vec3d::VecDeriv const& v) {
    Vec3d::VecDeriv whole(f.size(), Vector3d::Zero());
    driver.addForce(law_of(*this), whole, x, v, p.share);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] += 0.5 * whole[i];
  }
};

static_assert(ElementForce<ThreadForceField<Vec3d>> && ForceField<ThreadForceField<Vec3d>>);
static_assert(!ElementForce<ByItself> && ForceField<ByItself>);
static_assert(ElementForce<StiffSpringForceField<Vec3d, Between<"a", "b">>> &&
              InteractionForceField<StiffSpringForceField<Vec3d, Between<"a", "b">>>);

const std::vector<Vector3d> line{{0, 0, 0}, {1, 2, 0}};
const std::vector<Edge> edge{{0, 1}};

template <class Force, class Linear>
auto swinging(Force force, Linear linear) {
  Simulation sim{node<"root">(EulerImplicitSolver{},
                              linear,
                              MeshTopology{.edges = edge},
                              MechanicalObject<Vec3d>{line},
                              UniformMass<Vec3d>{.totalMass = 2},
                              force)};
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.05);
  return std::pair(sim.root().state().position, sim.potentialEnergy());
}

TEST_CASE("an element force is its law, its fields and its elements") {
  ThreadForceField<Vec3d> thread{.stiffness = {3}};
  thread.init({"body", line, {.edges = edge}});
  std::vector<Vector3d> f(2, Vector3d::Zero()), df = f;
  add_force(thread, {}, f, line, f);
  CHECK((f == std::vector<Vector3d>{{3, 6, 0}, {-3, -6, 0}}));
  add_dforce(std::as_const(thread), {.k = 2}, df, line);
  CHECK((df == std::vector<Vector3d>{{6, 12, 0}, {-6, -12, 0}}));
  CHECK(potential_energy(thread, line) == 7.5);

  Halved halved;
  halved.init({"body", line, {.edges = edge}});
  f.assign(2, Vector3d::Zero());
  add_force(halved, {}, f, line, f);
  CHECK((f == std::vector<Vector3d>{{0.5, 1, 0}, {-0.5, -1, 0}}));
  CHECK(potential_energy(halved, line) == 2.5);
}

TEST_CASE("a force with functions of its own moves as an element force does") {
  const ThreadForceField<Vec3d> thread{.stiffness = {3}};
  const ByItself own{.stiffness = 3};
  auto near = [](auto const& a, auto const& b) {
    for (std::size_t i = 0; i < 2; ++i) CHECK((a.first[i] - b.first[i]).norm() < 1e-12);
    CHECK(a.second == Approx(b.second));
  };
  const CGLinearSolver<> iterative{.iterations = 50, .tolerance = 1e-14};
  near(swinging(thread, iterative), swinging(own, iterative));
  near(swinging(thread, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}),
       swinging(own, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}));
  near(swinging(thread, iterative), swinging(thread, SparseLDLSolver<CompressedRowSparseMatrixMat3x3d>{}));
}

TEST_CASE("lists say which of their numbers and how many of their values are wrong") {
  CHECK(error_of([] {
          check_points("body", "points", std::vector{0, 4}, 4);
        }) == "body: points has 4, but the state has 4 points, numbered from 0; correct the index");
  CHECK(error_of([] { check_numbers("body", "edges", std::vector{-1}, 4, "edges", "the topology"); }) ==
        "body: edges has -1, but the topology has 4 edges, numbered from 0; correct the index");
  CHECK(error_of([] { check_one_or_each("body", "stiffness", 2, 3, "edges"); }) ==
        "body: stiffness has 2 values for 3 edges; give one value, or one for each");
  check_one_or_each("body", "stiffness", 3, 3, "edges");
  CHECK(one_or_each(std::vector{7}, 2) == 7);
  CHECK(one_or_each(std::vector{7, 8, 9}, 2) == 9);
}

}  // namespace test_element_force
