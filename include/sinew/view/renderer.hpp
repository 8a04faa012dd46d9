// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/drawn_marks.hpp>
#include <sinew/view/gl_objects.hpp>
#include <sinew/view/overlay.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/shaded_mesh.hpp>
#include <sinew/view/smooth_target.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

namespace detail {

// Blinn and Phong's light from up to mostLights places, one of them with its shadow, and light from all sides
// that may be brighter from above. The words of the lights that there are stand between these two parts.
inline constexpr std::string_view lightWords = R"(#version 330 core
uniform vec4 place[8];   // at the eye: of a light, or the direction to it
uniform vec4 colour[8];
uniform vec4 cone[8];    // where a spot shines to, and the cosine of its cone
uniform vec4 fall[8];    // attenuation, exponent of a spot
uniform vec3 upAtEye, around;
uniform float fromAbove;
uniform float opacity;
uniform mat4 toLight;    // from the eye
uniform sampler2DShadow shadow;
// How much of nine places around one is seen by the light that has a shadow. Of neighbours in a row with the
// weights 1 - f, 1, 1, f, the card's filter takes two at a time.
float seenBy(vec3 to, vec3 n, vec3 atEye) {
  vec3 p = (toLight * vec4(atEye, 1)).xyz * 0.5 + 0.5;
  p.z -= 0.002 + 0.006 * (1.0 - abs(dot(n, to)));
  vec2 size = vec2(textureSize(shadow, 0)), f = fract(p.xy * size - 0.5), middle = p.xy * size - f;
  vec2 a = 2.0 - f, b = 1.0 + f, low = (middle - 1.0 + 1.0 / a) / size, high = (middle + 1.0 + f / b) / size;
  return (a.x * a.y * textureLod(shadow, vec3(low, p.z), 0.0) +
          b.x * a.y * textureLod(shadow, vec3(high.x, low.y, p.z), 0.0) +
          a.x * b.y * textureLod(shadow, vec3(low.x, high.y, p.z), 0.0) +
          b.x * b.y * textureLod(shadow, vec3(high, p.z), 0.0)) / 9.0;
}
float fallen(float far, vec4 fall) { return 1.0 / (1.0 + fall.x * far); }
float inCone(vec3 to, vec4 cone, vec4 fall) {
  float inside = dot(-to, cone.xyz);
  return inside > cone.w ? pow(inside, fall.y) : 0.0;
}
struct Light { vec3 diffuse, shine; };
void add(inout Light sum, vec3 n, vec3 toEye, vec3 to, vec3 colour) {
  sum.diffuse += 0.75 * clamp(dot(n, to), 0.0, 1.0) * colour;
  float s = max(dot(n, normalize(to + toEye)), 0.0);
  s *= s * s * s * s;  // to the 40th power
  s *= s, s *= s, s *= s;
  sum.shine += 0.12 * s * colour;
}
vec3 linear(vec3 colour) { return pow(colour, vec3(2.2)); }
)";
inline constexpr std::string_view litWords = R"(
vec3 lit(vec3 n, vec3 atEye, vec3 own, float seen) {
  Light sum = Light(around * (1.0 + fromAbove * dot(n, upAtEye)), vec3(0.0));
  addAll(sum, n, atEye, normalize(-atEye), seen);
  return pow(own * sum.diffuse + sum.shine, vec3(1.0 / 2.2));
}
)";
// What adds all lights, and how much of the one with a shadow is seen.
inline std::string words_of_lights(std::vector<SeenLight> const& lights,
                                   std::optional<std::size_t> shadowOf) {
  std::string words =
      "void addAll(inout Light sum, vec3 n, vec3 atEye, vec3 toEye, float seen) {\n  vec3 to;\n";
  for (std::size_t k = 0; k < lights.size(); ++k) {
    const bool parallel = lights[k].kind == SeenLight::Kind::parallel,
               spot = lights[k].kind == SeenLight::Kind::spot;
    words += text("  to = place[", k, "].xyz", parallel ? "" : " - atEye", ";\n");
    words += text("  add(sum, n, toEye, normalize(to), colour[",
                  k,
                  "].rgb",
                  shadowOf == k ? " * seen" : "",
                  parallel ? std::string() : text(" * fallen(length(to), fall[", k, "])"),
                  spot ? text(" * inCone(normalize(to), cone[", k, "], fall[", k, "])") : std::string(),
                  ");\n");
  }
  return words + "}\nfloat seenByLight(vec3 n, vec3 atEye) { return " +
         (shadowOf ? text("seenBy(place[", *shadowOf, "].xyz, n, atEye)") : std::string("1.0")) + "; }\n";
}

