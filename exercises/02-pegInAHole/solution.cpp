#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

Eigen::MatrixXd regularisedInverse(const Eigen::MatrixXd& J, const Eigen::MatrixXd& W, double precision) {
  // <solution regularisedInverse>
  return solve(precision * J.transpose() * J + W, precision * J.transpose());
  // <todo>
  //| // TODO: slide 2:29 with C = precision * Id. solve(A, B) gives the X with A X = B.
  //| return Eigen::MatrixXd::Zero(J.cols(), J.rows());
  // </solution>
}

Eigen::MatrixXd nullspaceProjector(const Eigen::MatrixXd& J) {
  // <solution nullspaceProjector>
  // The columns of V with a singular value span what J sees; the projector takes that away.
  const SingularValues parts = svd(J);
  Eigen::MatrixXd N = Eigen::MatrixXd::Identity(J.cols(), J.cols());
  for (Eigen::Index i = 0; i < parts.s.size(); ++i)
    if (parts.s[i] > 1e-9 * parts.s[0]) N -= parts.V.col(i) * parts.V.col(i).transpose();
  return N;
  // <todo>
  //| // TODO: what is J# J for infinite precision? svd(J) tells which directions of q change y at all.
  //| return Eigen::MatrixXd::Identity(J.cols(), J.cols());
  // </solution>
}

Eigen::VectorXd multiTaskStep(const std::vector<TaskTerm>& tasks, const Eigen::MatrixXd& W) {
  // <solution multiTaskStep>
  // The big task Phi of slide 2:47 never has to be built: only its products are needed.
  Eigen::MatrixXd A = W;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(W.rows());
  for (const TaskTerm& task : tasks) {
    A += task.precision * task.J.transpose() * task.J;
    b -= task.precision * task.J.transpose() * task.error;
  }
  return solve(A, b);
  // <todo>
  //| // TODO: slides 2:47 and 2:48, with the step dq = q* - q0.
  //| return Eigen::VectorXd::Zero(W.rows());
  // </solution>
}

std::vector<Eigen::VectorXd> circleWithTasks(Simulator& S, const std::string& hand,
                                             const Eigen::Vector3d& center, double radius,
                                             const std::string& pointing, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  std::vector<Eigen::VectorXd> postures;
  // <solution circleWithTasks>
  const Eigen::VectorXd home = S.getJointAngles();
  for (int k = 1; k <= T; ++k) {
    const Eigen::Vector3d wanted = center + radius * Eigen::Vector3d(std::cos(k / 20.), 0, std::sin(k / 20.));
    const Eigen::VectorXd q = S.getJointAngles();
    const TaskTerm circle{S.kinematicsPos(hand) - wanted, S.jacobianPos(hand), 1e4};
    const TaskTerm up{S.kinematicsVec(pointing) - Eigen::Vector3d::UnitZ(), S.jacobianVec(pointing), 100};
    // The posture itself is a task map, too: its Jacobian is the identity.
    const TaskTerm stayAtHome{q - home, W, 0.01};
    S.setJointAngles(q + multiTaskStep({circle, up, stayAtHome}, W));
    postures.push_back(S.getJointAngles());
  }
  // <todo>
  //| // TODO: T steps, each with three tasks at the present posture: the circle, pointing upwards, and the
  //| // posture of S before the first step. What is the Jacobian of q itself?
  // </solution>
  return postures;
}

double sineProfile(double s) {
  // <solution sineProfile>
  return 0.5 * (1 - std::cos(std::numbers::pi * s));
  // <todo>
  //| // TODO: slide 2:40.
  //| return 0;
  // </solution>
}

std::vector<Eigen::VectorXd> jointSpaceMotion(const Eigen::VectorXd& q0, const Eigen::VectorXd& qT, int T) {
  std::vector<Eigen::VectorXd> postures;
  // <solution jointSpaceMotion>
  for (int t = 1; t <= T; ++t) postures.push_back(q0 + sineProfile(static_cast<double>(t) / T) * (qT - q0));
  // <todo>
  //| // TODO: slide 2:41, step 2.
  // </solution>
  return postures;
}

Eigen::VectorXd pegPosture(Simulator& S, const std::string& peg, const Eigen::Vector3d& place,
                           const Eigen::Vector3d& direction, double margin) {
  S.setContactMargin(margin);
  // <solution pegPosture>
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < 1000; ++i) {
    // A fiftieth of the way at a time: the linearisation holds, and contacts have time to steer around.
    const TaskTerm there{0.02 * (S.kinematicsPos(peg) - place), S.jacobianPos(peg), 1e4};
    const TaskTerm straight{0.02 * (S.kinematicsVec(peg) - direction), S.jacobianVec(peg), 1e4};
    const TaskTerm apart{S.kinematicsContacts(), S.jacobianContacts(), 100};
    S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight, apart}, W));
  }
  // <todo>
  //| // TODO: many multiTaskSteps. Each goes a small part of the way to the place and to the direction, and
  //| // drives S.kinematicsContacts(), whose Jacobian is S.jacobianContacts(), to zero.
  // </solution>
  return S.getJointAngles();
}

