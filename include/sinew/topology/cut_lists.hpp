// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/cut_parts.hpp>

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace sinew::detail {

/// The lists of elements of all topologies over the points of a body that is cut.
template <std::size_t N>
class CutLists {
 public:
  using Element = std::array<Index, N>;
  using Face = std::array<Index, N - 1>;

  CutLists(CutEdges<N> const& edges, CutParts<N> const& parts) : edges_(edges), parts_(parts) {
    touched_.assign(parts.copied.begin(), parts.copied.end());
    for (EdgeSplit const& s : edges.splits) touched_[std::size_t(s.a)] = touched_[std::size_t(s.b)] = 1;
    for (auto const& [part, without] : parts.bare)
      bare_.push_back(CutParts<N>::faceWithout(parts.parts[std::size_t(part)].now, without));
  }

  /// The elements that are cut: the first part of each in its place, the others behind them all.
  std::vector<Element> elements(std::vector<Origin>& come) const {
    std::vector<Element> list(edges_.elements.begin(), edges_.elements.end());
    for (std::size_t e = 0; e < edges_.elements.size(); ++e) {
      if (parts_.firstPart[e] < 0) continue;
      const auto first = std::size_t(parts_.firstPart[e]);
      list[e] = parts_.parts[first].now;
      for (std::size_t k = 1; k < std::size_t(parts_.partCount[e]); ++k) {
        list.push_back(parts_.parts[first + k].now);
        come.push_back({Index(e), Index(e), 0});
      }
    }
    return list;
  }
  /// Others over the same points: parts of them are with the element that they are of.
  template <std::size_t M>
  std::vector<std::array<Index, M>> follow(std::span<std::array<Index, M> const> before,
                                           std::vector<Origin>& come) const {
    std::vector<std::array<Index, M>> list(before.begin(), before.end()), pieces;
    for (std::size_t e = 0; e < before.size(); ++e) {
      if (std::none_of(
              before[e].begin(), before[e].end(), [this](Index i) { return touched_[std::size_t(i)]; }))
        continue;
      split_simplex<M>(before[e], edges_.splitsOf(before[e]), pieces);
      for (auto& piece : pieces) renumber(piece);
      list[e] = pieces[0];
      for (std::size_t k = 1; k < pieces.size(); ++k) {
        list.push_back(pieces[k]);
        come.push_back({Index(e), Index(e), 0});
      }
    }
    return list;
  }

  /// Whether faces are the whole border of the elements before: 1 outwards, -1 inwards, 0 they are not. By a
  /// fingerprint in which a face that two elements have cancels.
  int isBorder(std::span<Face const> faces) const {
    if (faces.empty()) return 0;
    std::uint64_t print = 0;
    for (Element const& e : edges_.elements)
      for (std::size_t k = 0; k < N; ++k) print ^= mark(CutParts<N>::faceWithout(e, k));
    for (Face const& f : faces) print ^= mark(f);
    if (print != 0) return 0;
    const Face key = sorted_corners(faces[0]);
    for (Element const& e : edges_.elements)
      for (std::size_t k = 0; k < N; ++k)
        if (const Face f = CutParts<N>::faceWithout(e, k); sorted_corners(f) == key) {
          const auto at = std::size_t(std::find(f.begin(), f.end(), faces[0][0]) - f.begin());
          return N == 3 ? (at == 0 ? 1 : -1) : f[(at + 1) % (N - 1)] == faces[0][1] ? 1 : -1;
        }
    return 0;
  }
  void addBare(int orientation, std::vector<Face>& faces) const {
    if (orientation == 0) return;
    for (Face f : bare_) {
      if (orientation < 0) std::reverse(f.begin(), f.end());
      faces.push_back(f);
    }
  }
  std::size_t facesApart() const { return bare_.size() / 2; }

  std::vector<Edge> splitEdges() const {
    std::vector<Edge> all;
    for (EdgeSplit const& s : edges_.splits) all.push_back({s.a, s.b});
    std::sort(all.begin(), all.end());
    return all;
  }
  /// Edges of elements, the lower point first before.
  std::vector<std::array<Edge, 2>> movedEdges() const {
    std::vector<std::array<Edge, 2>> all;
    for (auto const& part : parts_.parts)
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = 0; j < N; ++j) {
          const Edge before{part.points[i], part.points[j]}, now{part.now[i], part.now[j]};
          if (before[0] < before[1] && std::size_t(before[1]) < edges_.rest.size() &&
              (parts_.copied[std::size_t(before[0])] || parts_.copied[std::size_t(before[1])]))
            all.push_back({before, now});
        }
    std::sort(all.begin(), all.end());
    return all;
  }

  /// What the blade is not done with: crossings of edges that an element has through
  /// which it has not gone, or which is at the end of the cut.
  CutFront front() const {
    CutFront now{.faces = parts_.closed};
    for (std::size_t c = 0; c < edges_.crossings.size(); ++c) {
      if (edges_.isSplitEdge(c)) continue;
      Crossing const& edge = edges_.crossings[c];
      bool here = false;
      for (auto const& [same, p] : parts_.partsAt(edge.a)) {
        auto const& part = parts_.parts[std::size_t(p)];
        Index a = -1, b = -1;
        for (std::size_t k = 0; k < N; ++k) {
          if (part.points[k] == edge.a) a = part.now[k];
          if (part.points[k] == edge.b) b = part.now[k];
        }
        if (b < 0) continue;
        here = true;
        // a cut that has passed through a point goes on to do so
        for (auto const& [old, at] : {std::pair(edge.a, a), std::pair(edge.b, b)})
          if (edges_.on[std::size_t(old)] && !edges_.isWhole[std::size_t(part.parent)])
            now.points.push_back(at);
        if (edges_.isWhole[std::size_t(part.parent)] && !hasEnd(part.points)) continue;
        if (a < b)
          now.crossings.push_back({a, b, edge.weight, edge.side, edge.stroke});
        else
          now.crossings.push_back({b, a, 1 - edge.weight, -edge.side, edge.stroke});
      }
      if (!here) now.crossings.push_back(edge);
    }
    std::sort(now.crossings.begin(), now.crossings.end(), CutEdges<N>::before);
    now.crossings.erase(std::unique(now.crossings.begin(), now.crossings.end(), CutEdges<N>::sameEdge),
                        now.crossings.end());
    for (std::size_t i = 0; i < parts_.copied.size(); ++i)
      if (isEnd(i)) now.points.push_back(Index(i));
    std::vector<char> known(edges_.rest.size() + parts_.origins.size(), 0);
    for (auto const& part : parts_.parts) {
      if (!hasEnd(part.points)) continue;
      for (std::size_t k = 0; k < N; ++k) {
        if (parts_.inCut(part.points[k])) now.points.push_back(part.now[k]);
        if (std::size_t(part.points[k]) >= edges_.rest.size()) continue;
        auto const& side = edges_.side[std::size_t(part.points[k])];
        if (side.side == 0 || known[std::size_t(part.now[k])]) continue;
        known[std::size_t(part.now[k])] = 1;
        now.sides.push_back({part.now[k], side.side, side.stroke});
      }
    }
    for (auto const& side : edges_.side)
      if (side.side != 0 && parts_.partsAt(side.point).empty()) now.sides.push_back(side);
    std::sort(now.points.begin(), now.points.end());
    now.points.erase(std::unique(now.points.begin(), now.points.end()), now.points.end());
    return now;
  }

 private:
  CutEdges<N> const& edges_;
  CutParts<N> const& parts_;
  std::vector<char> touched_{};  // points at which elements change
  std::vector<Face> bare_{};

  // a point in which the cut ends: the elements around it hang together
  bool isEnd(std::size_t i) const {
    return !parts_.copied[i] && (i >= edges_.rest.size() || edges_.on[i] || edges_.inFront[i]);
  }
  bool hasEnd(Element const& e) const {
    return std::any_of(e.begin(), e.end(), [this](Index i) { return isEnd(std::size_t(i)); });
  }
  template <std::size_t M>
  void renumber(std::array<Index, M>& element) const {
    for (const Index i : element) {
      if (!parts_.copied[std::size_t(i)]) continue;
      for (auto const& [same, p] : parts_.partsAt(i)) {
        auto const& part = parts_.parts[std::size_t(p)];
        std::array<Index, M> now = element;
        bool all = true;
        for (Index& j : now) {
          const auto at = std::find(part.points.begin(), part.points.end(), j);
          all = all && at != part.points.end();
          if (all) j = part.now[std::size_t(at - part.points.begin())];
        }
        if (!all) continue;
        element = now;
        return;
      }
    }
  }
  // (the finalizer of SplitMix64, Steele, Lea, Flood 2014, point by point)
  static std::uint64_t mark(Face const& face) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (const Index i : sorted_corners(face)) {
      h += std::uint64_t(i) + 0x9e3779b97f4a7c15u;
      h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
      h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
      h ^= h >> 31;
    }
    return h;
  }
};

}  // namespace sinew::detail
