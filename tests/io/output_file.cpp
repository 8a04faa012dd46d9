// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>

#include "files.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

namespace test_output_file {

using namespace sinew;
using files::check_says;

namespace {

/// Lets no file of this process grow beyond some bytes, which is what a full disk looks like to it.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before_) == 0);
    const rlimit small{bytes, before_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  SmallDisk(SmallDisk const&) = delete;
  SmallDisk& operator=(SmallDisk const&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

}  // namespace

TEST_CASE("write_file writes and replaces, and leaves nothing else") {
  const files::TempFolder folder;
  const std::string file = folder / "a";
  io::write_file(file, "one");
  CHECK(io::read_file(file) == "one");
  io::write_file(file, std::string_view("t\0o\n", 4));
  CHECK(io::read_file(file) == std::string("t\0o\n", 4));
  CHECK(folder.count() == 1);
  // a temporary file of another writer stays as it is
  folder.write("a.tmp0", "other");
  io::write_file(file, "three");
  CHECK(io::read_file(file) == "three");
  CHECK(io::read_file(folder / "a.tmp0") == "other");
  CHECK(folder.count() == 2);
}

TEST_CASE("write_file keeps the old file when the disk is full") {
  const files::TempFolder folder;
  const std::string file = folder.write("a", "old");
  std::string message;
  {
    const SmallDisk disk(1000);
    message = error_of([&] { io::write_file(file, std::string(100000, 'x')); });
  }
  check_says(message, file, "could not be written whole");
  CHECK(io::read_file(file) == "old");
  CHECK(folder.count() == 1);
  if (::access("/dev/full", W_OK) == 0) {
    check_says(error_of([&] { io::write_file("/dev/full", "x"); }), "/dev/full", "No space left");
    CHECK(::access("/dev/full", W_OK) == 0);
  }
}

TEST_CASE("write_file writes to a device, never over it") {
  io::write_file("/dev/null", "x");
  struct stat info;
  REQUIRE(::stat("/dev/null", &info) == 0);
  CHECK(S_ISCHR(info.st_mode));
}

TEST_CASE("write_file says why it cannot") {
  const files::TempFolder folder;
  check_says(error_of([&] { io::write_file(folder / "none/a", "x"); }),
             folder / "none/a",
             "there is no folder " + (folder / "none/") + "; create it first");
  check_says(error_of([&] { io::write_file(folder / ".", "x"); }), folder / ".", "is a folder");
  const std::string file = folder.write("file", "x");
  check_says(error_of([&] { io::write_file(file + "/a", "x"); }), file + "/a", "Not a directory");
  check_says(error_of([&] { io::write_file("", "x"); }), "write_file", "name a file");
}

TEST_CASE("make_folders makes all that are missing") {
  const files::TempFolder folder;
  io::make_folders(folder / "a/b//c/");
  CHECK(std::filesystem::is_directory(folder / "a/b/c"));
  io::make_folders(folder / "a/b");
  const std::string file = folder.write("file", "x");
  check_says(error_of([&] { io::make_folders(file + "/b"); }), file, "cannot be created as a folder");
  check_says(error_of([&] { io::make_folders(file); }), file, "File exists");
}

TEST_CASE("numbers are written in the fewest digits that read back") {
  for (const double value : {0.1, 1.0 / 3, -0.0, 5e-324, 1.7976931348623157e308, 1e22, -12345.678}) {
    std::string digits;
    io::append_number(digits, value);
    double back = 1;
    REQUIRE(io::parse_number(digits, back));
    CHECK(std::memcmp(&back, &value, sizeof value) == 0);
  }
  std::string digits;
  io::append_number(digits, 0.1);
  CHECK(digits == "0.1");
}

}  // namespace test_output_file
