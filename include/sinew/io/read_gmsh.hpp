// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/mesh.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mesh in `content`, the text of a Gmsh file; `path` is for messages. See read_gmsh().
Mesh parse_gmsh(std::string_view path, std::string_view content);

/// Reads a Gmsh file (.msh), format 1, 2.0 to 2.2 or 4.1, ASCII. Points are in the order of the file,
/// whatever their numbers; lines, triangles, quads, tetrahedra, hexahedra, prisms and pyramids are read,
/// point elements and all groups ignored. Of second order, tetrahedra of 10 nodes and hexahedra of 20 or 27
/// are read, their nodes brought into VTK's order; lines, triangles and quads of second order are cut between
/// their nodes. Throws Error with the line on anything else: binary files, other elements, coordinates that
/// are not finite, unknown nodes, an incomplete file.
Mesh read_gmsh(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/cells.hpp>
#include <sinew/io/text_reader.hpp>

#include <vector>

namespace sinew::io::detail {

/// Gmsh files as the Gmsh reference manual describes them: chapters "MSH file format" (4.1) and "Legacy
/// formats" (1 and 2).
class GmshParser {
 public:
  GmshParser(std::string_view path, std::string_view content) : in_(path, content) {}

  Mesh parse() {
    bool started = false;
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      const std::string section(word);
      if (!started && section != "$MeshFormat" && section != "$NOD")
        throw in_.expected("$MeshFormat or $NOD, with which a Gmsh file begins");
      started = true;
      if (section == "$NOD" || section == "$Nodes") {
        nodes(section);
      } else if (section == "$ELM" || section == "$Elements") {
        elements(section);
      } else if (section == "$MeshFormat") {
        format();
        end(section);
      } else if (section.starts_with('$')) {
        skip(section);
      } else {
        throw in_.expected("a section such as $Nodes");
      }
    }
    if (!hasElements_) {
      in_.word();
      throw in_.expected("$Elements (or $ELM)");
    }
    return std::move(mesh_);
  }

 private:
  struct Node {
    std::int64_t number;
    Index index;
    std::uint32_t line;
  };

  void format() {
    const double version = in_.real("the version of the format");
    if (version >= 2 && version < 3)
      version_ = 2;
    else if (version == 4.1)
      version_ = 4;
    else
      throw in_.error(text("is of version ",
                           version,
                           " of Gmsh's format; save it as version 4.1 or 2.2 (gmsh -save -format msh41)"));
    if (in_.integer("0 for ASCII or 1 for binary") != 0)
      throw in_.error(
          "is a binary Gmsh file; export it as ASCII (in Gmsh, leave \"Binary\" unticked, or set Mesh.Binary "
          "= 0)");
    in_.integer("the size of a number in bytes");
  }

  // $NOD, $Nodes: positions in the order of the file
  void nodes(std::string const& section) {
    if (hasNodes_) throw in_.error("is a second section of nodes; keep one");
    hasNodes_ = true;
    in_.rejectBinary();
    if (version_ < 4) {
      const std::size_t n = in_.count("the number of nodes", 4);
      for (std::size_t i = 0; i < n; ++i) {
        number(in_.integer("the number of a node"));
        mesh_.positions.push_back(in_.point());
      }
    } else {
      const std::size_t blocks = in_.count("the number of blocks", 4);
      const std::size_t n = in_.count("the number of nodes", 4), line = in_.line();
      in_.integer("the least number of a node"), in_.integer("the greatest number of a node");
      for (std::size_t b = 0; b < blocks; ++b) {
        const std::int64_t dimension = in_.integer("the dimension of an entity");
        in_.integer("the number of an entity");
        const bool parametric = in_.integer("0, or 1 for parametric nodes") != 0;
        const std::size_t size = in_.count("the number of nodes of a block", 4);
        for (std::size_t i = 0; i < size; ++i) number(in_.integer("the number of a node"));
        for (std::size_t i = 0; i < size; ++i) {
          mesh_.positions.push_back(in_.point());
          if (parametric)
            for (std::int64_t k = 0; k < std::min<std::int64_t>(dimension, 3); ++k)
              in_.real("a parametric coordinate");
        }
      }
      total("nodes", n, line, nodes_.size());
    }
    end(section);
    if (nodes_.empty()) throw in_.error("holds no nodes; export a mesh");
    sortNodes();
  }
  void number(std::int64_t tag) { nodes_.push_back({tag, Index(nodes_.size()), std::uint32_t(in_.line())}); }

  void sortNodes() {
    auto less = [](Node const& a, Node const& b) { return a.number < b.number; };
    if (!std::is_sorted(nodes_.begin(), nodes_.end(), less)) std::sort(nodes_.begin(), nodes_.end(), less);
    for (std::size_t i = 1; i < nodes_.size(); ++i)
      if (nodes_[i].number == nodes_[i - 1].number)
        throw in_.error(std::max(nodes_[i].line, nodes_[i - 1].line),
                        text("node number ", nodes_[i].number, " is given twice; number the nodes anew"));
  }

  // $ELM, $Elements
  void elements(std::string const& section) {
    if (!hasNodes_) throw in_.error("stands before the nodes; move it behind them");
    if (hasElements_) throw in_.error("is a second section of elements; keep one");
    hasElements_ = true;
    if (version_ < 4) {
      const std::size_t n = in_.count("the number of elements", version_ == 1 ? 6 : 4);
      for (std::size_t e = 0; e < n; ++e) {
        in_.integer("the number of an element");
        const std::int64_t type = in_.integer("the type of an element");
        const std::size_t size = nodesOf(type);
        if (version_ == 1) {
          in_.integer("a physical entity"), in_.integer("an elementary entity");
          if (in_.integer("the number of nodes of an element") != std::int64_t(size))
            throw in_.error(text("elements of type ", type, " have ", size, " nodes; correct this line"));
        } else {
          const std::size_t tags = in_.count("the number of tags", 1);
          for (std::size_t t = 0; t < tags; ++t) in_.integer("a tag");
        }
        element(type);
      }
    } else {
      const std::size_t blocks = in_.count("the number of blocks", 4);
      const std::size_t n = in_.count("the number of elements", 2), line = in_.line();
      in_.integer("the least number of an element"), in_.integer("the greatest number of an element");
      std::size_t found = 0;
      for (std::size_t b = 0; b < blocks; ++b) {
        in_.integer("the dimension of an entity"), in_.integer("the number of an entity");
        const std::int64_t type = in_.integer("the type of elements");
        const std::size_t size = in_.count("the number of elements of a block", 1 + nodesOf(type));
        for (std::size_t e = 0; e < size; ++e) {
          in_.integer("the number of an element");
          element(type);
        }
        found += size;
      }
      total("elements", n, line, found);
    }
    end(section);
  }

  // how many nodes elements of a type have
  std::size_t nodesOf(std::int64_t type) const {
    switch (type) {
      case 1:
        return 2;
      case 2:
        return 3;
      case 3:
      case 4:
        return 4;
      case 5:
        return 8;
      case 6:
        return 6;
      case 7:
        return 5;
      case 8:
        return 3;
      case 9:
        return 6;
      case 10:
        return 9;
      case 11:
        return 10;
      case 12:
        return 27;
      case 15:
        return 1;
      case 16:
        return 8;
      case 17:
        return 20;
      default:
        break;
    }
    throw in_.error(text("elements of type ",
                         type,
                         " are of third or higher order, prisms or pyramids of second order, or unknown; ",
                         "save a mesh of first order (in Gmsh, Mesh.ElementOrder = 1), or tetrahedra or "
                         "hexahedra of second order"));
  }
  void element(std::int64_t type) {
    switch (type) {
      case 1:
        return add(mesh_.edges);
      case 2:
        return add(mesh_.triangles);
      case 3:
        return add(mesh_.quads);
      case 4:
        return add(mesh_.tetrahedra);
      case 5:
        return add(mesh_.hexahedra);
      case 6:
        return add(mesh_.prisms);
      case 7:
        return add(mesh_.pyramids);
      case 8:
        return add_quadratic_edge(mesh_, nodesOfElement<3>());
      case 9:
        return add_quadratic_triangle(mesh_, nodesOfElement<6>());
      case 10:
        return add_quadratic_quad(mesh_, nodesOfElement<9>());
      case 11:
        return add(mesh_.quadraticTetrahedra, gmshQuadraticTetrahedron);
      case 12:
        return add(mesh_.triquadraticHexahedra, gmshTriquadraticHexahedron);
      case 16:
        return add_quadratic_quad(mesh_, nodesOfElement<8>());
      case 17:
        return add(mesh_.quadraticHexahedra, gmshQuadraticHexahedron);
      default:
        node();  // a point
    }
  }
  template <class E>
  void add(std::vector<E>& list) {
    list.push_back(nodesOfElement<std::tuple_size_v<E>>());
  }
  // of another order of nodes
  template <class E>
  void add(std::vector<E>& list, E const& numbers) {
    const E read = nodesOfElement<std::tuple_size_v<E>>();
    E e;
    for (std::size_t k = 0; k < e.size(); ++k) e[k] = read[std::size_t(numbers[k])];
    list.push_back(e);
  }
  template <std::size_t N>
  std::array<Index, N> nodesOfElement() {
    std::array<Index, N> e;
    const std::size_t line = in_.line();
    for (Index& i : e) {
      if constexpr (N > 8) {
        TextReader ahead = in_;
        ahead.word();
        if (ahead.line() != line)
          throw in_.error(line, text("an element of ", N, " nodes has fewer in its line; give it all"));
      }
      i = node();
    }
    return e;
  }
  // index of the node whose number comes next; most files number their nodes without gaps
  Index node() {
    const std::int64_t tag = in_.integer("the number of a node");
    const std::uint64_t guess = std::uint64_t(tag) - std::uint64_t(nodes_.front().number);
    if (guess < nodes_.size() && nodes_[guess].number == tag) return nodes_[guess].index;
    const auto at = std::lower_bound(
        nodes_.begin(), nodes_.end(), tag, [](Node const& n, std::int64_t t) { return n.number < t; });
    if (at == nodes_.end() || at->number != tag)
      throw in_.error(text("an element refers to node ",
                           tag,
                           ", but no node has this number; correct the ",
                           "number or add the node"));
    return at->index;
  }

  void total(std::string_view what, std::size_t announced, std::size_t line, std::size_t found) const {
    if (announced == found) return;
    throw in_.error(line,
                    text(announced, " ", what, " are announced, but the blocks hold ", found) +
                        "; correct the number, or get a complete file");
  }
  static bool ends(std::string_view word, std::string const& section) {
    const std::string name = section.substr(1);
    return word == "$End" + name || word == "$END" + name;
  }
  void end(std::string const& section) {
    if (!ends(in_.word(), section)) throw in_.expected(text("the end of section ", section));
  }
  void skip(std::string const& section) {
    for (std::string_view word = in_.word(); !ends(word, section); word = in_.word())
      if (word.empty()) throw in_.expected(text("the end of section ", in_quotes(section)));
  }

  TextReader in_;
  Mesh mesh_{};
  std::vector<Node> nodes_{};  // in the order of their numbers
  int version_ = 1;
  bool hasNodes_ = false, hasElements_ = false;
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE Mesh parse_gmsh(std::string_view path, std::string_view content) {
  Mesh mesh = detail::GmshParser(path, content).parse();
  check_mesh(path, mesh);
  return mesh;
}

SINEW_ONCE Mesh read_gmsh(std::string const& path) { return parse_gmsh(path, read_file(path)); }

}  // namespace sinew::io
#endif
