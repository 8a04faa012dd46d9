// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/lanes.hpp>
#include <sinew/core/role.hpp>
#include <sinew/core/roles/mapping.hpp>
#include <sinew/core/roles/state.hpp>
#include <sinew/core/roles/visual_model.hpp>
#include <sinew/scene/states_of.hpp>
#include <sinew/view/seen_settings.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstddef>
#include <map>
#include <type_traits>
#include <vector>

namespace sinew::view {

/// A line between two places, with the value of a quantity.
struct SeenLine {
  Eigen::Vector3d from{0, 0, 0}, to{0, 0, 0};
  double value = 0;
};

namespace detail {

/// Forces of volume elements that are computed element by element.
template <class C>
concept VolumeForce = requires(C const c) {
  c.driver.packs;
  c.law();
  requires C::DataTypes::spatial == 3 && !C::DataTypes::rigid;
  requires(C::Driver::arity == 4 && requires { C::needsTetrahedra; }) || C::Driver::arity == 8 ||
              requires { C::Driver::Law::points; };
};
/// Springs between two points.
template <class C>
concept SpringForce = requires(C const c) {
  c.driver.packs;
  c.driver.packs[0].rest.length;
  requires C::Driver::arity == 2 && !C::DataTypes::rigid;
};

inline double volume_of(Eigen::Vector3d const (&x)[4]) {
  return std::abs((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0])) / 6;
}
// of two tetrahedra beside a diagonal of the base
inline double volume_of(Eigen::Vector3d const (&x)[5]) {
  const Eigen::Vector3d across = x[2] - x[0], up = x[4] - x[0];
  return std::abs((x[1] - x[0]).cross(across).dot(up) + across.cross(x[3] - x[0]).dot(up)) / 6;
}
// of three
inline double volume_of(Eigen::Vector3d const (&x)[6]) {
  auto six = [&x](int i, int j, int k, int l) { return (x[j] - x[i]).cross(x[k] - x[i]).dot(x[l] - x[i]); };
  return std::abs(six(0, 1, 2, 5) + six(0, 1, 5, 4) + six(0, 4, 5, 3)) / 6;
}
// of six tetrahedra around a diagonal
inline double volume_of(Eigen::Vector3d const (&x)[8]) {
  constexpr int around[] = {1, 2, 3, 7, 4, 5, 1};
  double sum = 0;
  for (int k = 0; k < 6; ++k)
    sum += (x[around[k]] - x[0]).cross(x[around[k + 1]] - x[0]).dot(x[6] - x[0]) / 6;
  return std::abs(sum);
}

/// The mean stress in an element is that of the forces f_k which hold it at its points x_k against its own,
///   s = -1/V sum_k sym(f_k x_k'),
/// whatever its law is. This is its invariant by von Mises, sqrt(3/2 dev(s) : dev(s)).
template <std::size_t N>
double von_mises(Eigen::Vector3d const (&x)[N], Eigen::Vector3d const (&f)[N], double volume) {
  if (!(volume > 0)) return 0;
  Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < N; ++k) s -= f[k] * (x[k] - x[0]).transpose();
  s = (s + s.transpose()).eval() / (2 * volume);
  s.diagonal().array() -= s.trace() / 3;
  return std::sqrt(1.5) * s.norm();
}

}  // namespace detail

/// The values of a quantity at the points of all states and visual models of a scene.
template <class Simulation>
class SeenValues {
 public:
  SeenValues(Simulation& simulation, Quantity quantity) : simulation_(simulation), quantity_(quantity) {
    if (quantity == Quantity::displacement) findDisplacements();
    if (quantity == Quantity::speed) findSpeeds();
    if (quantity == Quantity::vonMises || quantity == Quantity::strainEnergy) findElementValues();
  }
  /// Of a state or a visual model, one for each point; nothing where there is no value.
  std::vector<double> of(void const* component) const {
    const auto found = values_.find(component);
    return found == values_.end() ? std::vector<double>() : found->second;
  }

 private:
  Simulation& simulation_;
  Quantity quantity_;
  std::map<void const*, std::vector<double>> values_{};

