#include "host/tools/gl/draw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>
#include <string>

#include "host/base/error.h"
#include "host/tools/gl/context.h"
#include "host/tools/gl/opengl.h"
#include "host/tools/gl/view.h"

namespace duolux {

namespace {

constexpr GLsizei kLightsInShader = 1024;

constexpr const char* kVertexShader = R"(#version 430 compatibility
out vec3 position;
out vec3 normal;
void main() {
    position = gl_Vertex.xyz;
    normal = gl_Normal;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
}
)";

constexpr const char* kFragmentShader = R"(#version 430 compatibility
struct Light { vec4 position; vec4 direction; vec4 intensity; };
layout(std140, binding = 0) uniform Lights { Light lights[1024]; };
uniform int lightCount;
uniform vec3 diffuse[2];   // over pi; front, back
uniform vec3 emission[2];
in vec3 position;
in vec3 normal;
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    vec3 irradiance = vec3(0.0);
    for (int i = 0; i < lightCount; i++) {
        vec3 toLight = lights[i].position.xyz - position;
        float r2 = dot(toLight, toLight);
        float cosines = max(dot(n, toLight), 0.0) * max(-dot(lights[i].direction.xyz, toLight), 0.0);
        irradiance += lights[i].intensity.rgb * (cosines / (r2 * r2));
    }
    int side = gl_FrontFacing ? 0 : 1;
    gl_FragColor = vec4(diffuse[side] * irradiance + emission[side], 1.0);
}
)";

struct ShaderLight {
    glm::vec4 position, direction, intensity;
};

GLuint compileShader(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == 0) {
        std::string log(1000, '\0');
        GLsizei length = 0;
        glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
        log.resize(static_cast<std::size_t>(length));
        throw MachineError(fmt::format("compiling OpenGL's shader: {}", log));
    }
    return shader;
}

/// Albedo or emission of the two sides.
std::array<glm::vec3, 2> diffuseOf(const Material& m) {
    return {m.baseColor, m.sides == Sides::kBoth ? m.baseColor : glm::vec3(0.0f)};
}
std::array<glm::vec3, 2> emissionOf(const Material& m) {
    return {m.emission.visible, m.emission.sides == Sides::kBoth ? m.emission.visible : glm::vec3(0.0f)};
}

constexpr std::array<GLenum, 2> kFaces{GL_FRONT, GL_BACK};

/// An image of floats that can be drawn to.
struct Target {
    GLuint framebuffer = 0, texture = 0, depth = 0;

    Target(GLsizei width, GLsizei height, bool withDepth) {
        glGenTextures(1, &texture);
        glBindTexture(GL_TEXTURE_2D, texture);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, width, height, 0, GL_RGBA, GL_FLOAT, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glGenFramebuffers(1, &framebuffer);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
        if (withDepth) {
            glGenRenderbuffers(1, &depth);
            glBindRenderbuffer(GL_RENDERBUFFER, depth);
            glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH32F_STENCIL8, width, height);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth);
        }
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw MachineError(fmt::format("OpenGL cannot draw to {} x {} pixels of floats", width, height));
    }
    ~Target() {
        glDeleteFramebuffers(1, &framebuffer);
        glDeleteTextures(1, &texture);
        glDeleteRenderbuffers(1, &depth);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
};

void loadMatrix(GLenum mode, const glm::mat4& matrix) {
    glMatrixMode(mode);
    glLoadMatrixf(glm::value_ptr(matrix));
}

void addTo(const Target& sum, const Target& image) {
    glBindFramebuffer(GL_FRAMEBUFFER, sum.framebuffer);
    glPushAttrib(GL_ALL_ATTRIB_BITS);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_LIGHTING);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_TEXTURE_2D);
    glEnable(GL_TEXTURE_GEN_S);
    glEnable(GL_TEXTURE_GEN_T);
    glBindTexture(GL_TEXTURE_2D, image.texture);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    loadMatrix(GL_PROJECTION, glm::mat4(1.0f));
    loadMatrix(GL_MODELVIEW, glm::mat4(1.0f));
    glRectf(-1.0f, -1.0f, 1.0f, 1.0f);  // texture coordinates are made from positions
    glPopAttrib();
}

}  // namespace

const char* nameOf(Lighting lighting) {
    switch (lighting) {
        case Lighting::kFixedFunction:
            return "fixed-function";
        case Lighting::kPerFragment:
            return "per-fragment";
        case Lighting::kWireframe:
            return "wireframe";
    }
    return "";
}

struct GlScene::Objects {
    Objects(GLsizei width, GLsizei height) : image(width, height, true), sum(width, height, false) {}
    ~Objects() {
        glDeleteBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
        glDeleteProgram(program);
    }
    Objects(const Objects&) = delete;
    Objects& operator=(const Objects&) = delete;

    Target image, sum;
    std::array<GLuint, 3> buffers{};  // vertices, indices, lights
    GLuint program = 0;
};

