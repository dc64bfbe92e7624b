#include "grading/check.h"

#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "geometry/rotation.h"
#include "grading/own_differences.h"
#include "grading/tolerance.h"
#include "interface.h"
#include "kinematics/inverse_kinematics.h"
#include "motion_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// A robot to test the maps on: a scene in a random posture, and two of its bodies.
struct Robot {
  Simulator S;
  std::string body, other;
};

// Values below this count as zero: maps that use an arc cosine keep only half of their digits at the zero.
constexpr double kZero = 1e-5;
// Values of at least this much count as nonzero: 1 - cos(0.3 rad) is 0.04.
constexpr double kNotZero = 1e-3;
// Half a millimetre beside the goal even the fourth power of the distance is larger than this.
constexpr double kBeside = 1e-14;

// Two hundredths of a radian beside the goal the derivative of that power is larger than this.
constexpr double kNotFlat = 1e-9;

Simulator inRandomPosture(Simulator S, Rng& rng, double spread) {
  S.setJointAngles(S.getJointAngles() + spread * rng.normalVector(S.getJointDimension()));
  return S;
}

// Another posture of the robot, far enough for any direction.
Simulator elsewhere(Check& check, const Robot& robot) {
  Rng rng = check.rng().split(1);
  return inRandomPosture(robot.S, rng, 0.5);
}

Robot man(Rng& rng) { return {inRandomPosture(Simulator("man.ors"), rng, 0.3), "handR", "handL"}; }

Eigen::Vector3d randomDirection(Rng& rng) { return rng.normalVector(3).normalized(); }

std::string describe(const Robot& robot, const std::string& body) {
  return robot.S.description().sceneName + ", body '" + body + "', random posture";
}

using Map = std::function<TaskMapValue(Student&, const SimulatorDescription&)>;

// Derivatives of y up to here make tolerances larger, so that it does not matter in which unit y is.
constexpr double kMostDerivative = 100;

// A map of the student's, and the simulator it is tested on.
struct TestedMap {
  std::string function;
  const Simulator& S;
  Map map;
};

// y at the postures, asked of a fresh worker. The first posture is that of S, where y is `first`.
std::vector<Eigen::VectorXd> valuesOf(Check& check, const TestedMap& tested,
                                      const std::vector<Eigen::VectorXd>& postures,
                                      const Eigen::VectorXd& first) {
  const std::string name = "y of " + tested.function;
  return grading::valuesInAnyOrder(
      check, name, postures, first, [&](remote::Caller& caller, const Eigen::VectorXd& q) {
        Student stranger(caller);
        const TaskMapValue there = tested.map(stranger, at(tested.S, q).description());
        check.shape(name, there.y, first.size(), 1);
        return there.y;
      });
}

// J is the derivative of y, and y does change with q. `throughPosition` is the part of it that comes from the
// position of the body, if that is known: the sign of one part is a usual mistake.
void checkJacobianOf(Check& check, Student& student, const TestedMap& tested,
                     const std::function<Eigen::MatrixXd(Eigen::Index)>& throughPosition = {}) {
  const auto& [function, S, map] = tested;
  const TaskMapValue value = map(student, S.description());
  check.that("y of " + function + " has at least one entry", value.y.size() > 0);
  check.shape("y of " + function, value.y, value.y.size(), 1);
  check.shape("J of " + function, value.J, value.y.size(), S.getJointDimension());
  const Eigen::VectorXd posture = S.getJointAngles();
  const Eigen::MatrixXd numeric = grading::finiteDifferences(
      valuesOf(check, tested, grading::placesOfDifferences(posture), value.y), posture);
  check.atLeast("largest derivative of y of " + function + " by a joint angle", numeric.cwiseAbs().maxCoeff(),
                kNotZero);
  const Eigen::MatrixXd part = throughPosition ? throughPosition(numeric.rows())
                                               : Eigen::MatrixXd::Zero(numeric.rows(), numeric.cols());
  const auto noPosition = check.suspect(
      "Is the part missing that comes from the body's own motion, with jacobianPos?", numeric - part);
  const auto sign = check.suspect("Does the part with jacobianPos have the wrong sign?", numeric - 2 * part);
  const auto noDirection =
      check.suspect("Is the part missing that comes from the turning gaze, with jacobianVec?", part);
  check.near("J of " + function + ", beside differences of its y", value.J, numeric,
             1e-5 * grading::sizeUpTo(kMostDerivative, numeric));
}

