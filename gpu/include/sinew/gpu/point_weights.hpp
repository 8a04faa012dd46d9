// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/gpu/mapped_loops.hpp>
#include <sinew/mapping/carried_points.hpp>

#include <limits>
#include <vector>

namespace sinew {

namespace gpu {

/// A mapping in which each point of the child is a weighted sum of points of the parent,
///   x_i = sum_k w_ik X_k      F_k += sum_i w_ik f_i
/// as compressed rows both ways, children rising: the order of no sum depends on threads.
template <class In, class Out>
struct PointWeights {
  using Weight = typename In::Real;
  using Loops = PointLoops<In, Out>;
  template <class T>
  using Array = typename Loops::template Array<T>;
  struct Rows {
    Array<int> first{}, point{};
    Array<Weight> weight{};  // empty: all are 1
  };

  Rows ofChild{}, ofParent{};
  Loops loops{};

  /// each(add) calls add(child, parent, weight) for all that is not 0, children rising.
  template <class Each>
  void init(std::size_t parents, std::size_t children, Each const& each) {
    std::vector<int> below(children + 1, 0), above(parents + 1, 0), points, childOf;
    std::vector<Weight> weights;
    bool allOne = true;
    each([&](std::size_t child, std::size_t parent, Weight w) {
      ++below[child + 1];
      ++above[parent + 1];
      points.push_back(int(parent));
      childOf.push_back(int(child));
      weights.push_back(w);
      allOne = allOne && w == Weight(1);
    });
    if (points.size() > std::size_t(std::numeric_limits<int>::max()))
      throw Error("a mapping on a device",
                  text(points.size(), " weights exceed the range of an int, 2^31 - 1; split the body"));
    for (std::size_t i = 0; i < children; ++i) below[i + 1] += below[i];
    for (std::size_t k = 0; k < parents; ++k) above[k + 1] += above[k];
    std::vector<int> next(above.begin(), above.end() - 1), back(points.size());
    std::vector<Weight> weightsBack(points.size());
    for (std::size_t e = 0; e < points.size(); ++e) {
      const auto at = std::size_t(next[std::size_t(points[e])]++);
      back[at] = childOf[e];
      weightsBack[at] = weights[e];
    }
    if (allOne) weights.clear(), weightsBack.clear();
    ofChild = {std::move(below), std::move(points), std::move(weights)};
    ofParent = {std::move(above), std::move(back), std::move(weightsBack)};
    loops.init(parents, children);
  }

  void apply(typename Out::VecDeriv& out, typename In::VecDeriv const& in) const {
    loops.down(out, in, [&](LoopSide side) { return viewOf<Interpolate>(ofChild, side); });
  }
  void ask(typename Out::VecDeriv const& out, typename In::VecDeriv const& in) const {
    loops.ask(out, in, [&](LoopSide side) { return viewOf<Interpolate>(ofChild, side); });
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out) const {
    loops.up(in, out, [&](LoopSide side) { return viewOf<Gather>(ofParent, side); });
  }

  // what loops do

  struct View {
    int const *first, *point;
    Weight const* weight;  // null: all are 1
  };
  struct Interpolate : View {
    SINEW_HD void operator()(typename Out::Deriv& to, typename In::Deriv const* from, int i) const {
      typename In::Deriv sum = In::Deriv::Zero();
      for (int e = this->first[i]; e < this->first[i + 1]; ++e) {
        typename In::Deriv const& x = from[this->point[e]];
        sum += this->weight ? typename In::Deriv(this->weight[e] * x) : x;
      }
      to = sum.template cast<typename Out::Real>();
    }
  };
  struct Gather : View {
    SINEW_HD void operator()(typename In::Deriv& to, typename Out::Deriv const* from, int k) const {
      typename In::Deriv sum = to;
      for (int e = this->first[k]; e < this->first[k + 1]; ++e) {
        const typename In::Deriv f = from[this->point[e]].template cast<Weight>();
        sum += this->weight ? typename In::Deriv(this->weight[e] * f) : f;
      }
      to = sum;
    }
  };

 private:
  template <class V>
  static V viewOf(Rows const& rows, LoopSide side) {
    V view;
    const bool device = side == LoopSide::device;
    view.first = device ? entries(rows.first) : rows.first.data();
    view.point = device ? entries(rows.point) : rows.point.data();
    view.weight = rows.weight.empty() ? nullptr : device ? entries(rows.weight) : rows.weight.data();
    return view;
  }
};

}  // namespace gpu

template <class In, class Out>
requires(OnDevice<In> || OnDevice<Out>)
struct SubsetLoops<In, Out> {
  gpu::PointWeights<In, Out> weights{};

  void init(std::size_t parents, std::vector<int> const& indices) {
    weights.init(parents, indices.size(), [&](auto&& add) {
      for (std::size_t i = 0; i < indices.size(); ++i) add(i, std::size_t(indices[i]), 1);
    });
  }
  void ask(typename Out::VecDeriv const& out, typename In::VecDeriv const& in) const { weights.ask(out, in); }
  void apply(typename Out::VecDeriv& out, typename In::VecDeriv const& in, std::vector<int> const&) const {
    weights.apply(out, in);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out, std::vector<int> const&) const {
    weights.applyJT(in, out);
  }
};

template <class In, class Out>
requires(OnDevice<In> || OnDevice<Out>)
struct CarriedPoints<In, Out> {
  using Carriers = std::vector<Carrier<typename In::Real>>;
  gpu::PointWeights<In, Out> weights{};

  void init(std::size_t parents, Carriers const& carriers, Carriers const& others) {
    weights.init(parents, carriers.size(), [&](auto&& add) {
      for (std::size_t i = 0; i < carriers.size(); ++i)
        for (auto const* list : {&carriers, &others})
          for (std::size_t k = 0; k < 4 && !list->empty(); ++k)
            if ((*list)[i].weights[k] != 0) add(i, std::size_t((*list)[i].points[k]), (*list)[i].weights[k]);
    });
  }
  void ask(typename Out::VecDeriv const& out, typename In::VecDeriv const& in) const { weights.ask(out, in); }
  void apply(typename Out::VecDeriv& out, typename In::VecDeriv const& in, Carriers const&,
             Carriers const&) const {
    weights.apply(out, in);
  }
  void applyJT(typename In::VecDeriv& in, typename Out::VecDeriv const& out, Carriers const&,
               Carriers const&) const {
    weights.applyJT(in, out);
  }
};

}  // namespace sinew
