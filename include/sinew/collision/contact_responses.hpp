// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/contact.hpp>
#include <sinew/core/error.hpp>

#include <array>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace sinew {

/// What answers contacts: laws of force (ContactLaw), and what changes components that are touched
/// (TouchResponse), in the order of a contact manager, which numbers them.
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
  /// What changes components is no force, and no solver needs to know.
  static bool isForce(int place) {
    constexpr std::array forces{ContactLaw<Responses>...};
    return forces[std::size_t(place)];
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
};

}  // namespace sinew
