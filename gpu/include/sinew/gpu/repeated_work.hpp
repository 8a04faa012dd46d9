// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/execution.hpp>

#include <utility>

namespace sinew::gpu {

/// Work on a device that is the same each time: a GPU has it as a graph, since the launch of a small kernel
/// takes longer than what it does.
class RepeatedWork {
 public:
  RepeatedWork() = default;
  RepeatedWork(RepeatedWork&& other) noexcept { *this = std::move(other); }
  RepeatedWork& operator=([[maybe_unused]] RepeatedWork&& other) noexcept {
    forget();
#if SINEW_CUDA
    graph_ = std::exchange(other.graph_, nullptr);
#endif
    return *this;
  }
  ~RepeatedWork() { forget(); }

  /// work() asks for no result, and for no memory that has not been there before.
  template <class Work>
  void run([[maybe_unused]] char const* what, Work&& work) {
#if SINEW_CUDA
    if (!graph_) {
      cudaGraph_t graph = nullptr;
      check(cudaStreamBeginCapture(stream(), cudaStreamCaptureModeThreadLocal), what);
      try {
        work();
      } catch (...) {
        cudaStreamEndCapture(stream(), &graph);
        if (graph) cudaGraphDestroy(graph);
        throw;
      }
      check(cudaStreamEndCapture(stream(), &graph), what);
      const cudaError_t made = cudaGraphInstantiate(&graph_, graph, 0);
      cudaGraphDestroy(graph);
      check(made, what);
    }
    check(cudaGraphLaunch(graph_, stream()), what);
#else
    work();
#endif
  }
  /// The next time it is other work.
  void forget() {
#if SINEW_CUDA
    if (graph_) cudaGraphExecDestroy(graph_);
    graph_ = nullptr;
#endif
  }

 private:
#if SINEW_CUDA
  cudaGraphExec_t graph_ = nullptr;
#endif
};

}  // namespace sinew::gpu
