// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/element_driver.hpp>
#include <sinew/core/follow.hpp>
#include <sinew/force/tetrahedron_rest.hpp>
#include <sinew/force/viscoelastic_material.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace sinew {

/// Linear tetrahedron of a viscoelastic material, total Lagrangian: f_k = -V F S g_k [N]. The terms that
/// relax advance from a strain E_n and stresses Q_n at an earlier time by
///   Q = a Q_n + 2 G c dev(E - E_n),   a = exp(-h/tau), c = (1 - a) tau/h,
/// which is exact where the strain is linear in time (Taylor, Pister, Goudreau 1970; Simo, Hughes
/// 1998, 10.3). The tangent is exact at rest; with velocities, the part of df/dx that they make by way of
/// dE/dt, which is not symmetric, is left out.
template <class D>
struct TetrahedronViscoelasticity {
  using Real = typename D::Real;
  using Coord = typename D::Coord;
  using Deriv = typename D::Deriv;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  static constexpr int arity = 4;
  static constexpr bool usesVelocity = true;
  static constexpr int maxTerms = 3;

  using Rest = TetrahedronRest<Real>;
  // dev(E) and Q_i at one time: entries 00 11 22 12 02 01
  struct Memory {
    Real strain[6], stress[maxTerms][6];
  };
  struct Tangent {
    Mat3 f, s;                 // F and S at the last force
    Memory previous, current;  // of the last time step, and of the one before it
  };

  Real shear{0}, lambda{0}, viscosity{0};
  int terms = 0;
  Real decay[maxTerms], gain[maxTerms];  // a and 2 G c
  bool advance = false;                  // what was current is previous now
  bool retreat = false;                  // the other way: a step is tried again
  bool inside = false;                   // between two steps: nothing is kept

  SINEW_HD Real energy(Rest const& rest, Coord const (&x)[4]) const {
    const Mat3 e = strain(deformation_gradient(rest, x));
    const Real trace = e(0, 0) + e(1, 1) + e(2, 2);
    Real square(0);
    for (int i = 0; i < 9; ++i) square += e(i) * e(i);
    return rest.volume * (shear * square + Real(0.5) * lambda * trace * trace);
  }

  SINEW_HD void force(Rest const& rest, Coord const (&x)[4], Deriv const (&v)[4], Deriv (&force)[4],
                      Tangent& t) const {
    t.f = deformation_gradient(rest, x);
    const Mat3 e = strain(t.f), rate = strainRate(t.f, deformation_gradient(rest, v));
    const Real trace = e(0, 0) + e(1, 1) + e(2, 2), pressure = lambda * trace;
    for (int i = 0; i < 9; ++i)
      t.s(i) = Real(2) * (shear * e(i) + viscosity * rate(i)) + (i % 4 == 0 ? pressure : Real(0));
    if (terms > 0) relax(e, trace / Real(3), t);
    nodal(rest, times(t.f, t.s), Real(-1), force);
  }

  SINEW_HD void dforce(Rest const& rest, Tangent const& t, Deriv const (&dx)[4], Deriv (&df)[4], Real k,
                       Real b) const {
    const Mat3 g = deformation_gradient(rest, dx), de = strainRate(t.f, g);
    const Real factor = Real(2) * (k * instantShear() + b * viscosity),
               pressure = k * instantLambda() * (de(0, 0) + de(1, 1) + de(2, 2));
    Mat3 ds;
    for (int i = 0; i < 9; ++i) ds(i) = factor * de(i) + (i % 4 == 0 ? pressure : Real(0));
    const Mat3 a = times(t.f, ds), c = times(g, t.s);
    Mat3 dp;
    for (int i = 0; i < 9; ++i) dp(i) = a(i) + k * c(i);
    nodal(rest, dp, Real(-1), df);
  }

