#include <algorithm>
#include <cmath>

#include "exercise.h"
#include "kinematics/inverse_kinematics.h"

using namespace rex;

TaskValue lookAt(const Simulator& S, const std::string& body, const Eigen::Vector3d& gaze,
                 const Eigen::Vector3d& target) {
  // <solution lookAt>
  // The way to the target, as a unit vector, should be where the gaze points. The difference of two unit
  // vectors is zero only if they are equal, so looking away does not count.
  const Eigen::Vector3d way = target - S.kinematicsPos(body);
  const Eigen::Vector3d toTarget = way.normalized();
  // A move of the body turns the way: only the part across it counts, and less from far away.
  const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - toTarget * toTarget.transpose()) / way.norm();
  return {S.kinematicsVec(body, gaze) - toTarget, S.jacobianVec(body, gaze) + across * S.jacobianPos(body)};
  // <todo>
  //| // TODO: which world direction does the gaze have (S.kinematicsVec), and which should it have? Compare
  //| // them; the Jacobian follows from S.jacobianVec and S.jacobianPos.
  //| return {Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, S.getJointDimension())};
  // </solution>
}

TaskValue opposePalms(const Simulator& S, const std::string& left, const std::string& right,
                      const Eigen::Vector3d& palm) {
  // <solution opposePalms>
  // Opposite unit vectors add up to zero.
  return {S.kinematicsVec(left, palm) + S.kinematicsVec(right, palm),
          S.jacobianVec(left, palm) + S.jacobianVec(right, palm)};
  // <todo>
  //| // TODO: which function of the two palms' world directions (S.kinematicsVec) is zero only when they are
  //| // opposite? Its Jacobian follows from S.jacobianVec.
  //| return {Eigen::Vector3d::Zero(), Eigen::MatrixXd::Zero(3, S.getJointDimension())};
  // </solution>
}

TaskValue distanceToGoal(const Simulator& S, const std::string& body, const Eigen::Vector3d& goal) {
  // <solution distanceToGoal>
  // Half the squared distance has a derivative everywhere; the distance itself has none at the goal.
  const Eigen::Vector3d away = S.kinematicsPos(body) - goal;
  return {Eigen::VectorXd::Constant(1, 0.5 * away.squaredNorm()), away.transpose() * S.jacobianPos(body)};
  // <todo>
  //| // TODO: one number that is zero only at the goal, and its derivative by the chain rule (1 x n).
  //| return {Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Zero(1, S.getJointDimension())};
  // </solution>
}

Eigen::VectorXd ikStep(const Eigen::MatrixXd& J, const Eigen::VectorXd& dy, double sigma) {
  // <solution ikStep>
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(J.cols(), J.cols());
  return solve(J.transpose() * J + sigma * sigma * W, J.transpose() * dy);
  // <todo>
  //| // TODO: slide 2:29. solve(A, b) gives the x with A x = b.
  //| return Eigen::VectorXd::Zero(J.cols());
  // </solution>
}

std::vector<Eigen::VectorXd> smallSteps(Simulator& S, const std::string& body, const Eigen::Vector3d& target,
                                        double alpha, double sigma, int steps) {
  std::vector<Eigen::VectorXd> postures;
  for (int t = 1; t <= steps; ++t) {
    // <solution smallSteps>
    // Where the hand is and how it can move change with every step: both are asked for anew.
    const Eigen::VectorXd q = S.getJointAngles();
    S.setJointAngles(q + alpha * ikStep(S.jacobianPos(body), target - S.kinematicsPos(body), sigma));
    postures.push_back(S.getJointAngles());
    // <todo>
    //| // TODO: one step from the posture in which S is now; move S there, and keep the new posture.
    // </solution>
  }
  return postures;
}

std::vector<Eigen::VectorXd> straightLine(Simulator& S, const std::string& body,
                                          const Eigen::Vector3d& target, double sigma, int T) {
  std::vector<Eigen::VectorXd> postures;
  // <solution straightLine>
  const Eigen::Vector3d start = S.kinematicsPos(body);
  for (int t = 1; t <= T; ++t) {
    const double share = static_cast<double>(t) / T;
    const Eigen::Vector3d wanted = start + share * (target - start);
    S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), sigma));
    postures.push_back(S.getJointAngles());
  }
  // <todo>
  //| // TODO: T steps as above, but at step t the hand should be where a target is that moves along the
  //| // straight line to `target`: where is it at step t?
  // </solution>
  return postures;
}

std::vector<Eigen::VectorXd> circle(Simulator& S, const std::string& body, const Eigen::Vector3d& center,
                                    double radius, double sigma, int T) {
  std::vector<Eigen::VectorXd> postures;
  for (int t = 1; t <= T; ++t) {
    // <solution circle>
    const double angle = t / 20.;
    const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(angle), 0, std::sin(angle));
    S.setJointAngles(S.getJointAngles() + ikStep(S.jacobianPos(body), wanted - S.kinematicsPos(body), sigma));
    postures.push_back(S.getJointAngles());
    // <todo>
    //| // TODO: where on the circle should the hand be at step t? Step there.
    // </solution>
  }
  return postures;
}

