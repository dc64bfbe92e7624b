#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "collision/contacts.h"
#include "collision/motion_clearance.h"
#include "course/film.h"
#include "grading/evidence_parts.h"
#include "interface.h"
#include "scene/model.h"

using namespace rex;
using grading::Check;
using grading::Group;
using grading::Signal;

namespace {

using Motion = std::vector<Eigen::VectorXd>;

const Eigen::Vector3d kTarget(-0.2, -0.4, 1.1), kUp(0, 0, 1), kDown(0, 0, -1);

Eigen::MatrixXd randomMatrix(Rng& rng, int rows, int columns) {
  return rng.normalVector(rows * columns).reshaped(rows, columns);
}

Eigen::MatrixXd randomMetric(Rng& rng, int n) {
  const Eigen::MatrixXd A = randomMatrix(rng, n, n);
  return A * A.transpose() / n + 0.3 * Eigen::MatrixXd::Identity(n, n);
}

Simulator at(const Simulator& S, const Eigen::VectorXd& q) {
  SimulatorDescription description = S.description();
  description.q = q;
  return Simulator(description);
}

// Columns that span the nullspace of J.
Eigen::MatrixXd nullspace(const Eigen::MatrixXd& J) {
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(std::max(J.rows(), J.cols()), J.cols());
  square.topRows(J.rows()) = J;
  const SingularValues parts = svd(square);
  const auto rank = (parts.s.array() > 1e-9 * parts.s[0]).count();
  return parts.V.rightCols(J.cols() - rank);
}

// There are `count` postures, each of n finite numbers.
void checkPostures(Check& check, const Motion& motion, int count, int n) {
  check.near("number of postures", static_cast<double>(motion.size()), count, 0);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, n, 1);
}

// Part 1.

// X minimises precision * |J X dy - dy|^2 + |X dy|_W^2 for every dy if this gradient vanishes.
void inverseIsTheMinimum(Check& check, Student& student, const Eigen::MatrixXd& J, const Eigen::MatrixXd& W,
                         double precision) {
  const Eigen::MatrixXd X = student.regularisedInverse(J, W, precision);
  check.shape("J#", X, J.cols(), J.rows());
  const Eigen::MatrixXd gradient =
      precision * J.transpose() * (J * X - Eigen::MatrixXd::Identity(J.rows(), J.rows())) + W * X;
  const Eigen::MatrixXd wanted = solve(precision * J.transpose() * J + W, precision * J.transpose());
  const double scale = (precision * J.squaredNorm() + W.norm()) * wanted.norm() + precision * J.norm();
  check.atMost("relative gradient of the cost at J# dy", gradient.norm() / scale, 1e-8);
}

void inverses(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    Rng& rng = check.rng();
    const int d = 1 + rng.index(4), n = d + rng.index(8);
    check.input("a random Jacobian, a random metric W, a precision between 0.1 and 1e4");
    inverseIsTheMinimum(check, student, randomMatrix(rng, d, n), randomMetric(rng, n),
                        std::pow(10, rng.uniform(-1, 4)));
  });
}

void isTheProjector(Check& check, Student& student, const Eigen::MatrixXd& J, int rank) {
  const Eigen::Index n = J.cols();
  const Eigen::MatrixXd N = student.nullspaceProjector(J);
  check.shape("N", N, n, n);
  check.atMost("largest relative entry of J N", (J * N).cwiseAbs().maxCoeff() / J.cwiseAbs().maxCoeff(),
               1e-9);
  check.near("N N", N * N, N, 1e-9);
  check.atMost("largest entry of N - N' (W is the identity)", (N - N.transpose()).cwiseAbs().maxCoeff(),
               1e-9);
  check.near("trace of N, the number of free directions", N.trace(), static_cast<double>(n) - rank, 1e-9);
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
      check.input("a random Jacobian of full rank");
      isTheProjector(check, student, randomMatrix(rng, d, n), d);
    }
  });
}

