// SPDX-License-Identifier: BSL-1.0
#include <sinew/topology/hexahedra.hpp>
#include <sinew/topology/quality.hpp>
#include <sinew/topology/sparse_grid_topology.hpp>

#include <random>

#include "io/files.hpp"
#include "mesh_checks.hpp"

namespace test_sparse_grid_topology {

using namespace sinew;

namespace {

/// A box of 12 triangles that look outwards.
Mesh block(Eigen::Vector3d const& center, Eigen::Matrix3d const& rotation, Eigen::Vector3d const& half) {
  Mesh mesh;
  for (auto const& c : hexahedronCorners)
    mesh.positions.push_back(
        center + rotation * half.cwiseProduct(Eigen::Vector3d(2 * c[0] - 1, 2 * c[1] - 1, 2 * c[2] - 1)));
  for (auto const& f : hexahedronFaces) {
    mesh.triangles.push_back({Index(f[0]), Index(f[1]), Index(f[2])});
    mesh.triangles.push_back({Index(f[0]), Index(f[2]), Index(f[3])});
  }
  return mesh;
}
Mesh both(Mesh a, Mesh const& b, bool turned) {
  const auto n = Index(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (Triangle t : b.triangles) {
    if (turned) std::swap(t[1], t[2]);
    a.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  return a;
}

SparseGridTopology made(SparseGridTopology grid) {
  grid.generate("/root");
  return grid;
}
std::string refusal(SparseGridTopology const& grid) {
  return error_of([&] { made(grid); });
}

/// Whether two boxes share a point, one of them turned: fifteen axes (Gottschalk, Lin, Manocha 1996).
bool boxes_meet(Eigen::Vector3d const& a, Eigen::Vector3d const& halfA, Eigen::Vector3d const& b,
                Eigen::Matrix3d const& rotation, Eigen::Vector3d const& halfB) {
  std::vector<Eigen::Vector3d> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(Eigen::Vector3d::Unit(i)), axes.push_back(rotation.col(i));
    for (int j = 0; j < 3; ++j) axes.push_back(Eigen::Vector3d::Unit(i).cross(rotation.col(j)));
  }
  for (auto const& axis : axes)
    if (std::abs(axis.dot(a - b)) >
        axis.cwiseAbs().dot(halfA) + (rotation.transpose() * axis).cwiseAbs().dot(halfB) + 1e-12)
      return false;
  return true;
}

// volume of the cells, which are all alike
double volume(SparseGridTopology const& g) {
  auto const& h = g.hexahedra[0];
  return double(g.hexahedra.size()) * (g.points[std::size_t(h[6])] - g.points[std::size_t(h[0])]).prod();
}

const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();

}  // namespace

TEST_CASE("SparseGridTopology keeps just the cells that a turned block meets") {
  std::mt19937 random{11};
  auto number = [&](double low, double high) {
    return low + (high - low) * (double(random() >> 5) / double(1u << 27));
  };
  for (int round = 0; round < 10; ++round) {
    const Eigen::Matrix3d rotation =
        Eigen::Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1))
            .normalized()
            .toRotationMatrix();
    const Eigen::Vector3d center(number(-5, 5), number(-5, 5), number(-5, 5)),
        half(number(0.3, 2), number(0.3, 2), number(0.3, 2));
    const Mesh mesh = block(center, rotation, half);
    const Eigen::Vector3d lo = center - Eigen::Vector3d::Constant(4),
                          hi = center + Eigen::Vector3d(4, 5, 4.5);
    const auto grid = made(
        {.n = {15, 13, 18}, .position = mesh.positions, .triangles = mesh.triangles, .min = lo, .max = hi});
    const Mesh whole = regular_grid(15, 13, 18, lo, hi);
    std::vector<Eigen::Vector3d> expected;
    for (auto const& h : whole.hexahedra) {
      const Eigen::Vector3d a = whole.positions[std::size_t(h[0])], b = whole.positions[std::size_t(h[6])];
      if (boxes_meet((a + b) / 2, (b - a) / 2, center, rotation, half)) expected.push_back(a);
    }
    REQUIRE(grid.hexahedra.size() == expected.size());
    std::vector<Eigen::Vector3d> found;
    for (auto const& h : grid.hexahedra) found.push_back(grid.points[std::size_t(h[0])]);
    auto before = [](Eigen::Vector3d const& a, Eigen::Vector3d const& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::sort(found.begin(), found.end(), before);
    std::sort(expected.begin(), expected.end(), before);
    CHECK(found == expected);
    CHECK(std::is_sorted(grid.points.begin(), grid.points.end(), before));  // as SOFA numbers them
    // cells that meet the surface come first: those that are there without the others
    auto without = grid;
    without.onlyInsideCells = true;
    if (error_of([&] { without.generate("s"); }).empty()) {
      const std::size_t inside = without.hexahedra.size();
      REQUIRE(inside <= grid.hexahedra.size());
      for (std::size_t i = 0; i < inside; ++i)
        CHECK(without.points[std::size_t(without.hexahedra[i][0])] ==
              grid.points[std::size_t(grid.hexahedra[grid.hexahedra.size() - inside + i][0])]);
    }

    // its points are those of its cells, once each; split, it is conforming and positive
    Mesh split;
    split.positions = grid.points;
    split.tetrahedra = hexahedra_to_tetrahedra(grid.hexahedra);
    CHECK(is_conforming(split));
    CHECK(quality(split).minVolume > 0);
    CHECK(grid.edges == edges_of(grid.hexahedra));
    CHECK(made(grid).points == grid.points);  // made again, it is the same

    auto inner = grid;
    inner.onlyInsideCells = true;
    inner.n = {60, 60, 60};
    inner = made(inner);
    CHECK(volume(inner) < 8 * half.prod());
    for (auto const& p : inner.points)
      CHECK(((rotation.transpose() * (p - center)).cwiseAbs().array() < half.array()).all());
  }
}

TEST_CASE("the grid is that of the surface and a hundredth more, unless it is given") {
  const Mesh mesh = block({1, 2, 3}, straight, {1, 2, 3});
  const SparseGridTopology plain{.n = {3, 4, 5}, .position = mesh.positions, .triangles = mesh.triangles};
  const auto grid = made(plain);
  CHECK(grid.hexahedra.size() == 2 * 3 * 4);
  CHECK(grid.points.front().isApprox(Eigen::Vector3d(-0.02, -0.04, -0.06)));
  CHECK(grid.points.back().isApprox(Eigen::Vector3d(2.02, 4.04, 6.06)));
  CHECK(grid.view().positions.size() == 60);
  CHECK(grid.view().hexahedra.size() == 24);
  auto cells = plain;
  cells.cellWidth = 1, cells.min = Eigen::Vector3d(0, 0, 0), cells.max = Eigen::Vector3d(2, 3.5, 6);
  cells = made(cells);
  CHECK(cells.hexahedra.size() == 2 * 4 * 6);
  CHECK(cells.points.back().isApprox(Eigen::Vector3d(2, 4, 6)));
  // a surface that lies on faces of cells closes them all the same
  auto onFaces = plain;
  onFaces.n = {11, 11, 11}, onFaces.min = Eigen::Vector3d(-4, -3, -2), onFaces.max = Eigen::Vector3d(6, 7, 8);
  CHECK(made(onFaces).hexahedra.size() == 4 * 6 * 8);
  onFaces.onlyInsideCells = true;
  CHECK(error_of([&] { made(onFaces); }).find("no cell is inside") != std::string::npos);  // one is 2 wide
}

TEST_CASE("cavities stay empty, bodies in bodies are full, several bodies are kept", "[long]") {
  const Mesh outer = block({0, 0, 0}, straight, {2, 2, 2}), inner = block({0, 0, 0}, straight, {1, 1, 1}),
             beside = block({5, 0, 0}, straight, {2, 2, 2});
  auto cells = [](Mesh const& mesh) {
    return made({.position = mesh.positions, .triangles = mesh.triangles, .cellWidth = 0.1});
  };
  // between cells of 0.1 and boxes 1 % beyond, 0.3 a direction is the most that can be added or taken
  CHECK(std::cbrt(volume(cells(outer))) == Approx(4).margin(0.3));
  const double hollow = 64 - volume(cells(both(outer, inner, true)));
  CHECK(std::cbrt(hollow) == Approx(2).margin(1.5));
  CHECK(hollow < 8);
  CHECK(volume(cells(both(outer, inner, true))) < volume(cells(outer)) - 1.5 * 1.5 * 1.5);
  CHECK(volume(cells(both(outer, inner, false))) == volume(cells(outer)));
  CHECK(volume(cells(both(outer, beside, false))) == Approx(2 * 64).epsilon(0.2));
  // a surface that looks inwards as a whole is closed as well
  Mesh turned = outer;
  for (auto& t : turned.triangles) std::swap(t[0], t[1]);
  CHECK(cells(turned).hexahedra == cells(outer).hexahedra);
}

TEST_CASE("surfaces of quads and from files are the same") {
  const Mesh mesh = block(
      {0, 1, 0}, Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(), {1, 2, 3});
  std::vector<Quad> quads;
  std::string obj;
  for (auto const& p : mesh.positions) {
    char line[100];
    std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    obj += line;
  }
  for (auto const& f : hexahedronFaces) {
    quads.push_back({Index(f[0]), Index(f[1]), Index(f[2]), Index(f[3])});
    obj += text("f ", f[0] + 1, ' ', f[1] + 1, ' ', f[2] + 1, ' ', f[3] + 1, '\n');
  }
  const auto grid = made({.n = {9, 9, 9}, .position = mesh.positions, .triangles = mesh.triangles});
  const files::TempFolder folder;
  const auto same = made({.n = {9, 9, 9}, .position = mesh.positions, .quads = quads});
  const auto read = made({.n = {9, 9, 9}, .fileTopology = {folder.write("a.obj", obj)}});
  CHECK(same.points == grid.points);
  CHECK(read.points == grid.points);
  CHECK(read.hexahedra == grid.hexahedra);
}

TEST_CASE("points alone have the cells that they are in, and those that these shut in") {
  std::vector<Eigen::Vector3d> corners, shell;  // of a cube; of all cells of another but its middle
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d p = Eigen::Vector3d(i, j, k) + Eigen::Vector3d::Constant(0.5);
        if (i != 1 && j != 1 && k != 1) corners.push_back(p);
        if (i != 1 || j != 1 || k != 1) shell.push_back(p);
      }
  const Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Constant(3);
  const auto apart = made({.n = {4, 4, 4}, .position = corners, .min = low, .max = high});
  CHECK(apart.hexahedra.size() == 8);
  CHECK(apart.points.size() == 64);  // no two have a corner in common
  CHECK(apart.fill == std::vector<double>(8, 0.5));
  for (auto const& h : apart.hexahedra) {
    int held = 0;
    for (auto const& p : corners)
      held += (p - (apart.points[std::size_t(h[0])] + apart.points[std::size_t(h[6])]) / 2).norm() < 1e-12;
    CHECK(held == 1);
  }
  const auto shut = made({.n = {4, 4, 4}, .position = shell, .min = low, .max = high});
  CHECK(shut.hexahedra.size() == 27);
  CHECK(std::count(shut.fill.begin(), shut.fill.end(), 1.0) == 1);
  CHECK(
      made({.n = {4, 4, 4}, .position = shell, .min = low, .max = high, .fillWeighted = false}).fill.empty());
  // a box is 1 % larger than the points
  CHECK(made({.n = {2, 2, 2}, .position = corners}).points[0] == Eigen::Vector3d::Constant(0.48));
}