GlScene::GlScene(const Scene& scene, const RenderSettings& settings)
    : scene_(scene),
      settings_(settings),
      objects_(std::make_unique<Objects>(static_cast<GLsizei>(settings.width),
                                         static_cast<GLsizei>(settings.height))),
      mesh_(makeGlMesh(scene)) {
    statistics_.vertices = mesh_.vertices.size();
    glGenBuffers(3, objects_->buffers.data());
    glBindBuffer(GL_ARRAY_BUFFER, objects_->buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh_.vertices.size() * sizeof(GlVertex)),
                 mesh_.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, objects_->buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh_.indices.size() * sizeof(std::uint32_t)), mesh_.indices.data(),
                 GL_STATIC_DRAW);
    glEnableClientState(GL_VERTEX_ARRAY);
    glEnableClientState(GL_NORMAL_ARRAY);
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    glVertexPointer(3, GL_FLOAT, sizeof(GlVertex), offset(offsetof(GlVertex, position)));
    glNormalPointer(GL_FLOAT, sizeof(GlVertex), offset(offsetof(GlVertex, normal)));

    glViewport(0, 0, static_cast<GLsizei>(settings.width), static_cast<GLsizei>(settings.height));
    glFrontFace(GL_CCW);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    // Colours beyond 1 are clamped when the picture is displayed, not before it is averaged.
    glClampColor(GL_CLAMP_VERTEX_COLOR, GL_FALSE);
    glClampColor(GL_CLAMP_FRAGMENT_COLOR, GL_FALSE);
    const glm::vec4 black(0.0f, 0.0f, 0.0f, 1.0f);
    glLightModelfv(GL_LIGHT_MODEL_AMBIENT, glm::value_ptr(black));
    glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, GL_TRUE);
    glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT, glm::value_ptr(black));
    // Texture coordinates of addTo's rectangle: (x + 1) / 2, (y + 1) / 2.
    const glm::vec4 s(0.5f, 0.0f, 0.0f, 0.5f);
    const glm::vec4 t(0.0f, 0.5f, 0.0f, 0.5f);
    glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_OBJECT_LINEAR);
    glTexGenfv(GL_S, GL_OBJECT_PLANE, glm::value_ptr(s));
    glTexGenfv(GL_T, GL_OBJECT_PLANE, glm::value_ptr(t));
    checkGl("uploading the scene to OpenGL");
}

GlScene::~GlScene() = default;

void GlScene::drawRanges(const std::function<void(const Material&)>& setMaterial) {
    for (const GlMesh::Range& range : mesh_.ranges) {
        setMaterial(scene_.materials[range.material]);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(range.first * sizeof(std::uint32_t)));
    }
    ++statistics_.sceneDrawings;
}

void GlScene::drawFixedFunction(std::span<const SpotLight> lights, bool withEmission) {
    const Bounds bounds = boundsOf(scene_.geometry);
    const glm::vec3 size = bounds.upper - bounds.lower;
    const float length = std::max({size.x, size.y, size.z}) / 2.0f;
    const float attenuation = 1.0f / (length * length);  // a2: lights have about unit brightness then
    glEnable(GL_LIGHTING);
    for (GLenum i = 0; i < static_cast<GLenum>(statistics_.lightsAtOnce); ++i) {
        const GLenum light = GL_LIGHT0 + i;
        if (i >= lights.size()) {
            glDisable(light);
            continue;
        }
        const SpotLight& l = lights[i];
        const glm::vec4 position(l.position, 1.0f);
        const glm::vec4 diffuse(l.intensity * (attenuation / std::numbers::pi_v<float>), 1.0f);
        const glm::vec4 none(0.0f);
        glEnable(light);
        glLightfv(light, GL_POSITION, glm::value_ptr(position));
        glLightfv(light, GL_DIFFUSE, glm::value_ptr(diffuse));
        glLightfv(light, GL_AMBIENT, glm::value_ptr(none));
        glLightfv(light, GL_SPECULAR, glm::value_ptr(none));
        glLightfv(light, GL_SPOT_DIRECTION, glm::value_ptr(l.direction));
        glLightf(light, GL_SPOT_CUTOFF, 90.0f);
        glLightf(light, GL_SPOT_EXPONENT, 1.0f);
        glLightf(light, GL_CONSTANT_ATTENUATION, 0.0f);
        glLightf(light, GL_LINEAR_ATTENUATION, 0.0f);
        glLightf(light, GL_QUADRATIC_ATTENUATION, attenuation);
    }
    drawRanges([&](const Material& material) {
        for (std::size_t side = 0; side < 2; ++side) {
            const glm::vec4 diffuse(diffuseOf(material)[side], 1.0f);
            const glm::vec4 emission(withEmission ? emissionOf(material)[side] : glm::vec3(0.0f), 1.0f);
            glMaterialfv(kFaces[side], GL_DIFFUSE, glm::value_ptr(diffuse));
            glMaterialfv(kFaces[side], GL_EMISSION, glm::value_ptr(emission));
        }
    });
    glDisable(GL_LIGHTING);
}

