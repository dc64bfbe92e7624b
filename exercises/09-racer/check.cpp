#include "grading/check.h"

#include <array>
#include <cmath>
#include <complex>

#include "interface.h"
#include "noise_checks.h"
#include "racer_checks.h"
#include "search_checks.h"

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
}

void ridesThatFail(Check& check, Student& student) {
  rideFits(check, student, {}, Eigen::VectorXd::Zero(kFeatures), 200);
  rideFits(check, student, {}, tippingOver(check.rng()), 100);
  rideFits(check, student, {}, shaking(check.rng()), 25);
}

void searches(Check& check, Student& student) {
  for (int i = 0; i < 2; ++i) searchSucceeds(check, student, rewired({}, check.rng()));
}

void stays(Check& check, Student& student) { searchedPolicyStays(check, student, rewired({}, check.rng())); }

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

// Over 10 s without control, in steps so short that the Runge-Kutta method loses little energy even for the
// fastest of these racers.
void keepsEnergy(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    const RacerModel racer = i == 0 ? RacerModel{} : randomRacer(check.rng());
    Eigen::Vector4d x(0, check.rng().uniform(.3, 1.5), .3 * check.rng().normal(), 0);
    const auto energy = [&] {
      const Eigen::Vector2d q = x.head<2>(), v = x.tail<2>();
      return v.dot(inertiaAt(q, racer) * v) / 2 + heightEnergy(q, racer);
    };
    const double start = energy(), swing = racer.mB * racer.g * racer.l;
    double lowest = start;
    rex::grading::Signal energies{.axis = "time [s]"};
    for (int t = 0; t < 4000; ++t) {
      x = student.stepped(x, 0, kTau / 4, racer);
      check.shape("state after a step of stepped", x, 4, 1);
      energies.add(kTau / 4 * (t + 1), energy());
      lowest = std::min(lowest, heightEnergy(x.head<2>(), racer));
    }
    check.nearAlong("energy without control, over steps of stepped", energies,
                    {energies.values.size(), Eigen::VectorXd::Constant(1, start)}, .01 * swing, "J");
    check.atLeast("depth of the pendulum's fall, as a share of its length", (start - lowest) / swing, .3);
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

void unseenSearch(Check& check, Student& student) {
  check.forEachCase(
      3, [&](int) { searchSucceeds(check, student, rewired(similarSituation(check.rng()), check.rng())); });
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
      {"features", "features", "Features of successive readings", 2, Group::kVisible, features},
      {"ride", "ride", "Rides that last", 1, Group::kVisible, rides},
      {"failed-ride", "ride", "Rides that end in a failure", 1, Group::kVisible, ridesThatFail},
      {"search", "search", "A policy that balances on unseen noise", 1, Group::kVisible, searches},
      {"stays", "search", "A policy that does not roll away", 2, Group::kVisible, stays},
      // <hidden>
      {"lagrangian", "lagrange", "Other racers, by a numeric Lagrangian", 2, Group::kHidden,
       numericLagrangian},
      {"energy", "simulation", "Energy without control", 1, Group::kHidden, keepsEnergy},
      {"unseen-lqr", "lqr", "Other racers, held by your gain", 1, Group::kHidden, unseenLqr},
      {"unseen-features", "features", "Other readings and time steps", 1, Group::kHidden, unseenFeatures},
      {"unseen-rides", "ride", "Rides of other racers", 1, Group::kHidden, otherRides},
      {"unseen-search", "search", "Policies for other racers", 1, Group::kHidden, unseenSearch},
      // </hidden>
  };
}
