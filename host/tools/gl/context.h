#pragma once

#include <EGL/egl.h>

#include <string>
#include <string_view>

namespace duolux {

/// An OpenGL compatibility context without window system or surface, current on this thread during its
/// lifetime. It uses the first working EGL device that is a GPU, otherwise Mesa's surfaceless platform.
/// Throws MachineError with the step that failed.
class GlContext {
  public:
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    std::string renderer() const;  ///< GL_RENDERER
    std::string version() const;   ///< GL_VERSION

  private:
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// Throws MachineError naming the stage if OpenGL has recorded an error.
void checkGl(std::string_view stage);

}  // namespace duolux
