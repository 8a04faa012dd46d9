// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/linalg/multigrid.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>

namespace test_multigrid {

using namespace sinew;

namespace {

using Matrix3d = CompressedRowSparseMatrixMat3x3d;
using Row = Multigrid::Row;

/// A body of springs along the edges of tetrahedra, K = u u' of direction u, with the rigid motions of its
/// points.
struct Body {
  Mesh mesh;
  Matrix3d matrix{};
  std::vector<Row> modes{};

  explicit Body(std::array<int, 3> n, double mass = 0)
      : mesh(regular_grid_tetrahedra(n[0], n[1], n[2], {1, 2, 3}, {1.0 + n[0], 2.0 + n[1], 3.0 + n[2]})) {
    const int points = int(mesh.positions.size());
    matrix.startPattern(3 * points);
    each([&](int i, int j, auto const&) { matrix.preallocate(3 * i, 3 * j, 3, 3); });
    matrix.finishPattern();
    matrix.setZero();
    each([&](int i, int j, Eigen::Matrix3d const& k) {
      matrix.add(3 * i, 3 * i, k);
      matrix.add(3 * j, 3 * j, k);
      matrix.add(3 * std::min(i, j), 3 * std::max(i, j), Eigen::Matrix3d(-k));
    });
    modes.assign(std::size_t(3 * points), Row{});
    for (int i = 0; i < points; ++i) {
      Eigen::Vector3d const& x = mesh.positions[std::size_t(i)];
      Row* const m = &modes[std::size_t(3 * i)];
      m[0][0] = m[1][1] = m[2][2] = 1;
      m[0][4] = x[2], m[0][5] = -x[1], m[1][3] = -x[2], m[1][5] = x[0], m[2][3] = x[1], m[2][4] = -x[0];
      matrix.add(3 * i, 3 * i, Eigen::Matrix3d(mass * Eigen::Matrix3d::Identity()));
    }
  }

  template <class F>
  void each(F&& f) const {
    for (auto const& t : mesh.tetrahedra)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b) {
          const Eigen::Vector3d u =
              (mesh.positions[std::size_t(t[a])] - mesh.positions[std::size_t(t[b])]).normalized();
          f(t[a], t[b], Eigen::Matrix3d(u * u.transpose()));
        }
  }
};

Multigrid cycle_of(Body const& body, MultigridSettings settings = {.coarsestSize = 30}) {
  Multigrid m;
  m.settings = settings;
  m.init(body.matrix, OneThread{});
  m.modes = body.modes;
  m.update(OneThread{}, body.matrix);
  return m;
}

Eigen::MatrixXd dense(Multigrid& m, int n) {
  Eigen::MatrixXd all(n, n);
  Eigen::VectorXd e(n + 1), z = Eigen::VectorXd::Zero(n + 1);
  for (int i = 0; i < n; ++i) {
    e = Eigen::VectorXd::Unit(n + 1, i);
    m.apply(OneThread{}, e, z);
    all.col(i) = z.head(n);
  }
  return all;
}

/// The largest |A P B| over |A| |B|, and |P B_coarse - B| over |B|, of a level.
template <int R>
std::array<double, 2> rigid_errors(MultigridLevel<R>& level, std::vector<Row> const& below) {
  auto const& p = level.down;
  std::vector<Row> kept(level.modes.size(), Row{}), forces = kept;
  double most = 0, difference = 0, force = 0;
  for (std::size_t i = 0; i + 1 < p.start.size(); ++i)
    for (int s = p.start[i]; s < p.start[i + 1]; ++s)
      for (std::size_t r = 0; r < std::size_t(R); ++r)
        for (int c = 0; c < 6; ++c)
          kept[i * R + r] += double(p.values[std::size_t(s * R) + r][c]) *
                             below[std::size_t(6 * p.columns[std::size_t(s)] + c)];
  for (int i = 0; i < level.matrix.rows(); ++i)
    level.matrix.forEachInRow(i, [&](int j, int slot, bool transposed) {
      add_block_product<R>(std::as_const(level.matrix).block(slot),
                           transposed,
                           &kept[std::size_t(j * R)],
                           &forces[std::size_t(i * R)]);
    });
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (int c = 0; c < 6; ++c) {
      most = std::max(most, std::abs(level.modes[i][c]));
      difference = std::max(difference, std::abs(kept[i][c] - level.modes[i][c]));
      force = std::max(force, std::abs(forces[i][c]));
    }
  return {force / most, difference / most};
}

/// Points of a grid, those that are there, and as neighbours those that differ by one in one direction and
/// are joined.
struct Grid {
  Lattice lattice{};
  std::vector<int> start{0}, neighbours{};

