// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/read_vtu.hpp>

#include "files.hpp"
#include "samples.hpp"

namespace test_read_vtu {

using namespace sinew;
using files::check_says;
using files::replaced;

namespace {

std::string error_with(std::string const& sample, std::string_view from, std::string_view to) {
  return error_of([&] { io::parse_vtu("f.vtu", replaced(sample, from, to)); });
}

/// Bytes of values in an order, after their number in `Header`.
template <class Header, class T>
std::string encoded(std::vector<T> const& values, bool bigEndian, bool base64) {
  std::string bytes;
  auto add = [&](auto value) {
    std::string part(reinterpret_cast<char const*>(&value), sizeof value);
    if (bigEndian == (std::endian::native == std::endian::little)) std::reverse(part.begin(), part.end());
    bytes += part;
  };
  add(Header(values.size() * sizeof(T)));
  for (const T v : values) add(v);
  if (!base64) return bytes;
  std::string code;
  io::Base64Encoder encoder(code);
  encoder.add(bytes.data(), bytes.size());
  encoder.finish();
  return code;
}

enum class Place { inside, appendedRaw, appendedBase64 };

/// The mesh of samples.hpp with all data encoded.
template <class Header, class Real, class Whole>
std::string encoded_sample(Place place, bool bigEndian) {
  const std::vector<Real> x{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.25, 0.5, -1.5};
  const std::vector<Whole> connectivity{3, 4, 0, 2, 1, 0, 1, 2, 3, 0, 1, 2, 4}, offsets{2, 5, 9, 13};
  const std::vector<std::uint8_t> types{3, 5, 9, 10};
  std::string appended,
      out = text("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" byte_order=\"",
                 bigEndian ? "BigEndian" : "LittleEndian",
                 "\" header_type=\"",
                 sizeof(Header) == 8 ? "UInt64" : "UInt32",
                 "\">\n<UnstructuredGrid>\n",
                 "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">\n");
  auto array = [&](std::string_view name, std::string_view type, auto const& values) {
    const std::string data = encoded<Header>(values, bigEndian, place != Place::appendedRaw);
    out += text("<DataArray type=\"", type, "\" Name=\"", name, "\" ");
    if (place == Place::inside) {
      out += text("format=\"binary\">\n  ", data, "\n</DataArray>\n");
    } else {
      out += text("format=\"appended\" offset=\"", appended.size(), "\"/>\n");
      appended += data;
    }
  };
  const char* whole = sizeof(Whole) == 8 ? "UInt64" : sizeof(Whole) == 4 ? "Int32" : "Int16";
  out += "<Points>\n";
  array("", sizeof(Real) == 8 ? "Float64" : "Float32", x);
  out += "</Points><Cells>\n";
  array("connectivity", whole, connectivity);
  array("offsets", whole, offsets);
  array("types", "UInt8", types);
  out += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (place != Place::inside)
    out += text("<AppendedData encoding=\"",
                place == Place::appendedRaw ? "raw" : "base64",
                "\">\n _",
                appended,
                "\n</AppendedData>\n");
  return out + "</VTKFile>\n";
}

}  // namespace

TEST_CASE("read_vtu reads ascii data") {
  const files::TempFolder folder;
  CHECK(io::read_vtu(folder.write("a.vtu", samples::vtuAscii)) == samples::mesh());
}

TEST_CASE("read_vtu reads encoded data of all headers, orders and types") {
  for (const Place place : {Place::inside, Place::appendedRaw, Place::appendedBase64})
    for (const bool bigEndian : {false, true}) {
      INFO(int(place) << ' ' << bigEndian);
      CHECK(io::parse_vtu("f", encoded_sample<std::uint32_t, double, std::uint64_t>(place, bigEndian)) ==
            samples::mesh());
      CHECK(io::parse_vtu("f", encoded_sample<std::uint64_t, float, std::int32_t>(place, bigEndian)) ==
            samples::mesh());
      CHECK(io::parse_vtu("f", encoded_sample<std::uint64_t, double, std::int16_t>(place, bigEndian)) ==
            samples::mesh());
    }
}

TEST_CASE("read_vtu joins pieces") {
  const std::size_t begin = samples::vtuAscii.find("<Piece"),
                    end = samples::vtuAscii.find("</UnstructuredGrid>");
  std::string two = samples::vtuAscii;
  two.insert(end, samples::vtuAscii.substr(begin, end - begin));
  two.insert(end, "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"/>");
  const Mesh mesh = io::parse_vtu("f", two);
  CHECK(mesh.positions.size() == 10);
  CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 4}, {5, 6, 7, 9}});
  CHECK(mesh.edges == std::vector<Edge>{{3, 4}, {8, 9}});
}

