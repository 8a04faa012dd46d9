// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "laws/sample.hpp"

#include <sinew/mapping/articulated_system_mapping.hpp>

#include <utility>

namespace sample {

// a tree of six bodies and one that stands alone, with hinges, slides and a screw
template <class M>
void prepare_articulated(M& c, Random& random) {
  using P = ArticulationProcess;
  static constexpr int parent[] = {0, 0, 1, 2, 1};  // of bodies 1 to 5
  static constexpr P process[] = {P::sequential, P::onParent, P::onChild, P::sequential, P::onChild};
  c.centers.clear(), c.articulations.clear();
  for (int k = 4; k >= 0; --k) {  // before those that bear their parents
    ArticulationCenter one{.parentIndex = parent[k], .childIndex = k + 1, .articulationProcess = process[k]};
    one.posOnParent = vector<Eigen::Vector3d>(random);
    one.posOnChild = vector<Eigen::Vector3d>(random);
    c.centers.push_back(one);
  }
  static constexpr std::pair<bool, bool> kinds[] = {{true, false},
                                                    {false, true},
                                                    {true, false},
                                                    {true, false},
                                                    {false, true},
                                                    {false, true},
                                                    {true, false},
                                                    {false, true},
                                                    {true, true},
                                                    {true, false},
                                                    {false, false}};
  static constexpr int center[] = {4, 4, 4, 3, 3, 2, 2, 2, 1, 1, 0};
  for (int a = 0; a < 11; ++a)
    c.articulations.push_back({center[a],
                               (3 * a + 2) % 11,
                               kinds[a].first,
                               kinds[a].second,
                               vector<Eigen::Vector3d>(random) + Eigen::Vector3d(2, 1, 0)});
}
template <class... A>
void prepare(ArticulatedSystemMapping<A...>& c, Random& random) {
  prepare_articulated(c, random);
  if constexpr (requires { c.indexInput2; }) c.indexInput2 = random.index(9);
}

}  // namespace sample
