// SPDX-License-Identifier: BSL-1.0
// What the benchmarks of contact with friction share: how far a step is from the solution of its friction
// problem, by one measure for all solvers, and how long it takes.
#pragma once

#include "bodies.hpp"

#include <sinew/lagrangian.hpp>
#include <sinew/scene/profile_report.hpp>
#include <sinew/scene/profiled.hpp>

namespace bench {

using Matrix = CompressedRowSparseMatrixMat3x3d;

/// x with scale A x = b to 1e-12, by conjugate gradients with the diagonal blocks of A; and 1 / (scale D).
struct SystemSolve {
  Matrix& A;
  double scale;
  std::vector<Eigen::Matrix3d> inverse{};

  SystemSolve(Matrix& a, double s) : A(a), scale(s) {
    for (int i = 0; i < A.rows(); ++i) {
      Matrix::Block const D =
          Eigen::Map<Matrix::Block const>(std::as_const(A).block(A.rowStart[std::size_t(i)]));
      inverse.push_back((scale * D).inverse());
    }
  }
  Eigen::Vector3d weigh(int point, Eigen::VectorXd const& r) const {
    return inverse[std::size_t(point)] * r.segment<3>(3 * point);
  }
  Eigen::VectorXd operator()(Eigen::VectorXd const& b) const {
    const Eigen::Index n = b.size();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n), r = b, z(n), p = Eigen::VectorXd::Zero(n + 1), q(n + 1);
    auto weighed = [&] {
      for (int i = 0; i < int(n / 3); ++i) z.segment<3>(3 * i) = weigh(i, r);
      return r.dot(z);
    };
    double rho = weighed();
    const double end = 1e-24 * rho;
    p.head(n) = z;
    for (int k = 0; k < 10000 && rho > end; ++k) {
      A.multiply(p.data(), q.data());
      const double alpha = rho / (scale * p.head(n).dot(q.head(n)));
      x += alpha * p.head(n);
      r -= alpha * scale * q.head(n);
      const double next = weighed();
      p.head(n) = z + (next / rho) * p.head(n);
      rho = next;
    }
    return x;
  }
};

/// A contact of the last step: f [N], d [m] = d_free + J A^-1 J' f, what f does, whatever a solver says, and
/// w [m/N], the mean diagonal of J D^-1 J', D the diagonal blocks of the matrices A of the bodies, which is
/// there without W.
struct SolvedContact {
  Eigen::Vector3d f, d;
  double w, friction;

  /// |f - P(f - (d + c) / w)| w [m], the natural map as ConstraintProblem::residual has it.
  double residual() const {
    const Eigen::Vector3d v = d + Eigen::Vector3d(friction * d.tail<2>().norm(), 0, 0);
    return (f - project_on_cone(f - v / w, friction)).norm() * w;
  }
};
/// `matrices`: A of each system, by 1/dt of which it answers in velocities and by 1/dt^2 in positions.
inline std::vector<SolvedContact> solved_contacts(ConstrainedMotion const& m,
                                                  std::vector<Matrix*> const& matrices, double dt) {
  Eigen::VectorXd const& f = m.problem.multipliers;
  Eigen::VectorXd d = Eigen::Map<Eigen::VectorXd const>(m.rows.violation.data(), f.size());
  Eigen::VectorXd w = Eigen::VectorXd::Zero(f.size());
  for (std::size_t s = 0; s < m.systems.size(); ++s) {
    ConstrainedSystem const& system = m.systems[s];
    if (system.rows.empty()) continue;
    JacobianRows const& J = system.jacobian;
    const SystemSolve solve(*matrices[s], 1 / (dt * dt));
    Eigen::VectorXd force = Eigen::VectorXd::Zero(system.dofs()), row = force;
    for (int k = 0; k < J.rows(); ++k) {
      J.addTransposed(k, f[system.rows[std::size_t(k)]], force);
      J.addTransposed(k, 1, row);
      J.forEachInRow(k, [&](int dof, double) {
        auto own = row.segment<3>(3 * (dof / 3));
        w[system.rows[std::size_t(k)]] += own.dot(solve.weigh(dof / 3, row));
        own.setZero();
      });
    }
    const Eigen::VectorXd x = solve(force);
    for (int k = 0; k < J.rows(); ++k) d[system.rows[std::size_t(k)]] += J.times(k, x);
  }
  std::vector<SolvedContact> contacts;
  for (ConstraintBlock const& b : m.rows.blocks)
    if (const double mean = w.segment<3>(b.first).mean(); mean > 0)  // else nothing can part it
      contacts.push_back({f.segment<3>(b.first), d.segment<3>(b.first), mean, b.friction});
  return contacts;
}

/// The largest residual and the largest penetration [m] of contacts.
struct Quality {
  double residual = 0, penetration = 0;

