#include "grading/check.h"

#include <array>
#include <cmath>
#include <complex>

#include "evolution_checks.h"
#include "interface.h"
#include "noise_checks.h"
#include "racer_checks.h"
#include "search_checks.h"
#include "sensed_checks.h"

using rex::grading::Check;
using rex::grading::Group;

namespace {

// The wheel of the sheet could be a disc that turns about a diameter; that of another racer could not.
void massAndEnergy(Check& check, Student& student) {
  massFits(check, student, RacerModel{});
  massFits(check, student, randomRacer(check.rng()));
}

void forces(Check& check, Student& student) {
  forcesFit(check, student, RacerModel{});
  forcesFit(check, student, randomRacer(check.rng()));
}

void steps(Check& check, Student& student) {
  checkStep(check, student, RacerModel{}, .01);
  checkStep(check, student, randomRacer(check.rng()), .02);
}

void noises(Check& check, Student& student) {
  noiseFits(check, student, 4000, .01, .1);
  noiseFits(check, student, 4000, .0025, .3);
  noiseIsIndependent(check, student, 1000);
}

void linearises(Check& check, Student& student) {
  linearFits(check, student, RacerModel{});
  linearFits(check, student, randomRacer(check.rng()));
}

void gainOfTheSheet(Check& check, Student& student) {
  gainFits(check, student, RacerModel{}, Eigen::Vector2d(1, 10), 1);
  gainFits(check, student, RacerModel{}, Eigen::Vector2d(2, 5), .5);
}

void features(Check& check, Student& student) {
  featuresFit(check, student, kTau, 5);
  featuresFit(check, student, kTau, 30);
}

void rides(Check& check, Student& student) {
  for (int i = 0; i < 3; ++i) rideFits(check, student, {}, balancing(check.rng()), 60);
  rideFits(check, student, {}, Eigen::VectorXd::Zero(kFeatures), 200);
  rideFits(check, student, {}, tippingOver(check.rng()), 100);
  rideFits(check, student, {}, shaking(check.rng()), 25);
}

void selects(Check& check, Student& student) {
  selectionFits(check, student, 2, 2, 5);
  selectionFits(check, student, 4, 5, 12);
}

void evolves(Check& check, Student& student) { strategyFits(check, student, 3, 4, 60); }

void searches(Check& check, Student& student) { ridesOn(check, {}, searchSucceeds(check, student, {})); }

void sensesCost(Check& check, Student& student) {
  sensedCostFits(check, student, 3, 3);
  sensedCostFits(check, student, 3, 8);
}

void sensesPose(Check& check, Student& student) { sensedPoseFits(check, student, {}); }

// <hidden>
// The energies of any racer from the velocities of its bodies, by complex steps, which are exact up to
// rounding; the equation of motion follows from these energies.
using Complex = std::complex<double>;

// (x, z, angle) of the wheel and of the pendulum, one after the other.
std::array<Complex, 6> posesAt(const std::array<Complex, 2>& q, const RacerModel& racer) {
  return {q[0], racer.r, q[0] / racer.r, q[0] + racer.l * std::sin(q[1]), racer.r + racer.l * std::cos(q[1]),
          q[1]};
}

Eigen::Matrix2d inertiaAt(const Eigen::Vector2d& q, const RacerModel& racer) {
  constexpr double h = 1e-100;
  Eigen::Matrix<double, 6, 2> J;
  for (std::size_t k = 0; k < 2; ++k) {
    std::array<Complex, 2> near{q[0], q[1]};
    near[k] += Complex(0, h);
    const auto poses = posesAt(near, racer);
    for (std::size_t i = 0; i < 6; ++i)
      J(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = poses[i].imag() / h;
  }
  Eigen::Matrix<double, 6, 1> masses;
  masses << racer.mA, racer.mA, racer.IA, racer.mB, racer.mB, racer.IB;
  return J.transpose() * masses.asDiagonal() * J;
}

double heightEnergy(const Eigen::Vector2d& q, const RacerModel& racer) {
  const auto poses = posesAt({q[0], q[1]}, racer);
  return racer.g * (racer.mA * poses[1] + racer.mB * poses[4]).real();
}

// d/dt dL/dq' - dL/dq without the terms in q''; derivatives by q are finite differences of exact numbers.
Eigen::Vector2d numericForces(const Eigen::Vector2d& q, const Eigen::Vector2d& v, const RacerModel& racer) {
  constexpr double h = 1e-4;
  Eigen::Vector2d F = (inertiaAt(q + h * v / v.norm(), racer) - inertiaAt(q - h * v / v.norm(), racer)) * v *
                      v.norm() / (2 * h);
  for (int k = 0; k < 2; ++k) {
    const auto lagrangian = [&](double by) {
      const Eigen::Vector2d at = q + by * Eigen::Vector2d::Unit(k);
      return v.dot(inertiaAt(at, racer) * v) / 2 - heightEnergy(at, racer);
    };
    F[k] -= (lagrangian(h) - lagrangian(-h)) / (2 * h);
  }
  return F;
}

// Finite differences have a relative error of h^2.
void numericLagrangian(Check& check, Student& student) {
  check.forEachCase(10, [&](int) {
    const RacerModel racer = randomRacer(check.rng());
    const Eigen::Vector2d q = 2 * check.rng().normalVector(2), v = 3 * check.rng().normalVector(2);
    const Eigen::Matrix2d M = inertiaAt(q, racer);
    check.near("M of massMatrix", student.massMatrix(q, racer), M, 1e-10 * M.norm());
    const double scale = racer.mB * racer.l * (v.squaredNorm() + racer.g);
    check.near("F of forceTerm", student.forceTerm(q, v, racer), numericForces(q, v, racer), 1e-6 * scale);
    // The work of the motor over a small turn is u times the angle between wheel and pendulum.
    const Eigen::Vector2d B(1 / racer.r, -1);
    check.near("B of controlDirection", student.controlDirection(racer), B, 1e-12 * B.norm());
    const double energy = v.dot(M * v) / 2 + heightEnergy(q, racer);
    check.near("energy of energyOf", student.energyOf(stateOf(q, v), racer), energy,
               1e-9 * (1 + std::abs(energy)), "J");
  });
}

void unseenLqr(Check& check, Student& student) {
  check.forEachCase(6, [&](int) {
    const RacerModel racer = randomRacer(check.rng());
    linearFits(check, student, racer);
    gainFits(check, student, racer, Eigen::Vector2d(check.rng().uniform(.3, 3), check.rng().uniform(1, 30)),
             check.rng().uniform(.3, 3));
    gainHolds(check, student, racer);
  });
}

void unseenFeatures(Check& check, Student& student) {
  check.forEachCase(6,
                    [&](int i) { featuresFit(check, student, check.rng().uniform(.001, .1), 1 + 10 * i); });
}

void otherRides(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    const Situation other{randomRacer(check.rng()), randomSensors(check.rng()), check.rng().uniform(.05, .2)};
    // Short enough that rounding errors stay small even if a policy shakes.
    if (i % 2 == 0) rideFits(check, student, other, shaking(check.rng()), 25);
    if (i % 2 == 1) rideFits(check, student, other, tippingOver(check.rng()), 80);
  });
}

