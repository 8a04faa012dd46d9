// SPDX-License-Identifier: BSL-1.0
#include "combinations.hpp"

#include "csv.hpp"

#include <sinew/core/error.hpp>
#include <sinew/io/output_file.hpp>
#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>

namespace cli {

using sinew::text;

namespace {

constexpr char const* forms =
    "write first:last:step, lin:first:last:count, log:first:last:count, or values apart by commas";

[[noreturn]] void refuse(std::string_view item, std::string_view why) {
  throw sinew::Error("", text('\'', item, "' ", why));
}

std::string_view trimmed(std::string_view word) {
  const std::size_t begin = std::min(word.find_first_not_of(" \t"), word.size());
  word.remove_prefix(begin);
  return word.substr(0, word.find_last_not_of(" \t") + 1);
}

std::vector<std::string_view> parts_of(std::string_view words, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = std::min(words.find(separator), words.size());
    parts.push_back(trimmed(words.substr(0, end)));
    if (end == words.size()) return parts;
    words.remove_prefix(end + 1);
  }
}

/// digits * 10^exponent, a number as it is written.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;

  /// The same with another exponent, not above its own; nothing where that has no room.
  std::optional<std::int64_t> at(int other) const {
    std::int64_t value = digits;
    for (int e = exponent; e > other && value != 0; --e) {
      if (std::abs(value) > room / 10) return {};
      value *= 10;
    }
    return value;
  }
  // differences of two have room as well
  static constexpr std::int64_t room = std::numeric_limits<std::int64_t>::max() / 4;
};

// a number that is finite, in a sequence of them
double number(std::string_view item, std::string_view word) {
  double value = 0;
  if (!sinew::io::parse_number(word, value))
    refuse(item, text("has '", word, "', which is no number; ", forms));
  if (!std::isfinite(value)) refuse(item, text("has '", word, "', which is not finite; ", forms));
  return value;
}

Decimal decimal(std::string_view item, std::string_view word) {
  number(item, word);
  Decimal d;
  bool behindPoint = false;
  const bool negative = word.starts_with('-');
  for (std::size_t i = word.find_first_of("0123456789."); i < word.size(); ++i) {
    const char c = word[i];
    if (c == '.') {
      behindPoint = true;
    } else if (c == 'e' || c == 'E') {
      int exponent = 0;
      sinew::io::parse_number(word.substr(i + 1), exponent);
      d.exponent += exponent;
      break;
    } else {
      if (d.digits > (Decimal::room - 9) / 10)
        refuse(item, text("has '", word, "', which has too many digits; 18 are enough"));
      d.digits = 10 * d.digits + (c - '0');
      d.exponent -= behindPoint;
    }
  }
  if (negative) d.digits = -d.digits;
  // trailing zeros make exponents differ without need
  for (; d.digits != 0 && d.digits % 10 == 0; ++d.exponent) d.digits /= 10;
  if (d.digits == 0) d.exponent = 0;
  return d;
}

std::string in_words(double value) {
  std::string words;
  sinew::io::append_number(words, value);
  return words;
}

void limit(std::string_view item, double count) {
  if (!(count <= double(Combinations::most)))
    refuse(item,
           text("has ", count, " values, and a sweep may have ", Combinations::most, " runs; take fewer"));
}

void add_steps(std::string_view item, std::vector<std::string_view> const& parts,
               std::vector<std::string>& to) {
  const Decimal first = decimal(item, parts[0]), last = decimal(item, parts[1]),
                step = parts.size() > 2 ? decimal(item, parts[2]) : Decimal{1, 0};
  if (step.digits == 0) refuse(item, "has a step of 0; give another one, as in 1:10:2");
  int exponent = std::numeric_limits<int>::max();
  for (Decimal const& d : {first, last, step})
    if (d.digits != 0) exponent = std::min(exponent, d.exponent);
  const auto a = first.at(exponent), b = last.at(exponent), s = step.at(exponent);
  if (!a || !b || !s)
    refuse(item, "has numbers of too different sizes; write lin:first:last:count or log:first:last:count");
  if (*a != *b && (*b > *a) != (*s > 0))
    refuse(item,
           text("has no value: steps of ",
                parts.size() > 2 ? parts[2] : "1",
                " do not lead from ",
                parts[0],
                " to ",
                parts[1],
                "; it is first:last:step, as in 1:10:2"));
  const std::int64_t count = (*b - *a) / *s + 1;
  limit(item, double(count));
  for (std::int64_t i = 0; i < count; ++i) {
    // the double that is nearest to the decimal number
    double value = 0;
    sinew::io::parse_number(text(*a + i * *s, 'e', exponent), value);
    to.push_back(in_words(value));
  }
}

void add_counted(std::string_view item, std::vector<std::string_view> const& parts,
                 std::vector<std::string>& to) {
  const bool logarithmic = parts[0] == "log";
  if (parts.size() != 4) refuse(item, text("is not of the form ", parts[0], ":first:last:count"));
  const double first = number(item, parts[1]), last = number(item, parts[2]);
  std::int64_t count = 0;
  if (!sinew::io::parse_number(parts[3], count) || count < 2)
    refuse(item, text("has '", parts[3], "' for the number of values; give a whole number from 2 on"));
  limit(item, double(count));
  if (logarithmic && !((first > 0 && last > 0) || (first < 0 && last < 0)))
    refuse(item, "has ends that are not both above 0, or both below; only their ratio can be divided");
  const auto n = double(count - 1);
  for (std::int64_t i = 0; i < count; ++i) {
    const double t = double(i) / n;
    double value = i == 0 ? first : last;
    if (i > 0 && i < count - 1) {
      value = logarithmic
                  ? std::copysign(
                        std::exp(std::log(std::abs(first)) * (1 - t) + std::log(std::abs(last)) * t), first)
                  : first * (1 - t) + last * t;
      // what is left of rounding is no part of the value, and another machine may have another rest
      char digits[40];
      std::snprintf(digits, sizeof digits, "%.12g", value);
      sinew::io::parse_number(digits, value);
    }
    to.push_back(in_words(value));
  }
}

