#include "grading/check.h"

#include "both_checks.h"
#include "interface.h"
#include "peg_problem.h"
#include "phase_checks.h"
#include "plane_problems.h"
#include "reach_checks.h"
#include "rewire_checks.h"
#include "search_checks.h"
#include "star_checks.h"
#include "step_checks.h"
#include "tree_checks.h"
#include "tree_evidence.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

void radiusOfTwoArms(Check& check, Student& student) {
  densitiesFit(check, student, 0.6, 0.4, false);
  densitiesFit(check, student, 0.5, 0.9, false);
}

void planeOfOneArm(Check& check, Student& student) { densitiesFit(check, student, 0.6, 0.4, true); }

// <hidden>
void checkOtherArms(Check& check, Student& student) {
  for (int i = 0; i < 6; ++i) {
    const double l1 = check.rng().uniform(0.2, 2), l2 = i == 0 ? l1 : check.rng().uniform(0.2, 2);
    densitiesFit(check, student, l1, l2, true);
  }
}
// </hidden>

// Part 2.

// The first cases are in the plane, and small enough to be computed by hand.
void nearestAndStep(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    const int d = i < 6 ? 2 : 1 + rng.index(7), count = i == 6  ? 1
                                                        : i < 6 ? 4 + rng.index(8)
                                                                : 2 + rng.index(100);
    std::vector<Eigen::VectorXd> nodes;
    for (int k = 0; k < count; ++k) nodes.emplace_back(rng.uniformVector(d, -2, 2));
    const Eigen::VectorXd target = rng.uniformVector(d, -2, 2);
    nearestFits(check, student, nodes, target);
    stepTowardsFits(check, student, nodes[0], target, rng.uniform(0.1, 0.9) * (target - nodes[0]).norm());
  }
}

void targets(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (const double goalBias : {0., 0.1, 0.5, 1.}) checkSampler(check, student, goalBias, 1500, given);
  checkSampler(check, student, check.rng().uniform(0.2, 0.9), 1500, given);
}

void stepsInThePlane(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i)
    stepsWell(check, student, kThinWalls, i % 2 == 0 ? Way::kFree : Way::kEndBlocked);
}

// <hidden>
void stepsPastCorners(Check& check, Student& student) {
  for (int i = 0; i < 18; ++i)
    stepsWell(check, student, twoWalls(check.rng()).world,
              i % 3 == 0   ? Way::kFree
              : i % 3 == 1 ? Way::kEndBlocked
                           : Way::kOnlyMiddleBlocked);
}
// </hidden>

// Part 3.

void readsTheWay(Check& check, Student& student) {
  for (const int count : {1, 2, 5, 12}) wayFits(check, student, count);
}

// The goal is shut in, so that few targets give a node, and none a path.
void givesUp(Check& check, Student& student, Rng& given) {
  const PlaneWorld cell{.boxes = {{{0.78, 0.78}, {1, 0.8}}, {{0.78, 0.78}, {0.8, 1}}}};
  const SearchSettings settings = inThePlane(0.06, 0.1, 400);
  describe(check, "a goal that is shut in by walls", {cell, kLowerLeft, kUpperRight}, settings);
  int calls = 0;
  const EdgeTest counted = [&calls, isFree = freeIn(cell)](const Eigen::VectorXd& qa,
                                                           const Eigen::VectorXd& qb) {
    ++calls;
    return qa.size() == 2 && qb.size() == 2 && isFree(qa, qb);
  };
  const TreeSearch search =
      student.growBackward(kLowerLeft, kUpperRight, settings, counted, check.split(given.next()));
  check.that("the path of growBackward is empty if there is none", search.path.empty());
  const auto nodes = check.ask("Do only targets count that give a node? maxSamples limits all of them.");
  check.atMost("calls of edgeFree by growBackward, with 400 targets and no path", calls,
               3 * settings.maxSamples);
}

