#pragma once

namespace rex {

/// A colour as a screen shows it (sRGB), each part in [0, 1]; a = 0 is invisible, a = 1 opaque.
struct Color {
  float r = 0, g = 0, b = 0, a = 1;

  bool operator==(const Color&) const = default;
};

}  // namespace rex
