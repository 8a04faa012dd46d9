// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/component.hpp>
#include <sinew/solver/dfsph_flow.hpp>
#include <sinew/solver/multi_vec.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// Moves the particles of a fluid that is not compressed, by divergence-free SPH (Bender, Koschier 2017).
/// The mass of a particle over `density` is its volume V_i, and with a kernel W
///   d_i = sum_j V_j W_ij                       density over that at rest
///   D_i = sum_j V_j (v_i - v_j).grad W_ij      its rate [1/s]
///   a_i = -sum_j V_j (k_i + k_j) grad W_ij     acceleration by k = pressure / density >= 0 [m^2/s^2]
/// In a substep h one iteration finds the k that take out the divergence, D <= 0; forces of the node act
/// (gravity, planes, the viscosity and surface tension of an SPHFluidForceField without pressure), XSPH
/// (Monaghan 1989) takes velocities nearer to each other, v_i += xsph sum_j V_j W_ij (v_j - v_i); another one
/// finds the k that take out what would compress the fluid, d + h D <= 1; and the fluid moves, explicit
/// but for its own viscosity (DFSPHFlow), and of first order in h. Both start from the k of the last substep.
/// The step of the scene is divided so that none moves farther than cflFactor times the distance of particles
/// in a substep. Boundary particles of bodies are met as FluidBoundary says.
struct DFSPHSolver {
  using Role = role::OdeSolver;
  static constexpr std::string_view className = "DFSPHSolver";
  static constexpr std::string_view header = "sinew/solver/dfsph.hpp";
  static constexpr bool implicit = false;
  static constexpr int convergenceOrder = 0;
  static constexpr Auxiliary auxiliary{.derivs = 1};

  double radius = 1, density = 1000, viscosity = 0, xsph = 0;
  double maxError = 1e-4, maxErrorV = 1e-3, maxErrorViscosity = 1e-3;
  int maxIterations = 100, maxIterationsV = 100, maxIterationsViscosity = 100;
  bool enableDivergenceSolver = true;
  double cflFactor = 0.4;
  int maxSubsteps = 20;

  static constexpr auto fields() {
    using S = DFSPHSolver;
    return field_list(
        field("radius",
              &S::radius,
              "m",
              "how far particles act on each other: twice their distance",
              range::positive),
        field("density", &S::density, "kg/m^3", "at rest", range::positive),
        field("viscosity",
              &S::viscosity,
              "Pa s",
              "dynamic viscosity, implicit, so that it does not limit steps",
              range::nonNegative),
        field("xsph",
              &S::xsph,
              "",
              "how much of the mean velocity of its neighbours a particle takes in each substep",
              range::closed(0, 1)),
        field("maxError",
              &S::maxError,
              "",
              "mean error of the density over that at rest at the end of a substep",
              range::positive),
        field("maxErrorV",
              &S::maxErrorV,
              "",
              "mean of what the divergence would compress in a substep, over the density at rest",
              range::positive),
        field("maxIterations", &S::maxIterations, "", "for the density, at most", range::atLeast(2)),
        field("maxIterationsV", &S::maxIterationsV, "", "for the divergence, at most", range::atLeast(2)),
        field("maxErrorViscosity",
              &S::maxErrorViscosity,
              "",
              "residual of the velocities under viscosity, over the first one",
              range::positive),
        field("maxIterationsViscosity",
              &S::maxIterationsViscosity,
              "",
              "for the viscosity, at most",
              range::atLeast(1)),
        field("enableDivergenceSolver",
              &S::enableDivergenceSolver,
              "",
              "velocities are made free of divergence, too"),
        field("cflFactor",
              &S::cflFactor,
              "",
              "how far a particle moves in a substep at most, over the distance of particles",
              Range{.low = 0, .high = 1, .openLow = true}),
        field("maxSubsteps", &S::maxSubsteps, "", "more of them in a step are an error", range::atLeast(1)));
  }

  std::vector<double> pressures{}, pressuresV{};

  /// What the next step starts from, besides positions and velocities.
  static constexpr auto state() {
    using S = DFSPHSolver;
    return field_list(field("pressures", &S::pressures, "m^2/s^2", "over the density, of the last substep"),
                      field("pressuresV", &S::pressuresV, "m^2/s^2", "the same of the divergence"));
  }
  void reset() {
    pressures.assign(pressures.size(), 0.0);
    pressuresV.assign(pressuresV.size(), 0.0);
  }

