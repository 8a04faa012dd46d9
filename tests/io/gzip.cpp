// SPDX-License-Identifier: BSL-1.0
// Files that are compressed by gzip.
#include <sinew/io/gzip.hpp>
#include <sinew/io/read_obj.hpp>
#include <sinew/io/read_vtu.hpp>
#include <sinew/io/state_writer.hpp>

#include "files.hpp"

#include <array>
#include <bit>
#include <random>
#include <utility>

namespace test_gzip {

using namespace sinew;
using files::TempFolder;

namespace {

std::string some_bytes(std::size_t count, unsigned seed, unsigned values) {
  std::mt19937 random(seed);
  std::string bytes(count, ' ');
  for (char& c : bytes) c = char(random() % values);
  return bytes;
}

}  // namespace

TEST_CASE("bytes that are packed are unpacked to the same") {
  for (const std::size_t count :
       {std::size_t(1), std::size_t(65535), std::size_t(65536), std::size_t(1000003)})
    for (const unsigned values : {1u, 7u, 256u}) {
      const std::string bytes = some_bytes(count, values, values), packed = io::pack_gzip(bytes);
      CHECK(packed.starts_with("\x1f\x8b"));
      CHECK(io::unpack_gzip("f.gz", packed) == bytes);
    }
  // several members are one file, as gzip has it
  const std::string one = io::pack_gzip("one "), two = io::pack_gzip("two");
  CHECK(io::unpack_gzip("f.gz", one + two) == "one two");
}

TEST_CASE("a compressed file that is cut off or damaged is said") {
  const std::string bytes = some_bytes(5000, 3, 50), packed = io::pack_gzip(bytes);
  auto error = [](std::string const& content) { return error_of([&] { io::unpack_gzip("f.gz", content); }); };
  for (std::size_t n = 2; n < packed.size(); n += n < 30 ? 1 : 97)
    files::check_says(error(packed.substr(0, n)), "f.gz", "cut off");
  files::check_says(error(packed + "more"), "f.gz", "damaged");
  // its checksum finds every changed bit, wherever that is, but in what a header says of time and system
  for (std::size_t n = 10; n < packed.size(); n += 13) {
    std::string changed = packed;
    changed[n] = char(changed[n] ^ 4);
    CHECK_FALSE(error(changed).empty());
  }
}

TEST_CASE("a small file that unpacks to more than there is memory for is refused") {
  const std::size_t limit = memory_limit.exchange(1 << 20);
  const std::string packed = io::pack_gzip(std::string(std::size_t(1) << 24, 'a'));
  CHECK(packed.size() < 20000);
  files::check_says(error_of([&] { io::unpack_gzip("bomb.gz", packed); }), "bomb.gz", "unpacks to more than");
  memory_limit = limit;
}

TEST_CASE("readers read what is compressed") {
  TempFolder folder;
  const std::string file = folder.write("t.obj", io::pack_gzip("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  CHECK(io::read_obj(file).triangles.size() == 1);
}

TEST_CASE("VTK's XML is read where its arrays are compressed by zlib") {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::int64_t> corners{0, 1, 2, 3}, ends{4};
  const std::vector<std::uint8_t> types{10};
  // in blocks of so many bytes
  auto compressed = [](auto const& values, std::size_t block) {
    const std::string_view bytes(reinterpret_cast<char const*>(values.data()),
                                 values.size() * sizeof(values[0]));
    const std::size_t blocks = (bytes.size() + block - 1) / block;
    std::vector<std::uint32_t> header{
        std::uint32_t(blocks), std::uint32_t(block), std::uint32_t(bytes.size() % block)};
    std::string data;
    for (std::size_t i = 0; i < blocks; ++i) {
      const std::string_view part = bytes.substr(i * block, block);
      std::string packed(::compressBound(uLong(part.size())), ' ');
      uLongf n = uLongf(packed.size());
      ::compress(reinterpret_cast<Bytef*>(packed.data()),
                 &n,
                 reinterpret_cast<Bytef const*>(part.data()),
                 uLong(part.size()));
      header.push_back(std::uint32_t(n));
      data += packed.substr(0, n);
    }
    return std::pair(std::string(reinterpret_cast<char const*>(header.data()), 4 * header.size()), data);
  };
  auto base64 = [](std::string const& bytes) {
    std::string coded;
    io::Base64Encoder encoder(coded);
    encoder.add(bytes.data(), bytes.size());
    encoder.finish();
    return coded;
  };
  auto file = [](auto&& array, std::string const& appended) {
    return text("<VTKFile type=\"UnstructuredGrid\" byte_order=\"",
                std::endian::native == std::endian::big ? "BigEndian" : "LittleEndian",
                "\" header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid>"
                "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><Points>",
                array(0),
                "</Points><Cells>",
                array(1),
                array(2),
                array(3),
                "</Cells></Piece></UnstructuredGrid>",
                appended,
                "</VTKFile>");
  };
  auto tag = [](int i) {
    return text("<DataArray type=\"",
                std::array{"Float64", "Int64", "Int64", "UInt8"}[std::size_t(i)],
                "\" Name=\"",
                std::array{"Points", "connectivity", "offsets", "types"}[std::size_t(i)],
                "\" NumberOfComponents=\"",
                i == 0 ? 3 : 1,
                "\" ");
  };
  for (const std::size_t block : {std::size_t(8), std::size_t(32), std::size_t(1000)}) {
    const std::array all{compressed(points, block),
                         compressed(corners, block),
                         compressed(ends, block),
                         compressed(types, block)};
    const std::string inLine = file(
        [&](int i) {
          auto const& [header, data] = all[std::size_t(i)];
          return text(tag(i), "format=\"binary\">", base64(header), base64(data), "</DataArray>");
        },
        "");
    std::string raw;
    std::vector<std::size_t> offsets;
    for (auto const& [header, data] : all) offsets.push_back(raw.size()), raw += header + data;
    const std::string appended = file(
        [&](int i) { return text(tag(i), "format=\"appended\" offset=\"", offsets[std::size_t(i)], "\"/>"); },
        text("<AppendedData encoding=\"raw\">_", raw, "</AppendedData>"));
    for (std::string const& content : {inLine, appended}) {
      const Mesh mesh = io::parse_vtu("f.vtu", content);
      CHECK(mesh.positions == points);
      CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
    }
    // a block that is damaged, and one that is announced larger than any
    std::string bad = appended;
    bad[appended.find('_', appended.find("<AppendedData")) + 1 + all[0].first.size() + 3] ^= 0x55;
    files::check_says(error_of([&] { io::parse_vtu("f.vtu", bad); }), "f.vtu:1", "is not zlib's");
    bad = appended;
    bad[appended.find('_', appended.find("<AppendedData")) + 1 +
        (std::endian::native == std::endian::big ? 8 : 11)] = 0x7f;
    CHECK(error_of([&] { io::parse_vtu("f.vtu", bad); }).find("f.vtu:1: ") == 0);
  }
}

TEST_CASE("states are compressed where their name ends so, and recording goes on with them") {
  TempFolder folder;
  const std::string file = folder / "f.state.gz";
  io::StateLayout layout = io::state_layout<Vec3d>(2);
  layout.has = {false, true, false, false};
  auto add = [](auto& writer, int from, int to) {
    long stamp = 0;
    for (int k = from; k < to; ++k) {
      const double x[6] = {0.1 * k, 1, 2, 3, 4, 5};
      writer.add(std::size_t(k), stamp, 0.01 * k, {nullptr, x, nullptr, nullptr});
    }
  };
  for (const bool binary : {false, true}) {
    INFO((binary ? "binary" : "text"));
    {
      io::StateWriter<double> writer(file, layout, binary);
      add(writer, 0, 5);
      CHECK(std::filesystem::exists(file + ".part"));
      writer.finish();
    }
    CHECK(folder.count() == 1);
    {
      io::StateWriter<double> writer(file, layout, binary);
      add(writer, 3, 8);
      writer.finish();
    }
    auto const frames = io::read_state_file<double>(file, layout);
    REQUIRE(frames.times.size() == 8);
    for (int k = 0; k < 8; ++k) CHECK(frames.positions[std::size_t(6 * k)] == 0.1 * k);
    std::filesystem::remove(file);
  }
}

}  // namespace test_gzip
