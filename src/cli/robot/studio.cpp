#include "cli/robot/studio.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "base/interruption.h"
#include "geometry/rotation.h"

namespace rex::cli {
namespace {

using Eigen::Vector3d;

Camera turnedCamera(const Camera& camera, const Vector3d& p_WT, double angle) {
  Camera result = camera;
  const Eigen::Matrix3d R = rotationAboutAxis(angle, Vector3d::UnitZ());
  result.X_WC = {R * camera.X_WC.R, p_WT + R * (camera.X_WC.p - p_WT)};
  return result;
}

}  // namespace

Studio::Studio(const RenderPlan& plan, const Bounds& scene)
    : plan_(plan), scene_(scene), renderer_(plan.renderer) {}

std::string Studio::describe() const {
  const std::string views = viewsOf(plan_);
  return renderer_.describe() + (views.empty() ? "" : "; " + views);
}

Image Studio::draw(const Picture& picture, double angle) {
  const double aspect = static_cast<double>(plan_.renderer.width) / plan_.renderer.height;
  std::vector<KeyFrame> seen;
  for (const auto& [name, view] : plan_.views) {
    const Camera camera = view.camera(scene_, aspect);
    seen.push_back({drawFrom(picture, turnedCamera(camera, view.target(scene_), angle)), name});
  }
  return seen.size() == 1 ? seen.front().image : sheetOf(seen);
}

Image Studio::drawFrom(const Picture& picture, const Camera& camera) {
  throwIfInterrupted();
  if (plan_.show == Show::kColor) {
    DrawnFrame drawn = renderer_.drawFrame(picture, camera);
    sawSomething_ |= drawn.showsSomething;
    return std::move(drawn.image);
  }
  sawSomething_ = true;  // an empty depth or segmentation image is a valid result
  if (plan_.show == Show::kSegmentation)
    return segmentationColors(renderer_.drawSegmentation(picture, camera));
  const double distance = (scene_.center() - camera.X_WC.p).norm(), reach = scene_.radius();
  return depthColors(renderer_.drawDepth(picture, camera), std::max(0., distance - reach),
                     distance + 2 * reach);
}

void Studio::requireSomethingSeen() const {
  if (!sawSomething_)
    throw UsageError(
        {.what = "--camera", .found = "nothing of the scene in view", .wanted = "a view of the scene"});
}

Image sheetOf(const std::vector<KeyFrame>& pictures) {
  constexpr int kNarrowest = 16;  // the least that a sheet accepts; it never widens a picture
  return contactSheet(pictures, {.pictureWidth = std::max(pictures.front().image.width, kNarrowest)});
}

Bounds turningBox(const Bounds& scene) {
  Bounds box = scene;
  const Vector3d middle = scene.center(), half = scene.high - middle;
  const double reach = half.head<2>().norm();
  box.include(middle - Vector3d(reach, reach, half.z()));
  box.include(middle + Vector3d(reach, reach, half.z()));
  return box;
}

}  // namespace rex::cli
