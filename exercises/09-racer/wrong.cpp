// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant calls_the_library> caught by: forbidden-call
// mistake: takes the equation of motion from the library.
// <solution headers>
#include "systems/racer.h"
// <solution massMatrix>
return RacerDynamics{racer.r, racer.l, racer.mA, racer.mB, racer.IA, racer.IB, racer.g}.massMatrix(q);

// <variant spin_of_the_wheel_forgotten> caught by: mass, lagrangian
// mistake: the wheel moves along, but does not turn.
// <solution massMatrix>
// in place of: M << racer.mA + racer.mB + racer.IA / (racer.r * racer.r), ... racer.mB * racer.l * racer.l +
M << racer.mA + racer.mB, mixed, mixed, racer.mB* racer.l* racer.l + racer.IB;

// <variant wheel_as_a_disc> caught by: mass, lagrangian
// mistake: takes mA r^2 / 4 for the wheel's moment of inertia; for the racer of the sheet that is IA.
// <solution massMatrix>
const double IA = racer.mA * racer.r * racer.r / 4, c = racer.mB * racer.l * std::cos(q[1]);
Eigen::Matrix2d M;
M << racer.mA + racer.mB + IA / (racer.r * racer.r), c, c, racer.IB + racer.mB* racer.l* racer.l;
return M;

// <variant course_code_of_old> caught by: forces, lagrangian
// mistake: the terms of the course's old code: one Coriolis term twice, and another that does not exist.
// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
const double second = swing * v[0] * v[1] - swing * racer.g;
return {-2 * swing * v[1] * v[1], second};

// <variant gravity_pulls_back> caught by: forces, lagrangian
// mistake: the sign of the potential energy, as if the pendulum hung.
// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
return {-swing * v[1] * v[1], swing* racer.g};

// <variant no_torque_on_the_body> caught by: forces, lagrangian
// mistake: the motor turns the wheel, and nothing turns the pendulum back.
// <solution controlDirection>
return {1 / racer.r, 0};

// <variant new_velocities> caught by: step
// shown by: ride
// mistake: one step of Euler, in which the positions move with the new velocities.
// <solution stepped>
Eigen::Vector4d next = x;
next.tail<2>() += tau * rateOf(x, u, racer).tail<2>();
next.head<2>() += tau * next.tail<2>();
return next;

// <variant old_velocities> caught by: step, energy
// mistake: one step of Euler.
// <solution stepped>
return x + tau * rateOf(x, u, racer);

// <variant always_the_same_noise> caught by: noise
// mistake: uses a generator of its own, so that all rides have the same noise.
// <solution kicks>
Rng own(3);
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t)
  for (int i = 0; i < 2; ++i) noises(i, t) = std::sqrt(tau) * noise * own.normal();
return noises;

// <variant copy_of_rng> caught by: noise
// mistake: draws from a copy of rng, which itself never moves on: each run has the same noise.
// <solution kicks>
Rng mine = rng;
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t) noises.col(t) = std::sqrt(tau) * noise * mine.normalVector(2);
return noises;

// <variant noise_by_tau> caught by: noise
// shown by: noise
// mistake: scales the noise by tau instead of its root.
// <solution kicks>
return tau * noise * rng.normalVector(2 * steps).reshaped(2, steps);

// <variant one_kick_for_both> caught by: noise
// mistake: the same number for both velocities.
// <solution kicks>
return std::sqrt(tau) * noise * rng.normalVector(steps).transpose().replicate(2, 1);

// <variant control_costs_forgotten> caught by: gain, unseen-lqr
// mistake: forgets R, which is 1 on the sheet.
// <solution lqrGain>
// in place of: Z << system.A, -system.B * system.B.transpose() / R, -Q, -system.A.transpose();
Z << system.A, -system.B *system.B.transpose(), -Q, -system.A.transpose();
// in place of: for (int row = 0; row < 4; ++row) { ... }
for (int i = 0; i < 4; ++i) K[i] = system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i)));

// <variant gain_sign> caught by: gain, unseen-lqr
// mistake: the sign of the gain as on slide 8:43, where u = +K x.
// <solution lqrGain>
// in place of: for (int row = 0; row < 4; ++row) { ... }
for (int i = 0; i < 4; ++i) K[i] = -system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i))) / R;

// <variant averages_start_at_zero> caught by: features, unseen-features
// mistake: the averages begin with zero instead of the first reading.
// <solution featuresAt>
const Eigen::VectorXd last = before.size() > 0 ? before : Eigen::VectorXd::Zero(kFeatures);
Eigen::VectorXd now = Eigen::VectorXd::Zero(kFeatures);
now[0] = 1;
now.segment<4>(1) = y;
if (before.size() > 0) now.segment<4>(5) = (y - last.segment<4>(1)) / tau;
now.segment<8>(9) = .5 * last.segment<8>(9) + .5 * now.segment<8>(1);
now.segment<8>(17) = .9 * last.segment<8>(17) + .1 * now.segment<8>(1);
if (before.size() > 0) now[25] = u;
now[26] = last[25];
return now;

