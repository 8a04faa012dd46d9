// SPDX-License-Identifier: BSL-1.0
// BarycentricMapping on every kind of element.
#include <sinew/mapping/barycentric_mapping.hpp>
#include <sinew/topology/regular_grid_topology.hpp>

#include <random>

#include "catch.hpp"
#include "error_of.hpp"
#include "quadratic_mesh.hpp"

namespace test_barycentric_mapping {

using namespace sinew;

namespace {

using Points = std::vector<Eigen::Vector3d>;
using Barycentric = BarycentricMapping<Vec3d, Vec3d>;

struct Random {
  std::mt19937 engine{20070105};
  double operator()(double low, double high) {
    return low + (high - low) * (double(engine() >> 5) / double(1u << 27));
  }
  Eigen::Vector3d point(double low, double high) {
    const double x = (*this)(low, high), y = (*this)(low, high), z = (*this)(low, high);
    return {x, y, z};
  }
};

/// Maps `child`, whose place after init at rest is returned in it.
Barycentric mapped(Points const& parent, TopologyView const& topology, Points& child) {
  Barycentric mapping;
  const Points given = child;
  mapping.init({"/parent", parent, topology}, {"/parent/child", given, {}}, child);
  mapping.apply(child, parent);
  return mapping;
}

RegularGridTopology grid(std::array<int, 3> n) {
  RegularGridTopology g{.n = n, .min = {0, 0, 0}, .max = Eigen::Vector3d(n[0] - 1, n[1] - 1, n[2] - 1)};
  g.generate("");
  return g;
}
Points shaken(Points x, double maximum) {
  Random random;
  for (auto& p : x) p += random.point(-maximum, maximum);
  return x;
}

// affine motion of the parent moves the child along, to 1e-12 of sizes near 10
void check_affine(Barycentric const& mapping, Points const& parent, Points const& child) {
  Eigen::Matrix3d a;
  a << 1.2, 0.3, -0.4, -0.2, 0.7, 0.5, 0.1, -0.6, 1.1;
  const Eigen::Vector3d b(3, -2, 1);
  Points x = parent, out(child.size());
  for (auto& p : x) p = a * p + b;
  mapping.apply(out, x);
  double worst = 0;
  for (std::size_t i = 0; i < child.size(); ++i) worst = std::max(worst, (out[i] - a * child[i] - b).norm());
  CHECK(worst < 1e-11);
}

void check_virtual_work(Barycentric const& mapping, std::size_t parents, std::size_t children) {
  Random random;
  Points u(parents), w(children), ju(children), jw(parents, Eigen::Vector3d::Zero());
  for (auto& p : u) p = random.point(-1, 1);
  for (auto& p : w) p = random.point(-1, 1);
  mapping.applyJ(ju, u);
  mapping.applyJT(jw, w);
  double above = 0, below = 0, blocks = 0;
  for (std::size_t i = 0; i < parents; ++i) above += u[i].dot(jw[i]);
  for (std::size_t i = 0; i < children; ++i) {
    below += ju[i].dot(w[i]);
    mapping.forEachJacobianBlock(
        int(i), [&](int k, Eigen::Matrix3d const& block) { blocks += w[i].dot(block * u[std::size_t(k)]); });
  }
  CHECK(above == Approx(below).epsilon(1e-12));
  CHECK(blocks == Approx(below).epsilon(1e-12));
}

}  // namespace

TEST_CASE("what is in a grid whose state is moved is put into place with it") {
  const auto g = grid({4, 3, 5});
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Vector3d shift(30, -20, 10);
  Points parent = g.position, child;
  for (auto& x : parent) x = rotation * x + shift;
  Random random;
  for (int i = 0; i < 50; ++i) child.push_back(random.point(0.1, 1.9));
  const Points given = child;
  mapped(parent, g.view(), child);
  double worst = 0;
  for (std::size_t i = 0; i < given.size(); ++i)
    worst = std::max(worst, (child[i] - rotation * given[i] - shift).norm());
  CHECK(worst < 1e-13);
}

TEST_CASE("hexahedra carry points inside and outside, and move them affinely along") {
  for (const double distortion : {0.0, 0.2}) {
    const auto g = grid({4, 3, 5});
    const Points parent = shaken(g.position, distortion);
    Random random;
    Points child;
    for (int i = 0; i < 300; ++i) child.push_back(random.point(-2, 6));
    const Points given = child;
    TopologyView cells = g.view();
    cells.places = {};  // of no grid
    const Barycentric mapping = mapped(parent, cells, child);
    CHECK(mapping.others.size() == 300);
    double worst = 0;
    for (std::size_t i = 0; i < given.size(); ++i) worst = std::max(worst, (child[i] - given[i]).norm());
    CHECK(worst < 1e-12);
    check_affine(mapping, parent, child);
    check_virtual_work(mapping, parent.size(), child.size());
    // inside, no weight is negative and each point is held by the cell it is in
    for (std::size_t i = 0; i < given.size(); ++i) {
      auto const& p = given[i];
      if (distortion > 0 || (p.array() < 0).any() || p[0] > 3 || p[1] > 2 || p[2] > 4) continue;
      const Index cell = Index(p[0]) + 4 * (Index(p[1]) + 3 * Index(p[2]));
      CHECK(mapping.carriers[i].points[0] == cell);
      for (auto const* list : {&mapping.carriers, &mapping.others})
        for (const double w : (*list)[i].weights) CHECK(w >= 0);
    }
  }
}

TEMPLATE_TEST_CASE("points in a row in one element are carried as each by itself", "", Vec3d, Vec3f) {
  using Real = typename TestType::Real;
  const auto g = grid({4, 3, 3});
  const std::size_t w = CarriedPoints<Vec3d, TestType>::minimum;
  Random random;
  auto check = [&](TopologyView const& topology, auto const& elements) {
    // runs as long as lanes, shorter and longer; each begins in another element than the last has ended
    typename TestType::VecCoord child;
    std::size_t runs = 0, element = 0;
    for (const std::size_t n :
         {std::size_t(1), w, w, w + 1, w - 1, 2 * w, 3 * w + 3, std::size_t(2), 50 * w}) {
      auto const& e = elements[(element += 3) % elements.size()];
      for (std::size_t i = 0; i < n; ++i) {
        Eigen::Vector3d p(0, 0, 0);
        double sum = 0;
        for (const Index k : e) {
          const double part = random(0.5, 1);
          p += part * g.position[std::size_t(k)], sum += part;
        }
        child.push_back((p / sum).template cast<Real>());
      }
      runs += n >= w;
    }
    BarycentricMapping<Vec3d, TestType> mapping;
    const auto given = child;
    mapping.init({"/parent", g.position, topology}, {"/parent/child", given, {}}, child);
    REQUIRE(mapping.together.runs.size() == (mapping.together.possible ? runs : 0));

    // sizes are below 5: ten roundings of a sum of weights times those
    const double rounding = 50 * double(std::numeric_limits<Real>::epsilon());
    const Points x = shaken(g.position, 0.5);
    typename TestType::VecCoord out(child.size()), again = out;
    mapping.apply(out, x);
    mapping.applyJ(again, x);
    CHECK(out == again);
    typename TestType::VecDeriv f;
    Points collected = x, expected = x;
    double worst = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
      f.push_back(random.point(-1, 1).template cast<Real>());
      Eigen::Vector3d place(0, 0, 0);
      mapping.forEachJacobianBlock(int(i), [&](int k, Mat<Real, 3> const& block) {
        place += block.template cast<double>() * x[std::size_t(k)];
        expected[std::size_t(k)] += block.template cast<double>() * f[i].template cast<double>();
      });
      worst = std::max(worst, (out[i].template cast<double>() - place).norm());
    }
    CHECK(worst < rounding);
    mapping.applyJT(collected, f);
    worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, (collected[i] - expected[i]).norm());
    CHECK(worst < double(w) * rounding);  // of sums of some hundred forces
    // a translation is exact in lanes
    Points moved = g.position;
    for (auto& p : moved) p = {0.1, -2.7, 3.3};
    mapping.apply(out, moved);
    for (auto const& run : mapping.together.runs)
      CHECK(std::all_of(out.begin() + std::ptrdiff_t(run.first),
                        out.begin() + std::ptrdiff_t(run.end),
                        [&](auto const& p) { return p == moved[0].template cast<Real>(); }));
  };
  const std::vector<Tetrahedron> tetrahedra{{0, 1, 4, 12}, {5, 6, 9, 17}, {18, 19, 22, 30}, {14, 15, 11, 3}};
  check({.tetrahedra = tetrahedra}, tetrahedra);
  check({.hexahedra = g.hexahedra}, g.hexahedra);
  const std::vector<Quad> sheet{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 9, 8}, {5, 6, 10, 9}};
  check({.quads = sheet}, sheet);
}

