// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/data_types.hpp>

#include <array>
#include <string_view>

namespace sinew {

enum class CrossSectionShape { circular, rectangular };
inline constexpr std::array<std::string_view, 2> enum_names(CrossSectionShape) {
  return {"circular", "rectangular"};
}

/// What a beam along x feels of its cross-section in the yz plane.
struct BeamSection {
  double area;            // [m^2]
  double aboutY, aboutZ;  // second moments: of z^2 and of y^2 [m^4]
  double torsion;         // Saint-Venant's constant [m^4]
  double shear;           // part of the area that carries shear (Cowper 1966)
};

/// A disc, or a ring.
BeamSection circular_section(double radius, double radiusInner, double poissonRatio);

/// A rectangle with sides along y and z. With the longer side a and the shorter b, the torsion constant is
/// a b^3 (1/3 - 64/pi^5 b/a sum over odd n of tanh(n pi a / 2b) / n^5) (Timoshenko & Goodier 1970).
BeamSection rectangular_section(double lengthY, double lengthZ, double poissonRatio);

/// The section that the fields of a beam's component give. Throws Error for a ring without a wall.
BeamSection beam_section(std::string_view where, CrossSectionShape shape, double radius, double radiusInner,
                         double lengthY, double lengthZ, double poissonRatio);

/// Axes of a beam between two frames at rest: the first along the chord; the second as near as may be to that
/// of the frames.
Eigen::Quaterniond beam_axes(Eigen::Vector3d const& chord, Eigen::Quaterniond const& node0,
                             Eigen::Quaterniond const& node1);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sinew {

SINEW_ONCE BeamSection circular_section(double radius, double radiusInner, double poissonRatio) {
  const double outer = radius * radius, inner = radiusInner * radiusInner, nu = poissonRatio;
  const double second = std::numbers::pi / 4 * (outer * outer - inner * inner);
  const double m = inner / outer, p = (1 + m) * (1 + m);
  return {.area = std::numbers::pi * (outer - inner),
          .aboutY = second,
          .aboutZ = second,
          .torsion = 2 * second,
          .shear = 6 * (1 + nu) * p / ((7 + 6 * nu) * p + (20 + 12 * nu) * m)};
}

SINEW_ONCE BeamSection rectangular_section(double lengthY, double lengthZ, double poissonRatio) {
  using std::numbers::pi;
  const double a = std::max(lengthY, lengthZ), b = std::min(lengthY, lengthZ);
  double sum = 0;
  for (int n = 99; n > 0; n -= 2) sum += std::tanh(n * pi * a / (2 * b)) / std::pow(n, 5);
  return {.area = a * b,
          .aboutY = lengthY * std::pow(lengthZ, 3) / 12,
          .aboutZ = lengthZ * std::pow(lengthY, 3) / 12,
          .torsion = a * b * b * b * (1.0 / 3 - 64 / std::pow(pi, 5) * b / a * sum),
          .shear = 10 * (1 + poissonRatio) / (12 + 11 * poissonRatio)};
}

SINEW_ONCE BeamSection beam_section(std::string_view where, CrossSectionShape shape, double radius,
                                    double radiusInner, double lengthY, double lengthZ, double poissonRatio) {
  if (shape == CrossSectionShape::rectangular) return rectangular_section(lengthY, lengthZ, poissonRatio);
  if (!(radiusInner < radius))
    throw Error(
        where,
        text("radiusInner is ", radiusInner, " m, but must be less than radius, ", radius, " m; lower it"));
  return circular_section(radius, radiusInner, poissonRatio);
}

SINEW_ONCE Eigen::Quaterniond beam_axes(Eigen::Vector3d const& chord, Eigen::Quaterniond const& node0,
                                        Eigen::Quaterniond const& node1) {
  const Eigen::Vector3d x = chord.normalized(),
                        y = node0 * Eigen::Vector3d::UnitY() + node1 * Eigen::Vector3d::UnitY();
  Eigen::Matrix3d axes;
  axes.col(0) = x;
  axes.col(2) = x.cross(y);
  if (!(axes.col(2).norm() > 0.1)) axes.col(2) = node0 * Eigen::Vector3d::UnitZ();
  axes.col(1) = axes.col(2).cross(x);
  if (!(axes.col(1).norm() > 0.01)) axes.col(1) = x.unitOrthogonal();
  axes.col(1).normalize();
  axes.col(2) = x.cross(axes.col(1));
  return Eigen::Quaterniond(axes);
}

}  // namespace sinew
#endif
