// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/component.hpp>
#include <sinew/core/data_types.hpp>
#include <sinew/mapping/articulation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// The tree that centers and their articulations make of bodies: places in lists, without values.
struct ArticulationTree {
  struct Joint {
    int parent, child, center;
    std::size_t begin, end;  // of its articulations in `order`
  };
  std::vector<Joint> joints{};  // each after those that bear its parent
  std::vector<int> order{};     // articulations, joint by joint, as they act
  std::vector<int> chain{};     // of each body, the places in `order` of what moves it, from its base on
  std::vector<std::size_t> starts{0};  // of its part of the chain
  std::vector<bool> borne{};           // each body
  std::vector<int> base{};             // of each body: the one that bears all of its chain, and is not borne

  /// Throws Error where a list names what is not there, a body is borne twice, in a ring or by nothing that
  /// moves it in a direction, and where angles do not say where a body is.
  void init(std::string const& where, std::vector<ArticulationCenter> const& centers,
            std::vector<Articulation> const& articulations, std::size_t values,
            std::string const& whereValues, std::size_t bodies);
};

/// What moves with the bodies of an articulated system over Out.
template <class In, class Out>
struct ArticulatedBodies {
  using Real = typename Out::Real;
  using Vec3 = Vec<Real, 3>;
  using Mat3 = Mat<Real, 3>;
  using Deriv = typename Out::Deriv;

  struct Joint {
    std::size_t parent, child, begin, end;
    Vec3 onParent, onChild;
  };
  struct Move {
    std::size_t value;
    bool rotation, translation;
    Vec3 axis;              // of unit length
    Vec3 direction, place;  // d and p at the last apply: the axis and the center, in the world
    Vec3 turned;            // w at the last updateK: how its force changes as something before it turns
  };
  ArticulationTree tree{};
  std::vector<Joint> joints{};
  std::vector<Move> moves{};
  typename Out::VecCoord bodies{};  // at the last apply
  // sums over a body and all that it bears: f and the torque about its centre; f (x - c)', and t
  typename Out::VecDeriv wrenches{};
  struct Moments {
    Mat3 lever;
    Vec3 torque;
  };
  std::vector<Moments> moments{};
  typename Out::VecDeriv products{};  // (dJ/dt) v

  void init(std::string const& where, std::vector<ArticulationCenter> const& centers,
            std::vector<Articulation> const& articulations, std::size_t values,
            std::string const& whereValues, typename Out::VecCoord& positions) {
    if (positions.empty()) {
      int last = 0;
      for (auto const& c : centers) last = std::max({last, c.parentIndex, c.childIndex});
      positions.resize(std::size_t(last) + 1);
    }
    const std::size_t n = positions.size();
    tree.init(where, centers, articulations, values, whereValues, n);
    joints.clear(), moves.clear();
    for (auto const& j : tree.joints) {
      ArticulationCenter const& c = centers[std::size_t(j.center)];
      joints.push_back({std::size_t(j.parent),
                        std::size_t(j.child),
                        j.begin,
                        j.end,
                        c.posOnParent.cast<Real>(),
                        c.posOnChild.cast<Real>()});
    }
    const Vec3 zero = Vec3::Zero();
    for (const int a : tree.order) {
      Articulation const& one = articulations[std::size_t(a)];
      const bool moving = one.rotation || one.translation;
      moves.push_back({std::size_t(one.articulationIndex),
                       one.rotation,
                       one.translation,
                       moving ? Vec3(one.axis.normalized().cast<Real>()) : zero,
                       zero,
                       zero,
                       zero});
    }
    bodies = positions;
    wrenches.assign(n, Deriv::Zero());
    moments.assign(n, {Mat3::Zero(), zero});
    products.assign(n, Deriv::Zero());
  }

