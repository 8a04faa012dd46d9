// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/topology/border.hpp>
#include <sinew/topology/cut_edges.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace sinew::detail {

/// The parts of all elements at points of a cut, the faces between them that part, and the points that are
/// there more than once then: step 4 of plan_cut.
template <std::size_t N>
class CutParts {
 public:
  using Element = std::array<Index, N>;
  using Face = std::array<Index, N - 1>;

  /// `before` are faces that earlier cuts have left closed.
  CutParts(CutEdges<N> const& edges, std::span<Triangle const> before)
      : edges_(edges), origins(edges.origins) {
    near_ = edges.on;
    std::vector<Face> pieces;
    for (Triangle const& f : before) {
      Face face;
      std::copy_n(f.begin(), N - 1, face.begin());
      for (const Index i : face) near_[std::size_t(i)] = 1;
      split_simplex<N - 1>(face, edges.splitsOf(face), pieces);
      for (Face const& piece : pieces) closed_.push_back(sorted_corners(piece));
    }
    std::sort(closed_.begin(), closed_.end());
    findParts();
    joinParts();
    separate();
    leaveClosed();
  }

  struct Part {
    Element points;  // before points part
    Element now;
    Index parent;
    int side;                       // of the cut; 0 where it is not known
    std::array<Index, N> neighbor;  // that hangs on by the face without a point; -1: none
  };
  struct BareFace {
    Index part;
    std::size_t without;  // the point that it does not have
  };

 private:
  CutEdges<N> const& edges_;

 public:
  std::vector<Origin> origins;  // of all points that come
  std::vector<Part> parts{};
  std::vector<Index> firstPart{}, partCount{};  // of each element; -1: it is not at the cut
  std::vector<BareFace> bare{};                 // two by two
  std::vector<Triangle> closed{};  // faces that part, but whose points are all the same on both sides
  std::vector<char> copied{};      // points that are there more than once now
  std::vector<char> inSheet{};     // points of faces that part

  bool isOld(Index point) const { return std::size_t(point) < edges_.rest.size(); }
  /// Whether the cut passes through a point.
  bool inCut(Index point) const { return !isOld(point) || edges_.on[std::size_t(point)]; }
  /// Of the parts at a point, before points part, the numbers.
  std::span<std::pair<Index, Index> const> partsAt(Index point) const {
    const auto range = std::equal_range(partsAt_.begin(),
                                        partsAt_.end(),
                                        std::pair<Index, Index>(point, 0),
                                        [](auto const& p, auto const& q) { return p.first < q.first; });
    return std::span(partsAt_).subspan(std::size_t(range.first - partsAt_.begin()),
                                       std::size_t(range.second - range.first));
  }
  /// A face of an element, outwards where that is positively oriented.
  static Face faceWithout(Element const& e, std::size_t k) {
    Face f;
    if constexpr (N == 4) {
      constexpr std::size_t corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
      for (std::size_t c = 0; c < 3; ++c) f[c] = e[corners[k][c]];
    } else {
      f = {e[(k + 1) % 3], e[(k + 2) % 3]};
    }
    return f;
  }

 private:
  std::vector<std::pair<Index, Index>> partsAt_{};  // point, part
  std::vector<Face> closed_{};
  std::vector<char> near_{};  // points all of whose elements are needed

  void findParts() {
    auto const& elements = edges_.elements;
    std::vector<Element> pieces;
    firstPart.assign(elements.size(), -1);
    partCount.assign(elements.size(), 0);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      bool near = edges_.isSplit[e];
      for (const Index i : elements[e]) near = near || near_[std::size_t(i)];
      if (!near) continue;
      split_simplex<N>(elements[e], edges_.splitsOf(elements[e]), pieces);
      firstPart[e] = Index(parts.size());
      partCount[e] = Index(pieces.size());
      std::array<Index, N> none;
      none.fill(-1);
      for (Element const& piece : pieces) parts.push_back({piece, piece, Index(e), sideOf(e, piece), none});
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (const Index i : parts[p].points) partsAt_.emplace_back(i, Index(p));
    std::sort(partsAt_.begin(), partsAt_.end());
  }
  // That of a point beside the cut; else that on which all those points of the cut were which the blade has
  // not parted from such a point; else that of the larger part, about.
  int sideOf(std::size_t e, Element const& part) const {
    int low = 0, high = 0;
    bool beside = false;
    for (const Index i : part) {
      if (inCut(i)) continue;
      beside = true;
      if (const int side = edges_.side[std::size_t(i)].side; side != 0) return side;
      for (const Index j : part)
        if (isOld(j) && edges_.on[std::size_t(j)] && edges_.crossingOf(i, j) < 0) {
          low = std::min(low, edges_.side[std::size_t(j)].side);
          high = std::max(high, edges_.side[std::size_t(j)].side);
        }
    }
    return beside ? low + high : largerSide(edges_.elements[e]);
  }
  int largerSide(Element const& element) const {
    double weight = 0;
    int crossed = 0, sum = 0;
    for (std::size_t i = 0; i < N; ++i) {
      sum += edges_.side[std::size_t(element[i])].side;
      for (std::size_t j = i + 1; j < N; ++j) {
        const int c = edges_.crossingOf(element[i], element[j]);
        if (c < 0) continue;
        Crossing const& edge = edges_.crossings[std::size_t(c)];
        weight += edge.side * (edge.weight - 0.5);
        ++crossed;
      }
    }
    if (crossed == 0) return sum;
    return weight / crossed + 0.5 * sum >= 0 ? 1 : -1;
  }

