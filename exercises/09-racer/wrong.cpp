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
// ask: Is the rotation of the wheel left out? It turns by x / r.
// <solution massMatrix>
// in place of: M << racer.mA + racer.mB + racer.IA / (racer.r * racer.r), ... racer.mB * racer.l * racer.l +
M << racer.mA + racer.mB, mixed, mixed, racer.mB* racer.l* racer.l + racer.IB;

// <variant wheel_as_a_disc> caught by: mass, lagrangian
// mistake: takes mA r^2 / 4 for the wheel's moment of inertia; for the racer of the sheet that is IA.
// ask: Is the wheel's moment of inertia that of a disc? IA is given.
// <solution massMatrix>
const double IA = racer.mA * racer.r * racer.r / 4, c = racer.mB * racer.l * std::cos(q[1]);
Eigen::Matrix2d M;
M << racer.mA + racer.mB + IA / (racer.r * racer.r), c, c, racer.IB + racer.mB* racer.l* racer.l;
return M;

// <variant course_code_of_old> caught by: forces, lagrangian
// mistake: the terms of the course's old code: one Coriolis term twice, and another that does not exist.
// ask: Is this the F of the course's original code, which conserves energy and is nevertheless wrong?
// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
const double second = swing * v[0] * v[1] - swing * racer.g;
return {-2 * swing * v[1] * v[1], second};

// <variant gravity_pulls_back> caught by: forces, lagrangian
// mistake: the sign of the potential energy, as if the pendulum hung.
// ask: Does gravity have the sign of a hanging pendulum? theta is 0 upright.
// <solution forceTerm>
const double swing = racer.mB * racer.l * std::sin(q[1]);
return {-swing * v[1] * v[1], swing* racer.g};

// <variant no_torque_on_the_body> caught by: forces, lagrangian
// mistake: the motor turns the wheel, and nothing turns the pendulum back.
// ask: What turns the pendulum back? The motor acts between wheel and pendulum.
// <solution controlDirection>
return {1 / racer.r, 0};

// <variant new_velocities> caught by: step
// shown by: ride
// mistake: one step of Euler, in which the positions move with the new velocities.
// ask: Is it one step of Euler's method, in which x and theta move with the new velocities? A Runge-Kutta
// ask: step takes the weighted mean of four rates.
// <solution stepped>
Eigen::Vector4d next = x;
next.tail<2>() += tau * rateOf(x, u, racer).tail<2>();
next.head<2>() += tau * next.tail<2>();
return next;

// <variant old_velocities> caught by: step
// mistake: one step of Euler.
// ask: Is it one step of Euler's method? A Runge-Kutta step takes the weighted mean of four rates.
// <solution stepped>
return x + tau * rateOf(x, u, racer);

// <variant always_the_same_noise> caught by: noise
// mistake: uses a generator of its own, so that all rides have the same noise.
// ask: Does kicks use a generator of its own? All randomness comes from rng.
// <solution kicks>
Rng own(3);
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t)
  for (int i = 0; i < 2; ++i) noises(i, t) = std::sqrt(tau) * noise * own.normal();
return noises;

// <variant copy_of_rng> caught by: noise
// mistake: draws from a copy of rng, which itself never moves on: each run has the same noise.
// ask: Does kicks use a generator of its own? All randomness comes from rng.
// <solution kicks>
Rng mine = rng;
Eigen::MatrixXd noises(2, steps);
for (int t = 0; t < steps; ++t) noises.col(t) = std::sqrt(tau) * noise * mine.normalVector(2);
return noises;

// <variant noise_by_tau> caught by: noise
// shown by: noise
// mistake: scales the noise by tau instead of its root.
// ask: Is the noise multiplied by tau instead of its root?
// <solution kicks>
return tau * noise * rng.normalVector(2 * steps).reshaped(2, steps);

// <variant one_kick_for_both> caught by: noise
// mistake: the same number for both velocities.
// ask: Do both velocities get the same number?
// <solution kicks>
return std::sqrt(tau) * noise * rng.normalVector(steps).transpose().replicate(2, 1);

