// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/io/output_file.hpp>
#include <sinew/view/seen_scene.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

/// What is seen of a simulation over time as one file that 3D viewers, browsers and Blender open: glTF 2.0 in
/// its binary form (.glb). Of each body the points of the first time are a mesh, those of later times are
/// morph targets, and an animation goes from one to the next. A body whose elements change is another one
/// from then on.
class GltfFile {
 public:
  explicit GltfFile(std::string path) : path_(std::move(path)) {}
  std::string const& path() const { return path_; }

  /// Throws Error where a point is not finite.
  void add(SeenScene const& scene) {
    if (times_.empty()) up_ = scene.up.normalized(), start_ = scene.time;
    if (!times_.empty() && !(scene.time - start_ > times_.back()))
      throw Error(path_,
                  text("a time of ", scene.time, " s does not come after the one before; give rising times"));
    times_.push_back(scene.time - start_);
    for (SeenBody const& body : scene.bodies)
      if (body.visible && !body.points.empty()) add(body);
  }

  /// Writes the file, whole or not at all. Throws Error where it cannot, or would be larger than 4 GiB.
  void finish() {
    bytes_.clear();
    views_.clear();
    accessors_.clear();
    const std::string scene = json();
    std::string file;
    auto number = [&](std::uint64_t value) {
      for (int k = 0; k < 4; ++k) file += char((value >> (8 * k)) & 0xff);
    };
    const std::size_t pad = (4 - scene.size() % 4) % 4, padBytes = (4 - bytes_.size() % 4) % 4;
    const std::uint64_t size = 12 + 8 + scene.size() + pad + 8 + bytes_.size() + padBytes;
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Error(
          path_, text("it would have ", size, " bytes, and glTF ends at 4 GiB; take fewer frames (--every)"));
    file.reserve(std::size_t(size));
    file += "glTF";
    number(2);
    number(size);
    number(scene.size() + pad);
    file += "JSON";
    file += scene;
    file.append(pad, ' ');
    number(bytes_.size() + padBytes);
    file += std::string_view("BIN\0", 4);
    file += bytes_;
    file.append(padBytes, '\0');
    io::write_file(path_, file);
  }

 private:
  // a body while its elements are the same: from one frame on, one vector of numbers a frame
  struct Shape {
    SeenBody first;
    std::size_t begin;
    std::vector<std::vector<float>> frames{};
  };
  enum Kind { surface = 4, lines = 1, dots = 0 };  // glTF's modes

  std::string path_;
  Eigen::Vector3d up_{0, 1, 0};
  double start_ = 0;
  std::vector<double> times_{};
  std::vector<Shape> shapes_{};
  std::vector<std::shared_ptr<SeenTexture const>> textures_{};
  std::string bytes_{}, views_{}, accessors_{};
  int viewCount_ = 0, accessorCount_ = 0;

  void add(SeenBody const& body) {
    std::vector<float> numbers;
    for (Eigen::Vector3d const& p : body.points) {
      if (!p.cast<float>().allFinite())
        throw Error(path_, text(body.path, " has a point that is not finite"));
      for (int c = 0; c < 3; ++c) numbers.push_back(float(p[c]));
    }
    const std::size_t now = times_.size() - 1;
    for (Shape& shape : shapes_)
      if (shape.begin + shape.frames.size() == now && shape.first.path == body.path &&
          shape.first.kind == body.kind && shape.first.points.size() == body.points.size() &&
          shape.first.triangles == body.triangles && shape.first.quads == body.quads &&
          shape.first.edges == body.edges && shape.first.inTexture == body.inTexture &&
          shape.first.texture == body.texture) {
        shape.frames.push_back(std::move(numbers));
        return;
      }
    shapes_.push_back({.first = body, .begin = now});
    shapes_.back().frames.push_back(std::move(numbers));
  }

