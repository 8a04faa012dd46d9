// SPDX-License-Identifier: BSL-1.0
#pragma once

// Bodies to test drivers with, and what the CPU makes of them. Compiled once, without Thrust, for all
// backends.

#include <sinew/force/stiff_spring.hpp>
#include <sinew/force/tetrahedron_fem.hpp>

namespace gpu_test {

using namespace sinew;

/// Elements with their rest data, and a state to evaluate them in.
template <template <class> class LawOf, class D>
struct Body {
  std::vector<std::array<int, LawOf<D>::arity>> elements{};
  std::vector<typename LawOf<D>::Rest> rest{};
  typename D::VecCoord x{};
  typename D::VecDeriv v{}, dx{};
};

/// Springs between random pairs of random points. Nodes 0 and 1 are in one place; the last node has no
/// spring.
template <class D>
Body<SpringLaw, D> spring_network(int nodes, int springs);

/// A block of tetrahedra, turned by one radian and crumpled, with an inverted element.
template <class D>
Body<TetrahedronFEM, D> tetrahedra(RotationMethod method);

/// What a driver computes of a body: f = dx + force(x, v), df = v + (0.7 K + 0.3 B) dx, the energy of x.
template <class D>
struct Answer {
  typename D::VecDeriv f{}, df{};
  double energy = 0;

  bool operator==(Answer const&) const = default;
};

/// The answers of the CPU's driver, one element at a time and in lanes.
template <class D>
struct HostAnswers {
  Answer<D> scalar, lanes;
};
template <class D>
HostAnswers<D> on_host(Body<SpringLaw, D> const& body);
template <class D>
HostAnswers<D> on_host(Body<TetrahedronFEM, D> const& body, RotationMethod method);

/// A falling block of springs that twangs; its points have unit mass. `after`: where a Simulation has its
/// points after 100 steps of symplectic Euler.
template <class D>
struct Fall {
  static constexpr double dt = 0.005, gravity = -9.81;  // [s], [m/s^2] along y
  static constexpr int steps = 100;
  Body<SpringLaw, D> body{};
  typename D::VecCoord after{};

  /// Largest change of length of a spring, over its length at rest.
  double strain() const {
    double most = 0;
    for (std::size_t s = 0; s < body.elements.size(); ++s) {
      const auto [a, b] = body.elements[s];
      const double length = double((after[std::size_t(b)] - after[std::size_t(a)]).norm());
      most = std::max(most, std::abs(length / double(body.rest[s].length) - 1));
    }
    return most;
  }
};
template <class D>
Fall<D> falling_springs();

/// Largest difference of two vectors of vectors over the largest entry of the second.
template <class Vectors>
double relative_difference(Vectors const& a, Vectors const& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (int c = 0; c < int(b[i].size()); ++c) {
      difference = std::max(difference, std::abs(double(a[i][c] - b[i][c])));
      size = std::max(size, std::abs(double(b[i][c])));
    }
  return difference / size;
}

/// Largest relative difference of force, product and energy.
template <class D>
double relative_difference(Answer<D> const& a, Answer<D> const& b) {
  return std::max({relative_difference(a.f, b.f),
                   relative_difference(a.df, b.df),
                   std::abs(a.energy - b.energy) / std::abs(b.energy)});
}

/// What relative differences may reach by the order of sums and the fusing of multiply and add.
template <class Real>
constexpr double rounding = sizeof(Real) == 8 ? 2e-14 : 2e-6;

}  // namespace gpu_test
