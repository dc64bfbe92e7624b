#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance_checks.h"
#include "circle_checks.h"
#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "interface.h"
#include "priority_checks.h"
#include "scene/model.h"
#include "task_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;
using grading::Signal;

namespace {

const Eigen::Vector3d kDown(0, 0, -1);

Eigen::MatrixXd randomMetric(Rng& rng, int n) {
  const Eigen::MatrixXd A = randomMatrix(rng, n, n);
  return A * A.transpose() / n + 0.3 * Eigen::MatrixXd::Identity(n, n);
}

// Part 1.

void inverses(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    Rng& rng = check.rng();
    const int d = 1 + rng.index(4), n = d + rng.index(8);
    const Eigen::MatrixXd J = randomMatrix(rng, d, n), W = randomMetric(rng, n);
    const double precision = std::pow(10, rng.uniform(-1, 4));
    check.input("a random case", {{"J", J}, {"W", W}, {"precision", precision}});
    inverseIsTheMinimum(check, student, J, W, precision);
  });
}

void projectors(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    if (i < 2) {
      Simulator S("man.ors");
      S.setJointAngles(0.3 * rng.normalVector(27));
      check.input("man.ors in a random posture, the Jacobian of the right hand");
      isTheProjector(check, student, S.jacobianPos("handR"), 3);
    } else {
      const int d = 1 + rng.index(3), n = d + 2 + rng.index(8);
      Eigen::MatrixXd J = randomMatrix(rng, d, n);
      if (i == 2) J *= 1e-6;         // a robot of a micrometre
      if (i == 3) J.row(0) *= 1e-5;  // a task that hardly moves
      check.input("a random Jacobian of full rank", {{"J", J}});
      isTheProjector(check, student, J, d);
    }
  });
}

void projectorsOfLessRank(Check& check, Student& student) {
  check.input("pegArm.ors stretched out (q = 0), the Jacobian of the peg: it can only move up or down");
  isTheProjector(check, student, Simulator("pegArm.ors").jacobianPos("peg"), 1);
  Eigen::MatrixXd J = randomMatrix(check.rng(), 4, 7);
  J.row(3) = J.topRows(3).colwise().sum();
  check.input("a random Jacobian whose last row is the sum of the others", {{"J", J}});
  isTheProjector(check, student, J, 3);
}

// <hidden>
void inversesOfAnySize(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    if (i < 5) {
      const int d = 1 + rng.index(9), n = 1 + rng.index(9);
      inverseIsTheMinimum(check, student, randomMatrix(rng, d, n), randomMetric(rng, n),
                          std::pow(10, rng.uniform(-1, 4)));
    } else {
      // The rank of a product of thin matrices is their width.
      const int rank = 1 + rng.index(3), d = rank + rng.index(3), n = rank + rng.index(6);
      isTheProjector(check, student, randomMatrix(rng, d, rank) * randomMatrix(rng, rank, n), rank);
    }
  });
}
// </hidden>

// Part 2.

void stackedSteps(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    const int n = 2 + rng.index(10);
    std::vector<TaskTerm> tasks;
    for (int k = 0; k < 1 + i % 4; ++k) {
      const int d = 1 + rng.index(4);
      tasks.push_back({rng.normalVector(d), randomMatrix(rng, d, n), std::pow(10, rng.uniform(-2, 4))});
    }
    const Eigen::MatrixXd W = randomMetric(rng, n);
    const TaskTerm& task = tasks.back();
    check.input("random tasks", {{"number of tasks", tasks.size()},
                                 {"W", W},
                                 {"error of the last", task.error},
                                 {"J of the last", task.J},
                                 {"precision of the last", task.precision}});
    stepIsTheMinimum(check, student, tasks, W);
  });
}

void circleStaysAtHome(Check& check, Student& student) {
  check.input("man.ors, handR around (-0.2, -0.4, 1.1), radius 0.2 m, handL up, 1500 steps");
  const Simulator S("man.ors");
  const Motion motion = circleOf(check, student, S, kCircle, 1500);
  staysAtHome(check, S, motion);
  tracks(check, S, kCircle, motion);
}

