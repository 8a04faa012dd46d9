// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"
#include "error_of.hpp"
#include "view/triangle.hpp"

#include <sinew/collision/contact_responses.hpp>
#include <sinew/contact.hpp>
#include <sinew/control/write_state.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/topology/regular_grid.hpp>
#include <sinew/view/stage.hpp>

#include <filesystem>

namespace test_seen_fields {

using namespace sinew;
using view::SeenComponent;
using view::SeenField;

auto block(double young) {
  Mesh mesh = regular_grid_tetrahedra(4, 3, 3, {0, 0, 0}, {1, 1, 1});
  return Simulation{node<"root">(
      Gravity{{0, -9.81, 0}},
      EulerImplicitSolver{},
      CGLinearSolver<>{.iterations = 50, .tolerance = 1e-14},
      node<"empty">(),
      node<"block">(MeshTopology{.position = mesh.positions, .tetrahedra = mesh.tetrahedra},
                    MechanicalObject<Vec3d>{},
                    UniformMass<Vec3d>{.totalMass = 1},
                    TetrahedronFEMForceField<Vec3d>{.youngModulus = {young}, .poissonRatio = 0.3},
                    FixedConstraint<Vec3d>{.indices = {0, 1, 2}}))};
}
template <class Simulation>
int line_of(Simulation& sim, std::string_view className) {
  const auto tree = view::scene_tree(sim);
  for (std::size_t i = 0; i < tree.size(); ++i)
    if (tree[i].className == className) return int(i);
  return -1;
}
SeenField const& field_of(SeenComponent const& component, std::string_view name) {
  for (SeenField const& field : component.fields)
    if (field.name == name) return field;
  throw Error("test", "no field of this name");
}

TEST_CASE("what a component says of its fields") {
  auto sim = block(5000);
  sim.init();
  const auto tree = view::scene_tree(sim);
  REQUIRE(tree.size() == 11);
  CHECK(tree[4].name == "empty");
  CHECK(tree[5].name == "block");
  CHECK(tree[6].depth == 2);
  const SeenComponent fem = view::seen_component(sim, line_of(sim, "TetrahedronFEMForceField<Vec3d>"));
  CHECK(fem.path == "/root/block");
  CHECK(fem.role == "force field");
  REQUIRE(fem.fields.size() == 7);  // three of plasticity, and its strain
  SeenField const& young = fem.fields[0];
  CHECK(young.name == "youngModulus");
  CHECK(young.value == "5000");
  CHECK(young.unit == "Pa");
  CHECK(young.rangeWords == "greater than 0");
  CHECK(young.fixed.empty());
  SeenField const& method = field_of(fem, "method");
  CHECK(method.value == "large");
  CHECK(method.choices == std::vector<std::string>{"small", "large", "polar", "gradient", "nearest"});
  // long lists are counted
  const int state = line_of(sim, "MechanicalObject<Vec3d>");
  const SeenComponent body = view::seen_component(sim, state);
  CHECK(field_of(body, "position").entries == 36);
  CHECK(field_of(body, "position").whole);
  CHECK_FALSE(field_of(body, "scale3d").fixed.empty());
  const SeenComponent mesh = view::seen_component(sim, line_of(sim, "MeshTopology"));
  SeenField const& tetrahedra = field_of(mesh, "tetrahedra");
  CHECK(tetrahedra.entries > view::longest_list);
  CHECK_FALSE(tetrahedra.whole);
  CHECK(tetrahedra.value.empty());
  CHECK(view::field_text(sim, state, "position").starts_with("0 0 0 0.33333"));
  for (const int none : {-1, 0, 4, 5, 11, 1000})
    CHECK(error_of([&] { view::seen_component(sim, none); }).find("has no component") != std::string::npos);
}

TEST_CASE("a field that changes in the middle makes the motion of a scene that had it") {
  auto soft = block(500), stiff = block(5000), fresh = block(500);
  for (auto* sim : {&soft, &stiff, &fresh}) sim->init();
  for (auto* sim : {&soft, &stiff}) sim->animate(0.01);
  CHECK(soft.at<"block">().state().position != stiff.at<"block">().state().position);
  // the same place, speed, and material: the same steps
  const int fem = line_of(stiff, "TetrahedronFEMForceField<Vec3d>"),
            state = line_of(stiff, "MechanicalObject<Vec3d>");
  const view::FieldChange change = view::set_field(stiff, fem, "youngModulus", " 5e2 ");
  CHECK(change.before == "5000");
  CHECK(change.after == "500");
  for (std::string_view field : {"position", "velocity"})
    view::set_field(stiff, state, field, view::field_text(soft, state, field));
  CHECK(stiff.time() == 0.01);
  for (auto* sim : {&soft, &stiff}) sim->animate(0.01);
  CHECK(soft.at<"block">().state().position == stiff.at<"block">().state().position);
  CHECK(stiff.step() == 2);
  // what is initialised again with a mass or a topology, and the start
  view::set_field(stiff, line_of(stiff, "UniformMass<Vec3d>"), "totalMass", "2");
  for (auto* sim : {&stiff, &fresh}) sim->reset();
  stiff.animate(0.01);
  fresh.animate(0.01);
  CHECK(stiff.at<"block">().state().position != fresh.at<"block">().state().position);
  view::set_field(fresh, line_of(fresh, "UniformMass<Vec3d>"), "totalMass", "2");
  for (auto* sim : {&stiff, &fresh}) {
    sim->reset();
    for (int i = 0; i < 3; ++i) sim->animate(0.01);
  }
  CHECK(stiff.at<"block">().state().position == fresh.at<"block">().state().position);
}

TEST_CASE("what a field cannot be, and what cannot be changed") {
  auto sim = block(5000);
  sim.init();
  const int fem = line_of(sim, "TetrahedronFEMForceField<Vec3d>"),
            state = line_of(sim, "MechanicalObject<Vec3d>");
  auto wrong = [&](int line, std::string_view field, std::string_view words) {
    return error_of([&] { view::set_field(sim, line, field, words); });
  };
  const std::string where = "/root/block: TetrahedronFEMForceField<Vec3d>: ";
  CHECK(wrong(fem, "youngModulus", "soft") == where + "youngModulus: 'soft' is no number; correct it");
  CHECK(wrong(fem, "youngModulus", "-5") ==
        where +
            "youngModulus[0] is -5 Pa, but must be a finite number, greater than 0 (stiffness of the "
            "material: one value, or one a tetrahedron); correct this value");
  CHECK(wrong(fem, "poissonRatio", "nan").find("must be a finite number") != std::string::npos);
  CHECK(wrong(fem, "poissonRatio", "0.3 0.4").find("goes on with '0.4'") != std::string::npos);
  CHECK(wrong(fem, "method", "larg").find("did you mean 'large'?") != std::string::npos);
  CHECK(wrong(fem, "youngsModulus", "1").find("did you mean 'youngModulus'?") != std::string::npos);
  CHECK(wrong(fem, "youngModulus", "1 2 3").find("youngModulus") != std::string::npos);
  CHECK(wrong(state, "scale3d", "2 2 2").find("says where a scene starts") != std::string::npos);
  CHECK(wrong(state, "position", "1 2 3").find("here are 1 entries for a state of 36") != std::string::npos);
  CHECK(wrong(line_of(sim, "MeshTopology"), "tetrahedra", "0 1 2 99").find("99") != std::string::npos);
  // nothing has changed
  CHECK(view::field_text(sim, fem, "youngModulus") == "5000");
  CHECK(view::field_text(sim, fem, "poissonRatio") == "0.3");
  auto other = block(5000);
  other.init();
  for (auto* s : {&sim, &other}) s->animate(0.01);
  CHECK(sim.at<"block">().state().position == other.at<"block">().state().position);
}

TEST_CASE("files that a component writes keep their names") {
  const std::string file = (std::filesystem::temp_directory_path() / "sinew_fields.state").string(),
                    other = file + ".other";
  {
    Simulation sim{node<"root">(EulerExplicitSolver{},
                                node<"body">(MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                             UniformMass<Vec3d>{},
                                             WriteState<Vec3d>{.filename = file}))};
    sim.init();
    const int line = line_of(sim, "WriteState<Vec3d>");
    CHECK(error_of([&] { view::set_field(sim, line, "filename", other); })
              .ends_with("filename cannot be changed while the scene is there: files are read and written by "
                         "the scene as it starts"));
    sim.animate(0.01);
  }
  CHECK(std::filesystem::remove(file));
  CHECK_FALSE(std::filesystem::exists(other));
}

TEST_CASE("a scene that is composed while the program runs has the same fields") {
  using Few = Registry<Gravity,
                       MechanicalObject<Vec3d>,
                       UniformMass<Vec3d>,
                       EulerImplicitSolver,
                       CGLinearSolver<>,
                       StiffSpringForceField<Vec3d>>;
  RuntimeNode<Few> root("root");
  root.add(Gravity{{0, -9.81, 0}});
  root.add(EulerImplicitSolver{});
  root.add(CGLinearSolver<>{});
  auto& body = root.addChild("body");
  body.add(MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}});
  body.add(UniformMass<Vec3d>{.totalMass = 2}, "weight");
  Simulation sim{std::move(root)};
  sim.init();
  view::Stage stage(sim, 0.01);
  REQUIRE(stage.tree.size() == 7);
  CHECK(stage.tree[6].name == "weight");
  stage.select(6);
  stage.settle();
  REQUIRE(stage.state().selected);
  CHECK(stage.state().selected->name == "weight");
  CHECK(field_of(*stage.state().selected, "totalMass").value == "2");
  stage.setField(6, "totalMass", "8");
  stage.setField(1, "gravity", "0 0 -1");
  std::string error = "none";
  stage.setField(6, "totalMass", "-8", [&](std::string const& e) { error = e; });
  stage.settle();
  CHECK(error.find("must be a finite number") != std::string::npos);
  CHECK(stage.state().error.empty());
  CHECK(field_of(*stage.state().selected, "totalMass").value == "8");
  REQUIRE(stage.state().undo);
  CHECK(stage.state().undo->field == "gravity");
  CHECK_FALSE(stage.state().redo);
  stage.undo();
  stage.undo();
  stage.undo();  // there is none
  stage.settle();
  CHECK(field_of(*stage.state().selected, "totalMass").value == "2");
  CHECK_FALSE(stage.state().undo);
  CHECK(stage.state().redo->field == "totalMass");
  stage.redo();
  stage.settle();
  CHECK(field_of(*stage.state().selected, "totalMass").value == "8");
  stage.setField(6, "totalMass", "3");  // what was undone is forgotten
  stage.settle();
  CHECK_FALSE(stage.state().redo);
  stage.setField(6, "totalMass", "light");
  stage.settle();
  CHECK(stage.state().error.find("'light' is no number") != std::string::npos);
  std::string text;
  stage.fieldText(5, "position", [&](std::string const& value, std::string const&) { text = value; });
  stage.component(99, [&](SeenComponent const&, std::string const& e) { error = e; });
  stage.select(0);
  stage.settle();
  CHECK(text == "0 0 0 1 0 0");
  CHECK(error.find("line 99") != std::string::npos);
  CHECK_FALSE(stage.state().selected);
}

TEST_CASE("a body stays held while a field changes") {
  auto sim = test_view::triangle();
  sim.init();
  view::Stage stage(sim, 0.01);
  stage.press({0.2, 0.2, 1}, {0, 0, -1}, 100);
  stage.move({0.6, 0.2, 1}, {0, 0, -1});
  stage.step();
  stage.setField(line_of(sim, "UniformMass<Vec3d>"), "totalMass", "5");
  stage.step();
  stage.settle();
  CHECK(stage.state().error.empty());
  REQUIRE(stage.state().held);
  CHECK(stage.state().held->force.x() > 0);
  CHECK(view::field_text(sim, line_of(sim, "UniformMass<Vec3d>"), "totalMass") == "5");
}

}  // namespace test_seen_fields
