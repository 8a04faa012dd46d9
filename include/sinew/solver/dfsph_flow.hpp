// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/workers.hpp>
#include <sinew/force/sorted_particles.hpp>

#include <Eigen/Core>

#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// The pressures of a fluid of particles that is not compressed, by divergence-free SPH (Bender, Koschier
/// 2017). Particle i has the volume V_i = m_i / density at rest, and with the kernel W (WendlandKernel, see
/// calibrate())
///   d_i = sum_j V_j W_ij                       density over that at rest
///   D_i = sum_j V_j (v_i - v_j).grad W_ij      its rate [1/s]
///   a_i = -sum_j V_j (k_i + k_j) grad W_ij     acceleration by k = pressure / density >= 0 [m^2/s^2]
/// so that forces V_i a_i of a pair are opposite, and momentum is kept to rounding. Two iterations find k,
/// each from that of the last step: one so that D <= 0 (divergence), one so that d + h D <= 1 at the end of a
/// step h (density). Both are relaxed and projected Jacobi iterations,
///   k_i <- max(0, k_i + w r_i / (h^2 b_i)),  b_i = |sum_j V_j grad W_ij|^2 + sum_j V_i V_j |grad W_ij|^2,
/// w = 1/2, on r = h D, or d + h D - 1. Boundary particles (Akinci et al. 2012) are neighbours, too, with
/// volumes V_k = c / sum_l W_kl over those of boundaries, velocities of their own and k = 0. The constant c
/// (Band, Gissler, Ihmsen, Cornelis, Peer, Teschner 2018) is such that a plane of points at distances of half
/// the radius is a layer of the fluid.
/// Viscosity is implicit, too (Weiler, Koschier, Brand, Bender 2018): with nu = viscosity / density the new
/// velocities are those of
///   v_i = v*_i - h nu sum_j V_j w_ij (v_ij.x_ij) x_ij,  w_ij = -c 10 W'_ij / (r^2 + radius^2 / 100) / r,
/// by conjugate gradients with the inverse of the blocks of the diagonal. Pairs have opposite forces along
/// x_ij, so that momentum and angular momentum are kept to the tolerance of the iteration, and a body that
/// turns as a whole is not slowed down.
/// Boundary particles hold the fluid that touches them. The constant c is such that waves across a cubic
/// lattice that are long to its distance decay as those of the continuum.
class DFSPHFlow {
 public:
  struct Iteration {
    int least = 2, most = 100;
    double tolerance = 1e-4;
    int taken = 0;
    /// Of the last iteration: the mean over the fluid of |r_i|, or of what k_i can still do against r_i < 0.
    double error = 0;
  };

  double radius = 1;  // of the kernel [m]
  double factor = 1;  // of the kernel
  double viscosityFactor = 1;
  SomeWorkers workers{};

  // of particles, the fluid's first, then those of the boundary
  std::vector<Eigen::Vector3d> positions{}, velocities{};
  // of the fluid: [m^3], by other forces [m/s^2], d
  std::vector<double> volumes{};
  std::vector<Eigen::Vector3d> accelerations{};
  std::vector<double> densities{};
  // of the boundary: impulses by the fluid over its density, summed up [N s / (kg/m^3)]
  std::vector<Eigen::Vector3d> impulses{};

  std::size_t fluidSize() const { return volumes.size(); }

  /// Makes the kernel such that a cubic lattice of particles at this distance has d = 1.
  void calibrate(double distance);
  /// Room for all.
  void reserve(std::size_t fluid, std::size_t boundary);
  /// Finds neighbours, densities and b where the particles are. Throws Error as PointCells does.
  void place(std::string_view where);
  /// The longest step in which none of the fluid moves farther than a distance, by its velocity and
  /// acceleration [s]; not a number where these are none.
  double longestStep(double distance) const;
  /// Change the velocities of the fluid by the pressures over h that they find, from those of the last time.
  void solveDivergence(double h, Iteration& iteration, std::vector<double>& pressures) {
    solve(h, false, iteration, pressures);
  }
  void solveDensity(double h, Iteration& iteration, std::vector<double>& pressures) {
    solve(h, true, iteration, pressures);
  }
  /// Velocities of the fluid behind h of a kinematic viscosity [m^2/s]. The error is that of the residual,
  /// over the first one.
  void solveViscosity(double h, double kinematic, Iteration& iteration);
  /// Velocities of the fluid nearer to the mean of those around: v_i += part sum_j V_j W_ij (v_j - v_i).
  void smooth(double part);
  /// Two particles of the fluid that are in one place, or {-1, -1}; behind place().
  std::pair<int, int> coincident();

