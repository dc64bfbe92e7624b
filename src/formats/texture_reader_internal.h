#pragma once

#include <string>
#include <string_view>

#include "geometry/triangle_mesh.h"

namespace rex::mesh {

inline constexpr std::size_t kMostTexturePixels = std::size_t{1} << 24;  ///< of one picture
inline constexpr int kLongestTextureSide = 8192;                         ///< pixels

/// The picture in the bytes of a PNG or JPEG file, known by how they begin; what is transparent lies on
/// white. Throws Error beginning with `what`: another kind of file, a faulty one, one that is too large.
[[nodiscard]] Texture readTexture(std::string_view bytes, const std::string& what);

}  // namespace rex::mesh