// A wall between the start and nodes that are nearer than a step; and a goal without a way.
void endsWell(Check& check, Student& student, Rng& given) {
  const PlaneProblem behindAWall{{.boxes = {{{0.12, 0}, {0.13, 0.5}}}}, kLowerLeft, kUpperRight};
  for (int i = 0; i < 3; ++i)
    growsBackward(check, student, "a thin wall close to the start, in the unit square", behindAWall, given);
  givesUp(check, student, given);
}

void backwardInThePlane(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  growsBackward(check, student, "two thin walls in the unit square", {kThinWalls, kLowerLeft, kUpperRight},
                given);
  endsWell(check, student, given);
  aimsAtTheStart(check, student, given);
}

// <hidden>
void backwardAnywhere(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (int i = 0; i < 4; ++i) growsBackward(check, student, "two walls", twoWalls(check.rng()), given);
  endsWell(check, student, given);
  aimsAtTheStart(check, student, given);
}
// </hidden>

void describeArm(Check& check, double goalBias) {
  check.input(
      "pegInAHole.ors, from q = 0 into the hole, with q = R (joint angles), R a random rotation",
      {{"stepSize", kArmSettings.stepSize}, {"goalBias", goalBias}, {"maxSamples", kArmSettings.maxSamples}});
}

void backwardOutOfTheHole(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  const Simulator S("pegInAHole.ors");
  const TurnedArm arm(check.rng());
  const EdgeTest isFree = arm.test(freeForArm(S));
  describeArm(check, kArmSettings.goalBias);
  for (int i = 1; i <= kArmTries; ++i) {
    ArmSearch in{S, arm, EdgeRecord(isFree, 7), isFree};
    const TreeSearch search =
        student.growBackward(kZero, arm.goal, kArmSettings, in.record.test(), check.split(given.next()));
    if (search.path.empty() && i < kArmTries) continue;
    askedWell(check, "growBackward", in.record);
    in.treeIsSound(check, "growBackward", search.tree, arm.goal);
    return in.pathFits(check, "growBackward", search.path, {search.tree}, true);
  }
}

// Part 4.

void joinsWays(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) joinFits(check, student, i < 4 ? 3 : 3 + check.rng().index(10), i % 2 == 0);
}

void bothSidesInThePlane(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (const double goalBias : {0.1, 1.})
    growsFromBoth(check, student, "two thin walls in the unit square", {kThinWalls, kLowerLeft, kUpperRight},
                  goalBias, given);
}

// <hidden>
void growsFromBothSides(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (int i = 0; i < 5; ++i)
    growsFromBoth(check, student, "two walls", twoWalls(check.rng()), i % 2 == 0 ? 0.1 : 1, given);
}
// </hidden>

void bothSidesIntoTheHole(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  const Simulator S("pegInAHole.ors");
  const TurnedArm arm(check.rng());
  const EdgeTest isFree = arm.test(freeForArm(S));
  describeArm(check, kArmSettings.goalBias);
  for (int i = 1; i <= kArmTries; ++i) {
    ArmSearch in{S, arm, EdgeRecord(isFree, 7), isFree};
    const TwoTreeSearch search =
        student.growBoth(kZero, arm.goal, kArmSettings, in.record.test(), check.split(given.next()));
    if (search.path.empty() && i < kArmTries) continue;
    askedWell(check, "growBoth", in.record);
    in.treeIsSound(check, "growBoth, from the start", search.fromStart, kZero);
    in.treeIsSound(check, "growBoth, from the goal", search.fromGoal, arm.goal);
    in.pathFits(check, "growBoth", search.path, {search.fromStart, search.fromGoal}, false);
    return check.record("queries of edgeFree by growBoth, into the hole", in.record.queries());
  }
}

// Part 5.

