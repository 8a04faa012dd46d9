// SPDX-License-Identifier: BSL-1.0
// Each rule of scene/rules.hpp is broken by a scene, which the typed and the runtime tree refuse, or warn of,
// by the same rule.
#include "same_bits.hpp"

#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/constraint/attach.hpp>
#include <sinew/force/stiff_spring.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mapping/identity_mapping.hpp>
#include <sinew/mapping/rigid_mapping.hpp>
#include <sinew/mapping/subset_multi_mapping.hpp>
#include <sinew/solver/damp_velocity.hpp>
#include <sinew/solver/euler_explicit.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/topology/mesh_topology.hpp>

#include <set>

namespace test_rules {

using namespace sinew;
using rules::Rule;

namespace {

template <class Verdict>
constexpr Rule rule = Rule::none;
template <Rule R, class C, FixedString Node>
constexpr Rule rule<checks::Wrong<R, C, Node>> = R;

std::set<Rule> seen;

/// What a runtime tree says of a scene: its error, or its warnings.
std::string said(RuntimeNode<Standard> root) {
  StandardSimulation sim(std::move(root));
  try {
    sim.init();
  } catch (Error const& error) {
    return error.what();
  }
  std::string all;
  for (auto const& warning : sim.root().warnings) all += warning;
  return all;
}

void says(RuntimeNode<Standard> root, Rule broken) {
  const std::string words = said(std::move(root));
  CHECK_THAT(words, Catch::Contains(std::string(rules::sentence(broken).cause)));
  CHECK_THAT(words, Catch::Contains(std::string(rules::sentence(broken).remedy)));
  seen.insert(broken);
}

/// `scene` breaks a rule in both trees.
template <Rule broken, class Root>
void breaks(Root scene) {
  using Verdict = typename Simulation<Root>::Verdict;
  CAPTURE(rules::sentence(broken).name);
  STATIC_REQUIRE(rule<Verdict> == broken);
  says(to_runtime<Standard>(scene), broken);
}
/// It does in a typed one, where a runtime tree cannot be written so, or knows only when a topology is made.
template <Rule broken, class Root>
void breaks_typed(Root) {
  STATIC_REQUIRE(rule<typename Simulation<Root>::Verdict> == broken);
  seen.insert(broken);
}

const MechanicalObject<Vec3d> dofs{.position = {{0, 0, 0}}};
const MechanicalObject<Rigid3d> rigid{.position = {Rigid3d::Coord{}}};
const UniformMass<Vec3d> mass{};
const EulerExplicitSolver euler{};
using Springs = StiffSpringForceField<Vec3d, Between<"a", "b">>;
using Follow = SubsetMultiMapping<Vec3d, Vec3d, Parents<"../a", "../b">>;
const Follow follow{.indexPairs = {{0, 0}, {1, 0}}};

/// A node has one of a kind, and all stages of collision detection.
void node_rules() {
  breaks<Rule::secondState>(node<"root">(dofs, dofs));
  breaks<Rule::secondMapping>(node<"root">(
      dofs,
      node<"a">(
          MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{})));
  breaks<Rule::secondMass>(node<"root">(dofs, mass, mass));
  breaks<Rule::secondSolver>(node<"root">(euler, euler, dofs, mass));
  breaks<Rule::secondTopology>(node<"root">(MeshTopology{}, MeshTopology{}, dofs));
  breaks<Rule::sameNames>(node<"root">(node<"a">(), node<"a">()));
  breaks<Rule::missingStage>(node<"root">(DefaultPipeline{}, BruteForceBroadPhase{}));
  breaks<Rule::loneStage>(node<"root">(BruteForceBroadPhase{}));
  breaks<Rule::secondStage>(node<"root">(DefaultPipeline{},
                                         BruteForceBroadPhase{},
                                         BruteForceBroadPhase{},
                                         BVHNarrowPhase{},
                                         MinProximityIntersection{},
                                         DefaultContactManager{}));
}

/// What acts on a state finds one of its kind, moved by its solver.
void acting_rules() {
  breaks<Rule::noState>(node<"root">(mass));
  breaks<Rule::otherDataTypes>(node<"root">(rigid, mass));
  breaks<Rule::stateAcrossSolvers>(
      node<"root">(dofs, node<"a">(euler, node<"b">(dofs, mass), node<"c">(mass))));
  breaks<Rule::constraintOnMapped>(node<"root">(dofs,
                                                node<"a">(MechanicalObject<Vec3d>{},
                                                          IdentityMapping<Vec3d, Vec3d>{},
                                                          FixedConstraint<Vec3d>{.indices = {0}})));
  breaks<Rule::noPipeline>(node<"root">(dofs, SphereCollisionModel<Vec3d>{.radius = 1}));
  breaks_typed<Rule::noTetrahedra>(node<"root">(dofs, TetrahedronFEMForceField<Vec3d>{}));
}

/// What joins two states finds both.
void joining_rules() {
  breaks<Rule::noEnd>(node<"root">(Springs{}, node<"a">(dofs)));
  breaks<Rule::endWithoutState>(node<"root">(Springs{}, node<"a">(dofs), node<"b">()));
  breaks<Rule::endOfOtherDataTypes>(node<"root">(Springs{}, node<"a">(dofs), node<"b">(rigid)));
  breaks<Rule::constraintAcrossSolvers>(node<"root">(AttachProjectiveConstraint<Vec3d, Between<"a", "b">>{},
                                                     node<"a">(euler, dofs, mass),
                                                     node<"b">(euler, dofs, mass)));
  breaks_typed<Rule::endsByLinks>(
      node<"root">(StiffSpringForceField<Vec3d, Linked>{}, node<"a">(dofs), node<"b">(dofs)));
  RuntimeNode<Standard> root;
  root.addChild("a").add(dofs);
  root.addChild("b").add(StiffSpringForceField<Vec3d, Linked>{.ends = {"", "/a"}});
  root.find_node("b")->add(dofs);
  says(std::move(root), Rule::endNotBelow);
}

/// A mapping finds its child and its parents, before it and under its solver.
void mapping_rules() {
  const IdentityMapping<Vec3d, Vec3d> identity;
  breaks<Rule::noChild>(node<"root">(dofs, node<"a">(identity)));
  breaks<Rule::noParent>(node<"root">(node<"a">(dofs, identity)));
  breaks<Rule::mappingIn>(node<"root">(rigid, node<"a">(MechanicalObject<Vec3d>{}, identity)));
  breaks<Rule::mappingOut>(node<"root">(dofs, node<"a">(rigid, identity)));
  breaks<Rule::parentsAcrossSolvers>(node<"root">(
      dofs, node<"a">(euler, node<"b">(dofs, mass), node<"c">(MechanicalObject<Vec3d>{}, identity))));
  breaks_typed<Rule::noParentTetrahedra>(
      node<"root">(dofs, node<"a">(MechanicalObject<Vec3d>{}, BarycentricMapping<Vec3d, Vec3d>{})));

  const auto child = node<"c">(MechanicalObject<Vec3d>{}, follow);
  breaks<Rule::noParentNode>(node<"root">(node<"a">(dofs), child));
  breaks<Rule::parentComesLater>(node<"root">(node<"a">(dofs), child, node<"b">(dofs)));
  breaks<Rule::parentWithoutState>(node<"root">(node<"a">(dofs), node<"b">(), child));
  breaks<Rule::parentOfOtherDataTypes>(node<"root">(node<"a">(dofs), node<"b">(rigid), child));
  breaks<Rule::parentOfOtherDataTypes>(node<"root">(
      node<"a">(dofs),
      node<"b">(dofs),
      node<"c">(MechanicalObject<Vec3d>{},
                DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d, Parents<"../a", "../b">>{})));
  breaks<Rule::notTwoParents>(
      node<"root">(node<"a">(dofs),
                   node<"c">(MechanicalObject<Vec3d>{},
                             DeformableOnRigidFrameMapping<Vec3d, Rigid3d, Vec3d, Parents<"../a">>{})));
  breaks_typed<Rule::parentsByLinks>(
      node<"root">(dofs, node<"a">(MechanicalObject<Vec3d>{}, SubsetMultiMapping<Vec3d, Vec3d>{})));
  RuntimeNode<Standard> root;
  root.add(MechanicalObject<Vec3d>{});
  root.add(SubsetMultiMapping<Vec3d, Vec3d>{});
  says(std::move(root), Rule::noParents);
}

/// A solver has something to move, and what it needs for that.
void solver_rules() {
  breaks<Rule::solverBelowSolver>(node<"root">(euler, dofs, mass, node<"a">(euler, dofs, mass)));
  breaks<Rule::nothingToMove>(node<"root">(euler));
  breaks<Rule::besideNoSolver>(node<"root">(DampVelocitySolver{}, dofs, mass));
  breaks<Rule::noLinearSolver>(node<"root">(EulerImplicitSolver{}, dofs, mass));
}

/// Constraints by multipliers are solved by what stands in the root.
void multiplier_rules() {
  const FixedLagrangianConstraint<Vec3d> fixed{.indices = {0}};
  const FreeMotionAnimationLoop loop{};
  const BlockGaussSeidelConstraintSolver gaussSeidel{};
  breaks<Rule::noLoop>(node<"root">(euler, dofs, mass, fixed));
  breaks<Rule::noLoop>(node<"root">(euler,
                                    BilateralLagrangianConstraint<Vec3d, Between<"a", "b">>{},
                                    node<"a">(dofs, mass),
                                    node<"b">(dofs, mass)));
  breaks<Rule::loopNotInRoot>(node<"root">(node<"a">(loop, gaussSeidel)));
  breaks<Rule::noConstraintSolver>(node<"root">(loop, euler, dofs, mass));
  breaks<Rule::severalConstraintSolvers>(
      node<"root">(loop, gaussSeidel, euler, dofs, mass, node<"a">(gaussSeidel)));
  breaks<Rule::secondLoop>(node<"root">(loop, loop, gaussSeidel));
  breaks<Rule::secondLoop>(node<"root">(loop, gaussSeidel, gaussSeidel));
}

}  // namespace

TEST_CASE("what is wrong is said before what has no effect") {
  using Both = decltype(node<"root">(euler, node<"a">(mass)));
  STATIC_REQUIRE(rule<typename Simulation<Both>::Verdict> == Rule::noState);
}

TEST_CASE("each rule is broken by a scene, and both trees say so") {
  node_rules();
  acting_rules();
  joining_rules();
  mapping_rules();
  solver_rules();
  multiplier_rules();
  for (rules::Sentence const& sentence : rules::sentences) {
    CAPTURE(sentence.name);
    CHECK(seen.contains(sentence.rule));
  }
}

}  // namespace test_rules
