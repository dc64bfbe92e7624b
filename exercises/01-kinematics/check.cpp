#include "grading/check.h"

#include <cmath>
#include <numbers>

#include "interface.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// A robot to ask about: a scene, a body and a random posture of it.
struct Robot {
  Simulator S;
  std::string body;
  std::string other;  // a second body, for maps of two
};

const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1);
constexpr double kSigma = 0.01;
// Values below this count as zero: maps through an arc cosine have only half of the digits at their zero.
constexpr double kZero = 1e-6;
// A map that is not zero says so with at least this much: 1 - cos of 0.3 rad is 0.04.
constexpr double kNotZero = 1e-3;

Simulator inRandomPosture(Simulator S, Rng& rng, double spread) {
  S.setJointAngles(S.getJointAngles() + spread * rng.normalVector(S.getJointDimension()));
  return S;
}

Robot man(Rng& rng) { return {inRandomPosture(Simulator("man.ors"), rng, 0.3), "handR", "handL"}; }
Robot arm(Rng& rng) { return {inRandomPosture(Simulator("pegInAHole.ors"), rng, 0.7), "peg", "arm3"}; }

Eigen::Vector3d randomDirection(Rng& rng) { return rng.normalVector(3).normalized(); }

std::string describe(const Robot& robot, const std::string& body) {
  return robot.S.description().sceneName + ", body '" + body + "', random posture";
}

Simulator at(const Simulator& S, const Eigen::VectorXd& q) {
  SimulatorDescription description = S.description();
  description.q = q;
  return Simulator(description);
}

using Map = std::function<TaskValue(const SimulatorDescription&)>;

// y and J fit together, and y does change with q.
void checkJacobianOf(Check& check, const Simulator& S, const Map& map) {
  const TaskValue value = map(S.description());
  check.that("y has at least one entry", value.y.size() > 0);
  check.shape("y", value.y, value.y.size(), 1);
  check.shape("J", value.J, value.y.size(), S.getJointDimension());
  const VectorFunction f = [&](const Eigen::VectorXd& q) {
    const TaskValue there = map(at(S, q).description());
    check.shape("y", there.y, value.y.size(), 1);
    return there.y;
  };
  const Eigen::MatrixXd numeric = numericJacobian(f, S.getJointAngles());
  check.that("y changes when the robot moves", numeric.cwiseAbs().maxCoeff() > kNotZero);
  check.near("J against numeric differences of y", value.J, numeric,
             1e-5 * (1 + numeric.cwiseAbs().maxCoeff()));
}

double sizeOf(Check& check, const TaskValue& value) {
  check.that("y has at least one entry", value.y.size() > 0);
  check.shape("y", value.y, value.y.size(), 1);
  return value.y.cwiseAbs().maxCoeff();
}

// The three maps, for any robot.

void lookAtIsZeroAtTheTarget(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d gaze = randomDirection(check.rng());
  const Eigen::Vector3d eye = robot.S.kinematicsPos(robot.body),
                        seen = robot.S.kinematicsVec(robot.body, gaze);
  const Eigen::Vector3d aside = seen.cross(randomDirection(check.rng())).normalized();
  const auto size = [&](const Eigen::Vector3d& target) {
    return sizeOf(check, student.lookAt(robot.S.description(), robot.body, gaze, target));
  };
  check.input(describe(robot, robot.body));
  check.atMost("|y| with the target 1.3 m ahead of the gaze", size(eye + 1.3 * seen), kZero);
  check.atLeast("|y| with the target straight behind", size(eye - 1.3 * seen), kNotZero);
  check.atLeast("|y| with the target 30 degrees beside the gaze",
                size(eye + std::cos(0.52) * seen + std::sin(0.52) * aside), kNotZero);
  check.atLeast("|y| with the target at a right angle to the gaze", size(eye + aside), kNotZero);
}

void lookAtJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d gaze = randomDirection(check.rng());
  const Eigen::Vector3d target =
      robot.S.kinematicsPos(robot.body) + check.rng().uniform(0.5, 2) * randomDirection(check.rng());
  check.input(describe(robot, robot.body));
  checkJacobianOf(check, robot.S,
                  [&](const SimulatorDescription& S) { return student.lookAt(S, robot.body, gaze, target); });
}

