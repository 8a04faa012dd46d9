// SPDX-License-Identifier: BSL-1.0
// Sheets and bars that are pulled until they tear.
#include "cut_bodies.hpp"

#include <sinew/engines.hpp>
#include <sinew/mechanics.hpp>

#include <cmath>
#include <complex>
#include <numbers>

namespace test_tearing_engine {

using namespace cutting;

namespace {

struct Sheet {
  std::vector<Point> points{};
  std::vector<Triangle> triangles{};
};
/// nx * ny squares of 1 m, two triangles each, whose points inside are moved by up to `jitter`.
Sheet sheet(int nx, int ny, double jitter = 0) {
  Sheet s;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> move(-jitter, jitter);
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) {
      const bool inside = i > 0 && j > 0 && i < nx && j < ny;
      s.points.emplace_back(i + (inside ? move(random) : 0), j + (inside ? move(random) : 0), 0);
    }
  auto at = [nx](int i, int j) { return Index(i + (nx + 1) * j); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      s.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      s.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return s;
}
std::vector<Point> stretched(std::vector<Point> x, double strain) {
  for (auto& p : x) p[1] *= 1 + strain;
  return x;
}
/// Those at both ends along y.
std::vector<int> ends(std::vector<Point> const& x) {
  double top = 0;
  for (auto const& p : x) top = std::max(top, p[1]);
  std::vector<int> all;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (x[i][1] < 1e-6 || x[i][1] > top - 1e-6) all.push_back(int(i));
  return all;
}
double area(std::vector<Point> const& x, std::vector<Triangle> const& triangles) {
  double sum = 0;
  for (auto const& t : triangles) {
    auto at = [&](std::size_t k) { return x[std::size_t(t[k])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  return sum;
}

constexpr double young = 100;

/// The stress of a sheet without lateral contraction that is stretched along y is E times the strain.
auto scene(Sheet const& s, double strain, TearingEngine<Vec3d> const& engine,
           std::vector<double> const& E = {young}, double poissonRatio = 0,
           std::vector<int> const& held = {-1}) {
  return Simulation{node<"root">(
      EulerImplicitSolver{.rayleighMass = 0.1},
      CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14, .threshold = 1e-30},
      node<"sheet">(
          MeshTopology{.triangles = s.triangles},
          MechanicalObject<Vec3d>{.position = stretched(s.points, strain), .restPosition = s.points},
          DiagonalMass<Vec3d>{.massDensity = 1},
          TriangleFEMForceField<Vec3d>{.youngModulus = E,
                                       .poissonRatio = {poissonRatio},
                                       .thickness = 0.5,
                                       .method = TriangleMethod::polar},
          FixedConstraint<Vec3d>{.indices = held == std::vector<int>{-1} ? ends(s.points) : held},
          engine))};
}
template <class Sim>
auto& engine_of(Sim& sim) {
  return sim.template at<"sheet">().template get<TearingEngine<Vec3d>>();
}
template <class Sim>
int pieces_of(Sim& sim) {
  auto& node = sim.template at<"sheet">();
  return pieces(node.state().size(), node.template get<MeshTopology>().triangles);
}

}  // namespace

TEST_CASE("a sheet tears where its stress comes to the threshold, and not before") {
  const Sheet s = sheet(6, 8, 0.2);
  const double threshold = 20;
  for (const double part : {1 - 1e-9, 1 + 1e-9}) {
    auto sim = scene(s, part * threshold / young, {.stressThreshold = threshold, .step = 0});
    sim.init();
    auto& engine = engine_of(sim);
    auto& node = sim.at<"sheet">();
    const double energy = sim.potentialEnergy();
    sim.animate(1e-9);
    CHECK(engine.maxStress == Approx(part * threshold).epsilon(1e-12));
    CHECK(engine.fractures == (part > 1));
    CHECK((node.state().size() > s.points.size()) == (part > 1));
    // what tears keeps its strain and its size
    CHECK(sim.potentialEnergy() == Approx(energy).epsilon(1e-12));
    CHECK(area(node.state().restPosition, node.get<MeshTopology>().triangles) == Approx(48).epsilon(1e-12));
  }
}

TEST_CASE("what is pressed does not tear") {
  auto sim = scene(sheet(4, 4), -0.5, {.stressThreshold = 1, .step = 0});
  sim.init();
  for (int i = 0; i < 5; ++i) sim.animate(1e-9);
  CHECK(engine_of(sim).fractures == 0);
}

TEST_CASE("of columns side by side the stiffest tears first, at the threshold over its stiffness") {
  const Sheet s = sheet(5, 4);
  std::vector<double> E;
  for (std::size_t e = 0; e < s.triangles.size(); ++e) E.push_back(e / 2 % 5 == 3 ? 300 : 100);
  for (const double part : {1 - 1e-9, 1 + 1e-9}) {
    auto sim = scene(s, part * 30 / 300, {.stressThreshold = 30, .step = 0}, E);
    sim.init();
    sim.animate(1e-9);
    auto& node = sim.at<"sheet">();
    CHECK((engine_of(sim).fractures == 1) == (part > 1));
    for (std::size_t i = s.points.size(); i < node.state().size(); ++i) {
      CHECK(node.state().restPosition[i][0] >= 2);  // one element to each side of it at most
      CHECK(node.state().restPosition[i][0] <= 5);
    }
  }
}

TEST_CASE("tears go on until the sheet is in two, across the pull, and energy does not grow", "[long]") {
  for (const double jitter : {0., 0.2}) {
    const Sheet s = sheet(8, 8, jitter);
    auto sim = scene(s,
                     0.3,
                     {.stressThreshold = 25, .fractureMaxLength = 2, .step = 2, .nbFractureMax = 40},
                     {young},
                     0.3);
    sim.init();
    auto& node = sim.at<"sheet">();
    const double first = sim.potentialEnergy();
    double energy = first;
    int tears = 0;
    for (int i = 0; i < 400; ++i) {
      sim.animate(0.02);
      const double now = sim.potentialEnergy() + sim.kineticEnergy();
      CHECK(now <= energy * (1 + 1e-9));
      energy = now;
      CHECK(engine_of(sim).fractures - tears <= 1);
      tears = engine_of(sim).fractures;
      CHECK(area(node.state().restPosition, node.get<MeshTopology>().triangles) == Approx(64).epsilon(1e-10));
    }
    CHECK(pieces_of(sim) >= 2);
    CHECK(tears >= 3);
    CHECK(tears < 40);
    CHECK(energy < 0.05 * first);
  }
}

namespace {

// Displacement and largest principal stress beside a round hole of 1 m in an infinite sheet under tension S
// along y (Kirsch 1898), in plane stress, by the potentials of Kolosov and Muskhelishvili of tension along
// the first axis.
struct Kirsch {
  double S, E, nu;

  Point displacement(Point const& p) const {
    using C = std::complex<double>;
    const C z(p[1], p[0]), one = 1;
    const double kappa = (3 - nu) / (1 + nu), twoG = E / (1 + nu);
    const C phi = S / 4 * (z + 2. / z), slope = S / 4 * (one - 2. / (z * z)),
            psi = -S / 2 * (z + one / z - one / (z * z * z));
    const C u = (kappa * phi - z * std::conj(slope) - std::conj(psi)) / twoG;
    return {u.imag(), u.real(), 0};
  }
  double alongHole(double r) const { return S / 2 * (2 + 1 / (r * r) + 3 / (r * r * r * r)); }  // beside it
};
/// A ring around a hole of 1 m, up to 5 m.
Sheet ring(int around, int rings) {
  Sheet s;
  for (int k = 0; k <= rings; ++k)
    for (int i = 0; i < around; ++i) {
      const double r = std::pow(5., double(k) / rings), a = 2 * std::numbers::pi * i / around;
      s.points.emplace_back(r * std::cos(a), r * std::sin(a), 0);
    }
  auto at = [around](int i, int k) { return Index(i % around + around * k); };
  for (int k = 0; k < rings; ++k)
    for (int i = 0; i < around; ++i) {
      s.triangles.push_back({at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      s.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  return s;
}

}  // namespace

TEST_CASE("a sheet with a hole tears beside it, at three times the tension", "[long]") {
  const Sheet s = ring(48, 16);
  const Kirsch exact{.S = 0.1, .E = 100, .nu = 0.3};
  std::vector<Point> x;
  std::vector<int> rim;
  for (auto const& p : s.points) {
    if (p.norm() > 4.999) rim.push_back(int(x.size()));
    x.push_back(p + exact.displacement(p));
  }
  // between that at the hole and that in the middle of the elements beside it, which are a tenth of it large
  const double least = exact.alongHole(1.05), most = 1.02 * exact.alongHole(1);
  for (const double threshold : {most, least}) {
    Simulation sim{node<"root">(
        StaticSolver{},
        CGLinearSolver<>{.iterations = 3000, .tolerance = 1e-12, .threshold = 1e-30},
        node<"sheet">(
            MeshTopology{.triangles = s.triangles},
            MechanicalObject<Vec3d>{.position = x, .restPosition = s.points},
            DiagonalMass<Vec3d>{.massDensity = 1},
            TriangleFEMForceField<Vec3d>{
                .youngModulus = {exact.E}, .poissonRatio = {exact.nu}, .method = TriangleMethod::small},
            // a sheet that does not bend has no stiffness across its plane
            FixedPlaneConstraint<Vec3d>{.direction = {0, 0, 1}, .dmin = -1, .dmax = 1},
            FixedConstraint<Vec3d>{.indices = rim},
            TearingEngine<Vec3d>{
                .stressThreshold = threshold, .fractureMaxLength = 0.5, .step = 1, .nbFractureMax = 12}))};
    sim.init();
    auto& node = sim.at<"sheet">();
    auto const& engine = node.get<TearingEngine<Vec3d>>();
    sim.animate(1);
    sim.animate(1);
    CHECK(engine.maxStress >= least);
    CHECK(engine.maxStress <= most);
    CHECK(engine.fractures == (threshold < most));
    for (int i = 0; i < 40; ++i) sim.animate(1);
    CHECK((engine.fractures > 5) == (threshold < most));
    // along the first axis, from the hole on
    double length = 1;
    for (std::size_t i = s.points.size(); i < node.state().size(); ++i) {
      auto const& p = node.state().restPosition[i];
      length = std::max(length, std::abs(p[0]));
      CHECK(std::abs(p[1]) < 0.3 * std::abs(p[0]));
    }
    CHECK((length > 1.3) == (threshold < most));
  }
}

TEST_CASE("a bar of tetrahedra tears at the threshold, and into two", "[long]") {
  const Body b = block(3, 5, 2, 0.1);
  std::vector<int> held;
  for (std::size_t i = 0; i < b.points.size(); ++i)
    if (b.points[i][1] < 0.5 || b.points[i][1] > 4.5) held.push_back(int(i));
  for (const double part : {1 - 1e-6, 1 + 1e-6}) {
    const double threshold = 20;
    Simulation sim{node<"root">(
        EulerImplicitSolver{.rayleighMass = 0.1},
        CGLinearSolver<>{.iterations = 500, .tolerance = 1e-14, .threshold = 1e-30},
        node<"bar">(MeshTopology{.tetrahedra = b.tetrahedra},
                    MechanicalObject<Vec3d>{.position = stretched(b.points, part * threshold / young),
                                            .restPosition = b.points},
                    DiagonalMass<Vec3d>{.massDensity = 1},
                    TetrahedronFEMForceField<Vec3d>{
                        .youngModulus = {young}, .poissonRatio = 0, .method = RotationMethod::nearest},
                    FixedConstraint<Vec3d>{.indices = held},
                    TearingEngine<Vec3d>{
                        .stressThreshold = threshold, .fractureMaxLength = 3, .step = 0, .nbFractureMax = 60},
                    node<"skin">(MeshTopology{.triangles = b.skin})))};
    sim.init();
    auto& node = sim.at<"bar">();
    auto const& engine = node.get<TearingEngine<Vec3d>>();
    double energy = sim.potentialEnergy();
    for (int i = 0; i < 100; ++i) {
      sim.animate(i < 1 ? 1e-9 : 0.02);
      if (i == 0) CHECK(engine.maxStress == Approx(part * threshold).epsilon(1e-8));
      if (i == 0) CHECK(engine.fractures == (part > 1));
      const double now = sim.potentialEnergy() + sim.kineticEnergy();
      CHECK(now <= energy * (1 + 1e-9));
      energy = now;
      if (part < 1 && i > 2) break;
    }
    const Body now{node.state().restPosition,
                   node.get<MeshTopology>().tetrahedra,
                   sim.at<"bar/skin">().get<MeshTopology>().triangles};
    CHECK(volume(now) == Approx(volume(b)).epsilon(1e-12));
    CHECK(has_its_skin(now));
    CHECK(worst(now) >= std::min(0.1, worst(b)) * (1 - 1e-9));
    CHECK((pieces(now) > 1) == (part > 1));
  }
}

TEST_CASE("tears do not begin where they may not, and there are no more than asked for") {
  const Sheet s = sheet(6, 6);
  std::vector<int> lower;
  for (std::size_t e = 0; e < s.triangles.size(); ++e)
    if (s.points[std::size_t(s.triangles[e][0])][1] < 3) lower.push_back(int(e));
  auto middle = [](auto& node, int e) {
    Point sum = Point::Zero();
    for (const Index i : node.template get<MeshTopology>().triangles[std::size_t(e)])
      sum += node.state().restPosition[std::size_t(i)] / 3;
    return sum;
  };
  auto sim = scene(s,
                   0.3,
                   {.stressThreshold = 25,
                    .fractureMaxLength = 0.1,
                    .step = 2,
                    .nbFractureMax = 3,
                    .trianglesToIgnore = lower});
  sim.init();
  auto& engine = engine_of(sim);
  for (int i = 0; i < 20; ++i) {
    const int before = engine.fractures;
    sim.animate(1e-9);
    if (engine.fractures == before) continue;
    CHECK(engine.fractures == before + 1);
    CHECK((i + 1) % 3 == 0);
    CHECK(middle(sim.at<"sheet">(), engine.torn)[1] > 3);  // the first part stands where the element stood
    CHECK(middle(sim.at<"sheet">(), engine.torn)[1] < 5);  // where nothing is held
  }
  CHECK(engine.fractures == 3);
  for (const int e : engine.trianglesToIgnore) CHECK(middle(sim.at<"sheet">(), e)[1] < 3);
  sim.reset();
  CHECK(engine_of(sim).fractures == 3);

  std::vector<int> all;
  for (std::size_t e = 0; e < s.triangles.size(); ++e) all.push_back(int(e));
  auto none = scene(s, 0.3, {.stressThreshold = 25, .step = 0, .trianglesToIgnore = all});
  none.init();
  for (int i = 0; i < 3; ++i) none.animate(1e-9);
  CHECK(engine_of(none).fractures == 0);
}

TEST_CASE("what cannot tear is refused") {
  auto refused = [](auto sim, std::string_view words) {
    std::string message;
    try {
      sim.init();
    } catch (Error const& error) {
      message = error.what();
    }
    INFO(message);
    CHECK(message.find(words) != std::string::npos);
  };
  const Sheet s = sheet(2, 2);
  auto with = [&](TearingEngine<Vec3d> const& engine) { return scene(s, 0, engine); };
  const double nan = std::nan("");
  refused(with({.stressThreshold = 0}), "stressThreshold");
  refused(with({.stressThreshold = nan}), "stressThreshold");
  refused(with({.fractureMaxLength = -1}), "fractureMaxLength");
  refused(with({.step = -1}), "step");
  refused(with({.nbFractureMax = -1}), "nbFractureMax");
  refused(with({.trianglesToIgnore = {8}}), "trianglesToIgnore has 8");
  refused(with({.snapping = 0.6}), "snapping");
  auto of = [&](auto const& topology, auto const& force) {
    return Simulation{node<"root">(EulerExplicitSolver{},
                                   topology,
                                   MechanicalObject<Vec3d>{.position = s.points},
                                   UniformMass<Vec3d>{.totalMass = 1},
                                   force,
                                   TearingEngine<Vec3d>{})};
  };
  const MeshTopology triangles{.triangles = s.triangles};
  refused(of(triangles, ConstantForceField<Vec3d>{.totalForce = Point(0, 0, 1)}), "what stresses");
  refused(of(MeshTopology{.edges = {{0, 1}}}, ConstantForceField<Vec3d>{.totalForce = Point(0, 0, 1)}),
          "neither tetrahedra nor triangles");
  MeshTopology mixed = triangles;
  mixed.quads = {{0, 1, 4, 3}};
  refused(of(mixed, TriangleFEMForceField<Vec3d>{}), "a quad is not cut");
}

TEST_CASE("the largest principal stress, and which point of an element tears first") {
  Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Point(1, 2, 3).normalized()).toRotationMatrix();
  const PrincipalStress s =
      principal_stress(turn * Eigen::Vector3d(-9, 2, 5).asDiagonal() * turn.transpose());
  CHECK(s.value == Approx(5).epsilon(1e-12));
  CHECK(std::abs(s.direction.dot(turn.col(2))) == Approx(1).epsilon(1e-12));

  // inside the sheet the one with the stronger elements around it, and one on the border before all others
  const Sheet sheetOf = sheet(6, 6);
  auto begins = [&](Index strong, Index beside, PointStress method, Index axis = 1) {
    std::vector<Eigen::Matrix3d> stress(sheetOf.triangles.size(), Eigen::Matrix3d::Zero());
    stress[std::size_t(strong)](axis, axis) = 2;
    if (beside >= 0) stress[std::size_t(beside)](1, 1) = 1.5;
    const auto tear = plan_tear({.triangles = sheetOf.triangles},
                                sheetOf.points,
                                stress,
                                std::vector<bool>(stress.size(), true),
                                {.threshold = 1, .ofPoints = method});
    REQUIRE(tear);
    CHECK(tear->element == strong);
    CHECK(tear->stress == 2);
    return tear->point;
  };
  for (const PointStress method : {PointStress::WeightedAverageInverseDistance,
                                   PointStress::UnweightedAverage,
                                   PointStress::WeightedAverageArea}) {
    const Index e = 2 * (2 + 6 * 2);  // (2, 2) (3, 2) (3, 3), all inside
    CHECK(begins(e, e + 2, method) == sheetOf.triangles[std::size_t(e)][1]);
    CHECK(begins(6, -1, method, 0) <= 6);  // of those below
    // along the border nothing tears, and so it does inside
    CHECK(begins(6, -1, method, 1) == 11);
  }
}

}  // namespace test_tearing_engine