// <variant control_costs_forgotten> caught by: gain, unseen-lqr
// mistake: forgets R, which is 1 on the sheet.
// ask: Is R left out, as if it were 1?
// <solution lqrGain>
// in place of: Z << system.A, -system.B * system.B.transpose() / R, -Q, -system.A.transpose();
Z << system.A, -system.B *system.B.transpose(), -Q, -system.A.transpose();
// in place of: for (int row = 0; row < 4; ++row) { ... }
for (int i = 0; i < 4; ++i) K[i] = system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i)));

// <variant gain_sign> caught by: gain, unseen-lqr
// mistake: the sign of the gain as on slide 8:43, where u = +K x.
// ask: Is it the K of u = K x? Here u = -K x.
// <solution lqrGain>
// in place of: for (int row = 0; row < 4; ++row) { ... }
for (int i = 0; i < 4; ++i) K[i] = -system.B.dot(leastSquares(Z.rightCols(4), -Z.col(i))) / R;

// <variant averages_start_at_zero> caught by: features, unseen-features
// mistake: the averages begin with zero instead of the first reading.
// ask: Do the averages begin with zero? At the first reading they are the reading itself.
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
// ask: Is a the factor of the new reading? It is that of the average before.
// <solution featuresAt>
// in place of: const bool isFirst = before.size() == 0;
// in place of: if (isFirst) return now;
if (before.size() == 0) return now;
// in place of: now.segment<8>(9) = .5 * before.segment<8>(9) + .5 * ... now.segment<8>(17) = .9 *
now.segment<8>(9) = .5 * (before.segment<8>(9) + now.segment<8>(1));
now.segment<8>(17) = .1 * before.segment<8>(17) + .9 * now.segment<8>(1);

// <variant rates_per_step> caught by: features, unseen-features
// mistake: differences instead of rates.
// ask: Is the difference of the readings not divided by tau?
// <solution featuresAt>
// in place of: const bool isFirst = before.size() == 0;
// in place of: if (isFirst) return now; ... now.segment<4>(5) = (y - before.segment<4>(1)) / tau;
if (before.size() == 0) return now;
now.segment<4>(5) = y - before.segment<4>(1);

// <variant costs_of_the_state_before> caught by: ride
// mistake: counts the state before the step.
// ask: Are the states before the steps counted? The cost is that of the state after each step.
// <solution rideOf>
// in place of: x = stepped(x, u, kTau, racer);
const Eigen::Vector4d last = x;
x = stepped(x, u, kTau, racer);
// in place of: ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T
ride.cost +=
    stands ? last[0] * last[0] + 10 * last[1] * last[1] : kCostOfMissing * static_cast<double>(T - n);

// <variant failing_is_cheap> caught by: ride
// mistake: the ride is cut, but the missing steps cost nothing.
// ask: Do missing steps cost nothing?
// <solution rideOf>
// in place of: ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : kCostOfMissing * static_cast<double>(T
ride.cost += stands ? x[0] * x[0] + 10 * x[1] * x[1] : 0;

// <variant motor_without_limits> caught by: ride, unseen-rides
// mistake: the motor gives whatever the policy asks for.
// ask: Is u not limited to what the motor gives?
// <solution rideOf>
// in place of: u = std::clamp(w.dot(features), -kLargestControl, kLargestControl);
u = w.dot(features);

// <variant not_cut_at_failure> caught by: ride
// mistake: goes on after the failure, turning round and round.
// ask: Does the ride go on after the racer has failed?
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

// <variant highest_costs> caught by: selection, unseen-evolution
// shown by: selection
// mistake: selects the worst.
// ask: Are the mu samples with the highest costs selected?
// <solution nextSpecies>
// in place of: std::ranges::sort(order
std::ranges::sort(order, {}, [&](Eigen::Index i) { return -costs[i]; });

