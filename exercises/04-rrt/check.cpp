#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/QR>

#include "collision/motion_clearance.h"
#include "interface.h"
#include "peg_problem.h"
#include "phase_checks.h"
#include "plane_problems.h"
#include "planning/phase_space.h"
#include "tree_checks.h"
#include "tree_evidence.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

std::string text(double x) { return std::to_string(x).substr(0, 5); }

// The random generators passed to students come from a separate stream in each check: rewinding them does not
// reveal what the grader draws.
Rng generatorsOf(Check& check) { return check.rng().split(7); }

// Part 1.

// The share of postures with the hand nearer than r: those with a larger second angle than the one at r.
double shareWithin(double r, double l1, double l2) {
  const double cosine = std::clamp((r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1., 1.);
  return 1 - std::acos(cosine) / std::numbers::pi;
}

grading::Evidence densitySeen(double l1, double l2, double r, double got) {
  const double least = std::abs(l1 - l2), most = l1 + l2, h = 1e-4;
  Series wanted = grading::wantedCurve("wanted");
  for (double share = .01; share < .995; share += .01) {
    wanted.x.push_back(least + share * (most - least));
    wanted.y.push_back((shareWithin(wanted.x.back() + h, l1, l2) - shareWithin(wanted.x.back() - h, l1, l2)) /
                       (2 * h));
  }
  return {.figures = {{.title = "Density of the distance of the hand",
                       .xLabel = "r [m]",
                       .yLabel = "density [1/m]",
                       .series = {wanted, grading::wrongPoint("got", r, got)}}}};
}

// At random distances r, kept away from both ends so that differences of 1e-5 m are exact to 1e-6.
void densitiesAreRight(Check& check, Student& student, double l1, double l2, bool inThePlane) {
  Rng& rng = check.rng();
  const double least = std::abs(l1 - l2), most = l1 + l2, h = 1e-5;
  for (int i = 0; i < 10; ++i) {
    const double r = least + rng.uniform(0.02, 0.98) * (most - least);
    const double wanted = (shareWithin(r + h, l1, l2) - shareWithin(r - h, l1, l2)) / (2 * h);
    check.input("l1 = " + text(l1) + " m, l2 = " + text(l2) + " m, r = " + text(r) + " m");
    const double got = student.radiusDensity(r, l1, l2);
    const auto shown = check.show([&] { return densitySeen(l1, l2, r, got); });
    check.near("density of r", got, wanted, 1e-5 * wanted, "1/m");
    if (!inThePlane) continue;
    const double angle = rng.uniform(-4, 4);
    check.near("density in the plane",
               student.handDensity({r * std::cos(angle), r * std::sin(angle)}, l1, l2),
               wanted / (2 * std::numbers::pi * r), 1e-5 * wanted / r, "1/m^2");
  }
  check.input("l1 = " + text(l1) + " m, l2 = " + text(l2) + " m, where the hand cannot be");
  check.near("density of r", student.radiusDensity(1.01 * most, l1, l2), 0, 0, "1/m");
  if (inThePlane) check.near("density in the plane", student.handDensity({0, 1.2 * most}, l1, l2), 0, 0);
  if (least > 0.01) check.near("density of r", student.radiusDensity(0.98 * least, l1, l2), 0, 0, "1/m");
}

void radiusOfTwoArms(Check& check, Student& student) {
  densitiesAreRight(check, student, 0.6, 0.4, false);
  densitiesAreRight(check, student, 0.5, 0.9, false);
}

void planeOfOneArm(Check& check, Student& student) { densitiesAreRight(check, student, 0.6, 0.4, true); }

// <hidden>
void anyArm(Check& check, Student& student) {
  for (int i = 0; i < 6; ++i) {
    const double l1 = check.rng().uniform(0.2, 2), l2 = i == 0 ? l1 : check.rng().uniform(0.2, 2);
    densitiesAreRight(check, student, l1, l2, true);
  }
}
// </hidden>

// Part 2.

void nearestAndStep(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (int i = 0; i < 20; ++i) {
    const int d = 1 + rng.index(7), count = i == 0 ? 1 : 2 + rng.index(100);
    std::vector<Eigen::VectorXd> nodes;
    for (int k = 0; k < count; ++k) nodes.emplace_back(rng.uniformVector(d, -2, 2));
    const Eigen::VectorXd target = rng.uniformVector(d, -2, 2);
    check.input(std::to_string(count) + " random nodes and a target, d = " + std::to_string(d));
    check.near("number of the nearest node", student.nearestNode(nodes, target), nearestOf(nodes, target), 0);
    const Eigen::VectorXd& from = nodes[0];
    const double distance = (target - from).norm(), share = rng.uniform(0.1, 0.9);
    check.near("a step towards a target that is farther", student.stepTowards(from, target, share * distance),
               from + share * (target - from), 1e-12);
    check.near("a step towards a target that is nearer", student.stepTowards(from, target, 2 * distance),
               target, 0);
    check.near("a step from the target to itself", student.stepTowards(target, target, 0.1), target, 0);
  }
}

// n draws. Shares and moments must be within 5.5 standard deviations, which fails for one correct answer in
// 25 million.
void drawsWell(Check& check, Student& student, double goalBias, int n, Rng& given) {
  const Eigen::Vector3d lower(-1, 2, -0.5), upper(1, 2.5, 6), aim(7, 8, 9), size = upper - lower;
  const SearchSettings settings{lower, upper, 0.1, goalBias, 1000};
  check.input("a box from (-1, 2, -0.5) to (1, 2.5, 6), goalBias = " + text(goalBias));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  int others = 0;
  for (int i = 0; i < n; ++i) {
    const Eigen::VectorXd target = student.drawTarget(settings, aim, Rng(given.next()));
    check.shape("target", target, 3, 1);
    if (target == aim) continue;
    const Eigen::Vector3d place = ((target - lower).array() / size.array() - 0.5).matrix();
    check.atMost("distance of a target from the middle of the box, relative to its size",
                 place.cwiseAbs().maxCoeff(), 0.5);
    sum += place;
    products += place * place.transpose();
    ++others;
  }
  const double sigmas = 5.5, count = std::max(others, 1);
  check.near("share of draws that are the aim", 1 - static_cast<double>(others) / n, goalBias,
             sigmas * std::sqrt(goalBias * (1 - goalBias) / n));
  if (others == 0) return;
  check.near("mean of the others, relative to the size of the box", sum / count, Eigen::Vector3d::Zero(),
             sigmas / std::sqrt(12 * count));
  check.near("mean square of the others, relative to the size of the box", products.diagonal() / count,
             Eigen::Vector3d::Constant(1 / 12.), sigmas / std::sqrt(180 * count));
  check.near("covariances of the coordinates of the others, relative to the size of the box",
             Eigen::Vector3d(products(0, 1), products(0, 2), products(1, 2)) / count, Eigen::Vector3d::Zero(),
             sigmas / (12 * std::sqrt(count)));
}

void targets(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (const double goalBias : {0., 0.1, 0.5, 1.}) drawsWell(check, student, goalBias, 1500, given);
  drawsWell(check, student, check.rng().uniform(0.2, 0.9), 1500, given);
}

// What lies between the nearest node and the new one.
enum class Way { kFree, kEndBlocked, kOnlyMiddleBlocked };

void stepsWell(Check& check, Student& student, const PlaneWorld& world, Way wanted) {
  Rng& rng = check.rng();
  const double stepSize = rng.uniform(0.08, 0.15);
  const EdgeTest isFree = freeIn(world);
  Tree tree;
  Eigen::VectorXd target, q;
  int parent = 0;
  bool found = false;
  for (int i = 0; !found; ++i) {
    if (i % 100 == 0) tree = wildTree(world, 60, rng);  // not every tree has nodes beside a wall
    target = rng.uniformVector(2, 0, 1);
    parent = nearestOf(tree.nodes, target);
    const Eigen::VectorXd& from = tree.nodes[static_cast<std::size_t>(parent)];
    q = from + std::min(1., stepSize / (target - from).norm()) * (target - from);
    found = isFree(from, q) ? wanted == Way::kFree
                            : wanted == (isFree(q, q) ? Way::kOnlyMiddleBlocked : Way::kEndBlocked);
  }
  tree.costs.clear();
  EdgeRecord record(isFree, 2);
  check.input("a tree of 60 nodes in the unit square with walls and discs, a random target, stepSize = " +
              text(stepSize));
  const std::optional<NewNode> got = student.rrtStep(tree, target, stepSize, record.test());
  const auto shown = check.show([&] {
    return edgeSeen("A step towards a random target", world, tree,
                    got ? PlaneEdge{got->parent, got->q} : PlaneEdge{},
                    wanted == Way::kFree ? PlaneEdge{parent, q} : PlaneEdge{});
  });
  askedWell(check, record);
  if (wanted == Way::kFree) {
    check.that("a free step gives a node", got.has_value());
    check.near("parent of the new node", got->parent, parent, 0);
    check.near("new node", got->q, q, 1e-12);
    check.that("edgeFree was called for the new edge",
               record.wasFree(tree.nodes[static_cast<std::size_t>(parent)], got->q));
  } else if (wanted == Way::kEndBlocked) {
    check.that("a step into an obstacle gives no node", !got.has_value());
  } else {
    check.that("a step through an obstacle gives no node", !got.has_value());
  }
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
  for (const int count : {1, 2, 5, 12}) {
    const Path way = randomPath(count, check.rng());
    const TreeWithWay made = treeAround(way, check.rng());
    check.input("a random tree in the plane, and a node with " + std::to_string(count - 1) +
                " edges between it and the root");
    const Path got = student.wayFromRoot(made.tree, made.last);
    const auto shown = check.show([&] { return pathSeen(got, way); });
    isPath(check, got, way);
  }
}

void backwardIsSound(Check& check, const TreeSearch& search, const PlaneProblem& problem,
                     const SearchSettings& settings, const EdgeRecord& record, const EdgeTest& isFree) {
  askedWell(check, record);
  isTree(check, search.tree, problem.goal, true);
  edgesAreSound(check, search.tree, settings.stepSize, record, isFree);
  pathIsSound(check, search.path, problem.start, problem.goal, settings.stepSize, isFree);
  pathIsOfTrees(check, {search.path.begin() + 1, search.path.end()}, {search.tree});
}

// <hidden>
void growsBackward(Check& check, Student& student, Rng& given) {
  for (int i = 0; i < 4; ++i) {
    const PlaneProblem problem = twoWalls(check.rng());
    const SearchSettings settings = inThePlane(0.06, 0.1, 20000);
    const EdgeTest isFree = freeIn(problem.world);
    EdgeRecord record(isFree, 2);
    const TreeSearch search =
        student.growBackward(problem.start, problem.goal, settings, record.test(), Rng(given.next()));
    backwardIsSound(check, search, problem, settings, record, isFree);
  }
}

// The mean number of nodes over that many searches, with eighty steps from root to start. There are no
// obstacles, so that each target gives a node.
double nodesWithBias(Check& check, Student& student, double goalBias, int searches, Rng& given) {
  double sum = 0;
  for (int i = 0; i < searches; ++i) {
    const Eigen::VectorXd start = check.rng().uniformVector(2, -1, 1);
    const double angle = check.rng().uniform(-4, 4);
    const Eigen::VectorXd goal = start + 8 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const SearchSettings settings{Eigen::Vector2d(-20, -20), Eigen::Vector2d(20, 20), 0.1, goalBias, 4000};
    const EdgeTest isFree = [](const Eigen::VectorXd&, const Eigen::VectorXd&) { return true; };
    EdgeRecord record(isFree, 2);
    const TreeSearch search = student.growBackward(start, goal, settings, record.test(), Rng(given.next()));
    backwardIsSound(check, search, {{}, start, goal}, settings, record, isFree);
    sum += static_cast<double>(search.tree.nodes.size());
  }
  return sum / searches;
}

// Over 30 seeds, four searches have 230 nodes with a standard deviation of 23 for the low bias, and 130 with
// one of 4 for the high one. A fixed bias of 0.2 gives 172, one of 0.5 gives 115, whatever bias is required.
void aimsAtTheStart(Check& check, Student& student, Rng& given) {
  const double rare = nodesWithBias(check, student, 0.1, 8, given),
               often = nodesWithBias(check, student, 0.4, 4, given);
  check.atLeast("mean number of nodes of trees with goalBias = 0.1", rare, 150);
  check.atMost("mean number of nodes of trees with goalBias = 0.1", rare, 340);
  check.atLeast("mean number of nodes of trees with goalBias = 0.4", often, 105);
  check.atMost("mean number of nodes of trees with goalBias = 0.4", often, 155);
}

void backwardAnywhere(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  growsBackward(check, student, given);
  aimsAtTheStart(check, student, given);
}
// </hidden>

// The arm as students see it in the checks: its joint angles are rotated at random, q = R (joint angles).
// That preserves distances and straight lines, and makes postures recorded beforehand useless.
struct TurnedArm {
  explicit TurnedArm(Rng& rng) : goal(7) {
    R = Eigen::HouseholderQR<Eigen::MatrixXd>(rng.normalVector(49).reshaped(7, 7)).householderQ();
    goal = R * kInTheHole;
  }
  EdgeTest test(const EdgeTest& isFree) const {
    return [isFree, R = R](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
      return isFree(R.transpose() * qa, R.transpose() * qb);
    };
  }
  Path joints(const Path& path) const {
    Path turned;
    for (const Eigen::VectorXd& q : path) turned.push_back(q.size() == 7 ? R.transpose() * q : q);
    return turned;
  }

  Eigen::MatrixXd R;
  Eigen::VectorXd goal;
};

EdgeTest contactFreeEdges(const Simulator& S) {
  return [&S](const Eigen::VectorXd& qa, const Eigen::VectorXd& qb) {
    return motionClearance(S.model(), ContactModel(S.model()), qa, qb, 1e-3) > 0;
  };
}

auto showArm(Check& check, const Simulator& S, const TurnedArm& arm, const Path& path) {
  return check.show([&] {
    return armPathSeen(S, arm.joints(path), kInTheHole, kArmSettings.stepSize, contactFreeEdges(S));
  });
}

void armPathIsSound(Check& check, const Simulator& S, const TurnedArm& arm, const Path& path) {
  pathIsSound(check, path, kZero, arm.goal, kArmSettings.stepSize, arm.test(contactFreeEdges(S)));
}

void backwardOutOfTheHole(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  const Simulator S("pegInAHole.ors");
  const TurnedArm arm(check.rng());
  const EdgeTest isFree = arm.test(freeForArm(S));
  check.input(
      "pegInAHole.ors, from q = 0 into the hole, with q = R (joint angles), R a random rotation, "
      "stepSize = 0.1, goalBias = 0.1");
  for (int i = 1; i <= kArmTries; ++i) {
    EdgeRecord record(isFree, 7);
    const TreeSearch search =
        student.growBackward(kZero, arm.goal, kArmSettings, record.test(), Rng(given.next()));
    if (search.path.empty() && i < kArmTries) continue;
    const auto shown = showArm(check, S, arm, search.path);
    backwardIsSound(check, search, {{}, kZero, arm.goal}, kArmSettings, record, isFree);
    return armPathIsSound(check, S, arm, search.path);
  }
}

// Part 4.

void joinsWays(Check& check, Student& student) {
  for (int i = 0; i < 10; ++i) {
    Rng& rng = check.rng();
    const int count = 3 + rng.index(10), split = 1 + rng.index(count - 2);
    const bool meets = i % 2 == 0;
    const Path whole = randomPath(count, rng);
    const Path first(whole.begin(), whole.begin() + split + 1);
    const Path second(whole.rbegin(), whole.rend() - split - (meets ? 0 : 1));
    const TreeWithWay one = treeAround(first, rng), other = treeAround(second, rng);
    check.input(meets ? "two random trees, nodes a and b are the same configuration"
                      : "two random trees, nodes a and b are different configurations");
    const Path got = student.joinedPath(one.tree, one.last, other.tree, other.last);
    const auto shown = check.show([&] { return pathSeen(got, whole); });
    isPath(check, got, whole);
  }
}

void twoTreesAreSound(Check& check, const TwoTreeSearch& search, const PlaneProblem& problem, double stepSize,
                      const EdgeRecord& record, const EdgeTest& isFree) {
  askedWell(check, record);
  isTree(check, search.fromStart, problem.start, true);
  isTree(check, search.fromGoal, problem.goal, true);
  edgesAreSound(check, search.fromStart, stepSize, record, isFree);
  edgesAreSound(check, search.fromGoal, stepSize, record, isFree);
  pathIsSound(check, search.path, problem.start, problem.goal, stepSize, isFree);
  pathIsOfTrees(check, search.path, {search.fromStart, search.fromGoal});
}

// <hidden>
// In these worlds both trees have to grow, since one alone would take much longer to get through two gaps: at
// least one node in twenty belongs to the smaller of the two.
void growsFromBothSides(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (int i = 0; i < 5; ++i) {
    const PlaneProblem problem = twoWalls(check.rng());
    const SearchSettings settings = inThePlane(0.06, 0.1, 20000);
    const EdgeTest isFree = freeIn(problem.world);
    EdgeRecord record(isFree, 2);
    const TwoTreeSearch search =
        student.growBoth(problem.start, problem.goal, settings, record.test(), Rng(given.next()));
    twoTreesAreSound(check, search, problem, settings.stepSize, record, isFree);
    const double one = static_cast<double>(search.fromStart.nodes.size());
    const double other = static_cast<double>(search.fromGoal.nodes.size());
    check.atLeast("share of nodes in the smaller tree", std::min(one, other) / (one + other), 0.05);
  }
}
// </hidden>

void bothSidesIntoTheHole(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  const Simulator S("pegInAHole.ors");
  const TurnedArm arm(check.rng());
  const EdgeTest isFree = arm.test(freeForArm(S));
  check.input(
      "pegInAHole.ors, from q = 0 into the hole, with q = R (joint angles), R a random rotation, "
      "stepSize = 0.1");
  for (int i = 1; i <= kArmTries; ++i) {
    EdgeRecord record(isFree, 7);
    const TwoTreeSearch search =
        student.growBoth(kZero, arm.goal, kArmSettings, record.test(), Rng(given.next()));
    if (search.path.empty() && i < kArmTries) continue;
    const auto shown = showArm(check, S, arm, search.path);
    twoTreesAreSound(check, search, {{}, kZero, arm.goal}, kArmSettings.stepSize, record, isFree);
    return armPathIsSound(check, S, arm, search.path);
  }
}

// Part 5.

// The length of the shortened path, which must be free, have the same ends and not be longer.
double shortenedLength(Check& check, Student& student, const PlaneProblem& problem, const Path& path,
                       Rng& given) {
  EdgeRecord record(freeIn(problem.world), 2);
  const Path better = student.shortened(path, record.test(), Rng(given.next()));
  const auto shown = check.show([&] { return shortenedSeen(problem, path, better); });
  askedWell(check, record);
  // Pieces of free edges are free, up to the last digits.
  pathIsSound(check, better, problem.start, problem.goal, 2, freeIn(problem.world, 1e-9));
  check.atMost("length of the shortened path", lengthOf(better), lengthOf(path) + 1e-9);
  return lengthOf(better);
}

void staysFree(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  for (int i = 0; i < 6; ++i) {
    const PlaneProblem problem = twoWalls(check.rng());
    check.input("the path of two trees between two thin walls in the unit square");
    const Path path = jaggedPath(problem, check.rng());
    check.that("the shortened path is really shorter",
               shortenedLength(check, student, problem, path, given) < lengthOf(path) - 1e-3);
  }
  const PlaneProblem empty{{}, Eigen::Vector2d(0.1, 0.2), Eigen::Vector2d(0.9, 0.6)};
  double detour = 0, left = 0;
  for (int i = 0; i < 6; ++i) {
    check.input("a jagged path without obstacles");
    Path path{empty.start};
    for (int k = 1; k < 12; ++k)
      path.emplace_back(empty.start + k / 12. * (empty.goal - empty.start) +
                        check.rng().uniformVector(2, -0.06, 0.06));
    path.push_back(empty.goal);
    const double shortest = (empty.goal - empty.start).norm();
    detour += lengthOf(path) - shortest;
    left += shortenedLength(check, student, empty, path, given) - shortest;
  }
  check.atMost("remaining share of six detours", left / detour, 0.1);
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
    left += shortenedLength(check, student, disc.problem, path, given) - disc.shortest;
  }
  // Skipping nodes leaves 0.27, with a standard deviation of 0.04; shortcuts between random points on edges
  // leave 0.11.
  check.atMost("remaining share of many detours around a disc", left / detour, 0.5);
}
// </hidden>

