// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/mesh.hpp>
#include <sinew/force/stiff_spring.hpp>

#include <string>
#include <vector>

namespace examples {

/// A retina that scar tissue has pulled out of its shape, after figure 2 of Faure et al. (2007): the retina
/// is a hemisphere of springs, held at its rim and around the optic nerve; a ring of scar tissue inside it,
/// which has shrunk, pulls it inwards by short springs that a blade can cut. Lengths are in metres, the optic
/// nerve is at -z, the rim at z = 0.
struct EyeOptions {
  int sectors = 48;           // points around the retina; a third as many from the nerve to the rim
  double radius = 0.012;      // of the retina
  double nerve = 0.15;        // angle from the axis to the first row of points
  double gap = 0.0006;        // between retina and scar
  double stiffness = 5;       // of retina springs [N/m]
  double scarStiffness = 10;  // of springs in the scar
  double cuttableStiffness = 10;
  double shrinkage = 0.04;  // how much smaller than its place the ring of scar would be
  double density = 10;      // of the membranes [kg/m^2], with the vitreous that moves with them
};

/// The membranes: points of the retina row by row from the nerve to the rim, then the two rows of the scar.
struct Eye {
  std::vector<Eigen::Vector3d> position{};
  int retinaPoints = 0, sectors = 0;
  std::vector<sinew::Quad> quads{};  // of retina and scar
  sinew::Mesh retina{}, scar{};      // the same as surfaces of their own
  std::vector<sinew::Spring> springs{}, cuttable{};
  std::vector<int> fixed{};
  double density = 0;
  // the blade cuts what is nearer to a point of the membranes than both together
  double sphereRadius = 0.0003, contactDistance = 0.0003;

  // the tool, in its own axes: x outwards, y along the cut, z up the handle, from the middle of the blade
  sinew::Mesh handle{}, tip{}, blade{};
  std::vector<double> times{};  // its movement [s]
  std::vector<sinew::RigidCoord3<double>> places{};
  double cutBegins = 0, cutEnds = 0;  // the times between which it goes round
};
Eye make_eye(EyeOptions const& options);

/// What the surgeon wants to know of the retina at these positions of all points.
struct RetinaState {
  double tension = 0;           // sum of |F| over the springs of the retina [N]
  double energy = 0;            // in them [J]
  double traction = 0;          // with which the cuttable springs that are left pull, sum of |F| [N]
  double rms = 0, maximum = 0;  // distance from the natural shape [m]
};
RetinaState examine(Eye const& eye, std::vector<Eigen::Vector3d> const& now,
                    std::vector<sinew::Spring> const& uncut);

/// Writes what vitrectomy.scn reads into a folder: springs.xml, membranes.obj, retina.obj, scar.obj,
/// handle.obj, tip.obj, blade.obj, tool.txt. Throws sinew::Error.
void write_scene_data(Eye const& eye, std::string const& folder);

}  // namespace examples
