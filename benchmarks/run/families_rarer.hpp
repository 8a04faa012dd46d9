// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "families_of.hpp"

#include <sinew/force/angular_spring.hpp>
#include <sinew/force/beam_fem.hpp>
#include <sinew/force/conical_force_field.hpp>
#include <sinew/force/constant_force.hpp>
#include <sinew/force/diagonal_velocity_damping.hpp>
#include <sinew/force/element_pressure.hpp>
#include <sinew/force/ellipsoid_force_field.hpp>
#include <sinew/force/frame_spring.hpp>
#include <sinew/force/joint_spring.hpp>
#include <sinew/force/polynomial_rest_shape_springs.hpp>
#include <sinew/force/prism_fem.hpp>
#include <sinew/force/pyramid_fem.hpp>
#include <sinew/force/quad_bending_fem.hpp>
#include <sinew/force/quadratic_hexahedron_fem.hpp>
#include <sinew/force/quadratic_tetrahedron_fem.hpp>
#include <sinew/force/sphere_force_field.hpp>
#include <sinew/force/tait_surface_pressure.hpp>
#include <sinew/force/tetrahedron_diffusion.hpp>
#include <sinew/force/tetrahedron_reaction.hpp>
#include <sinew/force/torsion_force_field.hpp>
#include <sinew/force/triangular_biquadratic_springs.hpp>
#include <sinew/force/triangular_quadratic_springs.hpp>
#include <sinew/force/triangular_shell.hpp>
#include <sinew/force/triangular_tensor_mass.hpp>
#include <sinew/force/triquadratic_hexahedron_fem.hpp>
#include <sinew/force/uniform_velocity_damping.hpp>
#include <sinew/force/vector_spring.hpp>
#include <sinew/mapping/area_mapping.hpp>
#include <sinew/mapping/distance_mapping.hpp>
#include <sinew/mapping/skinning_mapping.hpp>
#include <sinew/mapping/tubular_mapping.hpp>
#include <sinew/mapping/volume_mapping.hpp>
#include <sinew/topology/quadratic_elements.hpp>

#include <algorithm>
#include <numeric>

namespace bench {

/// Prisms, pyramids and elements of second order over the points of a Body; these of blocks of 2 x 2 x 2
/// cells.
struct RarerElements {
  std::vector<Prism> prisms{};
  std::vector<Pyramid> pyramids{};
  std::vector<QuadraticTetrahedron> quadraticTetrahedra{};
  std::vector<QuadraticHexahedron> quadraticHexahedra{};
  std::vector<TriquadraticHexahedron> triquadraticHexahedra{};

  template <class D>
  explicit RarerElements(Body<D> const& body) {
    constexpr int n = Body<D>::n, half = (n + 1) / 2;
    for (auto const& h : body.hexahedra.hexahedra) {
      prisms.push_back({h[0], h[1], h[3], h[4], h[5], h[7]});
      prisms.push_back({h[1], h[2], h[3], h[5], h[6], h[7]});
      // a cube is three pyramids over the faces that do not touch one of its corners
      pyramids.push_back({h[0], h[1], h[2], h[3], h[6]});
      pyramids.push_back({h[0], h[4], h[5], h[1], h[6]});
      pyramids.push_back({h[0], h[3], h[7], h[4], h[6]});
    }
    auto fine = [](Index coarse) {
      const Index i = coarse % half, j = coarse / half % half, k = coarse / (half * half);
      return 2 * (i + n * (j + n * k));
    };
    for (auto const& t : regular_grid_tetrahedra(half, half, half, {0, 0, 0}, {1, 1, 1}).tetrahedra) {
      auto& e = quadraticTetrahedra.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) e[c] = fine(t[c]);
      for (auto const& [i, j, middle] : detail::quadraticTetrahedronEdges) e[middle] = (e[i] + e[j]) / 2;
    }
    for (int k = 0; k + 2 < n; k += 2)
      for (int j = 0; j + 2 < n; j += 2)
        for (int i = 0; i + 2 < n; i += 2) {
          auto& e = triquadraticHexahedra.emplace_back();
          for (std::size_t c = 0; c < 27; ++c) {
            auto const& at = detail::triquadraticPlaces.at[c];
            e[c] = i + 1 + int(at[0]) + n * (j + 1 + int(at[1]) + n * (k + 1 + int(at[2])));
          }
          std::copy_n(e.begin(), 20, quadraticHexahedra.emplace_back().begin());
        }
  }
};