  /// -V (k g_i.S g_j I + (k G + b eta)(g_i.g_j F F' + F g_j (F g_i)') + k lambda F g_i (F g_j)')
  SINEW_INLINE Mat3 block(Rest const& rest, Tangent const& t, int i, int j, Real k, Real b) const {
    const Vec3 gi = shape(rest, i), gj = shape(rest, j), fi = times(t.f, gi), fj = times(t.f, gj);
    const Real factor = -rest.volume * (k * instantShear() + b * viscosity),
               volume = -rest.volume * k * instantLambda(), gg = dot3(gi, gj),
               diagonal = -rest.volume * k * dot3(gi, times(t.s, gj));
    Mat3 block;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) {
        const Real left = t.f(r, 0) * t.f(c, 0) + t.f(r, 1) * t.f(c, 1) + t.f(r, 2) * t.f(c, 2);
        block(r, c) = factor * (gg * left + fj[r] * fi[c]) + volume * fi[r] * fj[c];
        if (r == c) block(r, c) += diagonal;
      }
    return block;
  }

 private:
  // moduli of a strain at the end of a step
  SINEW_INLINE Real instantShear() const {
    Real sum = shear;
    for (int i = 0; i < terms; ++i) sum += Real(0.5) * gain[i];
    return sum;
  }
  SINEW_INLINE Real instantLambda() const {
    Real sum = lambda;
    for (int i = 0; i < terms; ++i) sum -= gain[i] / Real(3);
    return sum;
  }

  SINEW_HD void relax(Mat3 const& e, Real mean, Tangent& t) const {
    constexpr int entry[6] = {0, 4, 8, 7, 6, 3};
    if (advance) t.previous = t.current;
    if (retreat) t.current = t.previous;
    Memory const& from = inside ? t.current : t.previous;
    Real stress[maxTerms][6];
    for (int n = 0; n < 6; ++n) {
      const Real deviator = n < 3 ? Real(e(entry[n]) - mean) : e(entry[n]),
                 increment = deviator - from.strain[n];
      Real sum(0);
      for (int i = 0; i < terms; ++i) {
        stress[i][n] = decay[i] * from.stress[i][n] + gain[i] * increment;
        sum += stress[i][n];
        if (!inside) t.current.stress[i][n] = stress[i][n];
      }
      if (!inside) t.current.strain[n] = deviator;
      const int r = entry[n] % 3, c = entry[n] / 3;
      t.s(r, c) += sum;
      if (r != c) t.s(c, r) += sum;
    }
  }

  SINEW_INLINE static Mat3 times(Mat3 const& a, Mat3 const& b) {
    Mat3 ab;
    for (int c = 0; c < 3; ++c) ab.col(c) = sinew::times(a, Vec3(b.col(c)));
    return ab;
  }
  SINEW_INLINE static Vec3 times(Mat3 const& a, Vec3 const& b) { return sinew::times(a, b); }
  SINEW_INLINE static Vec3 shape(Rest const& rest, int k) {
    Mat3 const& g = rest.gradient;
    return k == 0 ? Vec3(-(g.col(0) + g.col(1) + g.col(2))) : Vec3(g.col(k - 1));
  }
  SINEW_INLINE static Mat3 strain(Mat3 const& f) {
    Mat3 e;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        e(i, j) = e(j, i) = Real(0.5) * (dot3(Vec3(f.col(i)), Vec3(f.col(j))) - Real(i == j ? 1 : 0));
    return e;
  }
  // sym(F' G)
  SINEW_INLINE static Mat3 strainRate(Mat3 const& f, Mat3 const& g) {
    Mat3 e;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j)
        e(i, j) = e(j, i) =
            Real(0.5) * (dot3(Vec3(f.col(i)), Vec3(g.col(j))) + dot3(Vec3(f.col(j)), Vec3(g.col(i))));
    return e;
  }
  SINEW_INLINE static void nodal(Rest const& rest, Mat3 const& p, Real factor, Deriv (&f)[4]) {
    for (int k = 0; k < 3; ++k) f[k + 1] = times(p, Vec3(rest.gradient.col(k))) * (factor * rest.volume);
    for (int i = 0; i < 3; ++i) f[0][i] = -(f[1][i] + f[2][i] + f[3][i]);
  }
};

/// A viscoelastic body of tetrahedra: those of the topology, or six in each of its hexahedra where it has
/// none. Beside another force field over the same tetrahedra, Maxwell's materials with lambda = 0 are terms
/// that relax for any elasticity.
///
/// The history, Q_n and E_n, is that of the last step. The field learns of steps by the times that
/// it is asked for: a step ends when a force is wanted a whole step, MechanicalParams::dt, after its start or
/// later. So it follows solvers that move through each step, and those that try one again. Before the first
/// time there was rest: a body that starts strained has been strained just then.
template <class D>
struct TetrahedronViscoelasticityFEMForceField {
  using Role = role::ForceField;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "TetrahedronViscoelasticityFEMForceField";
  static constexpr bool needsTetrahedra = true;

  ViscoelasticMaterial materialName = ViscoelasticMaterial::KelvinVoigtFirstOrder;
  std::vector<double> parameterSet{};

  static constexpr auto fields() {
    using F = TetrahedronViscoelasticityFEMForceField;
    return field_list(
        field("materialName", &F::materialName, "", "rheological model"),
        field("ParameterSet",
              &F::parameterSet,
              "Pa and s",
              "its parameters: G1 tau lambda of KelvinVoigtFirstOrder and MaxwellFirstOrder; G1 tau1 G2 tau2 "
              "lambda of MaxwellSecondOrder; G0 G1 tau lambda of SLSMaxwellFirstOrder; G0 G1 tau1 G2 tau2 "
              "lambda of SLSMaxwellSecondOrder; G0 [G1 tau1 [G2 tau2 [G3 tau3]]] lambda of Prony"));
  }

