// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/io/output_file.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace sinew::view {

/// Pixels from the upper left one on, row by row: red, green, blue of 8 bits.
struct Image {
  int width = 0, height = 0;
  std::vector<unsigned char> rgb{};

  std::array<unsigned char, 3> at(int x, int y) const {
    const std::size_t i = 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

/// The bytes of a file PNG with so many channels of 8 bits; `path` is for messages.
inline std::string png_of(std::string const& path, int width, int height, int channels,
                          unsigned char const* pixels) {
  std::string bytes;
  auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<char const*>(data), std::size_t(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, channels, pixels, channels * width))
    throw Error(path, "the picture could not be packed: there is not enough memory");
  return bytes;
}

/// Throws Error where the file cannot be written; a file that is there stays whole then.
inline void write_png(Image const& image, std::string const& path) {
  io::write_file(path, png_of(path, image.width, image.height, 3, image.rgb.data()));
}

}  // namespace sinew::view
