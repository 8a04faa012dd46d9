// SPDX-License-Identifier: BSL-1.0
#include "io/files.hpp"

#include <sinew/core/data_types.hpp>
#include <sinew/io/state_writer.hpp>

#include <random>

#include <sys/resource.h>

#include <csignal>

namespace test_state_file {

using namespace sinew;
using files::TempFolder;

namespace {

const std::string sample =
    "T= 0\n  X= 0 0 0 1 0 0\n  V= 0 0 0 0 0 1\n"
    "T= 0.5\n  X= 0 0 0 1 0 0.5\n  V= 0 0 0 0 0 1\n"
    "T= 1\n  X= 0 0 0 1 0 1\n  V= 0 0 0 0 0 1\n";

io::StateLayout two() { return io::state_layout<Vec3d>(2); }
io::StateFrames<double> parse(std::string const& content, bool allowTruncated = false) {
  return io::parse_state_file<double>("tool.state", content, two(), allowTruncated);
}
std::string error_in(std::string const& content, bool allowTruncated = false) {
  return error_of([&] { parse(content, allowTruncated); });
}

/// Random numbers of all sizes, and those of which decimal digits are easily wrong.
template <class Real>
std::vector<Real> numbers(std::size_t n) {
  std::mt19937_64 random(7);
  std::vector<Real> all{Real(0.1),
                        Real(1) / 3,
                        Real(-0.0),
                        std::numeric_limits<Real>::min(),
                        std::numeric_limits<Real>::denorm_min(),
                        std::numeric_limits<Real>::max(),
                        std::numeric_limits<Real>::epsilon()};
  while (all.size() < n) {
    const auto bits = random();
    Real value;
    std::memcpy(&value, &bits, sizeof value);
    if (std::isfinite(value)) all.push_back(value);
  }
  all.resize(n);
  return all;
}

/// A file of frames 0, 1, ... at times k/3.
template <class Real>
std::string written(TempFolder const& folder, io::StateLayout layout, bool binary, int frames) {
  const std::string path = folder / (binary ? "some.bin" : "some.state");
  const std::size_t x = layout.numbers(1), v = layout.numbers(2);
  const auto values = numbers<Real>((x + v) * std::size_t(frames));
  io::StateWriter<Real> writer(path, layout, binary);
  long stamp = 0;
  for (std::size_t k = 0; k < std::size_t(frames); ++k)
    writer.add(k, stamp, double(k) / 3, {nullptr, &values[k * (x + v)], &values[k * (x + v) + x], nullptr});
  writer.finish();
  return io::read_file(path);
}

template <class D>
void round_trip() {
  using Real = typename D::Real;
  TempFolder folder;
  auto layout = io::state_layout<D>(5);
  layout.has = {false, true, true, false};
  for (const bool binary : {false, true}) {
    const std::string bytes = written<Real>(folder, layout, binary, 20);
    const auto frames = io::parse_state_file<Real>("some", bytes, layout);
    REQUIRE(frames.times.size() == 20);
    for (std::size_t k = 0; k < 20; ++k) CHECK(frames.times[k] == double(k) / 3);
    const std::size_t x = layout.numbers(1), v = layout.numbers(2);
    const auto values = numbers<Real>((x + v) * 20);
    std::vector<Real> read;
    for (std::size_t k = 0; k < 20; ++k) {
      read.insert(read.end(), &frames.positions[k * x], &frames.positions[k * x] + x);
      read.insert(read.end(), &frames.velocities[k * v], &frames.velocities[k * v] + v);
    }
    REQUIRE(read.size() == values.size());
    CHECK(std::memcmp(read.data(), values.data(), read.size() * sizeof(Real)) == 0);
  }
  CHECK(folder.count() == 2);
}

}  // namespace

TEST_CASE("states in SOFA's text are read") {
  const auto frames = parse(sample);
  CHECK(frames.times == std::vector<double>{0, 0.5, 1});
  CHECK(frames.positions.size() == 18);
  CHECK(frames.positions[11] == 0.5);
  CHECK(frames.velocities[17] == 1);
  // as SOFA writes it: with forces and rest positions, blanks at the ends, other ends of lines, comments
  const auto more =
      parse("# a comment\r\nT= 0\r\n  X0= 0 0 0 1 0 0 \r\n  X= 0 0 0 1e0 0 +5 \r\n  F= 0 0 0 0 0 0 \r\n\r\n");
  CHECK(more.positions == std::vector<double>{0, 0, 0, 1, 0, 5});
  CHECK(more.velocities.empty());
}

TEST_CASE("states that were written are read with the same bits, as text and binary") {
  round_trip<Vec3d>();
  round_trip<Vec3f>();
  round_trip<Rigid3d>();
  round_trip<Rigid2f>();
  round_trip<Vec1d>();
  round_trip<Vec6d>();
}

TEST_CASE("the text is SOFA's") {
  TempFolder folder;
  auto layout = io::state_layout<Rigid3d>(1);
  layout.has = {false, true, true, true};
  const double x[] = {1, 2.5, -3, 0, 0, 0, 1}, v[] = {0, 0, 0, 0, 0, 0.1}, f[] = {1, 2, 3, 4, 5, 6};
  {
    io::StateWriter<double> writer(folder / "one.state", layout, false);
    long stamp = 0;
    writer.add(0, stamp, 0.01, {nullptr, x, v, f});
  }
  CHECK(io::read_file(folder / "one.state") ==
        "T= 0.01\n  X= 1 2.5 -3 0 0 0 1\n  V= 0 0 0 0 0 0.1\n  F= 1 2 3 4 5 6\n");
}

TEST_CASE("what is wrong with a text of states is said with its line") {
  auto says = [](std::string const& content, std::string const& where, std::string_view words) {
    files::check_says(error_in(content), where, words);
  };
  using files::replaced;
  says("# nothing\n", "tool.state", "no whole frame");
  says("\n\n", "tool.state", "no whole frame");
  says("  ", "tool.state", "no whole frame");
  says("X= 0 0 0 1 0 0\n", "tool.state:1", "expected the time of the first frame");
  says("hello\n" + sample, "tool.state:1", "expected the time of the first frame, \"T= 0\", found \"hello\"");
  says(replaced(sample, "T= 0.5", "T= half"), "tool.state:4", "expected the time of a frame, found \"half\"");
  says(replaced(sample, "T= 0.5", "T= nan"), "tool.state:4", "not a finite number");
  says(replaced(sample, "T= 0.5", "T= 0"),
       "tool.state:4",
       "the time 0 s is not after that of the frame before, 0 s");
  says(replaced(sample, "T= 1", "T= 0.25"), "tool.state:7", "the time 0.25 s is not after");
  says(replaced(sample, "T= 1", "T= 1 2"), "tool.state:7", "there is more after the time");
  says(replaced(sample, "0.5\n  V", "\n  V"),
       "tool.state:5",
       "X= has 5 numbers, but the state, of 2 points over Vec3d, has 6");
  says(replaced(sample, "0.5\n  V", "0.5 7\n  V"), "tool.state:5", "X= has 7 numbers");
  says(replaced(sample, "0 1\nT= 0.5", "nan 1\nT= 0.5"),
       "tool.state:3",
       "number 4 of V=, a finite number, found \"nan\"");
  says(replaced(sample, "0 1\nT= 0.5", "1e999 1\nT= 0.5"), "tool.state:3", "a finite number");
  says(replaced(sample, "0 0.5", "0,5 0.5"), "tool.state:5", "found \"0,5\"");
  says(replaced(sample, "  V= 0 0 0 0 0 1\nT= 0.5", "T= 0.5"), "tool.state:3", "some frames have velocities");
  says(replaced(sample, "  V= 0 0 0 0 0 1\nT= 1", "T= 1"), "tool.state:4", "some frames have velocities");
  says(replaced(sample, "X= 0 0 0 1 0 0.5", "F= 0 0 0 1 0 0.5"), "tool.state:4", "no positions");
  says(replaced(sample, "  X= 0 0 0 1 0 0.5", "  Y= 0 0 0 1 0 0.5"), "tool.state:5", "found \"Y=\"");
  says(replaced(sample, "V= 0 0 0 0 0 1\nT= 0.5", "X= 0 0 0 0 0 1\nT= 0.5"), "tool.state:3", "X= twice");
  says(replaced(sample, "0 0.5", std::string("0 \0", 3)), "tool.state:5", "which is not text");
  // rigids in a file for points: 7 numbers
  says("T= 0\n  X= 0 0 0 0 0 0 1\n",
       "tool.state:2",
       "X= has 7 numbers, but the state, of 2 points over Vec3d, has 6");
}

TEST_CASE(
    "a text of states that is cut off anywhere says so, and is read to its last whole frame on request") {
  const std::size_t second = sample.find("T= 0.5"), last = sample.find("T= 1");
  for (std::size_t n = 1; n < sample.size(); ++n) {
    INFO(n);
    const std::string cut = sample.substr(0, n);
    // nothing shows it where a frame ends, or the only one ends behind its positions
    if (n == second || n == last || n == sample.find("  V=")) {
      CHECK(error_in(cut).empty());
      continue;
    }
    CHECK(!error_in(cut).empty());
    // a single T is not yet seen to be that of another frame: the frame before it is not whole
    const std::size_t begun = n > last + 1 ? 2 : n > second + 1 ? 1 : 0;
    if (begun > 0) {
      CHECK(error_in(cut).find("cut off in frame " + std::to_string(begun)) != std::string::npos);
      CHECK(parse(cut, true).times.size() == begun);
      CHECK(parse(cut, true).velocities.size() == 6 * begun);
    } else {
      CHECK(!error_in(cut, true).empty());
    }
  }
}

TEST_CASE("a binary file of states that is cut off anywhere says so") {
  TempFolder folder;
  auto layout = two();
  layout.has = {false, true, true, false};
  const std::string bytes = written<double>(folder, layout, true, 4);
  const std::size_t frame = 16 + 12 * 8;
  REQUIRE(bytes.size() == 64 + 4 * frame);
  for (std::size_t n = 1; n < bytes.size(); ++n) {
    INFO(n);
    const std::string cut = bytes.substr(0, n);
    const std::string error = error_in(cut);
    if (n < 8)
      CHECK(error.find("is cut off in its header") != error.npos);
    else if (n < 64)
      CHECK(error.find("is cut off in its header, at byte " + std::to_string(n)) != error.npos);
    else
      CHECK(error.find("is cut off in frame " + std::to_string((n - 64) / frame) + ", at byte " +
                       std::to_string(n)) != error.npos);
    if (n >= 64 + frame)
      CHECK(parse(cut, true).times.size() == (n - 64) / frame);
    else
      CHECK(!error_in(cut, true).empty());
  }
  CHECK(error_in(bytes + "x").find("goes on after its 4 frames, at byte " + std::to_string(bytes.size())) !=
        std::string::npos);
}

TEST_CASE("any damaged byte of a binary file of states is noticed") {
  TempFolder folder;
  auto layout = two();
  layout.has = {true, true, false, true};
  const std::size_t frame = 16 + 18 * 8;
  std::string bytes;
  {
    const auto values = numbers<double>(12);
    io::StateWriter<double> writer(folder / "f", layout, true);
    long stamp = 0;
    for (std::size_t k = 0; k < 3; ++k)
      writer.add(k, stamp, double(k), {&values[0], &values[0], nullptr, &values[0]});
    writer.finish();
    bytes = io::read_file(folder / "f");
  }
  REQUIRE(error_in(bytes).empty());
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    std::string damaged = bytes;
    damaged[n] = char(damaged[n] ^ 0x10);
    const std::string error = error_in(damaged, true);
    INFO(n << ": " << error);
    CHECK(!error.empty());
    if (n >= 8 && n < 64) CHECK(error.find("header") != error.npos);
    if (n >= 64) CHECK(error.find("frame " + std::to_string((n - 64) / frame)) != error.npos);
  }
}

