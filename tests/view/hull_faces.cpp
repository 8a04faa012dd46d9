// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/view/hull_faces.hpp>

#include <numbers>
#include <random>
#include <set>

namespace test_hull_faces {

using namespace sinew;
using Points = std::vector<Eigen::Vector3d>;

double volume_of(Points const& p, std::vector<Triangle> const& faces) {
  double six = 0;
  for (auto const& [a, b, c] : faces)
    six += p[std::size_t(a)].dot(p[std::size_t(b)].cross(p[std::size_t(c)]));
  return six / 6;
}
// each edge is passed once in each direction: a closed surface whose faces agree on what is outside
bool is_closed(std::vector<Triangle> const& faces) {
  std::set<std::pair<Index, Index>> edges;
  for (auto const& f : faces)
    for (std::size_t k = 0; k < 3; ++k)
      if (!edges.emplace(f[k], f[(k + 1) % 3]).second) return false;
  for (auto const& [i, j] : edges)
    if (!edges.contains({j, i})) return false;
  return true;
}

TEST_CASE("the faces of a convex hull close around its volume") {
  // a box, with points inside, on its faces and on its edges
  Points box;
  for (int x = 0; x <= 2; ++x)
    for (int y = 0; y <= 2; ++y)
      for (int z = 0; z <= 2; ++z) box.push_back({1. * x, 0.5 * y, 5 + 2. * z});
  auto faces = view::HullFaces(box).triangles();
  CHECK(is_closed(faces));
  CHECK(volume_of(box, faces) == Approx(2 * 1 * 4));
  CHECK(faces.size() == 12);
  // a round cloud, all of whose points are corners: 2 n - 4 faces
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  Points ball(500);
  for (auto& p : ball) p = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
  faces = view::HullFaces(ball).triangles();
  CHECK(is_closed(faces));
  CHECK(faces.size() == 2 * ball.size() - 4);
  CHECK(volume_of(ball, faces) < 4. / 3 * std::numbers::pi);
  CHECK(volume_of(ball, faces) > 0.97 * 4. / 3 * std::numbers::pi);
  for (auto const& [a, b, c] : faces) {
    auto at = [&](Index i) { return ball[std::size_t(i)]; };
    const Eigen::Vector3d n = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    for (auto const& p : ball) CHECK(n.dot(p - at(a)) < 1e-9);
  }
  // what is flat has the polygon around it, here of 2 m^2
  const Points plate{{0, 0, 1}, {1, 0, 1}, {0, 2, 1}, {1, 2, 1}, {0.5, 0.5, 1}, {0, 1, 1}};
  faces = view::HullFaces(plate).triangles();
  CHECK(faces.size() == 2);
  double area = 0;
  for (auto const& [a, b, c] : faces) {
    auto at = [&](Index i) { return plate[std::size_t(i)]; };
    area += (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
  }
  CHECK(area == Approx(2));
  CHECK(view::HullFaces(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).triangles().size() == 1);
  // what is straight, one place, or too few points has none
  CHECK(view::HullFaces(Points{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).triangles().empty());
  CHECK(view::HullFaces(Points(5, Eigen::Vector3d(1, 2, 3))).triangles().empty());
  CHECK(view::HullFaces(Points{}).triangles().empty());
}

}  // namespace test_hull_faces
