// SPDX-License-Identifier: BSL-1.0
#include "catch.hpp"

#include "error_of.hpp"

#include <sinew/view/protocol.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <random>

namespace test_protocol {

using namespace sinew;
using namespace sinew::view;

const std::vector<Command> every{command::Play{true},
                                 command::Play{false},
                                 command::Step{},
                                 command::Reset{},
                                 command::Speed{0.1},
                                 command::Press{{0.1, -2e-7, 1e9}, Eigen::Vector3d(1, 2, 2) / 3, 1234.5},
                                 command::Move{{1. / 3, 0, -5}, {0, 0, -1}},
                                 command::Release{},
                                 command::Component{3},
                                 command::SetField{4, "youngModulus", "1000 \"2\"\n"},
                                 command::Undo{},
                                 command::Redo{},
                                 command::Colour{Quantity::vonMises},
                                 command::Profile{true},
                                 command::Profile{false},
                                 command::Measure{true},
                                 command::Measure{false},
                                 command::MeasureField{5, "stiffness"},
                                 command::Measures{-1e300}};

// two bodies, one of them a visual model
SeenScene scene() {
  SeenScene seen;
  seen.up = {0, 0, 1};
  seen.time = 0.1;
  seen.step = 10;
  seen.bodies.push_back({.path = "root/a",
                         .kind = SeenBody::Kind::visual,
                         .points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 1, 0}},
                         .triangles = {{0, 1, 2}},
                         .quads = {{0, 1, 2, 3}},
                         .beyond = {{3, 2, 1}}});
  seen.bodies.push_back({.path = "root/bb",
                         .visible = false,
                         .points = {{1, 2, 3}, {4, 5, 6}},
                         .edges = {{0, 1}},
                         .values = {0.5, 0.25},
                         .colour = {1, 0.5, 0},
                         .opacity = 0.25});
  return seen;
}

std::string refusal(std::string_view json) {
  return error_of([&] { read_command(json); });
}

TEST_CASE("files beside a scene are where it looks for them, too") {
  using Files = std::vector<SceneFile>;
  auto more = [](Files files) {
    const std::size_t count = files.size();
    files = placed(std::move(files));
    return Files(files.begin() + std::ptrdiff_t(count), files.end());
  };
  const SceneFile mesh{"organ.obj", "v 0 0 0"};
  CHECK(more({{"a.scn", "<A filename=\"data/organ.obj\" href='more/organ.obj'/>"}, mesh}) ==
        Files{{"data/organ.obj", mesh.content}, {"more/organ.obj", mesh.content}});
  CHECK(more({{"in/a.scn", "<A filename='data/organ.obj'/>"}, mesh}) ==
        Files{{"in/data/organ.obj", mesh.content}});
  CHECK(more({{"a.scn", "<include href='b/c.xml'/>"}, {"c.xml", "<A f='data/organ.obj'/>"}, mesh}) ==
        Files{{"b/c.xml", "<A f='data/organ.obj'/>"}, {"data/organ.obj", mesh.content}});
  // nothing is named, or only a part of it; it is there already; it is no scene that names it
  for (char const* content : {"",
                              "<A filename='organ.obj'/>",
                              "<A filename='data/organ.objx'/>",
                              "<A filename='data/my-organ.obj'/>",
                              "data/organ.obj"})
    CHECK(more({{"a.scn", content}, mesh}).empty());
  CHECK(more({{"a.scn", "<A filename='data/organ.obj'/>"}, {"data/organ.obj", ""}, mesh}).empty());
  CHECK(more({{"a.txt", "<A filename='data/organ.obj'/>"}, mesh}).empty());
  // out of the folder, and where a file is in the way
  for (char const* name :
       {"/organ.obj", "../organ.obj", "a/../organ.obj", "//organ.obj", "organ.obj/organ.obj"})
    CHECK(more({{"a.scn", text("<A filename='", name, "'/>")}, mesh}).empty());
  // no more than may be sent
  std::string many;
  for (int i = 0; i < 100; ++i) many += text(" 'folder", i, "/organ.obj'");
  CHECK(placed({{"a.scn", many}, mesh}).size() == mostFiles);
  // a name that is everywhere and never ends: what looks back for each to the start does not come to an end
  std::string endless;
  while (endless.size() < longestUpload / 2) endless += "/o";
  CHECK(more({{"a.scn", endless}, {"o", ""}}).empty());
  const SceneFile large{"organ.obj", std::string(longestUpload / 3, ' ')};
  CHECK(more({{"a.scn", many}, large}).size() == 1);
}

