#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "course/walk_pictures.h"
#include "grading/check.h"
#include "grading/evidence.h"
#include "interface.h"
#include "locomotion/footsteps.h"
#include "locomotion/walking_pattern.h"

// Part 3: the cart, its gains, and walks over footsteps.

inline std::string described(const CartTable& cart) {
  return fmt::format("height {:.6g}, g {:.6g}, steps of {:.6g} s, {} ahead, Qe {:.6g}, R {:.6g}", cart.height,
                     cart.g, cart.step, cart.ahead, cart.Qe, cart.R);
}

inline rex::PreviewGains gainsOf(const CartTable& cart) {
  return rex::previewGains({.height = cart.height,
                            .g = cart.g,
                            .step = cart.step,
                            .preview = cart.step * cart.ahead,
                            .Qe = cart.Qe,
                            .R = cart.R});
}

inline CartTable randomCart(rex::Rng& rng) {
  CartTable cart{.height = rng.uniform(.4, 1.1), .g = rng.uniform(5, 11), .step = rng.uniform(.004, .02)};
  cart.ahead = static_cast<int>(rng.uniform(1, 2) / cart.step);
  cart.Qe = std::exp(rng.uniform(-1, 1));
  cart.R = std::exp(rng.uniform(-16, -11));
  return cart;
}

inline Eigen::Vector3d cartAfter(const CartTable& cart, const Eigen::Vector3d& x, double jerk) {
  const double seconds = cart.step, dv = seconds * (x[2] + seconds / 2 * jerk);
  return {x[0] + seconds * (x[1] + seconds / 2 * (x[2] + seconds / 3 * jerk)), x[1] + dv,
          x[2] + seconds * jerk};
}

inline void cartMoves(rex::grading::Check& check, Student& student, const CartTable& cart) {
  const Eigen::Vector3d x = check.rng().normalVector(3);
  const double jerk = 100 * check.rng().normal();
  check.input(described(cart), {{"x", x}, {"u", jerk}});
  // It is too small for the answers to show it.
  const double cube = cart.step * cart.step * cart.step / 6 * jerk;
  const auto noCube = check.suspect("Is the term with step^3 missing?",
                                    cartAfter(cart, x, jerk) - Eigen::Vector3d(cube, 0, 0));
  check.near("cartStep", student.cartStep(cart, x, jerk), cartAfter(cart, x, jerk), 1e-9);
}

/// Gains that stop the cart, but are not optimal.
inline PreviewLaw someLaw(rex::Rng& rng, const CartTable& cart) {
  const rex::PreviewGains best = gainsOf(cart);
  PreviewLaw law{best.Gi, best.Gx, best.Gp};
  law.Gi *= rng.uniform(.9, 1.1);
  for (double& gain : law.Gp) gain *= rng.uniform(.8, 1.2);
  return law;
}

/// The columns of a matrix over steps 0, 1, ...
inline rex::grading::Signal columnsOf(const Eigen::MatrixXd& matrix) {
  rex::grading::Signal signal;
  for (const auto& column : matrix.colwise()) signal.add(static_cast<double>(signal.at.size()), column);
  return signal;
}

/// The law in the form that Kajita prints, with all changes summed up.
inline Eigen::MatrixXd printedLaw(const CartTable& cart, const PreviewLaw& law,
                                  const Eigen::VectorXd& reference) {
  const Eigen::Index steps = reference.size();
  const auto r = [&](Eigen::Index k) { return reference[std::clamp<Eigen::Index>(k, 0, steps - 1)]; };
  Eigen::MatrixXd carts(3, steps);
  Eigen::Vector3d x(reference[0], 0, 0);
  const Eigen::Vector3d start = x;
  double errors = 0;
  for (Eigen::Index k = 0; k < steps; ++k) {
    carts.col(k) = x;
    errors += x[0] - cart.height / cart.g * x[2] - r(k);
    double sum = -law.Gi * errors - law.Gx.dot(x - start);
    for (Eigen::Index j = 1; j <= law.Gp.size(); ++j) sum += law.Gp[j - 1] * (r(k + j) - r(j - 1));
    x = cartAfter(cart, x, sum);
  }
  return carts;
}

inline void lawIsFollowed(rex::grading::Check& check, Student& student, CartTable cart) {
  rex::Rng& rng = check.rng();
  cart.ahead = 5 + rng.index(60);
  const PreviewLaw law = someLaw(rng, cart);
  Eigen::VectorXd reference(150);
  double at = rng.uniform(-1, 1);
  for (double& r : reference) r = at += rng.index(20) == 0 ? .2 * rng.normal() : 0;
  check.input(described(cart) + ", a reference of 150 numbers with jumps",
              {{"Gi", law.Gi}, {"Gx", law.Gx}, {"Gp", law.Gp}});
  const Eigen::MatrixXd wanted = printedLaw(cart, law, reference);
  const Eigen::MatrixXd got = student.followed(cart, law, reference);
  check.shape("states of followed", got, 3, 150);
  const char* names[] = {"position c of followed", "velocity c' of followed", "acceleration c'' of followed"};
  const char* units[] = {"m", "m/s", "m/s^2"};
  for (int i = 0; i < 3; ++i)
    check.nearAlong(names[i], columnsOf(got.row(i)), columnsOf(wanted.row(i)).values,
                    1e-7 * (1 + wanted.row(i).cwiseAbs().maxCoeff()), units[i]);
}

