#pragma once

#include "render/gl_functions_internal.h"
#include "render/image.h"

namespace rex::internal {

/// What pictures are drawn into: colour and depth, with several samples per pixel if asked for, or with a
/// second stage that can read the colours of the first.
class FrameBuffer {
 public:
  enum class Stages { kOne, kTwo };
  /// Texture unit of the first stage's colours, of two.
  static constexpr int kFirstStageUnit = 1;

  /// `samples` = 1: none extra, as two stages need. Throws Error when OpenGL cannot make it this large.
  FrameBuffer(const GlFunctions& gl, int width, int height, int samples, Stages stages = Stages::kOne);
  void bind() const;
  /// Ends the first stage: what follows is drawn over a copy of it, with its depths.
  void bindSecondStage() const;
  /// The picture drawn so far, its samples averaged.
  [[nodiscard]] Image read() const;

 private:
  void copyToResult() const;

  const GlFunctions* gl_;
  int width_, height_;
  bool averages_;
  GLuint drawn_ = 0, result_ = 0;
};

}  // namespace rex::internal
