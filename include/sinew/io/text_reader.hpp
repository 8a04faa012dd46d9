// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>
#include <sinew/core/error.hpp>
#include <sinew/core/mesh.hpp>

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace sinew::io {

/// The bytes of a whole file, without the mark (EF BB BF) that some programs put before UTF-8. Throws Error
/// if the file is missing, empty, unreadable, or not a regular file (a folder, a pipe, a device).
std::string read_file(std::string const& path);

/// The bytes of a file that is compressed by gzip, and such a file of bytes: null unless the program includes
/// io/gzip.hpp somewhere.
__attribute__((weak)) std::string unpack_gzip(std::string const& path, std::string_view packed);
__attribute__((weak)) std::string pack_gzip(std::string_view bytes);
/// The `size` bytes of a stream of zlib, likewise.
__attribute__((weak)) std::string unpack_zlib(std::string const& where, std::string_view packed,
                                              std::size_t size);
/// Whether the program has one of them.
template <class F>
bool is_there(F* function) {
  return function != nullptr;
}

/// `word` in quotes, fit for a message: shortened, and without unprintable bytes.
std::string in_quotes(std::string_view word);

/// The same letters in lower case, for names that do not depend on case.
inline std::string lower_case(std::string_view word) {
  std::string lower(word);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return lower;
}

/// Reads `word` as a number whatever the locale of the process; false unless all of it is one. A real too
/// small for a double is 0; one too large, infinite.
template <class T>
bool parse_number(std::string_view word, T& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  if constexpr (std::is_floating_point_v<T>)
    if (code == std::errc::result_out_of_range) {
      const bool small =
          word.find("e-") != std::string_view::npos || word.find("E-") != std::string_view::npos;
      value = small ? T(0) : std::numeric_limits<T>::infinity();
      return end == word.data() + word.size();
    }
  return code == std::errc{} && end == word.data() + word.size();
}

/// Words and numbers of a text one after the other, with the line that they stand on. Reading functions throw
/// Error at "path:line". The text must outlive the reader and the words it gives.
class TextReader {
 public:
  TextReader(std::string_view path, std::string_view content, std::size_t firstLine = 1)
      : path_(path), text_(content), first_(firstLine), line_(firstLine), wordLine_(firstLine) {}

  /// The next word of any line; empty at the end.
  std::string_view word() {
    more();
    return take(false);
  }
  /// The next word of this line; empty at the end of the line. A backslash at the end of a line joins the
  /// next.
  std::string_view wordOnLine();
  /// The rest of this line, without what ends it; the next word is from the line after it.
  std::string_view restOfLine();
  /// The next `n` numbers of `size` bytes of a file that is not text only; from the line after this one, or
  /// from here.
  std::string_view bytesAfterLine(std::size_t n, std::size_t size) {
    restOfLine();
    return bytes(n, size);
  }
  std::string_view bytes(std::size_t n, std::size_t size);
  /// Skips white space; false at the end.
  bool more() {
    for (; at_ < text_.size() && space(text_[at_]); ++at_) line_ += text_[at_] == '\n';
    return !atEnd();
  }
  bool atEnd() const { return at_ >= text_.size(); }

  /// The next word as a finite number; `what` is for the message: "a coordinate".
  double real(std::string_view what);
  Eigen::Vector3d point() {
    Eigen::Vector3d p;
    for (double& c : p) c = real("a coordinate");
    return p;
  }
  std::int64_t integer(std::string_view what) {
    std::int64_t value = 0;
    if (!parse_number(word(), value)) throw expected(text(what, ", a whole number"));
    return value;
  }
  /// The number of items that follow, each of at least `words` words; refused if they cannot be in the rest
  /// of the text. So memory may be reserved for them.
  std::size_t count(std::string_view what, std::size_t words);
  /// The number of one of `points` points, counted from 0.
  Index index(std::size_t points) { return checkedIndex(integer("the number of a point"), points); }
  Index checkedIndex(std::int64_t i, std::size_t points) const {
    if (i < 0 || std::uint64_t(i) >= points)
      throw error(text("point ",
                       i,
                       " is not among the ",
                       points,
                       " points, numbered from 0; correct the number or add the point"));
    return Index(i);
  }

  /// The line of the last word, from 1.
  std::size_t line() const { return wordLine_; }
  /// An Error at a line, or at that of the last word.
  Error error(std::size_t line, std::string_view message) const {
    return Error(text(path_, ':', line), message);
  }
  Error error(std::string_view message) const { return error(wordLine_, message); }
  /// The Error for a last word that is not `what`, or is missing.
  Error expected(std::string_view what) const;
  /// Leaves off zero bytes at the end, which some programs write, and throws Error at the first byte before
  /// them that no text file has.
  void rejectBinary();

 private:
  static constexpr bool space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  // length of a backslash with the end of line after it, or 0
  std::size_t joined(std::size_t at) const {
    if (text_.substr(at, 2) == "\\\n") return 2;
    return text_.substr(at, 3) == "\\\r\n" ? 3 : 0;
  }
  std::string_view take(bool mayJoin);

  std::string path_;
  std::string_view text_;
  std::size_t at_ = 0, first_, line_, wordLine_;
  std::string_view word_{};
};

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <memory>

namespace sinew::io {

SINEW_ONCE std::string read_file(std::string const& path) {
  struct stat info;
  if (::stat(path.c_str(), &info) != 0) {
    char folder[PATH_MAX];
    std::string looked;
    if (errno == ENOENT && !path.starts_with('/') && ::getcwd(folder, sizeof folder))
      looked = text(" (looked for from the folder ", static_cast<char const*>(folder), ")");
    throw Error(path,
                text("cannot be read: ",
                     static_cast<char const*>(std::strerror(errno)),
                     looked,
                     "; correct the name of the file"));
  }
  if (S_ISDIR(info.st_mode)) throw Error(path, "is a folder; name a file in it");
  if (!S_ISREG(info.st_mode)) throw Error(path, "is not a regular file; copy its content into one");

  auto close = [](std::FILE* f) { std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file)
    throw Error(path,
                text("cannot be opened: ",
                     static_cast<char const*>(std::strerror(errno)),
                     "; ask for the right to read it"));
  std::string bytes(std::size_t(info.st_size) + 1, '\0');
  std::size_t filled = 0;
  while (const std::size_t n = std::fread(bytes.data() + filled, 1, bytes.size() - filled, file.get())) {
    filled += n;
    if (filled == bytes.size()) bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file.get()))
    throw Error(path,
                text("cannot be read to its end: ",
                     static_cast<char const*>(std::strerror(errno)),
                     "; check the disk or the network"));
  bytes.resize(filled);
  if (bytes.starts_with("\x1f\x8b")) {
    if (!is_there(unpack_gzip))
      throw Error(path,
                  "is compressed by gzip, which this program does not read; unpack it with gunzip first, or "
                  "include sinew/io/gzip.hpp");
    bytes = unpack_gzip(path, bytes);
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.erase(0, 3);
  if (bytes.empty()) throw Error(path, "is empty; export it again, or name another file");
  return bytes;
}

SINEW_ONCE std::string in_quotes(std::string_view word) {
  std::string shown(word.substr(0, 40));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return text('"', shown, word.size() > 40 ? "...\"" : "\"");
}

SINEW_ONCE std::string_view TextReader::wordOnLine() {
  for (;; ++at_) {
    if (const std::size_t n = joined(at_)) {
      at_ += n - 1, ++line_;
    } else if (at_ >= text_.size() || text_[at_] == '\n' || !space(text_[at_])) {
      break;
    }
  }
  return take(true);
}

SINEW_ONCE std::string_view TextReader::restOfLine() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view rest = text_.substr(at_, end - at_);
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  wordLine_ = line_, line_ += end < text_.size();
  at_ = std::min(end + 1, text_.size());
  return rest;
}

SINEW_ONCE std::string_view TextReader::bytes(std::size_t n, std::size_t size) {
  const std::size_t left = text_.size() - at_;
  if (n > left / size)
    throw error(text(n,
                     " binary numbers of ",
                     size,
                     " bytes are announced, but ",
                     left,
                     " bytes follow; get a complete file"));
  at_ += n * size;
  return text_.substr(at_ - n * size, n * size);
}

SINEW_ONCE double TextReader::real(std::string_view what) {
  double value = 0;
  if (!parse_number(word(), value)) throw expected(what);
  if (!std::isfinite(value))
    throw error(text("expected ",
                     what,
                     ", found ",
                     in_quotes(word_),
                     ", which is not a finite number; ",
                     "correct it, or find out why the program that wrote the file went wrong"));
  return value;
}

SINEW_ONCE std::size_t TextReader::count(std::string_view what, std::size_t words) {
  const std::int64_t n = integer(what);
  const std::size_t room = (text_.size() - at_) / (2 * words);  // a space before each word
  if (n < 0 || std::size_t(n) > room || n > std::numeric_limits<Index>::max())
    throw error(text(what,
                     " is given as ",
                     n,
                     ", but no more than ",
                     room,
                     " fit into the ",
                     text_.size() - at_,
                     " bytes that follow; correct the number, or get a complete file"));
  return std::size_t(n);
}

SINEW_ONCE Error TextReader::expected(std::string_view what) const {
  if (word_.empty() && atEnd())
    return error(text("the data end where ",
                      what,
                      " is expected; the file is incomplete or a count in it is wrong: get a complete one"));
  return error(text("expected ",
                    what,
                    ", found ",
                    word_.empty() ? "the end of the line" : in_quotes(word_),
                    "; correct this line"));
}

SINEW_ONCE void TextReader::rejectBinary() {
  while (text_.ends_with('\0')) text_.remove_suffix(1);
  const auto bad = std::find_if(text_.begin(), text_.end(), [](char c) {
    return (static_cast<unsigned char>(c) < ' ' && !space(c)) || c == 0x7f;
  });
  if (bad == text_.end()) return;
  throw error(first_ + std::size_t(std::count(text_.begin(), bad, '\n')),
              text("holds the byte ", int(*bad), ", which is not text; export the file as ASCII or UTF-8"));
}

SINEW_ONCE std::string_view TextReader::take(bool mayJoin) {
  const std::size_t begin = at_;
  while (at_ < text_.size() && !space(text_[at_]) && !(mayJoin && joined(at_))) ++at_;
  wordLine_ = line_;
  return word_ = text_.substr(begin, at_ - begin);
}

}  // namespace sinew::io
#endif