  /// Terms that relax dissipate; the claims about a damper at rest are those of its spring.
  ForceProperties properties() const { return {.conservative = moduli.terms == 0}; }

  using Driver = ElementDriver<TetrahedronViscoelasticity, D>;
  ViscoelasticModuli moduli{};
  Driver driver{};
  double previousTime = 0, currentTime = 0;  // of the two memories of an element
  double step = -1;              // length of the step that began at currentTime; negative: none yet
  std::vector<double> memory{};  // of all elements, in their order
  bool advance = false, retreat = false;
  double now = 0;  // time of the last force

  /// What the next step depends on, besides positions and velocities.
  static constexpr auto state() {
    using F = TetrahedronViscoelasticityFEMForceField;
    return field_list(field("previousTime", &F::previousTime, "s", "time of the step before the last"),
                      field("currentTime", &F::currentTime, "s", "time of the last step"),
                      field("step", &F::step, "s", "length of the last step; negative: there was none"),
                      field("memory", &F::memory, "", "strains and stresses of both, of all elements"));
  }

  /// Tetrahedra that stay keep their history, parts have that of what they are of, and others have none.
  void follow(Followed const& change) {
    if (memory.empty()) return;
    change.topology.ofDimension(3, memory.size() / memorySize).filterRows(memory, memorySize);
  }

  void init(InitContext<D> const& context) {
    const std::string where =
        text(context.where, ": ", component_name<TetrahedronViscoelasticityFEMForceField>());
    check_viscoelastic(where, materialName, parameterSet);
    moduli = viscoelastic_moduli(materialName, parameterSet);
    const auto tetrahedra = init_tetrahedra<D>(where, driver, context);
    now = currentTime;
    if (moduli.terms == 0) return;
    const std::size_t size = tetrahedra.size() * memorySize;
    if (memory.size() == size)
      forEachMemory([](auto& lane, double kept) { lane = Real(kept); });
    else
      forget(0);
    memory.resize(size);
  }

  void reset() {
    step = -1;
    forget(0);
    now = 0;
    std::fill(memory.begin(), memory.end(), 0);
  }

  template <class Law = typename Driver::Law>
  Law law() const {
    using L = typename Law::Real;
    Law law;
    law.shear = L(moduli.shear), law.lambda = L(moduli.lambda), law.viscosity = L(moduli.viscosity);
    law.terms = moduli.terms;
    law.advance = advance, law.retreat = retreat, law.inside = now != currentTime;
    const double h = now - (law.inside ? currentTime : previousTime);
    for (int i = 0; i < moduli.terms; ++i) {
      const double z = h / moduli.time[std::size_t(i)];
      law.decay[i] = L(std::exp(-z));
      law.gain[i] = L(2 * moduli.modulus[std::size_t(i)] * (z > 0 ? -std::expm1(-z) / z : 1));
    }
    return law;
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) {
    if (moduli.terms == 0) return driver.addForce(law(), f, x, v);
    moveTo(p.time, p.dt);
    driver.addForce(law(), f, x, v);
    if (now == currentTime) forEachMemory([](auto const& lane, double& kept) { kept = double(lane); });
  }

 private:
  using Memory = typename TetrahedronViscoelasticity<D>::Memory;
  static constexpr std::size_t memorySize = 2 * sizeof(Memory) / sizeof(Real);

  void moveTo(double time, double dt) {
    advance = retreat = false;
    if (step < 0 || time < previousTime)
      forget(time);
    else if (time < currentTime)
      retreat = true, currentTime = previousTime;
    else if (time > currentTime && time >= currentTime + step * (1 - 1e-6))
      advance = true, previousTime = currentTime, currentTime = time;
    if (time == currentTime) step = dt;
    now = time;
  }
  // as if there had been rest until this time
  void forget(double time) {
    previousTime = currentTime = time;
    for (auto& pack : driver.packs) pack.tangent.previous = pack.tangent.current = {};
  }
  // f(scalar of an element's memory, its place in `memory`)
  template <class F>
  void forEachMemory(F&& f) {
    constexpr std::size_t lanes = sizeof(typename Driver::L) / sizeof(Real);
    std::size_t at = 0;
    for (auto& pack : driver.packs) {
      Real* const first = reinterpret_cast<Real*>(&pack.tangent.previous);
      for (std::size_t l = 0; l < std::size_t(pack.active); ++l)
        for (std::size_t r = 0; r < memorySize; ++r) f(first[r * lanes + l], memory[at++]);
    }
  }
};

}  // namespace sinew
