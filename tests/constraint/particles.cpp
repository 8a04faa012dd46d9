// SPDX-License-Identifier: BSL-1.0
// Sources and sinks of particles: how many there are, where and how fast, against closed forms.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/constraint/particle_sink.hpp>
#include <sinew/constraint/particle_source.hpp>
#include <sinew/control/threads.hpp>
#include <sinew/control/write_state.hpp>
#include <sinew/lagrangian.hpp>
#include <sinew/mechanics.hpp>
#include <sinew/solver/dfsph.hpp>

#include <cmath>
#include <limits>

namespace test_particles {

using namespace sinew;
using Catch::Contains;
using Source = ParticleSource<Vec3d>;
using Sink = ParticleSink<Vec3d>;

namespace {

template <class... Components>
auto scene(Eigen::Vector3d const& gravity, Components... components) {
  return Simulation{node<"root">(Gravity{gravity}, node<"drops">(std::move(components)...))};
}
auto& state_of(auto& simulation) { return simulation.template at<"drops">().state(); }

const Eigen::Vector3d none = Eigen::Vector3d::Zero(), down(0, -10, 0);

}  // namespace

TEST_CASE("a source gives as many particles as its rate times the time, each where it has moved to since") {
  const double dt = 0.01, delay = 0.07, start = 0.25, stop = 1.05;
  const Eigen::Vector3d velocity(0.3, -2, 0.1), shift(1, 2, 3), radius(0.1, 0.2, 0.3);
  const std::vector<Eigen::Vector3d> center{{0, 0, 0}, {1, 0, 0}, {0, 0, 2}};
  auto sim = scene(none,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{9, 9, 9}}},
                   UniformMass<Vec3d>{.vertexMass = 0.5},
                   Source{.translation = shift,
                          .scale = 2,
                          .center = center,
                          .radius = radius,
                          .velocity = velocity,
                          .delay = delay,
                          .start = start,
                          .stop = stop,
                          .addNoise = false});
  sim.init();
  auto& state = state_of(sim);
  for (int i = 0; i < 150; ++i) {
    sim.animate(dt);
    const double begin = i * dt, end = begin + dt;
    // one at t_k = start + k delay, seen in the first step that begins no earlier
    const int batches =
        begin + 1e-9 < start ? 0 : 1 + int(std::floor((std::min(begin, stop) - start) / delay + 1e-9));
    REQUIRE(state.size() == 1 + center.size() * std::size_t(batches));
    CHECK(state.position[0] == Eigen::Vector3d(9, 9, 9));
    Eigen::Vector3d momentum = none;
    for (auto const& v : state.velocity) momentum += 0.5 * v;
    // sums of n numbers
    CHECK((momentum - 0.5 * 3 * batches * velocity).norm() <= 1e-12 * (1 + momentum.norm()));
    for (int k = 0; k < batches; ++k)
      for (std::size_t c = 0; c < center.size(); ++c) {
        const Eigen::Vector3d x = 2 * center[c] + shift + radius + velocity * (end - start - k * delay);
        CHECK((state.position[1 + std::size_t(k) * 3 + c] - x).norm() < 1e-12);
      }
  }
  CHECK(sim.root().children[hana::size_c<0>].get<Source>().batches == 12);  // (1.05 - 0.25) / 0.07 = 11.4
}

TEST_CASE("as in SOFA a source without start waits for one delay, and its newest are a piston") {
  // each time that one comes, half of those held go: 1, then 0 + 1, then 0 + 1
  auto sim = scene(down,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{},
                   UniformMass<Vec3d>{.vertexMass = 1},
                   Source{.velocity = {0, -1, 0}, .delay = 0.1, .start = -5, .stop = 0.3});
  sim.init();
  auto& state = state_of(sim);
  CHECK(state.size() == 0);
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  CHECK(state.size() == 0);  // the step that begins at 0.1 is the next
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  REQUIRE(state.size() == 1);
  CHECK(state.velocity[0][1] == -1);
  CHECK(state.position[0][1] == Approx(-0.1));
  for (int i = 0; i < 10; ++i) sim.animate(0.01);
  REQUIRE(state.size() == 2);
  CHECK(state.velocity[0][1] == Approx(-1 - 10 * 0.1));  // falls since the second has come
  CHECK(state.velocity[1][1] == -1);
  for (int i = 0; i < 2; ++i) sim.animate(0.01);  // at 0.3 the third comes, at 0.31 all are let go
  REQUIRE(state.size() == 3);
  CHECK(state.velocity[2][1] == Approx(-1 - 10 * 0.01));
}

