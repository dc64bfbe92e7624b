#include "fuzz/sound_scene.h"

#include <algorithm>
#include <optional>
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
}

BodyPoses placesOf(const Model& model) {
  BodyPoses poses = forwardKinematics(model, model.initialPositions());
  for (const Pose& X_WB : poses.X_WB) require(isRotation(X_WB.R), "bodies stand with proper rotations");
  return poses;
}

// Numbers so large that a metre is lost in them say nothing about places.
bool isOfOurWorld(const Model& model, const BodyPoses& poses) {
  const auto isNear = [](const Pose& X) { return X.p.cwiseAbs().maxCoeff() < 1e3; };
  return std::ranges::all_of(poses.X_WB, isNear) &&
         std::ranges::all_of(model.joints(),
                             [&](const Joint& joint) { return isNear(joint.X_PF) && isNear(joint.X_MC); });
}

std::optional<Model> compiled(const SceneSpec& spec) {
  try {
    return compile(spec);
  } catch (const Error& error) {
    require(!error.parts().what.empty(), "a refusal has a reason");
    return {};
  }
}

}  // namespace

void requireSound(const SceneFile& scene, std::string (*write)(const SceneSpec&),
                  SceneSpec (*read)(const std::string&)) {
  const std::optional<Model> model = compiled(scene.spec);
  if (!model) return;
  requireSound(*model);
  if (model->bodies().size() > kSmall) return;
  const BodyPoses poses = placesOf(*model);
  if (!isOfOurWorld(*model, poses)) return;
  std::string text;
  try {
    text = write(scene.spec);
  } catch (const Error& error) {
    // Not the name of a body that says so.
    const std::string& what = error.parts().what;
    const bool isUnread =
        what.starts_with("as ") && what.find("could not be read again") != std::string::npos;
    require(!isUnread || error.parts().wanted.starts_with("at most"),
            "what is written can be read, within the limits");
    return;
  }
  const Model again = compile(read(text));
  const BodyPoses places = placesOf(again);
  for (const Body& body : model->bodies())
    require(isApprox(poses[model->body(body.name)], places[again.body(body.name)], 1e-6),
            "a scene that was written and read again stands as before");
  require(model->pins().size() == again.pins().size(),
          "a scene that was written and read again keeps its pins");
}

void requirePlace(const Error& error, std::string_view text) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  const SourceLocation& where = error.parts().where;
  require(!error.parts().what.empty(), "a refusal has a reason");
  require(where.line >= 1 && where.line <= lines && where.column >= 1, "a refusal has a place in the text");
}

}  // namespace rex::fuzz
