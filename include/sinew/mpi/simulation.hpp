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
#include <sinew/scene/states_of.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

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
  /// f(scope of the root) sees the whole scene before it is shared out. Another time and step than 0 are
  /// those of a checkpoint, which may be of another number of ranks.
  template <class F>
  void init(F&& f, double time = 0, long step = 0) {
    ranks_->collectively("init", [&] {
      refuse_undistributed(scopeOf(local_.root()));
      local_.init(time, step);
      f(scopeOf(local_.root()));
      if (keepsWhole_ && ranks_->rank() == 0) whole_.emplace(local_.root());
      local_.reduce([&](auto& root) {
        const auto scope = scopeOf(root);
        ShareOut(scope, root.distribution()).apply();
      });
#ifdef __GLIBC__
      malloc_trim(0);  // what the whole scene took goes back to the machine
#endif
    });
  }
  void animate(double dt) {
    ranks_->collectively("step " + std::to_string(local_.step() + 1), [&] { local_.animate(dt); });
  }

  /// Before init: rank 0 keeps the whole scene beside its part, for whole().
  void keepWhole() { keepsWhole_ = true; }
  /// The scene as one process would have it now, on rank 0, and null on the others: what a checkpoint is made
  /// of. Throws Error where a component keeps values from step to step that are not gathered.
  N const* whole() {
    ranks_->collectively("the whole scene", [&] {
      refuseKept();
      gather();
    });
    return whole_ ? &*whole_ : nullptr;
  }
  /// f(scope of the root) sees the same on rank 0, with visual models where they are now, of which parts have
  /// no vertices. What components keep from step to step is that of the start there.
  template <class F>
  void look(F&& f) {
    ranks_->collectively("the scene to be looked at", [&] {
      gather();
      if (!whole_) return;
      const auto all = scopeOf(*whole_);
      LiveEngines<std::decay_t<decltype(all)>>{all, local_.time()}.update(false);
      update_visuals(all);
      f(all);
    });
  }

  /// Those of Simulation, on each rank, after keepWhole(): rank 0 adds them up over the whole scene [J].
  struct Energies {
    double kinetic, potential;
  };
  Energies energies() {
    std::vector<double> found(2, 0);
    ranks_->collectively("the energies", [&] {
      refuseKept();
      gather();
      if (whole_) {
        traverse(scopeOf(*whole_), on<role::Mass>([&](auto& c, auto const& at) {
                   with_states_of(
                       c, at, [&](auto& s) { found[0] += c.kineticEnergy(s.position, s.velocity); });
                 }));
        traverse(scopeOf(*whole_),
                 on<role::ForceField, role::InteractionForceField>([&](auto& c, auto const& at) {
                   with_states_of(c, at, [&](auto&... s) { found[1] += potential_energy(c, s.position...); });
                 }));
      }
      ranks_->broadcast(found, "the energies of the scene, from rank 0");
    });
    return {found[0], found[1]};
  }

  double time() const { return local_.time(); }
  long step() const { return local_.step(); }
  Communicator& ranks() const { return *ranks_; }
  /// The part of this rank: own points, then ghosts.
  auto& root() { return local_.root(); }
  auto scope() { return scopeOf(local_.root()); }
  /// Positions and velocities of ghosts are those of their owners.
  void bringGhosts() {
    ranks_->collectively("ghost points", [&] {
      const auto all = scope();
      MechanicalOperations operations(all, local_.time());
      operations.bringGhosts(vec_id::position, vec_id::velocity);
      operations.propagate(vec_id::position, vec_id::velocity);
    });
  }
  /// What is known of the points of a state that is shared out.
  Halo const& halo(auto const& state) { return local_.root().distribution().halo(state.halo); }
  Traffic const& traffic() { return local_.root().distribution().traffic(); }
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
  bool keepsWhole_ = false;
  std::optional<DistributedNode<N>> whole_{};
  static constexpr NoScope above_{};

  // contacts, which each rank finds, of points that it has in the order of the whole scene
  template <class C>
  static constexpr bool sameOnAll = HasRole<C, role::ContactManager>;
  // other lists that steps change, beside vectors of states
  void refuseKept() {
    if (!keepsWhole_) return;
    traverse(scope(), on<AnyRole>([](auto& c, auto const& at) { refuseKept(c, at.path()); }));
  }
  template <class C>
  static void refuseKept(C const& c, std::string const& where) {
    if constexpr (requires { C::state(); } && !sameOnAll<C>)
      hana::for_each(C::state(), [&](auto const& fd) {
        auto const& value = c.*fd.member;
        if constexpr (requires { value.empty(); })
          if (!value.empty())
            throw Error(
                text(where, ": ", component_name<C>()),
                text("keeps ",
                     fd.name,
                     " from step to step, which is not gathered from ranks yet; run the scene without "
                     "checkpoints, or in one process"));
      });
  }
  void gather() {
    if (!keepsWhole_) throw Error("DistributedSimulation::whole", "call keepWhole() before init()");
    // both trees have the same components in the same order
    std::vector<void*> here;
    traverse(scope(), on<AnyRole>([&](auto& c, auto const&) { here.push_back(&c); }));
    auto& parts = local_.root().distribution();
    std::size_t next = 0;
    if (whole_) {
      traverse(scopeOf(*whole_), on<AnyRole>([&](auto& c, auto const&) {
                 using C = std::decay_t<decltype(c)>;
                 C const& from = *static_cast<C const*>(here[next++]);
                 if constexpr (HasRole<C, role::State>) {
                   c.position = parts.everywhere(from, from.position);
                   c.velocity = parts.everywhere(from, from.velocity);
                   c.dx = parts.everywhere(from, from.dx);
                 } else if constexpr (sameOnAll<C>) {
                   copy_fields(from, C::state(), c, C::state());
                 }
               }));
    } else {
      traverse(scope(), on<role::State>([&](auto& s, auto const&) {
                 parts.everywhere(s, s.position);
                 parts.everywhere(s, s.velocity);
                 parts.everywhere(s, s.dx);
               }));
    }
  }
  static auto scopeOf(DistributedNode<N>& root) {
    using S = typename ScopeOf<DistributedNode<N>, NoScope>::type;
    return S{root, root.aboveRoot};
  }
};
template <class N>
DistributedSimulation(N, std::shared_ptr<Communicator>) -> DistributedSimulation<N>;

}  // namespace sinew::mpi
