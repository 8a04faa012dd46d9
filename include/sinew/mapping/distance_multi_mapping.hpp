// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>
#include <sinew/mapping/child_points.hpp>
#include <sinew/mapping/index_pairs.hpp>
#include <sinew/mapping/stretch.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Each point of the child is by how much a distance between points of several parents is longer than at
/// rest:
///   c = l - L,  l = |d|,  d = x1 - x0       J = (-u', u'),  u = d/l
///   K_g = f/l (I - u u') (1 -1; -1 1)       with f the force on c
/// `indexPairs` chooses points: entry i is point indexPairs[i][1] of parent indexPairs[i][0], or the centre
/// of that rigid body. The edges of the topology in the node of the mapping are over these entries, and each
/// is a distance. Two points in one place have no direction: J and K_g are zero there. `stabilized` has no
/// K_g for distances that push (f > 0), where it is not negative. The parents stand before the node of the
/// mapping in the tree; they are named by paths from it (`P` = Parents<"../a", "../b/c">), or at run time
/// (`P` = LinkedParents).
template <class I, class O, class P = LinkedParents>
struct DistanceMultiMapping {
  using Role = role::Mapping;
  using In = I;
  using Out = O;
  using Parents = P;
  template <class Other>
  using WithParents = DistanceMultiMapping<I, O, Other>;
  using Real = typename In::Real;
  static constexpr int N = In::spatial;
  static_assert(!Out::rigid && Out::size == 1, "DistanceMultiMapping maps to Vec1");
  static constexpr std::string_view className = "DistanceMultiMapping";
  static constexpr bool overEntries = true;

  std::vector<std::array<int, 2>> indexPairs{};
  bool computeDistance = false;
  std::vector<double> restLengths{};
  GeometricStiffness geometricStiffness = GeometricStiffness::stabilized;
  [[no_unique_address]] P parents{};

  static constexpr auto fields() {
    using M = DistanceMultiMapping;
    return field_list(
        field("indexPairs",
              &M::indexPairs,
              "",
              "points between which edges are: the parent of each, from 0, and its point of that",
              range::nonNegative),
        field("computeDistance", &M::computeDistance, "", "lengths at rest are 0 where none are given"),
        field("restLengths",
              &M::restLengths,
              "m",
              "length of each edge at rest; where none is given, that of the rest positions",
              range::nonNegative),
        field("geometricStiffness",
              &M::geometricStiffness,
              "",
              "geometric stiffness: what rotating edges add to the stiffness"));
  }

  struct Link {
    std::array<std::size_t, 2> ends;  // entries of indexPairs
    Stretch<Real, N> stretch;
  };
  std::vector<Link> links{};
  typename In::template Array<Vec<Real, N>> places{}, motions{};  // of each entry: x, and dx

  /// What concerns one of the parents, of a mapping `M`, which may be constant.
  template <class M>
  struct PointsOfParent {
    using In = typename M::In;
    using Out = typename M::Out;
    M& of;
    std::size_t parent;

