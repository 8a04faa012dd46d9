// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "families.hpp"

#include <sinew/core/element_force.hpp>
#include <sinew/force/bending_springs.hpp>
#include <sinew/force/fast_triangular_bending_springs.hpp>
#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/mesh_spring.hpp>
#include <sinew/force/plane_force_field.hpp>
#include <sinew/force/rest_shape_springs.hpp>
#include <sinew/force/surface_pressure.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>
#include <sinew/force/tetrahedron_viscoelasticity.hpp>
#include <sinew/force/triangle_fem.hpp>
#include <sinew/linalg/preconditioner.hpp>
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/mesh_matrix_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/state/vector_operations.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <cmath>
#include <memory>

namespace bench {

using namespace sinew;

/// What the vectors of a state hold.
template <class D>
struct State {
  typename D::VecCoord rest{}, x{};
  typename D::VecDeriv v{}, f{};
};

/// A block of 11 x 11 x 11 points, strained by some hundredths.
template <class D>
struct Body : State<D> {
  using State<D>::rest, State<D>::x, State<D>::v, State<D>::f;
  static constexpr int n = 11;
  Mesh hexahedra = regular_grid(n, n, n, {0, 0, 0}, {1, 1, 1});
  Mesh tetrahedra = regular_grid_tetrahedra(n, n, n, {0, 0, 0}, {1, 1, 1});
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};

  Body() {
    edges = edges_of(tetrahedra.tetrahedra);
    detail::for_grid_squares({n, n, n}, [&](Index p, Index a, Index b) {
      triangles.push_back({p, p + a, p + a + b});
      triangles.push_back({p, p + a + b, p + b});
      quads.push_back({p, p + a, p + a + b, p + b});
    });
    for (auto const& p : hexahedra.positions) {
      rest.push_back(p.template cast<typename D::Real>());
      const Eigen::Vector3d moved = p + 0.003 * Eigen::Vector3d(std::sin(7 * p[1] + 9 * p[2]),
                                                                std::sin(5 * p[2] + 8 * p[0]),
                                                                std::sin(6 * p[0] + 7 * p[1]));
      x.push_back(moved.template cast<typename D::Real>());
      v.push_back((moved - p).template cast<typename D::Real>());
    }
    f.assign(rest.size(), D::Deriv::Zero());
  }
  TopologyView volumes(bool cubes) const {
    TopologyView view{.positions = hexahedra.positions};
    if (cubes)
      view.hexahedra = hexahedra.hexahedra;
    else
      view.tetrahedra = tetrahedra.tetrahedra;
    return view;
  }
  TopologyView surfaces() const { return {.positions = hexahedra.positions, .triangles = triangles}; }
  TopologyView lines() const { return {.positions = hexahedra.positions, .edges = edges}; }
};

/// `count`: points of a force that has no driver. What has no derivative is not timed for one.
template <class Force>
void add_force(std::vector<Work>& list, std::string family, Force component,
               InitContext<typename Force::DataTypes> const& context,
               std::shared_ptr<State<typename Force::DataTypes>> state, std::size_t count = 0,
               bool derivative = true) {
  auto force = std::make_shared<Force>(std::move(component));
  force->init(context);
  if constexpr (requires { force->driver; })
    for (auto const& pack : force->driver.packs) count += std::size_t(pack.active);
  const MechanicalParams p{.dt = 0.01, .b = -0.01, .k = -0.0001};
  list.push_back(
      {family, "addForce", count, [=] { sinew::add_force(*force, p, state->f, state->x, state->v); }});
  if (derivative)
    list.push_back({family, "addDForce", count, [=] { sinew::add_dforce(*force, p, state->f, state->v); }});
}
template <class Force>
void add_force(std::vector<Work>& list, std::string family, Force component, TopologyView const& topology,
               std::shared_ptr<Body<typename Force::DataTypes>> body, std::size_t count = 0,
               bool derivative = true) {
  add_force(list,
            std::move(family),
            std::move(component),
            InitContext<typename Force::DataTypes>{"benchmark", body->rest, topology},
            std::shared_ptr<State<typename Force::DataTypes>>(body),
            count,
            derivative);
}

