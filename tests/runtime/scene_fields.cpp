// SPDX-License-Identifier: BSL-1.0
#include "same_bits.hpp"

#include <sinew/runtime/precompiled.hpp>
#include <sinew/view/fields.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace test_scene_fields {

using namespace sinew;

std::vector<std::string> scenes() {
  std::vector<std::string> all;
  for (auto const& file : std::filesystem::directory_iterator(SINEW_EXAMPLE_SCENES))
    if (file.path().extension() == ".scn") all.push_back(file.path().string());
  std::sort(all.begin(), all.end());
  return all;
}

TEST_CASE("every field of every scene of the examples has a value that it takes, and outlives wrong ones",
          "[long]") {
  long seen = 0, set = 0, wrong = 0;
  for (std::string const& path : scenes()) {
    INFO(path);
#ifndef SINEW_CCD
    if (path.ends_with("hulls.scn") || path.ends_with("boxes.scn")) continue;
#endif
    auto sim = start(read_scene<Standard>(path));
    sim.animate(0.001);
    const auto tree = view::scene_tree(sim);
    for (int line = 0; line < int(tree.size()); ++line) {
      if (tree[std::size_t(line)].className.empty()) {
        CHECK_THROWS_AS(view::seen_component(sim, line), Error);
        continue;
      }
      for (view::SeenField const& field : view::seen_component(sim, line).fields) {
        INFO(tree[std::size_t(line)].className << "." << field.name);
        const std::string words = view::field_text(sim, line, field.name);
        ++seen;
        if (!field.fixed.empty()) {
          CHECK_THROWS_AS(view::set_field(sim, line, field.name, words), Error);
          continue;
        }
        const view::FieldChange change = view::set_field(sim, line, field.name, words);
        CHECK(change.before == change.after);
        CHECK(view::field_text(sim, line, field.name) == words);
        ++set;
        for (std::string_view bad : {"nan", "0 0 0"}) {
          auto copy = sim;
          try {
            view::set_field(copy, line, field.name, bad);
            copy.animate(0.001);
          } catch (Error const&) {
            ++wrong;
          }
        }
      }
    }
    sim.animate(0.001);
  }
  CHECK(seen > 8000);
  CHECK(set > 4000);
  CHECK(wrong > 4000);
}

}  // namespace test_scene_fields