  template <class There, class Joined>
  Grid(std::array<int, 3> n, There there, Joined joined) {
    lattice.size = n;
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          if (there(x, y, z)) lattice.of.push_back({x, y, z});
    for (auto const& a : lattice.of) {
      for (std::size_t k = 0; k < lattice.of.size(); ++k) {
        auto const& b = lattice.of[k];
        const int apart = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
        if (apart == 1 && joined(a, b)) neighbours.push_back(int(k));
      }
      start.push_back(int(neighbours.size()));
    }
  }
  LatticeCells cells() const { return aggregate_cells(lattice, start, neighbours); }
};

}  // namespace

TEST_CASE("the coarse space of a free body has its rigid motions") {
  Body body({16, 7, 7});
  Multigrid m = cycle_of(body, {.coarsestSize = 6});
  REQUIRE(m.levels() >= 3);
  // P is in float
  const double rounding = std::numeric_limits<float>::epsilon();
  const auto [force, difference] = rigid_errors(m.fine, m.coarse[0].modes);
  CHECK(force < 20 * rounding);
  CHECK(difference < 20 * rounding);
  const auto [force1, difference1] = rigid_errors(m.coarse[0], m.coarse[1].modes);
  CHECK(force1 < 20 * rounding);
  CHECK(difference1 < 20 * rounding);
}

TEST_CASE("a cycle is symmetric and positive definite") {
  for (const double mass : {1e-3, 1.0}) {
    Body body({6, 4, 4}, mass);
    const int n = body.matrix.dofs();
    for (const int degree : {1, 2, 3, 4}) {
      // the last of them W-cycles over coarse levels of which none is solved by its factor
      Multigrid m = cycle_of(body,
                             degree < 4 ? MultigridSettings{.coarsestSize = 30, .degree = degree}
                                        : MultigridSettings{.coarsestSize = 1, .degree = 2, .cycles = 2});
      REQUIRE(m.levels() >= (degree < 4 ? 2 : 3));
      const Eigen::MatrixXd z = dense(m, n);
      CHECK((z - z.transpose()).norm() < 1e-5 * z.norm());  // of float
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(0.5 * (z + z.transpose()));
      CHECK(of.eigenvalues()[0] > 0);
    }
  }
}

TEST_CASE("a system that is its own coarsest level is solved to float") {
  Body body({3, 3, 3}, 0.1);
  Multigrid m = cycle_of(body, {.coarsestSize = 1000});
  CHECK(m.levels() == 1);
  const int n = body.matrix.dofs();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1), x = b, back = b;
  for (int i = 0; i < n; ++i) b[i] = std::sin(3.0 * i);
  m.apply(OneThread{}, b, x);
  body.matrix.multiply(x.data(), back.data());
  CHECK((back - b).norm() < 1e-5 * b.norm());
}

TEST_CASE("units do not matter") {
  Body body({6, 4, 4}, 1e-2);
  const int n = body.matrix.dofs();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1), x = b, y = b;
  for (int i = 0; i < n; ++i) b[i] = std::sin(3.0 * i);
  cycle_of(body).apply(OneThread{}, b, x);
  for (auto& v : body.matrix.values) v *= 1e60;
  b *= 1e-60;
  cycle_of(body).apply(OneThread{}, b, y);
  CHECK((1e120 * y - x).norm() < 1e-5 * x.norm());
}

