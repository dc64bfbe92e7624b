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

// Part 1.

Eigen::Vector3d planarWrench(const Eigen::Vector2d& p, const Eigen::Vector2d& force,
                             const Eigen::Vector2d& center, double length) {
  // <solution planarWrench>
  const Eigen::Vector2d arm = p - center;
  return {force.x(), force.y(), (arm.x() * force.y() - arm.y() * force.x()) / length};
  // <todo>
  //| // TODO: a force upward, at the right side of the object: which sign has its torque?
  //| return Eigen::Vector3d::Zero();
  // </solution>
}

Eigen::VectorXd spatialWrench(const Eigen::Vector3d& p, const Eigen::Vector3d& force,
                              const Eigen::Vector3d& center, double length) {
  Eigen::VectorXd wrench = Eigen::VectorXd::Zero(6);
  // <solution spatialWrench>
  wrench << force, (p - center).cross(force) / length;
  // <todo>
  //| // TODO: a.cross(b) is a vector product.
  // </solution>
  return wrench;
}

bool inCone(const Finger& finger, const Eigen::Vector3d& force) {
  // <solution inCone>
  const double along = force.dot(finger.normal);
  const double across = (force - along * finger.normal).norm();
  return across <= finger.friction * along + 1e-9 * force.norm();
  // <todo>
  //| // TODO: the parts of the force along the normal and along the surface.
  //| return false;
  // </solution>
}

Eigen::MatrixXd pyramidEdges(const Finger& finger, int edges) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(3, edges);
  // <solution pyramidEdges>
  const Eigen::Vector3d& n = finger.normal;
  const Eigen::Vector3d least = std::abs(n.x()) < 0.6 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d a = n.cross(least).normalized(), b = n.cross(a);
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * k / edges;
    forces.col(k) = n + finger.friction * (std::cos(angle) * a + std::sin(angle) * b);
  }
  // <todo>
  //| // TODO: two directions along the surface, at right angles to each other; then a circle.
  // </solution>
  return forces;
}

Eigen::MatrixXd planarWrenches(const std::vector<PlanarFinger>& fingers, const Eigen::Vector2d& center,
                               double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(3, 2 * static_cast<Eigen::Index>(fingers.size()));
  // <solution planarWrenches>
  Eigen::Index column = 0;
  for (const PlanarFinger& finger : fingers)
    for (const double mu : {finger.friction, -finger.friction}) {
      const Eigen::Vector2d across(-finger.normal.y(), finger.normal.x());
      wrenches.col(column++) = planarWrench(finger.p, finger.normal + mu * across, center, length);
    }
  // <todo>
  //| // TODO: two columns for each finger.
  // </solution>
  return wrenches;
}

Eigen::MatrixXd spatialWrenches(const std::vector<Finger>& fingers, int edges, const Eigen::Vector3d& center,
                                double length) {
  Eigen::MatrixXd wrenches = Eigen::MatrixXd::Zero(6, edges * static_cast<Eigen::Index>(fingers.size()));
  // <solution spatialWrenches>
  Eigen::Index column = 0;
  for (const Finger& finger : fingers) {
    const Eigen::MatrixXd forces = pyramidEdges(finger, edges);
    for (Eigen::Index k = 0; k < forces.cols(); ++k)
      wrenches.col(column++) = spatialWrench(finger.p, forces.col(k), center, length);
  }
  // <todo>
  //| // TODO: one column for each edge of each finger.
  // </solution>
  return wrenches;
}

// Part 2.

Verdict judged(const Eigen::MatrixXd& wrenches) {
  // <solution judged>
  const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(d, n + d);  // so that U is square, however few wrenches
  padded.leftCols(n) = wrenches;
  const SingularValues values = svd(padded);
  if (values.s[d - 1] < 1e-9 * values.s[0]) return {false, values.U.col(d - 1)};
  // Weights 1 + x with x >= 0: what they sum up to is a positive multiple of weights with the sum 1.
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(n);
  const LinearSolution rest = minimizeLinear(wrenches, -wrenches.rowwise().sum(), ones);
  if (rest.status != LinearStatus::kOptimal) return {false, rest.y / -rest.y.norm()};
  const Eigen::VectorXd weights = rest.x + ones;
  return {true, weights / weights.sum()};
  // <todo>
  //| // TODO: do the wrenches span the space? And does a linear program find weights for zero? If not,
  //| // what does it return instead (optim/linear_program.h)?
  //| return {false, Eigen::VectorXd::Zero(wrenches.rows())};
  // </solution>
}

// Part 3.

double reachAlong(const Eigen::MatrixXd& wrenches, const Eigen::VectorXd& direction) {
  // <solution reachAlong>
  const Eigen::Index d = wrenches.rows(), n = wrenches.cols();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(d + 1, n + 1);  // unknown: the weights, and then s
  A.topLeftCorner(d, n) = wrenches;
  A.topRightCorner(d, 1) = -direction;
  A.bottomLeftCorner(1, n).setOnes();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(d + 1), cost = Eigen::VectorXd::Zero(n + 1);
  b[d] = 1;
  cost[n] = -1;
  return -minimizeLinear(A, b, cost).value;
  // <todo>
  //| // TODO: what is unknown, which equations hold, and what shall be least?
  //| return 0;
  // </solution>
}

