#pragma once

#include <string>

namespace rex::internal {

/// GLSL sources. Light is counted in squares of the colour values that go in and come out: close to sRGB, and
/// one square root per pixel instead of a power function.
struct ShaderSource {
  std::string vertex, fragment;
};

[[nodiscard]] ShaderSource backgroundShader();
/// Depth only, seen from the light.
[[nodiscard]] ShaderSource depthShader();
[[nodiscard]] ShaderSource solidShader(bool shadow, bool textured = false);
[[nodiscard]] ShaderSource groundShader(bool shadow);
/// Lines and discs, anti-aliased by their distance from the middle.
[[nodiscard]] ShaderSource overlayShader();

}  // namespace rex::internal
