// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/proximity.hpp>
#include <sinew/gpu/device_vector.hpp>
#include <sinew/gpu/fused/components.hpp>
#include <sinew/gpu/fused/contacts.hpp>
#include <sinew/gpu/standing_surface.hpp>
#include <sinew/lagrangian/convex_constraint_solver.hpp>

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// What the copies of a fused step have of contacts, on the device; here: nothing.
struct NoFusedContacts {
  using View = NoContacts;
  template <class Simulation, class All>
  void init(Simulation&, All const&, std::vector<int> const&, int) {}
  template <class Simulation>
  void load(int, Simulation&) {}
  View view() { return {}; }
};

/// The same of a scene whose models of points meet surfaces that stand: these are the same for all copies.
template <class D, class Intersection, class Manager>
class FusedContactsOf;
template <class D, class Intersection, template <class...> class Manager, class... Responses>
class FusedContactsOf<D, Intersection, Manager<Responses...>> {
 public:
  using View = FusedContacts<D, Intersection, Responses...>;

  /// `order`: the node of each row. Throws Error where models may meet that a fused step does not know.
  template <class Simulation, class All>
  void init(Simulation& simulation, All const& all, std::vector<int> const& order, int copies) {
    auto const& manager = only<detail::IsContactManager>(all);
    auto const& pipeline = only<detail::IsPipeline>(all);
    ConvexConstraintSolver const& solver = only<detail::IsConstraintSolver>(all);
    method_ = only<detail::IsIntersection>(all);
    CollisionSurface* mine = nullptr;
    const std::vector<CollisionSurface*> surfaces = surfacesOf(simulation, mine);
    if (mine->solver < 0)
      throw Error(mine->path,
                  "no solver moves the body of a fused step; give its node an EulerImplicitSolver");
    if (!manager.attachments.empty())
      throw Error("FusedSimulation",
                  "a place is held from outside (attach), which a fused step does not know");

    // the surfaces that it may meet
    double radius = 0;
    for (std::size_t e = 0; e < mine->size(); ++e) radius = std::max(radius, mine->radiusOf(int(e)));
    std::vector<FusedAnswer> answers;
    std::vector<StandingSurface> views;
    std::size_t used = 0;
    standing_.resize(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      for (std::size_t j = i; j < surfaces.size(); ++j) {
        CollisionSurface &a = *surfaces[i], &b = *surfaces[j];
        if (!pipeline.compare(a, b) || !has_pairs(a, b)) continue;
        CollisionSurface& other = &a == mine ? b : a;
        if ((&a != mine && &b != mine) || &a == &b || other.solver >= 0 || other.rigid ||
            !(is_simplex(other.shape) || other.shape == Shape::sphere))
          throw Error(other.path,
                      text("a fused step has contacts of the body's points or spheres with triangles, lines, "
                           "points or spheres that no solver moves, and these two may meet otherwise: ",
                           a.path,
                           " and ",
                           b.path,
                           "; take Simulation, or keep them apart by a group"));
        if (!manager.answersMeasuring(a.number, b.number))
          throw Error(other.path,
                      "its contacts have a response that a fused step does not know; take "
                      "FrictionContactConstraint, or Simulation");
        const auto chosen = manager.answers.find(a.number, b.number);
        other.enclose(method_.reach() / 2, 0);
        StandingOnDevice& there = standing_[used++];
        there.take(other, &other == &a, method_.reach() / 2 + mine->settings.proximity + radius);
        views.push_back(there.view);
        const auto sameState = [&](auto const* s) { return s->state == other.state; };
        answers.push_back({int(std::find_if(surfaces.begin(), surfaces.end(), sameState) - surfaces.begin()),
                           chosen.place,
                           manager.frictionOf(chosen, a, b)});
      }
    answers_ = std::move(answers);
    surfaces_ = std::move(views);
    places_ = placesOf(surfaces, *mine);

    // the points
    static_cast<SurfaceShape&>(points_) = *mine;
    points_.settings = {mine->settings.proximity, mine->settings.bothSide};
    std::vector<int> elementOf(order.size(), -1);
    for (std::size_t e = 0; e < mine->size(); ++e) {
      int& element = elementOf[std::size_t(mine->elements[e][0])];
      if (element >= 0)
        throw Error(mine->path,
                    text("elements ",
                         element,
                         " and ",
                         e,
                         " of its collision model are on the same point; a fused step knows one of each"));
      element = int(e);
    }
    elements_ = mine->elements;
    if (mine->shape == Shape::sphere) radii_ = mine->radius;
    elementOf_ = std::move(elementOf);

    rows_ = order.size();
    order_ = order;
    const std::size_t n = std::size_t(copies) * rows_;
    contacts_.resize(n * FusedEntries::room);
    blocks_.resize(n * FusedEntries::room);
    numbers_.resize(n * View::numbersOfRow);
    clear_on_device(numbers_.data(), n * View::numbersOfRow);
    counts_ = DeviceVector<int>(n, 0);
    unsolved_ = DeviceVector<int>(std::size_t(copies), 0);
    crowded_ = DeviceVector<int>(std::size_t(copies), 0);
    settings_.tolerance = solver.tolerance;
    settings_.momentumTolerance = solver.momentumTolerance;
    settings_.maxUpdates = solver.maxUpdates;
    settings_.maxConjugateGradients = solver.maxIterations;
    check_convex_step(settings_, "FusedSimulation");
    stopsUnsolved_ = solver.stopsUnsolved;
  }
  /// A copy that another state comes to has no contacts before its next step. Throws Error where surfaces
  /// stand elsewhere in the scene that it comes from.
  template <class Simulation>
  void load(int copy, Simulation& from) {
    CollisionSurface* mine = nullptr;
    const std::vector<CollisionSurface*> surfaces = surfacesOf(from, mine);
    if (placesOf(surfaces, *mine) != places_)
      throw Error("FusedSimulation::load",
                  "surfaces that stand are elsewhere than those of the copies, which share them; make a "
                  "FusedSimulation of this simulation");
    const auto begin = std::ptrdiff_t(std::size_t(copy) * rows_);
    clear_on_device(counts_.device() + begin, rows_);
    clear_on_device(numbers_.data() + begin * std::ptrdiff_t(View::numbersOfRow), rows_ * View::numbersOfRow);
    clear_on_device(unsolved_.device() + copy, 1);
    clear_on_device(crowded_.device() + copy, 1);
  }
  View view() {
    points_.elements = std::as_const(elements_).device();
    points_.radii = points_.shape == Shape::sphere ? std::as_const(radii_).device() : nullptr;
    View v;
    v.look = {points_, std::as_const(surfaces_).device(), int(surfaces_.size()), method_};
    v.elementOf = std::as_const(elementOf_).device();
    v.answers = std::as_const(answers_).device();
    v.rows = int(rows_);
    v.contacts = contacts_.data();
    v.counts = counts_.device();
    v.blocks = blocks_.data();
    v.numbers = numbers_.data();
    v.unsolved = unsolved_.device();
    v.crowded = crowded_.device();
    v.settings = settings_;
    return v;
  }

  /// Steps of a copy whose contacts were not solved to the tolerances.
  int unsolved(int copy) const { return unsolved_[std::size_t(copy)]; }
  /// Throws Error where contacts of a copy were lost, or, if the scene says so, not solved.
  void check(std::size_t copy) const {
    const std::string where = text("copy ", copy);
    if (std::as_const(crowded_).host()[copy] != 0)
      throw Error(where,
                  text("a point has touched more than ",
                       FusedEntries::room,
                       " places at once, for which a fused step has no room; take Simulation, or a surface "
                       "with fewer folds"));
    if (stopsUnsolved_ && std::as_const(unsolved_).host()[copy] != 0)
      throw Error(where,
                  text("ConvexConstraintSolver: contacts were not solved to the tolerances in ",
                       unsolved_[copy],
                       " steps; allow more (maxUpdates, maxIterations), or leave stopsUnsolved out"));
  }
  /// The contacts of a copy in the last step, by the order of rows, each with its node.
  std::vector<std::pair<int, FusedContact>> contacts(int copy) const {
    const std::size_t room = FusedEntries::room, begin = std::size_t(copy) * rows_;
    std::vector<FusedContact> all(rows_ * room);
    copy_to_host(all.data(), contacts_.data() + begin * room, all.size());
    std::vector<std::pair<int, FusedContact>> list;
    for (std::size_t row = 0; row < rows_; ++row)
      for (std::size_t k = 0; k < std::size_t(counts_[begin + row]); ++k)
        list.push_back({order_[row], all[row * room + k]});
    return list;
  }

 private:
  Intersection method_{};
  std::vector<StandingOnDevice> standing_{};
  DeviceVector<StandingSurface> surfaces_{};
  DeviceVector<FusedAnswer> answers_{};
  PointsOfState<D> points_{};
  DeviceVector<std::array<int, 3>> elements_{};
  DeviceVector<double> radii_{};
  DeviceVector<int> elementOf_{}, counts_{}, unsolved_{}, crowded_{};
  DeviceArray<FusedContact> contacts_{};
  DeviceArray<ConstraintBlock> blocks_{};
  DeviceArray<double> numbers_{};
  std::vector<int> order_{};
  std::vector<Eigen::Vector3d> places_{};  // of the surfaces that stand
  std::size_t rows_ = 0;
  ConvexStepSettings settings_{};
  bool stopsUnsolved_ = false;

  template <template <class> class Test, class All>
  static auto& only(All const& all) {
    return *std::get<0>(components_that<Test>(all));
  }
  // all surfaces where they are now, in the order of the scene; `mine` is that of the points
  template <class Simulation>
  static std::vector<CollisionSurface*> surfacesOf(Simulation& simulation, CollisionSurface*& mine) {
    std::vector<CollisionSurface*> all;
    simulation.template visit<role::CollisionModel>([&](auto& model, auto const& scope) {
      using Model = std::decay_t<decltype(model)>;
      using Types = typename Model::DataTypes;
      auto const& state = scope.template state<Types>();
      CollisionSurface& surface = model.surface;
      surface.state = &state;
      surface.number = int(all.size());
      if constexpr (detail::IsPointModel<Model>::value)
        mine = &surface;
      else
        update_vertices<Types>(surface, state.position, state.velocity);
      all.push_back(&surface);
    });
    return all;
  }
  static std::vector<Eigen::Vector3d> placesOf(std::vector<CollisionSurface*> const& surfaces,
                                               CollisionSurface const& mine) {
    std::vector<Eigen::Vector3d> all;
    for (auto const* s : surfaces)
      if (s != &mine) all.insert(all.end(), s->position.begin(), s->position.end());
    return all;
  }
};

}  // namespace sinew::gpu