TEST_CASE("files of a scene are read as they were sent, and lead nowhere else") {
  const std::vector<SceneFile> files{
      {"liver.SCN", "<Node/>\n"}, {"data/organ.obj", std::string("v 0\0 0", 7)}, {"empty.txt", ""}};
  CHECK(read_upload(write_upload(files)) == files);
  CHECK(scene_among(files) == 0);
  CHECK(scene_among({{"a.xml", ""}, {"b.scn", ""}}) == 1);
  CHECK(scene_among({{"a.obj", ""}, {"b.xml", ""}}) == 1);
  auto none = [](std::vector<SceneFile> const& some) { return error_of([&] { scene_among(some); }); };
  CHECK(none({{"a.obj", ""}}) ==
        "upload: there is no scene among the files (.scn or .xml); take one, with the files that it needs");
  CHECK(none({{"a.scn", ""}, {"b.scn", ""}}) ==
        "upload: there are 2 scenes (.scn); take one, with the files that it needs");
  CHECK(none({{".scn", ""}}) == none({}));

  auto named = [](std::string name) { return error_of([&] { read_upload(write_upload({{name, "x"}})); }); };
  for (char const* name : {"a.scn", "a b/c-1.obj", "a..b", "\xc3\xa4.scn", ".a"}) CHECK(named(name) == "");
  for (char const* name :
       {"", "/etc/passwd", "..", "../a", "a/../b", "a/..", "a//b", "a/", ".", "a\\b", "C:a", "a\nb", "a\x7f"})
    CHECK(named(name).starts_with("upload: the name '"));
  CHECK(named(std::string(longestFileName, 'a')) == "");
  CHECK(named(std::string(longestFileName + 1, 'a')).ends_with("is empty or too long; take another"));
  auto wrong = [](std::string const& bytes) { return error_of([&] { read_upload(bytes); }); };
  CHECK(wrong(write_upload({{"a", ""}, {"a", ""}})) == "upload: two files are called 'a'");
  CHECK(wrong(write_upload({{"a", ""}, {"a/b", ""}})) == "upload: two files are called 'a/b'");
  CHECK(wrong("") == "upload: it begins with no line that names its files");
  CHECK(wrong("[\n") == "upload: its first line is no JSON (RFC 8259)");
  CHECK(wrong(std::string(100, '[') + std::string(100, ']') + '\n') ==
        "upload: its first line is nested too deep");
  for (char const* line : {"[]", "{}", R"({"files": {}})", R"({"files": [], "more": 1})"})
    CHECK(wrong(std::string(line) + '\n') == "upload: its first line lacks the list 'files', or has more");
  CHECK(wrong("{\"files\": []}\n") == "upload: it has 0 files, and must have 1 to 64");
  for (char const* file : {"1",
                           "{}",
                           R"({"name": "a"})",
                           R"({"name": "a", "bytes": -1})",
                           R"({"name": "a", "bytes": 0.5})",
                           R"({"name": 1, "bytes": 1})",
                           R"({"name": "a", "bytes": 1, "more": 1})"})
    CHECK(wrong(std::string("{\"files\": [") + file + "]}\nx") ==
          "upload: a file has a 'name' and a number of 'bytes', and no more");
  const std::string good = write_upload(files);
  CHECK(wrong(good.substr(0, good.size() - 1)) == "upload: it ends too early");
  CHECK(wrong(good + 'x') == "upload: bytes are left at its end");
  CHECK(wrong("{\"files\": [{\"name\": \"a\", \"bytes\": 18446744073709551615}]}\nx") ==
        "upload: it ends too early");
  CHECK(
      error_of([&] { read_upload(std::string(longestUpload + 1, ' ')); }).ends_with("16777216 are allowed"));
  CHECK(error_of([&] {
          read_upload(write_upload(std::vector<SceneFile>(mostFiles + 1, {"a", ""})));
        }).starts_with("upload: it has 65 files"));
}

