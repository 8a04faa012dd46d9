// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/surface_looks.hpp>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sinew {

/// A surface to look at, whose vertices follow a mapping and take no part in the mechanics.
struct VisualModel {
  using Role = role::VisualModel;
  using DataTypes = Vec3f;
  using VecCoord = Vec3f::VecCoord;
  static constexpr std::string_view className = "VisualModel",
                                    aliases =
                                        "OglModel VisualModelImpl OglTetrahedralModel OglShaderVisualModel";

  Mesh mesh{};  // its positions are those at init
  std::vector<Eigen::Vector2d> texcoords{};
  std::vector<Triangle> textureTriangles{};
  std::vector<Quad> textureQuads{};
  std::string materialNames{};
  std::vector<Index> faceMaterials{};
  std::string materialLibrary{};
  Eigen::Vector2d scaleTex{1, 1}, translationTex{0, 0};

  static constexpr auto fields() {
    using V = VisualModel;
    return field_list(
        field("texcoords",
              &V::texcoords,
              "",
              "places in the texture, whose lower left corner is 0 0 and whose upper right one is 1 1: of "
              "each vertex, or those that textureTriangles and textureQuads number"),
        field("textureTriangles",
              &V::textureTriangles,
              "",
              "texcoords of the corners of each triangle; -1: none"),
        field("textureQuads", &V::textureQuads, "", "texcoords of the corners of each quad; -1: none"),
        field("materialNames", &V::materialNames, "", "materials of the faces, with blanks between"),
        field("faceMaterials",
              &V::faceMaterials,
              "",
              "which of materialNames each triangle has, then each quad; -1: none"),
        field("materialLibrary",
              &V::materialLibrary,
              "",
              "the file (.mtl) that has the materials, which pictures look for"),
        field("scaleTex", &V::scaleTex, "", "texcoords are first times this: the image is repeated so often"),
        field("translationTex", &V::translationTex, "", "and then shifted by this"));
  }

  VecCoord position{};

  std::size_t size() const { return position.size(); }

  /// The mesh with its vertices where they are now.
  Mesh current() const;

  /// How the faces look that there are now, after init.
  SurfaceLooks looks() const;
  void setLooks(SurfaceLooks looks);

  /// What is wrong with the texcoords and materials of the faces, as a sentence; empty where nothing is.
  std::string wrongLooks() const;

  /// Vertices that go take their faces with them.
  void follow(Renumbering const& points);
  /// Vertices come, and these are the faces and edges then. Those that are new have no looks of their own.
  void follow(Renumbering const& points, std::vector<Triangle> const& triangles,
              std::vector<Quad> const& quads, std::vector<Edge> const& edges);
  /// The mesh had these faces before: those that stay keep their looks, others have none.
  void facesWere(std::vector<Triangle> const& triangles, std::vector<Quad> const& quads);

  void init(std::string const& where);
  /// The vertices are where those of the mesh are.
  void takeValues(std::string_view, std::size_t) { place(); }

