#include "grading/check.h"

#include "candidates.h"
#include "chain_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

constexpr Convention kBoth[] = {Convention::kYawPitchRoll, Convention::k313};

// Part 1.

// A sixth of a turn about z comes first, then any axis.
void rotates(Check& check, Student& student) {
  rotatesAbout(check, student, Eigen::Vector3d::UnitZ(), kPi / 3);
  for (int i = 0; i < 10; ++i)
    rotatesAbout(check, student, randomDirection(check.rng()), check.rng().uniform(-3, 3));
}

void findsVectors(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) {
    const double angle = i % 2 == 0 ? check.rng().uniform(0.2, 1.4) : check.rng().uniform(1.7, 2.9);
    findsAxis(check, student, randomDirection(check.rng()), angle, 1e-9);
  }
}

// Near 0 and pi, about axes with entries that are zero or negative.
void findsVectorsEverywhere(Check& check, Student& student) {
  for (const double angle : {0., 1e-12, 1e-9, 1e-5, kPi - 1e-4, kPi - 1e-6, kPi - 1e-9, kPi})
    for (int i = 0; i < 6; ++i) {
      const Eigen::Vector3d axis =
          i < 3 ? Eigen::Vector3d(-Eigen::Vector3d::Unit(i)) : randomDirection(check.rng());
      findsAxis(check, student, axis, angle, 1e-7);
    }
}

void composesTurns(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i)
    composes(check, student, randomQuaternion(check.rng()), randomQuaternion(check.rng()));
}

void interpolates(Check& check, Student& student) {
  for (int i = 0; i < 8; ++i) turnsSmoothly(check, student, check.rng().uniform(0.4, 1.3), i % 2 == 1);
  turnsSmoothly(check, student, 0, false);
  turnsSmoothly(check, student, 0, true);
  turnsSmoothly(check, student, 1e-8, false);
}

// Part 2.

void turnsByAngles(Check& check, Student& student) {
  for (const Convention convention : kBoth)
    for (int i = 0; i < 6; ++i)
      turnsByEuler(check, student, convention,
                   anglesNear(check.rng(), convention, check.rng().uniform(0.2, 1.3)));
}

void findsAngles(Check& check, Student& student) {
  for (const Convention convention : kBoth)
    for (int i = 0; i < 8; ++i)
      findsEuler(check, student, convention,
                 anglesNear(check.rng(), convention, check.rng().uniform(0.2, 1.3)));
}

void findsLockedAngles(Check& check, Student& student) {
  for (const Convention convention : kBoth)
    for (int i = 0; i < 8; ++i) {
      findsEuler(check, student, convention, anglesNear(check.rng(), convention, i == 0 ? 1e-3 : 0.05));
      findsLocked(check, student, convention, i == 7);
    }
}

void findsTurningAxes(Check& check, Student& student) {
  for (const Convention convention : kBoth)
    for (int i = 0; i < 6; ++i)
      findsAxes(check, student, convention,
                anglesNear(check.rng(), convention, check.rng().uniform(0.2, 1.3)));
  for (const Convention convention : kBoth)
    for (int i = 0; i < 6; ++i) losesAxis(check, student, convention);
}

// Part 3.

void invertsTransforms(Check& check, Student& student) {
  for (int i = 0; i < 6; ++i) inverts(check, student);
}

void reachesEnds(Check& check, Student& student) {
  for (int i = 0; i < 6; ++i) movesJoint(check, student, i % 2 == 1);
  for (int n = 3; n <= 5; ++n) {
    const Chain chain = randomChain(check.rng(), n);
    const Eigen::VectorXd q = check.rng().uniformVector(n, -1.5, 1.5);
    reachesEnd(check, chain, q, matrixOf(trueEnd(chain, q)), student.endPose(chain, q), "X_WE of endPose");
  }
}

struct Robot {
  const char *scene, *body;
};
constexpr Robot kRobots[] = {{"arm3.ors", "eff"}, {"arm7.ors", "arm7"}, {"pegArm.ors", "peg"}};

// Calls `run` with a robot in a random posture, and the chain to its end.
template <class Run>
void forRobots(Check& check, const Run& run) {
  for (const Robot& robot : kRobots) {
    Simulator S(robot.scene);
    S.setJointAngles(check.rng().uniformVector(S.getJointDimension(), -1.2, 1.2));
    run(S, robot.body, chainOfRobot(S, robot.body));
  }
}

// <hidden>
void reachesRobotEnds(Check& check, Student& student) {
  forRobots(check, [&](const Simulator& S, const char* body, const Chain& chain) {
    const Eigen::VectorXd q = S.getJointAngles();
    const Eigen::Matrix4d X =
        matrixOf({rotationFromQuaternion(S.kinematicsQuat(body)), S.kinematicsPos(body)});
    reachesEnd(check, chain, q, X, student.endPose(chain, q), "X_WE of endPose, of a robot");
  });
  for (int n = 6; n <= 7; ++n) {
    const Chain chain = randomChain(check.rng(), n);
    const Eigen::VectorXd q = check.rng().uniformVector(n, -2, 2);
    reachesEnd(check, chain, q, matrixOf(trueEnd(chain, q)), student.endPose(chain, q), "X_WE of endPose");
  }
}
// </hidden>

// Part 4.

