// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/axis_box.hpp>
#include <sinew/collision/bounding_tree.hpp>
#include <sinew/collision/collision_settings.hpp>
#include <sinew/collision/convex_hull.hpp>
#include <sinew/collision/shape.hpp>
#include <sinew/core/compiled.hpp>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

struct DistanceGrid;

/// What detection and response know of a collision model: its primitives over vertices in world space, each
/// with a radius around it, and how they behave in contact. A model is to its surface what a mapping is to
/// its child: positions and velocities go down, forces come up. Surfaces are alike for all DataTypes, so that
/// what is between them is compiled once.
struct CollisionSurface : SurfaceShape {
  // of the model, at init
  CollisionSettings settings{};
  std::vector<std::array<int, 3>> elements{};  // their corners, -1 behind the last; of a hull its centre
  std::vector<double> radius{};                // around each element; empty: none
  std::vector<ConvexHull> hulls{};             // in the axes of rigids: one of all elements, or one of each
  std::shared_ptr<DistanceGrid const> grid{};  // around each rigid, of a model of distances
  bool gridPoints = false;                     // whether those on its surface meet other grids
  std::vector<std::array<int, 4>> solid{};     // tetrahedra of which it is the surface, if it is filled
  std::string path{};                          // of its node
  std::string name{};                          // of the model, where it has one
  std::string_view className{};                // of the model
  void const* state = nullptr;
  int number = -1;                   // among the surfaces of the scene, in their order
  int solver = -1;                   // which of the ODE solvers moves it; none: -1
  bool implicit = false;             // that solver is an implicit one
  Eigen::Vector3d gravity{0, 0, 0};  // on what a solver moves
  // of each element the point of a state, counted through the scene, with which all of it moves as one: a
  // frame that carries it, or the point that it is itself; -1: there is none
  std::vector<int> carriers{};
  int carrier = -1;  // that of all elements

  // around the primitives, from the elements
  std::vector<std::array<int, 3>> across{};  // of triangles: the corner opposite to the edge behind each
                                             // corner in the neighbour; -1: none
  std::vector<std::array<int, 2>> beside{};  // of segments that a model of triangles on this state has as
                                             // edges: the corners opposite to them; -1: none
  std::vector<int> firstAround{},
      around{};                        // the vertices joined to each vertex by edges, in compressed rows
  std::vector<double> radiusAround{};  // of the thickest capsules that join them

  // vertices, now
  std::vector<Eigen::Vector3d> position{}, velocity{}, force{}, dx{};
  std::vector<Eigen::Vector3d> spin{}, torque{}, angularDx{};  // of rigids: angular velocity, ..., angular dx
  std::vector<Eigen::Quaterniond> orientation{};               // of rigids
  std::vector<int> touched{};                                  // vertices with contacts
  std::vector<char> isTouched{};

  std::vector<AxisBox> boxes{}, solidBoxes{};  // of the elements, and of what fills it
  AxisBox box{};
  BoundingTree tree{}, solidTree{};
  std::optional<std::array<double, 2>> enclosed{};  // margin and dt of the boxes, while vertices stand still
  long enclosures = 0;                              // how often they were made anew
  bool elsewhere = false;  // in this step its vertices are on a device: the host has those that touch

  std::size_t size() const { return elements.size(); }
  SINEW_HD double radiusOf(int element) const { return radius.empty() ? 0 : radius[std::size_t(element)]; }
  ConvexHull const& hullOf(int element) const { return hulls[hulls.size() == 1 ? 0 : std::size_t(element)]; }
  /// The corners of an element.
  template <std::size_t N>
  SINEW_HD std::array<Eigen::Vector3d, N> corner(std::vector<Eigen::Vector3d> const& of, int element) const {
    std::array<Eigen::Vector3d, N> all;
    for (std::size_t c = 0; c < N; ++c) all[c] = of[std::size_t(elements[std::size_t(element)][c])];
    return all;
  }

  /// Takes the carriers of elements from those of vertices.
  void setCarriers(std::vector<int> const& ofVertices);
  /// Whether an element moves as one with an element of another surface, so that no force parts the two.
  bool isOneWith(int element, CollisionSurface const& other, int its) const {
    return !carriers.empty() && !other.carriers.empty() && carriers[std::size_t(element)] >= 0 &&
           carriers[std::size_t(element)] == other.carriers[std::size_t(its)];
  }
  /// Whether the other model is on the same state, of points, lines or triangles, and collides with the same.
  bool isAccompaniedBy(CollisionSurface const& other) const;
  /// Whether the distance d from a place of this surface, on the primitive over these vertices of an element,
  /// to somewhere else is the least one around it, and not only on this element: where it is not, a neighbour
  /// is nearer (the filter of Duriez, LocalMinDistance). `cone`: the sine of the angle by which a neighbour
  /// may lean towards the other place.
  bool isLocalMinimum(int element, std::array<int, 3> const& vertices, Eigen::Vector3d const& d,
                      double cone = leastCone) const;
  static constexpr double leastCone = 1e-9, coneAlong = 0.02;

