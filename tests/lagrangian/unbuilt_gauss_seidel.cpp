// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "friction_problems.hpp"

#include <sinew/lagrangian/unbuilt_gauss_seidel.hpp>

namespace test_unbuilt_gauss_seidel {

using namespace sinew;
using namespace friction_problems;

// keeps v = v_free + A^-1 J' f, and has no W
struct Motion {
  Contacts const& contacts;
  std::vector<ConstraintBlock> const& blocks;
  Eigen::VectorXd v{};
  double factor = 1;  // wrong on purpose, where it is not 1
  int changes = 0;

  Motion(Contacts const& c, std::vector<ConstraintBlock> const& b) : contacts(c), blocks(b), v(c.v) {}

  auto rows(std::size_t b) const { return contacts.J.middleRows(blocks[b].first, blocks[b].rows); }
  BlockMatrix diagonal(std::size_t b) const {
    return factor * rows(b) * contacts.inverseMass * rows(b).transpose();
  }
  BlockVector violation(std::size_t b) const { return rows(b) * v; }
  void change(std::size_t b, BlockVector const& step) {
    v += contacts.inverseMass * (rows(b).transpose() * step);
    ++changes;
  }
};
constexpr SweepSettings exact{.maxIterations = 50000, .tolerance = 1e-11, .scaleTolerance = false};

TEST_CASE("sweeps without W are those with it") {
  for (const double relaxation : {1., 0.8}) {
    for (Contacts const& c : {box_stack(3, 1), ball_pile(15, 2), soft_grid(3, 3)}) {
      ConstraintProblem p = c.problem();
      Motion motion(c, p.blocks);
      Eigen::VectorXd f = p.multipliers;
      SweepSettings settings{.maxIterations = 8, .tolerance = 0, .relaxation = relaxation};
      ConstraintSweeps built;
      UnbuiltGaussSeidel unbuilt;
      const SweepResult a = built.gaussSeidel(p, settings, "test");
      const SweepResult b = unbuilt.solve(motion, p.blocks, f, settings, "test");
      REQUIRE(p.multipliers.norm() > 1e-3);
      // the order of sums differs, and what rounds differently in a sweep stays as small in the next
      CHECK((p.multipliers - f).norm() < 1e-10 * f.norm());
      CHECK(b.error == Approx(a.error).epsilon(1e-6).margin(1e-12));
      CHECK(b.iterations == a.iterations);
      CHECK((motion.v - c.v - c.inverseMass * c.J.transpose() * f).norm() < 1e-10);
    }
  }
}

TEST_CASE("the operator hears of the first guess, and nothing changes where that is the solution") {
  const Contacts c = soft_grid(3, 5);
  ConstraintProblem p = c.problem();
  ConstraintSweeps built;
  REQUIRE(built.gaussSeidel(p, exact, "test").converged);
  Motion motion(c, p.blocks);
  Eigen::VectorXd f = p.multipliers;
  UnbuiltGaussSeidel unbuilt;
  const SweepResult result = unbuilt.solve(motion, p.blocks, f, {.tolerance = 1e-8}, "test");
  CHECK(result.iterations == 1);
  CHECK((f - p.multipliers).norm() < 1e-8 * f.norm());
  CHECK((motion.v - c.v - c.inverseMass * c.J.transpose() * f).norm() < 1e-10);
}

TEST_CASE("equalities and intervals without W: momentum is that of the closed form") {
  // 2 kg and 3 kg on a line, that are joined, and stop at 1 m/s
  Contacts c;
  c.J = Eigen::MatrixXd{{1, -1}, {1, 0}};
  c.inverseMass = Eigen::Vector2d(1. / 2, 1. / 3).asDiagonal();
  c.v = Eigen::Vector2d(4, -1);  // together 1 m/s
  const std::vector<ConstraintBlock> blocks{ConstraintBlock::equality(0, 1),
                                            ConstraintBlock::interval(1, -1, 0.5)};
  Motion motion(c, blocks);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(2);
  REQUIRE(UnbuiltGaussSeidel().solve(motion, blocks, f, exact, "test").converged);
  CHECK(motion.v[0] == Approx(0.5));
  CHECK(motion.v[1] == Approx(0.5));
  CHECK(f[1] == Approx(-2.5));      // 5 kg times 0.5 m/s
  CHECK(-f[0] == Approx(3 * 1.5));  // on the 3 kg
}

TEST_CASE("an operator whose diagonal is wrong runs away, and that is said") {
  const Contacts c = box_stack(3, 1);
  ConstraintProblem p = c.problem();
  std::vector<ConstraintBlock> equal;
  for (ConstraintBlock const& b : p.blocks)
    for (int i = 0; i < 3; ++i) equal.push_back(ConstraintBlock::equality(b.first + i, 1));
  Motion motion(c, equal);
  motion.factor = 0.2;
  Eigen::VectorXd f = p.multipliers;
  const SweepResult result = UnbuiltGaussSeidel().solve(motion, equal, f, exact, "test");
  CHECK_FALSE(result.converged);
  CHECK(std::isinf(result.error));
  CHECK(f.isZero());
}

TEST_CASE("operators that cannot be solved are refused, with their rows") {
  Contacts c = ball_pile(4, 1);
  const std::vector<ConstraintBlock> blocks = c.problem().blocks;
  Eigen::VectorXd f = Eigen::VectorXd::Zero(c.J.rows());
  auto says = [&](std::vector<ConstraintBlock> const& b) {
    Motion motion(c, b);
    return error_of([&] { UnbuiltGaussSeidel().solve(motion, b, f, exact, "root"); });
  };
  CHECK_THAT(says({ConstraintBlock::equality(0, 2)}), Catch::Contains("cover 2 rows"));
  c.J.row(4).setZero();
  CHECK_THAT(says(blocks), Catch::Contains("constraint 4") && Catch::Contains("root"));
  c.J.row(4).setConstant(std::nan(""));
  CHECK_THAT(says(blocks), Catch::Contains("from row 3 on is not a finite number"));
  f[1] = std::nan("");
  CHECK_THAT(says(blocks), Catch::Contains("from row 0 on is not a finite number"));
}

}  // namespace test_unbuilt_gauss_seidel