void add_item(std::string_view item, std::vector<std::string>& to) {
  if (item.empty()) throw sinew::Error("", text("a value is missing; ", forms));
  const auto parts = parts_of(item, ':');
  double value = 0;
  if (parts.size() > 1 && (parts[0] == "log" || parts[0] == "lin")) return add_counted(item, parts, to);
  if (parts.size() > 1 && sinew::io::parse_number(parts[0], value)) {
    if (parts.size() > 3) refuse(item, text("is no range; ", forms));
    return add_steps(item, parts, to);
  }
  if (parts.size() == 1 && sinew::io::parse_number(item, value) && !std::isfinite(value))
    refuse(item, "is not a finite number; give others");
  to.emplace_back(item);
}

SweepAxis read_table(std::string const& path) {
  std::string content;
  try {
    content = sinew::io::read_file(path);
  } catch (sinew::Error const& error) {
    throw Failure{badUsage, {text("--table: ", error.what())}};
  }
  SweepAxis axis;
  std::string_view rest = content;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::string_view line = next_line(rest);
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    auto wrong = [&](std::string const& what) {
      return Failure{badUsage, {text("--table: ", path, ':', number, ": ", what)}};
    };
    auto fields = csv_fields(line);
    if (!fields) throw wrong("a quote is not closed, or something stands behind it; correct the line");
    for (std::string& f : *fields) f = trimmed(f);
    if (axis.paths.empty()) {
      for (std::string const& f : *fields)
        if (f.find('.') == f.npos)
          throw wrong(text("'",
                           f,
                           "' is no attribute; the first line names one for each column, as "
                           "liver/fem.youngModulus"));
      axis.paths = std::move(*fields);
      continue;
    }
    if (fields->size() != axis.paths.size())
      throw wrong(
          text("has ", fields->size(), " values for ", axis.paths.size(), " columns; correct the line"));
    for (std::size_t i = 0; i < fields->size(); ++i) {
      double value = 0;
      if ((*fields)[i].empty()) throw wrong(text("has no value of ", axis.paths[i], "; give one"));
      if (sinew::io::parse_number((*fields)[i], value) && !std::isfinite(value))
        throw wrong(text("'", (*fields)[i], "' is not a finite number; give another one"));
    }
    if (axis.rows.size() == Combinations::most)
      throw wrong(text("is one line too many; a sweep may have ", Combinations::most, " runs"));
    axis.rows.push_back(std::move(*fields));
  }
  if (axis.rows.empty())
    throw Failure{
        badUsage,
        {text("--table: ", path, " has no combination; write a line of attributes, and lines of values")}};
  return axis;
}

}  // namespace

std::vector<std::string> sweep_values(std::string_view words) {
  std::vector<std::string> values;
  for (const std::string_view item : parts_of(words, ',')) {
    add_item(item, values);
    limit(words, double(values.size()));
  }
  return values;
}

Combinations::Combinations(Settings const& set, std::string const& table) {
  if (!table.empty()) axes_.push_back(read_table(table));
  for (auto const& [path, words] : set) {
    SweepAxis& axis = axes_.emplace_back(SweepAxis{{path}, {}});
    try {
      for (std::string& value : sweep_values(words)) axis.rows.push_back({std::move(value)});
    } catch (sinew::Error const& error) {
      throw Failure{badUsage, {text("--set ", path, ": ", error.what())}};
    }
  }
  double product = 1;
  for (SweepAxis const& axis : axes_) {
    for (std::string const& path : axis.paths) {
      if (std::find(paths_.begin(), paths_.end(), path) != paths_.end())
        throw Failure{badUsage,
                      {text(path, " is given twice; name all its values at once, apart by commas")}};
      paths_.push_back(path);
    }
    product *= double(axis.rows.size());
  }
  if (!(product <= double(most)))
    throw Failure{badUsage,
                  {text("these are ",
                        product,
                        " combinations, and a sweep may have ",
                        most,
                        "; take fewer values, or a --table of combinations")}};
  size_ = std::size_t(product);
}

std::vector<std::string> Combinations::values(std::size_t run) const {
  std::vector<std::size_t> rows(axes_.size());
  for (std::size_t a = axes_.size(); a-- > 0; run /= axes_[a].rows.size())
    rows[a] = run % axes_[a].rows.size();
  std::vector<std::string> values;
  for (std::size_t a = 0; a < axes_.size(); ++a)
    values.insert(values.end(), axes_[a].rows[rows[a]].begin(), axes_[a].rows[rows[a]].end());
  return values;
}

std::string Combinations::words() const {
  std::string all;
  for (SweepAxis const& axis : axes_) {
    for (std::string const& path : axis.paths) all += text(csv_field(path), ',');
    for (auto const& row : axis.rows) {
      all += '\n';
      for (std::string const& value : row) all += text(csv_field(value), ',');
    }
    all += "\n\n";
  }
  return all;
}

}  // namespace cli
