// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Viscoelastic materials, by the names of SOFA's plugin SofaViscoElastic, with its order of parameters:
/// shear moduli G [Pa], relaxation times tau [s], lambda [Pa]. With the strain E = (F'F - I)/2, the stress S
/// = dW/dE (second Piola-Kirchhoff) is
///   KelvinVoigtFirstOrder  G1 tau lambda                 S = lambda tr(E) I + 2 G1 (E + tau dE/dt)
///   MaxwellFirstOrder      G1 tau lambda                 S = lambda tr(E) I + Q_1
///   MaxwellSecondOrder     G1 tau1 G2 tau2 lambda        S = lambda tr(E) I + Q_1 + Q_2
///   SLSMaxwellFirstOrder   G0 G1 tau lambda              S = lambda tr(E) I + 2 G0 E + Q_1
///   SLSMaxwellSecondOrder  G0 G1 tau1 G2 tau2 lambda     S = lambda tr(E) I + 2 G0 E + Q_1 + Q_2
///   Prony                  G0 [G1 tau1 [G2 tau2 [G3 tau3]]] lambda    the same with up to three terms
/// where dQ_i/dt + Q_i / tau_i = 2 G_i d dev(E)/dt: a Prony series of the shear modulus, G(t) = G0 + sum_i
/// G_i exp(-t/tau_i). The volume stays elastic.
enum class ViscoelasticMaterial {
  KelvinVoigtFirstOrder,
  MaxwellFirstOrder,
  MaxwellSecondOrder,
  SLSMaxwellFirstOrder,
  SLSMaxwellSecondOrder,
  Prony
};
inline constexpr std::array<std::string_view, 6> enum_names(ViscoelasticMaterial) {
  return {"KelvinVoigtFirstOrder",
          "MaxwellFirstOrder",
          "MaxwellSecondOrder",
          "SLSMaxwellFirstOrder",
          "SLSMaxwellSecondOrder",
          "Prony"};
}
inline constexpr std::array<std::string_view, 6> viscoelasticParameters{
    "G1 tau lambda",
    "G1 tau lambda",
    "G1 tau1 G2 tau2 lambda",
    "G0 G1 tau lambda",
    "G0 G1 tau1 G2 tau2 lambda",
    "G0 [G1 tau1 [G2 tau2 [G3 tau3]]] lambda"};
inline constexpr bool takes_parameters(ViscoelasticMaterial material, std::size_t count) {
  constexpr std::size_t wanted[] = {3, 3, 5, 4, 6};
  if (material == ViscoelasticMaterial::Prony) return count == 2 || count == 4 || count == 6 || count == 8;
  return count == wanted[std::size_t(material)];
}

/// What the names above stand for.
struct ViscoelasticModuli {
  double shear = 0, lambda = 0;  // G0 [Pa]
  double viscosity = 0;          // G1 tau [Pa s] of Kelvin and Voigt
  int terms = 0;
  std::array<double, 3> modulus{}, time{};  // of the terms that relax
};
ViscoelasticModuli viscoelastic_moduli(ViscoelasticMaterial material, std::vector<double> const& p);

/// Throws Error unless the parameters are those of a material that holds together and dissipates.
void check_viscoelastic(std::string const& where, ViscoelasticMaterial material,
                        std::vector<double> const& p);

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

namespace sinew {

SINEW_ONCE ViscoelasticModuli viscoelastic_moduli(ViscoelasticMaterial material,
                                                  std::vector<double> const& p) {
  ViscoelasticModuli m;
  m.lambda = p.back();
  if (material == ViscoelasticMaterial::KelvinVoigtFirstOrder) {
    m.shear = p[0];
    m.viscosity = p[0] * p[1];
    return m;
  }
  std::size_t next = 0;
  if (p.size() % 2 == 0) m.shear = p[next++];
  for (; next + 1 < p.size(); next += 2, ++m.terms) {
    m.modulus[std::size_t(m.terms)] = p[next];
    m.time[std::size_t(m.terms)] = p[next + 1];
  }
  return m;
}

SINEW_ONCE void check_viscoelastic(std::string const& where, ViscoelasticMaterial material,
                                   std::vector<double> const& p) {
  const std::string_view name = enum_names(material)[std::size_t(material)],
                         names = viscoelasticParameters[std::size_t(material)];
  if (!takes_parameters(material, p.size()))
    throw Error(where, text("ParameterSet has ", p.size(), " values, but ", name, " takes ", names));
  const auto m = viscoelastic_moduli(material, p);
  auto refuse = [&](std::string_view what) {
    throw Error(where, text(what, "; correct ParameterSet, which is ", names, " of ", name));
  };
  double instant = m.shear;
  for (int i = 0; i < m.terms; ++i) {
    if (m.modulus[std::size_t(i)] < 0) refuse("a modulus G is negative");
    if (!(m.time[std::size_t(i)] > 0)) refuse("a relaxation time tau is not greater than 0");
    instant += m.modulus[std::size_t(i)];
  }
  if (m.shear < 0) refuse("a modulus G is negative");
  if (m.viscosity < 0) refuse("a relaxation time tau is negative");
  if (!(instant > 0)) refuse("all moduli G are 0");
  if (m.lambda < -2 * m.shear / 3) refuse("lambda is less than -2/3 of the modulus that stays");
}

}  // namespace sinew
#endif
