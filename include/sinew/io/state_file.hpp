// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/data_types.hpp>
#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

// The states of one body over time, in one of two formats.
//
// Text, that of SOFA's WriteState and ReadState: a frame for each time, each vector on a line of its own.
//
//   T= 0.01                  time [s]
//     X0= 0 0 0  1 0 0       rest positions,
//     X= 0 0 0  1 0 0        positions, point by point (rigids: centre, then quaternion x y z w or angle),
//     V= 0 0 0  0 0 -0.1     velocities (rigids: linear, then angular),
//     F= 0 0 0  0 0 0        and forces; a file has them or not
//
// Numbers have the fewest digits that read back as the same bits. Lines that begin with # are skipped.
//
// Binary: a header of 64 bytes and frames of one size, in the byte order of the machine.
//
//   bytes  0  8   "SinewSta"
//          8  4   0x01020304, from which readers see the order of bytes
//         12  4   version, 1
//         16  16  name of the DataTypes ("Vec3d"), filled up by zeros
//         32  4   bytes of a number: 4 or 8
//         36  4   what a frame has: 1 rest positions, 2 positions, 4 velocities, 8 forces, added up
//         40  8   number of points
//         48  8   number of frames; all bits set while the file is being written
//         56  8   checksum of the bytes before it
//   a frame: time, a double; then what it has, in the order above; then a checksum of all of that
//
// Checksums are 64-bit FNV-1a (Fowler, Noll, Vo 1991).

namespace sinew::io {

/// What a state has for each frame.
struct StateLayout {
  enum Quantity { restPosition, position, velocity, force };
  static constexpr std::array<std::string_view, 4> words{"X0=", "X=", "V=", "F="};

  std::string dataTypes{};                       // "Vec3d"
  std::size_t points = 0, coord = 0, deriv = 0;  // numbers of a position and of a velocity
  std::array<bool, 4> has{};
  bool operator==(StateLayout const&) const = default;

  std::size_t numbers(int part) const { return points * (part < velocity ? coord : deriv); }
  /// Of a frame.
  std::size_t numbers() const {
    std::size_t all = 0;
    for (int part = 0; part < 4; ++part) all += has[std::size_t(part)] ? numbers(part) : 0;
    return all;
  }
  std::uint32_t flags() const { return has[0] * 1u + has[1] * 2u + has[2] * 4u + has[3] * 8u; }
};

/// How many numbers a position has.
template <class D>
inline constexpr std::size_t coord_numbers = !D::rigid         ? D::size
                                             : D::spatial == 3 ? 7
                                                               : 3;
/// Positions that are their numbers, without a gap; a rigid body in the plane may have one behind it.
template <class D>
inline constexpr bool dense_coord = sizeof(typename D::Coord) == coord_numbers<D> * sizeof(typename D::Real);

template <class D>
StateLayout state_layout(std::size_t points) {
  return {std::string(data_types_name<D>::value), points, coord_numbers<D>, std::size_t(D::size)};
}

/// A position from its numbers.
template <class D>
typename D::Coord coord_of(typename D::Real const* numbers) {
  typename D::Coord x = D::zero();
  if constexpr (!D::rigid) {
    for (int i = 0; i < D::size; ++i) x[i] = numbers[i];
  } else {
    for (int i = 0; i < D::spatial; ++i) x.center[i] = numbers[i];
    if constexpr (D::spatial == 3)
      for (int i = 0; i < 4; ++i) x.orientation.coeffs()[i] = numbers[3 + i];
    else
      x.orientation = numbers[2];
  }
  return x;
}

/// Frames of a file, one after the other. Velocities are there for all frames or none.
template <class Real>
struct StateFrames {
  std::vector<double> times{};
  std::vector<Real> positions{}, velocities{};
  std::vector<std::size_t> begins{};  // byte of the file at which each frame begins,
  std::size_t end = 0;                // and that at which the last one ends
};

namespace state_file {

inline constexpr std::string_view magic = "SinewSta";
inline constexpr std::uint32_t order = 0x01020304, version = 1;
inline constexpr std::uint64_t unfinished = ~std::uint64_t(0);
inline constexpr std::size_t headerSize = 64;

inline std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}
template <class T>
void put(std::string& to, T value) {
  const auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  to.append(bytes.data(), sizeof(T));
}
template <class T>
T get(std::string_view from, std::size_t at) {
  T value;
  std::memcpy(&value, from.data() + at, sizeof(T));
  return value;
}
template <class Real>
void append_header(std::string& to, StateLayout const& layout, std::uint64_t frames) {
  const std::size_t begin = to.size();
  to += magic;
  put(to, order);
  put(to, version);
  std::array<char, 16> name{};
  std::copy_n(layout.dataTypes.begin(), std::min<std::size_t>(layout.dataTypes.size(), 15), name.begin());
  to.append(name.data(), name.size());
  put(to, std::uint32_t(sizeof(Real)));
  put(to, layout.flags());
  put(to, std::uint64_t(layout.points));
  put(to, frames);
  put(to, checksum(std::string_view(to).substr(begin)));
}
template <class Real>
std::size_t frame_size(StateLayout const& layout) {
  return 16 + layout.numbers() * sizeof(Real);
}

inline constexpr std::string_view cutAdvice =
    "; get a complete file, or read it up to its last whole frame (allowTruncated)";

/// Throws Error unless a time follows those before it.
template <class Real>
void check_time(StateFrames<Real> const& frames, double time, std::string const& where) {
  if (!std::isfinite(time)) throw Error(where, "the time of a frame is not a finite number");
  if (!frames.times.empty() && !(time > frames.times.back()))
    throw Error(where,
                text("the time ",
                     time,
                     " s is not after that of the frame before, ",
                     frames.times.back(),
                     " s; put the frames in the order of rising times, each time once"));
}

template <class Real>
class FramesOfBytes {
 public:
  FramesOfBytes(std::string const& path, std::string_view content, StateLayout layout, bool allowTruncated)
      : path_(path), content_(content), layout_(std::move(layout)), allow_(allowTruncated) {}

