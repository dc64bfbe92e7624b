#pragma once

#include <vector>

#include "render/camera.h"
#include "render/picture.h"

namespace rex::internal {

/// A corner of a flat overlay triangle: normalised device coordinates, and where it lies seen from the middle
/// of the line or disc: (along, across, half width) in pixels.
struct OverlayVertex {
  float position[3];
  float offset[3];
  Color color;
};

/// Triangles for lines and discs of constant width in pixels, because core OpenGL has neither. They lie 1 %
/// nearer to the camera than their points, so that a line on a surface is not half inside it.
[[nodiscard]] std::vector<OverlayVertex> makeOverlayMesh(const std::vector<Polyline>& lines,
                                                         const std::vector<PointSet>& sets,
                                                         const Camera& camera, int width, int height);

}  // namespace rex::internal
