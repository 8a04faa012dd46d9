// SPDX-License-Identifier: BSL-1.0
// expect: Sinew: -ffast-math removes the checks for values that are not finite.
#include <sinew/core/fields.hpp>

int main() {}
