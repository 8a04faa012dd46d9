// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/stage.hpp>

#include <imgui.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace sinew::view {

/// What is seen of a scene, chosen in a window of Dear ImGui that is open.
class ShowPanel {
 public:
  ShowPanel(Stage& stage, SeenSettings const& settings) : stage_(stage), settings_(settings) {}

  SeenSettings const& settings() const { return settings_; }
  void set(SeenSettings settings) {
    settings_ = std::move(settings);
    stage_.show(settings_);
  }

  void draw(SeenScene const& scene) {
    bool changed = false;
    auto check = [&](char const* label, bool& value) { changed = ImGui::Checkbox(label, &value) || changed; };
    ImGui::TextDisabled("colours");
    ImGui::SetNextItemWidth(-1);
    const auto names = enum_names(Quantity{});
    const QuantityWords words = words_of(settings_.colour);
    if (ImGui::BeginCombo("##colour",
                          settings_.colour == Quantity::none ? "of bodies" : words.title.data())) {
      for (std::size_t k = 0; k < names.size(); ++k)
        if (ImGui::Selectable(k == 0 ? "of bodies" : words_of(Quantity(k)).title.data(),
                              settings_.colour == Quantity(k))) {
          settings_.colour = Quantity(k);
          settings_.range.reset();
          changed = true;
        }
      ImGui::EndCombo();
    }
    if (scene.legend) {
      bool fixed = settings_.range.has_value();
      if (ImGui::Checkbox("keep their range", &fixed)) {
        settings_.range.reset();
        if (fixed) settings_.range = {scene.legend->low, scene.legend->high};
        changed = true;
      }
    }
    ImGui::Separator();
    ImGui::TextDisabled("arrows");
    for (std::size_t k = 0; k < settings_.arrows.size(); ++k)
      check(enum_names(ArrowKind{})[k].data(), settings_.arrows[k]);
    ImGui::Separator();
    ImGui::TextDisabled("models");
    check("visual models", settings_.visualModels);
    check("states", settings_.states);
    check("collision models", settings_.collisionModels);
    check("their boxes", settings_.boxes);
    if (settings_.boxes) {
      int level = settings_.boxLevel.value_or(-1);
      ImGui::SetNextItemWidth(-1);
      if (ImGui::SliderInt("##level", &level, -1, 20, level < 0 ? "of all levels" : "of level %d")) {
        settings_.boxLevel = level < 0 ? std::nullopt : std::optional(level);
        changed = true;
      }
    }
    check("springs", settings_.springs);
    check("held points", settings_.constraints);
    check("normals", settings_.normals);
    check("wireframe", settings_.wireframe);
    ImGui::Separator();
    check("axes", settings_.axes);
    ImGui::SameLine();
    check("grid", settings_.grid);
    ImGui::SameLine();
    check("legend", settings_.legend);
    check("shadows", settings_.shadows);
    check("occlusion", settings_.occlusion);
    changed = drawClip(scene) || changed;
    ImGui::Separator();
    ImGui::TextDisabled("bodies");
    for (SeenBody const& body : scene.bodies)
      if (body.kind != SeenBody::Kind::collision) changed = drawBody(body) || changed;
    if (changed) stage_.show(settings_);
  }

 private:
  Stage& stage_;
  SeenSettings settings_;
  int clipAxis_ = 0;

  bool drawClip(SeenScene const& scene) {
    bool changed = false, on = settings_.clip.has_value();
    const auto [low, high] = scene.box();
    if (ImGui::Checkbox("cut open", &on)) {
      settings_.clip.reset();
      if (on) settings_.clip = ClipPlane{Eigen::Vector3d::Unit(clipAxis_), (low + high)[clipAxis_] / 2};
      changed = true;
    }
    if (!on || !settings_.clip) return changed;
    for (int axis = 0; axis < 3; ++axis) {
      ImGui::SameLine();
      if (ImGui::RadioButton(axis == 0 ? "x" : axis == 1 ? "y" : "z", clipAxis_ == axis)) {
        clipAxis_ = axis;
        settings_.clip = ClipPlane{Eigen::Vector3d::Unit(axis), (low + high)[axis] / 2};
        changed = true;
      }
    }
    float at = float(settings_.clip->offset);
    ImGui::SetNextItemWidth(-1);
    if (ImGui::SliderFloat("##at", &at, float(low[clipAxis_]), float(high[clipAxis_]), "at %.3g m")) {
      settings_.clip->offset = double(at);
      changed = true;
    }
    return changed;
  }
  BodyLook& lookOf(SeenBody const& body) {
    for (BodyLook& look : settings_.looks)
      if (look.path == body.path) return look;
    return settings_.looks.emplace_back(BodyLook{.path = body.path});
  }
  bool drawBody(SeenBody const& body) {
    bool changed = false, visible = body.visible;
    ImGui::PushID(body.path.c_str());
    if (ImGui::Checkbox("##visible", &visible)) {
      lookOf(body).visible = visible;
      changed = true;
    }
    ImGui::SameLine();
    float colour[4] = {
        float(body.colour[0]), float(body.colour[1]), float(body.colour[2]), float(body.opacity)};
    if (ImGui::ColorEdit4(
            "##colour", colour, ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_AlphaPreview)) {
      BodyLook& look = lookOf(body);
      look.colour = Eigen::Vector3d(double(colour[0]), double(colour[1]), double(colour[2]));
      look.opacity = double(colour[3]);
      changed = true;
    }
    ImGui::SameLine();
    ImGui::TextUnformatted(body.path.c_str());
    ImGui::PopID();
    return changed;
  }
};

}  // namespace sinew::view
