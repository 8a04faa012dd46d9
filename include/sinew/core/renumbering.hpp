// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

/// Of what a point or an element is that comes, by old numbers, behind which what comes before it is
/// numbered:
///   x = (1 - weight - weightOfC) x_a + weight x_b + weightOfC x_c
/// A part or a copy of one has a = b, what is on an edge no c (-1), and what is of nothing no a: it is none.
struct Origin {
  Index a, b;
  double weight;
  Index c = -1;
  double weightOfC = 0;

  static Origin none() { return {-1, -1, 0}; }
  bool isNone() const { return a < 0; }
};

/// A vector, whose multiples add up.
template <class T>
concept Weighable = requires(T const& value, typename T::Scalar factor) { factor* value; };

/// The value of what comes, from that of what it comes of. What cannot be weighed is that of the nearer one.
template <class T>
T value_between(T const& a, T const& b, double weight) {
  if constexpr (std::is_floating_point_v<T>)
    return weight == 0 ? a : (1 - T(weight)) * a + T(weight) * b;
  else if constexpr (Weighable<T>)
    return weight == 0 ? a : T((1 - typename T::Scalar(weight)) * a + typename T::Scalar(weight) * b);
  else
    return weight < 0.5 ? a : b;
}

/// The same from a list with a value for each, and those of what comes before; that of what is of nothing is
/// zero.
template <class List>
auto value_of(List const& list, Origin const& o, std::vector<typename List::value_type> const& before = {}) ->
    typename List::value_type {
  using T = typename List::value_type;
  auto at = [&](Index i) -> T {
    return std::size_t(i) < list.size() ? list[std::size_t(i)] : before[std::size_t(i) - list.size()];
  };
  if (o.isNone()) {
    if constexpr (requires { T::Zero(); })
      return T::Zero();
    else
      return T{};
  }
  if (o.c < 0) return value_between<T>(at(o.a), at(o.b), o.weight);
  const double rest = 1 - o.weight - o.weightOfC;
  if constexpr (std::is_floating_point_v<T>)
    return T(rest) * at(o.a) + T(o.weight) * at(o.b) + T(o.weightOfC) * at(o.c);
  else if constexpr (Weighable<T>)
    return T(typename T::Scalar(rest) * at(o.a) + typename T::Scalar(o.weight) * at(o.b) +
             typename T::Scalar(o.weightOfC) * at(o.c));
  else
    return rest >= o.weight && rest >= o.weightOfC ? at(o.a) : o.weight >= o.weightOfC ? at(o.b) : at(o.c);
}

/// Points or elements of which some go, and others come. What stays keeps its order, or takes another where a
/// scene is distributed, and what comes is behind it.
struct Renumbering {
  std::vector<Index> kept{};   // old numbers of what stays, by new ones
  std::vector<Index> now{};    // new numbers, by old ones; -1 for what has gone
  std::vector<Origin> come{};  // of what all that comes is

  static Renumbering of(std::vector<bool> const& stays);
  /// The same in place: allocates nothing for as many as there were room for.
  void set(std::vector<bool> const& stays);
  /// Of so many, those with these old numbers stay, in this order.
  static Renumbering inOrder(std::vector<Index> kept, std::size_t before);
  /// So many that all stay, and others that come.
  static Renumbering grown(std::size_t stay, std::vector<Origin> come);

  /// This, and then another in which nothing comes, and that of which something has come stays.
  Renumbering then(Renumbering const& removal) const;

  std::vector<bool> stays() const {
    std::vector<bool> all;
    for (const Index n : now) all.push_back(n >= 0);
    return all;
  }
  bool changes() const { return kept.size() != now.size() || !come.empty() || !keepsOrder(); }
  bool keepsOrder() const { return std::is_sorted(kept.begin(), kept.end()); }
  /// How many there are now.
  std::size_t size() const { return kept.size() + come.size(); }
  bool stays(Index old) const { return std::size_t(old) >= now.size() || now[std::size_t(old)] >= 0; }

