// SPDX-License-Identifier: BSL-1.0
#pragma once

#include <sinew/core/error.hpp>

#include <epoxy/egl.h>
#include <epoxy/gl.h>

namespace sinew::view {

/// An OpenGL 3.3 context without a window or display, by EGL: on a graphics card or by Mesa's software. The
/// thread that makes it draws with it.
class OffscreenContext {
 public:
  /// Throws Error where there is no OpenGL 3.3.
  OffscreenContext() {
    if (!epoxy_has_egl()) refuse("there is no EGL on this machine");
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
      display_ = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) {
      display_ = eglGetDisplay(EGL_DEFAULT_DISPLAY);
      if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) {
        display_ = EGL_NO_DISPLAY;
        refuse("EGL finds no device to draw with");
      }
    }
    constexpr EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    constexpr EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  3,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  3,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
    EGLConfig config{};
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display_, wanted, &config, 1, &count) && count == 1)
      context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
    if (context_ == EGL_NO_CONTEXT || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      end();
      refuse("there is no OpenGL 3.3");
    }
  }
  OffscreenContext(OffscreenContext const&) = delete;
  OffscreenContext& operator=(OffscreenContext const&) = delete;
  ~OffscreenContext() { end(); }

 private:
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;

  void end() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }
  [[noreturn]] static void refuse(char const* what) {
    throw Error("pictures",
                text(what,
                     "; install a driver, or Mesa's software (Debian: libegl1, libgl1-mesa-dri), which needs "
                     "no graphics card"));
  }
};

}  // namespace sinew::view