/// Elements and loads that fewer scenes have.
template <class D>
std::vector<Work> rarer_forces() {
  std::vector<Work> list;
  auto body = std::make_shared<Body<D>>();
  auto const& b = *body;
  const RarerElements rarer(b);
  TopologyView solids{.positions = b.hexahedra.positions};
  solids.prisms = rarer.prisms, solids.pyramids = rarer.pyramids;
  solids.quadraticTetrahedra = rarer.quadraticTetrahedra;
  solids.quadraticHexahedra = rarer.quadraticHexahedra;
  solids.triquadraticHexahedra = rarer.triquadraticHexahedra;
  const TopologyView quads{.positions = b.hexahedra.positions, .quads = b.quads};

  add_force(list, "prism FEM", PrismFEMForceField<D>{}, solids, body);
  add_force(list, "pyramid FEM", PyramidFEMForceField<D>{}, solids, body);
  add_force(list, "tetrahedron of ten nodes FEM", QuadraticTetrahedronFEMForceField<D>{}, solids, body);
  add_force(list, "hexahedron of 20 nodes FEM", QuadraticHexahedronFEMForceField<D>{}, solids, body);
  add_force(list, "hexahedron of 27 nodes FEM", TriquadraticHexahedronFEMForceField<D>{}, solids, body);
  add_force(list, "triangle, tensor mass", TriangularTensorMassForceField<D>{}, b.surfaces(), body);
  add_force(
      list, "triangle, quadratic springs", TriangularQuadraticSpringsForceField<D>{}, b.surfaces(), body);
  add_force(
      list, "triangle, biquadratic springs", TriangularBiquadraticSpringsForceField<D>{}, b.surfaces(), body);
  add_force(list, "bending springs, linear", FastTriangularBendingSprings<D>{}, b.surfaces(), body);
  add_force(list, "quad plate FEM", QuadBendingFEMForceField<D>{}, quads, body);
  auto hyperelastic = [&](std::string name, HyperelasticMaterial material, std::vector<double> parameters) {
    TetrahedronHyperelasticityFEMForceField<D> force{.materialName = material, .parameterSet = parameters};
    if (material == HyperelasticMaterial::HolzapfelGasserOgden) force.anisotropyDirections = {{1, 0, 0}};
    add_force(list, "hyperelastic, " + name, std::move(force), b.volumes(false), body);
  };
  using Material = HyperelasticMaterial;
  hyperelastic("Arruda-Boyce", Material::ArrudaBoyce, {1000, 2000});
  hyperelastic("stable Neo-Hookean", Material::StableNeoHookean, {1000, 2000});
  hyperelastic("Veronda-Westman", Material::VerondaWestman, {1000, 1, 2000});
  hyperelastic("Costa", Material::Costa, {1000, 2000, 8, 4, 4, 3, 3, 3});
  hyperelastic(
      "Holzapfel-Gasser-Ogden, one family", Material::HolzapfelGasserOgden, {1000, 2000, 500, 2, 0.1});

  const std::size_t points = b.rest.size();
  add_force(list, "vector springs", VectorSpringForceField<D>{.useTopology = true}, b.lines(), body);
  add_force(
      list,
      "polynomial springs to rest places",
      PolynomialRestShapeSpringsForceField<D>{.polynomialStiffness = {100, 10}, .polynomialDegree = {2}},
      {},
      body);
  add_force(list, "sphere penalty", SphereForceField<D>{.radius = 0.7}, {}, body);
  add_force(list, "ellipsoid penalty", EllipsoidForceField<D>{}, {}, body);
  add_force(list, "cone penalty", ConicalForceField<D>{}, {}, body);
  std::vector<int> all(points), faces(b.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  std::iota(faces.begin(), faces.end(), 0);
  add_force(list,
            "load on triangles, a point",
            TrianglePressureForceField<D>{.pressure = D::Deriv::Constant(1), .pressedElements = faces},
            b.surfaces(),
            body,
            points,
            false);
  add_force(list,
            "constant force",
            ConstantForceField<D>{.totalForce = D::Deriv::Constant(1)},
            {},
            body,
            points,
            false);
  add_force(list,
            "torque",
            TorsionForceField<D>{.indices = all, .torque = 1, .axis = {0, 0, 1}},
            {},
            body,
            points,
            false);
  add_force(list,
            "velocity damping",
            UniformVelocityDampingForceField<D>{.dampingCoefficient = 1, .implicit = true},
            {},
            body,
            points);
  add_force(list,
            "velocity damping, an axis each",
            DiagonalVelocityDampingForceField<D>{.dampingCoefficient = {D::Deriv::Constant(1)}},
            {},
            body,
            points);
  return list;
}

/// Beams, shells and springs between rigid frames, which stand where the points of a Body do.
template <class D>
std::vector<Work> frame_forces() {
  using Real = typename D::Real;
  std::vector<Work> list;
  const Body<VecTypes<3, Real>> places;
  auto state = std::make_shared<State<D>>();
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    typename D::Coord frame{};
    frame.center = places.rest[i];
    state->rest.push_back(frame);
    frame.center = places.x[i];
    frame.orientation = Eigen::Quaternion<Real>(Real(1), Real(0.01), Real(0.02), Real(0.01)).normalized();
    state->x.push_back(frame);
  }
  state->v.assign(state->x.size(), D::Deriv::Constant(Real(1e-3)));
  state->f.assign(state->x.size(), D::Deriv::Zero());
  auto add = [&](std::string family, auto force, TopologyView const& topology) {
    add_force(list, family, std::move(force), InitContext<D>{"benchmark", state->rest, topology}, state);
  };
  add("beam FEM", BeamFEMForceField<D>{}, places.lines());
  add("triangular shell FEM", TriangularShellForceField<D>{}, places.surfaces());
  JointSpringForceField<D> joints;
  FrameSpringForceField<D> springs;
  for (auto const& [a, c] : places.edges) {
    joints.springs.push_back({.first = a, .second = c});
    springs.springs.push_back(
        {.first = a, .second = c, .stiffnessTranslation = 100, .stiffnessRotation = 10, .damping = 1});
  }
  add("joints", std::move(joints), {});
  add("springs between frames", std::move(springs), {});
  std::vector<int> turning(places.x.size());
  std::iota(turning.begin(), turning.end(), 0);
  add("springs against turning", AngularSpringForceField<D>{.indices = turning}, {});
  return list;
}

