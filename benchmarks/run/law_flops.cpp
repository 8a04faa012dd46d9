// SPDX-License-Identifier: BSL-1.0
#include "law_flops.hpp"

#include "counted.hpp"

#include <sinew/force/hexahedron_fem.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/force/tetrahedron_fem.hpp>
#include <sinew/force/tetrahedron_hyperelasticity.hpp>

#include <cstddef>

using namespace sinew;

namespace bench {

namespace {

/// Of a law over VecTypes<3, Counted>, with the points of its element in a state that is not the one of rest.
template <class Law, std::size_t Points>
LawFlops law_flops(Law const& law, typename Law::Rest const& rest, typename Law::Coord const (&x)[Points]) {
  constexpr int points = int(Points), pairs = points * (points + 1) / 2;
  static_assert(points == Law::arity);
  typename Law::Deriv f[Points], v[Points];
  for (auto& one : v) one.setZero();
  typename Law::Tangent tangent;
  LawFlops n;
  n.force = operations_of([&] { law.force(rest, x, v, f, tangent); }) + 3 * points;
  n.dforce = operations_of([&] { law.dforce(rest, tangent, x, f, Counted(1), Counted(0)); }) + 3 * points;
  n.blocks = 9 * pairs + operations_of([&] {
               for (int i = 0; i < points; ++i)
                 for (int j = i; j < points; ++j) law.block(rest, tangent, i, j, Counted(1), Counted(0));
             });
  return n;
}

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
