#include "app/render/revolver.hpp"

#include <array>
#include <cstddef>

namespace clay::render {
namespace {

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

void attribute(GLuint index, GLint size, std::size_t stride, std::size_t at, GLuint divisor) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride), offset(at));
  glVertexAttribDivisor(index, divisor);
}

template <class Item>
void upload(const std::vector<Item>& items, GLenum usage) {
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(),
               usage);
}

}  // namespace

Revolver Revolver::create() {
  Revolver made;
  made.vertices_ = make_vertex_array();
  made.steps_ = make_buffer();
  made.stretches_ = make_buffer();
  glBindVertexArray(made.vertices_.get());
  glBindBuffer(GL_ARRAY_BUFFER, made.steps_.get());
  attribute(0, 2, sizeof(glm::vec2), 0, 0);
  glBindBuffer(GL_ARRAY_BUFFER, made.stretches_.get());
  attribute(1, 4, sizeof(Stretch), offsetof(Stretch, from), 1);
  attribute(2, 4, sizeof(Stretch), offsetof(Stretch, from_normal), 1);
  attribute(3, 4, sizeof(Stretch), offsetof(Stretch, open), 1);
  attribute(4, 2, sizeof(Stretch), offsetof(Stretch, neck), 1);
  return made;
}

void Revolver::draw(const std::vector<Stretch>& meridian, int sectors) {
  if (meridian.empty()) return;
  glBindVertexArray(vertices_.get());
  if (sectors != sectors_) {
    std::vector<glm::vec2> steps;  // upper end first: front faces are counterclockwise
    for (int k = 0; k <= sectors; ++k)
      for (const float end : {1.0f, 0.0f})
        steps.emplace_back(static_cast<float>(k) / static_cast<float>(sectors), end);
    glBindBuffer(GL_ARRAY_BUFFER, steps_.get());
    upload(steps, GL_STATIC_DRAW);
    sectors_ = sectors;
  }
  glBindBuffer(GL_ARRAY_BUFFER, stretches_.get());
  upload(meridian, GL_STREAM_DRAW);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (sectors + 1),
                        static_cast<GLsizei>(meridian.size()));
}

SliceFan SliceFan::create() {
  SliceFan made;
  made.vertices_ = make_vertex_array();
  made.corners_ = make_buffer();
  made.slices_ = make_buffer();
  glBindVertexArray(made.vertices_.get());
  constexpr std::array<float, 8> kCorners{0, 0, 1, 0, 0, 1, 1, 1};
  glBindBuffer(GL_ARRAY_BUFFER, made.corners_.get());
  glBufferData(GL_ARRAY_BUFFER, sizeof(kCorners), kCorners.data(), GL_STATIC_DRAW);
  attribute(0, 2, 2 * sizeof(float), 0, 0);
  glBindBuffer(GL_ARRAY_BUFFER, made.slices_.get());
  attribute(1, 4, sizeof(Slice), offsetof(Slice, low), 1);
  attribute(2, 4, sizeof(Slice), offsetof(Slice, y), 1);
  return made;
}

void SliceFan::load(const std::vector<Slice>& slices) {
  glBindBuffer(GL_ARRAY_BUFFER, slices_.get());
  upload(slices, GL_STREAM_DRAW);
  count_ = static_cast<int>(slices.size());
}

void SliceFan::draw() const {
  if (count_ == 0) return;
  glBindVertexArray(vertices_.get());
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
}

}  // namespace clay::render
