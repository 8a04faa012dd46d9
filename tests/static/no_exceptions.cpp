// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: exceptions are needed, since errors in a scene are thrown. Remove -fno-exceptions.
#include <sinew/sinew.hpp>

int main() {}