    void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) const {
      forEachPoint([&](std::size_t i, std::size_t point) { of.places[i] = In::center(in[point]); });
      for (std::size_t e = 0; isLast() && e < out.size(); ++e) out[e][0] = of.measure(of.links[e]);
    }
    void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
      forEachLink([&](std::size_t e, int sign, std::size_t point, bool first) {
        const auto rate =
            typename Out::Real(Real(sign) * of.links[e].stretch.direction.dot(linear(in[point])));
        out[e][0] = (first ? 0 : out[e][0]) + rate;
      });
    }
    void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
      forEachLink([&](std::size_t e, int sign, std::size_t point, bool) {
        in[point].template head<N>() += of.links[e].stretch.direction * (Real(sign) * Real(out[e][0]));
      });
    }
    template <class F>
    void forEachJacobianBlock(int point, F&& f) const {
      Link const& link = of.links[std::size_t(point)];
      for (const int side : {0, 1})
        if (isMine(link.ends[std::size_t(side)])) {
          Mat<typename Out::Real, 1, In::size> j = Mat<typename Out::Real, 1, In::size>::Zero();
          j.template head<N>() = (Real(side == 0 ? -1 : 1) * link.stretch.direction.transpose())
                                     .template cast<typename Out::Real>();
          f(of.indexPairs[link.ends[std::size_t(side)]][1], j);
        }
    }
    void updateK(typename Out::VecDeriv const& f) const {
      if (!isLast()) return;
      for (std::size_t e = 0; e < of.links.size(); ++e)
        of.links[e].stretch.updateK(Real(f[e][0]), of.geometricStiffness);
    }
    void gather(typename In::VecDeriv const& dx) const {
      if (of.geometricStiffness == GeometricStiffness::none) return;
      forEachPoint([&](std::size_t i, std::size_t point) { of.motions[i] = linear(dx[point]); });
    }
    void addKx(typename In::VecDeriv& df, typename In::VecDeriv const&, double k) const {
      if (of.geometricStiffness == GeometricStiffness::none) return;
      forEachLink([&](std::size_t e, int sign, std::size_t point, bool) {
        Link const& link = of.links[e];
        const Vec<Real, N> d = of.motions[link.ends[1]] - of.motions[link.ends[0]];
        df[point].template head<N>() += link.stretch.pull(d, Real(sign) * Real(k));
      });
    }
    /// All stay, or `follow` says that they do not.
    std::vector<bool> pointsThatStay(Renumbering const&) const {
      return std::vector<bool>(of.links.size(), true);
    }

   private:
    bool isMine(std::size_t entry) const { return std::size_t(of.indexPairs[entry][0]) == parent; }
    bool isLast() const { return parent + 1 == of.parentCount; }
    static auto linear(typename In::Deriv const& v) { return v.template head<N>(); }
    // f(entry, point) for those of this parent
    template <class F>
    void forEachPoint(F&& f) const {
      for (std::size_t i = 0; i < of.indexPairs.size(); ++i)
        if (isMine(i)) f(i, std::size_t(of.indexPairs[i][1]));
    }
    // f(edge, -1 or 1, point, whether nothing has come to the edge yet) for ends of edges of this parent
    template <class F>
    void forEachLink(F&& f) const {
      for (std::size_t e = 0; e < of.links.size(); ++e) {
        auto const& ends = of.links[e].ends;
        const bool mine[] = {isMine(ends[0]), isMine(ends[1])};
        const bool firstOther[] = {of.indexPairs[ends[0]][0] < int(parent),
                                   of.indexPairs[ends[1]][0] < int(parent)};
        if (mine[0]) f(e, -1, std::size_t(of.indexPairs[ends[0]][1]), !firstOther[1]);
        if (mine[1]) f(e, 1, std::size_t(of.indexPairs[ends[1]][1]), !mine[0] && !firstOther[0]);
      }
    }
  };
  std::size_t parentCount = 0;
  std::string where{};  // for errors
  PointsOfParent<DistanceMultiMapping> part(std::size_t parent) { return {*this, parent}; }
  PointsOfParent<DistanceMultiMapping const> part(std::size_t parent) const { return {*this, parent}; }

  void init(std::vector<InitContext<In>> const& above, InitContext<Out> const& child,
            typename Out::VecCoord& positions) {
    where = text(child.where, ": ", component_name<DistanceMultiMapping>());
    parentCount = above.size();
    check_index_pairs(where, indexPairs, above);
    auto const& edges = child.topology.edges;
    if (edges.empty())
      throw Error(
          where,
          "there are no edges between the points of indexPairs; add a topology with edges to its node");
    check_rest_lengths(where, *this, edges.size());
    auto restOf = [&](std::size_t entry) -> Vec<Real, N> {
      const auto [parent, point] = indexPairs[entry];
      return In::center(above[std::size_t(parent)].rest[std::size_t(point)]);
    };
    links.clear();
    for (std::size_t e = 0; e < edges.size(); ++e) {
      for (const Index i : edges[e])
        if (i < 0 || std::size_t(i) >= indexPairs.size())
          throw Error(where,
                      text("edge ",
                           e,
                           " has point ",
                           i,
                           ", but indexPairs has ",
                           indexPairs.size(),
                           " entries, numbered from 0; give an entry for each end of an edge"));
      const std::array<std::size_t, 2> ends{std::size_t(edges[e][0]), std::size_t(edges[e][1])};
      links.push_back({ends, {rest_length(*this, e, (restOf(ends[1]) - restOf(ends[0])).norm())}});
    }
    places.assign(indexPairs.size(), Vec<Real, N>::Zero());
    motions.assign(indexPairs.size(), Vec<Real, N>::Zero());
    place_child(positions, links.size(), where, "edges");
  }

  template <class Sink>
  void addToMatrix(MechanicalParams const& p, std::size_t a, std::size_t b, Sink const& sink) const {
    if (geometricStiffness == GeometricStiffness::none) return;
    for (Link const& link : links) {
      Mat<Real, In::size> block = Mat<Real, In::size>::Zero();
      block.template topLeftCorner<N, N>() = link.stretch.stiffness(Real(p.k));
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
          auto const &row = indexPairs[link.ends[i]], &column = indexPairs[link.ends[j]];
          if (std::size_t(row[0]) == a && std::size_t(column[0]) == b)
            sink.template add<0, 1>(row[1], column[1], i == j ? block : Mat<Real, In::size>(-block));
        }
    }
  }

  /// Points go with those of the parents. Throws Error where one goes that an edge has.
  void follow(Renumbering const&, std::vector<Renumbering const*> const& above) {
    for (std::size_t i = 0; i < indexPairs.size(); ++i) {
      auto& [parent, point] = indexPairs[i];
      if (!above[std::size_t(parent)]->stays(point))
        throw Error(where,
                    text("point ",
                         point,
                         " of its parent ",
                         parent,
                         " is to go, and indexPairs[",
                         i,
                         "] names it; measure from one that stays"));
      above[std::size_t(parent)]->renumber(point);
    }
  }

  typename Out::Real measure(Link& link) const {
    return typename Out::Real(link.stretch.of(places[link.ends[1]] - places[link.ends[0]]));
  }
};

}  // namespace sinew
