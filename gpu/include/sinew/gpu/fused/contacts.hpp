// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact_constraint.hpp>
#include <sinew/collision/vertex_contacts.hpp>
#include <sinew/gpu/contact_search.hpp>
#include <sinew/gpu/convex_problem.hpp>

#include <cstddef>
#include <utility>

namespace sinew::gpu {

/// A fused step without contacts.
struct NoContacts {
  static constexpr bool any = false;
};

/// A contact of a point of a fused step with a surface that stands.
struct FusedContact {
  FoundContact found{};
  Eigen::Vector3d start{0, 0, 0};  // p_b - p_a, from the first to the second model in the order of the scene
  Eigen::Vector3d normal{0, 0, 0};
  Eigen::Vector3d force{0, 0, 0};  // on the second, over the last step [N]
};

/// How contacts with a standing surface are answered.
struct FusedAnswer {
  int body = -1;  // the first surface on the same state
  int response = -1;
  double friction = 0;
};

/// The entries of blocks of constraints that have one point each: `room` blocks a point, of which it uses the
/// first ones.
struct FusedEntries {
  static constexpr int room = 4;
  int const* counts;

  SINEW_INLINE int first(int block) const { return block; }
  SINEW_INLINE int last(int block) const { return block + 1; }
  SINEW_INLINE int pointOf(int e) const { return e / room; }
  SINEW_INLINE int slotOf(int e) const { return 9 * e; }
  SINEW_INLINE int blockOfEntry(int e) const { return e; }
  template <class F>
  SINEW_INLINE void eachOf(int i, F&& f) const {
    for (int k = 0; k < counts[i]; ++k) f(room * i + k);
  }
  SINEW_INLINE int firstPair(int i) const { return room * i; }
  SINEW_INLINE int lastPair(int i) const { return room * i + counts[i]; }
  SINEW_INLINE int ownOf(int k) const { return k; }
  SINEW_INLINE int otherOf(int k) const { return k; }
  SINEW_INLINE int pointOfPair(int k) const { return k / room; }
};

/// The contacts of the points of a body with surfaces that no solver moves, found and answered within its
/// fused steps. Points are numbered as the rows of its system here.
template <class D, class Intersection, class... Responses>
struct FusedContacts {
  static constexpr bool any = true;
  static constexpr int room = FusedEntries::room, candidates = 3 * room;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vector = Eigen::Vector3d;

  typename ContactSearch<D>::template Look<Intersection> look;  // its points are those of a copy
  int const* elementOf;                                         // of each node; -1: it does not collide
  FusedAnswer const* answers;                                   // of each surface
  int rows;
  // of all copies, one after the other
  FusedContact* contacts;
  int* counts;
  ConstraintBlock* blocks;
  double* numbers;
  int *unsolved, *crowded;  // steps that were not solved; the first one with too many contacts of a point
  ConvexStepSettings settings;

  /// Numbers that a row needs: vectors, those of conjugate gradients, two blocks; of each contact its
  /// Jacobian and coupling; of each of its rows what a ConvexProblem has.
  static constexpr std::size_t numbersOfRow =
      3 * (5 + GradientVectors::count) + 2 * 9 + room * (2 * 9 + 3 * (9 + 3));