TEST_CASE("noise is even between the centre and the radius") {
  auto sim = scene(none,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{},
                   UniformMass<Vec3d>{},
                   Source{.center = std::vector<Eigen::Vector3d>(100, none),
                          .radius = {1, 2, 0},
                          .delay = 0.01,
                          .capacity = 10000});
  sim.init();
  for (int i = 0; i < 101; ++i) sim.animate(0.01);
  auto const& x = state_of(sim).position;
  REQUIRE(x.size() == 10000);
  Eigen::Vector3d mean = none, square = none;
  for (auto const& p : x) {
    CHECK((p.array() >= 0).all());
    CHECK((p[0] < 1 && p[1] < 2 && p[2] == 0));
    mean += p / 10000;
    square += p.cwiseAbs2() / 10000;
  }
  // within five standard errors: 5 / sqrt(12 n)
  CHECK(std::abs(mean[0] - 0.5) < 0.0145);
  CHECK(std::abs(mean[1] - 1) < 0.029);
  CHECK(std::abs(square[0] - 1. / 3) < 0.02);
  CHECK(x[0] != x[1]);
  CHECK(x[0] != x[100]);
}

TEST_CASE("what comes is what goes and what is there") {
  auto sim = scene(down,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{0, 1, 0}, {0, -3, 0}, {0, 2, 0}}},
                   UniformMass<Vec3d>{.vertexMass = 0.1},
                   Sink{.d0 = -5, .d1 = -1},
                   Source{.center = {{0, 0, 0}, {1, 0, 0}},
                          .radius = {0.1, 0.1, 0.1},
                          .velocity = {0, -1, 0},
                          .delay = 0.013,
                          .stop = 1,
                          .capacity = 120});
  sim.init();
  auto& state = state_of(sim);
  auto& node = sim.root().children[hana::size_c<0>];
  sim.animate(0.01);
  REQUIRE(state.size() == 2);  // the one behind the sink has gone, the others keep their order
  CHECK(state.position[0][1] == Approx(1).margin(1e-2));
  CHECK(state.position[1][1] == Approx(2).margin(1e-2));
  for (int i = 0; i < 100; ++i) {
    sim.animate(0.01);
    CHECK(node.get<Source>().batches * 2 + 3 == node.get<Sink>().removed + int(state.size()));
    for (std::size_t p = 0; p < state.size(); ++p)
      CHECK(state.position[p][1] >
            -1 + 0.01 * state.velocity[p][1] - 1e-12);  // no more than a step behind it
  }
  CHECK(node.get<Source>().batches == 76);  // 1 / 0.013 = 76.9
  CHECK(sim.kineticEnergy() > 0);
  for (int i = 0; i < 100; ++i) sim.animate(0.01);
  CHECK(state.size() == 0);
  CHECK(node.get<Sink>().removed == 155);
  CHECK(sim.kineticEnergy() == 0);
}

TEST_CASE("points behind the first plane of a sink creep by the step of their force") {
  const double h = 0.01;
  auto sim = scene(down,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{0, -0.5, 0}}, .velocity = {{0, -7, 0}}},
                   UniformMass<Vec3d>{},
                   Sink{.d0 = 0, .d1 = -0.5055});
  sim.init();
  auto& state = state_of(sim);
  CHECK(state.velocity[0] == none);
  for (int i = 1; i <= 5; ++i) {
    sim.animate(h);
    CHECK(state.velocity[0] == none);
    CHECK(state.position[0][1] == Approx(-0.5 - i * 10 * h * h));
  }
  sim.animate(h);  // behind d1 after this one: at -0.506
  CHECK(state.size() == 1);
  sim.animate(h);
  CHECK(state.size() == 0);
}

