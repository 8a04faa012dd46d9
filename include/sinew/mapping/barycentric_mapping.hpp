// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/topology/point_location.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Each point of the child is carried by the tetrahedron of the parent that contains it at rest, or by the
/// nearest one: x = sum_k w_k x_k with the barycentric coordinates w. Affine motion of the parent is
/// reproduced exactly.
template <class I, class O>
struct BarycentricMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  using Weight = typename In::Real;
  static_assert(!In::rigid && !Out::rigid && In::size == 3 && Out::size == 3,
                "BarycentricMapping joins points in space");
  static constexpr std::string_view className = "BarycentricMapping";
  static constexpr bool needsParentTetrahedra = true;

  static constexpr auto fields() { return field_list(); }

  struct Carrier {
    Tetrahedron points;
    std::array<Weight, 4> weights;
  };
  std::vector<Carrier> carriers{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<BarycentricMapping>());
    auto const& tetrahedra = parent.topology.tetrahedra;
    if (tetrahedra.empty())
      throw Error(
          where,
          text("the topology of ", parent.where, " has no tetrahedra; give the parent a topology with some"));
    std::vector<Eigen::Vector3d> points;
    points.reserve(parent.rest.size());
    for (auto const& x : parent.rest) points.push_back(x.template cast<double>());
    const TetrahedronLocator locator(points, tetrahedra);
    carriers.clear();
    carriers.reserve(positions.size());
    for (auto const& x : positions) {
      const auto [element, w] = locator.locate(x.template cast<double>());
      carriers.push_back(
          {tetrahedra[std::size_t(element)], {Weight(w[0]), Weight(w[1]), Weight(w[2]), Weight(w[3])}});
    }
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const { interpolate(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { interpolate(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t i = 0; i < carriers.size(); ++i)
      for (std::size_t k = 0; k < 4; ++k)
        in[std::size_t(carriers[i].points[k])] += carriers[i].weights[k] * out[i].template cast<Weight>();
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    Carrier const& carrier = carriers[std::size_t(point)];
    for (std::size_t k = 0; k < 4; ++k)
      f(carrier.points[k], Mat<Real, 3>(Mat<Real, 3>::Identity() * Real(carrier.weights[k])));
  }

 private:
  void interpolate(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i < carriers.size(); ++i) {
      Carrier const& c = carriers[i];
      out[i] = (c.weights[0] * in[std::size_t(c.points[0])] + c.weights[1] * in[std::size_t(c.points[1])] +
                c.weights[2] * in[std::size_t(c.points[2])] + c.weights[3] * in[std::size_t(c.points[3])])
                   .template cast<Real>();
    }
  }
};

}  // namespace sinew