// Part 6.

void effortOfTransfers(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i) {
    check.input("random states, T between 0.5 and 4 s");
    leastEffortIsRight(check, student, randomTransfer(check.rng()));
  }
  const Transfer drift{{0.3, -1}, {0.3 - 2, -1}, 2};
  check.input("a state that the point reaches without force");
  check.near("effort without force", student.effort(drift.from, drift.to, drift.T), 0, 1e-8, "N^2 s");
}

// The whole motion at once ends at its target.
void stepsToTheTarget(Check& check, Student& student) {
  for (int i = 0; i < 4; ++i) {
    const Transfer x = randomTransfer(check.rng());
    check.input("one state, and tau = T: the whole motion to the target");
    const PhaseNode node = student.phaseStep({x.from}, x.to, x.T, x.T);
    check.near("number of the state from which the target needs the least effort", node.parent, 0, 0);
    check.near("state after T seconds", node.x, x.to, 1e-8 * (1 + x.T * x.T));
  }
}

// <hidden>
void stepsInPhaseSpace(Check& check, Student& student) {
  for (int i = 0; i < 12; ++i) {
    Rng& rng = check.rng();
    std::vector<Eigen::Vector2d> states;
    for (int k = 0; k < 40; ++k) states.emplace_back(rng.uniformVector(2, -3, 3));
    const Transfer x = randomTransfer(rng);
    const double tau = i == 0 ? x.T : rng.uniform(0.05, 1) * x.T;
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < states.size(); ++k)
      if (leastEffort(states[k], x.to, x.T) < leastEffort(states[nearest], x.to, x.T)) nearest = k;
    const PhaseNode node = student.phaseStep(states, x.to, x.T, tau);
    check.near("number of the state from which the target needs the least effort", node.parent,
               static_cast<double>(nearest), 0);
    check.near("state after tau seconds", node.x, leastEffortState(states[nearest], x.to, x.T, tau), 1e-8);
  }
}
// </hidden>

