// SPDX-License-Identifier: BSL-1.0
#pragma once

// What force fields over the processor's DataTypes answer, which those over a device's must equal: computed
// in files of their own, without Thrust, once for all backends.

#include <sinew/core/assembly.hpp>
#include <sinew/core/element_force.hpp>
#include <sinew/linalg/block_matrix.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/regular_grid.hpp>

#include <algorithm>
#include <cmath>

namespace gpu_test {

using namespace sinew;

/// DataTypes of the processor for any.
template <class D>
struct HostTypes {
  using type = D;
};
template <class D>
requires requires { typename D::Host; }
struct HostTypes<D> {
  using type = typename D::Host;
};
template <class D>
using HostOf = typename HostTypes<D>::type;

/// Anything that repeats, between -1 and 1.
inline double noise(std::size_t i) {
  const double s = std::sin(12.9898 * double(i + 1)) * 43758.5453;
  return 2 * (s - std::floor(s)) - 1;
}
template <class V>
V noise(std::size_t i, double size) {
  V v;
  for (int c = 0; c < int(v.size()); ++c)
    v[c] = typename V::Scalar(size * noise(i * std::size_t(v.size()) + std::size_t(c)));
  return v;
}

/// A block of 5 x 4 x 3 points, its elements of all kinds.
struct Block {
  Mesh mesh = regular_grid_tetrahedra(5, 4, 3, {0, 0, 0}, {2, 1.5, 1});
  std::vector<Hexahedron> hexahedra = regular_grid(5, 4, 3, {0, 0, 0}, {2, 1.5, 1}).hexahedra;
  std::vector<Triangle> triangles = boundary_triangles(mesh.tetrahedra);
  std::vector<Edge> edges = edges_of(mesh.tetrahedra);

  TopologyView topology() const {
    return {.edges = edges,
            .triangles = triangles,
            .tetrahedra = mesh.tetrahedra,
            .hexahedra = hexahedra,
            .grid = {5, 4, 3}};
  }
};

/// A state in which forces are evaluated: the block turned by one radian and crumpled by `size` [m], with a
/// tetrahedron inside out where `inverted`; or frames at its points.
template <class H>
struct Motion {
  using Real = typename H::Real;
  Block block{};
  std::vector<typename H::Coord> rest{}, x{};
  std::vector<typename H::Deriv> v{}, dx{};

  explicit Motion(double size = 0.1, bool inverted = false) {
    const double c = std::cos(1.0), s = std::sin(1.0);
    for (std::size_t i = 0; i < block.mesh.positions.size(); ++i) {
      Eigen::Vector3d p = block.mesh.positions[i] + noise<Eigen::Vector3d>(i, 0.05);
      block.mesh.positions[i] = p;
      rest.push_back(H::zero());
      H::setCenter(rest.back(), p.cast<Real>());
      p = Eigen::Vector3d(c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]);
      x.push_back(H::zero());
      H::setCenter(x.back(), p.cast<Real>());
      if constexpr (H::rigid) H::increment(rest.back(), noise<typename H::Deriv>(500 + i, 1));
      H::increment(x.back(), noise<typename H::Deriv>(100 + i, H::rigid ? 10 * size : size));
      v.push_back(noise<typename H::Deriv>(200 + i, 1));
      dx.push_back(noise<typename H::Deriv>(300 + i, 1));
    }
    if constexpr (!H::rigid)
      if (inverted) {
        Tetrahedron const& t = block.mesh.tetrahedra.back();
        auto at = [&](std::size_t k) -> auto& { return x[std::size_t(t[k])]; };
        at(3) = Real(2) / 3 * (at(0) + at(1) + at(2)) - at(3);
      }
  }
};

/// f = dx + force(x, v); three times v + (0.7 K + 0.3 B) dx: by the first product, by the second, and by the
/// assembled matrix; the energy of x.
template <class H>
struct Answer {
  std::vector<typename H::Deriv> f{}, first{}, second{}, assembled{};
  double energy = 0;
  std::size_t removed = 0;  // elements taken away before

  bool operator==(Answer const&) const = default;
};

template <class T>
std::vector<T> const& on_the_host(std::vector<T> const& v) {
  return v;
}
template <class V>
auto const& on_the_host(V const& v) {
  return v.host();
}

