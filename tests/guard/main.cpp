// SPDX-License-Identifier: BSL-1.0
// step_guard SCENE STEPS: runs the steps of a scene under callgrind (guard.py).
#include "scenes.hpp"

#include <cstdlib>
#include <cstring>

int main(int argc, char** argv) {
  struct {
    char const* name;
    void (*run)(int);
  } const scenes[] = {{"fem_assembled", guard::fem_assembled},
                      {"fem_matrix_free", guard::fem_matrix_free},
                      {"spring_grid", guard::spring_grid},
                      {"contacts", guard::contacts},
                      {"string", guard::string}};
  if (argc != 3) return 2;
  for (auto const& scene : scenes)
    if (std::strcmp(scene.name, argv[1]) == 0) return scene.run(std::atoi(argv[2])), 0;
  return 2;
}
