// SPDX-License-Identifier: BSL-1.0
#include "measures.hpp"

#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cli {

using sinew::text;
namespace role = sinew::role;

namespace {

constexpr std::array<std::string_view, 4> ofNodes{
    "kineticEnergy", "potentialEnergy", "largestDisplacement", "reaction"};
constexpr std::string_view ofSolvers = "residual";

Failure wrong(Measure const& measure, std::string_view what) {
  return {badUsage, {text("--measure ", measure.words, ": ", what)}};
}
std::string meant(std::string_view word, std::vector<std::string> const& known, std::string_view otherwise) {
  const std::string nearest = sinew::nearest_name(word, known);
  return nearest.empty() ? std::string(otherwise) : text("; did you mean '", nearest, "'?");
}

// a node, or a component of it
struct Place {
  Node* node;
  Node::Entry* entry = nullptr;
};

Place find(Measure const& measure, Node& top) {
  Place at{&top};
  std::string_view rest = measure.path;
  while (!rest.empty()) {
    const std::string_view step = rest.substr(0, rest.find('/'));
    rest.remove_prefix(std::min(step.size() + 1, rest.size()));
    if (at.entry)
      throw wrong(measure, text('\'', at.entry->name, "' is a component, and has nothing below it"));
    std::vector<std::string> known;
    Place next{nullptr};
    for (auto& entry : at.node->components()) {
      known.push_back(entry.name);
      if (!next.node && (entry.name == step || entry.component.isCalled(step))) next = {at.node, &entry};
    }
    for (auto const& child : at.node->children()) {
      known.push_back(child->name);
      if (child->name == step) next = {child.get()};
    }
    if (!next.node && at.node == &top && step == top.name) continue;
    if (!next.node)
      throw wrong(measure,
                  text("there is no '",
                       step,
                       "' in '",
                       at.node->name,
                       '\'',
                       meant(step, known, "; name a node or a component")));
    at = next;
  }
  return at;
}

// "/liver" of records
std::string below_top(Node const& node) {
  return node.parent() ? text(below_top(*node.parent()), '/', node.name) : "";
}

double residual_of(Node::Entry const& entry, bool& known) {
  double value = std::nan("");
  entry.component.visit<role::LinearSolver, role::OdeSolver, role::ConstraintSolver>([&](auto const& c) {
    if constexpr (requires { c.residuals.back(); }) {
      known = true;
      if (!c.residuals.empty()) value = double(c.residuals.back());
    } else if constexpr (requires { c.newton.residuals; }) {
      known = true;
      if (!c.newton.residuals.empty()) value = c.newton.residuals.back();
    } else if constexpr (requires { c.result.residual; }) {
      known = true;
      value = c.result.residual;
    } else if constexpr (requires { c.result.error; }) {
      known = true;
      value = c.result.error;
    }
  });
  return value;
}

Eigen::Vector3d reaction_below(Node const& node) {
  Eigen::Vector3d sum(0, 0, 0);
  if (!node.mapping())
    for (auto const& entry : node.components())
      entry.component.visit<role::State>([&](auto const& state) {
        if (state.reaction.size() == state.position.size()) sum += sinew::reaction_force(state).force;
      });
  for (auto const& child : node.children()) sum += reaction_below(*child);
  return sum;
}

void add_numbers(Cells& cells, Measure const& measure, std::vector<double> const& numbers) {
  if (measure.entry.size() > (numbers.size() > 1 ? 1u : 0u) ||
      (!measure.entry.empty() && measure.entry[0] >= numbers.size()))
    throw wrong(measure,
                numbers.size() > 1 ? text("it has ",
                                          numbers.size(),
                                          " numbers, of which one is named as in ",
                                          measure.path,
                                          '.',
                                          measure.name,
                                          "[0]")
                                   : std::string("it is one number; leave out what is in brackets"));
  if (numbers.size() == 1 || !measure.entry.empty()) {
    cells.emplace_back(measure.words, cell_of(numbers[measure.entry.empty() ? 0 : measure.entry[0]]));
    return;
  }
  for (std::size_t i = 0; i < numbers.size(); ++i)
    cells.emplace_back(text(measure.words, '[', i, ']'), cell_of(numbers[i]));
}

void add_of_node(Cells& cells, Measure const& measure, Node& node, Scene& scene,
                 sinew::RecordedFrame const& start) {
  auto& simulation = scene.simulation;
  const sinew::RuntimeScope<sinew::Standard> scope(node);
  if (measure.name == "kineticEnergy" || measure.name == "potentialEnergy") {
    sinew::MechanicalOperations<sinew::RuntimeScope<sinew::Standard>> operations(scope, simulation.time());
    double energy =
        measure.name == "kineticEnergy" ? operations.kineticEnergy() : operations.potentialEnergy();
    if (measure.name == "kineticEnergy")
      sinew::traverse(scope, sinew::on<role::BehaviorModel>([&](auto& model, auto const&) {
                        energy += model.kineticEnergy();
                      }));
    return add_numbers(cells, measure, {energy});
  }
  if (measure.name == "largestDisplacement") {
    const auto now = sinew::capture(simulation.root(), simulation.step(), simulation.time());
    return add_numbers(cells, measure, {largest_displacement(start, now, below_top(node))});
  }
  if (measure.name == "reaction") {
    const Eigen::Vector3d force = reaction_below(node);
    return add_numbers(cells, measure, {force.x(), force.y(), force.z()});
  }
  throw wrong(
      measure,
      text("a node has no '",
           measure.name,
           '\'',
           meant(measure.name,
                 {ofNodes.begin(), ofNodes.end()},
                 "; name a component of it, or kineticEnergy, potentialEnergy, largestDisplacement or "
                 "reaction")));
}

// words of a list, of an entry of it, or of one value
void add_field(Cells& cells, Measure const& measure, sinew::FieldInfo const& field, void const* component) {
  const std::string value = field.write(component);
  auto const& entry = measure.entry;
  const bool words = field.kind == "text" || field.isFile;
  const bool list = field.kind.starts_with("list of");
  if (entry.empty() && (list || words)) return cells.emplace_back(measure.words, value), void();
  if (words && !list) throw wrong(measure, "it is a text; leave out what is in brackets");
  std::vector<std::string> all;
  for (sinew::Words w(value); !w.end();) all.emplace_back(w.next());
  std::size_t begin = 0, size = all.size();
  std::string name = text(measure.path, '.', measure.name);
  std::size_t next = 0;
  if (list) {
    const std::size_t entries = field.type->entries(static_cast<char const*>(component) + field.offset);
    if (entry[0] >= entries)
      throw wrong(measure,
                  entries == 0
                      ? std::string("the list is empty")
                      : text("there is no entry ", entry[0], "; it has ", entries, ", numbered from 0"));
    if (size % entries != 0)
      throw wrong(measure, "its entries are not of the same size; leave out what is in brackets");
    size /= entries;
    begin = entry[0] * size;
    name += text('[', entry[0], ']');
    next = 1;
  }
  if (entry.size() > next) {
    if (entry.size() > next + 1 || entry[next] >= size || size == 1)
      throw wrong(measure,
                  size == 1
                      ? std::string("it is one number; leave out the last bracket")
                      : text("there is no number ", entry[next], "; it has ", size, ", numbered from 0"));
    return cells.emplace_back(measure.words, all[begin + entry[next]]), void();
  }
  if (size <= 1) return cells.emplace_back(measure.words, size == 1 ? all[begin] : ""), void();
  for (std::size_t i = 0; i < size; ++i) cells.emplace_back(text(name, '[', i, ']'), all[begin + i]);
}

// as in records, of which a place below the top is at or below a path
bool is_below(std::string_view path, std::string_view top) {
  return top.empty() || path == top || (path.starts_with(top) && path[top.size()] == '/');
}

void add_converged(Node const& node, bool& all) {
  for (auto const& entry : node.components())
    entry.component.visit<role::LinearSolver, role::OdeSolver>([&](auto const& c) {
      if constexpr (requires { c.newton.converged(); })
        // one iteration of a solver in time is not looked at
        all = all && (c.newton.residuals.empty() || c.newton.converged());
      if constexpr (requires { c.residuals.back(), c.tolerance, c.iterations; })
        if (c.tolerance > 0 && !c.residuals.empty())
          all = all && (c.residuals.back() <= c.tolerance || int(c.residuals.size()) <= c.iterations);
    });
  for (auto const& child : node.children()) add_converged(*child, all);
}

}  // namespace

