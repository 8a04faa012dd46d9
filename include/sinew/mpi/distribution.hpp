// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mpi/communicator.hpp>
#include <sinew/mpi/partition.hpp>
#include <sinew/scene/scope.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// The points of one state that two ranks have, and how their values come: from the owner to the others.
struct Halo {
  struct Neighbour {
    int rank;
    std::vector<int> sent;      // own points
    std::size_t first, ghosts;  // points here
    std::vector<std::byte> out{}, in{};
  };
  std::vector<int> parts{};      // rank of each point of the scene
  std::vector<Index> numbers{};  // of each point here, its number in the scene
  std::vector<std::size_t> ownedBy{};
  std::vector<int> ghostOwner{}, ghostNumber{};
  std::vector<Neighbour> neighbours{};

  Halo() = default;
  /// `bytes`: the most that is sent of a point at once.
  explicit Halo(Part&& part, int rank, std::size_t bytes)
      : parts(std::move(part.parts)),
        numbers(part.points.kept),
        ownedBy(std::move(part.ownedBy)),
        ghostOwner(std::move(part.ghostOwner)),
        ghostNumber(std::move(part.ghostNumber)) {
    std::size_t first = ownedBy[std::size_t(rank)];
    for (auto& [other, sent] : part.sent) {
      const auto ghosts = std::size_t(std::count(ghostOwner.begin(), ghostOwner.end(), other));
      auto& n = neighbours.emplace_back(Neighbour{other, std::move(sent), first, ghosts});
      n.out.resize(bytes * n.sent.size());
      n.in.resize(bytes * ghosts);
      first += ghosts;
    }
  }
};

/// Those of all states, and messages under way, which copies have none of.
struct Halos {
  std::vector<Halo> all{};
  std::vector<MPI_Request> messages{};

  Halos() = default;
  Halos(Halos&&) = default;
  Halos(Halos const& o) : all(o.all) { reserve(); }
  Halos& operator=(Halos&&) = default;
  Halos& operator=(Halos const& o) {
    all = o.all;
    reserve();
    return *this;
  }
  void add(Halo halo) {
    all.push_back(std::move(halo));
    reserve();
  }
  /// Where an error has ended the wait for them, they may still come.
  ~Halos() {
    auto pending = [](MPI_Request const& request) { return request != MPI_REQUEST_NULL; };
    if (std::any_of(messages.begin(), messages.end(), pending)) keep(std::move(all));
  }

 private:
  // one to each neighbour, and one from it
  void reserve() {
    std::size_t most = 0;
    for (Halo const& halo : all) most += 2 * halo.neighbours.size();
    messages.reserve(most);
  }
};

/// What this rank has sent to others so far, to be their ghost points.
struct Traffic {
  long exchanges = 0, messages = 0;
  std::size_t bytes = 0;
};

/// What a rank knows of a scene whose points are shared out among several: which are ghosts, and how their
/// values come from the ranks that own them. Mechanical operations ask it (scene/state_vectors.hpp,
/// scene/mechanical_forces.hpp): vectors are right at own points, sums are over these, and ghost points of
/// what a force or a product reads come before it, while it goes on with elements that need none.
class Distribution {
 public:
  Distribution() = default;
  explicit Distribution(std::shared_ptr<Communicator> ranks) : ranks_(std::move(ranks)) {}

  Communicator& ranks() const { return *ranks_; }
  /// Whether the scene is shared out already; before, each rank has all of it.
  bool active() const { return !halos_.all.empty(); }
  Halo const& halo(int number) const { return halos_.all[std::size_t(number)]; }
  void add(Halo halo, bool mapped) {
    halos_.add(std::move(halo));
    hasMapped_ = hasMapped_ || mapped;
  }
  /// Whether a state follows another that is shared out.
  bool hasMapped() const { return hasMapped_; }

  Traffic const& traffic() const { return traffic_; }

  double sum(double value) const { return active() ? ranks_->sum(value) : value; }

  /// Sends own points of these vectors to where they are ghosts, and expects its own ghosts.
  template <class Vectors, class... Ids>
  void begin(Vectors const& vectors, Ids... ids) {
    if (!active()) return;
    halos_.messages.clear();
    ++traffic_.exchanges;
    vectors.forEachIndependent([&](auto& s) {
      for (Halo::Neighbour& n : halos_.all[std::size_t(s.halo)].neighbours) {
        const std::size_t bytes = (sizeof(s[ids][0]) + ...);
        const std::size_t out = bytes * n.sent.size(), in = bytes * n.ghosts;
        if (n.out.size() < out) n.out.resize(out);
        if (n.in.size() < in) n.in.resize(in);
        std::byte* to = n.out.data();
        (pack(to, s[ids], n.sent), ...);
        if (n.ghosts > 0) halos_.messages.push_back(ranks_->receive(n.rank, n.in.data(), in, s.halo));
        if (n.sent.empty()) continue;
        halos_.messages.push_back(ranks_->send(n.rank, n.out.data(), out, s.halo));
        ++traffic_.messages;
        traffic_.bytes += out;
      }
    });
  }
  /// They have come.
  template <class Vectors, class... Ids>
  void end(Vectors const& vectors, Ids... ids) {
    if (!active()) return;
    ranks_->wait(halos_.messages, "ghost points of its neighbours");
    vectors.forEachIndependent([&](auto& s) {
      for (Halo::Neighbour const& n : halos_.all[std::size_t(s.halo)].neighbours) {
        std::byte const* from = n.in.data();
        (unpack(from, s[ids], n.first, n.ghosts), ...);
      }
    });
  }

