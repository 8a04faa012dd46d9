// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/fields.hpp>

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sinew {

/// Words of an attribute, apart by white space.
class Words {
 public:
  // SOFA writes matrices as [1 0 0,0 1 0,0 0 1]
  static constexpr std::string_view blanks = " \t\r\n[],";
  explicit Words(std::string_view text) : rest_(text) { skip(); }
  bool end() const { return rest_.empty(); }
  std::string_view next() {
    const std::size_t n = std::min(rest_.find_first_of(blanks), rest_.size());
    const std::string_view word = rest_.substr(0, n);
    rest_.remove_prefix(n);
    skip();
    return word;
  }
  std::string_view peek() const { return rest_.substr(0, rest_.find_first_of(blanks)); }
  std::string_view rest() const {
    std::string_view all = rest_;
    while (!all.empty() && std::string_view(" \t\r\n").find(all.back()) != all.npos) all.remove_suffix(1);
    return all;
  }

 private:
  std::string_view rest_;
  void skip() { rest_.remove_prefix(std::min(rest_.find_first_not_of(blanks), rest_.size())); }
};

namespace detail {

inline std::string shown(std::string_view word) {
  std::string clean(word.substr(0, 40));
  for (char& c : clean)
    if (c < ' ' || c > '~') c = '?';
  return text("'", clean, word.size() > 40 ? "...'" : "'");
}

template <class T>
T read_number(std::string_view word) {
  const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
  T value{};
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    // what is nearer to zero than the smallest number is zero
    if constexpr (std::is_floating_point_v<T>)
      if (digits.find_first_of("123456789") != digits.npos && digits.find("e-") != digits.npos) return T(0);
    throw Error("", text(shown(word), " is out of range; give a smaller number"));
  }
  if (error != std::errc{} || end != digits.data() + digits.size() || digits.empty())
    throw Error(
        "",
        text(shown(word), std::is_integral_v<T> ? " is no whole number" : " is no number", "; correct it"));
  return value;
}

template <class T>
concept DynamicList = requires(T list) {
  list.clear();
  list.push_back(list.front());
} && !std::is_same_v<T, std::string>;

/// A list of lists of any length, each in brackets where it is written: "[0 1] [] [2]".
template <class T>
concept ListOfLists = DynamicList<T> && DynamicList<typename T::value_type>;

template <class T>
inline constexpr bool is_eigen = std::is_base_of_v<Eigen::MatrixBase<T>, T>;

inline std::string_view need_word(Words& words, std::string_view what) {
  if (words.end()) throw Error("", text("ends where ", what, " is expected; give all values"));
  return words.next();
}

/// "3", "1-5" or "1-9-2": a whole number, or those from the first to the second in steps of the third.
inline void read_range(std::string_view word, std::vector<int>& to) {
  constexpr std::size_t maximum = std::size_t(1) << 26;
  const std::size_t dash = word.find('-', 1);
  const int first = read_number<int>(word.substr(0, dash));
  int last = first, step = 1;
  if (dash != word.npos) {
    std::string_view tail = word.substr(dash + 1);
    const std::size_t second = tail.find('-', 1);
    last = read_number<int>(tail.substr(0, second));
    if (second != tail.npos) step = read_number<int>(tail.substr(second + 1));
    if (step == 0 || (last - double(first)) * step < 0)
      throw Error("", text("the range ", shown(word), " leads nowhere; write first-last or first-last-step"));
  }
  const double count = (double(last) - first) / step + 1;
  if (double(to.size()) + count > double(maximum))
    throw Error(
        "", text("the range ", shown(word), " makes a list of more than ", maximum, " numbers; shorten it"));
  for (long i = 0, n = long(count); i < n; ++i) to.push_back(int(first + i * step));
}

template <class T>
void read_words(Words& words, T& value);

template <class Real, int Dim>
void read_rigid_mass(Words& words, RigidMass<Real, Dim>& value) {
  std::vector<Real> numbers;
  const bool bracket = words.rest().find('[') != std::string_view::npos;
  std::size_t before = 0;  // of the numbers, before that
  while (!words.end()) {
    before += words.rest().find('[') != std::string_view::npos;
    numbers.push_back(read_number<Real>(words.next()));
  }
  constexpr std::size_t n = Dim == 3 ? 9 : 1;
  value = {};
  if (!bracket && numbers.size() > 1) before = std::max(numbers.size(), n) - n;
  if (numbers.size() != 1 && (numbers.size() != n + before || before < 1 || before > 2))
    throw Error("",
                text("a rigid mass is a mass, or mass, volume and the ",
                     n,
                     " entries of the inertia divided by the mass, or mass and ",
                     n,
                     " entries of the inertia; here are ",
                     numbers.size(),
                     " numbers"));
  value.mass = numbers[0];
  const bool perMass = numbers.size() == n + 2;  // SOFA's form
  if (numbers.size() == 1)
    value.inertia *= value.mass;
  else
    for (std::size_t i = 0; i < n; ++i)
      value.inertia(Eigen::Index(i / (Dim == 3 ? 3 : 1)), Eigen::Index(i % (Dim == 3 ? 3 : 1))) =
          perMass ? numbers[i + 2] * value.mass : numbers[i + 1];
}

/// The name of an enumerator for which a scene file may have another.
template <class T>
std::string_view name_of(std::string_view word) {
  if constexpr (requires { enum_aliases(T{}); })
    for (auto const& [alias, name] : enum_aliases(T{}))
      if (alias == word) return name;
  return word;
}

template <class T>
void read_words(Words& words, T& value);

/// A struct that is written between two words, and all but its first values behind their names in capitals:
/// "BEGIN_SPRING 0 1 KD 3 END_SPRING".
template <class T>
concept HasKeywords = HasFields<T> && requires {
  T::bracket[1];
  T::unnamed;
};

/// The other names of its fields, where they have some, are the words.
template <class F>
constexpr std::string_view keyword_of(F const& fd) {
  return fd.aliases.empty() ? fd.name : fd.aliases;
}

template <class T>
void read_keywords(Words& words, T& value) {
  value = T{};
  std::string_view word = need_word(words, T::bracket[0]);
  if (word != T::bracket[0])
    throw Error("", text("begins with ", shown(word), "; write ", T::bracket[0], " ... ", T::bracket[1]));
  int number = 0;
  for_each_field(value, [&](auto const&, auto& part) {
    if (number++ < T::unnamed) read_words(words, part);
  });
  while ((word = need_word(words, T::bracket[1])) != T::bracket[1]) {
    bool found = false;
    std::string known;
    for_each_field(value, [&](auto const& fd, auto& part) {
      const std::string_view keyword = keyword_of(fd);
      if (fd.aliases.empty()) return;
      known += text(known.empty() ? "" : ", ", keyword);
      if (found || keyword != word) return;
      found = true;
      read_words(words, part);
    });
    if (!found)
      throw Error("", text(shown(word), " is not one of ", known, ", ", T::bracket[1], "; correct it"));
  }
}

template <class T>
void read_words(Words& words, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    const std::string_view word = need_word(words, "true or false");
    if (word == "1" || word == "true" || word == "True" || word == "TRUE")
      value = true;
    else if (word == "0" || word == "false" || word == "False" || word == "FALSE")
      value = false;
    else
      throw Error("", text(shown(word), " is neither true nor false; write 1 or 0"));
  } else if constexpr (std::is_enum_v<T>) {
    const std::string_view word = need_word(words, "a word");
    constexpr auto names = enum_names(T{});
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name_of<T>(word)) return void(value = T(i));
    std::string known;
    for (auto name : names) known += text(known.empty() ? "" : ", ", name);
    const std::string nearest = nearest_name(word, names);
    throw Error(
        "",
        text(shown(word),
             " is not one of ",
             known,
             nearest.empty() ? std::string("; choose one") : text("; did you mean '", nearest, "'?")));
  } else if constexpr (std::is_arithmetic_v<T>) {
    value = read_number<T>(need_word(words, "a number"));
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = std::string(words.rest());
    while (!words.end()) words.next();
  } else if constexpr (std::is_same_v<T, DataFile>) {
    read_words(words, value.path);
  } else if constexpr (requires { value.has_value(); }) {
    if (words.peek() == "auto") {
      words.next();
      value.reset();
    } else {
      value.emplace();
      read_words(words, *value);
    }
  } else if constexpr (requires { value.inertia; }) {
    read_rigid_mass(words, value);
  } else if constexpr (HasKeywords<T>) {
    read_keywords(words, value);
  } else if constexpr (HasFields<T>) {
    value = T{};
    for_each_field(value, [&](auto const&, auto& part) { read_words(words, part); });
  } else if constexpr (requires {
                         value.center;
                         value.orientation;
                       }) {
    read_words(words, value.center);
    if constexpr (requires { value.orientation.coeffs(); }) {
      auto coefficients = value.orientation.coeffs().eval();
      read_words(words, coefficients);
      value.orientation.coeffs() = coefficients;
    } else {
      read_words(words, value.orientation);
    }
  } else if constexpr (is_eigen<T>) {
    for (Eigen::Index i = 0; i < value.size(); ++i) {
      typename T::Scalar number;
      read_words(words, number);
      value(i / value.cols(), i % value.cols()) = number;
    }
  } else if constexpr (std::is_same_v<T, std::vector<DataFile>>) {
    value.clear();
    while (!words.end()) value.push_back({std::string(words.next())});
  } else if constexpr (std::is_same_v<T, std::vector<int>>) {
    value.clear();
    while (!words.end()) read_range(words.next(), value);
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    value.clear();
    while (!words.end()) {
      bool one = false;
      read_words(words, one);
      value.push_back(one);
    }
  } else if constexpr (DynamicList<T>) {
    value.clear();
    while (!words.end()) read_words(words, value.emplace_back());
  } else {
    for (auto& one : value) read_words(words, one);  // std::array
  }
}

