#pragma once

#include "render/frame_buffer_internal.h"
#include "render/gl_program_internal.h"

namespace rex::internal {

/// Smooths the steps of slanted edges by what a picture's colours tell about them (the idea of FXAA, T.
/// Lottes 2009), and leaves alone what is not an edge.
class Fxaa {
 public:
  explicit Fxaa(const GlFunctions& gl);
  /// Ends the first stage of `frame`, which needs two, and smooths it in the second.
  void smooth(const FrameBuffer& frame) const;

 private:
  const GlFunctions* gl_;
  GlProgram find_, blend_;
  GLuint noVertices_ = 0;
};

}  // namespace rex::internal
