// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/spring_network.hpp>
#include <sinew/topology/element_checks.hpp>

#include <optional>
#include <vector>

namespace sinew {

/// Springs between all pairs of points of each element of the topology, one kind after the other from edges
/// to hexahedra; two points get one spring, of the first kind that joins them. Edges, triangles and quads
/// that the topology does not list are those of its higher elements, as in SOFA's containers; pyramids and
/// prisms have no other springs than these, and elements of second order are refused. A stiffness is a force
/// per relative extension [N]: a spring of length L has stiffness / L [N/m].
template <class D>
struct MeshSpringForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "MeshSpringForceField";

  double stiffness = 0, damping = 0;
  std::optional<double> linesStiffness{}, linesDamping{}, trianglesStiffness{}, trianglesDamping{},
      quadsStiffness{}, quadsDamping{}, tetrahedraStiffness{}, tetrahedraDamping{}, cubesStiffness{},
      cubesDamping{};
  bool noCompression = false;

  static constexpr auto fields() {
    using F = MeshSpringForceField;
    constexpr Range r = range::nonNegative;
    constexpr std::string_view unit = "N", rate = "N s";
    return field_list(
        field("stiffness",
              &F::stiffness,
              unit,
              "force per relative extension, of all kinds without their own",
              r),
        field("damping", &F::damping, rate, "force per rate of relative extension, likewise", r),
        field("linesStiffness", &F::linesStiffness, unit, "stiffness along edges", r),
        field("linesDamping", &F::linesDamping, rate, "damping along edges", r),
        field("trianglesStiffness", &F::trianglesStiffness, unit, "stiffness within triangles", r),
        field("trianglesDamping", &F::trianglesDamping, rate, "damping within triangles", r),
        field("quadsStiffness", &F::quadsStiffness, unit, "stiffness within quads", r),
        field("quadsDamping", &F::quadsDamping, rate, "damping within quads", r),
        field("tetrahedraStiffness", &F::tetrahedraStiffness, unit, "stiffness within tetrahedra", r)
            .also("tetrasStiffness"),
        field("tetrahedraDamping", &F::tetrahedraDamping, rate, "damping within tetrahedra", r)
            .also("tetrasDamping"),
        field("cubesStiffness", &F::cubesStiffness, unit, "stiffness within hexahedra", r),
        field("cubesDamping", &F::cubesDamping, rate, "damping within hexahedra", r),
        field("noCompression", &F::noCompression, "", "springs act only when they are longer than at rest")
            .also("elongationOnly"));
  }

  using Driver = typename SpringNetwork<D>::Driver;
  Driver driver{};
  bool none = false;  // no spring

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<MeshSpringForceField>());
    TopologyView const& t = context.topology;
    detail::check_elements(where, t, context.rest.size());
    check_first_order(where, t);

    SpringNetwork<D> springs(context.rest);
    const double ks = linesStiffness.value_or(stiffness), kd = linesDamping.value_or(damping);
    if (!t.edges.empty()) {
      springs.addAll(t.edges, ks, kd);
    } else {
      springs.addAll(t.triangles, ks, kd);
      springs.addSome(t.quads, quad_edges, ks, kd);
      springs.addAll(t.tetrahedra, ks, kd);
      springs.addSome(t.hexahedra, hexahedron_edges, ks, kd);
      springs.addSome(t.pyramids, pyramid_edges, ks, kd);
      springs.addSome(t.prisms, prism_edges, ks, kd);
    }
    // the edges of the triangles of tetrahedra are those of the tetrahedra
    const double ts = trianglesStiffness.value_or(stiffness), td = trianglesDamping.value_or(damping);
    if (!t.triangles.empty())
      springs.addAll(t.triangles, ts, td);
    else
      springs.addAll(t.tetrahedra, ts, td);
    const double qs = quadsStiffness.value_or(stiffness), qd = quadsDamping.value_or(damping);
    if (!t.quads.empty()) {
      springs.addAll(t.quads, qs, qd);
    } else {
      springs.addSome(t.hexahedra, hexahedron_edges, qs, qd);
      springs.addSome(t.hexahedra, hexahedron_face_diagonals, qs, qd);
      springs.addSome(t.pyramids, pyramid_face_diagonals, qs, qd);
      springs.addSome(t.prisms, prism_face_diagonals, qs, qd);
    }
    springs.addAll(
        t.tetrahedra, tetrahedraStiffness.value_or(stiffness), tetrahedraDamping.value_or(damping));
    springs.addAll(t.hexahedra, cubesStiffness.value_or(stiffness), cubesDamping.value_or(damping));
    none = springs.empty();
    springs.init(driver, noCompression);
  }
  /// The warning of init; empty for none.
  std::string_view warning() const {
    return none ? "there is no spring, so that points move freely; give the node a topology with edges or "
                  "higher elements, and set a stiffness or damping of their kind"
                : "";
  }
};

}  // namespace sinew
