// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/view/seen_settings.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The words of the shaders of view/renderer.hpp.
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
vec3 mirrored(float s);
void add(inout Light sum, vec3 n, vec3 toEye, vec3 to, vec3 colour) {
  sum.diffuse += 0.75 * clamp(dot(n, to), 0.0, 1.0) * colour;
  sum.shine += mirrored(max(dot(n, normalize(to + toEye)), 0.0)) * colour;
}
vec3 linear(vec3 colour) { return pow(colour, vec3(2.2)); }
)";
inline constexpr std::string_view litWords = R"(
vec3 lit(vec3 n, vec3 atEye, vec3 own, float seen) {
  Light sum = Light(openness() * around * (1.0 + fromAbove * dot(n, upAtEye)), vec3(0.0));
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

// What is mirrored of light that comes from beside the mirror, by the cosine of the angle between the normal
// and the middle of light and eye: of bodies without a material 0.12 of its 40th power,
inline constexpr std::string_view plainMirror = R"(
vec3 mirrored(float s) {
  s *= s * s * s * s;
  s *= s, s *= s, s *= s;
  return vec3(0.12 * s);
}
)";
// and what a material says of others.
inline constexpr std::string_view materialMirror = R"(
uniform vec3 specular;
uniform float shininess;
vec3 mirrored(float s) { return specular * pow(s, shininess); }
)";

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
// with the colour of a texture there,
inline constexpr char const* texturedVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 3) in vec3 texcoord;
uniform mat4 toClip, toView;
uniform vec4 clip;
out vec3 atEye, normalAtEye, own;
out vec2 inImage;
void main() {
  own = colour;
  inImage = texcoord.xy;
  gl_ClipDistance[0] = dot(clip, vec4(position, 1));
  vec4 p = toView * vec4(position, 1);
  atEye = p.xyz;
  normalAtEye = mat3(toView) * normal;
  gl_Position = toClip * p;
})";
inline constexpr std::string_view texturedFragment = R"(
in vec3 atEye, normalAtEye, own;
in vec2 inImage;
uniform sampler2D image;
out vec4 pixel;
void main() {
  vec4 texel = texture(image, inImage);
  if (texel.a < 0.5) discard;
  vec3 n = normalize(gl_FrontFacing ? normalAtEye : -normalAtEye);
  pixel = vec4(lit(n, atEye, linear(own) * linear(texel.rgb), seenByLight(n, atEye)), opacity);
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

}  // namespace sinew::view
