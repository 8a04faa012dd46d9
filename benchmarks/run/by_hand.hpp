// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/sinew.hpp>
#include <sinew/topology/implicit_surface.hpp>
#include <sinew/topology/isosurface_stuffing.hpp>

/// The string as one would write it by hand: no scene, no Sinew, plain loops over springs and masses.
struct HandString {
  std::vector<Eigen::Vector3d> x, v, f;

  explicit HandString(int n) : v(std::size_t(n), Eigen::Vector3d::Zero()), f(std::size_t(n)) {
    for (int i = 0; i < n; ++i) x.emplace_back(0.1 * i, 0, 0);
  }
  void step(double dt) {
    const double mass = 0.05, stiffness = 100, damping = 0.1, length = 0.1;
    for (auto& fi : f) fi = Eigen::Vector3d(0, -9.81 * mass, 0);
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const Eigen::Vector3d d = x[i + 1] - x[i];
      const double l = d.norm();
      const Eigen::Vector3d u = d / l;
      const Eigen::Vector3d force = (stiffness * (l - length) + damping * (v[i + 1] - v[i]).dot(u)) * u;
      f[i] += force;
      f[i + 1] -= force;
    }
    for (std::size_t i = 1; i < x.size(); ++i) {
      v[i] += dt / mass * f[i];
      x[i] += dt * v[i];
    }
  }
};

inline sinew::Mesh hand_mesh() {
  const sinew::LiverShape shape;
  return sinew::tetrahedralize_count(shape, shape.box_min(), shape.box_max(), 1800);
}

inline std::vector<int> hand_fixed(sinew::Mesh const& mesh) {
  std::vector<int> fixed;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].y() > 0.035 && mesh.positions[i].z() < 0) fixed.push_back(int(i));
  return fixed;
}

inline auto hand_liver_scene(sinew::Mesh const& mesh) {
  using namespace sinew;
  Simulation sim{
      node<"root">(Gravity{{0, -9.81, 0}},
                   EulerImplicitSolver{.rayleighStiffness = 0.1, .rayleighMass = 0.1},
                   CGLinearSolver<CompressedRowSparseMatrixMat3x3d>{.iterations = 25, .tolerance = 0},
                   TetrahedronTopology{mesh.tetrahedra},
                   MechanicalObject<Vec3d>{mesh.positions},
                   DiagonalMass<Vec3d>{.massDensity = 1000},
                   TetrahedronFEMForceField<Vec3d>{.youngModulus = {3000}, .poissonRatio = 0.3},
                   FixedConstraint<Vec3d>{.indices = hand_fixed(mesh)})};
  sim.init();
  return sim;
}

/// The liver written by hand for this one purpose, over the library's element law, element driver and matrix:
/// what a scene adds to them (nodes, roles, traversals, multi-vectors) is what the comparison measures.
struct HandLiver {
  using Matrix = sinew::CompressedRowSparseMatrixMat3x3d;
  using Driver = sinew::ElementDriver<sinew::TetrahedronFEM, sinew::Vec3d>;
  using Dofs = sinew::DirectDofs<3>;
  using Vector = Eigen::VectorXd;
  template <sinew::AssemblyPhase Phase>
  using Sink = sinew::MatrixSink<Phase, Matrix, Dofs>;

  std::vector<Eigen::Vector3d> x, v, f, b;
  std::vector<double> mass;
  std::vector<int> fixed;
  Driver driver;
  Driver::Law law{sinew::RotationMethod::large};
  Matrix A;
  Vector dv, r, p, q;

  explicit HandLiver(sinew::Mesh const& mesh)
      : x(mesh.positions),
        v(x.size(), Eigen::Vector3d::Zero()),
        f(v),
        b(v),
        mass(x.size(), 0.0),
        fixed(hand_fixed(mesh)) {
    const double E = 3000, nu = 0.3, lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    std::vector<Driver::Rest> rest;
    for (auto const& t : mesh.tetrahedra) {
      Eigen::Vector3d at[4];
      for (std::size_t k = 0; k < 4; ++k) at[k] = x[std::size_t(t[k])];
      rest.push_back(
          sinew::TetrahedronFEM<sinew::Vec3d>::restOf(at, mu, lambda, sinew::RotationMethod::large));
      const double volume = (at[1] - at[0]).cross(at[2] - at[0]).dot(at[3] - at[0]) / 6;
      for (const int i : t) mass[std::size_t(i)] += 1000 * volume / 4;
    }
    driver.init({mesh.tetrahedra.begin(), mesh.tetrahedra.end()}, rest);
    A.startPattern(int(3 * x.size()));
    driver.addToMatrix(law, Sink<sinew::AssemblyPhase::pattern>{A, {0}, {0}}, 0, 0);
    A.finishPattern();
    driver.addToMatrix(law, Sink<sinew::AssemblyPhase::bind>{A, {0}, {0}}, 0, 0);
    for (Vector* w : {&dv, &r, &p, &q}) w->setZero(A.dofs() + 1);
  }

  void step(double h) {
    const double rs = 0.1, rm = 0.1;
    for (std::size_t i = 0; i < x.size(); ++i) f[i] = Eigen::Vector3d(0, -9.81 * mass[i], 0);
    driver.addForce(law, f, x, v);
    for (std::size_t i = 0; i < x.size(); ++i) b[i] = f[i] - rm * mass[i] * v[i];
    driver.addDForce(law, b, v, h + rs, 0);
    for (auto& bi : b) bi *= h;
    for (const int i : fixed) b[std::size_t(i)].setZero();

    A.setZero();
    driver.addToMatrix(law, Sink<sinew::AssemblyPhase::add>{A, {0}, {0}}, -h * (h + rs), 0);
    for (std::size_t i = 0; i < x.size(); ++i) {
      double* const block = A.block(A.rowStart[i]);
      for (int c = 0; c < 3; ++c) block[4 * c] += (1 + h * rm) * mass[i];
    }
    for (const int i : fixed)
      for (int c = 0; c < 3; ++c) A.fix(3 * i + c);

    dv.setZero();
    for (std::size_t i = 0; i < x.size(); ++i) r.segment<3>(3 * long(i)) = b[i];
    p = r;
    double rho = r.squaredNorm();
    for (int k = 0; k < 25; ++k) {
      A.multiply(p.data(), q.data());
      const double alpha = rho / p.dot(q);
      dv += alpha * p;
      r -= alpha * q;
      const double next = r.squaredNorm();
      p = r + next / rho * p;
      rho = next;
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] += dv.segment<3>(3 * long(i));
      x[i] += h * v[i];
    }
  }
};