void differentiatesChain(Check& check, Student& student, int n, bool isVector) {
  const Chain chain = randomChain(check.rng(), n);
  const Eigen::VectorXd q = check.rng().uniformVector(n, -1.5, 1.5);
  const Eigen::Vector3d y = check.rng().uniformVector(3, -1, 1);
  const Eigen::MatrixXd J = numericJacobian(
      [&](const Eigen::VectorXd& at) {
        const Pose X = trueEnd(chain, at);
        return Eigen::VectorXd(isVector ? Eigen::Vector3d(X.R * y) : X * y);
      },
      q);
  if (isVector)
    movesVector(check, chain, q, y, J, student.vectorJacobian(chain, q, y));
  else
    movesPoint(check, chain, q, y, J, student.pointJacobian(chain, q, y));
}

void differentiatesChains(Check& check, Student& student) {
  for (const bool isVector : {false, true})
    for (int n = 3; n <= 7; ++n) differentiatesChain(check, student, n, isVector);
}

// <hidden>
void differentiatesRobots(Check& check, Student& student) {
  forRobots(check, [&](const Simulator& S, const char* body, const Chain& chain) {
    const Eigen::VectorXd q = S.getJointAngles();
    const Eigen::Vector3d y = check.rng().uniformVector(3, -0.3, 0.3);
    movesPoint(check, chain, q, y, S.jacobianPos(body, y), student.pointJacobian(chain, q, y));
    movesVector(check, chain, q, y, S.jacobianVec(body, y), student.vectorJacobian(chain, q, y));
  });
}
// </hidden>

void takesDifferences(Check& check, Student& student) {
  for (int n = 1; n <= 5; ++n) differentiates(check, student, n == 3 ? 3 : 6 - n, n);
}

void findsEllipsoids(Check& check, Student& student) {
  for (int d = 2; d <= 4; ++d)
    for (int n = d; n <= d + 2; ++n)
      shapesEllipsoid(check, student, check.rng().normalVector(d * n).reshaped(d, n));
}

// Part 5.

void movesAlongScrews(Check& check, Student& student) {
  for (int i = 0; i < 8; ++i) movesByScrew(check, student, i % 2 == 1);
}

void reachesEndsByScrews(Check& check, Student& student) {
  for (int n = 3; n <= 7; ++n) {
    const Chain chain = randomChain(check.rng(), n);
    findsScrews(check, student, chain);
    multipliesScrews(check, student, chain, check.rng().uniformVector(n, -1.5, 1.5));
  }
}

// Part 6. All candidates are tried in one random order, so that it gives nothing away.

void tellsMistakes(Check& check, Student& student) {
  std::vector<Candidate> candidates = rightRotations();
  const std::size_t right = candidates.size();
  for (Candidate& mistake : mistakenRotations()) candidates.push_back(std::move(mistake));
  std::vector<bool> passed(candidates.size());
  for (const std::size_t k : shuffled(candidates.size(), check.rng()))
    passed[k] = student.passesRotationTest(candidates[k].function);
  for (std::size_t k = 0; k < right; ++k) {
    check.input("a right function, " + candidates[k].what);
    const auto asked = check.ask(candidates[k].question);
    check.that("passesRotationTest accepts a right function", passed[k]);
  }
  check.forEachCase(static_cast<int>(candidates.size() - right), [&](int i) {
    const std::size_t k = right + static_cast<std::size_t>(i);
    check.input("a function with a mistake: " + candidates[k].what);
    const auto asked = check.ask(candidates[k].question);
    check.that("passesRotationTest refuses a function with a mistake", !passed[k]);
  });
}

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"rotation-matrix", "rotations", "Rodrigues' formula", 1, Group::kVisible, rotates},
      {"rotation-vector", "rotations", "Axis and angle of a rotation", 1, Group::kVisible, findsVectors},
      {"rotation-edges", "rotations", "Nearly no turn, and nearly half a turn", 1, Group::kVisible,
       findsVectorsEverywhere},
      {"quaternions", "rotations", "Two turns in a row", 1, Group::kVisible, composesTurns},
      {"interpolation", "rotations", "From one orientation to another", 1, Group::kVisible, interpolates},
      {"euler-matrix", "euler", "The rotation by three angles", 1, Group::kVisible, turnsByAngles},
      {"euler-angles", "euler", "The angles of a rotation", 1, Group::kVisible, findsAngles},
      {"euler-locked", "euler", "Angles at gimbal lock and near to it", 1, Group::kVisible,
       findsLockedAngles},
      {"euler-axes", "euler", "The axes that the angles turn about, and the one that is lost", 1,
       Group::kVisible, findsTurningAxes},
      {"transforms", "chain", "Inverse and relative transforms", 1, Group::kVisible, invertsTransforms},
      {"end", "chain", "Joints, and the end of a chain", 1, Group::kVisible, reachesEnds},
      // <hidden>
      {"end-robots", "chain", "The course's robots, and longer chains", 1, Group::kHidden, reachesRobotEnds},
      // </hidden>
      {"columns", "jacobian", "How joints move a point and turn a direction", 1, Group::kVisible,
       differentiatesChains},
      // <hidden>
      {"jacobian-robots", "jacobian", "The course's robots", 1, Group::kHidden, differentiatesRobots},
      // </hidden>
      {"differences", "jacobian", "Finite differences", 1, Group::kVisible, takesDifferences},
      {"ellipsoid", "jacobian", "The ellipsoid of manipulability", 1, Group::kVisible, findsEllipsoids},
      {"screw", "screws", "The motion of a screw", 1, Group::kVisible, movesAlongScrews},
      {"screw-chain", "screws", "Screws of a chain, and their product", 1, Group::kVisible,
       reachesEndsByScrews},
      {"rotation-test", "test", "Right functions and mistakes, told apart", 2, Group::kVisible,
       tellsMistakes},
  };
}