namespace {

/// Drops of a fluid on a floor, from two sources, with a sink beside it.
template <class... Solvers>
auto bleeding(int threads, Solvers... solvers) {
  std::vector<Eigen::Vector3d> center;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k) center.push_back({0.05 * i, 0, 0.05 * k});
  return Simulation{node<"root">(
      Gravity{down},
      Threads{threads},
      node<"drops">(
          solvers...,
          MechanicalObject<Vec3d>{},
          UniformMass<Vec3d>{.vertexMass = 0.1},
          SPHFluidForceField<Vec3d>{.radius = 0.1,
                                    .mass = 0.1,
                                    .pressure = 10,
                                    .density = 1000,
                                    .viscosity = 1,
                                    .kernelType = 1,
                                    .viscosityType = 2},
          PlaneForceField<Vec3d>{.d = -0.3, .stiffness = 5000},
          SphereForceField<Vec3d>{.center = {0.1, -0.3, 0.1}, .radius = 0.1},
          UniformVelocityDampingForceField<Vec3d>{},
          Source{.center = center, .radius = {0.01, 0.01, 0.01}, .velocity = {0, -1, 0}, .delay = 0.05},
          Source{.translation = {0.5, 0, 0},
                 .center = center,
                 .radius = {0.01, 0.01, 0.01},
                 .velocity = {1, -1, 0},
                 .delay = 0.04},
          Sink{.normal = {-1, 0, 0}, .d0 = -9, .d1 = -0.9}))};
}
auto bits(auto& simulation) {
  auto& s = state_of(simulation);
  return std::tuple(s.position, s.velocity, s.restPosition, simulation.kineticEnergy());
}

template <class... Solvers>
void resets_and_repeats(Solvers... solvers) {
  auto sim = bleeding(1, solvers...);
  sim.init();
  for (int i = 0; i < 60; ++i) sim.animate(0.01);
  const auto first = bits(sim);
  auto& node = sim.root().children[hana::size_c<0>];
  CHECK(node.template get<Sink>().removed > 20);
  CHECK(state_of(sim).size() > 300);
  sim.reset();
  CHECK(state_of(sim).size() == 0);
  CHECK(state_of(sim).velocity.empty());
  for (int i = 0; i < 60; ++i) sim.animate(0.01);
  CHECK(bits(sim) == first);
  // a copy goes on alone
  auto copy = sim;
  for (int i = 0; i < 20; ++i) sim.animate(0.01), copy.animate(0.01);
  CHECK(bits(sim) == bits(copy));
  auto threaded = bleeding(3, solvers...);
  threaded.init();
  for (int i = 0; i < 80; ++i) threaded.animate(0.01);
  CHECK(bits(sim) == bits(threaded));
}

}  // namespace

TEST_CASE("sources and sinks repeat after a reset, in copies and with any number of threads", "[threads]") {
  SECTION("explicit") { resets_and_repeats(EulerExplicitSolver{}); }
  SECTION("implicit") { resets_and_repeats(EulerImplicitSolver{}, CGLinearSolver<>{}); }
  SECTION("of several stages") { resets_and_repeats(RungeKutta4Solver{}); }
  SECTION("with a history") { resets_and_repeats(NewmarkImplicitSolver{}, CGLinearSolver<>{}); }
}