 private:
  using Particles = SortedParticles<double, native_width<double>>;
  using L = Particles::L;
  using Pairs = Particles::Pairs;

  // sum W (r / 2)^3 over a plane of points at distances of r / 2
  static constexpr double boundaryLayer = 0.7782;

  // in the order of the particles, whose weights are their volumes
  Particles particles_{};
  std::vector<FourOf<double>> moved_{};                       // velocities by the pressures, and 0
  std::array<std::vector<double>, 3> velocity_{}, pushed_{};  // at first, and by the viscosity
  std::array<std::vector<double>, 3> residual_{}, direction_{}, product_{};  // of conjugate gradients
  std::array<std::vector<double>, 6> inverse_{};  // of the blocks of the diagonal: xx, yy, zz, xy, xz, yz
  std::vector<double> fluid_{}, volume_{};        // fluid: 1, boundary: 0
  std::vector<double> density_{}, diagonal_{}, pressure_{}, next_{}, error_{};
  std::vector<char> whole_{};  // has neighbours all around

  // f(array) for those with an entry for each particle
  template <class F>
  void forEachArray(F&& f) {
    for (auto* vectors : {&velocity_, &pushed_, &residual_, &direction_, &product_})
      for (auto& one : *vectors) f(one);
    for (auto& one : inverse_) f(one);
    for (auto* one : {&fluid_, &volume_, &density_, &diagonal_, &pressure_, &next_, &error_}) f(*one);
  }
  void findBoundaryVolumes(WorkShare const& share);
  void findDensities(WorkShare const& share);
  void push(WorkShare const& share, double h);
  void correct(WorkShare const& share, double h, bool ofDensity);
  void pushBoundary(WorkShare const& share, double h);
  void invertViscosity(WorkShare const& share, double strength);
  void drag(WorkShare const& share, double strength, std::array<std::vector<double>, 3> const& of);
  void dragBoundary(WorkShare const& share, double strength);
  void solve(double h, bool ofDensity, Iteration& iteration, std::vector<double>& pressures);

