// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/io/read_gmsh.hpp>
#include <sinew/io/text_reader.hpp>
#include <sinew/mpi/communicator.hpp>
#include <sinew/mpi/same_on_all.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::mpi {

namespace detail {

/// What the next line of a Gmsh file has to be, as it goes from the rank of one part to that of the next.
struct GmshPlace {
  enum Next : int { section, skipped, format, count, blocks, block, tags, points, nodes, elements, end };
  Next next = section;
  int version = 0;       // of the format: 1, 2 or 4
  bool ofNodes = false;  // the section
  bool hasNodes = false, hasElements = false, wrong = false;
  int dimension = 0, type = 0;
  bool parametric = false;
  std::int64_t left = 0, blocksLeft = 0;  // lines of this kind, blocks
  std::int64_t announced = 0, found = 0;  // in the whole section
  std::int64_t size = 0;                  // of the block
  std::array<char, 64> name{};            // of the section
};

/// Words of one line; `good` until one is missing or is no number.
struct GmshLine {
  std::string_view rest;
  bool good = true;

  std::string_view word() {
    auto space = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    std::size_t begin = 0;
    while (begin < rest.size() && space(rest[begin])) ++begin;
    std::size_t last = begin;
    while (last < rest.size() && !space(rest[last])) ++last;
    const std::string_view found = rest.substr(begin, last - begin);
    rest.remove_prefix(last);
    return found;
  }
  std::int64_t integer() {
    std::int64_t value = 0;
    good = io::parse_number(word(), value) && good;
    return value;
  }
  double real() {
    double value = 0;
    good = io::parse_number(word(), value) && std::isfinite(value) && good;
    return value;
  }
  /// All was there, and nothing else.
  bool ends() { return good && word().empty(); }
};

/// Of elements of first order; 15: a point.
inline bool is_gmsh_type(std::int64_t type) { return (type >= 1 && type <= 7) || type == 15; }

/// One rank's part of a Gmsh file of text: the lines that begin in it.
class GmshPart {
 public:
  struct Run {  // of lines that are read alike
    GmshPlace::Next kind;
    std::size_t first, count;
    int numbers, type;  // parametric coordinates; type of elements
  };
  std::vector<Run> runs{};
  bool wrong = false;

  GmshPart(std::string const& path, int rank, int size) {
    OpenFile file(path);
    auto at = [&](int r) { return std::size_t(double(file.size()) * r / size); };
    const std::size_t begin = at(rank), end = rank + 1 < size ? at(rank + 1) : file.size();
    const std::size_t from = begin > 0 ? begin - 1 : 0;  // whether a line begins at `begin`
    bytes_ = file.read(from, end - from);
    // the end of the last line
    while (from + bytes_.size() < file.size() && !bytes_.ends_with('\n')) {
      const std::string more = file.read(from + bytes_.size(), 4096);
      bytes_ += more.substr(0, more.find('\n') == more.npos ? more.npos : more.find('\n') + 1);
    }
    for (std::size_t i = begin > 0 ? std::min(bytes_.find('\n'), bytes_.size()) + 1 : 0;
         i < bytes_.size() && from + i < end;
         i = std::min(bytes_.find('\n', i), bytes_.size()) + 1)
      lines_.push_back(i);
    wrong = std::any_of(bytes_.begin(), bytes_.end(), [](char c) {
      return (static_cast<unsigned char>(c) < ' ' && (c < '\t' || c > '\r')) || c == 0x7f;
    });
  }

  std::string_view line(std::size_t i) const {
    std::string_view l(bytes_);
    l.remove_prefix(lines_[i]);
    return l.substr(0, l.find('\n'));
  }

  /// Finds out what the lines are, from what the first one has to be, and leaves that of the line behind.
  void walk(GmshPlace& p) {
    for (std::size_t i = 0; i < lines_.size() && !p.wrong;) {
      if (p.next == GmshPlace::tags || p.next == GmshPlace::points || p.next == GmshPlace::nodes ||
          p.next == GmshPlace::elements) {
        const std::size_t n = std::min(lines_.size() - i, std::size_t(p.left));
        if (n > 0) runs.push_back({p.next, i, n, p.parametric ? std::min(p.dimension, 3) : 0, p.type});
        i += n, p.left -= std::int64_t(n);
        if (p.left == 0) behind(p);
      } else {
        one(p, line(i++));
      }
    }
  }