TEST_CASE("where a source meets a full state, nothing before it has counted what did not change") {
  // Each of two sources has one particle at 0.1 s. At 0.2 s the first has room, the second none.
  const Source first{.velocity = {0, -1, 0}, .delay = 0.1, .capacity = 5};
  Source second = first;
  second.center = {{3, 0, 0}};
  auto sim = scene(none,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{6, 0, 0}, {9, 0, 0}}},
                   UniformMass<Vec3d>{},
                   first,
                   second);
  sim.init();
  for (int i = 0; i < 20; ++i) sim.animate(0.01);
  auto counts = [&] {
    std::vector<int> all{int(state_of(sim).size())};
    sim.root().children[hana::size_c<0>].forEachComponent(on<role::ProjectiveConstraint>([&](Source& source) {
      all.push_back(source.batches);
      all.insert(all.end(), source.held.begin(), source.held.end());
    }));
    return all;
  };
  CHECK(counts() == std::vector<int>{4, 1, 2, 1, 3});
  for (int k = 0; k < 2; ++k) {
    CHECK_THAT(error_of([&] { sim.animate(0.01); }), Contains("capacity of 5"));
    CHECK(counts() == std::vector<int>{4, 1, 2, 1, 3});
  }

  // nor has a sink
  auto sink = scene(
      none,
      EulerExplicitSolver{},
      MechanicalObject<Vec3d>{.position = {{6, 0, 0}}, .velocity = {{0, -1, 0}}},
      UniformMass<Vec3d>{},
      Sink{.d0 = -9, .d1 = -0.195},
      Source{
          .center = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, .velocity = {0, 1, 0}, .delay = 0.2, .capacity = 2});
  sink.init();
  for (int i = 0; i < 20; ++i) sink.animate(0.01);
  CHECK_THAT(error_of([&] { sink.animate(0.01); }), Contains("capacity of 2"));
  CHECK(sink.root().children[hana::size_c<0>].get<Sink>().removed == 0);
  CHECK(state_of(sink).size() == 1);
}

TEST_CASE("a source says when its state is full, and a sink makes room") {
  const Source source{.velocity = {0, -1, 0}, .delay = 0.1, .capacity = 3};
  auto full = scene(none, EulerExplicitSolver{}, MechanicalObject<Vec3d>{}, UniformMass<Vec3d>{}, source);
  full.init();
  for (int i = 0; i < 40; ++i) full.animate(0.01);
  CHECK(state_of(full).size() == 3);
  CHECK_THAT(error_of([&] { full.animate(0.01); }),
             Contains("/root/drops: ParticleSource<Vec3d>") && Contains("capacity of 3") &&
                 Contains("raise capacity") && Contains("ParticleSink"));
  CHECK(state_of(full).size() == 3);  // nothing has changed
  CHECK(state_of(full).position.size() == 3);
  auto open = scene(none,
                    EulerExplicitSolver{},
                    MechanicalObject<Vec3d>{},
                    UniformMass<Vec3d>{},
                    Sink{.d0 = -9, .d1 = -0.25},
                    source);
  open.init();
  for (int i = 0; i < 400; ++i) open.animate(0.01);
  CHECK(state_of(open).size() == 2);  // of 39 that have come those of 3.8 and 3.9 s, less than 0.25 m away
}

TEST_CASE("a total mass is that of the points there are at the start, and what a point weighs stays") {
  auto sim = scene(none,
                   EulerExplicitSolver{},
                   MechanicalObject<Vec3d>{.position = {{0, 5, 0}, {0, 6, 0}}},
                   UniformMass<Vec3d>{.totalMass = 3},
                   Source{.velocity = {0, 2, 0}, .delay = 0.1});
  sim.init();
  for (int i = 0; i < 41; ++i) sim.animate(0.01);
  CHECK(state_of(sim).size() == 6);
  CHECK(sim.kineticEnergy() == Approx(4 * 0.5 * 1.5 * 2 * 2));
}