// Palm vectors for which two hands in a given posture point in opposite, in the same, and in any directions:
// with R = R_left^T R_right, a vector v is opposite if R v = -v and equal if R v = v, its axis.
void opposePalmsIsZeroWhenOpposite(Check& check, Student& student, const Robot& robot) {
  const auto size = [&](const std::string& left, const std::string& right, const Eigen::Vector3d& palm) {
    return sizeOf(check, student.opposePalms(robot.S.description(), left, right, palm));
  };
  const auto frame = [&](const std::string& body) {
    Eigen::Matrix3d R;
    for (int i = 0; i < 3; ++i) R.col(i) = robot.S.kinematicsVec(body, Eigen::Vector3d::Unit(i));
    return R;
  };
  const Eigen::Matrix3d R = frame(robot.body).transpose() * frame(robot.other);
  const Eigen::Vector3d axis =
      Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)).normalized();
  check.input(describe(robot, robot.body));
  check.atLeast("|y| for palms in the same direction", size(robot.body, robot.other, axis), kNotZero);
  check.atLeast("|y| for one and the same hand", size(robot.body, robot.body, randomDirection(check.rng())),
                kNotZero);
  // A posture with opposite palms exists for every hand: turn it half around an axis across the palm. The
  // scene says so.
  const SimulatorDescription clapping{.sceneName = "two hands",
                                      .sceneText = R"(
    body post {}
    body left { mass=1 }
    body right { mass=1 }
    joint (post left) { A=<T t(0 .2 1) d(20 0 1 0)> B=<T t(0 0 .3)> }
    joint (post right) { A=<T t(0 -.2 1) d(20 0 1 0)> B=<T t(0 0 .3)> })",
                                      .q = {}};
  const double angle = check.rng().uniform(-2, 2);
  const auto clap = [&](double between) {
    SimulatorDescription S = clapping;
    S.q = Eigen::Vector2d(angle, angle + between);
    return sizeOf(check, student.opposePalms(S, "left", "right", Eigen::Vector3d::UnitZ()));
  };
  check.input("two hands that turn about parallel axes");
  check.atMost("|y| for palms in opposite directions", clap(std::numbers::pi), kZero);
  check.atLeast("|y| for palms 30 degrees from opposite", clap(std::numbers::pi - 0.52), kNotZero);
  check.atLeast("|y| for palms at a right angle", clap(std::numbers::pi / 2), kNotZero);
}

void opposePalmsJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d palm = randomDirection(check.rng());
  check.input(describe(robot, robot.body));
  checkJacobianOf(check, robot.S, [&](const SimulatorDescription& S) {
    return student.opposePalms(S, robot.other, robot.body, palm);
  });
}

void distanceIsZeroAtTheGoal(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d here = robot.S.kinematicsPos(robot.body);
  const auto value = [&](const Eigen::Vector3d& goal) {
    const TaskValue there = student.distanceToGoal(robot.S.description(), robot.body, goal);
    check.shape("y", there.y, 1, 1);
    check.shape("J", there.J, 1, robot.S.getJointDimension());
    return std::abs(there.y[0]);
  };
  check.input(describe(robot, robot.body));
  check.atMost("|y| at the goal", value(here), kZero);
  check.atLeast("|y| half a metre from the goal", value(here + 0.5 * randomDirection(check.rng())), kNotZero);
  check.atLeast("|y| beside the goal along x", value(here + Eigen::Vector3d(0.3, 0, 0)), kNotZero);
  check.atLeast("|y| beside the goal along y", value(here - Eigen::Vector3d(0, 0.3, 0)), kNotZero);
  check.atLeast("|y| beside the goal along z", value(here + Eigen::Vector3d(0, 0, 0.3)), kNotZero);
}

void distanceJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d goal =
      robot.S.kinematicsPos(robot.body) + check.rng().uniform(0.2, 1) * randomDirection(check.rng());
  check.input(describe(robot, robot.body));
  checkJacobianOf(check, robot.S,
                  [&](const SimulatorDescription& S) { return student.distanceToGoal(S, robot.body, goal); });
}

using MapCheck = void (*)(Check&, Student&, const Robot&);

auto onTheMan(MapCheck run) {
  return [run](Check& check, Student& student) {
    for (int i = 0; i < 2; ++i) run(check, student, man(check.rng()));
  };
}

// One step.

// The minimum of |J dq - dy|^2 + sigma^2 |dq|^2 is where its gradient vanishes.
void isTheMinimum(Check& check, Student& student, const Eigen::MatrixXd& J, const Eigen::VectorXd& dy,
                  double sigma) {
  const Eigen::VectorXd dq = student.ikStep(J, dy, sigma);
  check.shape("dq", dq, J.cols(), 1);
  const Eigen::VectorXd gradient = J.transpose() * (J * dq - dy) + sigma * sigma * dq;
  // Relative to what the two terms amount to for a step of this size; solving the normal equations costs
  // digits.
  const double scale = (J.transpose() * dy).norm() + J.squaredNorm() * dq.norm();
  check.atMost("gradient of the cost at dq, relative", gradient.norm() / scale, 1e-9);
}

