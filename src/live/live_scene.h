#pragma once
// The picture of a live page: the shapes of a model as a GLB in pieces, and the poses of its bodies.
#include <cstddef>
#include <string>
#include <vector>

#include "kinematics/forward_kinematics.h"
#include "scene/model.h"

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

/// Cuts a GLB of toGlb() at its buffer views.
[[nodiscard]] LivePieces splitGlb(const std::string& glb);

/// The shapes of a model as a GLB for the live page, at these poses of the bodies: shape i of
/// Model::shapes() is the node "s<i>". Shapes whose mesh was not loaded are left out. Throws Error as
/// toGlb().
[[nodiscard]] std::string liveGlb(const Model& model, const BodyPoses& poses);

/// What the page says about a model, as JSON: bodies, shapes with their poses on bodies, coordinates with
/// names, units and limits, the names of postures, and x and y of the direction that robots of this format
/// face: -y in .ors files, +x in others. Names are as in the scene.
[[nodiscard]] std::string liveDescription(const Model& model);

/// Poses as the page reads them: for each body x y z and a quaternion x y z w as little-endian floats, in
/// base 64.
[[nodiscard]] std::string posesText(const BodyPoses& poses);

}  // namespace rex
