// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

namespace sinew::io {

/// A file that is written piece by piece, so that a long one needs no memory: under a temporary name in the
/// folder of `path`, which finish() gives its own name. One that is not finished leaves nothing behind, and
/// what was at `path` before. A device such as /dev/stdout is written to directly. Functions throw Error.
class StreamedFile {
 public:
  explicit StreamedFile(std::string path);
  StreamedFile(StreamedFile&& other) noexcept
      : path_(std::move(other.path_)),
        name_(std::move(other.name_)),
        file_(std::exchange(other.file_, nullptr)),
        device_(other.device_) {}
  StreamedFile& operator=(StreamedFile&&) = delete;
  ~StreamedFile() { drop(); }

  void write(std::string_view bytes);
  /// Completes the file; nothing can be written then.
  void finish();

  std::string const& path() const { return path_; }

 private:
  std::string path_, name_;
  std::FILE* file_ = nullptr;
  bool device_ = false;

  void drop() {
    if (!file_) return;
    std::fclose(file_);
    if (!device_) std::remove(name_.c_str());
  }
  [[noreturn]] void fail(std::string_view what, std::string_view advice) const;
};

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/core/error.hpp>

#include <sys/stat.h>

#include <cerrno>
#include <cstring>

namespace sinew::io {

SINEW_ONCE StreamedFile::StreamedFile(std::string path) : path_(std::move(path)), name_(path_) {
  struct stat info;
  const bool exists = ::stat(path_.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) throw Error(path_, "is a folder; name a file in it");
  device_ = exists && !S_ISREG(info.st_mode);
  if (device_) file_ = std::fopen(path_.c_str(), "wb");
  for (int n = 0; !device_ && !file_ && n < 1000 && (n == 0 || errno == EEXIST); ++n) {
    name_ = text(path_, ".tmp", n);
    file_ = std::fopen(name_.c_str(), "wbx");
  }
  if (!file_) fail("cannot be written: ", "; choose another file, in a folder that is there");
}

SINEW_ONCE void StreamedFile::write(std::string_view bytes) {
  if (!file_) throw Error(path_, "the file is finished; nothing can be added");
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
    fail("cannot be written further: ", "; make room on the disk");
}

SINEW_ONCE void StreamedFile::finish() {
  if (!file_) throw Error(path_, "the file is finished already");
  if (std::fclose(std::exchange(file_, nullptr)) != 0) {
    if (!device_) std::remove(name_.c_str());
    fail("could not be written whole: ", "; nothing was kept of it");
  }
  if (!device_ && std::rename(name_.c_str(), path_.c_str()) != 0) {
    std::remove(name_.c_str());
    fail("cannot be written: ", "; choose another file");
  }
}

SINEW_ONCE void StreamedFile::fail(std::string_view what, std::string_view advice) const {
  throw Error(path_, text(what, static_cast<char const*>(std::strerror(errno)), advice));
}

}  // namespace sinew::io
#endif
