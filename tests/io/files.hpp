// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include "catch.hpp"
#include "error_of.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace files {

/// A folder of a test's own, removed at the end of the test.
class TempFolder {
 public:
  TempFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "sinew-test-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw sinew::Error(name, "cannot be created");
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(TempFolder const&) = delete;
  TempFolder& operator=(TempFolder const&) = delete;

  std::string operator/(std::string_view name) const { return path_ + '/' + std::string(name); }
  std::string write(std::string_view name, std::string_view bytes) const {
    const std::string file = *this / name;
    std::FILE* f = std::fopen(file.c_str(), "wb");
    REQUIRE(f != nullptr);
    REQUIRE(std::fwrite(bytes.data(), 1, bytes.size(), f) == bytes.size());
    REQUIRE(std::fclose(f) == 0);
    return file;
  }
  std::size_t count() const {
    const std::filesystem::directory_iterator all(path_);
    return std::size_t(std::distance(begin(all), end(all)));
  }

 private:
  std::string path_;
};

/// The message begins with `where` and a colon, and contains `words`.
inline void check_says(std::string const& message, std::string const& where, std::string_view words) {
  INFO("message: " << message);
  CHECK(message.starts_with(where + ": "));
  INFO("words: " << words);
  CHECK(message.find(words) != std::string::npos);
}

/// `whole` with its first `from` replaced.
inline std::string replaced(std::string whole, std::string_view from, std::string_view to) {
  const std::size_t at = whole.find(from);
  INFO("not in the sample: " << from);
  REQUIRE(at != std::string::npos);
  return whole.replace(at, from.size(), to);
}

}  // namespace files
