// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/runtime/scene_reader/class_names.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace sinew {

namespace detail {

/// The components that elements are, and what is said of those that are none.
class SceneItems {
 public:
  SceneItems(std::vector<ClassInfo> const& table, bool lenient, SceneMessages& messages)
      : names_{table}, lenient_(lenient), messages_(messages) {}

  SceneClassNames const& names() const { return names_; }
  /// Whether what is not simulated is left out with a warning.
  bool lenient() const { return lenient_; }

  /// An element of another class that stands for a part of what an element asks for. It lives as long as
  /// this.
  XmlElement& partOf(XmlElement const& element, std::string_view tag) {
    made_.push_back(std::make_unique<XmlElement>(
        XmlElement{.tag = std::string(tag), .file = element.file, .offset = element.offset}));
    return *made_.back();
  }
  /// The component that an element is; none where there is no such class, which is said.
  std::unique_ptr<SceneItem> makeItem(ScenePlace& place, XmlElement& element) {
    const std::string tag = tag_of(element);
    std::string_view known = tag;
    for (auto const& other : dialect::standsFor)
      if (other.name == tag) {
        known = other.className;
        element.set(other.attribute, other.value, false);
      }
    for (auto const& other : dialect::otherWords)
      if (auto const* given = other.name == tag ? element.attribute(other.attribute) : nullptr;
          given && given->value == other.word) {
        element.set(other.attribute, other.value);
        break;
      }
    if (dialect::is_over_elements(tag)) {
      known = overElements(element, tag);
      if (known.empty()) return nullptr;
    }
    auto item = std::make_unique<SceneItem>(SceneItem{&place, &element, tag, name_of(element, tag)});
    for (auto const& info : names_.table)
      if (info.known(known)) item->candidates.push_back(&info);
    if (!item->candidates.empty()) {
      hasNoChildren(element);
      warnOfMethod(element, tag);
      std::erase_if(element.attributes, [](XmlAttribute const& a) {
        return dialect::has(dialect::mayBeEmpty, a.name) && (a.value.empty() || a.value == "@");
      });
      return item;
    }
    leaveOut(element, tag);
    return nullptr;
  }
  /// The same, put into its node.
  void addItem(ScenePlace& place, XmlElement& element) {
    if (auto item = makeItem(place, element)) place.items.push_back(std::move(item));
  }

  /// Of a component, and of the response of a contact manager: what it does otherwise than in SOFA.
  void warnOfMethod(XmlElement const& element, std::string_view tag) {
    auto warn = [&](std::string_view name) {
      if (auto const* other = dialect::another_method(name))
        messages_.warnings.insert(text(element.place(),
                                       ": <",
                                       tag,
                                       ">: ",
                                       name == tag ? "" : name,
                                       name == tag ? "" : ": ",
                                       other->difference));
    };
    warn(tag);
    if (auto const* response = element.attribute("response")) warn(response->value);
  }

  void hasNoChildren(XmlElement const& component) {
    for (auto const& child : component.children)
      messages_.addError(
          child,
          text("stands inside <", component.tag, ">, but a component has attributes only; move it out"));
  }

 private:
  SceneClassNames names_;
  bool lenient_;
  SceneMessages& messages_;
  std::vector<std::unique_ptr<XmlElement>> made_{};

  // what is no component, and is said so
  void leaveOut(XmlElement& element, std::string const& tag) {
    switch (SceneClassNames::withoutClass(tag)) {
      case ElementKind::withoutMeaning:
        if (!dialect::has(dialect::ofViews, tag)) messages_.ignored.insert(tag);
        return;
      case ElementKind::inert:
        return void(messages_.warnings.insert(
            text(element.place(), ": <", tag, "> ", dialect::left_out(dialect::inert, tag)->why)));
      case ElementKind::notYet:
        return missing(element, text('<', tag, "> ", dialect::left_out(dialect::notYet, tag)->why));
      default:
        return missing(
            element,
            text("there is no component <", tag, ">", packageOf(tag, suggestion(tag, names_.all()))));
    }
  }
  void missing(XmlElement const& element, std::string const& message) {
    if (lenient_)
      messages_.warnings.insert(text(element.place(), ": ", message, " It is left out."));
    else
      messages_.addError(element.place(), message);
  }
  // what to do about a class that is not there for want of a package; else `otherwise`
  static std::string packageOf(std::string_view tag, std::string otherwise) {
    for (auto const& c : dialect::classesOfPackages)
      if (has_name(c.names, tag))
        return text(" in this program, which was built without ",
                    c.package,
                    "; install that (Debian: ",
                    c.debian,
                    ") and build Sinew anew");
    return otherwise;
  }

  // the class for a kind of elements, told what sets it apart; none where there is no such class, which is
  // said
  std::string_view overElements(XmlElement& element, std::string const& tag) {
    auto const* types = element.attribute("template");
    const std::string whole = types ? types->value : "";
    const std::size_t comma = std::min(whole.find(','), whole.size());
    const std::string kind(Words(std::string_view(whole).substr(std::min(comma + 1, whole.size()))).rest());
    std::string known;
    for (auto const& over : dialect::overElements) {
      if (over.name != tag) continue;
      known += text(known.empty() ? "" : ", ", over.element);
      if (over.element != kind) continue;
      element.set("template", whole.substr(0, comma));
      std::string_view value = over.value;
      if (auto const* method = element.attribute("rotationMethod"); method && over.attribute == "method") {
        value = "";
        std::string methods;
        for (auto const& [name, ours] : dialect::rotationMethods) {
          methods += text(methods.empty() ? "" : ", ", name);
          if (method->value == name) value = ours;
        }
        if (value.empty())
          return messages_.addError(
                     element.place(*method),
                     text('<', tag, ">: rotationMethod: ", shown(method->value), " is not one of ", methods)),
                 "";
        std::erase_if(element.attributes, [](auto const& a) { return a.name == "rotationMethod"; });
      }
      element.set(over.attribute, value);
      return over.className;
    }
    messages_.addError(types ? element.place(*types) : element.place(),
                       text('<',
                            tag,
                            "> is not there over ",
                            kind.empty() ? "no kind of elements" : shown(kind),
                            "; its template names one of ",
                            known,
                            ", as in Vec3,",
                            known.substr(0, known.find(','))));
    return "";
  }
};

}  // namespace detail

}  // namespace sinew
