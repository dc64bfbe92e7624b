#include "render/scene_picture.h"

#include <algorithm>

namespace rex {

std::vector<Solid> solidsOf(const Model& model, const BodyPoses& poses) {
  const auto isVisible = [](const ModelShape& shape) { return shape.visible; };
  const bool showsAll = std::none_of(model.shapes().begin(), model.shapes().end(), isVisible);
  std::vector<Solid> solids;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.visible && !showsAll) continue;
    if (usesMesh(shape.shape.type) && shape.shape.mesh.isEmpty()) continue;
    const Eigen::Vector4f c = shape.color.cast<float>();
    solids.push_back({.shape = shape.shape,
                      .X_WS = poses[shape.body] * shape.X_BS,
                      .color = {c[0], c[1], c[2], c[3]},
                      .name = shape.name});
  }
  return solids;
}

std::optional<double> groundHeight(const Model& model, const BodyPoses& poses) {
  std::optional<double> height;
  for (const ModelShape& shape : model.shapes()) {
    if (!shape.ground) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    const double top = X_WS.p.z() + X_WS.R.row(2).cwiseAbs().dot(halfBounds(shape.shape));
    height = std::max(height.value_or(top), top);
  }
  return height;
}

Picture pictureOf(const Model& model, const BodyPoses& poses) {
  Picture picture{.solids = solidsOf(model, poses)};
  if (const std::optional<double> height = groundHeight(model, poses)) {
    picture.ground.height = *height;
    return picture;
  }
  const Bounds all = bounds(picture);
  if (!all.isEmpty()) picture.ground.height = std::min(0., all.low.z());
  return picture;
}

}  // namespace rex
