// SPDX-License-Identifier: BSL-1.0
// Constraints that cannot be fulfilled, or do not say how: each solver says which component it is about, or
// goes on with finite numbers.
#include "error_of.hpp"
#include "lagrangian/contact_scenes.hpp"

namespace test_bad_constraints {

using namespace sinew;
using Eigen::Vector3d;

namespace {

constexpr double dt = 0.01;

using Fixed = FixedLagrangianConstraint<Vec3d>;
using Joint = BilateralLagrangianConstraint<Vec3d>;

// two points, 1 m above each other, of 2 kg each
template <class Solver, class... Components>
auto two_points(Solver solver, Components... components) {
  return RegistryScene{node<"root">(Gravity{{0, 0, -g}},
                                    FreeMotionAnimationLoop{},
                                    solver,
                                    node<"body">(EulerExplicitSolver{},
                                                 MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {0, 0, -1}}},
                                                 UniformMass<Vec3d>{.totalMass = 4},
                                                 components...))};
}
template <class Sim>
std::string run(Sim& sim, int steps = 20) {
  return error_of([&] {
    sim.init();
    for (int i = 0; i < steps; ++i) sim.animate(dt);
  });
}
template <class State>
bool finite(State const& s) {
  bool all = true;
  for (auto const& x : s.position) all = all && x.allFinite();
  for (auto const& v : s.velocity) all = all && v.allFinite();
  return all;
}

// f(solver) for each, by a list of calls, which a loop cannot be
template <class F>
void each_solver(F&& f) {
  f(BlockGaussSeidelConstraintSolver{});
  f(NNCGConstraintSolver{});
  f(ImprovedJacobiConstraintSolver{});
  f(LCPConstraintSolver{});
  f(LCPConstraintSolver{.mu = 0, .lemke = true});
  f(ConvexConstraintSolver{});
}
// the name of a node as an argument
template <FixedString Name>
struct Named {
  static constexpr FixedString value = Name;
};
template <class Solver>
bool pivots(Solver const& solver) {
  if constexpr (requires { solver.lemke; }) return solver.lemke;
  return false;
}

}  // namespace

TEST_CASE("a constraint between what cannot move names itself, whatever the solver") {
  each_solver([](auto solver) {
    using Solver = decltype(solver);
    INFO(Solver::className);
    auto says = [&](auto... components) {
      auto sim = two_points(solver, components...);
      return run(sim);
    };
    auto names = [](std::string const& message, std::string const& component, std::string const& equation) {
      CHECK_THAT(message,
                 Catch::Contains("/root/body: " + component) && Catch::Contains("equation " + equation) &&
                     Catch::Contains("leave it out"));
    };
    names(says(FixedConstraint<Vec3d>{.indices = {0, 1}}, Joint{.first_point = {0}, .second_point = {1}}),
          "BilateralLagrangianConstraint",
          "0");
    names(says(Joint{.first_point = {1}, .second_point = {1}}), "BilateralLagrangianConstraint", "0");
    // along some of its directions
    names(says(Fixed{.indices = {1}},
               PartialFixedConstraint<Vec3d>{.indices = {0}, .fixedDirections = {0, 1, 0}},
               Fixed{.indices = {0}}),
          "FixedLagrangianConstraint",
          "1");
  });
}

TEST_CASE("a constraint between a body that is held and one that nothing moves names itself") {
  using Contacts = UnilateralLagrangianConstraint<Vec3d, Between<"a", "b">>;
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                   solver,
                                   Contacts{.first_point = {0}, .second_point = {0}, .normal = {{0, 0, 1}}},
                                   node<"a">(EulerExplicitSolver{},
                                             MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                                             UniformMass<Vec3d>{},
                                             FixedConstraint<Vec3d>{.indices = {0}}),
                                   node<"b">(MechanicalObject<Vec3d>{.position = {{0, 0, -1}}}))};
    CHECK_THAT(run(sim),
               Catch::Contains("UnilateralLagrangianConstraint") && Catch::Contains("equation 0") &&
                   Catch::Contains("free a point"));
  });
}