 private:
  std::string bytes_{};
  std::vector<std::size_t> lines_{};  // where they begin

  static std::string_view name(GmshPlace const& p) { return p.name.data(); }

  // of lines that are read alike all are there
  static void behind(GmshPlace& p) {
    if (p.next == GmshPlace::tags) {
      p.next = GmshPlace::points, p.left = p.size;
      if (p.left > 0) return;
    }
    if (p.version < 4) {
      p.next = GmshPlace::end;
    } else if (--p.blocksLeft > 0) {
      p.next = GmshPlace::block;
    } else {
      p.next = GmshPlace::end;
      p.wrong = p.found != p.announced;
    }
  }
  static void one(GmshPlace& p, std::string_view words) {
    GmshLine line{words};
    switch (p.next) {
      case GmshPlace::section: {
        const std::string_view word = line.word();
        if (word.empty()) return;  // a blank line
        p.wrong = !line.ends() || word[0] != '$' || word.size() >= p.name.size();
        if (p.wrong) return;
        p.name.fill('\0');
        std::copy(word.begin(), word.end(), p.name.begin());
        if (word == "$NOD" || word == "$Nodes" || word == "$ELM" || word == "$Elements") {
          p.ofNodes = word == "$NOD" || word == "$Nodes";
          // $NOD and $ELM are of version 1, which begins without a format
          p.wrong = p.ofNodes ? p.hasNodes : (!p.hasNodes || p.hasElements);
          if (p.version == 0) p.version = 1, p.wrong = p.wrong || word != "$NOD";
          p.wrong = p.wrong || (p.version == 1) != (word == "$NOD" || word == "$ELM");
          (p.ofNodes ? p.hasNodes : p.hasElements) = true;
          p.found = 0;
          p.next = p.version < 4 ? GmshPlace::count : GmshPlace::blocks;
        } else if (word == "$MeshFormat") {
          p.wrong = p.version != 0;
          p.next = GmshPlace::format;
        } else {
          p.wrong = p.version == 0;
          p.next = GmshPlace::skipped;
        }
        return;
      }
      case GmshPlace::skipped:
        if (ends(p, line.word()) && line.ends()) p.next = GmshPlace::section;
        return;
      case GmshPlace::format: {
        const double version = line.real();
        p.version = version == 4.1 ? 4 : version >= 2 && version < 3 ? 2 : 0;
        p.wrong = line.integer() != 0 || p.version == 0;
        line.integer();
        p.wrong = p.wrong || !line.ends();
        p.next = GmshPlace::end;
        return;
      }
      case GmshPlace::count:
        p.left = line.integer();
        p.wrong = !line.ends() || p.left < 1;
        p.type = 0, p.parametric = false;
        p.next = p.ofNodes ? GmshPlace::nodes : GmshPlace::elements;
        return;
      case GmshPlace::blocks:
        p.blocksLeft = line.integer(), p.announced = line.integer();
        line.integer(), line.integer();
        p.wrong = !line.ends() || p.blocksLeft < 1;
        p.next = GmshPlace::block;
        return;
      case GmshPlace::block: {
        p.dimension = int(line.integer());
        line.integer();
        const std::int64_t kind = line.integer();
        p.size = line.integer();
        p.wrong = !line.ends() || p.size < 0 || p.dimension < 0 || !(p.ofNodes || is_gmsh_type(kind));
        p.parametric = p.ofNodes && kind != 0;
        p.type = p.ofNodes ? 0 : int(kind);
        p.found += p.size, p.left = p.size;
        p.next = p.ofNodes ? GmshPlace::tags : GmshPlace::elements;
        if (p.left == 0) behind(p);
        return;
      }
      case GmshPlace::end:
        p.wrong = !ends(p, line.word()) || !line.ends();
        p.next = GmshPlace::section;
        return;
      default:
        return;
    }
  }
  static bool ends(GmshPlace const& p, std::string_view word) {
    const std::string_view section = name(p).substr(1);
    return (word.starts_with("$End") || word.starts_with("$END")) && word.substr(4) == section;
  }
};

/// What a part holds: numbers and points of nodes, and elements by their type, of the numbers of their nodes.
struct GmshNumbers {
  static constexpr std::array<std::size_t, 8> nodesOfType{1, 2, 3, 4, 4, 8, 6, 5};  // 0: points, type 15

