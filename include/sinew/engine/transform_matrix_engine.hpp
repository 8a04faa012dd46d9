// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <string_view>

namespace sinew {

namespace detail {

struct TranslateTransform {
  static constexpr std::string_view className = "TranslateTransformMatrixEngine", field = "translation",
                                    unit = "m", purpose = "moves the points, before inT does";
  static Eigen::Vector3d standard() { return {0, 0, 0}; }
  static Eigen::Matrix4d matrix(Eigen::Vector3d const& translation);
};
struct RotateTransform {
  static constexpr std::string_view
      className = "RotateTransformMatrixEngine",
      field = "rotation", unit = "degrees",
      purpose = "rotates the points about the axes x, y and z, in this order, before inT";
  static Eigen::Vector3d standard() { return {0, 0, 0}; }
  static Eigen::Matrix4d matrix(Eigen::Vector3d const& rotation);
};
struct ScaleTransform {
  static constexpr std::string_view className = "ScaleTransformMatrixEngine", field = "scale", unit = "",
                                    purpose = "sizes along the axes x, y and z, before inT";
  static Eigen::Vector3d standard() { return {1, 1, 1}; }
  static Eigen::Matrix4d matrix(Eigen::Vector3d const& scale);
};

}  // namespace detail

/// A transformation as a matrix of 4 by 4 numbers, outT = inT T, which a loader may take for its points.
template <class Transform>
struct TransformMatrixEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = Transform::className;

  Eigen::Matrix4d inT = Eigen::Matrix4d::Identity();
  Eigen::Vector3d value = Transform::standard();

  static constexpr auto fields() {
    using E = TransformMatrixEngine;
    return field_list(field("inT", &E::inT, "", "what is done after it, row by row"),
                      field(Transform::field, &E::value, Transform::unit, Transform::purpose));
  }

  Eigen::Matrix4d outT = Eigen::Matrix4d::Identity();  // after update

  static constexpr auto outputs() {
    return field_list(field("outT", &TransformMatrixEngine::outT, "", "both, row by row"));
  }

  void update(std::string_view where) {
    check_fields(*this, where);
    outT = inT * Transform::matrix(value);
  }
};

/// A translation as a matrix, before another transformation.
using TranslateTransformMatrixEngine = TransformMatrixEngine<detail::TranslateTransform>;
/// A rotation by angles as a matrix, before another transformation.
using RotateTransformMatrixEngine = TransformMatrixEngine<detail::RotateTransform>;
/// Sizes along the axes as a matrix, before another transformation.
using ScaleTransformMatrixEngine = TransformMatrixEngine<detail::ScaleTransform>;

/// The inverse of a transformation: outT = inT^-1.
struct InvertTransformMatrixEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "InvertTransformMatrixEngine";

  Eigen::Matrix4d inT = Eigen::Matrix4d::Identity();

  static constexpr auto fields() {
    return field_list(field("inT", &InvertTransformMatrixEngine::inT, "", "the transformation, row by row"));
  }

  Eigen::Matrix4d outT = Eigen::Matrix4d::Identity();  // after update

  static constexpr auto outputs() {
    return field_list(field("outT", &InvertTransformMatrixEngine::outT, "", "its inverse, row by row"));
  }

  /// Throws Error where there is none; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/placement.hpp>

#include <Eigen/LU>

namespace sinew {

namespace detail {
SINEW_ONCE Eigen::Matrix4d TranslateTransform::matrix(Eigen::Vector3d const& translation) {
  Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
  t.topRightCorner<3, 1>() = translation;
  return t;
}
SINEW_ONCE Eigen::Matrix4d RotateTransform::matrix(Eigen::Vector3d const& rotation) {
  Eigen::Matrix4d t = Eigen::Matrix4d::Identity();
  t.topLeftCorner<3, 3>() = rotation_of_degrees(rotation).toRotationMatrix();
  return t;
}
SINEW_ONCE Eigen::Matrix4d ScaleTransform::matrix(Eigen::Vector3d const& scale) {
  return scale.homogeneous().asDiagonal();
}
}  // namespace detail

SINEW_ONCE void InvertTransformMatrixEngine::update(std::string_view where) {
  check_fields(*this, where);
  // by cofactors, over the largest entry, so that what is small is not taken for singular
  const double size = inT.cwiseAbs().maxCoeff();
  bool invertible = false;
  if (size > 0) (inT / size).eval().computeInverseWithCheck(outT, invertible, 1e-60);
  if (!invertible) throw Error(text(where, ": ", className), "inT has no inverse; no size of it may be 0");
  outT /= size;
}

}  // namespace sinew
#endif