void projectorsOfLessRank(Check& check, Student& student) {
  check.input("pegArm.ors stretched out (q = 0), the Jacobian of the peg: it can only move up or down");
  isTheProjector(check, student, Simulator("pegArm.ors").jacobianPos("peg"), 1);
  check.input("a random Jacobian whose last row is the sum of the others");
  Eigen::MatrixXd J = randomMatrix(check.rng(), 4, 7);
  J.row(3) = J.topRows(3).colwise().sum();
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

void stepIsTheMinimum(Check& check, Student& student, const std::vector<TaskTerm>& tasks,
                      const Eigen::MatrixXd& W) {
  const Eigen::VectorXd dq = student.multiTaskStep(tasks, W);
  check.shape("dq", dq, W.rows(), 1);
  Eigen::MatrixXd H = W;
  Eigen::VectorXd gradient = W * dq, pull = Eigen::VectorXd::Zero(W.rows());
  for (const auto& [error, J, precision] : tasks) {
    gradient += precision * J.transpose() * (error + J * dq);
    H += precision * J.transpose() * J;
    pull += precision * J.transpose() * error;
  }
  const double size = solve(H, pull).norm();  // of the wanted step
  double scale = W.norm() * size;
  for (const auto& [error, J, precision] : tasks)
    scale += precision * (J.norm() * error.norm() + J.squaredNorm() * size);
  check.atMost("relative gradient of the cost at dq", gradient.norm() / scale, 1e-8);
}

void stackedSteps(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    const int n = 2 + rng.index(10);
    std::vector<TaskTerm> tasks;
    for (int k = 0; k < 1 + i % 4; ++k) {
      const int d = 1 + rng.index(4);
      tasks.push_back({rng.normalVector(d), randomMatrix(rng, d, n), std::pow(10, rng.uniform(-2, 4))});
    }
    check.input("random tasks with precisions between 0.01 and 1e4, and a random metric W");
    stepIsTheMinimum(check, student, tasks, randomMetric(rng, n));
  });
}

struct Circle {
  std::string hand;
  Eigen::Vector3d center;
  double radius;
  std::string pointing;
};

const Circle kCircle{"handR", kTarget, 0.2, "handL"};

Motion circleOf(Check& check, Student& student, const Simulator& S, const Circle& circle, int T) {
  const Motion motion =
      student.circleWithTasks(S.description(), circle.hand, circle.center, circle.radius, circle.pointing, T);
  checkPostures(check, motion, T, S.getJointDimension());
  return motion;
}

// f(S, t) from step `first` on.
template <class F>
Signal along(const Simulator& S, const Motion& motion, int first, const F& f) {
  Signal signal;
  Simulator moved = S;
  for (int t = first; t <= static_cast<int>(motion.size()); ++t) {
    moved.setJointAngles(motion[static_cast<std::size_t>(t) - 1]);
    signal.add(t, f(moved, t));
  }
  return signal;
}

// The motion from step `first` on as a film of at most some 300 frames, with the path in the world that the
// body should follow.
grading::Evidence seen(const Simulator& S, const std::string& body, const Motion& motion, int first,
                       const std::vector<Eigen::Vector3d>& path = {}) {
  const std::size_t stride = 1 + motion.size() / 300;
  Motion shown;
  for (std::size_t t = static_cast<std::size_t>(first) - 1; t < motion.size(); t += stride)
    shown.push_back(motion[t]);
  Film film = filmOf(S, shown, {.traces = {body}, .paths = {path}});
  for (Frame& frame : film)
    if (!path.empty()) frame.picture.captions.push_back({.text = "grey: the wanted path"});
  return {.film = std::move(film)};
}

// 2e-4 m is usual: the home task pulls the hand off its circle in proportion to the precisions.
void tracks(Check& check, const Simulator& S, const Circle& circle, const Motion& motion,
            double most = 2e-3) {
  const auto wanted = [&](int t) -> Eigen::Vector3d {
    return circle.center + circle.radius * Eigen::Vector3d(std::cos(t / 20.), 0, std::sin(t / 20.));
  };
  const auto error = [&](const Simulator& moved, int t) {
    return (moved.kinematicsPos(circle.hand) - wanted(t)).norm();
  };
  const auto shown = check.show([&] {
    std::vector<Eigen::Vector3d> path;
    for (int t = 0; t < 126; ++t) path.push_back(wanted(t));
    return seen(S, circle.hand, motion, 20, path);
  });
  check.atMostAlong("distance of " + circle.hand + " from the point on the circle",
                    along(S, motion, 20, error), most, "m");
}

void staysAtHome(Check& check, const Simulator& S, const Motion& motion) {
  const Eigen::VectorXd atFirst = S.getJointAngles();
  const auto away = [&](const Simulator& moved, int) {
    return (moved.getJointAngles() - atFirst).cwiseAbs().maxCoeff();
  };
  const auto shown = check.show([&] {
    grading::Evidence evidence = seen(S, "handR", motion, 1);
    evidence.film = grading::withWanted(evidence.film, filmOf(S, Motion{atFirst}, {}));
    return evidence;
  });
  check.atMostAlong("deviation of the joint that is farthest from its home angle", along(S, motion, 1, away),
                    2.2, "rad");
}

