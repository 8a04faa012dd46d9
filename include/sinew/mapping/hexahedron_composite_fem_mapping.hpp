// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/cross_matrix.hpp>
#include <sinew/force/composite_cells.hpp>
#include <sinew/topology/element_checks.hpp>
#include <sinew/topology/point_location.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// Points inside the finer cells of a HexahedronCompositeFEMForceField, which move as these do: where a
/// hexahedron holds stiff and soft cells, the stiff ones keep their shape. A point follows the corners of its
/// finest cell, or of the nearest, along straight lines. Such a corner p follows each of the hexahedra that
/// it is in, and is at the mean of what these say: with y and p the places at rest in the frame of a
/// hexahedron, from its corner 0 on, R its rotation and W the weights of the corner,
///   x = x_0 + R (p + sum_k W_k u_k),  u_k = R'(x_k - x_0) - y_k
/// J has the derivative of R: with spin(dx) that of R,
///   dx = spin x (x - x_0) + sum_k R W_k R' (dx_k - spin x (x_k - x_0))
/// so that the body and its points turn as one. (SOFA's J has not.) Settings have to be those of the force;
/// scene files take from the force of the parent those that are not given.
template <class I, class O>
struct HexahedronCompositeFEMMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Real = typename Out::Real;
  static_assert(!In::rigid && !Out::rigid && In::size == 3 && Out::size == 3,
                "HexahedronCompositeFEMMapping joins points in space");
  static constexpr std::string_view className = "HexahedronCompositeFEMMapping";

  std::optional<int> nbVirtualFinerLevels{};
  double poissonRatio = 0.45;
  CellInterpolation interpolation = CellInterpolation::condensed;
  bool finestToCoarse = false;
  HexahedronMethod method = HexahedronMethod::large;
  bool completeInterpolation = false;

  static constexpr auto fields() {
    using M = HexahedronCompositeFEMMapping;
    return composite_cell_fields<M>(
        hexahedron_method_field<M>(),
        field("completeInterpolation",
              &M::completeInterpolation,
              "",
              "whether finer cells follow as in the whole of their equilibrium, where those of neighbours "
              "do not fit, and bulge; the stiffness is not that of it"));
  }

  /// What a hexahedron says of a point: x += share x_0 + R (place + sum_k weights_k u_k).
  struct Part {
    int hexahedron;
    double share;
    Eigen::Vector3d place;
    std::array<Eigen::Matrix3d, 8> weights;
    std::array<Mat<Real, 3>, 8> jacobian;  // by the corners, at the last apply
  };
  struct Element {
    Hexahedron points;
    std::array<Eigen::Vector3d, 8> corner;  // y
    HexahedronFrame frame;
  };
  std::vector<Element> elements{};
  std::vector<Part> parts{};                 // point by point
  std::vector<std::size_t> starts{0};        // where those of each point begin, and the end
  std::vector<char> used{};                  // of each hexahedron, whether it carries a point
  std::vector<Eigen::Matrix3d> rotations{};  // and how it is turned, at the last apply
  std::vector<std::array<Eigen::Matrix3d, 8>> spins{};

  void init(InitContext<In> const& parent, InitContext<Out> const& child, typename Out::VecCoord& positions) {
    const std::string where = text(child.where, ": ", component_name<HexahedronCompositeFEMMapping>());
    TopologyView const& topology = parent.topology;
    const CompositeCells cells(where, topology, cell_composition(*this));
    check_element_indices(text(where, ": ", parent.where), topology, parent.rest.size());
    const std::size_t count = topology.hexahedra.size();

    elements.clear();
    std::vector<Eigen::Vector3d> points;  // of the grid
    for (auto const& x : parent.rest) points.push_back(x.template cast<double>());
    for (auto const& h : topology.hexahedra) {
      Element e;
      e.points = h;
      Eigen::Vector3d x[8];
      for (std::size_t k = 0; k < 8; ++k) x[k] = points[std::size_t(h[k])];
      e.frame = cells.frame(elements.size(), x);
      for (std::size_t k = 0; k < 8; ++k) e.corner[k] = e.frame.rest.transpose() * (x[k] - x[0]);
      elements.push_back(e);
    }
    // children lie with the grid before the state is moved, as for BarycentricMapping
    if (topology.places.size() == points.size())
      points.assign(topology.places.begin(), topology.places.end());

    // the finest cells that count, and the hexahedron of each
    CellLevel const* const level = cells.finestLevel();
    const std::size_t finest = level ? level->hexahedra.size() : count;
    std::span<Hexahedron const> corners = topology.hexahedra;
    if (level) corners = level->hexahedra;
    std::vector<int> owner(finest);
    std::size_t places = parent.rest.size();
    for (std::size_t c = 0; c < finest; ++c) owner[c] = int(c);
    if (level) {
      places = 0;
      for (auto const& h : corners)
        for (const Index i : h) places = std::max(places, std::size_t(i) + 1);
      for (std::size_t c = 0; c < finest; ++c)
        for (std::size_t l = cells.levels(); l-- > 0;)
          owner[c] = topology.levels[l].parents[std::size_t(owner[c])];
    }
    std::vector<Eigen::Vector3d> lattice = level ? cellPlaces(topology, cells.levels(), points) : points;

    // the cell of each point, and its place there
    std::vector<int> cellOf(positions.size());
    std::vector<std::array<double, 8>> inCell(positions.size());
    std::vector<char> needed(places, 0), visited(count, 0);
    const auto find = locator(topology, cells.levels(), lattice, corners);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Eigen::Vector3d p = positions[i].template cast<double>();
      cellOf[i] = find(p);
      if (cellOf[i] < 0)
        throw Error(where, text("the cells of ", parent.where, " are all flat and carry no point"));
      auto const& cell = corners[std::size_t(cellOf[i])];
      const auto weights =
          level ? weightsInBox(lattice, cell, p) : MultilinearFit<3>(lattice, cell).fit(p).weights;
      for (std::size_t k = 0; k < 8; ++k) {
        inCell[i][k] = weights[Eigen::Index(k)];
        needed[std::size_t(cell[k])] = 1;
      }
    }

    // what each hexahedron says of the corners that are needed
    struct Said {
      int hexahedron;
      Eigen::Matrix<double, 3, 24> weights;
    };
    std::vector<std::vector<Said>> said(places);
    for (std::size_t c = 0; c < finest; ++c)
      for (const Index i : corners[c])
        if (needed[std::size_t(i)]) visited[std::size_t(owner[c])] = 1;
    for (std::size_t e = 0; e < count; ++e) {
      if (!visited[e]) continue;
      Eigen::Vector3d x[8];
      for (std::size_t k = 0; k < 8; ++k)
        x[k] = parent.rest[std::size_t(topology.hexahedra[e][k])].template cast<double>();
      for (auto const& f : cells.cell(e, x, true).finest)
        for (std::size_t k = 0; k < 8; ++k) {
          auto& list = said[std::size_t(corners[std::size_t(f.cell)][k])];
          if (needed[std::size_t(corners[std::size_t(f.cell)][k])] &&
              (list.empty() || list.back().hexahedron != int(e)))
            list.push_back({int(e), f.weights.template middleRows<3>(Eigen::Index(3 * k))});
        }
    }

    parts.clear();
    starts.assign(1, 0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      for (std::size_t k = 0; k < 8; ++k) {
        auto const point = std::size_t(corners[std::size_t(cellOf[i])][k]);
        const double share = inCell[i][k] / double(said[point].size());
        for (Said const& s : said[point]) add(s.hexahedron, share, s.weights, lattice[point], points);
      }
      starts.push_back(parts.size());
    }
    spins.resize(elements.size());
    rotations.assign(elements.size(), Eigen::Matrix3d::Identity());
    used.assign(elements.size(), 0);
    for (Part const& p : parts) used[std::size_t(p.hexahedron)] = 1;
  }

  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    Eigen::Vector3d x[8];
    auto take = [&](Element const& e) {
      for (std::size_t k = 0; k < 8; ++k) x[k] = in[std::size_t(e.points[k])].template cast<double>();
    };
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (!used[e]) continue;
      take(elements[e]);
      rotations[e] = elements[e].frame.rotation(x);
      spins[e] = elements[e].frame.spin(x);
    }
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t p = starts[i]; p < starts[i + 1]; ++p) {
        Part& part = parts[p];
        Element const& e = elements[std::size_t(part.hexahedron)];
        Eigen::Matrix3d const& r = rotations[std::size_t(part.hexahedron)];
        take(e);
        Eigen::Vector3d inFrame = part.place;
        Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();  // sum_k R W_k R' [x_k - x_0]
        std::array<Eigen::Matrix3d, 8> moving;
        for (std::size_t k = 0; k < 8; ++k) {
          const Eigen::Vector3d arm = x[k] - x[0];
          inFrame += part.weights[k] * (r.transpose() * arm - e.corner[k]);
          moving[k] = r * part.weights[k] * r.transpose();
          turning += moving[k] * cross_matrix(arm);
        }
        const Eigen::Vector3d arm = r * inFrame;
        turning -= cross_matrix(arm);
        sum += part.share * x[0] + arm;
        for (std::size_t k = 0; k < 8; ++k)
          part.jacobian[k] =
              (moving[k] + turning * spins[std::size_t(part.hexahedron)][k]).template cast<Real>();
      }
      out[i] = sum.template cast<Real>();
    }
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t i = 0; i + 1 < starts.size(); ++i) {
      out[i].setZero();
      forEachJacobianBlock(int(i), [&](int point, Mat<Real, 3> const& block) {
        out[i] += block * in[std::size_t(point)].template cast<Real>();
      });
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    using InReal = typename In::Real;
    for (std::size_t i = 0; i + 1 < starts.size(); ++i)
      forEachJacobianBlock(int(i), [&](int point, Mat<Real, 3> const& block) {
        in[std::size_t(point)] += (block.transpose() * out[i]).template cast<InReal>();
      });
  }
  template <class F>
  void forEachJacobianBlock(int point, F&& f) const {
    for (std::size_t p = starts[std::size_t(point)]; p < starts[std::size_t(point) + 1]; ++p)
      for (std::size_t k = 0; k < 8; ++k)
        f(elements[std::size_t(parts[p].hexahedron)].points[k], parts[p].jacobian[k]);
  }

 private:
  // what a hexahedron says of a corner, as a share of the point that was begun last
  void add(int hexahedron, double share, Eigen::Matrix<double, 3, 24> const& weights,
           Eigen::Vector3d const& corner, std::vector<Eigen::Vector3d> const& points) {
    auto same = [&](Part const& p) { return p.hexahedron == hexahedron; };
    auto part = std::find_if(parts.begin() + std::ptrdiff_t(starts.back()), parts.end(), same);
    if (part == parts.end()) {
      Part fresh{hexahedron, 0, Eigen::Vector3d::Zero(), {}, {}};
      for (auto& w : fresh.weights) w.setZero();
      for (auto& j : fresh.jacobian) j.setZero();
      part = parts.insert(parts.end(), fresh);
    }
    part->share += share;
    for (std::size_t k = 0; k < 8; ++k)
      part->weights[k] += share * weights.middleCols<3>(Eigen::Index(3 * k));
    // the place at rest, in the frame: trilinear, as the cells divide the hexahedron evenly
    Element const& e = elements[std::size_t(hexahedron)];
    const auto inside = MultilinearFit<3>(points, e.points).fit(corner).weights;
    for (std::size_t k = 0; k < 8; ++k) part->place += share * inside[Eigen::Index(k)] * e.corner[k];
  }

  // where the corners of the cells of a level lie, as places of the grid
  static std::vector<Eigen::Vector3d> cellPlaces(TopologyView const& topology, std::size_t levels,
                                                 std::vector<Eigen::Vector3d> const& points) {
    // of each cell its corner 0, and its edges
    struct Box {
      Eigen::Vector3d low;
      Eigen::Matrix3d edges;
    };
    std::vector<Box> boxes;
    for (auto const& h : topology.hexahedra) {
      auto at = [&](std::size_t k) { return points[std::size_t(h[k])]; };
      Box b{at(0), {}};
      b.edges << at(1) - at(0), at(3) - at(0), at(4) - at(0);
      boxes.push_back(b);
    }
    std::vector<Eigen::Vector3d> places;
    for (std::size_t l = 0; l < levels; ++l) {
      CellLevel const& level = topology.levels[l];
      std::vector<Box> next;
      for (std::size_t c = 0; c < level.hexahedra.size(); ++c) {
        Box b = boxes[std::size_t(level.parents[c])];
        b.edges /= 2;
        b.low += corner(b.edges, std::size_t(level.octants[c]));
        next.push_back(b);
        for (std::size_t k = 0; l + 1 == levels && k < 8; ++k) {
          const auto i = std::size_t(level.hexahedra[c][k]);
          if (i >= places.size()) places.resize(i + 1, Eigen::Vector3d::Zero());
          places[i] = b.low + corner(b.edges, k);
        }
      }
      boxes = std::move(next);
    }
    return places;
  }
  static Eigen::Vector3d corner(Eigen::Matrix3d const& edges, std::size_t k) {
    return edges * Eigen::Vector3d(hexahedronCorners[k][0], hexahedronCorners[k][1], hexahedronCorners[k][2]);
  }

  // of the corners of a box, at a place that may be outside
  static Eigen::Matrix<double, 8, 1> weightsInBox(std::vector<Eigen::Vector3d> const& lattice,
                                                  Hexahedron const& cell, Eigen::Vector3d const& p) {
    auto at = [&](std::size_t k) { return lattice[std::size_t(cell[k])]; };
    Eigen::Matrix3d edges;
    edges << at(1) - at(0), at(3) - at(0), at(4) - at(0);
    return MultilinearShape<3>(edges.inverse() * (p - at(0))).weights;
  }

  // finds the cell of a level around a place: where several lie at one place, by the finest of all
  static auto locator(TopologyView const& topology, std::size_t levels,
                      std::vector<Eigen::Vector3d> const& lattice, std::span<Hexahedron const> cells) {
    using Locator = ElementLocator<MultilinearFit<3>>;
    const bool several = levels > 0 && !topology.finer.hexahedra.empty();
    return [&topology,
            levels,
            several,
            locate = several ? Locator(topology.finer.positions, topology.finer.hexahedra)
                             : Locator(lattice, cells)](Eigen::Vector3d const& p) {
      int cell = locate.locate(p).element;
      for (std::size_t l = topology.levels.size(); several && cell >= 0 && l-- > levels;)
        cell = topology.levels[l].parents[std::size_t(cell)];
      return cell;
    };
  }
};

}  // namespace sinew
