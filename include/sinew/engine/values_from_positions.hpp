// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// What ValuesFromPositions makes.
enum class FieldKind { scalar, vector };
constexpr auto enum_names(FieldKind) { return std::to_array<std::string_view>({"Scalar", "Vector"}); }

/// Values along a direction: the input values are those at equal distances from the lowest to the highest
/// place of all points, x.d, with d = direction, and lines between them. Points have theirs, elements that of
/// their mean. As vectors all have the direction.
template <class D>
struct ValuesFromPositions {
  using Role = role::Engine;
  using DataTypes = D;
  static_assert(D::spatial == 3, "ValuesFromPositions is over points in space");
  static constexpr std::string_view className = "ValuesFromPositions";

  std::vector<double> inputValues{};
  Eigen::Vector3d direction{0, 1, 0};
  typename D::VecCoord position{};
  std::vector<Edge> edges{};
  std::vector<Triangle> triangles{};
  std::vector<Tetrahedron> tetrahedra{};
  FieldKind fieldType = FieldKind::scalar;

  static constexpr auto fields() {
    using V = ValuesFromPositions;
    return field_list(field("inputValues", &V::inputValues, "", "values along the direction"),
                      field("direction", &V::direction, "", "along which they are"),
                      field("position", &V::position, "m", "points").also("rest_position"),
                      field("edges", &V::edges, "", "over the points", range::nonNegative),
                      field("triangles", &V::triangles, "", "over the points", range::nonNegative),
                      field("tetrahedra", &V::tetrahedra, "", "over the points", range::nonNegative),
                      field("fieldType", &V::fieldType, "", "whether values or vectors are made"));
  }

  // after update
  std::vector<double> values{}, edgeValues{}, triangleValues{}, tetrahedronValues{};
  std::vector<Eigen::Vector3d> pointVectors{}, edgeVectors{}, triangleVectors{}, tetrahedronVectors{};

  static constexpr auto outputs() {
    using V = ValuesFromPositions;
    return field_list(field("values", &V::values, "", "of the points"),
                      field("edgeValues", &V::edgeValues, "", "of the edges"),
                      field("triangleValues", &V::triangleValues, "", "of the triangles"),
                      field("tetrahedronValues", &V::tetrahedronValues, "", "of the tetrahedra"),
                      field("pointVectors", &V::pointVectors, "", "of the points"),
                      field("edgeVectors", &V::edgeVectors, "", "of the edges"),
                      field("triangleVectors", &V::triangleVectors, "", "of the triangles"),
                      field("tetrahedronVectors", &V::tetrahedronVectors, "", "of the tetrahedra"));
  }

  /// Throws Error where there is no point, or an element refers to a missing one; the outputs then stay.
  void update(std::string_view where) {
    check_fields(*this, where);
    const std::string at = text(where, ": ", component_name<ValuesFromPositions>());
    if (position.empty())
      throw Error(at, "position is empty; link it to the points of a loader, topology or state");
    detail::check_indices(at, "edge", edges, position.size());
    detail::check_indices(at, "triangle", triangles, position.size());
    detail::check_indices(at, "tetrahedron", tetrahedra, position.size());
    const bool vectors = fieldType == FieldKind::vector;
    auto fill = [&](auto& to, std::size_t n, auto const& value) {
      to.clear();
      for (std::size_t i = 0; i < n; ++i) to.push_back(value(i));
    };
    auto none = [&](auto&... lists) { (lists.clear(), ...); };
    if (vectors) {
      auto same = [&](std::size_t) { return direction; };
      none(values, edgeValues, triangleValues, tetrahedronValues);
      fill(pointVectors, position.size(), same), fill(edgeVectors, edges.size(), same);
      fill(triangleVectors, triangles.size(), same), fill(tetrahedronVectors, tetrahedra.size(), same);
      return;
    }
    none(pointVectors, edgeVectors, triangleVectors, tetrahedronVectors);
    double low = along(0), high = low;
    for (std::size_t i = 0; i < position.size(); ++i)
      low = std::min(low, along(i)), high = std::max(high, along(i));
    const double intervals = double(inputValues.size()) - 1;
    auto value = [&](double place) {
      if (inputValues.empty()) return 0.0;
      const double t = high > low ? std::clamp((place - low) / (high - low), 0.0, 1.0) * intervals : 0;
      const std::size_t k = std::min(std::size_t(t), inputValues.size() - 1),
                        next = std::min(k + 1, inputValues.size() - 1);
      return inputValues[k] + (t - double(k)) * (inputValues[next] - inputValues[k]);
    };
    auto means = [&](auto& to, auto const& elements) {
      fill(to, elements.size(), [&](std::size_t e) {
        double sum = 0;
        for (const Index i : elements[e]) sum += along(std::size_t(i));
        return value(sum / double(elements[e].size()));
      });
    };
    fill(values, position.size(), [&](std::size_t i) { return value(along(i)); });
    means(edgeValues, edges), means(triangleValues, triangles), means(tetrahedronValues, tetrahedra);
  }

 private:
  double along(std::size_t i) const {
    return direction.dot(D::center(position[i]).template cast<double>().eval());
  }
};

}  // namespace sinew
