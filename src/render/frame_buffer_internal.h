#pragma once

#include <array>
#include <vector>

#include "render/gl_program_internal.h"
#include "render/image.h"

namespace rex::internal {

struct FrameFormat {
  int samples = 1;         ///< per pixel
  bool twoStages = false;  ///< for one sample only; with a stencil
  GLenum colors = GL_RGBA8;
};

/// What pictures are drawn into: colour and depth, with several samples per pixel if asked for, or with a
/// second stage that can read the colours of the first.
class FrameBuffer {
 public:
  /// Texture unit of the first stage's colours, of two.
  static constexpr int kFirstStageUnit = 1;

  /// Throws Error when OpenGL cannot make it this large.
  FrameBuffer(const GlFunctions& gl, int width, int height, const FrameFormat& format);
  void bind() const;
  /// Ends the first stage: what follows is drawn over a copy of it, with its depths.
  void bindSecondStage() const;
  /// The picture drawn so far, its samples averaged.
  [[nodiscard]] Image read() const;
  /// The first two parts of each colour, for GL_RG32F. Rows from the bottom.
  [[nodiscard]] std::vector<std::array<float, 2>> readPairs() const;

 private:
  void copyToResult() const;

  const GlFunctions* gl_;
  int width_, height_;
  FrameFormat format_;
  GLuint drawn_ = 0, result_ = 0;
};

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