  void findNeighbours(std::size_t vertices);
  /// What is wrong with the order of the corners of one-sided triangles where they are now, which says what
  /// is outside: neighbours that disagree, a closed surface that has its inside outside, and under what does
  /// not move a floor that looks down, along gravity. Empty where nothing is.
  std::string wrongWinding(Eigen::Vector3d const& along) const;
  /// The triangles beside the segments of this surface are those of another one on the same state.
  void findTriangles(CollisionSurface const& triangles);

  void resize(std::size_t vertices);

  void clearTouched() {
    for (const int i : touched) isTouched[std::size_t(i)] = 0;
    touched.clear();
  }
  void touch(int vertex) {
    if (isTouched[std::size_t(vertex)]) return;
    isTouched[std::size_t(vertex)] = 1;
    touched.push_back(vertex);
  }

  /// Boxes of the elements where they are, or on their way during dt, with what is around them.
  void enclose(double margin, double dt);

 private:
  AxisBox hullBox(int element, double dt) const;
  AxisBox gridBox(int element, double dt) const;
  AxisBox onItsWay(AxisBox const& now, int vertex, double reach, double dt) const;
};

/// Sets position and velocity of a vertex of a surface from those of a point of its state.
template <class D>
void update_vertices(CollisionSurface& s, std::size_t i, typename D::Coord const& x,
                     typename D::Deriv const& v) {
  auto set = [&](auto& to, auto const& value) {
    if (s.enclosed && to != value) s.enclosed.reset();
    to = value;
  };
  set(s.position[i], D::center(x).template cast<double>().eval());
  set(s.velocity[i], v.template head<3>().template cast<double>().eval());
  if constexpr (D::rigid) {
    set(s.spin[i], v.template tail<3>().template cast<double>().eval());
    set(s.orientation[i].coeffs(), x.orientation.coeffs().template cast<double>().eval());
  }
}
template <class D>
void update_vertices(CollisionSurface& s, typename D::VecCoord const& x, typename D::VecDeriv const& v) {
  for (std::size_t i = 0; i < x.size(); ++i) update_vertices<D>(s, i, x[i], v[i]);
}
/// The same for the vertices in contact; the forces on them become zero.
template <class D>
void update_touched_vertices(CollisionSurface& s, typename D::VecCoord const& x,
                             typename D::VecDeriv const& v) {
  for (const int t : s.touched) {
    const auto i = std::size_t(t);
    update_vertices<D>(s, i, x[i], v[i]);
    s.force[i].setZero();
    if constexpr (D::rigid) s.torque[i].setZero();
  }
}
template <class D>
void update_touched_vertices(CollisionSurface& s, typename D::VecDeriv const& dx) {
  for (const int t : s.touched) {
    const auto i = std::size_t(t);
    s.dx[i] = dx[i].template head<3>().template cast<double>();
    s.force[i].setZero();
    if constexpr (D::rigid) {
      s.angularDx[i] = dx[i].template tail<3>().template cast<double>();
      s.torque[i].setZero();
    }
  }
}
/// f += the forces on the vertices.
template <class D>
void add_forces(typename D::VecDeriv& f, CollisionSurface const& s) {
  using Real = typename D::Real;
  for (const int t : s.touched) {
    const auto i = std::size_t(t);
    f[i].template head<3>() += s.force[i].template cast<Real>();
    if constexpr (D::rigid) f[i].template tail<3>() += s.torque[i].template cast<Real>();
  }
}

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/collision/distance_grid.hpp>
#include <sinew/collision/local_minimum.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/error.hpp>

#include <algorithm>
#include <cmath>

