#pragma once

#include <string>
#include <vector>

#include "grading/check.h"
#include "interface.h"
#include "wrench_checks.h"

// What the checks require of a grasp of a polygon.

/// The best known radii for the objects of the visible check, newtons.
inline constexpr double kBestOnSlab = 0.316227, kBestOnWedge = 0.18688;

inline void isOnOutline(rex::grading::Check& check, const Plate& plate, const PlanarFinger& finger) {
  check.shape("place of a finger", finger.p, 2, 1);
  check.shape("normal of a finger", finger.normal, 2, 1);
  double least = INFINITY, fromCorner = INFINITY;
  Eigen::Vector2d inward(0, 0);
  for (std::size_t i = 0; i < plate.corners.size(); ++i) {
    const Eigen::Vector2d &a = plate.corners[i], &b = plate.corners[(i + 1) % plate.corners.size()];
    const Eigen::Vector2d side = (b - a).normalized();
    const double along = std::clamp(side.dot(finger.p - a), 0., (b - a).norm());
    const double away = (a + along * side - finger.p).norm();
    fromCorner = std::min(fromCorner, (finger.p - a).norm());
    if (away >= least) continue;
    least = away;
    inward = {-side.y(), side.x()};
  }
  check.atMost("distance of a finger from the edges", least, 1e-6, "m");
  check.atLeast("distance of a finger from the nearest corner", fromCorner, 0.002 - 1e-6, "m");
  check.near("normal of a finger", finger.normal, inward, 1e-6);
}

/// The polygon with the cones of its fingers.
inline rex::Figure drawing(const Plate& plate, const std::vector<PlanarFinger>& fingers) {
  rex::Figure figure{.title = "The fingers and their cones",
                     .xLabel = "x [m]",
                     .yLabel = "y [m]",
                     .equalAxes = true,
                     .legend = rex::Legend::kNone};
  rex::Region outline;
  for (const Eigen::Vector2d& corner : plate.corners) {
    outline.x.push_back(corner.x());
    outline.y.push_back(corner.y());
  }
  figure.regions = {outline};
  for (const PlanarFinger& finger : fingers) {
    if (!finger.p.allFinite() || !finger.normal.allFinite()) continue;
    rex::Series cone{.size = 2};
    const Eigen::Vector2d left(-finger.normal.y(), finger.normal.x());
    for (const double mu : {finger.friction, 0., -finger.friction}) {
      const Eigen::Vector2d p =
          finger.p + (mu == 0 ? Eigen::Vector2d::Zero()
                              : Eigen::Vector2d(0.3 * plate.length * (finger.normal + mu * left)));
      cone.x.push_back(p.x());
      cone.y.push_back(p.y());
    }
    figure.series.push_back(cone);
  }
  return figure;
}

/// A grasp as the contract wants it, at least 0.9 as good as the best that is known.
inline void graspIsGood(rex::grading::Check& check, Student& student, const Plate& plate, double friction,
                        int count, double best) {
  check.input("a polygon of " + std::to_string(plate.corners.size()) + " corners, friction " +
              text(friction) + ", " + std::to_string(count) + " fingers");
  const std::vector<PlanarFinger> fingers =
      student.bestGrasp(plate.corners, plate.center, plate.length, friction, count);
  const auto shown =
      check.show([&] { return rex::grading::Evidence{.figures = {drawing(plate, fingers)}, .film = {}}; });
  check.near("number of fingers", static_cast<double>(fingers.size()), count, 0);
  for (const PlanarFinger& finger : fingers) {
    isOnOutline(check, plate, finger);
    check.near("friction of a finger", finger.friction, friction, 1e-12);
  }
  const double quality = rex::graspQuality(wrenchesOf(fingers, plate.center, plate.length)).epsilon;
  check.atLeast("radius of the ball, of the best known", quality / best, 0.9);
}
