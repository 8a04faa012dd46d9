// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/camera.hpp>
#include <sinew/view/stage.hpp>

#include <cmath>

namespace sinew::view {

/// What the pointer does in the picture of a scene: the left button pulls what it is pressed on, and beside
/// bodies turns the camera; the right one shifts it; the wheel goes nearer. Places are pixels from the upper
/// left corner.
class Controls {
 public:
  Controls(Stage& stage, Camera const& first) : camera(first), stage_(stage), home_(first) {}

  Camera camera;
  double stiffness = 1000;  // of the spring that pulls [N/m]

  enum class Button { left, right };
  /// `onBody`: whether there is something below the pointer.
  void press(Button button, double x, double y, int width, int height, bool onBody) {
    x_ = x, y_ = y;
    if (button == Button::right) {
      doing_ = Doing::shifts;
    } else if (onBody) {
      doing_ = Doing::pulls;
      const auto [origin, direction] = camera.ray(x, y, width, height);
      stage_.press(origin, direction, stiffness);
    } else {
      doing_ = Doing::turns;
    }
  }
  void move(double x, double y, int width, int height) {
    const double dx = x - x_, dy = y - y_;
    x_ = x, y_ = y;
    if (dx == 0 && dy == 0) return;
    switch (doing_) {
      case Doing::nothing:
        break;
      case Doing::turns:
        camera.orbit(-dx / height * std::numbers::pi, dy / height * std::numbers::pi);
        break;
      case Doing::shifts: {
        // what is at the distance of the target stays below the pointer
        const double scale =
            2 * camera.distance * std::tan(camera.angle / 2 * std::numbers::pi / 180) / height;
        camera.target += scale * (dy * camera.above() - dx * camera.right());
        break;
      }
      case Doing::pulls: {
        const auto [origin, direction] = camera.ray(x, y, width, height);
        stage_.move(origin, direction);
        break;
      }
    }
  }
  void release() {
    if (doing_ == Doing::pulls) stage_.release();
    doing_ = Doing::nothing;
  }
  /// Clicks of the wheel, forwards.
  void zoom(double clicks) {
    const double closer = std::pow(0.9, clicks);
    camera.distance *= closer;
    camera.near *= closer;
    camera.far = std::max(camera.far, 3 * camera.distance);
  }
  /// Back to the whole scene, from where it was first seen.
  void home() { camera = home_; }
  void setHome(Camera const& first) { camera = home_ = first; }
  /// The whole scene from the side of an axis: 0 x, 1 y, 2 z.
  void lookAlong(int axis) {
    camera = home_;
    camera.toEye = Eigen::Vector3d::Unit(axis);
    // what is upwards in the scene, or where one looks along that, another axis
    if (camera.up.cross(camera.toEye).norm() < 1e-3) camera.up = Eigen::Vector3d::Unit((axis + 1) % 3);
  }

 private:
  enum class Doing { nothing, turns, shifts, pulls };
  Stage& stage_;
  Camera home_;
  Doing doing_ = Doing::nothing;
  double x_ = 0, y_ = 0;
};

}  // namespace sinew::view