void unseenEvolution(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    selectionFits(check, student, 1 + 2 * i, 1 + i, 4 + 3 * i);
    strategyFits(check, student, 2 + 2 * i, 1 + 2 * i, 60);
  });
}

void unseenSearch(Check& check, Student& student) {
  check.forEachCase(3, [&](int) { searchSucceeds(check, student, similarSituation(check.rng())); });
}

void unseenSensing(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    sensedCostFits(check, student, 1 + 7 * i, 40);
    sensedPoseFits(check, student, {randomRacer(check.rng()), randomSensors(check.rng())});
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"mass", "lagrange", "M and the energy of two racers", 1, Group::kVisible, massAndEnergy},
      {"forces", "lagrange", "F and B of two racers", 1, Group::kVisible, forces},
      {"step", "simulation", "Rate and step", 1, Group::kVisible, steps},
      {"noise", "simulation", "Noise of the right size", 1, Group::kVisible, noises},
      {"linear", "lqr", "The linear system near rest", 1, Group::kVisible, linearises},
      {"gain", "lqr", "The gain of the racer of the sheet", 1, Group::kVisible, gainOfTheSheet},
      {"features", "features", "Features of successive readings", 1, Group::kVisible, features},
      {"ride", "ride", "Rides that last, and rides that end in a failure", 1, Group::kVisible, rides},
      {"selection", "evolution", "The species after a generation", 1, Group::kVisible, selects},
      {"evolution", "evolution", "Generations of a strategy", 1, Group::kVisible, evolves},
      {"search", "search", "A policy that balances on unseen noise", 1, Group::kVisible, searches},
      {"sensed-cost", "sensed", "What readings cost", 1, Group::kVisible, sensesCost},
      {"sensed-pose", "sensed", "Where the racer is, by its sensors", 1, Group::kVisible, sensesPose},
      // <hidden>
      {"lagrangian", "lagrange", "Other racers, by a numeric Lagrangian", 1, Group::kHidden,
       numericLagrangian},
      {"unseen-lqr", "lqr", "Other racers, held by your gain", 1, Group::kHidden, unseenLqr},
      {"unseen-features", "features", "Other readings and time steps", 1, Group::kHidden, unseenFeatures},
      {"unseen-rides", "ride", "Rides of other racers", 1, Group::kHidden, otherRides},
      {"unseen-evolution", "evolution", "Other generations", 1, Group::kHidden, unseenEvolution},
      {"unseen-search", "search", "Policies for other racers", 1, Group::kHidden, unseenSearch},
      {"unseen-sensed", "sensed", "Other readings, racers and sensors", 1, Group::kHidden, unseenSensing},
      // </hidden>
  };
}