namespace sinew {

SINEW_ONCE void CollisionSurface::setCarriers(std::vector<int> const& ofVertices) {
  carriers.clear();
  for (auto const& e : elements) {
    int all = ofVertices[std::size_t(e[0])];
    for (const int v : e)
      if (v >= 0 && ofVertices[std::size_t(v)] != all) all = -1;
    carriers.push_back(std::max(all, -1));
  }
  carrier = carriers.empty() ? -1 : carriers[0];
  for (const int c : carriers)
    if (c != carrier) carrier = -1;
}

SINEW_ONCE bool CollisionSurface::isAccompaniedBy(CollisionSurface const& other) const {
  auto const &mine = settings, &its = other.settings;
  return state == other.state && is_simplex(other.shape) && mine.active == its.active &&
         mine.moving == its.moving && mine.simulated == its.simulated &&
         mine.selfCollision == its.selfCollision && mine.group == its.group &&
         mine.contactResponse == its.contactResponse;
}

SINEW_ONCE bool CollisionSurface::isLocalMinimum(int element, std::array<int, 3> const& vertices,
                                                 Eigen::Vector3d const& d, double cone) const {
  return is_local_minimum(*this, element, vertices, d, cone);
}

SINEW_ONCE std::string CollisionSurface::wrongWinding(Eigen::Vector3d const& along) const {
  if (shape != Shape::triangle || settings.bothSide || elements.empty()) return {};
  constexpr std::string_view advice = "; reverse them by swapping two corners each, or say bothSide=\"true\"";
  std::vector<std::array<int, 3>> edges;  // lower, higher vertex, whether they are passed in that order
  Eigen::Vector3d area(0, 0, 0);
  double volume = 0, size = 0;
  for (auto const& t : elements) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = position[std::size_t(t[c])] - position[std::size_t(elements[0][0])];
      const int from = t[c], to = t[(c + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), int(from < to)});
    }
    const Eigen::Vector3d twice = (p[1] - p[0]).cross(p[2] - p[0]);
    area += twice / 2;
    size += twice.norm() / 2;
    volume += p[0].dot(p[1].cross(p[2])) / 6;
  }
  std::sort(edges.begin(), edges.end());
  bool closed = true;
  int disagree = 0;
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    while (j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1]) ++j;
    closed = closed && j - i == 2;
    if (j - i == 2 && edges[i][2] == edges[i + 1][2]) ++disagree;
  }
  if (disagree > 0)
    return text("neighbouring triangles disagree at ",
                disagree,
                " edges about which of their sides is outside, and what touches the wrong side is pulled in",
                advice);
  if (closed && volume < -1e-9 * size * std::sqrt(size))
    return text("the triangles face inwards (their volume is ", volume, " m^3)", advice);
  if (!closed && solver < 0 && area.dot(along) > 0.5 * size * along.norm() && size > 0)
    return text("the outside of the triangles is below them, so that what lies on them is drawn through",
                advice);
  return {};
}

SINEW_ONCE void CollisionSurface::findTriangles(CollisionSurface const& triangles) {
  std::vector<std::array<int, 3>> edges;  // first, second vertex, opposite corner
  for (auto const& t : triangles.elements)
    for (std::size_t c = 0; c < 3; ++c)
      edges.push_back({std::min(t[c], t[(c + 1) % 3]), std::max(t[c], t[(c + 1) % 3]), t[(c + 2) % 3]});
  std::sort(edges.begin(), edges.end());
  beside.clear();
  for (auto const& e : elements) {
    const auto [p, q] = std::minmax(e[0], e[1]);
    std::array<int, 2> found{-1, -1};
    auto at = std::lower_bound(edges.begin(), edges.end(), std::array<int, 3>{p, q, -1});
    for (std::size_t k = 0; k < 2 && at != edges.end() && (*at)[0] == p && (*at)[1] == q; ++k, ++at)
      found[k] = (*at)[2];
    beside.push_back(found);
  }
}

SINEW_ONCE void CollisionSurface::findNeighbours(std::size_t vertices) {
  const bool ofTriangles = shape == Shape::triangle;
  std::vector<std::array<int, 3>> edges;  // first, second vertex, 3 * triangle + corner
  for (int e = 0; e < int(size()); ++e)
    for (int c = 0; c < (ofTriangles ? 3 : corners() - 1); ++c) {
      const auto [p, q] = std::minmax(elements[std::size_t(e)][std::size_t(c)],
                                      elements[std::size_t(e)][std::size_t((c + 1) % corners())]);
      edges.push_back({p, q, 3 * e + c});
    }
  std::sort(edges.begin(), edges.end());
  across.assign(ofTriangles ? size() : 0, {-1, -1, -1});
  firstAround.assign(vertices + 1, 0);
  auto same = [&](std::size_t i, std::size_t j) {
    return edges[i][0] == edges[j][0] && edges[i][1] == edges[j][1];
  };
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && same(i, i - 1)) continue;
    ++firstAround[std::size_t(edges[i][0]) + 1];
    ++firstAround[std::size_t(edges[i][1]) + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) firstAround[v + 1] += firstAround[v];
  around.assign(std::size_t(firstAround[vertices]), -1);
  if (shape == Shape::capsule) radiusAround.assign(around.size(), 0);
  auto next = firstAround;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (ofTriangles)  // of two triangles at an edge; more than two are beyond this filter
      for (const std::size_t j : {i + 1, i - 1})
        if (j < edges.size() && same(i, j)) {
          const int there = edges[j][2];
          across[std::size_t(edges[i][2] / 3)][std::size_t(edges[i][2] % 3)] =
              elements[std::size_t(there / 3)][std::size_t((there % 3 + 2) % 3)];
        }
    auto join = [&](int from, int to) {
      int& row = next[std::size_t(from)];
      if (i == 0 || !same(i, i - 1)) around[std::size_t(row++)] = to;
      if (shape == Shape::capsule) {
        double& thickest = radiusAround[std::size_t(row - 1)];
        thickest = std::max(thickest, radiusOf(edges[i][2] / 3));
      }
    };
    join(edges[i][0], edges[i][1]);
    join(edges[i][1], edges[i][0]);
  }
}