void checkClearance(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  double length = 0;
  for (int i = 0; i < 6; ++i) {
    const PlaneProblem problem = twoWalls(check.rng());
    const Path path = jaggedPath(problem, check.rng());
    describe(check, "the path of two trees between two thin walls in the unit square", path);
    length += shortenedLength(check, student, problem, path, true, given);
  }
  check.record("length of six paths of shortened between walls", length, "m");
  const PlaneProblem empty{{}, Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.9, 0.6)};
  double detour = 0, left = 0;
  for (int i = 0; i < 6; ++i) {
    const Path path = jaggedLine(empty, check.rng());
    describe(check, "a jagged path without obstacles", path);
    const double shortest = (empty.goal - empty.start).norm();
    detour += lengthOf(path) - shortest;
    left += shortenedLength(check, student, empty, path, false, given) - shortest;
  }
  check.input("six jagged paths without obstacles");
  check.atMost("length that the paths of shortened have beyond straight lines", left, 0.1 * detour, "m");
}

// <hidden>
void staysNearTheDisc(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  double detour = 0, left = 0;
  for (int i = 0; i < 24; ++i) {
    const DiscProblem disc = oneDisc(check.rng());
    Path path = jaggedPath(disc.problem, check.rng());
    // The shortest path goes round the disc on one side, and shortening does not lead to the other side.
    while (lengthOf(path) > 1.6 * disc.shortest) path = jaggedPath(disc.problem, check.rng());
    detour += lengthOf(path) - disc.shortest;
    left += shortenedLength(check, student, disc.problem, path, false, given) - disc.shortest;
  }
  // Skipping nodes leaves 0.27, with a standard deviation of 0.04; shortcuts between random points on edges
  // leave 0.11.
  check.atMost("share of the detours around a disc that shortened leaves", left / detour, 0.5);
}
// </hidden>

// Part 6.

void effortOfTransfers(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i) effortFits(check, student, randomTransfer(check.rng()));
  const Transfer drift{{0.3, -1}, {0.3 - 2, -1}, 2};
  check.input("a state that the point reaches without force",
              {{"from", drift.from}, {"to", drift.to}, {"T", drift.T}});
  check.near("effort without force", student.effort(drift.from, drift.to, drift.T), 0, 1e-8, "N^2 s");
}

// The whole motion at once ends at its target; then first parts of it, from a few states.
void stepsToTheTarget(Check& check, Student& student) {
  for (int i = 0; i < 8; ++i) {
    const Transfer x = randomTransfer(check.rng());
    std::vector<Eigen::Vector2d> states{x.from};
    for (int k = 0; k < 8 && i >= 4; ++k) states.emplace_back(check.rng().uniformVector(2, -3, 3));
    phaseStepFits(check, student, states, x, i < 4 ? x.T : check.rng().uniform(.05, 1) * x.T);
  }
}

// <hidden>
void stepsInPhaseSpace(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i) {
    Rng& rng = check.rng();
    std::vector<Eigen::Vector2d> states;
    for (int k = 0; k < 40; ++k) states.emplace_back(rng.uniformVector(2, -3, 3));
    const Transfer x = randomTransfer(rng);
    phaseStepFits(check, student, states, x, i == 0 ? x.T : rng.uniform(0.05, 1) * x.T);
  }
}
// </hidden>

// Part 7.

void choosesTheBest(Check& check, Student& student) {
  for (int i = 0; i < 25; ++i) {
    Rng& rng = check.rng();
    const PlaneWorld world = twoWalls(rng).world;
    const Tree tree = wildTree(world, 60, rng);
    Eigen::VectorXd q = rng.uniformVector(2, 0, 1);
    while (!wayIsFree(world, q, q)) q = rng.uniformVector(2, 0, 1);
    choosesParent(check, student, world, tree, q, nodesNear(tree, q, i == 0 ? 0. : 0.35, rng));
  }
}

void rewires(Check& check, Student& student) {
  for (int i = 0; i < 15; ++i) rewiringFits(check, student);
}

void growsAroundThinWalls(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  const PlaneProblem problem{kThinWalls, kLowerLeft, kUpperRight};
  const SearchSettings settings = inThePlane(0.1, 0.1, 1500);
  describe(check, "two thin walls in the unit square", problem, settings);
  check.record("length of the path of growStar between thin walls",
               starIsSound(check, student, problem, settings, given), "m");
}

