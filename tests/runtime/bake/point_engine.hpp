// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/registry.hpp>

#include <fstream>
#include <vector>

namespace sinew {

/// Points from a file of numbers, three each.
struct PointFileLoader {
  using Role = role::Engine;
  static constexpr std::string_view className = "PointFileLoader";

  DataFile filename{};

  static constexpr auto fields() {
    return field_list(field("filename", &PointFileLoader::filename, "", "the file to read"));
  }

  // after update
  std::vector<Eigen::Vector3d> position{};

  static constexpr auto outputs() {
    return field_list(field("position", &PointFileLoader::position, "m", "points"));
  }

  void update(std::string_view where) {
    std::ifstream file(filename.path);
    if (!file) throw Error(where, "cannot read the file; correct filename");
    position.clear();
    for (Eigen::Vector3d p; file >> p[0] >> p[1] >> p[2];) position.push_back(p);
  }
};

/// The points above a height.
template <class D>
struct HighPoints {
  using Role = role::Engine;
  using DataTypes = D;
  static constexpr std::string_view className = "HighPoints";

  typename D::VecCoord position{};
  double above = 0;

  static constexpr auto fields() {
    return field_list(field("position", &HighPoints::position, "m", "points to choose from"),
                      field("above", &HighPoints::above, "m", "height of the lowest"));
  }

  // after update
  std::vector<int> indices{};

  static constexpr auto outputs() {
    return field_list(field("indices", &HighPoints::indices, "", "those above"));
  }

  void update(std::string_view) {
    indices.clear();
    for (std::size_t i = 0; i < position.size(); ++i)
      if (position[i][1] > above) indices.push_back(int(i));
  }
};

/// A small registry, that builds in seconds.
struct Tested
    : Registry<Gravity, EulerExplicitSolver, TetrahedronTopology, MechanicalObject<Vec3d>, UniformMass<Vec3d>,
               FixedConstraint<Vec3d>, StiffSpringForceField<Vec3d>, MechanicalObject<Vec3f>,
               FixedConstraint<Vec3f>, PointFileLoader, HighPoints<Vec3d>> {};

}  // namespace sinew
