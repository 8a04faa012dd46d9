// SPDX-License-Identifier: BSL-1.0
#pragma once

// A tool that is moved as told and pulls at a string, in a typed scene.

#include "catch.hpp"
#include "io/files.hpp"

#include <sinew/constraint/fixed_constraint.hpp>
#include <sinew/constraint/linear_movement.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/control/read_state.hpp>
#include <sinew/control/write_state.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/mesh_topology.hpp>

namespace replay {

using namespace sinew;
using Eigen::Vector3d;
using files::TempFolder;

constexpr double dt = 0.01;

/// A tool without a solver, moved by `drive`, whose tip pulls at the end of a string by a spring.
template <class... Drive>
auto pulling(Drive... drive) {
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      node<"tool">(
          MechanicalObject<Rigid3d>{.position = {{{1, 0, 0}, Quat<double>(1, 0, 0, 0)}}},
          drive...,
          node<"tip">(MechanicalObject<Vec3d>{.position = {{0, 0.5, 0}}}, RigidMapping<Rigid3d, Vec3d>{})),
      node<"string">(EulerImplicitSolver{},
                     CGLinearSolver<>{.iterations = 50, .tolerance = 1e-12},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0.5, 0, 0}, {1, 0, 0}}},
                     UniformMass<Vec3d>{.vertexMass = 0.1},
                     StiffSpringForceField<Vec3d>{{{0, 1, 50, 0.1, 0.5}, {1, 2, 50, 0.1, 0.5}}},
                     FixedConstraint<Vec3d>{.indices = {0}}),
      StiffSpringForceField<Vec3d, Between<"tool/tip", "string">>{{{0, 2, 20, 0.5, 0.2}}})};
}
inline ReadState<Rigid3d> keys() {
  const Quat<double> turned(Eigen::AngleAxisd(1.5, Vector3d(1, 0, 1).normalized()));
  return {.keyTimes = {0, 0.3, 0.7, 1.2},
          .keyPositions = {{{1, 0, 0}, Quat<double>(1, 0, 0, 0)},
                           {{1.2, 0.3, 0}, turned},
                           {{0.8, 0.5, 0.3}, turned},
                           {{1, 0.1, -0.2}, Quat<double>(1, 0, 0, 0)}},
          .interpolation = Interpolation::cubic};
}

template <class V>
std::string bits(V const& vector) {
  return {reinterpret_cast<char const*>(vector.data()), vector.size() * sizeof(vector[0])};
}
/// Positions and velocities of all bodies.
template <class Sim>
std::string bits_of(Sim& sim) {
  std::string all;
  auto add = [&](auto const& s) { all += bits(s.position) + bits(s.velocity); };
  add(sim.template at<"tool">().state());
  add(sim.template at<"tool/tip">().state());
  add(sim.template at<"string">().state());
  return all;
}
template <class Sim>
std::vector<std::string> run(Sim& sim, int steps) {
  std::vector<std::string> all;
  for (int i = 0; i < steps; ++i) {
    sim.animate(dt);
    all.push_back(bits_of(sim));
  }
  return all;
}

template <class F>
void says(F&& f, std::initializer_list<std::string_view> words) {
  const std::string said = error_of(f);
  for (std::string_view word : words) {
    INFO(said << "\n  should say: " << word);
    CHECK(said.find(word) != std::string::npos);
  }
}

}  // namespace replay
