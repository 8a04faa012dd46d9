// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <charconv>
#include <cstring>
#include <string>
#include <string_view>

namespace sinew::io {

/// Appends a number in the fewest digits that read back as the same bits, whatever the locale of the process.
template <class T>
void append_number(std::string& out, T value) {
  char digits[40];
  out.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// Writes a file whole or not at all: under a temporary name in the same folder, which is then renamed. What
/// was at `path` stays until then. A device such as /dev/null is written to directly. Throws Error, and
/// leaves no temporary file, if the folder is missing or may not be written, or the disk is full.
void write_file(std::string const& path, std::string_view bytes);

/// Creates a folder and those above it, where they are missing. Throws Error if it cannot.
void make_folders(std::string const& folder);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>

namespace sinew::io {

SINEW_ONCE void write_file(std::string const& path, std::string_view bytes) {
  if (path.empty()) throw Error("write_file", "the path is empty; name a file");
  struct stat info;
  const bool exists = ::stat(path.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) throw Error(path, "is a folder; name a file in it");
  const bool device = exists && !S_ISREG(info.st_mode);

  std::string name = path;
  std::FILE* file = nullptr;
  if (device) {
    file = std::fopen(name.c_str(), "wb");
  } else {
    // x: never a file that another writer has open
    for (int n = 0; !file && n < 1000 && (n == 0 || errno == EEXIST); ++n) {
      name = text(path, ".tmp", n);
      file = std::fopen(name.c_str(), "wbx");
    }
  }
  if (!file) {
    const int cause = errno;
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    const bool missing = cause == ENOENT && !folder.empty() && ::stat(folder.c_str(), &info) != 0;
    throw Error(path,
                missing ? text("cannot be written: there is no folder ", folder, "; create it first")
                        : text("cannot be written: ",
                               static_cast<char const*>(std::strerror(cause)),
                               "; choose another file or folder"));
  }

  bool good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int cause = good ? 0 : errno;
  if (std::fclose(file) != 0 && good) good = false, cause = errno;
  if (good && !device && std::rename(name.c_str(), path.c_str()) != 0) good = false, cause = errno;
  if (good) return;
  if (!device) std::remove(name.c_str());
  throw Error(path,
              text("could not be written whole: ",
                   static_cast<char const*>(std::strerror(cause)),
                   "; nothing was kept of it. Make room on the disk or choose another one"));
}

SINEW_ONCE void make_folders(std::string const& folder) {
  for (std::size_t end = folder.find('/', 1);; end = folder.find('/', end + 1)) {
    const std::string part = folder.substr(0, end);
    struct stat info;
    if (::mkdir(part.c_str(), 0777) != 0) {
      const int cause = errno;
      if (::stat(part.c_str(), &info) != 0 || !S_ISDIR(info.st_mode))
        throw Error(part,
                    text("cannot be created as a folder: ",
                         static_cast<char const*>(std::strerror(cause)),
                         "; choose another place"));
    }
    if (end == std::string::npos) return;
  }
}

}  // namespace sinew::io
#endif
