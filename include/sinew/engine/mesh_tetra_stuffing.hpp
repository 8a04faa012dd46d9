// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// Tetrahedra that fill a closed surface of triangles looking outwards: isosurface stuffing (Labelle &
/// Shewchuk 2007, Isosurface stuffing: fast tetrahedral meshes with good dihedral angles) on a body-centred
/// cubic lattice around the middle of the surface, with the rules of SOFA's engine of that name for what is
/// inside and which points move, so that meshes are the same. Lattice points near the surface may move to it
/// (snapPoints), and tetrahedra that it crosses may be cut (splitTetrahedra); otherwise these stay whole.
/// detail::stuffed_mesh in topology/isosurface_stuffing.hpp makes better ones, of implicit surfaces.
struct MeshTetraStuffing {
  using Role = role::Engine;
  static constexpr std::string_view className = "MeshTetraStuffing";

  Vec<double, 6> vbbox = Vec<double, 6>::Zero();
  double size = -8;
  std::vector<Eigen::Vector3d> inputPoints{};
  std::vector<Triangle> inputTriangles{};
  std::vector<Quad> inputQuads{};
  double alphaLong = 0.24999, alphaShort = 0.42978;
  bool snapPoints = false, splitTetrahedra = false;

  static constexpr auto fields() {
    using E = MeshTetraStuffing;
    return field_list(
        field("vbbox",
              &E::vbbox,
              "m",
              "box of the lattice: xmin ymin zmin xmax ymax zmax; empty for that around the surface"),
        field("size", &E::size, "m", "longer edges of the lattice; negative for parts of the longest side"),
        field("inputPoints", &E::inputPoints, "m", "points of the surface"),
        field("inputTriangles", &E::inputTriangles, "", "of the surface", range::nonNegative),
        field("inputQuads", &E::inputQuads, "", "of the surface", range::nonNegative),
        field("alphaLong",
              &E::alphaLong,
              "",
              "part of a long edge within which the surface moves its end",
              range::closed(0, 0.5)),
        field("alphaShort", &E::alphaShort, "", "the same of a short edge", range::closed(0, 0.5)),
        field("snapPoints", &E::snapPoints, "", "whether points move to the surface"),
        field("splitTetrahedra", &E::splitTetrahedra, "", "whether tetrahedra are cut at the surface")
            .also("splitTetras"));
  }

  // after update
  std::vector<Eigen::Vector3d> outputPoints{};
  std::vector<Tetrahedron> outputTetrahedra{};

  static constexpr auto outputs() {
    using E = MeshTetraStuffing;
    return field_list(
        field("outputPoints", &E::outputPoints, "m", "points of the body"),
        field("outputTetrahedra", &E::outputTetrahedra, "", "that fill it").also("outputTetras"));
  }

  /// Throws Error where there is no surface, one refers to a missing point, or nothing is inside; the outputs
  /// then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/topology/ray_triangle.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

namespace sinew {

namespace detail {

/// The lattice: points of two cubic grids, those of the second, which is larger by one, in the middle of the
/// cells of the first. Each has 14 edges: 6 along the axes, 8 to points of the other grid; e ^ 1 is the
/// opposite of edge e.
class StuffingLattice {
 public:
  static constexpr int edgeCount = 14;

  StuffingLattice(std::array<int, 3> cells, Eigen::Vector3d const& origin, double spacing)
      : sizes_{cells, {cells[0] + 1, cells[1] + 1, cells[2] + 1}}, second_(cells[0] * cells[1] * cells[2]) {
    for (int grid = 0; grid < 2; ++grid)
      for (int z = 0; z < sizes_[std::size_t(grid)][2]; ++z)
        for (int y = 0; y < sizes_[std::size_t(grid)][1]; ++y)
          for (int x = 0; x < sizes_[std::size_t(grid)][0]; ++x)
            points.push_back(origin + Eigen::Vector3d(x - grid / 2., y - grid / 2., z - grid / 2.) * spacing);
    side.assign(points.size(), 0);
    next.assign(points.size(), {});
  }

  std::vector<Eigen::Vector3d> points{};  // of the lattice, then cuts of its edges
  std::vector<int> side{};                // > 0 inside, < 0 outside, 0 moved to the surface
  std::vector<std::array<double, edgeCount>>
      next{};                    // distance to the surface along each edge, in edges; or 0
  std::map<Edge, Index> cuts{};  // of an edge from outside to inside

  int count() const { return int(next.size()); }
  bool isFirst(int p) const { return p < second_; }
  static bool isLong(int edge) { return edge < 6; }

