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
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

/// Keeping and going back, records of what was done, and plots, in a window of Dear ImGui that is open.
class ToolsPanel {
 public:
  /// save(path) writes the simulation to a file, between two steps; without it there is no button for that.
  ToolsPanel(Stage& stage, std::function<void(std::string const&)> save)
      : stage_(stage), save_(std::move(save)) {
    std::strcpy(scene_.data(), "checkpoint.scn");
    std::strcpy(actions_.data(), "scene.actions");
    std::strcpy(plots_.data(), "plots.csv");
  }

  void drawTools(StageState const& state) {
    ImGui::TextDisabled("the simulation as it is");
    if (ImGui::Button("Keep")) stage_.keep();
    ImGui::SameLine();
    if (ImGui::Button("Go back to it")) stage_.restore();
    if (save_) {
      ImGui::InputText("##scene", scene_.data(), scene_.size());
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
    ImGui::InputText("##plots", plots_.data(), plots_.size());
    const bool picture = std::string_view(plots_.data()).ends_with(".svg");
    if (ImGui::Button(picture ? "Save as SVG" : "Save as CSV"))
      careful([&] {
        io::write_file(plots_.data(), picture ? svg_of(all) : csv_of(all));
        message_ = text("wrote ", plots_.data());
      });
    ImGui::SameLine();
    ImGui::TextDisabled("(.csv or .svg)");
    say();
  }

 private:
  // what the thread of the simulation answers
  struct Answer {
    std::mutex mutex{};
    std::optional<UserActions> actions{};
    std::string message{};
  };
  Stage& stage_;
  std::function<void(std::string const&)> save_;
  std::array<char, 256> scene_{}, actions_{}, plots_{};
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
