// SPDX-License-Identifier: BSL-1.0
// Bullet: btDbvt for surfaces, refitted as its deformable bodies do it; btDbvtBroadphase for balls.
#include "collision.hpp"

#include <btBulletCollisionCommon.h>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

namespace bench {

namespace {

btVector3 point(Coordinates const& x, int i) {
  return {btScalar(x[3 * std::size_t(i)]),
          btScalar(x[3 * std::size_t(i) + 1]),
          btScalar(x[3 * std::size_t(i) + 2])};
}
std::vector<btVector3> points(Coordinates const& x) {
  std::vector<btVector3> all(x.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = point(x, int(i));
  return all;
}

struct Count : btDbvt::ICollide {
  std::size_t pairs = 0;
  void Process(const btDbvtNode*, const btDbvtNode*) override { ++pairs; }
  void Process(const btDbvtNode*) override { ++pairs; }
};

struct Surface {
  btDbvt tree;
  std::vector<btDbvtNode*> leaves;
  std::vector<std::array<int, 3>> triangles;
  std::vector<btVector3> x;

  btDbvtVolume volume(std::size_t t) const {
    const btVector3* corners[3] = {
        &x[std::size_t(triangles[t][0])], &x[std::size_t(triangles[t][1])], &x[std::size_t(triangles[t][2])]};
    return btDbvtVolume::FromPoints(corners, 3);
  }
  void build(std::vector<std::array<int, 3>> const& list, Coordinates const& start) {
    triangles = list;
    x = points(start);
    for (std::size_t t = 0; t < triangles.size(); ++t) leaves.push_back(tree.insert(volume(t), nullptr));
    tree.optimizeTopDown();
  }
  void refit() {
    for (std::size_t t = 0; t < triangles.size(); ++t) leaves[t]->volume = volume(t);
    merge(tree.m_root);
  }
  static void merge(btDbvtNode* node) {
    if (node->isleaf()) return;
    merge(node->childs[0]);
    merge(node->childs[1]);
    Merge(node->childs[0]->volume, node->childs[1]->volume, node->volume);
  }
};

}  // namespace

Contender bullet_surfaces(Bodies const& start) {
  struct Two {
    Surface a, b;
    Count count;
  };
  auto two = std::make_shared<Two>();
  two->a.build(start.triangles, start.first);
  two->b.build(start.triangles, start.second);
  return {[two](Bodies const& now) { two->a.x = points(now.first), two->b.x = points(now.second); },
          [two] {
            two->a.refit();
            two->b.refit();
            two->count.pairs = 0;
            two->a.tree.collideTT(two->a.tree.m_root, two->b.tree.m_root, two->count);
          },
          [two] { return two->count.pairs; }};
}

Contender bullet_balls_on_surface(Bodies const& start) {
  struct All {
    Surface surface;
    std::vector<btVector3> centers;
    btScalar radius;
    Count count;
  };
  auto all = std::make_shared<All>();
  all->surface.build(start.triangles, start.first);
  all->radius = btScalar(start.radius);
  return {[all](Bodies const& now) { all->centers = points(now.second); },
          [all] {
            all->count.pairs = 0;
            for (btVector3 const& c : all->centers)
              all->surface.tree.collideTV(
                  all->surface.tree.m_root, btDbvtVolume::FromCR(c, all->radius), all->count);
          },
          [all] { return all->count.pairs; }};
}

Contender bullet_balls(Bodies const& start) {
  struct All {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase phase;
    std::vector<btBroadphaseProxy*> proxies;
    std::vector<btVector3> centers;
    btVector3 radius;
  };
  auto all = std::make_shared<All>();
  const btScalar r = btScalar(start.radius);
  all->radius = {r, r, r};
  all->centers = points(start.first);
  for (btVector3 const& c : all->centers)
    all->proxies.push_back(all->phase.createProxy(c - all->radius,
                                                  c + all->radius,
                                                  SPHERE_SHAPE_PROXYTYPE,
                                                  &all->proxies,
                                                  btBroadphaseProxy::DefaultFilter,
                                                  btBroadphaseProxy::AllFilter,
                                                  &all->dispatcher));
  all->phase.optimize();
  return {[all](Bodies const& now) { all->centers = points(now.first); },
          [all] {
            for (std::size_t i = 0; i < all->centers.size(); ++i)
              all->phase.setAabb(all->proxies[i],
                                 all->centers[i] - all->radius,
                                 all->centers[i] + all->radius,
                                 &all->dispatcher);
            all->phase.calculateOverlappingPairs(&all->dispatcher);
          },
          [all] {
            // the cache holds pairs of wider boxes
            std::size_t n = 0;
            auto const& pairs = all->phase.getOverlappingPairCache()->getOverlappingPairArray();
            for (int k = 0; k < pairs.size(); ++k) {
              btBroadphaseProxy const &p = *pairs[k].m_pProxy0, &q = *pairs[k].m_pProxy1;
              n += TestAabbAgainstAabb2(p.m_aabbMin, p.m_aabbMax, q.m_aabbMin, q.m_aabbMax);
            }
            return n;
          }};
}

}  // namespace bench
