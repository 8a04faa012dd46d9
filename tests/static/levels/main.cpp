// SPDX-License-Identifier: BSL-1.0
// The loader has taken the library of the best level that this processor has.
#include <cstdio>

extern "C" int lanes_of_doubles();

int main() {
  auto best = [] {
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl"))
      return 8;
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2")
               ? 4
               : 2;
  };
  std::printf("%d lanes of doubles, %d would be best\n", lanes_of_doubles(), best());
  return lanes_of_doubles() == best() ? 0 : 1;
}
