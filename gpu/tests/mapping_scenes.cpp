// SPDX-License-Identifier: BSL-1.0
// Scenes of several models of one body, on the device and across, against the same scene on the host.
#include "catch.hpp"

#include <sinew/gpu/gpu.hpp>

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mapping/subset_mapping.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/visual/visual_model.hpp>

namespace test_mapping_scenes {

using namespace sinew;

namespace {

std::size_t crossed() { return gpu::transfers().toDevice + gpu::transfers().toHost; }

template <class A, class B>
double largest_difference(A const& a, B const& b) {
  REQUIRE(a.size() == b.size());
  double maximum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) maximum = std::max(maximum, double((a[i] - b[i]).norm()));
  return maximum;
}

// a bar of 63 points held at one end, with a skin of its 50 border points pushed out a little
template <class D>
auto bar_with_skin() {
  const Mesh mesh = regular_grid_tetrahedra(7, 3, 3, {0, 0, 0}, {3, 1, 1});
  Mesh skin;
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Eigen::Vector3d const& p = mesh.positions[i];
    if (p[0] < 0.01) fixed.push_back(int(i));
    if (skin.positions.size() < 50) skin.positions.push_back(p + Eigen::Vector3d(0, 0.1, 0.05));
  }
  VisualModel visual;
  visual.mesh = skin;
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.1},
                   CGLinearSolver<>{.iterations = 25, .tolerance = 0},
                   node<"bar">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                               MechanicalObject<D>{},
                               DiagonalMass<D>{.massDensity = 1000},
                               TetrahedronFEMForceField<D>{.youngModulus = {1e5}, .poissonRatio = 0.4},
                               FixedConstraint<D>{.indices = fixed},
                               node<"skin">(visual, BarycentricMapping<D, Vec3f>{})))};
}

// a slab on 60 feet that a plane carries
template <class Rigid, class Point>
auto slab_on_feet() {
  typename Point::VecCoord feet;
  for (int i = 0; i < 60; ++i) {
    typename Point::Coord foot{0, 0, 0};
    foot[0] = typename Point::Real(0.1 * (i % 10) - 0.45);
    foot[1] = typename Point::Real(-0.1);
    foot[2] = typename Point::Real(0.15 * (i / 10) - 0.3);
    feet.push_back(foot);
  }
  typename Rigid::Coord start = Rigid::zero();
  start.center[1] = typename Rigid::Real(0.3);
  start.orientation.w() = typename Rigid::Real(std::cos(0.1));
  start.orientation.x() = typename Rigid::Real(std::sin(0.1));
  return Simulation{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{},
                   CGLinearSolver<>{.iterations = 12, .tolerance = 0},
                   node<"slab">(MechanicalObject<Rigid>{.position = {start}},
                                UniformMass<Rigid>{.vertexMass = RigidMass<typename Rigid::Real, 3>{2}},
                                node<"feet">(MechanicalObject<Point>{.position = feet},
                                             RigidMapping<Rigid, Point>{},
                                             PlaneForceField<Point>{.stiffness = 400, .damping = 5})))};
}

// a soft block of 27 points over D with spheres around its lowest 9, on the host, above a square of triangles
template <class D, class Child>
auto block_on_floor() {
  const Mesh mesh = regular_grid_tetrahedra(3, 3, 3, {0, 0.2, 0}, {1, 1.2, 1});
  std::vector<int> lowest;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i][1] < 0.21) lowest.push_back(int(i));
  MeshTopology square;
  square.triangles = {{0, 2, 1}, {0, 3, 2}};
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.1, .contactDistance = 0.05},
      DefaultContactManager{},
      node<"floor">(
          square,
          // no sphere is above the edge between the triangles, where rounding says whether it touches one or
          // both
          MechanicalObject<Vec3d>{.position = {{-5.2, 0, -5}, {4.8, 0, -5}, {4.8, 0, 5}, {-5.2, 0, 5}}},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactStiffness = 2e4}),
      node<"block">(EulerImplicitSolver{.rayleighStiffness = 0.02},
                    CGLinearSolver<>{.iterations = 30, .tolerance = 0},
                    MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                    MechanicalObject<D>{},
                    DiagonalMass<D>{.massDensity = 100},
                    TetrahedronFEMForceField<D>{.youngModulus = {1e5}, .poissonRatio = 0.3},
                    node<"spheres">(MechanicalObject<Child>{},
                                    SubsetMapping<D, Child>{.indices = lowest},
                                    SphereCollisionModel<Child>{.contactStiffness = 2e4, .radius = 0.05})))};
}

}  // namespace

