#include "gallery/contacts.h"

#include <algorithm>

#include "contact/contact_scenes.h"
#include "kinematics/forward_kinematics.h"
#include "render/contact_sheet.h"
#include "render/picture.h"
#include "render/renderer.h"

namespace rex::gallery {
namespace {

using Eigen::Vector3d;

const Color kSlabColor{0.86f, 0.87f, 0.89f};
const Color kBodyColors[] = {{0.0f, 0.45f, 0.7f},
                             {0.84f, 0.37f, 0.0f},
                             {0.0f, 0.62f, 0.45f},
                             {0.8f, 0.47f, 0.65f},
                             {0.9f, 0.62f, 0.0f}};

// What is left of a floor or a wall: a slab in the plane of its surface, as large as what it carries.
Solid slabOf(const Solid& solid, bool isWall, double size) {
  Solid slab = solid;
  slab.color = kSlabColor;
  const double thick = 0.02 * size;
  slab.shape.extent = isWall ? Vector3d(thick, size, 2 * size) : Vector3d(2 * size, size, thick);
  const Vector3d surface = isWall ? Vector3d(solid.shape.extent.x() / 2 - thick / 2, 0, 0)
                                  : Vector3d(0, 0, solid.shape.extent.z() / 2 - thick / 2);
  slab.X_WS = solid.X_WS * translation(surface.x(), surface.y(), surface.z());
  if (isWall) slab.X_WS.p.z() = size;
  return slab;
}

Image sceneImage(const contact::ContactScene& scene) {
  const Model& model = scene.model;
  const BodyPoses poses =
      forwardKinematics(model, scene.shown.size() > 0 ? scene.shown : model.initialPositions());
  Picture picture;
  std::vector<Solid> still;
  for (const Solid& solid : placedSolids(model, poses)) {
    if (solid.name == "ground" || solid.name == "wall") {
      still.push_back(solid);
    } else {
      picture.solids.push_back(solid);
      picture.solids.back().color = kBodyColors[(picture.solids.size() - 1) % std::size(kBodyColors)];
    }
  }
  const Bounds of = bounds(picture);
  const double size = 1.2 * of.radius() + 0.05;
  for (const Solid& solid : still) picture.solids.push_back(slabOf(solid, solid.name == "wall", size));
  picture.ground.visible = false;
  return Renderer({.width = 200, .height = 160})
      .draw(picture, framing(bounds(picture), {0.5, -2, 0.7}, 200. / 160));
}

Image contactScenesSheet() {
  std::vector<KeyFrame> frames;
  for (const contact::ContactScene& scene : contact::contactScenes())
    frames.push_back({sceneImage(scene), scene.name});
  return contactSheet(frames, {.columns = 6, .pictureWidth = 200});
}

}  // namespace

std::vector<Drawing> contactPictures() {
  return {{"contact-scenes", "Contacts with closed-form results",
           "These scenes compare the simulation with [results in closed form](benchmarks.md#contacts).",
           contactScenesSheet}};
}

}  // namespace rex::gallery
