// SPDX-License-Identifier: BSL-1.0
// Runs a scene file over the DataTypes of a device: sinew_cuda SCENE [--steps N] [--dt S] [--record FILE]
// [--save FILE]. Where nothing says how long, 100 steps.
#include <sinew/gpu/scenes.hpp>
#include <sinew/runtime/record.hpp>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

namespace {

struct Wishes {
  std::string scene{}, record{}, save{};
  long steps = 100;
  double dt = 0;
};

Wishes wishes(int argc, char** argv) {
  using sinew::read_value;
  Wishes w;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--")) {
      w.scene = word;
      continue;
    }
    if (i + 1 == argc) throw sinew::Error(word, "ends where a value is expected; give one");
    const std::string value = argv[++i];
    int steps = 0;
    if (word == "--steps")
      read_value(value, steps), w.steps = steps;
    else if (word == "--dt")
      read_value(value, w.dt);
    else if (word == "--record")
      w.record = value;
    else if (word == "--save")
      w.save = value;
    else
      throw sinew::Error(word, "is not known; there are --steps, --dt, --record and --save");
  }
  if (w.scene.empty())
    throw sinew::Error("usage", "sinew_cuda SCENE [--steps N] [--dt S] [--record FILE] [--save FILE]");
  return w;
}

}  // namespace

int main(int argc, char** argv) try {
  const Wishes w = wishes(argc, argv);
  auto read = sinew::read_scene<sinew::CudaScenes>(w.scene, {});
  for (auto const& warning : read.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
  const double dt = w.dt > 0 ? w.dt : read.dt;
  auto sim = sinew::start(std::move(read));
  std::optional<sinew::RecordWriter> record;
  if (!w.record.empty()) record.emplace(w.record);
  auto add = [&] {
    if (record) record->add(sinew::capture(sim.root(), sim.step(), sim.time()));
  };
  add();
  const auto begin = std::chrono::steady_clock::now();
  for (long i = 0; i < w.steps; ++i) sim.animate(dt), add();
  sinew::gpu::wait();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (record) record->finish();
  if (!w.save.empty()) sinew::save_scene(sim, dt, w.save);
  std::printf("%s: %ld steps of %g s in %.3f s, %.0f steps a second\n",
              w.scene.c_str(),
              w.steps,
              dt,
              seconds,
              double(w.steps) / seconds);
  return 0;
} catch (sinew::Error const& error) {
  std::fprintf(stderr, "sinew_cuda: %s\n", error.what());
  return 1;
}
