// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/gpu/gpu.hpp>
#include <sinew/scene/simulation.hpp>

namespace sinew::gpu {

/// recording(), as long as it lives.
struct Recording {
  Recording() { recording() = true; }
  Recording(Recording const&) = delete;
  ~Recording() { recording() = false; }
};

/// The step of a simulation as a CUDA graph: recorded once, then launched as one piece of work. What the host
/// computes in a step is recorded as the device sees it then, so a scene whose step asks the device for a
/// result, moves points by its clock, collides or writes files cannot be recorded (CUDA says so, or the same
/// forces are used again); bodies on the device with CGLinearSolver or ShewchukPCGLinearSolver can, also over
/// a matrix that is assembled there. A preconditioner is made in each recorded step, or in none. Whether
/// positions are finite is looked at by finish() alone. On the host backends of Thrust steps are made one by
/// one.
template <class Root>
class RecordedStep {
 public:
  /// Makes one step to warm up, and records another without making it. Throws Error where that cannot be.
  RecordedStep(Simulation<Root>& simulation, double dt) : simulation_(simulation), dt_(dt) {
    refuseAcross();
    {
      const Recording now;  // what a recorded step does is what needs its memory
      simulation_.animate(dt);
    }
#if SINEW_CUDA
    const double time = simulation_.time();
    const long step = simulation_.step();
    char const* const what = "RecordedStep";
    cudaGraph_t graph = nullptr;
    check(cudaStreamBeginCapture(stream(), cudaStreamCaptureModeThreadLocal), what);
    try {
      const Recording now;
      simulation_.animate(dt);
    } catch (...) {
      cudaStreamEndCapture(stream(), &graph);
      if (graph) cudaGraphDestroy(graph);
      throw;
    }
    check(cudaStreamEndCapture(stream(), &graph), what);
    const cudaError_t made = cudaGraphInstantiate(&step_, graph, 0);
    cudaGraphDestroy(graph);
    check(made, what);
    simulation_.continueFrom(time, step);
#endif
  }
  RecordedStep(RecordedStep const&) = delete;
  ~RecordedStep() {
#if SINEW_CUDA
    if (step_) cudaGraphExecDestroy(step_);
#endif
  }

  /// Makes steps; returns before they are done.
  void animate(int steps = 1) {
#if SINEW_CUDA
    for (int i = 0; i < steps; ++i) check(cudaGraphLaunch(step_, stream()), "RecordedStep::animate");
    simulation_.continueFrom(simulation_.time() + steps * dt_, simulation_.step() + steps);
#else
    for (int i = 0; i < steps; ++i) simulation_.animate(dt_);
#endif
  }
  /// Waits for the steps that were asked for.
  void finish() { wait(); }

 private:
  // rows of constraints are made by the host in every step; and a body that a mapping carries to the host is
  // looked at there
  void refuseAcross() const {
    const NoScope above;
    const typename Simulation<Root>::RootScope root{simulation_.root(), above};
    traverse(root, on<role::AnimationLoop>([](auto& loop, auto const& scope) {
               throw Error(
                   scope.path(),
                   text(component_name<std::decay_t<decltype(loop)>>(),
                        " solves constraints in every step, with rows from the host, which a recorded "
                        "step cannot; animate() the simulation"));
             }));
    traverse(root, on<role::Mapping>([](auto& mapping, auto const& scope) {
               using M = std::decay_t<decltype(mapping)>;
               if constexpr (OnDevice<typename M::In> != OnDevice<typename M::Out>)
                 scope.withChild(mapping, [&](auto& child) {
                   if constexpr (HasRole<std::decay_t<decltype(child)>, role::State>)
                     throw Error(scope.path(),
                                 text(component_name<M>(),
                                      " joins the device and the host in every step, which a recorded step "
                                      "cannot; put both bodies on the device, or animate() the simulation"));
                 });
             }));
  }

  Simulation<Root>& simulation_;
  double dt_;
#if SINEW_CUDA
  cudaGraphExec_t step_ = nullptr;
#endif
};

}  // namespace sinew::gpu
