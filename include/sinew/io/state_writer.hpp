// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/state_file.hpp>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <limits>

namespace sinew::io {

/// Writes states to a file (state_file.hpp), frame by frame and without allocating for one: under the name
/// "path.part", which finish(), or the end of the writer, makes the name asked for; compressed where that
/// ends in ".gz" and the program does so (io/gzip.hpp). So what was there stays until a record is complete,
/// and a program that is killed leaves its frames in the part. Nothing is created before the first frame. A
/// device such as /dev/stdout is written to directly. Functions throw Error.
template <class Real>
class StateWriter {
 public:
  /// Throws where there can be no file of this name.
  StateWriter(std::string path, StateLayout layout, bool binary)
      : path_(std::move(path)), layout_(std::move(layout)), binary_(binary) {
    struct stat info;
    if (path_.empty()) throw Error("", "filename is empty; name the file to write");
    if (compressed() && !is_there(pack_gzip))
      throw Error(path_,
                  "this program does not compress files; remove .gz, choose format=\"binary\", or include "
                  "sinew/io/gzip.hpp");
    const bool exists = ::stat(path_.c_str(), &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) throw Error(path_, "is a folder; name a file in it");
    device_ = exists && !S_ISREG(info.st_mode);
    const std::string folder = path_.substr(0, path_.rfind('/') + 1);
    if (!device_ && ::access(folder.empty() ? "." : folder.c_str(), W_OK) != 0)
      throw Error(path_,
                  errno == ENOENT
                      ? text("cannot be written: there is no folder ", folder, "; create it first")
                      : text("cannot be written: ", reason(errno), "; choose another folder"));
    name_.reserve(path_.size() + 16);
    buffer_.reserve(flushAt + maxBytes());
  }
  StateWriter(StateWriter const&) = delete;
  StateWriter& operator=(StateWriter const&) = delete;
  /// Completes the file as finish() does; where that fails, the part stays.
  ~StateWriter() {
    try {
      finish();
    } catch (std::exception const&) {
    }
  }

  /// Writes the frame of a number, counted from 0. Those from that number on that are there already go first:
  /// the simulation went back. Where nothing was written yet, the frames before it are those of the file of
  /// this name: a record that goes on. `stamp` is kept by who writes, 0 at first: of several copies of a
  /// scene, one writes.
  void add(std::size_t number, long& stamp, double time, std::array<Real const*, 4> const& parts) {
    if (fd_ < 0)
      start(number);
    else if (stamp != stamp_ || number != frames_)
      truncateTo(number, stamp);
    const std::size_t begin = buffer_.size();
    if (binary_) {
      state_file::put(buffer_, time);
      for (int p = 0; p < 4; ++p)
        if (layout_.has[std::size_t(p)])
          buffer_.append(reinterpret_cast<char const*>(parts[std::size_t(p)]),
                         layout_.numbers(p) * sizeof(Real));
      state_file::put(buffer_, state_file::checksum(std::string_view(buffer_).substr(begin)));
    } else {
      buffer_ += "T= ";
      append_number(buffer_, time);
      buffer_ += '\n';
      for (int p = 0; p < 4; ++p) {
        if (!layout_.has[std::size_t(p)]) continue;
        buffer_ += "  ";
        buffer_ += StateLayout::words[std::size_t(p)];
        for (std::size_t i = 0, n = layout_.numbers(p); i < n; ++i) {
          buffer_ += ' ';
          append_number(buffer_, parts[std::size_t(p)][i]);
        }
        buffer_ += '\n';
      }
    }
    ++frames_;
    stamp = ++stamp_;
    if (buffer_.size() >= flushAt) flush();
  }

  /// Gives the file its name, complete as it is. A frame after that goes on with it.
  void finish() {
    if (fd_ < 0) return;
    flush();
    if (binary_ && !device_) {
      std::string header;
      state_file::append_header<Real>(header, layout_, frames_);
      if (::pwrite(fd_, header.data(), header.size(), 0) != ::ssize_t(header.size())) fail();
    }
    if (::close(std::exchange(fd_, -1)) != 0) fail();
    if (device_) return;
    if (compressed()) {
      write_file(path_, pack_gzip(read_file(name_)));
      if (::unlink(name_.c_str()) != 0) fail();
    } else if (::rename(name_.c_str(), path_.c_str()) != 0) {
      fail();
    }
  }

