// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/assembly.hpp>
#include <sinew/core/lists.hpp>
#include <sinew/force/beam_law.hpp>
#include <sinew/mass/beam_inertia.hpp>
#include <sinew/mass/lumped_mass.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <vector>

namespace sinew {

/// Mass of rods, of the beams that a BeamInterpolation or a WireBeamInterpolation gives: the consistent one
/// (Przemieniecki 1968; Friedman & Kosmatka 1993) with rotary inertia, in the axes that a beam has now; the
/// weight acts along its length. Frequencies of bending come out with errors of order (h / wavelength)^4.
///
/// M^-1 f, which explicit solvers ask for, is taken with half of the mass and of the rotary inertia of a beam
/// at each of its frames; EulerExplicitSolver solves M a = f where a linear solver stands by. (SOFA refuses.)
/// What the change of the axes adds to M a beyond the gyroscopic torques of the sections is left out, as in
/// SOFA; it is of order (bending rate) (rate of rotation).
template <class D>
struct AdaptiveBeamMass {
  static_assert(D::rigid && D::spatial == 3, "Sinew: AdaptiveBeamMass is for frames in space (Rigid3d).");
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "AdaptiveBeamMass";

  std::vector<RodBeam> interpolation{};
  std::vector<double> massDensity{1};
  bool shearStressComputation = true;

  static constexpr auto fields() {
    using F = AdaptiveBeamMass;
    return field_list(
        field("interpolation",
              &F::interpolation,
              "",
              "the beams, those of an interpolation: one for each edge of the topology, or from each frame "
              "to the "
              "next")
            .oneEach(Of::edges),
        field("massDensity",
              &F::massDensity,
              "kg/m^3",
              "of beams whose interpolation gives none: one for all, or one for each",
              range::positive)
            .oneEach(Of::edges),
        field("shearStressComputation",
              &F::shearStressComputation,
              "",
              "Timoshenko's beam, which yields to shear; Euler and Bernoulli's when not")
            .also("useShearStressComputation"));
  }

  using Law = BeamFEM<D>;
  struct Element {
    Edge ends;
    typename Law::Rest rest;
    BeamInertia<Real> inertia;
  };
  std::vector<Element> elements{};
  LumpedMass<D> lumped{};

  bool exactInverse() const { return false; }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<AdaptiveBeamMass>());
    const std::size_t frames = context.rest.size();
    const std::vector<Edge> edges = rod_edges(where, context.topology.edges, frames, interpolation);
    check_one_or_each(where, "massDensity", massDensity.size(), edges.size(), "beams");

    std::vector<double> masses(frames, 0.0);
    std::vector<Eigen::Matrix3d> inertias(frames, Eigen::Matrix3d::Zero());
    elements.clear();
    for (std::size_t b = 0; b < edges.size(); ++b) {
      RodBeam const& beam = interpolation[b];
      const double density = beam.massDensity > 0 ? beam.massDensity : one_or_each(massDensity, b);
      const BeamSection section = beam.section();
      elements.push_back({edges[b],
                          rest_of_rod<D>(beam, shearStressComputation),
                          BeamInertia<Real>::of(section,
                                                beam.youngModulus,
                                                beam.poissonRatio,
                                                density,
                                                beam.chord.norm(),
                                                beam.length,
                                                shearStressComputation)});
      const double half = density * beam.length / 2;
      const Eigen::Vector3d inertia(section.aboutY + section.aboutZ, section.aboutY, section.aboutZ);
      for (std::size_t k = 0; k < 2; ++k) {
        Real const(&q)[4] = elements.back().rest.toAxes[k];
        const Eigen::Matrix3d axes =
            Eigen::Quaterniond(double(q[0]), double(q[1]), double(q[2]), double(q[3])).toRotationMatrix();
        const std::size_t i = std::size_t(edges[b][k]);
        masses[i] += half * section.area;
        inertias[i] += half * axes * inertia.asDiagonal() * axes.transpose();
      }
    }
    std::vector<typename D::MassType> ofFrames;
    for (std::size_t i = 0; i < frames; ++i) {
      if (!(masses[i] > 0))
        throw Error(where,
                    text("frame ",
                         i,
                         " is the end of no beam and would have no mass; give the topology an edge to it, or "
                         "remove it"));
      ofFrames.push_back({Real(masses[i]), inertias[i].template cast<Real>()});
    }
    lumped.init(where, ofFrames);
  }

  /// f += M g and the gyroscopic torques of the sections.
  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    MechanicalParams still = p;
    still.gravity.setZero();
    lumped.addForce(still, f, x, v);
    if (p.gravity.isZero(0)) return;
    Deriv g = Deriv::Zero();
    g.template head<3>() = p.gravity.template cast<Real>();
    for (Element const& e : elements) {
      const Mat<Real, 3> axes = axesOf(e, x);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) f[at(e, i)] += multiply(e, axes, i, j, g);
    }
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    for (Element const& e : elements) {
      const Mat<Real, 3> axes = axesOf(e, x);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          f[at(e, i)] += Real(factor) * multiply(e, axes, i, j, dx[at(e, j)]);
    }
  }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const { lumped.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const {
    double sum = 0;
    for (Element const& e : elements) {
      const Mat<Real, 3> axes = axesOf(e, x);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          sum += 0.5 * double(v[at(e, i)].dot(multiply(e, axes, i, j, v[at(e, j)])));
    }
    return sum;
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) const {
    if constexpr (Sink::phase != AssemblyPhase::bind)
      for (Element const& e : elements) {
        const Mat<Real, 3> axes = axesOf(e, x);
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j) {
            Mat<Real, 6> block = e.inertia.block(i, j);
            for (int r = 0; r < 6; r += 3)
              for (int c = 0; c < 6; c += 3)
                block.template block<3, 3>(r, c) =
                    (Real(p.m) * axes * block.template block<3, 3>(r, c) * axes.transpose()).eval();
            sink.add(e.ends[std::size_t(i)], e.ends[std::size_t(j)], block);
          }
      }
  }

 private:
  static std::size_t at(Element const& e, std::size_t end) { return std::size_t(e.ends[end]); }
  static Mat<Real, 3> axesOf(Element const& e, VecCoord const& x) {
    const Coord ends[2]{x[at(e, 0)], x[at(e, 1)]};
    const UnitQuaternion<Real> q = Law::axesOf(e.rest, ends);
    return Quat<Real>(q.w, q.v[0], q.v[1], q.v[2]).toRotationMatrix();
  }
  // M_ij dx of two ends
  static Deriv multiply(Element const& e, Mat<Real, 3> const& axes, std::size_t i, std::size_t j,
                        Deriv const& dx) {
    Deriv own;
    own.template head<3>() = axes.transpose() * dx.template head<3>();
    own.template tail<3>() = axes.transpose() * dx.template tail<3>();
    own = (e.inertia.block(int(i), int(j)) * own).eval();
    Deriv r;
    r.template head<3>() = axes * own.template head<3>();
    r.template tail<3>() = axes * own.template tail<3>();
    return r;
  }
};

}  // namespace sinew