// <variant first_in_order> caught by: selection, unseen-evolution
// mistake: takes the first samples, which nobody has sorted.
// ask: Are the first mu samples taken, in the order in which they came?
// <solution nextSpecies>
// in place of: std::ranges::sort(order

// <variant best_alone> caught by: selection, unseen-evolution
// mistake: moves to the best sample.
// ask: Is it the best sample alone? The mean of the mu best is less a matter of luck.
// <solution nextSpecies>
// in place of: next.mean =
next.mean = X.col(order[0]);

// <variant nothing_selected> caught by: selection, unseen-evolution
// mistake: takes the mean of all samples.
// ask: Is nothing selected, and is it the mean of all samples?
// <solution nextSpecies>
// in place of: next.mean =
next.mean = X.rowwise().mean();

// <variant step_in_units_of_x> caught by: selection, unseen-evolution
// mistake: does not divide the step by the deviation.
// ask: Is the step of the mean not divided by the deviation?
// <solution nextSpecies>
// in place of: next.path =
next.path = (1 - c) * species.path + std::sqrt(c * (2 - c) * mu) * (next.mean - species.mean);

// <variant mu_forgotten> caught by: selection, unseen-evolution
// mistake: the length of the path depends on mu.
// ask: Is the root of mu missing? The mean of mu samples varies less than one.
// <solution nextSpecies>
// in place of: next.path =
next.path = (1 - c) * species.path + std::sqrt(c * (2 - c)) * step;

// <variant weights_sum_to_one> caught by: selection, unseen-evolution
// mistake: takes the path for an average of steps.
// ask: Is the step multiplied by c instead of the root of c (2 - c) mu?
// <solution nextSpecies>
// in place of: next.path =
next.path = (1 - c) * species.path + c * step;

// <variant shares_exchanged> caught by: selection, unseen-evolution
// mistake: c and 1 - c exchanged.
// ask: Are c and 1 - c exchanged?
// <solution nextSpecies>
// in place of: next.path =
next.path = c * species.path + std::sqrt(c * (2 - c) * mu) * step;

// <variant path_forgotten> caught by: selection, unseen-evolution
// mistake: the path is the last step.
// ask: Is the path before forgotten?
// <solution nextSpecies>
// in place of: next.path =
next.path = std::sqrt(c * (2 - c) * mu) * step;

// <variant fixed_deviation> caught by: selection, unseen-evolution
// mistake: keeps the deviation, as slide 9:29 does.
// ask: Is the deviation left as it was, as on slide 9:29? Here it follows the path.
// <solution nextSpecies>
// in place of: next.deviation =
next.deviation = species.deviation;

// <variant path_before> caught by: selection, unseen-evolution
// mistake: the deviation follows the path before.
// ask: Does the deviation follow the path before? It follows the new one.
// <solution nextSpecies>
// in place of: next.deviation =
next.deviation = species.deviation * std::exp(c / 2 * (species.path.squaredNorm() / n - 1));

// <variant length_not_squared> caught by: selection, unseen-evolution
// mistake: compares the length of the path with n.
// ask: Is |path| not squared?
// <solution nextSpecies>
// in place of: next.deviation =
next.deviation = species.deviation * std::exp(c / 2 * (next.path.norm() / n - 1));

// <variant dimension_forgotten> caught by: selection, unseen-evolution
// mistake: expects a path as long as in one dimension.
// ask: Is |path|^2 not divided by n? Without selection it is n on average.
// <solution nextSpecies>
// in place of: next.deviation =
next.deviation = species.deviation * std::exp(c / 2 * (next.path.squaredNorm() - 1));

// <variant around_the_start> caught by: evolution, unseen-evolution
// shown by: evolution
// mistake: samples around the start, always.
// ask: Is every generation sampled around the start? Species have a mean.
// <solution evolved>
// in place of: Eigen::MatrixXd X = species.mean.replicate(1, lambda);
Eigen::MatrixXd X = start.mean.replicate(1, lambda);

