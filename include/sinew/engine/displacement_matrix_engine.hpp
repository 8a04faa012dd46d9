// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>

#include <vector>

namespace sinew {

/// The transformation of each frame from where it was at rest to where it is, X S X0^-1, as a matrix of 4 by
/// 4 numbers, with sizes S along its axes.
struct DisplacementMatrixEngine {
  using Role = role::Engine;
  static constexpr std::string_view className = "DisplacementMatrixEngine",
                                    aliases = "DisplacementTransformEngine";

  Rigid3d::VecCoord x0{}, x{};
  std::vector<Eigen::Vector3d> scales{};

  static constexpr auto fields() {
    using E = DisplacementMatrixEngine;
    return field_list(field("x0", &E::x0, "m", "frames at rest"),
                      field("x", &E::x, "m", "frames as they are"),
                      field("scales", &E::scales, "", "sizes along the axes of each frame; none for 1 1 1"));
  }

  std::vector<Eigen::Matrix4d> displacements{};  // after update

  static constexpr auto outputs() {
    return field_list(field("displacements",
                            &DisplacementMatrixEngine::displacements,
                            "",
                            "the matrix of each frame, row by row")
                          .also("displaceMats"));
  }

  /// Throws Error unless there are as many frames at rest, and sizes or none; the output then stays.
  void update(std::string_view where);
};

}  // namespace sinew

#if SINEW_DEFINES
namespace sinew {

SINEW_ONCE void DisplacementMatrixEngine::update(std::string_view where) {
  check_fields(*this, where);
  if (x.size() != x0.size() || (!scales.empty() && scales.size() != x.size()))
    throw Error(text(where, ": ", className),
                text("x has ",
                     x.size(),
                     " frames, x0 ",
                     x0.size(),
                     " and scales ",
                     scales.size(),
                     "; give as many, and sizes for all or none"));
  auto transform = [](RigidCoord3<double> const& frame) {
    Eigen::Isometry3d t(Eigen::Quaterniond(frame.orientation).normalized());
    t.pretranslate(frame.center);
    return t;
  };
  displacements.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    Eigen::Affine3d t(transform(x[i]));
    if (!scales.empty()) t.scale(scales[i]);
    displacements[i] = (t * transform(x0[i]).inverse()).matrix();
  }
}

}  // namespace sinew
#endif