  /// Puts the bodies where the values have them.
  void apply(typename Out::VecCoord& out, typename In::VecCoord const& in) {
    for (Joint const& joint : joints) {
      auto const& from = bodies[joint.parent];
      auto& to = bodies[joint.child];
      Quat<Real> turn = from.orientation;
      Vec3 place = from.center + turn * joint.onParent;
      for (std::size_t m = joint.begin; m < joint.end; ++m) {
        Move& move = moves[m];
        const Real value = Real(in[move.value][0]);
        move.direction = turn * move.axis;
        if (move.translation) place += value * move.direction;
        if (move.rotation) turn = turn * Quat<Real>(Eigen::AngleAxis<Real>(value, move.axis));
        move.place = place;
      }
      to.orientation = turn.normalized();
      to.center = place - to.orientation * joint.onChild;
    }
    out = bodies;
  }
  void applyJ(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    for (std::size_t b = 0; b < out.size(); ++b)
      if (!tree.borne[b]) out[b].setZero();
    for (Joint const& joint : joints) {
      const Vec3 from = bodies[joint.parent].center;
      Vec3 v = linear(out[joint.parent]), w = angular(out[joint.parent]), at = from;
      for (std::size_t m = joint.begin; m < joint.end; ++m) {
        Move const& move = moves[m];
        const Vec3 rate = Real(in[move.value][0]) * move.direction;
        v += w.cross(move.place - at);
        at = move.place;
        if (move.translation) v += rate;
        if (move.rotation) w += rate;
      }
      linear(out[joint.child]) = v + w.cross(bodies[joint.child].center - at);
      angular(out[joint.child]) = w;
    }
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) {
    sumWrenches(out);
    for (Joint const& joint : joints) {
      Deriv const& wrench = wrenches[joint.child];
      for (std::size_t m = joint.begin; m < joint.end; ++m) {
        Move const& move = moves[m];
        Real sum = 0;
        if (move.translation) sum += move.direction.dot(linear(wrench));
        if (move.rotation) sum += move.direction.dot(about(joint.child, move.place));
        in[move.value][0] += typename In::Real(sum);
      }
    }
  }
  /// f(value, column of J) for the rows of a body.
  template <class F>
  void forEachColumn(int body, F&& f) const {
    for (std::size_t k = tree.starts[std::size_t(body)]; k < tree.starts[std::size_t(body) + 1]; ++k) {
      Move const& move = moves[std::size_t(tree.chain[k])];
      Deriv column = Deriv::Zero();
      if (move.translation) linear(column) += move.direction;
      if (move.rotation) {
        linear(column) += move.direction.cross(bodies[std::size_t(body)].center - move.place);
        angular(column) = move.direction;
      }
      f(int(move.value), column);
    }
  }

  /// (dJ/dt) v: the accelerations of bodies of which no value, and no base, has an acceleration.
  typename Out::VecDeriv const& velocityProducts(typename In::VecDeriv const& rates,
                                                 typename Out::VecDeriv const& v) {
    for (std::size_t b = 0; b < products.size(); ++b)
      if (!tree.borne[b]) products[b].setZero();
    for (Joint const& joint : joints) {
      Vec3 a = linear(products[joint.parent]), alpha = angular(products[joint.parent]),
           w = angular(v[joint.parent]), at = bodies[joint.parent].center;
      const auto go = [&](Vec3 const& to) {
        const Vec3 arm = to - at;
        a += alpha.cross(arm) + w.cross(w.cross(arm));
        at = to;
      };
      for (std::size_t m = joint.begin; m < joint.end; ++m) {
        Move const& move = moves[m];
        const Vec3 rate = Real(rates[move.value][0]) * move.direction, turned = w.cross(rate);
        go(move.place);
        if (move.translation) a += 2 * turned;
        if (move.rotation) alpha += turned, w += rate;
      }
      go(bodies[joint.child].center);
      linear(products[joint.child]) = a;
      angular(products[joint.child]) = alpha;
    }
    return products;
  }

