// SPDX-License-Identifier: BSL-1.0
#include <sinew/core/element_driver.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include "catch.hpp"

#include <limits>
#include <random>

namespace test_element_driver {

using namespace sinew;

namespace {

using Matrix = CompressedRowSparseMatrixMat3x3d;
template <AssemblyPhase Phase, class M = Matrix>
using Sink = MatrixSink<Phase, M, DirectDofs<3>>;

template <class D>
struct Springs {
  using Driver = ElementDriver<SpringLaw, D, lane_width<D>()>;
  std::vector<typename Driver::Indices> points{};
  std::vector<typename Driver::Rest> rest{};

  void keep(auto&& stays) {
    Springs kept;
    for (std::size_t s = 0; s < points.size(); ++s)
      if (stays(points[s])) kept.points.push_back(points[s]), kept.rest.push_back(rest[s]);
    *this = kept;
  }
};

/// What a driver makes of springs.
template <class D, int W>
struct Result {
  using Real = typename D::Real;
  using Matrix = CompressedRowSparseMatrix<Real, 3>;
  typename D::VecDeriv force, dforce;
  double energy;
  Matrix matrix;

  Result(auto const& points, auto const& rest, typename D::VecCoord const& x, typename D::VecDeriv const& v)
      : force(x.size(), D::Deriv::Zero()), dforce(force) {
    using Driver = ElementDriver<SpringLaw, D, W>;
    const typename Driver::Law law;
    Driver driver;
    driver.init(points, rest);
    REQUIRE(driver.size() == points.size());
    driver.addForce(law, force, x, v);
    driver.addDForce(law, dforce, v, 2, 3);
    energy = driver.energy(law, x);
    matrix.startPattern(int(3 * x.size()));
    driver.addToMatrix(law, Sink<AssemblyPhase::pattern, Matrix>{matrix, {0}, {0}}, 0, 0);
    matrix.finishPattern();
    driver.addToMatrix(law, Sink<AssemblyPhase::bind, Matrix>{matrix, {0}, {0}}, 0, 0);
    matrix.setZero();
    driver.addToMatrix(law, Sink<AssemblyPhase::add, Matrix>{matrix, {0}, {0}}, 2, 3);
  }
};

/// Largest difference of two lists of scalars, beside their largest.
template <class Real>
double difference(Real const* a, Real const* b, std::size_t n) {
  double maximum = 0, largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    maximum = std::max(maximum, std::abs(double(a[i]) - double(b[i])));
    largest = std::max(largest, std::abs(double(b[i])));
  }
  REQUIRE(largest > 0);
  return maximum / largest;
}

/// Random springs between 40 points: most with damping, a third of them strings, one without length, one
/// twice, some at the last point, and a last pack that is not full.
template <class D, int W>
void check_lanes() {
  using Real = typename D::Real;
  using One = ElementDriver<SpringLaw, D, 1>;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> of(-1, 1);
  constexpr int n = 40;
  typename D::VecCoord x;
  typename D::VecDeriv v;
  auto vector = [&] { return typename D::Deriv(Real(of(random)), Real(of(random)), Real(of(random))); };
  for (int i = 0; i < n; ++i) x.push_back(vector()), v.push_back(vector());
  x[2] = x[1];
  std::vector<typename One::Indices> points{{1, 2}, {5, n - 1}, {5, n - 1}};
  while (points.size() < 16 * 7 + 5)
    if (const int i = int(random() % n), j = int(random() % n); i != j) points.push_back({i, j});
  std::vector<typename One::Rest> rest;
  for (std::size_t s = 0; s < points.size(); ++s)
    rest.push_back({Real(100 + 50 * of(random)),
                    Real(s % 4 ? 2 + of(random) : 0),
                    Real((s % 3 ? 0.8 : -0.8) * (1 + of(random)))});
  rest[0].length = 0;

  // a sum of about 12 springs at a point, each of about 20 operations
  const double rounding = 100 * std::numeric_limits<Real>::epsilon();
  const Result<D, 1> one(points, rest, x, v);
  const Result<D, W> lanes(points, rest, x, v);
  CHECK(difference(lanes.force[0].data(), one.force[0].data(), 3 * n) < rounding);
  CHECK(difference(lanes.dforce[0].data(), one.dforce[0].data(), 3 * n) < rounding);
  CHECK(difference(&lanes.energy, &one.energy, 1) < rounding);
  REQUIRE(lanes.matrix.columns == one.matrix.columns);
  REQUIRE(lanes.matrix.values.size() == one.matrix.values.size());
  CHECK(difference(lanes.matrix.values.data(), one.matrix.values.data(), one.matrix.values.size()) <
        rounding);
}

}  // namespace

