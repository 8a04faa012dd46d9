// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/force/corotation.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/topology/beam_section.hpp>
#include <sinew/topology/rod_beams.hpp>

#include <limits>

namespace sinew {

/// Beam of two frames, corotational (Crisfield 1990). The axes of the element are the mean of those of its
/// ends, rotated along the shortest arc until the first lies along the chord, of length l. Against them the
/// ends are rotated by the rotation vectors a, b (both are zero at rest, where l = L), and
///   E = EA/2L (l - L)^2 + GJ/2L (b_x - a_x)^2 + B_y(a_y, b_y) + B_z(a_z, b_z)                    [J]
///   B(a, b) = EI / (2L (1 + p)) ((4 + p)(a^2 + b^2) + 2 (2 - p) a b),   p = 12 EI / (k G A L^2)
/// as in Timoshenko's beam (Przemieniecki 1968); p is 0 in that of Euler and Bernoulli. Forces are the exact
/// slope of E, the tangent is the symmetric part of their exact derivative.
template <class D>
struct BeamFEM {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 2;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real toAxes[2][4];          // from the axes of a node to those of the element: w, x, y, z
    Real length;                // L [m]
    Real axial, torsion;        // EA/L [N/m], GJ/L [N m]
    Real bending[2], cross[2];  // EI/L (4 + p)/(1 + p), EI/L (2 - p)/(1 + p) about y, z [N m]
  };
  using Tangent = FrameState<Real, 2>;

  Real energy(Rest const& rest, Coord const (&x)[2]) const {
    Tangent state;
    state.take(x);
    const Local<Real> local(rest, state.template frames<Real>());
    const Real stretch = local.length - rest.length;
    return Real(0.5) * (rest.axial * stretch * stretch + dot3(local.moment[0], local.end[0].vector) +
                        dot3(local.moment[1], local.end[1].vector));
  }