  void updateK(typename Out::VecDeriv const& f) {
    sumWrenches(f);
    for (std::size_t b = 0; b < f.size(); ++b) moments[b] = {Mat3::Zero(), angular(f[b])};
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
      moments[joint->parent].lever += leverAbout(joint->child, bodies[joint->parent].center);
      moments[joint->parent].torque += moments[joint->child].torque;
    }
    for (Joint const& joint : joints)
      for (std::size_t m = joint.begin; m < joint.end; ++m) {
        Move& move = moves[m];
        move.turned.setZero();
        if (move.translation) move.turned += move.direction.cross(linear(wrenches[joint.child]));
        if (move.rotation) {
          const Mat3 lever = leverAbout(joint.child, move.place);
          move.turned += lever.transpose() * move.direction - lever.trace() * move.direction +
                         move.direction.cross(moments[joint.child].torque) / 2;
        }
      }
  }
  /// f(value, value, k) for the pairs of values of which K_g has k, those of different values once.
  template <class F>
  void forEachStiffness(F&& f) const {
    for (Joint const& joint : joints) {
      const std::size_t from = tree.starts[joint.child], to = tree.starts[joint.child + 1];
      for (std::size_t m = joint.begin; m < joint.end; ++m)
        for (std::size_t k = from; k < to && std::size_t(tree.chain[k]) <= m; ++k) {
          Move const &before = moves[std::size_t(tree.chain[k])], &move = moves[m];
          f(int(before.value),
            int(move.value),
            before.rotation ? before.direction.dot(move.turned) : Real(0));
        }
    }
  }
  void addKx(typename In::VecDeriv& df, typename In::VecDeriv const& dx, double factor) const {
    forEachStiffness([&](int i, int j, Real k) {
      const auto scaled = typename In::Real(Real(factor) * k);
      df[std::size_t(i)][0] += scaled * dx[std::size_t(j)][0];
      if (i != j) df[std::size_t(j)][0] += scaled * dx[std::size_t(i)][0];
    });
  }

  /// add(i, j, block) for the blocks of factor K_g.
  template <class Add>
  void addToMatrix(double factor, Add const& add) const {
    forEachStiffness([&](int i, int j, Real k) {
      const auto block = Mat<typename In::Real, 1>::Constant(typename In::Real(Real(factor) * k)).eval();
      add(i, j, block);
      if (i != j) add(j, i, block);
    });
  }

  /// f(value, w) for what moves bodies that a base bears: a turn of the base changes its force by w.
  template <class F>
  void forEachTurned(std::size_t root, F&& f) const {
    for (Joint const& joint : joints)
      if (std::size_t(tree.base[joint.child]) == root)
        for (std::size_t m = joint.begin; m < joint.end; ++m) f(int(moves[m].value), moves[m].turned);
  }
  /// What the turns of a base with its bodies add to the stiffness, symmetric.
  Mat3 turning(std::size_t root) const {
    Mat3 const& lever = moments[root].lever;
    return (lever + lever.transpose()) / 2 - lever.trace() * Mat3::Identity();
  }

  static auto linear(Deriv& d) { return d.template head<3>(); }
  static auto linear(Deriv const& d) { return d.template head<3>(); }
  static auto angular(Deriv& d) { return d.template tail<3>(); }
  static auto angular(Deriv const& d) { return d.template tail<3>(); }

  void sumWrenches(typename Out::VecDeriv const& f) {
    wrenches = f;
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) {
      Deriv& sum = wrenches[joint->parent];
      angular(sum) += about(joint->child, bodies[joint->parent].center);
      linear(sum) += linear(wrenches[joint->child]);
    }
  }

 private:
  // the torque on a body and all that it bears about a place
  Vec3 about(std::size_t body, Vec3 const& place) const {
    const Vec3 force = linear(wrenches[body]), arm = bodies[body].center - place;
    return angular(wrenches[body]) + arm.cross(force);
  }
  // the sum of f (x - place)' of them
  Mat3 leverAbout(std::size_t body, Vec3 const& place) const {
    return moments[body].lever + linear(wrenches[body]) * (bodies[body].center - place).transpose();
  }
};

}  // namespace sinew

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

