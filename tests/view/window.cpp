// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "view/triangle.hpp"

#include <sinew/contact.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/window.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace test_window {

using namespace sinew;

auto triangle() {
  return Simulation{node<"root">(
      EulerExplicitSolver{},
      node<"body">(MeshTopology{.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}},
                   MechanicalObject<Vec3d>{},
                   UniformMass<Vec3d>{}))};
}

TEST_CASE("a window shows the scene beside its panel, and goes on while a simulation runs") {
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.001);
  if (!std::getenv("DISPLAY")) {
    const std::string wrong = error_of([&] { view::Window window(stage); });
    CHECK(wrong.starts_with("view: there is no display to open a window on"));
    CHECK(wrong.ends_with("(sinew run --png)"));
    return;
  }
  view::Window window(stage, {.width = 800, .height = 600});
  window.frame();
  view::Image image = window.image();
  REQUIRE(image.width == 800);
  REQUIRE(image.height == 600);
  // the middle of the triangle, and a place that has nothing
  const Eigen::Vector3d at = window.controls().camera.project({1. / 3, 1. / 3, 0}, 800 - 340, 600);
  const auto face = image.at(340 + int(at[0]), int(at[1]));
  CHECK(face[0] > face[2] + 50);  // orange
  const auto beside = image.at(798, 2);
  CHECK(beside == std::array<unsigned char, 3>{255, 255, 255});
  CHECK(image.at(2, 598) != beside);  // the panel
  // a component is selected, and has its fields in the panel; its mass is changed, and that is taken back
  const auto without = window.image();
  window.scenePanel().select(5);
  stage.setField(5, "totalMass", "4");
  stage.settle();
  window.frame();
  const auto with = window.image();
  REQUIRE(stage.state().selected);
  CHECK(stage.state().selected->className == "UniformMass<Vec3d>");
  int changed = 0;
  for (int y = 300; y < 600; ++y)
    for (int x = 0; x < 340; ++x) changed += without.at(x, y) != with.at(x, y);
  CHECK(changed > 500);
  stage.undo();
  stage.settle();
  CHECK(stage.state().redo->after == "4");
  // what is shown, without the colour of the body
  view::SeenSettings settings;
  settings.looks = {{.path = "/root/body", .visible = false}};
  window.showPanel().set(settings);
  stage.settle();
  window.frame();
  CHECK(window.image().at(340 + int(at[0]), int(at[1])) == std::array<unsigned char, 3>{255, 255, 255});
  window.showPanel().set({});
  // each part of the panel is another one
  stage.measure(true);
  stage.step();
  stage.settle();
  view::Image last = window.image();
  for (char const* part : {"Show", "Tools", "Plots", "Scene"}) {
    window.turnTo(part);
    window.frame();
    view::Image now = window.image();
    CHECK(now.rgb != last.rgb);
    last = std::move(now);
  }
  window.controls().lookAlong(1);
  CHECK(window.controls().camera.right().allFinite());
  stage.play(true);
  while (stage.state().step < 10) window.frame();
  stage.play(false);
  stage.settle();
  CHECK(stage.state().error.empty());
}

// a user who moves the pointer, presses its left button, and types
struct User {
  view::Window& window;
  ImVec2 at{-1, -1};
  bool down = false, typing = false;

  explicit User(view::Window& w) : window(w) {
    window.input = [this](ImGuiIO& io) {
      io.MousePos = at;
      io.MouseDown[0] = down;
      typing = io.WantTextInput;
    };
  }
  ~User() { window.input = {}; }
  void moveTo(double x, double y) {
    at = {float(x), float(y)};
    window.frame();
  }
  void click(double x, double y) {
    moveTo(x, y);
    down = true;
    window.frame();
    down = false;
    window.frame();
    window.frame();
  }
  void type(std::string const& words) {
    for (const char c : words) {
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
      window.frame();
    }
  }
  void key(int which, bool ctrl = false) {
    for (const bool on : {true, false}) {
      auto before = window.input;
      window.input = [=](ImGuiIO& io) {
        before(io);
        io.KeysDown[which] = on;
        io.KeyCtrl = on && ctrl;
        io.KeyMods = io.KeyCtrl ? ImGuiKeyModFlags_Ctrl : ImGuiKeyModFlags_None;
      };
      window.frame();
      window.input = before;
    }
    window.frame();
  }
};