void circlePoints(Check& check, Student& student) {
  check.input("man.ors, handR around (-0.2, -0.4, 1.1), radius 0.2 m, handL up, steps 100 to 200");
  const Simulator S("man.ors");
  const Motion motion = circleOf(check, student, S, kCircle, 200);
  pointsUpwards(check, S, kCircle, motion);
  // It points while the other hand works; another check asks how well that hand works.
  tracks(check, S, kCircle, motion, kCircle.radius / 2);
}

// <hidden>
// On a circle of radius zero the posture comes to rest. Its remaining distance from home is what the other
// tasks need: home pulls against them, and against nothing else.
void restsNearHome(Check& check, Student& student, const Simulator& S, Circle circle) {
  circle.radius = 0;
  const Motion motion = circleOf(check, student, S, circle, 1200);
  const Simulator end = at(S, motion.back());
  Eigen::MatrixXd J(6, S.getJointDimension());
  J << end.jacobianPos(circle.hand), end.jacobianVec(circle.pointing);
  const Eigen::VectorXd away = motion.back() - S.getJointAngles();
  check.atMost("deviation from home that no other task asks for, in circleWithTasks",
               (nullspace(J).transpose() * away).norm(), 0.02, "rad");
}

void circleOfTheOtherHand(Check& check, Student& student) {
  check.forEachCase(3, [&](int i) {
    Rng& rng = check.rng();
    const Simulator S = at(Simulator("man.ors"), rng.uniformVector(27, -0.1, 0.1));
    const Circle circle{"handL", Eigen::Vector3d(0.2, -0.4, 1.1) + rng.uniformVector(3, -0.03, 0.03),
                        rng.uniform(0.1, 0.18), "handR"};
    if (i == 2) return restsNearHome(check, student, S, circle);
    const Motion motion = circleOf(check, student, S, circle, 600);
    tracks(check, S, circle, motion);
    staysAtHome(check, S, motion);
    pointsUpwards(check, S, circle, motion);
  });
}
// </hidden>

// Part 3.

void interpolates(Check& check, Student& student) {
  for (int i = 0; i <= 10; ++i) {
    const double s = i / 10.;
    check.near("sineProfile(" + std::to_string(s).substr(0, 3) + ")", student.sineProfile(s),
               (1 - std::cos(std::numbers::pi * s)) / 2, 1e-9);
  }
  Rng& rng = check.rng();
  const int n = 2 + rng.index(6), T = 10 + rng.index(20);
  const Eigen::VectorXd q0 = rng.normalVector(n), qT = rng.normalVector(n);
  const Motion motion = student.jointSpaceMotion(q0, qT, T);
  check.input("two random postures", {{"q0", q0}, {"qT", qT}, {"T", T}});
  checkPostures(check, motion, T, n);
  Motion wanted;
  for (int t = 1; t <= T; ++t)
    wanted.emplace_back(q0 + (1 - std::cos(std::numbers::pi * t / T)) / 2 * (qT - q0));
  check.nearAlong("posture of jointSpaceMotion", grading::overSteps(motion), wanted, 1e-9, "rad");
}

constexpr double kMargin = 0.02;
const Eigen::Vector3d kHole(0, -1, 1);
// The peg is above the hole, but the elbow is so near the frame that it touches unless it is kept away.
const Eigen::VectorXd kAbove =
    (Eigen::VectorXd(7) << 0.967552, -0.251879, -1.18846, 1.4825, 1.42033, 0.215273, -2.64193).finished();
// Bent, away from the hole; small steps lead from here to postures with room for the elbow.
const Eigen::VectorXd kStart = 0.6 * kAbove;

// An arm with a peg, a hole with the direction into it, and where to start.
struct Scene {
  Simulator S;
  std::string peg;
  Eigen::Vector3d hole;
  Eigen::Vector3d direction = kDown;
  Eigen::Vector3d before() const { return hole - 0.6 * direction; }
};