  void add(std::vector<SolvedContact> const& contacts) {
    for (SolvedContact const& c : contacts) {
      residual = std::max(residual, c.residual());
      penetration = std::max(penetration, -c.d[0]);
    }
  }
};

template <class Solver>
int iterations_of(Solver const& solver) {
  if constexpr (requires { solver.result.conjugateGradients; })
    return solver.result.conjugateGradients;
  else
    return solver.result.iterations;
}

/// The share of steps that the detection of contacts takes.
inline double detection_share(Profile const& profile) {
  double step = 0, collision = 0;
  for (ProfileLine const& line : profile_lines(profile)) {
    if (line.isPhase && line.name == "step") step += line.seconds;
    if (line.isPhase && line.name == "collision") collision += line.seconds;
  }
  return collision / step;
}

inline void print_line(std::string const& solver, double tolerance, double contacts, double speed,
                       double iterations, Quality const& worst, double detection) {
  std::printf("%s; %.0e; %.0f; %.5g; %.1f; %.2e; %.2e; %.3f\n",
              solver.c_str(),
              tolerance,
              contacts,
              speed,
              iterations,
              worst.residual,
              worst.penetration,
              detection);
  std::fflush(stdout);
}

/// Steps of a profiled scene that has settled, with each tolerance of its constraint solver in turn, as
/// lines:
///   solver; tolerance; contacts; steps/s; iterations a step; largest residual [m]; largest penetration [m];
///   share of detection
/// `matrices(sim)`: those of solved_contacts.
template <class Sim, class Matrices>
void measure(Sim& sim, std::vector<double> const& tolerances, double dt, int steps, Matrices&& matrices) {
  auto& solver = sim.root().template first<role::ConstraintSolver>();
  auto const& motion = sim.root().template first<role::AnimationLoop>().motion;
  for (const double tolerance : tolerances) {
    solver.tolerance = tolerance;
    std::vector<double> seconds;
    double iterations = 0, contacts = 0;
    Quality worst;
    sim.root().profile().clear();
    for (int i = 0; i < steps; ++i) {
      seconds.push_back(processor_seconds([&] { sim.animate(dt); }));
      iterations += iterations_of(solver);
      contacts += double(motion.rows.blocks.size());
      if (i % std::max(1, steps / 10) == 0) worst.add(solved_contacts(motion, matrices(sim), dt));
    }
    print_line(component_name<std::decay_t<decltype(solver)>>(),
               tolerance,
               contacts / steps,
               1 / median(seconds),
               iterations / steps,
               worst,
               detection_share(sim.root().profile()));
  }
}

/// Solvers over W: no row may change by more than the tolerance in a sweep.
inline BlockGaussSeidelConstraintSolver gauss_seidel() {
  return {.maxIterations = 20000, .tolerance = 1e-6, .allVerified = true};
}
inline NNCGConstraintSolver nncg() {
  return {.maxIterations = 20000, .tolerance = 1e-6, .allVerified = true};
}
/// Of the free motion, where no factor is needed.
inline CGLinearSolver<Matrix> free_motion() {
  return {.iterations = 1000, .tolerance = 1e-7, .warmStart = true};
}

/// The tolerances that follow the arguments of a program, from one on.
inline std::vector<double> tolerances_of(int argc, char** argv, int first) {
  std::vector<double> tolerances;
  for (int i = first; i < argc; ++i) tolerances.push_back(std::atof(argv[i]));
  return tolerances.empty() ? std::vector{1e-6} : tolerances;
}
/// f(constraint solver, linear solver, matrix of that) for the solver of a name: convex, sweeps or nncg.
template <class F>
void with_solver(std::string_view name, F&& f) {
  auto factored = [](SparseLDLSolver<>& linear) { return &linear.matrix; };
  if (name == "convex")
    f(ConvexConstraintSolver{}, free_motion(), [](auto& linear) { return &linear.system.matrix; });
  else if (name == "sweeps")
    f(gauss_seidel(), SparseLDLSolver<>{}, factored);
  else if (name == "nncg")
    f(nncg(), SparseLDLSolver<>{}, factored);
  else
    throw Error("arguments", text("there is no solver '", name, "'; take convex, sweeps or nncg"));
}
/// The contact stages of a root, with the friction 0.5.
inline auto contact_manager(int capacity) {
  return DefaultContactManager{
      .response = "FrictionContactConstraint", .responseParams = "mu=0.5", .capacity = capacity};
}
/// A fixed square in the plane z = 0.
inline auto wide_floor() {
  MeshTopology square;
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  return node<"floor">(
      square,
      MechanicalObject<Vec3d>{.position = {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}},
      TriangleCollisionModel<Vec3d>{.moving = false, .simulated = false});
}

}  // namespace bench