  /// The other end of an edge; -1 where the lattice ends.
  int neighbour(int p, int edge) const {
    std::size_t grid = isFirst(p) ? 0 : 1;
    int rest = p - (grid ? second_ : 0);
    std::array<int, 3> c;
    c[0] = rest % sizes_[grid][0], rest /= sizes_[grid][0];
    c[1] = rest % sizes_[grid][1], c[2] = rest / sizes_[grid][1];
    if (isLong(edge)) {
      c[std::size_t(edge / 2)] += edge % 2 ? 1 : -1;
    } else {
      const int e = edge - 6, minus = grid ? 1 : 0;
      c[0] += (e & 1) - minus, c[1] += ((e >> 1 ^ e) & 1) - minus, c[2] += ((e >> 2 ^ e) & 1) - minus;
      grid = 1 - grid;
    }
    return at(grid, c);
  }
  int at(std::size_t grid, std::array<int, 3> const& c) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (c[k] < 0 || c[k] >= sizes_[grid][k]) return -1;
    return c[0] + sizes_[grid][0] * (c[1] + sizes_[grid][1] * c[2]) + (grid ? second_ : 0);
  }

  /// Where the surface meets the lines of the lattice, and what is inside: each line votes on its points.
  template <class Surface>
  void measure(Surface const& surface) {
    struct Hit {
      double t;
      int sign;  // -1 where the line enters
    };
    std::vector<Hit> hits;
    for (int first = 0; first < count(); ++first)
      for (int e = 0; e < edgeCount; e += 2) {
        int p = neighbour(first, e);
        if (p < 0 || neighbour(first, e + 1) >= 0) continue;
        hits.clear();
        const Eigen::Vector3d from = points[std::size_t(first)], d = points[std::size_t(p)] - from;
        surface(from, d, [&](double t, bool enters) { hits.push_back({t, enters ? -1 : 1}); });
        if (hits.empty()) continue;
        std::sort(hits.begin(), hits.end(), [](Hit const& a, Hit const& b) { return a.t < b.t; });
        std::size_t i = 0;  // the first hit that is not before the point
        for (p = first; p >= 0; p = neighbour(p, e)) {
          const double place = (points[std::size_t(p)] - from).dot(d) / d.squaredNorm();
          const double here = std::round(place);
          while (i < hits.size() && hits[i].t < here) ++i;
          int& vote = side[std::size_t(p)];
          if (i == hits.size())
            vote -= hits.back().sign;
          else if (i == 0)
            vote += hits[0].sign;
          else
            vote += here - hits[i - 1].t < hits[i].t - here ? hits[i].sign : -hits[i - 1].sign;
          if (i < hits.size()) next[std::size_t(p)][std::size_t(e)] = hits[i].t - here;
          if (i > 0) next[std::size_t(p)][std::size_t(e + 1)] = here - hits[i - 1].t;
        }
      }
    for (int& s : side)
      if (s == 0) s = -1;
  }

  /// Points that the surface passes too near move to it: first those outside, then those inside.
  void snap(double alphaLong, double alphaShort) {
    auto violates = [&](int p, int e, int alphaOf) {
      const double t = next[std::size_t(p)][std::size_t(e)];
      return t != 0 && t < (isLong(alphaOf) ? alphaLong : alphaShort);
    };
    std::vector<bool> violated(std::size_t(count()), false);
    std::set<int> inside, outside;
    for (int p = 0; p < count(); ++p)
      for (int e = 0; e < edgeCount && !violated[std::size_t(p)]; ++e) {
        const int q = neighbour(p, e);
        if (q < 0 || isInside(p) == isInside(q) || !violates(p, e, e)) continue;
        violated[std::size_t(p)] = true;
        (isInside(p) ? inside : outside).insert(p);
      }
    // along the shortest such edge to a point that may be the goal
    auto move = [&](int p, auto const& mayLeadTo) {
      int along = -1;
      double least = 0;
      for (int e = 0; e < edgeCount; ++e) {
        const int q = neighbour(p, e);
        if (q < 0 || !mayLeadTo(q) || !violates(p, e, e)) continue;
        const double t = next[std::size_t(p)][std::size_t(e)], length = t * t * (isLong(e) ? 4 : 3);
        if (along < 0 || length < least) along = e, least = length;
      }
      if (along < 0) return false;
      auto& x = points[std::size_t(p)];
      x += (points[std::size_t(neighbour(p, along))] - x) * next[std::size_t(p)][std::size_t(along)];
      side[std::size_t(p)] = 0;
      violated[std::size_t(p)] = false;
      for (int e = 0; e < edgeCount; ++e) {
        next[std::size_t(p)][std::size_t(e)] = 0;
        if (const int q = neighbour(p, e); q >= 0) next[std::size_t(q)][std::size_t(e ^ 1)] = 0;
      }
      return true;
    };
    for (bool again = true; again;) {
      again = false;
      for (const int p : outside) {
        if (side[std::size_t(p)] == 0 ||
            !move(p, [&](int q) { return !isInside(q) && !violated[std::size_t(q)]; }))
          continue;
        again = true;
        for (int e = 0; e < edgeCount; ++e) {
          const int q = neighbour(p, e);
          if (q < 0 || !violated[std::size_t(q)] || !isInside(q)) continue;
          bool still = false;
          for (int f = 0; f < edgeCount && !still; ++f) {
            const int r = neighbour(q, f);
            still = r >= 0 && side[std::size_t(r)] < 0 && violates(q, f, e);
          }
          if (!still) violated[std::size_t(q)] = false, inside.erase(q);
        }
      }
    }
    for (const int p : inside) move(p, [&](int q) { return side[std::size_t(q)] < 0; });
  }