// Both sides of a face are seen. The light is computed for each pixel,
inline constexpr char const* surfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 toClip, toView;
uniform vec4 clip;
out vec3 atEye, normalAtEye, own;
void main() {
  own = colour;
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  vec4 p = toView * vec4(position, 1);
  atEye = p.xyz;
  normalAtEye = mat3(toView) * normal;
  gl_Position = toClip * p;
})";
inline constexpr std::string_view surfaceFragment = R"(
in vec3 atEye, normalAtEye, own;
out vec4 pixel;
void main() {
  vec3 n = normalize(gl_FrontFacing ? normalAtEye : -normalAtEye);
  pixel = vec4(lit(n, atEye, linear(own), seenByLight(n, atEye)), opacity);
})";
// or, where the triangles are as small as a few pixels, for each of their corners.
inline constexpr std::string_view fineVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colourAtCorner;
uniform mat4 toClip, toView;
uniform vec4 clip;
noperspective out vec3 front, back;
void main() {
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  vec4 p = toView * vec4(position, 1);
  vec3 n = normalize(mat3(toView) * normal);
  vec3 own = linear(colourAtCorner);
  float seen = seenByLight(n, p.xyz);
  front = lit(n, p.xyz, own, seen);
  back = lit(-n, p.xyz, own, seen);
  gl_Position = toClip * p;
})";
inline constexpr char const* fineFragment = R"(#version 330 core
noperspective in vec3 front, back;
uniform float opacity;
out vec4 pixel;
void main() { pixel = vec4(gl_FrontFacing ? front : back, opacity); })";

inline constexpr char const* shadowVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 toLight;  // from the scene
uniform vec4 clip;
void main() {
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  gl_Position = toLight * vec4(position, 1);
})";
inline constexpr char const* shadowFragment = R"(#version 330 core
void main() {})";

inline constexpr char const* plainVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 colour;
uniform mat4 toClip, toView;
uniform vec4 clip;
uniform float pointSize;
out vec3 own;
void main() {
  own = colour;
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  gl_Position = toClip * (toView * vec4(position, 1));
  gl_PointSize = pointSize;
})";

inline constexpr char const* plainFragment = R"(#version 330 core
in vec3 own;
uniform float roundPoints, opacity;
out vec4 pixel;
void main() {
  if (roundPoints > 0.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
  pixel = vec4(own, opacity);
})";

}  // namespace detail

/// Draws scenes with OpenGL 3.3 into the frame buffer that is bound; the context in which it is made is
/// current.
class Renderer {
 public:
  /// Brings what is seen onto the graphics card.
  void show(SeenScene const& scene) {
    auto const& [low, high] = scene.box();
    centre_ = (low + high) / 2;
    radius_ = std::max((high - low).norm() / 2, 1e-9);
    std::size_t used = 0;
    for (SeenBody const& seen : scene.bodies) {
      if (!seen.visible) continue;
      if (used == bodies_.size()) bodies_.emplace_back();
      Body& body = bodies_[used++];
      body.opacity = seen.opacity;
      if (body.shaded.update(seen, scene.legend, scene.settings, 6 * shadow_.texel(radius_)))
        body.drawn.set(body.shaded.mesh());
    }
    bodies_.resize(used);
    DrawnMarks marks = drawn_marks(scene, radius_);
    marks_.set(marks.mesh);
    labels_ = std::move(marks.labels);
    words_ = std::move(marks.words);
    legend_ = scene.settings.legend ? scene.legend : std::nullopt;
    if (!scene.settings.legend) words_.clear();
    up_ = scene.up;
    clip_ = scene.settings.clip;
    shadows_ = scene.settings.shadows;
    lights_ = scene.settings.lights;
    if (lights_.size() > mostLights) lights_.resize(mostLights);
    ambient_ = scene.settings.ambient;
    colour_ = scene.settings.background.value_or(Eigen::Vector3d(background.data()));
  }