TEST_CASE("what is held takes nothing from coarse levels, and may change") {
  Body body({9, 4, 4}, 1e-3);
  auto held = body;
  for (int dof = 0; dof < 30; ++dof) held.matrix.fix(dof);
  // a direction of a point: rows of its projector
  const Eigen::Vector3d normal = Eigen::Vector3d(1, 2, -1).normalized();
  held.matrix.project(60, Eigen::Matrix3d(Eigen::Matrix3d::Identity() - normal * normal.transpose()));
  Multigrid m = cycle_of(held);
  for (int i = 0; i < 10; ++i)
    CHECK(m.fine.down.start[std::size_t(i)] == m.fine.down.start[std::size_t(i) + 1]);
  double along = 0;
  for (int c = 0; c < 6; ++c) {
    Eigen::Vector3d mode;
    for (int r = 0; r < 3; ++r) mode[r] = m.fine.modes[std::size_t(60 + r)][c];
    // modes are those of unknowns that make the diagonal block one
    along = std::max(along, std::abs(normal.dot(m.fine.unit.inverse[20].transpose() * mode)));
  }
  CHECK(along < 1e-10);
  m.update(OneThread{}, body.matrix);  // held no more
  for (int i = 0; i < 10; ++i)
    CHECK(m.fine.down.start[std::size_t(i)] < m.fine.down.start[std::size_t(i) + 1]);
}

TEST_CASE("aggregates of the first update come back with what was held then") {
  Body body({9, 4, 4}, 1e-3);
  auto held = body, soft = body;
  for (int dof = 0; dof < 30; ++dof) held.matrix.fix(dof);
  for (auto& v : soft.matrix.values) v *= 1e-6;
  for (int i = 0; i < soft.matrix.rows(); ++i)
    soft.matrix.add(3 * i, 3 * i, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  Multigrid m = cycle_of(body);
  const std::vector<int> first = m.fine.down.aggregate;
  m.update(OneThread{}, held.matrix);
  CHECK(m.fine.down.aggregate != first);
  m.update(OneThread{}, soft.matrix);  // by itself it would have no aggregates
  CHECK(m.fine.down.aggregate == first);
  CHECK(cycle_of(soft).levels() == 1);
}

TEST_CASE("zeros on the diagonal and numbers that are not finite do no harm") {
  Body body({6, 4, 4}, 1e-3);
  const int n = body.matrix.dofs();
  Eigen::VectorXd b = Eigen::VectorXd::Ones(n + 1), x = Eigen::VectorXd::Zero(n + 1);
  auto hole = body;
  hole.matrix.forEachInRow(7, [&](int, int slot, bool) {
    for (int k = 0; k < 9; ++k) hole.matrix.block(slot)[k] = 0;
  });
  cycle_of(hole).apply(OneThread{}, b, x);
  CHECK(x.head(n).allFinite());
  auto broken = body;
  broken.matrix.values[100] = std::numeric_limits<double>::quiet_NaN();
  cycle_of(broken).apply(OneThread{}, b, x);
  auto negative = body;
  for (auto& v : negative.matrix.values) v = -v;
  cycle_of(negative).apply(OneThread{}, b, x);
  CHECK(x.head(n).allFinite());
  auto nothing = body;
  nothing.matrix.setZero();
  cycle_of(nothing).apply(OneThread{}, b, x);
  CHECK(x.head(n).allFinite());
}

TEST_CASE("points are aggregated once each, by whole neighbourhoods") {
  // a chain
  std::vector<int> start{0}, neighbours;
  for (int i = 0; i < 10; ++i) {
    if (i > 0 && i != 9) neighbours.push_back(i - 1);
    if (i < 8) neighbours.push_back(i + 1);
    start.push_back(int(neighbours.size()));
  }
  const Aggregates found = aggregate_points(start, neighbours, std::vector<float>(neighbours.size(), 1.f));
  CHECK(found.of == std::vector{0, 0, 1, 1, 1, 2, 2, 2, 2, -1});
  CHECK(found.count == 3);
}

TEST_CASE("points are on a lattice where their numbers are evenly spaced") {
  Mesh mesh = regular_grid_tetrahedra(7, 5, 4, {-1, 2, 0.1}, {2, 3, 0.4});
  auto& x = mesh.positions;
  const Lattice found = find_lattice(x);
  CHECK(found.size == std::array{7, 5, 4});
  REQUIRE(found.of.size() == x.size());
  bool right = true;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double first = std::array{-1.0, 2.0, 0.1}[c], spacing = std::array{0.5, 0.25, 0.1}[c];
      right = right && std::abs(first + spacing * found.of[i][c] - x[i][int(c)]) < 1e-12;
    }
  CHECK(right);
  // numbers that are none are of no point; a hole in the body does not matter, a point between does
  x[3] = Eigen::Vector3d::Constant(NAN);
  CHECK(find_lattice(x).of[3] == std::array{-1, -1, -1});
  x.erase(x.begin() + 40, x.begin() + 45);
  CHECK(find_lattice(x).size == found.size);
  x.push_back({0.2, 2, 0.1});
  CHECK(find_lattice(x).of.empty());
  // in a plane
  const std::vector<Eigen::Vector3d> row{{0, 0, 0}, {2, 0, 0}, {4, 0, 0}};
  CHECK(find_lattice(row).size == std::array{3, 1, 1});
  CHECK(find_lattice({}).of.empty());
}

