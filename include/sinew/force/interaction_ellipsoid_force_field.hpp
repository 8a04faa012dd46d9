// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/ellipsoid_penalty.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sinew {

/// Ellipsoids in the axes of a rigid body, which push points out of them as EllipsoidForceField does; with a
/// negative stiffness, in. Of several the one acts of which a point is deepest inside, sqrt(sum_c
/// d_c^2/r_c^2) being least. `frames` are places of rigid bodies, in a scene file those of the state that
/// `object2` names, which moves by itself; `object2_dof_index` chooses the body. Only the points are pushed:
/// what is left out is the force on the body, so that momentum is not conserved, and the stiffness of its
/// motion. It is the body of a hand, of a machine or of what is heavy. SOFA has a force on its centre without
/// a torque, where object2_forces=1; here that is an error. Damping is of the velocity of points in the
/// world.
template <class D>
struct InteractionEllipsoidForceField {
  static_assert(!D::rigid && D::size == 3, "Sinew: InteractionEllipsoidForceField is for points in space.");
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using Frame = Rigid3d::Coord;
  using Law = EllipsoidPenalty<D>;
  static constexpr std::string_view className = "InteractionEllipsoidForceField";
  static constexpr std::string_view followsObject2 = "frames";

  std::vector<Eigen::Vector3d> center{Eigen::Vector3d(0, 0, 0)}, vradius{Eigen::Vector3d(1, 1, 1)};
  double stiffness = 500, damping = 5;
  std::vector<Frame> frames{Frame{}};
  int bodyIndex = 0;
  bool bodyInverted = false, forcesOnBody = false;

  static constexpr auto fields() {
    using F = InteractionEllipsoidForceField;
    return field_list(
        field("center", &F::center, "m", "centre of each ellipsoid, in the axes of the body"),
        field("vradius",
              &F::vradius,
              "m",
              "radii of each along these axes; of fewer than centres the last is that of the others",
              range::positive),
        field("stiffness", &F::stiffness, "N", "force in the centre; negative: on points outside, inwards"),
        field("damping",
              &F::damping,
              "N s/m",
              "force per speed, times how far the point is from the surface in parts of the radius",
              range::nonNegative),
        field("frames", &F::frames, "m", "places of rigid bodies").whileRunning(),
        field("object2_dof_index", &F::bodyIndex, "", "the body among these", range::nonNegative),
        field(
            "object2_invert", &F::bodyInverted, "", "the place of the body is that of the world in its axes"),
        field("object2_forces", &F::forcesOnBody, "", "forces act on the body, too, which is not simulated"));
  }

  ForceProperties properties() const {
    const bool spheres =
        std::all_of(vradius.begin(), vradius.end(), [](auto const& r) { return (r.array() == r[0]).all(); });
    return {.internal = false, .objective = false, .conservative = spheres, .exactTangent = spheres};
  }

  struct Touched {
    Mat<Real, 3> slope;  // df/dx in the axes of the world; zero where nothing touches
    Real damping;
  };
  std::vector<Touched> touched{};  // of each point, at the last addForce
  std::vector<Law> laws{};         // of each ellipsoid

  void init(InitContext<D> const& context) {
    takeValues(context.where, context.rest.size());
    touched.assign(context.rest.size(), {Mat<Real, 3>::Zero(), Real(0)});
    laws.clear();
    for (std::size_t e = 0; e < std::max(center.size(), vradius.size()); ++e) {
      Law law;
      auto const& at = center[std::min(e, center.size() - 1)];
      auto const& radius = vradius[std::min(e, vradius.size() - 1)];
      law.center = at.template cast<Real>();
      law.inverse = radius.array().square().inverse().matrix().template cast<Real>();
      law.stiffness = Real(std::abs(stiffness));
      law.damping = Real(damping);
      law.outside = stiffness < 0;
      laws.push_back(law);
    }
  }
  void takeValues(std::string_view where, std::size_t) const {
    const std::string name = text(where, ": ", component_name<InteractionEllipsoidForceField>());
    if (forcesOnBody)
      throw Error(
          name,
          "object2_forces is 1, but forces on the body of the ellipsoids are not simulated: it moves by "
          "itself; set it to 0, or let points and body touch by collision models");
    if (center.empty() || vradius.empty())
      throw Error(name, "there is no ellipsoid; give a center and a vradius");
    if (std::size_t(bodyIndex) >= frames.size())
      throw Error(name,
                  text("object2_dof_index is ",
                       bodyIndex,
                       ", but there are ",
                       frames.size(),
                       " bodies, numbered from 0; correct it"));
  }
  void followPoints(Renumbering const&, std::size_t points) {
    touched.resize(points, {Mat<Real, 3>::Zero(), Real(0)});
  }

  void addForce(MechanicalParams const&, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    const Body body = place();
    for (std::size_t i = 0; i < x.size(); ++i) {
      const typename D::Coord local[1]{body.into(x[i])};
      const typename D::Deriv rate[1]{body.rotation.transpose() * v[i]};
      typename D::Deriv force[1];
      typename Law::Tangent tangent;
      lawOf(local[0]).force({Real(1)}, local, rate, force, tangent);
      f[i] += body.rotation * force[0];
      touched[i] = {body.rotation * tangent.slope * body.rotation.transpose(), tangent.damping};
    }
  }
  void addDForce(MechanicalParams const& p, VecDeriv& df, VecDeriv const& dx) const {
    for (std::size_t i = 0; i < dx.size(); ++i) df[i] += block(p, i) * dx[i];
  }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, Sink const& sink) const {
    for (std::size_t i = 0; i < touched.size(); ++i) sink.add(int(i), int(i), block(p, i));
  }
  double potentialEnergy(VecCoord const& x) const {
    const Body body = place();
    double energy = 0;
    for (auto const& point : x) {
      const typename D::Coord local[1]{body.into(point)};
      energy += double(lawOf(local[0]).energy({Real(1)}, local));
    }
    return energy;
  }

 private:
  struct Body {
    Mat<Real, 3> rotation;
    Vec<Real, 3> center;
    typename D::Coord into(typename D::Coord const& x) const { return rotation.transpose() * (x - center); }
  };
  Body place() const {
    Frame const& frame = frames[std::size_t(bodyIndex)];
    Eigen::Matrix3d rotation = frame.orientation.normalized().toRotationMatrix();
    Eigen::Vector3d at = frame.center;
    if (bodyInverted) {
      rotation.transposeInPlace();
      at = -(rotation * frame.center);
    }
    return {rotation.template cast<Real>(), at.template cast<Real>()};
  }
  // that of the ellipsoid in which a point is deepest
  Law const& lawOf(typename D::Coord const& local) const {
    std::size_t best = 0;
    Real least(0);
    for (std::size_t e = 0; e < laws.size(); ++e) {
      const Vec<Real, 3> d = local - laws[e].center;
      const Real square = d.cwiseProduct(d).dot(laws[e].inverse);
      if (e == 0 || square < least) best = e, least = square;
    }
    return laws[best];
  }
  Mat<Real, 3> block(MechanicalParams const& p, std::size_t i) const {
    return Real(p.k) * touched[i].slope - Real(p.b) * touched[i].damping * Mat<Real, 3>::Identity();
  }
};

}  // namespace sinew
