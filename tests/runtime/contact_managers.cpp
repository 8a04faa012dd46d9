// SPDX-License-Identifier: BSL-1.0
// A contact manager of one's own beside the default one, in one registry, each by its name.
#include <sinew/collision/brute_force_broad_phase.hpp>
#include <sinew/collision/bvh_narrow_phase.hpp>
#include <sinew/collision/contact_manager.hpp>
#include <sinew/collision/default_pipeline.hpp>
#include <sinew/collision/min_proximity_intersection.hpp>
#include <sinew/collision/sphere_collision_model.hpp>
#include <sinew/context/gravity.hpp>
#include <sinew/core/registry.hpp>
#include <sinew/lagrangian/block_gauss_seidel_constraint_solver.hpp>
#include <sinew/lagrangian/free_motion_animation_loop.hpp>
#include <sinew/mass/uniform_mass.hpp>
#include <sinew/runtime/read_scene.hpp>
#include <sinew/runtime/runtime.hpp>
#include <sinew/runtime/save_scene.hpp>
#include <sinew/solver/cg_linear_solver.hpp>
#include <sinew/solver/euler_implicit.hpp>
#include <sinew/state/mechanical_object.hpp>

#include "catch.hpp"

namespace test_contact_managers {

using namespace sinew;

namespace {

/// Pushes with 1 N, however deep.
struct ConstantContact {
  static constexpr std::string_view className = "ConstantContact";
  static constexpr std::string_view managerName = "ConstantContactManager";

  void evaluate(Contact& c, Eigen::Vector3d const&, Eigen::Vector3d const&) const {
    c.evaluated = c.normal;
    c.stiffnessMatrix.setZero();
    c.dampingMatrix.setZero();
  }
  void settle(Contact&, Eigen::Vector3d const&) const {}
};
using ConstantContactManager = ContactManager<PenalityContactForceField, ConstantContact>;

struct Mine
    : Registry<Gravity, DefaultPipeline, BruteForceBroadPhase, BVHNarrowPhase, MinProximityIntersection,
               DefaultContactManager, ConstantContactManager, EulerImplicitSolver, CGLinearSolver<>,
               MechanicalObject<Vec3d>, UniformMass<Vec3d>, SphereCollisionModel<Vec3d>,
               FreeMotionAnimationLoop, BlockGaussSeidelConstraintSolver> {};

// two balls of 2 kg, 0.9 m apart and 1 m wide
std::string balls(std::string const& manager) {
  return R"(<Node name="root" gravity="0 0 0"><DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/>
    <MinProximityIntersection alarmDistance="0.2" contactDistance="0.1"/><)" +
         manager + R"(/>
    <Node name="balls"><EulerImplicitSolver/><CGLinearSolver iterations="25" tolerance="1e-12" threshold="0"/>
      <MechanicalObject template="Vec3d" position="0 0 0  0.9 0 0"/><UniformMass vertexMass="2"/>
      <SphereCollisionModel selfCollision="true" radius="0.5" contactStiffness="10"/></Node></Node>)";
}

// speed of the second ball after one step of 0.01 s
double pushed(Simulation<RuntimeNode<Mine>>& sim) {
  sim.init();
  sim.animate(0.01);
  return sim.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->velocity[1][0];
}

}  // namespace

static_assert(DefaultContactManager::className == "DefaultContactManager");
static_assert(ConstantContactManager::className == "ConstantContactManager");

TEST_CASE("a registry holds the default contact manager and one of one's own, each by its name") {
  // k = 10 * 10 / (0.1 + 2 * 0.5) N/m is pressed by 0.2 m: each ball of m moves by v h, the two by 2 v h,
  // m v = h (k d - 2 k h v)
  const double k = 100 / 1.1, h = 0.01;
  for (std::string const name : {"DefaultContactManager", "CollisionResponse"}) {
    Simulation byDefault{parse_scene<Mine>("balls.scn", balls(name)).root};
    CHECK(pushed(byDefault) == Approx(h * k * 0.2 / (2 + 2 * k * h * h)).epsilon(1e-9));
  }
  Simulation own{
      parse_scene<Mine>("balls.scn", balls(R"(ConstantContactManager response="ConstantContact")")).root};
  CHECK(pushed(own) == Approx(h * 1 / 2).epsilon(1e-9));
  CHECK(own.root().get<ConstantContactManager>());
  CHECK_FALSE(own.root().get<DefaultContactManager>());
  Simulation same{parse_scene<Mine>("balls.scn", balls(R"(ConstantContactManager response="default")")).root};
  CHECK(pushed(same) == Approx(h * k * 0.2 / (2 + 2 * k * h * h)).epsilon(1e-9));
}