  // f(share), by threads where that pays
  template <class F>
  void inShares(F&& f) const {
    if (positions.size() < 2000)
      f(WorkShare{});
    else
      workers.run(f);
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/force/sph_kernels.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sinew {

SINEW_ONCE void DFSPHFlow::calibrate(double distance) {
  const WendlandKernel<double> kernel(radius);
  const int reach = int(radius / distance);
  double sum = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        sum += kernel.density(std::min(1.0, std::sqrt(double(x * x + y * y + z * z)) * distance / radius));
  factor = 1 / (sum * distance * distance * distance);
  // v_x = f(y) has the acceleration nu f'' sum_j V_j w_ij x^2 y^2 / 2
  const WendlandKernel<double> scaled(radius, factor);
  double along = 0;
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z) {
        const double square = double(x * x + y * y + z * z) * distance * distance;
        along -= 10 * scaled.densitySlope(std::min(1.0, std::sqrt(square) / radius)) /
                 (square + radius * radius / 100) * double(x * x * y * y);
      }
  viscosityFactor = 2 / (along * std::pow(distance, 7));
}

SINEW_ONCE void DFSPHFlow::reserve(std::size_t fluid, std::size_t boundary) {
  const std::size_t all = fluid + boundary;
  particles_.reserve(all);
  forEachArray([all](auto& v) { v.reserve(all); });
  whole_.reserve(all);
  moved_.reserve(all);
  positions.reserve(all);
  velocities.reserve(all);
  accelerations.reserve(fluid);
  impulses.reserve(boundary);
  for (auto* v : {&volumes, &densities}) v->reserve(fluid);
}

SINEW_ONCE void DFSPHFlow::place(std::string_view where) {
  const std::size_t n = fluidSize(), all = positions.size();
  particles_.sort(positions, radius, where);
  forEachArray([all](auto& v) { v.resize(all, 0.0); });
  whole_.resize(all);
  moved_.resize(all);
  densities.resize(n);
  for (std::size_t k = 0; k < all; ++k) {
    const auto i = std::size_t(particles_.order()[k]);
    fluid_[k] = i < n ? 1 : 0;
    volume_[k] = i < n ? volumes[i] : 0;
  }
  if (all > n) inShares([&](WorkShare share) { findBoundaryVolumes(share); });
  for (std::size_t k = 0; k < all; ++k) particles_.weight(k) = volume_[k];
  inShares([&](WorkShare share) { findDensities(share); });
  for (std::size_t k = 0; k < all; ++k)
    if (const auto i = std::size_t(particles_.order()[k]); i < n) densities[i] = density_[k];
}

SINEW_ONCE void DFSPHFlow::findBoundaryVolumes(WorkShare const& share) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    if (fluid_[std::size_t(i)] != 0) return;
    L around(0);
    each([&](Pairs const& p) {
      around += select(p.acts, (L(1) - Particles::load(fluid_, p)) * kernels.density(p.q), L(0));
    });
    volume_[std::size_t(i)] = boundaryLayer / Particles::sum(around);
  });
}

SINEW_ONCE void DFSPHFlow::findDensities(WorkShare const& share) {
  constexpr double few = 20;  // neighbours, below which a particle may go where it likes (2017, section 3.3)
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] == 0) return;
    L around(0), squares(0), count(0);
    std::array<L, 3> gradient{L(0), L(0), L(0)};
    each([&](Pairs const& p) {
      const L volume = p.weight;
      around += select(p.acts, volume * kernels.density(p.q), L(0));
      count += select(p.acts, L(1), L(0));
      L square(0);
      const L slope = select(p.acts, volume * kernels.densitySlope(p.q), L(0));
      for (std::size_t c = 0; c < 3; ++c) {
        const L along = slope * p.d[c];
        gradient[c] += along;
        square += along * along;
      }
      // V_i V_j |grad W|^2 from (V_j grad W)^2, of the fluid
      squares += select(p.acts, Particles::load(fluid_, p) * square / volume, L(0));
    });
    density_[at] = Particles::sum(around);
    double diagonal = volume_[at] * Particles::sum(squares);
    for (L const& g : gradient) {
      const double along = Particles::sum(g);
      diagonal += along * along;
    }
    diagonal_[at] = diagonal;
    whole_[at] = Particles::sum(count) - 1 >= few;
  });
}

SINEW_ONCE double DFSPHFlow::longestStep(double distance) const {
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < fluidSize(); ++i) {
    // |v| h + |a| h^2 = distance
    const double v = velocities[i].norm(), a = accelerations[i].norm();
    const double h = 2 * distance / (v + std::sqrt(v * v + 4 * a * distance));
    if (!(h >= longest)) longest = h;
    if (std::isnan(h)) return h;
  }
  return longest;
}

SINEW_ONCE std::pair<int, int> DFSPHFlow::coincident() {
  std::pair<int, int> found{-1, -1};
  particles_.forEach({}, [&](int i, auto const& each) {
    if (fluid_[std::size_t(i)] == 0) return;
    each([&](Pairs const& p) {
      for (int l = 0; l < Particles::width; ++l)
        if (const int j = p.places[l]; j > i && lane(p.q, l) < 1e-6 && fluid_[std::size_t(j)] != 0)
          found = std::minmax(particles_.order()[std::size_t(i)], particles_.order()[std::size_t(j)]);
    });
  });
  return found;
}

