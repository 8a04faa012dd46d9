// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/output_file.hpp>
#include <sinew/io/streamed_file.hpp>
#include <sinew/io/text_reader.hpp>
#include <sinew/runtime/node.hpp>

#include <optional>
#include <utility>

// Records: positions and velocities of all states of a scene over time, in a text file that other programs
// read with ease and that gives the same bits again.
//
//   sinew record 1                   the format
//   frame 0 time 0                   number of steps done, time [s]
//   state Vec3d 2 /liver             DataTypes, number of points, path below the top node, which is "/"
//   0 0 0  0 0 0                     a point a line: its position, then its velocity
//   1 0 0  0 0 -0.0981
//   frame 10 time 0.1
//   ...
//   end 2                            number of frames; a file without it is not whole
//
// Positions of rigids are centre and quaternion x y z w, or centre and angle [rad] in the plane; velocities
// are linear, then angular. Numbers have the fewest digits that read back as the same bits, of a float or of
// a double as the DataTypes say.

namespace sinew {

/// One state at one time, as plain numbers.
struct RecordedState {
  std::string path{};       // "/liver"
  std::string dataTypes{};  // "Vec3d"
  std::size_t points = 0;
  std::vector<double> positions{}, velocities{};  // point by point
  bool operator==(RecordedState const&) const = default;
};

/// All states of a scene at one time.
struct RecordedFrame {
  long step = 0;
  double time = 0;
  std::vector<RecordedState> states{};
  bool operator==(RecordedFrame const&) const = default;
};

/// How many numbers a point of a DataTypes has in a record.
struct RecordLayout {
  std::size_t position, velocity;
  std::size_t place;  // of those of the position, the first that are a place in space
  bool isFloat;
};
/// The layout of "Vec3d", "Rigid3f"...; nothing where the name is not one of those.
inline std::optional<RecordLayout> record_layout(std::string_view dataTypes) {
  if (dataTypes.empty()) return {};
  if (dataTypes.starts_with("Cuda")) dataTypes.remove_prefix(4);
  const char scalar = dataTypes.back();
  if (scalar != 'd' && scalar != 'f') return {};
  const bool isFloat = scalar == 'f';
  dataTypes.remove_suffix(1);
  if (dataTypes == "Rigid3") return RecordLayout{7, 6, 3, isFloat};
  if (dataTypes == "Rigid2") return RecordLayout{3, 3, 2, isFloat};
  for (const std::size_t n : {1u, 2u, 3u, 6u})
    if (dataTypes == text("Vec", n)) return RecordLayout{n, n, std::min<std::size_t>(n, 3), isFloat};
  return {};
}

namespace detail {

template <class C>
void append_coordinates(std::vector<double>& to, C const& x) {
  if constexpr (requires { x.center; }) {
    append_coordinates(to, x.center);
    if constexpr (requires { x.orientation.coeffs(); })
      append_coordinates(to, x.orientation.coeffs());
    else
      to.push_back(double(x.orientation));
  } else {
    for (Eigen::Index i = 0; i < x.size(); ++i) to.push_back(double(x[i]));
  }
}

template <class R>
void capture_below(RuntimeNode<R> const& node, std::string const& path, RecordedFrame& frame) {
  if (auto const* entry = node.state())
    entry->component.template visit<role::State>([&](auto const& state) {
      using D = typename std::decay_t<decltype(state)>::DataTypes;
      RecordedState& recorded = frame.states.emplace_back(RecordedState{
          path.empty() ? "/" : path, std::string(data_types_name<D>::value), state.position.size()});
      for (auto const& x : state.position) append_coordinates(recorded.positions, x);
      for (auto const& v : state.velocity) append_coordinates(recorded.velocities, v);
    });
  for (auto const& child : node.children()) capture_below(*child, text(path, '/', child->name), frame);
}

}  // namespace detail

/// The states of an initialised scene as they are now, from its top node.
template <class R>
RecordedFrame capture(RuntimeNode<R> const& top, long step, double time) {
  RecordedFrame frame{step, time, {}};
  detail::capture_below(top, "", frame);
  return frame;
}

/// The lines of one frame.
inline std::string record_text(RecordedFrame const& frame) {
  std::string out = text("frame ", frame.step, " time ");
  io::append_number(out, frame.time);
  out += '\n';
  for (auto const& state : frame.states) {
    const auto layout = record_layout(state.dataTypes);
    if (!layout || state.positions.size() != state.points * layout->position ||
        state.velocities.size() != state.points * layout->velocity)
      throw Error(state.path,
                  text("a state over ",
                       state.dataTypes,
                       " with ",
                       state.positions.size(),
                       " numbers cannot be recorded"));
    std::string path = state.path;
    for (char& c : path)
      if (static_cast<unsigned char>(c) < ' ') c = '_';
    out += text("state ", state.dataTypes, ' ', state.points, ' ', path, '\n');
    auto add = [&](double const* numbers, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) {
        if (layout->isFloat)
          io::append_number(out, float(numbers[i]));
        else
          io::append_number(out, numbers[i]);
        out += ' ';
      }
    };
    for (std::size_t p = 0; p < state.points; ++p) {
      add(&state.positions[p * layout->position], layout->position);
      add(&state.velocities[p * layout->velocity], layout->velocity);
      out.back() = '\n';
    }
  }
  return out;
}