SINEW_ONCE void CollisionSurface::resize(std::size_t vertices) {
  findNeighbours(vertices);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  for (auto* v : {&position, &velocity, &force, &dx}) v->assign(vertices, zero);
  if (rigid)
    for (auto* v : {&spin, &torque, &angularDx}) v->assign(vertices, zero);
  if (rigid) orientation.assign(vertices, Eigen::Quaterniond::Identity());
  touched.clear();
  touched.reserve(vertices);
  isTouched.assign(vertices, 0);
  boxes.resize(size());
  solidBoxes.resize(solid.size());
  enclosed.reset();
}

SINEW_ONCE void CollisionSurface::enclose(double margin, double dt) {
  if (enclosed == std::array{margin, dt}) return;
  enclosed.reset();
  ++enclosures;
  box = AxisBox{};
  for (std::size_t e = 0; e < size(); ++e) {
    AxisBox b;
    for (int c = 0; c < corners(); ++c) {
      const auto v = std::size_t(elements[e][std::size_t(c)]);
      b.include(position[v]);
      if (dt > 0) b.include(position[v] + (solver < 0 ? -dt : dt) * velocity[v]);
    }
    if (shape == Shape::hull) b = hullBox(int(e), dt);
    if (grid) b = gridBox(int(e), dt);
    boxes[e] = b.grown(settings.proximity + margin + radiusOf(int(e)));
    box.include(boxes[e]);
  }
  tree.update(boxes);
  for (std::size_t i = 0; i < solid.size(); ++i) {
    solidBoxes[i] = AxisBox{};
    for (const int v : solid[i]) solidBoxes[i].include(position[std::size_t(v)]);
  }
  if (!solid.empty()) solidTree.update(solidBoxes);
  if (solver < 0) enclosed = {margin, dt};  // the others hardly ever stand still
}

SINEW_ONCE AxisBox CollisionSurface::hullBox(int element, double dt) const {
  ConvexHull const& hull = hullOf(element);
  const auto v = std::size_t(elements[std::size_t(element)][0]);
  const Eigen::Matrix3d rotation = orientation[v].toRotationMatrix();
  AxisBox b;
  for (auto const& p : hull.points()) b.include(position[v] + rotation * p);
  return onItsWay(b, int(v), hull.reach(), dt);
}

SINEW_ONCE AxisBox CollisionSurface::gridBox(int element, double dt) const {
  const int vertex = elements[std::size_t(element)][0];
  const Eigen::Matrix3d rotation = orientation[std::size_t(vertex)].toRotationMatrix();
  AxisBox b;
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d p;
    for (int c = 0; c < 3; ++c) p[c] = corner >> c & 1 ? grid->around.max[c] : grid->around.min[c];
    b.include(position[std::size_t(vertex)] + rotation * p);
    reach = std::max(reach, p.norm());
  }
  return onItsWay(b, vertex, reach, dt);
}

// what a rigid is in during a step, all of it within a distance from its centre
SINEW_ONCE AxisBox CollisionSurface::onItsWay(AxisBox const& now, int vertex, double reach, double dt) const {
  if (!(dt > 0)) return now;
  const auto v = std::size_t(vertex);
  AxisBox swept = now;
  swept.include(now.min + (solver < 0 ? -dt : dt) * velocity[v]);
  swept.include(now.max + (solver < 0 ? -dt : dt) * velocity[v]);
  // a point at r moves by at most |w| r dt as the body rotates
  return swept.grown(dt * spin[v].norm() * reach);
}

}  // namespace sinew
#endif
