#pragma once

#include <vector>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "wrench_checks.h"

// What the checks require of a grasp of a polygon.

/// The best known radii for the objects of the visible check, newtons.
inline constexpr double kBestOnSlab = 0.316227, kBestOnWedge = 0.18688;

inline void isOnOutline(rex::grading::Check& check, const Plate& plate, const PlanarFinger& finger) {
  check.shape("position of a finger of bestGrasp", finger.p, 2, 1);
  check.shape("normal of a finger of bestGrasp", finger.normal, 2, 1);
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
  check.atMost("distance of a finger of bestGrasp from the edges", least, 1e-6, "m");
  const auto cornered = check.ask("Is a finger at a corner? There is no normal.", fromCorner < 1e-6);
  check.atLeast("distance of a finger of bestGrasp from the nearest corner", fromCorner, 0.002 - 1e-6, "m");
  const auto outward = check.suspect("Does the normal point out of the object?", -inward);
  check.near("normal of a finger of bestGrasp", finger.normal, inward, 1e-6);
}

/// The friction cone of a finger, 0.3 of the length deep, and the finger behind it.
inline void addFinger(rex::Figure& figure, const PlanarFinger& finger, double length) {
  const Eigen::Vector2d aside(-finger.normal.y(), finger.normal.x());
  rex::Region cone{.color = rex::grading::kGotColor};
  for (const double side : {-1., 0., 1.}) {
    const Eigen::Vector2d ahead = finger.normal + side * finger.friction * aside;
    const Eigen::Vector2d p = finger.p + (side == 0 ? 0 : 0.3) * length * ahead;
    cone.add(p.x(), p.y());
  }
  const Eigen::Vector2d from = finger.p - 0.25 * length * finger.normal;
  figure.regions.push_back(cone);
  figure.series.push_back(rex::through({from, finger.p}, rex::grading::gotCurve("")));
}

/// The polygon with the cones of its fingers.
inline rex::Figure drawing(const Plate& plate, const std::vector<PlanarFinger>& fingers) {
  rex::Figure figure = rex::planeFigure({.title = "Your fingers, and the forces they can exert",
                                         .legend = rex::Legend::kOutside,
                                         .regions = {rex::within(plate.corners)}});
  for (const PlanarFinger& one : fingers)
    if (one.p.allFinite() && one.normal.allFinite() && std::isfinite(one.friction))
      addFinger(figure, one, plate.length);
  if (!figure.series.empty()) figure.series[0].label = "fingers";
  figure.series.push_back(rex::dots(
      plate.center,
      {.label = "centre", .marker = rex::Marker::kPlus, .size = 2, .color = rex::grading::kWantedColor}));
  return figure;
}

/// Checks that a grasp meets the contract and is at least 0.8 as good as the best known one.
inline void graspIsGood(rex::grading::Check& check, Student& student, const Plate& plate, double friction,
                        int count, double best) {
  Eigen::MatrixXd corners(2, plate.corners.size());
  std::copy(plate.corners.begin(), plate.corners.end(), corners.colwise().begin());
  check.input("a polygon", {{"corners", corners},
                            {"center", plate.center},
                            {"length", plate.length},
                            {"friction", friction},
                            {"count", count}});
  const std::vector<PlanarFinger> fingers =
      student.bestGrasp(plate.corners, plate.center, plate.length, friction, count);
  rex::Figure figure = drawing(plate, fingers);
  const auto shown = check.show([&] { return rex::grading::Evidence{.figures = {figure}, .film = {}}; });
  check.near("number of fingers of bestGrasp", static_cast<double>(fingers.size()), count, 0);
  for (const PlanarFinger& one : fingers) {
    const auto marked = check.show([&] {
      figure.series.push_back(rex::grading::wrongPoint("this finger", one.p.x(), one.p.y()));
      return rex::grading::Evidence{.figures = {figure}, .film = {}};
    });
    isOnOutline(check, plate, one);
    check.near("friction of a finger of bestGrasp", one.friction, friction, 1e-12);
  }
  const double quality = rex::graspQuality(wrenchesOf(fingers, plate.center, plate.length)).epsilon;
  check.atLeast("epsilonOf() the fingers of bestGrasp", quality, 0.8 * best, "N");
}