/// Writes a record frame by frame (io::StreamedFile). Functions throw Error.
class RecordWriter {
 public:
  explicit RecordWriter(std::string path) : file_(std::move(path)) { file_.write("sinew record 1\n"); }

  void add(RecordedFrame const& frame) {
    file_.write(record_text(frame));
    ++frames_;
  }
  /// Completes the file; nothing can be added then.
  void finish() {
    file_.write(text("end ", frames_, '\n'));
    file_.finish();
  }

  std::size_t size() const { return frames_; }
  std::string const& path() const { return file_.path(); }

 private:
  io::StreamedFile file_;
  std::size_t frames_ = 0;
};

/// The frames of a record, from the content of its file. Throws Error at "path:line" where it is no record,
/// is not whole, or has values that are not finite.
inline std::vector<RecordedFrame> parse_record(std::string_view path, std::string_view content) {
  io::TextReader reader(path, content);
  auto expect = [&](std::string_view word, std::string_view what) {
    if (reader.word() != word) throw reader.expected(what);
  };
  constexpr std::string_view first = "the first line of a record, \"sinew record 1\"";
  for (std::string_view word : {"sinew", "record", "1"}) expect(word, first);
  std::vector<RecordedFrame> frames;
  for (;;) {
    const std::string_view word = reader.word();
    if (word == "end") {
      if (const auto n = reader.integer("the number of frames"); n != std::int64_t(frames.size()))
        throw reader.error(
            text("the record ends with ", n, " frames, but has ", frames.size(), "; get a complete file"));
      if (reader.more()) throw reader.error("the record goes on after its end; remove what follows");
      return frames;
    }
    if (word == "frame") {
      RecordedFrame& frame = frames.emplace_back();
      frame.step = long(reader.integer("the number of steps"));
      expect("time", "\"time\"");
      frame.time = reader.real("the time");
    } else if (word == "state" && !frames.empty()) {
      RecordedState& state = frames.back().states.emplace_back();
      state.dataTypes = std::string(reader.word());
      const auto layout = record_layout(state.dataTypes);
      if (!layout) throw reader.expected("DataTypes, as Vec3d");
      state.points = reader.count("the number of points", layout->position + layout->velocity);
      std::string_view name = reader.restOfLine();
      if (name.starts_with(' ')) name.remove_prefix(1);
      if (!name.starts_with('/')) throw reader.error("a state has no path; write it as /liver");
      state.path = std::string(name);
      auto number = [&](std::string_view what) {
        if (!layout->isFloat) return reader.real(what);
        float value = 0;
        if (!io::parse_number(reader.word(), value) || !std::isfinite(value))
          throw reader.expected(text(what, ", a finite number"));
        return double(value);
      };
      state.positions.reserve(state.points * layout->position);
      state.velocities.reserve(state.points * layout->velocity);
      for (std::size_t p = 0; p < state.points; ++p) {
        for (std::size_t i = 0; i < layout->position; ++i) state.positions.push_back(number("a position"));
        for (std::size_t i = 0; i < layout->velocity; ++i) state.velocities.push_back(number("a velocity"));
      }
    } else {
      throw reader.expected("\"frame\", \"state\" or \"end\"");
    }
  }
}
/// The same from a file.
inline std::vector<RecordedFrame> read_record(std::string const& path) {
  return parse_record(path, io::read_file(path));
}

}  // namespace sinew
