// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/collision/contact_constraint.hpp>
#include <sinew/collision/local_minimum.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/gpu/execution.hpp>
#include <sinew/gpu/sent_list.hpp>
#include <sinew/gpu/standing_surface.hpp>

#if THRUST_DEVICE_SYSTEM == THRUST_DEVICE_SYSTEM_CUDA
#include <cub/device/device_scan.cuh>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// The points of a state on the device, with a radius each where they are spheres, under the names that
/// CollisionSurface has.
template <class D>
struct PointsOfState : SurfaceShape {
  StandingSurface::Settings settings{};
  typename D::Coord const* position = nullptr;
  std::array<int, 3> const* elements = nullptr;
  double const* radii = nullptr;
  Eigen::Quaterniond const* orientation = nullptr;

  SINEW_HD double radiusOf(int element) const { return radii ? radii[element] : 0; }
  template <std::size_t N>
  SINEW_HD std::array<Eigen::Vector3d, N> corner(typename D::Coord const* of, int element) const {
    static_assert(N == 1);
    return {of[elements[element][0]].template cast<double>()};
  }
  SINEW_HD bool isLocalMinimum(int, std::array<int, 3> const&, Eigen::Vector3d const&, double) const {
    return true;
  }
};

/// A contact of such a point with a surface that stands.
struct FoundContact {
  int surface = -1;  // the place of the standing one in its list; of the first of all: how many follow
  int element = -1, other = -1;
  std::array<int, 3> vertices{-1, -1, -1};  // of the other, as in ContactSide
  Eigen::Vector3d weights{0, 0, 0};
  Eigen::Vector3d normal{0, 0, 0};  // from the first to the second model in the order of the scene
  double thickness = 0, limit = 0, distance = 0;
  double friction = 0;
  Eigen::Vector3d point{0, 0, 0}, standing{0, 0, 0};  // the places of the two
};

namespace detail {
template <class R>
SINEW_HD void measure(bool is, FoundContact const& c, ContactMotion const& motion, bool ofVelocity,
                      double* d) {
  if constexpr (MeasuresMotion<R>)
    if (is) R::violations(c, motion, ofVelocity, d);
}
}  // namespace detail

/// The violations d of the rows of a contact that is answered by the response of a number, for a motion of
/// its point without multipliers from x to free, with the velocity v at its end.
template <class D, class... Responses>
SINEW_HD void violations_of(FoundContact const& c, StandingSurface const& s, int response,
                            typename D::Coord const& x, typename D::Coord const& free,
                            typename D::Deriv const& v, double dt, bool ofVelocity, double* d) {
  using Vector = Eigen::Vector3d;
  Vector rate(0, 0, 0);
  for (int k = 0; k < 3 && c.vertices[std::size_t(k)] >= 0; ++k)
    rate += c.weights[k] * s.velocity[c.vertices[std::size_t(k)]];
  // what no solver moves is where it will be, and has come there
  const double sign = s.first ? 1 : -1;
  const Vector moved = D::difference(x, free).template cast<double>();
  ContactMotion motion{};
  motion.start = sign * (c.point - c.standing + dt * rate);
  motion.free = motion.start + sign * (moved - dt * rate);
  motion.rate = sign * (v.template cast<double>() - rate);
  motion.dt = dt;
  int number = 0;
  (detail::measure<Responses>(number++ == response, c, motion, ofVelocity, d), ...);
}

/// Finds the contacts of the points or spheres of a state on the device with surfaces that no solver moves:
/// candidates by a grid over the boxes of these, then by the law of the intersection method of the scene,
/// once to count them and once to write them down in the order of the points. They are on their way to the
/// host while that goes on; the device keeps them for the violations of their rows.
template <class D>
class ContactSearch {
 public:
  ContactSearch() = default;
  ContactSearch(ContactSearch&&) = default;
  ContactSearch& operator=(ContactSearch&&) = default;
  // a copy of a body makes its own
  ContactSearch(ContactSearch const&) {}
  ContactSearch& operator=(ContactSearch const&) { return *this = ContactSearch(); }

  /// Begins the search of a step for a model; `reserve`: contacts for which there is room from the start.
  void begin(CollisionSurface const& model, std::size_t reserve) {
    if (model_ != &model || enclosures_ != model.enclosures) {
      model_ = &model;
      enclosures_ = model.enclosures;
      largestRadius_ = 0;
      for (std::size_t e = 0; e < model.size(); ++e)
        largestRadius_ = std::max(largestRadius_, model.radiusOf(int(e)));
      points_.elements = elements_.send(model.elements);
      points_.radii = model.shape == Shape::sphere ? radii_.send(model.radius) : nullptr;
    }
    static_cast<SurfaceShape&>(points_) = model;
    points_.settings = {model.settings.proximity, model.settings.bothSide};
    reserve_ = std::max(reserve_, reserve);
    taken_.reserve(reserve_);
    rows_.reserve(reserve_);
    used_ = 0;
  }

