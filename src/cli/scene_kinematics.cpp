#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/json_internal.h"
#include "cli/posture_option.h"
#include "cli/wrong_use_internal.h"
#include "geometry/rotation.h"
#include "kinematics/jacobians.h"

namespace rex::cli {
namespace {

Eigen::VectorXd postureOf(const Model& model, const std::string& text) {
  return text.empty() ? model.initialPositions() : parsePosture(model, text);
}

std::string numbers(const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::string line;
  for (const double value : values) line += fmt::format(" {:10.6f}", std::abs(value) < 5e-7 ? 0. : value);
  return line;
}

void sayRows(const std::string& title, const Eigen::Ref<const Eigen::MatrixXd>& matrix) {
  say(title);
  for (const auto& row : matrix.rowwise()) say(numbers(row.transpose()));
}

}  // namespace

ExitCode sceneKinematics(const Project& project, const SceneOptions& options) {
  const Model model = loadScene(project, options.scene);
  const Eigen::VectorXd q = postureOf(model, options.posture);
  const BodyPoses poses = forwardKinematics(model, q);
  Json bodies = Json::array();
  std::size_t width = 4;
  for (const Body& body : model.bodies()) width = std::max(width, harmless(body.name).size());
  if (!options.json)
    say(fmt::format("{:{}} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}", "body", width, "x", "y", "z",
                    "qw", "qx", "qy", "qz"));
  for (const BodyId id : model.bodiesInFileOrder()) {
    const Quaternion quaternion = quaternionFromRotation(poses[id].R);
    if (options.json)
      bodies.push_back(
          {{"name", model[id].name}, {"pos", jsonOf(poses[id].p)}, {"quat_wxyz", jsonOf(quaternion)}});
    else
      say(fmt::format("{:{}}", harmless(model[id].name), width) + numbers(poses[id].p) + numbers(quaternion));
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
  if (options.scene.json) {
    say(dump(Json{{"pos", jsonOfRows(position)}, {"rot", jsonOfRows(angular)}}));
    return ExitCode::kFull;
  }
  sayRows(fmt::format("velocity of the point by v, m per unit ({} columns)", model.nv()), position);
  sayRows("angular velocity by v, rad per unit", angular);
  return ExitCode::kFull;
}

}  // namespace rex::cli
