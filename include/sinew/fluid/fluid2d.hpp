// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/immersed_body.hpp>
#include <sinew/fluid/grid_component.hpp>
#include <sinew/fluid/grid_fluid.hpp>

#include <string>
#include <vector>

namespace sinew {

/// An incompressible fluid in a rectangle of cells across the z axis, with a free surface: Fluid3D in two
/// dimensions, with the names of SOFA's Fluid2D. The rectangle is around `center`; the cells at its border
/// are its walls.
template <class D = Vec2d>
struct Fluid2D {
  using Role = role::BehaviorModel;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(
      !D::rigid && D::size == 2,
      "Sinew: a Fluid2D is in cells of the plane; take Vec2d, Vec2f, or CudaVec2d or CudaVec2f on a GPU.");
  static constexpr std::string_view className = "Fluid2D", header = "sinew/fluid/fluid2d.hpp";
  using Grid = fluid::GridFluid<Real, 2, fluid::GridLoops<D>>;

  int nx = 16, ny = 16;
  double cellwidth = 1;
  Eigen::Vector3d center{0, 0, 0};
  double height = 5;
  Eigen::Vector2d dir{0, 1};
  double tstart = 0, tstop = 60;
  double density = 1000, viscosity = 0;
  fluid::Walls walls = fluid::Walls::slip;
  fluid::Advection advection = fluid::Advection::macCormack;
  std::vector<Vec<double, 4>> obstacle{};
  Eigen::Vector2d source{0, 0};
  double sourceRadius = 0;
  Eigen::Vector2d sourceVelocity{0, 0};
  bool keepVolume = true;
  double tolerance = 1e-6;
  int iterations = 100;

  static constexpr auto fields() {
    using F = Fluid2D;
    return fluid::grid_component_fields<F>(
        "solid boxes, by two corners each: xmin ymin xmax ymax; cells whose centres are inside are "
        "solid",
        field("nx", &F::nx, "", "cells along x, with the two of the walls", range::atLeast(3)),
        field("ny", &F::ny, "", "cells along y, with the two of the walls", range::atLeast(3)));
  }

  /// Velocity, surface and pressure (GridFluid::save).
  typename Grid::Field flow{};
  static constexpr auto state() {
    return field_list(
        field("flow",
              &Fluid2D::flow,
              "",
              "velocity [m/s], distances from the surface [cells], pressure times dt over "
              "density and cellwidth [m/s], of all cells; cells along each axis, dt [s], volume [cells]"));
  }

  /// Solids that the next step meets, which the scene gives it, and what the last did to them.
  std::vector<ImmersedBody> bodies{};
  void reserveForBodies();

  // after init
  Grid grid{};
  std::string where{};

  /// Throws Error where the settings are wrong, and where there is no fluid.
  void init(std::string const& path);
  void reset();
  template <class Workers>
  void step(StepAhead const& ahead, Eigen::Vector3d const& gravity, Workers const& workers) {
    advance(ahead, gravity, some_workers(workers));
  }
  void advance(StepAhead const& ahead, Eigen::Vector3d const& gravity, SomeWorkers workers);
  /// [J], of a metre across the plane.
  double kineticEnergy();
  /// - rho g.x summed up over the fluid [J], of a metre across the plane.
  double gravityEnergy(Eigen::Vector3d const& gravity);
  /// Of the fluid [m^2].
  double volume();
  std::string_view notice() const;
  /// What is seen of it: edges around the fluid.
  Mesh border() const;
};

template <class D>
void Fluid2D<D>::init(std::string const& path) {
  where = text(path, ": ", component_name<Fluid2D>());
  fluid::start<2>(*this, where);
}
template <class D>
void Fluid2D<D>::reserveForBodies() {
  fluid::with_bodies(*this, [&] { grid.reserveForBodies(); });
}
template <class D>
void Fluid2D<D>::reset() {
  flow.clear();
  fluid::start<2>(*this, where);
}
template <class D>
void Fluid2D<D>::advance(StepAhead const& ahead, Eigen::Vector3d const& gravity, SomeWorkers workers) {
  fluid::advance<2>(*this, ahead, gravity, workers);
}
template <class D>
double Fluid2D<D>::kineticEnergy() {
  return grid.kineticEnergy();
}
template <class D>
double Fluid2D<D>::gravityEnergy(Eigen::Vector3d const& gravity) {
  return grid.gravityEnergy(gravity.head<2>());
}
template <class D>
double Fluid2D<D>::volume() {
  return grid.volume();
}
template <class D>
std::string_view Fluid2D<D>::notice() const {
  return fluid::notice_of(grid);
}
template <class D>
Mesh Fluid2D<D>::border() const {
  Mesh mesh = grid.border();
  for (Eigen::Vector3d& position : mesh.positions) position[2] = center[2];
  return mesh;
}

#if !SINEW_DEFINES
extern template struct Fluid2D<Vec2d>;
extern template struct Fluid2D<Vec2f>;
#endif

}  // namespace sinew