// Part 7.

// The number of the node of `near` through which q costs least; -1 if there is none.
int bestOf(const PlaneWorld& world, const Tree& tree, const std::vector<int>& near,
           const Eigen::VectorXd& q) {
  int best = -1;
  double least = 0;
  for (const int k : near) {
    const auto at = static_cast<std::size_t>(k);
    const double cost = tree.costs[at] + (q - tree.nodes[at]).norm();
    if (!wayIsFree(world, tree.nodes[at], q) || (best >= 0 && cost >= least)) continue;
    best = k;
    least = cost;
  }
  return best;
}

void choosesTheBest(Check& check, Student& student) {
  for (int i = 0; i < 25; ++i) {
    Rng& rng = check.rng();
    const PlaneWorld world = twoWalls(rng).world;
    const Tree tree = wildTree(world, 60, rng);
    Eigen::VectorXd q = rng.uniformVector(2, 0, 1);
    while (!wayIsFree(world, q, q)) q = rng.uniformVector(2, 0, 1);
    const std::vector<int> near = nodesNear(tree, q, i == 0 ? 0. : 0.35, rng);
    bool anyFree = false;
    for (const int k : near)
      anyFree = anyFree || wayIsFree(world, tree.nodes[static_cast<std::size_t>(k)], q);
    EdgeRecord record(freeIn(world), 2);
    check.input("a random tree in the plane, and " + std::to_string(near.size()) + " of its nodes as `near`");
    const std::optional<ParentChoice> chosen = student.bestParent(tree, near, q, record.test());
    const auto shown = check.show([&] {
      return edgeSeen("The parent of a new node", world, tree, {chosen ? chosen->parent : -1, q},
                      {bestOf(world, tree, near, q), q});
    });
    askedWell(check, record);
    check.that("there is a parent if and only if an edge is free", chosen.has_value() == anyFree);
    if (!chosen) continue;
    check.that("the parent is one of `near`",
               std::find(near.begin(), near.end(), chosen->parent) != near.end());
    // With q as a child of the chosen parent, no other node would be a better parent.
    const Eigen::VectorXd& from = tree.nodes[static_cast<std::size_t>(chosen->parent)];
    check.that("edgeFree was called for the new edge and returned true", record.wasFree(from, q));
    check.near("cost of the new node", chosen->cost,
               tree.costs[static_cast<std::size_t>(chosen->parent)] + (q - from).norm(), 1e-9);
    Tree grown = tree;
    grown.nodes.push_back(q);
    grown.costs.push_back(chosen->cost);
    for (const int k : near)
      check.that("no other parent gives less cost over a free edge",
                 !gains(world, grown, static_cast<int>(tree.nodes.size()), k));
  }
}

