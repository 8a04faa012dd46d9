// SPDX-License-Identifier: BSL-1.0
#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include <sinew/mpi/communicator.hpp>
#include <sinew/mpi/petsc.hpp>

#include <iostream>
#include <sstream>

int main(int argc, char** argv) {
  sinew::mpi::Session session(argc, argv);
  const sinew::mpi::PetscSession petsc;
  return Catch::Session().run(argc, argv);
}