TEST_CASE("a joint between two bodies that are both fixed names itself") {
  auto says = [](auto solver) {
    auto fixed = [&]<class Name>(Name) {
      return node<Name::value>(EulerExplicitSolver{},
                               MechanicalObject<Vec3d>{.position = {{0, 0, 0}}},
                               UniformMass<Vec3d>{},
                               FixedConstraint<Vec3d>{.indices = {0}});
    };
    RegistryScene sim{node<"root">(FreeMotionAnimationLoop{},
                                   solver,
                                   BilateralLagrangianConstraint<Vec3d, Between<"left", "right">>{
                                       .first_point = {0}, .second_point = {0}},
                                   fixed(Named<"left">{}),
                                   fixed(Named<"right">{}))};
    return run(sim, 1);
  };
  auto names = [](std::string const& message) {
    CHECK_THAT(message,
               Catch::StartsWith("/root: BilateralLagrangianConstraint<Vec3d") &&
                   Catch::Contains("its points are fixed") && Catch::Contains("leave it out"));
  };
  names(says(BlockGaussSeidelConstraintSolver{}));
  names(says(ConvexConstraintSolver{}));
}

TEST_CASE("equalities that say the same twice hold, or the solver says which are too many") {
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    auto sim = two_points(solver, Fixed{.indices = {0}}, Fixed{.indices = {0}});
    const std::string message = run(sim);
    auto const& body = sim.template at<"body">().state();
    REQUIRE(finite(body));
    if (pivots(solver)) {
      CHECK_THAT(message,
                 Catch::Contains("3 of the 6 equalities") &&
                     Catch::Contains("the first that depends on others is equation 0 of /root/body: "
                                     "FixedLagrangianConstraint<Vec3d> (2 of 2)"));
    } else {
      CHECK(message.empty());
      auto const& warnings = sim.warnings().list();
      REQUIRE_FALSE(warnings.empty());
      // Jacobi corrects twice what it should, and leaves the point to itself rather than run away
      if (sim.root().template get<decltype(solver)>().result.converged) {
        CHECK(body.position[0].norm() < 1e-5);
        CHECK_THAT(
            warnings[0].text(),
            Catch::StartsWith("step 1 (time 0.01 s), /root: 3 of the equalities") &&
                Catch::Contains("equation 0 of /root/body: FixedLagrangianConstraint<Vec3d> (2 of 2)"));
      } else {
        CHECK(body.position[0][2] == Approx(body.position[1][2] + 1));
        CHECK(warnings.back().what == "the constraints are not solved");
      }
    }
  });
}

TEST_CASE("equalities that contradict each other: who is told to stop names one of them, others go on") {
  const Joint joint{.first_point = {0}, .second_point = {1}, .rest_vector = {{1, 0, 0}}},
      other{.first_point = {0}, .second_point = {1}, .rest_vector = {{2, 0, 0}}};
  each_solver([&](auto solver) {
    INFO(decltype(solver)::className);
    auto sim = two_points(solver, joint, other);
    auto strict = solver;
    strict.stopsUnsolved = true;
    auto stops = two_points(strict, joint, other);
    if (!pivots(solver)) {
      CHECK(run(sim).empty());
      CHECK_FALSE(sim.root().template get<decltype(solver)>().result.converged);
      // the second asks for 2 - 1 m more in x than the first
      auto const& warnings = sim.warnings().list();
      REQUIRE(warnings.size() == 1);
      CHECK(warnings[0].count == 20);
      CHECK(warnings[0].step == 1);
      CHECK(warnings[0].last == 20);
      CHECK_THAT(
          warnings[0].text(),
          Catch::StartsWith("step 1 (time 0.01 s), /root: " +
                            std::string(component_name<decltype(solver)>())) &&
              Catch::Contains("the residual is ") &&
              Catch::Contains(
                  "equation 0 of /root/body: BilateralLagrangianConstraint<Vec3d> (2 of 2) contradicts "
                  "other equalities by 1 m"));
      std::string const& message = warnings[0].message;
      CHECK(message.find("the residual is ") == message.rfind("the residual is "));
      sim.reset();
      CHECK(sim.warnings().list().empty());
    }
    REQUIRE(finite(sim.template at<"body">().state()));
    CHECK_THAT(run(stops),
               Catch::Contains("/root: ") && Catch::Contains("/root/body: BilateralLagrangianConstraint"));
  });
}

TEST_CASE(
    "a point in an inclined plane that is fixed by multipliers, too, is named where W needs its inverse") {
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    auto sim =
        two_points(solver,
                   ProjectToPlaneConstraint<Vec3d>{.indices = {0}, .origin = {0, 0, 0}, .normal = {1, 1, 1}},
                   Fixed{.indices = {0}});
    const std::string message = run(sim);
    REQUIRE(finite(sim.template at<"body">().state()));
    if constexpr (std::is_same_v<decltype(solver), ConvexConstraintSolver>)
      CHECK(message.empty());
    else
      CHECK_THAT(message, Catch::Contains("equation 2 of /root/body: FixedLagrangianConstraint"));
  });
}