// Every near node that gains by it is a child of the node afterwards, no other node has a new parent, and all
// costs are lengths of paths again. The order of `near` does not matter: a node that becomes cheaper because
// its parent does would still be cheaper through the node, by the triangle inequality.
void rewires(Check& check, Student& student) {
  for (int i = 0; i < 15; ++i) {
    Rng& rng = check.rng();
    const PlaneWorld world = twoWalls(rng).world;
    const int node = 79;
    Tree tree;
    std::vector<int> near;
    // At least two gain, and one of those has children.
    for (int gaining = 0, carried = 0; gaining < 2 || carried == 0;) {
      tree = wildTree(world, node + 1, rng);
      near = nodesNear(tree, tree.nodes.back(), 0.35, rng);
      near.erase(std::find(near.begin(), near.end(), node));
      gaining = carried = 0;
      for (const int other : near) {
        if (!gains(world, tree, other, node)) continue;
        ++gaining;
        carried += static_cast<int>(std::count(tree.parents.begin(), tree.parents.end(), other));
      }
    }
    EdgeRecord record(freeIn(world), 2);
    check.input("a random tree in the plane, its last node, and all nodes within 0.35 of that");
    const Tree got = student.rewired(tree, near, node, record.test());
    askedWell(check, record);
    isPath(check, got.nodes, tree.nodes);
    isTree(check, got, tree.nodes[0], false);
    check.near("number of costs", static_cast<double>(got.costs.size()), node + 1, 0);
    const std::vector<double> costs = costsOf(got);
    Tree wanted = tree;
    for (const int k : near)
      if (gains(world, tree, k, node)) wanted.parents[static_cast<std::size_t>(k)] = node;
    const auto shown = check.show([&] { return rewiredSeen(world, got, wanted); });
    for (int k = 0; k <= node; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const bool moves = wanted.parents[at] != tree.parents[at];
      check.near("parent of a node", got.parents[at], wanted.parents[at], 0);
      check.near("cost of a node against the length of its path", got.costs[at], costs[at], 1e-9);
      if (moves)
        check.that("edgeFree was called for the new edges", record.wasFree(got.nodes[at], got.nodes[node]));
    }
  }
}

