// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs MPI. CMake's target sinew::mpi brings it.
#include <sinew/core/error.hpp>

#include <mpi.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::mpi {

/// Where the ranks of one machine are, in memory that they share: what is known of one that does not answer.
/// Ranks of other machines are not on it.
class Board {
 public:
  /// All of these ranks have to call it.
  explicit Board(MPI_Comm ranks) {
    MPI_Comm_split_type(ranks, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here_);
    MPI_Comm_set_errhandler(here_, MPI_ERRORS_RETURN);
    int rank = 0, count = 0, all = 0;
    MPI_Comm_rank(here_, &rank);
    MPI_Comm_size(here_, &count);
    MPI_Comm_size(ranks, &all);
    void* own = nullptr;
    // where there is no room for it, nothing is on it
    if (MPI_Win_allocate_shared(sizeof(Place), 1, MPI_INFO_NULL, here_, &own, &window_) != MPI_SUCCESS) {
      window_ = MPI_WIN_NULL;
      return;
    }
    own_ = new (own) Place;
    MPI_Barrier(here_);
    std::vector<int> these, theirs(std::size_t(count), 0);
    for (int r = 0; r < count; ++r) these.push_back(r);
    MPI_Group machine, whole;
    MPI_Comm_group(here_, &machine);
    MPI_Comm_group(ranks, &whole);
    MPI_Group_translate_ranks(machine, count, these.data(), whole, theirs.data());
    MPI_Group_free(&machine);
    MPI_Group_free(&whole);
    places_.assign(std::size_t(all), nullptr);
    for (int r = 0; r < count; ++r) {
      MPI_Aint bytes = 0;
      int unit = 0;
      void* at = nullptr;
      MPI_Win_shared_query(window_, r, &bytes, &unit, &at);
      places_[std::size_t(theirs[std::size_t(r)])] = static_cast<Place*>(at);
      if (r == 0) first_ = static_cast<Place*>(at);
    }
  }
  Board(Board const&) = delete;
  Board& operator=(Board const&) = delete;
  /// All ranks have to call it, where they are still in step.
  void close() {
    if (window_ != MPI_WIN_NULL) MPI_Win_free(&window_);
    if (here_ != MPI_COMM_NULL) MPI_Comm_free(&here_);
  }

  /// What this rank does from now on, a verb and its object: "waits for ", "ghost points".
  void write(std::string_view does, std::string_view what = {}) {
    if (!own_) return;
    std::size_t n = 0;
    for (std::string_view const part : {does, what})
      for (std::size_t i = 0; i < part.size() && n < length; ++i)
        own_->words[n++].store(part[i], std::memory_order_relaxed);
    own_->size.store(n, std::memory_order_relaxed);
    own_->since.store(now(), std::memory_order_relaxed);
  }
  /// What a rank does, and for how long: "is in PETSc's solver, for 12 s"; empty where nobody knows.
  std::string read(int rank) const {
    Place const* const place = std::size_t(rank) < places_.size() ? places_[std::size_t(rank)] : nullptr;
    if (!place) return {};
    std::string words(std::min(place->size.load(std::memory_order_relaxed), length), ' ');
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = place->words[i].load(std::memory_order_relaxed);
    if (words.empty()) return {};
    return text(words, ", for ", (now() - place->since.load(std::memory_order_relaxed)) / 1000, " s");
  }
  /// How many ranks there are on this machine.
  int ranksHere() const {
    return int(std::count_if(places_.begin(), places_.end(), [](Place* p) { return p != nullptr; }));
  }
  /// Whether this is the first call on this machine. A handler of signals may call it.
  bool first() const { return !first_ || first_->said.exchange(1) == 0; }

 private:
  static constexpr std::size_t length = 160;
  struct Place {
    std::atomic<long> since{0};  // [ms]
    std::atomic<std::size_t> size{0};
    std::atomic<int> said{0};
    std::array<std::atomic<char>, length> words{};
  };
  MPI_Comm here_ = MPI_COMM_NULL;
  MPI_Win window_ = MPI_WIN_NULL;
  Place *own_ = nullptr, *first_ = nullptr;
  std::vector<Place*> places_{};

  static long now() {
    using namespace std::chrono;
    return long(duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count());
  }
};

}  // namespace sinew::mpi