TEST_CASE("a binary file of another state says what it is of") {
  TempFolder folder;
  auto layout = two();
  layout.has = {false, true, false, false};
  const std::string bytes = written<double>(folder, layout, true, 1);
  auto error = [&](auto const& asked, auto real) {
    return error_of([&] { io::parse_state_file<std::decay_t<decltype(real)>>("tool.state", bytes, asked); });
  };
  files::check_says(error(io::state_layout<Vec3f>(2), 0.f),
                    "tool.state",
                    "is over \"Vec3d\" in numbers of 8 bytes, but the state is over Vec3f");
  files::check_says(error(io::state_layout<Rigid3d>(2), 0.), "tool.state", "but the state is over Rigid3d");
  files::check_says(error(io::state_layout<Vec3d>(3), 0.), "tool.state", "has 2 points, but the state has 3");
  layout.has = {false, false, true, false};
  const double v[6] = {};
  {
    io::StateWriter<double> writer(folder / "v", layout, true);
    long stamp = 0;
    writer.add(0, stamp, 0, {nullptr, nullptr, v, nullptr});
  }
  files::check_says(error_in(io::read_file(folder / "v")), "tool.state", "has no positions");
}

TEST_CASE("a file of states has its name when it is complete, and not before") {
  TempFolder folder;
  const std::string path = folder.write("old.state", "what was there");
  auto layout = two();
  layout.has = {false, true, false, false};
  const double x[6] = {1, 2, 3, 4, 5, 6};
  {
    io::StateWriter<double> writer(path, layout, false);
    CHECK(folder.count() == 1);  // nothing before the first frame
    long stamp = 0;
    writer.add(0, stamp, 0, {nullptr, x, nullptr, nullptr});
    CHECK(io::read_file(path) == "what was there");
    CHECK(folder.count() == 2);
    writer.finish();
    CHECK(folder.count() == 1);
    CHECK(io::read_file(path) == "T= 0\n  X= 1 2 3 4 5 6\n");
    // and goes on
    writer.add(1, stamp, 1, {nullptr, x, nullptr, nullptr});
    CHECK(io::read_file(path) == "T= 0\n  X= 1 2 3 4 5 6\n");
  }
  CHECK(io::read_file(path) == "T= 0\n  X= 1 2 3 4 5 6\nT= 1\n  X= 1 2 3 4 5 6\n");
  CHECK(folder.count() == 1);
}

