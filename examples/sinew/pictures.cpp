// SPDX-License-Identifier: BSL-1.0
#include "pictures.hpp"

#include <algorithm>

namespace cli {

namespace {

// "liver_skin" for the node /root/liver/skin: a name that every file system takes
std::string file_name(Node const& node) {
  std::string name = node.parent() ? node.path() : node.name;
  if (node.parent()) name = name.substr(std::min(name.find('/', 1) + 1, name.size()));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
    if (!plain) c = '_';
  }
  if (name.empty() || name.starts_with('.')) name.insert(name.begin(), '_');
  return name;
}

template <class T>
std::vector<T> copy(std::span<T const> elements) {
  return {elements.begin(), elements.end()};
}

// the elements of the highest dimension: those below are faces and edges of them
void take_elements(sinew::TopologyView const& topology, sinew::Mesh& mesh) {
  mesh.tetrahedra = copy(topology.tetrahedra);
  mesh.hexahedra = copy(topology.hexahedra);
  mesh.pyramids = copy(topology.pyramids);
  mesh.prisms = copy(topology.prisms);
  mesh.quadraticTetrahedra = copy(topology.quadraticTetrahedra);
  mesh.quadraticHexahedra = copy(topology.quadraticHexahedra);
  mesh.triquadraticHexahedra = copy(topology.triquadraticHexahedra);
  if (sinew::dimension_of(mesh) == 3) return;
  mesh.triangles = copy(topology.triangles);
  mesh.quads = copy(topology.quads);
  if (!mesh.triangles.empty() || !mesh.quads.empty()) return;
  mesh.edges = copy(topology.edges);
}

bool has_elements(sinew::TopologyView const& t) { return sinew::dimension_of(t) > 0; }

// what contacts do to the points of the state of a node
std::vector<Eigen::Vector3d> contact_forces(Node& top, Node& node) {
  std::vector<Eigen::Vector3d> all;
  if (!node.state()) return all;
  void const* state = node.state()->component.address();
  node.state()->component.visit<sinew::role::State>(
      [&](auto const& s) { all.assign(s.size(), Eigen::Vector3d::Zero()); });
  for (auto& entry : top.components())
    entry.component.visit<sinew::role::ContactManager>([&](auto& manager) {
      auto add = [&](sinew::ContactSide const& side, Eigen::Vector3d const& force) {
        if (side.surface < 0 || manager.surfaces[std::size_t(side.surface)]->state != state) return;
        for (std::size_t k = 0; k < std::size_t(side.corners()); ++k)
          all[std::size_t(side.vertices[k])] += side.weights[k] * force;
      };
      for (auto const& c : manager.contacts) add(c.a, -c.force), add(c.b, c.force);
      for (auto const& a : manager.attachments) add(a.contact.b, a.contact.force);
    });
  for (auto const& child : top.children()) {
    const auto below = contact_forces(*child, node);
    for (std::size_t i = 0; i < below.size(); ++i) all[i] += below[i];
  }
  return all;
}
template <class D, class State>
void add_forces(State const& state, std::vector<Eigen::Vector3d> const& contacts,
                sinew::io::PointData& data) {
  sinew::io::PointArray contact{"contactForce", 3}, reaction{"reaction", 3}, net{"netForce", 3};
  auto add = [](sinew::io::PointArray& array, Eigen::Vector3d const& f) {
    array.values.insert(array.values.end(), f.begin(), f.end());
  };
  for (std::size_t i = 0; i < state.size(); ++i) {
    add(contact, contacts[i]);
    add(reaction, sinew::detail::wrench_of<D>(state.reaction[i]).force);
    add(net, sinew::detail::wrench_of<D>(typename D::Deriv(state.applied[i] + state.reaction[i])).force);
  }
  for (auto* array : {&contact, &reaction, &net}) data.push_back(std::move(*array));
}

}  // namespace

Pictures::Pictures(std::string folder, Node& top) : folder_(std::move(folder)) { collect(top); }

// says whether something is shown of the node or below
bool Pictures::collect(Node& node) {
  if (node.visual()) {
    include(node, true);
    for (auto const& child : node.children()) collect(*child);
    return true;
  }
  bool below = false;
  const std::size_t place = series_.size();
  for (auto const& child : node.children()) below = collect(*child) || below;
  // a mapped state without elements is a help for others, and is not looked at
  const bool elements = has_elements(sinew::RuntimeScope<sinew::Standard>(node).topology());
  if (!node.state() || below || (node.mapping() && !elements)) return below;
  include(node, false);
  std::rotate(series_.begin() + std::ptrdiff_t(place), series_.end() - 1, series_.end());
  return true;
}

void Pictures::include(Node& node, bool visual) {
  const std::string name = sinew::text(folder_, folder_.ends_with('/') ? "" : "/", file_name(node));
  std::string stem = name;
  auto taken = [&](Series const& s) { return s.files.path() == stem + ".pvd"; };
  for (int n = 2; std::any_of(series_.begin(), series_.end(), taken); ++n) stem = sinew::text(name, '_', n);
  series_.push_back({&node, visual, sinew::io::PvdSeries(stem + ".pvd")});
}

void Pictures::add(sinew::StandardSimulation& simulation) {
  simulation.updateVisual();
  for (auto& series : series_) {
    sinew::Mesh mesh;
    sinew::io::PointData data;
    const auto contactForces = contact_forces(simulation.root(), *series.node);
    if (series.visual) {
      series.node->visual()->component.visit<sinew::role::VisualModel>(
          [&](auto const& visual) { mesh = visual.current(); });
    } else {
      take_elements(sinew::RuntimeScope<sinew::Standard>(*series.node).topology(), mesh);
      series.node->state()->component.visit<sinew::role::State>([&](auto const& state) {
        using D = typename std::decay_t<decltype(state)>::DataTypes;
        sinew::io::PointArray velocity{"velocity", 3};
        if (state.reaction.size() == state.size()) add_forces<D>(state, contactForces, data);
        for (std::size_t i = 0; i < state.size(); ++i) {
          Eigen::Vector3d x = Eigen::Vector3d::Zero(), v = x;
          x.head<D::spatial>() = D::center(state.position[i]).template cast<double>();
          v.head<D::spatial>() = state.velocity[i].template head<D::spatial>().template cast<double>();
          mesh.positions.push_back(x);
          velocity.values.insert(velocity.values.end(), v.begin(), v.end());
        }
        data.push_back(std::move(velocity));
      });
    }
    series.files.add(simulation.time(), mesh, data);
  }
}

std::vector<std::string> Pictures::paths() const {
  std::vector<std::string> all;
  for (auto const& series : series_) all.push_back(series.files.path());
  return all;
}

}  // namespace cli
