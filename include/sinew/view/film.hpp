// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>
#include <sinew/view/image.hpp>

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <utility>

extern char** environ;

namespace sinew::view {

/// A film of pictures, which the program ffmpeg packs (H.264 in an .mp4 file).
class Film {
 public:
  /// Throws Error where there is no ffmpeg, and where it cannot write the file; so do add() and finish().
  Film(std::string path, int width, int height, double picturesPerSecond)
      : path_(std::move(path)), width_(width), height_(height) {
    int ends[2];
    if (::pipe(ends) != 0) fail(std::strerror(errno));
    const std::string size = text(width, 'x', height), rate = text(picturesPerSecond);
    // an even number of pixels is what players can show
    char const* words[] = {"ffmpeg",   "-loglevel",   "error",     "-y",
                           "-f",       "rawvideo",    "-pix_fmt",  "rgb24",
                           "-s",       size.c_str(),  "-r",        rate.c_str(),
                           "-i",       "-",           "-vf",       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                           "-pix_fmt", "yuv420p",     "-movflags", "+faststart",
                           "--",       path_.c_str(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    const int wrong =
        ::posix_spawnp(&child_, words[0], &actions, nullptr, const_cast<char* const*>(words), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    to_ = ends[1];
    if (wrong == 0) return;
    close();
    fail(
        "the program ffmpeg, which makes films, is not there; install it (Debian: ffmpeg), or write "
        "pictures");
  }
  Film(Film const&) = delete;
  Film& operator=(Film const&) = delete;
  ~Film() {
    close();
    wait();
  }

  void add(Image const& image) {
    if (image.width != width_ || image.height != height_)
      fail(text("a picture of ",
                image.width,
                " x ",
                image.height,
                " pixels does not fit into a film of ",
                width_,
                " x ",
                height_));
    // a child that is gone is an error here, and no end of this program
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    std::size_t done = 0;
    while (done < image.rgb.size()) {
      const auto n = ::write(to_, image.rgb.data() + done, image.rgb.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) break;
      done += std::size_t(n);
    }
    std::signal(SIGPIPE, before);
    if (done < image.rgb.size()) fail("ffmpeg ended early; what it says is above");
  }
  std::string const& path() const { return path_; }
  /// The film is whole.
  void finish() {
    close();
    if (wait() != 0) fail("ffmpeg could not write it; what it says is above");
  }

 private:
  std::string path_;
  int width_, height_;
  pid_t child_ = -1;
  int to_ = -1;

  void close() {
    if (to_ >= 0) ::close(std::exchange(to_, -1));
  }
  int wait() {
    if (child_ < 0) return 0;
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
  }
  [[noreturn]] void fail(std::string const& why) const { throw Error(path_, why); }
};

}  // namespace sinew::view