void GlScene::drawPerFragment(std::span<const SpotLight> lights, bool withEmission) {
    std::vector<ShaderLight> records(kLightsInShader);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        records[i] = {glm::vec4(lights[i].position, 1.0f), glm::vec4(lights[i].direction, 0.0f),
                      glm::vec4(lights[i].intensity, 0.0f)};
    }
    glBindBuffer(GL_UNIFORM_BUFFER, objects_->buffers[2]);
    glBufferData(GL_UNIFORM_BUFFER, static_cast<GLsizeiptr>(records.size() * sizeof(ShaderLight)),
                 records.data(), GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, objects_->buffers[2]);
    if (objects_->program == 0) {
        objects_->program = glCreateProgram();
        for (const auto& [kind, source] : {std::pair(GLenum{GL_VERTEX_SHADER}, kVertexShader),
                                           {GLenum{GL_FRAGMENT_SHADER}, kFragmentShader}}) {
            const GLuint shader = compileShader(kind, source);
            glAttachShader(objects_->program, shader);
            glDeleteShader(shader);
        }
        glLinkProgram(objects_->program);
        GLint linked = 0;
        glGetProgramiv(objects_->program, GL_LINK_STATUS, &linked);
        if (linked == 0)
            throw MachineError("OpenGL cannot link the shaders; they require a uniform block of 48 KiB");
    }
    glUseProgram(objects_->program);
    const auto location = [&](const char* name) { return glGetUniformLocation(objects_->program, name); };
    glUniform1i(location("lightCount"), static_cast<GLint>(lights.size()));
    drawRanges([&](const Material& material) {
        std::array<glm::vec3, 2> diffuse = diffuseOf(material);
        for (glm::vec3& side : diffuse)
            side /= std::numbers::pi_v<float>;
        const std::array<glm::vec3, 2> emission =
            withEmission ? emissionOf(material) : std::array<glm::vec3, 2>{};
        glUniform3fv(location("diffuse"), 2, glm::value_ptr(diffuse[0]));
        glUniform3fv(location("emission"), 2, glm::value_ptr(emission[0]));
    });
    glUseProgram(0);
}

void GlScene::drawWireframe() {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 1.0f);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    drawRanges([](const Material&) {});
    glDisable(GL_POLYGON_OFFSET_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glDepthFunc(GL_LEQUAL);
    drawRanges([](const Material& material) { glColor3fv(glm::value_ptr(material.baseColor)); });
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

void GlScene::drawOnce(std::span<const SpotLight> lights, Lighting lighting) {
    glBindFramebuffer(GL_FRAMEBUFFER, objects_->image.framebuffer);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    if (lighting == Lighting::kWireframe) return drawWireframe();
    // Further lights are added only to the fragments that are visible with the first ones.
    std::size_t first = 0;
    do {
        const std::span<const SpotLight> batch =
            lights.subspan(first, std::min<std::size_t>(statistics_.lightsAtOnce, lights.size() - first));
        if (lighting == Lighting::kFixedFunction) {
            drawFixedFunction(batch, first == 0);
        } else {
            drawPerFragment(batch, first == 0);
        }
        first += batch.size();
        // Of coincident surfaces, only the first is drawn, as with the first lights.
        glClear(GL_STENCIL_BUFFER_BIT);
        glEnable(GL_STENCIL_TEST);
        glStencilFunc(GL_EQUAL, 0, 1);
        glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
        glDepthFunc(GL_EQUAL);
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
    } while (first < lights.size());
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_BLEND);
}

std::vector<glm::vec3> GlScene::draw(std::span<const SpotLight> lights, const DrawOptions& options) {
    GLint most = kLightsInShader;
    if (options.lighting == Lighting::kFixedFunction) glGetIntegerv(GL_MAX_LIGHTS, &most);
    statistics_.lightsAtOnce = static_cast<std::uint32_t>(most);

    glBindFramebuffer(GL_FRAMEBUFFER, objects_->sum.framebuffer);
    glClear(GL_COLOR_BUFFER_BIT);
    for (std::uint32_t pass = 0; pass < options.passes; ++pass) {
        const glm::vec2 jitter = jitterOf(pass);
        loadMatrix(GL_PROJECTION, projectionMatrix(scene_, settings_, jitter, options.window));
        loadMatrix(GL_MODELVIEW, viewMatrix(scene_.camera));
        drawOnce(lights, options.lighting);
        addTo(objects_->sum, objects_->image);
    }
    const std::uint32_t width = settings_.width;
    const std::uint32_t height = settings_.height;
    std::vector<glm::vec3> rows(std::size_t{width} * height);
    glBindFramebuffer(GL_FRAMEBUFFER, objects_->sum.framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height), GL_RGB, GL_FLOAT,
                 rows.data());
    checkGl("drawing with OpenGL");
    std::vector<glm::vec3> result;
    result.reserve(rows.size());
    for (std::uint32_t y = height; y-- > 0;) {
        for (std::uint32_t x = 0; x < width; ++x)
            result.push_back(rows[std::size_t{y} * width + x] / static_cast<float>(options.passes));
    }
    return result;
}

}  // namespace duolux