TEST_CASE("hexahedra of a grid carry trilinear motion exactly") {
  const auto g = grid({3, 3, 3});
  auto move = [](Eigen::Vector3d const& p) {
    return Eigen::Vector3d(p[0] * p[1] * p[2], p[0] * p[1] - p[2], 1 + p[1] * p[2]);
  };
  Random random;
  Points child, moved;
  for (int i = 0; i < 100; ++i) child.push_back(random.point(0, 2));
  const Barycentric mapping = mapped(g.position, g.view(), child);
  Points x = g.position, out(child.size());
  for (auto& p : x) p = move(p);
  mapping.apply(out, x);
  for (std::size_t i = 0; i < child.size(); ++i) CHECK((out[i] - move(child[i])).norm() < 1e-12);
}

TEST_CASE("points just outside a distorted hexahedron follow those just inside") {
  const auto g = grid({2, 2, 2});
  const Points rest = shaken(g.position, 0.2), x = shaken(rest, 0.3);
  Random random;
  for (auto const& face : hexahedronFaces)
    for (int i = 0; i < 10; ++i) {
      const double s = random(0, 1), t = random(0, 1),
                   w[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
      Eigen::Vector3d on(0, 0, 0), centre(0, 0, 0);
      for (std::size_t k = 0; k < 4; ++k) on += w[k] * rest[std::size_t(g.hexahedra[0][face[k]])];
      for (auto const& p : rest) centre += p / 8;
      Points child{on + 1e-6 * (centre - on), on - 1e-6 * (centre - on)}, out(2);
      const Barycentric mapping = mapped(rest, g.view(), child);
      mapping.apply(out, x);
      CHECK((out[0] - out[1]).norm() < 1e-5);
    }
}

TEST_CASE("triangles and quads carry the projection on the nearest of them") {
  // a dome over a sheet
  auto g = grid({9, 7, 1});
  for (auto& p : g.position) p[2] = 0.3 * std::sin(p[0]) * std::cos(p[1]);
  Random random;
  Points all;
  for (int i = 0; i < 300; ++i)
    all.push_back(Eigen::Vector3d(random(-2, 10), random(-2, 8), random(-1, 1) * (i < 200 ? 0.5 : 20)));
  auto check = [&](TopologyView const& topology, auto fit, auto const& elements) {
    Points child = all;
    const Barycentric mapping = mapped(g.position, topology, child);
    CHECK(mapping.others.empty());
    check_affine(mapping, g.position, child);
    check_virtual_work(mapping, g.position.size(), child.size());
    using Fit = typename decltype(fit)::type;
    const ElementLocator<Fit> locator(g.position, elements);
    for (std::size_t i = 0; i < all.size(); ++i) {
      double best = -1e300;
      for (auto const& e : elements) best = std::max(best, Fit(g.position, e).fit(all[i]).score);
      CHECK(locator.locate(all[i]).fit.score == best);
      // projecting what is projected changes nothing
      CHECK((all[i] - child[i]).norm() <= -best + 1e-12);
    }
  };
  check({.triangles = g.triangles}, std::type_identity<TriangleFit>{}, g.triangles);
  check({.quads = g.quads}, std::type_identity<MultilinearFit<2>>{}, g.quads);
}

TEST_CASE("the distance to a triangle is that to its nearest point") {
  Random random;
  for (int round = 0; round < 50; ++round) {
    const Points x{random.point(-1, 1), random.point(-1, 1), random.point(-1, 1)};
    const Eigen::Vector3d p = random.point(-2, 2);
    double nearest = 1e300;
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; i + j <= 200; ++j)
        nearest =
            std::min(nearest, (x[0] + i / 200.0 * (x[1] - x[0]) + j / 200.0 * (x[2] - x[0]) - p).norm());
    // the nearest sample is half a spacing of 3.5 / 200 away from the nearest point, at most
    const double distance = -TriangleFit(x, {0, 1, 2}).fit(p).score;
    CHECK(distance <= nearest + 1e-12);
    CHECK(distance >= nearest - 0.01);
  }
}

