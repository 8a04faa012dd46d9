// SPDX-License-Identifier: BSL-1.0
// Sinew in a page: the worker calls these functions, the same for each module. A stage without a thread does
// what it is told, and what it has to say waits as messages of view/protocol.hpp.
#include "running.hpp"

#include <sinew/view/protocol.hpp>

#include <emscripten.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace {

using namespace sinew;

struct Message {
  std::string bytes;
  bool binary;
};
std::deque<Message> messages;  // to be sent
Message sent;
void say(std::string json) { messages.push_back({std::move(json), false}); }

struct Shown {
  page::Running scene;
  view::SceneWriter writer{};
  view::Stage::Scene seen{};
  std::uint32_t topology = 0, textures = 0;
  std::string state{};

  void look() {
    if (view::Stage::Scene latest = scene.stage->scene(); latest != seen) {
      seen = std::move(latest);
      writer.write(*seen);
      if (std::exchange(textures, writer.texturesNumber()) != writer.texturesNumber())
        messages.push_back({writer.textures(), true});
      if (std::exchange(topology, writer.number()) != writer.number())
        messages.push_back({writer.topology(), true});
      messages.push_back({writer.frame(), true});
    }
    if (std::string json = view::write_state(scene.stage->state(), *seen); json != state)
      say(state = std::move(json));
  }
};
std::unique_ptr<Shown> shown;

}  // namespace

extern "C" {

/// Starts what the module knows by these bytes. False where it does not start; the message says why.
EMSCRIPTEN_KEEPALIVE bool sinew_start(char const* bytes, std::size_t size) try {
  shown = std::make_unique<Shown>(Shown{page::run({bytes, size})});
  say(view::write_scene(shown->scene.name, shown->scene.stage->dt(), shown->scene.stage->tree));
  shown->look();
  if (!shown->scene.notes.empty()) say(view::write_error(shown->scene.notes));
  return true;
} catch (std::exception const& error) {
  say(view::write_error(error.what()));
  return false;
}

EMSCRIPTEN_KEEPALIVE void sinew_command(char const* bytes, std::size_t size) try {
  view::tell(*shown->scene.stage, view::read_command({bytes, size}), say);
} catch (std::exception const& error) {
  say(view::write_error(error.what()));
}

/// Works for some milliseconds and looks at the scene; what follows in how many milliseconds there is more to
/// do, and below 0 where that is so only after the next command.
EMSCRIPTEN_KEEPALIVE double sinew_turn(double milliseconds) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  bool playing = false, works = true;
  while (works) {
    const long before = shown->scene.stage->state().step;
    shown->scene.stage->turn();
    const view::StageState now = shown->scene.stage->state();
    playing = now.playing;
    works = playing && now.step != before &&
            std::chrono::duration<double, std::milli>(Clock::now() - begin).count() < milliseconds;
  }
  shown->look();
  if (!playing) return -1;
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count() < milliseconds ? 4 : 0;
}

/// The next message, or null; its length, and whether it is no text.
EMSCRIPTEN_KEEPALIVE char const* sinew_message() {
  if (messages.empty()) return nullptr;
  sent = std::move(messages.front());
  messages.pop_front();
  return sent.bytes.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t sinew_message_size() { return sent.bytes.size(); }
EMSCRIPTEN_KEEPALIVE bool sinew_message_is_binary() { return sent.binary; }
}