  /// Adds a surface to look at, whose boxes are `reach` / 2 around its elements; `first`: it is the first of
  /// the two.
  void add(CollisionSurface const& surface, bool first, double reach) {
    if (used_ == standing_.size()) standing_.emplace_back();
    standing_[used_++].take(surface, first, reach / 2 + model_->settings.proximity + largestRadius_);
  }
  /// The surfaces that were added, by their places.
  int numberOf(int place) const { return standing_[std::size_t(place)].view.number; }

  /// Queues it, for points at x.
  template <class Intersection>
  void look(Intersection const& method, typename D::VecCoord const& x) {
    views_.clear();
    for (std::size_t k = 0; k < used_; ++k) views_.push_back(standing_[k].view);
    surfaces_ = viewsThere_.send(views_);
    const std::size_t n = model_->size();
    counts_.resize(n + 1);
    offsets_.resize(n + 1);
    if (expected_ == 0) expected_ = reserve_;
    makeRoom(std::max(reserve_, expected_));
    points_.position = x.device();
    const Look<Intersection> look{points_, surfaces_, int(used_), method};
    for_each_index(n + 1, Count<Intersection>{look, counts_.data(), int(n)});
    scan(int(n + 1));
    write(look, n);
    arrival_.begin(found_.data(), 1 + expected_);
  }
  /// Waits for what has come of it. Where it is more than there is room for, it is written down again, for
  /// the same points, which are at x now; returns whether that was so.
  template <class Intersection>
  bool take(Intersection const& method, typename D::VecCoord const& x) {
    FoundContact head;
    arrival_.take(&head, 1);
    const auto count = std::size_t(head.surface);
    const bool grows = count > room_;
    if (count > expected_) {
      if (grows) {
        makeRoom(count + count / 8);
        points_.position = x.device();
        write(Look<Intersection>{points_, surfaces_, int(used_), method}, model_->size());
      }
      arrival_.begin(found_.data(), 1 + count);
      arrival_.take(&head, 1);
    }
    expected_ = std::min(room_, count + count / 8 + 64);
    FoundContact const* const all = arrival_.data() + 1;
    again_ = std::exchange(accepted_, false) ? compare(all, count) : Again::no;
    taken_.assign(all, all + count);
    return grows;
  }
  /// What has been found, in the order of points, until the next search.
  std::vector<FoundContact> const& found() const { return taken_; }
  /// Whether each point has one contact at most and meets the same as in the step before, and whether that is
  /// in the same directions.
  enum class Again { no, same, sameDirections };
  Again again() const { return again_; }
  /// All that has been found is among the contacts of the scene, with which the next step is compared.
  void accept() { accepted_ = true; }

  /// A contact that has rows: which it is, the first of them, the response with these.
  struct Row {
    int place, row, response;
    double friction;
  };
  void clearRows() { rows_.clear(); }
  void addRow(Row const& row) { rows_.push_back(row); }
  /// Their violations into `to`, a number each row on the device, for a motion without multipliers from x to
  /// free, with the velocity v at its end.
  template <class... Responses>
  void putViolations(std::tuple<Responses...> const&, typename D::VecCoord const& x,
                     typename D::VecCoord const& free, typename D::VecDeriv const& v, double dt,
                     bool ofVelocity, double* to) {
    for_each_index(rows_.size(),
                   Violations<Responses...>{rowsThere_.send(rows_),
                                            found_.data() + 1,
                                            surfaces_,
                                            points_.elements,
                                            x.device(),
                                            free.device(),
                                            v.device(),
                                            dt,
                                            ofVelocity,
                                            to});
  }

  // what threads do

  // all contacts of a point
  template <class Intersection>
  struct Look {
    PointsOfState<D> points;
    StandingSurface const* surfaces;
    int count;
    Intersection method;

    template <class F>
    SINEW_HD void operator()(int element, F&& f) const {
      const Eigen::Vector3d x = points.template corner<1>(points.position, element)[0];
      for (int k = 0; k < count; ++k) {
        StandingSurface const& s = surfaces[k];
        s.grid.eachAt(x, [&](int other) {
          switch (s.shape) {
            case Shape::triangle:
              return meet<Shape::triangle>(element, k, other, x, f);
            case Shape::line:
              return meet<Shape::line>(element, k, other, x, f);
            default:
              return meet<Shape::point>(element, k, other, x, f);
          }
        });
      }
    }

