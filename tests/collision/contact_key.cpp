// SPDX-License-Identifier: BSL-1.0
#include <sinew/collision/contact.hpp>

#include <map>

#include "catch.hpp"

namespace test_contact_key {

using namespace sinew;

TEST_CASE("features say what they are, and stand in one order") {
  const std::vector<Feature> rising{Feature::whole(),
                                    Feature::face(),
                                    Feature::face(2),
                                    Feature{},
                                    Feature::vertex(0),
                                    Feature::edge(2, 0),
                                    Feature::edge(0, 3),
                                    Feature::vertex(2),
                                    Feature::edge(2, 3)};
  CHECK(std::is_sorted(rising.begin(), rising.end()));
  CHECK(Feature::edge(3, 1) == Feature::edge(1, 3));
  using Kind = Feature::Kind;
  const std::vector<Kind> kinds{Kind::whole,
                                Kind::face,
                                Kind::face,
                                Kind::none,
                                Kind::vertex,
                                Kind::edge,
                                Kind::edge,
                                Kind::vertex,
                                Kind::edge};
  for (std::size_t i = 0; i < rising.size(); ++i) {
    CHECK(rising[i].kind() == kinds[i]);
    CHECK(rising[i].isVertexOrNone() == (kinds[i] == Kind::vertex || kinds[i] == Kind::none));
  }
}

TEST_CASE("a contact is known by what meets, not by the elements that do") {
  std::map<ContactKey, double> known;
  Contact c;
  c.a = {.surface = 0, .element = 3, .vertices = {7, 4, -1}, .weights = {0.5, 0.5, 0}};
  c.b = {.surface = 1, .element = 0, .vertices = {0, -1, -1}, .weights = {1, 0, 0}};
  known[c.key()] = 1;
  c.a.element = 5;
  std::swap(c.a.vertices[0], c.a.vertices[1]);
  CHECK(known.contains(c.key()));
  CHECK(!c.key().ofOneVertex(0));
  CHECK(c.key().ofOneVertex(1));
  for (Feature const& other : {Feature::edge(0, 1), Feature::face(), Feature::whole()}) {
    Contact hull = c;
    hull.b.feature = other;
    CHECK(!known.contains(hull.key()));
    CHECK(!hull.key().ofOneVertex(1));
  }
}

}  // namespace test_contact_key
