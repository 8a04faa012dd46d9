// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/boundary_particles.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/core/lane_lists.hpp>
#include <sinew/core/work_share.hpp>
#include <sinew/force/sorted_particles.hpp>
#include <sinew/force/sph_law.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// Runs an SphLaw over the particles of a fluid and those of boundaries, in passes, each of which may be
/// shared among threads but the first: the order of all particles, densities, normals where the law has a use
/// for them, forces. Sums go over
/// neighbours in the order of their cells, so that bits repeat. A specialisation over the DataTypes of a
/// device is in sinew/gpu.
template <class D>
struct SphDriver {
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Particles = SortedParticles<Real, lane_width<D>()>;
  using Pairs = typename Particles::Pairs;
  using L = typename Particles::L;
  static constexpr bool sharesWork = true;

  std::size_t size = 0;  // of the fluid
  // in the order of the particles
  Particles particles{};                              // their weights: mass over that of the fluid's
  std::vector<FourOf<Real>> moving{};                 // velocity, p / rho^2
  std::vector<FourOf<Real>> normals{};                // n
  std::vector<Real> densities{}, volumes{}, fluid{};  // volumes: m / rho; 1 for the fluid, 0 for the boundary
  VecCoord joined{};                                  // the fluid, then the boundary

  /// Room for so many particles, with those of boundaries.
  void reserve(std::size_t all) {
    particles.reserve(all);
    joined.reserve(all);
    for (auto* one : {&moving, &normals}) one->reserve(all);
    for (auto* one : {&densities, &volumes, &fluid}) one->reserve(all);
  }

  /// Throws Error as PointCells does.
  template <class Law>
  void sort(Law const& law, VecCoord const& x, BoundaryParticles const& boundary, double radius,
            std::string_view where) {
    size = x.size();
    if (boundary.size() == 0) {
      particles.sort(x, radius, where);
    } else {
      joined.assign(x.begin(), x.end());
      for (auto const& p : boundary.positions) joined.push_back(p.template cast<Real>());
      particles.sort(joined, radius, where);
    }
    const std::size_t all = particles.order().size();
    moving.resize(all);
    normals.resize(law.tense ? all : 0, FourOf<Real>{});
    for (auto* one : {&densities, &volumes}) one->resize(all, Real(1));
    fluid.assign(all, Real(1));
    if (boundary.size() > 0) findBoundary(law);
  }
  void takeVelocities(VecDeriv const& v, BoundaryParticles const& boundary) {
    for (std::size_t k = 0; k < particles.order().size(); ++k) {
      const auto i = std::size_t(particles.order()[k]);
      for (int c = 0; c < 3; ++c)
        moving[k].of[c] = i < size ? v[i][c] : Real(boundary.velocities[i - size][c]);
    }
  }

  template <class Law>
  void findDensities(Law const& law, WorkShare const& share) {
    particles.forEach(share, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      if (fluid[at] == 0) return;
      L around(0);
      each([&](Pairs const& p) { law.addDensity(p, Weight{p}, around); });
      const Real rho = law.mass * Particles::sum(around);
      densities[at] = rho;
      moving[at].of[3] = law.pressureOf(rho);
      volumes[at] = law.mass / rho;
    });
  }

  template <class Law>
  void findNormals(Law const& law, WorkShare const& share) {
    if (!law.tense) return;
    particles.forEach(share, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      normals[at] = {};
      if (fluid[at] == 0) return;
      std::array<L, 3> sums{L(0), L(0), L(0)};
      each([&](Pairs const& p) { law.addNormal(p, Others(*this, p), sums); });
      for (std::size_t c = 0; c < 3; ++c) normals[at].of[c] = law.surface.radius * Particles::sum(sums[c]);
    });
  }

  template <class Law>
  void addForces(Law const& law, WorkShare const& share, VecDeriv& f, BoundaryParticles& boundary) {
    particles.forEach(share, [&](int i, auto const& each) {
      const auto at = std::size_t(i), point = std::size_t(particles.order()[at]);
      const bool wall = fluid[at] == 0;
      SphParticle<L> own{{}, L(particles.weight(at)), L(densities[at]), L(moving[at].of[3]), L(volumes[at])};
      for (std::size_t c = 0; c < 3; ++c) own.velocity[c] = L(moving[at].of[c]);
      if (law.tense) {
        own.fluid = L(fluid[at]);
        for (std::size_t c = 0; c < 3; ++c) own.normal[c] = L(normals[at].of[c]);
      }
      std::array<L, 3> sums{L(0), L(0), L(0)};
      each([&](Pairs const& p) {
        const Others other(*this, p);
        if (!wall) return law.addForces(own, p, other, sums);
        Pairs ofFluid = p;  // walls do not act on walls
        ofFluid.acts = both(p.acts, load(fluid, p) > L(0));
        law.addForces(own, ofFluid, other, sums);
      });
      if (wall) {
        for (std::size_t c = 0; c < 3; ++c)
          boundary.forces[point - size][Eigen::Index(c)] = double(Particles::sum(sums[c]));
        return;
      }
      std::array<Real, 3> tension{};
      if (law.curved) {
        std::array<L, 3> n{L(0), L(0), L(0)};
        L curvature(0);
        each([&](Pairs const& p) { law.addCurvature(own.volume, p, Others(*this, p), n, curvature); });
        tension = law.curvatureForce({Particles::sum(n[0]), Particles::sum(n[1]), Particles::sum(n[2])},
                                     Particles::sum(curvature));
      }
      for (std::size_t c = 0; c < 3; ++c) f[point][Eigen::Index(c)] += Particles::sum(sums[c]) + tension[c];
    });
  }

  /// Behind findDensities [J].
  template <class Law>
  double energy(Law const& law) const {
    double sum = 0;
    for (std::size_t k = 0; k < particles.order().size(); ++k)
      if (fluid[k] != 0) sum += law.energy(densities[k]);
    return sum;
  }

 private:
  static L load(std::vector<Real> const& from, Pairs const& p) { return Particles::load(from, p); }

  // what neighbours have
  struct Weight {
    Pairs const& pairs;
    L weight() const { return pairs.weight; }
  };
  struct Others : Weight {
    SphDriver const& of;
    L moving[4];  // fetched at once

    Others(SphDriver const& driver, Pairs const& p) : Weight{p}, of(driver) {
      load_at(of.moving.data(), p.places, moving);
    }
    L fluid() const { return load(of.fluid, this->pairs); }
    L normal(std::size_t axis) const {
      L all[4];
      load_at(of.normals.data(), this->pairs.places, all);
      return all[axis];
    }
    L density() const { return load(of.densities, this->pairs); }
    L volume() const { return load(of.volumes, this->pairs); }
    L pressure() const { return moving[3]; }
    L velocity(std::size_t axis) const { return moving[axis]; }
  };

  // volumes of the boundary, V_k = 1 / sum_l W_kl, at the density at rest and without pressure
  template <class Law>
  void findBoundary(Law const& law) {
    for (std::size_t k = 0; k < particles.order().size(); ++k)
      if (std::size_t(particles.order()[k]) >= size) fluid[k] = 0;
    particles.forEach({}, [&](int i, auto const& each) {
      const auto at = std::size_t(i);
      if (fluid[at] != 0) return;
      L around(0);
      each([&](Pairs const& p) {
        around += select(p.acts, (L(1) - load(fluid, p)) * law.kernels.density(p.q), L(0));
      });
      volumes[at] = 1 / Particles::sum(around);
      particles.weight(at) = law.atRest / law.mass * volumes[at];
      densities[at] = law.atRest;
      moving[at].of[3] = 0;
    });
  }
};

}  // namespace sinew