  /// Takes out of a list with one entry for each what has gone, and puts behind it what has come.
  template <class List>
  void filter(List& list) const {
    if (!changes() || list.size() != now.size()) return;
    std::vector<typename List::value_type> values;
    values.reserve(come.size());
    for (Origin const& o : come) values.push_back(value_of(list, o, values));
    if (keepsOrder()) {
      for (std::size_t i = 0; i < kept.size(); ++i) list[i] = list[std::size_t(kept[i])];
      list.resize(kept.size());
    } else {
      List inOrder;
      inOrder.reserve(kept.size() + come.size());
      for (const Index old : kept) inOrder.push_back(list[std::size_t(old)]);
      list = std::move(inOrder);
    }
    list.insert(list.end(), values.begin(), values.end());
  }
  /// The same where each has `width` values in a row; what comes has those of what it is of.
  template <class Value>
  void filterRows(std::vector<Value>& list, std::size_t width) const {
    if (!changes() || list.size() != width * now.size()) return;
    std::vector<Value> values;
    values.reserve(width * size());
    auto take = [&](Index old) {
      const auto first = list.begin() + std::ptrdiff_t(width) * old;
      values.insert(values.end(), first, first + std::ptrdiff_t(width));
    };
    for (const Index old : kept) take(old);
    for (Origin const& part : come)
      if (part.isNone())
        values.resize(values.size() + width, Value{});
      else
        take(part.a);
    list = std::move(values);
  }
  /// Puts the new number in the place of the old one.
  void renumber(Index& number) const {
    if (std::size_t(number) < now.size()) number = now[std::size_t(number)];
  }
};

/// Numbers of elements of a topology, kind by kind, and of its points.
struct ElementNumbers {
  std::vector<Index> edges{}, triangles{}, quads{}, tetrahedra{}, hexahedra{}, pyramids{}, prisms{},
      quadraticTetrahedra{}, quadraticHexahedra{}, triquadraticHexahedra{}, points{};

  std::array<std::vector<Index> const*, element_kinds> lists() const {
    return {&edges,
            &triangles,
            &quads,
            &tetrahedra,
            &hexahedra,
            &pyramids,
            &prisms,
            &quadraticTetrahedra,
            &quadraticHexahedra,
            &triquadraticHexahedra};
  }
  std::vector<Index>& of(int kind) {
    return *std::array{&edges,
                       &triangles,
                       &quads,
                       &tetrahedra,
                       &hexahedra,
                       &pyramids,
                       &prisms,
                       &quadraticTetrahedra,
                       &quadraticHexahedra,
                       &triquadraticHexahedra}[std::size_t(kind)];
  }
};

/// Elements that come to a topology, in the numbers of its points with those that come behind them; pyramids,
/// prisms and elements of second order do not.
struct AddedElements {
  std::vector<Origin> points{};  // where they come, between points that are there or come before them
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Quad> quads{};
  std::vector<Tetrahedron> tetrahedra{};
  std::vector<Hexahedron> hexahedra{};
  /// Of each kind, the element of the same kind of which each is a part, whose values it has, -1 for one that
  /// is of none; empty: all of none.
  std::array<std::vector<Index>, element_kinds> ancestors{};

  bool empty() const {
    return points.empty() && edges.empty() && triangles.empty() && quads.empty() && tetrahedra.empty() &&
           hexahedra.empty();
  }
  /// f(kind, list) for each kind.
  template <class F>
  void forEach(F&& f) const {
    for_each_kind(*this, f);
  }
};

/// The lists of a topology that may be changed; null for kinds that it does not have.
struct ElementLists {
  std::vector<Eigen::Vector3d>* positions = nullptr;
  std::vector<Edge>* edges = nullptr;
  std::vector<Triangle>* triangles = nullptr;
  std::vector<Quad>* quads = nullptr;
  std::vector<Tetrahedron>* tetrahedra = nullptr;
  std::vector<Hexahedron>* hexahedra = nullptr;
  std::vector<Pyramid>* pyramids = nullptr;
  std::vector<Prism>* prisms = nullptr;
  std::vector<QuadraticTetrahedron>* quadraticTetrahedra = nullptr;
  std::vector<QuadraticHexahedron>* quadraticHexahedra = nullptr;
  std::vector<TriquadraticHexahedron>* triquadraticHexahedra = nullptr;

  /// f(kind, list) for each kind there is.
  template <class F>
  void forEach(F&& f) const {
    for_each_kind(*this, [&](int kind, auto* list) {
      if (list) f(kind, *list);
    });
  }
};

/// What became of the points of a state and of the elements of one of its topologies.
struct TopologyChange {
  Renumbering points{};
  std::array<Renumbering, element_kinds> elements{};

  bool changes() const {
    bool any = points.changes();
    for (auto const& kind : elements) any = any || kind.changes();
    return any;
  }
  Renumbering const& of(ElementKind kind) const { return elements[std::size_t(kind)]; }

