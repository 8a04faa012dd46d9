// SPDX-License-Identifier: BSL-1.0
#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include <sinew/mpi/communicator.hpp>
#include <sinew/mpi/petsc.hpp>

#include <cstdlib>
#include <iostream>
#include <new>
#include <sstream>

// Allocations of what is compiled here, which MPI and PETSc, in libraries, have no part of: operator new, and
// malloc as Eigen calls it.
extern long allocationsHere;
long allocationsHere = 0;
extern "C" {
extern char __executable_start, etext;
void* __libc_malloc(std::size_t);
void* malloc(std::size_t size) {
  void* const from = __builtin_return_address(0);
  if (from >= &__executable_start && from < &etext) ++allocationsHere;
  return __libc_malloc(size);
}
}
void* operator new(std::size_t size) {
  ++allocationsHere;
  if (void* const p = __libc_malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

int main(int argc, char** argv) {
  sinew::mpi::Session session(argc, argv);
  const sinew::mpi::PetscSession petsc;
  return Catch::Session().run(argc, argv);
}