TEST_CASE("springs in lanes are what they are one by one") {
  check_lanes<Vec3d, 2>();
  check_lanes<Vec3f, 4>();
#if defined(__AVX__)  // wider lanes than registers are refused by clang, and warned of by g++
  check_lanes<Vec3d, 4>();
  check_lanes<Vec3f, 8>();
#endif
}

TEMPLATE_TEST_CASE("elements that are removed leave what a driver of the others has", "", Vec3d,
                   (WithLanes<Vec3d, 1>), (WithLanes<Vec3d, 2>)) {
  using D = TestType;
  using Driver = ElementDriver<SpringLaw, D, lane_width<D>()>;
  constexpr int n = 23;
  typename D::VecCoord x;
  typename D::VecDeriv v;
  for (int i = 0; i < n; ++i) {
    x.push_back({std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i)});
    v.push_back({std::cos(2.0 * i), std::sin(4.0 * i), std::cos(6.0 * i)});
  }
  Springs<D> springs;
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; j += 1 + (i * j) % 4) {
      springs.points.push_back({i, j});
      springs.rest.push_back({100.0 + i, 1.0 + j, 0.1 * i});
    }
  Driver cut;
  cut.init(springs.points, springs.rest);
  REQUIRE(cut.size() == springs.points.size());
  const typename Driver::Law law;

  // the matrix keeps the pattern of all
  auto pattern = [&](Matrix& matrix) {
    Driver all;
    all.init(springs.points, springs.rest);
    matrix.startPattern(3 * n);
    all.addToMatrix(law, Sink<AssemblyPhase::pattern>{matrix, {0}, {0}}, 0, 0);
    matrix.finishPattern();
  };
  Matrix a, b;
  pattern(a), pattern(b);
  cut.addToMatrix(law, Sink<AssemblyPhase::bind>{a, {0}, {0}}, 0, 0);

  // some, none, those at the last point, those at others, all
  const std::vector<std::vector<int>> gone{
      {3}, {}, {n - 1}, {0, 1, 2, 9, 12, 13, 20}, {0, 1, 2, 3, 4, 5, 6, 7, 8}};
  for (auto const& ends : gone) {
    auto goes = [&](auto const& points) {
      return std::any_of(
          points.begin(), points.end(), [&](int i) { return std::count(ends.begin(), ends.end(), i) > 0; });
    };
    const std::size_t before = springs.points.size();
    springs.keep([&](auto const& points) { return !goes(points); });
    CHECK(cut.removeIf(goes) == before - springs.points.size());
    REQUIRE(cut.size() == springs.points.size());

    Driver fresh;
    fresh.init(springs.points, springs.rest);
    REQUIRE(cut.packs.size() == fresh.packs.size());
    typename D::VecDeriv f(n, D::Deriv::Zero()), g = f, df = f, dg = f;
    cut.addForce(law, f, x, v);
    fresh.addForce(law, g, x, v);
    CHECK(f == g);
    cut.addDForce(law, df, v, 2, 3);
    fresh.addDForce(law, dg, v, 2, 3);
    CHECK(df == dg);
    CHECK(cut.energy(law, x) == fresh.energy(law, x));

    fresh.addToMatrix(law, Sink<AssemblyPhase::bind>{b, {0}, {0}}, 0, 0);
    a.setZero(), b.setZero();
    cut.addToMatrix(law, Sink<AssemblyPhase::add>{a, {0}, {0}}, 2, 3);
    fresh.addToMatrix(law, Sink<AssemblyPhase::add>{b, {0}, {0}}, 2, 3);
    CHECK(a.values == b.values);
  }
  CHECK(cut.removeIf([](auto const&) { return true; }) > 0);
  CHECK(cut.size() == 0);
  CHECK(cut.packs.empty());
  CHECK(cut.removeIf([](auto const&) { return true; }) == 0);
}

}  // namespace test_element_driver