void pointsUpwards(Check& check, const Simulator& S, const Circle& circle, const Motion& motion) {
  const auto tilt = [&](const Simulator& moved, int) {
    return (moved.kinematicsVec(circle.pointing) - kUp).norm();
  };
  const auto shown = check.show([&] { return seen(S, circle.pointing, motion, 100); });
  check.atMostAlong("|z axis - up| of " + circle.pointing, along(S, motion, 100, tilt), 0.05);
}

void circleTracks(Check& check, Student& student) {
  check.input("man.ors, handR around (-0.2, -0.4, 1.1), radius 0.2 m, handL up, steps 20 to 300");
  const Simulator S("man.ors");
  tracks(check, S, kCircle, circleOf(check, student, S, kCircle, 300));
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
  check.atMost("deviation from home that no other task asks for", (nullspace(J).transpose() * away).norm(),
               0.02, "rad");
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
  check.nearAlong("posture", grading::overSteps(motion), wanted, 1e-9, "rad");
}

constexpr double kMargin = 0.02;
const Eigen::Vector3d kHole(0, -1, 1);
// The peg is above the hole, but the elbow is so near the frame that it touches unless it is kept away.
const Eigen::VectorXd kAbove =
    (Eigen::VectorXd(7) << 0.967552, -0.251879, -1.18846, 1.4825, 1.42033, 0.215273, -2.64193).finished();
// Bent, away from the hole; small steps lead from here to postures with room for the elbow.
const Eigen::VectorXd kStart = 0.6 * kAbove;

// An arm with a peg, a hole, and where to start.
struct Scene {
  Simulator S;
  std::string peg;
  Eigen::Vector3d hole;
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
void turnsLittle(Check& check, const Simulator& S, const Motion& motion, double limit) {
  Eigen::VectorXd before = S.getJointAngles();
  Signal turns;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    turns.add(static_cast<double>(k) + 1, (motion[k] - before).cwiseAbs().maxCoeff());
    before = motion[k];
  }
  check.atMostAlong("largest turn of a joint since the posture before", turns, limit + 1e-9, "rad");
}

// The clearance between the postures counts, too. The computed bound is at most `slack` too low.
void clearanceIsKept(Check& check, const Simulator& S, const Motion& motion) {
  const double slack = 1e-4;
  const ContactModel contacts(S.model());
  Eigen::VectorXd before = S.getJointAngles();
  Signal clearances;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    clearances.add(static_cast<double>(k) + 1,
                   std::min(motionClearance(S.model(), contacts, before, motion[k], slack), kQueryCutoff));
    before = motion[k];
  }
  check.atLeastAlong("clearance on the way to the posture", clearances, 0.5 * kMargin - slack, "m");
}

// The motion of the peg and the last part of the wanted path.
grading::Evidence wayOf(const Scene& scene, const Motion& motion) {
  return seen(scene.S, scene.peg, motion, 1, {scene.hole - 0.6 * kDown, scene.hole});
}

void pegIsAt(Check& check, const Scene& scene, const Eigen::VectorXd& q, const Eigen::Vector3d& place,
             const Eigen::Vector3d& direction) {
  const Simulator there = at(scene.S, q);
  check.near("position of the peg", there.kinematicsPos(scene.peg), place, 1e-3, "m");
  check.near("z axis of the peg", there.kinematicsVec(scene.peg), direction, 0.01);
}

void postureIsRight(Check& check, Student& student, const Scene& scene, const Eigen::Vector3d& place) {
  const Eigen::VectorXd q = student.pegPosture(scene.S.description(), scene.peg, place, kDown, kMargin);
  check.shape("posture", q, scene.S.getJointDimension(), 1);
  pegIsAt(check, scene, q, place, kDown);
  check.atLeast("clearance", clearance(at(scene.S, q)), 0.5 * kMargin, "m");
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
  const auto shown = check.show([&] { return wayOf(scene, motion); });
  Motion wanted;
  for (int t = 1; t <= T; ++t)
    wanted.emplace_back(start + (1 - std::cos(std::numbers::pi * t / T)) / 2 * (kHole - start));
  const auto position = [](const Simulator& moved, int) { return moved.kinematicsPos("peg"); };
  const auto axis = [](const Simulator& moved, int) { return moved.kinematicsVec("peg"); };
  check.nearAlong("position of the peg", along(scene.S, motion, 1, position), wanted, 5e-3, "m");
  check.nearAlong("z axis of the peg", along(scene.S, motion, 1, axis), Motion(wanted.size(), direction),
                  0.05);
  pegIsAt(check, scene, motion.back(), kHole, direction);
  turnsLittle(check, scene.S, motion, 0.1);
  clearanceIsKept(check, scene.S, motion);
}