  /// Points that come have no pressure.
  void followPoints(Renumbering const& points, std::size_t count) {
    for (auto* k : {&pressures, &pressuresV}) {
      points.filter(*k);
      k->resize(count, 0.0);
    }
    pointsChanged = true;
  }

  BoundaryParticles boundary{};

  DFSPHFlow flow{};
  DFSPHFlow::Iteration ofDensity{}, ofDivergence{}, ofViscosity{};  // of the last substep
  int substeps = 0;                                                 // of the last step
  double distance = 0;         // of particles, by the smallest volume [m]
  bool pointsChanged = false;  // since the last step
  std::string where{};

  template <class Operations>
  void init(Operations& operations) {
    where = text(operations.root.path(), ": ", component_name<DFSPHSolver>());
    int states = 0;
    std::size_t room = 0;
    operations.forEachIndependent([&](auto& s) {
      using D = typename std::decay_t<decltype(s)>::DataTypes;
      if constexpr (is_fluid<D>)
        ++states, room = std::max(s.size(), s.capacity);
      else
        throw Error(where,
                    "a state below is not one of points in space on the host (Vec3d, Vec3f); give bodies a "
                    "solver of their own");
    });
    if (states != 1)
      throw Error(
          where,
          text(states, " states are below, but a solver moves the particles of one; give each a solver"));
    flow.reserve(room, boundary.size());
    pointsChanged = false;
    findVolumes(operations);
    flow.radius = radius;
    flow.workers = {};
    if (flow.fluidSize() > 0 || room == 0) calibrate();
    withFluid(operations, [&](auto& s) { read(s); });
    if (flow.fluidSize() > 0) {
      flow.place(where);
      if (const auto [i, j] = flow.coincident(); i >= 0)
        throw Error(where, text("particles ", i, " and ", j, " are in one place; move one"));
    }
    for (auto* k : {&pressures, &pressuresV})
      if (k->size() != flow.fluidSize()) k->assign(flow.fluidSize(), 0.0);
  }

  template <class Operations>
  void solve(Operations& operations, double dt) {
    if (std::exchange(pointsChanged, false)) {
      const double before = distance;
      findVolumes(operations);
      if (flow.fluidSize() > 0 && distance != before) calibrate();
    }
    flow.impulses.assign(boundary.size(), Eigen::Vector3d::Zero());
    for (auto& f : boundary.forces) f.setZero();
    substeps = 0;
    if (flow.fluidSize() == 0) return;
    MultiVecCoord pos(operations, vec_id::position);
    MultiVecDeriv vel(operations, vec_id::velocity), acc(operations);
    if constexpr (std::is_same_v<decltype(operations.workers()), SomeWorkers>)
      flow.workers = operations.workers();
    const double start = operations.time;
    for (double done = 0; done < dt;) {
      operations.computeAcc(start + done, acc, pos, vel);
      withFluid(operations, [&](auto& s) { read(s, s[acc.id]); });
      const double h = substep(dt, done);
      flow.place(where);
      if (enableDivergenceSolver) {
        ofDivergence.most = maxIterationsV, ofDivergence.tolerance = maxErrorV;
        flow.solveDivergence(h, ofDivergence, pressuresV);
      }
      for (std::size_t i = 0; i < flow.fluidSize(); ++i) flow.velocities[i] += h * flow.accelerations[i];
      if (viscosity > 0) {
        ofViscosity.most = maxIterationsViscosity, ofViscosity.tolerance = maxErrorViscosity;
        flow.solveViscosity(h, viscosity / density, ofViscosity);
      }
      if (xsph > 0) flow.smooth(xsph);
      ofDensity.most = maxIterations, ofDensity.tolerance = maxError;
      flow.solveDensity(h, ofDensity, pressures);
      withFluid(operations, [&](auto& s) { takePressure(s, s[acc.id], h); });
      operations.acted.add(vec_id::force, h / dt);
      operations.projectResponse(acc.id);
      vel.peq(acc, h);
      pos.peq(vel, h);
      for (std::size_t i = 0; i < boundary.size(); ++i) boundary.positions[i] += h * boundary.velocities[i];
      ++substeps;
      done = h >= (dt - done) * (1 - 1e-12) ? dt : done + h;
    }
    for (std::size_t i = 0; i < boundary.size(); ++i) boundary.forces[i] = density / dt * flow.impulses[i];
    operations.time = start;
  }