// <hidden>
void growsAroundWalls(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (int i = 0; i < 3; ++i)
    starIsSound(check, student, twoWalls(check.rng()), inThePlane(0.1, 0.1, 1500), given);
}

void comesNearTheShortest(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  double excess = 0;
  const int count = 4;
  for (int i = 0; i < count; ++i) {
    const DiscProblem disc = oneDisc(check.rng());
    excess +=
        starIsSound(check, student, disc.problem, inThePlane(0.1, 0.05, 1500), given) / disc.shortest - 1;
  }
  // Usually 0.019, with a standard deviation of 0.004; an RRT path is longer by 0.36, and by at least 0.2.
  check.atMost(
      "excess of the path of growStar over the shortest, as a share of it, on average over four worlds",
      excess / count, 0.06);
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"reach-radius", "reach", "The distance of the hand from the shoulder", 1, Group::kVisible,
       radiusOfTwoArms},
      {"reach-plane", "reach", "The position of the hand in the plane, for one arm (no points)", 0,
       Group::kVisible, planeOfOneArm},
      {"step-nearest", "step", "The nearest node, and a step that does not overshoot", 1, Group::kVisible,
       nearestAndStep},
      {"step-target", "step", "Random targets with a goal bias", 1, Group::kVisible, targets},
      {"step-plane", "step", "A step in the plane", 1, Group::kVisible, stepsInThePlane},
      {"backward-way", "backward", "The path from the root to a node", 1, Group::kVisible, readsTheWay},
      {"backward-plane", "backward", "A search between thin walls, and the goal bias (no points)", 0,
       Group::kVisible, backwardInThePlane},
      {"backward-arm", "backward", "From the hole back to q = 0", 1, Group::kVisible, backwardOutOfTheHole},
      {"connect-joined", "connect", "Two branches joined to a path", 1, Group::kVisible, joinsWays},
      {"connect-plane", "connect", "From both sides between thin walls (no points)", 0, Group::kVisible,
       bothSidesInThePlane},
      {"connect-arm", "connect", "From both sides into the hole", 1, Group::kVisible, bothSidesIntoTheHole},
      {"smooth-free", "smooth", "Shorter, with the same ends, and free", 1, Group::kVisible, checkClearance},
      {"phase-effort", "phase", "The least effort and its force", 1, Group::kVisible, effortOfTransfers},
      {"phase-whole-step", "phase", "A step, of the whole motion or a part of it (no points)", 0,
       Group::kVisible, stepsToTheTarget},
      {"star-parent", "star", "The best parent", 1, Group::kVisible, choosesTheBest},
      {"star-rewired", "star", "Rewiring, and what follows from it", 1, Group::kVisible, rewires},
      {"star-thin-walls", "star", "A whole tree between thin walls (no points)", 0, Group::kVisible,
       growsAroundThinWalls},
      // <hidden>
      {"reach-any-arm", "reach", "Other arms, and the density in the plane", 1, Group::kHidden,
       checkOtherArms},
      {"step-corners", "step", "Steps past corners of other worlds", 1, Group::kHidden, stepsPastCorners},
      {"backward-worlds", "backward", "Other worlds, and the goal bias", 1, Group::kHidden, backwardAnywhere},
      {"connect-worlds", "connect", "From both sides in other worlds", 1, Group::kHidden, growsFromBothSides},
      {"smooth-disc", "smooth", "How much shorter", 1, Group::kHidden, staysNearTheDisc},
      {"phase-step", "phase", "Growing a tree in phase space", 1, Group::kHidden, stepsInPhaseSpace},
      {"star-worlds", "star", "Trees and costs in other worlds", 1, Group::kHidden, growsAroundWalls},
      {"star-shortest", "star", "Close to the shortest path", 1, Group::kHidden, comesNearTheShortest},
      // </hidden>
  };
}