/// The words of each list of a list of lists; those of a single one need no brackets.
inline std::vector<std::string> split_lists(std::string_view all) {
  constexpr std::string_view space = " \t\r\n,";
  std::vector<std::string> lists;
  if (all.find('[') == all.npos) {
    if (all.find_first_not_of(space) != all.npos) lists.emplace_back(all);
    return lists;
  }
  for (std::size_t at = all.find_first_not_of(space); at != all.npos; at = all.find_first_not_of(space, at)) {
    const std::size_t end = all.find(']', at);
    if (all[at] != '[' || end == all.npos)
      throw Error("", text("each list stands in brackets, as in [0 1] [2]; correct ", shown(all.substr(at))));
    lists.emplace_back(all.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return lists;
}
inline std::string join_lists(std::vector<std::string> const& lists) {
  std::string all;
  for (auto const& list : lists) all += text(all.empty() ? "[" : " [", list, ']');
  return all;
}

/// The masses of rigid bodies, of which each inertia stands in brackets: "15 15 [20 0 0,0 20 0,0 0 20] 1 1
/// [...]".
template <class T>
concept ListOfRigidMasses = DynamicList<T> && requires(T list) { list.front().inertia; };

/// The words of each, which end with a bracket; those of a single one need none.
inline std::vector<std::string_view> split_rigid_masses(std::string_view all) {
  std::vector<std::string_view> masses;
  while (!Words(all).end()) {
    const std::size_t end = std::min(all.find(']'), all.size() - 1) + 1;
    masses.push_back(all.substr(0, end));
    all.remove_prefix(end);
  }
  return masses;
}

inline void append_number(std::string& to, double value) {
  char buffer[40];
  to.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}
inline void append_number(std::string& to, float value) {
  char buffer[40];
  to.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

template <class T>
void write_words(std::string& to, T const& value) {
  auto blank = [&] {
    if (!to.empty()) to += ' ';
  };
  if constexpr (std::is_same_v<T, bool>) {
    blank();
    to += value ? '1' : '0';
  } else if constexpr (std::is_enum_v<T>) {
    blank();
    to += enum_names(T{})[std::size_t(value)];
  } else if constexpr (std::is_floating_point_v<T>) {
    blank();
    append_number(to, value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    blank();
    to += std::to_string(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    blank();
    to += value;
  } else if constexpr (std::is_same_v<T, DataFile>) {
    write_words(to, value.path);
  } else if constexpr (requires { value.has_value(); }) {
    if (value)
      write_words(to, *value);
    else
      write_words(to, std::string("auto"));
  } else if constexpr (requires { value.inertia; }) {
    write_words(to, value.mass);
    write_words(to, value.inertia);
  } else if constexpr (HasKeywords<T>) {
    blank();
    to += T::bracket[0];
    int number = 0;
    const T standard{};
    for_each_field(value, [&](auto const& fd, auto const& part) {
      if (number++ >= T::unnamed) {
        if (part == standard.*fd.member) return;
        to += ' ';
        to += keyword_of(fd);
      }
      write_words(to, part);
    });
    blank();
    to += T::bracket[1];
  } else if constexpr (HasFields<T>) {
    for_each_field(value, [&](auto const&, auto const& part) { write_words(to, part); });
  } else if constexpr (requires {
                         value.center;
                         value.orientation;
                       }) {
    write_words(to, value.center);
    if constexpr (requires { value.orientation.coeffs(); })
      write_words(to, value.orientation.coeffs().eval());
    else
      write_words(to, value.orientation);
  } else if constexpr (is_eigen<T>) {
    for (Eigen::Index i = 0; i < value.size(); ++i)
      write_words(to, typename T::Scalar(value(i / value.cols(), i % value.cols())));
  } else if constexpr (std::is_same_v<T, std::vector<bool>>) {
    for (const bool one : value) write_words(to, one);
  } else {
    for (auto const& one : value) write_words(to, one);
  }
}

}  // namespace detail

/// Reads a field's value from the words of an attribute; lists of whole numbers may have ranges. Throws Error
/// that says what is wrong with which word, and leaves value as it was.
template <class T>
void read_value(std::string_view text_, T& value) {
  if constexpr (detail::ListOfLists<T>) {
    T lists{};
    for (auto const& list : detail::split_lists(text_)) read_value(list, lists.emplace_back());
    return void(value = std::move(lists));
  } else if constexpr (detail::ListOfRigidMasses<T>) {
    T masses{};
    for (auto const& mass : detail::split_rigid_masses(text_)) read_value(mass, masses.emplace_back());
    return void(value = std::move(masses));
  }
  Words words(text_);
  T read{};
  if constexpr (detail::is_eigen<T>) {
    // a single 0 is zero in all coordinates
    Words again(text_);
    if (!again.end() && again.next() == "0" && again.end()) {
      value.setZero();
      return;
    }
  }
  if constexpr (requires { value.has_value(); }) read = value;
  detail::read_words(words, read);
  if (!words.end())
    throw Error(
        "",
        text("goes on with ", detail::shown(words.next()), " where it should end; remove what is too much"));
  value = std::move(read);
}

/// The words from which read_value makes the same bits again.
template <class T>
std::string write_value(T const& value) {
  std::string words;
  if constexpr (detail::ListOfLists<T>)
    for (auto const& list : value) words += text(words.empty() ? "[" : " [", write_value(list), ']');
  else if constexpr (detail::ListOfRigidMasses<T>)
    for (auto const& of : value)
      words += text(words.empty() ? "" : " ", write_value(of.mass), " [", write_value(of.inertia), ']');
  else
    detail::write_words(words, value);
  return words;
}

}  // namespace sinew
