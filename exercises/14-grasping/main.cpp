#include <algorithm>
#include <cmath>
#include <numbers>

#include "exercise.h"
#include "show.h"

using namespace rex;

// Part 1.

Eigen::Vector3d planarWrench(const Eigen::Vector2d& p, const Eigen::Vector2d& force,
                             const Eigen::Vector2d& center, double length) {
  // TODO: a force upward, at the right side of the object: which sign has its torque?
  return Eigen::Vector3d::Zero();
}

Eigen::VectorXd spatialWrench(const Eigen::Vector3d& p, const Eigen::Vector3d& force,
                              const Eigen::Vector3d& center, double length) {
  Eigen::VectorXd wrench = Eigen::VectorXd::Zero(6);
  // TODO: a.cross(b) is a vector product.
  return wrench;
}

bool inCone(const Finger& finger, const Eigen::Vector3d& force) {
  // TODO: the parts of the force along the normal and along the surface.
  return false;
}

Eigen::MatrixXd pyramidEdges(const Finger& finger, int edges) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3, edges);
  // TODO: two directions along the surface, at right angles to each other; then a circle.
  return forces;
}

Eigen::MatrixXd planarWrenches(const std::vector<PlanarFinger>& fingers, const Eigen::Vector2d& center,
                               double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(3, 2 * static_cast<Eigen::Index>(fingers.size()));
  // TODO: two columns for each finger.
  return wrenches;
}

Eigen::MatrixXd spatialWrenches(const std::vector<Finger>& fingers, int edges, const Eigen::Vector3d& center,
                                double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(6, edges * static_cast<Eigen::Index>(fingers.size()));
  // TODO: one column for each edge of each finger.
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
  return 0;
}

double epsilonOf(const Eigen::MatrixXd& wrenches) {
  // TODO: planes through three wrenches; which of them bound the hull, and how far are they from zero?
  return 0;
}

// Part 4.

std::vector<int> keptFingers(const Eigen::MatrixXd& wrenches, const std::vector<int>& finger) {
  // TODO: 2) of slide 10:8. Ask judged() about those that are left.
  return {};
}

// Part 5.

// TODO: what else your search needs, as functions of your own.

std::vector<PlanarFinger> bestGrasp(const std::vector<Eigen::Vector2d>& corners,
                                    const Eigen::Vector2d& center, double length, double friction,
                                    int count) {
  // TODO: try many; epsilonOf() tells which is better. Can a good one be made better?
  return {};
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: the friction cone of a finger, and what three fingers on a plate can do; friction 0.4.
  showCone(.4, 8);
  showWrenches(.4, {.06, .2, .36});

  // Part 2: a cube with a finger in the middle of each face, with more and more friction.
  showVerdicts({0, .1, .3});

  // Part 3: two fingers on the plate, wherever they are; then known values.
  showMap(.8);
  showFriction();

  // Part 4: fingers all over a stone.
  showDeletion({0, .05, .1, .15, .2, .3});

  // Part 5: three fingers on the plate, put there by your search.
  showGrasp(.4, 3);
}
