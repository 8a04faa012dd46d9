// SPDX-License-Identifier: BSL-1.0
// libFuzzer: whatever the bytes of a file, a reader ends in what it holds, sound and no larger than the file
// allows, or in Error. `fuzz_read_data --format=msh -runs=1000000 FOLDER tests/fuzz/files/msh` goes on from
// the samples and keeps in FOLDER what is new;
// `-runs=0` only reads the samples.
#include <sinew/io/mesh_file.hpp>
#include <sinew/io/read_rigid.hpp>
#include <sinew/io/read_sph.hpp>
#include <sinew/io/state_file.hpp>
#include <sinew/runtime/record.hpp>

#include <cstdlib>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maximum);

namespace {

using namespace sinew;

void demand(bool condition, char const* what) {
  if (condition) return;
  std::fprintf(stderr, "what was read is not sound: %s\n", what);
  std::abort();
}

// each point and each element stands in bytes of its own
template <Mesh (*Parse)(std::string_view, std::string_view)>
void read_mesh(std::string_view bytes) {
  const Mesh mesh = Parse("f", bytes);
  try {
    check_mesh("f", mesh);
  } catch (Error const& error) {
    demand(false, error.what());
  }
  demand(!mesh.positions.empty(), "it has no points");
  demand(mesh.positions.size() + mesh.edges.size() + mesh.triangles.size() + mesh.quads.size() +
                 mesh.tetrahedra.size() + mesh.hexahedra.size() <=
             bytes.size(),
         "it has more points and elements than the file has bytes");
}

void read_spheres(std::string_view bytes) {
  const io::Spheres spheres = io::parse_sph("f", bytes);
  demand(!spheres.radii.empty() && spheres.radii.size() == spheres.centers.size() &&
             spheres.radii.size() <= bytes.size(),
         "centres and radii differ in number");
  for (std::size_t i = 0; i < spheres.radii.size(); ++i)
    demand(all_finite(spheres.centers[i]) && std::isfinite(spheres.radii[i]) && spheres.radii[i] > 0,
           "a sphere");
}

void read_rigid(std::string_view bytes) {
  const auto body = io::parse_rigid("f", bytes);
  demand(std::isfinite(body.mass) && body.mass > 0, "the mass");
  demand(body.inertia.allFinite(), "the inertia is not finite");
}

template <class D>
void read_states(std::string_view bytes, std::size_t points, bool allowTruncated) try {
  const io::StateLayout layout = io::state_layout<D>(points);
  const auto frames = io::parse_state_file<typename D::Real>("f", bytes, layout, allowTruncated);
  const std::size_t count = frames.times.size();
  demand(count > 0 && count == frames.begins.size() && frames.end <= bytes.size(), "the number of frames");
  demand(frames.positions.size() == count * layout.numbers(io::StateLayout::position),
         "the number of positions");
  demand(frames.velocities.empty() ||
             frames.velocities.size() == count * layout.numbers(io::StateLayout::velocity),
         "the number of velocities");
  for (const double t : frames.times) demand(std::isfinite(t), "a time");
  for (const auto x : frames.positions) demand(std::isfinite(x), "a position");
  for (const auto v : frames.velocities) demand(std::isfinite(v), "a velocity");
} catch (Error const&) {
}
// a file belongs to one of these states
void read_states(std::string_view bytes) {
  for (const bool allowTruncated : {false, true}) {
    read_states<Vec3d>(bytes, 2, allowTruncated);
    read_states<Rigid3d>(bytes, 1, allowTruncated);
    read_states<Vec1f>(bytes, 3, allowTruncated);
  }
}

// what was read is written, read and written again as the same text
void read_record(std::string_view bytes) {
  auto written = [](std::vector<RecordedFrame> const& frames) {
    std::string all = "sinew record 1\n";
    for (auto const& frame : frames) all += record_text(frame);
    return text(all, "end ", frames.size(), '\n');
  };
  const std::string once = written(parse_record("f", bytes));
  try {
    demand(written(parse_record("written", once)) == once,
           "it is another one when it is written and read again");
  } catch (Error const& error) {
    demand(false, error.what());
  }
}

struct Format {
  std::string_view name;
  void (*read)(std::string_view bytes);
};
constexpr Format formats[] = {{"msh", read_mesh<io::parse_gmsh>},
                              {"obj", read_mesh<io::parse_obj>},
                              {"stl", read_mesh<io::parse_stl>},
                              {"vtk", read_mesh<io::parse_vtk>},
                              {"vtu", read_mesh<io::parse_vtu>},
                              {"sph", read_spheres},
                              {"rigid", read_rigid},
                              {"state", read_states},
                              {"record", read_record}};
Format chosen{};

/// Numbers of Marsaglia's xorshift64 (2003).
struct Random {
  std::uint64_t state;
  std::size_t below(std::size_t n) {
    state ^= state << 13, state ^= state >> 7, state ^= state << 17;
    return std::size_t(state % n);
  }
};

bool blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

// a word is replaced, removed, or copied to another place; or a line is
void mutate_words(std::string& bytes, Random& random) {
  constexpr std::string_view words[] = {"0",
                                        "-1",
                                        "1",
                                        "2",
                                        "3",
                                        "4",
                                        "1e9",
                                        "1e300",
                                        "-1e300",
                                        "1e-300",
                                        "1e999",
                                        "nan",
                                        "inf",
                                        "2147483647",
                                        "-2147483648",
                                        "4294967295",
                                        "9223372036854775807",
                                        "-9223372036854775808",
                                        "18446744073709551615",
                                        "-",
                                        "#",
                                        "\n",
                                        "\\\n",
                                        ""};
  const std::size_t at = random.below(bytes.size());
  const bool lines = random.below(4) == 0;
  auto isEnd = [&](std::size_t i) { return lines ? bytes[i] == '\n' : blank(bytes[i]); };
  std::size_t begin = at, end = at;
  while (begin > 0 && !isEnd(begin - 1)) --begin;
  while (end < bytes.size() && !isEnd(end)) ++end;
  const std::string part = bytes.substr(begin, end - begin) + (lines ? "\n" : " ");
  switch (random.below(3)) {
    case 0:
      bytes.replace(begin, end - begin, words[random.below(std::size(words))]);
      break;
    case 1:
      bytes.erase(begin, end - begin + (end < bytes.size()));
      break;
    default:
      bytes.insert(random.below(bytes.size()), part);
  }
}

template <class T>
void put(std::string& bytes, std::size_t at, T value) {
  bytes.replace(at, sizeof value, reinterpret_cast<char const*>(&value), sizeof value);
}

// sizes and checksums of binary files fit again, so that a change is read and not refused because of them
void mend(std::string& bytes) {
  if (chosen.name == "stl" && bytes.size() >= 84) put(bytes, 80, std::uint32_t((bytes.size() - 84) / 50));
  if (chosen.name != "state" || !bytes.starts_with(io::state_file::magic) ||
      bytes.size() < io::state_file::headerSize)
    return;
  put(bytes, 56, io::state_file::checksum(std::string_view(bytes).substr(0, 56)));
  const auto width = io::state_file::get<std::uint32_t>(bytes, 32),
             flags = io::state_file::get<std::uint32_t>(bytes, 36);
  io::StateLayout layout = width == 8 ? io::state_layout<Vec3d>(2) : io::state_layout<Vec1f>(3);
  if (bytes[16] == 'R') layout = io::state_layout<Rigid3d>(1);
  for (std::size_t part = 0; part < 4; ++part) layout.has[part] = flags >> part & 1;
  const std::size_t size = 16 + layout.numbers() * (width == 8 ? 8 : 4);
  for (std::size_t at = io::state_file::headerSize; at + size <= bytes.size(); at += size)
    put(bytes, at + size - 8, io::state_file::checksum(std::string_view(bytes).substr(at, size - 8)));
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--format=";
  std::string names;
  for (auto const& format : formats) names += text(' ', format.name);
  for (int i = 1; i < *argc; ++i)
    if (const std::string_view word = (*argv)[i]; word.starts_with(option))
      for (auto const& format : formats)
        if (format.name == word.substr(option.size())) chosen = format;
  if (chosen.read) return 0;
  std::fprintf(stderr, "give the format: --format= with one of%s\n", names.c_str());
  std::exit(1);
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maximum,
                                               unsigned seed) {
  Random random{(std::uint64_t(seed) << 1 | 1) * 0x9e3779b97f4a7c15u};
  std::string bytes;
  if (size == 0 || random.below(2) == 0) {
    size = LLVMFuzzerMutate(data, size, maximum);
    bytes.assign(reinterpret_cast<char const*>(data), size);
  } else {
    bytes.assign(reinterpret_cast<char const*>(data), size);
    for (std::size_t changes = 1 + random.below(3); changes > 0 && !bytes.empty(); --changes)
      mutate_words(bytes, random);
  }
  if (random.below(4) != 0) mend(bytes);
  size = std::min(bytes.size(), maximum);
  std::copy_n(bytes.data(), size, reinterpret_cast<char*>(data));
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(unsigned char const* data, std::size_t size) {
  try {
    chosen.read({reinterpret_cast<char const*>(data), size});
  } catch (Error const& error) {
    demand(std::string_view(error.what()).starts_with("f"), "an error names another file");
  }
  return 0;
}