TEST_CASE("a user clicks on play, on a component and a body, and types a value into a field") {
  if (!std::getenv("DISPLAY")) return;
  auto sim = test_view::triangle();
  sim.init();
  view::Stage stage(sim, 0.001);
  constexpr int width = 900, height = 700, panel = 340;
  view::Window window(stage, {.width = width, .height = height});
  User user(window);
  window.frame();
  // the first button of the panel lets it go and stops it
  user.click(30, 18);
  stage.settle();
  CHECK(stage.state().playing);
  user.click(30, 18);
  stage.settle();
  CHECK(!stage.state().playing);
  // a component is somewhere in the tree
  int mass = -1;
  for (std::size_t i = 0; i < stage.tree.size(); ++i)
    if (stage.tree[i].className == "UniformMass<Vec3d>") mass = int(i);
  REQUIRE(mass > 0);
  // from below, since a click on a node closes what is below it
  int y = height;
  while (y > 0 && window.scenePanel().selected() != mass) user.click(120, y -= 5);
  REQUIRE(window.scenePanel().selected() == mass);
  stage.settle();
  window.frame();
  window.frame();
  REQUIRE(stage.state().selected);
  // and its fields below: totalMass takes what is typed, and has it when Enter is pressed
  y = height;
  for (bool found = false; !found;) {
    user.typing = false;
    user.click(270, y -= 5);
    REQUIRE(y > 0);
    if (!user.typing) continue;
    user.key(GLFW_KEY_A, true);
    user.type("7.5");
    CHECK(!stage.state().undo);  // not before it is entered
    user.key(GLFW_KEY_ENTER);
    stage.settle();
    auto const change = stage.state().undo;
    found = change && change->field == "totalMass" && change->after == "7.5";
    if (change && !found) stage.undo();
    stage.settle();
  }
  CHECK(view::field_text(sim, mass, "totalMass") == "7.5");
  // a value that is none is refused, and said
  user.click(270, y);
  user.key(GLFW_KEY_A, true);
  user.type("-1");
  user.key(GLFW_KEY_ENTER);
  stage.settle();
  CHECK(stage.state().error.find("totalMass") != std::string::npos);
  CHECK(view::field_text(sim, mass, "totalMass") == "7.5");
  // the body is pulled by the pointer: the spring's force, and its motion
  const Eigen::Vector3d middle = window.controls().camera.project({0.3, 0.3, 0}, width - panel, height);
  user.moveTo(panel + middle[0], middle[1]);
  user.down = true;
  window.frame();
  stage.settle();
  REQUIRE(stage.state().held);
  CHECK((stage.state().held->point - Eigen::Vector3d(0.3, 0.3, 0)).norm() < 0.01);
  user.moveTo(panel + middle[0] + 60, middle[1]);
  for (int k = 0; k < 20; ++k) stage.step();
  stage.settle();
  window.frame();
  REQUIRE(stage.state().held);
  const Eigen::Vector3d right = window.controls().camera.right();
  CHECK(stage.state().held->force.dot(right) > 1);
  CHECK(Eigen::Vector3d(sim.at<"body">().state().position[0]).dot(right) > 1e-4);
  user.down = false;
  window.frame();
  stage.settle();
  CHECK(!stage.state().held);
}

