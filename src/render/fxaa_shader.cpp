#include "render/fxaa_shader_internal.h"

namespace rex::internal {

// A step of an edge is a run of pixels between two places where the edge moves on by one pixel. On the true
// edge the share of the other colour grows along the run, from none at one end to half at the other; which
// end is which tells the side to which the edge goes on.
ShaderSource fxaaShader() {
  return {backgroundShader().vertex, R"(#version 330 core
uniform sampler2D drawn;
out vec4 color;

const float kFaint = 0.035, kFaintShare = 0.1;  // contrasts below are no edges
const float kFar = 14.0;                        // pixels that an edge is followed each way
const float kGrain = 0.5;                       // how far single pixels are smoothed

float light(vec3 c) { return dot(c, vec3(0.3, 0.6, 0.1)); }
float lightNear(ivec2 at) { return light(texelFetch(drawn, at, 0).rgb); }

void main() {
  ivec2 last = textureSize(drawn, 0) - 1, at = ivec2(gl_FragCoord.xy);
  int left = max(at.x - 1, 0), right = min(at.x + 1, last.x), below = max(at.y - 1, 0), above = min(at.y + 1, last.y);
  float m = lightNear(at);
  float w = lightNear(ivec2(left, at.y)), e = lightNear(ivec2(right, at.y));
  float s = lightNear(ivec2(at.x, below)), n = lightNear(ivec2(at.x, above));
  float most = max(m, max(max(w, e), max(s, n))), least = min(m, min(min(w, e), min(s, n)));
  float contrast = most - least;
  if (contrast < max(kFaint, kFaintShare * most)) discard;

  float sw = lightNear(ivec2(left, below)), se = lightNear(ivec2(right, below));
  float nw = lightNear(ivec2(left, above)), ne = lightNear(ivec2(right, above));
  float bendY = 2.0 * abs(n + s - 2.0 * m) + abs(nw + sw - 2.0 * w) + abs(ne + se - 2.0 * e);
  float bendX = 2.0 * abs(w + e - 2.0 * m) + abs(nw + ne - 2.0 * n) + abs(sw + se - 2.0 * s);
  bool level = bendY >= bendX;
  float low = level ? s : w, high = level ? n : e;
  bool toHigh = abs(high - m) >= abs(low - m);
  float other = toHigh ? high : low;

  vec2 pixel = 1.0 / vec2(last + 1), here = gl_FragCoord.xy * pixel;
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
)"};
}

}  // namespace rex::internal