TEST_CASE("edges carry the projection on the nearest of them") {
  const auto g = grid({6, 1, 1});
  Points child{{1.25, 0, 0}, {2.5, 0, 7}, {9, 1, 0}, {-2, 0, 0}};
  const Barycentric mapping = mapped(g.position, g.view(), child);
  CHECK(child[0].isApprox(Eigen::Vector3d(1.25, 0, 0)));
  CHECK(child[1].isApprox(Eigen::Vector3d(2.5, 0, 0)));
  CHECK(child[2].isApprox(Eigen::Vector3d(9, 0, 0)));
  CHECK(child[3].isApprox(Eigen::Vector3d(-2, 0, 0)));
  CHECK(mapping.carriers[1].points[0] == 2);
  CHECK(mapping.carriers[1].points[1] == 3);
  check_affine(mapping, g.position, child);
  check_virtual_work(mapping, g.position.size(), child.size());
}

TEST_CASE("elements of the highest dimension carry, both kinds of it") {
  // a hexahedron with a tetrahedron on its right; its faces would carry otherwise
  Points parent = grid({2, 2, 2}).position;
  parent.push_back({2, 0, 0});
  const std::vector<Hexahedron> hexahedra{{0, 1, 3, 2, 4, 5, 7, 6}};
  const std::vector<Tetrahedron> tetrahedra{{1, 8, 3, 5}};
  const std::vector<Quad> quads{{0, 1, 3, 2}};
  const TopologyView both{.quads = quads, .tetrahedra = tetrahedra, .hexahedra = hexahedra};
  Points child{{0.5, 0.5, 0.5}, {1.2, 0.2, 0.2}}, given = child;
  const Barycentric mapping = mapped(parent, both, child);
  CHECK((child[0] - given[0]).norm() < 1e-14);
  CHECK((child[1] - given[1]).norm() < 1e-14);
  CHECK(mapping.others[0].weights[0] == Approx(1.0 / 8));
  CHECK(mapping.carriers[1].points == std::array<Index, 4>{1, 8, 3, 5});
  CHECK(mapping.others[1].weights == std::array<double, 4>{});
  check_virtual_work(mapping, parent.size(), child.size());

  // a surface of both
  const std::vector<Triangle> triangles{{1, 8, 3}};
  Points low{{0.2, 0.2, 0}, {1.3, 0.1, 0}};
  const Barycentric surface = mapped(parent, {.triangles = triangles, .quads = quads}, low);
  CHECK(surface.carriers[0].points == std::array<Index, 4>{0, 1, 3, 2});
  CHECK(surface.carriers[1].points[1] == 8);
}