inline void gainsFit(rex::grading::Check& check, Student& student, const CartTable& cart) {
  check.input(described(cart));
  const rex::PreviewGains wanted = gainsOf(cart);
  const PreviewLaw got = student.previewLaw(cart);
  check.near("Gi of previewLaw", got.Gi, wanted.Gi, 1e-6 * wanted.Gi);
  for (int i = 0; i < 3; ++i)
    check.near(fmt::format("Gx[{}] of previewLaw", i), got.Gx[i], wanted.Gx[i],
               1e-6 * std::abs(wanted.Gx[i]));
  check.shape("Gp of previewLaw", got.Gp, cart.ahead, 1);
  check.near("Gp of previewLaw", got.Gp, wanted.Gp, 1e-6 * wanted.Gp.cwiseAbs().maxCoeff());
}

/// A walk with turns and steps of any length, including backward and sideways ones.
inline rex::WalkPlan randomWalk(rex::Rng& rng) {
  rex::WalkPlan plan{.doubleSupport = rng.uniform(.1, .3), .singleSupport = rng.uniform(.5, .9)};
  const double width = rng.uniform(.17, .25);
  double yaw = rng.uniform(-3, 3);
  Eigen::Vector2d at = rng.uniformVector(2, -2, 2);
  for (int i = 0; i < 8; ++i) {
    const bool isLeft = i % 2 == 0;
    const Eigen::Vector2d along(std::cos(yaw), std::sin(yaw)), left(-along.y(), along.x());
    plan.footsteps.push_back({.side = isLeft ? rex::Side::kLeft : rex::Side::kRight,
                              .p = at + (isLeft ? .5 : -.5) * width * left,
                              .yaw = yaw});
    if (i == 0) continue;
    yaw += rng.uniform(-.15, .15);
    at += rng.uniform(-.1, .3) * along + rng.uniform(-.03, .03) * left;
  }
  return plan;
}

/// A walk from above, up to the column where it went wrong.
inline rex::grading::Evidence walkSeen(const rex::WalkPlan& plan, const Eigen::MatrixXd& zmp,
                                       const Eigen::MatrixXd& reference, Eigen::Index until) {
  using namespace rex::grading;
  rex::Figure above = rex::footprintFigure(plan);
  above.title = "Zero moment point on the footprints, until it left them";
  above.legend = rex::Legend::kOutside;
  const Eigen::MatrixXd before = zmp.leftCols(until + 1);
  above.series = {through(before, gotCurve("yours")), through(reference, wantedCurve("wanted")),
                  wrongPoint("off the soles", zmp(0, until), zmp(1, until))};
  return {.figures = {above}};
}

/// Checks over a whole walk that the cart obeys its equation of motion, and that its zero moment point
/// stays on the standing soles.
inline void staysOnTheSoles(rex::grading::Check& check, Student& student, const CartTable& cart,
                            const rex::WalkPlan& plan) {
  check.input(fmt::format("{} footsteps, {:.3g} s on one foot, {:.3g} s on both, {}", plan.footsteps.size(),
                          plan.singleSupport, plan.doubleSupport, described(cart)));
  const Eigen::MatrixXd reference = rex::zmpReference(plan, cart.step);
  const PreviewLaw law = student.previewLaw(cart);
  check.shape("Gp of previewLaw", law.Gp, cart.ahead, 1);
  Eigen::MatrixXd zmp(2, reference.cols());
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const Eigen::MatrixXd x = student.followed(cart, law, reference.row(axis).transpose());
    check.shape("states of followed", x, 3, reference.cols());
    check.near("first state of followed", x.col(0), Eigen::Vector3d(reference(axis, 0), 0, 0), 1e-9);
    Eigen::MatrixXd wanted(3, x.cols() - 1);
    for (Eigen::Index k = 0; k + 1 < x.cols(); ++k)
      wanted.col(k) = cartAfter(cart, x.col(k), (x(2, k + 1) - x(2, k)) / cart.step);
    check.nearAlong("state of followed, one cartStep() after the state before",
                    columnsOf(x.rightCols(x.cols() - 1)), columnsOf(wanted).values, 1e-7);
    zmp.row(axis) = x.row(0) - cart.height / cart.g * x.row(2);
  }
  Eigen::Index left = zmp.cols();
  rex::grading::Signal margin{.axis = "time [s]"};
  for (Eigen::Index k = 0; k < zmp.cols(); ++k) {
    const double time = static_cast<double>(k) * cart.step;
    const rex::WalkPhase phase = rex::phaseAt(plan, time);
    margin.add(time, rex::supportMargin(rex::supportPolygon(phase, plan.sole), zmp.col(k)).margin);
    if (margin.values.back()[0] < 0) left = std::min(left, k);
  }
  const auto shown = check.show([&] { return walkSeen(plan, zmp, reference, left); });
  check.atLeastAlong("distance of the zero moment point from the border of the support polygon", margin, 0,
                     "m");
}
