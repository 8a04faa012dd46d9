// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/renumbering.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew::io {

/// What a file of topological changes asks for at a time [s].
struct TopologicalEntry {
  enum class What { remove, add, addPoints, incise };
  double time = 0;
  What what = What::remove;
  int kind = 0;                  // of the elements that come: ElementKind
  std::vector<int> numbers{};    // of elements that go; of the points of those that come, one element after
                                 // the other; of the triangles in which points come
  std::vector<int> ancestors{};  // of elements that come: of which each is a part; empty: of none
  std::vector<double> values{};  // of points that come: the weights of the first two corners; of an
                                 // incision: its coordinates [m]
  bool isShort = false, isLong = false;  // fewer or more numbers follow than the count says
};

/// The changes in `content`; `path` is for messages. See read_topological_changes().
std::vector<TopologicalEntry> parse_topological_changes(std::string_view path, std::string_view content);

/// Reads SOFA's text format of topological changes: "T= seconds", and any number of
///   REMOVE= count                             numbers of elements; where fewer follow, those missing are 0
///   ADD= Edges|Triangles|Quads|Tetrahedra|Hexahedra count [Ancestors numbers]     points of each
///   ADD= PointsInTriangle count               of each a triangle and the weights of its first two corners
///   INCISE= count                             points of a path, each three coordinates, or a triangle before
///                                             them
/// Further numbers are left out, as in SOFA. Throws Error with the line on anything else, on times that fall,
/// and a file without any change.
std::vector<TopologicalEntry> read_topological_changes(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace sinew::io {

namespace detail {

class TopologicalFile {
 public:
  TopologicalFile(std::string_view path, std::string_view content) : path_(path), in_(path, content) {
    in_.rejectBinary();
  }

  std::vector<TopologicalEntry> read() {
    for (std::string_view key = word(); !key.empty(); key = word()) {
      if (key == "T=") {
        const double next = in_.real("a time");
        if (timed_ && next < time_)
          throw in_.error(text("the time ", next, " s follows ", time_, " s; times rise"));
        time_ = next;
        timed_ = true;
      } else if (key == "REMOVE=") {
        readRemoval(entry());
      } else if (key == "ADD=") {
        readAddition(entry());
      } else if (key == "INCISE=") {
        readIncision(entry());
      } else {
        throw in_.expected("T=, REMOVE=, ADD= or INCISE=");
      }
    }
    if (entries_.empty())
      throw Error(path_, "there is no change (\"T= seconds\", \"REMOVE= count\"); add one");
    return std::move(entries_);
  }

 private:
  using What = TopologicalEntry::What;
  std::string_view path_;
  TextReader in_;
  double time_ = 0;
  bool timed_ = false;
  std::string_view next_{};  // a word that is read already
  std::vector<TopologicalEntry> entries_{};

  std::string_view word() {
    if (!next_.empty()) return std::exchange(next_, std::string_view());
    return in_.more() ? in_.word() : std::string_view();
  }
  static bool isKey(std::string_view w) {
    return w.empty() || w == "T=" || w == "REMOVE=" || w == "ADD=" || w == "INCISE=";
  }
  TopologicalEntry& entry() {
    if (!timed_) throw in_.error("a change has no time; put \"T= seconds\" before it");
    entries_.emplace_back();
    entries_.back().time = time_;
    return entries_.back();
  }
  std::size_t count(std::string_view what) {
    const std::int64_t n = in_.integer(what);
    if (n < 0) throw in_.expected(what);
    return std::size_t(n);
  }
  int number(std::string_view what) {
    int n = 0;
    const std::string_view w = word();
    if (!parse_number(w, n) || n < 0) throw in_.expected(text(what, ", from 0 on"));
    return n;
  }
  double real(std::string_view what) {
    double value = 0;
    const std::string_view w = word();
    if (!parse_number(w, value) || !(std::abs(value) <= std::numeric_limits<double>::max()))
      throw in_.expected(text(what, ", a finite number"));
    return value;
  }
  void skipMore(TopologicalEntry& e) {
    for (double value = 0; next_ = word(), parse_number(next_, value); next_ = {}) e.isLong = true;
  }

  void readRemoval(TopologicalEntry& e) {
    const std::size_t n = count("numbers of elements");
    while (e.numbers.size() < n) {
      const std::string_view w = word();
      int number = 0;
      e.isShort = isKey(w);
      if (!e.isShort && (!parse_number(w, number) || number < 0))
        throw in_.expected(text("the number of an element, from 0 on (", n, " follow REMOVE=)"));
      e.numbers.push_back(number);
      if (!e.isShort) continue;
      next_ = w;  // all that are missing are 0
      break;
    }
    skipMore(e);
  }
  void readAddition(TopologicalEntry& e) {
    struct Name {
      std::string_view one, several;
    };
    static constexpr int kinds = 5;
    static constexpr std::array<Name, kinds> names{{{"Edge", "Edges"},
                                                    {"Triangle", "Triangles"},
                                                    {"Quad", "Quads"},
                                                    {"Tetrahedron", "Tetrahedra"},
                                                    {"Hexahedron", "Hexahedra"}}};
    static constexpr std::array<std::size_t, kinds> corners{2, 3, 4, 4, 8};
    const std::string_view name = word();
    if (name == "PointInTriangle" || name == "PointsInTriangle") {
      e.what = What::addPoints;
      for (std::size_t n = count("points that come"), k = 0; k < n; ++k) {
        e.numbers.push_back(number("the number of the triangle in which a point comes"));
        const double a = real("the weight of a corner"), b = real("the weight of a corner");
        if (!(a >= 0 && b >= 0 && a + b <= 1 + 1e-9))
          throw in_.error(
              text("the weights ",
                   a,
                   " and ",
                   b,
                   " are those of no point in the triangle; give two from 0 on whose sum is 1 at most"));
        e.values.push_back(a), e.values.push_back(b);
      }
      return skipMore(e);
    }
    e.what = What::add;
    while (e.kind < kinds && name != names[std::size_t(e.kind)].one &&
           name != names[std::size_t(e.kind)].several)
      ++e.kind;
    if (e.kind == kinds)
      throw in_.expected("Edges, Triangles, Quads, Tetrahedra, Hexahedra or PointsInTriangle");
    const std::size_t n = count("elements that come");
    next_ = in_.wordOnLine();
    if (next_ == "Ancestors" || next_ == "Ancestor") {
      next_ = {};
      while (e.ancestors.size() < n) e.ancestors.push_back(number("the number of an ancestor"));
    }
    for (std::size_t k = 0; k < n * corners[std::size_t(e.kind)]; ++k)
      e.numbers.push_back(number(
          text("the number of a point (", corners[std::size_t(e.kind)], " for each of ", n, " elements)")));
    skipMore(e);
  }
  void readIncision(TopologicalEntry& e) {
    e.what = What::incise;
    const std::size_t n = count("points of the path");
    double value = 0;
    for (; next_ = word(), parse_number(next_, value); next_ = {}) {
      if (!(std::abs(value) <= std::numeric_limits<double>::max()))
        throw in_.expected("a coordinate, a finite number");
      e.values.push_back(value);
    }
    if (n < 2) throw in_.error(text("an incision of ", n, " points is none; give two or more"));
    if (e.values.size() == 4 * n) {
      // triangles, which are found by the places
      std::vector<double> places;
      for (std::size_t k = 0; k < e.values.size(); ++k)
        if (k % 4 != 0) places.push_back(e.values[k]);
      e.values = std::move(places);
    } else if (e.values.size() != 3 * n) {
      throw in_.error(text(e.values.size(),
                           " numbers follow INCISE= ",
                           n,
                           "; give three coordinates of each point, or a triangle and three coordinates"));
    }
  }
};

}  // namespace detail

SINEW_ONCE std::vector<TopologicalEntry> parse_topological_changes(std::string_view path,
                                                                   std::string_view content) {
  return detail::TopologicalFile(path, content).read();
}

SINEW_ONCE std::vector<TopologicalEntry> read_topological_changes(std::string const& path) {
  return parse_topological_changes(path, read_file(path));
}

}  // namespace sinew::io
#endif