// <variant deviation_of_the_start> caught by: evolution, unseen-evolution
// mistake: samples with the first deviation, always.
// ask: Is every generation sampled with the deviation of the start?
// <solution evolved>
// in place of: X +=
X += start.deviation * rng.normalVector(n * lambda).reshaped(n, lambda);

// <variant variance> caught by: evolution, unseen-evolution
// mistake: takes the deviation for the variance.
// ask: Is the deviation used as the variance?
// <solution evolved>
// in place of: X +=
X += std::sqrt(species.deviation) * rng.normalVector(n * lambda).reshaped(n, lambda);

// <variant one_number_per_sample> caught by: evolution, unseen-evolution
// mistake: adds the same number to all coordinates.
// ask: Is the same number added to all coordinates of a sample?
// <solution evolved>
// in place of: X +=
X += species.deviation * rng.normalVector(lambda).transpose().replicate(n, 1);

// <variant twins> caught by: evolution, unseen-evolution
// mistake: all samples of a generation are the same.
// ask: Are all samples of a generation the same?
// <solution evolved>
// in place of: X +=
X.colwise() += species.deviation * rng.normalVector(n);

// <variant copied_generator> caught by: evolution, unseen-evolution
// mistake: draws the same numbers in each generation.
// ask: Does evolved draw from a copy of rng? Pass rng by reference.
// <solution evolved>
// in place of: X +=
Rng mine = rng;
X += species.deviation * mine.normalVector(n * lambda).reshaped(n, lambda);

// <variant new_path_each_time> caught by: evolution, unseen-evolution
// mistake: begins each generation without a path.
// <solution evolved>
// in place of: species = nextSpecies(species, X, costs(X), mu);
species.path.setZero();
species = nextSpecies(species, X, costs(X), mu);

// <variant one_generation_less> caught by: evolution, unseen-evolution
// mistake: counts the start as a generation.
// ask: Is the start counted as a generation?
// <solution evolved>
// in place of: Eigen::MatrixXd X = species.mean.replicate(1, lambda);
if (i == 0) continue;
Eigen::MatrixXd X = species.mean.replicate(1, lambda);

// <variant budget_per_search> caught by: search, unseen-search
// mistake: counts generations instead of rides.
// ask: Are calls counted instead of rides? A call with m columns uses m rides.
// <solution searchedPolicy>
// in place of: const int generations = (budget / kSearches - kTests) / (kSamples * kRepeats);
const int generations = budget / kSearches / kSamples;

// <variant one_deviation_for_all> caught by: search, unseen-search
// mistake: searches the weights of rates as far away as those of readings.
// ask: Are the weights of rates searched as far from zero as those of readings? Rates are a hundred times as
// ask: large.
// <solution searchedPolicy>
// in place of: deviations.tail(4) *= kTau;

// <variant weights_from_elsewhere> caught by: search, unseen-search
// mistake: does not search; takes weights that balance the racer of the sheet.
// ask: Is nothing searched? Weights found elsewhere do not count.
// <solution searchedPolicy>
Eigen::VectorXd w = Eigen::VectorXd::Zero(kFeatures);
w.head(9) << .0005, -1.31, 8.28, 1.34, .166, .0045, -.0195, -.0054, .0907;
return w;

// <variant gyroscope_and_encoder_exchanged> caught by: sensed-cost, unseen-sensed
// mistake: prices the encoder like the gyroscope.
// ask: Are gyroscope and encoder exchanged? It is the encoder's square that is divided by 10.
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(2).squaredNorm() / 10 + Y.row(3).squaredNorm() +
       kCostOfMissing * static_cast<double>(steps - Y.cols());

// <variant rows_counted_from_one> caught by: sensed-cost, unseen-sensed
// mistake: takes rows 1 and 2.
// ask: Is y2 the second row? Rows are counted from zero.
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(1).squaredNorm() + Y.row(2).squaredNorm() / 10 +
       kCostOfMissing * static_cast<double>(steps - Y.cols());

