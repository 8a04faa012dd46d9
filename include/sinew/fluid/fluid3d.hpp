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

/// An incompressible fluid in a box of cells, with a free surface:
///   du/dt + (u.grad) u = g + mu / rho Laplacian u - grad p / rho,   div u = 0
/// on a staggered grid (fluid/grid_fluid.hpp), with the names of SOFA's Fluid3D. The box is around `center`;
/// as in SOFA, the cells at its border are its walls, so that nx - 2 cells along x have fluid. It has a state
/// of its own: no solver, mass or state is needed. SOFA's fluid always has a source; here a source has a
/// radius. Threads share the work; over the DataTypes of a device it is there that the fluid is stepped.
template <class D = Vec3d>
struct Fluid3D {
  using Role = role::BehaviorModel;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(
      !D::rigid && D::size == 3,
      "Sinew: a Fluid3D is in cells in space; take Vec3d, Vec3f, or CudaVec3d or CudaVec3f on a GPU.");
  static constexpr std::string_view className = "Fluid3D", header = "sinew/fluid/fluid3d.hpp";
  using Grid = fluid::GridFluid<Real, 3, fluid::GridLoops<D>>;

  int nx = 16, ny = 16, nz = 16;
  double cellwidth = 1;
  Eigen::Vector3d center{0, 0, 0};
  double height = 5;
  Eigen::Vector3d dir{0, 1, 0};
  double tstart = 0, tstop = 60;
  double density = 1000, viscosity = 0;
  fluid::Walls walls = fluid::Walls::slip;
  fluid::Advection advection = fluid::Advection::macCormack;
  std::vector<Vec<double, 6>> obstacle{};
  Eigen::Vector3d source{0, 0, 0};
  double sourceRadius = 0;
  Eigen::Vector3d sourceVelocity{0, 0, 0};
  bool keepVolume = true;
  double tolerance = 1e-6;
  int iterations = 100;

  static constexpr auto fields() {
    using F = Fluid3D;
    return fluid::grid_component_fields<F>(
        "solid boxes, by two corners each: xmin ymin zmin xmax ymax zmax; cells whose centres are "
        "inside are solid",
        field("nx", &F::nx, "", "cells along x, with the two of the walls", range::atLeast(3)),
        field("ny", &F::ny, "", "cells along y, with the two of the walls", range::atLeast(3)),
        field("nz", &F::nz, "", "cells along z, with the two of the walls", range::atLeast(3)));
  }

  /// Velocity, surface and pressure (GridFluid::save).
  typename Grid::Field flow{};
  static constexpr auto state() {
    return field_list(
        field("flow",
              &Fluid3D::flow,
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
  /// [J].
  double kineticEnergy();
  /// - rho g.x summed up over the fluid [J].
  double gravityEnergy(Eigen::Vector3d const& gravity);
  /// Of the fluid [m^3].
  double volume();
  std::string_view notice() const;
  /// What is seen of it: quads around the fluid.
  Mesh border() const;
};

template <class D>
void Fluid3D<D>::init(std::string const& path) {
  where = text(path, ": ", component_name<Fluid3D>());
  fluid::start<3>(*this, where);
}
template <class D>
void Fluid3D<D>::reserveForBodies() {
  fluid::with_bodies(*this, [&] { grid.reserveForBodies(); });
}
template <class D>
void Fluid3D<D>::reset() {
  flow.clear();
  fluid::start<3>(*this, where);
}
template <class D>
void Fluid3D<D>::advance(StepAhead const& ahead, Eigen::Vector3d const& gravity, SomeWorkers workers) {
  fluid::advance<3>(*this, ahead, gravity, workers);
}
template <class D>
double Fluid3D<D>::kineticEnergy() {
  return grid.kineticEnergy();
}
template <class D>
double Fluid3D<D>::gravityEnergy(Eigen::Vector3d const& gravity) {
  return grid.gravityEnergy(gravity.head<3>());
}
template <class D>
double Fluid3D<D>::volume() {
  return grid.volume();
}
template <class D>
std::string_view Fluid3D<D>::notice() const {
  return fluid::notice_of(grid);
}
template <class D>
Mesh Fluid3D<D>::border() const {
  return grid.border();
}

#if !SINEW_DEFINES
extern template struct Fluid3D<Vec3d>;
extern template struct Fluid3D<Vec3f>;
#endif

}  // namespace sinew