/// A force field's answers in a motion. With `fewer`, a third of its elements is taken away before.
template <class D, class Force>
Answer<HostOf<D>> answer_of(Force& force, Motion<HostOf<D>> const& motion, bool fewer) {
  using H = HostOf<D>;
  using Deriv = typename D::Deriv;
  Answer<H> answer;
  if (fewer) answer.removed = force.driver.removeIf([](auto const& element) { return element[0] % 3 == 1; });
  const typename D::VecCoord x(motion.x);
  const typename D::VecDeriv v(motion.v), dx(motion.dx);
  typename D::VecDeriv f(motion.dx), first(motion.v), second(motion.v);
  MechanicalParams p;
  add_force(force, p, f, x, v);
  p.k = 0.7, p.b = 0.3;
  add_dforce(force, p, first, dx);
  add_dforce(force, p, second, dx);
  answer.f = on_the_host(f);
  answer.first = on_the_host(first);
  answer.second = on_the_host(second);
  answer.energy = potential_energy(force, x);

  CompressedRowSparseMatrix<typename D::Real, D::size> matrix;
  using Dofs = DirectDofs<D::size>;
  const Dofs dofs{0};
  auto add = [&]<AssemblyPhase phase>() {
    add_to_matrix(force, p, MatrixSink<phase, decltype(matrix), Dofs>{matrix, dofs, dofs});
  };
  matrix.startPattern(int(motion.x.size()) * D::size);
  add.template operator()<AssemblyPhase::pattern>();
  matrix.finishPattern();
  add.template operator()<AssemblyPhase::bind>();
  matrix.setZero();
  add.template operator()<AssemblyPhase::add>();
  std::vector<Deriv> in = motion.dx, product(in.size(), Deriv::Zero());
  in.push_back(Deriv::Zero());  // multiply reads behind the end
  matrix.multiply(in[0].data(), product[0].data());
  answer.assembled = motion.v;
  for (std::size_t i = 0; i < product.size(); ++i) answer.assembled[i] += product[i];
  return answer;
}

/// A force field over D as variant `v` of `Sample` makes it, ready to be used.
template <class Sample, class D>
auto ready(int v, Motion<HostOf<D>> const& motion) {
  auto force = Sample::template make<D>(v);
  check_fields(force, "sample");
  const typename D::VecCoord rest(motion.rest);
  force.init(InitContext<D>{"sample", rest, motion.block.topology()});
  return force;
}

/// What a sample's motion is, unless it says so.
template <class Sample, class H>
Motion<H> motion_of() {
  if constexpr (requires { Sample::crumpled; })
    return Motion<H>(Sample::crumpled, Sample::inverted);
  else
    return Motion<H>(0.1, true);
}

/// The answers of the CPU's driver, in lanes and one element at a time. Instantiated in host_*.cpp.
template <class H>
struct HostAnswers {
  Answer<H> lanes, scalar;
};
template <class Sample, class H>
HostAnswers<H> on_host(int v, bool fewer);

/// Largest difference of two lists of vectors over the largest entry of the second.
template <class Vectors>
double relative_difference(Vectors const& a, Vectors const& b) {
  if (a.size() != b.size()) return INFINITY;
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (int c = 0; c < int(b[i].size()); ++c) {
      const double d = std::abs(double(a[i][c] - b[i][c]));
      difference = d <= difference ? difference : d;  // a NaN stays
      size = std::max(size, std::abs(double(b[i][c])));
    }
  return difference / size;
}
template <class H>
double relative_difference(Answer<H> const& a, Answer<H> const& b) {
  if (a.removed != b.removed) return INFINITY;
  return std::max({relative_difference(a.f, b.f),
                   relative_difference(a.first, b.first),
                   relative_difference(a.second, b.second),
                   relative_difference(a.assembled, b.assembled),
                   std::abs(a.energy - b.energy) / std::abs(b.energy)});
}

/// What relative differences may reach by the order of sums and the fusing of multiply and add.
template <class Real>
constexpr double rounding = sizeof(Real) == 8 ? 2e-14 : 5e-6;

}  // namespace gpu_test
