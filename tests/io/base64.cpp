// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/base64.hpp>

#include "catch.hpp"

#include <utility>

namespace test_base64 {

using namespace sinew::io;

namespace {

// RFC 4648, section 10
constexpr std::pair<std::string_view, std::string_view> vectors[] = {{"", ""},
                                                                     {"f", "Zg=="},
                                                                     {"fo", "Zm8="},
                                                                     {"foo", "Zm9v"},
                                                                     {"foob", "Zm9vYg=="},
                                                                     {"fooba", "Zm9vYmE="},
                                                                     {"foobar", "Zm9vYmFy"},
                                                                     {"\xff\xfe\xfb", "//77"}};

}  // namespace

TEST_CASE("base64 gives the vectors of RFC 4648") {
  for (auto const& [bytes, code] : vectors) {
    std::string out;
    Base64Encoder encoder(out);
    for (const char c : bytes) encoder.add(&c, 1);
    encoder.finish();
    CHECK(out == code);
    const auto back = decode_base64(code);
    CHECK(back.bytes == bytes);
    CHECK(back.badAt == std::string_view::npos);
  }
}

TEST_CASE("base64 decodes the bytes that are wanted, over white space and padding") {
  CHECK(decode_base64(" Zm9v\r\n Ym\tFy\n").bytes == "foobar");
  CHECK(decode_base64("Zg==Zm9v").bytes == "ffoo");
  CHECK(decode_base64("Zm9vYmFy", 4).bytes == "foob");
  CHECK(decode_base64("Zm9vYmFy", 0).bytes.empty());
  // what comes after the wanted bytes does not matter
  CHECK(decode_base64("Zm9v!", 3).badAt == std::string_view::npos);
}

TEST_CASE("base64 says where it is broken") {
  CHECK(decode_base64("Zm9v!mFy").badAt == 4);
  CHECK(decode_base64("Z").badAt == 1);
  CHECK(decode_base64("Zm9vYmF").badAt == 7);
  CHECK(decode_base64("Z===").badAt == 1);
  CHECK(decode_base64("Zg=v").badAt == 3);
  CHECK(decode_base64("=").badAt == 0);
}

}  // namespace test_base64
