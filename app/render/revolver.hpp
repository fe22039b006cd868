#pragma once
// Buffers for vertex shaders that revolve a meridian: its stretches are uploaded in each frame,
// some ten kilobytes; the sectors stay.

#include "app/render/gl_objects.hpp"
#include "app/render/section.hpp"

#include <vector>

namespace clay::render {

class Revolver {
 public:
  static Revolver create();
  /// Draws the stretches with the current program, revolved in the given number of sectors.
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
