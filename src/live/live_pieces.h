#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace rex {

/// A run of bytes in the binary part of a GLB, such as the corners of a mesh.
struct LivePiece {
  std::size_t at = 0;  ///< where it belongs
  std::string name{};  ///< the same for the same bytes: "piece-1f3a..."
  std::string bytes{};
};

/// A GLB as text and pieces, so that pages fetch what they have not seen yet, and put it together again.
struct LivePieces {
  std::string json{};
  std::vector<LivePiece> pieces{};
};

/// Cuts a GLB of glbOf() at its buffer views.
[[nodiscard]] LivePieces piecesOf(const std::string& glb);

}  // namespace rex