TEST_CASE("a constraint on what has diverged names itself") {
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    auto sim = two_points(solver, Joint{.first_point = {0}, .second_point = {1}}, Fixed{.indices = {0}});
    sim.init();
    sim.template at<"body">().state().velocity[0][1] = 1e308;
    CHECK_THAT(
        error_of([&] { sim.animate(100); }),
        Catch::StartsWith("/root/body: BilateralLagrangianConstraint<Vec3d>: its equation 1 is not finite") &&
            Catch::Contains("smaller dt"));
  });
}

TEST_CASE("friction of constraints that is negative or not a number is refused at init") {
  for (const double mu : {-0.1, std::nan("")}) {
    auto says = [&](auto constraint) {
      constraint.mu = {mu};
      auto sim = two_points(BlockGaussSeidelConstraintSolver{}, constraint);
      return error_of([&] { sim.init(); });
    };
    CHECK_THAT(says(UnilateralLagrangianConstraint<Vec3d>{
                   .first_point = {1}, .second_point = {0}, .normal = {{0, 0, 1}}}),
               Catch::Contains("/root/body: UnilateralLagrangianConstraint") && Catch::Contains("mu"));
    CHECK_THAT(says(AugmentedLagrangianConstraint<Vec3d>{
                   .first_point = {1}, .second_point = {0}, .normal = {{0, 0, 1}}}),
               Catch::Contains("/root/body: AugmentedLagrangianConstraint") && Catch::Contains("mu"));
  }
}

TEST_CASE("of several constraints of a class in a node the wrong one is told by its place") {
  auto says = [](auto first, auto second) {
    auto sim = two_points(
        BlockGaussSeidelConstraintSolver{}, first, Joint{.first_point = {0}, .second_point = {1}}, second);
    return error_of([&] { sim.init(); });
  };
  CHECK_THAT(says(Fixed{.indices = {0}}, Fixed{.indices = {2}}),
             Catch::StartsWith("/root/body: FixedLagrangianConstraint<Vec3d> (2 of 2): "));
  CHECK_THAT(says(Fixed{.indices = {2}}, Fixed{.indices = {0}}),
             Catch::StartsWith("/root/body: FixedLagrangianConstraint<Vec3d> (1 of 2): "));
  CHECK_THAT(says(Joint{.first_point = {3}, .second_point = {1}}, Fixed{.indices = {0}}),
             Catch::StartsWith("/root/body: BilateralLagrangianConstraint<Vec3d> (1 of 2): "));
  // one of its class alone needs none
  CHECK_THAT(says(Joint{.first_point = {0}, .second_point = {1}}, Fixed{.indices = {2}}),
             Catch::StartsWith("/root/body: FixedLagrangianConstraint<Vec3d>: "));
}

TEST_CASE("bodies that start in each other are parted, and stay finite") {
  // balls of 0.2 m in the same place but for 1 mm, and one all below the floor
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        0,
        fixed_floor(),
        node<"balls">(EulerExplicitSolver{},
                      MechanicalObject<Vec3d>{
                          .position = {{0, 0, 0.25}, {0, 0.001, 0.25}, {0, 0, 0.251}, {2, 0, -0.05}}},
                      UniformMass<Vec3d>{.vertexMass = 1},
                      SphereCollisionModel<Vec3d>{.selfCollision = true, .radius = 0.2}));
    CHECK(run(sim, 100).empty());
    auto const& x = sim.template at<"balls">().state();
    REQUIRE(finite(x));
    // to the contact distance of 0.01 m and beyond
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(x.position[i][2] > 0.2);
      for (std::size_t k = i + 1; k < 3; ++k) CHECK((x.position[i] - x.position[k]).norm() > 0.41);
    }
    CHECK(x.position[3][2] > 0.2);
    // balls 1 mm apart are in each other by their diameter less that
    std::string all;
    for (auto const& w : sim.warnings().list())
      if (w.what == "they start in each other") all += w.text() + "\n";
    CHECK(
        all ==
        "step 1 (time 0.01 s), /root/floor and /root/balls: they start in each other, by 0.25 m, and will be "
        "driven apart at once; move one of them away\n"
        "step 1 (time 0.01 s), parts of /root/balls: they start in each other, by 0.399 m, and will be "
        "driven "
        "apart at once; move one of them away\n");
  });
}

