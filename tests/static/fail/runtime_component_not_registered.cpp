// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: a component is not in the registry of the runtime tree
#include <sinew/mass/diagonal_mass.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/node.hpp>

using namespace sinew;

int main() {
  RuntimeNode<Registry<UniformMass<Vec3d>>> root;
  root.add(DiagonalMass<Vec3d>{});
}