TEST_CASE("commands are read as they were written") {
  for (Command const& said : every) CHECK(read_command(write_command(said)) == said);
  CHECK(read_command(R"({"do": "speed", "times": 0})") == Command(command::Speed{0}));
  // a direction comes to length 1
  const auto move =
      std::get<command::Move>(read_command(R"({"do":"move","origin":[0,0,0],"direction":[0,3,4]})"));
  CHECK((move.direction - Eigen::Vector3d(0, 0.6, 0.8)).norm() < 1e-15);
}

TEST_CASE("what is no command is refused, with a sentence") {
  CHECK(refusal("") == "command: it is no JSON (RFC 8259)");
  CHECK(refusal("{'do':'play'}") == "command: it is no JSON (RFC 8259)");
  CHECK(refusal(R"({"do":"step"} {"do":"step"})") == "command: it is no JSON (RFC 8259)");
  CHECK(refusal("[]") == "command: it is no object");
  CHECK(refusal("{}") == "command: it lacks the member 'do', which says what to do");
  CHECK(refusal(R"({"do":7})") == "command: it lacks the member 'do', which says what to do");
  CHECK(refusal(R"({"do":"fly"})") ==
        "command: nothing is called 'fly'; there are play, step, reset, speed, press, move, release, "
        "component, "
        "setField, undo, redo, colour, profile, measure, measureField and measures");
  CHECK(refusal(R"({"do":"colour","by":"mood"})") ==
        "command: 'by' is 'mood' and must be one of: none, displacement, speed, vonMises, strainEnergy, "
        "stretch");
  CHECK(refusal(R"({"do":"component","line":1.5})") == "command: 'line' must be a whole number");
  CHECK(refusal(R"({"do":"component","line":-1})").starts_with("command: 'line' is -1 and must be from 0"));
  CHECK(refusal(R"({"do":"setField","line":1,"field":"a","value":1})") == "command: 'value' must be text");
  CHECK(refusal(R"({"do":"play"})") == "command: 'play' lacks its member 'on'");
  CHECK(refusal(R"({"do":"play","on":1})") == "command: 'on' must be true or false");
  CHECK(refusal(R"({"do":"step","on":true})") == "command: 'step' has no member 'on'");
  CHECK(refusal(R"({"do":"speed","times":-1})") == "command: 'times' is -1 and must be from 0 to 1000000");
  CHECK(refusal(R"({"do":"speed","times":"1"})") == "command: 'times' must be a number");
  CHECK(refusal(R"({"do":"speed","times":1e999})") == "command: it is no JSON (RFC 8259)");
  CHECK(refusal(R"({"do":"speed","times":NaN})") == "command: it is no JSON (RFC 8259)");
  CHECK(refusal(R"({"do":"move","origin":[0,0],"direction":[0,0,1]})") ==
        "command: 'origin' must be a list of 3 numbers");
  CHECK(refusal(R"({"do":"move","origin":[0,0,0],"direction":[0,0,0]})") ==
        "command: 'direction' has no direction");
  CHECK(refusal(R"({"do":"press","origin":[0,0,0],"direction":[0,0,1],"stiffness":0})")
            .starts_with("command: 'stiffness' is 0 and must be from"));
  CHECK(refusal(std::string(9000, '[') + std::string(7000, ']')) == "command: it is nested too deep");
  CHECK(refusal(std::string(longestCommand + 1, ' ')) ==
        "command: it has 16385 bytes, and 16384 are allowed");
}

