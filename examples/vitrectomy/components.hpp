// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/force/stiff_spring.hpp>

#include <algorithm>
#include <span>

namespace examples {

/// Springs that can be cut: a StiffSpringForceField that loses some while the scene runs, until a reset.
template <class D>
struct CuttableSpringForceField {
  using Role = sinew::role::ForceField;
  using DataTypes = D;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "CuttableSpringForceField";

  std::vector<sinew::Spring> springs{};  // those that are left

  static constexpr auto fields() {
    return sinew::field_list(sinew::field("springs",
                                          &CuttableSpringForceField::springs,
                                          "",
                                          "the springs: two points, stiffness, damping, length")
                                 .also("spring"));
  }

  std::vector<sinew::Spring> springsAtStart{};  // where some were cut

  static constexpr auto state() {
    return sinew::field_list(sinew::field("springsAtStart",
                                          &CuttableSpringForceField::springsAtStart,
                                          "",
                                          "the springs to which a reset goes, where some were cut"));
  }

  sinew::StiffSpringForceField<D> whole{}, uncut{};

  void init(sinew::InitContext<D> const& context) {
    auto start = [&](auto& field, auto const& list) {
      field.springs = list;
      field.init(context);
      field.springs.clear();
    };
    start(whole, springsAtStart.empty() ? springs : springsAtStart);
    start(uncut, springs);
    springsAtStart.reserve(springs.size());
  }
  /// All springs are there again; says whether some were not.
  bool reset() {
    if (springsAtStart.empty()) return false;
    springs.swap(springsAtStart);
    springsAtStart.clear();
    uncut.driver = whole.driver;
    return true;
  }
  /// Where points go, what was cut does not come back.
  void follow(sinew::Followed const&) { springsAtStart.clear(); }

  /// Removes the springs that have an end among these points, which rise. Allocates nothing.
  void cut(std::span<int const> points) {
    auto among = [points](int i) { return std::binary_search(points.begin(), points.end(), i); };
    auto goes = [&](sinew::Spring const& s) { return among(s.first) || among(s.second); };
    if (std::none_of(springs.begin(), springs.end(), goes)) return;
    if (springsAtStart.empty()) springsAtStart.assign(springs.begin(), springs.end());
    uncut.driver.removeIf([&](auto const& ends) { return among(ends[0]) || among(ends[1]); });
    std::erase_if(springs, goes);
  }

  void addForce(sinew::MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    sinew::add_force(uncut, p, f, x, v);
  }
  void addDForce(sinew::MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    sinew::add_dforce(uncut, p, df, dx);
  }
  double potentialEnergy(VecCoord const& x) const { return sinew::potential_energy(uncut, x); }
  template <class Sink>
  void addToMatrix(sinew::MechanicalParams const& p, Sink const& sink) {
    sinew::add_to_matrix(uncut, p, sink);
  }
};

/// Answers contact by cutting, in the place of a force.
struct SpringRemovalContact {
  static constexpr std::string_view className = "SpringRemovalContact";

  template <class D>
  void touch(CuttableSpringForceField<D>& springs, std::span<int const> points) const {
    springs.cut(points);
  }
};

}  // namespace examples
