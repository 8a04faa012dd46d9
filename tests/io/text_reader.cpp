// SPDX-License-Identifier: BSL-1.0
#include <sinew/io/text_reader.hpp>

#include "files.hpp"

namespace test_text_reader {

using namespace sinew;
using files::check_says;

TEST_CASE("read_file gives every byte, without the mark of UTF-8") {
  const files::TempFolder folder;
  std::string bytes = "a\r\n\0\xff b";
  bytes += '\0';
  CHECK(io::read_file(folder.write("plain", bytes)) == bytes);
  CHECK(io::read_file(folder.write("marked",
                                   "\xEF\xBB\xBF"
                                   "abc")) == "abc");
  const std::string large(300001, 'x');
  CHECK(io::read_file(folder.write("large", large)) == large);
}

TEST_CASE("read_file names the file and what is wrong with it") {
  const files::TempFolder folder;
  const std::string missing = folder / "missing.msh";
  check_says(error_of([&] { io::read_file(missing); }), missing, "No such file");
  check_says(error_of([&] { io::read_file("missing.msh"); }), "missing.msh", "looked for from the folder /");
  check_says(error_of([&] { io::read_file(folder / "."); }), folder / ".", "is a folder");
  const std::string empty = folder.write("empty", "");
  check_says(error_of([&] { io::read_file(empty); }), empty, "is empty");
  // a pipe without a writer would block for ever
  const std::string pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  check_says(error_of([&] { io::read_file(pipe); }), pipe, "not a regular file");
  check_says(error_of([&] { io::read_file("/dev/zero"); }), "/dev/zero", "not a regular file");
  if (::geteuid() != 0) {  // root may read everything
    const std::string locked = folder.write("locked", "x");
    REQUIRE(::chmod(locked.c_str(), 0) == 0);
    check_says(error_of([&] { io::read_file(locked); }), locked, "cannot be opened");
  }
}

TEST_CASE("numbers are whole words") {
  double real = 0;
  CHECK((io::parse_number("-1.5e3", real) && real == -1500));
  CHECK((io::parse_number("+.5", real) && real == 0.5));
  CHECK((io::parse_number("1e-400", real) && real == 0));
  CHECK((io::parse_number("1e400", real) && std::isinf(real)));
  CHECK((io::parse_number("4.9e-324", real) && real == 4.9e-324));
  for (const char* word : {"", "1,5", "1.5x", " 1", "+-1", "++1", "0x10", "-", "+", "e5", "1e"}) {
    INFO(word);
    CHECK_FALSE(io::parse_number(word, real));
  }
  std::int64_t whole = 0;
  CHECK((io::parse_number("+12", whole) && whole == 12));
  for (const char* word : {"1.0", "9223372036854775808", "1e3"}) CHECK_FALSE(io::parse_number(word, whole));
}

TEST_CASE("TextReader knows the line of each word") {
  io::TextReader in("f", "one  two\r\n\n\tthree\nfour five\nsix", 7);
  CHECK(in.word() == "one");
  CHECK(in.line() == 7);
  CHECK(in.word() == "two");
  CHECK(in.word() == "three");
  CHECK(in.line() == 9);
  CHECK(in.wordOnLine().empty());
  CHECK(in.restOfLine().empty());
  CHECK(in.restOfLine() == "four five");
  CHECK(in.line() == 10);
  CHECK(in.more());
  CHECK(in.word() == "six");
  CHECK(in.line() == 11);
  CHECK_FALSE(in.more());
  CHECK(in.word().empty());
}

TEST_CASE("a backslash joins lines for words of one line only") {
  io::TextReader in("f", "a b\\\n c \\\r\nd\ne");
  for (const char* word : {"a", "b", "c", "d", ""}) CHECK(in.wordOnLine() == word);
  in.restOfLine();
  CHECK(in.word() == "e");
  CHECK(in.line() == 4);
  io::TextReader plain("f", "b\\\nc");
  CHECK(plain.word() == "b\\");
}

TEST_CASE("TextReader refuses with path and line") {
  auto in = [](std::string_view content) { return io::TextReader("p.msh", content); };
  check_says(error_of([&] { in("\n\nabc").real("a coordinate"); }),
             "p.msh:3",
             "expected a coordinate, found \"abc\"");
  check_says(error_of([&] { in("\n nan").real("a coordinate"); }), "p.msh:2", "not a finite number");
  check_says(error_of([&] { in("-1e999").real("a coordinate"); }), "p.msh:1", "not a finite number");
  check_says(error_of([&] { in("1\n").word(), in("\n").real("a coordinate"); }), "p.msh:2", "data end");
  check_says(error_of([&] { in("1.5").integer("a tag"); }), "p.msh:1", "a tag, a whole number");
  check_says(error_of([&] {
               in("a\x01\xff"
                  "b")
                   .integer("a tag");
             }),
             "p.msh:1",
             "found \"a??b\"");
  check_says(error_of([&] { in(std::string(100, 'y')).integer("a tag"); }),
             "p.msh:1",
             std::string(40, 'y').append("...\""));
  check_says(error_of([&] { in("5").index(5); }), "p.msh:1", "point 5 is not among the 5 points");
  check_says(error_of([&] { in("-1").index(5); }), "p.msh:1", "point -1 is not");
  check_says(error_of([&] { in("text\n\n\x02").rejectBinary(); }), "p.msh:3", "byte 2");
  CHECK_NOTHROW(in("caf\xC3\xA9\t\r\n\f").rejectBinary());
}

TEST_CASE("a count cannot exceed what fits into the rest of the text") {
  auto count = [](std::string_view content, std::size_t words) {
    return io::TextReader("p", content).count("the number of nodes", words);
  };
  CHECK(count("3 1 2 3", 1) == 3);
  CHECK(count("1 1 2 3", 3) == 1);
  CHECK(count("0", 4) == 0);
  check_says(error_of([&] { count("4 1 2 3", 1); }), "p:1", "given as 4, but no more than 3 fit");
  check_says(error_of([&] { count("2 1 2 3", 3); }), "p:1", "given as 2, but no more than 1 fit");
  check_says(error_of([&] { count("-1 1", 1); }), "p:1", "given as -1");
  check_says(error_of([&] { count("9223372036854775807 1 2", 1); }), "p:1", "correct the number");
}

}  // namespace test_text_reader