TEST_CASE("read_vtu gives each array bytes of its own, so that a small file is no large mesh") {
  const std::string one = encoded_sample<std::uint32_t, double, std::int32_t>(Place::appendedRaw, false);
  const std::size_t begin = one.find("<Piece"), end = one.find("</UnstructuredGrid>");
  std::string many = one;
  for (int i = 0; i < 1000; ++i) many.insert(end, one.substr(begin, end - begin));
  files::check_says(
      error_of([&] { io::parse_vtu("f", many); }), "f:15", "each array at an offset of its own");
}

TEST_CASE("read_vtu says what it does not read") {
  using samples::vtuAscii;
  // VTK names its compressor also where all arrays are text
  std::string compressed = vtuAscii;
  compressed.replace(compressed.find("byte_order"), 0, "compressor=\"vtkZLibDataCompressor\" ");
  CHECK(io::parse_vtu("f.vtu", compressed).positions.size() == 5);
  compressed.replace(compressed.find("format=\"ascii\""), 14, "format=\"binary\"");
  check_says(error_of([&] { io::parse_vtu("f.vtu", compressed); }),
             "f.vtu:7",
             "compressed with \"vtkZLibDataCompressor\"; save it uncompressed");
  check_says(error_with(vtuAscii, "type=\"UnstructuredGrid\"", "type=\"PolyData\""),
             "f.vtu:2",
             "holds \"PolyData\"");
  check_says(error_with(vtuAscii, "LittleEndian", "MiddleEndian"), "f.vtu:2", "MiddleEndian");
  check_says(error_with(vtuAscii, "byte_order", "header_type=\"UInt16\" byte_order"), "f.vtu:2", "UInt16");
  check_says(error_with(vtuAscii, "format=\"ascii\"", "format=\"ansi\""), "f.vtu:7", "format is \"ansi\"");
  check_says(error_with(vtuAscii, "5 9 10<", "5 9 26<"), "f.vtu:18", "cell 4 is of VTK's cell type 26");
  check_says(error_of([] { io::parse_vtu("f.vtu", "<svg/>"); }), "f.vtu:1", "no <VTKFile>");
  check_says(error_of([] { io::parse_vtu("f.vtu", "hello"); }), "f.vtu:1", "not complete XML");
}

