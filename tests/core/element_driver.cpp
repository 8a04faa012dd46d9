// SPDX-License-Identifier: BSL-1.0
#include <sinew/core/element_driver.hpp>
#include <sinew/force/spring_law.hpp>
#include <sinew/linalg/block_matrix.hpp>

#include "catch.hpp"

using namespace sinew;

namespace {

using Matrix = CompressedRowSparseMatrixMat3x3d;
template <AssemblyPhase Phase>
using Sink = MatrixSink<Phase, Matrix, DirectDofs<3>>;

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

}  // namespace

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
