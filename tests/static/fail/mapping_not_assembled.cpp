// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a mapping is under a linear solver that assembles a matrix
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

using namespace sinew;

struct Follow {
  using Role = role::Mapping;
  using In = Vec3d;
  using Out = Vec3d;
  using V = Vec3d::VecDeriv;
  using X = Vec3d::VecCoord;
  static constexpr std::string_view className = "Follow";
  static constexpr auto fields() { return field_list(); }
  void init(InitContext<In> const&, InitContext<Out> const&, X&) {}
  void apply(X&, X const&) const {}
  void applyJ(V&, V const&) const {}
  void applyJT(V&, V const&) const {}
};

int main() {
  Simulation sim{node<"root">(EulerImplicitSolver{},
                              CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{},
                              MechanicalObject<Vec3d>{},
                              UniformMass<Vec3d>{},
                              node<"skin">(MechanicalObject<Vec3d>{}, Follow{}))};
  sim.init();
  sim.animate(0.1);
}
