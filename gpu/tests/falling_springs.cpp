// SPDX-License-Identifier: BSL-1.0
#include "host_answers.hpp"

#include <sinew/force/gravity.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/scene/simulation.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/state/mechanical_object.hpp>
#include <sinew/topology/regular_grid.hpp>

namespace gpu_test {

template <class D>
Fall<D> falling_springs() {
  using Real = typename D::Real;
  Fall<D> fall;
  const Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {1.5, 1, 1});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    Eigen::Vector3d const& p = mesh.positions[i];
    const Real t = Real(i);
    fall.body.x.push_back({Real(p[0]), Real(p[1]), Real(p[2])});
    fall.body.v.push_back({std::sin(t), std::sin(3 * t), std::cos(2 * t)});
  }
  std::vector<Spring> springs;
  for (Tetrahedron const& t : mesh.tetrahedra)
    for (std::size_t k = 0; k < 4; ++k) {
      const Spring spring{.first = t[k], .second = t[(k + 1) % 4], .stiffness = 200, .damping = 0.5};
      const Real length =
          (fall.body.x[std::size_t(spring.second)] - fall.body.x[std::size_t(spring.first)]).norm();
      springs.push_back(spring);
      fall.body.elements.push_back({spring.first, spring.second});
      fall.body.rest.push_back({Real(spring.stiffness), Real(spring.damping), length});
    }

  Simulation sim{node<"root">(Gravity{{0, Fall<D>::gravity, 0}},
                              EulerExplicitSolver{},
                              MechanicalObject<D>{.position = fall.body.x, .velocity = fall.body.v},
                              UniformMass<D>{.vertexMass = Real(1)},
                              StiffSpringForceField<D>{springs})};
  sim.init();
  for (int step = 0; step < Fall<D>::steps; ++step) sim.animate(Fall<D>::dt);
  fall.after = sim.root().state().position;
  return fall;
}

template Fall<Vec3d> falling_springs<Vec3d>();
template Fall<Vec3f> falling_springs<Vec3f>();

}  // namespace gpu_test
