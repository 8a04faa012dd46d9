// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/io/write_vtu.hpp>

namespace sinew::io {

/// Which piece of a mesh a process has, of how many. `vertices`: no piece has elements, and points are to be
/// seen.
struct VtuPiece {
  int number = 0, count = 1;
  bool vertices = true;
};

/// A simulation over time for ParaView: "out/liver" writes out/liver_0000.vtu, out/liver_0001.vtu... and
/// out/liver.pvd, which lists them with their times [s] and is complete after each call of add().
class PvdSeries {
 public:
  /// `stem` is the path of the .pvd file, with or without that ending; its folder is created where it is
  /// missing. Throws Error if it cannot be, or if the stem names no file.
  explicit PvdSeries(std::string stem);

  /// Writes one more state. Throws Error as write_vtu() does, or if the time is not finite; the series is
  /// then as before.
  void add(double time, Mesh const& mesh, PointData const& data = {});

  /// The same of a mesh that several processes have pieces of, numbered from 0, each of which writes its own:
  /// out/liver_0000_3.vtu, and the first one out/liver_0000.pvtu, which names them all. Arrays of data have
  /// the same names in all pieces.
  void addPiece(double time, Mesh const& mesh, PointData const& data, VtuPiece const& piece);

  std::size_t size() const { return count_; }
  std::string path() const { return stem_ + ".pvd"; }

 private:
  std::string stem_, name_{}, entries_{};
  std::size_t count_ = 0;

  std::string number() const;
  void list(double time, std::string const& file);
};

}  // namespace sinew::io

#if SINEW_DEFINES
#include <cmath>

namespace sinew::io {

SINEW_ONCE PvdSeries::PvdSeries(std::string stem) : stem_(std::move(stem)) {
  if (stem_.ends_with(".pvd")) stem_.resize(stem_.size() - 4);
  const std::size_t slash = stem_.rfind('/');
  name_ = slash == std::string::npos ? stem_ : stem_.substr(slash + 1);
  if (name_.empty()) throw Error(stem_, "names no file for a time series; give a name such as \"out/liver\"");
  name_ = xml_escaped(stem_, name_);
  if (slash != std::string::npos && slash > 0) make_folders(stem_.substr(0, slash));
}

SINEW_ONCE void PvdSeries::add(double time, Mesh const& mesh, PointData const& data) {
  if (!std::isfinite(time))
    throw Error(path(), text("the time ", time, " is not a finite number; correct it"));
  const std::string end = text('_', number(), ".vtu");
  write_vtu(stem_ + end, mesh, data);
  list(time, name_ + end);
}

SINEW_ONCE void PvdSeries::addPiece(double time, Mesh const& mesh, PointData const& data,
                                    VtuPiece const& piece) {
  if (!std::isfinite(time))
    throw Error(path(), text("the time ", time, " is not a finite number; correct it"));
  const std::string end = text('_', number());
  write_vtu(text(stem_, end, '_', piece.number, ".vtu"), mesh, data, piece.vertices);
  if (piece.number > 0) {
    ++count_;
    return;
  }
  auto array = [&](std::string_view name, int components) {
    return text("      <PDataArray type=\"Float64\" Name=\"",
                xml_escaped(path(), name),
                "\" NumberOfComponents=\"",
                components,
                "\"/>\n");
  };
  std::string whole =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" header_type=\"UInt64\">\n"
      "  <PUnstructuredGrid GhostLevel=\"0\">\n    <PPoints>\n";
  whole += array("Points", 3) + "    </PPoints>\n    <PPointData>\n";
  for (PointArray const& a : data) whole += array(a.name, a.components);
  whole += "    </PPointData>\n";
  for (int i = 0; i < piece.count; ++i)
    whole += text("    <Piece Source=\"", name_, end, '_', i, ".vtu\"/>\n");
  write_file(text(stem_, end, ".pvtu"), whole + "  </PUnstructuredGrid>\n</VTKFile>\n");
  list(time, text(name_, end, ".pvtu"));
}

SINEW_ONCE std::string PvdSeries::number() const {
  std::string digits = text(count_);
  return digits.insert(0, digits.size() < 4 ? 4 - digits.size() : 0, '0');
}

SINEW_ONCE void PvdSeries::list(double time, std::string const& file) {
  std::string seconds;
  append_number(seconds, time);
  std::string entries =
      text(entries_, "    <DataSet timestep=\"", seconds, "\" part=\"0\" file=\"", file, "\"/>\n");
  write_file(path(),
             text("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
                  entries,
                  "  </Collection>\n</VTKFile>\n"));
  entries_ = std::move(entries);
  ++count_;
}

}  // namespace sinew::io
#endif
