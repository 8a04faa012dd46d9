// SPDX-License-Identifier: BSL-1.0
// FCL: BVHModel of boxes for surfaces, refitted bottom-up; DynamicAABBTreeCollisionManager for balls.
#include "collision.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/detail/traversal/collision/bvh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/traversal_recurse.h>

namespace bench {

namespace {

using Model = fcl::BVHModel<fcl::AABBd>;

std::vector<fcl::Vector3d> points(Coordinates const& x) {
  std::vector<fcl::Vector3d> all(x.size() / 3);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  return all;
}

// counts the pairs of leaves whose boxes overlap, in place of testing the triangles
struct Count : fcl::detail::BVHCollisionTraversalNode<fcl::AABBd> {
  mutable std::size_t pairs = 0;
  void leafTesting(int, int) const override { ++pairs; }
};

struct Surface {
  Model model;
  std::vector<fcl::Vector3d> x;

  void build(std::vector<std::array<int, 3>> const& list, Coordinates const& start) {
    x = points(start);
    std::vector<fcl::Triangle> triangles;
    for (auto const& t : list)
      triangles.emplace_back(std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2]));
    model.beginModel();
    model.addSubModel(x, triangles);
    model.endModel();
  }
  void refit() {
    model.beginReplaceModel();
    model.replaceSubModel(x);
    model.endReplaceModel(true, true);
  }
};

}  // namespace

Contender fcl_surfaces(Bodies const& start) {
  struct Two {
    Surface a, b;
    Count count;
  };
  auto two = std::make_shared<Two>();
  two->a.build(start.triangles, start.first);
  two->b.build(start.triangles, start.second);
  two->count.model1 = &two->a.model;
  two->count.model2 = &two->b.model;
  return {[two](Bodies const& now) { two->a.x = points(now.first), two->b.x = points(now.second); },
          [two] {
            two->a.refit();
            two->b.refit();
            two->count.pairs = 0;
            fcl::detail::collisionRecurse(
                static_cast<fcl::detail::CollisionTraversalNodeBase<double>*>(&two->count), 0, 0, nullptr);
          },
          [two] { return two->count.pairs; }};
}

Contender fcl_balls(Bodies const& start, bool refit) {
  struct All {
    std::vector<fcl::CollisionObjectd> balls;
    fcl::DynamicAABBTreeCollisionManagerd manager;
    std::vector<fcl::CollisionObjectd*> list;
    std::vector<fcl::Vector3d> centers;
    std::size_t pairs = 0;
  };
  auto all = std::make_shared<All>();
  auto ball = std::make_shared<fcl::Sphered>(start.radius);
  ball->computeLocalAABB();
  all->centers = points(start.first);
  all->balls.reserve(all->centers.size());
  for (auto const& c : all->centers) {
    all->balls.emplace_back(ball, fcl::Matrix3d::Identity(), c);
    all->list.push_back(&all->balls.back());
  }
  all->manager.registerObjects(all->list);
  all->manager.setup();
  return {[all](Bodies const& now) { all->centers = points(now.first); },
          [all, refit] {
            for (std::size_t i = 0; i < all->centers.size(); ++i) {
              all->balls[i].setTranslation(all->centers[i]);
              all->balls[i].computeAABB();
            }
            if (refit)
              all->manager.update();
            else
              all->manager.update(all->list);
            all->pairs = 0;
            all->manager.collide(&all->pairs,
                                 [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* pairs) {
                                   *static_cast<std::size_t*>(pairs) += a->getAABB().overlap(b->getAABB());
                                   return false;
                                 });
          },
          [all] { return all->pairs; }};
}

}  // namespace bench
