// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/force/hyperelastic_material.hpp>

#include <span>
#include <string>
#include <string_view>

namespace sinew {

/// What a hyperelastic body is told of directions.
struct MaterialDirections {
  HyperelasticMaterial material;
  bool definite;
  std::span<Eigen::Vector3d const> families, fibers, sheets;
};

/// Throws Error unless the material has such directions, their lists fit `count` elements, and none is zero.
void check_directions(std::string const& where, MaterialDirections const& given, std::size_t count,
                      std::string_view elements);

/// Axes f, s and n of an element, as columns: f = fiber/|fiber|, s = the part of the sheet that is square to
/// f. Throws Error where they are parallel.
Eigen::Matrix3d axes_of(std::string const& where, std::span<Eigen::Vector3d const> fibers,
                        std::span<Eigen::Vector3d const> sheets, std::size_t element);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>
#include <sinew/core/lists.hpp>

#include <Eigen/Geometry>

namespace sinew {

SINEW_ONCE void check_directions(std::string const& where, MaterialDirections const& given, std::size_t count,
                                 std::string_view elements) {
  const std::string_view name = enum_names(given.material)[std::size_t(given.material)];
  auto check = [&](std::string_view list, std::span<Eigen::Vector3d const> directions) {
    if (!directions.empty() && !has_directions(given.material))
      throw Error(where,
                  text(list,
                       " has directions, but ",
                       name,
                       " is the same in all directions; take Costa or HolzapfelGasserOgden, or remove them"));
    for (std::size_t i = 0; i < directions.size(); ++i)
      if (!(directions[i].squaredNorm() > 0))
        throw Error(where, text(list, " has no direction at [", i, "], 0 0 0; give another vector"));
  };
  check("AnisotropyDirections", given.families);
  check("fiberDirections", given.fibers);
  check("sheetDirections", given.sheets);
  if (given.material == HyperelasticMaterial::Costa && !given.families.empty())
    throw Error(where,
                "AnisotropyDirections are of the fibres of HolzapfelGasserOgden; give the axes of Costa by "
                "fiberDirections and sheetDirections");
  if (given.families.size() > 2)
    throw Error(where,
                text("AnisotropyDirections has ",
                     given.families.size(),
                     " directions, but ",
                     name,
                     " has one or two families of fibres; remove the others"));
  if (!given.sheets.empty() && given.fibers.empty())
    throw Error(
        where, "sheetDirections needs fiberDirections, to which its directions are turned square; give both");
  if (!given.fibers.empty())
    check_one_or_each(where, "fiberDirections", given.fibers.size(), count, elements, "one direction");
  if (!given.sheets.empty())
    check_one_or_each(where, "sheetDirections", given.sheets.size(), count, elements, "one direction");
  if (given.definite && has_directions(given.material))
    throw Error(where,
                text("matrixRegularization is not there for ",
                     name,
                     ", of which the tangent has no simple eigenvalues; set it to 0"));
}

SINEW_ONCE Eigen::Matrix3d axes_of(std::string const& where, std::span<Eigen::Vector3d const> fibers,
                                   std::span<Eigen::Vector3d const> sheets, std::size_t element) {
  if (fibers.empty()) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d f = one_or_each(fibers, element).normalized();
  const Eigen::Vector3d sheet =
      sheets.empty() ? f.unitOrthogonal() : one_or_each(sheets, element).normalized();
  const Eigen::Vector3d across = f.cross(sheet);
  // an angle of less than this is rounding of directions in a file
  if (!(across.norm() > 1e-6))
    throw Error(
        where,
        text("sheetDirections has at element ",
             element,
             " the direction of the fibres, which makes no plane with it; give one that is not parallel"));
  const Eigen::Vector3d n = across.normalized();
  Eigen::Matrix3d axes;
  axes << f, n.cross(f), n;
  return axes;
}

}  // namespace sinew
#endif