  std::vector<std::int64_t> tags{};
  std::vector<double> points{};
  std::array<std::vector<std::int64_t>, 8> elements{};
  bool wrong = false;

  void read(GmshPart const& part, int version) {
    for (auto const& run : part.runs)
      for (std::size_t i = run.first; i < run.first + run.count && !wrong; ++i) {
        GmshLine line{part.line(i)};
        if (run.kind == GmshPlace::tags || run.kind == GmshPlace::nodes) tags.push_back(line.integer());
        if (run.kind == GmshPlace::points || run.kind == GmshPlace::nodes)
          for (int k = 0; k < 3; ++k) points.push_back(line.real());
        if (run.kind == GmshPlace::points)
          for (int k = 0; k < run.numbers; ++k) line.real();
        if (run.kind == GmshPlace::elements) element(line, version, run.type);
        wrong = wrong || !line.ends();
      }
  }

 private:
  void element(GmshLine& line, int version, std::int64_t type) {
    line.integer();
    if (version < 4) type = line.integer();
    wrong = !is_gmsh_type(type);
    if (wrong) return;
    const std::size_t list = type == 15 ? 0 : std::size_t(type);
    if (version == 1) {
      line.integer(), line.integer();
      wrong = line.integer() != std::int64_t(nodesOfType[list]);
    } else if (version == 2) {
      const std::int64_t ofGroups = line.integer();
      wrong = ofGroups < 0;
      for (std::int64_t t = 0; t < ofGroups && line.good; ++t) line.integer();
    }
    for (std::size_t k = 0; k < nodesOfType[list]; ++k) elements[list].push_back(line.integer());
  }
};

/// Reads a Gmsh file with all ranks, or nothing, where it is not what a line each is of.
class GmshOfRanks {
 public:
  GmshOfRanks(std::string const& path, Communicator& ranks) : path_(path), ranks_(ranks) {}

  std::optional<Mesh> read() {
    GmshPart part(path_, ranks_.rank(), ranks_.size());
    // from rank to rank, what the lines are
    auto place = std::make_unique<GmshPlace>();
    try {
      pass(*place, part);
    } catch (...) {
      keep(std::move(place));  // a message into it may be under way
      throw;
    }
    GmshNumbers own;
    own.read(part, place->version);
    const bool whole = place->next == GmshPlace::section && place->hasNodes && place->hasElements;
    const bool last = ranks_.rank() + 1 == ranks_.size();
    std::vector<Counts> all = counts(
        {part.wrong || place->wrong || own.wrong || (last && !whole), own.tags.size(), own.points.size()});
    if (wrong(all)) return {};
    std::vector<std::int64_t> tags = together(own.tags, all, 1);
    const std::vector<double> points = together(own.points, all, 2);
    if (tags.empty() || points.size() != 3 * tags.size()) return {};
    Mesh mesh;
    for (std::size_t i = 0; i < tags.size(); ++i)
      mesh.positions.emplace_back(points[3 * i], points[3 * i + 1], points[3 * i + 2]);

    // numbers of nodes become places among the points
    std::array<std::vector<Index>, 8> places;
    Counts found{};
    const bool same = find(tags, own.elements, places);
    found[0] = !same;
    for (std::size_t k = 1; k < 8; ++k) found[k] = places[k].size();
    all = counts(found);
    if (wrong(all)) return {};
    add(mesh.edges, places[1], all, 1), add(mesh.triangles, places[2], all, 2);
    add(mesh.quads, places[3], all, 3), add(mesh.tetrahedra, places[4], all, 4);
    add(mesh.hexahedra, places[5], all, 5), add(mesh.prisms, places[6], all, 6);
    add(mesh.pyramids, places[7], all, 7);
    return mesh;
  }

 private:
  using Counts = std::array<std::size_t, 8>;  // first whether something is wrong
  std::string const& path_;
  Communicator& ranks_;

