#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "tree_checks.h"

// Part 1: densities of the position of the hand.

/// The share of postures with the hand nearer than r: those with a larger second angle than the one at r.
inline double shareWithin(double r, double l1, double l2) {
  const double cosine = std::clamp((r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2), -1., 1.);
  return 1 - std::acos(cosine) / std::numbers::pi;
}

/// The density along r, or in the plane at that distance, and the value that was returned.
inline rex::grading::Evidence densitySeen(double l1, double l2, double r, double got, bool isInThePlane) {
  const double least = std::abs(l1 - l2), most = l1 + l2, h = 1e-4;
  rex::Series wanted = rex::grading::wantedCurve("wanted");
  for (double share = .01; share < .995; share += .01) {
    const double at = least + share * (most - least);
    const double density = (shareWithin(at + h, l1, l2) - shareWithin(at - h, l1, l2)) / (2 * h);
    wanted.add(at, isInThePlane ? density / (2 * std::numbers::pi * at) : density);
  }
  return {.figures = {{.title = isInThePlane ? "Density of the hand in the plane"
                                             : "Density of the distance of the hand",
                       .xLabel = "r [m]",
                       .yLabel = isInThePlane ? "density [1/m^2]" : "density [1/m]",
                       .series = {wanted, rex::grading::wrongPoint("got", r, got)}}}};
}

inline void radiusFits(rex::grading::Check& check, Student& student, double l1, double l2, double r,
                       double wanted) {
  const double pi = std::numbers::pi, cosine = (r * r - l1 * l1 - l2 * l2) / (2 * l1 * l2);
  const double slope = l1 * l2 * std::sqrt(1 - cosine * cosine) / r;  // |dr / dangle|
  const double got = student.radiusDensity(r, l1, l2);
  const auto shown = check.show([&] { return densitySeen(l1, l2, r, got, false); });
  check.near("radiusDensity", got, wanted, 1e-5 * wanted,
             {{"Is it the density of the angle? That of r is divided by |dr / dangle|.", 1 / pi},
              {"Is it the density of the angle? That of r is divided by |dr / dangle|.", .5 / pi},
              {"Is it multiplied by |dr / dangle|? A density is divided by it.", slope / pi},
              {"Is the factor r missing? d(r^2) is 2 r dr.", wanted / r},
              {"Are angles from -pi to pi counted twice?", 2 * wanted},
              {"Is it the share of postures within r? Wanted is its derivative.", shareWithin(r, l1, l2)}},
             "1/m");
}

inline void planeFits(rex::grading::Check& check, Student& student, double l1, double l2,
                      const Eigen::Vector2d& p, double ofRadius) {
  const double pi = std::numbers::pi, r = p.norm(), wanted = ofRadius / (2 * pi * r);
  const double got = student.handDensity(p, l1, l2);
  const auto shown = check.show([&] { return densitySeen(l1, l2, r, got, true); });
  check.near(
      "handDensity", got, wanted, 1e-5 * wanted,
      {{"Is it the density of r? In the plane it is spread over a circle of the length 2 pi r.", ofRadius},
       {"Is r left out? The circle has the length 2 pi r.", ofRadius / (2 * pi)},
       {"Is it divided by the area of a disc? p(r) is spread over a circle.", ofRadius / (pi * r * r)},
       {"Is 2 pi left out? The circle has the length 2 pi r.", ofRadius / r}},
      "1/m^2");
}

/// At random distances r, kept away from both ends so that differences of 1e-5 m are exact to 1e-6.
inline void densitiesFit(rex::grading::Check& check, Student& student, double l1, double l2,
                         bool isInThePlane) {
  rex::Rng& rng = check.rng();
  const double least = std::abs(l1 - l2), most = l1 + l2, h = 1e-5;
  for (int i = 0; i < 10; ++i) {
    const double r = least + rng.uniform(0.02, 0.98) * (most - least);
    const double wanted = (shareWithin(r + h, l1, l2) - shareWithin(r - h, l1, l2)) / (2 * h);
    check.input("an arm", {{"r", r}, {"l1", l1}, {"l2", l2}});
    radiusFits(check, student, l1, l2, r, wanted);
    if (!isInThePlane) continue;
    const double angle = rng.uniform(-4, 4);
    const Eigen::Vector2d p = r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    check.input("an arm", {{"p", p}, {"l1", l1}, {"l2", l2}});
    planeFits(check, student, l1, l2, p, wanted);
  }
  const auto isZero = [&](double r) {
    check.input("an arm", {{"r", r}, {"l1", l1}, {"l2", l2}});
    check.near("radiusDensity where the hand cannot be", student.radiusDensity(r, l1, l2), 0, 0, "1/m");
  };
  isZero(1.01 * most);
  if (least > 0.01) isZero(0.98 * least);
  if (!isInThePlane) return;
  const Eigen::Vector2d far(0, 1.2 * most);
  check.input("an arm", {{"p", far}, {"l1", l1}, {"l2", l2}});
  check.near("handDensity where the hand cannot be", student.handDensity(far, l1, l2), 0, 0, "1/m^2");
}
