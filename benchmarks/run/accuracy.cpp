// SPDX-License-Identifier: BSL-1.0
// Seconds a step to a relative residual of 1e-6 by each solver and preconditioner: accuracy MESH YOUNG
// ROUNDS. All go the same way, ten steps a round in turn; a factor that is kept is made once a round, and
// turns with the body. Prints one line a solver: name, seconds a step, iterations a step in the last round,
// distance of the positions from the direct solver's [m].
#include "bodies.hpp"

#include <sinew/io/mesh_file.hpp>

#include <functional>
#include <memory>

using namespace bench;

namespace {

constexpr int steps = 10;
constexpr double tolerance = 1e-6;
using Matrix = CompressedRowSparseMatrixMat3x3d;

struct Choice {
  char const* name;
  std::function<double()> round;  // iterations a step
  std::function<Vec3d::VecCoord const&()> positions;
  std::vector<double> times{};
  double iterations = 0;
};

template <class Sim>
Choice choice(char const* name, Sim scene) {
  auto sim = std::make_shared<Sim>(std::move(scene));
  sim->init();
  auto round = [sim] {
    double iterations = 0;
    for (int i = 0; i < steps; ++i) {
      sim->animate(0.02);
      auto& solver = sim->root().template first<role::LinearSolver>();
      if constexpr (requires { solver.residuals; }) {
        iterations += double(solver.residuals.size()) - 1;
        if (solver.residuals.back() > tolerance)
          throw Error(component_name<std::decay_t<decltype(solver)>>(), "the residual did not get to 1e-6");
      }
    }
    return iterations / steps;
  };
  return {name, round, [sim]() -> Vec3d::VecCoord const& { return sim->root().state().position; }};
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "usage: accuracy MESH YOUNG ROUNDS\n");
    return 2;
  }
  const Mesh mesh = io::read_mesh(argv[1]);
  const double young = whole_number(argv[2]);
  const int rounds = whole_number(argv[3]), maximum = 20000;
  using P = PreconditionerMethod;
  auto preconditioned = [&](char const* name, P method, int updateStep = 1) {
    return choice(name,
                  body<Vec3d>(mesh,
                              ShewchukPCGLinearSolver<Matrix>{.iterations = maximum,
                                                              .tolerance = tolerance,
                                                              .updateStep = updateStep,
                                                              .precondition = method,
                                                              .warp = updateStep > 1},
                              young));
  };
  std::vector<Choice> choices;
  choices.push_back(choice(
      "cg", body<Vec3d>(mesh, CGLinearSolver<Matrix>{.iterations = maximum, .tolerance = tolerance}, young)));
  choices.push_back(preconditioned("jacobi", P::jacobi));
  choices.push_back(preconditioned("block-jacobi", P::blockJacobi));
  choices.push_back(preconditioned("ssor", P::ssor));
  choices.push_back(preconditioned("incomplete-cholesky", P::incompleteCholesky));
  choices.push_back(preconditioned("ldl-kept-and-turned", P::ldl, steps));
  choices.push_back(choice("ldl", body<Vec3d>(mesh, SparseLDLSolver<Matrix>{}, young)));
  for (int r = 0; r < rounds; ++r)
    for (Choice& c : choices) c.times.push_back(processor_seconds([&] { c.iterations = c.round(); }) / steps);
  auto const& exact = choices.back().positions();
  for (Choice& c : choices) {
    double distance = 0;
    for (std::size_t i = 0; i < exact.size(); ++i)
      distance = std::max(distance, (c.positions()[i] - exact[i]).norm());
    std::printf("%s %.9g %.1f %.2e\n", c.name, median(c.times), c.iterations, distance);
  }
  return 0;
} catch (Error const& error) {
  std::fprintf(stderr, "accuracy: %s\n", error.what());
  return 1;
}
