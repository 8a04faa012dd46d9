// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/sorted_particles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Keeps all points of a body a distance h apart, whichever they are, as SOFA's plugin SofaSphFluid does: two
/// that are nearer, at r < h, push each other along n = (x_i - x_j) / r and slow each other down,
///   f_i = stiffness (h - r) n - damping (h - r) (v_i - v_j),   E = stiffness/2 (h - r)^2
/// Implicit solvers have of its derivative the part along n, -stiffness n n', which never pulls; the part
/// across, which does, is left out, and so is the damping unless `implicit` asks for it. Linear solvers that
/// assemble a matrix have nothing of it, as in SOFA: under these its forces are those at the start of a step.
/// Points at one place do not see each other. Sums go over neighbours in the order of their cells, so that
/// bits repeat.
template <class D>
struct ParticlesRepulsionForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "ParticlesRepulsionForceField";

  double distance = 1, stiffness = 100, damping = 0.1;
  bool implicit = false;

  static constexpr auto fields() {
    using F = ParticlesRepulsionForceField;
    return field_list(
        field("distance", &F::distance, "m", "below which two points push each other", range::positive),
        field("stiffness", &F::stiffness, "N/m", "of each pair", range::nonNegative),
        field("damping",
              &F::damping,
              "N s/m^2",
              "of each pair, by how much it is too near",
              range::nonNegative),
        field("implicit", &F::implicit, "", "whether implicit solvers have the damping"));
  }

  ForceProperties properties() const {
    return {
        .objective = damping == 0, .conservative = damping == 0, .exactTangent = false, .inMatrix = false};
  }

  std::string where{};
  SortedParticles<Real, lane_width<D>()> particles{};
  std::vector<FourOf<Real>> values{};  // velocities or motions, in the order of the particles

  void init(InitContext<D> const& context) {
    where = text(context.where, ": ", component_name<ParticlesRepulsionForceField>());
    reserve(context.rest.size());
  }
  void followPoints(Renumbering const&, std::size_t points) { reserve(points); }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    particles.sort(x, distance, where);
    const bool damped = damping > 0;
    if (damped) order(v);
    const L push{Real(stiffness * distance)}, slow{Real(damping * distance)};
    addSums(damped, f, [&](Pairs const& p, std::array<L, 3> const& apart, std::array<L, 3>& sum) {
      const L depth = depthOf(p), along = push * depth * inverse(p), rubs = slow * depth;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += along * p.d[c];
      for (std::size_t c = 0; c < 3; ++c) sum[c] -= rubs * apart[c];
    });
  }
  /// Of the pairs of the last addForce.
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) {
    order(dx);
    const L stiff{Real(-p.k * stiffness)}, slow{Real(implicit ? -p.b * damping * distance : 0)};
    addSums(true, df, [&](Pairs const& pairs, std::array<L, 3> const& apart, std::array<L, 3>& sum) {
      L along(0);
      for (std::size_t c = 0; c < 3; ++c) along += apart[c] * pairs.d[c];
      const L one = inverse(pairs);
      along = select(pairs.acts, stiff * one * one * along, L(0));
      const L rubs = slow * depthOf(pairs);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += along * pairs.d[c] + rubs * apart[c];
    });
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const&, Sink const&) const {}
  double potentialEnergy(VecCoord const& x) {
    particles.sort(x, distance, where);
    double energy = 0;
    particles.forEach({}, [&](int, auto const& each) {
      L sum(0);
      each([&](Pairs const& p) {
        const L depth = depthOf(p);
        sum += depth * depth;
      });
      energy += double(Particles::sum(sum));  // each pair twice
    });
    return stiffness * distance * distance * energy / 4;
  }

 private:
  using Particles = SortedParticles<Real, lane_width<D>()>;
  using Pairs = typename Particles::Pairs;
  using L = typename Particles::L;
  // what is this near, in radii, is at one place: a particle beside itself
  static constexpr Real atOnePlace = Real(2e-9);

  void reserve(std::size_t points) {
    particles.reserve(points);
    values.reserve(points);
  }
  void order(VecDeriv const& of) {
    values.resize(particles.order().size());
    for (std::size_t k = 0; k < particles.order().size(); ++k)
      for (int c = 0; c < 3; ++c) values[k].of[c] = of[std::size_t(particles.order()[k])][c];
  }
  // by how much pairs that are apart are too near [distance]
  static L depthOf(Pairs const& p) { return select(both(p.acts, p.q > L(atOnePlace)), L(1) - p.q, L(0)); }
  // 1/r of them
  L inverse(Pairs const& p) const {
    return select(p.q > L(atOnePlace), L(1) / (p.q * L(Real(distance))), L(0));
  }
  // To each particle what add(pairs, differences of the values where they are asked for, sum) sums up of its
  // neighbours.
  template <class F>
  void addSums(bool differences, VecDeriv& to, F&& add) {
    particles.forEach({}, [&](int i, auto const& each) {
      std::array<L, 3> own{L(0), L(0), L(0)}, sum = own;
      if (differences)
        for (std::size_t c = 0; c < 3; ++c) own[c] = L(values[std::size_t(i)].of[c]);
      each([&](Pairs const& p) {
        std::array<L, 3> apart{L(0), L(0), L(0)};
        if (differences) {
          L other[4];
          load_at(values.data(), p.places, other);
          for (std::size_t c = 0; c < 3; ++c) apart[c] = own[c] - other[c];
        }
        add(p, apart, sum);
      });
      const auto point = std::size_t(particles.order()[std::size_t(i)]);
      for (std::size_t c = 0; c < 3; ++c) to[point][Eigen::Index(c)] += Particles::sum(sum[c]);
    });
  }
};

}  // namespace sinew