  /// `left`: the pixels that are left free beside the picture.
  void draw(Camera const& camera, int width, int height, int left = 0) {
    const Eigen::Matrix4d toView = camera.toView(), toClip = camera.toClip(double(width) / height);
    std::vector<SeenLight> lights = lights_;
    if (lights.empty())  // from the left above the eye
      lights.push_back(
          {.direction = (0.6 * camera.toEye - 0.5 * camera.right() + 0.7 * camera.above()).normalized()});
    // the first one from far away has a shadow
    const auto first = std::find_if(lights.begin(), lights.end(), [](SeenLight const& light) {
      return light.kind == SeenLight::Kind::parallel && !light.movesWithCamera;
    });
    const bool hasShadow = shadows_ && first != lights.end();
    const Eigen::Matrix4d toLight =
        first != lights.end() ? lightOf(first->direction) : Eigen::Matrix4d::Identity().eval();
    GLint target = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    if (clip_) glEnable(GL_CLIP_DISTANCE0);
    if (hasShadow) drawShadow(toLight);
    glBindFramebuffer(GL_FRAMEBUFFER, GLuint(target));

    glViewport(left, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glClearColor(GLfloat(colour_[0]), GLfloat(colour_[1]), GLfloat(colour_[2]), 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, shadow_.depth);
    const std::string words = detail::words_of_lights(
        lights, hasShadow ? std::optional(std::size_t(first - lights.begin())) : std::nullopt);
    if (!lit_ || lit_->words != words) lit_.emplace(words);
    GlShaders const &surface = lit_->surface, &fine = lit_->fine;
    for (GlShaders const* shaders : {&surface, &fine}) {
      shaders->use();
      shaders->set("toView", toView);
      shaders->set("toClip", toClip);
      shaders->set("toLight", Eigen::Matrix4d(toLight * toView.inverse()));
      shaders->set("clip", clipped());
      setLights(*shaders, lights, toView);
      shaders->set("upAtEye", toView.topLeftCorner<3, 3>() * up_);
      shaders->setTexture("shadow", 0);
    }
    glEnable(GL_POLYGON_OFFSET_FILL);  // edges are seen on the faces they belong to
    glPolygonOffset(1, 1);
    auto drawFaces = [&](Body const& body) {
      GlShaders const& shaders = isFine(body.shaded.mesh(), camera, height) ? fine : surface;
      shaders.use();
      shaders.set("opacity", body.opacity);
      body.drawn.faces.draw(GL_TRIANGLES);
    };
    for (Body const& body : bodies_)
      if (!body.seenThrough()) drawFaces(body);
    surface.use();
    surface.set("opacity", 1);
    surface.set("clip", everything());  // marks are seen as a whole
    marks_.faces.draw(GL_TRIANGLES);
    glDisable(GL_POLYGON_OFFSET_FILL);
    plain_.use();
    plain_.set("toView", toView);
    plain_.set("toClip", toClip);
    plain_.set("clip", clipped());
    plain_.set("pointSize", std::max(4., height / 90.));
    auto drawThin = [&](Drawn const& drawn, double opacity) {
      plain_.set("opacity", opacity);
      plain_.set("roundPoints", 0);
      drawn.lines.draw(GL_LINES);
      plain_.set("roundPoints", 1);
      drawn.points.draw(GL_POINTS);
    };
    for (Body const& body : bodies_)
      if (!body.seenThrough()) drawThin(body.drawn, 1);
    plain_.set("clip", everything());
    drawThin(marks_, 1);
    plain_.set("clip", clipped());
    surface.use();
    surface.set("clip", clipped());
    drawSeenThrough(camera, drawFaces, [&](Body const& body) {
      plain_.use();
      drawThin(body.drawn, body.opacity);
    });
    glDisable(GL_CLIP_DISTANCE0);
    drawWords(camera, width, height);
  }

  std::array<double, 3> background{1, 1, 1};

 private:
  struct Drawn {
    GlMesh faces{3}, lines{2}, points{2};

    void set(ShadedMesh const& mesh) {
      faces.set(mesh.corners, mesh.normals, mesh.colours);
      faces.setIndices(mesh.triangles);
      faces.setIndices(mesh.casters, 1);
      lines.set(mesh.lines.at, mesh.lines.colours);
      points.set(mesh.points.at, mesh.points.colours);
    }
  };
  struct Body {
    ShadedBody shaded{};
    Drawn drawn{};
    double opacity = 1;
    bool seenThrough() const { return opacity < 1; }
  };
  struct Shadow {
    static constexpr double margin = 1.05;  // seen around the scene, times its radius
    int size = 2048;
    GlTexture depth = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
    GlFrame frame = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });

    Shadow() {
      // without a graphics card a finer one takes most of the time
      if (drawn_by_software()) size = 1024;
      glBindTexture(GL_TEXTURE_2D, depth);
      glTexImage2D(
          GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
      auto set = [](GLenum what, GLint to) { glTexParameteri(GL_TEXTURE_2D, what, to); };
      set(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
      set(GL_TEXTURE_MAG_FILTER, GL_LINEAR);
      set(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
      set(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
      set(GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
      glBindFramebuffer(GL_FRAMEBUFFER, frame);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
      glDrawBuffer(GL_NONE);
      glReadBuffer(GL_NONE);
    }
    double texel(double radius) const { return 2 * margin * radius / size; }  // [m]
  };
  // for the lights that there are: a shader that asks which ones is slow without a graphics card
  struct Lit {
    GlShaders surface, fine;
    std::string words;

    explicit Lit(std::string const& lights)
        : surface(detail::surfaceVertex, light(lights, detail::surfaceFragment)),
          fine(light(lights, detail::fineVertex), detail::fineFragment),
          words(lights) {}
    static std::string light(std::string const& lights, std::string_view main) {
      return text(detail::lightWords, lights, detail::litWords, main);
    }
  };
  std::optional<Lit> lit_{};
  GlShaders depth_{detail::shadowVertex, detail::shadowFragment};
  GlShaders plain_{detail::plainVertex, detail::plainFragment};
  Shadow shadow_{};
  std::vector<Body> bodies_{};
  Drawn marks_{};
  GlMesh overlay_{2};
  std::vector<std::pair<Eigen::Vector3d, std::string>> labels_{};
  std::vector<std::string> words_{};
  std::optional<Legend> legend_{};
  std::optional<ClipPlane> clip_{};
  Eigen::Vector3d up_{0, 1, 0}, centre_{0, 0, 0}, colour_{1, 1, 1};
  double radius_ = 1;
  bool shadows_ = true;
  std::vector<SeenLight> lights_{};
  std::optional<Eigen::Vector3d> ambient_{};

  void setLights(GlShaders const& shaders, std::vector<SeenLight> const& lights,
                 Eigen::Matrix4d const& toView) const {
    std::vector<Eigen::Vector4f> places, colours, cones, falls;
    for (SeenLight const& light : lights) {
      const Eigen::Matrix4d own = light.movesWithCamera ? Eigen::Matrix4d::Identity().eval() : toView;
      const Eigen::Vector3d direction = own.topLeftCorner<3, 3>() * light.direction;
      const bool parallel = light.kind == SeenLight::Kind::parallel,
                 spot = light.kind == SeenLight::Kind::spot;
      Eigen::Vector4d place = direction.homogeneous(), cone = direction.homogeneous();
      place[3] = 0;
      if (!parallel) place = own * light.position.homogeneous();
      cone[3] = spot ? std::cos(light.cutoff * std::numbers::pi / 180) : -1;
      places.push_back(place.cast<float>());
      colours.push_back(light.colour.homogeneous().cast<float>());
      cones.push_back(cone.cast<float>());
      falls.push_back({float(light.attenuation), float(light.exponent), 0, 0});
    }
    shaders.set("place", places);
    shaders.set("colour", colours);
    shaders.set("cone", cones);
    shaders.set("fall", falls);
    // with lights of the scene there is less of what has no place
    shaders.set("around", ambient_.value_or(Eigen::Vector3d::Constant(lights_.empty() ? 0.42 : 0.2)));
    shaders.set("fromAbove", ambient_ ? 0. : 0.18 / 0.42);
  }
  // Whether no edge of a mesh is seen longer than a few pixels: its light may be computed at corners.
  static bool isFine(ShadedMesh const& mesh, Camera const& camera, int height) {
    constexpr double most = 8;  // [pixels]
    const Eigen::Vector3d eye = camera.eye(), nearest = eye.cwiseMax(mesh.low).cwiseMin(mesh.high);
    const double wide = 2 * std::tan(camera.angle / 2 * std::numbers::pi / 180) * (nearest - eye).norm();
    return mesh.longest * height < most * wide;
  }
  // positive where something is seen
  static Eigen::Vector4d everything() { return {0, 0, 0, 1}; }
  Eigen::Vector4d clipped() const {
    if (!clip_) return everything();
    return {-clip_->normal[0], -clip_->normal[1], -clip_->normal[2], clip_->offset};
  }
  // parallel light onto the sphere around everything
  Eigen::Matrix4d lightOf(Eigen::Vector3d const& light) const {
    Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
    m.block<1, 3>(0, 0) = light.unitOrthogonal().transpose();
    m.block<1, 3>(1, 0) = light.cross(light.unitOrthogonal()).transpose();
    m.block<1, 3>(2, 0) = -light.transpose();
    m.topLeftCorner<3, 3>() /= Shadow::margin * radius_;
    m.block<3, 1>(0, 3) = -(m.topLeftCorner<3, 3>() * centre_);
    return m;
  }
  void drawShadow(Eigen::Matrix4d const& toLight) {
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_.frame);
    glViewport(0, 0, shadow_.size, shadow_.size);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    depth_.use();
    depth_.set("toLight", toLight);
    depth_.set("clip", clipped());
    for (Body const& body : bodies_)
      if (!body.seenThrough()) body.drawn.faces.draw(GL_TRIANGLES, 1);
    depth_.set("clip", everything());
    marks_.faces.draw(GL_TRIANGLES);
  }
  // Bodies that one sees through, the farthest first, of each the side that looks away first: each colour
  // goes onto what is behind it.
  template <class Faces, class Thin>
  void drawSeenThrough(Camera const& camera, Faces&& drawFaces, Thin&& drawThin) const {
    std::vector<std::pair<double, Body const*>> order;
    for (Body const& body : bodies_)
      if (body.seenThrough()) {
        ShadedMesh const& mesh = body.shaded.mesh();
        order.emplace_back(((mesh.low + mesh.high) / 2 - camera.eye()).norm(), &body);
      }
    if (order.empty()) return;
    std::sort(order.begin(), order.end(), [](auto const& a, auto const& b) { return a.first > b.first; });
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    for (auto const& [_, body] : order) {
      glEnable(GL_CULL_FACE);
      for (const GLenum hidden : {GLenum(GL_FRONT), GLenum(GL_BACK)}) {
        glCullFace(hidden);
        drawFaces(*body);
      }
      glDisable(GL_CULL_FACE);
      drawThin(*body);
    }
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
  }
  // legend, words and labels, in front of everything
  void drawWords(Camera const& camera, int width, int height) {
    if (!legend_ && words_.empty() && labels_.empty()) return;
    const double luminance = colour_.dot(Eigen::Vector3d(0.3, 0.6, 0.1));
    Overlay overlay(std::max(1., height / 480.), Eigen::Vector3d::Constant(luminance > 0.5 ? 0.1 : 0.95));
    if (legend_) overlay.addLegend(*legend_, width, height);
    overlay.addWords(words_, height);
    for (auto const& [place, label] : labels_) {
      const Eigen::Vector3d at = camera.project(place, width, height);
      if (at[2] > 0 && at[2] < 1) overlay.addText(at[0], at[1], label);
    }
    Eigen::Matrix4d toClip = Eigen::Matrix4d::Identity();
    toClip(0, 0) = 2. / width, toClip(1, 1) = -2. / height;
    toClip(0, 3) = -1, toClip(1, 3) = 1;
    glDisable(GL_DEPTH_TEST);
    plain_.use();
    plain_.set("toView", Eigen::Matrix4d(Eigen::Matrix4d::Identity()));
    plain_.set("toClip", toClip);
    plain_.set("clip", everything());
    plain_.set("roundPoints", 0);
    plain_.set("opacity", 1);
    overlay_.set(overlay.triangles().at, overlay.triangles().colours);
    overlay_.draw(GL_TRIANGLES);
    glEnable(GL_DEPTH_TEST);
  }
};

}  // namespace sinew::view