  /// Where the blocks of a matrix here are in that of all ranks (PetscLayout): rank by rank, and in each
  /// state by state.
  template <class Operations, class Layout>
  void layout(Operations& operations, Layout& to, int blockSize, std::string_view where) const {
    using Number = typename decltype(to.rows)::value_type;
    const std::size_t count = std::size_t(ranks_->size());
    std::vector<std::int64_t> next(count + 1, 0);
    operations.forEachIndependent([&](auto& s) {
      constexpr int size = std::decay_t<decltype(s)>::DataTypes::size;
      if (size % blockSize != 0)
        throw Error(where,
                    text("points of ",
                         size,
                         " coordinates do not fill the blocks of ",
                         blockSize,
                         " of the matrix; take one of scalars, such as CompressedRowSparseMatrixd"));
      for (std::size_t r = 0; r < count; ++r)
        next[r + 1] += std::int64_t(halo(s.halo).ownedBy[r]) * (size / blockSize);
    });
    for (std::size_t r = 0; r < count; ++r) next[r + 1] += next[r];
    if (next.back() * blockSize > std::int64_t(std::numeric_limits<Number>::max()))
      throw Error(where,
                  text("the system has ",
                       next.back() * blockSize,
                       " unknowns, more than this PETSc can number; take one with 64-bit indices"));
    const auto own = std::size_t(ranks_->rank());
    to.begin = Number(next[own]);
    to.rows.clear();
    to.global.clear();
    operations.forEachIndependent([&](auto& s) {
      const int per = std::decay_t<decltype(s)>::DataTypes::size / blockSize;
      Halo const& h = halo(s.halo);
      for (std::size_t i = 0; i < s.owned() * std::size_t(per); ++i) {
        to.rows.push_back(Number(to.global.size()));
        to.global.push_back(Number(next[own] + std::int64_t(i)));
      }
      for (std::size_t g = 0; g < s.ghosts; ++g)
        for (int k = 0; k < per; ++k)
          to.global.push_back(
              Number(next[std::size_t(h.ghostOwner[g])] + std::int64_t(h.ghostNumber[g]) * per + k));
      for (std::size_t r = 0; r < count; ++r) next[r] += std::int64_t(h.ownedBy[r]) * per;
    });
  }

  /// The values at all points of the scene, in its order, on each rank. All ranks have to call it.
  template <class State, class Value>
  std::vector<Value> everywhere(State const& s, std::vector<Value> const& own) const {
    if (!active()) return own;
    Halo const& h = halo(s.halo);
    std::vector<Value> mine;
    for (std::size_t i = 0; i < own.size(); ++i)
      if (h.parts[std::size_t(h.numbers[i])] == ranks_->rank()) mine.push_back(own[i]);
    const auto byRank = ranks_->gather(mine, h.ownedBy, "values at the points of all ranks");
    std::vector<Value> all(h.parts.size());
    std::vector<std::size_t> next(1, 0);
    for (const std::size_t n : h.ownedBy) next.push_back(next.back() + n);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = byRank[next[std::size_t(h.parts[i])]++];
    return all;
  }

 private:
  std::shared_ptr<Communicator> ranks_{};
  Halos halos_{};
  bool hasMapped_ = false;
  Traffic traffic_{};

  template <class Values>
  static void pack(std::byte*& to, Values const& values, std::vector<int> const& points) {
    for (const int i : points) {
      std::memcpy(to, &values[std::size_t(i)], sizeof values[0]);
      to += sizeof values[0];
    }
  }
  template <class Values>
  static void unpack(std::byte const*& from, Values& values, std::size_t first, std::size_t count) {
    std::memcpy(static_cast<void*>(values.data() + first), from, count * sizeof values[0]);
    from += count * sizeof values[0];
  }
};

/// What is above the root of a distributed scene.
struct DistributedTop : NoScope {
  static constexpr bool distributed = true;
  mutable Distribution parts{};

  Distribution& distribution() const { return parts; }
};

/// The root of a typed scene that is distributed.
template <class N>
struct DistributedNode : N {
  DistributedTop aboveRoot{};

  Distribution& distribution() { return aboveRoot.parts; }
};

}  // namespace sinew::mpi

namespace sinew {
template <class N>
struct ScopeOf<mpi::DistributedNode<N>, NoScope> {
  using type = typename ScopeOf<N, mpi::DistributedTop>::type;
};
}  // namespace sinew
