// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/mapping/geometric_stiffness.hpp>

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace sinew {

/// Each point of the child is the volume of a tetrahedron of the parent, negative where it is inside out:
///   V = e1 . (e2 x e3) / 6,  ek = xk - x0       dV/dxk = ak  with  6 a1 = e2 x e3, ..., a0 = -a1 - a2 - a3
///   K_g = f d2V/dx2                              with f the force on V
/// where 6 d2V/dx1 dx2 v = -e3 x v and so on cyclically, and blocks on the diagonal are zero. The tetrahedra
/// are those of the topology in the node of the mapping, or else of the parent's. `stabilized` has K_g, as
/// SOFA, for tetrahedra that are pulled together (f < 0) only; d2V/dx2 has both signs anyway.
template <class I, class O>
struct VolumeMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename In::Real;
  static_assert(!In::rigid && In::size == 3 && !Out::rigid && Out::size == 1,
                "VolumeMapping maps Vec3 to Vec1");
  static constexpr std::string_view className = "VolumeMapping";
  static constexpr bool overParent = true;

  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;

  static constexpr auto fields() {
    return field_list(field("geometricStiffness",
                            &VolumeMapping::geometricStiffness,
                            "",
                            "geometric stiffness: what rotating faces add to the stiffness"));
  }

  struct Cell {
    Tetrahedron points;
    std::array<Vec<Real, 3>, 4> area;  // dV/dxk
    std::array<Vec<Real, 3>, 4> edge;  // xk - x0
    Real force;                        // at the last updateK
  };
  std::vector<Cell> cells{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<VolumeMapping>());
    auto const& tetrahedra =
        child.topology.tetrahedra.empty() ? parent.topology.tetrahedra : child.topology.tetrahedra;
    if (tetrahedra.empty())
      throw Error(
          where,
          "there are no tetrahedra, neither in its node nor in its parent's; add a topology with some");
    detail::check_indices(where, "tetrahedron", tetrahedra, parent.rest.size());
    cells.assign(tetrahedra.size(), {});
    for (std::size_t e = 0; e < cells.size(); ++e) {
      cells[e].points = tetrahedra[e];
      cells[e].force = 0;
    }
    if (positions.empty()) positions.resize(cells.size());
    if (positions.size() != cells.size())
      throw Error(where,
                  text("the child has ",
                       positions.size(),
                       " points for ",
                       cells.size(),
                       " tetrahedra; give the child as many, or none"));
  }

  std::vector<bool> pointsThatStay(TopologyView const&, TopologyChange const& change) const {
    return change.of(ElementKind::tetrahedron).stays();
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (std::size_t e = 0; e < cells.size(); ++e) {
      Cell& c = cells[e];
      for (std::size_t k = 0; k < 4; ++k)
        c.edge[k] = in[std::size_t(c.points[k])] - in[std::size_t(c.points[0])];
      c.area[1] = c.edge[2].cross(c.edge[3]) / 6;
      c.area[2] = c.edge[3].cross(c.edge[1]) / 6;
      c.area[3] = c.edge[1].cross(c.edge[2]) / 6;
      c.area[0] = -c.area[1] - c.area[2] - c.area[3];
      out[e][0] = typename Out::Real(c.edge[1].dot(c.area[1]));
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t e = 0; e < cells.size(); ++e) {
      Real rate = 0;
      for (std::size_t k = 0; k < 4; ++k) rate += cells[e].area[k].dot(in[std::size_t(cells[e].points[k])]);
      out[e][0] = typename Out::Real(rate);
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    for (std::size_t e = 0; e < cells.size(); ++e)
      for (std::size_t k = 0; k < 4; ++k)
        in[std::size_t(cells[e].points[k])] += cells[e].area[k] * Real(out[e][0]);
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    Cell const& c = cells[std::size_t(point)];
    using J = Mat<typename Out::Real, 1, 3>;
    for (std::size_t k = 0; k < 4; ++k)
      f(c.points[k], J(c.area[k].transpose().template cast<typename Out::Real>()));
  }

  void updateK(typename Out::VecDeriv const& f) {
    for (std::size_t e = 0; e < cells.size(); ++e) {
      const Real force = Real(f[e][0]);
      const bool counts = geometricStiffness == GeometricStiffness::exact ||
                          (geometricStiffness == GeometricStiffness::stabilized && force < 0);
      cells[e].force = counts ? force : Real(0);
    }
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double k) const {
    if (geometricStiffness == GeometricStiffness::none) return;
    for (Cell const& c : cells) {
      // how the areas change
      const auto edgeChange = [&](std::size_t i) -> Vec<Real, 3> {
        return dx[std::size_t(c.points[i])] - dx[std::size_t(c.points[0])];
      };
      const Vec<Real, 3> d1 = edgeChange(1), d2 = edgeChange(2), d3 = edgeChange(3);
      const Real factor = Real(k) * c.force / 6;
      const Vec<Real, 3> f1 = factor * (d2.cross(c.edge[3]) + c.edge[2].cross(d3)),
                         f2 = factor * (d3.cross(c.edge[1]) + c.edge[3].cross(d1)),
                         f3 = factor * (d1.cross(c.edge[2]) + c.edge[1].cross(d2));
      df[std::size_t(c.points[0])] -= f1 + f2 + f3;
      df[std::size_t(c.points[1])] += f1;
      df[std::size_t(c.points[2])] += f2;
      df[std::size_t(c.points[3])] += f3;
    }
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    if (geometricStiffness == GeometricStiffness::none) return;
    // the edge that, made into a matrix [e]x / 6, is block (i, j): from the one to the other of the two
    // points that are left, in the order that makes (i, j, from, to) an odd permutation
    static constexpr int left[6][4] = {
        {0, 1, 3, 2}, {0, 2, 1, 3}, {0, 3, 2, 1}, {1, 2, 3, 0}, {1, 3, 0, 2}, {2, 3, 1, 0}};
    for (Cell const& c : cells)
      for (auto const& [i, j, from, to] : left) {
        const Vec<Real, 3> e =
            (Real(p.k) * c.force / 6) * (c.edge[std::size_t(to)] - c.edge[std::size_t(from)]);
        Mat<Real, 3> block;
        block << 0, -e[2], e[1], e[2], 0, -e[0], -e[1], e[0], 0;
        const int a = c.points[std::size_t(i)], b = c.points[std::size_t(j)];
        sink.add(a, b, block);
        sink.add(b, a, block.transpose().eval());
      }
  }
};

}  // namespace sinew