double epsilonOf(const Eigen::MatrixXd& wrenches) {
  // <solution epsilonOf>
  std::vector<Eigen::Vector3d> ends;
  double size = 0, least = INFINITY;
  for (Eigen::Index k = 0; k < wrenches.cols(); ++k) {
    ends.push_back(wrenches.col(k));
    size = std::max(size, ends.back().norm());
  }
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Eigen::Vector3d ab = ends[j] - ends[i], ac = ends[k] - ends[i];
        const Eigen::Vector3d across = ab.cross(ac);
        const double area = across.norm(), here = across.dot(ends[i]);
        if (area < 1e-9 * size * size) continue;
        double lowest = here, highest = here;
        for (const Eigen::Vector3d& point : ends) {
          lowest = std::min(lowest, across.dot(point));
          highest = std::max(highest, across.dot(point));
        }
        const double much = 1e-9 * size * area;  // three points of one face may lie on either side of it
        if (highest < here + much) least = std::min(least, here / area);
        if (lowest > here - much) least = std::min(least, -here / area);
      }
  return least < INFINITY ? std::max(least, 0.) : 0;
  // <todo>
  //| // TODO: planes through three wrenches; which of them bound the hull, and how far are they from zero?
  //| return 0;
  // </solution>
}

// Part 4.

std::vector<int> keptFingers(const Eigen::MatrixXd& wrenches, const std::vector<int>& finger) {
  // <solution keptFingers>
  std::vector<int> kept = finger;
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  const auto closes = [&](const std::vector<int>& fingers) {
    Eigen::MatrixXd some(wrenches.rows(), 0);
    for (std::size_t k = 0; k < finger.size(); ++k)
      if (std::find(fingers.begin(), fingers.end(), finger[k]) != fingers.end()) {
        some.conservativeResize(wrenches.rows(), some.cols() + 1);
        some.col(some.cols() - 1) = wrenches.col(static_cast<Eigen::Index>(k));
      }
    return some.cols() > 0 && judged(some).closed;
  };
  if (!closes(kept)) return {};
  for (std::size_t i = 0; i < kept.size();) {
    std::vector<int> rest = kept;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    if (closes(rest))
      kept = std::move(rest);
    else
      ++i;
  }
  return kept;
  // <todo>
  //| // TODO: 2) of slide 10:8. Ask judged() about those that are left.
  //| return {};
  // </solution>
}

// Part 5.

// <solution search>
namespace {

// The finger at a place of the outline, counted in edges: 2.5 is the middle of the third.
PlanarFinger fingerAlong(const std::vector<Eigen::Vector2d>& corners, double place, double friction) {
  const auto n = static_cast<double>(corners.size());
  place -= n * std::floor(place / n);
  const std::size_t i = std::min(static_cast<std::size_t>(place), corners.size() - 1);
  const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
  const double size = side.norm(), part = place - static_cast<double>(i);
  const double along = std::clamp(part * size, 0.0021, size - 0.0021);
  return {corners[i] + along / size * side, {-side.y() / size, side.x() / size}, friction};
}

}  // namespace
// <todo>
//| // TODO: what else your search needs, as functions of your own.
// </solution>

std::vector<PlanarFinger> bestGrasp(const std::vector<Eigen::Vector2d>& corners,
                                    const Eigen::Vector2d& center, double length, double friction,
                                    int count) {
  // <solution bestGrasp>
  const auto fingersAt = [&](const std::vector<double>& places) {
    std::vector<PlanarFinger> grasp;
    for (const double place : places) grasp.push_back(fingerAlong(corners, place, friction));
    return grasp;
  };
  const auto qualityOf = [&](const std::vector<double>& places) {
    return epsilonOf(planarWrenches(fingersAt(places), center, length));
  };
  Rng rng(7);
  std::vector<double> best;
  double quality = -1;
  for (int start = 0; start < 30; ++start) {
    std::vector<double> here, other(static_cast<std::size_t>(count));
    double now = -1;
    const auto isBetter = [&] {
      const double then = qualityOf(other);
      if (then <= now) return false;
      now = then;
      here = other;
      return true;
    };
    for (int draw = 0; draw < 150; ++draw) {
      for (double& place : other) place = rng.uniform(0, static_cast<double>(corners.size()));
      isBetter();
    }
    // From there all fingers move at once: one alone often cannot, though two could.
    for (double i = 0, step = 0.5; i < 250; ++i) {
      other = here;
      for (double& place : other) place += step * rng.normal();
      step *= isBetter() ? 1.3 : 0.96;
    }
    if (now > quality) best = here;
    quality = std::max(quality, now);
  }
  return fingersAt(best);
  // <todo>
  //| // TODO: try many; epsilonOf() tells which is better. Can a good one be made better?
  //| return {};
  // </solution>
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
