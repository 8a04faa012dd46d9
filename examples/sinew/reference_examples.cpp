// SPDX-License-Identifier: BSL-1.0
#include "reference_examples.hpp"
#include "reference.hpp"

#include <algorithm>

namespace cli {

using sinew::text;

namespace {

/// f(line) for each line of a text but the empty one at its beginning.
template <class F>
void each_line(std::string_view all, F&& f) {
  while (!all.empty()) {
    const std::size_t end = std::min(all.find('\n'), all.size());
    if (end > 0) f(all.substr(0, end));
    all.remove_prefix(std::min(end + 1, all.size()));
  }
}

/// What a component of a role looks like where its class says nothing else.
struct RoleExample {
  sinew::RoleKind role;
  std::string_view scene, standIn;
  Place place = Place::instead;
};
constexpr auto roleExamples = std::to_array<RoleExample>(
    {{sinew::RoleKind::topology, softBody, "RegularGridTopology"},
     {sinew::RoleKind::mass, softBody, "UniformMass"},
     {sinew::RoleKind::forceField, softBody, "TetrahedronFEMForceField"},
     {sinew::RoleKind::projectiveConstraint, softBody, "FixedConstraint"},
     {sinew::RoleKind::mapping, carrier, "BarycentricMapping"},
     {sinew::RoleKind::odeSolver, softBody, "EulerImplicitSolver"},
     {sinew::RoleKind::linearSolver, softBody, "SparseLDLSolver"},
     {sinew::RoleKind::engine, softBody, "FixedConstraint"},
     {sinew::RoleKind::collisionPipeline, contact, "DefaultPipeline"},
     {sinew::RoleKind::broadPhase, contact, "BruteForceBroadPhase"},
     {sinew::RoleKind::narrowPhase, contact, "BVHNarrowPhase"},
     {sinew::RoleKind::intersection, contact, "MinProximityIntersection"},
     {sinew::RoleKind::contactManager, contact, "DefaultContactManager"},
     {sinew::RoleKind::collisionModel, contact, "SphereCollisionModel"},
     {sinew::RoleKind::stepDivision, parts, "MultiStepAnimationLoop"},
     {sinew::RoleKind::animationLoop, friction, "FreeMotionAnimationLoop"},
     {sinew::RoleKind::lagrangianConstraint, multipliers, "FixedLagrangianConstraint"},
     {sinew::RoleKind::constraintSolver, friction, "BlockGaussSeidelConstraintSolver"},
     {sinew::RoleKind::constraintCorrection, friction, "SparseLDLSolver", Place::beside}});

/// A scene with text in the place of the line with an element, or below it, as far to the right as that; as
/// it is where no element is named.
std::string placed(std::string_view scene, std::string_view standIn, std::string_view xml, Place place) {
  std::string out;
  bool found = standIn.empty();
  auto add = [&](std::string_view line) { out += text(line, '\n'); };
  each_line(scene, [&](std::string_view line) {
    const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
    const std::string_view element = line.substr(indent);
    const bool here = !found && element.starts_with(text('<', standIn)) &&
                      std::string_view(" />").find(element[standIn.size() + 1]) != std::string_view::npos;
    if (!here || place == Place::beside) add(line);
    if (!here) return;
    found = true;
    each_line(xml, [&](std::string_view below) { add(text(line.substr(0, indent), below)); });
  });
  if (!found) throw Failure{badUsage, {text("no example has an element ", standIn, " to stand beside")}};
  return out;
}

ClassExample example_of_class(std::string_view name) {
  for (auto const examples : {examples_of_bodies(),
                              examples_of_elements(),
                              examples_of_springs(),
                              examples_of_loads(),
                              examples_of_fluids(),
                              examples_of_constraints(),
                              examples_of_mappings(),
                              examples_of_solvers(),
                              examples_of_selections(),
                              examples_of_sources(),
                              examples_of_meshes(),
                              examples_of_topological_mappings(),
                              examples_of_collision(),
                              examples_of_lagrangian()})
    for (ClassExample const& example : examples)
      if (example.name == name) return example;
  return {.name = name};
}

}  // namespace

std::string example_of(Entry const& entry) {
  const std::string_view name = entry.first().name;
  const std::string alone = text('<', name, "/>");
  ClassExample example = example_of_class(name);
  if (example.scene.empty()) {
    if (example.xml.starts_with("\n<Node")) return placed(example.xml, {}, {}, Place::beside);
    for (auto const& role : roleExamples)
      if (role.role == entry.first().role)
        example = {name, example.xml, role.scene, role.standIn, role.place};
  }
  if (example.scene.empty()) return {};
  return placed(example.scene, example.standIn, example.xml.empty() ? alone : example.xml, example.place);
}

}  // namespace cli
