// SPDX-License-Identifier: BSL-1.0
// Of sinew::serve: what a stage and a page say to each other.
#include <sinew/view/protocol.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <tuple>
#include <type_traits>

namespace sinew::view {

namespace {

using Json = nlohmann::json;

// ---- commands

[[noreturn]] void refuse(std::string const& what) { throw Error("command", what); }

Json parse(std::string_view json) {
  if (json.size() > longestCommand)
    refuse(text("it has ", json.size(), " bytes, and ", longestCommand, " are allowed"));
  auto depth = [](int deep, Json::parse_event_t, Json&) {
    if (deep > int(deepestCommand)) refuse("it is nested too deep");
    return true;
  };
  try {
    return Json::parse(json.begin(), json.end(), depth);
  } catch (Json::exception const&) {
    refuse("it is no JSON (RFC 8259)");
  }
}

// The members of a command; each is asked for once, and no others may be there.
struct Members {
  Json const& json;
  std::string name;

  void only(std::initializer_list<char const*> names) const {
    for (auto const& [key, value] : json.items()) {
      bool known = key == "do";
      for (char const* n : names) known = known || key == n;
      if (!known) refuse(text("'", name, "' has no member '", shown(key), "'"));
    }
  }
  Json const& member(char const* key) const {
    const auto at = json.find(key);
    if (at == json.end()) refuse(text("'", name, "' lacks its member '", key, "'"));
    return *at;
  }
  bool flag(char const* key) const {
    Json const& value = member(key);
    if (!value.is_boolean()) refuse(text("'", key, "' must be true or false"));
    return value.get<bool>();
  }
  double number(char const* key, double low, double high) const {
    return number(member(key), key, low, high);
  }
  int line() const {
    Json const& value = member("line");
    if (!value.is_number_integer()) refuse("'line' must be a whole number");
    return int(number(value, "line", 0, 1e9));
  }
  std::string words(char const* key) const {
    Json const& value = member(key);
    if (!value.is_string()) refuse(text("'", key, "' must be text"));
    return value.get<std::string>();
  }
  Eigen::Vector3d vector(char const* key, double most) const {
    Json const& value = member(key);
    if (!value.is_array() || value.size() != 3) refuse(text("'", key, "' must be a list of 3 numbers"));
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = number(value[std::size_t(k)], key, -most, most);
    return v;
  }
  Eigen::Vector3d direction(char const* key) const {
    const Eigen::Vector3d v = vector(key, 1e9);
    if (!(v.norm() > 1e-9)) refuse(text("'", key, "' has no direction"));
    // one that has length 1 keeps its bits
    return std::abs(v.norm() - 1) < 1e-15 ? v : Eigen::Vector3d(v.normalized());
  }
  static double number(Json const& value, char const* key, double low, double high) {
    if (!value.is_number()) refuse(text("'", key, "' must be a number"));
    const double x = value.get<double>();
    if (!std::isfinite(x) || x < low || x > high)
      refuse(text("'", key, "' is ", x, " and must be from ", low, " to ", high));
    return x;
  }
  static std::string shown(std::string_view word) {
    std::string clean(word.substr(0, 40));
    for (char& c : clean)
      if (c < ' ' || c > '~') c = '?';
    return clean;
  }
};

std::string listed_names() {
  std::string all;
  for (std::string_view name : enum_names(Quantity{})) all += text(all.empty() ? "" : ", ", name);
  return all;
}

constexpr double farthest = 1e9;  // of the origin of a ray [m]

Json list_of(Eigen::Vector3d const& v) {
  Json list = Json::array();
  for (int k = 0; k < 3; ++k) list.push_back(v[k]);
  return list;
}
// bytes that are no UTF-8, as names of a scene may have, become marks
std::string dumped(Json const& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

// ---- bytes

constexpr std::uint32_t topologyKind = 1, frameKind = 2, texturesKind = 3, hiddenKind = 4;

template <class T>
void put(std::string& to, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(T));
  to.append(bytes, sizeof(T));
}
void put_count(std::string& to, std::size_t count) { put(to, std::uint32_t(count)); }

// Bytes from first to last; what is not there is refused.
struct Bytes {
  std::string_view left;
  char const* what;

