#include "render/shaders_internal.h"

namespace rex::internal {
namespace {

const std::string kVersion = "#version 330 core\n";

const std::string kBackground = R"(
uniform vec4 backgroundTop, backgroundBottom;
uniform float pictureHeight;
vec3 background() {
  return mix(backgroundBottom.rgb, backgroundTop.rgb, gl_FragCoord.y / pictureHeight);
}
)";

const std::string kPlaceSolid = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 end;
uniform mat3 R_WS;
uniform vec3 p_WS, halfSize, stretch;
vec3 placed() { return R_WS * (halfSize * position + stretch * end) + p_WS; }
)";

// The point is moved off its surface, towards the light, before it is looked up, because the surface would
// otherwise shade itself. Light may shine on the back of an imported surface.
const std::string kShadowPoint = R"(
#if SHADOW
uniform mat4 shadowClipFromWorld;
uniform float shadowTexel;
uniform vec3 toLight;
out vec3 shadowPoint;
void setShadowPoint(vec3 p, vec3 n) {
  float reach = dot(n, toLight) < 0.0 ? -1.5 * shadowTexel : 1.5 * shadowTexel;
  shadowPoint = 0.5 + 0.5 * (shadowClipFromWorld * vec4(p + reach * n, 1)).xyz;
}
#else
void setShadowPoint(vec3 p, vec3 n) {}
#endif
)";

// The rim of the map is empty, so that everything outside is lit.
const std::string kLight = R"(
#if SHADOW
uniform sampler2DShadow shadowMap;
in vec3 shadowPoint;
float sunSeen() { return texture(shadowMap, shadowPoint); }
#else
float sunSeen() { return 1.0; }
#endif
uniform vec3 toLight;
const vec3 kSky = vec3(0.50, 0.52, 0.55), kBounce = vec3(0.27, 0.26, 0.25), kSun = vec3(0.66, 0.65, 0.62);
vec3 diffuse(vec3 n, float sun) { return mix(kBounce, kSky, 0.5 + 0.5 * n.z) + kSun * sun; }
)";

std::string shadowSwitch(bool shadow) { return shadow ? "#define SHADOW 1\n" : "#define SHADOW 0\n"; }

std::string vertexStart(bool shadow) { return kVersion + shadowSwitch(shadow) + kShadowPoint; }

std::string fragmentStart(bool shadow) { return kVersion + shadowSwitch(shadow) + kLight; }

}  // namespace

ShaderSource backgroundShader() {
  return {kVersion + R"(
void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 1, 1); }
)",
          kVersion + kBackground + R"(
out vec4 color;
void main() { color = vec4(sqrt(background()), 1); }
)"};
}

ShaderSource depthShader() {
  return {kVersion + kPlaceSolid + R"(
uniform mat4 shadowClipFromWorld;
void main() { gl_Position = shadowClipFromWorld * vec4(placed(), 1); }
)",
          kVersion + "void main() {}\n"};
}

ShaderSource solidShader(bool shadow, bool textured) {
  const std::string painted = textured ? "#define TEXTURED 1\n" : "#define TEXTURED 0\n";
  const std::string vertex = vertexStart(shadow) + painted + kPlaceSolid + R"(
uniform mat4 clipFromWorld;
out vec3 worldPoint, worldNormal;
#if TEXTURED
layout(location = 3) in vec2 point;
out vec2 painted;
#endif
void main() {
#if TEXTURED
  painted = point;
#endif
  worldPoint = placed();
  worldNormal = normalize(R_WS * (normal / halfSize));
  gl_Position = clipFromWorld * vec4(worldPoint, 1);
  setShadowPoint(worldPoint, worldNormal);
}
)";
  const std::string fragment = fragmentStart(shadow) + painted + R"(
uniform vec3 eye;
uniform vec4 solidColor;
in vec3 worldPoint, worldNormal;
out vec4 color;
#if TEXTURED
uniform sampler2D surface;
in vec2 painted;
vec3 albedo() { vec3 c = texture(surface, painted).rgb; return solidColor.rgb * c * c; }
#else
vec3 albedo() { return solidColor.rgb; }
#endif
void main() {
  vec3 n = normalize(gl_FrontFacing ? worldNormal : -worldNormal);
  float facing = dot(n, toLight);
  float sun = facing > 0.0 ? facing * sunSeen() : 0.0;
  float shine = max(dot(n, normalize(toLight + normalize(eye - worldPoint))), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  color = vec4(sqrt(albedo() * diffuse(n, sun) + 0.12 * shine * sun), solidColor.a);
}
)";
  return {vertex, fragment};
}

// The checker is the product of two square waves, each averaged over the width of a pixel: `rise` is the
// integral of a wave that is 1 in even and -1 in odd cells.
ShaderSource groundShader(bool shadow) {
  const std::string vertex = vertexStart(shadow) + R"(
uniform mat4 clipFromWorld;
uniform vec3 groundCenter;
uniform float groundRadius;
out vec2 ground;
void main() {
  vec2 corner = vec2(2 * (gl_VertexID & 1) - 1, (gl_VertexID & 2) - 1);
  vec3 worldPoint = groundCenter + vec3(groundRadius * corner, 0);
  ground = worldPoint.xy;
  gl_Position = clipFromWorld * vec4(worldPoint, 1);
  setShadowPoint(worldPoint, vec3(0, 0, 1));
}
)";
  const std::string fragment = fragmentStart(shadow) + kBackground + R"(
uniform vec3 groundCenter;
uniform float groundRadius, groundCell;
uniform vec4 groundLight, groundDark;
in vec2 ground;
out vec4 color;
vec2 rise(vec2 x) { return 1.0 - abs(2.0 * fract(0.5 * x) - 1.0); }
void main() {
  vec2 x = ground / groundCell;
  vec2 width = max(abs(dFdx(x)) + abs(dFdy(x)), 0.001);
  vec2 wave = (rise(x + 0.5 * width) - rise(x - 0.5 * width)) / width;
  vec3 albedo = mix(groundDark.rgb, groundLight.rgb, 0.5 + 0.5 * wave.x * wave.y);
  vec3 lit = albedo * diffuse(vec3(0, 0, 1), toLight.z > 0.0 ? toLight.z * sunSeen() : 0.0);
  float far = smoothstep(0.3, 1.0, distance(ground, groundCenter.xy) / groundRadius);
  color = vec4(sqrt(mix(lit, background(), far)), 1);
}
)";
  return {vertex, fragment};
}

ShaderSource overlayShader() {
  return {kVersion + R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 offset;
layout(location = 2) in vec3 band;
layout(location = 3) in vec4 tint;
out vec2 fromStart;
flat out vec3 stroke;
flat out vec4 color0;
void main() {
  gl_Position = vec4(position, 1);
  fromStart = offset;
  stroke = band;
  color0 = tint;
}
)",
          kVersion + R"(
uniform float opacity;
in vec2 fromStart;
flat in vec3 stroke;
flat in vec4 color0;
out vec4 color;
void main() {
  float beyond = fromStart.x - clamp(fromStart.x, stroke.x, stroke.y);
  float covered = clamp(stroke.z + 0.5 - length(vec2(beyond, fromStart.y)), 0.0, 1.0);
  color = vec4(color0.rgb, color0.a * opacity * covered);
}
)"};
}

}  // namespace rex::internal
