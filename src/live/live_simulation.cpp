#include "live/live_simulation.h"

#include <fmt/format.h>

#include "kinematics/forward_kinematics.h"
#include "kinematics/jacobians.h"
#include "render/picture.h"
#include "render/report.h"
#include "scene/state.h"

namespace rex {

std::string toReplay(const Model& model, const LiveRecording& recording) {
  Report report{.title = model.name()};
  for (std::size_t k = 0; k < recording.times.size(); ++k)
    report.film.push_back({.time = recording.times[k],
                           .picture = scenePicture(model, forwardKinematics(model, recording.postures[k]))});
  settleGround(report.film);
  if (recording.floor)
    for (Frame& frame : report.film) frame.picture.ground.height = *recording.floor;
  return reportPage(report);
}

std::string toTable(const Model& model, const LiveRecording& recording) {
  std::string text = "time";
  for (const std::string& name : positionNames(model)) {
    text += ',';
    for (const char c : name) text += c == ',' || c == '\n' || c == '"' ? '_' : c;
  }
  text += '\n';
  for (std::size_t k = 0; k < recording.times.size(); ++k) {
    text += fmt::format("{}", recording.times[k] - recording.times.front());
    for (const double value : recording.postures[k]) text += fmt::format(",{}", value);
    text += '\n';
  }
  return text;
}

namespace {

constexpr double kTau = 1e-3;  // seconds per step

Model withFloor(SceneSpec spec, const std::optional<double>& height) {
  if (height) spec.worldShapes.push_back(floorAt(*height));
  return compile(spec);
}

}  // namespace

ShapeSpec floorAt(double height) {
  constexpr double kThickness = 1, kWidth = 100;
  return {.name = "floor",
          .X_BS = translation(0, 0, height - kThickness / 2),
          .shape = {.type = ShapeType::kBox, .extent = {kWidth, kWidth, kThickness}},
          .contact = true,
          .visible = false,
          .ground = true};
}

LiveSimulation::LiveSimulation(const SceneSpec& spec, const LiveSimulationOptions& options,
                               const State& start)
    : model_(withFloor(spec, options.floor)),
      options_(options),
      gravity_W_(options.gravity ? earthGravity() : Eigen::Vector3d::Zero()),
      world_(model_, {.gravity_W = gravity_W_, .friction = options.friction}),
      holder_(model_, options.hold, start.q, gravity_W_, kTau) {
  world_.setState(start);
}

void LiveSimulation::holdAt(const Eigen::VectorXd& q) {
  holder_ = Holder(model_, options_.hold, q, gravity_W_, kTau);
}

void LiveSimulation::advance(int milliseconds, const std::optional<Push>& push) {
  for (int k = 0; k < milliseconds; ++k) {
    const State now = world_.state();
    Eigen::VectorXd u = holder_.forces(now);
    if (push) {
      const BodyPoses poses = forwardKinematics(model_, now.q);
      u += positionJacobian(model_, poses, push->body, push->p_BQ).transpose() * push->force_W;
    }
    world_.setMotors(holder_.motors(u));
    world_.step(kTau);
  }
}

Energy LiveSimulation::energyNow() const {
  const State now = world_.state();
  return energy(model_, now.q, now.v, gravity_W_);
}

}  // namespace rex
