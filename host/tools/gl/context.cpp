#include "host/tools/gl/context.h"

#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>
#include <vector>

#include "host/base/error.h"
#include "host/tools/gl/opengl.h"

namespace duolux {

namespace {

bool has(const char* extensions, std::string_view name) {
    return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

/// The displays that need no window system, in order of preference.
std::vector<EGLDisplay> candidates() {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto platformDisplay =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    std::vector<EGLDisplay> displays;
    if (platformDisplay == nullptr) return displays;
    // GPUs first: Mesa's own software device comes with the surfaceless platform.
    if (has(extensions, "EGL_EXT_platform_device") && has(extensions, "EGL_EXT_device_enumeration")) {
        const auto queryDevices =
            reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
        const auto queryString =
            reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        if (queryDevices != nullptr && queryString != nullptr &&
            queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_TRUE) {
            for (EGLint i = 0; i < count; ++i) {
                EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
                if (has(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
                displays.push_back(platformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
            }
        }
    }
    if (has(extensions, "EGL_MESA_platform_surfaceless"))
        displays.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return displays;
}

EGLContext makeContext(EGLDisplay display) {
    if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
    constexpr std::array<EGLint, 7> kContext{EGL_CONTEXT_MAJOR_VERSION,
                                             4,
                                             EGL_CONTEXT_MINOR_VERSION,
                                             3,
                                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                             EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                             EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kContext.data());
}

std::string glString(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text != nullptr ? text : "";
}

}  // namespace

GlContext::GlContext() {
    std::string problem = "EGL offers no display without a window system (Debian: libegl-mesa0)";
    for (EGLDisplay display : candidates()) {
        if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
            problem = fmt::format("eglInitialize failed (EGL error {:#x})", eglGetError());
            continue;
        }
        EGLContext context = makeContext(display);
        if (context != EGL_NO_CONTEXT &&
            eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_TRUE) {
            display_ = display;
            context_ = context;
            return;
        }
        problem = fmt::format("no OpenGL 4.3 compatibility context (EGL error {:#x})", eglGetError());
        if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
        eglTerminate(display);
    }
    throw MachineError(fmt::format("starting OpenGL: {}", problem));
}

GlContext::~GlContext() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string GlContext::renderer() const {
    return glString(GL_RENDERER);
}

std::string GlContext::version() const {
    return glString(GL_VERSION);
}

void checkGl(std::string_view stage) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) return;
    throw MachineError(fmt::format("{}: OpenGL error {:#x} from {}", stage, error, glString(GL_RENDERER)));
}

}  // namespace duolux
