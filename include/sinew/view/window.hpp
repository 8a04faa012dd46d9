// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/controls.hpp>
#include <sinew/view/image.hpp>
#include <sinew/view/picture.hpp>
#include <sinew/view/renderer.hpp>
#include <sinew/view/scene_panel.hpp>
#include <sinew/view/show_panel.hpp>
#include <sinew/view/stage.hpp>
#include <sinew/view/tools_panel.hpp>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace sinew::view {

struct WindowSettings {
  std::string title = "Sinew";
  int width = 1280, height = 800;                       // [pixels]
  std::optional<Camera> camera{};                       // without one, that which sees all of the scene
  SeenSettings seen{};                                  // what view() shows at first
  std::function<void(std::string const& path)> save{};  // writes the simulation to a file, between two steps
};

/// A window onto a stage: the scene, its tree, and what it may be told. Of a process one at a time, in its
/// main thread.
class Window {
 public:
  /// Throws Error where there is no display, or no OpenGL 3.3.
  explicit Window(Stage& stage, WindowSettings const& settings = {})
      : stage_(stage),
        system_(settings),
        scene_(stage.scene()),
        show_(stage, scene_->settings),
        tools_(stage, settings.save) {
    if (settings.camera) controls_.setHome(*settings.camera);
    renderer_.show(*scene_);
  }

  /// Until it is closed.
  void run() {
    while (!glfwWindowShouldClose(system_.window)) frame();
  }
  /// One picture of what there is now; what the user has done meanwhile is passed on.
  void frame() {
    draw();
    glfwSwapBuffers(system_.window);
  }
  /// The same, and what the window then shows.
  Image image() {
    draw();
    int width = 0, height = 0;
    glfwGetFramebufferSize(system_.window, &width, &height);
    glReadBuffer(GL_BACK);
    Image image = read_image(width, height);
    glfwSwapBuffers(system_.window);
    return image;
  }
  Controls& controls() { return controls_; }
  /// A part of the panel: "Scene", "Show", "Tools" or "Plots".
  void open(std::string part) { tab_ = std::move(part); }
  ScenePanel& scenePanel() { return panel_; }
  ShowPanel& showPanel() { return show_; }
  void close() { glfwSetWindowShouldClose(system_.window, GLFW_TRUE); }

 private:
  // GLFW, the window, and Dear ImGui in it
  struct System {
    GLFWwindow* window = nullptr;

    explicit System(WindowSettings const& settings) {
      if (!glfwInit()) refuse("there is no display to open a window on");
      glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
      glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
      glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
      glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
      glfwWindowHint(GLFW_SAMPLES, 4);
      window = glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
      if (!window) {
        glfwTerminate();
        refuse("no window with OpenGL 3.3 can be opened");
      }
      glfwMakeContextCurrent(window);
      glfwSwapInterval(1);
      ImGui::CreateContext();
      ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
      float scale = 1;
      glfwGetWindowContentScale(window, &scale, nullptr);
      ImGui::StyleColorsLight();
      ImGui::GetStyle().FrameBorderSize = 1;
      ImGui::GetStyle().ScaleAllSizes(scale);
      ImGui::GetIO().FontGlobalScale = scale;
      ImGui_ImplGlfw_InitForOpenGL(window, true);
      ImGui_ImplOpenGL3_Init("#version 330");
    }
    System(System const&) = delete;
    System& operator=(System const&) = delete;
    ~System() {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
      glfwDestroyWindow(window);
      glfwTerminate();
    }
    [[noreturn]] static void refuse(char const* what) {
      char const* reason = nullptr;
      glfwGetError(&reason);
      throw Error(
          "view",
          text(what,
               reason ? text(" (", reason, ')') : std::string(),
               "; start it in a desktop session, or make pictures without a window (sinew run --png)"));
    }
  };
  Stage& stage_;
  System system_;
  Stage::Scene scene_;
  Renderer renderer_{};
  StageState state_{};
  Controls controls_{stage_, camera_of(*scene_, region().width, region().height)};
  ScenePanel panel_{stage_};
  ShowPanel show_;
  ToolsPanel tools_;
  std::string tab_{};
  int speed_ = 0;
  bool help_ = false;

