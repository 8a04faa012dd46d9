// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/data_types.hpp>
#include <sinew/mapping/mapped_loops.hpp>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew {

namespace gpu {

// the bodies of the loops: body(to[i], from, i), or the same with a sum that begins at zero
template <class Body, class To, class From>
struct Each {
  Body body;
  To* to;
  From const* from;
  SINEW_HD void operator()(int i) const { body(to[i], from, i); }
};
template <class Body, class To, class From>
Each(Body, To*, From const*) -> Each<Body, To, From>;
template <class Body, class To, class From>
struct EachSum {
  Body body;
  To* to;
  From const* from;
  SINEW_HD void operator()(int i) const {
    To sum = To::Zero();
    body(sum, from, i);
    to[i] = sum;
  }
};
template <class Body, class To, class From>
EachSum(Body, To*, From const*) -> EachSum<Body, To, From>;
template <class T>
struct Plus {
  T* to;
  T const* from;
  SINEW_HD void operator()(int i) const { to[i] += from[i]; }
};

/// Where a loop of the host writes all entries of a vector.
template <class T>
T* overwritten_on_host(std::vector<T>& v) {
  return v.data();
}
template <class T>
T* overwritten_on_host(DeviceVector<T>& v) {
  return v.overwriteOnHost();
}

/// Where the loops of a mapping have to look for its tables.
enum class LoopSide { host, device };

/// The loops of a mapping with both states on a device, or one there and one on the host. Of the latter, the
/// vector of fewer bytes crosses, and the loops run on the other side: a device makes the points of a surface
/// and sends those, where the surface has fewer than the body; else it sends the body's.
///
/// `bodies(side)` gives what makes one entry, an object with a SINEW_HD operator and addresses of that side:
///   body(out[i], in, i)   of down      body(in[i], out, i)   of up, which adds all that the child does to i
template <class In, class Out>
struct PointLoops {
  static constexpr bool across = OnDevice<In> != OnDevice<Out>;
  using Device = std::conditional_t<OnDevice<In>, In, Out>;
  using Host = std::conditional_t<OnDevice<In>, Out, In>;
  template <class T>
  using Array = typename Device::template Array<T>;

  bool atDevice = OnDevice<In> && OnDevice<Out>;

  // what the host has, or is to get, of both kinds of vectors; and the sum of what it adds to a device
  mutable Array<typename Host::Coord> coords{};
  mutable Array<typename Host::Deriv> derivs{};
  mutable Array<typename In::Deriv> sums{};
  mutable bool asked = false;  // whether the device makes what is to go down

  void init(std::size_t parents, std::size_t children) {
    const std::size_t above = parents * sizeof(typename In::Deriv),
                      below = children * sizeof(typename Out::Deriv);
    atDevice = !across || (OnDevice<In> ? below < above : above < below);
  }

  /// Begins what down(), called next with the same arguments, brings from a device to the host: the work and
  /// its copy are queued there, and not waited for.
  template <class To, class From, class Bodies>
  void ask(To const& out, From const& in, Bodies const& bodies) const {
    if constexpr (across && OnDevice<In>) {
      if (atDevice) {
        auto& workspace = like(out);
        workspace.resize(out.size());
        each_point<Device>(out.size(), Each{bodies(LoopSide::device), overwritten(workspace), entries(in)});
        bring_to_host(workspace);
        asked = true;
      } else {
        bring_to_host(in);
      }
    }
  }

  template <class To, class From, class Bodies>
  void down(To& out, From const& in, Bodies const& bodies) const {
    if constexpr (!across) {
      each_point<Device>(out.size(), Each{bodies(LoopSide::device), overwritten(out), entries(in)});
    } else if (!atDevice) {
      onThisHost(out.size(), Each{bodies(LoopSide::host), overwritten_on_host(out), in.data()});
    } else if constexpr (OnDevice<In>) {
      if (!asked) ask(out, in, bodies);
      asked = false;
      std::copy_n(std::as_const(like(out)).data(), out.size(), out.data());
    } else {
      auto& workspace = like(in);
      workspace.assign(in.begin(), in.end());
      each_point<Device>(out.size(),
                         Each{bodies(LoopSide::device), overwritten(out), entries(std::as_const(workspace))});
    }
  }

  template <class To, class From, class Bodies>
  void up(To& in, From const& out, Bodies const& bodies) const {
    if constexpr (!across) {
      each_point<Device>(in.size(), Each{bodies(LoopSide::device), entries(in), entries(out)});
    } else if constexpr (OnDevice<In>) {
      // without forces on the host there is nothing to transfer
      if (std::all_of(out.begin(), out.end(), [](auto const& f) { return f.isZero(0); })) return;
      if (atDevice) {
        derivs.assign(out.begin(), out.end());
        each_point<Device>(in.size(),
                           Each{bodies(LoopSide::device), entries(in), entries(std::as_const(derivs))});
      } else {
        sums.resize(in.size());
        onThisHost(in.size(), EachSum{bodies(LoopSide::host), overwritten_on_host(sums), out.data()});
        addSums(in);
      }
    } else if (atDevice) {
      sums.resize(in.size());
      each_point<Device>(in.size(), EachSum{bodies(LoopSide::device), overwritten(sums), entries(out)});
      for (std::size_t i = 0; i < in.size(); ++i) in[i] += std::as_const(sums).data()[i];
    } else {
      onThisHost(in.size(), Each{bodies(LoopSide::host), in.data(), out.data()});
    }
  }
  /// in += `sums`, which the host has filled.
  template <class To>
  void addSums(To& in) const {
    each_point<Device>(in.size(), Plus<typename In::Deriv>{entries(in), entries(std::as_const(sums))});
  }

 private:
  template <class Loop>
  static void onThisHost(std::size_t count, Loop const& loop) {
    for (std::size_t i = 0; i < count; ++i) loop(int(i));
  }
  // buffer for a copy of a vector of the host
  template <class V>
  auto& like(V const&) const {
    if constexpr (std::is_same_v<typename V::value_type, typename Host::Deriv>)
      return derivs;
    else
      return coords;
  }
};

/// What a mapping makes of one point, as a loop takes it.
template <class Point>
struct OfOnePoint {
  Point point;
  template <class To, class From>
  SINEW_HD void operator()(To& to, From const* from, int i) const {
    point(to, from[i]);
  }
};

}  // namespace gpu

template <class In, class Out>
requires(OnDevice<In> || OnDevice<Out>)
struct MappedLoops<In, Out> {
  gpu::PointLoops<In, Out> loops{};

  void init(std::size_t parents, std::size_t children) { loops.init(parents, children); }
  template <class To, class From, class Point>
  void ask(To const& out, From const& in, Point const& point) const {
    loops.ask(out, in, [&](gpu::LoopSide) { return gpu::OfOnePoint<Point>{point}; });
  }
  template <class To, class From, class Point>
  void apply(To& out, From const& in, Point const& point) const {
    loops.down(out, in, [&](gpu::LoopSide) { return gpu::OfOnePoint<Point>{point}; });
  }
  template <class To, class From, class Point>
  void applyJT(To& in, From const& out, Point const& point) const {
    loops.up(in, out, [&](gpu::LoopSide) { return gpu::OfOnePoint<Point>{point}; });
  }
};

}  // namespace sinew
