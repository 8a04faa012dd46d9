// SPDX-License-Identifier: BSL-1.0
// Writes the headers that compare.cpp is compiled with: generate SCENE HEADER NAME [--embed]
// With BAKED_ENGINES, of the registry of point_engine.hpp.
#include <sinew/io/output_file.hpp>
#include <sinew/runtime/bake.hpp>
#ifdef BAKED_ENGINES
#include "runtime/bake/point_engine.hpp"
using Registered = sinew::Tested;
const std::vector<std::string> includes{"runtime/bake/point_engine.hpp"};
#else
#include <sinew/runtime/precompiled.hpp>
using Registered = sinew::Standard;
const std::vector<std::string> includes{};
#endif

#include <iostream>

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  try {
    const bool embed = argc > 4 && std::string_view(argv[4]) == "--embed";
    sinew::io::write_file(
        argv[2],
        sinew::bake_scene<Registered>(argv[1], {}, {.embed = embed, .name = argv[3], .includes = includes}));
  } catch (std::exception const& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