TEST_CASE("a writer goes back to an earlier frame") {
  for (const bool binary : {false, true}) {
    TempFolder folder;
    auto layout = two();
    layout.has = {false, true, false, false};
    std::array<double, 6> x{};
    auto frames = [&](int from, int to, long& stamp, io::StateWriter<double>& writer) {
      for (int k = from; k < to; ++k) {
        x[0] = k;
        writer.add(std::size_t(k), stamp, k, {nullptr, x.data(), nullptr, nullptr});
      }
    };
    const std::string path = folder / "f";
    io::StateWriter<double> writer(path, layout, binary);
    long stamp = 0;
    frames(0, 5000, stamp, writer);  // more than the buffer
    frames(10, 20, stamp, writer);
    writer.finish();
    auto read = io::read_state_file<double>(path, layout);
    REQUIRE(read.times.size() == 20);
    for (std::size_t k = 0; k < 20; ++k) CHECK(read.positions[6 * k] == double(k));
    frames(0, 3, stamp, writer);
    writer.finish();
    CHECK(io::read_state_file<double>(path, layout).times.size() == 3);
    // two that write in turns
    long other = stamp;
    frames(3, 5, stamp, writer);
    frames(3, 4, other, writer);
    files::check_says(error_of([&] { frames(5, 6, stamp, writer); }), path, "another copy of this scene");
    frames(4, 6, other, writer);
    writer.finish();
    CHECK(io::read_state_file<double>(path, layout).times.size() == 6);
    // a file that has too few
    io::StateWriter<double> late(path, layout, binary);
    long zero = 0;
    files::check_says(
        error_of([&] { frames(9, 10, zero, late); }), path, "9 frames were recorded before, and it has 6");
    io::StateWriter<double> wrong(path, layout, !binary);
    files::check_says(error_of([&] { frames(2, 3, zero, wrong); }), path, "of the other format");
  }
}

