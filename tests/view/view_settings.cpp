// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include <sinew/mechanics.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/view/picture.hpp>
#include <sinew/view/view_settings.hpp>

namespace test_view_settings {

using namespace sinew;
using Catch::Matchers::Contains;
using view::view_settings;
using view::ViewSettings;

ViewSettings of(ViewElement element) {
  element.origin = "a.scn:3:5";
  return view_settings(std::array{element});
}
ViewSettings of(std::string tag, std::vector<std::pair<std::string, std::string>> attributes) {
  return of({.path = "/root/a", .tag = std::move(tag), .attributes = std::move(attributes)});
}

TEST_CASE("flags of a visual style") {
  CHECK(of("VisualStyle", {}).seen.visualModels);
  const auto all = of("VisualStyle", {{"displayFlags", "showAll hideCollisionModels showWireframe"}}).seen;
  CHECK(all.states);
  CHECK(all.springs);
  CHECK_FALSE(all.collisionModels);
  CHECK(all.wireframe);
  const auto some = of("VisualStyle", {{"displayFlags", "hideVisual showBehaviorModels showMappings"}});
  CHECK_FALSE(some.seen.visualModels);
  CHECK(some.seen.states);
  CHECK_FALSE(some.seen.springs);
  CHECK(some.warnings.empty());
  const auto wrong = of("VisualStyle", {{"displayFlags", "showNothing Visual showNormals"}});
  CHECK(wrong.seen.normals);
  REQUIRE(wrong.warnings.size() == 2);
  CHECK(wrong.warnings[0] ==
        "a.scn:3:5: <VisualStyle>: displayFlags: 'showNothing' is not known; it is left out");
}

TEST_CASE("colours and materials") {
  auto colour = [](std::string const& words) {
    const auto settings = of("OglModel", {{"color", words}});
    return settings.seen.looks.size() == 1 ? *settings.seen.looks[0].colour : Eigen::Vector3d(-1, -1, -1);
  };
  CHECK(colour("red") == Eigen::Vector3d(1, 0, 0));
  CHECK(colour("0.2 0.4 0.6 1") == Eigen::Vector3d(0.2, 0.4, 0.6));
  CHECK(colour("[0.2, 0.4, 0.6]") == Eigen::Vector3d(0.2, 0.4, 0.6));
  CHECK(colour("#ff0033") == Eigen::Vector3d(1, 0, 0.2));
  CHECK(colour("#FF003380") == Eigen::Vector3d(1, 0, 0.2));
  auto opacity = [](std::string const& name, std::string const& words) {
    const auto settings = of("OglModel", {{name, words}});
    return settings.seen.looks.at(0).opacity.value();
  };
  CHECK(opacity("color", "red") == 1);
  CHECK(opacity("color", "1 0 0 0.3") == 0.3);
  CHECK(opacity("color", "#FF003380") == Approx(128 / 255.));
  CHECK(opacity("material", "Default Diffuse 1 1 0 0 0.5 Ambient 1 0 0 0 1") == 0.5);
  CHECK(colour("") == Eigen::Vector3d(-1, -1, -1));
  for (char const* wrong : {"reddish", "#ff00", "#gg0000", "1 2 3", "1 0", "nan 0 0", "-1 0 0"}) {
    const auto settings = of("OglModel", {{"color", wrong}});
    CHECK(settings.seen.looks.empty());
    REQUIRE(settings.warnings.size() == 1);
    CHECK_THAT(settings.warnings[0], Contains("<OglModel>: color: "));
  }
  const auto material =
      of("OglModel",
         {{"material", "Texture Ambient 1 0.2 0.2 0.2 1 Diffuse 1 0.5 0.25 0 1 Specular 0 1 1 1 1"}});
  REQUIRE(material.seen.looks.size() == 1);
  CHECK(material.seen.looks[0].path == "/root/a");
  CHECK(*material.seen.looks[0].colour == Eigen::Vector3d(0.5, 0.25, 0));
  CHECK(of("OglModel", {{"material", "Default Diffuse 0 1 0 0 1"}}).seen.looks.empty());
  CHECK(of("OglModel", {{"material", "Default Diffuse 1 1"}}).warnings.size() == 1);
  CHECK(*of("BackgroundSetting", {{"color", "black"}}).seen.background == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("cameras, axes, grids and planes") {
  const auto looks =
      of("InteractiveCamera", {{"position", "0 2 5"}, {"lookAt", "0 2 1"}, {"fieldOfView", "30"}});
  REQUIRE(looks.camera);
  CHECK((looks.camera->eye() - Eigen::Vector3d(0, 2, 5)).norm() < 1e-12);
  CHECK(looks.camera->target == Eigen::Vector3d(0, 2, 1));
  CHECK(looks.camera->angle == 30);
  // a quarter turn about x looks down from above
  const auto turned =
      of("InteractiveCamera",
         {{"position", "0 3 0"}, {"orientation", "-0.70710678 0 0 0.70710678"}, {"distance", "2"}});
  REQUIRE(turned.camera);
  CHECK((turned.camera->target - Eigen::Vector3d(0, 1, 0)).norm() < 1e-6);
  CHECK(turned.camera->right().allFinite());
  const auto down = of("Camera", {{"position", "0 3 0"}, {"lookAt", "0 0 0"}});
  CHECK(down.camera->right().allFinite());
  CHECK_FALSE(of("InteractiveCamera", {{"position", "0 3 0"}}).camera);
  for (auto const& [name, value] : std::vector<std::pair<std::string, std::string>>{
           {"lookAt", "0 2 5"}, {"fieldOfView", "180"}, {"lookAt", "a b c"}, {"orientation", "0 0 0 0"}}) {
    auto attributes = std::vector<std::pair<std::string, std::string>>{{"position", "0 2 5"}};
    if (name != "lookAt") attributes.emplace_back("lookAt", "0 0 0");
    attributes.emplace_back(name, value);
    const auto wrong = of("InteractiveCamera", attributes);
    CHECK_FALSE(wrong.camera);
    CHECK(wrong.warnings.size() == 1);
  }
  CHECK(of("OglSceneFrame", {}).seen.axes);
  CHECK(of("VisualGrid", {}).seen.grid);
  const auto clip = of("ClipPlane", {{"position", "0 1 0"}, {"normal", "0 2 0"}});
  CHECK(clip.seen.clip->normal == Eigen::Vector3d(0, -1, 0));
  CHECK(clip.seen.clip->offset == -1);
  CHECK_FALSE(of("ClipPlane", {{"active", "0"}}).seen.clip);
}

TEST_CASE("lights") {
  using Kind = view::SeenLight::Kind;
  auto light = [](std::string const& tag, std::vector<std::pair<std::string, std::string>> attributes) {
    const auto settings = of(tag, std::move(attributes));
    REQUIRE(settings.seen.lights.size() == 1);
    return settings.seen.lights[0];
  };
  const auto plain = light("DirectionalLight", {});
  CHECK(plain.kind == Kind::parallel);
  CHECK(plain.direction == Eigen::Vector3d(0, 0, -1));
  CHECK(plain.colour == Eigen::Vector3d(1, 1, 1));
  CHECK(light("DirectionalLight", {{"direction", "0 3 0"}, {"color", "1 0.5 0 1"}}).direction ==
        Eigen::Vector3d(0, 1, 0));
  const auto point =
      light("PositionalLight", {{"position", "1 2 3"}, {"attenuation", "0.5"}, {"fixed", "true"}});
  CHECK(point.kind == Kind::point);
  CHECK(point.position == Eigen::Vector3d(1, 2, 3));
  CHECK(point.attenuation == 0.5);
  CHECK(point.movesWithCamera);
  const auto spot = light(
      "SpotLight",
      {{"position", "0 5 0"}, {"direction", "0 1 0"}, {"lookat", "1"}, {"cutoff", "40"}, {"exponent", "2"}});
  CHECK(spot.kind == Kind::spot);
  CHECK(spot.direction == Eigen::Vector3d(0, -1, 0));  // towards the point that it looks at
  CHECK(spot.cutoff == 40);
  CHECK(spot.exponent == 2);
  CHECK(*of("LightManager", {{"ambient", "0.1 0.2 0.3 1"}}).seen.ambient == Eigen::Vector3d(0.1, 0.2, 0.3));
  CHECK_FALSE(of("LightManager", {{"shadows", "0"}}).seen.shadows);
  CHECK(of("LightManager", {}).seen.shadows);
  CHECK(of("VisualStyle", {{"displayFlags", "showBoundingCollisionModels"}}).seen.boxes);
  auto wrong = [](std::string const& tag, std::string const& name, std::string const& value) {
    const auto settings = of(tag, {{name, value}});
    CHECK(settings.seen.lights.empty());
    return settings.warnings.size() == 1 ? settings.warnings[0] : std::string();
  };
  CHECK(wrong("DirectionalLight", "direction", "0 0 0") ==
        "a.scn:3:5: <DirectionalLight>: direction: the light shines to nowhere; it is left out");
  CHECK_THAT(wrong("DirectionalLight", "color", "bright"), Contains("color: "));
  CHECK_THAT(wrong("SpotLight", "cutoff", "120"), Contains("cutoff: it is above 0 and up to 90 degrees"));
  CHECK_THAT(wrong("PositionalLight", "attenuation", "-1"), Contains("attenuation: it is at least 0"));
  const std::vector<ViewElement> nine(9, {.tag = "DirectionalLight"});
  const auto many = view_settings(nine);
  CHECK(many.seen.lights.size() == 8);
  REQUIRE(many.warnings.size() == 1);
  CHECK_THAT(many.warnings[0], Contains("up to 8 lights"));
}

TEST_CASE("a scene file keeps how it is looked at, also through a change and in a checkpoint") {
  using Few =
      Registry<Gravity, MechanicalObject<Vec3d>, UniformMass<Vec3d>, EulerExplicitSolver, VisualModel>;
  auto scene = parse_scene<Few>("a.scn", R"(<Node name="root">
    <VisualStyle displayFlags="showVisual"/>
    <BackgroundSetting color="0 0 0"/>
    <LightManager ambient="0.2 0.2 0.2"/>
    <Node name="v">
      <DirectionalLight direction="0 0 1"/>
      <OglModel color="0 1 0" position="0 0 0  1 0 0  0 1 0" triangles="0 1 2"/>
    </Node></Node>)");
  CHECK(scene.ignored.empty());
  REQUIRE(scene.root.view.size() == 5);
  CHECK(scene.root.view[0].origin == "a.scn:2:5");
  auto sim = start(std::move(scene));
  sim.change([](auto&) {});
  auto check = [](auto& simulation) {
    const ViewSettings settings = view::view_settings_of(simulation);
    CHECK(settings.warnings.empty());
    CHECK(settings.seen.lights.size() == 1);
    CHECK(settings.seen.ambient);
    const view::Image image =
        view::Picture(simulation, {.width = 40, .height = 30, .camera = {}, .seen = settings.seen}).image();
    CHECK(image.at(1, 1) == std::array<unsigned char, 3>{0, 0, 0});
    const auto middle = image.at(18, 17);
    CHECK(middle[1] > 60);
    CHECK(middle[0] < middle[1] / 2);
  };
  check(sim);
  auto again = start(parse_scene<Few>("b.scn", scene_text(sim, 0.01)));
  check(again);
}

}  // namespace test_view_settings
