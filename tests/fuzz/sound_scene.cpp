#include "fuzz/sound_scene.h"

#include <algorithm>
#include <string_view>

#include "fuzz/require.h"
#include "geometry/rotation.h"
#include "kinematics/forward_kinematics.h"

namespace rex::fuzz {
namespace {

// Inputs are small, so this leaves out only scenes that consist of little else than bodies.
constexpr std::size_t kSmall = 100;

bool isMoving(const Joint& joint) { return joint.nq > 0 && !joint.mimics; }

void requireSound(const Model& model) {
  int coordinates = 0;
  for (const Joint& joint : model.joints()) {
    if (isMoving(joint)) coordinates += joint.nq;
    require(joint.qIndex + joint.nq <= model.nq() && joint.vIndex + joint.nv <= model.nv(),
            "joints have coordinates of the model");
  }
  require(coordinates == model.nq(), "each coordinate belongs to one joint");
  if (model.bodies().size() > kSmall) return;
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  for (const Pose& X_WB : poses.X_WB) require(isRotation(X_WB.R), "bodies stand with proper rotations");
}

}  // namespace

void requireSound(const SceneFile& scene) {
  try {
    requireSound(compile(scene.spec));
  } catch (const Error& error) {
    require(!error.parts().what.empty(), "a refusal has a reason");
  }
}

void requirePlace(const Error& error, std::string_view text) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  const SourceLocation& where = error.parts().where;
  require(!error.parts().what.empty(), "a refusal has a reason");
  require(where.line >= 1 && where.line <= lines && where.column >= 1, "a refusal has a place in the text");
}

}  // namespace rex::fuzz
