// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/force/corotation.hpp>
#include <sinew/force/shell_stiffness.hpp>

#include <array>
#include <string_view>
#include <vector>

namespace sinew {

/// Flat triangular shell of three frames, corotational (Felippa & Haugen 2005). The axes e_1, e_2, e_3 of the
/// element have e_3 normal to the triangle as it is, and are rotated in its plane to where its deformation is
/// symmetric. In them the corners have the places x_k and the rotation vectors t_k (X_k and 0 at rest), and
///   E = 1/2 m' K_m m + 1/2 b' K_b b,   m = (x_k - X_k, t_kz)_k,   b = (t_kx, t_ky)_k             [J]
/// with the membrane and the plate of shell_stiffness.hpp. Forces are the exact slope of E, the tangent is
/// the symmetric part of their exact derivative.
template <class D>
struct TriangularShell {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  static constexpr int arity = 3;
  static constexpr bool usesVelocity = false;

  struct Rest {
    Real toAxes[3][4];             // from the axes of a node to those of the element: w, x, y, z
    Real corner[3];                // X_0 = (0, 0), X_1 = (corner[0], 0), X_2 = (corner[1], corner[2])
    Real membrane[45], plate[21];  // K_m, K_b, rows of their lower triangles
  };
  using Tangent = FrameState<Real, 3>;

  Real energy(Rest const& rest, Coord const (&x)[3]) const {
    Tangent state;
    state.take(x);
    const Local<Real> local(rest, state.template frames<Real>());
    Real sum(0);
    for (int i = 0; i < 9; ++i) sum += local.stretch[i] * local.pull[i];
    for (int i = 0; i < 6; ++i) sum += local.bend[i] * local.moment[i];
    return Real(0.5) * sum;
  }

  void force(Rest const& rest, Coord const (&x)[3], Deriv const (&)[3], Deriv (&f)[3],
             Tangent& tangent) const {
    tangent.take(x);
    const FrameForces<Real, 3> all = forces(rest, tangent.template frames<Real>());
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) f[i][c] = all.force[i][c], f[i][c + 3] = all.torque[i][c];
  }

  void dforce(Rest const& rest, Tangent const& tangent, Deriv const (&dx)[3], Deriv (&df)[3], Real k,
              Real /*b*/) const {
    frame_dforce(tangent, dx, df, k, [&](auto const& frames) { return forces(rest, frames); });
  }

  Mat<Real, 6> block(Rest const& rest, Tangent const& tangent, int i, int j, Real k, Real /*b*/) const {
    return frame_block(tangent, i, j, k, [&](auto const& frames) { return forces(rest, frames); });
  }