  void pass(GmshPlace& place, GmshPart& part) {
    constexpr int ofPlace = 21;
    const int rank = ranks_.rank();
    if (rank > 0) {
      MPI_Request come = ranks_.receive(rank - 1, &place, sizeof place, ofPlace);
      ranks_.wait({&come, 1}, text("what rank ", rank - 1, " has found in its part of ", path_));
    }
    part.walk(place);
    if (rank + 1 == ranks_.size()) return;
    MPI_Request gone = ranks_.send(rank + 1, &place, sizeof place, ofPlace);
    ranks_.wait({&gone, 1}, text("rank ", rank + 1, ", which reads its part of ", path_));
  }
  std::vector<Counts> counts(Counts const& own) {
    return ranks_.gather(std::vector<Counts>{own},
                         std::vector<std::size_t>(std::size_t(ranks_.size()), 1),
                         text("what all ranks have found in ", path_));
  }
  static bool wrong(std::vector<Counts> const& all) {
    std::size_t most = 0;
    for (Counts const& c : all)
      for (std::size_t const n : c) most += n;
    // (8 bytes each, in one message)
    return most > (std::size_t(1) << 28) ||
           std::any_of(all.begin(), all.end(), [](Counts const& c) { return c[0] != 0; });
  }
  template <class T>
  std::vector<T> together(std::vector<T> const& own, std::vector<Counts> const& all, std::size_t which) {
    std::vector<std::size_t> sizes;
    for (Counts const& c : all) sizes.push_back(c[which]);
    return ranks_.gather(own, sizes, text("what all ranks have read of ", path_));
  }
  template <class E>
  void add(std::vector<E>& list, std::vector<Index> const& own, std::vector<Counts> const& all,
           std::size_t which) {
    if (std::all_of(all.begin(), all.end(), [&](Counts const& c) { return c[which] == 0; })) return;
    const std::vector<Index> points = together(own, all, which);
    constexpr std::size_t n = std::tuple_size_v<E>;
    list.resize(points.size() / n);
    for (std::size_t e = 0; e < list.size(); ++e)
      for (std::size_t k = 0; k < n; ++k) list[e][k] = points[n * e + k];
  }
  // false where a number is twice or missing
  static bool find(std::vector<std::int64_t> const& tags,
                   std::array<std::vector<std::int64_t>, 8> const& elements,
                   std::array<std::vector<Index>, 8>& places) {
    std::vector<std::pair<std::int64_t, Index>> nodes;
    nodes.reserve(tags.size());
    for (const std::int64_t tag : tags) nodes.emplace_back(tag, Index(nodes.size()));
    if (!std::is_sorted(nodes.begin(), nodes.end())) std::sort(nodes.begin(), nodes.end());
    for (std::size_t i = 1; i < nodes.size(); ++i)
      if (nodes[i].first == nodes[i - 1].first) return false;
    for (std::size_t k = 0; k < elements.size(); ++k)
      for (const std::int64_t tag : elements[k]) {
        // most files number their nodes without gaps
        const std::uint64_t guess = std::uint64_t(tag) - std::uint64_t(nodes.front().first);
        auto at = nodes.end();
        if (guess < nodes.size() && nodes[guess].first == tag)
          at = nodes.begin() + std::ptrdiff_t(guess);
        else
          at = std::lower_bound(nodes.begin(), nodes.end(), std::pair(tag, Index(0)));
        if (at == nodes.end() || at->first != tag) return false;
        places[k].push_back(at->second);
      }
    return true;
  }
};

}  // namespace detail

/// Reads a Gmsh file (io/read_gmsh.hpp) with all ranks: each reads its part of the bytes and makes numbers of
/// them, and all have the mesh then, the same as one process would have, bit by bit. A file with several
/// nodes or elements on a line, and one with a mistake, is read by each rank as a whole, which says what is
/// wrong. Throws Error where the file is not there on all ranks, or not the same.
inline Mesh read_gmsh(std::string const& path, Communicator& ranks) {
  same_file_on_all(ranks, path);
  std::optional<Mesh> mesh = detail::GmshOfRanks(path, ranks).read();
  if (!mesh) return io::read_gmsh(path);
  check_mesh(path, *mesh);
  return std::move(*mesh);
}

/// As long as it lives, loaders of Gmsh files in scenes of this thread read them with all ranks.
class ReadTogether {
 public:
  explicit ReadTogether(Communicator& ranks) : before_(std::exchange(now(), &ranks)) {}
  ReadTogether(ReadTogether const&) = delete;
  ReadTogether& operator=(ReadTogether const&) = delete;
  ~ReadTogether() { now() = before_; }

  static Communicator*& now() {
    thread_local Communicator* ranks = nullptr;
    return ranks;
  }

 private:
  Communicator* before_;
};

}  // namespace sinew::mpi
