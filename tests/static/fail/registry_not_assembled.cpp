// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a force field is under a linear solver that assembles a matrix
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cholesky_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Pull {
  using Role = role::ForceField;
  using DataTypes = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Pull";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<Vec3d> const&) {}
  void addForce(MechanicalParams const&, V&, X const&, V const&) {}
  void addDForce(MechanicalParams const&, V&, V const&) const {}
  double potentialEnergy(X const&) const { return 0; }
};
using Direct = CholeskySolver<CompressedRowSparseMatrixMat3x3d>;
struct Mine : Registry<EulerImplicitSolver, Direct, MechanicalObject<Vec3d>, UniformMass<Vec3d>, Pull> {};

int main() {
  RuntimeNode<Mine> root;
  root.add(EulerImplicitSolver{});
  root.add(Direct{});
  root.add(MechanicalObject<Vec3d>{});
  root.add(UniformMass<Vec3d>{});
  root.add(Pull{});
  Simulation sim{std::move(root)};
  sim.init();
  sim.animate(0.1);
}