  void findDisplacements() {
    simulation_.template visit<role::State>([&](auto const& state, auto const&) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      auto& values = values_[&state];
      for (std::size_t i = 0; i < state.size() && i < state.restPosition.size(); ++i)
        values.push_back(double((D::center(state.position[i]) - D::center(state.restPosition[i])).norm()));
    });
    simulation_.template visit<role::VisualModel>([&](auto const& visual, auto const&) {
      auto& values = values_[&visual];
      const Mesh now = visual.current();
      for (std::size_t i = 0; i < now.positions.size(); ++i)
        values.push_back((now.positions[i] - visual.mesh.positions[i]).norm());
    });
  }

  void findSpeeds() {
    simulation_.template visit<role::State>([&](auto const& state, auto const&) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      auto& values = values_[&state];
      for (auto const& v : state.velocity) values.push_back(double(v.template head<D::spatial>().norm()));
    });
    simulation_.template visit<role::Mapping>([&](auto& mapping, auto const& scope) {
      scope.withMapped(mapping, [&](auto& part, auto& child, auto& parent) {
        using Child = std::decay_t<decltype(child)>;
        if constexpr (HasRole<Child, role::VisualModel>) {
          typename Child::DataTypes::VecDeriv velocity(child.size(), Child::DataTypes::Deriv::Zero());
          part.applyJ(velocity, parent.velocity);
          auto& values = values_[&child];
          values.assign(child.size(), 0);
          for (std::size_t i = 0; i < values.size(); ++i) values[i] = double(velocity[i].norm());
        }
      });
    });
  }

  // of elements, as the mean of those around a point, by their volumes; what follows by a mapping has the
  // values of what it follows
  void findElementValues() {
    std::map<void const*, std::vector<double>> weights;
    simulation_.template visit<role::ForceField>([&](auto const& force, auto const& scope) {
      using C = std::decay_t<decltype(force)>;
      if constexpr (detail::VolumeForce<C>) {
        auto const& state = scope.template state<typename C::DataTypes>();
        auto &sum = values_[&state], &weight = weights[&state];
        sum.resize(state.size());
        weight.resize(state.size());
        addElements(force, state, sum, weight);
      }
    });
    for (auto& [state, sum] : values_) {
      auto const& weight = weights[state];
      for (std::size_t i = 0; i < sum.size(); ++i)
        if (weight[i] > 0) sum[i] /= weight[i];
    }
    simulation_.template visit<role::Mapping>([&](auto& mapping, auto const& scope) {
      scope.withMapped(mapping, [&](auto& part, auto& child, auto& parent) {
        if constexpr (HasJacobianBlocks<std::decay_t<decltype(part)>>) {
          const auto above = values_.find(&parent);
          if (above == values_.end() || weights.count(&child)) return;
          std::vector<double> const& from = above->second;
          auto& to = values_[&child];
          to.resize(child.size());
          for (std::size_t i = 0; i < to.size(); ++i) {
            double sum = 0, all = 0;
            part.forEachJacobianBlock(int(i), [&](int point, auto const& block) {
              const double share = std::abs(double(block(0, 0)));
              sum += share * from[std::size_t(point)];
              all += share;
            });
            if (all > 0) to[i] = sum / all;
          }
        }
      });
    });
  }

  template <class Force, class State>
  void addElements(Force const& force, State const& state, std::vector<double>& sum,
                   std::vector<double>& weight) const {
    using Driver = typename Force::Driver;
    using Pack = typename Driver::Pack;
    constexpr int n = Driver::arity;
    const auto law = force.law();
    const auto ends = Driver::oneBody(state.position.data());
    for (Pack const& pack : force.driver.packs) {
      typename Pack::template OfPoints<typename Driver::DL::Coord> x;
      typename Pack::template OfPoints<typename Driver::DL::Deriv> v, f;
      pack.gather(ends, x);
      for (auto& one : v) one.setZero();
      auto tangent = pack.tangent;
      law.force(pack.rest, x, v, f, tangent);
      const auto energy = law.energy(pack.rest, x);
      for (int l = 0; l < pack.active; ++l) {
        Eigen::Vector3d at[std::size_t(n)], of[std::size_t(n)];
        for (int k = 0; k < n; ++k)
          for (int c = 0; c < 3; ++c) {
            at[k][c] = double(lane(x[k][c], l));
            of[k][c] = double(lane(f[k][c], l));
          }
        const double volume = [&] {
          if constexpr (n <= 8) {
            return detail::volume_of(at);
          } else {  // at rest
            double sum = 0;
            for (auto const& w : pack.rest.weight) sum += double(lane(w, l));
            return sum;
          }
        }();
        if (!(volume > 0) || !std::isfinite(volume)) continue;
        const double value = quantity_ == Quantity::vonMises ? detail::von_mises(at, of, volume)
                                                             : double(lane(energy, l)) / volume;
        for (int k = 0; k < n; ++k) {
          sum[std::size_t(pack.index[k][l])] += volume * value;
          weight[std::size_t(pack.index[k][l])] += volume;
        }
      }
    }
  }
};

/// All springs of a scene, with their stretch: length over that without force.
template <class Simulation>
std::vector<SeenLine> seen_springs(Simulation& simulation) {
  std::vector<SeenLine> lines;
  simulation.template visit<role::ForceField, role::InteractionForceField>(
      [&](auto const& force, auto const& scope) {
        using C = std::decay_t<decltype(force)>;
        if constexpr (detail::SpringForce<C>) {
          using D = typename C::DataTypes;
          auto add = [&](auto const& a, auto const& b) {
            auto place = [](auto const& state, int i) {
              Eigen::Vector3d p = Eigen::Vector3d::Zero();
              p.head<D::spatial>() = D::center(state.position[std::size_t(i)]).template cast<double>();
              return p;
            };
            for (auto const& pack : force.driver.packs)
              for (int l = 0; l < pack.active; ++l) {
                SeenLine line{place(a, pack.index[0][l]), place(b, pack.index[1][l])};
                const double rest = std::abs(double(lane(pack.rest.length, l)));
                if (rest > 0) line.value = (line.to - line.from).norm() / rest;
                lines.push_back(line);
              }
          };
          with_scopes_of(force, scope, [&](auto const& first, auto const&... second) {
            auto const& a = first.template state<D>();
            if constexpr (sizeof...(second) == 0)
              add(a, a);
            else
              add(a, (second, ...).template state<D>());
          });
        }
      });
  return lines;
}

}  // namespace sinew::view