TEST_CASE("a surface far from the origin is met as one near it") {
  const Mesh near = block({0, 0, 0}, straight, {1, 1, 1}), far = block({1e6, -1e6, 1e6}, straight, {1, 1, 1});
  const auto a = made({.n = {12, 12, 12}, .position = near.positions, .triangles = near.triangles});
  const auto b = made({.n = {12, 12, 12}, .position = far.positions, .triangles = far.triangles});
  CHECK(a.hexahedra == b.hexahedra);
}

TEST_CASE("SparseGridTopology says what is wrong, and keeps what it had") {
  const Mesh mesh = block({0, 0, 0}, straight, {1, 1, 1});
  const SparseGridTopology good{.n = {8, 8, 8}, .position = mesh.positions, .triangles = mesh.triangles};
  CHECK(refusal(good).empty());
  auto change = [&](auto edit) {
    SparseGridTopology grid = made(good);
    const auto before = grid.points;
    edit(grid);
    const std::string said = error_of([&] { grid.generate("/root"); });
    CHECK(contains(said, "/root: SparseGridTopology: "));
    CHECK((grid.points == before));
    return said;
  };
  CHECK(contains(change([](auto& g) { g.triangles.clear(), g.position.clear(); }), "there is no point"));
  CHECK(contains(change([](auto& g) { g.triangles.resize(6); }), "the surface is not closed"));
  CHECK(contains(change([](auto& g) {
                   for (std::size_t t = 0; t < 6; ++t) std::swap(g.triangles[t][0], g.triangles[t][1]);
                 }),
                 "do not all look outwards"));
  CHECK(contains(change([](auto& g) { g.triangles[3][1] = 8; }), "triangle 3 refers to point 8"));
  CHECK(contains(change([](auto& g) { g.quads = {{0, 1, 2, -1}}; }), "quad 0 refers to point -1"));
  CHECK(contains(change([](auto& g) { g.position[4][2] = std::nan(""); }), "point 4 has a coordinate"));
  CHECK(contains(change([](auto& g) { g.n = {8, 1, 8}; }), "at least 2 each way"));
  CHECK(contains(change([](auto& g) { g.n = {400, 400, 400}; }), "2^24"));
  CHECK(contains(change([](auto& g) { g.cellWidth = 1e-9; }), "2^24"));
  CHECK(contains(change([](auto& g) { g.min = Eigen::Vector3d(2, 0, 0); }), "is empty"));
  CHECK(contains(change([](auto& g) {
                   g.min = Eigen::Vector3d(2, 2, 2);
                   g.max = Eigen::Vector3d(3, 3, 3);
                 }),
                 "no cell touches the surface or is inside"));
  CHECK(contains(change([](auto& g) { g.n = {2, 2, 2}, g.onlyInsideCells = true; }), "no cell is inside"));
  CHECK(
      contains(change([](auto& g) { g.fileTopology.path = "missing.obj"; }), "missing.obj: cannot be read"));
  CHECK(contains(change([](auto& g) { g.fileTopology.path = "a.step"; }),
                 "files ending in \".step\" are not read"));
  // flat: all points in a plane
  CHECK(contains(change([](auto& g) {
                   for (auto& p : g.position) p[2] = 0;
                 }),
                 "is empty"));
  CHECK(contains(error_of([] { check_fields(SparseGridTopology{.n = {2, 1, 2}}, "s"); }), "n[1] is 1"));

  const auto grid = made(good);
  const std::vector<Eigen::Vector3d> few(grid.points.size() - 1, Eigen::Vector3d::Zero());
  CHECK(contains(error_of([&] {
                   grid.init(InitContext<Vec3d>{"/root", few, grid.view()});
                 }),
                 "but the state"));
}

// in SOFA too
TEST_CASE("cells that touch the surface are half filled, unless fillWeighted is off") {
  const Mesh cube = block(Eigen::Vector3d::Zero(), straight, Eigen::Vector3d::Constant(1));
  SparseGridTopology grid{.n = {6, 6, 6}, .position = cube.positions, .triangles = cube.triangles};
  const auto half = made(grid);
  // 5 cells each way, of which 3 are inside
  REQUIRE(half.view().fill.size() == 125);
  for (std::size_t e = 0; e < 125; ++e) CHECK(half.fill[e] == (e < 98 ? 0.5 : 1.0));
  grid.fillWeighted = false;
  CHECK(made(grid).view().fill.empty());
}

}  // namespace test_sparse_grid_topology