TEST_CASE("a body on the device has its skin on the host, which crosses when it is looked at") {
  auto host = bar_with_skin<Vec3d>();
  auto device = bar_with_skin<CudaVec3d>();
  auto single = bar_with_skin<CudaVec3f>();
  auto start = [](auto& sim) {
    sim.init();
    for (int i = 0; i < 3; ++i) sim.animate(0.02);
  };
  start(host), start(device), start(single);
  gpu::transfers() = {};
  for (int i = 0; i < 47; ++i) host.animate(0.02), device.animate(0.02), single.animate(0.02);
  CHECK(crossed() == 0);
  device.updateVisual();
  CHECK(gpu::transfers().toHost == 50);
  CHECK(gpu::transfers().toDevice == 0);
  host.updateVisual();
  single.updateVisual();
  auto const& expected = host.template at<"bar/skin">().visual().position;
  // the bar bends by 0.6; a float has 7 digits, and conjugate gradients lose one or two of them
  CHECK(largest_difference(device.template at<"bar/skin">().visual().position, expected) < 1e-6);
  CHECK(largest_difference(single.template at<"bar/skin">().visual().position, expected) < 1e-3);
}

TEST_CASE("points of a rigid body on the device carry it, and nothing crosses") {
  auto host = slab_on_feet<Rigid3d, Vec3d>();
  auto device = slab_on_feet<CudaRigid3d, CudaVec3d>();
  auto mixed = slab_on_feet<CudaRigid3d, Vec3d>();
  host.init(), device.init(), mixed.init();
  auto run = [&](int steps) {
    for (int i = 0; i < steps; ++i) host.animate(0.01), device.animate(0.01);
  };
  run(2);
  gpu::transfers() = {};
  run(98);
  CHECK(crossed() == 0);
  for (int i = 0; i < 100; ++i) mixed.animate(0.01);
  auto const& expected = host.template at<"slab">().state().position[0];
  for (auto const& found :
       {device.template at<"slab">().state().position[0], mixed.template at<"slab">().state().position[0]}) {
    CHECK((found.center - expected.center).norm() < 1e-9);
    CHECK((found.orientation.coeffs() - expected.orientation.coeffs()).norm() < 1e-9);
  }
  // 60 springs of 400 N/m carry 2 kg with a depth of 0.8 mm: it lies flat, 0.1 above that
  CHECK(expected.center[1] == Approx(0.1 - 2 * 9.81 / 24000).margin(0.02));
  CHECK(largest_difference(device.template at<"slab/feet">().state().position,
                           host.template at<"slab/feet">().state().position) < 1e-9);
}

TEST_CASE("a body on the device falls onto a floor with the spheres that it has on the host") {
  auto host = block_on_floor<Vec3d, Vec3d>();
  auto device = block_on_floor<CudaVec3d, Vec3d>();
  host.init(), device.init();
  std::size_t contacts = 0;
  for (int i = 0; i < 100; ++i) {
    host.animate(0.01), device.animate(0.01);
    contacts = std::max(contacts, device.root().template get<DefaultContactManager>().contacts.size());
  }
  CHECK(contacts >= 9);
  auto const& expected = host.template at<"block">().state().position;
  auto const& found = device.template at<"block">().state().position;
  CHECK(largest_difference(found, expected) < 1e-6);
  double lowest = 1;
  for (auto const& x : found) lowest = std::min(lowest, x[1]);
  // spheres of 0.05 at a distance of at most 0.05, pressed in by a few mm
  CHECK(lowest > 0.08);
  CHECK(lowest < 0.105);

  // dx of 9 points comes down in each product, and forces of those go up, and the first forces of a step
  gpu::transfers() = {};
  device.animate(0.01);
  CHECK(gpu::transfers().toHost <= 9 * (2 * 31 + 6));
  CHECK(gpu::transfers().toDevice <= 9 * (2 * 31 + 6));
  CHECK(gpu::transfers().toDevice >= 9 * 30);
}

}  // namespace test_mapping_scenes