TEST_CASE("a contact manager of one's own is saved under its name, and read again") {
  Simulation sim{
      parse_scene<Mine>("balls.scn", balls(R"(ConstantContactManager response="ConstantContact")")).root};
  pushed(sim);
  const std::string saved = scene_text(sim, 0.01);
  CHECK_THAT(saved, Catch::Contains("<ConstantContactManager"));
  CHECK_THAT(saved, !Catch::Contains("DefaultContactManager"));
  Simulation again{parse_scene<Mine>("saved.scn", saved).root};
  again.init();
  sim.animate(0.01), again.animate(0.01);
  CHECK(again.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->velocity ==
        sim.root().find_node("balls")->get<MechanicalObject<Vec3d>>()->velocity);
}

TEST_CASE("the default contact manager does not know the response of another one, and names what it has") {
  Simulation sim{
      parse_scene<Mine>("balls.scn", balls(R"(DefaultContactManager response="ConstantContact")")).root};
  CHECK_THROWS_WITH(sim.init(),
                    Catch::Contains("'ConstantContact'") && Catch::Contains("StickContactForceField"));
}

TEST_CASE("more contacts in a step than are allowed end it with the models named, and change nothing") {
  std::string three = balls("DefaultContactManager maximumContacts='1'");
  three.replace(three.find("0.9 0 0"), 7, "0.9 0 0  1.8 0 0");
  Simulation sim{parse_scene<Mine>("balls.scn", three).root};
  sim.init();
  auto& state = *sim.root().find_node("balls")->get<MechanicalObject<Vec3d>>();
  const auto before = state.position;
  CHECK_THROWS_WITH(sim.animate(0.01),
                    Catch::Contains("DefaultContactManager") && Catch::Contains("more than 1 contacts") &&
                        Catch::Contains("parts of /root/balls") && Catch::Contains("raise maximumContacts"));
  CHECK(state.position == before);
  CHECK(sim.time() == 0);

  state.position[2][0] = 10;  // only the first two touch now, as without the third
  sim.animate(0.01);
  Simulation two{parse_scene<Mine>("balls.scn", balls("DefaultContactManager maximumContacts='1'")).root};
  CHECK(state.velocity[1][0] == Approx(pushed(two)).epsilon(1e-9));

  Simulation none{parse_scene<Mine>("balls.scn", balls("DefaultContactManager maximumContacts='2'")).root};
  none.root().get<DefaultContactManager>()->maximumContacts = 0;
  CHECK_THROWS_WITH(none.init(), Catch::Contains("maximumContacts"));
}

// a ball of 2 kg that slides at 4 m/s over a fixed one of 1000 m, which it touches
std::string sliding(std::string const& manager, std::string const& model = "",
                    std::string const& loop = "<FreeMotionAnimationLoop/>") {
  return "<Node name='root' gravity='0 0 -10'>" + loop +
         R"(<BlockGaussSeidelConstraintSolver tolerance="1e-13"/>
    <DefaultPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/>
    <MinProximityIntersection alarmDistance="0.2" contactDistance="0.1"/><)" +
         manager + R"(/>
    <Node name="ground"><MechanicalObject template="Vec3d" position="0 0 -1000"/>
      <SphereCollisionModel name="earth" radius="1000" simulated="false" moving="false"/></Node>
    <Node name="thing"><EulerImplicitSolver/><CGLinearSolver iterations="25" tolerance="1e-14" threshold="0"/>
      <MechanicalObject template="Vec3d" position="0 0 0.6" velocity="4 0 0"/><UniformMass vertexMass="2"/>
      <SphereCollisionModel name="ball" radius="0.5" )" +
         model + "/></Node></Node>";
}
// by how much it has become slower in ten steps of 0.01 s, which with g = 10 m/s^2 is the friction
double friction_of(std::string const& xml) {
  Simulation sim{parse_scene<Mine>("sliding.scn", xml).root};
  sim.init();
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  return 4 - sim.root().find_node("thing")->get<MechanicalObject<Vec3d>>()->velocity[0][0];
}

