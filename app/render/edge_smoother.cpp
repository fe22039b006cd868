#include "app/render/edge_smoother.hpp"

#include "app/render/shaders.hpp"

#include <utility>

namespace clay::render {
namespace {

/// The gradient between the corners of a pixel gives the direction of an edge. Along it, four taps
/// over three pixels replace the steps by a slope. Elsewhere the difference to the corners is
/// increased, within their range, since enlarging reduces it.
constexpr const char* kFragment = R"(
uniform sampler2D canvas;
out vec4 colour;

float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }

void main() {
  vec2 pixel = 1.0 / vec2(textureSize(canvas, 0));
  vec2 at = gl_FragCoord.xy * pixel, h = 0.5 * pixel;
  vec3 middle = texture(canvas, at).rgb;
  vec3 a = texture(canvas, at - h).rgb, b = texture(canvas, at + vec2(h.x, -h.y)).rgb;
  vec3 c = texture(canvas, at + vec2(-h.x, h.y)).rgb, d = texture(canvas, at + h).rgb;
  float la = luma(a), lb = luma(b), lc = luma(c), ld = luma(d);
  vec2 across = vec2(lb + ld - la - lc, lc + ld - la - lb);
  float steep = length(across);
  vec2 along = vec2(-across.y, across.x) / max(steep, 1e-4) * pixel;
  vec3 smoothed = 0.25 * (texture(canvas, at + 0.5 * along).rgb +
                          texture(canvas, at - 0.5 * along).rgb +
                          texture(canvas, at + 1.5 * along).rgb +
                          texture(canvas, at - 1.5 * along).rgb);
  vec3 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
  vec3 sharp = clamp(middle + 0.6 * (middle - 0.25 * (a + b + c + d)), min(low, middle),
                     max(high, middle));
  colour = vec4(mix(sharp, smoothed, smoothstep(0.03, 0.16, steep)), 1.0);
}
)";

}  // namespace

Result<EdgeSmoother> EdgeSmoother::create() {
  return make_program("smoothed edges", background_vertex(), kFragment).map([](Program program) {
    EdgeSmoother made;
    made.program_ = std::move(program);
    made.nothing_ = make_vertex_array();
    return made;
  });
}

void EdgeSmoother::draw(const Canvas& from, const Canvas& into) const {
  glBindFramebuffer(GL_FRAMEBUFFER, into.framebuffer());
  for (const GLenum test :
       {GLenum{GL_DEPTH_TEST}, GLenum{GL_BLEND}, GLenum{GL_CULL_FACE}, GLenum{GL_SCISSOR_TEST}})
    glDisable(test);
  glViewport(0, 0, into.width_px(), into.height_px());
  glUseProgram(program_.get());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, from.colour());
  glBindVertexArray(nothing_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glUseProgram(0);
}

}  // namespace clay::render
