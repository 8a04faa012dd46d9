// SPDX-License-Identifier: BSL-1.0
#include "frames.hpp"

#include <sinew/force/beam_fem.hpp>
#include <sinew/mass/beam_mass.hpp>

#include <numbers>

namespace test_beam_fem {

using namespace sinew;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using frames::frame;
using frames::moved;
using frames::wave;
using one::force;
using one::ready;
using one::refuses;
using std::numbers::pi;

namespace {

using Beams = BeamFEMForceField<Rigid3d>;
using Masses = BeamMass<Rigid3d>;
using VecCoord = Rigid3d::VecCoord;
using VecDeriv = Rigid3d::VecDeriv;

// three frames that stand in any way, and two beams between them
const VecCoord bent{frame({0, 0, 0}, Quaterniond(0.3, 0.5, -0.4, 0.7).normalized()),
                    frame({0.7, 0.2, 0}, Quaterniond(-0.6, 0.2, 0.5, 0.1).normalized()),
                    frame({1, 1, 0.5}, Quaterniond(0.1, 0.9, 0.2, -0.3).normalized())};
const std::vector<Edge> two{{0, 1}, {1, 2}};
TopologyView lines(std::vector<Edge> const& edges) {
  TopologyView topology;
  topology.edges = edges;
  return topology;
}

}  // namespace

TEST_CASE("sections have the closed forms of their shapes") {
  const BeamSection disc = circular_section(0.2, 0, 0.3), ring = circular_section(0.2, 0.1, 0.3);
  CHECK(disc.area == Approx(pi * 0.04));
  CHECK(disc.aboutY == Approx(pi / 4 * 0.0016));
  CHECK(ring.area == Approx(pi * 0.03));
  CHECK(ring.aboutZ == Approx(pi / 4 * 0.0015));
  CHECK(ring.torsion == Approx(pi / 2 * 0.0015));
  CHECK(disc.shear == Approx(6 * 1.3 / (7 + 6 * 0.3)));
  // a thin wall carries shear on half of its area (nu = 0)
  CHECK(circular_section(1, 0.9999, 0).shear == Approx(0.5).epsilon(1e-3));
  const BeamSection box = rectangular_section(0.1, 0.3, 0);
  CHECK(box.aboutY == Approx(0.1 * 0.027 / 12));
  CHECK(box.aboutZ == Approx(0.3 * 0.001 / 12));
  CHECK(box.shear == Approx(5.0 / 6));
  // torsion of a square: 0.140577 a^4, of a strip: a b^3 / 3 (1 - 0.630 b/a) (Timoshenko & Goodier)
  CHECK(rectangular_section(2, 2, 0).torsion == Approx(0.140577 * 16).epsilon(1e-5));
  CHECK(rectangular_section(0.01, 1, 0).torsion == Approx(1e-6 / 3 * (1 - 0.00630)).epsilon(1e-5));
}

// Pure stretch, twist and bending, of which the energies are EA u^2 / 2L, GJ a^2 / 2L and EI a^2 / 2L.
TEST_CASE("a beam resists stretch, twist and bending alone as its section does") {
  const double E = 200, nu = 0.25, L = 2, angle = 0.8;
  auto beam = ready(Beams{.poissonRatio = nu,
                          .youngModulus = E,
                          .crossSectionShape = CrossSectionShape::rectangular,
                          .lengthY = 0.2,
                          .lengthZ = 0.3},
                    {frame({0, 0, 0}), frame({L, 0, 0})},
                    lines({{0, 1}}));
  const BeamSection s = rectangular_section(0.2, 0.3, nu);
  CHECK(potential_energy(beam, {frame({0, 0, 0}), frame({L, 0, 0})}) == 0);
  CHECK(potential_energy(beam, {frame({0, 0, 0}), frame({L + 0.3, 0, 0})}) ==
        Approx(E * s.area * 0.09 / 2 / L));
  auto turned = [&](Vector3d const& axis) {
    const Eigen::AngleAxisd half(angle / 2, axis), back(-angle / 2, axis);
    return potential_energy(beam, {frame({0, 0, 0}, Quaterniond(back)), frame({L, 0, 0}, Quaterniond(half))});
  };
  CHECK(turned(Vector3d::UnitX()) == Approx(E / (2 * (1 + nu)) * s.torsion * angle * angle / 2 / L));
  CHECK(turned(Vector3d::UnitY()) == Approx(E * s.aboutY * angle * angle / 2 / L));
  CHECK(turned(Vector3d::UnitZ()) == Approx(E * s.aboutZ * angle * angle / 2 / L));
  // bent by a moment: opposite torques and nothing else
  const Eigen::AngleAxisd half(angle / 2, Vector3d::UnitZ());
  const auto f =
      force(beam, {frame({0, 0, 0}, Quaterniond(half.inverse())), frame({L, 0, 0}, Quaterniond(half))});
  CHECK(f[1][5] == Approx(-E * s.aboutZ * angle / L));
  CHECK((f[0] + f[1]).norm() < 1e-14);
  CHECK(f[1].head<5>().norm() < 1e-14);
}

// 12 EI / L^3 across, and 12 EI / L^3 (1 + p) where it yields to shear, with p = 12 EI / (k G A L^2)
TEST_CASE("a beam yields to shear where it is asked to, and otherwise as SOFA's does not") {
  const double E = 200, nu = 0.25, L = 2, u = 1e-4;
  const BeamSection s = circular_section(0.3, 0, nu);
  for (const bool shear : {false, true}) {
    Beams round{.poissonRatio = nu, .youngModulus = E, .radius = 0.3};
    if (shear) round.shearStressComputation = true;
    auto beam = ready(round, {frame({0, 0, 0}), frame({L, 0, 0})}, lines({{0, 1}}));
    const auto f = force(beam, {frame({0, 0, 0}), frame({L, u, 0})});
    const double p = shear ? 12 * E * s.aboutZ / (s.shear * E / (2 * (1 + nu)) * s.area * L * L) : 0;
    CHECK(f[1][1] == Approx(-12 * E * s.aboutZ / (L * L * L * (1 + p)) * u).epsilon(1e-6));
  }
}

TEST_CASE("how frames stand to a round beam, and in which order they come, changes nothing") {
  const Beams round{.poissonRatio = 0.3, .youngModulus = 100, .radius = 0.2, .shearStressComputation = true};
  auto beams = ready(round, bent, lines(two)), reversed = ready(round, bent, lines({{1, 0}, {2, 1}}));
  const auto x = moved(bent, wave(3, 0.4));
  const auto f = force(beams, x), g = force(reversed, x);
  CHECK(force(beams, bent)[1].norm() < 1e-13);
  // other frames at rest, which go along with the same bodies: q r in place of q
  const Quaterniond r[3]{Quaterniond(1, 2, 0, 1).normalized(),
                         Quaterniond(1, -2, 0.5, 1).normalized(),
                         Quaterniond(0, 2, 1, 1).normalized()};
  auto restOther = bent, xOther = x;
  for (std::size_t i = 0; i < 3; ++i) {
    restOther[i].orientation = bent[i].orientation * r[i];
    xOther[i].orientation = x[i].orientation * r[i];
  }
  auto other = ready(round, restOther, lines(two));
  CHECK(potential_energy(other, xOther) == Approx(potential_energy(beams, x)).epsilon(1e-12));
  const auto h = force(other, xOther);
  // the quaternions q and -q are one orientation
  auto flipped = x;
  flipped[1].orientation.coeffs() *= -1;
  const auto k = force(beams, flipped);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK((f[i] - g[i]).norm() < 1e-12 * f[i].norm());
    CHECK((f[i] - h[i]).norm() < 1e-12 * f[i].norm());
    CHECK((f[i] - k[i]).norm() < 1e-12 * f[i].norm());
  }
}

