// SPDX-License-Identifier: BSL-1.0
// Ends with 77, which ctest takes for "skipped", where there is no GPU; unless asked for "[without-gpu]",
// what is to be seen there.
#define CATCH_CONFIG_RUNNER
#include "catch.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace gpu_test {
int devices();
}

int main(int argc, char** argv) {
  const bool without = std::find(argv, argv + argc, std::string_view("[without-gpu]")) != argv + argc;
  if (!without && gpu_test::devices() == 0) {
    std::puts("skipped: there is no GPU that this program can use");
    return 77;
  }
  return Catch::Session().run(argc, argv);
}
