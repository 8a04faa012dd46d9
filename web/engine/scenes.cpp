// SPDX-License-Identifier: BSL-1.0
// The module of scene files, which are dropped onto the page with what they need.
#include "registry.hpp"
#include "running.hpp"

#include <sinew/core/memory_limit.hpp>
#include <sinew/runtime/checks.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/scope.hpp>
#include <sinew/view/load_materials.hpp>
#include <sinew/view/protocol.hpp>
#include <sinew/view/view_settings.hpp>

#include <filesystem>

namespace {

namespace fs = std::filesystem;
using namespace sinew;

// a step has the same bits with any number of threads, and WebAssembly has one
void take_one_thread(RuntimeNode<page::Components>& node) {
  if (auto* threads = node.get<Threads>()) threads->count = 1;
  for (auto const& child : node.children()) take_one_thread(*child);
}

void add_line(std::string& to, std::string const& line) { to += text(to.empty() ? "" : "\n", line); }

}  // namespace

page::Running page::run(std::string_view bytes) {
  memory_limit = std::size_t(512) << 20;
  const std::vector<view::SceneFile> dropped = view::read_upload(bytes);
  std::string const& name = dropped[view::scene_among(dropped)].name;
  // in memory: there is no other file system
  for (view::SceneFile const& file : view::placed(dropped)) {
    if (const fs::path folder = fs::path(file.name).parent_path(); !folder.empty())
      fs::create_directories(folder);
    io::write_file(file.name, file.content);
  }
  auto read = read_scene<Components>(name, {.missing = view::missingFile});
  const double dt = read.dt;
  take_one_thread(read.root);
  std::string notes, ignored;
  for (auto const& one : read.ignored) ignored += text(ignored.empty() ? "" : ", ", one);
  if (!ignored.empty()) add_line(notes, "ignored, without a meaning here: " + ignored);
  for (auto const& warning : read.warnings) add_line(notes, "warning: " + warning);
  auto simulation = std::make_shared<Simulation<RuntimeNode<Components>>>(start(std::move(read)));
  for (auto const& warning : simulation->root().warnings) add_line(notes, "warning: " + warning);
  view::ViewSettings settings = view::view_settings(simulation->root().view);
  view::load_materials(*simulation, settings.seen, settings.warnings);
  for (auto const& warning : settings.warnings) add_line(notes, "warning: " + warning);
  Running scene = running(fs::path(name).filename().string(), std::move(simulation), dt, settings.seen);
  scene.notes = std::move(notes);
  return scene;
}
