#pragma once
// Buffers from which the vertex shaders revolve: a line of stretches goes up in each frame, some
// ten kilobytes; the sectors stay.

#include "app/render/gl_objects.hpp"
#include "app/render/section.hpp"

#include <vector>

namespace clay::render {

class Revolver {
 public:
  static Revolver create();
  /// Draws the stretches with the program in use, each around in so many sectors.
  void draw(const std::vector<Stretch>& meridian, int sectors);

 private:
  VertexArray vertices_;
  Buffer steps_, stretches_;
  int sectors_ = 0;
};

class SliceFan {
 public:
  static SliceFan create();
  void load(const std::vector<Slice>& slices);
  void draw() const;

 private:
  VertexArray vertices_;
  Buffer corners_, slices_;
  int count_ = 0;
};

}  // namespace clay::render
