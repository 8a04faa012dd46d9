// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/io/write_vtu.hpp>

namespace sinew::io {

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

  std::size_t size() const { return count_; }
  std::string path() const { return stem_ + ".pvd"; }

 private:
  std::string stem_, name_{}, entries_{};
  std::size_t count_ = 0;
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
  std::string seconds, number = text(count_);
  append_number(seconds, time);
  number.insert(0, number.size() < 4 ? 4 - number.size() : 0, '0');

  write_vtu(text(stem_, '_', number, ".vtu"), mesh, data);
  std::string entries = text(entries_,
                             "    <DataSet timestep=\"",
                             seconds,
                             "\" part=\"0\" file=\"",
                             name_,
                             '_',
                             number,
                             ".vtu\"/>\n");
  write_file(path(),
             text("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n",
                  entries,
                  "  </Collection>\n</VTKFile>\n"));
  entries_ = std::move(entries);
  ++count_;
}

}  // namespace sinew::io
#endif