  StateFrames<Real> read() {
    const std::uint64_t declared = header();
    const std::size_t size = frame_size<Real>(layout_), bytes = content_.size() - headerSize;
    const std::size_t whole = bytes / size;
    if (declared == unfinished && !allow_)
      fail(text("was never finished: the program that wrote it ended before it did; it has ",
                whole,
                " whole frames",
                cutAdvice));
    if (declared != unfinished && declared > whole && !allow_)
      fail(text("is cut off in frame ",
                whole,
                ", at byte ",
                content_.size(),
                ": it should have ",
                declared,
                " frames of ",
                size,
                " bytes",
                cutAdvice));
    if (declared <= whole && bytes != declared * size)
      fail(text("goes on after its ",
                declared,
                " frames, at byte ",
                headerSize + declared * size,
                "; remove what follows"));
    StateFrames<Real> frames;
    for (std::size_t k = 0; k < std::min<std::uint64_t>(declared, whole); ++k) frame(frames, k, size);
    frames.end = headerSize + frames.times.size() * size;
    return frames;
  }

 private:
  std::string const& path_;
  std::string_view content_;
  StateLayout layout_;
  bool allow_;

  [[noreturn]] void fail(std::string_view what) const { throw Error(path_, what); }

  // the number of frames that it gives
  std::uint64_t header() {
    if (content_.size() < headerSize)
      fail(text("is cut off in its header, at byte ",
                content_.size(),
                " of ",
                headerSize,
                "; get a complete file"));
    const auto mark = get<std::uint32_t>(content_, 8);
    if (mark == 0x04030201)
      fail("was written on a machine with the other order of bytes; write it as text there");
    if (mark != order || get<std::uint64_t>(content_, 56) != checksum(content_.substr(0, 56)))
      fail("has a damaged header (bytes 8 to 63); get the file again");
    if (const auto v = get<std::uint32_t>(content_, 12); v != version)
      fail(text("has version ", v, " of the format, and only ", version, " is known here; update Sinew"));
    std::string_view name = content_.substr(16, 16);
    name = name.substr(0, name.find('\0'));
    const auto width = get<std::uint32_t>(content_, 32);
    if (name != layout_.dataTypes || width != sizeof(Real))
      fail(text("is over ",
                in_quotes(name),
                " in numbers of ",
                width,
                " bytes, but the state is over ",
                layout_.dataTypes,
                "; give both the same template"));
    if (const auto points = get<std::uint64_t>(content_, 40); points != layout_.points)
      fail(text("has ",
                points,
                " points, but the state has ",
                layout_.points,
                "; name the file that belongs to this state"));
    const auto flags = get<std::uint32_t>(content_, 36);
    for (std::size_t part = 0; part < 4; ++part) layout_.has[part] = flags >> part & 1;
    if (flags > 15 || !layout_.has[StateLayout::position])
      fail("has no positions; write it again with writeX");
    return get<std::uint64_t>(content_, 48);
  }

