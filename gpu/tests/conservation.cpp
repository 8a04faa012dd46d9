// SPDX-License-Identifier: BSL-1.0
// What a body that is left alone keeps, on the device.
#include "answers.hpp"
#include "catch.hpp"

#include <sinew/force/regular_grid_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/gpu/gpu.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

namespace test_conservation {

using namespace gpu_test;

namespace {

// the body moves as a whole, turns, and shakes
template <class D>
std::vector<typename D::Deriv> velocities(std::size_t n) {
  std::vector<typename D::Deriv> v;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d all = Eigen::Vector3d(0.5, -0.3, 0.2) + noise<Eigen::Vector3d>(i, 0.5);
    v.push_back(all.cast<typename D::Real>());
  }
  return v;
}

struct Momentum {
  Eigen::Vector3d linear{0, 0, 0}, angular{0, 0, 0};
  double scale = 0;  // sum of m |v| (1 + |x|)
};
template <class Sim>
Momentum momentum(Sim& sim) {
  auto const& s = sim.template at<"body">().state();
  Momentum p;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Eigen::Vector3d x = s.position[i].template cast<double>(),
                          v = s.velocity[i].template cast<double>();
    p.linear += v;
    p.angular += x.cross(v);
    p.scale += v.norm() * (1 + x.norm());
  }
  return p;
}

template <class D, class... Solvers>
auto fem(Solvers... solvers) {
  const Mesh mesh = regular_grid_tetrahedra(4, 4, 4, {0, 0, 0}, {1, 1, 1});
  Simulation sim{node<"root">(
      solvers...,
      node<"body">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                   MechanicalObject<D>{.velocity = velocities<D>(mesh.positions.size())},
                   UniformMass<D>{.vertexMass = typename D::Real(1)},
                   TetrahedronFEMForceField<D>{
                       .youngModulus = {3000}, .poissonRatio = 0.3, .method = RotationMethod::nearest}))};
  sim.init();
  return sim;
}

template <class D>
void keeps_momentum(double maximum) {
  // symplectic Euler keeps both, of forces that turn nothing
  auto free = fem<D>(EulerExplicitSolver{});
  Momentum before = momentum(free);
  for (int i = 0; i < 100; ++i) free.animate(0.002);
  Momentum after = momentum(free);
  CHECK((after.linear - before.linear).norm() < maximum * before.scale);
  CHECK((after.angular - before.angular).norm() < maximum * before.scale);
  CHECK(free.potentialEnergy() > 0.1);

  // implicit Euler keeps the linear one, however far its solver went
  auto implicit = fem<D>(EulerImplicitSolver{}, CGLinearSolver<>{.iterations = 5, .tolerance = 0});
  before = momentum(implicit);
  for (int i = 0; i < 100; ++i) implicit.animate(0.01);
  after = momentum(implicit);
  CHECK((after.linear - before.linear).norm() < maximum * before.scale);
  CHECK((after.angular - before.angular).norm() > maximum * before.scale);
}

}  // namespace

TEST_CASE("a free body on the device keeps its momentum") {
  keeps_momentum<CudaVec3d>(1e-13);
  keeps_momentum<CudaVec3f>(1e-5);
}

TEST_CASE("springs without damping on the device keep their energy as symplectic Euler does") {
  // the energy sways with the step, by a part of the order w dt, and does not drift
  auto sway = [](double dt) {
    using D = CudaVec3d;
    Simulation sim{
        node<"root">(EulerExplicitSolver{},
                     node<"body">(RegularGridTopology{.n = {4, 4, 4}},
                                  MechanicalObject<D>{.velocity = velocities<D>(64)},
                                  UniformMass<D>{.vertexMass = 1.0},
                                  RegularGridSpringForceField<D>{.stiffness = 300, .damping = 0}))};
    sim.init();
    const double start = sim.kineticEnergy() + sim.potentialEnergy();
    double maximum = 0, potential = 0;
    for (int step = 0; step * dt < 2; ++step) {
      sim.animate(dt);
      potential = std::max(potential, sim.potentialEnergy());
      maximum = std::max(maximum, std::abs(sim.kineticEnergy() + sim.potentialEnergy() - start) / start);
    }
    CHECK(potential > 0.1 * start);
    return maximum;
  };
  const double coarse = sway(0.002), fine = sway(0.001);
  CHECK(coarse < 0.05);
  CHECK(coarse / fine == Approx(2).epsilon(0.2));
}

}  // namespace test_conservation