  // which parts hang together; the faces between parts on different sides are laid bare
  void joinParts() {
    struct Keyed {
      Face key;
      Index part;
      std::size_t without;
    };
    std::vector<Keyed> faces;
    faces.reserve(N * parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t k = 0; k < N; ++k)
        faces.push_back({sorted_corners(faceWithout(parts[p].points, k)), Index(p), k});
    std::sort(faces.begin(), faces.end(), [](Keyed const& f, Keyed const& g) {
      return f.key != g.key ? f.key < g.key : f.part < g.part;
    });
    inSheet.assign(edges_.rest.size() + origins.size(), 0);
    for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
      Keyed const &f = faces[k], &g = faces[k + 1];
      if (f.key != g.key) continue;
      Part &a = parts[std::size_t(f.part)], &b = parts[std::size_t(g.part)];
      if (!separates(f.key, a, b) && !std::binary_search(closed_.begin(), closed_.end(), f.key)) {
        a.neighbor[f.without] = g.part;
        b.neighbor[g.without] = f.part;
        continue;
      }
      for (const Index i : f.key) inSheet[std::size_t(i)] = 1;
      bare.push_back({f.part, f.without});
      bare.push_back({g.part, g.without});
    }
  }
  bool separates(Face const& face, Part const& a, Part const& b) const {
    return a.side * b.side < 0 && std::all_of(face.begin(), face.end(), [this](Index i) { return inCut(i); });
  }

  // a point of a face that parts is there once for each group of parts around it that hang together
  void separate() {
    copied.assign(inSheet.size(), 0);
    std::vector<Index> stack, seen(parts.size(), -1);  // the last point for which a part was seen
    for (std::size_t point = 0; point < copied.size(); ++point) {
      if (!inSheet[point]) continue;
      const auto i = Index(point);
      bool first = true;
      for (auto const& [same, start] : partsAt(i)) {
        if (seen[std::size_t(start)] == i) continue;
        Index number = i;
        if (!first) {
          number = Index(edges_.rest.size() + origins.size());
          origins.push_back(isOld(i) ? Origin{i, i, 0} : origins[point - edges_.rest.size()]);
          copied[point] = 1;
        }
        first = false;
        seen[std::size_t(start)] = i;
        stack.assign(1, start);
        while (!stack.empty()) {
          Part& part = parts[std::size_t(stack.back())];
          stack.pop_back();
          for (std::size_t k = 0; k < N; ++k) {
            if (part.points[k] == i) {
              part.now[k] = number;
              continue;
            }
            const Index other = part.neighbor[k];
            if (other < 0 || seen[std::size_t(other)] == i) continue;
            seen[std::size_t(other)] = i;
            stack.push_back(other);
          }
        }
      }
    }
  }

  void leaveClosed() {
    std::vector<BareFace> open;
    auto remember = [this](Face const& key) {
      Triangle face{-1, -1, -1};
      std::copy(key.begin(), key.end(), face.begin());
      closed.push_back(face);
    };
    for (std::size_t k = 0; k < bare.size(); k += 2) {
      auto now = [&](BareFace const& f) {
        return sorted_corners(faceWithout(parts[std::size_t(f.part)].now, f.without));
      };
      if (now(bare[k]) != now(bare[k + 1]))
        open.insert(open.end(), {bare[k], bare[k + 1]});
      else
        remember(now(bare[k]));
    }
    bare = std::move(open);
  }
};

}  // namespace sinew::detail