  void frame(StateFrames<Real>& frames, std::size_t k, std::size_t size) const {
    const std::size_t begin = headerSize + k * size;
    const std::string_view bytes = content_.substr(begin, size);
    const std::string where = text(path_, ": frame ", k, " (byte ", begin, ")");
    if (get<std::uint64_t>(bytes, size - 8) != checksum(bytes.substr(0, size - 8)))
      throw Error(where, "is damaged: its checksum is another one; get the file again");
    const auto time = get<double>(bytes, 0);
    check_time(frames, time, where);
    frames.times.push_back(time);
    frames.begins.push_back(begin);
    std::size_t at = 8;
    for (int part = 0; part < 4; ++part) {
      if (!layout_.has[std::size_t(part)]) continue;
      const std::size_t n = layout_.numbers(part);
      auto* const to = part == StateLayout::position   ? &frames.positions
                       : part == StateLayout::velocity ? &frames.velocities
                                                       : nullptr;
      for (std::size_t i = 0; to && i < n; ++i) {
        to->push_back(get<Real>(bytes, at + i * sizeof(Real)));
        if (!std::isfinite(to->back()))
          throw Error(where,
                      text("number ",
                           i,
                           part == StateLayout::position ? " of the positions" : " of the velocities",
                           " is not finite; find out why the simulation that wrote the file diverged"));
      }
      at += n * sizeof(Real);
    }
  }
};

template <class Real>
class FramesOfText {
 public:
  FramesOfText(std::string const& path, std::string_view content, StateLayout const& layout,
               bool allowTruncated)
      : path_(path), content_(content), layout_(layout), allow_(allowTruncated) {}

  StateFrames<Real> read() {
    TextReader(path_, content_).rejectBinary();
    // the lines that begin a frame
    std::vector<std::size_t> lines;
    std::size_t line = 0;
    for (std::size_t at = 0; at < content_.size(); ++line) {
      const std::string_view rest = content_.substr(at);
      const std::size_t word = std::min(rest.find_first_not_of(" \t"), rest.size());
      if (rest.substr(word).starts_with("T=")) {
        frames_.begins.push_back(at), lines.push_back(line + 1);
      } else if (frames_.begins.empty() && word < rest.size() && rest[word] != '#' && rest[word] != '\n' &&
                 rest[word] != '\r') {
        TextReader in(path_, rest, line + 1);
        in.word();
        throw in.expected("the time of the first frame, \"T= 0\"");
      }
      at = std::min(content_.find('\n', at), content_.size() - 1) + 1;
    }
    frames_.end = content_.size();
    const std::size_t found = frames_.begins.size();
    for (std::size_t k = 0; k < found; ++k) {
      const bool last = k + 1 == found;
      const std::size_t begin = frames_.begins[k], end = last ? frames_.end : frames_.begins[k + 1];
      if (last && content_.back() != '\n') return cut(line, "the last line is not ended by a line break");
      frame(TextReader(path_, content_.substr(begin, end - begin), lines[k]));
      if (k == 0) first_ = seen_;
      const std::size_t x = StateLayout::position, v = StateLayout::velocity;
      if (seen_[x] && seen_[v] == first_[v]) continue;
      if (last && k > 0 && seen_[v] <= first_[v])
        return cut(line, "lines are missing that other frames have");
      throw Error(text(path_, ':', lines[k]),
                  seen_[x] ? "some frames have velocities (\"V=\") and others do not; give all or none"
                           : "this frame has no positions; give them after \"X=\"");
    }
    return std::move(frames_);
  }