  /// Three numbers a row of a copy: b of the free motion, then what that has left of it.
  SINEW_INLINE double* restOf(int copy) const {
    return numbers + std::size_t(copy) * numbersOfRow * std::size_t(rows);
  }
  /// What of a problem is set before it is solved: of each row of constraints its Jacobian and violation.
  struct Given {
    double *jacobian, *start;
  };
  /// The problem of a copy, over a system.
  template <class System>
  SINEW_INLINE ConvexProblem<System, FusedEntries> problem(System const& system, int copy,
                                                           Given& given) const {
    double* at = restOf(copy) + 3 * std::ptrdiff_t(rows);
    auto next = [&](int each) { return std::exchange(at, at + each * std::ptrdiff_t(rows)); };
    ConvexProblem<System, FusedEntries> q;
    q.system = system;
    q.blocks = rows * room;
    q.block = blocks + std::ptrdiff_t(copy) * rows * room;
    q.entries.counts = counts + std::ptrdiff_t(copy) * rows;
    q.rows = given.jacobian = next(9 * room);
    q.start = given.start = next(3 * room);
    for (double** of : {&q.multipliers,
                        &q.violation,
                        &q.before,
                        &q.lagged,
                        &q.regularisation,
                        &q.compliance,
                        &q.rate,
                        &q.goodMultipliers})
      *of = next(3 * room);
    q.curvature = next(9 * room);
    for (double** of : {&q.velocity, &q.momentum, &q.gradient, &q.goodVelocity}) *of = next(3);
    q.newton = GradientVectors::in(next(3 * GradientVectors::count), std::size_t(rows));
    q.diagonal = next(9);
    q.inverse = next(9);
    q.coupling = next(9 * room);
    q.settings = settings;
    q.progress = {};
    q.progress.lag = settings.friction;
    q.progressThere = nullptr;
    return q;
  }
  SINEW_INLINE FusedContact* contactsOf(int copy, int row) const {
    return contacts + (std::ptrdiff_t(copy) * rows + row) * room;
  }
  SINEW_INLINE Vector placeOf(FoundContact const& c) const {
    return look.surfaces[c.surface].first ? c.point - c.standing : c.standing - c.point;
  }

  /// Finds the contacts of a node that is at x[node], of which directions are held, in the place of those of
  /// the step before, whose forces go on in them; returns how many. More than there is room for are lost, and
  /// `tooMany` says so. The rules are those of ContactManager::manage, for the contacts of one vertex.
  SINEW_HD int find(int copy, int row, int node, int held, Coord const* x, bool& tooMany) const {
    int& count = counts[std::ptrdiff_t(copy) * rows + row];
    FusedContact* const mine = contactsOf(copy, row);
    FusedContact found[candidates];
    int n = 0;
    auto ofCopy = look;
    ofCopy.points.position = x;
    if (elementOf[node] >= 0)
      ofCopy(elementOf[node], [&](FoundContact const& c) {
        if (n == candidates) {
          tooMany = true;
          return;
        }
        // in the order of keys
        int at = n++;
        for (; at > 0 && isBefore(c, found[at - 1].found); --at) found[at] = found[at - 1];
        found[at] = {c, placeOf(c), c.normal, Vector(0, 0, 0)};
      });
    n = withoutSamePlaces(found, n);
    n = withoutBehindOthers(found, n);
    n = withoutFixed(found, n, held);
    if (n > room) {
      tooMany = true;
      n = room;
    }
    for (int k = 0; k < n; ++k) {
      FusedContact const* const last = before(found[k].found, mine, count);
      if (last) found[k].force = last->force;
    }
    for (int k = 0; k < n; ++k) mine[k] = found[k];
    return count = n;
  }

  /// The block of a contact with its Jacobian, violations and guess, for a point that moves from x to free.
  template <class Problem>
  SINEW_HD void describe(Problem const& q, Given const& given, int copy, int row, int k, int held,
                         Coord const& x, Coord const& free, Deriv const& v, double h) const {
    const int number = room * row + k, first = 3 * number;
    ConstraintBlock& block = blocks[std::ptrdiff_t(copy) * rows * room + number];
    block = {ConstraintBlock::Kind::equality, first, 0};
    if (k >= q.entries.counts[row]) return;
    FusedContact const& c = contactsOf(copy, row)[k];
    FoundContact found = c.found;
    FusedAnswer const& answer = answers[found.surface];
    found.friction = answer.friction;
    StandingSurface const& surface = look.surfaces[found.surface];
    if (found.friction > 0)
      block = {ConstraintBlock::Kind::friction, first, 3, found.friction};
    else
      block = {ConstraintBlock::Kind::interval, first, 1};
    double d[3] = {0, 0, 0};
    violations_of<D, Responses...>(found, surface, answer.response, x, free, v, h, false, d);
    const Eigen::Matrix3d axes = contact_axes(c.normal);
    for (int r = 0; r < block.rows; ++r) {
      const Vector j = free_part(surface.first ? Vector(axes.col(r)) : Vector(-axes.col(r)), held);
      for (int a = 0; a < 3; ++a) given.jacobian[3 * (first + r) + a] = j[a];
      given.start[first + r] = d[r];
      q.multipliers[first + r] = axes.col(r).dot(c.force);
      q.lagged[first + r] = 0;
    }
  }
  /// The force of a contact from its multipliers.
  template <class Problem>
  SINEW_HD void takeForce(Problem const& q, int copy, int row, int k) const {
    FusedContact& c = contactsOf(copy, row)[k];
    ConstraintBlock const& block = q.block[room * row + k];
    const Eigen::Matrix3d axes = contact_axes(c.normal);
    c.force.setZero();
    for (int r = 0; r < block.rows; ++r) c.force += q.multipliers[block.first + r] * axes.col(r);
  }