TEST_CASE("a window opens another scene in the place of that which is seen") {
  if (!std::getenv("DISPLAY")) return;
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.001);
  auto open = [](std::string const& path) -> view::OpenedScene {
    if (path != "other") throw Error("", text("there is no file ", path));
    struct Kept {
      decltype(triangle()) simulation = triangle();
      std::optional<view::Stage> stage{};
    };
    auto kept = std::make_shared<Kept>();
    kept->simulation.init();
    kept->stage.emplace(kept->simulation, 0.25);
    return {.stage = std::shared_ptr<view::Stage>(kept, &*kept->stage),
            .title = path,
            .camera = view::Camera{.target = {5, 0, 0}},
            .notes = {"warning: it is another one"}};
  };
  view::Window window(stage, {.width = 800, .height = 600, .open = open});
  auto wait = [&] {
    for (int k = 0; k < 1000 && window.message().empty(); ++k) window.frame();
  };
  stage.play(true);
  window.scenePanel().select(5);
  window.open("nothing");
  wait();
  CHECK(window.message() == "there is no file nothing");
  CHECK(&window.stage() == &stage);
  // that which is there goes on meanwhile, and stands when it is seen no more
  stage.settle();
  CHECK(stage.state().playing);
  window.open("other");
  wait();
  CHECK(window.message() == "warning: it is another one");
  CHECK(&window.stage() != &stage);
  CHECK(window.stage().dt() == 0.25);
  CHECK(window.controls().camera.target == Eigen::Vector3d(5, 0, 0));
  CHECK(window.scenePanel().selected() == -1);
  stage.settle();
  CHECK(!stage.state().playing);
  window.stage().step();
  window.stage().settle();
  window.frame();
  CHECK(window.stage().state().time == 0.25);
  // once more, which lets the last one go; and one that cannot open any says so
  window.open("other");
  wait();
  CHECK(window.stage().state().time == 0);
  for (char const* part : {"Show", "Tools", "Plots", "Scene"}) {
    window.turnTo(part);
    window.frame();
  }
}

TEST_CASE("a window draws what has changed, and what stands no more than that") {
  if (!std::getenv("DISPLAY")) return;
  auto sim = triangle();
  sim.init();
  view::Stage stage(sim, 0.001);
  view::Window window(stage, {.width = 800, .height = 600});
  window.input = [](ImGuiIO& io) { io.MousePos = {700, 10}; };
  for (int k = 0; k < 200; ++k) window.frame();
  // some pictures at first, and those with another number of pictures a second in the panel
  CHECK(window.drawn() > 1);
  CHECK(window.drawn() < 190);
  // a step, another camera, and another panel are new pictures
  auto draws = [&](auto&& act) {
    const long before = window.drawn();
    act();
    stage.settle();
    window.frame();
    window.frame();
    return window.drawn() > before;
  };
  CHECK(draws([&] { stage.step(); }));
  CHECK(draws([&] { window.controls().lookAlong(1); }));
  CHECK(draws([&] { window.turnTo("Tools"); }));
  // edges of what stands are smooth: pixels of the triangle's outline have neither its colour nor white
  window.controls().home();
  for (int k = 0; k < 3; ++k) window.frame();
  const view::Image image = window.image();
  int between = 0;
  for (int y = 0; y < 600; ++y)
    for (int x = 341; x < 800; ++x) {
      const auto pixel = image.at(x, y);
      between += pixel[2] > 110 && pixel[2] < 250;
    }
  CHECK(between > 40);
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}
double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A measurement, which fails nothing and says its numbers:
//   xvfb-run -a -s "-screen 0 1280x800x24 -noreset" test_window "[.speed]"
TEST_CASE("frame time at 1e5 triangles", "[.speed]") {
  if (!std::getenv("DISPLAY")) return;
  Mesh sheet;
  constexpr Index n = 224;
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j)
      sheet.positions.push_back(
          {double(i) / n, 0.05 * std::sin(0.1 * double(i)) * std::cos(0.1 * double(j)), double(j) / n});
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + n + 1;
      sheet.triangles.push_back({a, a + 1, b + 1});
      sheet.triangles.push_back({a, b + 1, b});
    }
  Simulation sim{
      node<"root">(Gravity{{0, -0.01, 0}},
                   EulerExplicitSolver{},
                   node<"sheet">(MechanicalObject<Vec3d>{sheet.positions},
                                 UniformMass<Vec3d>{},
                                 node<"skin">(VisualModel{.mesh = sheet}, IdentityMapping<Vec3d, Vec3f>{})))};
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  view::Window window(stage);
  // nothing changes; the picture alone; what is seen is made and brought to the card again for each picture
  for (std::string const what : {"stands", "is turned", "moves"}) {
    std::vector<double> times;
    for (int k = 0; k < 60; ++k) {
      if (what == "moves") {
        stage.step();
        stage.settle();
      }
      if (what == "is turned") window.controls().camera.orbit(0.01, 0);
      const double start = seconds_now();
      window.frame();
      times.push_back(1e3 * (seconds_now() - start));
    }
    std::printf("a scene of %zu triangles %s: %.1f ms a frame (median), %.1f ms (least)\n",
                sheet.triangles.size(),
                what.c_str(),
                median_of(times),
                *std::min_element(times.begin(), times.end()));
  }
}

