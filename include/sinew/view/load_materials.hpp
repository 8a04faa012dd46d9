// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/roles/visual_model.hpp>
#include <sinew/io/read_mtl.hpp>
#include <sinew/scene/path.hpp>
#include <sinew/view/read_texture.hpp>
#include <sinew/view/seen_settings.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

namespace detail {

// Files are read once. What is wrong with one is said once, by what needs it.
class MaterialFiles {
 public:
  MaterialFiles(std::vector<std::string>& warnings, std::vector<std::string> const& folders)
      : warnings_(warnings) {
    for (std::string const& folder : folders) {
      const std::filesystem::path whole = std::filesystem::weakly_canonical(folder);
      folders_.push_back(whole.has_filename() ? whole : whole.parent_path());  // without a slash at its end
    }
  }

  std::shared_ptr<SeenTexture const> texture(std::string const& path, std::string const& by) {
    const auto [found, isNew] = textures_.try_emplace(path);
    if (isNew) try {
        check(path);
        found->second = std::make_shared<SeenTexture const>(read_texture(path));
      } catch (Error const& error) {
        warnings_.push_back(text(by, ": the texture ", error.what(), "; it is left out"));
      }
    return found->second;
  }
  // all materials of a library
  std::vector<SeenMaterial> materials(std::string const& library, std::string const& by) {
    std::vector<SeenMaterial> all;
    try {
      check(library);
      for (io::Material const& m : io::read_mtl(library)) {
        SeenMaterial material{.library = library,
                              .name = m.name,
                              .colour = m.diffuse,
                              .specular = m.specular,
                              .shininess = std::max(m.shininess, 1.),
                              .opacity = m.opacity};
        if (!m.texture.empty()) material.texture = texture(m.texture, text(by, ": ", m.name));
        all.push_back(std::move(material));
      }
    } catch (Error const& error) {
      warnings_.push_back(text(by, ": the materials of its faces: ", error.what(), "; they are left out"));
    }
    return all;
  }

 private:
  std::vector<std::string>& warnings_;
  std::vector<std::filesystem::path> folders_{};

  void check(std::string const& file) const {
    if (folders_.empty()) return;
    const std::filesystem::path whole = std::filesystem::weakly_canonical(file);
    for (auto const& folder : folders_)
      if (std::mismatch(folder.begin(), folder.end(), whole.begin(), whole.end()).first == folder.end())
        return;
    throw Error(file, "this file is elsewhere than those of the scene; put it beside them");
  }
  std::map<std::string, std::shared_ptr<SeenTexture const>> textures_{};
};

}  // namespace detail

/// Reads the textures that settings name, and the materials and textures of those that the visual models of a
/// simulation name. What is missing or wrong is a warning, and is left out. Where folders are given, no files
/// are read that are elsewhere than below one of them.
template <class Simulation>
void load_materials(Simulation& simulation, SeenSettings& seen, std::vector<std::string>& warnings,
                    std::vector<std::string> const& folders = {}) {
  detail::MaterialFiles files(warnings, folders);
  std::set<std::string> placed;  // paths of what has places in a texture
  std::set<std::string> libraries;
  seen.materials.clear();
  simulation.template visit<role::VisualModel>([&](auto const& visual, auto const& scope) {
    if constexpr (requires { visual.looks(); }) {
      if (!visual.texcoords.empty()) placed.insert(scope.path());
      if (visual.faceMaterials.empty()) return;
      std::string const& library = visual.materialLibrary;
      if (library.empty()) return;
      if (libraries.insert(library).second) {
        auto all = files.materials(library, scope.path());
        std::move(all.begin(), all.end(), std::back_inserter(seen.materials));
      }
      const bool any = std::any_of(seen.materials.begin(), seen.materials.end(), [&](SeenMaterial const& m) {
        return m.library == library;
      });
      for (std::string const& name : names_of_words(visual.materialNames))
        if (any && std::none_of(seen.materials.begin(), seen.materials.end(), [&](SeenMaterial const& m) {
              return m.library == library && m.name == name;
            }))
          warnings.push_back(
              text(scope.path(), ": ", library, " has no material '", name, "' for its faces; add it there"));
    }
  });
  for (BodyLook& look : seen.looks) {
    if (look.image.empty()) continue;
    look.texture = files.texture(look.image, look.origin.empty() ? look.path : look.origin);
    if (look.texture && !placed.count(look.path))
      warnings.push_back(text(look.origin.empty() ? look.path : look.origin,
                              ": ",
                              look.path,
                              " has no texcoords for its texture, which is not seen; take a mesh that has "
                              "them (lines \"vt\" of a file OBJ), or give one for each vertex"));
  }
}

}  // namespace sinew::view