TEST_CASE("the tangent of a beam is the symmetric part of the derivative of its forces, far from rest too") {
  auto beams =
      ready(Beams{.poissonRatio = 0.3, .youngModulus = 100, .radius = 0.3, .shearStressComputation = true},
            bent,
            lines(two));
  const auto x = moved(bent, wave(3, 0.7, 3));
  frames::check_tangent(beams, x, 1e-7);
}

TEST_CASE("listSegment chooses edges") {
  auto all = ready(Beams{}, bent, lines(two)), first = ready(Beams{.listSegment = {0}}, bent, lines(two)),
       second = ready(Beams{.listSegment = {1}}, bent, lines(two));
  const auto x = moved(bent, wave(3, 0.2));
  CHECK(potential_energy(all, x) == Approx(potential_energy(first, x) + potential_energy(second, x)));
  CHECK(force(first, x)[2].norm() == 0);
  CHECK(force(second, x)[0].norm() == 0);
}

TEST_CASE("frames have half of the mass and of the rotary inertia of their beams") {
  const double r = 1000, L = 0.5;
  const VecCoord x{frame({0, 0, 0}, Quaterniond(Eigen::AngleAxisd(pi / 2, Vector3d::UnitZ()))),
                   frame({0, L, 0}),
                   frame({L, L, 0})};
  auto mass = ready(Masses{.massDensity = r,
                           .crossSectionShape = CrossSectionShape::rectangular,
                           .lengthY = 0.1,
                           .lengthZ = 0.2},
                    x,
                    lines(two));
  const double area = 0.02, aboutY = 0.1 * 0.008 / 12, aboutZ = 0.2 * 0.001 / 12;
  auto const& m = mass.lumped.mass;
  CHECK(m[0].mass == Approx(r * area * L / 2));
  CHECK(m[1].mass == Approx(r * area * L));
  CHECK(m[2].mass == Approx(r * area * L / 2));
  // in the axes of the frames: that of frame 2 has its x along the beam
  const Vector3d along = r * L / 2 * Vector3d(aboutY + aboutZ, aboutY, aboutZ);
  CHECK((m[2].inertia - Eigen::Matrix3d(along.asDiagonal())).norm() < 1e-15);
  // the energy of a turn about the first beam and of one about z
  VecDeriv v(3, Rigid3d::Deriv::Zero());
  v[0][4] = 3;
  CHECK(mass.kineticEnergy(x, v) == Approx(0.5 * 9 * along[0]));
  v[0][4] = 0, v[0][5] = 3;
  CHECK(mass.kineticEnergy(x, v) == Approx(0.5 * 9 * along[2]));
}

