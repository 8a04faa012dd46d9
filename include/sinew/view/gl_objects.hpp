// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <epoxy/gl.h>

#include <Eigen/Core>
#include <string>
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

/// Lists of vectors as the attributes 0, 1, ... of vertices, kept between frames.
class GlMesh {
 public:
  explicit GlMesh(int attributes)
      : vertices_(detail::made<GlVertices>([](auto n, auto* id) { glGenVertexArrays(n, id); })) {
    glBindVertexArray(vertices_);
    for (int a = 0; a < attributes; ++a) {
      buffers_.push_back(detail::made<GlBuffer>([](auto n, auto* id) { glGenBuffers(n, id); }));
      glBindBuffer(GL_ARRAY_BUFFER, buffers_.back());
      glEnableVertexAttribArray(GLuint(a));
      glVertexAttribPointer(GLuint(a), 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }
  }
  template <class... Lists>
  void set(std::vector<Eigen::Vector3f> const& first, Lists const&... more) {
    std::size_t a = 0;
    for (auto const* list : {&first, &more...}) {
      glBindBuffer(GL_ARRAY_BUFFER, buffers_[a++]);
      glBufferData(
          GL_ARRAY_BUFFER, GLsizeiptr(list->size() * sizeof(Eigen::Vector3f)), list->data(), GL_STREAM_DRAW);
    }
    count_ = GLsizei(first.size());
  }
  /// Which of them make the primitives; without that they are taken in their order.
  void setIndices(std::vector<GLuint> const& indices) {
    if (!indices_) indices_ = detail::made<GlBuffer>([](auto n, auto* id) { glGenBuffers(n, id); });
    glBindVertexArray(vertices_);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
    glBufferData(
        GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(GLuint)), indices.data(), GL_STREAM_DRAW);
    count_ = GLsizei(indices.size());
  }
  void draw(GLenum kind) const {
    if (count_ == 0) return;
    glBindVertexArray(vertices_);
    if (indices_)
      glDrawElements(kind, count_, GL_UNSIGNED_INT, nullptr);
    else
      glDrawArrays(kind, 0, count_);
  }

 private:
  GlVertices vertices_{};
  std::vector<GlBuffer> buffers_{};
  GlBuffer indices_{};
  GLsizei count_ = 0;
};

/// A program of a vertex and a fragment shader.
class GlShaders {
 public:
  GlShaders(char const* vertex, char const* fragment) : program_(glCreateProgram()) {
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
  void set(char const* name, Eigen::Vector3d const& v) const {
    const Eigen::Vector3f value = v.cast<float>();
    glUniform3fv(at(name), 1, value.data());
  }
  void set(char const* name, Eigen::Vector4d const& v) const {
    const Eigen::Vector4f value = v.cast<float>();
    glUniform4fv(at(name), 1, value.data());
  }
  void set(char const* name, double value) const { glUniform1f(at(name), float(value)); }
  void setTexture(char const* name, int unit) const { glUniform1i(at(name), unit); }

 private:
  GlProgram program_;

  GLint at(char const* name) const { return glGetUniformLocation(program_, name); }
  static GLuint compiled(GLenum kind, char const* source) {
    const GLuint shader = glCreateShader(kind);
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
