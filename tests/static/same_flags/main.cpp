// SPDX-License-Identifier: BSL-1.0
#include "library.hpp"

int main() { return answer() == 42 ? 0 : 1; }
