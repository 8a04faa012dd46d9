// SPDX-License-Identifier: BSL-1.0
// Writes the headers that compare.cpp is compiled with: generate SCENE HEADER NAME [--embed]
#include <sinew/io/output_file.hpp>
#include <sinew/runtime/bake.hpp>
#include <sinew/runtime/precompiled.hpp>

#include <iostream>

int main(int argc, char** argv) {
  if (argc < 4) return 2;
  try {
    const bool embed = argc > 4 && std::string_view(argv[4]) == "--embed";
    sinew::io::write_file(argv[2], sinew::bake_scene(argv[1], {}, {.embed = embed, .name = argv[3]}));
  } catch (std::exception const& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
