// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "collision/simplex_pairs.hpp"

#include <algorithm>
#include <limits>

namespace test_closest_points {

using namespace sinew;
using namespace simplex_pairs;

namespace {

using Long = long double;

/// Largest errors in units of machine epsilon times the size of the pair.
struct Errors {
  double distance = 0, reported = 0, weights = 0, points = 0, direction = 0;
  Kind worst = general;
  int brute = 0;
};

template <class Real, std::size_t NA, std::size_t NB>
Errors errors(int pairs, int bruteEvery) {
  constexpr Real eps = std::numeric_limits<Real>::epsilon();
  PairMaker<Real, NA, NB> maker{std::mt19937_64(NA * 10 + NB)};
  Errors e;
  Simplex<Real, NA> a;
  Simplex<Real, NB> b;
  auto raise = [](double& worst, Long value) {
    const bool more = !(double(value) <= worst);  // NaN too
    if (more) worst = double(value);
    return more;
  };
  for (int i = 0; i < pairs; ++i) {
    const Kind kind = maker.make(a, b);
    const auto c = closest_points(a, b);
    const Long unit = Long(eps) * std::max(Long(detail::contact_size<Real, NA, NB>(a, b)), Long(1e-30));
    const auto la = to<Long>(a, a[0]);
    const auto lb = to<Long>(b, a[0]);

    // barycentric, and the points are those of the weights
    Long sumA = 0, sumB = 0;
    V3<Long> pa{0, 0, 0}, pb{0, 0, 0};
    Long largest = 0;
    for (int k = 0; k < 3; ++k) {
      const Long wa = c.weightsA[k], wb = c.weightsB[k];
      if (!(wa >= 0) || !(wb >= 0) || (k >= int(NA) && wa != 0) || (k >= int(NB) && wb != 0))
        e.weights = 1e30;
      sumA += wa, sumB += wb;
      if (k < int(NA))
        pa = pa + la[std::size_t(k)] * wa, largest = std::max<Long>(largest, a[std::size_t(k)].norm());
      if (k < int(NB))
        pb = pb + lb[std::size_t(k)] * wb, largest = std::max<Long>(largest, b[std::size_t(k)].norm());
    }
    raise(e.weights, std::max(std::abs(sumA - 1), std::abs(sumB - 1)) / eps);
    for (int k = 0; k < 3; ++k) {
      const Long ea = Long(c.pointA[k]) - a[0][k] - (k == 0 ? pa.x : k == 1 ? pa.y : pa.z);
      const Long eb = Long(c.pointB[k]) - a[0][k] - (k == 0 ? pb.x : k == 1 ? pb.y : pb.z);
      if (largest > 0) raise(e.points, std::max(std::abs(ea), std::abs(eb)) / (Long(eps) * largest));
    }
    pa = pa * (1 / sumA), pb = pb * (1 / sumB);
    const V3<Long> d = pb - pa;
    const Long distance = std::sqrt(d.dot(d));
    raise(e.reported, std::abs(std::sqrt(Long(c.squaredDistance)) - distance) / unit);

    // No pair of points is nearer: nothing is nearer than 0; what lies between two planes across d is not
    // nearer than these; else all faces are tried.
    Long lower = std::max<Long>(0, separation(la, lb, d));
    if (!((distance - lower) / unit < 4) || i % bruteEvery == 0) {
      ++e.brute;
      lower = std::sqrt(brute_squared_distance(la, lb));
    }
    if (raise(e.distance, (distance - lower) / unit)) e.worst = kind;
    raise(e.direction, std::abs(Long(contact_direction(a, b, c).norm()) - 1) / eps);
  }
  return e;
}

template <class Real, std::size_t NA, std::size_t NB>
void check(int pairs, int bruteEvery) {
  const Errors e = errors<Real, NA, NB>(pairs, bruteEvery);
  INFO(NA << " and " << NB << " points, " << pairs << " pairs, " << e.brute << " by all faces; worst kind "
          << e.worst);
  INFO("distance " << e.distance << " reported " << e.reported << " weights " << e.weights << " points "
                   << e.points << " direction " << e.direction);
  // The distance is the norm of a sum of four products: 6 roundings at most, mostly below size / 2 each. The
  // pair of points is within rounding of the nearest along every direction in which the distance changes to
  // first order; the bound between planes is taken up to 4, and contact_tolerance promises 16. 1 - s - t, and
  // w0 a + w1 b + w2 c: three or four roundings.
  CHECK(e.distance < 6);
  CHECK(e.reported < 6);
  CHECK(e.weights <= 4);
  CHECK(e.points <= 4);
  CHECK(e.direction <= 4);
}

}  // namespace

TEMPLATE_TEST_CASE("closest points of random pairs are nearest, to rounding", "[collision]", double, float) {
  check<TestType, 1, 1>(manyPairs / 10, 100);
  check<TestType, 1, 2>(manyPairs, 100);
  check<TestType, 2, 1>(manyPairs / 10, 100);
  check<TestType, 1, 3>(manyPairs, 100);
  check<TestType, 3, 1>(manyPairs / 10, 100);
  check<TestType, 2, 2>(manyPairs, 100);
  check<TestType, 2, 3>(manyPairs, 100);
  check<TestType, 3, 2>(manyPairs / 10, 100);
  check<TestType, 3, 3>(manyPairs, 100);
}

}  // namespace test_closest_points
