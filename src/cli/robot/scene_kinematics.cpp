#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/numbers.h"
#include "cli/results_internal.h"
#include "cli/robot/posture_option.h"
#include "cli/robot/scene_verbs.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"

namespace rex::cli {
namespace {

// For at most nine columns, even of large numbers; what rounds to zero has no sign.
std::string fiveDecimals(double value) {
  if (std::abs(value) >= 1e3) return fmt::format("{:.3g}", value);
  return fmt::format("{:.5f}", std::abs(value) < 5e-6 ? 0. : value);
}

constexpr std::size_t kPoseColumn = 9;

}  // namespace

ExitCode sceneKinematics(const Project& project, const SceneOptions& options) {
  const Model model = loadScene(project, options.scene);
  const Eigen::VectorXd q = parsePosture(model, options.posture);
  const BodyPoses poses = forwardKinematics(model, q);
  noteOverflow(std::ranges::all_of(model.bodiesInFileOrder(), [&](BodyId id) {
    return poses[id].R.allFinite() && poses[id].p.allFinite();
  }));
  Results all{.json = {{"q", toJson(q)}, {"bodies", Json::array()}}};
  Table table(model[kWorld].name.size(), kPoseColumn);
  table.add({"body", "x", "y", "z", "qw", "qx", "qy", "qz"});
  for (const BodyId id : model.bodiesInFileOrder()) {
    Eigen::VectorXd pose(7);
    pose << poses[id].p, quaternionFromRotation(poses[id].R);
    all.json["bodies"].push_back(
        {{"name", model[id].name}, {"pos", toJson(pose.head(3))}, {"quat_wxyz", toJson(pose.tail(4))}});
    table.add(escapeForTerminal(model[id].name), pose, fiveDecimals);
  }
  all.line("{}", table.text());
  all.print(options.json);
  return ExitCode::kFull;
}

ExitCode sceneJacobian(const Project& project, const JacobianOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  const BodyId body = asWrongUse([&] { return model.body(options.body); }, "--body: ");
  const Eigen::Vector3d point = parsePoint(options.point, "--point");
  const BodyPoses poses = forwardKinematics(model, parsePosture(model, options.scene.posture));
  const Eigen::Matrix3Xd position = positionJacobian(model, poses, body, point);
  const Eigen::Matrix3Xd angular = angularJacobian(model, poses, body);
  noteOverflow(position.allFinite() && angular.allFinite());
  Results all{.json = {{"pos", jsonOfRows(position)}, {"rot", jsonOfRows(angular)}}};
  all.line("velocity of the point and angular velocity, per unit of each joint's velocity");
  Table table(8, kPoseColumn);
  table.add({"joint", "x", "y", "z", "wx", "wy", "wz"});
  const std::vector<std::string> names = printableVelocityNames(model);
  Eigen::MatrixXd both(6, model.nv());
  both << position, angular;
  for (int i = 0; i < model.nv(); ++i)
    table.add(names[static_cast<std::size_t>(i)], both.col(i), fiveDecimals);
  all.line("{}", table.text());
  all.print(options.scene.json);
  return ExitCode::kFull;
}

}  // namespace rex::cli
