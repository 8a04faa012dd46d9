// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/force/sph_driver.hpp>
#include <sinew/gpu/particle_cells.hpp>

#include <array>
#include <string_view>

namespace sinew {

namespace gpu::detail {

/// What loops of SphDriver read, in the order of the particles.
template <class D>
struct SphView {
  using Real = typename D::Real;
  typename ParticleCells<D>::View cells;
  FourOf<Real> const *states, *motions;  // x and p / rho^2, v and rho
  Real const* weights;                   // none: there is no boundary, and all are 1
  FourOf<Real> const* normals;           // none: the law has no use for them
  int fluid;                             // numbers below are of the fluid
  Real mass;

  SINEW_INLINE bool isFluid(int place) const { return !weights || cells.order[place] < fluid; }
  SINEW_INLINE Real weight(int place) const { return weights ? weights[place] : Real(1); }
  SINEW_INLINE Real volume(int place) const { return weight(place) * mass / motions[place].of[3]; }
};

/// What a neighbour has.
template <class D>
struct SphOther {
  using Real = typename D::Real;
  SphView<D> const& of;
  int place;

  SINEW_INLINE Real weight() const { return of.weight(place); }
  SINEW_INLINE Real fluid() const { return Real(of.isFluid(place)); }
  SINEW_INLINE Real normal(std::size_t axis) const { return of.normals[place].of[axis]; }
  SINEW_INLINE Real density() const { return of.motions[place].of[3]; }
  SINEW_INLINE Real pressure() const { return of.states[place].of[3]; }
  SINEW_INLINE Real volume() const { return of.volume(place); }
  SINEW_INLINE Real velocity(std::size_t axis) const { return of.motions[place].of[axis]; }
};

/// The weight of a boundary particle is rho_0 / (m sum_l W_kl).
template <class D, class Law>
struct SphBoundary {
  using Real = typename D::Real;
  SphView<D> view;
  Law law;
  Real* weights;
  SINEW_HD void operator()(int i) const {
    weights[i] = Real(1);
    if (view.isFluid(i)) return;
    Real around(0);
    view.cells.each(i, [&](auto const& p) {
      if (!view.isFluid(p.other)) around += law.kernels.density(p.q);
    });
    weights[i] = law.atRest / (law.mass * around);
  }
};

template <class D, class Law>
struct SphDensity {
  using Real = typename D::Real;
  SphView<D> view;
  Law law;
  FourOf<Real>*states, *motions;
  SINEW_HD void operator()(int i) const {
    const FourOf<Real> at = view.cells.places[i];
    Real rho = law.atRest, pressure(0);
    if (view.isFluid(i)) {
      Real around(0);
      view.cells.each(i, [&](auto const& p) { law.addDensity(p, SphOther<D>{view, p.other}, around); });
      rho = law.mass * around;
      pressure = law.pressureOf(rho);
    }
    states[i] = {{at.of[0], at.of[1], at.of[2], pressure}};
    motions[i].of[3] = rho;
  }
};

template <class D, class Law>
struct SphNormal {
  using Real = typename D::Real;
  SphView<D> view;
  Law law;
  FourOf<Real>* normals;
  SINEW_HD void operator()(int i) const {
    std::array<Real, 3> n{Real(0), Real(0), Real(0)};
    if (view.isFluid(i))
      view.cells.each(i, [&](auto const& p) { law.addNormal(p, SphOther<D>{view, p.other}, n); });
    for (Real& one : n) one *= law.surface.radius;
    normals[i] = {{n[0], n[1], n[2], Real(0)}};
  }
};

template <class D, class Law>
struct SphForce {
  using Real = typename D::Real;
  SphView<D> view;
  Law law;
  typename D::Deriv* forces;
  Eigen::Vector3d* onBoundary;
  SINEW_HD void operator()(int i) const {
    const int point = view.cells.order[i];
    const FourOf<Real> v = view.motions[i];
    SphParticle<Real> own{
        {v.of[0], v.of[1], v.of[2]}, view.weight(i), v.of[3], view.states[i].of[3], view.volume(i)};
    if (law.tense) {
      const FourOf<Real> n = view.normals[i];
      own.fluid = Real(view.isFluid(i));
      own.normal = {n.of[0], n.of[1], n.of[2]};
    }
    std::array<Real, 3> sums{Real(0), Real(0), Real(0)};
    const bool wall = !view.isFluid(i);  // walls do not act on walls
    view.cells.each(i, [&](auto const& p) {
      if (!wall || view.isFluid(p.other)) law.addForces(own, p, SphOther<D>{view, p.other}, sums);
    });
    if (wall) {
      for (int c = 0; c < 3; ++c) onBoundary[point - view.fluid][c] = double(sums[std::size_t(c)]);
      return;
    }
    if (law.curved) {
      std::array<Real, 3> n{Real(0), Real(0), Real(0)};
      Real curvature(0);
      view.cells.each(i, [&](auto const& p) {
        law.addCurvature(own.volume, p, SphOther<D>{view, p.other}, n, curvature);
      });
      const std::array<Real, 3> tension = law.curvatureForce(n, curvature);
      for (std::size_t c = 0; c < 3; ++c) sums[c] += tension[c];
    }
    for (int c = 0; c < 3; ++c) forces[point][c] += sums[std::size_t(c)];
  }
};

template <class D>
struct SphVelocity {
  using Real = typename D::Real;
  SphView<D> view;
  typename D::Deriv const* velocities;
  Eigen::Vector3d const* ofBoundary;
  FourOf<Real>* motions;
  SINEW_HD void operator()(int i) const {
    const int k = view.cells.order[i];
    Real v[3];
    for (int c = 0; c < 3; ++c)
      v[c] = k < view.fluid ? velocities[k][c] : Real(ofBoundary[k - view.fluid][c]);
    motions[i] = {{v[0], v[1], v[2], Real(0)}};
  }
};

template <class D, class Law>
struct SphEnergy {
  SphView<D> view;
  Law law;
  SINEW_HD double operator()(int i) const { return view.isFluid(i) ? law.energy(view.motions[i].of[3]) : 0; }
};

}  // namespace gpu::detail

/// An SphLaw over the particles of a device, one thread each; a thread goes through the cells around in their
/// order, so that bits repeat. Boundary particles and the forces on them cross in each step, as they are of
/// the host.
template <class H>
struct SphDriver<CudaTypes<H>> {
  using D = CudaTypes<H>;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr bool sharesWork = false;

