// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/constraint/constrained_points.hpp>
#include <sinew/force/rotations.hpp>
#include <sinew/lagrangian/compliance_file.hpp>

#include <algorithm>
#include <bit>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// A body answers to multipliers as it does at rest, by a dense compliance C that is found once, with the
/// system of its solver at the rest positions and the length of the first step:
///   u = R C R' h J' f,   C = A^-1 at rest.
/// With `rotations` R turns with each point: with a rigid body, or with the neighbours that its elements join
/// it to (Mueller et al. 2005), the rotation nearest to sum_j (x_j - x_i) (x0_j - x0_i)'; else R = 1. C has
/// n^2 numbers, so that it is for bodies of some hundred points whose solver keeps no factor. Where a file is
/// named, C is read from it, or, as long as it is not there, written to it.
template <class D>
struct PrecomputedConstraintCorrection {
  using Role = role::ConstraintCorrection;
  using DataTypes = D;
  using Real = typename D::Real;
  static_assert(D::spatial == 3,
                "Sinew: this correction is of bodies in space; take Vec3d, Vec3f, Rigid3d or Rigid3f.");
  static constexpr std::string_view className = "PrecomputedConstraintCorrection";

  bool rotations = false, restDeformations = false, recompute = false;
  double regularizationTerm = 0;
  std::string fileCompliance{}, fileDir{};

  static constexpr auto fields() {
    using C = PrecomputedConstraintCorrection;
    return field_list(
        field("rotations", &C::rotations, "", "the compliance turns with the points"),
        field("restDeformations",
              &C::restDeformations,
              "",
              "of rigid bodies: it turns by their rotation since rest; else by their whole orientation")
            .also("restRotations"),
        field("recompute", &C::recompute, "", "the compliance is found anew though there is a file of it"),
        field("regularizationTerm",
              &C::regularizationTerm,
              "m/(N s)",
              "displacement for an impulse of 1 N s that is added to the compliance of each equation",
              range::nonNegative),
        field("fileCompliance", &C::fileCompliance, "", "file of the compliance, read or written")
            .also("filePrefix"),
        field("fileDir",
              &C::fileDir,
              "",
              "folder of that file; without a file name it has one by size and step"));
  }

  using Few = Eigen::Matrix<double, D::size, 1>;
  Eigen::MatrixXd compliance{};  // A^-1 at rest [1/kg]
  double dt = 0;                 // of the step of which it is; 0: of none so far
  std::string where{};
  std::vector<int> first{}, neighbours{};  // of each point
  std::vector<Eigen::Matrix3d> rotation{};
  typename D::VecCoord rest{};
  mutable Eigen::VectorXd room{};

  void init(InitContext<D> const& context) {
    where = place_of<PrecomputedConstraintCorrection>(context);
    const std::size_t n = context.rest.size();
    rest = context.rest;
    dt = 0;
    compliance.resize(Eigen::Index(n) * D::size, Eigen::Index(n) * D::size);
    room.setZero(compliance.rows());
    rotation.assign(n, Eigen::Matrix3d::Identity());
    first.assign(n + 1, 0);
    neighbours.clear();
    if constexpr (!D::rigid)
      if (rotations) joinNeighbours(context.topology, n);
  }

  /// Not where there is a file that has it.
  bool needsCompliance(double step) {
    if (dt == step) return false;
    const ComplianceFile file = fileOf(step);
    if (file.path.empty() || recompute || !file.exists()) return true;
    file.read(compliance, where);
    dt = step;
    return false;
  }
  void setColumn(int dof, typename D::VecDeriv const& u) {
    for (std::size_t i = 0; i < u.size(); ++i)
      compliance.col(dof).template segment<D::size>(Eigen::Index(i) * D::size) = u[i].template cast<double>();
  }
  void keepCompliance(double step) {
    if (!compliance.allFinite())
      throw Error(where, "the compliance is not finite: nothing holds the body, or the scene has diverged");
    compliance = (compliance + compliance.transpose()).eval() / 2;  // what rounding leaves
    if (const ComplianceFile file = fileOf(step); !file.path.empty()) file.write(compliance, where);
    dt = step;
  }