Scene pegInAHole(const Eigen::VectorXd& q) { return {at(Simulator("pegInAHole.ors"), q), "peg", kHole}; }

// The smaller of two distances. Not-a-number is passed on: it must not be taken for a large distance.
double lesser(double a, double b) { return std::isnan(a) || a <= b ? a : b; }

// The least distance between two shapes that may collide, metres, but at most 0.5.
double clearance(const Simulator& S) {
  double least = kQueryCutoff;
  for (const Proxy& one : proxies(ContactModel(S.model()), forwardKinematics(S.model(), S.getJointAngles())))
    least = lesser(least, one.proximity.distance);
  return least;
}

// Without this, a joint that turns a million times would keep the check of the clearance busy for ever.
void turnsLittle(Check& check, const Simulator& S, const std::string& function, const Motion& motion) {
  Eigen::VectorXd before = S.getJointAngles();
  Signal turns;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    turns.add(static_cast<double>(k) + 1, (motion[k] - before).cwiseAbs().maxCoeff());
    before = motion[k];
  }
  check.atMostAlong("largest turn of a joint since the posture before, in " + function, turns, 0.1 + 1e-9,
                    "rad");
}

// The clearance between the postures counts, too. The computed bound is at most `slack` too low.
void clearanceIsKept(Check& check, const Simulator& S, const std::string& function, const Motion& motion) {
  const double slack = 1e-4;
  const ContactModel contacts(S.model());
  Eigen::VectorXd before = S.getJointAngles();
  Signal clearances;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    clearances.add(static_cast<double>(k) + 1,
                   std::min(motionClearance(S.model(), contacts, before, motion[k], slack), kQueryCutoff));
    before = motion[k];
  }
  check.atLeastAlong("clearance on the way to the posture, in " + function, clearances, 0.5 * kMargin - slack,
                     "m");
}

// The motion of the peg and the last part of the wanted path.
grading::Evidence pegSeen(const Scene& scene, const Motion& motion) {
  return seen(scene.S, scene.peg, motion, {scene.before(), scene.hole});
}

void pegIsAt(Check& check, const Scene& scene, const std::string& property, const Eigen::VectorXd& q,
             const Eigen::Vector3d& place, const Eigen::Vector3d& direction) {
  const Simulator there = at(scene.S, q);
  check.near("position of the peg " + property, there.kinematicsPos(scene.peg), place, 1e-3, "m");
  check.near("z axis of the peg " + property, there.kinematicsVec(scene.peg), direction, 0.01);
}

void postureIsRight(Check& check, Student& student, const Scene& scene, const Eigen::Vector3d& place) {
  const Eigen::VectorXd q =
      student.pegPosture(scene.S.description(), scene.peg, place, scene.direction, kMargin);
  check.shape("posture of pegPosture", q, scene.S.getJointDimension(), 1);
  const auto shown = check.show([&] { return pegSeen(scene, {q}); });
  pegIsAt(check, scene, "in pegPosture", q, place, scene.direction);
  check.atLeast("clearance in pegPosture", clearance(at(scene.S, q)), 0.5 * kMargin, "m");
}

void postureAboveAndIn(Check& check, Student& student) {
  check.input("pegInAHole.ors, arm bent, position (0, -1, 1.6) above the hole, downwards");
  postureIsRight(check, student, pegInAHole(kStart), kHole - 0.6 * kDown);
  check.input("pegInAHole.ors, peg above the hole, position (0, -1, 1) in the hole, downwards");
  postureIsRight(check, student, pegInAHole(kAbove), kHole);
}

