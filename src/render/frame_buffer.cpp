#include <cstring>

#include <fmt/format.h>

#include "base/error.h"
#include "render/frame_buffer_internal.h"
#include "render/shaders_internal.h"

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

namespace {

const std::string kNeighbours = R"(#version 330 core
uniform sampler2D drawn;
out vec4 color;

float light(vec3 c) { return dot(c, vec3(0.3, 0.6, 0.1)); }
ivec2 at = ivec2(gl_FragCoord.xy);
float lightAt(int right, int up) {
  return light(texelFetch(drawn, clamp(at + ivec2(right, up), ivec2(0), textureSize(drawn, 0) - 1), 0).rgb);
}
float m = lightAt(0, 0), w = lightAt(-1, 0), e = lightAt(1, 0), s = lightAt(0, -1), n = lightAt(0, 1);
float most = max(m, max(max(w, e), max(s, n))), least = min(m, min(min(w, e), min(s, n)));
float contrast = most - least;
)";

const std::string kFind = kNeighbours + R"(
const float kFaint = 0.035, kFaintShare = 0.1;  // contrasts below are no edges
void main() {
  if (contrast < max(kFaint, kFaintShare * most)) discard;
  color = texelFetch(drawn, at, 0);
}
)";

// The stairs of an edge are runs of pixels along it. The true share of the colour beyond the edge is one
// half for a pixel where its run ends with a step to its own side, and decreases to zero in the middle of
// the run.
const std::string kBlend = kNeighbours + R"(
const float kFar = 14.0;   // pixels that an edge is followed each way
const float kGrain = 0.5;  // how far single pixels are smoothed

void main() {
  float sw = lightAt(-1, -1), se = lightAt(1, -1);
  float nw = lightAt(-1, 1), ne = lightAt(1, 1);
  float bendY = 2.0 * abs(n + s - 2.0 * m) + abs(nw + sw - 2.0 * w) + abs(ne + se - 2.0 * e);
  float bendX = 2.0 * abs(w + e - 2.0 * m) + abs(nw + ne - 2.0 * n) + abs(sw + se - 2.0 * s);
  bool level = bendY >= bendX;
  float low = level ? s : w, high = level ? n : e;
  bool toHigh = abs(high - m) >= abs(low - m);
  float other = toHigh ? high : low;

  vec2 pixel = 1.0 / vec2(textureSize(drawn, 0)), here = gl_FragCoord.xy * pixel;
  vec2 along = (level ? vec2(1, 0) : vec2(0, 1)) * pixel;
  vec2 across = (level ? vec2(0, 1) : vec2(1, 0)) * (toHigh ? pixel : -pixel);

  // Between the two rows the light is half of each for as long as the step goes on.
  vec2 seam = here + 0.5 * across;
  float middle = 0.5 * (m + other), gone = 0.25 * abs(other - m);
  float back = 0.0, front = 0.0, offBack = 0.0, offFront = 0.0;
  for (float step = 1.0; step <= kFar; step += 1.0) {
    bool goBack = abs(offBack) < gone, goFront = abs(offFront) < gone;
    if (!goBack && !goFront) break;
    if (goBack) { back = step; offBack = light(texture(drawn, seam - step * along).rgb) - middle; }
    if (goFront) { front = step; offFront = light(texture(drawn, seam + step * along).rgb) - middle; }
  }
  float nearer = min(back, front), offNearer = back < front ? offBack : offFront;
  bool ended = abs(offNearer) >= gone;
  bool leaves = ended && (offNearer < 0.0) != (m < other);
  float share = leaves ? 0.5 - (nearer - 0.5) / (back + front - 1.0) : 0.0;

  float around = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
  float grain = smoothstep(0.0, 1.0, clamp(abs(around - m) / contrast, 0.0, 1.0));
  share = max(share, kGrain * grain * grain);
  color = texture(drawn, here + share * across);
}
)";

}  // namespace

Fxaa::Fxaa(const GlFunctions& gl)
    : gl_(&gl), find_(gl, backgroundShader().vertex, kFind), blend_(gl, backgroundShader().vertex, kBlend) {
  gl.GenVertexArrays(1, &noVertices_);
  for (const GlProgram* program : {&find_, &blend_}) {
    program->use();
    program->setTexture("drawn", FrameBuffer::kFirstStageUnit);
  }
}

// Edges are few, but OpenGL in software runs a whole shader for every pixel that the stencil does not stop.
void Fxaa::smooth(const FrameBuffer& frame) const {
  frame.bindSecondStage();
  gl_->Clear(GL_STENCIL_BUFFER_BIT);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Enable(GL_STENCIL_TEST);
  gl_->BindVertexArray(noVertices_);
  gl_->StencilFunc(GL_ALWAYS, 1, 1);
  gl_->StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  find_.use();
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->StencilFunc(GL_EQUAL, 1, 1);
  blend_.use();
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  gl_->Disable(GL_STENCIL_TEST);
  gl_->Enable(GL_DEPTH_TEST);
}

}  // namespace rex::internal
