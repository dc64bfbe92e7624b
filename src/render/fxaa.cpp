#include "render/fxaa_internal.h"
#include "render/shaders_internal.h"

namespace rex::internal {
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
