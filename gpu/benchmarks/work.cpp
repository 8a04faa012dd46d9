// SPDX-License-Identifier: BSL-1.0
#include "work.hpp"

#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>

using namespace sinew;

namespace bench {

namespace {

using D = VecTypes<3, Counted>;
const D::Coord tetrahedron[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const D::Coord stretched[4] = {{0, 0, 0}, {1.1, 0.1, 0}, {0, 1, 0.2}, {0.1, 0, 0.9}};

}  // namespace

LawFlops spring_flops() {
  const D::Coord x[2] = {{0, 0, 0}, {1.1, 0.1, 0}};
  return law_flops(SpringLaw<D>{}, {1, 0, 1}, x);
}
LawFlops tetrahedron_flops() {
  const TetrahedronFEM<D> law{RotationMethod::gradient};
  return law_flops(law, law.restOf(tetrahedron, 1, 1, law.method), stretched);
}
LawFlops hexahedron_flops() {
  const HexahedronFEM<D> law{HexahedronMethod::large};
  D::Coord rest[8], x[8];
  const int corners[8][3] = {
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int i = 0; i < 8; ++i) {
    auto const& c = corners[i];
    rest[i] = {c[0], c[1], c[2]};
    x[i] = {1.1 * c[0] + 0.1 * c[1], c[1] + 0.2 * c[2], 0.9 * c[2]};
  }
  return law_flops(law, law.restOf(rest, 1, 1, law.method), x);
}
LawFlops hyperelastic_flops() {
  TetrahedronHyperelasticity<D> law;
  law.material.material = HyperelasticMaterial::NeoHookean;
  law.material.p[0] = 1200;
  law.material.p[1] = 2500;
  TetrahedronRest<Counted> rest;
  rest.gradient.setIdentity();
  rest.volume = 1.0 / 6;
  return law_flops(law, rest, stretched);
}

}  // namespace bench
