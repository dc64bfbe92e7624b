#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/numbers.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_verbs.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"

namespace rex::cli {
namespace {

Eigen::VectorXd postureOf(const Model& model, const std::string& text) {
  return text.empty() ? model.initialPositions() : parsePosture(model, text);
}

// Nine columns each, even for very large numbers; what rounds to zero has no sign.
std::string fiveDecimals(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string line;
  for (const double value : values) {
    if (std::abs(value) >= 1e3)
      line += fmt::format(" {:9.3g}", value);
    else
      line += fmt::format(" {:9.5f}", std::abs(value) < 5e-6 ? 0. : value);
  }
  return line;
}

std::string heads(const std::vector<const char*>& names) {
  std::string line;
  for (const char* name : names) line += fmt::format(" {:>9}", name);
  return line;
}

}  // namespace

ExitCode sceneKinematics(const Project& project, const SceneOptions& options) {
  const Model model = loadScene(project, options.scene);
  const Eigen::VectorXd q = postureOf(model, options.posture);
  const BodyPoses poses = forwardKinematics(model, q);
  noteOverflow(std::ranges::all_of(model.bodiesInFileOrder(), [&](BodyId id) {
    return poses[id].R.allFinite() && poses[id].p.allFinite();
  }));
  Json bodies = Json::array();
  std::vector<std::string> names;
  for (const Body& body : model.bodies()) names.push_back(escapeForTerminal(body.name));
  const std::size_t width = widestOf(names, 4);
  if (!options.json)
    say(fmt::format("{:{}}", "body", width) + heads({"x", "y", "z", "qw", "qx", "qy", "qz"}));
  for (const BodyId id : model.bodiesInFileOrder()) {
    const Quaternion quaternion = quaternionFromRotation(poses[id].R);
    if (options.json)
      bodies.push_back(
          {{"name", model[id].name}, {"pos", jsonOf(poses[id].p)}, {"quat_wxyz", jsonOf(quaternion)}});
    else
      say(fmt::format("{:{}}", escapeForTerminal(model[id].name), width) + fiveDecimals(poses[id].p) +
          fiveDecimals(quaternion));
  }
  if (options.json) say(dump(Json{{"q", jsonOf(q)}, {"bodies", bodies}}));
  return ExitCode::kFull;
}

ExitCode sceneJacobian(const Project& project, const JacobianOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  const BodyId body = asWrongUse([&] { return model.body(options.body); }, "--body: ");
  const Eigen::Vector3d point =
      options.point.empty() ? Eigen::Vector3d::Zero() : parsePoint(options.point, "--point");
  const BodyPoses poses = forwardKinematics(model, postureOf(model, options.scene.posture));
  const Eigen::Matrix3Xd position = positionJacobian(model, poses, body, point);
  const Eigen::Matrix3Xd angular = angularJacobian(model, poses, body);
  noteOverflow(position.allFinite() && angular.allFinite());
  if (options.scene.json) {
    say(dump(Json{{"pos", jsonOfRows(position)}, {"rot", jsonOfRows(angular)}}));
    return ExitCode::kFull;
  }
  const std::vector<std::string> names = printableVelocityNames(model);
  const std::size_t width = widestOf(names, 8);
  say("velocity of the point and angular velocity, per unit of each joint's velocity");
  say(fmt::format("{:{}}", "joint", width) + heads({"x", "y", "z", "wx", "wy", "wz"}));
  for (int i = 0; i < model.nv(); ++i)
    say(fmt::format("{:{}}", names[static_cast<std::size_t>(i)], width) + fiveDecimals(position.col(i)) +
        fiveDecimals(angular.col(i)));
  return ExitCode::kFull;
}

}  // namespace rex::cli