// moved = v + h a of the fluid
SINEW_ONCE void DFSPHFlow::push(WorkShare const& share, double h) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] == 0) return;
    const L own(pressure_[at]);
    std::array<L, 3> sums{L(0), L(0), L(0)};
    each([&](Pairs const& p) {
      // the slope is 0 where a pair does not act: q = 1
      const L along = p.weight * (own + Particles::load(pressure_, p)) * kernels.densitySlope(p.q);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
    });
    for (std::size_t c = 0; c < 3; ++c) moved_[at].of[c] = velocity_[c][at] - h * Particles::sum(sums[c]);
  });
}

SINEW_ONCE void DFSPHFlow::correct(WorkShare const& share, double h, bool ofDensity) {
  constexpr double relaxation = 0.5;
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    next_[at] = error_[at] = 0;
    if (fluid_[at] == 0 || !(diagonal_[at] > 0) || !(ofDensity || whole_[at])) return;
    std::array<L, 3> v;
    for (std::size_t c = 0; c < 3; ++c) v[c] = L(moved_[at].of[c]);
    L rate(0);
    each([&](Pairs const& p) {
      L other[4], closing(0);
      load_at(moved_.data(), p.places, other);
      for (std::size_t c = 0; c < 3; ++c) closing += (v[c] - other[c]) * p.d[c];
      rate += p.weight * kernels.densitySlope(p.q) * closing;
    });
    const double residual = h * Particles::sum(rate) + (ofDensity ? density_[at] - 1 : 0);
    const double strength = h * h * diagonal_[at];
    error_[at] = residual > 0 ? residual : std::min(-residual, strength * pressure_[at]);
    next_[at] = std::max(0.0, pressure_[at] + relaxation * residual / strength);
  });
}

SINEW_ONCE void DFSPHFlow::pushBoundary(WorkShare const& share, double h) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] != 0) return;
    std::array<L, 3> sums{L(0), L(0), L(0)};
    each([&](Pairs const& p) {
      const L along =
          select(p.acts,
                 Particles::load(volume_, p) * Particles::load(pressure_, p) * kernels.densitySlope(p.q),
                 L(0));
      for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
    });
    auto& impulse = impulses[std::size_t(particles_.order()[at]) - fluidSize()];
    for (std::size_t c = 0; c < 3; ++c) impulse[Eigen::Index(c)] -= h * volume_[at] * Particles::sum(sums[c]);
  });
}

namespace detail {
// w_ij of a pair, with the volume of its other particle
template <class Pairs, class L>
L viscous_weight(WendlandKernel<double> const& kernels, Pairs const& p, L const& volume, double factor,
                 double radius) {
  const L square = p.q * p.q * L(radius * radius);
  return select(p.acts,
                volume * L(-10 * factor) * kernels.densitySlope(p.q) / (square + L(radius * radius / 100)),
                L(0));
}
}  // namespace detail

// the inverse of 1 + strength sum_j V_j w_ij x x'
SINEW_ONCE void DFSPHFlow::invertViscosity(WorkShare const& share, double strength) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] == 0) return;
    std::array<L, 6> sums{L(0), L(0), L(0), L(0), L(0), L(0)};
    each([&](Pairs const& p) {
      const L w = detail::viscous_weight(kernels, p, Particles::load(volume_, p), viscosityFactor, radius);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += w * p.d[c] * p.d[c];
      sums[3] += w * p.d[0] * p.d[1];
      sums[4] += w * p.d[0] * p.d[2];
      sums[5] += w * p.d[1] * p.d[2];
    });
    std::array<double, 6> s;
    for (std::size_t c = 0; c < 6; ++c) s[c] = strength * Particles::sum(sums[c]);
    Eigen::Matrix3d block;
    block << 1 + s[0], s[3], s[4], s[3], 1 + s[1], s[5], s[4], s[5], 1 + s[2];
    const Eigen::Matrix3d inverse = block.inverse();
    for (std::size_t c = 0; c < 3; ++c) inverse_[c][at] = inverse(Eigen::Index(c), Eigen::Index(c));
    inverse_[3][at] = inverse(0, 1), inverse_[4][at] = inverse(0, 2), inverse_[5][at] = inverse(1, 2);
  });
}

