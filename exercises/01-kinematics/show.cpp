#include "show.h"

#include <algorithm>
#include <cmath>

#include "kinematics/inverse_kinematics.h"

using namespace rex;

namespace {

// |y - wanted| before the first step and after each, where wanted(t) is the position for step t. A
// logarithmic axis cannot show zero.
template <class Wanted>
std::vector<double> trackingErrors(const Postures& motion, const Wanted& wanted) {
  Simulator S("man.ors");
  std::vector<double> errors;
  const auto add = [&] {
    const Eigen::Vector3d missing = S.kinematicsPos("handR") - wanted(static_cast<int>(errors.size()));
    errors.push_back(std::max(missing.norm(), 1e-16));
  };
  add();
  for (const Eigen::VectorXd& posture : motion) {
    S.setJointAngles(posture);
    add();
  }
  return errors;
}

Postures stepsOfTheLibrary(const Eigen::Vector3d& target) {
  Simulator S("man.ors");
  Postures motion;
  for (int t = 0; t < 100; ++t) {
    const Eigen::VectorXd dy = target - S.kinematicsPos("handR");
    motion.push_back(S.getJointAngles() + 0.1 * inverseKinematicsStep(S.jacobianPos("handR"), dy, 0.01));
    S.setJointAngles(motion.back());
  }
  return motion;
}

}  // namespace

void showReaching(const Postures& fullSteps, const Postures& tenths, const Postures& line,
                  const Eigen::Vector3d& goal) {
  const auto errors = [&](const Postures& motion) {
    return trackingErrors(motion, [&](int) { return goal; });
  };
  plot("errors",
       {.title = "Distance of the right hand from its target",
        .xLabel = "step",
        .yLabel = "task error [m]",
        .logY = true,
        .legend = Legend::kBottomRight,
        .series = {
            {.label = "full steps", .y = errors(fullSteps), .style = SeriesStyle::kLinesPoints},
            {.label = "steps of a tenth", .y = errors(tenths)},
            {.label = "steps of a tenth, library", .y = errors(stepsOfTheLibrary(goal)), .dashed = true},
            {.label = "target moved along a line", .y = errors(line)}}});
}

void showCircle(const Simulator& turns, const Postures& longRun, const Eigen::Vector3d& center) {
  const auto onCircle = [&](int t) -> Eigen::Vector3d {
    return center + 0.2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  std::vector<Eigen::Vector3d> wholeCircle;
  for (int t = 0; t <= 126; ++t) wholeCircle.push_back(onCircle(t));
  Figure errors{.title = "Following the circle",
                .xLabel = "step",
                .yLabel = "tracking error [m]",
                .logY = true,
                .series = {{.y = trackingErrors(longRun, onCircle)}}};
  std::vector<double> drift = {0};
  for (const Eigen::VectorXd& q : longRun) drift.push_back(q.norm());
  const Figure posture{.title = "How far the posture wanders while the hand circles",
                       .xLabel = "step",
                       .yLabel = "length of q [rad]",
                       .series = {{.y = drift}}};
  plot("circle", errors);
  plot("posture", posture);

  Figure firstTurns = errors;
  firstTurns.title = "The first three turns";
  std::vector<double>& y = firstTurns.series[0].y;
  y.resize(std::min<std::size_t>(y.size(), 381));
  const PictureOptions look{
      .caption = "12.3.2 d: a circle of radius 0.2 m", .traces = {"handR"}, .paths = {wholeCircle}};
  writeVideo(turns, "circle", look);
  writeReplay(turns, "circle", look, {firstTurns, errors, posture});
}
