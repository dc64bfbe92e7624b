#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "render/frame_buffer_internal.h"

namespace rex::internal {

namespace {

GLuint makeRenderbuffer(const GlFunctions& gl, int samples, GLenum format, int width, int height) {
  GLuint buffer = 0;
  gl.GenRenderbuffers(1, &buffer);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
  return buffer;
}

GLuint makeColorTexture(const GlFunctions& gl, GLenum format, int width, int height) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.ActiveTexture(GL_TEXTURE0 + FrameBuffer::kFirstStageUnit);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                nullptr);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, axis, GL_CLAMP_TO_EDGE);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  gl.ActiveTexture(GL_TEXTURE0);
  return texture;
}

}  // namespace

FrameBuffer::FrameBuffer(const GlFunctions& gl, int width, int height, const FrameFormat& format)
    : gl_(&gl), width_(width), height_(height), format_(format) {
  const int samples = format.samples;
  const GLuint depth = makeRenderbuffer(
      gl, samples, format.twoStages ? GL_DEPTH24_STENCIL8 : GL_DEPTH_COMPONENT24, width, height);
  const auto make = [&](int colorSamples, bool readable, bool withDepth) {
    GLuint framebuffer = 0;
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    if (readable)
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                              makeColorTexture(gl, format.colors, width, height), 0);
    else
      gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 makeRenderbuffer(gl, colorSamples, format.colors, width, height));
    const GLenum attachment = format.twoStages ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
    if (withDepth) gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, depth);
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw Error({.what = "OpenGL cannot draw a picture of this size",
                   .found = fmt::format("{} x {} pixels, {} samples", width, height, samples),
                   .wanted = "a smaller one"});
    return framebuffer;
  };
  drawn_ = make(samples, format.twoStages, true);
  result_ = format.twoStages || samples > 1 ? make(1, false, format.twoStages) : drawn_;
}

void FrameBuffer::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  gl_->Viewport(0, 0, width_, height_);
}

void FrameBuffer::copyToResult() const {
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, result_);
  gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void FrameBuffer::bindSecondStage() const {
  copyToResult();
  gl_->BindFramebuffer(GL_FRAMEBUFFER, result_);
}

Image FrameBuffer::read() const {
  if (format_.samples > 1) copyToResult();
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, result_);
  // RGBA, because reading RGB takes three times as long.
  std::vector<std::uint8_t> rgba(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  gl_->ReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  requireNoGlError(*gl_, "drawing a picture");
  Image image(width_, height_);
  const std::uint8_t* from = rgba.data();
  for (int y = height_ - 1; y >= 0; --y) {
    std::uint8_t* to = image.pixel(0, y);
    for (int x = 0; x < width_; ++x, from += 4, to += 3) std::memcpy(to, from, 3);
  }
  return image;
}

std::vector<std::array<float, 2>> FrameBuffer::readPairs() const {
  std::vector<std::array<float, 2>> pairs(static_cast<std::size_t>(width_) *
                                          static_cast<std::size_t>(height_));
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, result_);
  gl_->ReadPixels(0, 0, width_, height_, GL_RG, GL_FLOAT, pairs.data());
  requireNoGlError(*gl_, "drawing a picture");
  return pairs;
}

}  // namespace rex::internal
