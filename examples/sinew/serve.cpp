// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#ifdef SINEW_SERVE
#include "opened.hpp"
#include "temporary_folder.hpp"

#include <sinew/view/protocol.hpp>
#include <sinew/view/serve.hpp>

#include <pugixml.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace cli {

namespace {

namespace fs = std::filesystem;
using sinew::text;
using sinew::view::SceneFile;

bool names_file(std::string_view attribute) {
  std::string small(attribute);
  for (char& c : small) c = char(std::tolower(static_cast<unsigned char>(c)));
  return small == "href" || small == "texturename" || small == "materiallibrary" ||
         small.find("file") != small.npos;
}
// whether a path leads from a folder to somewhere below it, and is no link to another field
bool stays_below(std::string_view path) {
  path.remove_prefix(std::min(path.find_first_not_of(" \t\r\n"), path.size()));
  if (path.starts_with('/') || path.starts_with('@') || path.starts_with('~')) return false;
  for (std::size_t at = 0; at <= path.size();) {
    const std::size_t end = std::min(path.find('/', at), path.size());
    if (path.substr(at, end - at).starts_with("..")) return false;
    at = end + 1;
  }
  return true;
}

// Who sends a scene reads no other files of this machine by it than those of --data
void check_reads(std::vector<SceneFile> const& files) {
  struct Walker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& node) override {
      for (auto const& a : node.attributes())
        if (names_file(a.name()) && !stays_below(a.value()))
          throw sinew::Error(
              "",
              text('<',
                   node.name(),
                   ">: ",
                   a.name(),
                   " is '",
                   a.value(),
                   "'; a scene that is dropped here finds its files beside itself or in folders below, and "
                   "is dropped with them"));
      return true;
    }
  } walker;
  for (SceneFile const& file : files) {
    pugi::xml_document document;
    document.load_buffer(file.content.data(),
                         file.content.size());  // data are no XML, and have no attributes
    document.traverse(walker);
  }
}
// ... and writes none
void check_writes(Node& root) {
  sinew::view::for_each_line(root, [](sinew::view::FoundLine const& line) {
    if (!line.info) return;
    for (sinew::FieldInfo const& field : line.info->fields)
      if (field.isInput && !field.isFile && sinew::view::detail::names_file(field) &&
          !field.write(line.component).empty())
        throw sinew::Error(
            line.path,
            text(line.className,
                 ": ",
                 field.name,
                 " names a file that is written; a scene that is dropped here writes none, take "
                 "the component out of it"));
  });
}

sinew::view::OpenedScene open_files(ServeOptions const& options, std::vector<SceneFile> const& dropped) {
  std::string const& name = dropped[sinew::view::scene_among(dropped)].name;
  const std::vector<SceneFile> files = sinew::view::placed(dropped);
  check_reads(files);
  const auto folder = opening([] { return std::make_shared<TemporaryFolder>("scene"); });
  for (SceneFile const& file : files) {
    const fs::path path = folder->path / file.name;
    fs::create_directories(path.parent_path());
    sinew::io::write_file(path.string(), file.content);
  }
  const std::string place = folder->path.string() + '/';
  SceneOptions scene = options.scene;
  scene.path = place + name;
  scene.set.clear();  // of the scene of the command line
  scene.dt = 0;
  scene.missing = sinew::view::missingFile;
  // whoever sent it knows nothing of the folder
  auto plain = [&place](std::string words) {
    for (std::size_t at = words.find(place); at != words.npos; at = words.find(place, at))
      words.erase(at, place.size());
    return words;
  };
  try {
    return opening([&] {
      auto found = read(scene);
      check_writes(found.root);
      SeenOptions seen;
      seen.folders = scene.data;
      seen.folders.push_back(place);
      auto result = opened(start(std::move(found), scene), fs::path(name).filename().string(), folder, seen);
      for (std::string& note : result.notes) note = plain(note);
      return result;
    });
  } catch (sinew::Error const& error) {
    throw sinew::Error("", plain(error.what()));
  }
}

}  // namespace

int serve(ServeOptions const& options) {
  StagedScene staged(load(options.scene), {});
  print_notes(staged.scene.ignored, staged.scene.warnings);
  try {
    sinew::view::serve(
        staged.stage,
        {.title = fs::path(options.scene.path).filename().string(),
         .address = options.address,
         .port = options.port,
         .page = options.page,
         .clients = options.clients,
         .open = [&options](std::vector<SceneFile> const& files) { return open_files(options, files); }});
  } catch (sinew::Error const& error) {
    throw Failure{notWritten, {error.what()}};
  }
  return ok;
}

}  // namespace cli

#else

namespace cli {

int serve(ServeOptions const&) {
  throw Failure{badUsage,
                {"serve: this program was built without a server; install what it needs (Debian: "
                 "nlohmann-json3-dev), configure and build again"}};
}

}  // namespace cli

#endif
