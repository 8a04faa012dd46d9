// SPDX-License-Identifier: BSL-1.0
#include "record.hpp"
#include "shells.hpp"

namespace test_shells_linear {

using namespace shells;

namespace {

/// A square of 4 x 4 cells with its inner frames moved aside, so that no two elements are alike.
Sheet irregular() {
  Sheet sheet = flat(4, 4, 1, 1);
  for (std::size_t i = 0; i < sheet.x.size(); ++i) {
    Vector3d& c = sheet.x[i].center;
    const bool inside = c[0] > 0.01 && c[0] < 0.99 && c[1] > 0.01 && c[1] < 0.99;
    if (inside) c += 0.08 * Vector3d(std::sin(5.0 * double(i)), std::cos(7.0 * double(i)), 0);
  }
  return sheet;
}
bool on_border(Vector3d const& c) { return c[0] < 1e-9 || c[0] > 1 - 1e-9 || c[1] < 1e-9 || c[1] > 1 - 1e-9; }

/// How far the inner frames settle from displacements `move`, a displacement and a turn at a place, that the
/// border is given; against the largest of these.
template <class Move>
double patch_error(Move const& move) {
  const Sheet sheet = irregular();
  const auto border = sheet.where(on_border);
  Rigid3d::VecCoord start = sheet.x, exact = sheet.x;
  double largest = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Deriv d = move(sheet.x[i].center);
    Rigid3d::increment(exact[i], d);
    largest = std::max(largest, d.norm());
  }
  for (const int i : border) start[std::size_t(i)] = exact[std::size_t(i)];
  const Shell shell{.poissonRatio = 0.3, .youngModulus = 1e4, .thickness = 0.05};
  const Rigid3d::VecDeriv none(sheet.x.size(), Deriv::Zero());
  const auto found = settle(shell, sheet, start, {{{border, all}}}, none, 1, 1e-14).x;
  double error = 0;
  for (std::size_t i = 0; i < exact.size(); ++i)
    error = std::max(error, Rigid3d::difference(exact[i], found[i]).norm());
  return error / largest;
}

}  // namespace

// Frames inside a border that is strained or bent evenly come to the same strain or bend. What is left is of
// the second order: displacements are 1e-6 of the size.
TEST_CASE("shells pass the patch tests of membranes and of plates") {
  const double e = 1e-6;
  CHECK(patch_error([&](Vector3d const& c) {
          const double a = 0.3 * e, b = -0.5 * e, f = 0.7 * e, g = 0.4 * e;
          return wrench({a * c[0] + b * c[1], f * c[0] + g * c[1], 0}, {0, 0, (f - b) / 2});
        }) < 1e-6);
  CHECK(patch_error([&](Vector3d const& c) {
          const double a = 0.8 * e, b = -0.6 * e, f = 0.5 * e;  // w = a x^2 / 2 + b y^2 / 2 + f x y
          return wrench({0, 0, (a * c[0] * c[0] + b * c[1] * c[1]) / 2 + f * c[0] * c[1]},
                        {b * c[1] + f * c[0], -(a * c[0] + f * c[1]), 0});
        }) < 1e-6);
}

// Kirchhoff plates under an even load q: clamped square of side a, 0.00126532 q a^4 / D, supported 0.00406235
// (Timoshenko & Woinowsky-Krieger 1959, the series summed); clamped disc of radius a, q a^4 / 64 D.
namespace {

const Shell plate{.poissonRatio = 0.3, .youngModulus = 1e7, .thickness = 0.01};
const double stiffness = 1e7 * 1e-6 / (12 * (1 - 0.09)), load = 1e-4;  // D [N m], q [Pa]

double middle(Sheet const& sheet, Held const& held) {
  const auto found = settle(plate, sheet, {{held}}, sheet.spread({0, 0, load}), 1, 1e-12);
  const auto at = sheet.where([](Vector3d const& c) { return (c - Vector3d(0.5, 0.5, 0)).norm() < 1e-9; });
  REQUIRE(at.size() == 1);
  return found.x[std::size_t(at[0])].center[2] * stiffness / load;
}
/// Errors with n and 2 n cells a side: of order 2, and at most `maximum` with 2 n.
template <class Deflection>
void converges(Record& curve, std::string_view name, Deflection const& deflection, double exact, int n,
               double maximum) {
  const double coarse = deflection(n) / exact - 1, fine = deflection(2 * n) / exact - 1;
  curve.row(name, 1.0 / n, std::abs(coarse));
  curve.row(name, 0.5 / n, std::abs(fine));
  if (Record::wanted()) curve.row(name, 0.25 / n, std::abs(deflection(4 * n) / exact - 1));
  INFO("errors " << coarse << " " << fine);
  CHECK(std::abs(fine) < maximum);
  CHECK(coarse / fine == Approx(4).epsilon(0.2));
}

}  // namespace

