// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>
#include <sinew/view/stage.hpp>

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cfloat>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

/// Keeping and going back, records of what was done, and plots, in a window of Dear ImGui that is open.
class ToolsPanel {
 public:
  /// save(path) writes the simulation to a file, between two steps; without it there is no button for that,
  /// nor one to open a scene unless `opens`.
  ToolsPanel(Stage& stage, std::function<void(std::string const&)> save, bool opens = false)
      : stage_(stage), save_(std::move(save)), opens_(opens) {
    std::strcpy(scene_.data(), "checkpoint.scn");
    std::strcpy(actions_.data(), "scene.actions");
    std::strcpy(plots_.data(), "plots.csv");
    std::strcpy(profile_.data(), "profile.csv");
  }

  /// The scene to open, where one is asked for.
  std::optional<std::string> drawTools(StageState const& state) {
    std::optional<std::string> open;
    ImGui::TextDisabled("the simulation as it is");
    if (ImGui::Button("Keep")) stage_.keep();
    ImGui::SameLine();
    if (ImGui::Button("Go back to it")) stage_.restore();
    if (save_ || opens_) ImGui::InputText("##scene", scene_.data(), scene_.size());
    if (opens_) {
      if (ImGui::Button("Open")) open = scene_.data();
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("a scene, or one that was saved, in the place of this; a file may be dropped, too");
      if (save_) ImGui::SameLine();
    }
    if (save_) {
      if (ImGui::Button("Save as a scene")) {
        answer_ = std::make_shared<Answer>();
        const std::string path = scene_.data();
        stage_.between([save = save_, path] { save(path); },
                       [answer = answer_, path](std::string const& error) {
                         const std::lock_guard lock(answer->mutex);
                         answer->message = error.empty() ? text("wrote ", path) : error;
                       });
      }
    }
    ImGui::Separator();
    ImGui::TextDisabled("what is done to it");
    if (ImGui::Button(state.recording ? "Stop" : "Record from the start")) stage_.record(!state.recording);
    ImGui::InputText("##actions", actions_.data(), actions_.size());
    if (ImGui::Button("Save")) saveActions();
    ImGui::SameLine();
    if (ImGui::Button("Replay"))
      careful([&] {
        const std::string path = actions_.data();
        stage_.replay(read_actions(io::read_file(path), path));
        message_ = text("replays ", path);
      });
    if (state.replaying) {
      ImGui::SameLine();
      ImGui::TextDisabled("replays");
    }
    finishSaving();
    say();
    return open;
  }
  void drawPlots(StageState const& state) {
    bool on = state.measuring;
    if (ImGui::Checkbox("measure each step", &on)) stage_.measure(on);
    ImGui::SetNextItemWidth(-1);
    if (state.selected && ImGui::BeginCombo("##field", "and a field of the selected component")) {
      for (SeenField const& field : state.selected->fields)
        if (field.whole && field.kind.find("number") != std::string::npos)
          if (ImGui::Selectable(field.name.c_str())) {
            stage_.measureField(state.selected->line, field.name);
            stage_.measure(true);
          }
      ImGui::EndCombo();
    }
    drawProfile(state);
    if (!state.measures) return say();
    Measures const& all = *state.measures;
    for (Series const& one : all.series) {
      std::vector<float> values;
      for (const double value : one.values) values.push_back(float(value));
      const std::string last =
          one.values.empty() ? std::string() : text(detail::short_number(one.values.back()), ' ', one.unit);
      ImGui::TextWrapped("%s", one.name.c_str());
      ImGui::PlotLines(text("##", one.name).c_str(),
                       values.data(),
                       int(values.size()),
                       0,
                       last.c_str(),
                       FLT_MAX,
                       FLT_MAX,
                       {ImGui::GetContentRegionAvail().x, 70});
    }
    offerFile("Save", "##plots", plots_, all);
    ImGui::SameLine();
    ImGui::TextDisabled("(.csv or .svg)");
    say();
  }

  /// The time of each component, as bars.
  void drawProfile(StageState const& state) {
    bool on = state.profiling;
    if (ImGui::Checkbox("time of each component", &on)) stage_.profile(on);
    if (!state.profile) return;
    StepProfile const& profile = *state.profile;
    ImGui::TextDisabled("in a step, mean of %ld steps", profile.steps);
    constexpr std::size_t most = 16;
    const double longest = profile.shares.empty() ? 0 : profile.shares.front().milliseconds;
    for (std::size_t i = 0; i < profile.shares.size() && i < most; ++i) {
      TimeShare const& one = profile.shares[i];
      const std::string number = text(detail::short_number(one.milliseconds), " ms");
      ImGui::ProgressBar(longest > 0 ? float(one.milliseconds / longest) : 0,
                         {ImGui::GetContentRegionAvail().x * 0.42f, ImGui::GetTextLineHeight() + 4},
                         number.c_str());
      ImGui::SameLine();
      ImGui::TextUnformatted(one.name.c_str());
      if (ImGui::IsItemHovered())
        ImGui::SetTooltip("%s\n%.1f %% of the step, %.3g calls in it",
                          one.className.empty() ? "a phase, outside of components" : one.className.c_str(),
                          100 * one.share,
                          one.calls);
    }
    offerFile("Save the times", "##profile", profile_, profile);
    ImGui::Separator();
  }

 private:
  // what the thread of the simulation answers
  struct Answer {
    std::mutex mutex{};
    std::optional<UserActions> actions{};
    std::string message{};
  };
  using Name = std::array<char, 256>;
  Stage& stage_;
  std::function<void(std::string const&)> save_;
  bool opens_;
  Name scene_{}, actions_{}, plots_{}, profile_{};
  std::string message_{};
  std::shared_ptr<Answer> answer_{};

  void saveActions() {
    stage_.record(false);
    answer_ = std::make_shared<Answer>();
    stage_.recorded([answer = answer_](UserActions const& all) {
      const std::lock_guard lock(answer->mutex);
      answer->actions = all;
    });
  }
  void finishSaving() {
    if (!answer_) return;
    {
      const std::lock_guard lock(answer_->mutex);
      if (!answer_->message.empty()) message_ = answer_->message;
      if (!answer_->actions && answer_->message.empty()) return;
      if (answer_->actions)
        careful([&] {
          if (answer_->actions->dt == 0) throw Error("actions", "nothing was recorded yet");
          io::write_file(actions_.data(), actions_text(*answer_->actions));
          message_ = text("wrote ", actions_.data());
        });
    }
    answer_.reset();
  }
  // a name of a file, and a button that writes there as its end says: a picture, or a table
  template <class Of>
  void offerFile(char const* words, char const* id, Name& name, Of const& of) {
    ImGui::InputText(id, name.data(), name.size());
    const bool picture = std::string_view(name.data()).ends_with(".svg");
    if (ImGui::Button(text(words, picture ? " as SVG" : " as CSV").c_str()))
      careful([&] {
        io::write_file(name.data(), picture ? svg_of(of) : csv_of(of));
        message_ = text("wrote ", name.data());
      });
  }
  template <class Act>
  void careful(Act&& act) {
    try {
      act();
    } catch (Error const& error) {
      message_ = error.what();
    }
  }
  void say() const {
    if (!message_.empty()) ImGui::TextWrapped("%s", message_.c_str());
  }
};

}  // namespace sinew::view