  [[noreturn]] void refuse(char const* why) const { throw Error(what, why); }
  std::string_view take(std::size_t count) {
    if (count > left.size()) refuse("it ends too early");
    const std::string_view taken = left.substr(0, count);
    left.remove_prefix(count);
    return taken;
  }
  template <class T>
  T number() {
    char bytes[sizeof(T)];
    std::memcpy(bytes, take(sizeof(T)).data(), sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }
  std::uint32_t word() { return number<std::uint32_t>(); }
  // so many things of so many bytes, which are there
  std::size_t count(std::uint32_t n, std::size_t size) const {
    if (n > left.size() / size) refuse("it ends too early");
    return n;
  }
  void end() const {
    if (!left.empty()) refuse("bytes are left at its end");
  }
};

template <class Elements>
void put_elements(std::string& to, Elements const& elements) {
  for (auto const& element : elements)
    for (const auto i : element) put(to, std::uint32_t(i));
}
template <class Elements>
void read_elements(Bytes& bytes, std::uint32_t n, std::size_t points, Elements& elements,
                   bool orNone = false) {
  constexpr std::size_t corners = std::tuple_size_v<typename Elements::value_type>;
  elements.resize(bytes.count(n, corners * sizeof(std::uint32_t)));
  for (auto& element : elements)
    for (auto& i : element) {
      const std::uint32_t number = bytes.word();
      if (number >= points && !(orNone && number == ~std::uint32_t(0)))
        bytes.refuse("an element has a point that there is not");
      i = std::remove_reference_t<decltype(i)>(number);
    }
}

}  // namespace

Command read_command(std::string_view json) {
  const Json parsed = parse(json);
  if (!parsed.is_object()) refuse("it is no object");
  const auto what = parsed.find("do");
  if (what == parsed.end() || !what->is_string()) refuse("it lacks the member 'do', which says what to do");
  const Members m{parsed, Members::shown(what->get<std::string>())};
  auto has = [&](char const* name, std::initializer_list<char const*> members) {
    if (m.name != name) return false;
    m.only(members);
    return true;
  };
  if (has("play", {"on"})) return command::Play{m.flag("on")};
  if (has("step", {})) return command::Step{};
  if (has("reset", {})) return command::Reset{};
  if (has("speed", {"times"})) return command::Speed{m.number("times", 0, 1e6)};
  if (has("press", {"origin", "direction", "stiffness"}))
    return command::Press{
        m.vector("origin", farthest), m.direction("direction"), m.number("stiffness", 1e-12, 1e12)};
  if (has("move", {"origin", "direction"}))
    return command::Move{m.vector("origin", farthest), m.direction("direction")};
  if (has("release", {})) return command::Release{};
  if (has("component", {"line"})) return command::Component{m.line()};
  if (has("setField", {"line", "field", "value"}))
    return command::SetField{m.line(), m.words("field"), m.words("value")};
  if (has("undo", {})) return command::Undo{};
  if (has("redo", {})) return command::Redo{};
  if (has("colour", {"by"})) {
    const std::string by = m.words("by");
    constexpr auto names = enum_names(Quantity{});
    const auto at = std::find(names.begin(), names.end(), by);
    if (at == names.end())
      refuse(text("'by' is '", Members::shown(by), "' and must be one of: ", listed_names()));
    return command::Colour{Quantity(at - names.begin())};
  }
  if (has("profile", {"on"})) return command::Profile{m.flag("on")};
  if (has("measure", {"on"})) return command::Measure{m.flag("on")};
  if (has("measureField", {"line", "field"})) return command::MeasureField{m.line(), m.words("field")};
  if (has("measures", {"after"})) return command::Measures{m.number("after", -1e300, 1e300)};
  refuse(text("nothing is called '",
              m.name,
              "'; there are play, step, reset, speed, press, move, release, component, setField, undo, "
              "redo, colour, profile, measure, measureField and measures"));
}

std::string write_command(Command const& said) {
  struct {
    Json operator()(command::Play const& c) { return {{"do", "play"}, {"on", c.on}}; }
    Json operator()(command::Step const&) { return {{"do", "step"}}; }
    Json operator()(command::Reset const&) { return {{"do", "reset"}}; }
    Json operator()(command::Speed const& c) { return {{"do", "speed"}, {"times", c.times}}; }
    Json operator()(command::Press const& c) {
      return {{"do", "press"},
              {"origin", list_of(c.origin)},
              {"direction", list_of(c.direction)},
              {"stiffness", c.stiffness}};
    }
    Json operator()(command::Move const& c) {
      return {{"do", "move"}, {"origin", list_of(c.origin)}, {"direction", list_of(c.direction)}};
    }
    Json operator()(command::Release const&) { return {{"do", "release"}}; }
    Json operator()(command::Component const& c) { return {{"do", "component"}, {"line", c.line}}; }
    Json operator()(command::SetField const& c) {
      return {{"do", "setField"}, {"line", c.line}, {"field", c.field}, {"value", c.value}};
    }
    Json operator()(command::Undo const&) { return {{"do", "undo"}}; }
    Json operator()(command::Redo const&) { return {{"do", "redo"}}; }
    Json operator()(command::Colour const& c) {
      return {{"do", "colour"}, {"by", enum_names(c.by)[std::size_t(c.by)]}};
    }
    Json operator()(command::Profile const& c) { return {{"do", "profile"}, {"on", c.on}}; }
    Json operator()(command::Measure const& c) { return {{"do", "measure"}, {"on", c.on}}; }
    Json operator()(command::MeasureField const& c) {
      return {{"do", "measureField"}, {"line", c.line}, {"field", c.field}};
    }
    Json operator()(command::Measures const& c) { return {{"do", "measures"}, {"after", c.after}}; }
  } json;
  return dumped(std::visit(json, said));
}

std::string write_scene(std::string_view title, double dt, std::vector<TreeLine> const& tree) {
  Json lines = Json::array();
  for (TreeLine const& line : tree) {
    Json one{{"depth", line.depth}, {"name", line.name}};
    if (!line.className.empty()) one["class"] = line.className;
    lines.push_back(std::move(one));
  }
  return dumped({{"is", "scene"}, {"protocol", 1}, {"title", title}, {"dt", dt}, {"tree", std::move(lines)}});
}

std::string write_state(StageState const& state, SeenScene const& scene) {
  Json json{{"is", "state"},
            {"time", state.time},
            {"step", state.step},
            {"playing", state.playing},
            {"stepsPerSecond", state.stepsPerSecond},
            {"held", nullptr},
            {"undo", state.undo ? Json(state.undo->field) : Json()},
            {"redo", state.redo ? Json(state.redo->field) : Json()},
            {"error", state.error},
            {"colour", enum_names(Quantity{})[std::size_t(scene.settings.colour)]},
            {"legend", nullptr},
            {"profiling", state.profiling},
            {"profile", nullptr}};
  if (state.profile) {
    constexpr std::size_t most = 24;  // the largest
    Json shares = Json::array();
    for (std::size_t i = 0; i < state.profile->shares.size() && i < most; ++i) {
      TimeShare const& one = state.profile->shares[i];
      shares.push_back({{"name", one.name},
                        {"class", one.className},
                        {"milliseconds", one.milliseconds},
                        {"share", one.share}});
    }
    json["profile"] = {{"steps", state.profile->steps}, {"shares", std::move(shares)}};
  }
  if (scene.legend)
    json["legend"] = {{"title", scene.legend->title},
                      {"unit", scene.legend->unit},
                      {"low", scene.legend->low},
                      {"high", scene.legend->high}};
  if (state.held)
    json["held"] = {{"path", state.held->path},
                    {"point", list_of(state.held->point)},
                    {"target", list_of(state.held->target)},
                    {"force", list_of(state.held->force)}};
  return dumped(json);
}

std::string write_component(SeenComponent const& component) {
  Json fields = Json::array();
  for (SeenField const& field : component.fields)
    fields.push_back({{"name", field.name},
                      {"value", field.value},
                      {"entries", field.entries},
                      {"whole", field.whole},
                      {"kind", field.kind},
                      {"choices", field.choices},
                      {"unit", field.unit},
                      {"help", field.help},
                      {"range", field.rangeWords},
                      {"default", field.defaultValue},
                      {"isInput", field.isInput},
                      {"fixed", field.fixed}});
  return dumped({{"is", "component"},
                 {"line", component.line},
                 {"path", component.path},
                 {"name", component.name},
                 {"class", component.className},
                 {"role", component.role},
                 {"fields", std::move(fields)}});
}

std::string write_measures(Measures const& measures, double after) {
  auto const& times = measures.times;
  const auto first = std::upper_bound(times.begin(), times.end(), after) - times.begin();
  Json series = Json::array();
  for (Series const& one : measures.series)
    series.push_back({{"name", one.name},
                      {"unit", one.unit},
                      {"values",
                       Json(std::vector<double>(
                           one.values.begin() + std::min<std::ptrdiff_t>(first, std::ssize(one.values)),
                           one.values.end()))}});
  return dumped({{"is", "measures"},
                 {"times", std::vector<double>(times.begin() + first, times.end())},
                 {"series", std::move(series)}});
}

std::string write_error(std::string_view message) { return dumped({{"is", "error"}, {"text", message}}); }

std::vector<std::shared_ptr<SeenTexture const>> textures_of(SeenScene const& scene) {
  std::vector<std::shared_ptr<SeenTexture const>> all;
  for (SeenBody const& body : scene.bodies)
    if (body.texture && std::find(all.begin(), all.end(), body.texture) == all.end())
      all.push_back(body.texture);
  return all;
}

std::string write_textures(std::vector<std::shared_ptr<SeenTexture const>> const& textures) {
  std::string to;
  put(to, texturesKind);
  put_count(to, textures.size());
  for (auto const& texture : textures) {
    put_count(to, texture->file.size());
    to += texture->file;
    to.append((4 - texture->file.size() % 4) % 4, '\0');
  }
  return to;
}

std::vector<std::string> read_textures(std::string_view message) {
  Bytes bytes{message, "textures"};
  if (bytes.word() != texturesKind) bytes.refuse("they are none");
  std::vector<std::string> files(bytes.count(bytes.word(), 4));
  for (std::string& file : files) {
    const std::uint32_t size = bytes.word();
    file = bytes.take(size);
    bytes.take((4 - size % 4) % 4);
  }
  bytes.end();
  return files;
}

std::string write_topology(SeenScene const& scene, std::uint32_t number) {
  const auto textures = textures_of(scene);
  std::string to;
  put(to, topologyKind);
  put(to, number);
  for (int k = 0; k < 3; ++k) put(to, float(scene.up[k]));
  put_count(to, scene.bodies.size());
  for (SeenBody const& body : scene.bodies) {
    put(to, std::uint32_t(body.kind) + (body.visible ? 0u : hiddenKind));
    for (int k = 0; k < 3; ++k) put(to, float(body.colour[k]));
    put(to, float(body.opacity));
    for (const std::size_t n : {body.path.size(),
                                body.points.size(),
                                body.triangles.size(),
                                body.quads.size(),
                                body.edges.size(),
                                body.beyond.size()})
      put_count(to, n);
    SurfaceLooks const& in = body.inTexture;
    const bool textured =
        body.texture && in.triangles.size() == body.triangles.size() && in.quads.size() == body.quads.size();
    const auto texture = std::find(textures.begin(), textures.end(), body.texture);
    put_count(to, textured ? std::size_t(texture - textures.begin()) + 1 : 0);
    put_count(to, textured ? in.texcoords.size() : 0);
    for (int k = 0; k < 3; ++k) put(to, float(body.specular[k]));
    put(to, float(body.shininess));
    to += body.path;
    to.append((4 - body.path.size() % 4) % 4, '\0');
    put_elements(to, body.triangles);
    put_elements(to, body.quads);
    put_elements(to, body.edges);
    put_elements(to, body.beyond);
    if (!textured) continue;
    for (Eigen::Vector2d const& t : in.texcoords)
      for (int k = 0; k < 2; ++k) put(to, float(t[k]));
    put_elements(to, in.triangles);
    put_elements(to, in.quads);
  }
  return to;
}

std::string write_frame(SeenScene const& scene, std::uint32_t topology) {
  std::size_t points = 0;
  bool coloured = false;
  for (SeenBody const& body : scene.bodies) {
    points += body.points.size();
    coloured = coloured || !body.values.empty();
  }
  std::string to;
  to.reserve(32 + 16 * points);
  put(to, frameKind);
  put(to, topology);
  put_count(to, points);
  put_count(to, coloured ? points : 0);
  put(to, scene.time);
  put(to, double(scene.step));
  for (SeenBody const& body : scene.bodies)
    for (Eigen::Vector3d const& p : body.points)
      for (int k = 0; k < 3; ++k) put(to, float(p[k]));
  if (coloured)
    for (SeenBody const& body : scene.bodies)
      for (std::size_t i = 0; i < body.points.size(); ++i)
        put(to, i < body.values.size() ? float(body.values[i]) : std::numeric_limits<float>::quiet_NaN());
  return to;
}

ReadTopology read_topology(std::string_view message) {
  Bytes bytes{message, "topology"};
  if (bytes.word() != topologyKind) bytes.refuse("it is none");
  ReadTopology read{.number = bytes.word()};
  for (int k = 0; k < 3; ++k) read.scene.up[k] = double(bytes.number<float>());
  std::size_t all = 0;
  constexpr std::size_t header = 17 * sizeof(std::uint32_t);
  const std::size_t bodies = bytes.count(bytes.word(), header);
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::uint32_t kind = bytes.word();
    if (kind % hiddenKind > std::uint32_t(SeenBody::Kind::collision) || kind >= 2 * hiddenKind)
      bytes.refuse("a body is of no kind that there is");
    SeenBody body{.kind = SeenBody::Kind(kind % hiddenKind), .visible = kind < hiddenKind};
    for (int k = 0; k < 3; ++k) body.colour[k] = double(bytes.number<float>());
    body.opacity = double(bytes.number<float>());
    if (!(body.opacity >= 0 && body.opacity <= 1)) bytes.refuse("an opacity is not from 0 to 1");
    const std::uint32_t path = bytes.word(), points = bytes.word(), triangles = bytes.word(),
                        quads = bytes.word(), edges = bytes.word(), beyond = bytes.word();
    const std::uint32_t texture = bytes.word(), texcoords = bytes.word();
    for (int k = 0; k < 3; ++k) body.specular[k] = double(bytes.number<float>());
    body.shininess = double(bytes.number<float>());
    // a frame of them would be longer than what is sent
    if ((all += points) > mostPoints) bytes.refuse("it has too many points");
    body.path = bytes.take(path);
    bytes.take((4 - path % 4) % 4);
    body.points.assign(points, Eigen::Vector3d::Zero());
    read_elements(bytes, triangles, points, body.triangles);
    read_elements(bytes, quads, points, body.quads);
    read_elements(bytes, edges, points, body.edges);
    read_elements(bytes, beyond, points, body.beyond);
    if (texture > 0) {
      body.inTexture.texcoords.resize(bytes.count(texcoords, 8));
      for (Eigen::Vector2d& t : body.inTexture.texcoords)
        for (int k = 0; k < 2; ++k) t[k] = double(bytes.number<float>());
      read_elements(bytes, triangles, texcoords, body.inTexture.triangles, true);
      read_elements(bytes, quads, texcoords, body.inTexture.quads, true);
    }
    read.textures.push_back(texture);
    read.scene.bodies.push_back(std::move(body));
  }
  bytes.end();
  return read;
}

void read_frame(std::string_view message, ReadTopology& into) {
  Bytes bytes{message, "frame"};
  if (bytes.word() != frameKind) bytes.refuse("it is none");
  if (bytes.word() != into.number) bytes.refuse("it is of another topology");
  std::size_t points = 0;
  for (SeenBody const& body : into.scene.bodies) points += body.points.size();
  const std::uint32_t count = bytes.word();
  if (count != points) bytes.refuse("it has another number of points than its topology");
  const std::uint32_t values = bytes.word();
  if (values != 0 && values != points) bytes.refuse("it has another number of values than points");
  const double time = bytes.number<double>(), step = bytes.number<double>();
  if (!(step >= 0 && step < 9e15)) bytes.refuse("its step is no count");
  if (bytes.left.size() != 12 * points + 4 * values) bytes.refuse("it has another length than its points");
  into.scene.time = time;
  into.scene.step = long(step);
  for (SeenBody& body : into.scene.bodies)
    for (Eigen::Vector3d& p : body.points)
      for (int k = 0; k < 3; ++k) p[k] = double(bytes.number<float>());
  for (SeenBody& body : into.scene.bodies) {
    body.values.resize(values == 0 ? 0 : body.points.size());
    for (double& value : body.values) value = double(bytes.number<float>());
  }
}

namespace {

// a path of plain names, which stays below the folder that it is looked for in
void check_file_name(std::string const& name) {
  auto refuse_name = [&](char const* why) {
    throw Error("upload", text("the name '", Members::shown(name), "' ", why, "; take another"));
  };
  if (name.empty() || name.size() > longestFileName) refuse_name("is empty or too long");
  for (const char c : name)
    if (static_cast<unsigned char>(c) < ' ' || c == 127 || c == '\\' || c == ':')
      refuse_name("has a character that names of files of a scene do not have");
  for (std::size_t at = 0; at <= name.size();) {
    const std::size_t end = std::min(name.find('/', at), name.size());
    const std::string_view part = std::string_view(name).substr(at, end - at);
    if (part.empty() || part == "." || part == "..") refuse_name("does not lead to a file below a folder");
    at = end + 1;
  }
}
// a file cannot be where another one is, or has its folder
bool clash(std::string const& a, std::string const& b) {
  return a == b || a.starts_with(b + '/') || b.starts_with(a + '/');
}
bool ends_in(std::string_view name, std::string_view ending) {
  if (name.size() <= ending.size()) return false;
  name.remove_prefix(name.size() - ending.size());
  return std::equal(name.begin(), name.end(), ending.begin(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b;
  });
}

}  // namespace

std::string write_upload(std::vector<SceneFile> const& files) {
  Json list = Json::array();
  for (SceneFile const& file : files) list.push_back({{"name", file.name}, {"bytes", file.content.size()}});
  std::string bytes = dumped({{"files", std::move(list)}}) + '\n';
  for (SceneFile const& file : files) bytes += file.content;
  return bytes;
}

std::vector<SceneFile> read_upload(std::string_view bytes) {
  constexpr char const* what = "upload";
  if (bytes.size() > longestUpload)
    throw Error(what, text("it has ", bytes.size(), " bytes, and ", longestUpload, " are allowed"));
  constexpr std::size_t longestHeader = mostFiles * (2 * longestFileName + 64);
  const std::size_t line = bytes.substr(0, longestHeader).find('\n');
  if (line == bytes.npos) throw Error(what, "it begins with no line that names its files");
  Json header;
  try {
    header = Json::parse(
        bytes.begin(), bytes.begin() + std::ptrdiff_t(line), [](int deep, Json::parse_event_t, Json&) {
          if (deep > int(deepestCommand)) throw Error(what, "its first line is nested too deep");
          return true;
        });
  } catch (Json::exception const&) {
    throw Error(what, "its first line is no JSON (RFC 8259)");
  }
  const auto list = header.is_object() ? header.find("files") : header.end();
  if (!header.is_object() || list == header.end() || !list->is_array() || header.size() != 1)
    throw Error(what, "its first line lacks the list 'files', or has more");
  if (list->empty() || list->size() > mostFiles)
    throw Error(what, text("it has ", list->size(), " files, and must have 1 to ", mostFiles));
  std::vector<SceneFile> files;
  Bytes left{bytes.substr(line + 1), what};
  for (Json const& one : *list) {
    const auto name = one.is_object() ? one.find("name") : one.end();
    const auto size = one.is_object() ? one.find("bytes") : one.end();
    if (!one.is_object() || one.size() != 2 || name == one.end() || size == one.end() || !name->is_string() ||
        !size->is_number_unsigned())
      throw Error(what, "a file has a 'name' and a number of 'bytes', and no more");
    SceneFile file{.name = name->get<std::string>()};
    check_file_name(file.name);
    for (SceneFile const& other : files)
      if (clash(other.name, file.name))
        throw Error(what, text("two files are called '", Members::shown(file.name), "'"));
    const auto count = size->get<std::uint64_t>();
    if (count > left.left.size()) left.refuse("it ends too early");
    file.content = left.take(std::size_t(count));
    files.push_back(std::move(file));
  }
  left.end();
  return files;
}

std::size_t scene_among(std::vector<SceneFile> const& files) {
  for (std::string_view ending : {".scn", ".xml"}) {
    std::size_t count = 0, last = 0;
    for (std::size_t i = 0; i < files.size(); ++i)
      if (ends_in(files[i].name, ending)) ++count, last = i;
    if (count == 1) return last;
    if (count > 1)
      throw Error(
          "upload",
          text("there are ", count, " scenes (", ending, "); take one, with the files that it needs"));
  }
  throw Error("upload",
              "there is no scene among the files (.scn or .xml); take one, with the files that it needs");
}

std::vector<SceneFile> placed(std::vector<SceneFile> files) {
  constexpr std::string_view ends = "\"' \t\r\n";  // of a name in a scene
  const std::vector<SceneFile> dropped = files;
  std::size_t total = 0;
  for (SceneFile const& file : dropped) total += file.content.size();
  auto place = [&](std::string name, std::string const& content) {
    try {
      check_file_name(name);
    } catch (Error const&) {
      return;  // it leads out of the folder
    }
    for (SceneFile const& other : files)
      if (clash(other.name, name)) return;
    if (files.size() == mostFiles || total + content.size() > longestUpload) return;
    total += content.size();
    files.push_back({std::move(name), content});
  };
  for (SceneFile const& scene : dropped) {
    if (!ends_in(scene.name, ".scn") && !ends_in(scene.name, ".xml")) continue;
    const std::string folder = scene.name.substr(0, scene.name.rfind('/') + 1), &words = scene.content;
    for (SceneFile const& file : dropped) {
      if (file.name.find('/') != file.name.npos) continue;
      const std::string called = '/' + file.name;
      for (std::size_t at = words.find(called); at != words.npos; at = words.find(called, at + 1)) {
        const std::size_t end = at + called.size();
        if (end == words.size() || ends.find(words[end]) == ends.npos) continue;
        const std::size_t earliest = at > longestFileName ? at - longestFileName : 0;
        const std::size_t before = std::string_view(words).substr(earliest, at - earliest).find_last_of(ends);
        if (before == ends.npos && earliest > 0) continue;  // too long for a name
        const std::size_t begin = before == ends.npos ? 0 : earliest + before + 1;
        place(folder + words.substr(begin, end - begin), file.content);
      }
    }
  }
  return files;
}

void SceneWriter::write(SeenScene const& scene) {
  if (auto textures = textures_of(scene); textures != known_) {
    known_ = std::move(textures);
    textures_ = write_textures(known_);
    ++texturesNumber_;
    topology_.clear();  // whose bodies have other textures by the same numbers
  }
  if (std::string now = write_topology(scene, number_); now != topology_)
    topology_ = write_topology(scene, ++number_);
  frame_ = write_frame(scene, number_);
}

}  // namespace sinew::view