 private:
  template <class D>
  static constexpr bool is_fluid = [] {
    if constexpr (requires { typename D::Coord; })
      return D::size == 3 && !D::rigid &&
             std::is_same_v<typename D::VecCoord, std::vector<typename D::Coord>>;
    else
      return false;
  }();

  template <class Operations, class F>
  static void withFluid(Operations& operations, F&& f) {
    operations.forEachIndependent([&](auto& s) {
      if constexpr (is_fluid<typename std::decay_t<decltype(s)>::DataTypes>) f(s);
    });
  }
  // the kernel, by the distance of the particles
  void calibrate() {
    if (radius < distance || radius > 4 * distance)
      throw Error(where,
                  text("radius is ",
                       radius,
                       " m, and particles of their mass are ",
                       distance,
                       " m apart at rest; take twice that, or correct the mass or the density"));
    flow.calibrate(distance);
  }
  // masses over the density
  template <class Operations>
  void findVolumes(Operations& operations) {
    withFluid(operations, [&](auto& s) {
      using Deriv = typename std::decay_t<decltype(s)>::DataTypes::Deriv;
      s.dx.assign(s.size(), Deriv::Unit(0));
      s.force.assign(s.size(), Deriv::Zero());
    });
    operations.addMBKdx(vec_id::force, vec_id::dx, {.m = 1});
    withFluid(operations, [&](auto& s) {
      using Deriv = typename std::decay_t<decltype(s)>::DataTypes::Deriv;
      flow.volumes.clear();
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < s.size(); ++i) {
        const double mass = double(s.force[i][0]);
        if (!(mass > 0))
          throw Error(where,
                      text("particle ", i, " has the mass ", mass, " kg; give the node a UniformMass"));
        flow.volumes.push_back(mass / density);
        least = std::min(least, mass / density);
      }
      distance = std::cbrt(least);
      s.dx.assign(s.size(), Deriv::Zero());
      s.force.assign(s.size(), Deriv::Zero());
    });
  }
  template <class State>
  void read(State const& s) {
    const std::size_t n = flow.fluidSize();
    for (auto* v : {&flow.positions, &flow.velocities}) v->resize(n + boundary.size());
    std::copy(
        boundary.positions.begin(), boundary.positions.end(), flow.positions.begin() + std::ptrdiff_t(n));
    std::copy(
        boundary.velocities.begin(), boundary.velocities.end(), flow.velocities.begin() + std::ptrdiff_t(n));
    for (std::size_t i = 0; i < n; ++i) {
      flow.positions[i] = s.position[i].template cast<double>();
      flow.velocities[i] = s.velocity[i].template cast<double>();
    }
  }
  template <class State, class VecDeriv>
  void read(State const& s, VecDeriv const& acceleration) {
    read(s);
    flow.accelerations.resize(flow.fluidSize());
    for (std::size_t i = 0; i < flow.fluidSize(); ++i)
      flow.accelerations[i] = acceleration[i].template cast<double>();
  }
  // The length of the next substep: the rest of the step in as few as the CFL number lets.
  double substep(double dt, double done) const {
    const double longest = flow.longestStep(cflFactor * distance), rest = dt - done;
    const double count = std::max(1.0, std::ceil(rest / longest * (1 - 1e-9)));
    if (!(substeps + count <= maxSubsteps))
      throw Error(where,
                  text("a step of ",
                       dt,
                       " s is beyond the CFL limit: particles would move farther than ",
                       cflFactor,
                       " of their distance of ",
                       distance,
                       " m in ",
                       longest,
                       " s; take a step of less than ",
                       maxSubsteps * longest,
                       " s, more maxSubsteps, or look for what drives them"));
    return rest / count;
  }
  // acceleration = (new velocity - velocity) / h, and the force of the pressure
  template <class State, class VecDeriv>
  void takePressure(State& s, VecDeriv& acceleration, double h) const {
    using Deriv = typename State::DataTypes::Deriv;
    using Real = typename State::DataTypes::Real;
    for (std::size_t i = 0; i < flow.fluidSize(); ++i) {
      const Eigen::Vector3d whole = (flow.velocities[i] - s.velocity[i].template cast<double>()) / h;
      s.force[i] +=
          Deriv((density * flow.volumes[i] * (whole - flow.accelerations[i])).template cast<Real>());
      acceleration[i] = whole.template cast<Real>();
    }
  }
};

}  // namespace sinew
