// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::io {

struct Spheres {
  std::vector<Eigen::Vector3d> centers{};
  std::vector<double> radii{};
};

/// The spheres in `content`, the text of an .sph file; `path` is for messages. See read_sph().
Spheres parse_sph(std::string_view path, std::string_view content);

/// Reads SOFA's text format of spheres: "sph 1.0", then a line "sphe number x y z radius" for each, and
/// comments
/// (#). Throws Error with the line on anything else, numbers that are not finite, a radius that is not
/// positive.
Spheres read_sph(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

namespace sinew::io {

SINEW_ONCE Spheres parse_sph(std::string_view path, std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  if (in.word() != "sph") throw in.expected("sph, with which a file of spheres begins");
  Spheres spheres;
  for (in.restOfLine(); in.more(); in.restOfLine()) {
    const std::string_view key = in.word();
    if (key == "nums" || key.starts_with('#')) continue;  // their number is seen
    if (key != "sphe") throw in.expected("sphe, nums or a comment (#)");
    in.integer("the number of the sphere");
    const Eigen::Vector3d center = in.point();
    const double radius = in.real("a radius");
    if (!(radius > 0))
      throw in.error(text("the radius is ", radius, ", but must be greater than 0; correct it"));
    spheres.centers.push_back(center);
    spheres.radii.push_back(radius);
  }
  if (spheres.centers.empty())
    throw in.error("there are no spheres (lines \"sphe number x y z radius\"); add some");
  return spheres;
}

SINEW_ONCE Spheres read_sph(std::string const& path) { return parse_sph(path, read_file(path)); }

}  // namespace sinew::io
#endif