/// What goes on in temperatures and potentials over the tetrahedra of a Body.
template <class D>
std::vector<Work> scalar_forces() {
  using Real = typename D::Real;
  std::vector<Work> list;
  const Body<VecTypes<3, Real>> body;
  auto state = std::make_shared<State<D>>();
  for (auto const& x : body.x) state->x.push_back(typename D::Coord(x[0]));
  state->rest = state->x;
  state->v.assign(state->x.size(), D::Deriv::Constant(Real(1e-3)));
  state->f.assign(state->x.size(), D::Deriv::Zero());
  const TopologyView tetrahedra = body.volumes(false);
  InitContext<D> context{"benchmark", state->rest, tetrahedra};
  context.body = body.hexahedra.positions;
  add_force(list, "tetrahedron, diffusion", TetrahedronDiffusionFEMForceField<D>{}, context, state);
  add_force(list,
            "reaction in tetrahedra, a point",
            TetrahedronReactionFEMForceField<D>{.parameterSet = {1}},
            context,
            state,
            state->x.size());
  return list;
}

/// Mappings of frames to points, and of points to their measures.
template <class D>
std::vector<Work> rarer_mappings() {
  using Real = typename D::Real;
  using Frames = RigidTypes<3, Real>;
  using Scalars = VecTypes<1, Real>;
  std::vector<Work> list;
  const Body<D> body;
  auto measured = [&]<class Mapping>(
                      Mapping mapping, std::string family, TopologyView const& topology, std::size_t count) {
    add_mapping(list, family, std::move(mapping), body.x, topology, typename Scalars::VecCoord(count));
  };
  measured(DistanceMapping<D, Scalars>{}, "lengths of edges", body.lines(), body.edges.size());
  measured(AreaMapping<D, Scalars>{}, "areas of triangles", body.surfaces(), body.triangles.size());
  measured(VolumeMapping<D, Scalars>{},
           "volumes of tetrahedra",
           body.volumes(false),
           body.tetrahedra.tetrahedra.size());
  typename Frames::VecCoord frames(16);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].center = body.rest[i * 80];
  add_mapping(list, "skinning, four frames", SkinningMapping<Frames, D>{}, frames, {}, body.rest);
  add_mapping(list,
              "tubes around frames",
              TubularMapping<Frames, D>{.nbPointsOnEachCircle = 64, .radius = 0.1},
              frames,
              {},
              typename D::VecCoord(64 * frames.size()));
  return list;
}

/// All forces, of points in space, rigid frames and scalars.
template <class Points, class Frames, class Scalars>
std::vector<Work> all_forces() {
  std::vector<Work> all;
  for (auto&& list :
       {forces<Points>(), rarer_forces<Points>(), frame_forces<Frames>(), scalar_forces<Scalars>()})
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace bench