// <variant averages_the_other_way> caught by: features, unseen-features
// mistake: gives the factor of the average to the new reading.
// <solution featuresAt>
// in place of: const bool isFirst = before.size() == 0;
// in place of: if (isFirst) return now;
if (before.size() == 0) return now;
// in place of: now.segment<8>(9) = .5 * before.segment<8>(9) + .5 * ... now.segment<8>(17) = .9 *
now.segment<8>(9) = .5 * (before.segment<8>(9) + now.segment<8>(1));
now.segment<8>(17) = .1 * before.segment<8>(17) + .9 * now.segment<8>(1);

// <variant rates_per_step> caught by: features, unseen-features
// mistake: differences instead of rates.
// <solution featuresAt>
// in place of: const bool isFirst = before.size() == 0;
// in place of: if (isFirst) return now; ... now.segment<4>(5) = (y - before.segment<4>(1)) / tau;
if (before.size() == 0) return now;
now.segment<4>(5) = y - before.segment<4>(1);

// <variant costs_of_the_state_before> caught by: ride
// mistake: counts the state before the step.
// <solution rideOf>
// in place of: x = stepped(x, u, kTau, racer);
const Eigen::Vector4d last = x;
x = stepped(x, u, kTau, racer);
// in place of: ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T
ride.cost +=
    stands ? last[0] * last[0] + 10 * last[1] * last[1] : kCostOfMissing * static_cast<double>(T - n);

// <variant failing_is_cheap> caught by: failed-ride
// mistake: the ride is cut, but the missing steps cost nothing.
// <solution rideOf>
// in place of: ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T
ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : 0;

// <variant motor_without_limits> caught by: failed-ride, unseen-rides
// mistake: the motor gives whatever the policy asks for.
// <solution rideOf>
// in place of: u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
u = w.dot(features);

// <variant not_cut_at_failure> caught by: failed-ride
// mistake: goes on after the failure, turning round and round.
// <solution rideOf>
const Eigen::Index T = noise.cols();
Ride ride{Eigen::MatrixXd(4, T + 1), Eigen::VectorXd(T), 0};
ride.states.col(0) = start;
Eigen::VectorXd features;
double u = 0;
for (Eigen::Index n = 0; n < T; ++n) {
  const Eigen::Vector4d x = ride.states.col(n);
  features = featuresAt(sensors.measured(x, racer.r), features, u, kTau);
  u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
  ride.controls[n] = u;
  Eigen::Vector4d next = stepped(x, u, kTau, racer);
  next.tail<2>() += noise.col(n);
  ride.states.col(n + 1) = next;
  ride.cost += next[0] * next[0] + 10 * next[1] * next[1];
}
return ride;

// <variant budget_per_search> caught by: search, unseen-search
// mistake: counts generations instead of rides.
// <solution searchedPolicy>
// in place of: const int generations = (budget / kSearches - kTests) / (kSamples * kRepeats);
const int generations = budget / kSearches / kSamples;

// <variant direct_sensors_only> caught by: stays
// mistake: searches on (1, y) only, which do not show how fast the wheel turns.
// <solution searchedPolicy>
// in place of: constexpr int kSearches = 3, kSamples = 20, kRepeats = 4, ... deviations.tail(4) *= kTau;
constexpr int kSearches = 3, kSamples = 20, kRepeats = 4, kTests = 50, kSearched = 5;
Eigen::VectorXd deviations = Eigen::VectorXd::Constant(kSearched, .3);

// <variant one_deviation_for_all> caught by: search, stays, unseen-search
// mistake: searches the weights of rates as far away as those of readings.
// <solution searchedPolicy>
// in place of: deviations.tail(4) *= kTau;

// <variant signs_tried_out> caught by: search, stays, unseen-search
// shown by: search
// mistake: does not search; tries known weights with all signs of motor and sensors.
// <solution searchedPolicy>
Eigen::VectorXd known = Eigen::VectorXd::Zero(kFeatures);
known.head(9) << .037, -.986, 5.999, .726, .07, -.001, -.001, -.004, .053;
Eigen::MatrixXd W = known.replicate(1, 32);
for (int p = 0; p < 32; ++p)
  for (int i = 0; i < 9; ++i) {
    const bool isOther = i > 0 && (p >> (i - 1) % 4 & 1) == 1;
    if (isOther != (p >= 16)) W(i, p) *= -1;
  }
Eigen::VectorXd costs = Eigen::VectorXd::Zero(32);
for (int k = 0; k < 20; ++k) costs += rides(W, kLongestRide);
int best = 0;
costs.minCoeff(&best);
return W.col(best);

// <variant weights_from_elsewhere> caught by: search, stays, unseen-search
// mistake: does not search; takes weights that balance the racer of the sheet, wired as it is there.
// <solution searchedPolicy>
Eigen::VectorXd w = Eigen::VectorXd::Zero(kFeatures);
w.head(9) << .0005, -1.31, 8.28, 1.34, .166, .0045, -.0195, -.0054, .0907;
return w;
