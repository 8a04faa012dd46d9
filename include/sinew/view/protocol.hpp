// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/opened_scene.hpp>
#include <sinew/view/scene_tree.hpp>
#include <sinew/view/seen_scene.hpp>
#include <sinew/view/stage.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

// What a stage and a page that is elsewhere, in a browser, say to each other (docs/viewing.md): functions on
// bytes, which know of no socket. They are of the target sinew::serve.
namespace sinew::view {

/// What a page may tell a stage. Rays have an origin and a direction of length 1, in metres.
namespace command {
struct Play {
  bool on = true;
  bool operator==(Play const&) const = default;
};
struct Step {
  bool operator==(Step const&) const = default;
};
struct Reset {
  bool operator==(Reset const&) const = default;
};
struct Speed {
  double times = 1;  // the time of the clock; 0: as fast as it can
  bool operator==(Speed const&) const = default;
};
struct Press {
  Eigen::Vector3d origin{0, 0, 0}, direction{0, 0, 1};
  double stiffness = 1000;  // [N/m]
  bool operator==(Press const&) const = default;
};
struct Move {
  Eigen::Vector3d origin{0, 0, 0}, direction{0, 0, 1};
  bool operator==(Move const&) const = default;
};
struct Release {
  bool operator==(Release const&) const = default;
};
/// Asks for the component at a line of the tree, with its fields.
struct Component {
  int line = 0;
  bool operator==(Component const&) const = default;
};
/// Gives a field of it another value, in the words of a scene file.
struct SetField {
  int line = 0;
  std::string field{}, value{};
  bool operator==(SetField const&) const = default;
};
struct Undo {
  bool operator==(Undo const&) const = default;
};
struct Redo {
  bool operator==(Redo const&) const = default;
};
/// What the colours of bodies show from now on, for all who look.
struct Colour {
  Quantity by = Quantity::none;
  bool operator==(Colour const&) const = default;
};
/// Times all components during steps from now on, or no more.
struct Profile {
  bool on = true;
  bool operator==(Profile const&) const = default;
};
/// Measures the simulation after each step from now on, or no more; a field, too.
struct Measure {
  bool on = true;
  bool operator==(Measure const&) const = default;
};
struct MeasureField {
  int line = 0;
  std::string field{};
  bool operator==(MeasureField const&) const = default;
};
/// Asks for what was measured later than that [s].
struct Measures {
  double after = 0;
  bool operator==(Measures const&) const = default;
};
}  // namespace command
using Command = std::variant<command::Play, command::Step, command::Reset, command::Speed, command::Press,
                             command::Move, command::Release, command::Component, command::SetField,
                             command::Undo, command::Redo, command::Colour, command::Profile,
                             command::Measure, command::MeasureField, command::Measures>;

/// Commands longer than that [bytes], or nested deeper, are refused.
inline constexpr std::size_t longestCommand = 16384, deepestCommand = 4;

/// A command from JSON (RFC 8259). Throws Error for all that is not exactly one: whose numbers are finite and
/// in range, and which has its members and no others.
Command read_command(std::string_view json);
std::string write_command(Command const& command);

/// What a page is told as JSON: once what the scene is made of; how it gets on; a component that it asked
/// for; what was wrong with a command.
std::string write_scene(std::string_view title, double dt, std::vector<TreeLine> const& tree);
std::string write_state(StageState const& state, SeenScene const& scene);
std::string write_component(SeenComponent const& component);
/// Times and series, of the steps that were later.
std::string write_measures(Measures const& measures, double after);
std::string write_error(std::string_view message);

/// Does what a command says with a stage, or what has its functions. What the stage answers, now or later and
/// then in its thread, goes to answer(std::string json).
template <class Stage, class Answer>
void tell(Stage& stage, Command const& said, Answer const& answer) {
  struct {
    Stage& stage;
    Answer const& answer;
    void operator()(command::Play const& c) { stage.play(c.on); }
    void operator()(command::Step const&) { stage.step(); }
    void operator()(command::Reset const&) { stage.reset(); }
    void operator()(command::Speed const& c) { stage.setSpeed(c.times); }
    void operator()(command::Press const& c) { stage.press(c.origin, c.direction, c.stiffness); }
    void operator()(command::Move const& c) { stage.move(c.origin, c.direction); }
    void operator()(command::Release const&) { stage.release(); }
    void operator()(command::Component const& c) {
      stage.component(c.line, [say = answer](SeenComponent const& seen, std::string const& error) {
        say(error.empty() ? write_component(seen) : write_error(error));
      });
    }
    void operator()(command::SetField const& c) {
      stage.setField(c.line, c.field, c.value, [say = answer](std::string const& error) {
        if (!error.empty()) say(write_error(error));
      });
    }
    void operator()(command::Undo const&) { stage.undo(); }
    void operator()(command::Redo const&) { stage.redo(); }
    void operator()(command::Colour const& c) {
      SeenSettings seen = stage.scene()->settings;
      seen.colour = c.by;
      stage.show(seen);
    }
    void operator()(command::Profile const& c) { stage.profile(c.on); }
    void operator()(command::Measure const& c) { stage.measure(c.on); }
    void operator()(command::MeasureField const& c) { stage.measureField(c.line, c.field); }
    void operator()(command::Measures const& c) {
      stage.measures([after = c.after, say = answer](Measures const& measures) {
        say(write_measures(measures, after));
      });
    }
  } doing{stage, answer};
  std::visit(doing, said);
}

/// The elements of what is seen, known by a number; of its points only how many there are. Words of four
/// bytes, the lowest first: 1 for a topology, its number, three floats upwards, how many bodies; for each
/// body its kind (SeenBody::Kind, and 4 more where it is hidden), three floats of its colour and one of its
/// opacity, lengths of path [bytes], points, triangles, quads, edges, triangles beyond its border; its
/// texture, counted from 1, or 0; how many texcoords; three floats of what is mirrored, and one of its
/// exponent; the path, filled up to a word, the numbers of the points of each element, and where it has
/// texcoords two floats of each, and their numbers at the corners of each triangle and quad, -1 for none.
std::string write_topology(SeenScene const& scene, std::uint32_t number);
/// The textures of the bodies of a scene, each once, as topologies count them: the words 3 and how many there
/// are; for each its length [bytes] and a file PNG or JPEG, filled up to a word.
std::string write_textures(std::vector<std::shared_ptr<SeenTexture const>> const& textures);
std::vector<std::shared_ptr<SeenTexture const>> textures_of(SeenScene const& scene);
/// A moment of it: the words 2, the number of its topology, how many points all bodies have, how many values:
/// none, or one a point; time [s] and step as doubles; x, y, z of each point as floats; the values that
/// colours show as floats, those of bodies without them no numbers.
std::string write_frame(SeenScene const& scene, std::uint32_t topology);

/// Of a topology that is read.
inline constexpr std::size_t mostPoints = 4'000'000;

struct ReadTopology {
  std::uint32_t number = 0;
  SeenScene scene{};                      // its points are all 0, and it has no textures
  std::vector<std::uint32_t> textures{};  // of each body, counted from 1, or 0
};
/// The inverse functions; throw Error where bytes are no topology, or no frame of this one.
ReadTopology read_topology(std::string_view bytes);
void read_frame(std::string_view bytes, ReadTopology& into);
std::vector<std::string> read_textures(std::string_view bytes);

/// Files that a page sends, one of which is a scene: a line of JSON, {"files": [{"name": "a.scn", "bytes":
/// 12}]}, and behind it the bytes of all files, one after the other.
inline constexpr std::size_t longestUpload = 16u << 20, mostFiles = 64, longestFileName = 200;
std::string write_upload(std::vector<SceneFile> const& files);
/// Throws Error where bytes are no such files, and where a name might lead out of the folder of the scene.
std::vector<SceneFile> read_upload(std::string_view bytes);
/// Which of them is the scene: the one that ends in .scn, or else in .xml. Throws Error where none is, or
/// several are.
std::size_t scene_among(std::vector<SceneFile> const& files);
/// The same files; and one that stands outside of the folder in which a scene among them looks for it, as it
/// does when a few files are dropped together, is there, too.
std::vector<SceneFile> placed(std::vector<SceneFile> files);
/// What to do about a file that is none of them.
inline constexpr char const* missingFile = "drop it along with the scene";

/// Messages for scenes that follow each other: their topology again only when it has changed.
class SceneWriter {
 public:
  /// What to send of a scene: to whom does not have the textures of their number, these first, and then the
  /// topology, if it is another one. Number 0: there are no textures.
  void write(SeenScene const& scene);
  std::uint32_t number() const { return number_; }
  std::uint32_t texturesNumber() const { return texturesNumber_; }
  std::string const& topology() const { return topology_; }
  std::string const& textures() const { return textures_; }
  std::string const& frame() const { return frame_; }

 private:
  std::uint32_t number_ = 0, texturesNumber_ = 0;
  std::vector<std::shared_ptr<SeenTexture const>> known_{};
  std::string topology_{}, textures_{}, frame_{};
};

}  // namespace sinew::view
