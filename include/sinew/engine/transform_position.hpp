// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// How TransformPosition moves points.
enum class PositionTransform {
  projectOnPlane,
  translation,
  rotation,
  random,
  scale,
  scaleTranslation,
  scaleRotationTranslation,
  affine,
  fromFile
};
constexpr auto enum_names(PositionTransform) {
  return std::to_array<std::string_view>({"projectOnPlane",
                                          "translation",
                                          "rotation",
                                          "random",
                                          "scale",
                                          "scaleTranslation",
                                          "scaleRotationTranslation",
                                          "affine",
                                          "fromFile"});
}

/// Moves points by one of several methods, with o = origin, n = normal of length 1, t = translation, R the
/// rotation by angles and S the scale:
///   projectOnPlane  x + n (o - x).n         translation  x + t        rotation  R x
///   scale  o + S (x - o)    scaleTranslation  S x + t    scaleRotationTranslation  R S x + t
///   affine  (M (x, 1)) / its fourth number, with M = matrix; fromFile: the matrix is read from a file
///   random  x + r, the numbers of r at random up to maxRandomDisplacement; the same ones with each run
struct TransformPosition {
  using Role = role::Engine;
  static constexpr std::string_view className = "TransformPosition";

  Eigen::Vector3d origin{0, 0, 0};
  std::vector<Eigen::Vector3d> inputPosition{};
  Eigen::Vector3d normal{0, 0, 0}, translation{0, 0, 0}, rotation{0, 0, 0}, scale{1, 1, 1};
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  PositionTransform method = PositionTransform::projectOnPlane;
  int seedValue = 0;
  double maxRandomDisplacement = 1;
  std::vector<int> fixedIndices{};
  DataFile filename{};

  static constexpr auto fields() {
    using T = TransformPosition;
    return field_list(
        field("origin", &T::origin, "m", "a point of the plane, or the centre of the scale"),
        field("input_position", &T::inputPosition, "m", "where the points are").also("inputPosition"),
        field("normal", &T::normal, "", "of the plane"),
        field("translation", &T::translation, "m", "moves the points"),
        field("rotation", &T::rotation, "degrees", "rotates them about the axes x, y and z, in this order"),
        field("scale", &T::scale, "", "sizes along the axes x, y and z"),
        field("matrix", &T::matrix, "", "4 by 4 numbers, row by row"),
        field("method", &T::method, "", "what is done"),
        field("seedValue", &T::seedValue, "", "begins the random numbers", range::nonNegative),
        field("maxRandomDisplacement",
              &T::maxRandomDisplacement,
              "m",
              "along each axis at most",
              range::nonNegative),
        field("fixedIndices", &T::fixedIndices, "", "points that stay", range::nonNegative),
        field(
            "filename",
            &T::filename,
            "",
            "the file of the matrix: .trm, a translation and three lines of a rotation; .xfm and .txt, four "
            "lines of it; .tfm, 12 numbers behind Parameters, the last three of which are the translation "
            "from z to x"));
  }

  std::vector<Eigen::Vector3d> outputPosition{};  // after update

  static constexpr auto outputs() {
    return field_list(
        field("output_position", &TransformPosition::outputPosition, "m", "where the points are put")
            .also("outputPosition"));
  }

  /// Throws Error where the plane has no normal, an index is out of range, or the file cannot be read; the
  /// output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/lists.hpp>
#include <sinew/core/placement.hpp>
#include <sinew/io/text_mesh_file.hpp>
#include <sinew/io/text_reader.hpp>

#include <cmath>
#include <random>

namespace sinew {

namespace detail {

SINEW_ONCE Eigen::Matrix4d read_transformation(std::string const& path) {
  const std::string ending = io::file_ending(path), content = io::read_file(path);
  io::TextReader in(path, content);
  in.rejectBinary();
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  if (ending == ".trm") {
    for (int i = 0; i < 3; ++i) m(i, 3) = in.real("a number of the translation");
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = in.real("a number of the rotation");
  } else if (ending == ".txt" || ending == ".xfm") {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m(i, j) = in.real("a number of the matrix");
  } else if (ending == ".tfm") {
    while (in.more()) {
      std::string_view word = in.wordOnLine();
      if (word.find("Parameters") == word.npos || word.find("Fixed") != word.npos) {
        in.restOfLine();
        continue;
      }
      std::vector<double> numbers;
      for (word = in.wordOnLine(); !word.empty(); word = in.wordOnLine())
        if (double number = 0; io::parse_number(word, number) && std::isfinite(number))
          numbers.push_back(number);
        else if (word != "=" && word != ":")
          throw in.expected("a number of the transformation");
      if (numbers.size() != 12)
        throw in.error(text("has ", numbers.size(), " numbers behind Parameters, but must have 12"));
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) m(i, j) = numbers[std::size_t(3 * i + j)];
        m(i, 3) = numbers[std::size_t(11 - i)];
      }
      return m;
    }
    throw in.error("has no line of Parameters; get a complete file");
  } else {
    throw Error(path, "is no file of a transformation; these end in .trm, .tfm, .xfm or .txt");
  }
  if (in.more()) {
    in.word();
    throw in.error("goes on behind the transformation; remove what is too much");
  }
  return m;
}

}  // namespace detail

SINEW_ONCE void TransformPosition::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  using enum PositionTransform;
  check_numbers(at, "fixedIndices", fixedIndices, inputPosition.size(), "points", "input_position");
  if (method == projectOnPlane && !(normal.norm() > 0))
    throw Error(at, "normal is 0 0 0; give the normal of the plane, or another method");
  Eigen::Matrix4d m = matrix;
  if (method == fromFile) {
    if (filename.path.empty()) throw Error(at, "filename is empty; name the file of the transformation");
    try {
      m = detail::read_transformation(filename.path);
    } catch (Error const& error) {
      throw Error(at, error.what());
    }
  }
  Placement placed{Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
  if (method == translation) placed.translation = this->translation;
  if (method == rotation) placed.linear = rotation_of_degrees(this->rotation).toRotationMatrix();
  if (method == scaleTranslation)
    placed = placement(this->translation, Eigen::Vector3d(0, 0, 0), this->scale);
  if (method == scaleRotationTranslation) placed = placement(this->translation, this->rotation, this->scale);
  std::mt19937_64 generator(static_cast<unsigned>(seedValue));
  const Eigen::Vector3d n = normal.stableNormalized();
  outputPosition.clear();
  for (auto const& x : inputPosition) {
    Eigen::Vector3d y = placed * x;
    if (method == projectOnPlane) y = x + n * (origin - x).dot(n);
    if (method == scale) y = origin + (x - origin).cwiseProduct(this->scale);
    if (method == random)
      for (double& c : y) c += maxRandomDisplacement * (double(generator() >> 11) * 0x1p-52 - 1);
    if (method == affine || method == fromFile) {
      const Eigen::Vector4d h = m * x.homogeneous();
      if (!(std::abs(h[3]) > 1e-10))
        throw Error(at, text("the matrix takes point ", outputPosition.size(), " to infinity; correct it"));
      y = h.head<3>() / h[3];
    }
    outputPosition.push_back(y);
  }
  for (const int i : fixedIndices) outputPosition[std::size_t(i)] = inputPosition[std::size_t(i)];
}

}  // namespace sinew
#endif