// product = strength sum_j V_j w_ij (v_ij.x_ij) x_ij of the fluid
SINEW_ONCE void DFSPHFlow::drag(WorkShare const& share, double strength,
                                std::array<std::vector<double>, 3> const& of) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] == 0) return;
    std::array<L, 3> v, sums{L(0), L(0), L(0)};
    for (std::size_t c = 0; c < 3; ++c) v[c] = L(of[c][at]);
    each([&](Pairs const& p) {
      L along(0);
      for (std::size_t c = 0; c < 3; ++c) along += (v[c] - Particles::load(of[c], p)) * p.d[c];
      along *= detail::viscous_weight(kernels, p, Particles::load(volume_, p), viscosityFactor, radius);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
    });
    for (std::size_t c = 0; c < 3; ++c) product_[c][at] = strength * Particles::sum(sums[c]);
  });
}

SINEW_ONCE void DFSPHFlow::dragBoundary(WorkShare const& share, double strength) {
  const WendlandKernel<double> kernels(radius, factor);
  particles_.forEach(share, [&](int i, auto const& each) {
    const auto at = std::size_t(i);
    if (fluid_[at] != 0) return;
    std::array<L, 3> v, sums{L(0), L(0), L(0)};
    for (std::size_t c = 0; c < 3; ++c) v[c] = L(pushed_[c][at]);
    each([&](Pairs const& p) {
      L along(0);
      for (std::size_t c = 0; c < 3; ++c) along += (Particles::load(pushed_[c], p) - v[c]) * p.d[c];
      along *= detail::viscous_weight(
          kernels, p, Particles::load(volume_, p) * Particles::load(fluid_, p), viscosityFactor, radius);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += along * p.d[c];
    });
    auto& impulse = impulses[std::size_t(particles_.order()[at]) - fluidSize()];
    for (std::size_t c = 0; c < 3; ++c)
      impulse[Eigen::Index(c)] += strength * volume_[at] * Particles::sum(sums[c]);
  });
}

SINEW_ONCE void DFSPHFlow::solveViscosity(double h, double kinematic, Iteration& iteration) {
  const std::size_t n = fluidSize(), all = positions.size();
  const double strength = h * kinematic;
  impulses.resize(all - n, Eigen::Vector3d::Zero());
  iteration.taken = 0;
  iteration.error = 0;
  auto const& order = particles_.order();
  for (std::size_t k = 0; k < all; ++k)
    for (int c = 0; c < 3; ++c) pushed_[std::size_t(c)][k] = velocities[std::size_t(order[k])][c];
  // sum_i V_i a_i.b_i, in the order of the particles
  auto dot = [&](auto const& a, auto const& b) {
    double sum = 0;
    for (std::size_t k = 0; k < all; ++k) {
      const double one = a[0][k] * b[0][k] + a[1][k] * b[1][k] + a[2][k] * b[2][k];
      sum += fluid_[k] * volume_[k] * one;
    }
    return sum;
  };
  // z = inverse r
  auto precondition = [&](std::size_t k) {
    auto const& [xx, yy, zz, xy, xz, yz] = inverse_;
    const double x = residual_[0][k], y = residual_[1][k], z = residual_[2][k];
    return std::array{xx[k] * x + xy[k] * y + xz[k] * z,
                      xy[k] * x + yy[k] * y + yz[k] * z,
                      xz[k] * x + yz[k] * y + zz[k] * z};
  };
  inShares([&](WorkShare share) {
    invertViscosity(share, strength);
    drag(share, strength, pushed_);
  });
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < all; ++k) {
      residual_[c][k] = fluid_[k] == 0 ? 0 : -product_[c][k];
      direction_[c][k] = 0;
    }
  const double first = dot(residual_, residual_);
  double before = 0;
  while (first > 0 && iteration.taken < iteration.most) {
    double slope = 0;
    for (std::size_t k = 0; k < all; ++k) {
      if (fluid_[k] == 0) continue;
      const auto z = precondition(k);
      slope += volume_[k] * (residual_[0][k] * z[0] + residual_[1][k] * z[1] + residual_[2][k] * z[2]);
    }
    const double again = before > 0 ? slope / before : 0;
    before = slope;
    for (std::size_t k = 0; k < all; ++k) {
      if (fluid_[k] == 0) continue;
      const auto z = precondition(k);
      for (std::size_t c = 0; c < 3; ++c) direction_[c][k] = z[c] + again * direction_[c][k];
    }
    inShares([&](WorkShare share) { drag(share, strength, direction_); });
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < all; ++k)
        if (fluid_[k] != 0) product_[c][k] += direction_[c][k];
    const double length = slope / dot(direction_, product_);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < all; ++k) {
        if (fluid_[k] == 0) continue;
        pushed_[c][k] += length * direction_[c][k];
        residual_[c][k] -= length * product_[c][k];
      }
    ++iteration.taken;
    iteration.error = std::sqrt(dot(residual_, residual_) / first);
    if (iteration.error <= iteration.tolerance) break;
  }
  if (all > n) inShares([&](WorkShare share) { dragBoundary(share, strength); });
  for (std::size_t k = 0; k < all; ++k)
    if (const auto i = std::size_t(order[k]); i < n)
      for (int c = 0; c < 3; ++c) velocities[i][c] = pushed_[std::size_t(c)][k];
}

