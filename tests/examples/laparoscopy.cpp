// SPDX-License-Identifier: BSL-1.0
#include "laparoscopy/measures.hpp"
#include "laparoscopy/scene.hpp"

#include "catch.hpp"

namespace test_laparoscopy {

using namespace sinew;

TEST_CASE("laparoscopy: bodies are what they say") {
  const auto b = examples::make_bodies(1800);
  CHECK(std::abs(int(b.liver.volume.tetrahedra.size()) - 1800) <= 90);
  for (auto const* organ : {&b.liver, &b.intestines}) {
    CHECK(organ->volumeOfSkin > 0);
    CHECK(!organ->fixed.empty());
    for (auto const& t : organ->volume.tetrahedra) {
      auto at = [&](std::size_t i) { return organ->volume.positions[std::size_t(t[i])]; };
      REQUIRE((at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) > 0);
    }
    for (auto const& p : organ->skin.positions) REQUIRE(b.room(p) < 0);
  }
  // a tube of 0.79 m with a radius of 15 mm and blunt ends, as an octagon: 2 sqrt 2 r^2 across
  CHECK(b.intestines.volumeOfSkin == Approx(2 * std::sqrt(2) * 0.015 * 0.015 * 0.79).epsilon(0.05));
  // the wall has its inside in front
  CHECK(examples::enclosed_volume(b.wall.positions, b.wall.triangles) ==
        Approx(-4.0 / 3 * std::acos(-1) * b.room.radii.prod()).epsilon(0.05));
  CHECK(examples::is_inside({-0.03, 0, 0}, b.liver.skin.positions, b.liver.skin.triangles));
  CHECK(!examples::is_inside({-0.03, 0, 0.09}, b.liver.skin.positions, b.liver.skin.triangles));
}

TEMPLATE_TEST_CASE("laparoscopy: a script of 20 s passes, and all stays where it belongs", "",
                   examples::FemOrgans, examples::GridOrgans) {
  constexpr bool fem = std::is_same_v<TestType, examples::FemOrgans>;
  const auto bodies = fem ? examples::make_bodies(1000) : examples::make_bodies({11, 6, 7});
  auto sim = examples::laparoscopy_scene<TestType>(bodies);
  sim.init();
  examples::LaparoscopyScript script;
  examples::LaparoscopyMeasures m;
  const auto before = sim.template at<"organs/liver/skin">().state().position;
  double lift = 0;
  for (int i = 1; i <= 1000; ++i) {
    script.act(sim, 0.02);
    sim.animate(0.02);  // throws where something is no longer finite
    m.look<DefaultContactManager>(sim, bodies, i % 20 == 0);
    if (!script.held.empty())
      for (std::size_t p = 0; p < before.size(); ++p)
        lift = std::max(lift, sim.template at<"organs/liver/skin">().state().position[p].z() - before[p].z());
  }
  INFO("fastest " << m.fastest << ", farthest " << m.farthest << ", volumes " << m.smallest << " to "
                  << m.largest << ", of elements at least " << m.lowest << ", within " << m.within
                  << ", lift " << lift << ", deepest " << m.deepest << ' ' << m.where << ", contacts "
                  << m.contacts);
  CHECK(script.graspsDone == 1);
  CHECK(script.held.empty());
  // springs of 300 N/m together pull the lobe by 30 mm; what it gives is some of that
  CHECK(lift > 0.005);
  // the tool moves at 0.2 m/s at most; the lobe snaps back as it is let go
  CHECK(m.fastest < 0.6);
  CHECK(m.deepest < 0.002);  // the tool has a radius of 4 mm
  CHECK(m.contacts > 2);
  CHECK(m.farthest < 0);
  CHECK(m.within == 0);
  CHECK(m.maximum == 0);
  CHECK(m.lowest > 0.2);
  CHECK(m.smallest > 0.9);
  CHECK(m.largest < 1.1);
}

}  // namespace test_laparoscopy
