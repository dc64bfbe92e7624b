#pragma once

#include "render/gl_functions_internal.h"
#include "render/image.h"

namespace rex::internal {

/// What pictures are drawn into: colour and depth, with several samples per pixel if asked for.
class FrameBuffer {
 public:
  /// `samples` = 1: none extra. Throws Error when OpenGL cannot make it this large.
  FrameBuffer(const GlFunctions& gl, int width, int height, int samples);
  void bind() const;
  /// The picture drawn so far, its samples averaged.
  [[nodiscard]] Image read() const;

 private:
  GLuint makeFramebuffer(int samples, bool withDepth) const;

  const GlFunctions* gl_;
  int width_, height_;
  GLuint drawn_ = 0, averaged_ = 0;
};

}  // namespace rex::internal
