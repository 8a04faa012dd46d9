// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/scene/body_of_points.hpp>
#include <sinew/topology/blade_crossings.hpp>
#include <sinew/topology/cut_plan.hpp>

#include <vector>

namespace sinew {

/// What is to be cut, and how.
struct CutOrder {
  BladeStroke stroke;
  CutRules rules{};
  CutFront front{};  // what the blade was not done with
  std::vector<Eigen::Vector3d>
      before{};  // where the points were when the blade started; empty: where they are
};

/// What a cut has done.
struct Cut {
  TopologyChange change{};
  std::size_t elements = 0;  // through which the blade has gone
  std::size_t faces = 0;     // that have parted
  CutFront front{};          // what the blade is not done with
};

/// A body that is cut: tetrahedra or triangles over points in space.
template <class RootScope>
class CutBody : public BodyOfPoints<RootScope> {
 public:
  using typename BodyOfPoints<RootScope>::Body;
  using BodyOfPoints<RootScope>::states, BodyOfPoints<RootScope>::bodies;

  /// Throws Error where something stands on these points that cannot follow.
  CutBody(RootScope const& root, void const* topology, void const* state)
      : BodyOfPoints<RootScope>(root, state), root_(root), topology_(topology) {
    checkBodies();
    this->checkValues("its body is to be cut");
    traverse(root_, on<role::State>([&](auto& s, auto const& scope) {
               if (static_cast<void const*>(&s) == state) take(s, scope.path());
             }));
  }

  /// Where the points are.
  std::vector<Eigen::Vector3d> const& positions() const { return x_; }

  CutPlan plan(CutOrder const& order) const {
    std::vector<TopologyView> views;
    std::vector<bool> grows;
    std::size_t first = 0;
    for (std::size_t t = 0; t < bodies.size(); ++t) {
      if (bodies[t].address == topology_) first = t;
      views.push_back(bodies[t].view);
      grows.push_back(!this->mechanical.contains(bodies[t].address));
    }
    TopologyView const& body = views[first];
    if (!order.before.empty() && order.before.size() != x_.size())
      throw Error(bodies[first].path, "the points before the stroke are not those of the body");
    CutFront front = order.front;
    if (!body.tetrahedra.empty())
      add_crossings(body.tetrahedra, x_, order.before, order.stroke, front);
    else
      add_crossings(body.triangles, x_, order.before, order.stroke, front);
    try {
      return plan_cut(rest_, views, first, grows, front, order.rules);
    } catch (Error const& error) {
      throw Error(bodies[first].path, error.what());
    }
  }

 private:
  RootScope const& root_;
  void const* topology_;
  std::vector<Eigen::Vector3d> x_{}, rest_{};

  void checkBodies() const {
    traverse(root_, on<role::Topology>([this](auto& t, auto const& scope) {
               if (!states.contains(scope.pointsAddress())) return;
               using T = std::decay_t<decltype(t)>;
               constexpr bool editable = requires { t.edit(); };
               const TopologyView view = t.view();
               for_each_kind(view, [&](int kind, auto const& list) {
                 if (!list.empty() && list[0].size() > std::size_t(dimension_of_kind(kind)) + 1)
                   throw Error(text(scope.path(), ": ", component_name<T>()),
                               text("a ",
                                    element_kind_name(kind),
                                    " is not cut; give the body tetrahedra "
                                    "(Hexa2TetraTopologicalMapping), or triangles"));
               });
               if (static_cast<void const*>(&t) != topology_) return;
               if (!editable)
                 throw Error(
                     text(scope.path(), ": ", component_name<T>()),
                     "the elements of this topology are made from a few numbers, and none of them can be "
                     "cut; give the node a MeshTopology with these elements");
               if (view.tetrahedra.empty() && view.triangles.empty())
                 throw Error(text(scope.path(), ": ", component_name<T>()),
                             "there are neither tetrahedra nor triangles to cut; give it some");
             }));
  }

  template <class State>
  void take(State const& s, std::string const& path) {
    using D = typename State::DataTypes;
    if constexpr (D::rigid || D::spatial != 3 || D::size != 3) {
      throw Error(path, "bodies of points in space are cut (Vec3d, Vec3f), and this state has others");
    } else {
      for (auto const& x : s.position) x_.push_back(x.template cast<double>());
      for (auto const& x : s.restPosition) rest_.push_back(x.template cast<double>());
    }
  }
};

}  // namespace sinew
