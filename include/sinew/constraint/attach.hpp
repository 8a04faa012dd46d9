// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/component.hpp>
#include <sinew/core/ends.hpp>

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Point indices2[i] is attached to point indices1[i], of another body (`E` = Between<"a", "b/c">, at a
/// common ancestor; `E` = Linked in a runtime tree) or of the same (`E` = Within).
///   twoWay: they move as one point, P = 1/n (1 1'; 1 1') over all n that are joined. Positions, velocities
///   and, under explicit solvers, accelerations become their mean by mass, which keeps momentum. else: the
///   second follows the first, which does not feel it.
/// Of rigid bodies the orientations are joined too, unless there are `freeRotations`. A point that another
/// constraint holds should be the first of an attachment that is not twoWay.
template <class D, class E = Within>
struct AttachProjectiveConstraint {
  using Ends = E;
  template <class Other>
  using WithEnds = AttachProjectiveConstraint<D, Other>;
  static constexpr bool between = !std::is_same_v<E, Within>;
  using Role = role::ProjectiveConstraint;
  using DataTypes = D;
  using Real = typename D::Real;
  using VecCoord = typename D::VecCoord;
  using VecDeriv = typename D::VecDeriv;
  static constexpr std::string_view className = "AttachProjectiveConstraint";
  static constexpr std::string_view aliases = "AttachConstraint";
  static constexpr bool needsMasses = true;

  std::vector<int> indices1{}, indices2{};
  [[no_unique_address]] E ends{};
  bool twoWay = false, freeRotations = false;
  std::vector<double> constraintFactor{};

  static constexpr auto fields() {
    using F = AttachProjectiveConstraint;
    return field_list(field("indices1", &F::indices1, "", "points of the first body", range::nonNegative)
                          .numbersOf(Of::points),
                      field("indices2",
                            &F::indices2,
                            "",
                            "points of the second that are attached to them",
                            range::nonNegative)
                          .numbersOf(Of::secondPoints),
                      field("twoWay", &F::twoWay, "", "the first body feels the second"),
                      field("freeRotations",
                            &F::freeRotations,
                            "",
                            "rigid bodies rotate freely about where they are attached"),
                      field("constraintFactor",
                            &F::constraintFactor,
                            "",
                            "whether each pair is attached, 1 or 0; all are where none is given",
                            range::closed(0, 1))
                          .oneEach(Of::entries));
  }

  struct Member {
    int side, point;
    Real weight;  // in the mean: of all of a group together 1
  };
  std::vector<Member> members{};       // group by group: the first leads where the attachment is not twoWay
  std::vector<std::size_t> groups{0};  // where each begins, and the end
  std::vector<int> dofs{};             // of one group in the matrix

  void init(InitContext<D> const& context) { init(context, context); }
  void init(InitContext<D> const& a, InitContext<D> const& b) {
    const std::string where = text(a.where, ": ", component_name<AttachProjectiveConstraint>());
    const std::size_t n = indices1.size();
    auto same = [&](std::string_view name, std::size_t size) {
      if (size != n)
        throw Error(
            where,
            text("indices1 has ", n, " points and ", name, ' ', size, " entries; give one for each pair"));
    };
    auto check = [&](std::string_view name, InitContext<D> const& end, int i) {
      if (i < 0 || std::size_t(i) >= end.rest.size())
        throw Error(where,
                    text(name,
                         " has ",
                         i,
                         ", but the state of ",
                         end.where,
                         " has ",
                         end.rest.size(),
                         " points, numbered from 0; correct the index"));
    };
    same("indices2", indices2.size());
    if (!constraintFactor.empty()) same("constraintFactor", constraintFactor.size());
    std::vector<std::vector<Member>> found;
    for (std::size_t k = 0; k < n; ++k) {
      check("indices1", a, indices1[k]);
      check("indices2", b, indices2[k]);
      if (!between && indices1[k] == indices2[k])
        throw Error(where, text("point ", indices1[k], " is attached to itself; give two points"));
      const double factor = constraintFactor.empty() ? 1 : constraintFactor[k];
      if (factor != 0 && factor != 1)
        throw Error(
            where,
            text("constraintFactor[", k, "] is ", factor, ", but a pair is attached or not; give 1 or 0"));
      if (factor == 1) join(where, found, {0, indices1[k], 0}, {between ? 1 : 0, indices2[k], 0});
    }
    members.clear();
    groups.assign(1, 0);
    std::size_t maximum = 0;
    for (auto& group : found) {
      weigh(group, a, b);
      members.insert(members.end(), group.begin(), group.end());
      groups.push_back(members.size());
      maximum = std::max(maximum, group.size());
    }
    dofs.assign(maximum, 0);
  }

  template <class... V>
  requires(sizeof...(V) == (between ? 2 : 1))
  void projectResponse(V&... dx) const {
    const std::array<VecDeriv*, sizeof...(V)> states{&dx...};
    forEachGroup([&](std::span<Member const> group) {
      if (twoWay)
        shareMean(states, group, [&](Member const&) { return Real(1) / Real(group.size()); });
      else
        for (Member const& m : group.subspan(1))
          for (int c = 0; c < coordinates(); ++c) of(states, m)[c] = 0;
    });
  }
  template <class... V>
  requires(sizeof...(V) == (between ? 2 : 1))
  void projectAcceleration(V&... a) const {
    if (twoWay)
      projectVelocity(0.0, a...);
    else
      projectResponse(a...);
  }
  template <class... V>
  requires(sizeof...(V) == (between ? 2 : 1))
  void projectVelocity(double /*time*/, V&... v) const {
    const std::array<VecDeriv*, sizeof...(V)> states{&v...};
    forEachGroup([&](std::span<Member const> group) {
      shareMean(states, group, [](Member const& m) { return m.weight; });
    });
  }
  template <class... X>
  requires(sizeof...(X) == (between ? 2 : 1))
  void projectPosition(double /*time*/, X&... x) const {
    const std::array<VecCoord*, sizeof...(X)> states{&x...};
    forEachGroup([&](std::span<Member const> group) {
      auto mean = of(states, group[0]);
      typename D::Deriv displacement = D::Deriv::Zero();
      for (Member const& m : group)
        displacement += m.weight * D::difference(of(states, group[0]), of(states, m));
      D::increment(mean, displacement);
      for (Member const& m : group)
        if (freeRotations)
          D::setCenter(of(states, m), D::center(mean));
        else
          of(states, m) = mean;
    });
  }

  /// Adds the blocks between joined points to the pattern of the matrix.
  template <class Sink>
  void preallocate(Sink const& sink) {
    if (twoWay)
      forEachGroup(
          [&](std::span<Member const> group) { sink.preallocateMean(dofsOf(sink, group), coordinates()); });
  }
  template <class Sink>
  void projectMatrix(Sink const& sink) {
    forEachGroup([&](std::span<Member const> group) {
      if (twoWay) return sink.projectToMean(dofsOf(sink, group), coordinates());
      for (const int dof : dofsOf(sink, group.subspan(1)))
        for (int c = 0; c < coordinates(); ++c) sink.fixDof(dof + c);
    });
  }

 private:
  // joined are the first coordinates of a point
  int coordinates() const { return freeRotations ? D::spatial : D::size; }

  template <class V>
  static auto& of(V const& states, Member const& m) {
    return (*states[std::size_t(m.side)])[std::size_t(m.point)];
  }
  template <class F>
  void forEachGroup(F&& f) const {
    for (std::size_t g = 0; g + 1 < groups.size(); ++g)
      f(std::span(members).subspan(groups[g], groups[g + 1] - groups[g]));
  }
  template <class V, class Weight>
  void shareMean(V const& states, std::span<Member const> group, Weight&& weight) const {
    // that of equal values is the same to the last bit
    const typename D::Deriv first = of(states, group[0]);
    typename D::Deriv mean = first;
    for (Member const& m : group) mean += weight(m) * (of(states, m) - first);
    for (Member const& m : group)
      for (int c = 0; c < coordinates(); ++c) of(states, m)[c] = mean[c];
  }
  template <class Sink>
  std::span<int const> dofsOf(Sink const& sink, std::span<Member const> group) {
    for (std::size_t i = 0; i < group.size(); ++i)
      dofs[i] =
          group[i].side == 0 ? sink.template dof<0>(group[i].point) : sink.template dof<1>(group[i].point);
    return std::span(dofs).first(group.size());
  }

  // the group that a point is in, among those found so far
  static std::size_t groupOf(std::vector<std::vector<Member>> const& found, Member const& m) {
    for (std::size_t g = 0; g < found.size(); ++g)
      for (Member const& other : found[g])
        if (other.side == m.side && other.point == m.point) return g;
    return found.size();
  }
  void join(std::string const& where, std::vector<std::vector<Member>>& found, Member first,
            Member second) const {
    const std::size_t n = found.size();
    std::size_t g = groupOf(found, first), h = groupOf(found, second);
    if (!twoWay &&
        (h != n || (g != n && (found[g][0].side != first.side || found[g][0].point != first.point))))
      throw Error(where,
                  text("point ",
                       h != n ? second.point : first.point,
                       " is attached twice, as a point that follows; attach it once, or take twoWay"));
    if (g == n) found.push_back({first}), g = n;
    if (h == n) {
      found[g].push_back(second);
    } else if (h != g) {
      found[g].insert(found[g].end(), found[h].begin(), found[h].end());
      found.erase(found.begin() + std::ptrdiff_t(h));
    }
  }
  void weigh(std::vector<Member>& group, InitContext<D> const& a, InitContext<D> const& b) const {
    if (!twoWay) {
      group[0].weight = 1;
      return;
    }
    double sum = 0;
    const bool known = !a.masses.empty() && !b.masses.empty();
    auto mass = [&](Member const& m) {
      return known ? (m.side == 0 ? a : b).masses[std::size_t(m.point)] : 1;
    };
    for (Member const& m : group) sum += mass(m);
    for (Member& m : group) m.weight = Real(mass(m) / sum);
  }
};

}  // namespace sinew