// From a posture in which the task is fulfilled to that of S: y must not jump between where it is known,
// which is there, and where J is compared with its differences.
void checkPathFrom(Check& check, Student& student, const TestedMap& tested,
                   const Eigen::VectorXd& fulfilled) {
  const auto& [function, S, map] = tested;
  const auto valueAt = [&](Student& one, const Eigen::VectorXd& q) {
    const TaskMapValue value = map(one, at(S, q).description());
    return grading::ValueAndDerivative{value.y, value.J};
  };
  const grading::ValueAndDerivative start = valueAt(student, fulfilled);
  check.that("y of " + function + " has at least one entry", start.value.size() > 0);
  check.shape("J of " + function, start.derivative, start.value.size(), S.getJointDimension());
  grading::requireIntegral(check, "y of " + function, fulfilled, S.getJointAngles(), start,
                           [&](remote::Caller& caller, const Eigen::VectorXd& q) {
                             Student stranger(caller);
                             return valueAt(stranger, q);
                           });
}

// A map like y = q has an easy Jacobian but says nothing about the task. A map of the task is zero where S
// fulfils it, and nearby hardly larger than its derivative there predicts.
void checkIsOfTheTask(Check& check, Student& student, const TestedMap& tested) {
  const auto& [function, S, map] = tested;
  const Eigen::VectorXd q = S.getJointAngles(), y = map(student, S.description()).y;
  check.that("y of " + function + " has at least one entry", y.size() > 0);
  const auto posture = check.ask("Is y the posture? It should depend on the task.",
                                 y.size() == S.getJointDimension() && y.isApprox(q));
  check.atMost("largest entry of |y| of " + function + " where the task is fulfilled",
               y.cwiseAbs().maxCoeff(), kZero);
  const Eigen::VectorXd way = check.rng().uniformVector(S.getJointDimension(), -1e-3, 1e-3);
  // Two hundredths of a radian away, where y must not be flat either.
  const Eigen::VectorXd farther = q + 20 * way;
  std::vector<Eigen::VectorXd> postures = grading::placesOfDifferences(q + way);
  const std::size_t count = postures.size();
  for (const Eigen::VectorXd& place : grading::placesOfDifferences(farther)) postures.push_back(place);
  postures.insert(postures.begin(), q);
  const std::vector<Eigen::VectorXd> values = valuesOf(check, tested, postures, y);
  const Eigen::VectorXd beside = values[1].cwiseAbs();
  const Eigen::VectorXd change =
      grading::finiteDifferences(std::span(values).subspan(1, count), q + way).cwiseAbs() * way.cwiseAbs();
  const Eigen::VectorXd most = (kZero + 10 * change.array().min(kMostDerivative * way.lpNorm<1>())).matrix();
  Eigen::Index worst = 0;
  (beside - most).maxCoeff(&worst);
  check.atMost("largest entry of |y| of " + function + " a thousandth of a radian away from there",
               beside[worst], most[worst]);
  const auto flat = check.ask("Is y zero or constant around the place where it should be zero?");
  check.atLeast(
      "largest derivative of y of " + function + " two hundredths of a radian away from there",
      grading::finiteDifferences(std::span(values).subspan(1 + count), farther).cwiseAbs().maxCoeff(),
      kNotFlat);
}

// The three maps, for any robot.

// w with the sign of one component in the frame R flipped; nothing if that would hardly change it.
std::optional<Eigen::Vector3d> mirrored(const Eigen::Vector3d& w, const Eigen::Matrix3d& R, int component) {
  Eigen::Vector3d inFrame = R.transpose() * w;
  if (std::abs(inFrame[component]) < 0.25) return {};
  inFrame[component] = -inFrame[component];
  return R * inFrame;
}

