// SPDX-License-Identifier: BSL-1.0
#pragma once

// Needs PETSc for real numbers (Debian: petsc-dev), and MPI. Not in sinew.hpp; CMake's target sinew::mpi
// brings it.
#include <sinew/core/error.hpp>

#include <petscksp.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::mpi {

namespace detail {
/// What PETSc said of its last error, where that began.
inline std::string& petsc_words() {
  static std::string words;
  return words;
}
inline PetscErrorCode keep_petsc_words(MPI_Comm, int, char const*, char const*, PetscErrorCode code,
                                       PetscErrorType type, char const* message, void*) {
  if (type == PETSC_ERROR_INITIAL) petsc_words() = message ? message : "";
  return code;
}
}  // namespace detail

/// PETSc is there, and leaves it to us to report its errors.
inline void start_petsc() {
  PetscBool running = PETSC_FALSE;
  PetscInitialized(&running);
  if (!running) {
    PetscOptionsSetValue(nullptr, "-no_signal_handler", "true");
    PetscInitializeNoArguments();
    PetscPushErrorHandler(detail::keep_petsc_words, nullptr);
  }
  // of their names
  KSPInitializePackage();
  PCInitializePackage();
}
/// PETSc as long as it lives, in a program that has MPI.
struct PetscSession {
  PetscSession() { start_petsc(); }
  PetscSession(PetscSession const&) = delete;
  PetscSession& operator=(PetscSession const&) = delete;
  ~PetscSession() { PetscFinalize(); }
};

/// Throws Error with PETSc's words where a call has failed.
inline void check_petsc(PetscErrorCode code, std::string_view where) {
  if (code == 0) return;
  char const* general = nullptr;
  PetscErrorMessage(code, &general, nullptr);
  std::string words = std::exchange(detail::petsc_words(), {});
  for (char& c : words)
    if (c == '\n') c = ' ';
  while (!words.empty() && words.back() == ' ') words.pop_back();
  throw Error(where,
              text("PETSc says: ",
                   words.empty() ? std::string(general ? general : "an error without words") : words,
                   "; take another solver or preconditioner"));
}

/// One of PETSc's objects. Copies are empty: init makes them anew.
template <class Object, PetscErrorCode (*Destroy)(Object*)>
struct Petsc {
  Object object = nullptr;

  Petsc() = default;
  Petsc(Petsc&& o) noexcept : object(std::exchange(o.object, nullptr)) {}
  Petsc(Petsc const&) {}
  Petsc& operator=(Petsc&& o) noexcept {
    std::swap(object, o.object);
    return *this;
  }
  Petsc& operator=(Petsc const& o) {
    if (this != &o) clear();
    return *this;
  }
  ~Petsc() { clear(); }

  void clear() {
    PetscBool ended = PETSC_FALSE;
    if (object) PetscFinalized(&ended);
    if (object && !ended) Destroy(&object);
    object = nullptr;
  }
  /// For a function that makes one.
  Object* fresh() {
    clear();
    return &object;
  }
  operator Object() const { return object; }
};

/// Names in one of PETSc's lists.
inline std::vector<std::string> names_of(PetscFunctionList list) {
  char const** names = nullptr;
  int count = 0;
  PetscFunctionListGet(list, &names, &count);
  std::vector<std::string> all;
  for (int i = 0; i < count; ++i)
    if (names[i]) all.emplace_back(names[i]);
  PetscFree(names);
  return all;
}

}  // namespace sinew::mpi