/// Element laws, which run in lanes.
template <class D>
std::vector<Work> forces() {
  std::vector<Work> list;
  auto body = std::make_shared<Body<D>>();
  auto const& b = *body;
  using Material = HyperelasticMaterial;
  add_force(
      list, "springs", MeshSpringForceField<D>{.linesStiffness = 100, .linesDamping = 1}, b.lines(), body);
  add_force(list, "springs to rest places", RestShapeSpringsForceField<D>{}, {}, body);
  add_force(list, "plane penalty", PlaneForceField<D>{.d = 0.5}, {}, body);
  add_force(list, "pressure on triangles", SurfacePressureForceField<D>{.pressure = 1}, b.surfaces(), body);
  add_force(list, "bending springs", TriangularBendingSprings<D>{}, b.surfaces(), body);
  add_force(list, "triangle FEM", TriangleFEMForceField<D>{}, b.surfaces(), body);
  add_force(list, "tetrahedron FEM, large", TetrahedronFEMForceField<D>{}, b.volumes(false), body);
  add_force(list,
            "tetrahedron FEM, nearest",
            TetrahedronFEMForceField<D>{.method = RotationMethod::nearest},
            b.volumes(false),
            body);
  add_force(list, "hexahedron FEM, large", HexahedronFEMForceField<D>{}, b.volumes(true), body);
  auto hyperelastic = [&](std::string name, Material material, std::vector<double> parameters) {
    add_force(
        list,
        "hyperelastic, " + name,
        TetrahedronHyperelasticityFEMForceField<D>{.materialName = material, .parameterSet = parameters},
        b.volumes(false),
        body);
  };
  hyperelastic("Saint Venant-Kirchhoff", Material::StVenantKirchhoff, {1000, 2000});
  hyperelastic("Neo-Hookean", Material::NeoHookean, {1000, 2000});
  hyperelastic("Mooney-Rivlin", Material::MooneyRivlin, {500, 100, 2000});
  hyperelastic("Ogden", Material::Ogden, {1000, 3, 2000});
  add_force(list,
            "viscoelastic, Kelvin-Voigt",
            TetrahedronViscoelasticityFEMForceField<D>{.parameterSet = {1000, 0.1, 2000}},
            b.volumes(false),
            body);
  return list;
}

template <class Mass>
void add_mass(std::vector<Work>& list, std::string family, Mass component, TopologyView const& topology,
              std::shared_ptr<Body<typename Mass::DataTypes>> body) {
  using D = typename Mass::DataTypes;
  auto mass = std::make_shared<Mass>(std::move(component));
  mass->init(InitContext<D>{"benchmark", body->rest, topology});
  const MechanicalParams p{.dt = 0.01, .gravity = {0, -9.81, 0}};
  const std::size_t n = body->rest.size();
  list.push_back({family, "addForce", n, [=] { mass->addForce(p, body->f, body->x, body->v); }});
  list.push_back({family, "addMDx", n, [=] { mass->addMDx(body->f, body->x, body->v, 0.5); }});
}

template <class Mapping>
void add_mapping(std::vector<Work>& list, std::string family, Mapping mapping,
                 typename Mapping::In::VecCoord const& parent, TopologyView const& topology,
                 typename Mapping::Out::VecCoord const& child) {
  using In = typename Mapping::In;
  using Out = typename Mapping::Out;
  struct State {
    Mapping mapping;
    typename In::VecCoord in;
    typename In::VecDeriv force;
    typename Out::VecCoord out;
    typename Out::VecDeriv v;
  };
  auto s = std::make_shared<State>();
  s->mapping = std::move(mapping);
  s->in = parent;
  s->out = child;
  s->force.assign(parent.size(), In::Deriv::Zero());
  s->v.assign(child.size(), Out::Deriv::Constant(typename Out::Real(1e-3)));
  typename Out::VecCoord positions = child;
  s->mapping.init(
      InitContext<In>{"benchmark", s->in, topology}, InitContext<Out>{"benchmark", s->out, {}}, positions);
  list.push_back({family, "apply", child.size(), [=] { s->mapping.apply(s->out, s->in); }});
  list.push_back({family, "applyJT", child.size(), [=] { s->mapping.applyJT(s->force, s->v); }});
}