// A map of a direction, and the words for where it should be zero and for the opposite.
struct DirectionMap {
  std::string function, zero, opposite;
  std::function<TaskMapValue(const Eigen::Vector3d&)> at;
};

// A map of a direction must be zero at w and nowhere else. A careless map may also be zero in the opposite
// direction, beside w, at a right angle to it, or at its mirror images in the world and in a body's frame R.
// A single number must not change its sign: it would be zero in between. `text` says what the case is.
void isZeroOnlyAt(Check& check, const std::string& text, const Eigen::Vector3d& w, const Eigen::Matrix3d& R,
                  const DirectionMap& map) {
  Eigen::Index dimensions = -1;
  const auto valueAt = [&](const Eigen::Vector3d& direction) {
    const TaskMapValue value = map.at(direction);
    if (dimensions < 0) dimensions = value.y.size();
    check.that("y of " + map.function + " has at least one entry", dimensions > 0);
    check.shape("y of " + map.function, value.y, dimensions, 1);
    return value.y;
  };
  const auto isZero = [](const Eigen::VectorXd& y) { return y.cwiseAbs().maxCoeff() <= kZero; };
  const std::string size = "largest entry of |y| of " + map.function + " ";
  Eigen::VectorXd before;
  const auto notZero = [&](const std::string& where, const Eigen::Vector3d& direction) {
    const Eigen::VectorXd y = valueAt(direction);
    check.input(text, {{"zero only at", w}, {"direction", direction}, {"y", y}});
    check.atLeast(size + where, y.cwiseAbs().maxCoeff(), kNotZero);
    if (dimensions > 1) return;
    if (before.size() == 0) before = y;
    check.input(text, {{"direction", direction}, {"y", y}, {"y in the opposite direction", before}});
    const auto cancel = check.ask("Can parts of either sign cancel in it?");
    check.that("y of " + map.function + " is a single number, so it has the same sign in all directions",
               before[0] * y[0] >= 0);
  };
  const Eigen::VectorXd y = valueAt(w);
  check.input(text, {{"direction", w}, {"y", y}});
  {
    const auto inBody = check.ask("Is the direction in the body's frame used as one in the world?",
                                  isZero(valueAt(R.transpose() * w)));
    const auto sign = check.ask("It is zero " + map.opposite + ": does a sign differ?", isZero(valueAt(-w)));
    check.atMost(size + map.zero, y.cwiseAbs().maxCoeff(), kZero);
  }
  {
    const auto cross = check.ask("Is it a cross product, or a square? These are zero there, too.",
                                 !isZero(valueAt(w.unitOrthogonal())));
    notZero(map.opposite, -w);
  }
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d aside = w.cross(randomDirection(check.rng())).normalized();
    notZero("30 degrees beside the right direction", std::cos(0.52) * w + std::sin(0.52) * aside);
    notZero("at a right angle to the right direction", aside);
    for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), R}) {
      const auto leftOut = check.ask("Is a coordinate of the direction left out?", dimensions > 1);
      if (const auto image = mirrored(w, frame, i))
        notZero("at a mirror image of the right direction", *image);
    }
  }
}

Eigen::Matrix3d frameOf(const Simulator& S, const std::string& body) {
  Eigen::Matrix3d R;
  for (int i = 0; i < 3; ++i) R.col(i) = S.kinematicsVec(body, Eigen::Vector3d::Unit(i));
  return R;
}

void lookAtIsZeroAtTheTarget(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d gaze = randomDirection(check.rng());
  const Eigen::Vector3d eye = robot.S.kinematicsPos(robot.body);
  isZeroOnlyAt(check, describe(robot, robot.body) + ", the target 1.3 m from it",
               robot.S.kinematicsVec(robot.body, gaze), frameOf(robot.S, robot.body),
               {"lookAt", "with the target along the gaze", "where the body looks away from the target",
                [&](const Eigen::Vector3d& direction) {
                  return student.lookAt(robot.S.description(), robot.body, gaze, eye + 1.3 * direction);
                }});
}

void lookAtJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d gaze = randomDirection(check.rng());
  const Eigen::Vector3d target = robot.S.kinematicsPos(robot.body) + robot.S.kinematicsVec(robot.body, gaze);
  const auto mapTo = [&](const Eigen::Vector3d& place) {
    return [&, place](Student& one, const SimulatorDescription& S) {
      return one.lookAt(S, robot.body, gaze, place);
    };
  };
  check.input(describe(robot, robot.body) + ", the target 1 m along the gaze");
  checkIsOfTheTask(check, student, {"lookAt", robot.S, mapTo(target)});
  const Simulator S = elsewhere(check, robot);
  const TestedMap tested{"lookAt", S, mapTo(target)};
  check.input(describe(robot, robot.body), {{"gaze", gaze}, {"target", target}});
  // A body that moves and does not turn does to y what the opposite motion of the target would.
  checkJacobianOf(check, student, tested, [&](Eigen::Index dimensions) -> Eigen::MatrixXd {
    const VectorFunction ofTarget = [&](const Eigen::VectorXd& place) {
      const TaskMapValue value = mapTo(place)(student, S.description());
      check.shape("y of lookAt", value.y, dimensions, 1);
      return value.y;
    };
    return -numericJacobian(ofTarget, target) * S.jacobianPos(robot.body);
  });
  checkPathFrom(check, student, tested, robot.S.getJointAngles());
}

// Two hands that rotate freely: yaw, pitch and roll of each are joints.
constexpr const char* kTwoHands = R"(
  body post {}
  body l1 {} body l2 {} body left { mass=1 }
  body r1 {} body r2 {} body right { mass=1 }
  joint (post l1) { A=<T t(0 .2 1)> type=hingeZ }
  joint (post r1) { A=<T t(0 -.2 1)> type=hingeZ }
  joint (l1 l2) { type=hingeY }
  joint (r1 r2) { type=hingeY }
  joint (l2 left) { type=hingeX }
  joint (r2 right) { type=hingeX })";

void opposePalmsIsZeroWhenOpposite(Check& check, Student& student) {
  const Eigen::Vector3d palm = randomDirection(check.rng());
  const Eigen::Matrix3d R_left = expSO3(check.rng().normalVector(3));
  const Eigen::Vector3d left = R_left * palm;
  const auto map = [&](const Eigen::Vector3d& right) {
    const Eigen::Matrix3d R_right =
        rotationAboutAxis(check.rng().uniform(0, 6), right) * rotationBetween(palm, right);
    const Eigen::Vector3d l = rollPitchYawFromRotation(R_left), r = rollPitchYawFromRotation(R_right);
    const Eigen::VectorXd q = (Eigen::VectorXd(6) << l[2], r[2], l[1], r[1], l[0], r[0]).finished();
    return student.opposePalms({.sceneName = "two hands", .sceneText = kTwoHands, .q = q}, "left", "right",
                               palm);
  };
  isZeroOnlyAt(check, "two hands that rotate freely; the direction is that of the right palm", -left, R_left,
               {"opposePalms", "with opposite palms", "with palms that point in the same direction", map});
}

// Moves the robot until its palms are opposite; false if that fails from its current posture.
bool opposed(Robot& robot, const Eigen::Vector3d& palm) {
  Simulator& S = robot.S;
  for (int step = 0; step < 100; ++step) {
    const Eigen::Vector3d sum = S.kinematicsVec(robot.other, palm) + S.kinematicsVec(robot.body, palm);
    if (sum.norm() < 1e-12) return true;
    const Eigen::MatrixXd J = S.jacobianVec(robot.other, palm) + S.jacobianVec(robot.body, palm);
    S.setJointAngles(S.getJointAngles() - inverseKinematicsStep(J, sum, 1e-3));
  }
  return false;
}

void opposePalmsJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d palm = randomDirection(check.rng());
  const auto map = [&](Student& one, const SimulatorDescription& S) {
    return one.opposePalms(S, robot.other, robot.body, palm);
  };
  Robot clapping = robot;
  while (!opposed(clapping, palm)) clapping.S = inRandomPosture(robot.S, check.rng(), 1);
  check.input(describe(robot, robot.body) + " with the palms opposite");
  checkIsOfTheTask(check, student, {"opposePalms", clapping.S, map});
  check.input(describe(robot, robot.body), {{"palm", palm}});
  checkJacobianOf(check, student, {"opposePalms", robot.S, map});
  checkPathFrom(check, student, {"opposePalms", robot.S, map}, clapping.S.getJointAngles());
}

void distanceIsZeroAtTheGoal(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d here = robot.S.kinematicsPos(robot.body);
  const auto valueAt = [&](const Eigen::Vector3d& goal) {
    const TaskMapValue value = student.distanceToGoal(robot.S.description(), robot.body, goal);
    check.shape("y of distanceToGoal", value.y, 1, 1);
    check.shape("J of distanceToGoal", value.J, 1, robot.S.getJointDimension());
    return value.y[0];
  };
  check.input(describe(robot, robot.body) + " at the goal");
  check.near("y of distanceToGoal at the goal", valueAt(here), 0, kZero);
  double before = 0;
  std::vector<Eigen::Vector3d> ways = {
      {0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, 0.5 * randomDirection(check.rng())};
  for (const Eigen::Vector3d& way : ways) {
    for (const Eigen::Vector3d& goal : {Eigen::Vector3d(here + way), Eigen::Vector3d(here - way)}) {
      const double y = valueAt(goal);
      check.input(describe(robot, robot.body),
                  {{"its position", here}, {"goal", goal}, {"y", y}, {"y at the goal before", before}});
      check.atLeast("|y| of distanceToGoal away from the goal", std::abs(y), kNotZero);
      // A continuous function that changes its sign is zero in between, away from the goal.
      const auto cancel = check.ask("Can differences of either sign cancel in it?");
      check.that("y of distanceToGoal has the same sign all around the goal", before * y >= 0);
      before = y;
    }
  }
  const Eigen::Vector3d near = here + 5e-4 * randomDirection(check.rng());
  check.input(describe(robot, robot.body), {{"its position", here}, {"goal", near}});
  const auto guarded = check.ask("Is there a tolerance around the goal? Only the goal itself may give zero.");
  check.atLeast("|y| of distanceToGoal half a millimetre away from the goal", std::abs(valueAt(near)),
                kBeside);
}

void distanceJacobian(Check& check, Student& student, const Robot& robot) {
  const Eigen::Vector3d goal = robot.S.kinematicsPos(robot.body);
  const auto map = [&](Student& one, const SimulatorDescription& S) {
    return one.distanceToGoal(S, robot.body, goal);
  };
  check.input(describe(robot, robot.body) + " at the goal");
  checkIsOfTheTask(check, student, {"distanceToGoal", robot.S, map});
  const Simulator S = elsewhere(check, robot);
  check.input(describe(robot, robot.body), {{"its position", S.kinematicsPos(robot.body)}, {"goal", goal}});
  checkJacobianOf(check, student, {"distanceToGoal", S, map});
  checkPathFrom(check, student, {"distanceToGoal", S, map}, robot.S.getJointAngles());
}

using MapCheck = void (*)(Check&, Student&, const Robot&);

auto onTheMan(MapCheck run) {
  return [run](Check& check, Student& student) {
    for (int i = 0; i < 2; ++i) run(check, student, man(check.rng()));
  };
}

auto twice(void (*run)(Check&, Student&)) {
  return [run](Check& check, Student& student) {
    for (int i = 0; i < 2; ++i) run(check, student);
  };
}

// One step.

void stepIsTheMinimum(Check& check, Student& student, const Eigen::MatrixXd& J, const Eigen::VectorXd& dy,
                      double sigma) {
  isTheMinimum(check, "dq of ikStep", student.ikStep(J, dy, sigma), J, dy, sigma);
}

void stepOfTheHand(Check& check, Student& student) {
  check.forEachCase(4, [&](int) {
    const Robot robot = man(check.rng());
    const Eigen::Vector3d dy = 0.3 * randomDirection(check.rng());
    check.input("Jacobian of the right hand in a random posture", {{"dy", dy}, {"sigma", kSigma}});
    stepIsTheMinimum(check, student, robot.S.jacobianPos("handR"), dy, kSigma);
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
    check.shape("dq of ikStep", dq, 3, 1);
    check.near("dq of ikStep, for a change that no joint can make", dq, Eigen::VectorXd::Zero(3), 1e-6,
               "rad");
  }
  check.input("pegArm.ors stretched out (q = 0), a change of 0.3 m across the arm");
  stepIsTheMinimum(check, student, J, Eigen::Vector3d(0, 0, 0.3), kSigma);
}

// Motions.

void lineOfTheHand(Check& check, Student& student) {
  check.input("man.ors, handR to (-0.2, -0.4, 1.1) in 100 steps");
  followsTheLine(check, student, Simulator("man.ors"), "handR", kTarget, 100, 5e-4);
}

void circleOfTheHand(Check& check, Student& student) {
  check.input("man.ors, handR around (-0.2, -0.4, 1.1), radius 0.2 m, steps 20 to 250");
  followsTheCircle(check, student, Simulator("man.ors"), "handR", kTarget, 0.2, 250, 20, 2e-3);
}

// <hidden>
void stepOfAnySize(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    Rng& rng = check.rng();
    const int d = 1 + rng.index(8), n = 1 + rng.index(20);
    const Eigen::MatrixXd J = rng.normalVector(d * n).reshaped(d, n);
    stepIsTheMinimum(check, student, J, rng.normalVector(d), std::pow(10, rng.uniform(-2, 0.5)));
  });
}