  gpu::ParticleCells<D> cells{};
  gpu::WorkArray<FourOf<Real>> states{}, motions{}, normals{};
  gpu::WorkArray<Real> weights{};
  gpu::WorkArray<Eigen::Vector3d> boundary{};  // positions, velocities, forces
  std::size_t size = 0, bounds = 0;

  void reserve(std::size_t all) {
    cells.reserve(all);
    states.resize(all);
    motions.resize(all);
  }
  /// Throws Error as ParticleCells does.
  template <class Law>
  void sort(Law const& law, VecCoord const& x, BoundaryParticles const& from, double radius,
            std::string_view where) {
    size = x.size();
    bounds = from.size();
    reserve(size + bounds);
    mass = law.mass;
    if (bounds > 0) {
      if (gpu::recording())
        throw Error(where,
                    "boundary particles of bodies cross to the device in every step, which a recorded step "
                    "cannot; animate() the simulation");
      boundary.resize(3 * bounds);
      weights.resize(size + bounds);
      send(0, from.positions);
      send(1, from.velocities);
    }
    cells.sort(x.device(), size, boundary.data(), bounds, radius, where);
    if (bounds > 0)
      gpu::for_each_index(cells.size(), gpu::detail::SphBoundary<D, Law>{view(), law, weights.data()});
  }
  void takeVelocities(VecDeriv const& v, BoundaryParticles const&) {
    gpu::for_each_index(
        cells.size(),
        gpu::detail::SphVelocity<D>{view(), v.device(), boundary.data() + bounds, motions.data()});
  }
  template <class Law>
  void findDensities(Law const& law, WorkShare const&) {
    gpu::for_each_index(cells.size(),
                        gpu::detail::SphDensity<D, Law>{view(), law, states.data(), motions.data()});
  }
  template <class Law>
  void findNormals(Law const& law, WorkShare const&) {
    if (!law.tense) return;
    normals.resize(cells.size());
    gpu::for_each_index(cells.size(), gpu::detail::SphNormal<D, Law>{view(), law, normals.data()});
  }
  template <class Law>
  void addForces(Law const& law, WorkShare const&, VecDeriv& f, BoundaryParticles& to) {
    Eigen::Vector3d* const onBoundary = boundary.data() + 2 * bounds;
    gpu::for_each_index(cells.size(), gpu::detail::SphForce<D, Law>{view(), law, f.device(), onBoundary});
    if (bounds == 0) return;
    gpu::copy_to_host(to.forces.data(), onBoundary, bounds);
    gpu::transfers().toHost += bounds;
  }
  template <class Law>
  double energy(Law const& law) const {
    return gpu::sum_on_host(cells.size(), gpu::detail::SphEnergy<D, Law>{view(), law});
  }

 private:
  Real mass{1};

  gpu::detail::SphView<D> view() const {
    return {cells.view(),
            states.data(),
            motions.data(),
            bounds > 0 ? weights.data() : nullptr,
            normals.data(),
            int(size),
            mass};
  }
  void send(std::size_t part, std::vector<Eigen::Vector3d> const& from) {
    gpu::copy_to_device(boundary.data() + part * bounds, from.data(), bounds);
    gpu::transfers().toDevice += bounds;
  }
};

}  // namespace sinew