TEST_CASE("a topology and its frames are read as they were written") {
  const SeenScene seen = scene();
  ReadTopology read = read_topology(write_topology(seen, 7));
  CHECK(read.number == 7);
  CHECK(read.scene.up == seen.up);
  REQUIRE(read.scene.bodies.size() == 2);
  CHECK(read.scene.bodies[0].path == "root/a");
  CHECK(read.scene.bodies[0].kind == SeenBody::Kind::visual);
  CHECK(read.scene.bodies[0].visible);
  CHECK(read.scene.bodies[0].triangles == seen.bodies[0].triangles);
  CHECK(read.scene.bodies[0].quads == seen.bodies[0].quads);
  CHECK(read.scene.bodies[0].beyond == seen.bodies[0].beyond);
  CHECK(read.scene.bodies[1].path == "root/bb");
  CHECK(read.scene.bodies[1].kind == SeenBody::Kind::state);
  CHECK_FALSE(read.scene.bodies[1].visible);
  CHECK(read.scene.bodies[1].colour == Eigen::Vector3d(1, 0.5, 0));
  CHECK(read.scene.bodies[0].opacity == 1);
  CHECK(read.scene.bodies[1].opacity == 0.25);
  CHECK(read.scene.bodies[1].edges == seen.bodies[1].edges);
  const std::string frame = write_frame(seen, 7);
  CHECK(frame.size() == 32 + 6 * 16);
  read_frame(frame, read);
  CHECK(read.scene.time == 0.1);
  CHECK(read.scene.step == 10);
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t i = 0; i < seen.bodies[b].points.size(); ++i)
      CHECK(read.scene.bodies[b].points[i] ==
            Eigen::Vector3d(seen.bodies[b].points[i].cast<float>().cast<double>()));
  CHECK(read.scene.bodies[1].values == seen.bodies[1].values);
  CHECK(std::isnan(read.scene.bodies[0].values[3]));
  // without colours
  SeenScene plain = seen;
  plain.bodies[1].values.clear();
  CHECK(write_frame(plain, 7).size() == 32 + 6 * 12);
  read_frame(write_frame(plain, 7), read);
  CHECK(read.scene.bodies[1].values.empty());
}

TEST_CASE("textures and places in them are read as they were written, and are sent once") {
  SeenScene seen = scene();
  SeenBody& body = seen.bodies[0];
  body.texture = std::make_shared<SeenTexture>(SeenTexture{.width = 1, .height = 1, .file = "image"});
  body.specular = {0.25, 0.5, 1};
  body.shininess = 8;
  body.inTexture.texcoords = {{0, 0.5}, {1, 0.25}};
  body.inTexture.triangles = {{0, 1, -1}};
  body.inTexture.quads = {{1, 0, 1, 0}};
  SceneWriter writer;
  writer.write(seen);
  CHECK(writer.texturesNumber() == 1);
  CHECK(read_textures(writer.textures()) == std::vector<std::string>{"image"});
  const ReadTopology read = read_topology(writer.topology());
  CHECK(read.textures == std::vector<std::uint32_t>{1, 0});
  CHECK(read.scene.bodies[0].inTexture == body.inTexture);
  CHECK(read.scene.bodies[0].specular == body.specular);
  CHECK(read.scene.bodies[0].shininess == 8);
  CHECK(read.scene.bodies[1].specular.isApprox(SeenBody::plainSpecular, 1e-6));
  // elements change, and the same texture is sent no more
  seen.bodies[1].edges.clear();
  writer.write(seen);
  CHECK(writer.number() == 2);
  CHECK(writer.texturesNumber() == 1);
  // another image in the same places
  body.texture = std::make_shared<SeenTexture>(SeenTexture{.width = 1, .height = 1, .file = "other"});
  writer.write(seen);
  CHECK(writer.number() == 3);
  CHECK(read_textures(writer.textures()) == std::vector<std::string>{"other"});
  // places that do not belong to the faces are none
  body.inTexture.quads.clear();
  CHECK(read_topology(write_topology(seen, 1)).textures[0] == 0);
  body.texture.reset();
  writer.write(seen);
  CHECK(read_textures(writer.textures()).empty());

  auto refused = [](std::string const& bytes) { return error_of([&] { read_textures(bytes); }); };
  const std::string good = write_textures({std::make_shared<SeenTexture>(SeenTexture{.file = "12345"})});
  CHECK(refused(good).empty());
  for (std::size_t n = 0; n < good.size(); ++n) CHECK_FALSE(refused(good.substr(0, n)).empty());
  CHECK(refused(good + "x") == "textures: bytes are left at its end");
  CHECK(refused(writer.topology()) == "textures: they are none");
}