TEST_CASE("plates under an even load sag as Kirchhoff's do, with order 2", "[page]") {
  Record curve("plates", {"plate", "h", "error"});
  converges(
      curve,
      "square, clamped",
      [](int n) {
        const Sheet sheet = flat(n, n, 1, 1);
        return middle(sheet, {sheet.where(on_border), all});
      },
      0.00126532,
      8,
      0.008);
  converges(
      curve,
      "square, supported",
      [](int n) {
        const Sheet sheet = flat(n, n, 1, 1);
        return middle(sheet, {sheet.where(on_border), places});
      },
      0.00406235,
      8,
      0.004);
  converges(
      curve,
      "disc, clamped",
      [](int n) {
        Sheet sheet = disc(n, 0.5);
        for (auto& x : sheet.x) x.center += Vector3d(0.5, 0.5, 0);
        const auto rim =
            sheet.where([](Vector3d const& c) { return (c - Vector3d(0.5, 0.5, 0)).norm() > 0.5 - 1e-9; });
        return middle(sheet, {rim, all});
      },
      0.0625 / 64,
      5,
      0.004);
}

// A strip of 10 x 1 x 0.1, nu = 0, pulled at its end across its plane and in it.
TEST_CASE("a strip bends as a beam does, across its plane and in it") {
  const double E = 1e6, h = 0.1, b = 1, L = 10, P = 1e-6;
  const Shell shell{.poissonRatio = 0, .youngModulus = E, .thickness = h};
  auto tip = [&](int nx, int ny, Vector3d const& force) {
    const Sheet sheet = flat(nx, ny, L, b);
    Rigid3d::VecDeriv loads(sheet.x.size(), Deriv::Zero());
    const auto end = sheet.where([](Vector3d const& c) { return c[0] > 10 - 1e-9; });
    for (const int i : end) {
      const double y = sheet.x[std::size_t(i)].center[1], part = y < 1e-9 || y > b - 1e-9 ? 0.5 : 1;
      loads[std::size_t(i)].head<3>() = part / ny * force;
    }
    const Held clamp{sheet.where([](Vector3d const& c) { return c[0] < 1e-9; }), all};
    const auto found = settle(shell, sheet, {{clamp}}, loads, 1, 1e-13);
    Vector3d mean = Vector3d::Zero();
    for (const int i : end)
      mean += (found.x[std::size_t(i)].center - sheet.x[std::size_t(i)].center) / double(end.size());
    return mean;
  };
  const double across = P * L * L * L / (3 * E * b * h * h * h / 12);
  CHECK(tip(10, 2, {0, 0, P})[2] == Approx(across).epsilon(0.003));
  // slender in its plane too; shear adds 1.2 P L / (G A)
  const double inPlane = P * L * L * L / (3 * E * h * b * b * b / 12) + 1.2 * P * L / (E / 2 * h * b);
  for (const int n : {1, 2, 4}) {
    const double error = tip(10 * n, n, {0, P, 0})[1] / inPlane - 1;
    INFO("cells " << n << " error " << error);
    CHECK(std::abs(error) < 0.004 / (n * n));
  }
}

// The roof of Scordelis & Lo 1964 under its weight: R = 25, L = 50, 80 degrees, 0.25 thick, E = 4.32e8, nu =
// 0, 90 a square; its ends are held in their planes. The middle of the free edge sinks by 0.3024 (MacNeal &
// Harder 1985).
TEST_CASE("the roof of Scordelis and Lo sinks as in the literature", "[page]") {
  Record table("roof", {"cells", "sinks", "ratio"});
  const Shell shell{.poissonRatio = 0, .youngModulus = 4.32e8, .thickness = 0.25};
  for (const int n : {8, 16, 32}) {
    const Sheet sheet = grid(n, n, 50, 80, [](double x, double degrees) {
      const double angle = (degrees - 40) * pi / 180;
      return Vector3d(x, 25 * std::sin(angle), 25 * std::cos(angle));
    });
    const Held ends{sheet.where([](Vector3d const& c) { return c[0] < 1e-9 || c[0] > 50 - 1e-9; }),
                    {0, 1, 1}};
    const Held along{{n / 2}, {1}};  // along the roof, one frame
    const double weight = 90e-4;
    const auto found = settle(shell, sheet, {{ends, along}}, sheet.spread({0, 0, -weight}), 1, 1e-11);
    const std::size_t edge = std::size_t(n / 2);
    const double sinks = -(found.x[edge].center[2] - sheet.x[edge].center[2]) * 90 / weight;
    table.row(n, sinks, sinks / 0.3024);
    INFO("cells " << n << " sinks " << sinks);
    CHECK(sinks == Approx(0.3024).epsilon(n == 8 ? 0.05 : 0.005));
  }
}

}  // namespace test_shells_linear
