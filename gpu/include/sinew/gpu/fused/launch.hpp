// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/device_vector.hpp>
#include <sinew/gpu/fused/plan.hpp>
#include <sinew/gpu/fused/step.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace sinew::gpu {

namespace detail {

#if SINEW_CUDA
/// Threads of a block, and how many entries of a row each keeps in so many of the registers that are then
/// there for it (128 and 168).
inline constexpr int cluster_threads = 512, grid_threads = 384;
template <class Body, int Registers>
inline constexpr int kept_in =
    std::min(Body::keptEntries, Registers / (Body::components * int(sizeof(typename Body::Real) / 4)));

template <int Lanes, class Body>
using FusedCluster = ClusterTeam<Lanes, kept_in<Body, 36>>;
template <int Lanes, class Body>
using FusedGrid = GridTeam<Lanes, kept_in<Body, 64>>;

template <int Lanes, class Body>
__global__ void __launch_bounds__(cluster_threads, 1) fused_kernel(Body body) {
  extern __shared__ __align__(16) unsigned char shared[];
  fused_steps(FusedCluster<Lanes, Body>(), body, shared);
}
template <int Lanes, class Body>
__global__ void __launch_bounds__(grid_threads, 1) fused_grid_kernel(Body body, GridMemory memory) {
  extern __shared__ __align__(16) unsigned char shared[];
  fused_steps(FusedGrid<Lanes, Body>(memory), body, shared);
}
#endif

}  // namespace detail

/// How a copy runs: by the blocks of a launch, or those of a cluster; threads of a block, threads a row,
/// bytes of shared memory a block.
struct FusedShape {
  bool grid = false;
  int blocks = 1, threads = 1, lanes = 1;
  std::size_t shared = 0;
};

/// Chooses how copies of a body run, and runs their steps.
template <class Body>
class FusedLauncher {
 public:
  /// `blocks` above 16 asks for the blocks of a launch. Where it is 0: a single copy takes these, unless one
  /// block has a thread for every entry; several the smallest of the clusters whose memory holds the body, or
  /// a larger one, up to a thread for every entry, where all copies still run at once. Throws Error where the
  /// body is too large for them.
  FusedPlan choose(std::vector<std::vector<int>> const& neighbours, int copies, int blocks) {
    copies_ = copies;
    FusedPlan plan = shaped(neighbours, blocks);
    if (shape_.grid) {
      sums_.resize(2 * 2 * std::size_t(shape_.blocks));
      if (Body::touches) joint_.resize(2 * most_joined * std::size_t(shape_.blocks));
      arrived_ = DeviceVector<unsigned long long>(2, 0ull);
      announced_.resize(std::size_t(shape_.blocks));
      nearFirst_ = plan.nearFirst;
      near_ = plan.near;
    }
    return plan;
  }

  FusedShape const& shape() const { return shape_; }
  /// A body with the sizes of the plan, and nothing else yet.
  Body const& sizes() const { return sizes_; }

  /// Steps of all copies; returns before they are done.
  void run(Body body) {
    body.sharedFirst = std::as_const(sharedFirst_).device();
#if SINEW_CUDA
    if (shape_.grid)
      launch(gridKernel(),
             body,
             GridMemory{arrived_.device(),
                        parity_,
                        announced_.data(),
                        sums_.data(),
                        joint_.data(),
                        std::as_const(nearFirst_).device(),
                        std::as_const(near_).device()});
    else
      launch(clusterKernel(), body);
    parity_ = 1 - parity_;
#else
    std::vector<double> shared(shape_.shared / sizeof(double) + 1);
    for (int c = 0; c < copies_; ++c)
      fused_steps(SerialTeam{.copy = c}, body, reinterpret_cast<unsigned char*>(shared.data()));
#endif
  }

 private:
  int copies_ = 1;
  FusedShape shape_{};
  Body sizes_{};
  DeviceVector<int> sharedFirst_{};
  // of a grid (GridMemory)
  DeviceArray<double> sums_{}, joint_{};
  DeviceArray<unsigned> announced_{};
  DeviceVector<int> nearFirst_{}, near_{};
  DeviceVector<unsigned long long> arrived_{};
  int parity_ = 0;

