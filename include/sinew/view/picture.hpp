// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/image.hpp>
#include <sinew/view/offscreen.hpp>
#include <sinew/view/renderer.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/smooth_target.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace sinew::view {

struct PictureSettings {
  int width = 1280, height = 960;  // [pixels]
  std::optional<Camera>
      camera{};  // without one the first picture shows all of the scene, and later ones the same place
  SeenSettings seen{};
};

/// The camera that sees all of a scene: from the front, the right and above.
inline Camera camera_of(SeenScene const& scene, int width, int height) {
  Camera camera;
  camera.up = scene.up;
  const Eigen::Vector3d other =
      std::abs(scene.up[2]) > 0.7 ? Eigen::Vector3d(0, -1, 0) : Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector3d right = scene.up.cross(other).normalized(), front = right.cross(scene.up);
  camera.toEye = (front + 0.6 * right + 0.5 * scene.up).normalized();
  const auto [low, high] = scene.box();
  const double radius = (high - low).norm() / 2;
  camera.fit((low + high) / 2, radius > 0 ? radius : 1, double(width) / height);
  return camera;
}

/// The pixels of the frame buffer that is bound for reading.
inline Image read_image(int width, int height) {
  Image image{width, height, std::vector<unsigned char>(std::size_t(width) * std::size_t(height) * 3)};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const auto row = std::ptrdiff_t(width) * 3;
  for (std::ptrdiff_t y = 0; y < height / 2; ++y)  // OpenGL begins with the lowest row
    std::swap_ranges(image.rgb.begin() + row * y,
                     image.rgb.begin() + row * (y + 1),
                     image.rgb.begin() + row * (height - 1 - y));
  return image;
}

/// Pictures of scenes without a window, on a graphics card or by Mesa's software.
class Painter {
 public:
  /// Throws Error where the size is none, and where there is no OpenGL 3.3.
  explicit Painter(PictureSettings const& settings = {}) : settings_(checked(settings)) {
    target_.resize(settings_.width, settings_.height, 8);
  }

  Image paint(SeenScene const& scene) {
    if (!settings_.camera) settings_.camera = camera_of(scene, settings_.width, settings_.height);
    renderer_.show(scene);
    target_.begin();
    renderer_.draw(*settings_.camera, settings_.width, settings_.height);
    target_.end();
    Image image = read_image(settings_.width, settings_.height);
    if (const GLenum wrong = glGetError(); wrong != GL_NO_ERROR)
      throw Error("pictures", text("OpenGL says error ", wrong, "; is there enough memory?"));
    return image;
  }
  /// The camera of the pictures; none before the first, where none was given.
  std::optional<Camera> const& camera() const { return settings_.camera; }

 private:
  PictureSettings settings_;
  OffscreenContext context_{};  // before what is made in it
  Renderer renderer_{};
  SmoothTarget target_{};

  static PictureSettings const& checked(PictureSettings const& settings) {
    if (settings.width < 1 || settings.height < 1)
      throw Error("pictures",
                  text("a picture of ",
                       settings.width,
                       " x ",
                       settings.height,
                       " pixels has none; width and height are at least 1"));
    return settings;
  }
};

/// A picture of a simulation as it is now: Picture(sim).write("a.png").
class Picture {
 public:
  template <class Simulation>
  explicit Picture(Simulation& simulation, PictureSettings const& settings = {})
      : image_(Painter(settings).paint(seen_scene(simulation, settings.seen))) {}
  Image const& image() const { return image_; }
  void write(std::string const& path) const { write_png(image_, path); }

 private:
  Image image_;
};

}  // namespace sinew::view
