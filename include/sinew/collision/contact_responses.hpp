// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact_constraint.hpp>
#include <sinew/core/error.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace sinew {

/// A response of a contact manager by its place, with what its parameters say.
struct ResponseChoice {
  static constexpr int notGiven = -1, noResponse = -2;
  int place = notGiven;
  double friction = -1;  // mu of a response that has one; negative: they do not say it
};

/// A response with a coefficient of friction of its own, a parameter in scene files.
template <class R>
concept HasFriction = requires(R r) { r.mu = 0.5; };

/// What answers contacts: laws of force (ContactLaw), multipliers (ContactConstraint), and what changes
/// components that are touched (TouchResponse), in the order of a contact manager, which numbers them.
template <class... Responses>
struct ContactResponses {
  static constexpr int count = int(sizeof...(Responses));

  static std::string names() {
    std::string all;
    ((all += text(all.empty() ? "" : ", ", Responses::className)), ...);
    return all;
  }
  /// The name that the first response that has one gives its manager; nothing where none has.
  static consteval std::string_view managerName() {
    std::string_view name;
    auto look = [&]<class R>(R const*) {
      if constexpr (requires { R::managerName; })
        if (name.empty()) name = R::managerName;
    };
    (look(static_cast<Responses const*>(nullptr)), ...);
    return name;
  }
  /// Place of a response of a name; -1 where there is none.
  static int find(std::string_view name) {
    int place = -1, i = 0;
    auto look = [&]<class R>(R const*) {
      if (place < 0 && (R::className == name || has_name(class_aliases<R>(), name))) place = i;
      ++i;
    };
    (look(static_cast<Responses const*>(nullptr)), ...);
    return place;
  }
  /// The response that "Name" or "Name?mu=0.5" asks for, as scene files do, or that there shall be none by
  /// "nullptr" (SOFA); throws Error where nothing has that name.
  static ResponseChoice choose(std::string_view where, std::string_view wanted) {
    const std::size_t mark = wanted.find('?');
    const std::string_view name = wanted.substr(0, mark);
    if (name == "nullptr") return {.place = ResponseChoice::noResponse};
    ResponseChoice choice{.place = find(name)};
    if (choice.place < 0)
      throw Error(where,
                  text("contacts ask for the response '",
                       name,
                       "', which this contact manager does not have; take one of: ",
                       names()));
    const bool takesFriction[] = {HasFriction<Responses>...};
    const bool byPenalty = (is_by_penalty<Responses>(name) || ...);
    if (mark != wanted.npos && takesFriction[choice.place])
      choice.friction = parse_friction(where, name, wanted.substr(mark + 1), byPenalty);
    if (byPenalty) choice.friction = std::max(choice.friction, 0.0);
    return choice;
  }
  /// By a law of force, the only one that ODE solvers see.
  static bool isForce(int place) {
    constexpr std::array forces{ContactLaw<Responses>...};
    return forces[std::size_t(place)];
  }
  static bool isConstraint(int place) {
    constexpr std::array constraints{ContactConstraint<Responses>...};
    return place >= 0 && constraints[std::size_t(place)];
  }

  /// By multipliers whose violations follow from the motion (MeasuresMotion).
  static bool measuresMotion(int place) {
    constexpr std::array measuring{ContactConstraint<Responses> && MeasuresMotion<Responses>...};
    return place >= 0 && measuring[std::size_t(place)];
  }

  /// f(response) for that at a place.
  template <class F>
  static void visit(std::tuple<Responses...> const& responses, int place, F&& f) {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      ((place == int(I) ? f(std::get<I>(responses)) : void()), ...);
    }(std::index_sequence_for<Responses...>{});
  }
  static void setStep(std::tuple<Responses...>& responses, double dt) {
    auto set = [dt](auto& response) {
      if constexpr (requires { response.dt = dt; }) response.dt = dt;
    };
    std::apply([&](auto&... r) { (set(r), ...); }, responses);
  }

 private:
  template <class R>
  static bool is_by_penalty(std::string_view name) {
    if constexpr (requires { R::byPenalty; }) return name == R::byPenalty;
    return false;
  }
  // "name=value&name=value"; epsilon, where it is one, is read and has no effect
  static double parse_friction(std::string_view where, std::string_view response, std::string_view parameters,
                               bool byPenalty) {
    double mu = -1;
    while (!parameters.empty()) {
      const std::size_t end = std::min(parameters.find('&'), parameters.size()),
                        equals = std::min(parameters.find('='), end);
      const std::string_view name = parameters.substr(0, equals),
                             value = parameters.substr(std::min(equals + 1, end),
                                                       end - std::min(equals + 1, end));
      parameters.remove_prefix(std::min(end + 1, parameters.size()));
      const bool penalty = byPenalty && name == "epsilon";
      if (name != "mu" && !penalty)
        throw Error(where,
                    text("the response '",
                         response,
                         "' has no parameter '",
                         name,
                         "'; it has: mu",
                         byPenalty ? ", epsilon" : ""));
      double number = 0;
      const auto [last, error] = std::from_chars(value.data(), value.data() + value.size(), number);
      if (error != std::errc{} || last != value.data() + value.size() || !std::isfinite(number) || number < 0)
        throw Error(where,
                    text("the response '",
                         response,
                         "' has ",
                         name,
                         "='",
                         value,
                         penalty ? "'; the penalty is a number of at least 0"
                                 : "'; the coefficient of friction is a number of at least 0, such as in "
                                   "mu=0.5"));
      if (!penalty) mu = number;
    }
    return mu;
  }
};

}  // namespace sinew