Measure::Measure(std::string asked) : words(std::move(asked)) {
  const std::size_t bracket = std::min(words.find('['), words.size());
  std::string_view before = std::string_view(words).substr(0, bracket);
  std::string_view rest = std::string_view(words).substr(bracket);
  const std::size_t dot = before.rfind('.');
  bool good = dot != before.npos && dot + 1 < before.size();
  if (good) path = before.substr(0, dot), name = before.substr(dot + 1);
  while (good && !rest.empty()) {
    const std::size_t end = rest.find(']');
    std::size_t number = 0;
    good = rest[0] == '[' && end != rest.npos && sinew::io::parse_number(rest.substr(1, end - 1), number) &&
           entry.size() < 2;
    entry.push_back(number);
    rest.remove_prefix(good ? end + 1 : rest.size());
  }
  if (!good)
    throw wrong(*this,
                "is not of the form path.name, or path.name[entry][number], as in liver/dofs.position[3][1]");
}

bool needs_forces(Measure const& measure) { return measure.name == "reaction"; }

std::string cell_of(double value) {
  std::string words;
  if (std::isfinite(value)) sinew::io::append_number(words, value);
  return words;
}

double largest_displacement(sinew::RecordedFrame const& start, sinew::RecordedFrame const& now,
                            std::string_view below) {
  double largest = 0;
  for (std::size_t s = 0; s < now.states.size(); ++s) {
    sinew::RecordedState const& b = now.states[s];
    if (!is_below(b.path, below)) continue;
    const auto a = std::find_if(
        start.states.begin(), start.states.end(), [&](auto const& state) { return state.path == b.path; });
    if (a == start.states.end() || a->points != b.points) return std::nan("");
    const auto layout = *sinew::record_layout(b.dataTypes);
    for (std::size_t p = 0; p < b.points; ++p) {
      double squares = 0;
      for (std::size_t i = p * layout.position; i < p * layout.position + layout.place; ++i)
        squares += (b.positions[i] - a->positions[i]) * (b.positions[i] - a->positions[i]);
      largest = std::max(largest, squares);
    }
  }
  return std::sqrt(largest);
}

