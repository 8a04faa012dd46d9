// SPDX-License-Identifier: BSL-1.0
#pragma once

// Random bodies and random field values, from which the law suites make a sample of any component. Its author
// writes nothing for them, or what values have to do with each other (samples/).

#include <sinew/registry.hpp>
#include <sinew/topology/adjacency.hpp>
#include <sinew/topology/quadratic_shapes.hpp>

#include <random>

namespace sample {

using namespace sinew;

struct Random {
  std::mt19937 engine;
  explicit Random(unsigned seed) : engine(seed) {}
  double operator()(double low = -1, double high = 1) {
    return low + (high - low) * (double(engine() >> 5) / double(1u << 27));
  }
  int index(int n) { return int(engine() % unsigned(n)); }
};

/// Points of a 3x3x3 grid, shaken, with its lines, a hexahedron, five tetrahedra, three pyramids and two
/// prisms a cell, the surface of the first two, and elements of second order over all cells.
struct Body {
  static constexpr int n = 27;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Hexahedron> hexahedra;
  std::vector<Pyramid> pyramids;
  std::vector<Prism> prisms;
  // over all cells; of the nodes of the last, the others have their own
  std::vector<QuadraticTetrahedron> quadraticTetrahedra;
  std::vector<QuadraticHexahedron> quadraticHexahedra;
  std::vector<TriquadraticHexahedron> triquadraticHexahedra;
  std::vector<Eigen::Vector3d> points;

