// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/data_types.hpp>

#include <string>
#include <string_view>

namespace sinew::io {

/// The mass in `content`, the text of a .rigid file; `path` is for messages. See read_rigid().
RigidMass<double, 3> parse_rigid(std::string_view path, std::string_view content);

/// Reads the mass of a rigid body from SOFA's text format: "Xsp 3.0", then the mass [kg] (mass; 1 where it is
/// not given) and the nine entries, row by row, of the inertia about the centre divided by the mass [m^2]
/// (inrt; the identity where it is not given). Volume, centre, frame, gravity and others are not used, as in
/// SOFA. Throws Error with the line on anything else, and on numbers or an inertia that are not finite.
RigidMass<double, 3> read_rigid(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

namespace sinew::io {

SINEW_ONCE RigidMass<double, 3> parse_rigid(std::string_view path, std::string_view content) {
  TextReader in(path, content);
  in.rejectBinary();
  if (in.word() != "Xsp") throw in.expected("Xsp, with which a file of a rigid mass begins");
  RigidMass<double, 3> body;
  Eigen::Matrix3d perMass = Eigen::Matrix3d::Identity();
  for (in.restOfLine(); in.more(); in.restOfLine()) {
    const std::string_view key = in.word();
    if (key == "mass" || key == "vertexMass") {
      body.mass = in.real("a mass");
      if (!(body.mass > 0))
        throw in.error(text("the mass is ", body.mass, " kg, but must be greater than 0; correct it"));
    } else if (key == "inrt") {
      for (int i = 0; i < 9; ++i) perMass(i / 3, i % 3) = in.real("an entry of the inertia");
    } else if (key == "cntr" || key == "center") {
      in.point();
    } else if (key != "volm" && key != "frme" && key != "grav" && key != "visc" && key != "stck" &&
               key != "step" && key != "prec" && !key.starts_with('#')) {
      throw in.expected("mass, inrt, cntr, volm or another keyword of files of rigid masses");
    }
  }
  body.inertia = body.mass * perMass;
  if (!body.inertia.allFinite())
    throw in.error(text("the mass of ",
                        body.mass,
                        " kg times the inertia is beyond the largest number; correct mass or inrt"));
  return body;
}

SINEW_ONCE RigidMass<double, 3> read_rigid(std::string const& path) {
  return parse_rigid(path, read_file(path));
}

}  // namespace sinew::io
#endif
