#include "bench/robots.h"

#include <numbers>

#include "base/rng.h"
#include "formats/ors_reader.h"
#include "geometry/rotation.h"
#include "support/paths.h"

namespace rex::bench {
namespace {

// Links on a fixed base, each turned by a hinge about its own z axis, as URDF robots are after calibration.
SceneSpec chain(const std::string& name, const std::vector<Pose>& jointFrames) {
  SceneSpec spec{.name = name, .bodies = {{.name = "base", .X_WB = {}}}, .joints = {}, .worldShapes = {}};
  for (std::size_t i = 0; i < jointFrames.size(); ++i) {
    BodySpec link{.name = "link" + std::to_string(i), .X_WB = {}, .mass = 1 + 0.1 * static_cast<double>(i)};
    link.p_BBcm = {0.02, -0.03, 0.1};
    link.inertia = Eigen::Vector3d(0.02, 0.03, 0.01).asDiagonal();
    const JointSpec joint{.name = "joint" + std::to_string(i),
                          .parent = spec.bodies.back().name,
                          .child = link.name,
                          .X_PF = jointFrames[i],
                          .X_MC = {},
                          .axis = Eigen::Vector3d::UnitZ()};
    spec.bodies.push_back(link);
    spec.joints.push_back(joint);
  }
  return spec;
}

SceneSpec arm() {
  const auto frame = [](double rollInQuarters, double x, double y, double z) {
    return translation(x, y, z) * rotation(rollInQuarters * std::numbers::pi / 2, Eigen::Vector3d::UnitX());
  };
  return chain("arm7", {frame(0, 0, 0, 0.33), frame(-1, 0, 0, 0), frame(1, 0, -0.32, 0), frame(1, 0.08, 0, 0),
                        frame(-1, -0.08, 0.38, 0), frame(1, 0, 0, 0), frame(1, 0.09, 0, 0)});
}

Robot robot(const std::string& name, const SceneSpec& spec, const std::string& tip, Rng& rng) {
  Model model = compile(spec);
  Eigen::MatrixXd Q(model.nq(), Robot::kPostures);
  for (auto q : Q.colwise()) q = rng.uniformVector(model.nq(), -2, 2);
  const BodyId body = model.body(tip);
  return {name, std::move(model), body, std::move(Q)};
}

}  // namespace

std::vector<Robot> robots() {
  Rng rng(1);
  std::vector<Robot> all;
  all.push_back(robot("arm7", arm(), "link6", rng));
  all.push_back(robot("man", readOrs(sourcePath("data/robots/man.ors")).spec, "handR", rng));
  return all;
}

Measurement timedInTurn(const std::function<void(int k)>& work) {
  if (!work) return {};
  return timed([work, k = 0]() mutable { work(k = (k + 1) % Robot::kPostures); });
}

Measurement timedPerPosture(const std::function<void()>& work) {
  return [all = timed(work)] { return all() / Robot::kPostures; };
}

}  // namespace rex::bench
