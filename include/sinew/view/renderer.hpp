// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/gl_objects.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/shaded_mesh.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace sinew::view {

/// Colours that people who see colours differently can tell apart (Okabe, Ito 2008), red, green, blue.
inline constexpr std::array<std::array<double, 3>, 7> palette{{{0.84, 0.37, 0.0},
                                                               {0.0, 0.45, 0.70},
                                                               {0.0, 0.62, 0.45},
                                                               {0.80, 0.47, 0.65},
                                                               {0.90, 0.62, 0.0},
                                                               {0.34, 0.71, 0.91},
                                                               {0.94, 0.89, 0.26}}};

namespace detail {

inline constexpr char const* surfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 toClip, toView, toLight;
out vec3 atEye, normalAtEye, atLight;
void main() {
  vec4 p = toView * vec4(position, 1);
  atEye = p.xyz;
  normalAtEye = mat3(toView) * normal;
  atLight = (toLight * vec4(position, 1)).xyz * 0.5 + 0.5;
  gl_Position = toClip * p;
})";

// Blinn and Phong's light from one side, with its shadow, and light from all sides that is brighter from
// above. Both sides of a face are seen.
inline constexpr char const* surfaceFragment = R"(#version 330 core
in vec3 atEye, normalAtEye, atLight;
uniform vec3 colour, lightAtEye, upAtEye;
uniform sampler2DShadow shadow;
out vec4 pixel;
void main() {
  vec3 n = normalize(normalAtEye), toEye = normalize(-atEye);
  if (!gl_FrontFacing) n = -n;
  float slope = clamp(dot(n, lightAtEye), 0.0, 1.0);
  float bias = 0.002 + 0.006 * (1.0 - slope), lit = 0.0;
  vec2 texel = 1.0 / vec2(textureSize(shadow, 0));
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      lit += texture(shadow, vec3(atLight.xy + vec2(i, j) * texel, atLight.z - bias)) / 9.0;
  float around = 0.42 + 0.18 * dot(n, upAtEye);
  float shine = pow(max(dot(n, normalize(lightAtEye + toEye)), 0.0), 40.0);
  vec3 linear = pow(colour, vec3(2.2)) * (around + 0.75 * slope * lit) + 0.12 * shine * lit;
  pixel = vec4(pow(linear, vec3(1.0 / 2.2)), 1);
})";

inline constexpr char const* plainVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 toClip, toView;
uniform float pointSize;
void main() {
  gl_Position = toClip * (toView * vec4(position, 1));
  gl_PointSize = pointSize;
})";

inline constexpr char const* plainFragment = R"(#version 330 core
uniform vec3 colour;
uniform float roundPoints;
out vec4 pixel;
void main() {
  if (roundPoints > 0.0 && length(gl_PointCoord - 0.5) > 0.5) discard;
  pixel = vec4(colour, 1);
})";

}  // namespace detail

/// Draws scenes with OpenGL 3.3 into the frame buffer that is bound; the context in which it is made is
/// current.
class Renderer {
 public:
  /// Brings what is seen onto the graphics card.
  void show(SeenScene const& scene) {
    bodies_.resize(std::min(bodies_.size(), scene.bodies.size()));
    while (bodies_.size() < scene.bodies.size()) bodies_.emplace_back();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      const ShadedMesh mesh = shaded_mesh(scene.bodies[i]);
      bodies_[i].faces.set(mesh.corners, mesh.normals);
      bodies_[i].lines.set(mesh.lines);
      bodies_[i].points.set(mesh.points);
      bodies_[i].hasFaces = !mesh.corners.empty();
    }
    up_ = scene.up;
    auto const& [low, high] = scene.box();
    centre_ = (low + high) / 2;
    radius_ = std::max((high - low).norm() / 2, 1e-9);
  }

  /// `left`: the pixels that are left free beside the picture.
  void draw(Camera const& camera, int width, int height, int left = 0) {
    const Eigen::Matrix4d toView = camera.toView(), toClip = camera.toClip(double(width) / height);
    // from the left above the eye
    const Eigen::Vector3d light =
        (0.6 * camera.toEye - 0.5 * camera.right() + 0.7 * camera.above()).normalized();
    const Eigen::Matrix4d toLight = lightOf(light);
    GLint target = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
    drawShadow(toLight);
    glBindFramebuffer(GL_FRAMEBUFFER, GLuint(target));

    glViewport(left, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_MULTISAMPLE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glClearColor(GLfloat(background[0]), GLfloat(background[1]), GLfloat(background[2]), 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    surface_.use();
    surface_.set("toView", toView);
    surface_.set("toClip", toClip);
    surface_.set("toLight", toLight);
    surface_.set("lightAtEye", toView.topLeftCorner<3, 3>() * light);
    surface_.set("upAtEye", toView.topLeftCorner<3, 3>() * up_);
    surface_.setTexture("shadow", 0);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, shadow_.depth);
    glEnable(GL_POLYGON_OFFSET_FILL);  // edges are seen on the faces they belong to
    glPolygonOffset(1, 1);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      surface_.set("colour", colourOf(i));
      bodies_[i].faces.draw(GL_TRIANGLES);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
    plain_.use();
    plain_.set("toView", toView);
    plain_.set("toClip", toClip);
    plain_.set("pointSize", std::max(4., height / 90.));
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      plain_.set("roundPoints", 0);
      plain_.set("colour", bodies_[i].hasFaces ? Eigen::Vector3d(0.4 * colourOf(i)) : colourOf(i));
      bodies_[i].lines.draw(GL_LINES);
      plain_.set("roundPoints", 1);
      bodies_[i].points.draw(GL_POINTS);
    }
  }

  std::array<double, 3> background{1, 1, 1};

 private:
  struct Body {
    GlMesh faces{2}, lines{1}, points{1};
    bool hasFaces = false;
  };
  struct Shadow {
    static constexpr int size = 2048;
    GlTexture depth = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
    GlFrame frame = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });

    Shadow() {
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
  Eigen::Vector3d up_{0, 1, 0}, centre_{0, 0, 0};
  double radius_ = 1;

  static Eigen::Vector3d colourOf(std::size_t body) {
    return Eigen::Vector3d(palette[body % palette.size()].data());
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
    glViewport(0, 0, Shadow::size, Shadow::size);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    plain_.use();
    plain_.set("toView", Eigen::Matrix4d(Eigen::Matrix4d::Identity()));
    plain_.set("toClip", toLight);
    for (Body const& body : bodies_) body.faces.draw(GL_TRIANGLES);
  }
};

}  // namespace sinew::view
