#pragma once
// Owners of OpenGL object names. They are deleted with the context that was current at creation.

#include "claystack/core/result.hpp"

#include <epoxy/gl.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <utility>

namespace clay::render {

/// `Delete`: the function that deletes the name.
template <auto Delete>
class GlName {
 public:
  GlName() = default;
  explicit GlName(GLuint name) : name_(name) {}
  GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlName& operator=(GlName&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlName() {
    if (name_ != 0) Delete(name_);
  }
  [[nodiscard]] GLuint get() const noexcept { return name_; }

 private:
  GLuint name_ = 0;
};

namespace gl {
inline void delete_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void delete_vertices(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void delete_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void delete_renderbuffer(GLuint name) { glDeleteRenderbuffers(1, &name); }
inline void delete_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }
}  // namespace gl

using Buffer = GlName<gl::delete_buffer>;
using VertexArray = GlName<gl::delete_vertices>;
using Texture = GlName<gl::delete_texture>;
using Renderbuffer = GlName<gl::delete_renderbuffer>;
using Framebuffer = GlName<gl::delete_framebuffer>;
using Program = GlName<gl::delete_program>;

Buffer make_buffer();
VertexArray make_vertex_array();
Texture make_texture();
/// Of the bound 2D texture.
void filter_linearly();

/// The first line of the shaders for this context.
[[nodiscard]] const char* glsl_version();

/// Compiles and links. An error of kind `device`, with the driver's text, on failure; `name`
/// identifies the program.
Result<Program> make_program(std::string_view name, const std::string& vertex,
                             const std::string& fragment);

/// Uniforms of the program in use, by name.
[[nodiscard]] GLint location(const Program& program, const char* name);
void set(const Program& program, const char* name, const glm::mat4& value);
void set(const Program& program, const char* name, const glm::vec4& value);
void set(const Program& program, const char* name, const glm::vec3& value);
void set(const Program& program, const char* name, const glm::vec2& value);
void set(const Program& program, const char* name, float value);

/// Colour and depth, multisampled if `samples` is above 1; otherwise the colour is a texture.
class Canvas {
 public:
  /// `device`: the driver refuses this size.
  static Result<Canvas> create(int width_px, int height_px, int samples);
  [[nodiscard]] GLuint framebuffer() const noexcept { return framebuffer_.get(); }
  /// The texture, with linear filtering; 0 if multisampled.
  [[nodiscard]] GLuint colour() const noexcept { return texture_.get(); }
  [[nodiscard]] bool is(int width_px, int height_px, int samples) const noexcept {
    return width_ == width_px && height_ == height_px && samples_ == samples;
  }
  [[nodiscard]] int width_px() const noexcept { return width_; }
  [[nodiscard]] int height_px() const noexcept { return height_; }

 private:
  Framebuffer framebuffer_;
  Texture texture_;
  Renderbuffer colour_, depth_;
  int width_ = 0, height_ = 0, samples_ = 0;
};

}  // namespace clay::render