TEST_CASE("what is wrong with a source or a sink is said") {
  auto wrong = [](auto c) {
    auto sim = scene(none,
                     EulerExplicitSolver{},
                     MechanicalObject<Vec3d>{.position = {{0, 0, 0}, {1, 0, 0}}},
                     UniformMass<Vec3d>{},
                     c);
    return error_of([&] { sim.init(); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Vector3d v(0, -1, 0);
  CHECK(wrong(Source{.velocity = v}).empty());
  CHECK_THAT(wrong(Source{}), Contains("velocity is 0 and so is the radius"));
  CHECK_THAT(wrong(Source{.radius = {1, 1, 1}, .addNoise = false}), Contains("velocity is 0"));
  CHECK_THAT(wrong(Source{.radius = {1, -1, 1}, .velocity = v}), Contains("radius has a negative"));
  CHECK_THAT(wrong(Source{.velocity = v, .delay = -1}), Contains("delay"));
  CHECK_THAT(wrong(Source{.velocity = v, .delay = 0}), Contains("delay"));
  CHECK_THAT(wrong(Source{.velocity = v, .delay = nan}), Contains("delay"));
  CHECK_THAT(wrong(Source{.velocity = v, .capacity = 0}), Contains("capacity"));
  CHECK_THAT(wrong(Source{.velocity = v, .capacity = 2000000000}),
             Contains("capacity") && Contains("would take"));
  CHECK_THAT(wrong(Source{.velocity = v, .capacity = 1}), Contains("starts with 2 points"));
  CHECK_THAT(wrong(Source{.velocity = {0, nan, 0}}), Contains("velocity") && Contains("finite number"));
  CHECK_THAT(wrong(Source{.translation = {nan, 0, 0}, .velocity = v}), Contains("translation"));
  CHECK_THAT(wrong(Source{.scale = nan, .velocity = v}), Contains("scale"));
  CHECK_THAT(wrong(Source{.radius = {nan, 0, 0}, .velocity = v}), Contains("radius"));
  CHECK_THAT(wrong(Source{.velocity = v, .start = nan}), Contains("start"));
  CHECK_THAT(wrong(Source{.velocity = v, .stop = nan}), Contains("stop"));
  CHECK_THAT(wrong(Source{.velocity = v, .start = 2, .stop = 1}), Contains("put stop behind start"));
  CHECK_THAT(wrong(Source{.center = {}, .velocity = v}), Contains("center is empty"));
  CHECK_THAT(wrong(Source{.center = {v, {0, nan, 0}}, .velocity = v}), Contains("center[1]"));
  CHECK_THAT(wrong(Sink{.normal = none}), Contains("/root/drops: ParticleSink<Vec3d>") && Contains("normal"));
  CHECK_THAT(wrong(Sink{.normal = {0, nan, 0}}), Contains("normal"));
  CHECK_THAT(wrong(Sink{.d0 = nan}), Contains("finite"));
  CHECK_THAT(wrong(Sink{.d1 = nan}), Contains("finite"));
}

TEST_CASE("an incompressible fluid whose points come is that of one that has them, and is not compressed") {
  // half of a block falls for a step; then the other half comes, which its source lets go after a step
  std::vector<Eigen::Vector3d> half, rest;
  const double d = 0.05, mass = 1000 * d * d * d, dt = 0.002;
  for (int i = 0; i < 128; ++i)
    (i < 64 ? half : rest).push_back(d * Eigen::Vector3d(i % 4 + 0.5, i / 32 + 0.5, i / 4 % 8 + 0.5));
  auto fluid = [&](auto const& points, auto const& velocities, auto... more) {
    return scene(down,
                 DFSPHSolver{.radius = 2 * d},
                 MechanicalObject<Vec3d>{.position = points, .velocity = velocities},
                 UniformMass<Vec3d>{.vertexMass = mass},
                 PlaneForceField<Vec3d>{.normal = {0, 1, 0}, .d = 0, .stiffness = 500},
                 more...);
  };
  auto solver_of = [](auto& sim) -> auto& { return sim.template at<"drops">().template get<DFSPHSolver>(); };
  auto falling = [](std::size_t n) { return std::vector<Eigen::Vector3d>(n, Eigen::Vector3d(0, -1, 0)); };
  const Source source{.center = rest,
                      .velocity = {0, -1, 0},
                      .delay = dt,
                      .start = dt,
                      .stop = dt,
                      .addNoise = false,
                      .capacity = 200};
  auto coming = fluid(half, falling(64), source);
  auto fromNone = fluid(std::vector<Eigen::Vector3d>{}, falling(0), source);
  for (auto* sim : {&coming, &fromNone}) {
    sim->init();
    sim->animate(dt);
  }
  CHECK(state_of(fromNone).size() == 0);
  coming.animate(dt);
  REQUIRE(state_of(coming).size() == half.size() + rest.size());
  auto atOnce = fluid(state_of(coming).position, state_of(coming).velocity);
  atOnce.init();
  solver_of(atOnce).pressures = solver_of(coming).pressures;
  solver_of(atOnce).pressuresV = solver_of(coming).pressuresV;
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    atOnce.animate(dt);
    coming.animate(dt);
    fromNone.animate(dt);
    REQUIRE(state_of(coming).position == state_of(atOnce).position);
    REQUIRE(state_of(fromNone).size() == rest.size());
    worst = std::max(worst, solver_of(coming).ofDensity.error);
  }
  CHECK(worst <= 1e-4);
  coming.reset();
  CHECK(state_of(coming).size() == half.size());
  for (int i = 0; i < 102; ++i) coming.animate(dt);
  CHECK(state_of(coming).position == state_of(atOnce).position);
}

TEST_CASE("points of an incompressible fluid go with their pressures") {
  DFSPHSolver one;
  one.pressures = one.pressuresV = {1, 2, 3, 4};
  one.followPoints(Renumbering::of({true, false, true, true}), 5);
  CHECK(one.pressures == std::vector<double>{1, 3, 4, 0, 0});
  CHECK(one.pressuresV == one.pressures);
  // a column of 3x3x12 on a floor, from which a sink takes the upper part: what is left stands as it did
  const double d = 0.05;
  std::vector<Eigen::Vector3d> column;
  for (int i = 0; i < 108; ++i)
    column.push_back(d * Eigen::Vector3d(i % 3 + 0.5, i / 9 + 0.5, i / 3 % 3 + 0.5));
  auto sim = scene(down,
                   DFSPHSolver{.radius = 2 * d},
                   MechanicalObject<Vec3d>{.position = column},
                   UniformMass<Vec3d>{.vertexMass = 1000 * d * d * d},
                   PlaneForceField<Vec3d>{.normal = {0, 1, 0}, .d = d / 2, .stiffness = 2000},
                   Sink{.normal = {0, -1, 0}, .d0 = -0.45, .d1 = -0.4});
  sim.init();
  auto& state = state_of(sim);
  auto& solver = sim.at<"drops">().get<DFSPHSolver>();
  for (int i = 0; i < 20; ++i) {
    const auto before = state.position;
    sim.animate(0.001);
    REQUIRE(solver.pressures.size() == state.size());
    if (i == 0) CHECK(state.size() < before.size());
  }
  CHECK(state.size() > 27);
  for (auto const& v : state.velocity) CHECK(v.allFinite());
}

TEST_CASE("what cannot follow points that go and come is refused") {
  auto refused = [](auto... components) {
    auto sim = scene(none, std::move(components)..., Source{.velocity = {0, 1, 0}});
    return error_of([&] { sim.init(); });
  };
  const MechanicalObject<Vec3d> state{.position = {{0, 0, 0}, {1, 0, 0}}};
  const UniformMass<Vec3d> mass{};
  const EulerExplicitSolver ode{};
  CHECK(refused(ode, state, mass).empty());
  CHECK_THAT(refused(ode, state, mass, FixedConstraint<Vec3d>{.indices = {0}}),
             Contains("/root/drops: FixedConstraint<Vec3d>") && Contains("points go and come"));
  CHECK_THAT(refused(ode, state, DiagonalMass<Vec3d>{.vertexMass = {1}}), Contains("DiagonalMass<Vec3d>"));
  CHECK_THAT(refused(ode, state, mass, MeshTopology{.edges = {{0, 1}}}), Contains("MeshTopology"));
  CHECK_THAT(refused(ode, state, mass, StiffSpringForceField<Vec3d>{}), Contains("StiffSpringForceField"));
  CHECK_THAT(refused(ode, state, mass, WriteState<Vec3d>{.filename = "/tmp/none.state"}),
             Contains("WriteState"));
  CHECK_THAT(
      refused(ode, state, mass, node<"copy">(MechanicalObject<Vec3d>{}, IdentityMapping<Vec3d, Vec3d>{})),
      Contains("/root/drops/copy: IdentityMapping") && Contains("points go and come"));
  Simulation joined{node<"root">(FreeMotionAnimationLoop{},
                                 BlockGaussSeidelConstraintSolver{},
                                 node<"drops">(ode, state, mass, Source{.velocity = {0, 1, 0}}))};
  CHECK_THAT(error_of([&] { joined.init(); }),
             Contains("FreeMotionAnimationLoop") && Contains("leave the loop"));
}

}  // namespace test_particles
