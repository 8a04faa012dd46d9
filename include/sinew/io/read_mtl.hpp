// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/compiled.hpp>

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::io {

/// What a file MTL says of one material.
struct Material {
  std::string name{};
  Eigen::Vector3d diffuse{0.8, 0.8, 0.8};  // Kd: red, green, blue from 0 to 1
  Eigen::Vector3d specular{0, 0, 0};       // Ks
  double shininess = 0;                    // Ns: the exponent of Phong's model
  double opacity = 1;                      // d, or 1 - Tr
  std::string texture{};                   // map_Kd: the file of an image, beside that of the material

  bool operator==(Material const&) const = default;
};

/// The materials in `content`, the text of a file MTL; `path` is for messages. See read_mtl().
std::vector<Material> parse_mtl(std::string_view path, std::string_view content);

/// Reads the materials (newmtl) of a file of Wavefront's material library (.mtl): Kd, Ks, Ns, d or Tr, and
/// map_Kd. All else is ignored. Throws Error with the line on numbers that are none or out of range, and on
/// what belongs to no material.
std::vector<Material> read_mtl(std::string const& path);

}  // namespace sinew::io

#if SINEW_DEFINES
#include <sinew/io/text_reader.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sinew::io::detail {

/// The material library as Alias and Wavefront's "MTL material format" (1995) describes it.
class MtlParser {
 public:
  MtlParser(std::string_view path, std::string_view content) : in_(path, content), path_(path) {}

  std::vector<Material> parse() {
    in_.rejectBinary();
    for (; !in_.atEnd(); in_.restOfLine()) {
      const std::string_view key = word();
      if (key == "newmtl") {
        const std::string_view name = word();
        if (name.empty()) throw in_.expected("the name of a material");
        all_.push_back({.name = std::string(name)});
      } else if (key == "Kd") {
        colour(&Material::diffuse);
      } else if (key == "Ks") {
        colour(&Material::specular);
      } else if (key == "Ns") {
        of().shininess = std::max(0., number("an exponent"));
      } else if (key == "d") {
        of().opacity = opacity();
      } else if (key == "Tr") {
        of().opacity = 1 - opacity();
      } else if (key == "map_Kd") {
        of().texture = image();
      }
    }
    return std::move(all_);
  }

 private:
  std::string_view word() {
    const std::string_view w = in_.wordOnLine();
    return w.starts_with('#') ? std::string_view{} : w;
  }
  Material& of() {
    if (all_.empty()) throw in_.error("this belongs to no material; write \"newmtl NAME\" above it");
    return all_.back();
  }
  double number(char const* what) {
    const std::string_view w = word();
    double value = 0;
    if (w.empty() || !parse_number(w, value)) throw in_.expected(what);
    if (!std::isfinite(value))
      throw in_.error(text("the number ", in_quotes(w), " is not finite; correct it"));
    return value;
  }
  // by one number where all three are the same; spectra and CIE colours are left out
  void colour(Eigen::Vector3d Material::*member) {
    Eigen::Vector3d& to = of().*member;
    Eigen::Vector3d read;
    for (int k = 0; k < 3; ++k) {
      const std::string_view w = word();
      if (k == 0 && (w == "spectral" || w == "xyz")) return;
      if (w.empty() && k == 1) {
        read[1] = read[2] = read[0];
        break;
      }
      if (w.empty() || !parse_number(w, read[k])) throw in_.expected("red, green and blue from 0 to 1");
      if (!std::isfinite(read[k]))
        throw in_.error(text("the number ", in_quotes(w), " is not finite; correct it"));
    }
    to = read.cwiseMax(0.).cwiseMin(1.);
  }
  double opacity() {
    const double value = number("an opacity from 0 to 1");
    if (value < 0 || value > 1) throw in_.error(text("an opacity is ", value, ", but is from 0 to 1"));
    return value;
  }
  // the words behind options ("-s 1 1 1", "-clamp on"): a name may have blanks
  std::string image() {
    std::string name;
    bool ofOption = false;
    for (std::string_view w = word(); !w.empty(); w = word()) {
      double value = 0;
      if (name.empty() && w.size() > 1 && w[0] == '-') {
        ofOption = true;
      } else if (!ofOption || !(parse_number(w, value) || w == "on" || w == "off" || w.size() == 1)) {
        ofOption = false;
        name += text(name.empty() ? "" : " ", w);
      }
    }
    if (name.empty()) throw in_.error("map_Kd names no image; write its file behind it");
    std::replace(name.begin(), name.end(), '\\', '/');
    const std::size_t folder = name.starts_with('/') ? 0 : path_.rfind('/') + 1;  // npos + 1 is 0
    return std::string(path_.substr(0, folder)) + name;
  }

  TextReader in_;
  std::string_view path_;
  std::vector<Material> all_{};
};

}  // namespace sinew::io::detail

namespace sinew::io {

SINEW_ONCE std::vector<Material> parse_mtl(std::string_view path, std::string_view content) {
  return detail::MtlParser(path, content).parse();
}
SINEW_ONCE std::vector<Material> read_mtl(std::string const& path) {
  return parse_mtl(path, read_file(path));
}

}  // namespace sinew::io
#endif
