// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "scenes_contact.hpp"

#include <sinew/contact.hpp>

#include <string>
#include <utility>

namespace gpu_test {

/// The soft block of BlockOnPlane slides over hills of triangles that stand, its points over D meeting them.
struct BlockOnFloor {
  int cells = 3;
  double slope = 0.3, mu = 0.2;
  bool velocityFirst = false;
  int capacity = 1000;

  // off the lines on which points of the block would meet two triangles at once
  MeshTopology floor() const {
    constexpr int across = 7;
    MeshTopology t;
    for (int j = 0; j <= across; ++j)
      for (int i = 0; i <= across; ++i)
        t.position.push_back({0.613 * i - 1.237, 0.587 * j - 1.171, -0.01 - 0.002 * ((i + 2 * j) % 3)});
    for (int j = 0; j < across; ++j)
      for (int i = 0; i < across; ++i) {
        const int p = j * (across + 1) + i, q = p + across + 1;
        t.triangles.push_back({p, p + 1, q + 1});
        t.triangles.push_back({p, q + 1, q});
      }
    return t;
  }
  template <class D, class Linear = CGLinearSolver<CompressedRowSparseMatrixMat3x3d>, class Model,
            class... More>
  auto make(Model model, More... more) const {
    const BlockOnPlane b{.cells = cells, .slope = slope};
    const Mesh m = b.mesh();
    return Simulation{
        node<"root">(FreeMotionAnimationLoop{.solveVelocityConstraintFirst = velocityFirst},
                     b.solver(),
                     b.gravity(),
                     DefaultPipeline{},
                     BruteForceBroadPhase{},
                     BVHNarrowPhase{},
                     MinProximityIntersection{.alarmDistance = 0.02, .contactDistance = 0.01},
                     DefaultContactManager{.response = "FrictionContactConstraint",
                                           .responseParams = "mu=" + std::to_string(mu),
                                           .capacity = capacity},
                     node<"floor">(floor(),
                                   MechanicalObject<Vec3d>{},
                                   TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false}),
                     node<"body">(b.ode(),
                                  b.linear<Linear>(),
                                  MeshTopology{.position = m.positions, .tetrahedra = m.tetrahedra},
                                  MechanicalObject<D>{},
                                  UniformMass<D>{.totalMass = b.mass},
                                  b.material<D>(),
                                  std::move(model),
                                  std::move(more)...))};
  }
};

struct PointsOnFloor : OneBody {
  static constexpr double dt = 0.01;
  static constexpr int steps = 40;
  static constexpr bool onDevice = true;
  template <class D>
  static auto make() {
    return BlockOnFloor{}.make<D>(PointCollisionModel<D>{});
  }
};
struct RatesOnFloor : PointsOnFloor {
  template <class D>
  static auto make() {
    return BlockOnFloor{.velocityFirst = true}.make<D>(PointCollisionModel<D>{});
  }
};
struct SpheresOnFloor : PointsOnFloor {
  template <class D>
  static auto make() {
    return BlockOnFloor{.mu = 0}.make<D>(SphereCollisionModel<D>{.radius = 0.004});
  }
};
/// Some of its points are held, of which some touch.
struct HeldOnFloor : PointsOnFloor {
  static constexpr bool onDevice = false;  // the host looks at what is held
  template <class D>
  static auto make() {
    const Mesh m = BlockOnPlane{}.mesh();
    return BlockOnFloor{.slope = 0.5}.make<D>(
        PointCollisionModel<D>{},
        FixedConstraint<D>{.indices = BlockOnPlane::points(m, [](auto const& x) { return x[0] < 1e-9; })},
        PartialFixedConstraint<D>{
            .indices = BlockOnPlane::points(m, [](auto const& x) { return x[1] > 0.99; }),
            .fixedDirections = {true, false, false}});
  }
};

}  // namespace gpu_test