TEST_CASE("beams that cannot be are refused") {
  const auto topology = lines(two);
  refuses(
      Beams{}, bent, {}, {"body", "BeamFEMForceField<Rigid3d>", "the topology has no edge", "MeshTopology"});
  refuses(Beams{}, bent, lines({{0, 3}}), {"edge 0 refers to point 3", "3 points"});
  refuses(Beams{}, bent, lines({{1, 1}}), {"from frame 1 to frame 1", "no length"});
  refuses(Beams{.listSegment = {0, 2}}, bent, topology, {"listSegment has 2", "2 edges"});
  refuses(Beams{.listSegment = {-1}}, bent, topology, {"listSegment[0] is -1"});
  refuses(Beams{.radius = 0}, bent, topology, {"radius is 0 m", "greater than 0"});
  refuses(Beams{.radius = 1, .radiusInner = 1}, bent, topology, {"radiusInner is 1 m", "less than radius"});
  refuses(Beams{.radiusInner = -1}, bent, topology, {"radiusInner is -1 m"});
  refuses(Beams{.poissonRatio = 0.6}, bent, topology, {"poissonRatio is 0.6", "at most 0.5"});
  refuses(Beams{.youngModulus = -1}, bent, topology, {"youngModulus is -1 Pa"});
  refuses(Beams{.youngModulus = one::notANumber}, bent, topology, {"youngModulus is nan"});
  refuses(Beams{.lengthY = 0}, bent, topology, {"lengthY is 0 m"});

  refuses(Masses{}, bent, lines({{0, 1}}), {"BeamMass<Rigid3d>", "frame 2 is the end of no beam"});
  refuses(Masses{}, bent, lines({{0, 5}}), {"edge 0 refers to point 5"});
  refuses(Masses{.massDensity = 0}, bent, topology, {"massDensity is 0 kg/m^3"});
  refuses(Masses{.radius = 1, .radiusInner = 2}, bent, topology, {"radiusInner is 2 m"});
}

}  // namespace test_beam_fem
