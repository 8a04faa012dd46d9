// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/collision/collision_surface.hpp>
#include <sinew/collision/contact_responses.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Which response answers the contacts of two models: that of a model that names one, of the first by its
/// number; else of the first rule that fits; else that of the manager. Rules are triplets of words, two of
/// models in either order and one of a response with its parameters (SOFA's RuleBasedContactManager). A model
/// is meant by its name, by the last names of the path of its node, by the number of a group, or by * for
/// all.
class ContactRules {
 public:
  /// `choose(where, words)` finds a response.
  template <class Choose>
  void read(std::string const& where, std::string_view response, std::string_view rules,
            std::vector<CollisionSurface*> const& surfaces, Choose&& choose) {
    ofManager_ = choose(where, response);
    ofModels_.assign(surfaces.size(), {});
    for (std::size_t s = 0; s < surfaces.size(); ++s)
      if (std::string const& wanted = surfaces[s]->settings.contactResponse; !wanted.empty())
        ofModels_[s] = choose(surfaces[s]->path, wanted);
    rules_.clear();
    const std::vector<std::string_view> words = split(where, rules);
    for (std::size_t i = 0; i < words.size(); i += 3)
      rules_.push_back({named(where, words[i], surfaces),
                        named(where, words[i + 1], surfaces),
                        choose(text(where, ": rule ", i / 3), words[i + 2])});
  }

  ResponseChoice find(int a, int b) const {
    const auto i = std::size_t(a), j = std::size_t(b);
    for (ResponseChoice const& own : {ofModels_[i], ofModels_[j]})
      if (own.place != ResponseChoice::notGiven) return own;
    for (Rule const& rule : rules_)
      if ((rule.first[i] && rule.second[j]) || (rule.first[j] && rule.second[i])) return rule.response;
    return ofManager_;
  }
  /// Whether f(place) holds for some response that may answer.
  template <class F>
  bool any(F&& f) const {
    bool some = f(ofManager_.place);
    for (ResponseChoice const& own : ofModels_) some = some || f(own.place);
    for (Rule const& rule : rules_) some = some || f(rule.response.place);
    return some;
  }

 private:
  struct Rule {
    std::vector<char> first, second;  // of each surface, whether it is meant
    ResponseChoice response;
  };
  ResponseChoice ofManager_{};
  std::vector<ResponseChoice> ofModels_{};
  std::vector<Rule> rules_{};

  static std::vector<std::string_view> split(std::string_view where, std::string_view all);
  static std::vector<char> named(std::string_view where, std::string_view name,
                                 std::vector<CollisionSurface*> const& surfaces);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <algorithm>
#include <charconv>

namespace sinew {

SINEW_ONCE std::vector<std::string_view> ContactRules::split(std::string_view where, std::string_view all) {
  std::vector<std::string_view> words;
  constexpr std::string_view blanks = " \t\r\n";
  for (std::size_t at = all.find_first_not_of(blanks); at < all.size();
       at = all.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(all.find_first_of(blanks, at), all.size());
    words.push_back(all.substr(at, end - at));
    at = end;
  }
  if (words.size() == 1 && words[0] == "default") words.clear();  // so SOFA's scenes say that there are none
  if (words.size() % 3 != 0)
    throw Error(
        where,
        text("rules have ",
             words.size(),
             " words; each rule has three: two models (name, path, group or *), and a response, as in "
             "'tool * FrictionContactConstraint?mu=0.3'"));
  return words;
}

SINEW_ONCE std::vector<char> ContactRules::named(std::string_view where, std::string_view name,
                                                 std::vector<CollisionSurface*> const& surfaces) {
  int number = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool isGroup = error == std::errc{} && end == name.data() + name.size();
  std::vector<char> meant;
  for (auto const* s : surfaces) {
    std::string_view path = s->path;
    auto const& groups = s->settings.group;
    bool is = name == "*" || name == s->name || name == path;
    if (isGroup) is = std::find(groups.begin(), groups.end(), number) != groups.end();
    if (path.size() > name.size() && path.ends_with(name))
      is = is || (!isGroup && path[path.size() - name.size() - 1] == '/');
    meant.push_back(char(is));
  }
  if (!isGroup && name != "*" && std::find(meant.begin(), meant.end(), 1) == meant.end())
    throw Error(where,
                text("a rule is for '",
                     name,
                     "', but no collision model has this name, nor a node of this path that has one"));
  return meant;
}

}  // namespace sinew
#endif