  void cutEdges() {
    for (int p = 0; p < count(); ++p)
      for (int e = 0; side[std::size_t(p)] < 0 && e < edgeCount; ++e) {
        const int q = neighbour(p, e);
        if (q < 0 || !isInside(q)) continue;
        cuts[{p, q}] = Index(points.size());
        const Eigen::Vector3d x = points[std::size_t(p)];
        points.push_back(x + (points[std::size_t(q)] - x) * next[std::size_t(p)][std::size_t(e)]);
      }
  }

  /// The inside of all tetrahedra: each of an edge along an axis of the first grid, and an edge around it of
  /// the second.
  std::vector<Tetrahedron> tetrahedra(bool split) {
    std::vector<Tetrahedron> all;
    auto const& n = sizes_[0];
    constexpr int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int z = 0; z < n[2]; ++z)
      for (int y = 0; y < n[1]; ++y)
        for (int x = 0; x < n[0]; ++x)
          for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<int, 3> c{x, y, z};
            const int p = at(0, c);
            --c[axis];
            const int q = at(0, c);
            if (q < 0) continue;
            ++c[axis];
            // the other axes, y and z of x, z and x of y, x and y of z
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            auto ring = [&](int i) {
              std::array<int, 3> m = c;
              m[u] += around[i % 4][0], m[v] += around[i % 4][1];
              return at(1, m);
            };
            for (int i = 0; i < 4; ++i) add(all, {p, q, ring(i + 1), ring(i)}, split);
          }
    return all;
  }

 private:
  std::array<std::array<int, 3>, 2> sizes_;
  int second_;  // number of the first point of the second grid

  bool isInside(int p) const { return side[std::size_t(p)] > 0; }
  double volume(Tetrahedron const& t) const {
    auto x = [&](std::size_t k) -> Eigen::Vector3d const& { return points[std::size_t(t[k])]; };
    return (x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0)));
  }
  void emit(std::vector<Tetrahedron>& to, Tetrahedron t) const {
    if (volume(t) < 0) std::swap(t[2], t[3]);
    to.push_back(t);
  }
  Index cut(int outside, int inside) const {
    const auto known = cuts.find({outside, inside});
    return known == cuts.end() ? Index(outside) : known->second;
  }
  // of a quad a b c d with d and c on edges from a and b to the point outside: whether its diagonal is b d
  bool otherDiagonal(int a, int b, int c, int outside) const {
    if (isFirst(a) == isFirst(outside)) return true;
    if (isFirst(b) == isFirst(outside)) return false;
    int above = 0;
    for (int k = 0; k < 3; ++k) above += points[std::size_t(a)][k] > points[std::size_t(c)][k];
    return (above % 2 == 1) != isFirst(a);
  }

  void add(std::vector<Tetrahedron>& to, Tetrahedron t, bool split) const {
    if (volume(t) < 0) std::swap(t[2], t[3]);
    std::vector<int> in, out, on;
    for (const Index p : t) (isInside(p) ? in : side[std::size_t(p)] < 0 ? out : on).push_back(p);
    if (in.empty() && !out.empty()) return;
    if (out.empty() || !split) return emit(to, t);
    if (in.size() == 1) {
      for (Index& p : t)
        if (side[std::size_t(p)] < 0) p = cut(p, in[0]);
      return emit(to, t);
    }
    const int a = in[0], b = in[1];
    const Index c0 = cut(out[0], a), c1 = cut(out[0], b);
    if (in.size() == 2 && out.size() == 1) {
      if (otherDiagonal(a, b, c1, out[0]))
        emit(to, {on[0], a, b, c0}), emit(to, {on[0], b, c1, c0});
      else
        emit(to, {on[0], a, b, c1}), emit(to, {on[0], a, c1, c0});
    } else if (in.size() == 2) {
      const Index c2 = cut(out[1], a), c3 = cut(out[1], b);
      const bool first = otherDiagonal(a, b, c1, out[0]), second = otherDiagonal(a, b, c3, out[1]);
      if (!first && second)
        emit(to, {a, b, c1, c2}), emit(to, {a, c1, c0, c2}), emit(to, {b, c1, c2, c3});
      else if (first && !second)
        emit(to, {a, b, c0, c3}), emit(to, {b, c0, c3, c1}), emit(to, {a, c0, c2, c3});
    } else {
      const int c = in[2];
      const Index c2 = cut(out[0], c);
      const bool ab = otherDiagonal(a, b, c1, out[0]), bc = otherDiagonal(b, c, c2, out[0]);
      bool ca = otherDiagonal(c, a, c0, out[0]);
      if (ab == bc && bc == ca) ca = !ab;
      const Index low = ab && !bc ? b : bc && !ca ? c : a, high = !ab && bc ? c1 : !bc && ca ? c2 : c0;
      emit(to, {low, c0, c2, c1});
      emit(to, {high, a, b, c});
      if (ab == bc)
        emit(to, {b, c1, low, high});
      else if (bc == ca)
        emit(to, {c, c2, low, high});
      else
        emit(to, {a, c0, low, high});
    }
  }
};

}  // namespace detail