TEST_CASE("what was measured later is told") {
  const Measures measures{.times = {0.1, 0.2, 0.3},
                          .series = {{"energy", "J", {1, 2, std::nan("")}}, {"k", "", {5, 6, 7}}}};
  CHECK(write_measures(measures, 0.1) ==
        R"({"is":"measures","series":[{"name":"energy","unit":"J","values":[2.0,null]},)"
        R"({"name":"k","unit":"","values":[6.0,7.0]}],"times":[0.2,0.3]})");
  CHECK(write_measures(measures, 0.3) ==
        R"({"is":"measures","series":[{"name":"energy","unit":"J","values":[]},)"
        R"({"name":"k","unit":"","values":[]}],"times":[]})");
  CHECK(write_measures({}, -1e300) == R"({"is":"measures","series":[],"times":[]})");
}

TEST_CASE("bytes that are no topology or frame are refused") {
  const std::string topology = write_topology(scene(), 1), frame = write_frame(scene(), 1);
  auto refused = [](std::string const& bytes) { return error_of([&] { read_topology(bytes); }); };
  CHECK(refused("") == "topology: it ends too early");
  CHECK(refused(frame) == "topology: it is none");
  CHECK(refused(topology + "abcd") == "topology: bytes are left at its end");
  for (std::size_t n = 0; n < topology.size(); ++n) CHECK_FALSE(refused(topology.substr(0, n)).empty());
  SeenScene wrong = scene();
  wrong.bodies[1].edges[0] = {0, 2};
  CHECK(refused(write_topology(wrong, 1)) == "topology: an element has a point that there is not");
  // a number of triangles for which there is no memory
  std::string large = topology;
  large.replace(24 + 28, 4, "\xff\xff\xff\xff");
  CHECK(refused(large) == "topology: it ends too early");

  ReadTopology into = read_topology(topology);
  auto not_frame = [&](std::string const& bytes) { return error_of([&] { read_frame(bytes, into); }); };
  CHECK(not_frame(topology) == "frame: it is none");
  CHECK(not_frame(write_frame(scene(), 2)) == "frame: it is of another topology");
  CHECK(not_frame(frame.substr(0, frame.size() - 4)) == "frame: it has another length than its points");
  std::string values = frame;
  values[12] = 1;
  CHECK(not_frame(values) == "frame: it has another number of values than points");
  std::string kind = topology;
  kind[24] = 3;
  CHECK(refused(kind) == "topology: a body is of no kind that there is");
  wrong.bodies[0].points.pop_back();
  CHECK(not_frame(write_frame(wrong, 1)) == "frame: it has another number of points than its topology");
  CHECK(into.scene.step == 0);
}

TEST_CASE("a topology has a new number when it has changed, and only then") {
  SceneWriter writer;
  SeenScene seen = scene();
  writer.write(seen);
  CHECK(writer.number() == 1);
  ReadTopology read = read_topology(writer.topology());
  read_frame(writer.frame(), read);
  seen.bodies[0].points[0].x() = 0.5;
  seen.step = 11;
  writer.write(seen);
  CHECK(writer.number() == 1);
  read_frame(writer.frame(), read);
  CHECK(read.scene.bodies[0].points[0].x() == 0.5);
  seen.bodies[0].quads.clear();
  writer.write(seen);
  CHECK(writer.number() == 2);
  CHECK(read_topology(writer.topology()).scene.bodies[0].quads.empty());
}

