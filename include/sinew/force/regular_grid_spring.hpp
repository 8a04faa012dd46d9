// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/spring_network.hpp>

#include <optional>

namespace sinew {

/// Springs along the lines and diagonals of a regular grid: lines between neighbours, both diagonals of each
/// face (quads) and the four through each cell (cubes). Where the topology has hexahedra and is no grid,
/// those of its hexahedra. A stiffness is a force per relative extension [N]: a spring of length L has
/// stiffness / L [N/m].
template <class D>
struct RegularGridSpringForceField {
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "RegularGridSpringForceField";

  double stiffness = 100, damping = 5;
  std::optional<double> linesStiffness{}, linesDamping{}, quadsStiffness{}, quadsDamping{}, cubesStiffness{},
      cubesDamping{};
  bool elongationOnly = false;

  static constexpr auto fields() {
    using F = RegularGridSpringForceField;
    constexpr Range r = range::nonNegative;
    constexpr std::string_view unit = "N", rate = "N s";
    return field_list(
        field("stiffness",
              &F::stiffness,
              unit,
              "force per relative extension, of all kinds without their own",
              r),
        field("damping", &F::damping, rate, "force per rate of relative extension, likewise", r),
        field("linesStiffness", &F::linesStiffness, unit, "stiffness between neighbours", r),
        field("linesDamping", &F::linesDamping, rate, "damping between neighbours", r),
        field("quadsStiffness", &F::quadsStiffness, unit, "stiffness of diagonals of faces", r),
        field("quadsDamping", &F::quadsDamping, rate, "damping of diagonals of faces", r),
        field("cubesStiffness", &F::cubesStiffness, unit, "stiffness of diagonals of cells", r),
        field("cubesDamping", &F::cubesDamping, rate, "damping of diagonals of cells", r),
        field("elongationOnly", &F::elongationOnly, "", "springs act only when they are longer than at rest")
            .also("noCompression"));
  }

  using Driver = typename SpringNetwork<D>::Driver;
  Driver driver{};
  bool none = false;  // no spring

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<RegularGridSpringForceField>());
    TopologyView const& t = context.topology;
    SpringNetwork<D> springs(context.rest);
    if (t.grid[0] > 0) {
      if (std::size_t(t.grid[0]) * std::size_t(t.grid[1]) * std::size_t(t.grid[2]) > context.rest.size())
        throw Error(where,
                    text("the grid has ",
                         t.grid[0],
                         " x ",
                         t.grid[1],
                         " x ",
                         t.grid[2],
                         " points, but the state has ",
                         context.rest.size(),
                         "; give it the positions of the grid, or none"));
      addGrid(springs, t.grid);
    } else {
      detail::check_indices(where, "hexahedron", t.hexahedra, context.rest.size());
      springs.addSome(t.hexahedra, hexahedron_edges, lines().stiffness, lines().damping);
      springs.addSome(t.hexahedra, hexahedron_face_diagonals, quads().stiffness, quads().damping);
      springs.addSome(t.hexahedra, hexahedron_diagonals, cubes().stiffness, cubes().damping);
    }
    none = springs.empty();
    springs.init(driver, elongationOnly);
  }
  /// The warning of init; empty for none.
  std::string_view warning() const {
    return none ? "there is no spring, so that it has no force; give the node a regular grid of at least two "
                  "points, or hexahedra, and set a stiffness or damping"
                : "";
  }

 private:
  struct Material {
    double stiffness, damping;
  };
  Material lines() const { return {linesStiffness.value_or(stiffness), linesDamping.value_or(damping)}; }
  Material quads() const { return {quadsStiffness.value_or(stiffness), quadsDamping.value_or(damping)}; }
  Material cubes() const { return {cubesStiffness.value_or(stiffness), cubesDamping.value_or(damping)}; }

  void addGrid(SpringNetwork<D>& springs, std::array<int, 3> n) const {
    // between the points of each cell at p and p + d, for all p where both are in the grid
    auto add = [&](std::array<int, 3> d, Material m) {
      if (m.stiffness == 0 && m.damping == 0) return;
      std::array<int, 3> low, high;
      for (std::size_t a = 0; a < 3; ++a) low[a] = d[a] < 0 ? 1 : 0, high[a] = n[a] - (d[a] > 0 ? 1 : 0);
      for (int z = low[2]; z < high[2]; ++z)
        for (int y = low[1]; y < high[1]; ++y)
          for (int x = low[0]; x < high[0]; ++x) {
            const int i = x + n[0] * (y + n[1] * z);
            springs.add(i, i + d[0] + n[0] * (d[1] + n[1] * d[2]), m.stiffness, m.damping);
          }
    };
    for (std::array<int, 3> d : {std::array{1, 0, 0}, std::array{0, 1, 0}, std::array{0, 0, 1}})
      add(d, lines());
    for (std::array<int, 3> d : {std::array{1, 1, 0},
                                 std::array{-1, 1, 0},
                                 std::array{1, 0, 1},
                                 std::array{-1, 0, 1},
                                 std::array{0, 1, 1},
                                 std::array{0, -1, 1}})
      add(d, quads());
    for (std::array<int, 3> d :
         {std::array{1, 1, 1}, std::array{-1, 1, 1}, std::array{1, -1, 1}, std::array{1, 1, -1}})
      add(d, cubes());
  }
};

}  // namespace sinew
