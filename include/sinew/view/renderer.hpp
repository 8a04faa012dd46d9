// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/drawn_marks.hpp>
#include <sinew/view/gl_objects.hpp>
#include <sinew/view/overlay.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/shaded_mesh.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sinew::view {

namespace detail {

inline constexpr char const* surfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
uniform mat4 toClip, toView, toLight;
uniform vec4 clip;
out vec3 atEye, normalAtEye, atLight, own;
void main() {
  own = colour;
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  vec4 p = toView * vec4(position, 1);
  atEye = p.xyz;
  normalAtEye = mat3(toView) * normal;
  atLight = (toLight * vec4(position, 1)).xyz * 0.5 + 0.5;
  gl_Position = toClip * p;
})";

// Blinn and Phong's light from up to mostLights places, one of them with its shadow, and light from all sides
// that may be brighter from above. Both sides of a face are seen.
inline constexpr char const* surfaceFragment = R"(#version 330 core
in vec3 atEye, normalAtEye, atLight, own;
uniform vec4 place[8];   // at the eye: of a light, or the direction to it (w = 0)
uniform vec3 colour[8];
uniform vec4 cone[8];    // where a spot shines to, and the cosine of its cone; -1: to all sides
uniform vec4 fall[8];    // attenuation, exponent of a spot
uniform float count, shadowOf;
uniform vec3 upAtEye, around;
uniform float fromAbove;
uniform sampler2DShadow shadow;
out vec4 pixel;
void main() {
  vec3 n = normalize(normalAtEye), toEye = normalize(-atEye);
  if (!gl_FrontFacing) n = -n;
  vec3 sum = around * (1.0 + fromAbove * dot(n, upAtEye)), shine = vec3(0.0);
  for (int k = 0; k < int(count); ++k) {
    vec3 to = place[k].xyz - place[k].w * atEye;
    float far = length(to), lit = place[k].w > 0.0 ? 1.0 / (1.0 + fall[k].x * far) : 1.0;
    to /= far;
    if (cone[k].w >= 0.0) {
      float inside = dot(-to, cone[k].xyz);
      lit *= inside > cone[k].w ? pow(inside, fall[k].y) : 0.0;
    }
    float slope = clamp(dot(n, to), 0.0, 1.0);
    if (float(k) == shadowOf) {
      float bias = 0.002 + 0.006 * (1.0 - slope), seen = 0.0;
      vec2 texel = 1.0 / vec2(textureSize(shadow, 0));
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          seen += texture(shadow, vec3(atLight.xy + vec2(i, j) * texel, atLight.z - bias)) / 9.0;
      lit *= seen;
    }
    sum += 0.75 * slope * lit * colour[k];
    shine += 0.12 * pow(max(dot(n, normalize(to + toEye)), 0.0), 40.0) * lit * colour[k];
  }
  vec3 linear = pow(own, vec3(2.2)) * sum + shine;
  pixel = vec4(pow(linear, vec3(1.0 / 2.2)), 1);
})";

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
uniform float roundPoints;
out vec4 pixel;
void main() {
  if (roundPoints > 0.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
  pixel = vec4(own, 1);
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
    auto upload = [&](ShadedMesh const& mesh) {
      if (used == bodies_.size()) bodies_.emplace_back();
      Body& body = bodies_[used++];
      body.faces.set(mesh.corners, mesh.normals, mesh.colours);
      body.faces.setIndices(mesh.triangles);
      body.lines.set(mesh.lines.at, mesh.lines.colours);
      body.points.set(mesh.points.at, mesh.points.colours);
    };
    for (SeenBody const& body : scene.bodies)
      if (body.visible) upload(shaded_mesh(body, scene.legend, scene.settings));
    DrawnMarks marks = drawn_marks(scene, radius_);
    upload(marks.mesh);
    bodies_.resize(used);
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
    surface_.use();
    surface_.set("toView", toView);
    surface_.set("toClip", toClip);
    surface_.set("toLight", toLight);
    surface_.set("clip", clipped());
    setLights(lights, toView);
    surface_.set("shadowOf", hasShadow ? double(first - lights.begin()) : -1);
    surface_.set("upAtEye", toView.topLeftCorner<3, 3>() * up_);
    surface_.setTexture("shadow", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, shadow_.depth);
    glEnable(GL_POLYGON_OFFSET_FILL);  // edges are seen on the faces they belong to
    glPolygonOffset(1, 1);
    for (Body const& body : bodies_) {
      if (&body == &bodies_.back()) surface_.set("clip", everything());  // marks are seen as a whole
      body.faces.draw(GL_TRIANGLES);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    plain_.use();
    plain_.set("toView", toView);
    plain_.set("toClip", toClip);
    plain_.set("clip", clipped());
    plain_.set("pointSize", std::max(4., height / 90.));
    for (Body const& body : bodies_) {
      if (&body == &bodies_.back()) plain_.set("clip", everything());
      plain_.set("roundPoints", 0);
      body.lines.draw(GL_LINES);
      plain_.set("roundPoints", 1);
      body.points.draw(GL_POINTS);
    }
    glDisable(GL_CLIP_DISTANCE0);
    drawWords(camera, width, height);
  }

  std::array<double, 3> background{1, 1, 1};

 private:
  struct Body {
    GlMesh faces{3}, lines{2}, points{2};
  };
  struct Shadow {
    int size = 2048;
    GlTexture depth = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
    GlFrame frame = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });

    Shadow() {
      // without a graphics card a finer one takes most of the time
      auto const* renderer = reinterpret_cast<char const*>(glGetString(GL_RENDERER));
      if (renderer && std::strstr(renderer, "llvmpipe")) size = 1024;
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
  };
  GlShaders surface_{detail::surfaceVertex, detail::surfaceFragment};
  GlShaders plain_{detail::plainVertex, detail::plainFragment};
  Shadow shadow_{};
  std::vector<Body> bodies_{};
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

  void setLights(std::vector<SeenLight> const& lights, Eigen::Matrix4d const& toView) {
    surface_.set("count", double(lights.size()));
    for (std::size_t k = 0; k < lights.size(); ++k) {
      SeenLight const& light = lights[k];
      const Eigen::Matrix4d own = light.movesWithCamera ? Eigen::Matrix4d::Identity().eval() : toView;
      const Eigen::Vector3d direction = own.topLeftCorner<3, 3>() * light.direction;
      const bool parallel = light.kind == SeenLight::Kind::parallel,
                 spot = light.kind == SeenLight::Kind::spot;
      Eigen::Vector4d place = direction.homogeneous(), cone = direction.homogeneous();
      place[3] = 0;
      if (!parallel) place = own * light.position.homogeneous();
      cone[3] = spot ? std::cos(light.cutoff * std::numbers::pi / 180) : -1;
      auto set = [&](char const* name, auto const& value) {
        surface_.set(text(name, '[', k, ']').c_str(), value);
      };
      set("place", place);
      set("colour", light.colour);
      set("cone", cone);
      set("fall", Eigen::Vector4d(light.attenuation, light.exponent, 0, 0));
    }
    // with lights of the scene there is less of what has no place
    surface_.set("around", ambient_.value_or(Eigen::Vector3d::Constant(lights_.empty() ? 0.42 : 0.2)));
    surface_.set("fromAbove", ambient_ ? 0. : 0.18 / 0.42);
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
    m.topLeftCorner<3, 3>() /= 1.05 * radius_;
    m.block<3, 1>(0, 3) = -(m.topLeftCorner<3, 3>() * centre_);
    return m;
  }
  void drawShadow(Eigen::Matrix4d const& toLight) {
    glBindFramebuffer(GL_FRAMEBUFFER, shadow_.frame);
    glViewport(0, 0, shadow_.size, shadow_.size);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    plain_.use();
    plain_.set("toView", Eigen::Matrix4d(Eigen::Matrix4d::Identity()));
    plain_.set("toClip", toLight);
    plain_.set("clip", clipped());
    for (Body const& body : bodies_) body.faces.draw(GL_TRIANGLES);
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
    overlay_.set(overlay.triangles().at, overlay.triangles().colours);
    overlay_.draw(GL_TRIANGLES);
    glEnable(GL_DEPTH_TEST);
  }
};

}  // namespace sinew::view
