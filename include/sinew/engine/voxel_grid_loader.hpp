// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <array>
#include <vector>

namespace sinew {

/// Reads voxels, a byte each and x fastest, from a file without a header (.raw), and makes a hexahedron, or a
/// point, of each that is of the body: whose value is among the active ones, or where none are given, not one
/// of the background. Without either all are.
struct VoxelGridLoader {
  using Role = role::Engine;
  static constexpr std::string_view className = "VoxelGridLoader";

  DataFile filename{};
  Eigen::Vector3d voxelSize{1, 1, 1};
  std::array<int, 3> resolution{0, 0, 0};
  std::array<int, 6> roi{0, 0, 0, 65535, 65535, 65535};
  int headerSize = 0;
  std::vector<int> bgValue{}, dataValue{};
  bool generateHexa = true;

  static constexpr auto fields() {
    using L = VoxelGridLoader;
    return field_list(
        field("filename", &L::filename, "", "the file to read").also("segmentationFile"),
        field("voxelSize", &L::voxelSize, "m", "sides of a voxel", range::positive),
        field("resolution", &L::resolution, "", "voxels along x, y and z", range::nonNegative),
        field("ROI",
              &L::roi,
              "",
              "the first and the last voxel along x, y and z: xmin ymin zmin xmax ymax zmax",
              range::nonNegative),
        field("header", &L::headerSize, "", "bytes before the voxels", range::nonNegative),
        field("bgValue", &L::bgValue, "", "values of the background", range::closed(0, 255)),
        field("dataValue", &L::dataValue, "", "values of the body", range::closed(0, 255)),
        field("generateHexa", &L::generateHexa, "", "whether voxels become hexahedra, and not points"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};
  std::vector<Hexahedron> hexahedra{};
  std::vector<int> idxInRegularGrid{};

  static constexpr auto outputs() {
    using L = VoxelGridLoader;
    return field_list(field("position", &L::position, "m", "points").also("points"),
                      field("hexahedra", &L::hexahedra, "", "one of each voxel of the body").also("hexas"),
                      field("idxInRegularGrid", &L::idxInRegularGrid, "", "the voxel of each"));
  }

  /// Throws Error where there is no resolution, or the file is too short for it; the outputs then stay.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <algorithm>

namespace sinew {

SINEW_ONCE void VoxelGridLoader::update(std::string_view where) {
  check_fields(*this, where);
  const std::string at = text(where, ": ", className);
  if (filename.path.empty()) throw Error(at, "filename is empty; name the file to read");
  const int nx = resolution[0], ny = resolution[1], nz = resolution[2];
  const double voxels = double(nx) * ny * nz;
  if (!(voxels > 0)) throw Error(at, "resolution has a 0; give the voxels along x, y and z");
  std::string content;
  try {
    content = io::read_file(filename.path);
  } catch (Error const& error) {
    throw Error(at, error.what());
  }
  if (voxels + headerSize > double(content.size()))
    throw Error(at,
                text(filename.path,
                     " has ",
                     content.size(),
                     " bytes, too few for ",
                     voxels,
                     " voxels; correct resolution, or get a complete file"));
  const auto inside = [](std::vector<int> const& list, int value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  };
  auto active = [&](int voxel) {
    const int value = static_cast<unsigned char>(content[std::size_t(headerSize) + std::size_t(voxel)]);
    return dataValue.empty() ? !inside(bgValue, value) : inside(dataValue, value);
  };
  position.clear(), hexahedra.clear(), idxInRegularGrid.clear();
  const int x1 = std::min(roi[3], nx - 1), y1 = std::min(roi[4], ny - 1), z1 = std::min(roi[5], nz - 1);
  auto each = [&](int more, auto const& f) {
    for (int k = roi[2]; k <= z1 + more; ++k)
      for (int j = roi[1]; j <= y1 + more; ++j)
        for (int i = roi[0]; i <= x1 + more; ++i) f(i, j, k);
  };
  auto voxel = [&](int i, int j, int k) { return i + nx * (j + ny * k); };
  auto point = [&](int i, int j, int k) { return std::size_t(i + (nx + 1) * (j + (ny + 1) * k)); };
  if (!generateHexa)
    return each(0, [&](int i, int j, int k) {
      if (!active(voxel(i, j, k))) return;
      position.push_back(voxelSize.cwiseProduct(Eigen::Vector3d(i, j, k)));
      idxInRegularGrid.push_back(voxel(i, j, k));
    });
  std::vector<Index> number(point(nx, ny, nz) + 1, -1);  // 0 where a voxel has the point
  auto corners = [&](int i, int j, int k) {
    return std::array{point(i, j, k),
                      point(i + 1, j, k),
                      point(i + 1, j + 1, k),
                      point(i, j + 1, k),
                      point(i, j, k + 1),
                      point(i + 1, j, k + 1),
                      point(i + 1, j + 1, k + 1),
                      point(i, j + 1, k + 1)};
  };
  each(0, [&](int i, int j, int k) {
    if (active(voxel(i, j, k)))
      for (const std::size_t p : corners(i, j, k)) number[p] = 0;
  });
  each(1, [&](int i, int j, int k) {
    if (number[point(i, j, k)] < 0) return;
    number[point(i, j, k)] = Index(position.size());
    position.push_back(voxelSize.cwiseProduct(Eigen::Vector3d(i, j, k)));
  });
  each(0, [&](int i, int j, int k) {
    if (!active(voxel(i, j, k))) return;
    const auto of = corners(i, j, k);
    std::transform(
        of.begin(), of.end(), hexahedra.emplace_back().begin(), [&](std::size_t p) { return number[p]; });
    idxInRegularGrid.push_back(voxel(i, j, k));
  });
}

}  // namespace sinew
#endif