SINEW_ONCE void DFSPHFlow::smooth(double part) {
  const WendlandKernel<double> kernels(radius, factor);
  auto const& order = particles_.order();
  for (std::size_t k = 0; k < order.size(); ++k)
    for (int c = 0; c < 3; ++c) velocity_[std::size_t(c)][k] = velocities[std::size_t(order[k])][c];
  inShares([&](WorkShare share) {
    particles_.forEach(share, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      if (fluid_[at] == 0) return;
      std::array<L, 3> v, sums{L(0), L(0), L(0)};
      for (std::size_t c = 0; c < 3; ++c) v[c] = L(velocity_[c][at]);
      each([&](Pairs const& p) {
        const L mean = select(
            p.acts, Particles::load(volume_, p) * Particles::load(fluid_, p) * kernels.density(p.q), L(0));
        for (std::size_t c = 0; c < 3; ++c) sums[c] += mean * (Particles::load(velocity_[c], p) - v[c]);
      });
      for (int c = 0; c < 3; ++c)
        velocities[std::size_t(order[at])][c] += part * Particles::sum(sums[std::size_t(c)]);
    });
  });
}

SINEW_ONCE void DFSPHFlow::solve(double h, bool ofDensity, Iteration& iteration,
                                 std::vector<double>& pressures) {
  const std::size_t n = fluidSize(), all = positions.size();
  pressures.resize(n, 0.0);
  impulses.resize(all - n, Eigen::Vector3d::Zero());
  auto const& order = particles_.order();
  for (std::size_t k = 0; k < all; ++k) {
    const auto i = std::size_t(order[k]);
    for (int c = 0; c < 3; ++c) velocity_[std::size_t(c)][k] = moved_[k].of[c] = velocities[i][c];
    pressure_[k] = i < n ? pressures[i] : 0;
  }
  for (iteration.taken = 0;; ++iteration.taken) {
    inShares([&](WorkShare share) { push(share, h); });
    inShares([&](WorkShare share) { correct(share, h, ofDensity); });
    double sum = 0;
    for (std::size_t k = 0; k < all; ++k) sum += error_[k];
    iteration.error = n == 0 ? 0 : sum / double(n);
    const bool good = iteration.taken >= iteration.least && iteration.error <= iteration.tolerance;
    if (good || iteration.taken >= iteration.most) break;
    pressure_.swap(next_);
  }
  if (all > n) inShares([&](WorkShare share) { pushBoundary(share, h); });
  for (std::size_t k = 0; k < all; ++k)
    if (const auto i = std::size_t(order[k]); i < n) {
      for (int c = 0; c < 3; ++c) velocities[i][c] = moved_[k].of[c];
      pressures[i] = pressure_[k];
    }
}

}  // namespace sinew
#endif
