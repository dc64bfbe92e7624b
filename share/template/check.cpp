#include <algorithm>
#include <cmath>

#include "grading/evidence.h"
#include "interface.h"

namespace {

using rex::grading::Check;
using rex::grading::Evidence;
using rex::grading::Group;

Eigen::Vector2d randomPoint(rex::Rng& rng) { return {rng.uniform(-2, 2), rng.uniform(-2, 2)}; }

// What (1, 0) was turned into, beside what it should be.
Evidence quarterTurn(const Eigen::Vector2d& q) {
  return {.figures = {rex::planeFigure({.title = "A quarter turn of (1, 0)",
                                        .series = {rex::grading::gotCurve("got", {0, q.x()}, {0, q.y()}),
                                                   rex::grading::wantedCurve("wanted", {0, 0}, {0, 1})}})}};
}

void turnsAQuarter(Check& check, Student& student) {
  const Eigen::Vector2d p(1, 0);
  const double angle = std::acos(0.0);
  check.input("a quarter turn", {{"p", p}, {"angle", angle}});
  const Eigen::Vector2d q = student.rotated(p, angle);
  const auto shown = check.show([&] { return quarterTurn(q); });
  const double radians = angle * std::acos(-1.0) / 180;
  const auto suspected = check.suspect("Is the angle taken for one in degrees?",
                                       Eigen::Vector2d(std::cos(radians), std::sin(radians)));
  check.near("point after a quarter turn", q, Eigen::Vector2d(0, 1), 1e-12, "m");
}

void keepsTheLength(Check& check, Student& student) {
  double largest = 0;
  check.forEachCase(20, [&](int) {
    const Eigen::Vector2d p = randomPoint(check.rng());
    const Eigen::Vector2d q = student.rotated(p, check.rng().uniform(-4, 4));
    check.near("distance from the origin", q.norm(), p.norm(), 1e-12, "m");
    largest = std::max(largest, std::abs(q.norm() - p.norm()));
  });
  check.record("largest error of a distance", largest, "m");
}

// <hidden>
void addsAngles(Check& check, Student& student) {
  check.forEachCase(20, [&](int) {
    const Eigen::Vector2d p = randomPoint(check.rng());
    const double a = check.rng().uniform(-4, 4), b = check.rng().uniform(-4, 4);
    const Eigen::Vector2d twice = student.rotated(student.rotated(p, a), b);
    check.near("distance from the origin", twice.norm(), p.norm(), 1e-12, "m");
    check.near("two turns in a row", twice, student.rotated(p, a + b), 1e-12, "m");
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"quarter-turn", "rotate", "A quarter turn", 1, Group::kVisible, turnsAQuarter},
      {"keeps-length", "rotate", "Turning keeps the length", 1, Group::kVisible, keepsTheLength},
      // <hidden>
      {"angles-add", "rotate", "Two turns in a row", 1, Group::kHidden, addsAngles},
      // </hidden>
  };
}