 private:
  std::string const& path_;
  std::string_view content_;
  StateLayout const& layout_;
  bool allow_;
  StateFrames<Real> frames_{};
  std::array<bool, 4> seen_{}, first_{};  // what the frame has, and what the first has

  // the file ends in the middle of the last frame
  StateFrames<Real> cut(std::size_t line, std::string_view why) {
    if (!allow_)
      throw Error(text(path_, ':', line),
                  text("the file is cut off in frame ", frames_.begins.size() - 1, ": ", why, cutAdvice));
    frames_.end = frames_.begins.back();
    frames_.begins.pop_back();
    const std::size_t k = frames_.begins.size();
    frames_.times.resize(k);
    frames_.positions.resize(k * layout_.numbers(StateLayout::position));
    if (!frames_.velocities.empty()) frames_.velocities.resize(k * layout_.numbers(StateLayout::velocity));
    return std::move(frames_);
  }

  void frame(TextReader in) {
    seen_ = {};
    in.word();
    double time = 0;
    if (!parse_number(in.wordOnLine(), time)) throw in.expected("the time of a frame");
    check_time(frames_, time, text(path_, ':', in.line()));
    frames_.times.push_back(time);
    if (!in.wordOnLine().empty()) throw in.error("there is more after the time; remove it");
    while (in.more()) {
      const std::string_view word = in.word();
      if (word.starts_with('#')) {
        in.restOfLine();
        continue;
      }
      const auto part = std::find(layout_.words.begin(), layout_.words.end(), word) - layout_.words.begin();
      if (part == 4) throw in.expected("\"T=\", \"X=\", \"V=\", \"F=\" or \"X0=\"");
      if (std::exchange(seen_[std::size_t(part)], true))
        throw in.error(text("this frame has ", word, " twice; remove one"));
      numbers(in, int(part), word);
    }
  }
  void numbers(TextReader& in, int part, std::string_view name) {
    auto* const to = part == StateLayout::position   ? &frames_.positions
                     : part == StateLayout::velocity ? &frames_.velocities
                                                     : nullptr;
    std::size_t found = 0;
    for (std::string_view word; !(word = in.wordOnLine()).empty(); ++found) {
      Real value = 0;
      if (!parse_number(word, value) || !std::isfinite(value))
        throw in.expected(text("number ", found, " of ", name, ", a finite number"));
      if (to) to->push_back(value);
    }
    if (const std::size_t n = layout_.numbers(part); found != n)
      throw in.error(text(name,
                          " has ",
                          found,
                          " numbers, but the state, of ",
                          layout_.points,
                          " points over ",
                          layout_.dataTypes,
                          ", has ",
                          n,
                          "; name the file that belongs to this state"));
  }
};

}  // namespace state_file

/// Reads the content of a file of states, in either format, for a state of this layout. `allowTruncated`: one
/// that was cut off, or never finished, is read up to its last whole frame. Throws Error at "path:line", or
/// with the frame and the byte, where the file is no such file, belongs to another state, is damaged or cut
/// off, has no frame, times that do not rise, or numbers that are not finite.
template <class Real>
StateFrames<Real> parse_state_file(std::string const& path, std::string_view content,
                                   StateLayout const& layout, bool allowTruncated = false) {
  StateFrames<Real> frames =
      content.starts_with(state_file::magic.substr(0, std::min(content.size(), state_file::magic.size())))
          ? state_file::FramesOfBytes<Real>(path, content, layout, allowTruncated).read()
          : state_file::FramesOfText<Real>(path, content, layout, allowTruncated).read();
  if (frames.times.empty()) throw Error(path, "has no whole frame; get a complete file");
  return frames;
}
template <class Real>
StateFrames<Real> read_state_file(std::string const& path, StateLayout const& layout,
                                  bool allowTruncated = false) {
  return parse_state_file<Real>(path, read_file(path), layout, allowTruncated);
}

}  // namespace sinew::io