// From here on everything is given: the parts of the exercise one after another, with pictures. Change it as
// you like.

namespace {

const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1);  // where the red ball is
constexpr double kSigma = 0.01;

// |y - wanted| before the first step and after each, where wanted(t) is the place for step t.
template <class Wanted>
std::vector<double> trackingErrors(const std::vector<Eigen::VectorXd>& postures, const Wanted& wanted) {
  Simulator S("man.ors");
  std::vector<double> errors = {(S.kinematicsPos("handR") - wanted(0)).norm()};
  for (std::size_t t = 0; t < postures.size(); ++t) {
    S.setJointAngles(postures[t]);
    errors.push_back((S.kinematicsPos("handR") - wanted(static_cast<int>(t) + 1)).norm());
  }
  return errors;
}

Eigen::Vector3d onCircle(int t) {
  return kTarget + 0.2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
}

std::vector<Eigen::Vector3d> wholeCircle() {
  std::vector<Eigen::Vector3d> points;
  for (int t = 0; t <= 126; ++t) points.push_back(onCircle(t));
  return points;
}

// A logarithmic axis has no zero.
std::vector<double> positive(std::vector<double> values) {
  for (double& value : values) value = std::max(value, 1e-16);
  return values;
}

void showTaskMaps() {
  const Simulator S("man.ors");
  const Eigen::Vector3d forward(0, -1, 0), palm(0, 1, 0);
  print("lookAt: y", lookAt(S, "head", forward, kTarget).y);
  print("opposePalms: y", opposePalms(S, "handL", "handR", palm).y);
  print("distanceToGoal: y", distanceToGoal(S, "handR", kTarget).y);
}

}  // namespace

int main() {
  showTaskMaps();

  // 12.3.2 a, b, c: the task error after each step. Once your own steps work, they lie on the library's.
  const auto atTarget = [](int) { return kTarget; };
  Simulator full("man.ors"), small("man.ors"), line("man.ors"), library("man.ors");
  const std::vector<double> fullErrors =
      trackingErrors(smallSteps(full, "handR", kTarget, 1, kSigma, 8), atTarget);
  const std::vector<double> smallErrors =
      trackingErrors(smallSteps(small, "handR", kTarget, 0.1, kSigma, 100), atTarget);
  const std::vector<double> lineErrors =
      trackingErrors(straightLine(line, "handR", kTarget, kSigma, 100), atTarget);
  std::vector<Eigen::VectorXd> libraryPostures;
  for (int t = 0; t < 100; ++t) {
    const Eigen::VectorXd dy = kTarget - library.kinematicsPos("handR");
    library.setJointAngles(library.getJointAngles() +
                           0.1 * inverseKinematicsStep(library.jacobianPos("handR"), dy, kSigma));
    libraryPostures.push_back(library.getJointAngles());
  }
  plot("errors",
       {.title = "Distance of the right hand from its target",
        .xLabel = "step",
        .yLabel = "task error [m]",
        .logY = true,
        .legend = Legend::kBottomRight,
        .series = {{.label = "full steps", .y = positive(fullErrors), .style = SeriesStyle::kLinesPoints},
                   {.label = "steps of a tenth", .y = positive(smallErrors)},
                   {.label = "steps of a tenth, library",
                    .y = positive(trackingErrors(libraryPostures, atTarget)),
                    .dashed = true},
                   {.label = "target moved along a line", .y = positive(lineErrors)}}});
  writeVideo(line, "line", {.caption = "12.3.2 c: along a straight line", .traces = {"handR"}});

  // 12.3.2 d: three turns of the circle, and what a long run does to the posture.
  Simulator turning("man.ors");
  const std::vector<Eigen::VectorXd> turns = circle(turning, "handR", kTarget, 0.2, kSigma, 380);
  const PictureOptions turningLook{
      .caption = "12.3.2 d: a circle of radius 0.2 m", .traces = {"handR"}, .paths = {wholeCircle()}};
  writeVideo(turning, "circle", turningLook);
  const Figure turnErrors{.title = "The first three turns",
                          .xLabel = "step",
                          .yLabel = "tracking error [m]",
                          .logY = true,
                          .series = {{.y = positive(trackingErrors(turns, onCircle))}}};
  Simulator longRun("man.ors");
  const std::vector<Eigen::VectorXd> postures = circle(longRun, "handR", kTarget, 0.2, kSigma, 2000);
  std::vector<double> drift = {0};
  for (const Eigen::VectorXd& q : postures) drift.push_back(q.norm());
  const Figure errors{.title = "Following the circle",
                      .xLabel = "step",
                      .yLabel = "tracking error [m]",
                      .logY = true,
                      .series = {{.y = positive(trackingErrors(postures, onCircle))}}};
  const Figure posture{.title = "How far the posture wanders while the hand circles",
                       .xLabel = "step",
                       .yLabel = "length of q [rad]",
                       .series = {{.y = drift}}};
  plot("circle", errors);
  plot("posture", posture);
  writeReplay(turning, "circle", turningLook, {turnErrors, errors, posture});
  longRun.watch("posture_after_2000_steps");
}
