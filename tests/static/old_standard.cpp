// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: C++20 is needed. Compile with -std=c++20, by g++ 12, clang 14 or nvcc 13, or later ones.
#include <sinew/sinew.hpp>

int main() {}