// Checks what holds for every tree of RRT*, and returns the cost of its path.
double starIsSound(Check& check, Student& student, const PlaneProblem& problem,
                   const SearchSettings& settings, Rng& given) {
  const EdgeTest isFree = freeIn(problem.world);
  EdgeRecord record(isFree, 2);
  const StarSearch search = student.growStar.orInfinite()(problem.start, problem.goal, settings, 1.5,
                                                          record.test(), Rng(given.next()));
  const Tree& grown = search.tree;
  askedWell(check, record);
  isTree(check, grown, problem.start, false);
  const auto shown = check.show([&] { return treeSeen(problem, grown, settings.stepSize); });
  edgesAreSound(check, grown, settings.stepSize, record, isFree);
  check.near("number of costs", static_cast<double>(grown.costs.size()),
             static_cast<double>(grown.nodes.size()), 0);
  const std::vector<double> costs = costsOf(grown);
  for (std::size_t i = 0; i < costs.size(); ++i)
    check.near("cost of a node against the length of its path", grown.costs[i], costs[i], 1e-9);
  check.near("number of costs in `best`", static_cast<double>(search.best.size()), settings.maxSamples, 0);
  for (std::size_t i = 1; i < search.best.size(); ++i)
    check.that("the cost of the goal never grows", search.best[i] <= search.best[i - 1]);
  check.that("the goal is reached", search.goal >= 0 && search.goal < static_cast<int>(grown.nodes.size()));
  const auto goal = static_cast<std::size_t>(search.goal);
  check.near("the node that is the goal", grown.nodes[goal], problem.goal, 0);
  check.near("the last cost of the goal", search.best.back(), costs[goal], 1e-9);
  growsWhileItImproves(check, search, problem.world, settings);
  return costs[goal];
}

