// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/distributed/devices.hpp>
#include <sinew/gpu/fused/simulation.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sinew::gpu {

/// Copies of a typed scene, shared out among several devices, on each of which they are a FusedSimulation.
/// Simulations of the scene are on the device that is current where they are made.
template <class Root>
class DistributedCopies {
  static constexpr char const* name = "DistributedCopies";

 public:
  /// Throws Error as FusedSimulation does, and where there are fewer copies than devices.
  DistributedCopies(Simulation<Root>& simulation, int copies, std::vector<int> devices = all_devices())
      : group_(std::move(devices), name), copies_(copies) {
    if (copies < int(group_.size()))
      throw Error(name, text(copies, " copies are to be on ", group_.size(), " devices; take fewer devices"));
    FusedSimulation<Root>::settle(simulation);
    group_.each([&](std::size_t k) {
      const int own = begin(k + 1) - begin(k);
      all_.push_back(std::make_unique<FusedSimulation<Root>>(simulation, own));
    });
    group_.wait();
  }

  void load(int copy, Simulation<Root>& from) {
    const std::size_t k = deviceOf(copy);
    FusedSimulation<Root>::settle(from);
    const UseDevice use(group_.device(k));
    all_[k]->load(copy - begin(k), from);
    gpu::wait();
  }
  void store(int copy, Simulation<Root>& to) const {
    const std::size_t k = deviceOf(copy);
    FusedSimulation<Root>::settle(to);
    const UseDevice use(group_.device(k));
    all_[k]->store(copy - begin(k), to);
    gpu::wait();
  }
  /// Makes steps of dt seconds in all copies; returns before they are done.
  void animate(double dt, int steps = 1) {
    group_.each([&](std::size_t k) { all_[k]->animate(dt, steps); });
  }
  /// Waits for the steps that were asked for, and throws what FusedSimulation does, with its numbers of
  /// copies counted from the first on the device.
  void finish() {
    group_.wait();
    group_.each([&](std::size_t k) {
      try {
        all_[k]->finish();
      } catch (Error const& error) {
        throw Error(text("GPU ", group_.device(k), ", whose first copy is ", begin(k)), error.what());
      }
    });
  }

  int copies() const { return copies_; }
  /// The copies on one of the devices, and the first of them.
  FusedSimulation<Root>& on(std::size_t k) { return *all_.at(k); }
  int first(std::size_t k) const { return begin(k); }

 private:
  DeviceGroup group_;
  int copies_;
  std::vector<std::unique_ptr<FusedSimulation<Root>>> all_{};

  int begin(std::size_t k) const { return int(std::size_t(copies_) * k / group_.size()); }
  std::size_t deviceOf(int copy) const {
    if (copy < 0 || copy >= copies_)
      throw Error(name, text("there is no copy ", copy, "; the ", copies_, " are numbered from 0"));
    std::size_t k = 0;
    while (copy >= begin(k + 1)) ++k;
    return k;
  }
};

}  // namespace sinew::gpu
