#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "exercise.h"
#include "geometry/facet_hull.h"
#include "grasp_pictures.h"
#include "grasping/quality.h"

using namespace rex;

// Keeps the compiler quiet about what a function below does not use yet.
template <class... Unused>
void notUsedYet(const Unused&...) {}

// Part 1.

Eigen::Vector3d planarWrench(const Eigen::Vector2d& p, const Eigen::Vector2d& force,
                             const Eigen::Vector2d& center, double length) {
  // TODO: a force upward, at the right side of the object: which sign has its torque?
  notUsedYet(p, force, center, length);
  return Eigen::Vector3d::Zero();
}

Eigen::VectorXd spatialWrench(const Eigen::Vector3d& p, const Eigen::Vector3d& force,
                              const Eigen::Vector3d& center, double length) {
  Eigen::VectorXd wrench = Eigen::VectorXd::Zero(6);
  // TODO: a.cross(b) is a vector product.
  notUsedYet(p, force, center, length);
  return wrench;
}

bool inCone(const Finger& finger, const Eigen::Vector3d& force) {
  // TODO: the parts of the force along the normal and along the surface.
  notUsedYet(finger, force);
  return false;
}

Eigen::MatrixXd pyramidEdges(const Finger& finger, int edges) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3, edges);
  // TODO: two directions along the surface, at right angles to each other; then a circle.
  notUsedYet(finger);
  return forces;
}

Eigen::MatrixXd planarWrenches(const std::vector<PlanarFinger>& fingers, const Eigen::Vector2d& center,
                               double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(3, 2 * static_cast<Eigen::Index>(fingers.size()));
  // TODO: two columns for each finger.
  notUsedYet(center, length);
  return wrenches;
}

Eigen::MatrixXd spatialWrenches(const std::vector<Finger>& fingers, int edges, const Eigen::Vector3d& center,
                                double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(6, edges * static_cast<Eigen::Index>(fingers.size()));
  // TODO: one column for each edge of each finger.
  notUsedYet(center, length);
  return wrenches;
}

// Part 2.

Verdict judged(const Eigen::MatrixXd& wrenches) {
  // TODO: do the wrenches span the space? And does a linear program find weights for zero? If not,
  // what does it return instead (optim/linear_program.h)?
  return {false, Eigen::VectorXd::Zero(wrenches.rows())};
}

// Part 3.

double reachAlong(const Eigen::MatrixXd& wrenches, const Eigen::VectorXd& direction) {
  // TODO: what is unknown, which equations hold, and what shall be least?
  notUsedYet(wrenches, direction);
  return 0;
}

double epsilonOf(const Eigen::MatrixXd& wrenches) {
  // TODO: planes through three wrenches; which of them bound the hull, and how far are they from zero?
  notUsedYet(wrenches);
  return 0;
}

// Part 4.

std::vector<int> keptFingers(const Eigen::MatrixXd& wrenches, const std::vector<int>& finger) {
  // TODO: 2) of slide 10:8. Ask judged() about those that are left.
  notUsedYet(wrenches, finger);
  return {};
}

// Part 5.

// TODO: what else your search needs, as functions of your own.

std::vector<PlanarFinger> bestGrasp(const std::vector<Eigen::Vector2d>& corners,
                                    const Eigen::Vector2d& center, double length, double friction,
                                    int count) {
  // TODO: try many; epsilonOf() tells which is better. Can a good one be made better?
  notUsedYet(corners, center, length, friction, count);
  return {};
}

// From here on everything is given: all parts one after another, with pictures. Change it as you like.

namespace {

constexpr double kFriction = 0.4;

Eigen::MatrixXd wrenchesOnPlate(const std::vector<PlanarFinger>& fingers) {
  return planarWrenches(fingers, Eigen::Vector2d::Zero(), kPlateLength);
}

// byLibrary(wrenches): what the library says about the same.
using Quality = double (*)(const Eigen::MatrixXd&);
using Hull = FacetHull (*)(const Eigen::MatrixXd&);

void showGrasp(Quality byLibrary, Hull hull) {
  const std::vector<PlanarFinger> fingers =
      bestGrasp(plate(), Eigen::Vector2d::Zero(), kPlateLength, kFriction, 3);
  const Eigen::MatrixXd W = wrenchesOnPlate(fingers);
  const double yours = W.cols() > 0 ? epsilonOf(W) : 0, library = W.cols() > 0 ? byLibrary(W) : 0;
  std::printf("three fingers on the plate: epsilon %.6f N, by the library %.6f N\n", yours, library);
  char title[80];
  std::snprintf(title, sizeof title, "Three fingers, friction %.1f: epsilon = %.3f N", kFriction, yours);
  plot("cones", conesFigure(title, plate(), fingers));
  if (W.cols() == 0 || W.isZero()) return;
  const FacetHull facets = hull(W);
  Figure figure = hullFigure("The hull of the wrenches of three fingers", W, facets.normals, facets.offsets);
  if (yours > 0) addBall(figure, yours);
  plot("hull", figure);
}

void showMap() {
  double around = 0;
  const std::vector<Eigen::Vector2d> corners = plate();
  Figure figure{.title = "Two fingers, friction 0.8: where to put them",
                .xLabel = "first finger, along the outline [m]",
                .yLabel = "second finger, along the outline [m]",
                .colorLabel = "epsilon [N]",
                .equalAxes = true,
                .legend = Legend::kNone,
                .width = 800,
                .height = 700};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d side = ahead(corners[(i + 1) % corners.size()], -1, corners[i]);
    around += std::hypot(side[0], side[1]);
    if (i + 1 == corners.size()) break;
    figure.verticalLines.push_back({.at = around, .color = kGrey});
    figure.horizontalLines.push_back({.at = around, .color = kGrey});
  }
  const auto quality = [&](double a, double b) {
    return epsilonOf(wrenchesOnPlate({fingerAt(corners, a, 0.8), fingerAt(corners, b, 0.8)}));
  };
  figure.heatMap = heatMapOf(quality, {0, around}, {0, around}, 150, 150);
  figure.colorRange = {0, std::max(0.1, figure.heatMap->values.maxCoeff())};
  plot("map", figure);
}