TEST_CASE("points of a lattice are aggregated by cells that hang together") {
  auto all = [](auto const&...) { return true; };
  const std::array n{6, 6, 3};
  const Grid whole(n, all, all);
  const LatticeCells cells = whole.cells();
  CHECK(cells.aggregates.count == 4);
  CHECK(cells.lattice.size == std::array{2, 2, 1});
  REQUIRE(cells.lattice.of.size() == 4);
  bool right = true;
  for (std::size_t i = 0; i < whole.lattice.of.size(); ++i) {
    auto const& cell = cells.lattice.of[std::size_t(cells.aggregates.of[i])];
    right = right && cell[0] == (whole.lattice.of[i][0] > 2) && cell[1] == (whole.lattice.of[i][1] > 2);
  }
  CHECK(right);

  // a slit between cells parts none, one in the middle of cells does
  auto slit = [](int behind) {
    return [behind](auto const& a, auto const& b) { return (a[0] > behind) == (b[0] > behind); };
  };
  const Grid between(n, all, slit(2)), within(n, all, slit(1));
  CHECK(between.cells().aggregates.count == 4);
  CHECK(within.cells().aggregates.count == 0);

  // the corner of a sphere: two points of a cell join the aggregates beside them
  const Grid ragged(
      {7, 3, 3}, [](int x, int y, int z) { return x < 3 || (x == 3 && y == 0 && z < 2); }, all);
  const LatticeCells two = ragged.cells();
  CHECK(two.aggregates.count == 1);
  const std::vector<float> even(ragged.neighbours.size(), 1.f);
  const Aggregates joined = aggregate_points(ragged.start, ragged.neighbours, even, two.aggregates);
  CHECK(joined.count == 1);
  CHECK(std::count(joined.of.begin(), joined.of.end(), 0) == long(joined.of.size()));
}

TEST_CASE("the levels of a regular body are cells of cells") {
  Body body({18, 9, 9}, 1e-3);
  const Multigrid m = cycle_of(body, {.coarsestSize = 60});
  REQUIRE(m.levels() == 3);
  CHECK(m.fine.down.coarseRows() == 54);
  CHECK(m.coarse[0].down.coarseRows() == 2);
  // also where aggregates are found anew after the body has moved
  Multigrid moved = m;
  for (auto& row : moved.modes) row[4] *= 1.1;
  moved.reset();
  moved.update(OneThread{}, body.matrix);
  CHECK(moved.fine.down.aggregate == m.fine.down.aggregate);
  // whole neighbourhoods where the modes are those of no points in space
  Body other = body;
  for (auto& row : other.modes) row[3] = -row[3];
  CHECK(cycle_of(other, {.coarsestSize = 60}).fine.down.aggregate != m.fine.down.aggregate);
}

TEST_CASE("the largest eigenvalue of a tridiagonal matrix") {
  // 2 on the diagonal, -1 beside it: 2 + 2 cos(pi / (n + 1))
  const std::vector<double> diagonal(9, 2.0), beside(8, -1.0);
  CHECK(largest_eigenvalue(diagonal, beside) ==
        Approx(2 + 2 * std::cos(3.14159265358979 / 10)).epsilon(1e-6));
}

}  // namespace test_multigrid
