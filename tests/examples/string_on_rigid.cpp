// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "string_on_rigid/scene.hpp"

namespace test_string_on_rigid {

using namespace sinew;

TEST_CASE("string on rigid: implicit steps with a matrix and without agree") {
  auto run = [](auto cg) {
    auto sim = examples::string_on_rigid(EulerImplicitSolver{}, cg);
    sim.init();
    for (int i = 0; i < 100; ++i) sim.animate(0.005);
    return sim.template at<"brick">().state().position[0];
  };
  const auto free = run(CGLinearSolver<>{.iterations = 300, .tolerance = 1e-12});
  // the matrix holds the string, the brick, and the interaction through the rigid mapping: J' K J
  const auto assembled =
      run(CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 300, .tolerance = 1e-12});
  const auto scalar = run(CGLinearSolver<CompressedRowSparseMatrixd>{.iterations = 300, .tolerance = 1e-12});
  CHECK((free.center - assembled.center).norm() < 1e-8);
  CHECK((free.orientation.coeffs() - assembled.orientation.coeffs()).norm() < 1e-8);
  CHECK((free.center - scalar.center).norm() < 1e-8);
  CHECK(free.center.y() < -0.3);  // it fell
}

TEST_CASE("string on rigid: explicit and implicit steps tend to the same motion, to first order") {
  auto end = [](auto sim, double dt) {
    sim.init();
    while (sim.time() < 0.3 - dt / 2) sim.animate(dt);
    return sim.template at<"brick">().state().position[0].center;
  };
  auto implicit = [&](double dt) {
    return end(examples::string_on_rigid(EulerImplicitSolver{},
                                         CGLinearSolver<>{.iterations = 300, .tolerance = 1e-12}),
               dt);
  };
  const Eigen::Vector3d exact = end(examples::string_on_rigid(RungeKutta4Solver{}), 0.0005);
  CHECK((end(examples::string_on_rigid(EulerExplicitSolver{}), 0.0001) - exact).norm() < 1e-3);
  const double coarse = (implicit(0.001) - exact).norm(), fine = (implicit(0.0005) - exact).norm();
  CHECK(std::log2(coarse / fine) == Approx(1).margin(0.15));
}

TEST_CASE("string on rigid: at rest the links carry the weight below them") {
  auto sim = examples::string_on_rigid(EulerImplicitSolver{.rayleighMass = 2},
                                       CGLinearSolver<>{.iterations = 300, .tolerance = 1e-12});
  sim.init();
  for (int i = 0; i < 6000; ++i) sim.animate(0.01);
  auto const& x = sim.at<"string">().state().position;
  // below link i hang 10 - i masses of 0.05 kg, less its own upper one, and the brick of 1 kg; stiffness 500
  // N/m
  for (std::size_t i = 1; i < 10; ++i) {
    const double weight = 9.81 * (0.05 * double(10 - i) + 1);
    CHECK((x[i] - x[i - 1]).norm() == Approx(0.1 + weight / 500).epsilon(1e-6));
  }
  // the brick hangs with its centre under the corner that is tied
  auto const& brick = sim.at<"brick">().state().position[0];
  auto const& corner = sim.at<"brick/corner">().state().position[0];
  CHECK((brick.center - corner).norm() == Approx(std::hypot(0.1, 0.05)));
  CHECK(brick.center.x() == Approx(corner.x()).margin(1e-6));
}

}  // namespace test_string_on_rigid