  void force(Rest const& rest, Coord const (&x)[2], Deriv const (&)[2], Deriv (&f)[2],
             Tangent& tangent) const {
    tangent.take(x);
    const FrameForces<Real, 2> all = forces(rest, tangent.template frames<Real>());
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 3; ++c) f[i][c] = all.force[i][c], f[i][c + 3] = all.torque[i][c];
  }

  void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[2], Deriv (&df)[2], Real k,
              Real /*b*/) const {
    frame_dforce(tangent, dx, df, k, [&](auto const& frames) { return forces(rest, frames); });
  }

  Mat<Real, 6> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    return frame_block(tangent, i, j, k, [&](auto const& frames) { return forces(rest, frames); });
  }

  /// The axes of the element, its first along the chord of the frames.
  static UnitQuaternion<Real> axesOf(Rest const& rest, Coord const (&x)[2]) {
    Tangent state;
    state.take(x);
    return Local<Real>(rest, state.template frames<Real>()).axes;
  }

  /// Rest data of the element between frames at rest, of a material E, nu. Without `shear` p is 0.
  static Rest restOf(Coord const (&x)[2], BeamSection const& section, double E, double nu, bool shear) {
    Rest rest;
    const Eigen::Vector3d chord = (x[1].center - x[0].center).template cast<double>();
    const double L = chord.norm(), G = shear_modulus(E, nu);
    Eigen::Quaterniond node[2];
    for (int i = 0; i < 2; ++i) node[i] = x[i].orientation.template cast<double>();
    const Eigen::Quaterniond axes = beam_axes(chord, node[0], node[1]);
    for (int i = 0; i < 2; ++i) store(node[i].conjugate() * axes, rest.toAxes[i]);
    rest.length = Real(L);
    rest.axial = Real(E * section.area / L);
    rest.torsion = Real(G * section.torsion / L);
    for (int c = 0; c < 2; ++c) {
      const double EI = E * (c == 0 ? section.aboutY : section.aboutZ);
      const double p = shear ? 12 * EI / (section.shear * G * section.area * L * L) : 0;
      rest.bending[c] = Real(EI / L * (4 + p) / (1 + p));
      rest.cross[c] = Real(EI / L * (2 - p) / (1 + p));
    }
    return rest;
  }

 private:
  /// The axes of the element, its deformation in them, and dE by that: moments about the rotation vectors.
  template <class S>
  struct Local {
    S length;
    UnitQuaternion<S> axes;
    LocalRotation<S> end[2];
    Vec<S, 3> moment[2];

    SINEW_HD Local(Rest const& rest, Frames<S, 2> const& frames) {
      using std::sqrt, sinew::sqrt;
      const S tiny(std::numeric_limits<lane_scalar<Real>>::min());
      UnitQuaternion<S> node[2];
      for (int i = 0; i < 2; ++i) node[i] = frames.orientation[i] * unit_quaternion<S>(rest.toAxes[i]);
      // of the quaternions q and -q, which are one rotation, that on the side of the other end
      const S together = node[0].w * node[1].w + dot3(node[0].v, node[1].v);
      const S side = select(value_of(together) < Real(0), S(-1), S(1));
      UnitQuaternion<S> mean{node[0].w + side * node[1].w, node[0].v + side * node[1].v};
      const S inverse = S(1) / sqrt(mean.w * mean.w + dot3(mean.v, mean.v) + tiny);
      mean.w = mean.w * inverse;
      mean.v = inverse * mean.v;

      length = sqrt(dot3(frames.place[1], frames.place[1]) + tiny);
      const Vec<S, 3> e = (S(1) / length) * mean.inverse()(frames.place[1]);
      const S n = S(1) + e[0], half = S(1) / sqrt(n + n + tiny);
      axes = mean * UnitQuaternion<S>{n * half, Vec<S, 3>(S(0), -e[2] * half, e[1] * half)};

      for (int i = 0; i < 2; ++i) end[i] = LocalRotation<S>(axes.inverse() * node[i]);
      const S twist = S(rest.torsion) * (end[1].vector[0] - end[0].vector[0]);
      moment[0][0] = -twist, moment[1][0] = twist;
      for (int i = 0; i < 2; ++i)
        for (int c = 1; c < 3; ++c)
          moment[i][c] =
              S(rest.bending[c - 1]) * end[i].vector[c] + S(rest.cross[c - 1]) * end[1 - i].vector[c];
    }
  };

  // Minus the slope of E. By their construction the axes have v_0x + v_1x = 0 for the vector parts v of the
  // quaternions of the ends against them, which gives how they rotate about the chord:
  //   w_x = (sum a_i.w_i - A_y w_y - A_z w_z) / A_x,   a_i = (q_w, v_z, -v_y),   A = a_0 + a_1,
  // while w_y, w_z are those of the chord.
  template <class S>
  SINEW_HD static FrameForces<S, 2> forces(Rest const& rest, Frames<S, 2> const& frames) {
    const Local<S> local(rest, frames);
    Vec<S, 3> torque[2], a[2];
    for (int i = 0; i < 2; ++i) {
      torque[i] = local.end[i].torque(local.moment[i]);
      UnitQuaternion<S> const& q = local.end[i].orientation;
      a[i] = Vec<S, 3>(q.w, q.v[2], -q.v[1]);
    }
    const Vec<S, 3> sum = torque[0] + torque[1], A = a[0] + a[1];
    const S about = sum[0] / A[0], inverse = S(1) / local.length;
    const Vec<S, 3> pull(S(rest.axial) * (local.length - S(rest.length)),
                         (A[2] * about - sum[2]) * inverse,
                         (sum[1] - A[1] * about) * inverse);
    FrameForces<S, 2> f;
    f.force[0] = local.axes(pull);
    f.force[1] = -f.force[0];
    for (int i = 0; i < 2; ++i) f.torque[i] = local.axes(Vec<S, 3>(about * a[i] - torque[i]));
    return f;
  }
};

/// Rest data of a beam of a rod.
template <class D>
typename BeamFEM<D>::Rest rest_of_rod(RodBeam const& beam, bool shear) {
  using Real = typename D::Real;
  typename D::Coord x[2]{D::zero(), D::zero()};
  x[1].center = beam.chord.template cast<Real>();
  x[1].orientation = beam.turn().template cast<Real>();
  return BeamFEM<D>::restOf(x, beam.section(), beam.youngModulus, beam.poissonRatio, shear);
}

}  // namespace sinew
