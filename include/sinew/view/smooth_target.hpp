// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/view/gl_objects.hpp>

#include <algorithm>
#include <cstring>

namespace sinew::view {

/// Whether Mesa's software takes the place of a graphics card in the context that is current.
inline bool drawn_by_software() {
  auto const* renderer = reinterpret_cast<char const*>(glGetString(GL_RENDERER));
  return renderer && std::strstr(renderer, "llvmpipe");
}

/// Pixels to draw to, each the mean of several samples, so that edges are smooth.
class SmoothTarget {
 public:
  /// What was drawn is lost where the size is another one. Throws Error where there is no room.
  void resize(int width, int height, int samples) {
    if (width == width_ && height == height_) return;
    GLint largest = 0, most = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width > largest || height > largest)
      throw Error("pictures",
                  text("a picture of ",
                       width,
                       " x ",
                       height,
                       " pixels is larger than the ",
                       largest,
                       " that OpenGL has room for here; ask for a smaller one"));
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    width_ = width, height_ = height;
    attach(smooth_, std::min<GLint>(samples, most));
    attach(plain_, 0);
  }
  /// What is drawn from now on goes here.
  void begin() const { glBindFramebuffer(GL_FRAMEBUFFER, smooth_.frame); }
  /// The means are made, and are what is read from now on.
  void end() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, smooth_.frame);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, plain_.frame);
    copy();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, plain_.frame);
  }
  /// To the frame buffer of a window, which is drawn to from now on.
  void show() const {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, plain_.frame);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    copy();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }

 private:
  struct Target {
    GlFrame frame = detail::made<GlFrame>([](auto n, auto* id) { glGenFramebuffers(n, id); });
    GlStore colour = detail::made<GlStore>([](auto n, auto* id) { glGenRenderbuffers(n, id); });
    GlStore depth = detail::made<GlStore>([](auto n, auto* id) { glGenRenderbuffers(n, id); });
  };
  Target smooth_{}, plain_{};
  int width_ = 0, height_ = 0;

  void copy() const {
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  void attach(Target const& to, GLint samples) const {
    glBindFramebuffer(GL_FRAMEBUFFER, to.frame);
    auto store = [&](GLuint id, GLenum format, GLenum place) {
      glBindRenderbuffer(GL_RENDERBUFFER, id);
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width_, height_);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, id);
    };
    store(to.colour, GL_RGB8, GL_COLOR_ATTACHMENT0);
    store(to.depth, GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error("pictures",
                  text("OpenGL has no room for a picture of ",
                       width_,
                       " x ",
                       height_,
                       " pixels; ask for a smaller one"));
  }
};

}  // namespace sinew::view
