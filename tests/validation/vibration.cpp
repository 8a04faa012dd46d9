// SPDX-License-Identifier: BSL-1.0
#include "bars.hpp"
#include "catch.hpp"
#include "record.hpp"
#include "registry_scene.hpp"
#include "ring.hpp"

namespace test_vibration {

using namespace bars;

namespace {

constexpr double density = 1000;

/// A bar of elements let go in a small displacement `mode(p)` [m], with its sections free to move as `held`
/// leaves them.
template <class Mass, class Force, class Mode>
double frequency(Bar const& bar, Cells cells, Mass mass, Force fem, std::vector<int> held,
                 std::array<int, 3> fixed, double expected, Mode&& mode) {
  const Mesh mesh = bar.mesh(cells);
  mass.massDensity = {density};
  fem.youngModulus = {bar.E}, fem.poissonRatio = bar.nu;
  RegistryScene sim{
      node<"root">(NewmarkImplicitSolver{},
                   SparseLDLSolver<>{},
                   MeshTopology{.tetrahedra = mesh.tetrahedra, .hexahedra = mesh.hexahedra},
                   MechanicalObject<Vec3d>{mesh.positions},
                   mass,
                   fem,
                   PartialFixedConstraint<Vec3d>{.indices = held, .fixedDirections = fixed},
                   // the bar moves in its plane
                   PartialFixedConstraint<Vec3d>{.fixAll = true, .fixedDirections = {0, 0, 1}})};
  sim.init();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    sim.root().state().position[i] += 1e-6 * mode(mesh.positions[i]);
  return ring(sim, mesh.positions, 0.2 / expected);
}

}  // namespace

TEST_CASE("bars ring along themselves as rods do", "[page]") {
  // held at one end, w = pi/2L sqrt(E/rho); of hexahedra of length a, with t = pi a/2L:
  //   lumped      w = 2/a sin(t/2) sqrt(E/rho)
  //   consistent  w = 2/a sin(t/2) sqrt(E/rho) / sqrt(1 - 2/3 sin^2(t/2))
  Record curve("vibration", {"bar", "h", "error"});
  const HexahedronFEMForceField<Vec3d> hexahedra{.method = HexahedronMethod::small};
  double lumpedError[4], consistentError[4], tetrahedraError[4];
  for (int level = 0; level < 4; ++level) {
    const Bar bar{.length = 4, .along = 4 << level, .across = 1 << level, .deep = 1};
    const double a = bar.length / bar.along, speed = std::sqrt(bar.E / density),
                 theory = pi / (2 * bar.length) * speed;
    auto shape = [&](Vector3d const& p) { return Vector3d(std::sin(pi * p[0] / (2 * bar.length)), 0, 0); };
    const std::vector<int> held = points_at(bar.mesh(Cells::hexahedra), 0);
    auto along = [&](auto mass, Cells cells, auto fem) {
      return frequency(bar, cells, mass, fem, held, {1, 1, 1}, theory, shape);
    };
    const double lumped = along(DiagonalMass<Vec3d>{}, Cells::hexahedra, hexahedra),
                 consistent = along(MeshMatrixMass<Vec3d>{}, Cells::hexahedra, hexahedra),
                 tetrahedra = along(MeshMatrixMass<Vec3d>{},
                                    Cells::six,
                                    TetrahedronFEMForceField<Vec3d>{.method = RotationMethod::small});
    const double sine = std::sin(pi * a / (4 * bar.length)), closed = 2 / a * sine * speed;
    // cancellation in 1 - cos(W h), of 0.2^2/2, and of the strain in positions: 1e-16 of 4 against 1e-6 / 4
    CHECK(lumped == Approx(closed).epsilon(1e-7));
    CHECK(consistent == Approx(closed / std::sqrt(1 - 2.0 / 3 * sine * sine)).epsilon(1e-7));
    lumpedError[level] = 1 - lumped / theory;
    consistentError[level] = consistent / theory - 1;
    tetrahedraError[level] = tetrahedra / theory - 1;
    curve.row("axial, hexahedra, lumped mass", a, lumpedError[level]);
    curve.row("axial, hexahedra, consistent mass", a, consistentError[level]);
    curve.row("axial, tetrahedra, consistent mass", a, tetrahedraError[level]);
  }
  CHECK(std::log2(lumpedError[2] / lumpedError[3]) == Approx(2).margin(0.02));
  CHECK(std::log2(consistentError[2] / consistentError[3]) == Approx(2).margin(0.02));
  CHECK(std::log2(tetrahedraError[2] / tetrahedraError[3]) == Approx(2).margin(0.3));

  // Across, between supports that let sections turn: w(k) of Timoshenko's beam with k = pi / L,
  //   E I k^4 - w^2 rho (A + I k^2 (1 + E/(kappa G))) + w^4 rho^2 I / (kappa G) = 0
  double bending[4];
  for (int level = 0; level < 4; ++level) {
    const int across = 1 << level;
    const Bar bar{.length = 8, .along = 8 * across, .across = across, .deep = 1};
    const double k = pi / bar.length, I = bar.inertia(), G = 5.0 / 6 * bar.shearModulus();
    const double p = density * (bar.area() + I * k * k * (1 + bar.E / G)), q = density * density * I / G;
    const double square = (p - std::sqrt(p * p - 4 * q * bar.E * I * std::pow(k, 4))) / (2 * q),
                 theory = std::sqrt(square);
    // sections turn by dw/dx less the shear, which is rho w^2 / (kappa G k) of w
    const double lean = k - density * square / (G * k);
    auto shape = [&](Vector3d const& x) {
      return Vector3d(-x[1] * lean * std::cos(k * x[0]), std::sin(k * x[0]), 0);
    };
    const Mesh mesh = bar.mesh(Cells::hexahedra);
    const std::vector<int> held =
        points_where(mesh, [&](Vector3d const& x) { return x[0] < 1e-9 || x[0] > bar.length - 1e-9; });
    const double found =
        frequency(bar, Cells::hexahedra, MeshMatrixMass<Vec3d>{}, hexahedra, held, {0, 1, 0}, theory, shape);
    bending[level] = found / theory - 1;
    curve.row("bending, hexahedra, consistent mass", 1.0 / across, bending[level]);
  }
  CHECK(std::log2(bending[1] / bending[2]) == Approx(2).margin(0.1));
  CHECK(bending[3] < 0.006);
}

}  // namespace test_vibration