std::vector<Eigen::VectorXd> taskSpaceMotion(Simulator& S, const std::string& peg,
                                             const Eigen::Vector3d& place, double margin, int T) {
  const int n = S.getJointDimension();
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  S.setContactMargin(margin);
  std::vector<Eigen::VectorXd> postures;
  // <solution taskSpaceMotion>
  const Eigen::Vector3d start = S.kinematicsPos(peg), direction = S.kinematicsVec(peg);
  for (int k = 1; k <= T; ++k) {
    const Eigen::Vector3d wanted = start + sineProfile(static_cast<double>(k) / T) * (place - start);
    const TaskTerm there{S.kinematicsPos(peg) - wanted, S.jacobianPos(peg), 1e4};
    const TaskTerm straight{S.kinematicsVec(peg) - direction, S.jacobianVec(peg), 1e4};
    const TaskTerm apart{S.kinematicsContacts(), S.jacobianContacts(), 100};
    S.setJointAngles(S.getJointAngles() + multiTaskStep({there, straight, apart}, W));
    postures.push_back(S.getJointAngles());
  }
  // <todo>
  //| // TODO: slide 2:42. At step t the peg should be at the interpolated place, pointing as at the start.
  // </solution>
  return postures;
}

std::vector<Eigen::VectorXd> insertPeg(Simulator& S, const std::string& peg, const Eigen::Vector3d& inside,
                                       const Eigen::Vector3d& direction, double margin) {
  std::vector<Eigen::VectorXd> postures;
  // <solution insertPeg>
  // Above the hole first, in joint space, with steps far below the limit; then straight down.
  const Eigen::VectorXd start = S.getJointAngles();
  Simulator search = S;
  const Eigen::VectorXd above = pegPosture(search, peg, inside - 0.6 * direction, direction, margin);
  postures = jointSpaceMotion(start, above, 200);
  S.setJointAngles(above);
  const std::vector<Eigen::VectorXd> down = taskSpaceMotion(S, peg, inside, margin, 200);
  postures.insert(postures.end(), down.begin(), down.end());
  // <todo>
  //| // TODO: where should the peg be before it goes into the hole? Join the functions above.
  // </solution>
  return postures;
}

Eigen::VectorXd priorityStep(const Eigen::MatrixXd& J1, const Eigen::VectorXd& dy1, const Eigen::MatrixXd& J2,
                             const Eigen::VectorXd& dy2) {
  // <solution priorityStep>
  const double smallest = 1e-9 * std::max(svd(J1).s[0], svd(J2).s[0]);
  const auto pseudoInverse = [&](const Eigen::MatrixXd& J) {
    const SingularValues parts = svd(J);
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(J.cols(), J.rows());
    for (Eigen::Index i = 0; i < parts.s.size(); ++i)
      if (parts.s[i] > smallest) inverse += parts.V.col(i) * parts.U.col(i).transpose() / parts.s[i];
    return inverse;
  };
  // What the first task demands, and then in its nullspace only what is still missing of the second: there
  // the second sees joints through J2 N1, not through J2, and this is what has to be inverted.
  const Eigen::VectorXd first = pseudoInverse(J1) * dy1;
  return first + pseudoInverse(J2 * nullspaceProjector(J1)) * (dy2 - J2 * first);
  // <todo>
  //| // TODO: what does the first task demand? Which of the second's wishes is left then, and how does it
  //| // change with the motions that the first does not notice?
  //| return Eigen::VectorXd::Zero(J1.cols());
  // </solution>
}

TaskMapValue jointLimits(const Simulator& S, double margin) {
  const Eigen::VectorXd q = S.getJointAngles(), low = S.getLowerLimits(), high = S.getUpperLimits();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(1);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(1, q.size());
  // <solution jointLimits>
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double below = margin - q[i] + low[i], above = margin + q[i] - high[i];
    if (below > 0) {
      y[0] += below / margin;
      J(0, i) -= 1 / margin;
    }
    if (above > 0) {
      y[0] += above / margin;
      J(0, i) += 1 / margin;
    }
  }
  // <todo>
  //| // TODO: slide 2:59. Which joints add to y, and how does y change when one of them turns?
  // </solution>
  return {y, J};
}

TaskMapValue massCenter(const Simulator& S, const std::vector<BodyMass>& masses) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, S.getJointDimension());
  // <solution massCenter>
  double total = 0;
  for (const BodyMass& one : masses) {
    y += one.mass * S.kinematicsPos(one.body, one.center);
    J += one.mass * S.jacobianPos(one.body, one.center);
    total += one.mass;
  }
  y /= total;
  J /= total;
  // <todo>
  //| // TODO: slide 2:61. Check the unit of what it prints: is it one of a position?
  // </solution>
  return {y, J};
}

TaskMapValue relativePosition(const Simulator& S, const std::string& body, const Eigen::Vector3d& inBody,
                              const std::string& frame, const Eigen::Vector3d& inFrame) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(3);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, S.getJointDimension());
  // <solution relativePosition>
  // R^T d consists of the scalar products of d with the axes of the frame. Both factors move.
  const Eigen::Vector3d d = S.kinematicsPos(body, inBody) - S.kinematicsPos(frame, inFrame);
  const Eigen::MatrixXd moves = S.jacobianPos(body, inBody) - S.jacobianPos(frame, inFrame);
  for (const int k : {0, 1, 2}) {
    const Eigen::Vector3d axis = S.kinematicsVec(frame, Eigen::Vector3d::Unit(k));
    y[k] = axis.dot(d);
    J.row(k) = axis.transpose() * moves + d.transpose() * S.jacobianVec(frame, Eigen::Vector3d::Unit(k));
  }
  // <todo>
  //| // TODO: slide 2:55. S.kinematicsVec gives the axes of the frame. Which of the factors change with q?
  // </solution>
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
