// SPDX-License-Identifier: BSL-1.0
// Where articulated bodies are, how they move, and what of that is wrong input: without a scene.
#include "catch.hpp"
#include "error_of.hpp"

#include <sinew/mapping/articulated_system_mapping.hpp>

#include <cmath>

namespace test_articulated_bodies {

using namespace sinew;
using Catch::Matchers::Contains;

using Mapping = ArticulatedSystemMapping<Vec1d, Rigid3d>;
using Rooted = ArticulatedSystemMapping<Vec1d, Rigid3d, Rigid3d, LinkedParents>;
using P = ArticulationProcess;

Vec1d::VecCoord numbers(std::initializer_list<double> list) {
  Vec1d::VecCoord all;
  for (const double x : list) all.push_back(Vec1d::Coord::Constant(x));
  return all;
}
Rigid3d::VecCoord placed(Mapping& mapping, Vec1d::VecCoord const& q, Rigid3d::VecCoord bodies = {}) {
  mapping.init({"angles", q, {}}, {"bodies", bodies, {}}, bodies);
  mapping.apply(bodies, q);
  return bodies;
}
bool near(Eigen::Vector3d const& a, Eigen::Vector3d const& b) { return (a - b).norm() < 1e-14; }

// two rods of length 2, whose centres are in their middle, hang on body 0 by hinges about z
Mapping pendulum() {
  return {.centers = {{0, 1, {0, 0, 0}, {0, 1, 0}}, {1, 2, {0, -1, 0}, {0, 1, 0}}},
          .articulations = {{0, 0, true, false, {0, 0, 3}}, {1, 1, true, false, {0, 0, 1}}}};
}

TEST_CASE("hinges place bodies behind one another") {
  Mapping mapping = pendulum();
  const double a = 0.3, b = 0.5;
  const auto x = placed(mapping, numbers({a, b}));
  REQUIRE(x.size() == 3);
  CHECK(near(x[0].center, {0, 0, 0}));
  CHECK(near(x[1].center, {std::sin(a), -std::cos(a), 0}));
  CHECK(near(x[2].center, {2 * std::sin(a) + std::sin(a + b), -2 * std::cos(a) - std::cos(a + b), 0}));
  CHECK(std::abs(x[2].orientation.z() - std::sin((a + b) / 2)) < 1e-15);
}

TEST_CASE("a base that is given, slides, and axes of one body or the other") {
  const double quarter = std::acos(0.0);
  const auto at = [&](P process) {
    Mapping mapping{.centers = {{0, 1, {1, 0, 0}, {-1, 0, 0}, process}},
                    .articulations = {{0, 0, true, false, {0, 0, 1}}, {0, 1, false, true, {1, 0, 0}}}};
    Rigid3d::VecCoord bodies(2);
    bodies[0].center = {5, 0, 0};
    return placed(mapping, numbers({quarter, 3}), bodies)[1].center;
  };
  // the arm of the child has turned to y; the slide along its own x, now y, or along that of the base
  CHECK(near(at(P::sequential), {6, 1 + 3, 0}));
  CHECK(near(at(P::onChild), {6, 1 + 3, 0}));
  CHECK(near(at(P::onParent), {6 + 3, 1, 0}));
}

TEST_CASE("a screw goes as far as it turns") {
  Mapping mapping{.centers = {{0, 1, {0, 0, 0}, {0, 0, 0}}},
                  .articulations = {{0, 0, true, true, {0, 0, 1}}}};
  const auto x = placed(mapping, numbers({0.7}));
  CHECK(near(x[1].center, {0, 0, 0.7}));
  CHECK(std::abs(x[1].orientation.z() - std::sin(0.35)) < 1e-15);
}

// chains with all kinds of articulations, some of them against the order of the list
template <class M>
M tree() {
  M mapping;
  mapping.centers = {{2, 4, {0.3, -0.2, 0.5}, {0.1, 0.4, -0.6}, P::onChild},
                     {0, 1, {1, 0.2, 0}, {-0.5, 0.3, 0.1}},
                     {1, 2, {0.4, -0.8, 0.2}, {0.2, 0.2, 0.7}, P::onParent},
                     {0, 3, {-0.3, 0.6, 0.9}, {0, 0.4, 0}}};
  mapping.articulations = {{1, 3, true, false, {0.2, 1, 0.4}},
                           {1, 0, false, true, {1, 0.3, -0.2}},
                           {1, 4, true, false, {0.7, -0.1, 0.9}},
                           {2, 1, true, false, {-0.4, 0.2, 1}},
                           {2, 6, false, true, {0.1, 0.9, 0.3}},
                           {0, 2, false, true, {0.5, 0.5, -1}},
                           {0, 7, true, false, {1, -1, 0.2}},
                           {3, 5, true, true, {0.3, 0.3, 1}}};
  return mapping;
}
const Vec1d::VecCoord angles = numbers({0.3, -0.7, 0.4, 1.1, -0.5, 0.8, 0.2, -0.9});
const Vec1d::VecDeriv rates = numbers({0.6, 1.3, -0.8, 0.9, 0.5, -1.1, 0.7, 1.2});

// J v, (dJ/dt) v and K_g by differences over 2e-5: truncation 1e-10, rounding 1e-11
constexpr double h = 1e-5;

Vec1d::VecCoord moved(Vec1d::VecCoord q, Vec1d::VecDeriv const& v, double time) {
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += time * v[i];
  return q;
}

// forces, and torques as large as `torque`, on bodies
Rigid3d::VecDeriv loads(std::size_t bodies, double torque) {
  Rigid3d::VecDeriv f;
  for (double b = 0; f.size() < bodies; ++b)
    f.push_back((Rigid3d::Deriv() << std::sin(b + 1),
                 std::cos(2 * b),
                 std::sin(3 * b + 1),
                 torque * 0.3,
                 torque * std::cos(b + 1),
                 torque * 0.2 * b)
                    .finished());
  return f;
}

TEST_CASE("velocities, accelerations and stiffness are derivatives") {
  Mapping mapping = tree<Mapping>();
  mapping.geometricStiffness = RotationalStiffness::symmetrized;
  auto x = placed(mapping, angles);
  const auto before = placed(mapping, moved(angles, rates, -h)),
             after = placed(mapping, moved(angles, rates, h));
  Rigid3d::VecDeriv v(x.size()), later = v, earlier = v;
  mapping.apply(x, moved(angles, rates, h));
  mapping.applyJ(later, rates);
  mapping.apply(x, moved(angles, rates, -h));
  mapping.applyJ(earlier, rates);
  mapping.apply(x, angles);
  mapping.applyJ(v, rates);
  const auto products = mapping.velocityProducts(rates, v);
  double size = 0;
  for (std::size_t b = 0; b < x.size(); ++b) {
    CHECK((Rigid3d::difference(before[b], after[b]) / (2 * h) - v[b]).norm() < 1e-7 * (1 + v[b].norm()));
    CHECK(((later[b] - earlier[b]) / (2 * h) - products[b]).norm() < 1e-7 * (1 + products[b].norm()));
    size += products[b].norm();
  }
  CHECK(size > 1);

  // forces on bodies, without torques of which K_g has the symmetric part: exact
  const auto f = loads(x.size(), 0);
  Vec1d::VecDeriv q(8, Vec1d::Deriv::Zero()), plus = q, minus = q, k = q;
  mapping.updateK(f);
  mapping.addKx(k, rates, 1);
  mapping.apply(x, moved(angles, rates, h));
  mapping.applyJT(plus, f);
  mapping.apply(x, moved(angles, rates, -h));
  mapping.applyJT(minus, f);
  for (std::size_t i = 0; i < 8; ++i) CHECK(std::abs((plus[i][0] - minus[i][0]) / (2 * h) - k[i][0]) < 1e-7);

  // virtual work
  mapping.apply(x, angles);
  mapping.applyJT(q, f);
  double work = 0, same = 0;
  for (std::size_t i = 0; i < 8; ++i) work += q[i][0] * rates[i][0];
  for (std::size_t b = 0; b < f.size(); ++b) same += f[b].dot(v[b]);
  CHECK(work == Approx(same).epsilon(1e-13));
}

TEST_CASE("bodies on a moving base go with it") {
  Rooted mapping = tree<Rooted>();
  mapping.geometricStiffness = RotationalStiffness::symmetrized;
  Rigid3d::VecCoord base(2), x;
  base[1].center = {0.4, 1, -2};
  const Rigid3d::Deriv motion = (Rigid3d::Deriv() << 0.3, -0.7, 0.2, 0.9, 0.5, -1.2).finished();
  Rigid3d::increment(base[1], 0.6 * motion);
  mapping.init({"angles", angles, {}}, {"bases", base, {}}, {"bodies", x, {}}, x);
  auto values = mapping.part(ParentNumber<0>{});
  auto root = mapping.part(ParentNumber<1>{});
  const Rigid3d::VecDeriv motions = {Rigid3d::Deriv::Zero(), motion};
  // positions, and velocities, after a time
  auto at = [&](double time, Rigid3d::VecDeriv& v) {
    auto there = base;
    Rigid3d::increment(there[1], time * motion);
    values.apply(x, moved(angles, rates, time));
    root.apply(x, there);
    v.resize(x.size());
    values.applyJ(v, rates);
    root.applyJ(v, motions);
    return x;
  };
  Rigid3d::VecDeriv v, later, earlier;
  const auto after = at(h, later), before = at(-h, earlier), now = at(0, v);
  CHECK(near(now[0].center, base[1].center));
  const auto products = values.velocityProducts(rates, v);
  for (std::size_t b = 0; b < now.size(); ++b) {
    CHECK((Rigid3d::difference(before[b], after[b]) / (2 * h) - v[b]).norm() < 1e-7 * (1 + v[b].norm()));
    CHECK(((later[b] - earlier[b]) / (2 * h) - products[b]).norm() < 1e-7 * (1 + products[b].norm()));
  }
  // the force on the values and the symmetric part of that on the base, u'K u, of forces and torques
  const auto f = loads(now.size(), 1);
  auto power = [&](double time) {
    Rigid3d::VecDeriv ignored;
    at(time, ignored);
    Vec1d::VecDeriv q(8, Vec1d::Deriv::Zero());
    Rigid3d::VecDeriv r(2, Rigid3d::Deriv::Zero());
    values.applyJT(q, f);
    root.applyJT(r, f);
    double sum = r[1].dot(motion);
    for (std::size_t i = 0; i < 8; ++i) sum += q[i][0] * rates[i][0];
    return sum;
  };
  const double slope = (power(h) - power(-h)) / (2 * h);
  at(0, v);
  values.updateK(f);
  root.updateK(f);
  values.gather(rates);
  root.gather(motions);
  Vec1d::VecDeriv q(8, Vec1d::Deriv::Zero());
  Rigid3d::VecDeriv r(2, Rigid3d::Deriv::Zero());
  values.addKx(q, rates, 1);
  root.addKx(r, motions, 1);
  double product = r[1].dot(motion);
  for (std::size_t i = 0; i < 8; ++i) product += q[i][0] * rates[i][0];
  CHECK(product == Approx(slope).epsilon(1e-7));
  CHECK(std::abs(slope) > 0.1);
}

// M = J' m J and the force of weight and (dJ/dt) v, of two rods that have mass and inertia
TEST_CASE("a double pendulum has the accelerations of its Lagrangian") {
  Mapping mapping = pendulum();
  const double a = 0.8, b = -1.9, ra = 1.3, rb = -2.2, g = 9.81, m1 = 2, m2 = 0.7, I1 = 0.6, I2 = 0.3;
  const auto q = numbers({a, b}), w = numbers({ra, rb});
  auto x = placed(mapping, q);
  Rigid3d::VecDeriv v(3), c1(3), c2(3);
  mapping.applyJ(v, w);
  mapping.applyJ(c1, numbers({1, 0}));
  mapping.applyJ(c2, numbers({0, 1}));
  const auto products = mapping.velocityProducts(w, v);
  Rigid3d::VecDeriv f(3, Rigid3d::Deriv::Zero());
  Eigen::Matrix2d M = Eigen::Matrix2d::Zero();
  const double mass[] = {0, m1, m2}, inertia[] = {0, I1, I2};
  for (std::size_t i = 1; i < 3; ++i) {
    Eigen::Matrix<double, 6, 1> d;
    d << mass[i], mass[i], mass[i], 1, 1, inertia[i];
    f[i] = -d.cwiseProduct(products[i]);
    f[i][1] -= mass[i] * g;
    Eigen::Matrix<double, 6, 2> J;
    J << c1[i], c2[i];
    M += J.transpose() * d.asDiagonal() * J;
  }
  Vec1d::VecDeriv force(2, Vec1d::Deriv::Zero());
  mapping.applyJT(force, f);
  const Eigen::Vector2d found = M.inverse() * Eigen::Vector2d(force[0][0], force[1][0]);

  // with the angles s = a and t = a + b from the vertical: l = 2, arms of 1 to the centres
  const double s = a, t = a + b, rs = ra, rt = ra + rb, l = 2, arm = 1;
  Eigen::Matrix2d L;
  L << m1 * arm * arm + m2 * l * l + I1, m2 * l * arm * std::cos(s - t), m2 * l * arm * std::cos(s - t),
      m2 * arm * arm + I2;
  const Eigen::Vector2d right(
      -m2 * l * arm * std::sin(s - t) * rt * rt - (m1 * arm + m2 * l) * g * std::sin(s),
      m2 * l * arm * std::sin(s - t) * rs * rs - m2 * g * arm * std::sin(t));
  const Eigen::Vector2d lagrange = L.inverse() * right;
  CHECK(found[0] == Approx(lagrange[0]).epsilon(1e-12));
  CHECK(found[0] + found[1] == Approx(lagrange[1]).epsilon(1e-12));
}

TEST_CASE("what does not fit an ArticulatedSystemMapping is named") {
  auto with = [](auto change, std::size_t values = 2) {
    return error_of([=] {
      Mapping mapping = pendulum();
      change(mapping);
      Rigid3d::VecCoord bodies(3);
      const Vec1d::VecCoord q(values, Vec1d::Coord::Zero());
      mapping.init({"/angles", q, {}}, {"bodies", bodies, {}}, bodies);
    });
  };
  CHECK_THAT(with([](Mapping& m) { m.centers.clear(); }),
             Contains("bodies: ArticulatedSystemMapping") && Contains("there is no center"));
  CHECK_THAT(with([](Mapping& m) { m.centers[1].childIndex = 3; }),
             Contains("centers[1] has childIndex 3, but there are 3 bodies"));
  CHECK_THAT(with([](Mapping& m) { m.centers[1].parentIndex = -1; }), Contains("has parentIndex -1"));
  CHECK_THAT(with([](Mapping& m) { m.centers[1].childIndex = 1; }),
             Contains("body 1 is borne by centers[0] and by centers[1]"));
  CHECK_THAT(with([](Mapping& m) { m.centers[0].parentIndex = 2; }), Contains("borne in a ring"));
  CHECK_THAT(with([](Mapping& m) { m.articulations[1].center = 2; }),
             Contains("articulations[1] has center 2, but there are 2 centers"));
  CHECK_THAT(with([](Mapping&) {}, 1),
             Contains("articulations[1] has articulationIndex 1, but there are 1 values in /angles"));
  CHECK_THAT(with([](Mapping& m) { m.articulations[1].articulationIndex = 0; }),
             Contains("articulations[0] and [1] have the same value, 0"));
  CHECK_THAT(with([](Mapping& m) { m.articulations[0].axis.setZero(); }),
             Contains("articulations[0] has the axis 0 0 0, which has no direction"));
  CHECK_THAT(with([](Mapping& m) { m.articulations[0].axis[1] = NAN; }), Contains("no direction"));
  CHECK_THAT(with([](Mapping& m) {
               m.centers[0].articulationProcess = P::onParent;
               m.articulations[1].center = 0;
             }),
             Contains("centers[0] turns about several axes of one body (articulationProcess 1)"));
  auto rooted = [](int index, int child) {
    return error_of([=] {
      Rooted mapping;
      mapping.centers = {{0, 1, {0, 0, 0}, {0, 0, 0}}, {1, 2, {0, 0, 0}, {0, 0, 0}}};
      mapping.centers[1].childIndex = child;
      mapping.centers[0].parentIndex = child == 0 ? 2 : 0;
      mapping.indexInput2 = index;
      Rigid3d::VecCoord bodies(3);
      const Rigid3d::VecCoord base(1);
      const Vec1d::VecCoord q(2, Vec1d::Coord::Zero());
      mapping.init({"/angles", q, {}}, {"/base", base, {}}, {"bodies", bodies, {}}, bodies);
    });
  };
  CHECK(rooted(0, 2).empty());
  CHECK_THAT(rooted(1, 2), Contains("indexInput2 has 1, but /base has 1 rigid bodies"));
  CHECK_THAT(rooted(0, 0), Contains("centers[1] bears body 0, which is the base"));
}

}  // namespace test_articulated_bodies
