// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/force/elasticity.hpp>
#include <sinew/topology/beam_section.hpp>

#include <cmath>

namespace sinew {

/// Consistent mass of a beam between two frames, in its axes (Przemieniecki 1968; with shear, Friedman &
/// Kosmatka 1993):
///   M = integral over the length of r A N_w' N_w + r I N_t' N_t
/// for each plane of bending, where N_w and N_t give the deflection and the rotation of the sections for
/// loads at the ends, and linear functions along and about the beam, with the polar inertia r (I_y + I_z).
template <class Real>
struct BeamInertia {
  Real along[2], about[2];  // end by itself, and with the other [kg, kg m^2]
  // of the planes xz and xy, between v_0 v_0, v_0 t_0, v_0 v_1, v_0 t_1, t_0 t_0, t_0 t_1; those of the other
  // end are alike, with signs
  Real bending[2][6];

  /// Of a beam of the given length between the frames and the length that has mass.
  static BeamInertia of(BeamSection const& s, double E, double nu, double density, double L, double massive,
                        bool shear) {
    BeamInertia inertia;
    const double line = density * s.area * massive / L, polar = density * (s.aboutY + s.aboutZ) * massive;
    for (int k = 0; k < 2; ++k) {
      inertia.along[k] = Real(line * L / (k == 0 ? 3 : 6));
      inertia.about[k] = Real(polar / (k == 0 ? 3 : 6));
    }
    for (int c = 0; c < 2; ++c) {
      const double I = c == 0 ? s.aboutY : s.aboutZ, rotary = density * I * massive / L;
      const double p = shear ? 12 * E * I / (s.shear * shear_modulus(E, nu) * s.area * L * L) : 0;
      Real(&to)[6] = inertia.bending[c];
      for (Real& entry : to) entry = Real(0);
      // the products have order 6 at most: four points of Gauss are exact
      static constexpr double at[4]{
          -0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526},
          weight[4]{0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
      for (int g = 0; g < 4; ++g) {
        const double x = (1 + at[g]) / 2, n = 1 / (1 + p), h = weight[g] / 2 * L;
        const double w[4]{n * (2 * x * x * x - 3 * x * x - p * x + 1 + p),
                          n * L * (x * x * x - (2 + p / 2) * x * x + (1 + p / 2) * x),
                          n * (-2 * x * x * x + 3 * x * x + p * x),
                          n * L * (x * x * x - (1 - p / 2) * x * x - p / 2 * x)};
        const double t[4]{n * 6 / L * (x * x - x),
                          n * (3 * x * x - (4 + p) * x + 1 + p),
                          -n * 6 / L * (x * x - x),
                          n * (3 * x * x - (2 - p) * x)};
        static constexpr int pairs[6][2]{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 1}, {1, 3}};
        for (int k = 0; k < 6; ++k) {
          const int i = pairs[k][0], j = pairs[k][1];
          to[k] += Real(h * (line * w[i] * w[j] + rotary * t[i] * t[j]));
        }
      }
    }
    return inertia;
  }

  /// Of the ends i and j, in the axes of the beam.
  Mat<Real, 6> block(int i, int j) const {
    Mat<Real, 6> m = Mat<Real, 6>::Zero();
    m(0, 0) = along[i == j ? 0 : 1];
    m(3, 3) = about[i == j ? 0 : 1];
    for (int c = 0; c < 2; ++c) {
      // y and the rotation about z; z and that about -y
      const int v = c == 0 ? 2 : 1, t = c == 0 ? 4 : 5;
      const Real(&b)[6] = bending[c];
      const Real turn(c == 0 ? -1 : 1), side(i == 0 ? 1 : -1);
      if (i == j) {
        m(v, v) = b[0];
        m(v, t) = m(t, v) = turn * side * b[1];
        m(t, t) = b[4];
      } else {
        m(v, v) = b[2];
        m(v, t) = turn * side * b[3];
        m(t, v) = -turn * side * b[3];
        m(t, t) = b[5];
      }
    }
    return m;
  }
};

}  // namespace sinew
