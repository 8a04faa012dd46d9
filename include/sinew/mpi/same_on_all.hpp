// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/mpi/communicator.hpp>
#include <sinew/version.hpp>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::mpi {

/// A sum that other bytes hardly have: FNV-1a.
struct Mark {
  std::uint64_t value = 14695981039346656037u;

  void add(void const* data, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i)
      value = (value ^ static_cast<unsigned char const*>(data)[i]) * 1099511628211u;
  }
};

/// A file that is read in places. Throws Error where it cannot be read.
class OpenFile {
 public:
  explicit OpenFile(std::string path) : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rb")) {
    if (!file_ || std::fseek(file_.get(), 0, SEEK_END) != 0) throw unreadable();
    const long end = std::ftell(file_.get());
    if (end < 0) throw unreadable();
    size_ = std::size_t(end);
  }
  std::size_t size() const { return size_; }
  /// The bytes from one place on, fewer at the end of the file.
  std::string read(std::size_t from, std::size_t bytes) {
    std::string found(from < size_ ? std::min(bytes, size_ - from) : 0, '\0');
    if (std::fseek(file_.get(), long(from), SEEK_SET) != 0 ||
        std::fread(found.data(), 1, found.size(), file_.get()) != found.size())
      throw unreadable();
    return found;
  }

 private:
  struct Close {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::size_t size_ = 0;

  Error unreadable() const {
    return Error(path_,
                 text("cannot be read: ",
                      static_cast<char const*>(std::strerror(errno)),
                      "; it has to be there for all ranks, at the same place"));
  }
};

/// Of the size of a file, and of what is in it at 256 places, 4 kB each: of all that is in it up to 1 MB.
inline std::uint64_t mark_of_file(std::string const& path) {
  constexpr std::size_t places = 256, bytes = 4096;
  OpenFile file(path);
  Mark mark;
  const std::size_t size = file.size(), step = std::max(bytes, size / places);
  mark.add(&size, sizeof size);
  for (std::size_t at = 0; at < size; at += step) {
    const std::string found = file.read(at, bytes);
    mark.add(found.data(), found.size());
  }
  return mark.value;
}

/// Throws Error on ranks where a value is another than on rank 0; all of them call it.
inline void same_on_all(Communicator& ranks, std::uint64_t value, std::string_view where,
                        std::string_view otherwise) {
  std::vector<std::uint64_t> first{value};
  ranks.broadcast(first, text("what rank 0 has of ", where));
  if (first != std::vector<std::uint64_t>{value}) throw Error(where, otherwise);
}

/// Throws Error on ranks where a file is not there, or is another than that of rank 0.
inline void same_file_on_all(Communicator& ranks, std::string const& path) {
  same_on_all(ranks,
              mark_of_file(path),
              path,
              "is another file on this rank, not that of rank 0; give all ranks the same files");
}

/// Throws Error on ranks that run another program than rank 0, or another version of it.
inline void same_program_on_all(Communicator& ranks) {
  Mark mark;
  const std::uint64_t program = mark_of_file("/proc/self/exe");
  mark.add(&program, sizeof program);
  const std::string_view version = SINEW_VERSION;
  mark.add(version.data(), version.size());
  same_on_all(ranks,
              mark.value,
              "the program",
              text("this is Sinew ",
                   version,
                   ", and rank 0 runs another version or build; start the same program on all ranks"));
}

}  // namespace sinew::mpi