  explicit Body(Random& random) {
    for (int i = 0; i < n; ++i)
      points.push_back(Eigen::Vector3d(i % 3, i / 3 % 3, i / 9) +
                       0.1 * Eigen::Vector3d(random(), random(), random()));
    for (int i = 0; i < n; ++i) {
      if (i % 3 < 2) edges.push_back({i, i + 1});
      if (i / 3 % 3 < 2) edges.push_back({i, i + 3});
      if (i / 9 < 2) edges.push_back({i, i + 9});
    }
    const int even[5][4] = {{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    const int odd[5][4] = {{1, 3, 0, 5}, {2, 0, 3, 6}, {4, 5, 6, 0}, {7, 6, 5, 3}, {0, 3, 5, 6}};
    for (int c = 0; c < 8; ++c) {
      const int x = c % 2, y = c / 2 % 2, z = c / 4;
      auto corner = [&](int k) { return (x + k % 2) + 3 * (y + k / 2 % 2) + 9 * (z + k / 4); };
      for (auto const& t : (x + y + z) % 2 == 0 ? even : odd) {
        Tetrahedron e{corner(t[0]), corner(t[1]), corner(t[2]), corner(t[3])};
        Eigen::Matrix3d sides;
        for (int k = 0; k < 3; ++k)
          sides.col(k) = points[std::size_t(e[std::size_t(k) + 1])] - points[std::size_t(e[0])];
        if (sides.determinant() < 0) std::swap(e[2], e[3]);
        tetrahedra.push_back(e);
      }
      hexahedra.push_back(
          {corner(0), corner(1), corner(3), corner(2), corner(4), corner(5), corner(7), corner(6)});
      pyramids.push_back({corner(0), corner(1), corner(3), corner(2), corner(7)});
      pyramids.push_back({corner(0), corner(4), corner(5), corner(1), corner(7)});
      pyramids.push_back({corner(0), corner(2), corner(6), corner(4), corner(7)});
      prisms.push_back({corner(0), corner(1), corner(3), corner(4), corner(5), corner(7)});
      prisms.push_back({corner(0), corner(3), corner(2), corner(4), corner(7), corner(6)});
      for (int axis = 0; axis < 3; ++axis)
        for (int high = 0; high < 2; ++high) {
          if ((axis == 0 ? x : axis == 1 ? y : z) != high) continue;  // outer faces, seen from outside
          const int u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3, base = high << axis;
          Quad q{corner(base), corner(base + u), corner(base + u + v), corner(base + v)};
          if (!high) std::swap(q[1], q[3]);
          quads.push_back(q);
        }
    }
    triangles = boundary_triangles(tetrahedra);
    TriquadraticHexahedron whole{};
    for (std::size_t k = 0; k < 27; ++k) {
      auto const& at = sinew::detail::triquadraticPlaces.at[k];
      whole[k] = int(at[0] + 3 * at[1] + 9 * at[2]) + 13;
    }
    triquadraticHexahedra = {whole};
    std::copy(whole.begin(), whole.begin() + 20, quadraticHexahedra.emplace_back().begin());
    for (auto const& t : even) {
      auto& e = quadraticTetrahedra.emplace_back();
      for (std::size_t k = 0; k < 4; ++k) e[k] = 2 * (t[k] % 2 + 3 * (t[k] / 2 % 2) + 9 * (t[k] / 4));
      for (auto const& [i, j, middle] : sinew::detail::quadraticTetrahedronEdges)
        e[middle] = (e[i] + e[j]) / 2;
    }
  }
  /// Also with elements of second order.
  TopologyView whole() const {
    TopologyView all = topology();
    all.quadraticTetrahedra = quadraticTetrahedra;
    all.quadraticHexahedra = quadraticHexahedra;
    all.triquadraticHexahedra = triquadraticHexahedra;
    return all;
  }
  TopologyView topology() const {
    return {.edges = edges,
            .triangles = triangles,
            .quads = quads,
            .tetrahedra = tetrahedra,
            .hexahedra = hexahedra,
            .pyramids = pyramids,
            .prisms = prisms,
            .grid = {3, 3, 3}};
  }
};

template <class V>
V vector(Random& random, double size = 1) {
  V v;
  for (int i = 0; i < v.size(); ++i) v[i] = typename V::Scalar(size * random());
  return v;
}

template <class D>
typename D::Coord coord(Random& random, double size = 1) {
  typename D::Coord x = D::zero();
  D::increment(x, vector<typename D::Deriv>(random, size));
  return x;
}

/// Positions of the body's points in any DataTypes: where there are fewer coordinates, other random ones.
template <class D>
typename D::VecCoord positions(Body const& body, Random& random) {
  typename D::VecCoord x;
  for (auto const& p : body.points)
    if constexpr (!D::rigid && D::size == 3)
      x.push_back(p.cast<typename D::Real>());
    else
      x.push_back(coord<D>(random, 2));
  return x;
}

template <class D>
typename D::VecDeriv derivs(std::size_t n, Random& random, double size = 1) {
  typename D::VecDeriv v(n);
  for (auto& d : v) d = vector<typename D::Deriv>(random, size);
  return v;
}

/// A random value of a field, in its range.
template <class T>
void randomise(T& value, Range range, Random& random) {
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, float>) {
    const double low = std::max(range.low, -2.0), high = std::min(range.high, low + 4);
    value = T(low + (high - low) * random(0.1, 0.9));
  } else if constexpr (std::is_same_v<T, int>) {
    value = random.index(Body::n);
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::vector<bool>> || std::is_enum_v<T>) {
  } else if constexpr (requires { value.has_value(); }) {
    value.emplace();
    randomise(*value, range, random);
  } else if constexpr (HasFields<T>) {
    for_each_field(value, [&](auto const& fd, auto& v) { randomise(v, fd.range, random); });
  } else if constexpr (requires { value.inertia; }) {
    value.mass = typename std::decay_t<decltype(value.mass)>(random(0.5, 2));
    value.inertia.setRandom();
    value.inertia = (value.inertia * value.inertia.transpose()).eval();
    value.inertia.diagonal().array() += 1;
  } else if constexpr (requires { value.coeff(0); }) {
    value = vector<T>(random, 2);
  } else if constexpr (requires {
                         value.clear();
                         value.resize(1);
                       }) {
    using V = typename T::value_type;
    // lists of numbers keep their single value; lists of indices and of structs become lists of seven
    value.resize(std::is_same_v<V, int> || HasFields<V> ? 7 : 1);
    for (auto& v : value) randomise(v, range, random);
  }
}

/// Ends of springs that join no point to itself.
inline void join_two_points(std::vector<int> const& first, std::vector<int>& second) {
  for (std::size_t s = 0; s < first.size(); ++s)
    if (first[s] == second[s]) second[s] = (first[s] + 1) % Body::n;
}
/// Values at three key times.
template <class V>
void fill(std::vector<V>& values, Random& random) {
  values = {vector<V>(random), vector<V>(random), vector<V>(random)};
}
/// As many parameters as a material has.
template <class Material>
void take_parameters(std::vector<double>& parameters, Material material, Random& random) {
  parameters.clear();
  while (!takes_parameters(material, parameters.size())) parameters.push_back(random(1, 3));
}

// What random values in the ranges of its fields do not say of a component, overloads of these functions in
// samples/ do, one file a component.

/// Whether a component has laws at all.
template <class C>
constexpr bool has_laws(C const&) {
  return true;
}
/// Points below a mapping: as many as a list of indices has, none where the mapping makes them.
template <class M>
constexpr std::size_t child_points(M const&) {
  const bool makes = over_parent<M> || needs_masses<M> || requires { M::samePoints; };
  return makes ? 0 : 7;
}
/// Whether the stabilized geometric stiffness of a mapping has all directions negative.
template <class M>
constexpr bool stabilizes(M const&) {
  return false;
}
/// Gives a mass a value of its own for each point, or for all.
template <class M>
void give_masses(M&, std::size_t, Random&) {}
/// Whether the inverse of a mass that has not its own is that of the sums of its rows.
template <class M>
constexpr bool has_row_sums(M const&) {
  return true;
}
/// Makes random values of fields agree with each other and with the body.
template <class C>
void prepare(C&, Random&) {}
/// Makes a force whose rest is among its fields rest where the body does.
template <class C, class VecCoord>
void rest_at(C&, VecCoord const&, Body const&) {}
/// The same after each choice of enums and bools.
template <class C>
void complete(C&, Random&) {}

/// f(component) with each value of each enum and each bool, or list of one, among its fields.
template <class C, class F>
void for_each_choice(C& c, Random&, F&& f) {
  bool any = false;
  for_each_field(c, [&](auto const& fd, auto& value) {
    using T = std::decay_t<decltype(value)>;
    // what is not there, or does not act, has no laws
    if (fd.name == "enabled" || fd.name == "activeDirections") return;
    if constexpr (std::is_enum_v<T>) {
      any = true;
      for (std::size_t i = 0; i < enum_names(T{}).size(); ++i) {
        value = T(i);
        f(c);
      }
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::vector<bool>>) {
      any = true;
      [[maybe_unused]] const T before = value;
      for (const bool b : {true, false}) {
        if constexpr (std::is_same_v<T, bool>)
          value = b;
        else
          value.assign(1, b);
        f(c);
      }
      if constexpr (!std::is_same_v<T, bool>) value = before;
    }
  });
  if (!any) f(c);
}

/// f(component) for a random one with each choice.
template <class C, class F>
void for_each_variant(Random& random, F&& f) {
  C c{};
  for_each_field(c, [&](auto const& fd, auto& value) { randomise(value, fd.range, random); });
  prepare(c, random);
  for_each_choice(c, random, [&](C chosen) {
    complete(chosen, random);
    f(chosen);
  });
}

}  // namespace sample

#include "samples.hpp"
