// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/follow.hpp>
#include <sinew/mass/lumped_mass.hpp>
#include <sinew/topology/shape_file.hpp>

#include <optional>

namespace sinew {

/// The same mass at every point: `vertexMass`, or `totalMass` shared out evenly. Rigid bodies have a mass and
/// an inertia in body axes; `totalMass` scales both. In space they may take it from a file: SOFA's .rigid, or
/// a closed surface (.obj, .stl, .ply, .msh, .vtk) around the origin, filled evenly with 1 kg or `totalMass`.
template <class D>
struct UniformMass {
  using Role = role::Mass;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  using MassType = typename D::MassType;
  static constexpr std::string_view className = "UniformMass";

  std::optional<MassType> vertexMass{};  // 1 kg (and unit inertia) when neither is given
  std::optional<double> totalMass{};
  DataFile filename{};  // of rigid bodies in space
  static constexpr bool readsFile = D::rigid && D::spatial == 3;

  static constexpr auto fields() {
    using M = UniformMass;
    constexpr auto mass = field("vertexMass", &M::vertexMass, "kg", "mass of each point", range::positive)
                              .also("mass vertexmass");
    constexpr auto total =
        field("totalMass", &M::totalMass, "kg", "mass of all points together", range::positive)
            .also("totalmass");
    if constexpr (readsFile)
      return field_list(
          mass,
          total,
          field("filename", &M::filename, "", "mass and inertia of each body: .rigid, or a closed surface"));
    else
      return field_list(mass, total);
  }

  LumpedMass<D> lumped{};

  /// What a point weighs stays, not the total; where points come since the body is cut or refined, the total.
  void follow(Followed const& change) {
    if (change.points.come.empty() || !(change.joined || change.refined)) return keepMassOfPoint();
    if (!totalMass)
      totalMass = double(LumpedMass<D>::scalar(lumped.mass[0])) * double(change.points.now.size());
    vertexMass.reset();
  }
  void followPoints(Renumbering const&, std::size_t) { keepMassOfPoint(); }
  void keepMassOfPoint() {
    if (!totalMass) return;
    vertexMass = lumped.mass[0];
    totalMass.reset();
    filename = {};
  }

  void init(InitContext<D> const& context) {
    const std::string where = text(context.where, ": ", component_name<UniformMass>());
    if (vertexMass && totalMass)
      throw Error(where, "vertexMass and totalMass are both given; give one of them");
    MassType mass = vertexMass.value_or(unit());
    if constexpr (readsFile)
      if (!filename.path.empty()) {
        if (vertexMass) throw Error(where, "vertexMass and filename are both given; give one of them");
        mass = massInFile(where);
      }
    if (totalMass) {
      if (context.rest.empty())
        throw Error(where, "the state has no points to share totalMass; give it positions");
      const Real share = Real(*totalMass) / Real(context.rest.size());
      if constexpr (D::rigid)
        mass = {share, share / mass.mass * mass.inertia};
      else
        mass = share;
    }
    lumped.init(where, {mass});
  }

  void addForce(MechanicalParams const& p, VecDeriv& f, VecCoord const& x, VecDeriv const& v) const {
    lumped.addForce(p, f, x, v);
  }
  void addMDx(VecDeriv& f, VecCoord const& x, VecDeriv const& dx, double factor) const {
    lumped.addMDx(f, x, dx, Real(factor));
  }
  void accFromF(VecDeriv& a, VecCoord const& x, VecDeriv const& f) const { lumped.accFromF(a, x, f); }
  double kineticEnergy(VecCoord const& x, VecDeriv const& v) const { return lumped.kineticEnergy(x, v); }
  template <class Sink>
  void addToMatrix(MechanicalParams const& p, VecCoord const& x, Sink const& sink) const {
    lumped.addToMatrix(x, Real(p.m), sink);
  }

 private:
  static MassType unit() {
    if constexpr (D::rigid)
      return {};
    else
      return MassType(1);
  }

  MassType massInFile(std::string const& where) const {
    try {
      const RigidMass<double, 3> body = rigid_mass_in_file(filename.path);
      return {Real(body.mass), body.inertia.template cast<Real>()};
    } catch (Error const& error) {
      throw Error(where, error.what());
    }
  }
};

}  // namespace sinew
