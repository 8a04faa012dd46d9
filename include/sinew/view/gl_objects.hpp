// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <epoxy/gl.h>

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::view {

// Owners of what OpenGL makes; the context in which they are made is current where they go, too.

template <void (*Release)(GLuint)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint id) : id_(id) {}
  GlObject(GlObject&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~GlObject() {
    if (id_) Release(id_);
  }
  operator GLuint() const { return id_; }

 private:
  GLuint id_ = 0;
};

namespace detail {
inline void release_buffer(GLuint id) { glDeleteBuffers(1, &id); }
inline void release_vertices(GLuint id) { glDeleteVertexArrays(1, &id); }
inline void release_texture(GLuint id) { glDeleteTextures(1, &id); }
inline void release_frame(GLuint id) { glDeleteFramebuffers(1, &id); }
inline void release_store(GLuint id) { glDeleteRenderbuffers(1, &id); }
inline void release_program(GLuint id) { glDeleteProgram(id); }

template <class Object, class Make>
Object made(Make make) {
  GLuint id = 0;
  make(1, &id);
  return Object(id);
}
}  // namespace detail

using GlBuffer = GlObject<detail::release_buffer>;
using GlVertices = GlObject<detail::release_vertices>;
using GlTexture = GlObject<detail::release_texture>;
using GlFrame = GlObject<detail::release_frame>;
using GlStore = GlObject<detail::release_store>;
using GlProgram = GlObject<detail::release_program>;

/// Red, green, blue and opacity of 8 bits from the upper left pixel on, row by row, as a texture that is
/// repeated, with the smaller ones of itself; its places are counted from the lower left corner.
inline GlTexture texture_of(int width, int height, std::vector<unsigned char> const& rgba) {
  GlTexture texture = detail::made<GlTexture>([](auto n, auto* id) { glGenTextures(n, id); });
  glBindTexture(GL_TEXTURE_2D, texture);
  std::vector<unsigned char> fromBelow;
  fromBelow.reserve(rgba.size());
  const auto row = std::ptrdiff_t(4) * width;
  for (std::ptrdiff_t y = height - 1; y >= 0; --y)
    fromBelow.insert(fromBelow.end(), rgba.begin() + y * row, rgba.begin() + (y + 1) * row);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, fromBelow.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

/// Lists of vectors as the attributes 0, 1, ... of vertices, kept between frames. A list goes to the graphics
/// card where it differs from the one that is there.
class GlMesh {
 public:
  explicit GlMesh(int attributes)
      : vertices_(detail::made<GlVertices>([](auto n, auto* id) { glGenVertexArrays(n, id); })) {
    glBindVertexArray(vertices_);
    for (int a = 0; a < attributes; ++a) {
      lists_.emplace_back();
      glBindBuffer(GL_ARRAY_BUFFER, lists_.back().buffer);
      glEnableVertexAttribArray(GLuint(a));
      glVertexAttribPointer(GLuint(a), 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
  }
  /// An empty list is no attribute.
  template <class... Lists>
  void set(std::vector<Eigen::Vector3f> const& first, Lists const&... more) {
    glBindVertexArray(vertices_);
    std::size_t a = 0;
    for (auto const* list : {&first, &more...}) {
      list->empty() ? glDisableVertexAttribArray(GLuint(a)) : glEnableVertexAttribArray(GLuint(a));
      lists_[a++].set(GL_ARRAY_BUFFER, *list);
    }
    count_ = GLsizei(first.size());
  }
  /// Which of them make the primitives; without that they are taken in their order. There may be several such
  /// lists, of which one is drawn.
  void setIndices(std::vector<GLuint> const& indices, std::size_t which = 0) {
    if (indices_.size() <= which) indices_.resize(which + 1);
    glBindVertexArray(vertices_);
    indices_[which].set(GL_ELEMENT_ARRAY_BUFFER, indices);
  }
  void draw(GLenum kind, std::size_t which = 0) const {
    glBindVertexArray(vertices_);
    if (indices_.empty()) {
      glDrawArrays(kind, 0, count_);
    } else if (auto const& indices = indices_[which]; !indices.values.empty()) {
      glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.buffer);
      glDrawElements(kind, GLsizei(indices.values.size()), GL_UNSIGNED_INT, nullptr);
    }
  }

 private:
  template <class Value>
  struct List {
    GlBuffer buffer = detail::made<GlBuffer>([](auto n, auto* id) { glGenBuffers(n, id); });
    std::vector<Value> values{};  // that are there

    void set(GLenum kind, std::vector<Value> const& wanted) {
      if (values == wanted) return;
      values = wanted;
      glBindBuffer(kind, buffer);
      glBufferData(kind, GLsizeiptr(values.size() * sizeof(Value)), values.data(), GL_DYNAMIC_DRAW);
    }
  };
  GlVertices vertices_{};
  std::vector<List<Eigen::Vector3f>> lists_{};
  std::vector<List<GLuint>> indices_{};
  GLsizei count_ = 0;
};

/// A program of a vertex and a fragment shader.
class GlShaders {
 public:
  GlShaders(std::string const& vertex, std::string const& fragment) : program_(glCreateProgram()) {
    const GLuint parts[] = {compiled(GL_VERTEX_SHADER, vertex), compiled(GL_FRAGMENT_SHADER, fragment)};
    for (const GLuint part : parts) glAttachShader(program_, part);
    glLinkProgram(program_);
    for (const GLuint part : parts) glDeleteShader(part);
    GLint good = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &good);
    if (!good) {
      char log[1024]{};
      glGetProgramInfoLog(program_, sizeof log, nullptr, log);
      throw Error("pictures", text("OpenGL cannot link Sinew's shaders: ", log));
    }
  }
  void use() const { glUseProgram(program_); }
  void set(char const* name, Eigen::Matrix4d const& m) const {
    const Eigen::Matrix4f value = m.cast<float>();
    glUniformMatrix4fv(at(name), 1, GL_FALSE, value.data());
  }
  void set(char const* name, Eigen::Vector2d const& v) const {
    glUniform2f(at(name), float(v[0]), float(v[1]));
  }
  void set(char const* name, Eigen::Vector3d const& v) const {
    const Eigen::Vector3f value = v.cast<float>();
    glUniform3fv(at(name), 1, value.data());
  }
  void set(char const* name, Eigen::Vector4d const& v) const {
    const Eigen::Vector4f value = v.cast<float>();
    glUniform4fv(at(name), 1, value.data());
  }
  /// A list in the shader.
  void set(char const* name, std::vector<Eigen::Vector4f> const& list) const {
    if (!list.empty()) glUniform4fv(at(name), GLsizei(list.size()), list.front().data());
  }
  void set(char const* name, double value) const { glUniform1f(at(name), float(value)); }
  void setTexture(char const* name, int unit) const { glUniform1i(at(name), unit); }

 private:
  GlProgram program_;
  mutable std::map<std::string, GLint, std::less<>> places_{};  // of uniforms that were asked for

  GLint at(char const* name) const {
    auto found = places_.find(std::string_view(name));
    if (found == places_.end()) found = places_.emplace(name, glGetUniformLocation(program_, name)).first;
    return found->second;
  }
  static GLuint compiled(GLenum kind, std::string const& words) {
    const GLuint shader = glCreateShader(kind);
    char const* source = words.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char log[1024]{};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    glDeleteShader(shader);
    throw Error("pictures", text("OpenGL cannot compile Sinew's shaders: ", log));
  }
};

}  // namespace sinew::view
