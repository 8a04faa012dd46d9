// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "curved_wire.hpp"

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/point_collision_model.hpp>
#include <sinew/collision/triangle_collision_model.hpp>
#include <sinew/control/interventional_radiology_controller.hpp>
#include <sinew/force/adaptive_beam_force_field.hpp>
#include <sinew/mapping/adaptive_beam_mapping.hpp>
#include <sinew/mass/adaptive_beam_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/solver/sparse_ldl_solver.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include <numbers>

namespace test_catheter {

using namespace sinew;
using Eigen::Vector3d;
using std::numbers::pi;
using Controller = InterventionalRadiologyController<Rigid3d>;
using Frames = Rigid3d::VecCoord;

// A tube of radius 5 mm, straight along x, then a quarter of a circle of radius 50 mm towards +z, away from
// where the tip bends to, then straight along z.
namespace {

double length_of(Frames const& x) {
  double length = 0;
  for (std::size_t i = 1; i < x.size(); ++i) length += (x[i].center - x[i - 1].center).norm();
  return length;
}

struct Tube {
  static constexpr double radius = 0.005, bend = 0.05, entry = 0.03, exit = 0.06;
  /// The middle line at an abscissa, and its direction.
  static std::pair<Vector3d, Vector3d> at(double s) {
    if (s < entry) return {{s, 0, 0}, {1, 0, 0}};
    const double a = (s - entry) / bend;
    if (a < pi / 2)
      return {{entry + bend * std::sin(a), 0, bend * (1 - std::cos(a))}, {std::cos(a), 0, std::sin(a)}};
    return {{entry + bend, 0, bend + s - entry - bend * pi / 2}, {0, 0, 1}};
  }
  static double distance(Vector3d const& p) {
    double nearest = 1;
    for (int i = 0; i <= 2000; ++i)
      nearest = std::min(nearest, (p - at(i * (entry + bend * pi / 2 + exit) / 2000).first).norm());
    return nearest;
  }
  std::vector<Vector3d> points{};
  std::vector<Triangle> triangles{};
  Tube() {
    const int around = 16, rings = 40;
    for (int r = 0; r <= rings; ++r) {
      const auto middle = at(-0.002 + (entry + bend * pi / 2 + exit) * r / rings);
      const Vector3d y(0, 1, 0), z = middle.second.cross(y);
      for (int k = 0; k < around; ++k) {
        const double a = 2 * pi * k / around;
        points.push_back(middle.first + radius * (std::cos(a) * y + std::sin(a) * z));
        if (r == rings) continue;
        const int p = r * around + k, q = r * around + (k + 1) % around;
        triangles.push_back({p, q + around, q});
        triangles.push_back({p, p + around, q + around});
      }
    }
  }
};

}  // namespace

// The penalty of a point has the stiffness 1 * 1 / 0.5 mm = 2000 N/m; straightening the tip takes
// EI / R = 2.5e-3 N m, which is 0.1 N at its ends: 0.05 mm.
TEST_CASE("a wire is pushed through a bent tube and its points stay inside") {
  const auto shape = curved_wire();
  const Tube tube;
  Simulation sim{node<"root">(
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = 0.0015, .contactDistance = 0.0005},
      DefaultContactManager{},
      node<"wire">(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 1},
                   SparseLDLSolver<CompressedRowSparseMatrixd>{},
                   MechanicalObject<Rigid3d>{.position = Frames(16, Rigid3d::zero())},
                   AdaptiveBeamForceField<Rigid3d>{.interpolation = shape.beams},
                   AdaptiveBeamMass<Rigid3d>{.interpolation = shape.beams},
                   Controller{.instruments = shape.beams, .speed = 0.05},
                   node<"points">(MechanicalObject<Vec3d>{},
                                  AdaptiveBeamMapping<Rigid3d, Vec3d>{.interpolation = shape.beams,
                                                                      .points = shape.collisionPoints},
                                  PointCollisionModel<Vec3d>{.contactStiffness = 1})),
      node<"tube">(
          MeshTopology{.triangles = tube.triangles},
          MechanicalObject<Vec3d>{.position = tube.points},
          TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false, .contactStiffness = 1}))};
  sim.init();
  auto const& points = sim.at<"wire/points">().state().position;
  auto const& frames = sim.at<"wire">().state().position;
  double deepest = 0;
  Vector3d where(0, 0, 0);
  int when = 0;
  for (int i = 0; i < 600; ++i) {
    sim.animate(0.005);
    if (i % 10 != 9) continue;
    for (auto const& p : points)
      if (p[0] > 0 || p[2] > 0.02)
        if (const double d = Tube::distance(p); d > deepest) deepest = d, where = p, when = i;
  }
  INFO("deepest " << deepest << " at " << where.transpose() << " in step " << when << " tip "
                  << points.back().transpose());
  CHECK(deepest < Tube::radius);
  CHECK(length_of(frames) == Approx(0.2 + 0.04 * std::sin(0.2) / 0.2).epsilon(1e-3));
  // 0.15 m along a middle line that is 0.03 + 0.0785 m to the end of the bend: the tip is in the last part
  CHECK(points.back()[2] > Tube::bend);
  CHECK(points.back()[0] > Tube::entry + Tube::bend - Tube::radius);
}

}  // namespace test_catheter
