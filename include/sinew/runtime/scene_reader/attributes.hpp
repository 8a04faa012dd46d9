// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/parts.hpp>

#include <algorithm>
#include <optional>

namespace sinew {

namespace detail {

/// dx="1" stands for translation="1 0 0", rx="30" for rotation="30 0 0"
inline void spell_out(SceneItem& item) {
  if (item.info->role != RoleKind::visualModel && !item.info->field("translation")) return;
  auto& attributes = item.element->attributes;
  struct Kind {
    char letter;
    std::string_view name;
  };
  for (const Kind kind : {Kind{'d', "translation"}, Kind{'r', "rotation"}}) {
    std::array<std::string, 3> parts{"0", "0", "0"};
    auto whole = std::find_if(
        attributes.begin(), attributes.end(), [&](auto const& a) { return a.name == kind.name; });
    if (whole != attributes.end()) {
      Words words(whole->value);
      for (auto& part : parts)
        if (!words.end()) part = std::string(words.next());
    }
    std::optional<std::size_t> offset;
    std::erase_if(attributes, [&](XmlAttribute const& a) {
      if (a.name.size() != 2 || a.name[0] != kind.letter || a.name[1] < 'x' || a.name[1] > 'z') return false;
      // in an old scene that SOFA saved, dx is a vector of the state
      Words words(a.value);
      if (!words.end()) words.next();
      if (item.info->role == RoleKind::state && !words.end()) return true;
      parts[std::size_t(a.name[1] - 'x')] = a.value;
      offset = a.offset;
      return true;
    });
    if (!offset) continue;
    std::erase_if(attributes, [&](auto const& a) { return a.name == kind.name; });
    attributes.push_back({std::string(kind.name), text(parts[0], ' ', parts[1], ' ', parts[2]), *offset});
  }
}

/// Takes out what moves a visual model: it is moved where its vertices come from.
inline std::vector<XmlAttribute> take_placing(SceneItem& item) {
  std::vector<XmlAttribute> taken;
  if (item.info->role != RoleKind::visualModel) return taken;
  // SOFA's second name for them
  const bool named = item.element->attribute("position");
  if (named) std::erase_if(item.element->attributes, [](auto const& a) { return a.name == "vertices"; });
  for (auto& a : item.element->attributes)
    if (a.name == "vertices") a.name = "position";
  static constexpr std::array names =
      std::to_array<std::string_view>({"translation", "rotation", "scale", "scale3d"});
  std::erase_if(item.element->attributes, [&](XmlAttribute const& a) {
    if (!dialect::has(names, a.name)) return false;
    taken.push_back(a);
    return true;
  });
  return taken;
}

/// Takes out the translation of a state that follows on the first; where it is rotated in between it stays.
inline std::vector<XmlAttribute> take_second_translation(SceneItem& item) {
  std::vector<XmlAttribute> taken;
  if (item.info->role != RoleKind::state || !item.info->field("translation") ||
      item.element->attribute("rotation2"))
    return taken;
  std::erase_if(item.element->attributes, [&](XmlAttribute const& a) {
    if (a.name == "translation2") taken.push_back(a);
    return a.name == "translation2";
  });
  return taken;
}

/// One number is that of all directions: "2" stands for "2 2 2".
inline std::string alike(std::string const& value) {
  Words words(value);
  if (words.end()) return value;
  const std::string one(words.next());
  return words.end() ? text(one, ' ', one, ' ', one) : value;
}

/// Of each group of words the first ones, with more behind them.
inline std::string every(std::string_view value, std::size_t group, std::size_t first,
                         std::string_view more) {
  std::string all;
  std::size_t i = 0;
  for (Words words(value); !words.end(); ++i) {
    const std::string_view word = words.next();
    if (i % group < first) all += text(word, ' ');
    if (i % group == group - 1) all += more;
  }
  return all;
}

/// Points of a topology are in space, but may be given as those of a state in fewer dimensions.
inline std::string in_space(SceneItem const& item, std::string value) {
  ScenePlace const* const owner = item.place->owner();
  const std::size_t given = owner && owner->state.starts_with("Vec") ? std::size_t(owner->state[3] - '0') : 3;
  std::size_t count = 0;
  for (Words words(value); !words.end(); words.next()) ++count;
  if (given >= 3 || count % 3 == 0 || count % given != 0) return value;
  return every(value, given, given, given == 2 ? "0 " : "0 0 ");
}

/// The fields of a state that are points.
inline constexpr auto fields_of_points = std::to_array<std::string_view>({"position", "rest_position"});

/// Positions as they are written: as in SOFA numbers at the end that are no whole point are left out; an
/// orientation of zeros is none.
inline std::string whole_points(SceneItem const& item, std::string const& value, XmlAttribute const& a,
                                SceneMessages& messages) {
  const std::string_view types = item.info->dataTypes;
  const std::size_t each = types.find("Rigid3") != types.npos   ? 7
                           : types.find("Rigid2") != types.npos ? 3
                           : types.find("Vec") != types.npos ? std::size_t(types[types.find("Vec") + 3] - '0')
                                                             : 1;
  std::vector<std::string> numbers;
  bool joined = false;  // "0-0.5" is two numbers, as in SOFA
  for (Words words(value); !words.end();) {
    std::string_view word = words.next();
    for (std::size_t at = 1; at < word.size(); ++at) {
      if (word[at] != '-' || word[at - 1] < '0' || word[at - 1] > '9') continue;
      numbers.emplace_back(word.substr(0, at));
      word.remove_prefix(at), at = 0;
      joined = true;
    }
    numbers.emplace_back(word);
  }
  auto note = [&](auto const&... what) {
    messages.warnings.insert(text(item.element->place(a), ": <", item.tag, ">: ", a.name, ": ", what...));
  };
  const std::size_t left = numbers.size() % each;
  bool changed = joined || (left > 0 && numbers.size() > each);
  if (joined) note("has numbers without a blank between, which are taken apart; put one there");
  if (left > 0 && numbers.size() > each) {
    numbers.resize(numbers.size() - left);
    note("goes on with ",
         left,
         " of the ",
         each,
         " numbers of a point, which are left out; give all, or none");
  }
  auto zero = [](std::string const& word) {
    double number = 1;
    return io::parse_number(word, number) && number == 0;
  };
  for (std::size_t i = 0; each == 7 && i + each <= numbers.size(); i += each)
    if (std::all_of(
            numbers.begin() + std::ptrdiff_t(i) + 3, numbers.begin() + std::ptrdiff_t(i + each), zero)) {
      numbers[i + 6] = "1";
      note("the orientation of point ", i / each, " is zero; it is taken for none, 0 0 0 1");
      changed = true;
    }
  if (!changed) return value;
  std::string all;
  for (auto const& number : numbers) all += text(number, ' ');
  return all;
}

}  // namespace detail

}  // namespace sinew