void goesIn(Check& check, Student& student, const Scene& scene) {
  const Motion motion = student.insertPeg(scene.S.description(), scene.peg, scene.hole, kDown, kMargin);
  check.atLeast("number of postures", static_cast<double>(motion.size()), 10);
  check.atMost("number of postures", static_cast<double>(motion.size()), 1000);
  for (const Eigen::VectorXd& q : motion) check.shape("posture", q, scene.S.getJointDimension(), 1);
  const auto shown = check.show([&] { return wayOf(scene, motion); });
  turnsLittle(check, scene.S, motion, 0.1);
  pegIsAt(check, scene, motion.back(), scene.hole, kDown);
  clearanceIsKept(check, scene.S, motion);
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

// Another hole, a thicker rod instead of the peg, and another start with more room than the margin.
Scene anotherHole(Rng& rng) {
  SimulatorDescription description = Simulator("pegInAHole.ors").description();
  const Eigen::Vector3d hole = kHole + rng.uniformVector(3, -0.08, 0.08);
  const auto number = [](double x) { return std::to_string(x); };
  const std::string place = number(hole.x()) + " " + number(hole.y()) + " " + number(hole.z());
  description.sceneText = replaced(description.sceneText, "t(0 -1 1)", "t(" + place + ")");
  description.sceneText = replaced(description.sceneText, "[0 0 0.6 0.05]", "[0 0 0.6 0.06]");
  description.sceneText = replaced(description.sceneText, "peg", "rod");
  Simulator S(description);
  do S.setJointAngles(kStart + rng.uniformVector(7, -0.1, 0.1));
  while (!(clearance(S) >= 1.5 * kMargin));
  return {S, "rod", S.kinematicsPos("hole")};
}

void anotherPegAndHole(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    const Scene other = anotherHole(check.rng());
    if (i < 2) {
      goesIn(check, student, other);
    } else if (i == 2) {
      postureIsRight(check, student, other, other.hole - 0.6 * kDown);
    } else {
      const Eigen::VectorXd near = kAbove + check.rng().uniformVector(7, -0.02, 0.02);
      postureIsRight(check, student, pegInAHole(near), kHole);
    }
  });
}
// </hidden>

// Part 4.

struct TwoTasks {
  Eigen::MatrixXd J1;
  Eigen::VectorXd dy1;
  Eigen::MatrixXd J2;
  Eigen::VectorXd dy2;
};

TwoTasks randomTasks(Rng& rng, int d1, int d2, int n) {
  return {randomMatrix(rng, d1, n), rng.normalVector(d1), randomMatrix(rng, d2, n), rng.normalVector(d2)};
}

Eigen::VectorXd stepOf(Check& check, Student& student, const TwoTasks& tasks) {
  const Eigen::VectorXd dq = student.priorityStep(tasks.J1, tasks.dy1, tasks.J2, tasks.dy2);
  check.shape("dq", dq, tasks.J1.cols(), 1);
  return dq;
}

// The length of the wanted step. The second task is left out if the first leaves it no freedom.
double wantedLength(const TwoTasks& tasks) {
  const Eigen::VectorXd first = leastSquares(tasks.J1, tasks.dy1);
  const Eigen::MatrixXd free = nullspace(tasks.J1);
  Eigen::MatrixXd J = tasks.J2 * free;
  J = (J.array().abs() < 1e-9).select(0, J);  // the rounding errors of a row that the first task has, too
  if (J.size() == 0 || J.norm() == 0) return first.norm();
  return (first + free * leastSquares(J, tasks.dy2 - tasks.J2 * first)).norm();
}

void firstIsFulfilled(Check& check, const TwoTasks& tasks, const Eigen::VectorXd& dq) {
  const Eigen::VectorXd missing = tasks.J1.transpose() * (tasks.J1 * dq - tasks.dy1);
  check.atMost("relative gradient of the error of the first task",
               missing.norm() /
                   (tasks.J1.squaredNorm() * wantedLength(tasks) + (tasks.J1.transpose() * tasks.dy1).norm()),
               1e-7);
}

