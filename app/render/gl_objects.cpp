#include "app/render/gl_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>

namespace clay::render {
namespace {

template <class Generate>
GLuint generated(Generate generate) {
  GLuint name = 0;
  generate(1, &name);
  return name;
}

/// A shader is needed only until its program is linked.
class Shader {
 public:
  Shader(GLenum kind, const std::string& text) : name_(glCreateShader(kind)) {
    const std::array sources = {
        glsl_version(),
        epoxy_is_desktop_gl() ? "\n" : "\nprecision highp float;\nprecision highp int;\n",
        text.c_str()};
    glShaderSource(name_, static_cast<GLsizei>(sources.size()), sources.data(), nullptr);
    glCompileShader(name_);
  }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  ~Shader() { glDeleteShader(name_); }
  [[nodiscard]] GLuint get() const noexcept { return name_; }
  /// The compiler's error text; empty if there is none.
  [[nodiscard]] std::string complaint() const {
    GLint fine = GL_FALSE, size = 0;
    glGetShaderiv(name_, GL_COMPILE_STATUS, &fine);
    if (fine == GL_TRUE) return {};
    glGetShaderiv(name_, GL_INFO_LOG_LENGTH, &size);
    std::string text(static_cast<std::size_t>(std::max(size, 1)), '\0');
    glGetShaderInfoLog(name_, size, nullptr, text.data());
    return text;
  }

 private:
  GLuint name_;
};

Renderbuffer make_storage(GLenum format, int width, int height, int samples) {
  Renderbuffer buffer(generated(glGenRenderbuffers));
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.get());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width,
                                   height);
  return buffer;
}

Texture make_colours(int width, int height) {
  Texture texture = make_texture();
  glBindTexture(GL_TEXTURE_2D, texture.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  filter_linearly();
  glBindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

}  // namespace

const char* glsl_version() {
  return epoxy_is_desktop_gl() ? "#version 330 core" : "#version 300 es";
}

Buffer make_buffer() { return Buffer(generated(glGenBuffers)); }
VertexArray make_vertex_array() { return VertexArray(generated(glGenVertexArrays)); }
Texture make_texture() { return Texture(generated(glGenTextures)); }

void filter_linearly() {
  for (const GLenum filter : {GLenum{GL_TEXTURE_MIN_FILTER}, GLenum{GL_TEXTURE_MAG_FILTER}})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}})
    glTexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
}

Result<Program> make_program(std::string_view name, const std::string& vertex,
                             const std::string& fragment) {
  const Shader first(GL_VERTEX_SHADER, vertex), second(GL_FRAGMENT_SHADER, fragment);
  for (const Shader* shader : {&first, &second})
    if (const std::string complaint = shader->complaint(); !complaint.empty())
      return failure(ErrorKind::device,
                     fmt::format("OpenGL refuses the shader {}: {}", name, complaint));
  Program program(glCreateProgram());
  glAttachShader(program.get(), first.get());
  glAttachShader(program.get(), second.get());
  glLinkProgram(program.get());
  GLint fine = GL_FALSE;
  glGetProgramiv(program.get(), GL_LINK_STATUS, &fine);
  if (fine != GL_TRUE)
    return failure(ErrorKind::device, fmt::format("OpenGL cannot link the shader {}", name));
  return program;
}

GLint location(const Program& program, const char* name) {
  return glGetUniformLocation(program.get(), name);
}
void set(const Program& program, const char* name, const glm::mat4& value) {
  glUniformMatrix4fv(location(program, name), 1, GL_FALSE, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec4& value) {
  glUniform4fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec3& value) {
  glUniform3fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, const glm::vec2& value) {
  glUniform2fv(location(program, name), 1, glm::value_ptr(value));
}
void set(const Program& program, const char* name, float value) {
  glUniform1f(location(program, name), value);
}

Result<Canvas> Canvas::create(int width_px, int height_px, int samples) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  Canvas canvas;
  canvas.width_ = width_px;
  canvas.height_ = height_px;
  canvas.samples_ = samples;
  const int taken = std::min(samples, static_cast<int>(most));
  if (taken > 1)
    canvas.colour_ = make_storage(GL_RGBA8, width_px, height_px, taken);
  else
    canvas.texture_ = make_colours(width_px, height_px);
  canvas.depth_ = make_storage(GL_DEPTH_COMPONENT24, width_px, height_px, taken);
  canvas.framebuffer_ = Framebuffer(generated(glGenFramebuffers));
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas.framebuffer());
  if (taken > 1)
    glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                              canvas.colour_.get());
  else
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           canvas.texture_.get(), 0);
  glFramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                            canvas.depth_.get());
  const GLenum status = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
  if (status != GL_FRAMEBUFFER_COMPLETE)
    return failure(ErrorKind::device,
                   fmt::format("OpenGL refuses a picture of {} x {} px with {} samples (status "
                               "{:#x})",
                               width_px, height_px, taken, status));
  return canvas;
}

}  // namespace clay::render