  /// Rest data of the element between frames at rest. Without `bending` it is a membrane.
  static Rest restOf(Coord const (&x)[3], double E, double nu, double thickness, bool bending) {
    Rest rest;
    const Eigen::Vector3d a = (x[1].center - x[0].center).template cast<double>(),
                          b = (x[2].center - x[0].center).template cast<double>();
    const Eigen::Matrix3d axes = frame_of(a, b);
    const Eigen::Quaterniond orientation(axes);
    for (int i = 0; i < 3; ++i)
      store(x[i].orientation.template cast<double>().conjugate() * orientation, rest.toAxes[i]);
    const PlaneTriangle<double> corners{Eigen::Vector2d(0, 0),
                                        Eigen::Vector2d(a.norm(), 0),
                                        Eigen::Vector2d(axes.col(0).dot(b), axes.col(1).dot(b))};
    rest.corner[0] = Real(corners[1][0]);
    rest.corner[1] = Real(corners[2][0]), rest.corner[2] = Real(corners[2][1]);
    const Eigen::Matrix<double, 9, 9> membrane =
        membrane_stiffness(corners, double(E), double(nu), double(thickness));
    const Eigen::Matrix<double, 6, 6> plate =
        plate_stiffness(corners, double(E), double(nu), double(thickness));
    for (int i = 0; i < 9; ++i)
      for (int j = 0; j <= i; ++j) rest.membrane[lower(i, j)] = Real(membrane(i, j));
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j <= i; ++j) rest.plate[lower(i, j)] = Real(bending ? plate(i, j) : 0);
    return rest;
  }

 private:
  static constexpr int lower(int i, int j) { return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i; }
  template <std::size_t N, class S, std::size_t M>
  SINEW_HD static void multiply(Real const (&k)[M], S const (&d)[N], S (&f)[N]) {
    for (int i = 0; i < int(N); ++i) {
      f[i] = k[lower(i, 0)] * d[0];
      for (int j = 1; j < int(N); ++j) f[i] += k[lower(i, j)] * d[j];
    }
  }
  // gradients at rest of the shape functions of the corners 1 and 2, and of the corner 0
  SINEW_INLINE static void gradients(Rest const& rest, Real (&g)[3][2]) {
    const Real inverse = Real(1) / (rest.corner[0] * rest.corner[2]);
    g[1][0] = rest.corner[2] * inverse, g[1][1] = -rest.corner[1] * inverse;
    g[2][0] = Real(0), g[2][1] = rest.corner[0] * inverse;
    for (int c = 0; c < 2; ++c) g[0][c] = -(g[1][c] + g[2][c]);
  }

  /// The axes of the element, its deformation in them, and dE by that.
  template <class S>
  struct Local {
    Vec<S, 3> axes[3];
    S place[3][2];  // x_k
    S trace;        // of the deformation gradient
    LocalRotation<S> end[3];
    S stretch[9], pull[9];  // m, K_m m
    S bend[6], moment[6];   // b, K_b b

    SINEW_HD Local(Rest const& rest, Frames<S, 3> const& frames) {
      using std::sqrt, sinew::sqrt;
      const S tiny(std::numeric_limits<lane_scalar<Real>>::min());
      const Mat<S, 3> edges = frame_of(frames.place[1], frames.place[2]);
      Real g[3][2];
      gradients(rest, g);
      // the deformation gradient in the axes along the first side
      S f[2][2];
      for (int r = 0; r < 2; ++r) {
        const Vec<S, 3> axis = edges.col(r);
        const S p1 = dot3(axis, frames.place[1]), p2 = dot3(axis, frames.place[2]);
        for (int c = 0; c < 2; ++c) f[r][c] = g[1][c] * p1 + g[2][c] * p2;
      }
      const S c = f[0][0] + f[1][1], s = f[1][0] - f[0][1];
      trace = sqrt(c * c + s * s + tiny);
      const S inverse = S(1) / trace, cosine = c * inverse, sine = s * inverse;
      const Vec<S, 3> u = edges.col(0), v = edges.col(1);
      axes[0] = cosine * u + sine * v;
      axes[1] = cosine * v - sine * u;
      axes[2] = edges.col(2);

      const Real at[3][2]{{Real(0), Real(0)}, {rest.corner[0], Real(0)}, {rest.corner[1], rest.corner[2]}};
      for (int k = 0; k < 3; ++k) {
        end[k] = localRotation(frames.orientation[k] * unit_quaternion<S>(rest.toAxes[k]));
        for (int r = 0; r < 2; ++r) {
          place[k][r] = dot3(axes[r], frames.place[k]);
          stretch[3 * k + r] = place[k][r] - S(at[k][r]);
          bend[2 * k + r] = end[k].vector[r];
        }
        stretch[3 * k + 2] = end[k].vector[2];
      }
      multiply<9>(rest.membrane, stretch, pull);
      multiply<6>(rest.plate, bend, moment);
    }

   private:
    // the rotation of a node against the axes, by less than 180 degrees
    SINEW_HD LocalRotation<S> localRotation(UnitQuaternion<S> const& node) const {
      using std::sqrt, sinew::sqrt;
      Vec<S, 3> column[3];  // R = axes' node, of which quaternions have tr R = 4 w^2 - 1, R - R' = 4 w [v]x
      for (int c = 0; c < 3; ++c) {
        Vec<S, 3> unit(S(0), S(0), S(0));
        unit[c] = S(1);
        const Vec<S, 3> a = node(unit);
        for (int r = 0; r < 3; ++r) column[c][r] = dot3(axes[r], a);
      }
      const S tiny(lane_scalar<Real>(1e-12));
      const S twice = sqrt(S(1) + column[0][0] + column[1][1] + column[2][2] + tiny);
      const S part = S(0.5) / twice;
      return LocalRotation<S>({S(0.5) * twice,
                               Vec<S, 3>(part * (column[1][2] - column[2][1]),
                                         part * (column[2][0] - column[0][2]),
                                         part * (column[0][1] - column[1][0]))});
    }
  };

  // Minus the slope of E. The axes rotate by w = (sum h_ky dz_k, -sum h_kx dz_k, sum (g_kx dy_k - g_ky dx_k)
  // / tr F) when the corners move by (dx, dy, dz)_k in them; g are the gradients of the shape functions at
  // rest, h those as they are now. The moment of all that pulls at the nodes is undone by forces that make
  // that rotation.
  template <class S>
  SINEW_HD static FrameForces<S, 3> forces(Rest const& rest, Frames<S, 3> const& frames) {
    const Local<S> local(rest, frames);
    Vec<S, 3> torque[3], whole(S(0), S(0), S(0));
    for (int k = 0; k < 3; ++k) {
      torque[k] =
          local.end[k].torque(Vec<S, 3>(local.moment[2 * k], local.moment[2 * k + 1], local.pull[3 * k + 2]));
      whole += torque[k];
      whole[2] += local.place[k][0] * local.pull[3 * k + 1] - local.place[k][1] * local.pull[3 * k];
    }
    auto const& x = local.place;
    const S inverse = S(1) / (x[1][0] * x[2][1] - x[2][0] * x[1][1]), about = whole[2] / local.trace;
    S h[3][2];
    h[1][0] = x[2][1] * inverse, h[1][1] = -x[2][0] * inverse;
    h[2][0] = -x[1][1] * inverse, h[2][1] = x[1][0] * inverse;
    for (int c = 0; c < 2; ++c) h[0][c] = -(h[1][c] + h[2][c]);
    Real g[3][2];
    gradients(rest, g);
    FrameForces<S, 3> f;
    for (int k = 0; k < 3; ++k) {
      const S px = -local.pull[3 * k] - g[k][1] * about, py = g[k][0] * about - local.pull[3 * k + 1],
              pz = whole[0] * h[k][1] - whole[1] * h[k][0];
      f.force[k] = px * local.axes[0] + py * local.axes[1] + pz * local.axes[2];
      f.torque[k] =
          -(torque[k][0] * local.axes[0] + torque[k][1] * local.axes[1] + torque[k][2] * local.axes[2]);
    }
    return f;
  }
};