void secondIsAsGoodAsItCan(Check& check, const TwoTasks& tasks, const Eigen::VectorXd& dq) {
  const Eigen::MatrixXd free = nullspace(tasks.J1);
  const Eigen::VectorXd missing = tasks.J2 * dq - tasks.dy2;
  check.atMost(
      "relative gradient of the error of the second task in the directions that the first leaves free",
      (free.transpose() * tasks.J2.transpose() * missing).norm() /
          (tasks.J2.squaredNorm() * wantedLength(tasks) + tasks.J2.norm() * tasks.dy2.norm()),
      1e-7);
}

void isTheShortest(Check& check, const TwoTasks& tasks, const Eigen::VectorXd& dq) {
  Eigen::MatrixXd both(tasks.J1.rows() + tasks.J2.rows(), dq.size());
  both << tasks.J1, tasks.J2;
  check.atMost("relative part of dq that neither task asks for",
               (nullspace(both).transpose() * dq).norm() / wantedLength(tasks), 1e-7);
}

void firstComesFirst(Check& check, Student& student) {
  check.forEachCase(10, [&](int i) {
    Rng& rng = check.rng();
    TwoTasks tasks = randomTasks(rng, 3, 1 + rng.index(3), 7);
    check.input("two random tasks for 7 joints");
    if (i >= 5) {
      tasks.J2 = randomMatrix(rng, static_cast<int>(tasks.J2.rows()), 3) * tasks.J1;
      check.input("a second task that depends on the same joint motions as the first, and contradicts it");
    }
    const Eigen::VectorXd dq = stepOf(check, student, tasks);
    firstIsFulfilled(check, tasks, dq);
    check.near("J1 dq", tasks.J1 * dq, tasks.dy1, 1e-6);
  });
}

void secondComesSecond(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    const TwoTasks tasks = randomTasks(check.rng(), 3, 1 + check.rng().index(3), 7);
    check.input("two random tasks for 7 joints, which can both be fulfilled");
    const Eigen::VectorXd dq = stepOf(check, student, tasks);
    firstIsFulfilled(check, tasks, dq);
    secondIsAsGoodAsItCan(check, tasks, dq);
    isTheShortest(check, tasks, dq);
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
  check.atMostAlong("distance of handR from the point on the circle", distance, 2e-3, "m");
  check.near("z axis of handR at the end", S.kinematicsVec("handR"), kUp, 0.05);
}

// <hidden>
void anyTwoTasks(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    const int n = 3 + rng.index(8);
    TwoTasks tasks = randomTasks(rng, 1 + rng.index(6), 1 + rng.index(6), n);
    // The first task loses rank, so that it cannot be fulfilled; the second may share a row with it.
    if (i % 3 > 0)
      tasks.J1 = randomMatrix(rng, static_cast<int>(tasks.J1.rows()), 1) * randomMatrix(rng, 1, n);
    if (i % 3 > 1) tasks.J2.row(0) = tasks.J1.row(0);
    const Eigen::VectorXd dq = stepOf(check, student, tasks);
    firstIsFulfilled(check, tasks, dq);
    secondIsAsGoodAsItCan(check, tasks, dq);
    isTheShortest(check, tasks, dq);
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
      {"circle-tracks", "tasks", "the hand follows the circle", 1, Group::kVisible, circleTracks},
      {"circle-home", "tasks", "the posture stays near home", 1, Group::kVisible, circleStaysAtHome},
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
      {"peg-insert", "peg", "the whole motion into the hole, also between the postures", 2, Group::kVisible,
       goesIntoTheHole},
      // <hidden>
      {"peg-other-hole", "peg", "another peg, another hole, another start", 2, Group::kHidden,
       anotherPegAndHole},
      // </hidden>
      {"priority-first", "priority", "the second task never disturbs the first", 1, Group::kVisible,
       firstComesFirst},
      {"priority-second", "priority", "the second task gets all that the first leaves", 1, Group::kVisible,
       secondComesSecond},
      {"priority-circle", "priority", "the hand stays on its circle against a second task", 1,
       Group::kVisible, circlesUndisturbed},
      // <hidden>
      {"priority-any", "priority", "tasks of any size and rank", 1, Group::kHidden, anyTwoTasks},
      // </hidden>
  };
}
