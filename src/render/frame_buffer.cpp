#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "render/frame_buffer_internal.h"

namespace rex::internal {

FrameBuffer::FrameBuffer(const GlFunctions& gl, int width, int height, int samples)
    : gl_(&gl), width_(width), height_(height) {
  drawn_ = makeFramebuffer(samples, true);
  averaged_ = samples > 1 ? makeFramebuffer(1, false) : drawn_;
}

GLuint FrameBuffer::makeFramebuffer(int samples, bool withDepth) const {
  GLuint framebuffer = 0;
  gl_->GenFramebuffers(1, &framebuffer);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  const auto attach = [&](GLenum format, GLenum attachment) {
    GLuint buffer = 0;
    gl_->GenRenderbuffers(1, &buffer);
    gl_->BindRenderbuffer(GL_RENDERBUFFER, buffer);
    gl_->RenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width_, height_);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  };
  attach(GL_RGBA8, GL_COLOR_ATTACHMENT0);
  if (withDepth) attach(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT);
  if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error({.what = "OpenGL cannot draw a picture of this size",
                 .found = fmt::format("{} x {} pixels, {} samples", width_, height_, samples),
                 .wanted = "a smaller one"});
  return framebuffer;
}

void FrameBuffer::bind() const {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, drawn_);
  gl_->Viewport(0, 0, width_, height_);
}

Image FrameBuffer::read() const {
  if (averaged_ != drawn_) {
    gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, averaged_);
    gl_->BlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, averaged_);
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

}  // namespace rex::internal
