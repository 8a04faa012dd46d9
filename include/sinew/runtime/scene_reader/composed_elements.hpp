// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/text_reader.hpp>
#include <sinew/runtime/scene_reader/items.hpp>

#include <algorithm>

namespace sinew {

namespace detail {

/// Elements that stand for several components, or for one beside their own.
class ComposedElements {
 public:
  ComposedElements(SceneItems& items, SceneMessages& messages) : items_(items), messages_(messages) {}

  /// <BoxConstraint box="..."/> stands for a BoxROI and a FixedProjectiveConstraint of what is in it.
  void boxConstraint(ScenePlace& place, XmlElement& element) {
    items_.hasNoChildren(element);
    const std::string name = name_of(element, "BoxConstraint") + "_roi";
    XmlElement& roi = items_.partOf(element, "BoxROI");
    XmlElement& fixed = items_.partOf(element, "FixedProjectiveConstraint");
    fixed.attributes = {{"indices", text('@', name, ".indices"), element.offset}};
    for (auto const& a : element.attributes)
      if (a.name != "type") (a.name == "name" || a.name == "fixAll" ? fixed : roi).attributes.push_back(a);
    roi.set("name", name);
    items_.addItem(place, roi);
    items_.addItem(place, fixed);
  }

  /// <MechanicalObject externalForce="..."/>, forces on the first of its points, stands for a
  /// ConstantForceField.
  void externalForce(ScenePlace& place, XmlElement& state) {
    auto const* const given = state.attribute("externalForce");
    if (!given) return;
    const XmlAttribute forces = *given;
    std::erase_if(state.attributes, [](XmlAttribute const& a) { return a.name == "externalForce"; });
    int numbers = 0;
    bool zero = true;
    io::TextReader reader("", forces.value);
    for (std::string_view word = reader.word(); !word.empty(); word = reader.word(), ++numbers) {
      double number = 1;
      zero = (io::parse_number(word, number) && number == 0) && zero;
    }
    if (zero) return;
    auto const* const types = state.attribute("template");
    const std::string_view of = types ? std::string_view(types->value) : "Vec3";
    const int each = of.find("Rigid2") != of.npos  ? 3
                     : of.find("Rigid") != of.npos ? 6
                     : of.find("Vec1") != of.npos  ? 1
                     : of.find("Vec2") != of.npos  ? 2
                     : of.find("Vec6") != of.npos  ? 6
                                                   : 3;
    if (is_link(forces.value) || numbers % each != 0)
      return messages_.addError(state.place(forces),
                                text('<',
                                     state.tag,
                                     ">: externalForce: give ",
                                     each,
                                     " numbers for each of the first points, or use a ConstantForceField"));
    XmlElement& constant = items_.partOf(state, "ConstantForceField");
    std::string indices;
    for (int i = 0; i < numbers / each; ++i) indices += text(i > 0 ? " " : "", i);
    constant.attributes = {{"name", name_of(state, state.tag) + "_externalForce", forces.offset},
                           {"indices", indices, forces.offset},
                           {"forces", forces.value, forces.offset}};
    items_.addItem(place, constant);
  }