/// An elastic thin shell of triangles: the triangles of the topology, or two in each of its quads where it
/// has none. They stretch, shear, bend, and hold the rotation of their frames about the normal.
template <class D>
struct TriangularShellForceField {
  static_assert(D::rigid && D::spatial == 3,
                "Sinew: TriangularShellForceField is for frames in space (Rigid3d).");
  using Role = role::ForceField;
  static constexpr bool sharesWork = true;
  using DataTypes = D;
  using Real = typename D::Real;
  static constexpr std::string_view className = "TriangularShellForceField";

  double poissonRatio = 0.45, youngModulus = 3000, thickness = 0.1;
  bool bending = true;

  static constexpr auto fields() {
    using F = TriangularShellForceField;
    return field_list(
        field("poissonRatio",
              &F::poissonRatio,
              "",
              "lateral contraction per strain",
              Range{.low = -1, .high = 0.5, .openLow = true}),
        field("youngModulus", &F::youngModulus, "Pa", "stiffness of the material", range::positive),
        field("thickness", &F::thickness, "m", "thickness of the shell", range::positive),
        field("bending", &F::bending, "", "whether it resists bending; a membrane when not"));
  }

  // the symmetric part
  static constexpr ForceProperties properties() { return {.exactTangent = false}; }

  bool hadElements = false;  // a surface may have lost all its triangles

  using Driver = ElementDriver<TriangularShell, D>;
  Driver driver{};

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<TriangularShellForceField>());
    TopologyView const& t = context.topology;
    detail::check_indices(where, "triangle", t.triangles, context.rest.size());
    detail::check_indices(where, "quad", t.quads, context.rest.size());
    std::vector<Triangle> triangles(t.triangles.begin(), t.triangles.end());
    if (triangles.empty())
      for (Quad const& q : t.quads) {
        triangles.push_back({q[0], q[1], q[2]});
        triangles.push_back({q[0], q[2], q[3]});
      }
    if (triangles.empty() && !hadElements && !t.grows)
      throw Error(where, "the topology has no triangle; give the node a topology with triangles or quads");
    hadElements = true;
    std::vector<typename Driver::Rest> rest;
    for (std::size_t e = 0; e < triangles.size(); ++e) {
      typename D::Coord x[3];
      for (std::size_t k = 0; k < 3; ++k) x[k] = context.rest[std::size_t(triangles[e][k])];
      const Vec<Real, 3> a = x[1].center - x[0].center, b = x[2].center - x[0].center;
      const Real longest = std::max({a.norm(), b.norm(), (b - a).norm()});
      if (!(a.cross(b).norm() > Real(1e-6) * longest * longest))
        throw Error(where, text("triangle ", e, " has no area; move or merge its points"));
      rest.push_back(TriangularShell<D>::restOf(x, youngModulus, poissonRatio, thickness, bending));
    }
    driver.init(triangles, rest);
  }
};

}  // namespace sinew
