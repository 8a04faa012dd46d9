// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/surface_pressure.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// The pressure of what a closed surface holds, by Tait's equation of state (Tait 1888): with V its volume
/// and V0 that at rest, and what has been injected,
///   p = p0 - B ((V/V0)^gamma - 1),   f = p dV/dx                                             [Pa], [N]
///   E = -(p0 + B) (V - V0) + B V0/(gamma + 1) ((V/V0)^(gamma + 1) - 1)                             [J]
///   df/dx = p d2V/dx2 + dp/dV (dV/dx)(dV/dx)',   dp/dV = -B gamma/V (V/V0)^gamma
/// The second part joins all points of the surface: an assembled matrix has a block for each pair of them.
/// Where the surface is turned inside out, V is taken as 0.
template <class D>
struct TaitSurfacePressureForceField {
  using Role = role::ForceField;
  static constexpr bool actsBeforeStep = true;
  using DataTypes = D;
  using Real = typename D::Real;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "TaitSurfacePressureForceField";

  double p0 = 0, B = 0, gamma = 0, injectedVolume = 0, maxInjectionRate = 1000;

  static constexpr auto fields() {
    using F = TaitSurfacePressureForceField;
    return field_list(
        field("p0", &F::p0, "Pa", "pressure at the volume at rest"),
        field("B", &F::B, "Pa", "how the pressure rises with compression", range::nonNegative),
        field("gamma", &F::gamma, "", "exponent of the volume; 0: the pressure is p0", range::nonNegative),
        field("injectedVolume", &F::injectedVolume, "m^3", "what is injected, or taken out if negative"),
        field(
            "maxInjectionRate", &F::maxInjectionRate, "m^3/s", "how fast that is done", range::nonNegative));
  }

  static constexpr ForceProperties properties() { return {}; }

  double currentInjectedVolume = 0;  // [m^3]

  static constexpr auto state() {
    return field_list(field("currentInjectedVolume",
                            &TaitSurfacePressureForceField::currentInjectedVolume,
                            "m^3",
                            "what has been injected"));
  }

  template <class State>
  bool beginStep(StepAhead const& step, State const&) {
    const double most = maxInjectionRate * step.dt;
    currentInjectedVolume += std::clamp(injectedVolume - currentInjectedVolume, -most, most);
    return false;
  }
  void reset() { currentInjectedVolume = 0; }

  // after init
  std::vector<Triangle> triangles{};
  std::vector<int> points{};  // of the surface
  double initialVolume = 0;   // [m^3]
  // at the last force
  double volume = 0, pressure = 0, slope = 0;  // [m^3], [Pa], dp/dV [Pa/m^3]
  VecDeriv gradient{};                         // dV/dx
  ElementDriver<TrianglePressure, D> faces{};

  /// Throws Error where the surface has a border, or no volume.
  void init(InitContext<D> const& context) {
    static_assert(!D::rigid && D::size == 3, "Sinew: TaitSurfacePressureForceField is for points in space");
    const std::string where = text(context.where, ": ", component_name<TaitSurfacePressureForceField>());
    TopologyView const& t = context.topology;
    if (t.triangles.empty() && t.quads.empty())
      throw Error(where, "the topology has neither triangle nor quad; give the node a closed surface");
    detail::check_indices(where, "triangle", t.triangles, context.rest.size());
    detail::check_indices(where, "quad", t.quads, context.rest.size());
    triangles.assign(t.triangles.begin(), t.triangles.end());
    for (Quad const& q : t.quads) {
      triangles.push_back({q[0], q[1], q[2]});
      triangles.push_back({q[2], q[3], q[0]});
    }
    if (!is_closed(triangles))
      throw Error(where, "the surface has a border, or its triangles do not turn the same way; close it");
    points.clear();
    for (Triangle const& e : triangles) points.insert(points.end(), e.begin(), e.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    gradient.assign(context.rest.size(), Deriv::Zero());
    initialVolume = volumeOf(context.rest);
    const double least = initialVolume + std::min({0.0, injectedVolume, currentInjectedVolume});
    if (!(initialVolume > 0) || !(least > 0))
      throw Error(where,
                  text("the surface holds ",
                       initialVolume,
                       " m^3 at rest and ",
                       least - initialVolume,
                       " m^3 are injected, but a volume above 0 has to be left; see that the triangles are "
                       "counter-clockwise from outside"));
    faces.init(triangles, std::vector<typename TrianglePressure<D>::Rest>(triangles.size(), {Real(0)}));
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    for (const int i : points) gradient[std::size_t(i)] = Deriv::Zero();
    for (Triangle const& t : triangles) {
      const Deriv third = (at(x, t[1]) - at(x, t[0])).cross(at(x, t[2]) - at(x, t[0])) / 6;
      for (const Index i : t) gradient[std::size_t(i)] += third;
    }
    volume = volumeOf(x);
    const double part = std::max(0.0, volume / restVolume());
    const bool acts = B > 0 && gamma > 0;
    pressure = p0 - (acts ? B * (std::pow(part, gamma) - 1) : 0);
    slope = acts && part > 0 ? -B * gamma / volume * std::pow(part, gamma) : 0;
    faces.addForce(law(), f, x, v);
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    faces.addDForce(law(), df, dx, Real(p.k), Real(p.b));
    double change = 0;
    for (const int i : points) change += double(gradient[std::size_t(i)].dot(dx[std::size_t(i)]));
    const Real factor = Real(p.k * slope * change);
    for (const int i : points) df[std::size_t(i)] += factor * gradient[std::size_t(i)];
  }
  double potentialEnergy(VecCoord const& x) const {
    const double rest = restVolume(), v = volumeOf(x), part = std::max(0.0, v / rest);
    if (!(B > 0 && gamma > 0)) return -p0 * (v - rest);
    return -(p0 + B) * (v - rest) + B * rest / (gamma + 1) * (std::pow(part, gamma + 1) - 1);
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) {
    faces.addToMatrix(law(), sink, Real(p.k), Real(p.b));
    for (const int i : points)
      for (const int j : points) {
        const Mat<Real, 3> block =
            Real(p.k * slope) * gradient[std::size_t(i)] * gradient[std::size_t(j)].transpose();
        sink.add(i, j, block);
      }
  }

 private:
  using Law = typename ElementDriver<TrianglePressure, D>::Law;

  Law law() const { return {typename Law::Real(Real(pressure))}; }
  double restVolume() const { return initialVolume + currentInjectedVolume; }
  static Deriv at(VecCoord const& x, Index i) { return x[std::size_t(i)]; }
  // from a point of the surface, so that little is lost where it is far from the origin
  double volumeOf(VecCoord const& x) const {
    const Deriv origin = at(x, triangles[0][0]);
    double sum = 0;
    for (Triangle const& t : triangles)
      sum += double(
          TrianglePressure<D>::volume(at(x, t[0]) - origin, at(x, t[1]) - origin, at(x, t[2]) - origin));
    return sum;
  }
};

}  // namespace sinew
