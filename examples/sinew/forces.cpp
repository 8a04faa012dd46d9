// SPDX-License-Identifier: BSL-1.0
#include "forces.hpp"

#include "csv.hpp"

#include <sinew/io/output_file.hpp>

namespace cli {

namespace {

// "/liver" for the node /root/liver, as in records; "/" for the top
std::string below_top(std::string const& path) {
  if (path.empty()) return {};
  const std::size_t slash = path.find('/', 1);
  return slash == path.npos ? "/" : path.substr(slash);
}

}  // namespace

ForcesFile::ForcesFile(std::string path) : file_(std::move(path)) {
  file_.write("step,time,kind,body,other,index,x,y,z,nx,ny,nz,fx,fy,fz,tx,ty,tz\n");
}

void ForcesFile::add(sinew::StandardSimulation& simulation) {
  std::string lines, start = sinew::text(simulation.step(), ',');
  sinew::io::append_number(start, simulation.time());
  for (sinew::ForceOnBody const& f : simulation.forces()) {
    lines += sinew::text(start,
                         ',',
                         enum_names(f.kind)[std::size_t(f.kind)],
                         ',',
                         csv_field(below_top(f.body)),
                         ',',
                         csv_field(below_top(f.other)),
                         ',',
                         f.index);
    for (Eigen::Vector3d const& v : {f.point, f.normal, f.wrench.force, f.wrench.torque})
      for (const double value : v) {
        lines += ',';
        sinew::io::append_number(lines, value);
      }
    lines += '\n';
  }
  file_.write(lines);
}

}  // namespace cli