SINEW_ONCE void MeshTetraStuffing::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (inputPoints.empty() || (inputTriangles.empty() && inputQuads.empty()))
    throw Error(at,
                "there is no surface; link inputPoints and inputTriangles to those of a loader or topology");
  if (size == 0) throw Error(at, "size is 0; give a length, or the negative number of parts");
  detail::check_indices(at, "triangle", inputTriangles, inputPoints.size());
  detail::check_indices(at, "quad", inputQuads, inputPoints.size());
  std::vector<Triangle> triangles = inputTriangles;
  for (auto const& q : inputQuads)
    triangles.insert(triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});

  Eigen::Vector3d low = vbbox.head<3>(), high = vbbox.tail<3>();
  if (low[0] >= high[0]) {
    low = high = inputPoints[0];
    for (auto const& x : inputPoints) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const Eigen::Vector3d margin = 0.01 * (high - low);
    low -= margin, high += margin;
  }
  const double spacing = size < 0 ? (high - low).maxCoeff() / -size : size;
  const Eigen::Vector3d middle = (low + high) / 2;
  std::array<int, 3> cells;
  Eigen::Vector3d origin;
  double points = 1;
  for (int c = 0; c < 3; ++c) points *= (high[c] - low[c]) / spacing + 6;
  if (!(2 * points < 16777216))
    throw Error(at, text("size is ", size, ", which makes more than 2^24 lattice points; enlarge it"));
  for (int c = 0; c < 3; ++c) {
    const int before = int((middle[c] - low[c]) / spacing) + 2,
              after = int((high[c] - middle[c]) / spacing) + 2;
    cells[std::size_t(c)] = before + after + 1;
    origin[c] = middle[c] - before * spacing;
  }
  detail::StuffingLattice lattice(cells, origin, spacing);
  auto x = [&](Index i) -> Eigen::Vector3d const& { return inputPoints[std::size_t(i)]; };
  std::vector<Eigen::Vector3d> normals;
  for (auto const& [a, b, c] : triangles) normals.push_back((x(b) - x(a)).cross(x(c) - x(a)));
  double volume = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) volume += normals[t].dot(x(triangles[t][0]));
  if (volume < 0)
    throw Error(at, "the triangles of the surface look inwards; turn them, by flipNormals of a loader");
  lattice.measure([&](Eigen::Vector3d const& from, Eigen::Vector3d const& d, auto const& hit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      auto const& [a, b, c] = triangles[t];
      if (const auto place = line_meets_triangle(from, d, x(a), x(b), x(c)); place && *place >= 0)
        hit(*place, normals[t].dot(d) < 0);
    }
  });
  if (snapPoints) lattice.snap(alphaLong, alphaShort);
  if (splitTetrahedra) lattice.cutEdges();
  std::vector<Tetrahedron> made = lattice.tetrahedra(splitTetrahedra);
  if (made.empty())
    throw Error(at, "nothing is inside of the surface; make size smaller, or get a closed surface");
  std::vector<Index> number(lattice.points.size(), -1);
  for (auto const& t : made)
    for (const Index p : t) number[std::size_t(p)] = 0;
  outputPoints.clear();
  for (std::size_t p = 0; p < number.size(); ++p)
    if (number[p] == 0) {
      number[p] = Index(outputPoints.size());
      outputPoints.push_back(lattice.points[p]);
    }
  for (auto& t : made)
    for (Index& p : t) p = number[std::size_t(p)];
  outputTetrahedra = std::move(made);
}

}  // namespace sinew
#endif