// The peg moves from its position straight into the hole.
void movesStraight(Check& check, Student& student) {
  const int T = 150;
  const Scene scene = pegInAHole(kAbove);
  check.input("pegInAHole.ors, from above the hole to (0, -1, 1) in 150 steps");
  const Eigen::Vector3d start = scene.S.kinematicsPos("peg"), direction = scene.S.kinematicsVec("peg");
  const Motion motion = student.taskSpaceMotion(scene.S.description(), "peg", kHole, kMargin, T);
  checkPostures(check, motion, T, scene.S.getJointDimension());
  const auto shown = check.show([&] { return pegSeen(scene, motion); });
  Motion wanted;
  for (int t = 1; t <= T; ++t)
    wanted.emplace_back(start + (1 - std::cos(std::numbers::pi * t / T)) / 2 * (kHole - start));
  const auto position = [](const Simulator& moved, int) { return moved.kinematicsPos("peg"); };
  const auto axis = [](const Simulator& moved, int) { return moved.kinematicsVec("peg"); };
  Eigen::VectorXd aside(T);  // of each posture from the straight line between the first and the last
  const Eigen::VectorXd first = motion.front(), chord = (motion.back() - first).normalized();
  for (int t = 0; t < T; ++t) {
    const Eigen::VectorXd gone = motion[static_cast<std::size_t>(t)] - first;
    aside[t] = (gone - gone.dot(chord) * chord).norm();
  }
  const auto joints = check.ask("Do the joints move straight instead of the peg?", aside.maxCoeff() < 1e-6);
  check.nearAlong("position of the peg in taskSpaceMotion", along(scene.S, motion, 1, position), wanted, 5e-3,
                  "m");
  check.nearAlong("z axis of the peg in taskSpaceMotion", along(scene.S, motion, 1, axis),
                  Motion(wanted.size(), direction), 0.05);
  pegIsAt(check, scene, "at the end of taskSpaceMotion", motion.back(), kHole, direction);
  turnsLittle(check, scene.S, "taskSpaceMotion", motion);
  clearanceIsKept(check, scene.S, "taskSpaceMotion", motion);
}

void goesIn(Check& check, Student& student, const Scene& scene) {
  const Motion motion =
      student.insertPeg(scene.S.description(), scene.peg, scene.hole, scene.direction, kMargin);
  check.atLeast("number of postures of insertPeg", static_cast<double>(motion.size()), 10);
  check.atMost("number of postures of insertPeg", static_cast<double>(motion.size()), 1000);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, scene.S.getJointDimension(), 1);
  const auto shown = check.show([&] { return pegSeen(scene, motion); });
  turnsLittle(check, scene.S, "insertPeg", motion);
  pegIsAt(check, scene, "at the end of insertPeg", motion.back(), scene.hole, scene.direction);
  clearanceIsKept(check, scene.S, "insertPeg", motion);
}

void goesIntoTheHole(Check& check, Student& student) {
  check.input("pegInAHole.ors, arm bent, into the hole at (0, -1, 1) downwards");
  goesIn(check, student, pegInAHole(kStart));
}

// <hidden>
std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t place = text.find(what); place != std::string::npos;
       place = text.find(what, place + by.size()))
    text.replace(place, what.size(), by);
  return text;
}

// Another hole, upright or tilted towards the arm, a thicker rod instead of the peg, and another start with
// more room than the margin.
Scene anotherHole(Rng& rng, bool isTilted) {
  SimulatorDescription description = Simulator("pegInAHole.ors").description();
  const Eigen::Vector3d hole = kHole + rng.uniformVector(3, -0.08, 0.08);
  const auto number = [](double x) { return std::to_string(x); };
  const std::string place = number(hole.x()) + " " + number(hole.y()) + " " + number(hole.z());
  const double angle = isTilted ? rng.uniform(12, 18) : 0, turn = std::numbers::pi + rng.uniform(-.6, .6);
  const std::string tilt =
      " d(" + number(angle) + " " + number(std::cos(turn)) + " " + number(std::sin(turn)) + " 0)";
  description.sceneText = replaced(description.sceneText, "t(0 -1 1)", "t(" + place + ")" + tilt);
  description.sceneText = replaced(description.sceneText, "[0 0 0.6 0.05]", "[0 0 0.6 0.06]");
  description.sceneText = replaced(description.sceneText, "peg", "rod");
  Simulator S(description);
  do S.setJointAngles(kStart + rng.uniformVector(7, -0.1, 0.1));
  while (!(clearance(S) >= 1.5 * kMargin));
  return {S, "rod", S.kinematicsPos("hole"), -S.kinematicsVec("hole")};
}

