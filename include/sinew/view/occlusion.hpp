// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/gl_objects.hpp>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::view {

namespace detail {

inline constexpr char const* wholePicture = R"(#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); })";
// Of the half ball around a place, on the side of its normal, how much is in front of what is seen there:
// 16 points of it, turned about the normal by 16 angles in blocks of 4 x 4 pixels. What is far in front of a
// point is another body, which does not hide it.
inline constexpr char const* openFragment = R"(#version 330 core
uniform sampler2D depth;
uniform mat4 toClip, fromClip;
uniform vec4 points[16];
uniform float radius;
out float open;
vec3 placeAt(vec2 at) {
  vec4 p = fromClip * vec4(vec3(at, textureLod(depth, at, 0.0).r) * 2.0 - 1.0, 1);
  return p.xyz / p.w;
}
// along x or y, to the neighbour that is on the same face
vec3 along(vec2 at, vec3 p, vec2 step) {
  vec3 a = placeAt(at + step) - p, b = p - placeAt(at - step);
  return abs(a.z) < abs(b.z) ? a : b;
}
void main() {
  vec2 size = vec2(textureSize(depth, 0)), at = gl_FragCoord.xy / size;
  open = 1.0;
  if (textureLod(depth, at, 0.0).r == 1.0) return;
  vec3 p = placeAt(at);
  vec3 n = normalize(cross(along(at, p, vec2(1, 0) / size), along(at, p, vec2(0, 1) / size)));
  if (dot(n, p) > 0.0) n = -n;
  ivec2 of = ivec2(gl_FragCoord.xy) % 4;
  float angle = 0.39269908 * float(4 * of.y + of.x);  // a 16th of a turn
  vec3 u = normalize(abs(n.z) < 0.9 ? cross(n, vec3(0, 0, 1)) : cross(n, vec3(1, 0, 0))), v = cross(n, u);
  vec3 x = cos(angle) * u + sin(angle) * v, y = cross(n, x);
  float hidden = 0.0;
  for (int k = 0; k < 16; ++k) {
    vec3 s = p + radius * (points[k].x * x + points[k].y * y + points[k].z * n);
    vec4 clip = toClip * vec4(s, 1);
    float before = placeAt(clip.xy / clip.w * 0.5 + 0.5).z - s.z;
    if (before > 0.02 * radius && before < 2.0 * radius) hidden += 1.0;
  }
  open = 1.0 - hidden / 16.0;
})";
// The mean of a block of 4 x 4 pixels, of which the card's filter takes four at a time.
inline constexpr std::string_view openWords = R"(
uniform sampler2D open;
uniform vec2 corner;      // of the picture [pixels]
uniform float occludes;   // 0: of what is seen through
float four(vec2 p) { return textureLod(open, p / vec2(textureSize(open, 0)), 0.0).r; }
float openness() {
  vec2 p = gl_FragCoord.xy - corner - 1.5;
  float sum = four(p) + four(p + vec2(2, 0)) + four(p + vec2(0, 2)) + four(p + vec2(2, 2));
  return mix(1.0, 0.25 * sum, occludes);
}
)";
inline constexpr std::string_view allOpenWords = R"(
float openness() { return 1.0; }
)";

}  // namespace detail

/// How much of the light from all sides reaches what a picture shows: ambient occlusion, by what is seen
/// around each pixel within a radius (Mittring 2007). The depths come from drawing the scene once more.
class Occlusion {
 public:
  /// draw() draws all that hides, into depths alone.
  template <class Draw>
  void make(Eigen::Matrix4d const& toClip, int width, int height, double radius, Draw&& draw) {
    resize(width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, depthFrame_);
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    draw();
    glBindFramebuffer(GL_FRAMEBUFFER, openFrame_);
    glDisable(GL_DEPTH_TEST);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, depth_);
    shaders_.use();
    shaders_.setTexture("depth", 0);
    shaders_.set("toClip", toClip);
    shaders_.set("fromClip", Eigen::Matrix4d(toClip.inverse()));
    shaders_.set("points", points());
    shaders_.set("radius", radius);
    glBindVertexArray(nothing_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
  }
  GLuint texture() const { return open_; }

 private:
  GlShaders shaders_{detail::wholePicture, detail::openFragment};
  GlVertices nothing_ = detail::made<GlVertices>([](auto n, auto* id) { glGenVertexArrays(n, id); });
  GlTexture depth_{}, open_{};
  GlFrame depthFrame_{}, openFrame_{};
  int width_ = 0, height_ = 0;

  // evenly in the half ball around z, by the sequence R3 (Roberts 2018)
  static std::vector<Eigen::Vector4f> const& points() {
    static const std::vector<Eigen::Vector4f> all = [] {
      std::vector<Eigen::Vector4f> made;
      for (int k = 0; k < 16; ++k) {
        auto part = [&](double by) { return std::fmod(0.5 + (k + 1) * by, 1.); };
        const double r = std::cbrt((k + 0.5) / 16), z = part(0.6710436067),
                     angle = 2 * std::numbers::pi * part(0.5497004779);
        const double around = std::sqrt(1 - z * z);
        made.push_back(
            {float(r * around * std::cos(angle)), float(r * around * std::sin(angle)), float(r * z), 0});
      }
      return made;
    }();
    return all;
  }
  void resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width, height_ = height;
    auto texture = [&](GLint format, GLenum channels, GLenum type, GLint filter) {
      GlTexture made = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
      glBindTexture(GL_TEXTURE_2D, made);
      glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, channels, type, nullptr);
      for (const GLenum which : {GLenum(GL_TEXTURE_MIN_FILTER), GLenum(GL_TEXTURE_MAG_FILTER)})
        glTexParameteri(GL_TEXTURE_2D, which, filter);
      for (const GLenum which : {GLenum(GL_TEXTURE_WRAP_S), GLenum(GL_TEXTURE_WRAP_T)})
        glTexParameteri(GL_TEXTURE_2D, which, GL_CLAMP_TO_EDGE);
      return made;
    };
    auto frame = [&](GLenum place, GLuint to) {
      GlFrame made = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });
      glBindFramebuffer(GL_FRAMEBUFFER, made);
      glFramebufferTexture2D(GL_FRAMEBUFFER, place, GL_TEXTURE_2D, to, 0);
      if (place != GL_DEPTH_ATTACHMENT) return made;
      glDrawBuffer(GL_NONE);
      glReadBuffer(GL_NONE);
      return made;
    };
    depth_ = texture(GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT, GL_FLOAT, GL_NEAREST);
    open_ = texture(GL_R8, GL_RED, GL_UNSIGNED_BYTE, GL_LINEAR);
    depthFrame_ = frame(GL_DEPTH_ATTACHMENT, depth_);
    openFrame_ = frame(GL_COLOR_ATTACHMENT0, open_);
  }
};

}  // namespace sinew::view