TEST_CASE("what a page is told is JSON") {
  StageState state{.time = 0.5, .stepsPerSecond = std::numeric_limits<double>::quiet_NaN(), .step = 25};
  state.held = Held{.path = "a", .point = {1, 2, 3}, .target = {4, 5, 6}, .force = {0, 0, 7}};
  state.error = "a \"word\"\n\xff";
  // what is no number has none in JSON, and what is no UTF-8 becomes a mark
  SeenScene seen;
  seen.settings.colour = Quantity::speed;
  seen.legend = Legend{"speed", "m/s", 0, 2};
  CHECK(
      write_state(state, seen) ==
      R"({"colour":"speed","error":"a \"word\"\n)"
      "\xef\xbf\xbd"
      R"(","held":{"force":[0.0,0.0,7.0],"path":"a","point":[1.0,2.0,3.0],"target":[4.0,5.0,6.0]},)"
      R"("is":"state","legend":{"high":2.0,"low":0.0,"title":"speed","unit":"m/s"},"playing":false,)"
      R"("profile":null,"profiling":false,"redo":null,"step":25,"stepsPerSecond":null,"time":0.5,"undo":null})");
  state.profiling = true;
  state.profile = std::make_shared<StepProfile>(
      StepProfile{.steps = 3, .shares = {{"fem", "Force<Vec3d>", 1.5, 0.75, 2}, {"step", "", 0.5, 0.25, 1}}});
  CHECK_THAT(
      write_state(state, seen),
      Catch::Matchers::Contains(
          R"("profile":{"shares":[{"class":"Force<Vec3d>","milliseconds":1.5,"name":"fem","share":0.75},)"
          R"({"class":"","milliseconds":0.5,"name":"step","share":0.25}],"steps":3},"profiling":true)"));
  CHECK(write_scene("t", 0.01, {{0, "root", ""}, {1, "fem", "Force<Vec3d>"}}) ==
        R"({"dt":0.01,"is":"scene","protocol":1,"title":"t","tree":[{"depth":0,"name":"root"},)"
        R"({"class":"Force<Vec3d>","depth":1,"name":"fem"}]})");
  CHECK(
      write_component({.line = 3,
                       .path = "/root",
                       .name = "fem",
                       .className = "Force<Vec3d>",
                       .role = "forceField",
                       .fields = {{.name = "k", .value = "5", .unit = "N/m", .rangeWords = "at least 0"}}}) ==
      R"({"class":"Force<Vec3d>","fields":[{"choices":[],"default":"","entries":1,"fixed":"","help":"",)"
      R"("isInput":true,"kind":"","name":"k","range":"at least 0","unit":"N/m","value":"5","whole":true}],)"
      R"("is":"component","line":3,"name":"fem","path":"/root","role":"forceField"})");
  CHECK(write_error("no") == R"({"is":"error","text":"no"})");
}

// what a stage is told
struct Told {
  std::string last{};
  Eigen::Vector3d origin{0, 0, 0};
  double value = 0;
  void play(bool on) { last = on ? "play" : "pause"; }
  void step() { last = "step"; }
  void reset() { last = "reset"; }
  void setSpeed(double times) { last = "speed", value = times; }
  void press(Eigen::Vector3d const& o, Eigen::Vector3d const&, double k) {
    last = "press", origin = o, value = k;
  }
  void move(Eigen::Vector3d const& o, Eigen::Vector3d const&) { last = "move", origin = o; }
  void release() { last = "release"; }
  template <class F>
  void component(int line, F answer) {
    last = "component", value = line;
    answer(SeenComponent{.line = line}, line == 3 ? "" : "there is none");
  }
  template <class F>
  void setField(int, std::string const& field, std::string const& words, F answer) {
    last = field + '=' + words;
    answer("it is no number");
  }
  void undo() { last = "undo"; }
  void redo() { last = "redo"; }
  std::shared_ptr<SeenScene const> scene() const { return std::make_shared<SeenScene>(); }
  void profile(bool on) { last = on ? "profile" : "no profile"; }
  void measure(bool on) { last = on ? "measure" : "no measure"; }
  void measureField(int line, std::string const& field) { last = "measure " + field, value = line; }
  template <class F>
  void measures(F answer) {
    last = "measures";
    answer(Measures{.times = {2}});
  }
  void show(SeenSettings const& seen) { last = enum_names(seen.colour)[std::size_t(seen.colour)]; }
};