  /// <HexahedronFEMForceFieldAndMass density="3" .../> stands for a force and a mass of the same elements;
  /// with useMass="0", for a UniformMass of the totalMass.
  void forceAndMass(ScenePlace& place, XmlElement& element, dialect::ForceAndMass const& both) {
    items_.hasNoChildren(element);
    if (both.force == dialect::rodForce) return rodForceAndMass(place, element);
    const bool composite = !both.interpolation.empty();
    const bool uniform = composite && isOff(element, "useMass");
    XmlElement& force = items_.partOf(element, both.force);
    XmlElement& mass = items_.partOf(element, uniform ? "UniformMass" : both.mass);
    if (composite && isOff(element, "useRamification"))
      messages_.addError(
          element,
          "useRamification is not simulated: only its default '1' is; take a SparseGridTopology "
          "for cells that are not split");
    for (XmlAttribute a : element.attributes) {
      // what SOFA has, and does not use
      if (a.name == "type" ||
          (composite && has_name("useMass useRamification homogenizationMethod massMatrices", a.name)))
        continue;
      const bool ofMass =
          has_name("density lumpedMass totalMass", a.name) && (composite || a.name != "totalMass");
      const bool ofBoth =
          a.name == "template" ||
          (composite && !uniform && has_name("nbVirtualFinerLevels poissonRatio finestToCoarse", a.name));
      if (!ofMass) force.attributes.push_back(a);
      if (uniform ? a.name == "totalMass" : ofMass && !(composite && a.name == "totalMass")) {
        if (a.name == "density") a.name = "massDensity";
        if (a.name == "lumpedMass") a.name = "lumping";
        mass.attributes.push_back(a);
      } else if (ofBoth) {
        mass.attributes.push_back(a);
      }
    }
    if (uniform && !mass.attribute("totalMass"))
      messages_.addError(element, "useMass is off, and there is no totalMass; give it the mass of the body");
    if (!uniform) mass.set("massDensity", "1", false);
    for (XmlElement* part : {&force, &mass}) {
      if (!composite || part->tag == "UniformMass") continue;
      part->set("nbVirtualFinerLevels", "0", false);
      part->set("interpolation", std::string(both.interpolation));
    }
    if (!composite) mass.set("elements", "hexahedra");
    if (both.fillWeighted) mass.set("fillWeighted", "1");
    mass.set("name", name_of(element, element.tag) + "_mass");
    items_.addItem(place, force);
    items_.addItem(place, mass);
  }

  /// Of rods both have the beams, and there may be no mass.
  void rodForceAndMass(ScenePlace& place, XmlElement& element) {
    XmlElement& force = items_.partOf(element, dialect::rodForce);
    XmlElement& mass = items_.partOf(element, dialect::rodMass);
    for (XmlAttribute const& a : element.attributes) {
      // forces here are the slope of the energy in the length that a chord has
      if (has_name("type computeMass reinforceLength", a.name)) continue;
      if (a.name != "massDensity") force.attributes.push_back(a);
      if (a.name != "name") mass.attributes.push_back(a);
    }
    mass.set("name", name_of(element, element.tag) + "_mass");
    items_.addItem(place, force);
    if (!isOff(element, "computeMass")) items_.addItem(place, mass);
  }

  /// <CGImplicit .../> of the first SOFA is an EulerImplicitSolver, damped, with a CGLinearSolver; a node
  /// that has a solver gets the latter only, with a warning.
  void cgImplicit(ScenePlace& place, XmlElement& element) {
    items_.hasNoChildren(element);
    XmlElement& ode = items_.partOf(element, "EulerImplicitSolver");
    XmlElement& linear = items_.partOf(element, "CGLinearSolver");
    auto const* class_ = items_.names().named(linear.tag);
    for (auto const& a : element.attributes)
      if (a.name != "type") (class_ && class_->field(a.name) ? linear : ode).attributes.push_back(a);
    ode.set("rayleighStiffness", "0.1", false);
    ode.set("rayleighMass", "0.1", false);
    linear.set("threshold", "1e-5", false);
    linear.set("name", name_of(element, element.tag) + "_linear");
    auto const first = std::find_if(place.items.begin(), place.items.end(), [](auto const& item) {
      return item->candidates[0]->role == RoleKind::odeSolver;
    });
    if (first == place.items.end())
      items_.addItem(place, ode);
    else
      messages_.warnings.insert(
          text(element.place(),
               ": <",
               tag_of(element),
               ">: its node has an ODE solver already, <",
               (*first)->tag,
               ">; of this one the conjugate gradients alone are taken, where SOFA makes a step with each; "
               "remove one of them"));
    items_.addItem(place, linear);
  }

 private:
  SceneItems& items_;
  SceneMessages& messages_;

  static bool isOff(XmlElement const& element, std::string_view attribute) {
    auto const* given = element.attribute(attribute);
    return given && (given->value == "0" || given->value == "false");
  }
};

}  // namespace detail

}  // namespace sinew