TEST_CASE("boxes of triangles that start in each other are named, those that touch are not") {
  const std::vector<Vector3d> corners{
      {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  // two-sided surfaces: points do not say how deep they are
  auto warnings = [&](Vector3d const& apart, long step) {
    std::vector<Vector3d> moved = corners;
    for (auto& x : moved) x += apart;
    MeshTopology surface;
    surface.triangles = blockSurface;
    auto box = [&]<class Name>(Name, std::vector<Vector3d> const& at) {
      return node<Name::value>(EulerExplicitSolver{},
                               surface,
                               MechanicalObject<Vec3d>{at},
                               UniformMass<Vec3d>{.vertexMass = 1},
                               TriangleCollisionModel<Vec3d>{});
    };
    auto sim = constrained_scene_by(BlockGaussSeidelConstraintSolver{},
                                    near_by(),
                                    0,
                                    box(Named<"left">{}, corners),
                                    box(Named<"right">{}, moved));
    sim.init(0.1, step);
    sim.animate(dt);
    std::string all;
    for (auto const& w : sim.warnings().list()) all += w.text();
    return all;
  };
  CHECK(warnings({0.9, 0.3, 0.2}, 0) ==
        "step 1 (time 0.11 s), /root/left and /root/right: they start in each other, and will be driven "
        "apart at "
        "once; move one of them away");
  CHECK(warnings({1, 0.3, 0.2}, 0).empty());
  CHECK(warnings({1, 0, 0}, 0).empty());
  // what goes on from a checkpoint does not start
  CHECK(warnings({0.9, 0.3, 0.2}, 7).empty());
}

TEST_CASE(
    "a scene whose constraints are solved warns of nothing, and one that is not solved once of each thing") {
  each_solver([](auto solver) {
    INFO(decltype(solver)::className);
    auto sim = two_points(solver, Fixed{.indices = {0}}, Joint{.first_point = {0}, .second_point = {1}});
    CHECK(run(sim).empty());
    CHECK(sim.warnings().list().empty());
  });
  StepWarnings warnings;
  int made = 0;
  auto warn = [&](long step, std::string const& where) {
    warnings.add(step, double(step), where, "it is so", [&] { return ++made, std::string("it is so by 3"); });
  };
  for (const long step : {1, 2, 2, 5}) warn(step, "here");
  warn(5, "there");
  REQUIRE(warnings.list().size() == 2);
  CHECK(made == 2);
  CHECK(warnings.list()[0].text() == "step 1 (time 1 s), here: it is so by 3");
  CHECK(warnings.list()[0].summary() == "here: it is so in 3 steps, from step 1 to 5");
  for (std::size_t i = 2; i < StepWarnings::capacity + 3; ++i) warn(6, text("place ", i));
  CHECK(warnings.list().size() == StepWarnings::capacity);
  CHECK(warnings.leftOut() == 3);
}

TEST_CASE("who does not converge on contacts, and is told to stop, names the bodies") {
  auto heap = [](auto solver) {
    solver.stopsUnsolved = true;
    auto sim = constrained_scene_by(
        solver,
        near_by(),
        0.5,
        fixed_floor(),
        node<"balls">(
            EulerExplicitSolver{},
            MechanicalObject<Vec3d>{.position = {{0, 0, 0.2}, {0, 0, 0.59}, {0, 0, 0.98}, {0, 0, 1.37}}},
            UniformMass<Vec3d>{.vertexMass = 1},
            SphereCollisionModel<Vec3d>{.selfCollision = true, .radius = 0.2}));
    return run(sim, 3);
  };
  const auto names = [](std::string const& message) {
    CHECK_THAT(message, Catch::Contains("not solved after") && Catch::Contains("of the contact of /root/"));
  };
  names(heap(BlockGaussSeidelConstraintSolver{.maxIterations = 1, .tolerance = 1e-12}));
  names(heap(NNCGConstraintSolver{.maxIterations = 1, .tolerance = 1e-12}));
  names(heap(ImprovedJacobiConstraintSolver{.maxIterations = 1, .tolerance = 1e-12}));
  names(heap(LCPConstraintSolver{.maxIterations = 1, .tolerance = 1e-12}));
  names(heap(ConvexConstraintSolver{.maxUpdates = 1, .maxIterations = 1}));
}

}  // namespace test_bad_constraints
