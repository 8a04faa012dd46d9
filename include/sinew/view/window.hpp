// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/controls.hpp>
#include <sinew/view/image.hpp>
#include <sinew/view/opened_scene.hpp>
#include <sinew/view/picture.hpp>
#include <sinew/view/renderer.hpp>
#include <sinew/view/scene_panel.hpp>
#include <sinew/view/show_panel.hpp>
#include <sinew/view/smooth_target.hpp>
#include <sinew/view/stage.hpp>
#include <sinew/view/tools_panel.hpp>

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#if defined(__GLIBC__)
#include <malloc.h>
#endif
#if defined(__linux__)
#include <sys/resource.h>
#endif

namespace sinew::view {

namespace detail {

// by their numbers in the system; empty where these are not known
inline std::set<std::string> threads_of_process() {
  std::set<std::string> all;
#if defined(__linux__)
  std::error_code none;
  for (auto const& entry : std::filesystem::directory_iterator("/proc/self/task", none))
    all.insert(entry.path().filename().string());
#endif
  return all;
}
/// Mesa's software draws by the processor that simulates: the threads it has started since `before` give way,
/// and the memory of a picture, some 10 MB, is kept for the next one.
inline void spare_simulation(std::set<std::string> const& before) {
#if defined(__linux__)
  constexpr int lower = 10;  // a tenth of the share of others
  for (std::string const& thread : threads_of_process())
    if (!before.count(thread)) setpriority(PRIO_PROCESS, id_t(std::stoul(thread)), lower);
#endif
#if defined(__GLIBC__)
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

}  // namespace detail

struct WindowSettings {
  std::string title = "Sinew";
  int width = 1280, height = 800;                       // [pixels]
  std::optional<Camera> camera{};                       // without one, that which sees all of the scene
  SeenSettings seen{};                                  // what view() shows at first
  std::function<void(std::string const& path)> save{};  // writes the simulation to a file, between two steps
  // Reads a scene, a checkpoint, too, which then takes the place of that which is seen, in a thread of its
  // own. What it throws as Error is shown. Without it the window opens no scenes.
  std::function<OpenedScene(std::string const& path)> open{};
};

/// A window onto a stage: the scene, its tree, and what it may be told. Of a process one at a time, in its
/// main thread.
class Window {
 public:
  /// Throws Error where there is no display, or no OpenGL 3.3.
  explicit Window(Stage& stage, WindowSettings const& settings = {})
      : system_(settings), open_(settings.open), scene_(stage.scene()) {
    face(stage, settings.camera, settings.save);
    glfwSetWindowUserPointer(system_.window, this);
    glfwSetWindowRefreshCallback(system_.window, [](GLFWwindow* window) {
      static_cast<Window*>(glfwGetWindowUserPointer(window))->damaged_ = true;
    });
    glfwSetDropCallback(system_.window, [](GLFWwindow* window, int count, char const** paths) {
      if (count > 0) static_cast<Window*>(glfwGetWindowUserPointer(window))->open(std::string(paths[0]));
    });
  }

  /// Until it is closed; up to 60 pictures a second, also where the display waits for none.
  void run() {
    while (!glfwWindowShouldClose(system_.window)) {
      const auto next = std::chrono::steady_clock::now() + std::chrono::microseconds(16600);
      frame();
      std::this_thread::sleep_until(next);
    }
  }
  /// One picture of what there is now, where it differs from the last one; what the user has done meanwhile
  /// is passed on.
  void frame() {
    if (!prepare()) return;
    draw();
    glfwSwapBuffers(system_.window);
  }
  /// The same, and what the window then shows.
  Image image() {
    prepare();
    draw();
    int width = 0, height = 0;
    glfwGetFramebufferSize(system_.window, &width, &height);
    glReadBuffer(GL_BACK);
    Image image = read_image(width, height);
    glfwSwapBuffers(system_.window);
    return image;
  }
  /// How many pictures were drawn.
  long drawn() const { return drawn_; }
  Controls& controls() { return face_->controls; }
  /// A part of the panel: "Scene", "Show", "Tools" or "Plots".
  void turnTo(std::string part) { tab_ = std::move(part); }
  ScenePanel& scenePanel() { return face_->panel; }
  ShowPanel& showPanel() { return face_->show; }
  /// Reads a scene by WindowSettings::open, which is seen as soon as it is there; as a file that is dropped
  /// onto the window.
  void open(std::string path) {
    if (opening_.valid()) return;
    message_.clear();
    if (!open_) {
      message_ = "this window shows one scene; sinew view opens others";
      return;
    }
    openingPath_ = path;
    opening_ = std::async(std::launch::async, [read = open_, path] { return read(path); });
  }
  /// What the pointer and the keys do beside those of the user, asked before each picture: for demonstrations
  /// and tests.
  std::function<void(ImGuiIO& io)> input{};
  /// The stage that is seen: that of the start, or of a scene that was opened.
  Stage& stage() { return face_->stage; }
  /// What was noticed when a scene was opened, or why it was not.
  std::string const& message() const { return message_; }
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
      const std::set<std::string> before = detail::threads_of_process();
      window = glfwCreateWindow(settings.width, settings.height, settings.title.c_str(), nullptr, nullptr);
      if (!window) {
        glfwTerminate();
        refuse("no window with OpenGL 3.3 can be opened");
      }
      glfwMakeContextCurrent(window);
      glfwSwapInterval(1);
      if (drawn_by_software()) detail::spare_simulation(before);
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
  // what belongs to a stage
  struct Face {
    Stage& stage;
    Controls controls;
    ScenePanel panel;
    ShowPanel show;
    ToolsPanel tools;

