// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/stage.hpp>

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::view {

/// The tree of a scene, and the fields of the component that is selected in it, in a window of Dear ImGui
/// that is open.
class ScenePanel {
 public:
  explicit ScenePanel(Stage& stage) : stage_(stage) {}

  void draw(StageState const& state) {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##search", "search", search_.data(), search_.size());
    ImGui::BeginChild("tree", {0, ImGui::GetContentRegionAvail().y * 0.42f}, true);
    if (search_[0] == 0)
      drawTree(0, stage_.tree.size());
    else
      drawFound();
    ImGui::EndChild();
    ImGui::BeginDisabled(!state.undo);
    if (ImGui::Button("Undo")) stage_.undo();
    ImGui::EndDisabled();
    tip(state.undo, "takes back");
    ImGui::SameLine();
    ImGui::BeginDisabled(!state.redo);
    if (ImGui::Button("Redo")) stage_.redo();
    ImGui::EndDisabled();
    tip(state.redo, "does again");
    ImGui::BeginChild("fields", {0, 0}, true);
    if (state.selected && state.selected->line == selected_)
      drawComponent(*state.selected);
    else
      ImGui::TextDisabled("select a component to see its fields");
    ImGui::EndChild();
  }
  void select(int line) {
    selected_ = line;
    editing_.clear();
    stage_.select(line);
  }
  int selected() const { return selected_; }

 private:
  Stage& stage_;
  std::array<char, 64> search_{};
  int selected_ = -1;
  std::string editing_{};

  static void tip(std::optional<FieldChange> const& change, char const* does) {
    if (!change || !ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("%s: %s from %.60s to %.60s",
                      does,
                      change->field.c_str(),
                      change->before.c_str(),
                      change->after.c_str());
  }
  static bool isNode(TreeLine const& line) { return line.className.empty(); }
  static std::string labelOf(TreeLine const& line) {
    if (isNode(line)) return line.name;
    const std::string_view ofClass = std::string_view(line.className).substr(0, line.className.find('<'));
    return line.name.empty() || line.name == ofClass ? line.className : text(line.className, "  ", line.name);
  }
  void drawLeaf(std::size_t i) {
    TreeLine const& line = stage_.tree[i];
    ImGui::PushID(int(i));
    if (ImGui::Selectable(labelOf(line).c_str(), selected_ == int(i)) && !isNode(line)) select(int(i));
    ImGui::PopID();
  }
  // the lines from one to before another, all on one level or below
  void drawTree(std::size_t from, std::size_t to) {
    auto const& tree = stage_.tree;
    for (std::size_t i = from; i < to;) {
      std::size_t end = i + 1;
      while (end < to && tree[end].depth > tree[i].depth) ++end;
      if (isNode(tree[i])) {
        ImGui::PushID(int(i));
        const bool open = ImGui::TreeNodeEx(
            tree[i].name.c_str(), ImGuiTreeNodeFlags_DefaultOpen | ImGuiTreeNodeFlags_SpanAvailWidth);
        ImGui::PopID();
        if (open) {
          drawTree(i + 1, end);
          ImGui::TreePop();
        }
      } else {
        drawLeaf(i);
      }
      i = end;
    }
  }
  void drawFound() {
    auto small = [](std::string words) {
      for (char& c : words) c = char(std::tolower(static_cast<unsigned char>(c)));
      return words;
    };
    const std::string wanted = small(search_.data());
    int found = 0;
    std::vector<std::string> path;
    for (std::size_t i = 0; i < stage_.tree.size(); ++i) {
      TreeLine const& line = stage_.tree[i];
      path.resize(std::size_t(line.depth));
      if (isNode(line)) path.push_back(line.name);
      if (small(labelOf(line)).find(wanted) == std::string::npos) continue;
      ++found;
      drawLeaf(i);
      if (ImGui::IsItemHovered()) {
        std::string where;
        for (auto const& name : path) where += '/' + name;
        ImGui::SetTooltip("%s", where.c_str());
      }
    }
    if (found == 0) ImGui::TextDisabled("nothing is called so");
  }

  void drawComponent(SeenComponent const& component) {
    ImGui::TextWrapped("%s", component.className.c_str());
    ImGui::TextDisabled("%s in %s", component.role.c_str(), component.path.c_str());
    for (const bool inputs : {true, false}) {
      if (std::none_of(component.fields.begin(), component.fields.end(), [&](SeenField const& f) {
            return f.isInput == inputs;
          }))
        continue;
      if (!inputs) ImGui::TextDisabled("what it makes");
      if (!ImGui::BeginTable(inputs ? "inputs" : "outputs", 2, ImGuiTableFlags_SizingFixedFit)) continue;
      ImGui::TableSetupColumn("name");
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch);
      for (SeenField const& field : component.fields)
        if (field.isInput == inputs) drawField(component, field);
      ImGui::EndTable();
    }
    if (component.fields.empty()) ImGui::TextDisabled("it has no fields");
    if (ImGui::CollapsingHeader("page of documentation")) drawPage(component);
  }
  void drawField(SeenComponent const& component, SeenField const& field) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(field.name.c_str());
    if (ImGui::IsItemHovered()) drawTip(field);
    ImGui::TableNextColumn();
    ImGui::PushID(field.name.c_str());
    const float unit = field.unit.empty() ? 0 : ImGui::CalcTextSize(field.unit.c_str()).x + 8;
    ImGui::SetNextItemWidth(-1 - unit);
    constexpr std::size_t longest = 500;
    if (!field.whole || field.value.size() > longest)
      ImGui::TextDisabled("%zu entries", field.entries);
    else if (!field.fixed.empty())
      ImGui::TextDisabled("%s", field.value.empty() ? "-" : field.value.c_str());
    else if (!field.choices.empty())
      choose(component, field);
    else
      edit(component, field);
    if (ImGui::IsItemHovered()) drawTip(field);
    if (!field.unit.empty()) {
      ImGui::SameLine();
      ImGui::TextDisabled("%s", field.unit.c_str());
    }
    ImGui::PopID();
  }
  void choose(SeenComponent const& component, SeenField const& field) {
    if (field.kind == "yes or no") {
      bool on = field.value == "1";
      if (ImGui::Checkbox("##value", &on)) stage_.setField(component.line, field.name, on ? "1" : "0");
    } else if (ImGui::BeginCombo("##value", field.value.c_str())) {
      for (std::string const& choice : field.choices)
        if (ImGui::Selectable(choice.c_str(), choice == field.value))
          stage_.setField(component.line, field.name, choice);
      ImGui::EndCombo();
    }
  }
  void edit(SeenComponent const& component, SeenField const& field) {
    char words[1024];
    std::strncpy(words, field.value.c_str(), sizeof words - 1);
    words[sizeof words - 1] = 0;
    const bool entered =
        ImGui::InputText("##value", words, sizeof words, ImGuiInputTextFlags_EnterReturnsTrue);
    if (entered) editing_ = words;
    // one that is left with a new value has it, too, unless by Escape
    const bool left =
        ImGui::IsItemDeactivatedAfterEdit() && !ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if ((entered || left) && editing_ != field.value) stage_.setField(component.line, field.name, editing_);
    if (ImGui::IsItemActive()) editing_ = words;
  }
  static void drawTip(SeenField const& field) {
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(380);
    ImGui::TextUnformatted(field.help.c_str());
    std::string words = field.kind;
    if (!field.unit.empty()) words += text(" [", field.unit, ']');
    if (!field.rangeWords.empty()) words += text(", ", field.rangeWords);
    if (!field.defaultValue.empty()) words += text("; by default ", field.defaultValue);
    ImGui::TextDisabled("%s", words.c_str());
    if (!field.fixed.empty()) ImGui::TextDisabled("not changed here: %s", field.fixed.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
  }
  static void drawPage(SeenComponent const& component) {
    for (SeenField const& field : component.fields) {
      ImGui::Bullet();
      std::string words = text(field.name, ": ", field.help);
      if (!field.unit.empty()) words += text(" [", field.unit, ']');
      if (!field.rangeWords.empty()) words += text("; ", field.rangeWords);
      ImGui::TextWrapped("%s", words.c_str());
    }
  }
};

}  // namespace sinew::view