TEST_CASE("where no file of states can be written is said before the first step") {
  TempFolder folder;
  auto error = [&](std::string const& path) {
    return error_of([&] { io::StateWriter<double>(path, two(), false); });
  };
  CHECK(error("").find("filename is empty") == 0);
  files::check_says(error(folder / ""), folder / "", "is a folder");
  files::check_says(error(folder / "none/f"), folder / "none/f", "there is no folder " + (folder / "none/"));
  files::check_says(error(folder / "f.gz"), folder / "f.gz", "does not compress");
  const std::string packed = folder.write("g.gz", "\x1f\x8b and more");
  files::check_says(error_of([&] { io::read_file(packed); }), packed, "unpack it with gunzip first");
}

TEST_CASE("a disk that is full is said with the file") {
  auto layout = two();
  layout.has = {false, true, false, false};
  const double x[6] = {1, 2, 3, 4, 5, 6};
  // /dev/full has no room at all
  if (::access("/dev/full", W_OK) == 0) {
    io::StateWriter<double> writer("/dev/full", layout, false);
    long stamp = 0;
    writer.add(0, stamp, 0, {nullptr, x, nullptr, nullptr});
    files::check_says(error_of([&] { writer.finish(); }), "/dev/full", "could not be written: No space left");
  }
  // a limit on the size of files: the part stays, and what was there
  TempFolder folder;
  const std::string path = folder.write("f", "old");
  auto const handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit before, small;
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  small = before, small.rlim_cur = 100000;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  std::string error;
  {
    io::StateWriter<double> writer(path, layout, false);
    long stamp = 0;
    error = error_of([&] {
      for (std::size_t k = 0; k < 10000; ++k) writer.add(k, stamp, double(k), {nullptr, x, nullptr, nullptr});
    });
  }
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  files::check_says(
      error, path, "could not be written: File too large; what was recorded before is in " + path + ".part");
  CHECK(io::read_file(path) == "old");
  CHECK(io::read_state_file<double>(path + ".part", layout, true).times.size() > 1000);
}

}  // namespace test_state_file