void growsAroundThinWalls(Check& check, Student& student) {
  Rng given = generatorsOf(check);
  check.input("two thin walls in the unit square, from (0.1, 0.1) to (0.9, 0.9)");
  starIsSound(check, student, {kThinWalls, kLowerLeft, kUpperRight}, inThePlane(0.1, 0.1, 1500), given);
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
  check.atMost("excess over the shortest path, as a share of it, on average over four worlds", excess / count,
               0.06);
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
      {"backward-arm", "backward", "From the hole back to q = 0", 1, Group::kVisible, backwardOutOfTheHole},
      {"connect-joined", "connect", "Two branches joined to a path", 1, Group::kVisible, joinsWays},
      {"connect-arm", "connect", "From both sides into the hole", 1, Group::kVisible, bothSidesIntoTheHole},
      {"smooth-free", "smooth", "Shorter, with the same ends, and free", 1, Group::kVisible, staysFree},
      {"phase-effort", "phase", "The least effort and its force", 1, Group::kVisible, effortOfTransfers},
      {"phase-whole-step", "phase", "The whole motion as one step (no points)", 0, Group::kVisible,
       stepsToTheTarget},
      {"star-parent", "star", "The best parent", 1, Group::kVisible, choosesTheBest},
      {"star-rewired", "star", "Rewiring, and what follows from it", 1, Group::kVisible, rewires},
      {"star-thin-walls", "star", "A whole tree between thin walls (no points)", 0, Group::kVisible,
       growsAroundThinWalls},
      // <hidden>
      {"reach-any-arm", "reach", "Other arms, and the density in the plane", 1, Group::kHidden, anyArm},
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