 private:
  // what projective constraints leave of a direction; nothing where that is rounding
  SINEW_HD static Vector free_part(Vector const& direction, int held) {
    Vector left = direction;
    double largest = 0, most = 0;
    for (int c = 0; c < 3; ++c) {
      const double size = direction[c] < 0 ? -direction[c] : direction[c];
      largest = size > largest ? size : largest;
      if (held >> c & 1)
        left[c] = 0;
      else
        most = size > most ? size : most;
    }
    return most > 1e-12 * largest ? left : Vector(0, 0, 0);
  }

  // vertices of the other side, rising, as ContactKey has them
  SINEW_HD static void sorted(FoundContact const& c, int (&v)[3]) {
    for (int k = 0; k < 3; ++k) v[k] = c.vertices[std::size_t(k)];
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b + a < 2; ++b)
        if (v[b] > v[b + 1]) std::swap(v[b], v[b + 1]);
  }
  SINEW_HD static bool isBefore(FoundContact const& a, FoundContact const& b) {
    if (a.surface != b.surface) return a.surface < b.surface;
    int u[3], v[3];
    sorted(a, u), sorted(b, v);
    for (int k = 0; k < 3; ++k)
      if (u[k] != v[k]) return u[k] < v[k];
    return false;
  }
  SINEW_HD int bodyOf(FusedContact const& c) const { return answers[c.found.surface].body; }
  template <class Drop>
  SINEW_HD static int without(FusedContact (&found)[candidates], int n, Drop&& drop) {
    bool dropped[candidates];
    for (int i = 0; i < n; ++i) dropped[i] = drop(i);
    int left = 0;
    for (int i = 0; i < n; ++i)
      if (!dropped[i]) {
        if (left != i) found[left] = found[i];
        ++left;
      }
    return left;
  }
  SINEW_HD int withoutSamePlaces(FusedContact (&found)[candidates], int n) const {
    return without(found, n, [&](int i) {
      for (int first = 0; first < i; ++first)  // of its body
        if (bodyOf(found[first]) == bodyOf(found[i]))
          return is_same_place(found[first].start, found[i].start);
      return false;
    });
  }
  SINEW_HD int withoutBehindOthers(FusedContact (&found)[candidates], int n) const {
    return without(found, n, [&](int i) {
      for (int j = 0; j < n; ++j)
        if (bodyOf(found[j]) == bodyOf(found[i]) && is_behind_other(found[i], found[j])) return true;
      return false;
    });
  }
  // without those that nothing can part
  SINEW_HD static int withoutFixed(FusedContact (&found)[candidates], int n, int held) {
    return without(found, n, [&](int i) { return free_part(found[i].normal, held).squaredNorm() == 0; });
  }
  // that of the last step that goes on: with the same key, else the first with its body
  SINEW_HD FusedContact const* before(FoundContact const& c, FusedContact const* last, int count) const {
    FusedContact const* ofBody = nullptr;
    for (int k = 0; k < count; ++k) {
      if (!isBefore(c, last[k].found) && !isBefore(last[k].found, c)) return last + k;
      if (!ofBody && answers[c.surface].body == bodyOf(last[k])) ofBody = last + k;
    }
    return ofBody;
  }
};

}  // namespace sinew::gpu
