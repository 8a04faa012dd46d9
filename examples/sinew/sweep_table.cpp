// SPDX-License-Identifier: BSL-1.0
#include "sweep_table.hpp"

#include "csv.hpp"
#include "options.hpp"

#include <sinew/core/error.hpp>
#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <numeric>

namespace cli {

using sinew::text;

namespace {

constexpr std::string_view title = "# sinew sweep 1, key ";

Failure not_written(std::string const& path, std::string_view what) {
  return {notWritten, {text(path, ": ", what)}};
}
std::string cause() { return static_cast<char const*>(std::strerror(errno)); }

// "# sinew sweep 1, key 0123456789abcdef, 12 runs: sinew sweep ...", then the names of columns
bool read_header(std::string_view first, std::string_view second, SweepHeader& header) {
  if (!first.starts_with(title)) return false;
  first.remove_prefix(title.size());
  const std::size_t comma = first.find(", "), end = first.find(" runs: ");
  if (comma == first.npos || end == first.npos || end < comma) return false;
  header.key = first.substr(0, comma);
  header.command = first.substr(end + 7);
  auto columns = csv_fields(second);
  if (!columns || columns->size() < 2 || columns->front() != "run" || columns->back() != "error")
    return false;
  header.columns = std::move(*columns);
  return sinew::io::parse_number(first.substr(comma + 2, end - comma - 2), header.runs);
}

std::string read_all(int file, std::string const& path) {
  std::string content;
  char bytes[65536];
  for (off_t at = 0;;) {
    const ssize_t n = ::pread(file, bytes, sizeof bytes, at);
    if (n < 0) throw Failure{badScene, {text(path, ": cannot be read: ", cause())}};
    if (n == 0) return content;
    content.append(bytes, std::size_t(n));
    at += n;
  }
}

// why a table that is there is not this one
std::string difference(SweepHeader const& there, SweepHeader const& asked) {
  constexpr char const* advice = "; name another file with --output, or remove this one";
  if (there.command == asked.command)
    return text("was begun with another scene file, data or version of this program, by the same command",
                advice);
  return text("is of another sweep, '", there.command, "', and this one is '", asked.command, "'", advice);
}

}  // namespace

std::string SweepHeader::text() const {
  std::string lines = sinew::text(title, key, ", ", runs, " runs: ", command, '\n');
  for (std::size_t i = 0; i < columns.size(); ++i)
    lines += sinew::text(i > 0 ? "," : "", csv_field(columns[i]));
  return lines + '\n';
}

bool has_error(std::string_view line) { return !line.ends_with(','); }

SweepRows read_sweep(std::string const& path, std::string const& content) {
  SweepRows table;
  std::string_view rest(content);
  // the line that was not written whole
  rest = rest.substr(0, rest.rfind('\n') + 1);
  table.whole = rest.size();
  const std::string_view first = next_line(rest), second = next_line(rest);
  if (!read_header(first, second, table.header))
    throw Failure{badScene,
                  {text(path,
                        ": is no table of a sweep: it does not begin with '",
                        title,
                        "...' and the names of columns; name another file with --output")}};
  for (std::size_t number = 3; !rest.empty(); ++number) {
    const std::string_view line = next_line(rest);
    const auto fields = csv_fields(line);
    std::size_t run = 0;
    if (!fields || fields->size() != table.header.columns.size() ||
        !sinew::io::parse_number(fields->front(), run) || run < 1 || run > table.header.runs)
      throw Failure{badScene,
                    {text(path,
                          ':',
                          number,
                          ": is no run of this sweep; it begins with the number of one, 1 to ",
                          table.header.runs,
                          ", and has ",
                          table.header.columns.size(),
                          " fields. Remove the line, and it is run again")}};
    table.rows.emplace_back(run - 1, line);
  }
  return table;
}

void sort_runs(SweepRows& table) {
  auto& rows = table.rows;
  std::stable_sort(rows.begin(), rows.end(), [](auto const& a, auto const& b) {
    return a.first != b.first ? a.first < b.first : !has_error(a.second) && has_error(b.second);
  });
  rows.erase(
      std::unique(rows.begin(), rows.end(), [](auto const& a, auto const& b) { return a.first == b.first; }),
      rows.end());
}

SweepTable::SweepTable(std::string path, SweepHeader header, bool again)
    : path_(std::move(path)), header_(std::move(header)), there_(header_.runs) {
  open();
  try {
    const std::string content = read_all(file_, path_);
    // a program that was killed at once
    if (content.find('\n') == content.npos && header_.text().starts_with(content)) {
      if (!content.empty() && ::ftruncate(file_, 0) != 0) throw not_written(path_, cause());
      append(header_.text());
      return;
    }
    SweepRows table = read_sweep(path_, content);
    if (table.header.text() != header_.text()) {
      if (table.header.key == header_.key && table.header.columns == header_.columns)
        header_.command = table.header.command;  // from another folder
      else
        throw Failure{badUsage, {text(path_, ": ", difference(table.header, header_))}};
    }
    if (table.whole < content.size() && ::ftruncate(file_, off_t(table.whole)) != 0)
      throw not_written(path_, cause());
    for (auto const& [run, line] : table.rows) there_[run] = there_[run] || !again || !has_error(line);
  } catch (...) {
    close();
    throw;
  }
}

SweepTable::~SweepTable() { close(); }

void SweepTable::open() {
  for (;;) {
    struct stat info, now;
    if (::stat(path_.c_str(), &info) == 0 && !S_ISREG(info.st_mode))
      throw not_written(path_,
                        S_ISDIR(info.st_mode) ? "is a folder; name a file in it" : "is no file; name one");
    file_ = ::open(path_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0)
      throw not_written(path_, text("cannot be written: ", cause(), "; choose another file or folder"));
    // file systems without locks have none
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      close();
      throw not_written(path_,
                        "another sweep writes this table now; wait for its end, or give each part a file of "
                        "its own with --output");
    }
    // the one before may have put a sorted one in its place
    if (::fstat(file_, &info) == 0 && ::stat(path_.c_str(), &now) == 0 && info.st_ino == now.st_ino) return;
    close();
  }
}

void SweepTable::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void SweepTable::append(std::string_view bytes) {
  struct stat info;
  if (::fstat(file_, &info) != 0) throw not_written(path_, cause());
  const ssize_t n = ::write(file_, bytes.data(), bytes.size());
  if (n == ssize_t(bytes.size())) return;
  const std::string why = n < 0 ? cause() : "no space left";
  // what was written of it goes
  if (n > 0 && ::ftruncate(file_, info.st_size) != 0) close();
  throw not_written(
      path_,
      text("cannot be written further: ",
           why,
           "; the runs before are in it. Make room on the disk, and give the same command again"));
}

void SweepTable::add(std::size_t run, std::string line) {
  append(line += '\n');
  there_[run] = true;
}

void SweepTable::sort() {
  SweepRows table = read_sweep(path_, read_all(file_, path_));
  const auto before = table.rows;
  sort_runs(table);
  if (table.rows == before) return;
  std::string all = table.header.text();
  for (auto const& row : table.rows) all += text(row.second, '\n');
  try {
    sinew::io::write_file(path_, all);
  } catch (sinew::Error const& error) {
    throw Failure{notWritten, {text("the table is complete, and not in order: ", error.what())}};
  }
}

}  // namespace cli
