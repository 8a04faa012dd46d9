// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: exceptions are needed, since errors in a scene are thrown. Leave -fno-exceptions away.
#include <sinew/sinew.hpp>

int main() {}