  bool writes(std::string_view path, StateLayout const& layout, bool binary) const {
    return path == path_ && layout == layout_ && binary == binary_;
  }
  std::size_t points() const { return layout_.points; }
  std::size_t frames() const { return frames_; }

 private:
  bool compressed() const { return path_.ends_with(".gz"); }

  static constexpr std::size_t flushAt = 1 << 16;  // bytes

  std::string path_, name_{}, buffer_{};
  StateLayout layout_;
  bool binary_, device_ = false;
  int fd_ = -1;
  std::size_t frames_ = 0;
  long stamp_ = 0;
  // one copy of the scene went back to this number of frames after that stamp
  std::size_t cut_ = std::numeric_limits<std::size_t>::max();
  long cutStamp_ = 0;

  static std::string reason(int cause) { return static_cast<char const*>(std::strerror(cause)); }
  // numbers of at most 24 characters after a blank; times, names and checksums
  std::size_t maxBytes() const { return 25 * layout_.numbers() + 128; }

  void start(std::size_t number) {
    std::string before;
    if (number > 0 && !device_) before = framesOf(path_, number);
    name_ = path_;
    int& fd = fd_;
    if (device_) {
      fd = ::open(name_.c_str(), O_WRONLY | O_CLOEXEC);
    } else {
      name_ += ".part";
      const std::size_t length = name_.size();
      for (int n = 0; fd < 0 && n < 1000 && (n == 0 || errno == EEXIST); ++n) {
        if (n > 0) {
          char digits[8];
          name_.resize(length);
          name_.append(digits, std::to_chars(digits, digits + sizeof digits, n).ptr);
        }
        fd = ::open(name_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      }
    }
    if (fd < 0)
      throw Error(path_, text("cannot be written: ", reason(errno), "; choose another file or folder"));
    buffer_.clear();
    if (binary_) state_file::append_header<Real>(buffer_, layout_, state_file::unfinished);
    frames_ = number;
    if (!before.empty()) {
      buffer_ += before;
      flush();
    }
  }
  // the bytes of the first frames of a file
  std::string framesOf(std::string const& file, std::size_t number) const {
    const std::string content = read_file(file);
    const bool isBinary = content.starts_with(state_file::magic);
    if (isBinary != binary_)
      throw Error(file, text("cannot be continued: it is of the other format; write to another file"));
    StateLayout layout = layout_;
    const StateFrames<Real> found = parse_state_file<Real>(file, content, layout, file == name_);
    if (found.times.size() < number)
      throw Error(file,
                  text("cannot be continued: ",
                       number,
                       " frames were recorded before, and it has ",
                       found.times.size(),
                       "; get the file that belongs to the checkpoint, or record from the start"));
    const std::size_t end = number < found.begins.size() ? found.begins[number] : found.end;
    return content.substr(found.begins[0], end - found.begins[0]);
  }
  void truncateTo(std::size_t number, long stamp) {
    if (device_ || number > frames_ || (number > cut_ && stamp <= cutStamp_))
      throw Error(path_,
                  "another copy of this scene records to the same file; give each copy a file of its own");
    cut_ = number, cutStamp_ = stamp_;
    flush();
    std::size_t end = binary_ ? state_file::headerSize : 0;
    if (number > 0) end += framesOf(name_, number).size();
    if (::ftruncate(fd_, ::off_t(end)) != 0 || ::lseek(fd_, 0, SEEK_END) < 0) fail();
    frames_ = number;
  }

  void flush() {
    for (std::size_t done = 0; done < buffer_.size();) {
      const ::ssize_t n = ::write(fd_, buffer_.data() + done, buffer_.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail();
      done += std::size_t(n);
    }
    buffer_.clear();
  }
  // the part stays, and what was at the path
  [[noreturn]] void fail() {
    const int cause = errno;
    buffer_.clear();
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
    throw Error(
        path_,
        text("could not be written: ",
             reason(cause),
             device_ ? std::string()
                     : text("; what was recorded before is in ", name_, " (read it with allowTruncated)"),
             ". Make room on the disk, or choose another one"));
  }
};

}  // namespace sinew::io
