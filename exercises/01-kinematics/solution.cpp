#include <cmath>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

TaskMapValue lookAt(const Simulator& S, const std::string& body, const Eigen::Vector3d& gaze,
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

TaskMapValue opposePalms(const Simulator& S, const std::string& left, const std::string& right,
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

TaskMapValue distanceToGoal(const Simulator& S, const std::string& body, const Eigen::Vector3d& goal) {
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

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: the values of the task maps where the robot starts, and of the last one where its task is
  // fulfilled.
  const Simulator S("man.ors");
  const Eigen::Vector3d target(-0.2, -0.4, 1.1);  // where the red ball is, metres
  const Eigen::Vector3d forward(0, -1, 0), palm(0, 1, 0);
  print("lookAt: y", lookAt(S, "head", forward, target).y);
  print("opposePalms: y", opposePalms(S, "handL", "handR", palm).y);
  print("distanceToGoal: y", distanceToGoal(S, "handR", target).y);
  print("distanceToGoal: y at the goal, which should be 0",
        distanceToGoal(S, "handR", S.kinematicsPos("handR")).y);

  // Part 2: one full step promises nearly all of dy, because sigma is small.
  const double sigma = 0.01;
  const Eigen::MatrixXd J = S.jacobianPos("handR");
  const Eigen::Vector3d dy = target - S.kinematicsPos("handR");
  print("dy", dy);
  print("J dq, which should be nearly dy", J * ikStep(J, dy, sigma));

  // Part 3, 12.3.2 a, b, c: three ways to the target.
  Simulator full = S, small = S, line = S;
  showReaching(smallSteps(full, "handR", target, 1, sigma, 8),
               smallSteps(small, "handR", target, 0.1, sigma, 100),
               straightLine(line, "handR", target, sigma, 100), target);
  writeVideo(line, "line", {.caption = "12.3.2 c: along a straight line", .traces = {"handR"}});

  // 12.3.2 d: three turns of a circle, and what a long run does to the posture.
  Simulator turns = S, longRun = S;
  circle(turns, "handR", target, 0.2, sigma, 380);
  showCircle(turns, circle(longRun, "handR", target, 0.2, sigma, 2000), target);
  longRun.watch("posture_after_2000_steps");
}
