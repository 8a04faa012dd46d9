// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/io/text_reader.hpp>
#include <sinew/view/image.hpp>
#include <sinew/view/seen_material.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#include <stb/stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace sinew::view {

/// Of the sides of a texture [pixels].
inline constexpr int longestTexture = 8192;

/// The image in bytes of a file PNG, JPEG, BMP or TGA; `path` is for messages. Throws Error where they are
/// none, or the image is larger than that.
inline SeenTexture parse_texture(std::string path, std::string bytes) {
  auto const* data = reinterpret_cast<stbi_uc const*>(bytes.data());
  const int size = int(bytes.size());
  SeenTexture texture{.path = std::move(path)};
  int channels = 0;
  auto refuse = [&] { throw Error(texture.path, "it is no image that can be read; save it as PNG or JPEG"); };
  if (bytes.size() > (256u << 20) ||
      !stbi_info_from_memory(data, size, &texture.width, &texture.height, &channels))
    refuse();
  if (texture.width > longestTexture || texture.height > longestTexture)
    throw Error(texture.path,
                text("the image has ",
                     texture.width,
                     " x ",
                     texture.height,
                     " pixels, and up to ",
                     longestTexture,
                     " a side can be shown; make it smaller"));
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &texture.width, &texture.height, &channels, 4), stbi_image_free);
  if (!pixels) refuse();
  texture.rgba.assign(pixels.get(),
                      pixels.get() + 4 * std::size_t(texture.width) * std::size_t(texture.height));
  const std::string_view start(bytes);
  texture.file = start.starts_with("\x89PNG") || start.starts_with("\xff\xd8")
                     ? std::move(bytes)
                     : png_of(texture.path, texture.width, texture.height, 4, texture.rgba.data());
  return texture;
}

/// Throws Error where there is no such file, too.
inline SeenTexture read_texture(std::string const& path) { return parse_texture(path, io::read_file(path)); }

}  // namespace sinew::view
