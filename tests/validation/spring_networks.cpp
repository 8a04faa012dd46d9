// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"
#include "registry_scene.hpp"

#include <Eigen/Cholesky>

namespace test_spring_networks {

using namespace bars;

namespace {

/// A network of springs, and its equilibrium by hand: Newton's method with the dense sum of
///   k (u u' + (1 - L/l) (I - u u')),   u = d/l, l = |d|
/// over all springs, factorised by Eigen.
struct Network {
  Vec3d::VecCoord points;
  std::vector<Spring> springs;
  std::vector<int> fixed;
  Vector3d load;  // on each point [N]

  Vec3d::VecCoord byHand(int iterations) const {
    Vec3d::VecCoord x = points;
    const long n = 3 * long(x.size());
    for (int it = 0; it < iterations; ++it) {
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
      Eigen::VectorXd f(n);
      for (std::size_t i = 0; i < x.size(); ++i) f.segment<3>(3 * long(i)) = load;
      for (Spring const& s : springs) {
        const long a = 3 * s.first, b = 3 * s.second;
        const Vector3d d = x[std::size_t(s.second)] - x[std::size_t(s.first)];
        const double l = d.norm(), L = (points[std::size_t(s.second)] - points[std::size_t(s.first)]).norm();
        const Eigen::Matrix3d uu = d * d.transpose() / (l * l);
        const Eigen::Matrix3d k = s.stiffness * (uu + (1 - L / l) * (Eigen::Matrix3d::Identity() - uu));
        f.segment<3>(a) += s.stiffness * (l - L) * d / l, f.segment<3>(b) -= s.stiffness * (l - L) * d / l;
        K.block<3, 3>(a, a) += k, K.block<3, 3>(b, b) += k;
        K.block<3, 3>(a, b) -= k, K.block<3, 3>(b, a) -= k;
      }
      for (const int i : fixed)
        for (int c = 0; c < 3; ++c) {
          K.row(3 * i + c).setZero(), K.col(3 * i + c).setZero();
          K(3 * i + c, 3 * i + c) = 1, f[3 * i + c] = 0;
        }
      const Eigen::VectorXd dx = K.ldlt().solve(f);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += dx.segment<3>(3 * long(i));
    }
    return x;
  }
  template <class Linear>
  auto simulated(Linear linear, int iterations) const {
    RegistryScene sim{node<"root">(to_rounding(iterations),
                                   linear,
                                   MechanicalObject<Vec3d>{points},
                                   StiffSpringForceField<Vec3d>{.springs = springs},
                                   ConstantForceField<Vec3d>{.force = load},
                                   FixedConstraint<Vec3d>{.indices = fixed})};
    sim.init();
    sim.animate(1);
    return sim;
  }
};

/// Shaken points of a block, each joined to all that are near, with stiffnesses over two decades.
Network network(double load) {
  Network net;
  net.load = {0.3 * load, -load, 0.1 * load};
  for (int i = 0; i < 60; ++i) {
    const double t = i;
    net.points.push_back(Vector3d(i % 3, i / 3 % 4, i / 12) +
                         0.2 * Vector3d(std::sin(3 * t), std::sin(5 * t + 1), std::sin(7 * t + 2)));
    if (i / 3 % 4 == 3) net.fixed.push_back(i);
  }
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < i; ++j)
      if ((net.points[std::size_t(i)] - net.points[std::size_t(j)]).norm() < 1.6)
        net.springs.push_back(
            {.first = i, .second = j, .stiffness = 100 * std::pow(10, std::sin(double(i * j)))});
  return net;
}

double largest_difference(Vec3d::VecCoord const& a, Vec3d::VecCoord const& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace

TEST_CASE("networks of springs hang where a direct solution made by hand says", "[page]") {
  Record table("spring_networks", {"load", "way", "ldl", "cg"});
  for (const double load : {1e-3, 1.0, 10.0}) {
    const Network net = network(load);
    REQUIRE(net.springs.size() > 200);
    const auto hand = net.byHand(20);
    // a small load is one iteration of both, also to the last digits
    CHECK(largest_difference(net.simulated(SparseLDLSolver<>{}, 1).root().state().position, net.byHand(1)) <
          1e-12 * (1 + load));
    auto direct = net.simulated(SparseLDLSolver<>{}, 20);
    const double ldl = largest_difference(direct.root().state().position, hand);
    CHECK(ldl < 1e-11);
    auto iterated = net.simulated(CGLinearSolver<>{.iterations = 2000, .tolerance = 1e-12}, 20);
    const double cg = largest_difference(iterated.root().state().position, hand);
    CHECK(cg < 1e-9);
    const double way = largest_difference(net.points, hand);
    table.row(load, way, ldl, cg);
  }
}

TEST_CASE("a grid of springs stretches as its lattice does") {
  // K is a force per relative extension: a spring of length L that a strain e along x extends by e cos^2 of
  // itself has the energy K L (e cos^2)^2 / 2. In cells of side 1 lines have L = 1, cos^2 = 1, diagonals of
  // faces sqrt 2 and 1/2, diagonals of cells sqrt 3 and 1/3.
  const double K = 10, e = 1e-4;
  for (const int cells : {2, 5}) {
    RegistryScene sim{node<"root">(EulerExplicitSolver{},
                                   RegularGridTopology{.n = {cells + 1, cells + 1, cells + 1},
                                                       .min = {0, 0, 0},
                                                       .max = {double(cells), double(cells), double(cells)}},
                                   MechanicalObject<Vec3d>{},
                                   UniformMass<Vec3d>{.vertexMass = 1},
                                   RegularGridSpringForceField<Vec3d>{.stiffness = K})};
    sim.init();
    for (auto& x : sim.root().state().position) x[0] *= 1 + e;
    const double n = cells, m = cells + 1;
    const double lines = n * m * m, faces = 4 * n * n * m * std::sqrt(2.0) / 4,
                 diagonals = 4 * n * n * n * std::sqrt(3.0) / 9;
    const double energy = K / 2 * e * e * (lines + faces + diagonals);
    // the next term of the extension is e/2 against it
    CHECK(sim.potentialEnergy() == Approx(energy).epsilon(2 * e));
  }
}

}  // namespace test_spring_networks
