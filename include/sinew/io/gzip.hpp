// SPDX-License-Identifier: BSL-1.0
#pragma once

// A program that includes this in one of its sources reads files that are compressed by gzip, whatever their
// name, and VTK's XML whose arrays are compressed by zlib, and compresses states that are written to a name
// that ends in ".gz". It is linked with zlib (-lz).
#include <sinew/core/error.hpp>
#include <sinew/core/memory_limit.hpp>
#include <sinew/io/text_reader.hpp>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>

namespace sinew::io {

/// The bytes of a gzip file, of all its members one after the other. Throws Error where it is damaged, cut
/// off, or unpacks to more than memory_limit.
__attribute__((used)) inline std::string unpack_gzip(std::string const& path, std::string_view packed) {
  struct Stream : ::z_stream {
    Stream() : ::z_stream{} {}
    ~Stream() { ::inflateEnd(this); }
    Stream(Stream const&) = delete;
    Stream& operator=(Stream const&) = delete;
  } stream;
  constexpr int gzipOnly = 16 + MAX_WBITS;
  if (::inflateInit2(&stream, gzipOnly) != Z_OK) throw Error(path, "there is no memory to unpack it");
  std::string bytes;
  std::array<char, 1 << 16> part;
  std::size_t read = 0;
  for (bool whole = false; !whole || read < packed.size();) {
    if (stream.avail_in == 0 && read < packed.size()) {
      const std::size_t n = std::min<std::size_t>(packed.size() - read, std::numeric_limits<uInt>::max());
      // zlib does not write to what it reads
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + read));
      stream.avail_in = uInt(n);
    }
    const uInt before = stream.avail_in;
    if (whole && ::inflateReset(&stream) != Z_OK) throw Error(path, "cannot be unpacked");
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = uInt(part.size());
    const int result = ::inflate(&stream, Z_NO_FLUSH);
    const std::size_t found = part.size() - stream.avail_out;
    read += before - stream.avail_in;
    if (result != Z_OK && result != Z_STREAM_END) {
      if (result == Z_BUF_ERROR)
        throw Error(path, text("is compressed and cut off after ", read, " bytes; get a complete file"));
      throw Error(path,
                  text("is compressed and damaged near byte ",
                       read,
                       stream.msg ? text(" (", static_cast<char const*>(stream.msg), ")") : std::string(),
                       "; get the file again"));
    }
    if (bytes.size() + found > memory_limit)
      throw Error(path,
                  text("unpacks to more than ",
                       memory_text(double(memory_limit)),
                       "; name a smaller file, or raise memory_limit"));
    bytes.append(part.data(), found);
    whole = result == Z_STREAM_END;
  }
  return bytes;
}

/// The `size` bytes of one stream of zlib. Throws Error at `where` where it is damaged or holds another
/// number.
__attribute__((used)) inline std::string unpack_zlib(std::string const& where, std::string_view packed,
                                                     std::size_t size) {
  constexpr std::size_t most = 1032;  // bytes that one can unpack to
  std::string bytes;
  uLongf n = 0;
  if (size / most <= packed.size()) {
    bytes.resize(size);
    n = uLongf(size);
    if (::uncompress(reinterpret_cast<Bytef*>(bytes.data()),
                     &n,
                     reinterpret_cast<Bytef const*>(packed.data()),
                     uLong(packed.size())) != Z_OK)
      n = uLongf(size) + 1;
  }
  if (std::size_t(n) != size || bytes.size() != size)
    throw Error(where,
                text("a block of ",
                     packed.size(),
                     " bytes is not zlib's, or does not unpack to the ",
                     size,
                     " that are announced; get the file again"));
  return bytes;
}

/// A gzip file of these bytes.
__attribute__((used)) inline std::string pack_gzip(std::string_view bytes) {
  ::z_stream stream{};
  constexpr int gzipOnly = 16 + MAX_WBITS, memory = 8;
  if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzipOnly, memory, Z_DEFAULT_STRATEGY) !=
      Z_OK)
    throw Error("pack_gzip", "there is no memory to compress");
  std::string packed;
  std::array<char, 1 << 16> part;
  std::size_t read = 0;
  for (int result = Z_OK; result != Z_STREAM_END;) {
    if (stream.avail_in == 0) {
      const std::size_t n = std::min<std::size_t>(bytes.size() - read, std::numeric_limits<uInt>::max());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + read));
      stream.avail_in = uInt(n);
      read += n;
    }
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = uInt(part.size());
    result = ::deflate(&stream, read < bytes.size() ? Z_NO_FLUSH : Z_FINISH);
    packed.append(part.data(), part.size() - stream.avail_out);
  }
  ::deflateEnd(&stream);
  return packed;
}

}  // namespace sinew::io