Robot arm(Rng& rng) { return {inRandomPosture(Simulator("pegInAHole.ors"), rng, 0.7), "peg", "arm3"}; }

void mapsOfAnotherRobot(Check& check, Student& student) {
  const MapCheck runs[] = {lookAtIsZeroAtTheTarget, lookAtJacobian, opposePalmsJacobian,
                           distanceIsZeroAtTheGoal, distanceJacobian};
  check.forEachCase(10, [&](int i) { runs[i % 5](check, student, arm(check.rng())); });
}

// The arm with seven joints, bent so that it can move in every direction and the targets are within reach.
Simulator bentArm(Rng& rng) {
  Simulator S("pegInAHole.ors");
  S.setJointAngles((Eigen::VectorXd(7) << 0.6, 0.5, -0.8, 0.7, 0.9, -0.6, 0.5).finished() +
                   rng.uniformVector(7, -0.1, 0.1));
  return S;
}

// Each posture follows from the one before by alpha times the best step to its target; nothing else is
// checked.
void stepsFollowOneAnother(Check& check, const std::string& function, const Simulator& S,
                           const Motion& motion, const Place& target, double alpha, double sigma) {
  Simulator before = S;
  for (int t = 1; t <= static_cast<int>(motion.size()); ++t) {
    const Eigen::VectorXd& q = motion[static_cast<std::size_t>(t) - 1];
    const Eigen::Vector3d dy = target(t) - before.kinematicsPos("peg");
    if (dy.norm() < 1e-4) break;  // from here on the difference of two postures is mostly rounding
    isTheMinimum(check, "step from one posture to the next in " + function,
                 (q - before.getJointAngles()) / alpha, before.jacobianPos("peg"), dy, sigma);
    before.setJointAngles(q);
  }
}

void stepsToATarget(Check& check, Student& student, const Simulator& S, const Eigen::Vector3d& target) {
  const double alpha = check.rng().uniform(0.1, 1), sigma = check.rng().uniform(0.01, 0.3);
  const Motion motion = student.smallSteps(S.description(), "peg", target, alpha, sigma, 12);
  checkPostures(check, motion, 12, S.getJointDimension());
  stepsFollowOneAnother(
      check, "smallSteps", S, motion, [&](int) { return target; }, alpha, sigma);
}