// <variant tenth_of_the_reading> caught by: sensed-cost, unseen-sensed
// mistake: divides before it squares.
// ask: Is the reading of the encoder divided by 10 before it is squared?
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(2).squaredNorm() + (Y.row(3) / 10).squaredNorm() +
       kCostOfMissing * static_cast<double>(steps - Y.cols());

// <variant early_end_for_free> caught by: sensed-cost, unseen-sensed
// mistake: a ride that ends early is cheap.
// ask: Do missing steps cost nothing?
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(2).squaredNorm() + Y.row(3).squaredNorm() / 10;

// <variant one_price_for_failing> caught by: sensed-cost, unseen-sensed
// mistake: the cost of failing does not depend on when.
// ask: Is kCostOfMissing counted once? Each missing step costs as much.
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(2).squaredNorm() + Y.row(3).squaredNorm() / 10 + (Y.cols() < steps ? kCostOfMissing : 0);

// <variant ridden_steps_cost> caught by: sensed-cost, unseen-sensed
// mistake: charges for steps that were ridden.
// ask: Does each step that was ridden cost kCostOfMissing?
// <solution sensedCost>
// in place of: return Y.row(2) ... kCostOfMissing
return Y.row(2).squaredNorm() + Y.row(3).squaredNorm() / 10 + kCostOfMissing * static_cast<double>(Y.cols());

// <variant bias_left_out> caught by: sensed-pose, unseen-sensed
// mistake: takes the gyroscope at its word.
// ask: Is theta' the reading of the gyroscope? It reads theta' - gyroBias.
// <solution sensedPose>
// in place of: const double spin =
const double spin = y[2], pull = sensors.kappa * spin * spin;

// <variant bias_subtracted> caught by: sensed-pose, unseen-sensed
// mistake: the sign of the bias.
// ask: Is gyroBias subtracted? The gyroscope reads theta' - gyroBias.
// <solution sensedPose>
// in place of: const double spin =
const double spin = y[2] - sensors.gyroBias, pull = sensors.kappa * spin * spin;

// <variant no_centrifugal_terms> caught by: sensed-pose, unseen-sensed
// mistake: the direction of gravity alone.
// ask: Are the terms with theta'^2 left out?
// <solution sensedPose>
// in place of: const double spin =
const double pull = 0;

// <variant mount_left_out> caught by: sensed-pose, unseen-sensed
// mistake: the angle of the accelerometers instead of the body.
// ask: Is it theta + phi? The accelerometers are mounted at the angle phi.
// <solution sensedPose>
// in place of: std::atan2(
std::atan2(y[1] + pull * std::sin(sensors.phi), y[0] + pull * std::cos(sensors.phi));

// <variant small_angle> caught by: sensed-pose, unseen-sensed
// mistake: takes sin(theta + phi) for the angle.
// ask: Is sin(theta + phi) taken for theta + phi?
// <solution sensedPose>
// in place of: const double spin = ... std::atan2(
const double theta = y[1] / sensors.s - sensors.phi;

// <variant wheel_alone> caught by: sensed-pose, unseen-sensed
// mistake: forgets that the encoder turns with the body.
// ask: Is x = r y3? The encoder is between wheel and body, which tilts.
// <solution sensedPose>
// in place of: return {racer.r * (y[3] + theta), theta};
return {racer.r * y[3], theta};

// <variant body_turns_back> caught by: sensed-pose, unseen-sensed
// mistake: the sign of theta in the reading of the encoder.
// ask: Does theta have the wrong sign in x?
// <solution sensedPose>
// in place of: return {racer.r * (y[3] + theta), theta};
return {racer.r * (y[3] - theta), theta};

// <variant angle_of_the_wheel> caught by: sensed-pose, unseen-sensed
// mistake: returns the angle of the wheel.
// ask: Is x not multiplied by r?
// <solution sensedPose>
// in place of: return {racer.r * (y[3] + theta), theta};
return {y[3] + theta, theta};
