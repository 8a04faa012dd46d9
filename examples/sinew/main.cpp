// SPDX-License-Identifier: BSL-1.0
#include "options.hpp"

int main(int argc, char** argv) { return cli::program(argc, argv); }