namespace sinew {

SINEW_ONCE void ArticulationTree::init(std::string const& where,
                                       std::vector<ArticulationCenter> const& centers,
                                       std::vector<Articulation> const& articulations, std::size_t values,
                                       std::string const& whereValues, std::size_t bodies) {
  if (centers.empty())
    throw Error(
        where,
        "there is no center, so that nothing moves the bodies; give `centers` and `articulations`, or "
        "in a scene file an ArticulatedHierarchyContainer with ArticulationCenters");
  auto check = [&](std::string_view list,
                   std::size_t i,
                   std::string_view what,
                   int number,
                   std::size_t count,
                   std::string_view of) {
    if (number < 0 || std::size_t(number) >= count)
      throw Error(where,
                  text(list,
                       '[',
                       i,
                       "] has ",
                       what,
                       ' ',
                       number,
                       ", but there are ",
                       count,
                       ' ',
                       of,
                       ", numbered from 0; correct it"));
  };
  std::vector<int> bearer(bodies, -1);  // the center that bears each body
  for (std::size_t c = 0; c < centers.size(); ++c) {
    ArticulationCenter const& one = centers[c];
    check("centers", c, "parentIndex", one.parentIndex, bodies, "bodies");
    check("centers", c, "childIndex", one.childIndex, bodies, "bodies");
    int& by = bearer[std::size_t(one.childIndex)];
    if (by >= 0)
      throw Error(where,
                  text("body ",
                       one.childIndex,
                       " is borne by centers[",
                       by,
                       "] and by centers[",
                       c,
                       "]; a body is borne once: join the second one by springs or constraints"));
    by = int(c);
  }
  std::vector<int> movedBy(values, -1);
  std::vector<std::vector<int>> ofCenter(centers.size());
  for (std::size_t a = 0; a < articulations.size(); ++a) {
    Articulation const& one = articulations[a];
    check("articulations", a, "center", one.center, centers.size(), "centers");
    check("articulations",
          a,
          "articulationIndex",
          one.articulationIndex,
          values,
          text("values in ", whereValues));
    const double length = one.axis.norm();
    if ((one.rotation || one.translation) && !(length > 0 && length < 1e150))
      throw Error(where,
                  text("articulations[",
                       a,
                       "] has the axis ",
                       one.axis[0],
                       ' ',
                       one.axis[1],
                       ' ',
                       one.axis[2],
                       ", which has no direction; give it one"));
    int& other = movedBy[std::size_t(one.articulationIndex)];
    if (other >= 0)
      throw Error(where,
                  text("articulations[",
                       other,
                       "] and [",
                       a,
                       "] have the same value, ",
                       one.articulationIndex,
                       "; give each one of its own"));
    other = int(a);
    ofCenter[std::size_t(one.center)].push_back(int(a));
  }
  // axes of a body: what is along them stands before all turns, or behind
  for (std::size_t c = 0; c < centers.size(); ++c) {
    const ArticulationProcess process = centers[c].articulationProcess;
    if (process == ArticulationProcess::sequential) continue;
    auto turns = [&](int a) { return articulations[std::size_t(a)].rotation; };
    auto& list = ofCenter[c];
    if (std::count_if(list.begin(), list.end(), turns) > 1)
      throw Error(where,
                  text("centers[",
                       c,
                       "] turns about several axes of one body (articulationProcess ",
                       int(process),
                       "): where the bodies are would depend on how they came there, and not on the angles "
                       "alone; take articulationProcess 0, or a center with a body for each axis"));
    std::stable_partition(list.begin(), list.end(), [&](int a) {
      return turns(a) == (process == ArticulationProcess::onChild);
    });
  }

  // centers in an order in which each comes after what bears it
  joints.clear(), order.clear(), chain.clear();
  starts.assign(1, 0);
  base.assign(bodies, -1);
  borne.assign(bodies, false);
  std::vector<std::vector<int>> moving(bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    borne[b] = bearer[b] >= 0;
    if (!borne[b]) base[b] = int(b);
  }
  for (bool more = true; more;) {
    more = false;
    for (std::size_t c = 0; c < centers.size(); ++c) {
      const auto from = std::size_t(centers[c].parentIndex), to = std::size_t(centers[c].childIndex);
      if (base[to] >= 0 || base[from] < 0) continue;
      base[to] = base[from];
      more = true;
      moving[to] = moving[from];
      const std::size_t begin = order.size();
      for (const int a : ofCenter[c]) {
        moving[to].push_back(int(order.size()));
        order.push_back(a);
      }
      joints.push_back({int(from), int(to), int(c), begin, order.size()});
    }
  }
  for (std::size_t b = 0; b < bodies; ++b)
    if (base[b] < 0)
      throw Error(where,
                  text("body ",
                       b,
                       " is borne in a ring; leave out the center that closes it, and join its ends by "
                       "springs or constraints"));
  for (auto const& list : moving) {
    chain.insert(chain.end(), list.begin(), list.end());
    starts.push_back(chain.size());
  }
}

}  // namespace sinew
#endif