 private:
  void place() {
    position.clear();
    for (auto const& p : mesh.positions) position.emplace_back(float(p[0]), float(p[1]), float(p[2]));
  }
  bool facesHaveLooks() const {
    return !textureTriangles.empty() || !textureQuads.empty() || !faceMaterials.empty();
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <cstddef>
#include <map>
#include <type_traits>
#include <utility>

namespace sinew {

SINEW_ONCE Mesh VisualModel::current() const {
  Mesh now{.positions = {},
           .edges = mesh.edges,
           .triangles = mesh.triangles,
           .quads = mesh.quads,
           .tetrahedra = mesh.tetrahedra,
           .hexahedra = mesh.hexahedra};
  now.positions.reserve(position.size());
  for (auto const& x : position) now.positions.emplace_back(x[0], x[1], x[2]);
  return now;
}

SINEW_ONCE SurfaceLooks VisualModel::looks() const {
  // vertices that are made while the scene runs have none
  const bool ofVertices =
      textureTriangles.empty() && textureQuads.empty() && texcoords.size() == position.size();
  if (textureTriangles.empty() && textureQuads.empty() && !ofVertices)
    return {.materials = names_of_words(materialNames),
            .faceMaterials = faceMaterials,
            .library = materialLibrary};
  std::vector<Eigen::Vector2d> placed = texcoords;
  for (Eigen::Vector2d& t : placed) t = t.cwiseProduct(scaleTex) + translationTex;
  return {.texcoords = std::move(placed),
          .triangles = ofVertices ? mesh.triangles : textureTriangles,
          .quads = ofVertices ? mesh.quads : textureQuads,
          .materials = names_of_words(materialNames),
          .faceMaterials = faceMaterials,
          .library = materialLibrary};
}
SINEW_ONCE void VisualModel::setLooks(SurfaceLooks looks) {
  texcoords = std::move(looks.texcoords);  // as they are to be
  scaleTex.setOnes();
  translationTex.setZero();
  textureTriangles = std::move(looks.triangles);
  textureQuads = std::move(looks.quads);
  materialNames = words_of_names(looks.materials);
  faceMaterials = std::move(looks.faceMaterials);
  materialLibrary = std::move(looks.library);
}

SINEW_ONCE std::string VisualModel::wrongLooks() const {
  for (Eigen::Vector2d const& t : texcoords)
    if (!t.allFinite()) return "texcoords has a number that is not finite; correct it";
  if (!scaleTex.allFinite()) return "scaleTex has a number that is not finite; correct it";
  if (!translationTex.allFinite()) return "translationTex has a number that is not finite; correct it";
  const bool ofVertices = textureTriangles.empty() && textureQuads.empty();
  if (ofVertices && !texcoords.empty() && texcoords.size() != mesh.positions.size())
    return text("texcoords has ",
                texcoords.size(),
                " entries for ",
                mesh.positions.size(),
                " vertices; give one for each, or textureTriangles and textureQuads");
  if (std::string wrong = detail::looks_mismatch(
          "textureTriangles", textureTriangles, mesh.triangles.size(), texcoords.size());
      !wrong.empty())
    return wrong;
  if (std::string wrong =
          detail::looks_mismatch("textureQuads", textureQuads, mesh.quads.size(), texcoords.size());
      !wrong.empty())
    return wrong;
  const std::size_t faces = mesh.triangles.size() + mesh.quads.size();
  if (!faceMaterials.empty() && faceMaterials.size() != faces)
    return text(
        "faceMaterials has ", faceMaterials.size(), " entries for ", faces, " faces; give one for each");
  const std::size_t names = names_of_words(materialNames).size();
  for (const Index i : faceMaterials)
    if (i < -1 || i >= Index(names))
      return text("faceMaterials has the number ",
                  i,
                  ", and there are ",
                  names,
                  " materialNames, numbered from 0; correct it, or give -1 for none");
  return {};
}

SINEW_ONCE void VisualModel::follow(Renumbering const& points) {
  points.filter(mesh.positions);
  if (textureTriangles.empty() && textureQuads.empty()) points.filter(texcoords);
  const auto triangles = facesHaveLooks() ? mesh.triangles : std::vector<Triangle>{};
  const auto quads = facesHaveLooks() ? mesh.quads : std::vector<Quad>{};
  auto eachFace = [&](auto&& act) {
    act(mesh.edges), act(mesh.triangles), act(mesh.quads), act(mesh.tetrahedra), act(mesh.hexahedra);
  };
  eachFace([&](auto& list) {
    std::erase_if(list, [&](auto const& face) {
      return std::any_of(face.begin(), face.end(), [&](Index i) { return !points.stays(i); });
    });
  });
  facesWere(triangles, quads);
  eachFace([&](auto& list) {
    for (auto& face : list)
      for (Index& i : face) points.renumber(i);
  });
}

SINEW_ONCE void VisualModel::follow(Renumbering const& points, std::vector<Triangle> const& triangles,
                                    std::vector<Quad> const& quads, std::vector<Edge> const& edges) {
  const std::size_t before = mesh.positions.size();
  points.filter(mesh.positions);
  if (textureTriangles.empty() && textureQuads.empty() && texcoords.size() == before)
    points.filter(texcoords);
  const auto were = std::exchange(mesh.triangles, triangles);
  const auto quadsWere = std::exchange(mesh.quads, quads);
  mesh.edges = edges;
  facesWere(were, quadsWere);
}

SINEW_ONCE void VisualModel::facesWere(std::vector<Triangle> const& triangles,
                                       std::vector<Quad> const& quads) {
  if (!facesHaveLooks()) return;
  std::vector<Index> materials;
  auto sort = [&](auto const& faces, auto const& before, auto& corners, std::size_t first) {
    std::map<typename std::decay_t<decltype(faces)>::value_type, std::size_t> known;
    for (std::size_t f = 0; f < before.size(); ++f) known.emplace(before[f], f);
    std::decay_t<decltype(corners)> now;
    for (auto const& face : faces) {
      const auto found = known.find(face);
      auto none = face;
      none.fill(-1);
      if (!corners.empty()) now.push_back(found == known.end() ? none : corners[found->second]);
      if (!faceMaterials.empty())
        materials.push_back(found == known.end() ? -1 : faceMaterials[first + found->second]);
    }
    corners = std::move(now);
  };
  sort(mesh.triangles, triangles, textureTriangles, 0);
  sort(mesh.quads, quads, textureQuads, triangles.size());
  faceMaterials = std::move(materials);
}

SINEW_ONCE void VisualModel::init(std::string const& where) {
  check_mesh(text(where, ": VisualModel"), mesh);
  if (const std::string wrong = wrongLooks(); !wrong.empty())
    throw Error(text(where, ": VisualModel"), wrong);
  place();
}

}  // namespace sinew
#endif