TEST_CASE("scene files say responses by multipliers, their friction, and rules, as SOFA's do") {
  // the curved ground takes v^2 / r of gravity, 0.16 % of it
  auto is = [](double mu) { return Approx(mu).epsilon(3e-3); };
  auto of = [](std::string const& manager, std::string const& model = "") {
    return friction_of(sliding(manager, model));
  };
  CHECK(of("CollisionResponse response='FrictionContactConstraint' responseParams='mu=0.5'") == is(0.5));
  CHECK(of("DefaultContactManager response='FrictionContact'") == is(0.8));
  CHECK(of("DefaultContactManager response='FrictionContact'",
           "contactResponse='FrictionContactConstraint?mu=0.3'") == is(0.3));
  const std::string byRules = "RuleBasedContactManager response='FrictionContactConstraint' rules='";
  CHECK(of(byRules + "default'") == is(0.8));
  CHECK(of(byRules + "earth ball FrictionContactConstraint?mu=0.2'") == is(0.2));
  CHECK(of(byRules + "ball * StickContactConstraint'") == is(4));
  CHECK_THROWS_WITH(
      friction_of(sliding("DefaultContactManager response='FrictionContactConstraint'", "", "")),
      Catch::Contains("FreeMotionAnimationLoop"));
  CHECK_THROWS_WITH(of("DefaultContactManager response='FrictionContactConstraint' responseParams='mu=-1'"),
                    Catch::Contains("coefficient of friction"));
  // SOFA's augmented Lagrangian: the same contact, without friction where none is given
  const std::string augmented = "DefaultContactManager response='AugmentedLagrangianResponseConstraint'";
  CHECK(of(augmented + " responseParams='mu=0.5&amp;epsilon=10'") == is(0.5));
  CHECK(std::abs(of(augmented)) < 3e-3);
  CHECK(of(byRules + "earth ball AugmentedLagrangianResponseConstraint?epsilon=2&amp;mu=0.2'") == is(0.2));
  CHECK_THROWS_WITH(of(augmented + " responseParams='epsilon=-1'"), Catch::Contains("penalty"));
  CHECK_THROWS_WITH(
      of("DefaultContactManager response='FrictionContactConstraint' responseParams='epsilon=1'"),
      Catch::Contains("has no parameter 'epsilon'"));
}

TEST_CASE("contacts by multipliers go on from a checkpoint with the same bits") {
  for (const std::string response : {"FrictionContactConstraint", "StickContactConstraint"}) {
    INFO(response);
    // with a tolerance at which the first guess shows
    std::string xml = sliding("DefaultContactManager response='" + response + "'");
    xml.replace(xml.find("1e-13"), 5, "1e-5");
    Simulation sim{parse_scene<Mine>("sliding.scn", xml).root};
    sim.init();
    for (int i = 0; i < 5; ++i) sim.animate(0.01);
    const std::string saved = scene_text(sim, 0.01);
    CHECK_THAT(saved, Catch::Contains("<FreeMotionAnimationLoop"));
    Simulation again{parse_scene<Mine>("saved.scn", saved).root};
    again.init(sim.time(), sim.step());
    for (int i = 0; i < 5; ++i) sim.animate(0.01), again.animate(0.01);
    auto state = [](auto& s) { return s.root().find_node("thing")->template get<MechanicalObject<Vec3d>>(); };
    CHECK(state(again)->position == state(sim)->position);
    CHECK(state(again)->velocity == state(sim)->velocity);
  }
}

}  // namespace test_contact_managers