void stepOfTheHand(Check& check, Student& student) {
  check.forEachCase(4, [&](int) {
    const Robot robot = man(check.rng());
    check.input("Jacobian of the right hand in a random posture, a change of 0.3 m, sigma 0.01");
    isTheMinimum(check, student, robot.S.jacobianPos("handR"), 0.3 * randomDirection(check.rng()), kSigma);
  });
}

void stepOfAnySize(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    Rng& rng = check.rng();
    const int d = 1 + rng.index(8), n = 1 + rng.index(20);
    const Eigen::MatrixXd J = rng.normalVector(d * n).reshaped(d, n);
    isTheMinimum(check, student, J, rng.normalVector(d), std::pow(10, rng.uniform(-2, 0.5)));
  });
}

// The planar arm stretched out: no step moves its tip along the arm, and J J^T has no inverse.
void stepAtASingularity(Check& check, Student& student) {
  const Simulator S("pegArm.ors");
  const Eigen::MatrixXd J = S.jacobianPos("peg");
  const Eigen::Vector3d along = S.kinematicsVec("peg");
  check.input("pegArm.ors stretched out (q = 0), a change of 0.3 m along the arm or out of its plane");
  for (const Eigen::Vector3d& direction :
       {along, Eigen::Vector3d(1, 0, 0), Eigen::Vector3d((along + Eigen::Vector3d(1, 0, 0)) / 2)}) {
    const Eigen::VectorXd dq = student.ikStep(J, 0.3 * direction, kSigma);
    check.shape("dq", dq, 3, 1);
    check.atMost("length of dq for a change no joint can make", dq.norm(), 1e-6, "rad");
  }
  check.input("pegArm.ors stretched out (q = 0), a change of 0.3 m across the arm");
  isTheMinimum(check, student, J, Eigen::Vector3d(0, 0, 0.3), kSigma);
}

// Motions.

Eigen::Vector3d placeAt(const Simulator& S, const std::string& body, const Eigen::VectorXd& q) {
  return at(S, q).kinematicsPos(body);
}

using Motion = std::vector<Eigen::VectorXd>;

// As many postures as asked for, each of n finite numbers.
void checkPostures(Check& check, const Motion& motion, int count, int n) {
  check.near("number of postures", static_cast<double>(motion.size()), count, 0);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, n, 1);
}

struct ErrorAfter {
  int step;
  double error;
};

void errorSequence(Check& check, Student& student, double alpha, int steps,
                   const std::vector<ErrorAfter>& known) {
  const Simulator S("man.ors");
  check.input("man.ors, handR to (-0.2, -0.4, 1.1), sigma 0.01, alpha " +
              std::string(alpha == 1 ? "1" : "0.1"));
  const Motion motion = student.smallSteps(S.description(), "handR", kTarget, alpha, kSigma, steps);
  checkPostures(check, motion, steps, S.getJointDimension());
  for (const auto& [step, error] : known) {
    const double got = (placeAt(S, "handR", motion[static_cast<std::size_t>(step) - 1]) - kTarget).norm();
    check.near("task error after step " + std::to_string(step), got, error, 1e-4 + 1e-3 * error, "m");
  }
}

void fullSteps(Check& check, Student& student) {
  errorSequence(check, student, 1, 6, {{1, 0.1750}, {2, 0.0297}, {3, 0.0015}, {4, 4e-6}});
}

void stepsOfATenth(Check& check, Student& student) {
  errorSequence(check, student, 0.1, 100, {{1, 0.3041}, {10, 0.1179}, {50, 0.0018}, {100, 9e-6}});
}

// The largest distance from where the body should be at each step from `first` on.
double largestError(const Simulator& S, const std::string& body, const Motion& motion, int first,
                    const std::function<Eigen::Vector3d(int)>& wanted) {
  double largest = 0;
  for (int t = first; t <= static_cast<int>(motion.size()); ++t) {
    largest =
        std::max(largest, (placeAt(S, body, motion[static_cast<std::size_t>(t) - 1]) - wanted(t)).norm());
  }
  return largest;
}

void followsTheLine(Check& check, Student& student, const Simulator& S, const std::string& body,
                    const Eigen::Vector3d& target, int T, double tolerance) {
  const Eigen::Vector3d first = S.kinematicsPos(body);
  const Motion motion = student.straightLine(S.description(), body, target, kSigma, T);
  checkPostures(check, motion, T, S.getJointDimension());
  const auto onLine = [&](int t) -> Eigen::Vector3d {
    return first + static_cast<double>(t) / T * (target - first);
  };
  check.atMost("largest distance from the moving target", largestError(S, body, motion, 1, onLine), tolerance,
               "m");
}