void anotherPegAndHole(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    const Scene other = anotherHole(check.rng(), i > 0);
    if (i < 2) {
      goesIn(check, student, other);
    } else if (i == 2) {
      postureIsRight(check, student, other, other.before());
    } else {
      const Eigen::VectorXd near = kAbove + check.rng().uniformVector(7, -0.02, 0.02);
      postureIsRight(check, student, pegInAHole(near), kHole);
    }
  });
}
// </hidden>

// Part 4.

void firstTasks(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    const int d2 = 1 + rng.index(3);
    TwoTasks tasks = i < 8 ? randomTasks(rng, 3, d2, 7) : exactTasks(rng, 3, d2, 7);
    if (i >= 5 && i < 8) tasks.J2 = randomMatrix(rng, d2, 3) * tasks.J1;
    describe(check, i < 5 ? "two random tasks" : "a second task that contradicts the first", tasks);
    firstComesFirst(check, student, tasks, i >= 8);
  });
}

void secondTasks(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    const TwoTasks tasks = randomTasks(check.rng(), 3, 1 + check.rng().index(3), 7);
    describe(check, "two random tasks, which can both be fulfilled", tasks);
    secondComesSecond(check, student, tasks);
  });
}

// The hand circles. With lower priority it should stay where it was, which is impossible, and point upwards.
void circlesUndisturbed(Check& check, Student& student) {
  Simulator S("man.ors");
  const Eigen::Vector3d start = S.kinematicsPos("handR");
  check.input("man.ors, first handR on the circle, second handR at its start and its z axis upwards");
  Signal distance;
  for (int t = 1; t <= 200; ++t) {
    const Eigen::Vector3d wanted = kTarget + 0.2 * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
    TwoTasks tasks{S.jacobianPos("handR"), wanted - S.kinematicsPos("handR"), Eigen::MatrixXd(6, 27),
                   Eigen::VectorXd(6)};
    tasks.J2 << tasks.J1, S.jacobianVec("handR");
    tasks.dy2 << start - S.kinematicsPos("handR"), kUp - S.kinematicsVec("handR");
    tasks.dy2 *= 0.1;
    S.setJointAngles(S.getJointAngles() + stepOf(check, student, tasks));
    if (t >= 20) distance.add(t, (S.kinematicsPos("handR") - wanted).norm());
  }
  check.atMostAlong("distance of handR from its point on the circle, moved by priorityStep", distance, 2e-3,
                    "m");
  check.near("z axis of handR at the end, moved by priorityStep", S.kinematicsVec("handR"), kUp, 0.05);
}

// <hidden>
void anyTwoTasks(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    const int n = 3 + rng.index(8);
    const bool isExact = i % 4 == 3;
    TwoTasks tasks = randomTasks(rng, 1 + rng.index(6), 1 + rng.index(6), n);
    // The first task loses rank, so that it cannot be fulfilled; the second may share a row with it.
    if (i % 3 > 0)
      tasks.J1 = randomMatrix(rng, static_cast<int>(tasks.J1.rows()), 1) * randomMatrix(rng, 1, n);
    if (i % 3 > 1) tasks.J2.row(0) = tasks.J1.row(0);
    if (isExact) tasks = exactTasks(rng, 1 + rng.index(3), 1 + rng.index(3), n);
    const Eigen::VectorXd dq = stepOf(check, student, tasks);
    firstIsFulfilled(check, tasks, dq, isExact ? 1e-7 : kRegularised);
    secondIsAsGoodAsItCan(check, tasks, dq);
    isTheShortest(check, tasks, dq);
  });
}
// </hidden>

// Part 5. The tree comes first, since it is small enough to compute by hand.

