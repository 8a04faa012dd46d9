// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/platform.hpp>

namespace sinew {

/// What the primitives of a collision model are: convex hulls on rigids, simplices over one, two or three
/// vertices, or what is within a radius of a vertex (a sphere) or of the line between two (a capsule).
enum class Shape { hull, point, line, triangle, sphere, capsule };

/// The shape without the radius around it, by which geometry knows it: a sphere is a point, a capsule a line.
constexpr Shape skeleton(Shape s) {
  return s == Shape::sphere ? Shape::point : s == Shape::capsule ? Shape::line : s;
}

/// Vertices of which a primitive is the convex hull; 0 of a hull, which has points of its own.
constexpr int corners_of(Shape s) { return int(skeleton(s)); }

/// The simplex over so many vertices.
constexpr Shape simplex(int corners) { return Shape(corners); }

constexpr bool is_simplex(Shape s) { return s != Shape::hull && skeleton(s) == s; }

/// A set of shapes.
struct Shapes {
  unsigned bits = 0;

  static constexpr Shapes of(Shape s) { return {1u << unsigned(s)}; }
  constexpr bool has(Shape s) const { return (bits >> unsigned(s) & 1u) != 0; }
  constexpr bool empty() const { return bits == 0; }
  constexpr bool operator==(Shapes const&) const = default;
};
constexpr Shapes operator|(Shapes a, Shapes b) { return {a.bits | b.bits}; }

inline constexpr Shapes allSimplices =
    Shapes::of(Shape::point) | Shapes::of(Shape::line) | Shapes::of(Shape::triangle);

/// What a model has of a body besides its primitives: their shape, and which models stand beside it.
struct SurfaceShape {
  Shape shape = Shape::hull;  // of a primitive
  bool rigid = false;
  Shapes companions{};  // of the models of points, lines and triangles on this state that collide as this one

  SINEW_HD int corners() const { return corners_of(shape); }
  SINEW_HD bool hasAllSimplices() const { return companions.bits == allSimplices.bits && is_simplex(shape); }
  /// Of the smallest of its primitives: capsules have their ends for themselves.
  SINEW_HD int leastCorners() const { return shape == Shape::capsule ? 1 : corners(); }
  /// Of which shape the primitives are that have a place on the simplex over so many vertices of this
  /// surface: the smallest that hold it, of this model and of those beside it. What has a radius has its own.
  SINEW_HD Shape smallestAround(int vertices) const {
    if (shape == Shape::capsule) return simplex(vertices);
    for (int n = vertices; is_simplex(shape) && n < corners(); ++n)
      if (companions.has(simplex(n))) return simplex(n);
    return skeleton(shape);
  }
};

/// Shapes as a type.
template <Shape...>
struct ShapeList {};

namespace detail {

/// The shapes of a set as a type.
template <Shapes Set, int Next = 0, Shape... Found>
constexpr auto list_of_shapes() {
  if constexpr (Next > int(Shape::capsule))
    return ShapeList<Found...>{};
  else if constexpr (Set.has(Shape(Next)))
    return list_of_shapes<Set, Next + 1, Found..., Shape(Next)>();
  else
    return list_of_shapes<Set, Next + 1, Found...>();
}

}  // namespace detail

}  // namespace sinew