// A cube with half edges of 1 and a finger in the middle of each face.
Eigen::MatrixXd cubeWrenches(double friction, int edges) {
  std::vector<Finger> fingers;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {1., -1.})
      fingers.push_back({side * Eigen::Vector3d::Unit(axis), -side * Eigen::Vector3d::Unit(axis), friction});
  return spatialWrenches(fingers, edges, Eigen::Vector3d::Zero(), 1);
}

// weakest(wrenches): the direction in which the hull reaches least far, by the library.
void showFriction(Eigen::VectorXd (*weakest)(const Eigen::MatrixXd&)) {
  Figure figure{.title = "What friction does", .xLabel = "friction [1]", .yLabel = "epsilon [N]"};
  Series two{.label = "two fingers, yours", .size = 5, .color = Color{1, 0.85f, 0.3f}},
      law{.label = "mu / sqrt(2 + mu^2)", .dashed = true, .color = kBlack},
      cube{.label = "cube, 8 edges, yours", .size = 5, .color = Color{0.6f, 0.8f, 1}},
      cubeLaw{.label = "mu sqrt(2/3)", .dashed = true, .color = kBlue},
      coarse{.label = "cube, 4 edges, yours", .style = SeriesStyle::kPoints, .color = kRed};
  for (int i = 1; i <= 20; ++i) {
    const double mu = 0.04 * i;
    for (Series* series : {&two, &law, &cube, &cubeLaw, &coarse}) series->x.push_back(mu);
    two.y.push_back(epsilonOf(
        planarWrenches({{{-1, 0}, {1, 0}, mu}, {{1, 0}, {-1, 0}, mu}}, Eigen::Vector2d::Zero(), 1)));
    law.y.push_back(mu / std::sqrt(2 + mu * mu));
    cubeLaw.y.push_back(mu * std::sqrt(2. / 3));
    for (const int edges : {4, 8}) {
      const Eigen::MatrixXd W = cubeWrenches(mu, edges);
      const Eigen::VectorXd direction = weakest(W);
      (edges == 4 ? coarse : cube).y.push_back(direction.size() > 0 ? reachAlong(W, direction) : 0);
    }
  }
  figure.series = {two, law, cube, cubeLaw, coarse};
  plot("friction", figure);
}

void showVerdicts() {
  for (const double friction : {0., 0.1, 0.3}) {
    const Verdict verdict = judged(cubeWrenches(friction, 8));
    std::printf("a cube with a finger on each face, friction %.1f: %s\n", friction,
                verdict.closed ? "closed" : "open");
    if (verdict.closed)
      std::printf("  smallest weight %.4f, largest %.4f\n", verdict.proof.minCoeff(),
                  verdict.proof.maxCoeff());
    else if (verdict.proof.isZero())
      std::printf("  without proof so far\n");
    else
      print("  nothing opposes the wrench", Eigen::MatrixXd(verdict.proof.transpose()));
  }
}

std::vector<int> keptOnStone(const std::vector<Finger>& fingers) {
  constexpr int kEdges = 8;
  std::vector<int> owner;
  for (std::size_t k = 0; k < fingers.size() * kEdges; ++k) owner.push_back(static_cast<int>(k / kEdges));
  return keptFingers(spatialWrenches(fingers, kEdges, Eigen::Vector3d::Zero(), 0.05), owner);
}

void showDeletion() {
  for (const double friction : {0., 0.05, 0.1, 0.15, 0.2, 0.3}) {
    const std::vector<Finger> fingers = fingersEverywhere(stone(), friction);
    const std::vector<int> kept = keptOnStone(fingers);
    std::printf("a stone, friction %.2f: %zu of %zu fingers are kept\n", friction, kept.size(),
                fingers.size());
    if (friction == 0.3) writeDeletion("deletion", filmOfDeletion(stone(), fingers, kept));
  }
}

}  // namespace

int main() {
  showVerdicts();
  // Once your own functions work, they say the same as the library.
  showGrasp([](const Eigen::MatrixXd& W) { return graspQuality(W).epsilon; },
            [](const Eigen::MatrixXd& W) { return facetHull(W); });
  showMap();
  showFriction([](const Eigen::MatrixXd& W) { return graspQuality(W).weakest; });
  showDeletion();
}
