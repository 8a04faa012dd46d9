// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sinew::io {

inline constexpr std::string_view base64_alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Appends bytes to a text in base64 (RFC 4648, 2006): each three as four characters of six bits. Bytes may
/// come in portions; finish() pads with '='.
class Base64Encoder {
 public:
  explicit Base64Encoder(std::string& out) : out_(out) {}

  void add(void const* data, std::size_t size);
  void finish();

 private:
  void flush(int characters) {
    for (int i = 0; i < characters; ++i) out_ += base64_alphabet[bits_ >> (18 - 6 * i) & 63];
    bits_ = 0, held_ = 0;
  }

  std::string& out_;
  std::uint32_t bits_ = 0;
  int held_ = 0;
};

struct Base64Decoded {
  std::string bytes{};
  std::size_t badAt = std::string_view::npos;  // where the text is not base64, or ends too early
};

/// The first `maximum` bytes, or all, of a base64 text. White space is skipped, and several padded texts may
/// follow each other.
Base64Decoded decode_base64(std::string_view text, std::size_t maximum = std::size_t(-1));

}  // namespace sinew::io

#if SINEW_DEFINES
#include <algorithm>
#include <array>

namespace sinew::io {

SINEW_ONCE void Base64Encoder::add(void const* data, std::size_t size) {
  auto const* bytes = static_cast<unsigned char const*>(data);
  for (std::size_t i = 0; i < size; ++i) {
    bits_ = bits_ << 8 | bytes[i];
    if (++held_ == 3) flush(4);
  }
}

SINEW_ONCE void Base64Encoder::finish() {
  if (held_ == 0) return;
  const int full = held_ + 1;
  for (int i = held_; i < 3; ++i) bits_ <<= 8;
  flush(full);
  out_.append(std::size_t(4 - full), '=');
}

SINEW_ONCE Base64Decoded decode_base64(std::string_view text, std::size_t maximum) {
  static constexpr auto values = [] {
    std::array<std::int8_t, 256> v{};
    v.fill(-1);
    for (std::size_t i = 0; i < 64; ++i) v[std::size_t(base64_alphabet[i])] = std::int8_t(i);
    return v;
  }();
  Base64Decoded out;
  out.bytes.reserve(std::min(maximum, text.size() / 4 * 3));
  std::uint32_t bits = 0;
  int characters = 0, padding = 0;
  for (std::size_t i = 0; i < text.size() && out.bytes.size() < maximum; ++i) {
    const char c = text[i];
    if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
    const int value = values[static_cast<unsigned char>(c)];
    if (c == '=' ? characters < 2 : (value < 0 || padding > 0)) {
      out.badAt = i;
      return out;
    }
    padding += c == '=';
    bits = bits << 6 | std::uint32_t(c == '=' ? 0 : value);
    if (++characters < 4) continue;
    for (int k = 0; k < 3 - padding && out.bytes.size() < maximum; ++k)
      out.bytes += char(bits >> (16 - 8 * k) & 255);
    bits = 0, characters = 0, padding = 0;
  }
  if (characters != 0) out.badAt = text.size();
  return out;
}

}  // namespace sinew::io
#endif