TEST_CASE("read_vtu names the line of an error") {
  using samples::vtuAscii;
  check_says(error_with(vtuAscii, "0.25 0.5", "0.25 nan"), "f.vtu:9", "not a finite number");
  check_says(error_with(vtuAscii, "0.25 0.5", "0.25 x.5"), "f.vtu:9", "found \"x.5\"");
  check_says(error_with(vtuAscii, "0.25 0.5", "0.25"), "f.vtu:7", "has 14 values, but 5 times 3");
  check_says(
      error_with(vtuAscii, "0 3 4 0", "0 3 5 0"), "f.vtu:13", "cell 1 refers to point 5, but there are 5");
  check_says(error_with(vtuAscii, "0 3 4 0", "0 -3 4 0"), "f.vtu:13", "refers to point -3");
  check_says(
      error_with(vtuAscii, "1 3 6 10 14", "1 3 6 5 14"), "f.vtu:17", "cell 3 of 5 begins at 6 and ends at 5");
  check_says(error_with(vtuAscii, "1 3 6 10 14", "1 3 6 10 15"), "f.vtu:17", "ends at 15 of the 14");
  check_says(error_with(vtuAscii, "1 3 6 10 14", "1 3 6 10 13"), "f.vtu:17", "ends at 13 of the 14");
  check_says(error_with(vtuAscii, "1 3 6 10 14", "1 3 6 10"), "f.vtu:17", "has 4 values");
  check_says(error_with(vtuAscii, "1 3 6 10 14", "1 3 6 10.0 14"), "f.vtu:17", "a whole number");
  check_says(error_with(vtuAscii, "\"types\"", "\"kinds\""), "f.vtu:4", "no DataArray for types");
  check_says(error_with(vtuAscii, "NumberOfPoints=\"5\"", "NumberOfPoints=\"99999999999\""),
             "f.vtu:7",
             "99999999999");
  check_says(error_with(vtuAscii, "NumberOfCells=\"5\"", "NumberOfCells=\"-5\""),
             "f.vtu:4",
             "NumberOfCells is \"-5\"");
  check_says(error_with(vtuAscii, "<PointData>", "<PointData\x01>"), "f.vtu:5", "not text");
}

TEST_CASE("read_vtu trusts no number of bytes in encoded data") {
  const std::string inside = encoded_sample<std::uint64_t, double, std::int32_t>(Place::inside, false);
  const std::string raw = encoded_sample<std::uint64_t, double, std::int32_t>(Place::appendedRaw, false);
  // 120 bytes of points; their number is the first of the data
  const std::string number("\x78\0\0\0\0\0\0\0", 8);
  check_says(
      error_with(raw, number, std::string("\xff\xff\xff\xff\xff\xff\xff\xff", 8)), "f.vtu:6", "fewer bytes");
  check_says(error_with(raw, number, std::string("\x79\0\0\0\0\0\0\0", 8)),
             "f.vtu:6",
             "not a whole number of values");
  check_says(error_with(raw, number, std::string("\x70\0\0\0\0\0\0\0", 8)), "f.vtu:6", "has 14 values");
  check_says(error_with(raw, "offset=\"0\"", "offset=\"100000\""), "f.vtu:6", "beyond");
  check_says(error_with(raw, "offset=\"0\"", "offset=\"-1\""), "f.vtu:6", "offset is \"-1\"");
  check_says(error_with(inside, "eAAAAAAAAAA", "eAAAAA*AAAA"), "f.vtu:6", "not base64");
  check_says(error_with(inside, "eAAAAAAAAAA", "////////////AAA"), "f.vtu:6", "fewer bytes");
  check_says(error_with(inside, "type=\"Int32\"", "type=\"Float32\""), "f.vtu:10", "type is \"Float32\"");
  // -inf in place of the z of the last point, -1.5
  check_says(error_with(raw, std::string("\0\0\0\0\0\0\xf8\xbf", 8), std::string("\0\0\0\0\0\0\xf0\xff", 8)),
             "f.vtu:6",
             "point 4 has a coordinate that is not a finite number");
}

TEST_CASE("read_vtu refuses every incomplete file") {
  const std::string encoded[] = {
      samples::vtuAscii,
      encoded_sample<std::uint32_t, float, std::int32_t>(Place::inside, true),
      encoded_sample<std::uint32_t, float, std::int32_t>(Place::appendedRaw, false),
      encoded_sample<std::uint64_t, float, std::int16_t>(Place::appendedBase64, false)};
  for (std::string const& sample : encoded)
    for (std::size_t n = 0; n + 2 < sample.size(); ++n) {  // the last two bytes are > and the end of the line
      INFO(sample.substr(0, n));
      CHECK_THROWS_AS(io::parse_vtu("f", std::string_view(sample).substr(0, n)), Error);
    }
}

}  // namespace test_read_vtu
