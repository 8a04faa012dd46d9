// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

#ifdef SINEW_ZLIB
#include <sinew/io/gzip.hpp>
#endif

#include <unistd.h>

#include <cstdio>
#include <exception>
#include <string>

namespace {

// Goes on as the program for several processes, which stands beside this one, or in PATH.
[[noreturn]] void hand_over(char** argv) {
  std::string path(4096, '\0');
  const auto length = readlink("/proc/self/exe", path.data(), path.size());
  path.resize(length > 0 ? std::size_t(length) : 0);
  path.resize(path.rfind('/') + 1);
  path += "sinew-mpi";
  execv(path.c_str(), argv);
  execvp("sinew-mpi", argv);
  throw cli::Failure{
      cli::badUsage,
      {"sinew: --mpi needs the program sinew-mpi, which is not here; build Sinew where MPI, PETSc and "
       "METIS are (Debian: libopenmpi-dev openmpi-bin petsc-dev libmetis-dev)"}};
}

}  // namespace

int cli::program(int argc, char** argv) try {
  int status = cli::ok;
  const cli::Options options = cli::read_options(argc, argv, status);
  switch (options.command) {
    case cli::Command::run:
      if (options.run.mpi) hand_over(argv);
      return cli::run(options.run);
    case cli::Command::view:
      return cli::view(options.view);
    case cli::Command::serve:
      return cli::serve(options.serve);
    case cli::Command::check:
      return cli::check(options.check);
    case cli::Command::list:
      return cli::list(options.list);
    case cli::Command::bake:
      return cli::bake(options.bake);
    case cli::Command::compare:
      return cli::compare(options.compare);
    case cli::Command::sweep:
      if (options.sweep.mpi && options.sweep.worker < 0) hand_over(argv);
      return cli::sweep(options.sweep);
    default:
      return status;
  }
} catch (cli::Failure const& failure) {
  for (auto const& message : failure.messages) std::fprintf(stderr, "%s\n", message.c_str());
  return failure.status;
} catch (std::bad_alloc const&) {
  std::fprintf(stderr, "sinew: there is not enough memory; make the scene smaller, or raise --max-memory\n");
  return cli::badScene;
} catch (std::exception const& error) {
  std::fprintf(stderr, "sinew: %s\n", error.what());
  return cli::badScene;
}
