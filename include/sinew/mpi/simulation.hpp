// SPDX-License-Identifier: BSL-1.0
#pragma once

// A typed scene that several processes step together, each its part of it:
//   mpi::Session session(argc, argv);
//   auto ranks = std::make_shared<mpi::Communicator>();
//   mpi::DistributedSimulation sim{node<"root">(...), ranks};
//   sim.init();
//   while (sim.time() < 10) sim.animate(0.02);
//   auto positions = sim.everywhere(sim.root().state(), vec_id::position);
// docs/mpi.md says what is distributed and how.
#include <sinew/mpi/share_out.hpp>
#include <sinew/scene/simulation.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// All functions but time() and root() are to be called by all ranks; where one throws, all throw the same
/// Error.
template <class N>
class DistributedSimulation {
 public:
  explicit DistributedSimulation(N scene, std::shared_ptr<Communicator> ranks)
      : ranks_(ranks), local_(DistributedNode<N>{std::move(scene), {{}, Distribution(std::move(ranks))}}) {}

  /// Each rank initialises the whole scene, as one process would, and then keeps its part. Throws Error where
  /// a component is not distributed yet, where ranks have other scenes, and where there are more ranks than
  /// parts.
  void init() {
    init([](auto const&) {});
  }
  /// f(scope of the root) sees the whole scene before it is shared out.
  template <class F>
  void init(F&& f) {
    ranks_->collectively("init", [&] {
      refuse_undistributed(scopeOf(local_.root()));
      local_.init();
      f(scopeOf(local_.root()));
      local_.change([&](auto& next) {
        const auto scope = scopeOf(next);
        return ShareOut(scope, next.distribution()).apply();
      });
    });
  }
  void animate(double dt) {
    ranks_->collectively("step", [&] { local_.animate(dt); });
  }

  double time() const { return local_.time(); }
  long step() const { return local_.step(); }
  Communicator& ranks() const { return *ranks_; }
  /// The part of this rank: own points, then ghosts.
  auto& root() { return local_.root(); }
  auto scope() { return scopeOf(local_.root()); }
  /// A vector of a state, at all points of the scene, in its order.
  template <class State, class Id>
  auto everywhere(State& state, Id id) {
    auto values = state[id];
    ranks_->collectively("everywhere",
                         [&] { values = local_.root().distribution().everywhere(state, state[id]); });
    return values;
  }

 private:
  std::shared_ptr<Communicator> ranks_;
  Simulation<DistributedNode<N>> local_;
  static constexpr NoScope above_{};

  static auto scopeOf(DistributedNode<N>& root) {
    using S = typename ScopeOf<DistributedNode<N>, NoScope>::type;
    return S{root, root.aboveRoot};
  }
};
template <class N>
DistributedSimulation(N, std::shared_ptr<Communicator>) -> DistributedSimulation<N>;

}  // namespace sinew::mpi
