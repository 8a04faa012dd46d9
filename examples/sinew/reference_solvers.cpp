// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"

namespace cli {

namespace {

constexpr auto examples = std::to_array<ClassExample>({
    {"BDFOdeSolver", R"(<BDFOdeSolver order="2"/>)"},
    {"NewmarkImplicitSolver", R"(<NewmarkImplicitSolver gamma="0.5" beta="0.25"/>)"},
    {"EulerImplicitSolver", "", softBody, ""},
    {"StaticSolver", R"(<StaticSolver newton_iterations="20"/>)"},
    {"DampVelocitySolver",
     R"(<DampVelocitySolver rate="0.5"/>)",
     softBody,
     "EulerImplicitSolver",
     Place::beside},
    {"EulerExplicitSolver", R"(<EulerExplicitSolver/>)", chain, "EulerImplicitSolver"},
    {"CentralDifferenceSolver",
     R"(<CentralDifferenceSolver rayleighMass="0.1"/>)",
     chain,
     "EulerImplicitSolver"},
    {"RungeKutta2Solver", R"(<RungeKutta2Solver/>)", chain, "EulerImplicitSolver"},
    {"RungeKutta4Solver", R"(<RungeKutta4Solver/>)", chain, "EulerImplicitSolver"},
    {"RungeKutta45Solver", R"(<RungeKutta45Solver tolerance="1e-6"/>)", chain, "EulerImplicitSolver"},
    {"CGLinearSolver", R"(
<CGLinearSolver template="CompressedRowSparseMatrixMat3x3d" iterations="100" tolerance="1e-8"/>)"},
    {"MinResLinearSolver", R"(<MinResLinearSolver iterations="100" tolerance="1e-8"/>)"},
    {"ShewchukPCGLinearSolver", R"(
<ShewchukPCGLinearSolver template="CompressedRowSparseMatrixMat3x3d" iterations="100" tolerance="1e-8"
                         precondition="incompleteCholesky"/>)"},
    {"MultigridLinearSolver", R"(<MultigridLinearSolver tolerance="1e-8" refresh="5" warp="true"/>)"},
    {"SparseLDLSolver", "", softBody, ""},
    {"WriteState",
     R"(<WriteState filename="body.state" writeV="true" period="0.1"/>)",
     softBody,
     "FixedConstraint",
     Place::beside},
});

}  // namespace

std::span<ClassExample const> examples_of_solvers() { return examples; }

}  // namespace cli