Standing someRobot(Rng& rng, int i) {
  return inRandomPosture(rng, i < 3 ? randomTree(rng, 2 + i) : limitedMan(rng));
}

void sumsOverRobots(Check& check, Student& student) {
  check.forEachCase(5, [&](int i) {
    const Standing robot = someRobot(check.rng(), i);
    limitsFit(check, student, robot);
    centerFits(check, student, robot);
  });
}

void positionsInFrames(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) { positionFits(check, student, someRobot(check.rng(), i)); });
}

// <hidden>
void mapsOfOtherRobots(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Standing robot = inRandomPosture(check.rng(), randomTree(check.rng(), 3 + i));
    if (i == 0) robot.frame = robot.body;  // a point of the frame itself never moves there
    if (i == 1) robot.frame = "b0";        // and this frame does not turn
    const SimulatorDescription S = robot.S.description();
    differencesFit(check, "jointLimits", robot, jointLimitsTask(robot.margin),
                   student.jointLimits(S, robot.margin));
    differencesFit(check, "massCenter", robot, centerOfMassTask(), student.massCenter(S, robot.masses));
    differencesFit(check, "relativePosition", robot, relativePositionOf(robot),
                   student.relativePosition(S, robot.body, robot.inBody, robot.frame, robot.inFrame));
  });
}
// </hidden>

}  // namespace

grading::Checks<Student> checks() {
  return {
      {"inverse", "nullspace", "regularisedInverse minimises its cost", 1, Group::kVisible, inverses},
      {"projector", "nullspace", "the projector onto the nullspace", 1, Group::kVisible, projectors},
      {"projector-singular", "nullspace", "the projector for a Jacobian that loses rank", 1, Group::kVisible,
       projectorsOfLessRank},
      // <hidden>
      {"nullspace-any-size", "nullspace", "Jacobians of any size and rank", 1, Group::kHidden,
       inversesOfAnySize},
      // </hidden>
      {"stack", "tasks", "multiTaskStep minimises the sum of its costs", 1, Group::kVisible, stackedSteps},
      {"circle-home", "tasks", "the hand follows the circle, and the posture stays near home", 1,
       Group::kVisible, circleStaysAtHome},
      {"circle-points", "tasks", "the other hand points upwards", 1, Group::kVisible, circlePoints},
      // <hidden>
      {"circle-other-hand", "tasks", "the circle with the other hand, from another posture", 1,
       Group::kHidden, circleOfTheOtherHand},
      // </hidden>
      {"interpolation", "peg", "joint-space interpolation with the sine profile", 1, Group::kVisible,
       interpolates},
      {"peg-posture", "peg", "postures above the hole and in it", 1, Group::kVisible, postureAboveAndIn},
      {"peg-straight", "peg", "the peg moves straight into the hole and touches nothing", 1, Group::kVisible,
       movesStraight},
      {"peg-insert", "peg", "the whole motion into the hole, also between the postures", 1, Group::kVisible,
       goesIntoTheHole},
      // <hidden>
      {"peg-other-hole", "peg", "another peg, another hole, another start", 1, Group::kHidden,
       anotherPegAndHole},
      // </hidden>
      {"priority-first", "priority", "the second task never disturbs the first", 1, Group::kVisible,
       firstTasks},
      {"priority-second", "priority", "the second task gets all that the first leaves", 1, Group::kVisible,
       secondTasks},
      {"priority-circle", "priority", "the hand stays on its circle against a second task", 1,
       Group::kVisible, circlesUndisturbed},
      // <hidden>
      {"priority-any", "priority", "tasks of any size and rank", 1, Group::kHidden, anyTwoTasks},
      // </hidden>
      {"sums", "balance", "joint limits and the centre of mass", 1, Group::kVisible, sumsOverRobots},
      {"frames", "balance", "positions in the axes of another body", 1, Group::kVisible, positionsInFrames},
      // <hidden>
      {"other-robots", "balance", "the three maps of other robots, and differences of their values", 1,
       Group::kHidden, mapsOfOtherRobots},
      // </hidden>
  };
}