  void beginCorrections(typename D::VecCoord const& x) {
    if (!rotations) return;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if constexpr (D::rigid) {
        const auto q = restDeformations ? Quat<Real>(x[i].orientation * rest[i].orientation.conjugate())
                                        : Quat<Real>(x[i].orientation);
        rotation[i] = q.toRotationMatrix().template cast<double>();
      } else {
        Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
        for (int k = first[i]; k < first[i + 1]; ++k) {
          const auto j = std::size_t(neighbours[std::size_t(k)]);
          a +=
              (x[j] - x[i]).template cast<double>() * (rest[j] - rest[i]).transpose().template cast<double>();
        }
        // what a point alone leaves open does not turn
        rotation[i] =
            nearest_rotation(Eigen::Matrix3d(a + 1e-9 * (a.norm() + 1e-300) * Eigen::Matrix3d::Identity()));
      }
    }
  }
  void addCorrection(typename D::VecDeriv& u, typename D::VecDeriv const& f, typename D::VecCoord const&,
                     ConstraintFactors const& factors) const {
    room.setZero();
    for (std::size_t i = 0; i < f.size(); ++i) {
      if (f[i].isZero(0)) continue;
      const Few own = rotated(i, f[i].template cast<double>(), true);
      for (int c = 0; c < D::size; ++c)
        if (own[c] != 0) room += own[c] * compliance.col(Eigen::Index(i) * D::size + c);
    }
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i] += (factors.impulse *
               rotated(i, Few(room.template segment<D::size>(Eigen::Index(i) * D::size)), false))
                  .template cast<Real>();
  }

 private:
  Few rotated(std::size_t i, Few v, bool back) const {
    if (!rotations) return v;
    for (int part = 0; part < D::size; part += 3)
      v.template segment<3>(part) =
          back ? Eigen::Vector3d(rotation[i].transpose() * v.template segment<3>(part))
               : Eigen::Vector3d(rotation[i] * v.template segment<3>(part));
    return v;
  }
  ComplianceFile fileOf(double step) const {
    std::string name = fileCompliance;
    if (name.empty() && !fileDir.empty()) name = text("compliance-", compliance.rows(), "-", step, ".comp");
    return {name.empty() || fileDir.empty() ? name : text(fileDir, '/', name), step, fingerprint()};
  }
  // of the bits of the rest positions (FNV-1a)
  std::uint64_t fingerprint() const {
    std::uint64_t hash = 14695981039346656037u;
    for (auto const& x : rest)
      for (int k = 0; k < D::spatial; ++k) {
        hash ^= std::bit_cast<std::uint64_t>(double(D::center(x)[k]));
        hash *= 1099511628211u;
      }
    return hash;
  }
  void joinNeighbours(TopologyView const& topology, std::size_t n) {
    std::vector<std::vector<int>> near(n);
    auto join = [&](auto const& elements) {
      for (auto const& e : elements)
        for (const int i : e)
          for (const int j : e)
            if (i != j) near[std::size_t(i)].push_back(j);
    };
    for_each_kind(topology, [&](int, auto const& elements) { join(elements); });
    for (std::size_t i = 0; i < n; ++i) {
      std::sort(near[i].begin(), near[i].end());
      near[i].erase(std::unique(near[i].begin(), near[i].end()), near[i].end());
      neighbours.insert(neighbours.end(), near[i].begin(), near[i].end());
      first[i + 1] = int(neighbours.size());
    }
    if (neighbours.empty())
      throw Error(
          where,
          "rotations: no elements join the points, so that nothing says how they turn; put a topology "
          "into the node, or leave rotations out");
  }
};

}  // namespace sinew
