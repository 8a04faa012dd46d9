// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>

#include "bodies.hpp"
#include "options.hpp"
#include "script.hpp"

namespace examples {

/// What the organs are: corotational finite elements...
struct FemOrgans {
  static sinew::EulerImplicitSolver solver(LaparoscopyScene const& s) {
    return {.rayleighStiffness = s.viscosity, .rayleighMass = 0.1};
  }
  template <sinew::FixedString Name, class... Children>
  static auto organ(Organ const& o, double youngModulus, double, Children... children) {
    using namespace sinew;
    return node<Name>(TetrahedronTopology{o.volume.tetrahedra},
                      MechanicalObject<Vec3d>{o.volume.positions},
                      DiagonalMass<Vec3d>{.massDensity = 1000},
                      TetrahedronFEMForceField<Vec3d>{.youngModulus = {youngModulus}, .poissonRatio = 0.4},
                      FixedConstraint<Vec3d>{.indices = o.fixed},
                      children...);
  }
};

/// ... or grids of springs around them, as free-form deformations of the skin. Their springs have dampers.
/// With Rayleigh damping, rK K, springs that are pressed would drive what they should damp: K has F/l (I -
/// uu') of each, which is negative then, and a grid that is crushed under the tool shakes until it breaks up.
struct GridOrgans {
  static sinew::EulerImplicitSolver solver(LaparoscopyScene const&) { return {.rayleighMass = 0.1}; }
  template <sinew::FixedString Name, class... Children>
  static auto organ(Organ const& o, double youngModulus, double viscosity, Children... children) {
    using namespace sinew;
    // a bar of cells is as stiff as one of this modulus: along it, a cell has a line and the projections of 4
    // diagonals of faces and 4 of the cube, 1 + 4/2^1.5 + 4/3^1.5 = 3.2 springs
    const double stiffness = youngModulus * o.cell * o.cell / 3.2;
    return node<Name>(
        RegularGridTopology{.n = o.grid},
        MechanicalObject<Vec3d>{o.volume.positions},
        UniformMass<Vec3d>{.totalMass = 1000 * o.volumeOfSkin},
        RegularGridSpringForceField<Vec3d>{.stiffness = stiffness, .damping = viscosity * stiffness},
        FixedConstraint<Vec3d>{.indices = o.fixed},
        children...);
  }
};

/// A skin that follows the organ around it and touches others. Points meet the triangles of other organs and
/// of the same one: these have an outside, and what has gone too far finds back, which edges against edges
/// do not know. (The edges are there, and not active, for points and triangles to leave their own kind to
/// them.) Tool and ribs are thick lines and meet triangles; the wall meets points. `group` is the number of
/// the model of points, and that of the triangles follows.
inline auto skin(sinew::Mesh const& mesh, int group, bool selfCollision, LaparoscopyScene const& s) {
  using namespace sinew;
  MeshTopology topology;
  topology.triangles = mesh.triangles;
  return node<"skin">(topology,
                      MechanicalObject<Vec3d>{mesh.positions},
                      BarycentricMapping<Vec3d, Vec3d>{},
                      PointCollisionModel<Vec3d>{.selfCollision = selfCollision,
                                                 .group = {group},
                                                 .contactStiffness = s.organContact,
                                                 .contactFriction = s.organFriction,
                                                 .contactDamping = s.organDamping},
                      LineCollisionModel<Vec3d>{.active = false},
                      TriangleCollisionModel<Vec3d>{.selfCollision = selfCollision,
                                                    .group = {group + 1},
                                                    .contactStiffness = s.organContact,
                                                    .contactFriction = s.organFriction,
                                                    .contactDamping = s.organDamping});
}

/// Liver and intestines in the abdomen, the ribs over them, and a tool that a script moves. `Organs`:
/// FemOrgans or GridOrgans, with the bodies made for it.
template <class Organs, class Manager = sinew::DefaultContactManager,
          class Matrix = sinew::CompressedRowSparseMatrixMat3x3d>
auto laparoscopy_scene(LaparoscopyBodies const& b, LaparoscopyScene const& s = {}) {
  using namespace sinew;
  MeshTopology wall, ribs, shaft;
  wall.triangles = b.wall.triangles;
  ribs.edges = b.ribs.edges;
  Vec3d::VecCoord ofShaft;
  for (int i = 0; i <= 12; ++i) ofShaft.push_back({0, 0, 0.02 * i});
  for (int i = 0; i < 12; ++i) shaft.edges.push_back({i, i + 1});
  auto movement = LaparoscopyScript::trajectory(s.period);
  return Simulation{node<"root">(
      Gravity{{0, 0, -s.gravity}},
      DefaultPipeline{},
      BruteForceBroadPhase{},
      BVHNarrowPhase{},
      MinProximityIntersection{.alarmDistance = s.alarmDistance, .contactDistance = s.contactDistance},
      Manager{},
      node<"organs">(
          Organs::solver(s),
          CGLinearSolver<Matrix>{.iterations = s.iterations, .tolerance = 1e-6},
          Organs::template organ<"liver">(
              b.liver, s.liverModulus, s.viscosity, skin(b.liver.skin, 1, false, s)),
          Organs::template organ<"intestines">(
              b.intestines,
              s.intestineModulus,
              s.viscosity,
              RestShapeSpringsForceField<Vec3d>{.points = b.intestines.tethered, .stiffness = {s.mesentery}},
              skin(b.intestines.skin, 3, true, s))),
      node<"wall">(wall,
                   MechanicalObject<Vec3d>{b.wall.positions},
                   TriangleCollisionModel<Vec3d>{.moving = false,
                                                 .simulated = false,
                                                 .bothSide = false,
                                                 .group = {2, 4},
                                                 .contactStiffness = s.wallContact}),
      node<"ribs">(ribs,
                   MechanicalObject<Vec3d>{b.ribs.positions},
                   LineCollisionModel<Vec3d>{.moving = false,
                                             .simulated = false,
                                             .group = {1, 3},
                                             .proximity = 0.005,
                                             .contactStiffness = s.toolContact}),
      node<"tool">(MechanicalObject<Rigid3d>{.position = {movement.positions.front()}},
                   ReadState<Rigid3d>{.loop = true,
                                      .keyTimes = movement.times,
                                      .keyPositions = movement.positions,
                                      .interpolation = Interpolation::cubic},
                   node<"shaft">(shaft,
                                 MechanicalObject<Vec3d>{ofShaft},
                                 RigidMapping<Rigid3d, Vec3d>{},
                                 LineCollisionModel<Vec3d>{.simulated = false,
                                                           .group = {1, 3},
                                                           .proximity = 0.004,
                                                           .contactStiffness = s.toolContact,
                                                           .contactFriction = 0.1})))};
}

}  // namespace examples
