#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

Eigen::MatrixXd regularisedInverse(const Eigen::MatrixXd& J, const Eigen::MatrixXd& W, double precision) {
  // TODO: slide 2:29 with C = precision * Id. solve(A, B) gives the X with A X = B.
  return Eigen::MatrixXd::Zero(J.cols(), J.rows());
}

Eigen::MatrixXd nullspaceProjector(const Eigen::MatrixXd& J) {
  // TODO: what is J# J for infinite precision? svd(J) tells which directions of q change y at all.
  return Eigen::MatrixXd::Identity(J.cols(), J.cols());
}

Eigen::VectorXd multiTaskStep(const std::vector<TaskTerm>& tasks, const Eigen::MatrixXd& W) {
  // TODO: slides 2:47 and 2:48, with the step dq = q* - q0.
  return Eigen::VectorXd::Zero(W.rows());
}

std::vector<Eigen::VectorXd> circleWithTasks(Simulator& S, const std::string& hand,
                                             const Eigen::Vector3d& center, double radius,
                                             const std::string& pointing, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  std::vector<Eigen::VectorXd> postures;
  // TODO: T steps, each with three tasks at the present posture: the circle, pointing upwards, and the
  // posture of S before the first step. What is the Jacobian of q itself?
  return postures;
}

double sineProfile(double s) {
  // TODO: slide 2:40.
  return 0;
}

std::vector<Eigen::VectorXd> jointSpaceMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& qT, int T) {
  std::vector<Eigen::VectorXd> postures;
  // TODO: slide 2:41, step 2.
  return postures;
}

Eigen::VectorXd pegPosture(Simulator& S, const std::string& peg, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin) {
  S.setContactMargin(margin);
  // TODO: many multiTaskSteps. Each goes a small part of the way to the place and to the direction, and
  // drives S.kinematicsContacts(), whose Jacobian is S.jacobianContacts(), to zero.
  return S.getJointAngles();
}

std::vector<Eigen::VectorXd> taskSpaceMotion(Simulator& S, const std::string& peg,
                                             const Eigen::Vector3d& place, double margin, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  S.setContactMargin(margin);
  std::vector<Eigen::VectorXd> postures;
  // TODO: slide 2:42. At step t the peg should be at the interpolated place, pointing as at the start.
  return postures;
}

std::vector<Eigen::VectorXd> insertPeg(Simulator& S, const std::string& peg, const Eigen::Vector3d& inside,
                                       const Eigen::Vector3d& direction, double margin) {
  std::vector<Eigen::VectorXd> postures;
  // TODO: where should the peg be before it goes into the hole? Join the functions above.
  return postures;
}

Eigen::VectorXd priorityStep(const Eigen::MatrixXd& J1, const Eigen::VectorXd& dy1, const Eigen::MatrixXd& J2,
                             const Eigen::VectorXd& dy2) {
  // TODO: what does the first task demand? Which of the second's wishes is left then, and how does it
  // change with the motions that the first does not notice?
  return Eigen::VectorXd::Zero(J1.cols());
}

TaskMapValue jointLimits(const Simulator& S, double margin) {
  const Eigen::VectorXd q = S.getJointAngles(), low = S.getLowerLimits(), high = S.getUpperLimits();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(1);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(1, q.size());
  // TODO: slide 2:59. Which joints add to y, and how does y change when one of them turns?
  return {y, J};
}

TaskMapValue massCenter(const Simulator& S, const std::vector<BodyMass>& masses) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, S.getJointDimension());
  // TODO: slide 2:61. Check the unit of what it prints: is it one of a position?
  return {y, J};
}

TaskMapValue relativePosition(const Simulator& S, const std::string& body, const Eigen::Vector3d& inBody,
                              const std::string& frame, const Eigen::Vector3d& inFrame) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, S.getJointDimension());
  // TODO: slide 2:55. S.kinematicsVec gives the axes of the frame. Which of the factors change with q?
  return {y, J};
}

// What follows is given: the parts of the exercise one after another. show.cpp draws the pictures.
int main() {
  // Part 1: the task of the right hand, which takes three of the 27 joint angles.
  const Simulator man("man.ors");
  const Eigen::MatrixXd J = man.jacobianPos("handR"), N = nullspaceProjector(J);
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(N.rows(), N.cols());
  print("trace of N, which should be 27 - 3", N.trace());
  print("largest entry of J N, which should be 0", (J * N).cwiseAbs().maxCoeff());
  for (const double precision : {1., 1e2, 1e4, 1e6})
    print("largest entry of I - J J#, which should become less and less",
          (Eigen::Matrix3d::Identity() - J * regularisedInverse(J, W, precision)).cwiseAbs().maxCoeff());

  // Part 2: a long run on the circle, and three turns of it for the film.
  const Eigen::Vector3d center(-0.2, -0.4, 1.1);  // where the red ball is, metres
  Simulator longRun = man, turns = man;
  circleWithTasks(turns, "handR", center, 0.2, "handL", 380);
  showCircles(circleWithTasks(longRun, "handR", center, 0.2, "handL", 2000), turns, center);
  longRun.watch("circle_with_tasks_after_2000_steps");

  // Part 3: motion profiles. Then a posture with the peg above the hole, from a bent arm, and from above the
  // hole into it, in joint space and in task space. In the end the whole way from the bent arm.
  showProfiles();
  const Eigen::Vector3d hole(0, -1, 1), down(0, 0, -1);
  const double margin = 0.02;
  Simulator bent("pegInAHole.ors"), above = bent;
  above.setJointAngles(
      (Eigen::VectorXd(7) << 0.967552, -0.251879, -1.18846, 1.4825, 1.42033, 0.215273, -2.64193).finished());
  bent.setJointAngles(0.6 * above.getJointAngles());
  Simulator search = bent, straight = above, peg = bent;
  showPosture(pegPosture(search, "peg", {0, -1, 1.5}, down, margin));
  const Postures inTaskSpace = taskSpaceMotion(straight, "peg", hole, margin, 150);
  const Postures inJointSpace = jointSpaceMotion(above.getJointAngles(), straight.getJointAngles(), 150);
  const Figure contacts = showInterpolation(inJointSpace, inTaskSpace, hole, margin);
  showInsertion(bent, insertPeg(peg, "peg", hole, down, margin), contacts);

  // Part 4: a second wish pulls the right hand away from its circle.
  showPriority(center);

  // Part 5: the man on his own feet picks something up from the floor, with his balance in mind and without.
  showBalance({-0.15, -0.55, 0.1});
}