TEST_CASE("a command does with a stage what it says") {
  Told told;
  std::vector<std::string> words, answers;
  auto answer = [&](std::string json) { answers.push_back(std::move(json)); };
  for (Command const& said : every) {
    tell(told, said, answer);
    words.push_back(told.last);
  }
  CHECK(words == std::vector<std::string>{"play",
                                          "pause",
                                          "step",
                                          "reset",
                                          "speed",
                                          "press",
                                          "move",
                                          "release",
                                          "component",
                                          "youngModulus=1000 \"2\"\n",
                                          "undo",
                                          "redo",
                                          "vonMises",
                                          "profile",
                                          "no profile",
                                          "measure",
                                          "no measure",
                                          "measure stiffness",
                                          "measures"});
  tell(told, command::Component{5}, answer);
  CHECK(answers == std::vector<std::string>{write_component({.line = 3}),
                                            write_error("it is no number"),
                                            write_measures({.times = {2}}, -1e300),
                                            write_error("there is none")});
  CHECK(told.value == 5);
  CHECK(told.origin == Eigen::Vector3d(1. / 3, 0, -5));
}

TEST_CASE("any bytes are refused or understood") {
  std::mt19937 random(1);
  auto below = [&](std::size_t n) { return std::size_t(random() % n); };
  std::vector<std::string> samples;
  for (Command const& said : every) samples.push_back(write_command(said));
  const std::size_t commands = samples.size();
  samples.push_back(write_topology(scene(), 1));
  samples.push_back(write_frame(scene(), 1));
  samples.push_back(write_upload({{"a.scn", "<Node/>"}, {"data/b.obj", "v 0 0 0"}}));
  const ReadTopology topology = read_topology(samples[commands]);
  long understood = 0, refused = 0;
  auto tried = [&](auto&& read) {
    try {
      read();
      ++understood;
    } catch (Error const&) {
      ++refused;
    }
  };
  for (int round = 0; round < (brief ? 20000 : 100000); ++round) {
    std::string bytes = samples[below(samples.size())];
    if (round % 10 == 0) {
      bytes.resize(below(200));
      for (char& c : bytes) c = char(random());
    }
    for (std::size_t changes = below(4); changes > 0 && !bytes.empty(); --changes) {
      const std::size_t at = below(bytes.size());
      switch (below(5)) {
        case 0:
          bytes[at] = char(random());
          break;
        case 1:
          bytes.erase(at, below(8));
          break;
        case 2:
          bytes.insert(at, bytes, below(bytes.size()), below(16));
          break;
        case 3:
          bytes.insert(at,
                       std::vector<std::string>{"[", "{", "\"", "1e308", "-", "null", "\\u", ","}[below(8)]);
          break;
        default: {  // a bit of JSON or a number of a header of another
          std::string const& other = samples[below(samples.size())];
          const std::size_t from = below(other.size());
          bytes.replace(at, below(8), other, from, below(8));
        }
      }
    }
    tried([&] {
      // understood means the same when it is written and read again
      const Command said = read_command(bytes);
      if (!(read_command(write_command(said)) == said)) FAIL(write_command(said));
    });
    tried([&] {
      const ReadTopology read = read_topology(bytes);
      for (SeenBody const& body : read.scene.bodies)
        for (Triangle const& t : body.triangles)
          for (const Index i : t)
            if (i < 0 || std::size_t(i) >= body.points.size()) FAIL("a triangle has no such point");
    });
    tried([&] {
      ReadTopology into = topology;
      read_frame(bytes, into);
    });
    tried([&] {
      for (SceneFile const& file : read_upload(bytes))
        if (("/" + file.name + "/").find("/../") != file.name.npos) FAIL(file.name);
    });
  }
  CHECK(understood > (brief ? 4000 : 20000));
  CHECK(refused > (brief ? 40000 : 200000));
}

}  // namespace test_protocol