    Face(Stage& of, Camera const& camera, SeenSettings const& seen,
         std::function<void(std::string const&)> const& save, bool opens)
        : stage(of), controls(of, camera), panel(of), show(of, seen), tools(of, save, opens) {}
  };
  // the picture of the scene that there is
  struct Shown {
    Stage::Scene scene{};
    Camera camera{};
    int width = 0, height = 0;
    bool operator==(Shown const&) const = default;
  };
  System system_;
  const bool software_ = drawn_by_software();
  std::function<OpenedScene(std::string const&)> open_;
  OpenedScene opened_{};  // before the face, which uses it
  Stage::Scene scene_;
  Renderer renderer_{};
  SmoothTarget smooth_{};
  Shown shown_{};
  bool isSmooth_ = false;   // what smooth_ has is what is shown
  bool damaged_ = true;     // the window has lost what it showed
  std::vector<char> ui_{};  // the panel as it was drawn last
  long drawn_ = 0;
  struct {
    std::chrono::steady_clock::time_point at = std::chrono::steady_clock::now();
    long drawn = 0;
    double rate = 0;
  } counted_{};
  StageState state_{};
  std::optional<Face> face_{};
  std::string tab_{}, message_{}, openingPath_{};
  std::future<OpenedScene> opening_{};
  int speed_ = 0;
  bool help_ = false;