/// What linear solvers do with vectors, with the assembled matrix of the tetrahedra, and to be
/// preconditioned.
template <class D>
void add_linear(std::vector<Work>& list, std::shared_ptr<Body<D>> body) {
  using Real = typename D::Real;
  using Matrix = CompressedRowSparseMatrix<Real, 3>;
  struct System {
    Matrix matrix;
    Eigen::Matrix<Real, Eigen::Dynamic, 1> p, q;
    double sum;
  };
  auto s = std::make_shared<System>();
  const std::size_t n = body->rest.size();
  s->matrix.startPattern(int(3 * n));
  for (auto const& [i, j] : body->edges) s->matrix.preallocate(3 * i, 3 * j, 3, 3);
  s->matrix.finishPattern();
  // definite, since its diagonal dominates
  std::fill(s->matrix.values.begin(), s->matrix.values.end(), Real(0.01));
  for (int i = 0; i < s->matrix.rows(); ++i)
    for (int c = 0; c < 3; ++c) s->matrix.block(s->matrix.rowStart[std::size_t(i)])[4 * c] = 1;
  s->p.setConstant(Eigen::Index(3 * n + 1), Real(1));
  s->q.setZero(Eigen::Index(3 * n + 1));
  list.push_back({"vectors", "x += f y", n, [=] { vec::peq(body->f, body->v, Real(1e-3)); }});
  list.push_back({"vectors", "dot", n, [=] { s->sum += vec::dot(body->f, body->v); }});
  list.push_back({"matrix of 3 x 3 blocks",
                  "multiply, a block",
                  s->matrix.columns.size() + s->matrix.leftColumns.size(),
                  [=] { s->matrix.multiply(s->p.data(), s->q.data()); }});
  for (const auto method : {PreconditionerMethod::blockJacobi,
                            PreconditionerMethod::ssor,
                            PreconditionerMethod::incompleteCholesky,
                            PreconditionerMethod::ldl}) {
    auto m = std::make_shared<Preconditioner<Matrix>>();
    m->init(s->matrix, method, s->matrix.dofs());
    const std::string family = "preconditioner " + std::string(enum_names(method)[std::size_t(method)]);
    list.push_back({family, "update", n, [=] { m->update(s->matrix); }});
    list.push_back({family, "apply", n, [=] { m->apply(s->p, s->q); }});
  }
}

/// Masses, mappings and vectors: loops over points, which the compiler vectorises or not.
template <class D>
std::vector<Work> points() {
  using Real = typename D::Real;
  using Rigid = RigidTypes<3, Real>;
  std::vector<Work> list;
  auto body = std::make_shared<Body<D>>();
  auto const& b = *body;
  add_mass(list, "uniform mass", UniformMass<D>{.vertexMass = 1}, {}, body);
  add_mass(list, "diagonal mass", DiagonalMass<D>{.massDensity = 1}, b.volumes(false), body);
  add_mass(list, "consistent mass", MeshMatrixMass<D>{.massDensity = {1}}, b.volumes(false), body);
  add_mapping(list, "identity mapping", IdentityMapping<D, D>{}, b.x, {}, b.x);
  add_mapping(list, "barycentric, tetrahedra", BarycentricMapping<D, D>{}, b.rest, b.volumes(false), b.x);
  add_mapping(list, "barycentric, hexahedra", BarycentricMapping<D, D>{}, b.rest, b.volumes(true), b.x);
  add_mapping(list, "rigid mapping", RigidMapping<Rigid, D>{}, {typename Rigid::Coord{}}, {}, b.x);
  add_linear<D>(list, body);
  return list;
}

}  // namespace bench