  /// What becomes of a list of `size`, with one entry for each element of a dimension (1, 2, 3): simplices
  /// first, and then as many entries for each other element as there must be, since a component may split
  /// hexahedra or quads into simplices. A part has the entries of the whole, in their order, so that means
  /// over the whole stay. Where others than simplices are listed too and something comes, all comes, what
  /// stays as a copy. Of dimension 0, of a topology without elements, nothing goes.
  Renumbering ofDimension(int dimension, std::size_t size) const;
  /// The highest dimension of which there were elements; 0 for none.
  int dimension() const;
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE Renumbering Renumbering::then(Renumbering const& removal) const {
  if (now.empty()) return removal;
  if (removal.now.empty()) return *this;
  Renumbering both;
  std::vector<Index> place(come.size(), -1);  // of what comes, as it is numbered behind the old
  for (const Index between : removal.kept) {
    if (std::size_t(between) < kept.size()) {
      both.kept.push_back(kept[std::size_t(between)]);
      continue;
    }
    const std::size_t k = std::size_t(between) - kept.size();
    place[k] = Index(now.size() + both.come.size());
    Origin o = come[k];
    for (Index* of : {&o.a, &o.b, &o.c})
      if (*of >= Index(now.size())) *of = place[std::size_t(*of) - now.size()];
    both.come.push_back(o);
  }
  for (const Index between : now) both.now.push_back(between < 0 ? -1 : removal.now[std::size_t(between)]);
  return both;
}

SINEW_ONCE void Renumbering::set(std::vector<bool> const& stays) {
  kept.clear();
  now.clear();
  come.clear();
  for (std::size_t i = 0; i < stays.size(); ++i) {
    now.push_back(stays[i] ? Index(kept.size()) : -1);
    if (stays[i]) kept.push_back(Index(i));
  }
}

SINEW_ONCE Renumbering Renumbering::of(std::vector<bool> const& stays) {
  Renumbering r;
  r.set(stays);
  return r;
}

SINEW_ONCE Renumbering Renumbering::inOrder(std::vector<Index> kept, std::size_t before) {
  Renumbering r;
  r.now.assign(before, -1);
  for (std::size_t i = 0; i < kept.size(); ++i) r.now[std::size_t(kept[i])] = Index(i);
  r.kept = std::move(kept);
  return r;
}

SINEW_ONCE Renumbering Renumbering::grown(std::size_t stay, std::vector<Origin> come) {
  Renumbering r = of(std::vector<bool>(stay, true));
  r.come = std::move(come);
  return r;
}

SINEW_ONCE Renumbering TopologyChange::ofDimension(int dimension, std::size_t size) const {
  if (dimension == 0) return {};
  constexpr int simplex[] = {0, 1, 3};
  Renumbering const& simplices = of(ElementKind(simplex[dimension - 1]));
  // the others one kind behind the other
  std::size_t count = 0;
  bool comes = !simplices.come.empty();
  auto forEachOther = [&](auto&& f) {
    for (int kind = simplex[dimension - 1] + 1; kind < element_kinds; ++kind)
      if (dimension_of_kind(kind) == dimension) f(elements[std::size_t(kind)]);
  };
  forEachOther([&](Renumbering const& kind) {
    count += kind.now.size();
    comes = comes || !kind.come.empty();
  });
  const std::size_t first = simplices.now.size(), rest = size > first ? size - first : 0;
  if (count == 0 || rest % count != 0) return simplices;
  std::vector<Index> kept;
  std::vector<Origin> come;
  std::size_t before = 0;
  auto add = [&](Renumbering const& kind, std::size_t entries) {
    auto addElement = [&](Index old) {
      for (std::size_t k = 0; k < entries; ++k) {
        const Index from = old < 0 ? -1 : Index(before + std::size_t(old) * entries + k);
        if (!comes)
          kept.push_back(from);
        else
          come.push_back(from < 0 ? Origin::none() : Origin{from, from, 0});
      }
    };
    for (const Index old : kind.kept) addElement(old);
    for (Origin const& o : kind.come) addElement(o.a);
    before += kind.now.size() * entries;
  };
  add(simplices, 1);
  forEachOther([&](Renumbering const& kind) { add(kind, rest / count); });
  Renumbering all = Renumbering::inOrder(std::move(kept), first + rest);
  all.come = std::move(come);
  return all;
}

SINEW_ONCE int TopologyChange::dimension() const {
  int highest = 0;
  for (int kind = 0; kind < element_kinds; ++kind)
    if (!elements[std::size_t(kind)].now.empty()) highest = std::max(highest, dimension_of_kind(kind));
  return highest;
}

}  // namespace sinew
#endif
