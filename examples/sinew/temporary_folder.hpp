// SPDX-License-Identifier: BSL-1.0
#pragma once

#include "options.hpp"

#include <sinew/core/error.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace cli {

/// A folder of its own, which goes at the end of the scope with what is in it.
struct TemporaryFolder {
  std::filesystem::path path;

  explicit TemporaryFolder(std::string_view purpose) {
    const std::filesystem::path place = std::filesystem::temp_directory_path();
    std::string name = (place / sinew::text("sinew-", purpose, "-XXXXXX")).string();
    if (!mkdtemp(name.data()))
      throw Failure{notWritten, {sinew::text("no folder can be made in ", place.string())}};
    path = name;
  }
  TemporaryFolder(TemporaryFolder const&) = delete;
  TemporaryFolder& operator=(TemporaryFolder const&) = delete;
  ~TemporaryFolder() {
    std::error_code failed;
    std::filesystem::remove_all(path, failed);
  }
};

}  // namespace cli