  static void list(std::string& all, std::string_view one) {
    if (!all.empty()) all += ',';
    all += one;
  }
  static std::string quoted(std::string_view words) {
    std::string out = "\"";
    for (const char c : words) {
      if (c == '"' || c == '\\') out += '\\';
      if (static_cast<unsigned char>(c) >= 0x20) out += c;
    }
    return out + '"';
  }
  static std::string numbers(auto const& values) {
    std::string out;
    for (auto const& value : values) {
      if (!out.empty()) out += ',';
      io::append_number(out, value);
    }
    return out;
  }
  int appendBytes(char const* bytes, std::size_t size) {
    list(views_, text("{\"buffer\":0,\"byteOffset\":", bytes_.size(), ",\"byteLength\":", size, '}'));
    bytes_.append(bytes, size);
    bytes_.append((4 - size % 4) % 4, '\0');
    return viewCount_++;
  }
  // Appends numbers as they are in memory, little endian, as glTF wants them.
  template <class T>
  int append(std::vector<T> const& values, int componentType, std::string_view type, int components,
             bool ends) {
    static_assert(std::endian::native == std::endian::little && sizeof(T) == 4);
    std::string accessor =
        text("{\"bufferView\":",
             appendBytes(reinterpret_cast<char const*>(values.data()), values.size() * sizeof(T)),
             ",\"componentType\":",
             componentType,
             ",\"count\":",
             values.size() / std::size_t(components),
             ",\"type\":\"",
             type,
             '"');
    if (ends) {
      std::vector<T> low(std::size_t(components), std::numeric_limits<T>::max()),
          high(std::size_t(components), std::numeric_limits<T>::lowest());
      for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t c = i % std::size_t(components);
        low[c] = std::min(low[c], values[i]);
        high[c] = std::max(high[c], values[i]);
      }
      accessor += text(",\"min\":[", numbers(low), "],\"max\":[", numbers(high), ']');
    }
    list(accessors_, accessor + '}');
    return accessorCount_++;
  }
  static constexpr int asFloat = 5126, asIndex = 5125;

  std::string json() {
    viewCount_ = accessorCount_ = 0;
    textures_.clear();
    std::string nodes, meshes, materials, samplers, channels, children;
    int node = 1, mesh = 0, sampler = 0;
    const std::vector<float> seconds(times_.begin(), times_.end());
    const int atTimes =
        times_.size() > 1 && !shapes_.empty() ? append(seconds, asFloat, "SCALAR", 1, true) : -1;
    auto animate = [&](int target, std::string_view what, int values, std::string_view how) {
      list(samplers,
           text("{\"input\":", atTimes, ",\"output\":", values, ",\"interpolation\":\"", how, "\"}"));
      list(channels,
           text("{\"sampler\":", sampler++, ",\"target\":{\"node\":", target, ",\"path\":\"", what, "\"}}"));
    };
    for (Shape const& shape : shapes_) {
      const std::size_t targets = shape.frames.size() - 1;
      list(materials, materialOf(shape.first, mesh));
      list(meshes, meshOf(shape, mesh));
      list(nodes, text("{\"mesh\":", mesh, ",\"name\":", quoted(shape.first.path), '}'));
      list(children, text(node));
      if (atTimes >= 0 && targets > 0) {
        // at each time the weight of its own target alone; before and behind, those of the ends
        std::vector<float> weights(times_.size() * targets, 0.f);
        for (std::size_t t = 0; t < times_.size(); ++t) {
          const std::size_t frame = std::min(t < shape.begin ? 0 : t - shape.begin, targets);
          if (frame > 0) weights[t * targets + frame - 1] = 1;
        }
        animate(node, "weights", append(weights, asFloat, "SCALAR", 1, false), "LINEAR");
      }
      if (atTimes >= 0 && (shape.begin > 0 || shape.begin + shape.frames.size() < times_.size())) {
        std::vector<float> scales;  // what is not there has no size
        for (std::size_t t = 0; t < times_.size(); ++t)
          scales.insert(
              scales.end(), 3, t >= shape.begin && t < shape.begin + shape.frames.size() ? 1.f : 0.f);
        animate(node, "scale", append(scales, asFloat, "VEC3", 3, false), "STEP");
      }
      ++node, ++mesh;
    }
    std::string images, textures;
    for (std::size_t i = 0; i < textures_.size(); ++i) {
      std::string const& file = textures_[i]->file;
      list(images,
           text("{\"mimeType\":\"",
                file.starts_with("\x89PNG") ? "image/png" : "image/jpeg",
                "\",\"bufferView\":",
                appendBytes(file.data(), file.size()),
                '}'));
      list(textures, text("{\"source\":", i, '}'));
    }
    // y is up in glTF
    const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(up_, Eigen::Vector3d::UnitY());
    std::string root = text("{\"name\":\"scene\",\"rotation\":[", numbers(turn.coeffs()), ']');
    root += children.empty() ? std::string("}") : text(",\"children\":[", children, "]}");
    std::string all =
        "{\"asset\":{\"version\":\"2.0\",\"generator\":\"Sinew\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[" +
        root;
    if (!nodes.empty()) all += ',' + nodes;
    all += ']';
    auto some = [&](std::string_view name, std::string const& entries) {
      if (!entries.empty()) all += text(",\"", name, "\":[", entries, ']');
    };
    some("meshes", meshes);
    some("materials", materials);
    some("textures", textures);
    some("images", images);
    some("accessors", accessors_);
    some("bufferViews", views_);
    if (!bytes_.empty()) all += text(",\"buffers\":[{\"byteLength\":", bytes_.size(), "}]");
    if (!channels.empty())
      all += text(",\"animations\":[{\"name\":\"simulation\",\"samplers\":[",
                  samplers,
                  "],\"channels\":[",
                  channels,
                  "]}]");
    return all + '}';
  }

  // The corners of a body where their places in a texture are theirs alone: points, places, and which of them
  // the elements have.
  struct Corners {
    std::vector<std::size_t> points{};
    std::vector<float> texcoords{};
    std::vector<std::uint32_t> indices{};
    Kind kind = surface;

    explicit Corners(SeenBody const& body) {
      SurfaceLooks const& in = body.inTexture;
      const bool textured = hasTexture(body);
      std::map<std::pair<Index, Index>, std::uint32_t> known;
      auto add = [&](auto const& faces, auto const& places, auto const&... order) {
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (const std::size_t k : {order...}) {
            const Index point = faces[f][k], place = textured ? places[f][k] : -1;
            if (!textured) {
              indices.push_back(std::uint32_t(point));
              continue;
            }
            const auto [found, isNew] = known.emplace(std::pair(point, place), points.size());
            indices.push_back(found->second);
            if (!isNew) continue;
            points.push_back(std::size_t(point));
            // from the upper left corner
            const Eigen::Vector2d at = place < 0 ? Eigen::Vector2d(0, 0) : in.texcoords[std::size_t(place)];
            texcoords.insert(texcoords.end(), {float(at[0]), float(1 - at[1])});
          }
      };
      constexpr std::size_t a = 0, b = 1, c = 2, d = 3;
      add(body.triangles, in.triangles, a, b, c);
      add(body.quads, in.quads, a, b, c, a, c, d);
      if (textured) return;
      for (std::size_t i = 0; i < body.points.size(); ++i) points.push_back(i);
      if (!indices.empty()) return;
      kind = body.edges.empty() ? dots : lines;
      for (Edge const& e : body.edges)
        for (const Index i : e) indices.push_back(std::uint32_t(i));
    }
    std::vector<float> of(std::vector<float> const& numbers) const {
      std::vector<float> all;
      all.reserve(3 * points.size());
      for (const std::size_t i : points)
        for (std::size_t c = 0; c < 3; ++c) all.push_back(numbers[3 * i + c]);
      return all;
    }
  };
  static bool hasTexture(SeenBody const& body) {
    return body.texture && body.inTexture.triangles.size() == body.triangles.size() &&
           body.inTexture.quads.size() == body.quads.size();
  }

  std::string materialOf(SeenBody const& body, int number) {
    std::vector<double> linear;  // glTF's colours are linear in light
    for (int c = 0; c < 3; ++c) linear.push_back(std::pow(std::clamp(body.colour[c], 0., 1.), 2.2));
    linear.push_back(std::clamp(body.opacity, 0., 1.));
    std::string texture;
    if (hasTexture(body)) {
      const auto found = std::find(textures_.begin(), textures_.end(), body.texture);
      texture = text(",\"baseColorTexture\":{\"index\":", found - textures_.begin(), '}');
      if (found == textures_.end()) textures_.push_back(body.texture);
    }
    // as rough as an exponent of Blinn's model says (Karis 2013): r = (2 / (n + 2))^(1/4)
    const double roughness = body.ofMaterial ? std::pow(2 / (std::max(body.shininess, 0.) + 2), 0.25) : 0.6;
    return text("{\"name\":\"colour ",
                number,
                "\",\"doubleSided\":true,\"pbrMetallicRoughness\":{\"baseColorFactor\":[",
                numbers(linear),
                ']',
                texture,
                ",\"metallicFactor\":0,\"roughnessFactor\":",
                numbers(std::array{roughness}),
                '}',
                body.opacity < 1 ? ",\"alphaMode\":\"BLEND\"}" : "}");
  }
  std::string meshOf(Shape const& shape, int material) {
    const Corners corners(shape.first);
    const std::vector<float> first = corners.of(shape.frames[0]);
    std::string primitive = text("{\"attributes\":{\"POSITION\":", append(first, asFloat, "VEC3", 3, true));
    if (!corners.texcoords.empty())
      primitive += text(",\"TEXCOORD_0\":", append(corners.texcoords, asFloat, "VEC2", 2, false));
    primitive += '}';
    if (!corners.indices.empty())
      primitive += text(",\"indices\":", append(corners.indices, asIndex, "SCALAR", 1, false));
    primitive += text(",\"mode\":", int(corners.kind), ",\"material\":", material);
    std::string targets, weights;
    for (std::size_t k = 1; k < shape.frames.size(); ++k) {
      std::vector<float> moved = corners.of(shape.frames[k]);
      for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= first[i];
      list(targets, text("{\"POSITION\":", append(moved, asFloat, "VEC3", 3, true), '}'));
      list(weights, "0");
    }
    if (!targets.empty()) primitive += text(",\"targets\":[", targets, ']');
    std::string mesh = text("{\"primitives\":[", primitive, "}]");
    if (!weights.empty()) mesh += text(",\"weights\":[", weights, ']');
    return mesh + '}';
  }
};

}  // namespace sinew::view