// Full steps with another sigma, along the line and around the circle.
void stepsOfTheLine(Check& check, Student& student, const Simulator& S, const Eigen::Vector3d& target) {
  const double sigma = check.rng().uniform(0.05, 0.3);
  const Eigen::Vector3d first = S.kinematicsPos("peg");
  const Motion motion = student.straightLine(S.description(), "peg", target, sigma, 20);
  checkPostures(check, motion, 20, S.getJointDimension());
  const Place onLine = [&](int t) -> Eigen::Vector3d { return first + t / 20. * (target - first); };
  stepsFollowOneAnother(check, "straightLine", S, motion, onLine, 1, sigma);
}

void stepsOfTheCircle(Check& check, Student& student, const Simulator& S, const Eigen::Vector3d& center) {
  const double sigma = check.rng().uniform(0.05, 0.3);
  const Motion motion = student.circle(S.description(), "peg", center, 0.1, sigma, 20);
  checkPostures(check, motion, 20, S.getJointDimension());
  const Place onCircle = [&](int t) -> Eigen::Vector3d {
    return center + 0.1 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  stepsFollowOneAnother(check, "circle", S, motion, onCircle, 1, sigma);
}

void motionsOfAnotherRobot(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    const Simulator S = bentArm(check.rng());
    const Eigen::Vector3d place = S.kinematicsPos("peg"), center = place - Eigen::Vector3d(0.1, 0, 0);
    const Eigen::Vector3d target = place + 0.3 * randomDirection(check.rng());
    if (i < 2) stepsToATarget(check, student, S, target);
    if (i == 2) stepsOfTheLine(check, student, S, target);
    if (i == 3 || i == 4) followsTheLine(check, student, S, "peg", target, 60 + 10 * i, 1e-3);
    if (i == 5) stepsOfTheCircle(check, student, S, center);
    if (i > 5) followsTheCircle(check, student, S, "peg", center, 0.1, 130, 10, 1e-3);
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"look-at-zero", "maps", "lookAt is zero exactly when the body looks at the target", 1, Group::kVisible,
       onTheMan(lookAtIsZeroAtTheTarget)},
      {"look-at-jacobian", "maps", "the Jacobian of lookAt", 1, Group::kVisible, onTheMan(lookAtJacobian)},
      {"palms-zero", "maps", "opposePalms is zero exactly for opposite palms", 1, Group::kVisible,
       twice(opposePalmsIsZeroWhenOpposite)},
      {"palms-jacobian", "maps", "the Jacobian of opposePalms", 1, Group::kVisible,
       onTheMan(opposePalmsJacobian)},
      {"distance-zero", "maps", "distanceToGoal is one number, zero only at the goal", 1, Group::kVisible,
       onTheMan(distanceIsZeroAtTheGoal)},
      {"distance-jacobian", "maps", "the Jacobian of distanceToGoal", 1, Group::kVisible,
       onTheMan(distanceJacobian)},
      // <hidden>
      {"maps-other-robot", "maps", "the maps of another robot", 2, Group::kHidden, mapsOfAnotherRobot},
      // </hidden>
      {"step-hand", "step", "one step minimises its cost, for the right hand", 2, Group::kVisible,
       stepOfTheHand},
      {"step-singular", "step", "one step stays small at a singular posture", 1, Group::kVisible,
       stepAtASingularity},
      // <hidden>
      {"step-any-size", "step", "one step for Jacobians of any size", 1, Group::kHidden, stepOfAnySize},
      // </hidden>
      {"full-steps", "motion", "full steps reach the target as in the lecture", 1, Group::kVisible,
       fullSteps},
      {"small-steps", "motion", "a hundred steps of a tenth reach the target", 1, Group::kVisible,
       stepsOfATenth},
      {"line", "motion", "the hand follows the straight line", 2, Group::kVisible, lineOfTheHand},
      {"circle", "motion", "the hand follows the circle", 2, Group::kVisible, circleOfTheHand},
      // <hidden>
      {"motion-other-robot", "motion", "lines and circles of another robot", 2, Group::kHidden,
       motionsOfAnotherRobot},
      // </hidden>
  };
}
