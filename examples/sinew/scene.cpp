// SPDX-License-Identifier: BSL-1.0
#include "scene.hpp"

#include <sinew/core/memory_limit.hpp>

#include <sys/resource.h>

#include <csignal>
#include <fstream>

namespace cli {

using sinew::text;

namespace {

volatile std::sig_atomic_t pressed = 0;

void count_below(Node const& node, Count& count) {
  ++count.nodes;
  for (auto const& entry : node.components()) {
    count.components += !entry.component.is<sinew::role::Context, sinew::role::Execution>();
    if (!node.mapping())
      entry.component.visit<sinew::role::State>([&](auto const& state) {
        count.degreesOfFreedom += state.size() * std::decay_t<decltype(state)>::DataTypes::size;
      });
  }
  for (auto const& child : node.children()) count_below(*child, count);
}

// whether a message begins with "file:line:column: "
bool has_place(std::string_view message) {
  auto number = [&](std::size_t from) {
    const std::size_t end = message.find_first_not_of("0123456789", from);
    return end != message.npos && end > from && message[end] == ':' ? end + 1 : message.npos;
  };
  for (std::size_t colon = message.find(':'); colon != message.npos; colon = message.find(':', colon + 1))
    if (const std::size_t line = number(colon + 1); line != message.npos)
      if (number(line) != message.npos) return true;
  return false;
}

#if defined(__SANITIZE_ADDRESS__)
void limit_allocations(std::size_t, int) {}  // its shadow is larger than any machine
#else
// Memory that is free without swapping [bytes]; 0 where it is not known.
std::size_t free_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  std::size_t kilobytes = 0;
  while (file >> name >> kilobytes && std::getline(file, unit))
    if (name == "MemAvailable:") return kilobytes * 1024;
  return 0;
}

// what is asked for beyond that fails at once, and does not make the machine swap
void limit_allocations(std::size_t asked, int processes) {
  const std::size_t bytes = asked > 0 ? asked : free_memory() / std::size_t(processes);
  if (bytes == 0) return;
  rlimit limit{};
  if (getrlimit(RLIMIT_DATA, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, bytes);
  setrlimit(RLIMIT_DATA, &limit);
}
#endif

void limit_memory(std::size_t asked, int processes) {
  sinew::memory_limit = asked > 0 ? asked : std::size_t(512) << 20;
  // once: what the scenes that are there have taken is free no more
  static bool limited = false;
  if (!std::exchange(limited, true)) limit_allocations(asked, processes);
}

}  // namespace

std::string Count::words() const {
  auto amount = [](std::size_t n, std::string_view one, std::string_view many) {
    return text(n, ' ', n == 1 ? one : many);
  };
  return text(amount(nodes, "node", "nodes"),
              ", ",
              amount(components, "component", "components"),
              ", ",
              amount(degreesOfFreedom, "degree of freedom", "degrees of freedom"));
}

Count count(Node const& top) {
  Count count;
  count_below(top, count);
  return count;
}

void use_threads(Node& node, int count) {
  bool found = node.parent() != nullptr;
  for (auto& entry : node.components())
    if (auto* threads = entry.component.getIf<sinew::Threads>()) threads->count = count, found = true;
  if (!found) node.add(sinew::Threads{.count = count});
  for (auto const& child : node.children()) use_threads(*child, count);
}

std::string located(std::string const& path, std::string const& message) {
  return has_place(message) || message.starts_with(path + ':') ? message : text(path, ": ", message);
}

sinew::ReadScene<sinew::Standard> read(SceneOptions const& options) {
  limit_memory(options.maxMemory, options.processes);
  try {
    auto scene = sinew::read_scene<sinew::Standard>(
        options.path, {options.data, options.lenient, options.set, options.missing});
    if (options.dt > 0) scene.dt = options.dt;
    return scene;
  } catch (sinew::SceneError const& error) {
    // a path of --set that leads nowhere is no mistake of the scene
    const bool isUsage = !error.messages.empty() && error.messages[0].starts_with("--set");
    Failure failure{isUsage ? badUsage : badScene, error.messages};
    if (!isUsage)
      for (auto& message : failure.messages) message = located(options.path, message);
    throw failure;
  }
}

Scene start(sinew::ReadScene<sinew::Standard> scene, SceneOptions const& options) {
  try {
    const double dt = scene.dt;
    auto ignored = std::move(scene.ignored), warnings = std::move(scene.warnings);
    Scene started{sinew::start(std::move(scene)), dt, std::move(ignored), std::move(warnings), options.path};
    for (auto const& warning : started.simulation.root().warnings)
      started.warnings.push_back(located(options.path, warning));
    return started;
  } catch (sinew::Error const& error) {
    throw Failure{badScene, {located(options.path, error.what())}};
  }
}

Scene load(SceneOptions const& options) { return start(read(options), options); }

void Scene::animate() {
  try {
    simulation.animate(dt);
  } catch (sinew::Error const& error) {
    throw Failure{diverged, {located(path, error.what())}};
  }
}

void print_notes(std::vector<std::string> const& ignored, std::vector<std::string> const& warnings) {
  std::string all;
  for (auto const& name : ignored) all += text(all.empty() ? "" : ", ", name);
  if (!all.empty()) std::fprintf(stderr, "ignored, without a meaning here: %s\n", all.c_str());
  for (auto const& warning : warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

long steps_of(Duration const& duration, double dt) {
  if (duration.time == 0) return duration.steps;
  const double steps = duration.time / dt;
  if (!(steps < 1e12))
    throw Failure{
        badUsage,
        {text("--time: ", duration.time, " s in steps of ", dt, " s are too many steps; take a larger dt")}};
  return std::max(1L, std::lround(steps));
}

void catch_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { pressed = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}
bool was_interrupted() { return pressed != 0; }

}  // namespace cli