void followsTheCircle(Check& check, Student& student, const Simulator& S, const std::string& body,
                      const Eigen::Vector3d& center, double radius, int T, int approach, double tolerance) {
  const Motion motion = student.circle(S.description(), body, center, radius, kSigma, T);
  checkPostures(check, motion, T, S.getJointDimension());
  const auto onCircle = [&](int t) -> Eigen::Vector3d {
    return center + radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  check.atMost("largest distance from the point on the circle",
               largestError(S, body, motion, approach, onCircle), tolerance, "m");
}

void lineOfTheHand(Check& check, Student& student) {
  check.input("man.ors, handR to (-0.2, -0.4, 1.1) in 100 steps");
  followsTheLine(check, student, Simulator("man.ors"), "handR", kTarget, 100, 1e-3);
}

void circleOfTheHand(Check& check, Student& student) {
  check.input("man.ors, handR around (-0.2, -0.4, 1.1), radius 0.2 m, steps 20 to 250");
  followsTheCircle(check, student, Simulator("man.ors"), "handR", kTarget, 0.2, 250, 20, 0.01);
}

// <hidden>
void mapsOfAnotherRobot(Check& check, Student& student) {
  const MapCheck runs[] = {lookAtIsZeroAtTheTarget, lookAtJacobian,          opposePalmsIsZeroWhenOpposite,
                           opposePalmsJacobian,     distanceIsZeroAtTheGoal, distanceJacobian};
  check.forEachCase(6, [&](int i) { runs[i](check, student, arm(check.rng())); });
}

// The arm with seven joints, bent so that it can move in every direction, on targets within reach.
Simulator bentArm(Rng& rng) {
  Simulator S("pegInAHole.ors");
  S.setJointAngles((Eigen::VectorXd(7) << 0.6, 0.5, -0.8, 0.7, 0.9, -0.6, 0.5).finished() +
                   rng.uniformVector(7, -0.1, 0.1));
  return S;
}

void motionsOfAnotherRobot(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    const Simulator S = bentArm(check.rng());
    const Eigen::Vector3d place = S.kinematicsPos("peg");
    if (i < 3) {
      followsTheLine(check, student, S, "peg", place + 0.3 * randomDirection(check.rng()), 60 + 10 * i, 5e-3);
    } else {
      followsTheCircle(check, student, S, "peg", place - Eigen::Vector3d(0.1, 0, 0), 0.1, 130, 10, 5e-3);
    }
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"look-at-zero", "maps", "lookAt is zero exactly when the body looks at the target", 1, Group::visible,
       onTheMan(lookAtIsZeroAtTheTarget)},
      {"look-at-jacobian", "maps", "the Jacobian of lookAt", 1, Group::visible, onTheMan(lookAtJacobian)},
      {"palms-zero", "maps", "opposePalms is zero exactly for opposite palms", 1, Group::visible,
       onTheMan(opposePalmsIsZeroWhenOpposite)},
      {"palms-jacobian", "maps", "the Jacobian of opposePalms", 1, Group::visible,
       onTheMan(opposePalmsJacobian)},
      {"distance-zero", "maps", "distanceToGoal is one number, zero only at the goal", 1, Group::visible,
       onTheMan(distanceIsZeroAtTheGoal)},
      {"distance-jacobian", "maps", "the Jacobian of distanceToGoal", 1, Group::visible,
       onTheMan(distanceJacobian)},
      // <hidden>
      {"maps-other-robot", "maps", "the maps of another robot", 2, Group::hidden, mapsOfAnotherRobot},
      // </hidden>
      {"step-hand", "step", "one step minimises its cost, for the right hand", 2, Group::visible,
       stepOfTheHand},
      {"step-singular", "step", "one step stays small at a singular posture", 1, Group::visible,
       stepAtASingularity},
      // <hidden>
      {"step-any-size", "step", "one step for Jacobians of any size", 1, Group::hidden, stepOfAnySize},
      // </hidden>
      {"full-steps", "motion", "full steps reach the target as in the lecture", 1, Group::visible, fullSteps},
      {"small-steps", "motion", "a hundred steps of a tenth reach the target", 1, Group::visible,
       stepsOfATenth},
      {"line", "motion", "the hand follows the straight line", 2, Group::visible, lineOfTheHand},
      {"circle", "motion", "the hand follows the circle", 2, Group::visible, circleOfTheHand},
      // <hidden>
      {"motion-other-robot", "motion", "lines and circles of another robot", 2, Group::hidden,
       motionsOfAnotherRobot},
      // </hidden>
  };
}
