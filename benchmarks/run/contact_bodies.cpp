// SPDX-License-Identifier: BSL-1.0
// Soft bodies that lie on each other, their contacts solved by multipliers:
//   contact_bodies livers TETRAHEDRA STEPS SOLVER [TOLERANCE ...]  the hollow of one on the back of another
//   contact_bodies stack BLOCKS STEPS SOLVER [TOLERANCE ...]       blocks of 192 tetrahedra, each turned a
//   little
// SOLVER: convex, sweeps or nncg. A line for each tolerance, by measure() in contact.hpp.
#include "contact.hpp"

#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>
#include <sinew/topology/surface_mesh.hpp>

using namespace bench;

namespace {

constexpr double dt = 0.01;

/// All bodies, which one state has.
struct Bodies {
  Mesh volume{}, surface{};
  std::vector<int> fixed{};
  double mass = 0, young = 0, skin = 0;  // [kg, Pa, m]: they touch at the distance of the skin
  int settling = 0;                      // steps until they lie

  void add(Mesh const& body, Eigen::Matrix3d const& turn, Eigen::Vector3d const& shift) {
    auto append = [&](Mesh& to, Mesh const& more) {
      const int first = int(to.positions.size());
      for (auto const& x : more.positions) to.positions.push_back(turn * x + shift);
      for (auto t : more.tetrahedra) {
        for (Index& i : t) i += first;
        to.tetrahedra.push_back(t);
      }
      for (auto t : more.triangles) {
        for (Index& i : t) i += first;
        to.triangles.push_back(t);
      }
    };
    append(volume, body);
    append(surface, boundary_surface(body));
  }
};

Bodies livers(int tetrahedra) {
  const LiverShape shape;
  const Mesh liver = tetrahedralize_count(shape, LiverShape::box_min(), LiverShape::box_max(), tetrahedra);
  const Eigen::Matrix3d upright = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  Bodies two{.mass = 2 * 1.2, .young = 1e4, .skin = 5e-4, .settling = 60};
  two.add(liver, upright, {0, 0, 0.07});
  for (std::size_t i = 0; i < two.volume.positions.size(); ++i)
    if (two.volume.positions[i][2] < 0.03) two.fixed.push_back(int(i));
  two.add(liver, upright, {-0.035, 0, 0.07 + 0.105});
  return two;
}
Bodies stack(int blocks) {
  const Mesh block = regular_grid_tetrahedra(5, 5, 3, {-0.1, -0.1, 0}, {0.1, 0.1, 0.1});
  Bodies all{.mass = 4.0 * blocks, .young = 5e4, .skin = 1e-3, .settling = 60};
  for (int i = 0; i < blocks; ++i)
    all.add(block,
            Eigen::AngleAxisd(0.15 * (i % 3 - 1), Eigen::Vector3d::UnitZ()).toRotationMatrix(),
            {0.004 * i, 0, all.skin + (0.1 + all.skin) * i});
  return all;
}

template <class Solver, class Linear>
auto scene(Bodies const& b, Solver solver, Linear linear) {
  MeshTopology triangles;
  triangles.triangles = b.surface.triangles;
  return profiled(node<"root">(
      FreeMotionAnimationLoop{},
      solver,
      Gravity{{0, 0, -9.81}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      ContinuousIntersection{.alarmDistance = 4 * b.skin, .contactDistance = b.skin},  // 8 mm a step at most
      contact_manager(4 * int(b.surface.positions.size())),
      wide_floor(),
      node<"bodies">(EulerImplicitSolver{.rayleighStiffness = 0.01, .rayleighMass = 0.01},
                     linear,
                     TetrahedronTopology{b.volume.tetrahedra},
                     MechanicalObject<Vec3d>{.position = b.volume.positions},
                     UniformMass<Vec3d>{.totalMass = b.mass},
                     TetrahedronFEMForceField<Vec3d>{.youngModulus = {b.young}, .poissonRatio = 0.4},
                     FixedConstraint<Vec3d>{.indices = b.fixed},
                     node<"skin">(triangles,
                                  MechanicalObject<Vec3d>{.position = b.surface.positions},
                                  BarycentricMapping<Vec3d, Vec3d>{},
                                  TriangleCollisionModel<Vec3d>{.selfCollision = true, .bothSide = false},
                                  PointCollisionModel<Vec3d>{.selfCollision = true}))));
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view kind = argc > 1 ? argv[1] : "";
  if (argc < 5 || (kind != "livers" && kind != "stack")) {
    std::fprintf(
        stderr,
        "usage: contact_bodies livers|stack TETRAHEDRA|BLOCKS STEPS convex|sweeps|nncg [TOLERANCE ...]\n");
    return 2;
  }
  const Bodies bodies = kind == "livers" ? livers(whole_number(argv[2])) : stack(whole_number(argv[2]));
  with_solver(argv[4], [&](auto solver, auto linear, auto matrixOf) {
    Simulation sim{scene(bodies, solver, linear)};
    sim.init();
    for (int i = 0; i < bodies.settling; ++i) sim.animate(dt);
    measure(sim, tolerances_of(argc, argv, 5), dt, whole_number(argv[3]), [&](auto& s) {
      return std::vector{matrixOf(s.template at<"bodies">().template get<decltype(linear)>())};
    });
  });
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "contact_bodies: %s\n", error.what());
  return 1;
}