  void draw() {
    glfwPollEvents();
    if (auto latest = stage_.scene(); latest != scene_) {
      scene_ = std::move(latest);
      renderer_.show(*scene_);
    }
    state_ = stage_.state();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    point();
    keys();
    panel();
    if (help_) showHelp();
    showHeld();
    ImGui::Render();
    int width = 0, height = 0;
    glfwGetFramebufferSize(system_.window, &width, &height);
    if (width > 0 && height > 0) {
      glBindFramebuffer(GL_FRAMEBUFFER, 0);
      const Region seen = region();  // in the unit of the mouse, of which a picture may have more
      const int left = int(double(width) * seen.left / (seen.left + seen.width));
      renderer_.draw(controls_.camera, width - left, height, left);
      ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    }
  }
  // where the scene is seen, beside the panel
  struct Region {
    int left, width, height;
  };
  Region region() const {
    int width = 0, height = 0;
    glfwGetWindowSize(system_.window, &width, &height);
    const int panel = std::min(int(340 * ImGui::GetIO().FontGlobalScale), width / 2);
    return {panel, std::max(width - panel, 1), std::max(height, 1)};
  }
  void point() {
    ImGuiIO const& io = ImGui::GetIO();
    const auto [left, width, height] = region();
    const double x = double(io.MousePos.x) - left, y = double(io.MousePos.y);
    if (!io.WantCaptureMouse) {
      for (const int button : {0, 1}) {
        if (!ImGui::IsMouseClicked(button)) continue;
        const auto [origin, direction] = controls_.camera.ray(x, y, width, height);
        controls_.press(button == 0 ? Controls::Button::left : Controls::Button::right,
                        x,
                        y,
                        width,
                        height,
                        meets(*scene_, origin, direction));
      }
      if (io.MouseWheel != 0) controls_.zoom(double(io.MouseWheel));
    }
    if (ImGui::IsMousePosValid()) controls_.move(x, y, width, height);
    if (ImGui::IsMouseReleased(0) || ImGui::IsMouseReleased(1)) controls_.release();
  }
  void keys() {
    if (ImGui::GetIO().WantCaptureKeyboard) return;
    auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(GLFW_KEY_SPACE)) stage_.play(!state_.playing);
    if (pressed(GLFW_KEY_N)) stage_.step();
    if (pressed(GLFW_KEY_R)) stage_.reset();
    if (pressed(GLFW_KEY_F)) controls_.home();
    for (int axis = 0; axis < 3; ++axis)
      if (pressed(GLFW_KEY_X + axis)) controls_.lookAlong(axis);
    if (pressed(GLFW_KEY_U)) stage_.undo();
    if (pressed(GLFW_KEY_H)) help_ = !help_;
    if (pressed(GLFW_KEY_Q)) close();
  }
  ImGuiTabItemFlags selected(char const* tab) const {
    return tab_ == tab ? ImGuiTabItemFlags_SetSelected : ImGuiTabItemFlags_None;
  }
  void panel() {
    const Region seen = region();
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({float(seen.left), float(seen.height)});
    ImGui::Begin(
        "panel", nullptr, ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize);
    if (ImGui::Button(state_.playing ? "Pause" : "Play")) stage_.play(!state_.playing);
    ImGui::SameLine();
    if (ImGui::Button("Step")) stage_.step();
    ImGui::SameLine();
    if (ImGui::Button("Reset")) stage_.reset();
    ImGui::SameLine();
    if (ImGui::Button("Fit")) controls_.home();
    ImGui::SameLine();
    if (ImGui::Button("Help")) help_ = !help_;
    constexpr double speeds[] = {1, 0.1, 0};
    if (ImGui::Combo("speed", &speed_, "as the clock\0a tenth of it\0as fast as it can\0"))
      stage_.setSpeed(speeds[speed_]);
    float stiffness = float(controls_.stiffness);
    if (ImGui::SliderFloat("pull", &stiffness, 1, 1e5f, "%.0f N/m", ImGuiSliderFlags_Logarithmic))
      controls_.stiffness = double(stiffness);
    ImGui::Text("%.3f s, step %ld of %g s", state_.time, state_.step, stage_.dt());
    ImGui::Text("%.0f steps/s, %.0f pictures/s", state_.stepsPerSecond, double(ImGui::GetIO().Framerate));
    if (!state_.error.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, {0.7f, 0.1f, 0.1f, 1});
      ImGui::TextWrapped("%s", state_.error.c_str());
      ImGui::PopStyleColor();
    }
    if (ImGui::BeginTabBar("tabs")) {
      if (ImGui::BeginTabItem("Scene", nullptr, selected("Scene"))) {
        panel_.draw(state_);
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Show", nullptr, selected("Show"))) {
        ImGui::BeginChild("show");
        show_.draw(*scene_);
        ImGui::EndChild();
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Tools", nullptr, selected("Tools"))) {
        tools_.drawTools(state_);
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Plots", nullptr, selected("Plots"))) {
        ImGui::BeginChild("plots");
        tools_.drawPlots(state_);
        ImGui::EndChild();
        ImGui::EndTabItem();
      }
      tab_.clear();
      ImGui::EndTabBar();
    }
    ImGui::End();
  }
  void showHelp() {
    ImGui::Begin("Help", &help_, ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextUnformatted(
        "left button on a body     pull it\n"
        "left button beside it     turn\n"
        "right button              shift\n"
        "wheel                     nearer, farther\n"
        "space                     play, pause\n"
        "N                         one step\n"
        "R                         back to the start\n"
        "F                         the whole scene\n"
        "X, Y, Z                   from the side of an axis\n"
        "U                         takes back the last change of a field\n"
        "H                         this help\n"
        "Q                         close");
    ImGui::End();
  }
  // the spring that pulls, with its force
  void showHeld() {
    if (!state_.held) return;
    const Region seen = region();
    auto at = [&](Eigen::Vector3d const& p) {
      const Eigen::Vector3d pixel = controls_.camera.project(p, seen.width, seen.height);
      return ImVec2(float(pixel[0] + seen.left), float(pixel[1]));
    };
    constexpr ImU32 colour = IM_COL32(20, 20, 20, 255);
    const ImVec2 from = at(state_.held->point), to = at(state_.held->target);
    ImDrawList* draw = ImGui::GetForegroundDrawList();
    draw->AddLine(from, to, colour, 2);
    draw->AddCircleFilled(from, 4, colour);
    draw->AddCircle(to, 6, colour);
    char force[32];
    std::snprintf(force, sizeof force, "%.3g N", state_.held->force.norm());
    draw->AddText({to.x + 10, to.y - 6}, colour, force);
  }
};

/// Shows a simulation, which is initialised, in a window until that is closed: it stands at first, and space
/// lets it go.
template <class Simulation>
void view(Simulation& simulation, double dt, WindowSettings const& settings = {}) {
  Stage stage(simulation, dt, 1, settings.seen);
  Window(stage, settings).run();
}

}  // namespace sinew::view