  void face(Stage& stage, std::optional<Camera> const& camera,
            std::function<void(std::string const&)> const& save) {
    scene_ = stage.scene();
    const Region seen = region();
    face_.emplace(stage, camera_of(*scene_, seen.width, seen.height), scene_->settings, save, bool(open_));
    if (camera) face_->controls.setHome(*camera);
    speed_ = 0;
    renderer_.show(*scene_);
  }
  // another scene takes the place as soon as it is there
  void takeOpened() {
    if (!opening_.valid() || opening_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    try {
      OpenedScene next = opening_.get();
      for (std::string const& note : next.notes) message_ += text(message_.empty() ? "" : "\n", note);
      face_->stage.release();
      face_->stage.play(false);
      face_.reset();
      face(*next.stage, next.camera, next.save);
      opened_ = std::move(next);
      glfwSetWindowTitle(system_.window, opened_.title.c_str());
    } catch (std::exception const& error) {
      message_ = error.what();
    }
  }

  // All but the drawing. False: it would be the last picture again.
  bool prepare() {
    glfwPollEvents();
    takeOpened();
    if (auto latest = stage().scene(); latest != scene_) {
      scene_ = std::move(latest);
      renderer_.show(*scene_);
    }
    state_ = stage().state();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    if (input) input(ImGui::GetIO());
    ImGui::NewFrame();
    point();
    keys();
    panel();
    if (help_) showHelp();
    showHeld();
    ImGui::Render();
    const bool sameUi = bytes_of_ui() == ui_;
    return !(sameUi && isSmooth_ && shown() == shown_ && !std::exchange(damaged_, false));
  }
  Shown shown() const {
    Shown now{.scene = scene_, .camera = face_->controls.camera};
    glfwGetFramebufferSize(system_.window, &now.width, &now.height);
    return now;
  }
  static std::vector<char> bytes_of_ui() {
    std::vector<char> bytes;
    auto add = [&](auto const& list) {
      auto const* first = reinterpret_cast<char const*>(list.Data);
      bytes.insert(bytes.end(), first, first + std::size_t(list.Size) * sizeof *list.Data);
    };
    ImDrawData const* data = ImGui::GetDrawData();
    for (int k = 0; k < data->CmdListsCount; ++k)
      add(data->CmdLists[k]->VtxBuffer), add(data->CmdLists[k]->IdxBuffer);
    return bytes;
  }
  void draw() {
    const Shown now = shown();
    if (now.width < 1 || now.height < 1) return;
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    drawScene(now);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    ui_ = bytes_of_ui();
    ++drawn_;
  }
  // With smooth edges; without a graphics card these take long, and only what stands has them.
  void drawScene(Shown const& now) {
    const Region seen = region();  // in the unit of the mouse, of which a picture may have more
    const int left = int(double(now.width) * seen.left / (seen.left + seen.width));
    const bool stands = std::exchange(shown_, now) == now;
    isSmooth_ = isSmooth_ && stands;
    if (software_ && !stands) return renderer_.draw(now.camera, now.width - left, now.height, left);
    if (!isSmooth_) {
      smooth_.resize(now.width, now.height, 4);
      smooth_.begin();
      renderer_.draw(now.camera, now.width - left, now.height, left);
      smooth_.end();
      isSmooth_ = true;
    }
    smooth_.show();
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
        const auto [origin, direction] = face_->controls.camera.ray(x, y, width, height);
        face_->controls.press(button == 0 ? Controls::Button::left : Controls::Button::right,
                              x,
                              y,
                              width,
                              height,
                              meets(*scene_, origin, direction));
      }
      if (io.MouseWheel != 0) face_->controls.zoom(double(io.MouseWheel));
    }
    if (ImGui::IsMousePosValid()) face_->controls.move(x, y, width, height);
    if (ImGui::IsMouseReleased(0) || ImGui::IsMouseReleased(1)) face_->controls.release();
  }
  void keys() {
    if (ImGui::GetIO().WantCaptureKeyboard) return;
    auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    if (pressed(GLFW_KEY_SPACE)) stage().play(!state_.playing);
    if (pressed(GLFW_KEY_N)) stage().step();
    if (pressed(GLFW_KEY_R)) stage().reset();
    if (pressed(GLFW_KEY_F)) face_->controls.home();
    for (int axis = 0; axis < 3; ++axis)
      if (pressed(GLFW_KEY_X + axis)) face_->controls.lookAlong(axis);
    if (pressed(GLFW_KEY_U)) stage().undo();
    if (pressed(GLFW_KEY_H)) help_ = !help_;
    if (pressed(GLFW_KEY_Q)) close();
  }
  // of the last half second, so that the number does not make a picture of its own each time
  double picturesPerSecond() {
    const auto now = std::chrono::steady_clock::now();
    const double since = std::chrono::duration<double>(now - counted_.at).count();
    if (since > 0.5) counted_ = {now, drawn_, double(drawn_ - counted_.drawn) / since};
    return counted_.rate;
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
    if (ImGui::Button(state_.playing ? "Pause" : "Play")) stage().play(!state_.playing);
    ImGui::SameLine();
    if (ImGui::Button("Step")) stage().step();
    ImGui::SameLine();
    if (ImGui::Button("Reset")) stage().reset();
    ImGui::SameLine();
    if (ImGui::Button("Fit")) face_->controls.home();
    ImGui::SameLine();
    if (ImGui::Button("Help")) help_ = !help_;
    constexpr double speeds[] = {1, 0.1, 0};
    if (ImGui::Combo("speed", &speed_, "as the clock\0a tenth of it\0as fast as it can\0"))
      stage().setSpeed(speeds[speed_]);
    float stiffness = float(face_->controls.stiffness);
    if (ImGui::SliderFloat("pull", &stiffness, 1, 1e5f, "%.0f N/m", ImGuiSliderFlags_Logarithmic))
      face_->controls.stiffness = double(stiffness);
    ImGui::Text("%.3f s, step %ld of %g s", state_.time, state_.step, stage().dt());
    ImGui::Text("%.0f steps/s, %.0f pictures/s", state_.stepsPerSecond, picturesPerSecond());
    for (std::string const* wrong : {&state_.error, &message_}) {
      if (wrong->empty()) continue;
      ImGui::PushStyleColor(ImGuiCol_Text, {0.7f, 0.1f, 0.1f, 1});
      ImGui::TextWrapped("%s", wrong->c_str());
      ImGui::PopStyleColor();
    }
    if (!message_.empty() && ImGui::SmallButton("Close the message")) message_.clear();
    if (opening_.valid()) ImGui::TextWrapped("opens %s", openingPath_.c_str());
    if (ImGui::BeginTabBar("tabs")) {
      if (ImGui::BeginTabItem("Scene", nullptr, selected("Scene"))) {
        face_->panel.draw(state_);
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Show", nullptr, selected("Show"))) {
        ImGui::BeginChild("show");
        face_->show.draw(*scene_);
        ImGui::EndChild();
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Tools", nullptr, selected("Tools"))) {
        if (auto path = face_->tools.drawTools(state_)) open(*path);
        ImGui::EndTabItem();
      }
      if (ImGui::BeginTabItem("Plots", nullptr, selected("Plots"))) {
        ImGui::BeginChild("plots");
        face_->tools.drawPlots(state_);
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
      const Eigen::Vector3d pixel = face_->controls.camera.project(p, seen.width, seen.height);
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