// a block of 1,764 tetrahedra that hangs, with 25 iterations a step
auto hanging_block() {
  const Mesh mesh = regular_grid_tetrahedra(7, 8, 8, {0, 0, 0}, {1, 1, 1});
  return Simulation{node<"root">(
      Gravity{{0, -10, 0}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 25, .tolerance = 1e-20, .threshold = 1e-30},
      node<"block">(TetrahedronTopology{mesh.tetrahedra},
                    MechanicalObject<Vec3d>{mesh.positions},
                    UniformMass<Vec3d>{.totalMass = 1},
                    FixedConstraint<Vec3d>{.indices = {0, 1, 2, 3, 4, 5, 6}},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {1000}, .poissonRatio = 0.3}))};
}

TEST_CASE("step time with and without a window", "[.speed]") {
  if (!std::getenv("DISPLAY")) return;
  auto sim = hanging_block();
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  view::Window window(stage);
  window.frame();
  auto rate = [&](bool seen) {
    stage.play(true);
    stage.settle();
    const long first = stage.state().step;
    const double start = seconds_now();
    while (seconds_now() < start + 2) {
      if (seen) window.frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(seen ? 12 : 16));
    }
    const long steps = stage.state().step - first;
    const double seconds = seconds_now() - start;
    stage.play(false);
    stage.settle();
    return double(steps) / seconds;
  };
  rate(false);
  std::vector<double> with, without, ratios;
  for (int k = 0; k < 9; ++k) {
    without.push_back(rate(false));
    with.push_back(rate(true));
    ratios.push_back(without.back() / with.back());
  }
  std::printf(
      "%zu tetrahedra: %.0f steps/s without the window, %.0f with it; a step takes %.1f %% longer "
      "(medians)\n",
      sim.at<"block">().get<TetrahedronTopology>().tetrahedra.size(),
      median_of(without),
      median_of(with),
      100 * (median_of(ratios) - 1));
}

// A measurement of ten minutes:
//   xvfb-run -a -s "-screen 0 1280x800x24 -noreset" test_window "[.memory]"
TEST_CASE("memory of a window over ten minutes, while a body moves and is coloured", "[.memory]") {
  if (!std::getenv("DISPLAY")) return;
  auto sim = hanging_block();
  sim.init();
  view::Stage stage(sim, 0.01, 0);
  view::Window window(stage);
  view::SeenSettings seen;
  auto megabytes = [] {
    std::ifstream file("/proc/self/statm");
    long all = 0, resident = 0;
    file >> all >> resident;
    return double(resident) * double(sysconf(_SC_PAGESIZE)) / 1e6;
  };
  std::vector<double> minutes;
  stage.play(true);
  const double start = seconds_now();
  for (long frame = 0; minutes.size() <= 10; ++frame) {
    if (frame % 100 == 0) {  // other quantities, a scene that starts again
      seen.colour = view::Quantity(frame / 100 % 5);
      seen.wireframe = frame / 100 % 7 == 0;
      stage.show(seen);
      if (frame % 1000 == 0) stage.reset();
    }
    window.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (seconds_now() - start >= 60 * double(minutes.size())) {
      minutes.push_back(megabytes());
      std::printf("minute %zu, frame %ld, step %ld: %.1f MB\n",
                  minutes.size() - 1,
                  frame,
                  stage.state().step,
                  minutes.back());
      std::fflush(stdout);
    }
  }
  // constant but for what allocators keep
  CHECK(minutes[10] < 1.05 * minutes[2]);
}

}  // namespace test_window
