// SPDX-License-Identifier: BSL-1.0
#pragma once

// Random bodies and random field values, from which the law suites make a sample of any component: its author
// writes nothing for them.

#include <sinew/registry.hpp>
#include <sinew/topology/adjacency.hpp>

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

/// Points of a 3x3x3 grid, shaken, with its lines, a hexahedron and five tetrahedra a cell, and the surface
/// of both.
struct Body {
  static constexpr int n = 27;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Tetrahedron> tetrahedra;
  std::vector<Hexahedron> hexahedra;
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
        Eigen::Matrix3d edges;
        for (int k = 0; k < 3; ++k)
          edges.col(k) = points[std::size_t(e[std::size_t(k) + 1])] - points[std::size_t(e[0])];
        if (edges.determinant() < 0) std::swap(e[2], e[3]);
        tetrahedra.push_back(e);
      }
      hexahedra.push_back(
          {corner(0), corner(1), corner(3), corner(2), corner(4), corner(5), corner(7), corner(6)});
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
  }
  TopologyView topology() const {
    return {.edges = edges,
            .triangles = triangles,
            .quads = quads,
            .tetrahedra = tetrahedra,
            .hexahedra = hexahedra,
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

/// f(component) for a random one with each value of each enum and each bool, or list of one, among its
/// fields.
template <class C, class F>
void for_each_variant(Random& random, F&& use) {
  // materials differ in the number of their parameters
  auto f = [&](C complete) {
    if constexpr (requires { complete.parameterSet; }) {
      complete.parameterSet.clear();
      while (!takes_parameters(complete.materialName, complete.parameterSet.size()))
        complete.parameterSet.push_back(random(1, 3));
    }
    use(complete);
  };
  C c{};
  for_each_field(c, [&](auto const& fd, auto& value) { randomise(value, fd.range, random); });
  if constexpr (requires { c.springs; })
    for (auto& s : c.springs)
      if (s.first == s.second) s.second = (s.first + 1) % Body::n;
  if constexpr (requires { c.springsIndices1; })
    for (std::size_t s = 0; s < c.springsIndices1.size(); ++s)
      if (c.springsIndices1[s] == c.springsIndices2[s])
        c.springsIndices2[s] = (c.springsIndices1[s] + 1) % Body::n;
  if constexpr (requires { c.polynomialDegree; }) {
    c.polynomialDegree = {3}, c.polynomialStiffness = {3, 1, 2};
    for (std::size_t s = 0; s < c.firstObjectPoints.size(); ++s)
      if (c.firstObjectPoints[s] == c.secondObjectPoints[s])
        c.secondObjectPoints[s] = (c.firstObjectPoints[s] + 1) % Body::n;
  }
  if constexpr (requires { c.radiusInner; }) c.radiusInner = c.radius / 2;
  // bodies that the one before them holds
  if constexpr (requires { c.indices, c.angularStiffness; })
    for (int& i : c.indices) i = std::max(i, 1);
  // a pressure is proved on a closed surface, where it has an energy: all of that of the body
  if constexpr (requires { c.triangleIndices; }) {
    c.triangleIndices.clear(), c.quadIndices.clear();
    c.min.reset(), c.max.reset();
  }
  if constexpr (requires { c.pressedElements; })
    for (int& i : c.pressedElements) i %= 24;  // quads of the body
  // movements over the times 0 to 2; a velocity turns a body about one axis, as its orientation has it
  if constexpr (requires { c.keyTimes; }) {
    auto fill = [&](auto& values, bool oneAxis) {
      using V = typename std::decay_t<decltype(values)>::value_type;
      values = {vector<V>(random), vector<V>(random), vector<V>(random)};
      if constexpr (C::DataTypes::rigid && C::DataTypes::spatial == 3)
        for (std::size_t k = 1; oneAxis && k < 3; ++k)
          values[k].template tail<3>() = values[0].template tail<3>() * typename V::Scalar(k + 1);
    };
    c.keyTimes = {0, 1, 2};
    if constexpr (requires { c.movements; }) fill(c.movements, false);
    if constexpr (requires { c.velocities; }) fill(c.velocities, true);
    if constexpr (requires { c.coordinates; }) c.coordinates.assign(1, 0);
    // all points, on a way of their own
    if constexpr (requires { c.keyPositions; }) {
      using D = typename C::DataTypes;
      c.keyPositions.clear(), c.keyVelocities.clear();
      for (int i = 0; i < 3 * Body::n; ++i) c.keyPositions.push_back(coord<D>(random));
      c.shift = 0.1;
      if constexpr (D::spatial != 3) c.scalePos = 1, c.rotation.setZero(), c.translation.setZero();
    }
  }
  if constexpr (requires { c.endConstraintTime; }) c.beginConstraintTime = 0, c.endConstraintTime = 2;
  if constexpr (requires { c.minDistValidity; }) c.minDistValidity = 0;
  if constexpr (requires { c.endTime; }) c.beginTime = 0, c.endTime = 2;
  // at least one axis is held
  if constexpr (requires { c.fixedXRotation; }) {
    for (int axes = 1; axes < 8; ++axes) {
      c.fixedXRotation = axes & 1, c.fixedYRotation = axes & 2, c.fixedZRotation = axes & 4;
      f(c);
    }
    return;
  }
  if constexpr (requires { c.dmax; }) c.dmin = 0, c.dmax = 1;
  // some points attached to others, one of them to three
  if constexpr (requires { c.twoWay; })
    c.indices1 = {0, 1, 2, 2, 9}, c.indices2 = {10, 13, 11, 20, 15}, c.constraintFactor = {1, 1, 1, 1, 0};
  // the nearest frames, with the weights that follow
  if constexpr (requires { c.nbRef; }) {
    c.nbRef = {3};
    c.indices.clear(), c.weight.clear(), c.initPos.clear();
  }
  // points of three parents, of nine points each
  if constexpr (requires { c.indexPairs; }) {
    c.indexPairs.resize(7);
    for (std::size_t i = 0; i < 7; ++i) c.indexPairs[i] = {int(i) % 3, random.index(9)};
  }
  // an energy is that of a body at rest, beside a target at rest; of bodies that turn, a tangent is proved at
  // their rest positions, which are then the target
  if constexpr (requires { c.target, c.targetVelocity; }) {
    c.targetVelocity.clear();
    if constexpr (C::turns) c.target.clear();
  }
  if constexpr (requires { c.restLengths; }) c.restLengths.clear();  // those of the rest positions
  if constexpr (requires { c.pulse; }) c.pulse = random(1, 2);       // in the middle of one
  // of bodies that turn a tangent is proved at their rest positions, about all axes
  if constexpr (requires { c.externalRestShape; }) {
    using D = typename C::DataTypes;
    c.externalRestShape.clear();
    c.activeDirections.assign(std::size_t(D::size), true);
    if constexpr (D::rigid && D::spatial == 3)
      c.externalPoints.clear();
    else if constexpr (D::size > 1)
      c.activeDirections.back() = false;
    if constexpr (!(D::rigid && D::spatial == 3))
      for (int i = 0; i < Body::n; ++i) c.externalRestShape.push_back(coord<D>(random, 2));
  }
  if constexpr (requires { c.fixedDirections; }) c.fixedDirections.back() = c.fixedDirections.size() == 1;
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

}  // namespace sample