   private:
    template <Shape Other, class F>
    SINEW_HD void meet(int element, int k, int other, Eigen::Vector3d const& x, F&& f) const {
      StandingSurface const& s = surfaces[k];
      using Points = PointsOfState<D>;
      Contact c;
      if (s.first) {
        const PrimitivePair<Other, Shape::point, StandingSurface, Points> pair{s, points, other, element, 0};
        if (method.find(pair, c)) f(found(c, c.a, element, k, other, x));
      } else {
        const PrimitivePair<Shape::point, Other, Points, StandingSurface> pair{points, s, element, other, 0};
        if (method.find(pair, c)) f(found(c, c.b, element, k, other, x));
      }
    }
    SINEW_HD FoundContact found(Contact const& c, ContactSide const& side, int element, int k, int other,
                                Eigen::Vector3d const& x) const {
      FoundContact f;
      f.surface = k;
      f.element = element;
      f.other = other;
      f.vertices = side.vertices;
      f.normal = c.normal;
      f.thickness = c.thickness;
      f.limit = c.limit;
      f.distance = c.distance;
      f.point = x;
      for (int i = 0; i < 3 && side.vertices[std::size_t(i)] >= 0; ++i) {
        f.weights[i] = side.weights[std::size_t(i)];
        f.standing += f.weights[i] * surfaces[k].position[side.vertices[std::size_t(i)]];
      }
      return f;
    }
  };
  template <class Intersection>
  struct Count {
    Look<Intersection> look;
    int* counts;
    int end;
    SINEW_HD void operator()(int i) const {
      int count = 0;
      if (i < end) look(i, [&](FoundContact const&) { ++count; });
      counts[i] = count;
    }
  };
  template <class Intersection>
  struct Write {
    Look<Intersection> look;
    int const* offsets;
    int end, room;
    FoundContact* to;
    SINEW_HD void operator()(int i) const {
      int next = offsets[i];
      if (i == end)
        to->surface = next;
      else if (offsets[i + 1] > next && offsets[i + 1] <= room)
        look(i, [&](FoundContact const& c) { to[1 + next++] = c; });
    }
  };
  template <class... Responses>
  struct Violations {
    Row const* rows;
    FoundContact const* found;
    StandingSurface const* surfaces;
    std::array<int, 3> const* elements;
    typename D::Coord const *x, *free;
    typename D::Deriv const* v;
    double dt;
    bool ofVelocity;
    double* to;

    SINEW_HD void operator()(int i) const {
      const Row row = rows[i];
      FoundContact c = found[row.place];
      c.friction = row.friction;
      const int point = elements[c.element][0];
      violations_of<D, Responses...>(c,
                                     surfaces[c.surface],
                                     row.response,
                                     x[point],
                                     free[point],
                                     v[point],
                                     dt,
                                     ofVelocity,
                                     to + row.row);
    }
  };

 private:
  CollisionSurface const* model_ = nullptr;
  long enclosures_ = -1;
  double largestRadius_ = 0;
  PointsOfState<D> points_{};
  SentList<std::array<int, 3>> elements_{};
  SentList<double> radii_{};
  std::vector<StandingOnDevice> standing_{};
  std::size_t used_ = 0;
  std::vector<StandingSurface> views_{};
  SentList<StandingSurface> viewsThere_{};
  StandingSurface const* surfaces_ = nullptr;
  DeviceArray<int> counts_{}, offsets_{};
  DeviceArray<unsigned char> scanRoom_{};
  DeviceArray<FoundContact> found_{};
  Arrival<FoundContact> arrival_{};
  std::size_t room_ = 0, reserve_ = 0, expected_ = 0;
  std::vector<FoundContact> taken_{};
  Again again_ = Again::no;
  bool accepted_ = false;
  std::vector<Row> rows_{};
  SentList<Row> rowsThere_{};

  Again compare(FoundContact const* now, std::size_t count) const {
    if (count != taken_.size()) return Again::no;
    bool directions = true;
    for (std::size_t i = 0; i < count; ++i) {
      FoundContact const &a = now[i], &b = taken_[i];
      if (a.surface != b.surface || a.element != b.element || a.other != b.other ||
          a.vertices != b.vertices || (i > 0 && a.element == now[i - 1].element))
        return Again::no;
      directions = directions && a.normal == b.normal && a.thickness == b.thickness && a.limit == b.limit;
    }
    return directions ? Again::sameDirections : Again::same;
  }
  void makeRoom(std::size_t contacts) {
    if (contacts <= room_) return;
    found_.resize(1 + contacts);
    room_ = contacts;
  }
  template <class Intersection>
  void write(Look<Intersection> const& look, std::size_t n) {
    for_each_index(n + 1, Write<Intersection>{look, offsets_.data(), int(n), int(room_), found_.data()});
  }
  // the counts before each
  void scan(int n) {
#if SINEW_CUDA
    std::size_t bytes = 0;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, counts_.data(), offsets_.data(), n, stream()),
          "contacts on the GPU");
    scanRoom_.resize(bytes);
    check(
        cub::DeviceScan::ExclusiveSum(scanRoom_.data(), bytes, counts_.data(), offsets_.data(), n, stream()),
        "contacts on the GPU");
#else
    int sum = 0;
    for (int i = 0; i < n; ++i) offsets_.data()[i] = std::exchange(sum, sum + counts_.data()[i]);
#endif
  }
};

}  // namespace sinew::gpu
