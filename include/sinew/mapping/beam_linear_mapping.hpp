// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/mapping/beam_carriers.hpp>
#include <sinew/topology/beam_section.hpp>
#include <sinew/topology/point_location.hpp>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace sinew {

/// Points carried by beams between frames: the edges of the parent's topology, or where it has none, frames
/// that follow one another. Each point belongs to the beam nearest to it at rest, at a place t of its length
/// L, 0 to 1. With c_k, T_k the centres of the two frames and the axes of the beam that rotate with them,
///   x = (1 - f) c_0 + f c_1 + L ((t - 2t^2 + t^3) T_0 e_x + (t^3 - t^2) T_1 e_x) + R s,   f = 3t^2 - 2t^3
/// The middle line is Hermite's cubic, as bent beams have it; the section, with s in it, rotates by R, the
/// mean of T_0 and T_1 as quaternions with weights 1 - t and t. (In SOFA points are the mean of those that
/// the two frames would carry, with weights 1 - f and f: halfway its line bends out twice as far.)
template <class I, class O>
struct BeamLinearMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  using Vec3 = Vec<Real, 3>;
  static_assert(In::rigid && In::spatial == 3 && !Out::rigid && Out::size == 3,
                "BeamLinearMapping carries points by frames in space");
  static constexpr std::string_view className = "BeamLinearMapping";

  bool localCoord = true;

  static constexpr auto fields() {
    return field_list(
        field("localCoord",
              &BeamLinearMapping::localCoord,
              "",
              "the positions of the child are given in the beams: x is the number of the beam plus "
              "the part of its length, y and z are across, in lengths of the beam"));
  }

  /// Throws Error where positions count beams: those of the others would have to change.
  void follow(Followed const&) const {
    if (localCoord)
      throw Error(component_name<BeamLinearMapping>(),
                  "with localCoord positions count the beams, and none of these can be removed; give the "
                  "positions in the world");
  }

  using Carriers = BeamCarriers<In, Out>;
  Carriers carried{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<BeamLinearMapping>());
    detail::check_indices(where, "edge", parent.topology.edges, parent.rest.size());
    std::vector<Edge> beams(parent.topology.edges.begin(), parent.topology.edges.end());
    if (beams.empty())
      for (int i = 0; i + 1 < int(parent.rest.size()); ++i) beams.push_back({i, i + 1});
    if (beams.empty())
      throw Error(where,
                  text(parent.where, " has no beam; give it two frames or more, or a topology with edges"));
    std::vector<Eigen::Vector3d> centers;
    for (auto const& x : parent.rest) centers.push_back(x.center.template cast<double>());
    const ElementLocator<MultilinearFit<1>> locator(centers, beams);

    carried.carriers.clear();
    for (auto const& position : positions) {
      Eigen::Vector3d p = position.template cast<double>();
      int beam = int(std::clamp(std::floor(p[0]), 0.0, double(beams.size() - 1)));
      double along = p[0] - beam;
      if (!localCoord) {
        const auto located = locator.locate(p);
        if (located.element < 0)
          throw Error(where, text("the beams of ", parent.where, " have no length; move its frames apart"));
        beam = located.element;
        along = located.fit.weights[1];
      }
      carried.carriers.push_back(
          carrierAt(parent.rest, beams[std::size_t(beam)], std::clamp(along, 0.0, 1.0)));
      typename Carriers::Carrier& c = carried.carriers.back();
      if (localCoord)
        c.offset = c.length * Vec3(Real(along) - c.place, Real(p[1]), Real(p[2]));
      else
        c.offset = typename Carriers::Section(c, parent.rest).placeOf(p.template cast<Real>());
    }
    carried.prepare();
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) { carried.apply(out, in); }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const { carried.applyJ(out, in); }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    carried.applyJT(in, out);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    carried.forEachJacobianBlock(point, std::forward<F>(f));
  }

 private:
  static typename Carriers::Carrier carrierAt(typename In::VecCoord const& rest, Edge const& beam,
                                              double along) {
    auto const &x0 = rest[std::size_t(beam[0])], &x1 = rest[std::size_t(beam[1])];
    const Eigen::Vector3d chord = (x1.center - x0.center).template cast<double>();
    const Eigen::Quaterniond node[2]{x0.orientation.template cast<double>(),
                                     x1.orientation.template cast<double>()};
    const Eigen::Quaterniond axes = beam_axes(chord, node[0], node[1]);
    return {.frames = beam,
            .place = Real(along),
            .length = Real(chord.norm()),
            .toBeam = {Quat<Real>((node[0].conjugate() * axes).template cast<Real>()),
                       Quat<Real>((node[1].conjugate() * axes).template cast<Real>())},
            .offset = Vec3::Zero()};
  }
};

}  // namespace sinew