  FusedPlan shaped(std::vector<std::vector<int>> const& neighbours, int blocks) {
#if SINEW_CUDA
    char const* const what = "FusedSimulation";
    int device = 0, maximum = 0, processors = 0, clusters = 0;
    gpu::check(cudaGetDevice(&device), what);
    gpu::check(cudaDeviceGetAttribute(&maximum, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), what);
    gpu::check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), what);
    gpu::check(cudaDeviceGetAttribute(&clusters, cudaDevAttrClusterLaunch, device), what);
    std::size_t entries = neighbours.size();
    for (auto const& n : neighbours) entries += n.size();
    auto fits = [&](FusedPlan const& plan, bool grid, int minimum) {
      using Cluster = detail::FusedCluster<1, Body>;
      using Grid = detail::FusedGrid<1, Body>;
      for (const int lanes : {8, 4, 2, 1}) {
        if (lanes < minimum || (!grid && !plan.possible())) return false;
        take(plan, lanes * (grid ? Grid::keptEntries : Cluster::keptEntries));
        const std::size_t shared = grid ? sizes_.template shared<Grid>() : sizes_.template shared<Cluster>();
        const int threads = (plan.widest * lanes + 31) / 32 * 32 + (grid ? Grid::helpers : 0);
        shape_ = {grid, plan.ranks, threads, lanes, shared};
        if (threads <= (grid ? detail::grid_threads : detail::cluster_threads) &&
            shared <= std::size_t(maximum))
          return true;
      }
      return false;
    };
    if (copies_ == 1 && (blocks == 0 ? entries > detail::cluster_threads : blocks > 16)) {
      // 16 rows a block while that leaves a quarter of the GPU idle, since many blocks exchange sums slower
      // than few; else as few as have eight threads a row, or all
      struct Candidate {
        int blocks, lanes;
      };
      constexpr int rows = (detail::grid_threads - detail::FusedGrid<1, Body>::helpers) / 8;
      const int nodes = int(neighbours.size());
      const std::vector<Candidate> candidates =
          blocks == 0
              ? std::vector<Candidate>{{std::min((nodes + 15) / 16, std::max(1, processors * 3 / 4)), 8},
                                       {(nodes + rows - 1) / rows, 8},
                                       {processors, 2}}
              : std::vector<Candidate>{{std::min(blocks, processors), 2}};
      for (const Candidate candidate : candidates) {
        if (candidate.blocks > processors) continue;
        FusedPlan plan(neighbours, candidate.blocks);
        if (fits(plan, true, candidate.lanes)) return plan;
      }
    }
    std::optional<FusedPlan> chosen;
    for (const int more : {1, 2, 4, 8, 16}) {
      if (blocks != 0 && more != blocks) continue;
      const bool enough = chosen && std::size_t(chosen->ranks) * detail::cluster_threads >= entries;
      if (enough || (more > 1 && !clusters)) break;
      FusedPlan plan(neighbours, more);
      if (fits(plan, false, 1) && (!chosen || copies_ <= copiesAtOnce())) chosen = std::move(plan);
    }
    if (chosen) {
      fits(*chosen, false, 1);
      return *std::move(chosen);
    }
    throw Error(what,
                text("a body of ",
                     neighbours.size(),
                     " points and ",
                     entries,
                     " blocks of the matrix does not fit into the shared memory of ",
                     blocks == 0 ? std::string("the GPU's blocks") : text(blocks, " blocks"),
                     "; take Simulation, whose memory is that of the GPU, or CudaVec3f for CudaVec3d"));
#else
    (void)blocks;
    FusedPlan plan(neighbours, 1);
    take(plan, 0);
    shape_.shared = sizes_.template shared<SerialTeam>();
    return plan;
#endif
  }
  void take(FusedPlan const& plan, int kept) {
    FusedPlan::Shared shared = plan.shared(kept);
    sharedFirst_ = std::move(shared.first);
    sizes_.rows = plan.rows;
    sizes_.widest = plan.widest;
    sizes_.entriesOfWidest = shared.maximum;
    sizes_.longestVector = plan.longestVector;
  }

#if SINEW_CUDA
  auto clusterKernel() const {
    return shape_.lanes == 8   ? detail::fused_kernel<8, Body>
           : shape_.lanes == 4 ? detail::fused_kernel<4, Body>
           : shape_.lanes == 2 ? detail::fused_kernel<2, Body>
                               : detail::fused_kernel<1, Body>;
  }
  auto gridKernel() const {
    return shape_.lanes == 8   ? detail::fused_grid_kernel<8, Body>
           : shape_.lanes == 4 ? detail::fused_grid_kernel<4, Body>
                               : detail::fused_grid_kernel<2, Body>;
  }
  // `attribute` is what the configuration refers to
  template <class Kernel>
  cudaLaunchConfig_t configuration(Kernel kernel, cudaLaunchAttribute& attribute) const {
    char const* const what = "FusedSimulation";
    gpu::check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, int(shape_.shared)),
               what);
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(unsigned(copies_ * shape_.blocks));
    config.blockDim = dim3(unsigned(shape_.threads));
    config.dynamicSmemBytes = shape_.shared;
    config.stream = stream();
    config.attrs = &attribute;
    config.numAttrs = shape_.blocks > 1;
    if (shape_.grid) {
      attribute.id = cudaLaunchAttributeCooperative;
      attribute.val.cooperative = 1;
    } else {
      if (shape_.blocks > 8)
        gpu::check(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), what);
      attribute.id = cudaLaunchAttributeClusterDimension;
      attribute.val.clusterDim.x = unsigned(shape_.blocks);
      attribute.val.clusterDim.y = attribute.val.clusterDim.z = 1;
    }
    return config;
  }
  // how many clusters of the shape the GPU runs at the same time
  int copiesAtOnce() const {
    cudaLaunchAttribute attribute{};
    const cudaLaunchConfig_t config = configuration(clusterKernel(), attribute);
    int count = 0;
    gpu::check(cudaOccupancyMaxActiveClusters(&count, clusterKernel(), &config), "FusedSimulation");
    return count;
  }
  template <class... Arguments>
  void launch(void (*kernel)(Arguments...), std::type_identity_t<Arguments>... arguments) const {
    cudaLaunchAttribute attribute{};
    const cudaLaunchConfig_t config = configuration(kernel, attribute);
    gpu::check(cudaLaunchKernelEx(&config, kernel, arguments...), "FusedSimulation::animate");
  }
#endif
};

}  // namespace sinew::gpu