bool converged(Scene& scene) {
  bool all = true;
  for (auto const& warning : scene.simulation.warnings().list())
    if (warning.what == "the constraints are not solved" && warning.last == scene.simulation.step())
      all = false;
  add_converged(scene.simulation.root(), all);
  return all;
}

void add_measured(Cells& cells, Measure const& measure, Scene& scene, sinew::RecordedFrame const& start) {
  const Place at = find(measure, scene.simulation.root());
  if (!at.entry) return add_of_node(cells, measure, *at.node, scene, start);
  static const auto table = sinew::make_class_table<sinew::Standard>();
  sinew::ClassInfo const& info = table[std::size_t(at.entry->component.type())];
  if (auto const* field = info.field(measure.name))
    return add_field(cells, measure, *field, at.entry->component.address());
  bool isSolver = false;
  const double residual = residual_of(*at.entry, isSolver);
  if (isSolver && measure.name == ofSolvers) return add_numbers(cells, measure, {residual});
  std::vector<std::string> known;
  for (auto const& f : info.fields) known.emplace_back(f.name);
  if (isSolver) known.emplace_back(ofSolvers);
  throw wrong(measure,
              text('<',
                   info.name,
                   "> has no '",
                   measure.name,
                   '\'',
                   meant(measure.name, known, text("; 'sinew list ", info.name, "' shows what it has"))));
}

}  // namespace cli
