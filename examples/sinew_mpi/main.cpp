// SPDX-License-Identifier: BSL-1.0
// The program sinew-mpi, to which `sinew run FILE --mpi` and `sinew sweep FILE --mpi` hand over: mpirun
// starts it in several processes, which step a scene together, or share out the runs of a sweep.
#include "sinew_mpi/commands.hpp"

#include <sinew/mpi/petsc.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace {

// what is said to all ranks alike is printed by the first one
struct Silence {
  int out = -1, error = -1;
  explicit Silence(bool silent) {
    if (!silent) return;
    const int nowhere = open("/dev/null", O_WRONLY);
    out = dup(1), error = dup(2);
    dup2(nowhere, 1), dup2(nowhere, 2);
    close(nowhere);
  }
  Silence(Silence const&) = delete;
  Silence& operator=(Silence const&) = delete;
  ~Silence() {
    if (out < 0) return;
    std::fflush(stdout), std::fflush(stderr);
    dup2(out, 1), dup2(error, 2);
    close(out), close(error);
  }
};

}  // namespace

int main(int argc, char** argv) {
  sinew::mpi::Session session(argc, argv);
  const auto ranks = std::make_shared<sinew::mpi::Communicator>();
  int status = cli::ok;
  try {
    cli::Options options;
    {
      const Silence silence(ranks->rank() != 0);
      options = cli::read_options(argc, argv, status);
    }
    if (options.command == cli::Command::none) return status;
    if (options.command == cli::Command::sweep)
      return cli::sweep_on_ranks(options.sweep, argv, *ranks, status);
    if (options.command != cli::Command::run)
      throw cli::Failure{
          cli::badUsage,
          {"sinew-mpi: several processes can run and sweep scenes only: sinew run FILE --mpi"}};
    const sinew::mpi::PetscSession petsc;
    return cli::run_on_ranks(options.run, ranks, status);
  } catch (cli::Failure const& failure) {
    if (ranks->rank() == 0)
      for (auto const& message : failure.messages) std::fprintf(stderr, "%s\n", message.c_str());
    return failure.status;
  } catch (std::exception const& error) {
    sinew::mpi::report(*ranks, error);
    // mpirun ends with the status of the rank that has said why
    return ranks->reports() ? status : cli::ok;
  }
}