TEST_CASE("prisms and pyramids carry points inside and outside, and move them affinely along") {
  const auto cells = grid({3, 3, 3});
  Points parent = shaken(cells.position, 0.1);
  std::vector<Prism> prisms;
  std::vector<Pyramid> pyramids;  // six of each cell, around its middle
  for (Hexahedron const& h : cells.hexahedra) {
    prisms.push_back({h[0], h[5], h[1], h[3], h[6], h[2]});
    prisms.push_back({h[0], h[4], h[5], h[3], h[7], h[6]});
    for (auto const& f : hexahedronFaces)
      pyramids.push_back({h[f[0]], h[f[3]], h[f[2]], h[f[1]], Index(parent.size())});
    parent.push_back((cells.position[std::size_t(h[0])] + cells.position[std::size_t(h[6])]) / 2);
  }
  for (TopologyView const& view : {TopologyView{.prisms = prisms}, TopologyView{.pyramids = pyramids}}) {
    Random random;
    Points child = parent;  // points of the elements, too: apexes, and edges at which corners coincide
    for (int i = 0; i < 200; ++i) child.push_back(random.point(-1, 3));
    const Points given = child;
    const Barycentric mapping = mapped(parent, view, child);
    double worst = 0, negative = 0;
    for (std::size_t i = 0; i < given.size(); ++i) {
      worst = std::max(worst, (child[i] - given[i]).norm());
      if ((given[i].array() > 0.15).all() && (given[i].array() < 1.85).all())
        for (auto const* list : {&mapping.carriers, &mapping.others})
          for (const double w : (*list)[i].weights) negative = std::min(negative, w);
    }
    CHECK(worst < 1e-10);
    CHECK(negative > -1e-6);  // inside an element
    check_affine(mapping, parent, child);
    check_virtual_work(mapping, parent.size(), child.size());
  }
  // the weights are the shape functions, here of the middle of the prism and of a place above the base
  const Points unit{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  const std::vector<Prism> one{{0, 1, 2, 3, 4, 5}};
  Points at{{1. / 3, 1. / 3, 0.25}};
  const Barycentric prism = mapped(unit, {.prisms = one}, at);
  CHECK(prism.carriers[0].weights[0] == Approx(0.25));
  CHECK(prism.others[0].weights[0] == Approx(0.25 / 3));
  const Points tent{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  const std::vector<Pyramid> two{{0, 1, 2, 3, 4}};
  Points above{{0, 0, 0.6}};
  const Barycentric pyramid = mapped(tent, {.pyramids = two}, above);
  for (const double w : pyramid.carriers[0].weights) CHECK(w == Approx(0.1));
  CHECK(pyramid.others[0].weights[0] == Approx(0.6));
}

TEST_CASE("tetrahedra of ten points and hexahedra of 27 carry points by their parts") {
  auto check = [](auto element) {
    Mesh mesh = one::quadratic_box<decltype(element)>(2, 2, 2, {0, 0, 0}, {2, 2, 2});
    const Points parent = shaken(mesh.positions, 0.05);
    const TopologyView view{.quadraticTetrahedra = mesh.quadraticTetrahedra,
                            .triquadraticHexahedra = mesh.triquadraticHexahedra};
    Random random;
    Points child = parent;
    for (int i = 0; i < 200; ++i) child.push_back(random.point(-1, 3));
    const Points given = child;
    const Barycentric mapping = mapped(parent, view, child);
    for (std::size_t i = 0; i < given.size(); ++i) {
      CHECK((child[i] - given[i]).norm() < 1e-10);
      if ((given[i].array() > 0.15).all() && (given[i].array() < 1.85).all())
        for (const double w : mapping.carriers[i].weights) CHECK(w > -1e-6);  // inside an element
      if (i >= parent.size()) continue;
      double most = 0;  // a node is carried by itself
      for (auto const* list : {&mapping.carriers, &mapping.others})
        if (!list->empty())
          for (std::size_t k = 0; k < 4; ++k)
            if ((*list)[i].points[k] == Index(i)) most += (*list)[i].weights[k];
      CHECK(most == Approx(1).epsilon(1e-6));
    }
    check_affine(mapping, parent, child);
    check_virtual_work(mapping, parent.size(), child.size());
  };
  check(QuadraticTetrahedron{}), check(TriquadraticHexahedron{});
  const Mesh twenty = one::quadratic_box<QuadraticHexahedron>(1, 1, 1, {0, 0, 0}, {1, 1, 1});
  Points at{{0.5, 0.5, 0.5}};
  const std::string said =
      error_of([&] { mapped(twenty.positions, {.quadraticHexahedra = twenty.quadraticHexahedra}, at); });
  CHECK(said.find("take hexahedra of 27 points") != said.npos);
}

TEST_CASE("a child that starts elsewhere is carried by where it rests, if it says so") {
  const Points parent = grid({3, 3, 3}).position;
  const auto cells = grid({3, 3, 3});
  const Points rest{{0.3, 0.4, 0.6}, {1.2, 0.1, 0.9}};
  Points child{{5, 5, 5}, {6, 6, 6}};
  Barycentric mapping{.useRestPosition = true};
  mapping.init({"/parent", parent, {.hexahedra = cells.hexahedra}}, {"/parent/child", rest, {}}, child);
  Points moved = parent;
  for (auto& x : moved) x += Eigen::Vector3d(1, 2, 3);
  mapping.apply(child, moved);
  for (std::size_t i = 0; i < 2; ++i) CHECK((child[i] - rest[i] - Eigen::Vector3d(1, 2, 3)).norm() < 1e-14);
  Points three(3, rest[0]);
  CHECK(
      error_of([&] {
        mapping.init({"/parent", parent, {.hexahedra = cells.hexahedra}}, {"/parent/child", rest, {}}, three);
      }).find("the child has 3 points and 2 rest positions") != std::string::npos);
}

TEST_CASE("BarycentricMapping says what is wrong with its parent") {
  const Points x = grid({2, 2, 1}).position;
  auto said = [&](TopologyView const& topology) {
    Points child{{0.3, 0.3, 0}};
    return error_of([&] { mapped(x, topology, child); });
  };
  auto contains = [](std::string_view whole, std::string_view part) {
    return whole.find(part) != whole.npos;
  };
  const std::vector<Triangle> good{{0, 1, 2}}, outside{{0, 1, 4}}, flat{{0, 1, 1}},
      some{{0, 1, 1}, {1, 2, 3}};
  const std::vector<Hexahedron> sheet{{0, 1, 3, 2, 0, 1, 3, 2}};
  const std::vector<Quad> line{{0, 1, 1, 0}};
  const std::vector<Edge> point{{2, 2}};
  CHECK(said({.triangles = good}).empty());
  CHECK(said({.triangles = some}).empty());  // one that is not flat is enough
  CHECK(contains(said({}),
                 "/parent/child: BarycentricMapping<Vec3d, Vec3d>: the topology of /parent has no elements"));
  CHECK(contains(said({.triangles = outside}),
                 "/parent: triangle 0 refers to point 4, but there are 4 points"));
  CHECK(contains(said({.triangles = flat}), "all flat"));
  CHECK(contains(said({.quads = line}), "all flat"));
  CHECK(contains(said({.edges = point}), "all flat"));
  CHECK(contains(said({.hexahedra = sheet}), "all flat"));
  const std::vector<Tetrahedron> square{{0, 1, 2, 3}};
  CHECK(contains(said({.tetrahedra = square}), "all flat"));
  // nothing to carry is no mistake
  Points none;
  CHECK(error_of([&] { mapped(x, {.triangles = good}, none); }).empty());
}

}  // namespace test_barycentric_mapping
