// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant nearest_node> caught by: interpolation
// mistake: takes the value at the nearest node.
// <solution valueAt>
// in place of: const int cell ... return
return V(static_cast<int>(a + .5) % grid.angles, static_cast<int>(b + .5));

// <variant node_below> caught by: interpolation
// mistake: takes the value at the node below.
// <solution valueAt>
// in place of: const int next ... const int j
const int j = std::min(static_cast<int>(b), grid.rates - 2);
// in place of: const double s ... return
return V(i, j);

// <variant from_zero> caught by: interpolation
// mistake: counts the angles from 0.
// <solution valueAt>
// in place of: const double turn = 2 * std::numbers::pi, share = x[0] / turn + .5;
const double turn = 2 * std::numbers::pi, share = x[0] / turn;

// <variant shares_exchanged> caught by: interpolation
// mistake: the farther node counts more.
// <solution valueAt>
// in place of: const double s = a - cell, t = b - j;
const double s = 1 - (a - cell), t = 1 - (b - j);

// <variant ends_at_pi> caught by: interpolation
// mistake: stops at the last node, which the first follows.
// <solution valueAt>
// in place of: const int next = (cell + 1) % grid.angles;
const int next = std::min(i + 1, grid.angles - 1);

// <variant no_whole_turns> caught by: interpolation
// mistake: knows no angles beyond -pi and pi.
// <solution valueAt>
// in place of: const double a = (share - std::floor(share)) * grid.angles;
const double a = std::clamp(share, 0., 1.) * grid.angles;

// <variant straight_on> caught by: interpolation
// mistake: goes on as it was beyond the fastest rate.
// <solution valueAt>
// in place of: const double rate = std::clamp(x[1], -grid.fastest, grid.fastest);
const double rate = x[1];
// in place of: const int j = std::min(static_cast<int>(b), grid.rates - 2);
const int j = std::clamp(static_cast<int>(b), 0, grid.rates - 2);

// <variant angle_alone> caught by: interpolation
// mistake: interpolates only between angles.
// <solution valueAt>
// in place of: const double s = a - cell, t = b - j;
const double s = a - cell, t = 0;

// <variant per_second> caught by: bellman, other-grids
// shown by: bellman
// mistake: takes the cost per second for that of a step.
// <solution swept>
// in place of: swept(i, j) = decision.tau * costOf(x, u, decision.effort)
swept(i, j) = costOf(x, u, decision.effort) + decision.discount * after;

// <variant no_discount> caught by: bellman, other-grids
// mistake: what comes after counts in full.
// <solution swept>
// in place of: swept(i, j) = decision.tau * costOf(x, u, decision.effort)
swept(i, j) = decision.tau * costOf(x, u, decision.effort) + after;

// <variant discounts_all> caught by: bellman, other-grids
// mistake: discounts the cost of the step, too.
// <solution swept>
// in place of: swept(i, j) = decision.tau * costOf(x, u, decision.effort)
swept(i, j) = decision.discount * (decision.tau * costOf(x, u, decision.effort) + after);

// <variant discount_per_second> caught by: bellman, other-grids
// mistake: takes the discount of a step for that of a second.
// <solution swept>
// in place of: swept(i, j) = decision.tau * costOf(x, u, decision.effort)
const double kept = std::pow(decision.discount, decision.tau);
swept(i, j) = decision.tau * costOf(x, u, decision.effort) + kept * after;

// <variant value_here> caught by: bellman, other-grids
// mistake: adds the value of the node, not of where the step leads.
// <solution swept>
// in place of: const double after = valueAt(grid, V,
const double after = V(i, j);

// <variant euler_step> caught by: bellman
// mistake: makes a step of Euler.
// <solution swept>
// in place of: const double after = valueAt(grid, V,
const double after = valueAt(grid, V, x + decision.tau * rateOf(decision.pendulum, x, u));

// <variant never_torque> caught by: bellman
// mistake: forgets to choose.
// <solution swept>
// in place of: const double u = bestTorque(decision, V, x);
const double u = 0;

// <variant rates_from_zero> caught by: bellman
// mistake: puts the slowest node at rest.
// <solution swept>
// in place of: const double rate = (2. * j / (grid.rates - 1) - 1) * grid.fastest;
const double rate = j * grid.fastest / (grid.rates - 1);

// <variant angles_with_both_ends> caught by: bellman
// mistake: puts the last node at pi, where the first is.
// <solution swept>
// in place of: const double angle = (2. * i / grid.angles - 1) * std::numbers::pi;
const double angle = (2. * i / (grid.angles - 1) - 1) * std::numbers::pi;

// <variant in_place> caught by: bellman
// mistake: overwrites the values that other nodes still need.
// <solution swept>
// in place of: const Grid& grid = decision.grid;
const Grid& grid = decision.grid;
swept = V;
// in place of: const double u = bestTorque(decision, V, x); ... swept(i, j) = decision.tau
const double u = bestTorque(decision, swept, x);
const double after = valueAt(grid, swept, nextOf(decision.pendulum, x, u, decision.tau));
swept(i, j) = decision.tau * costOf(x, u, decision.effort) + decision.discount * after;

// <variant best_is_most> caught by: bellman, torques, other-grids
// mistake: takes the torque that leads to the most.
// <solution bestTorque>
// in place of: double best = 0, least = INFINITY;
double best = 0, least = -INFINITY;
// in place of: if (total < least) best = u, least = total;
if (total > least) best = u, least = total;

// <variant ends_left_out> caught by: bellman, torques, other-grids
// mistake: leaves the strongest torque out.
// <solution bestTorque>
// in place of: const double u
const double u = (2. * std::max(k - 1, 0) / (decision.torques - 1) - 1) * decision.pendulum.strongest;

// <variant value_of_torque> caught by: torques, other-grids
// mistake: returns the value, not the torque.
// <solution bestTorque>
// in place of: if (total < least) best = u, least = total;
if (total < least) best = least = total;

// <variant number_of_torque> caught by: torques, other-grids
// mistake: returns the number of the torque in the list.
// <solution bestTorque>
// in place of: if (total < least) best = u, least = total;
if (total < least) best = k, least = total;

// <variant cheapest_at_once> caught by: torques, other-grids
// mistake: looks no farther than the step.
// <solution bestTorque>
// in place of: const double after ... const double total
const double total = decision.tau * costOf(next, u, decision.effort);

// <variant torque_per_second> caught by: torques, other-grids
// mistake: takes the cost per second for that of a step.
// <solution bestTorque>
// in place of: const double total
const double total = costOf(x, u, decision.effort) + after;

// <variant only_two> caught by: torques, other-grids
// mistake: full strength, one way or the other.
// <solution bestTorque>
// in place of: const double u
const double u = (k % 2 == 0 ? 1 : -1) * decision.pendulum.strongest;

// <variant end_forgotten> caught by: horizon, other-horizons
// mistake: begins with Q instead of F.
// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = costs.Q;
for (auto k = K.rbegin(); k != K.rend(); ++k) {
  *k = -solve(costs.R + B.transpose() * P * B, B.transpose() * P * A);
  P = costs.Q + A.transpose() * P * (A + B * *k);
}
return K;

// <variant gains_backward> caught by: horizon, other-horizons
// mistake: returns the gains in the order in which they are computed.
// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = F;
for (Eigen::MatrixXd& k : K) {
  k = -solve(costs.R + B.transpose() * P * B, B.transpose() * P * A);
  P = costs.Q + A.transpose() * P * (A + B * k);
}
return K;

// <variant gains_of_continuous_time> caught by: horizon, other-horizons
// mistake: K = -R^-1 B^T P, as in continuous time.
// <solution gainsOverTime>
const Eigen::MatrixXd &A = plant.A, &B = plant.B;
std::vector<Eigen::MatrixXd> K(static_cast<std::size_t>(steps));
Eigen::MatrixXd P = F;
for (auto k = K.rbegin(); k != K.rend(); ++k) {
  *k = -solve(costs.R, B.transpose() * P);
  const Eigen::MatrixXd M = costs.R + B.transpose() * P * B;
  P = costs.Q + A.transpose() * (P - P * B * solve(M, B.transpose() * P)) * A;
}
return K;

// <variant no_last_cost> caught by: horizon, other-horizons
// mistake: begins with zero instead of F.
// <solution gainsOverTime>
// in place of: Eigen::MatrixXd P = F;
Eigen::MatrixXd P = 0 * F;

// <variant sign_of_the_library> caught by: horizon, other-horizons
// mistake: the sign of 8:18, u = -K x.
// <solution gainsOverTime>
// in place of: *k = -solveMatrix(costs.R + M, Bt * PA);
*k = solveMatrix(costs.R + M, Bt* PA);
// in place of: const Eigen::MatrixXd PBK = PB * *k, both = PA + PBK;
const Eigen::MatrixXd PBK = PB * *k, both = PA - PBK;

// <variant one_gain> caught by: horizon, other-horizons
// mistake: the gain of the first step for all.
// <solution gainsOverTime>
// in place of: return K;
return std::vector<Eigen::MatrixXd>(static_cast<std::size_t>(steps), K.front());

// <variant gain_of_the_step_before> caught by: horizon, other-horizons
// mistake: takes P of the time t for K[t], not that after the step.
// <solution gainsOverTime>
// in place of: P = .5 * (P + P.transpose()).eval();
P = .5 * (P + P.transpose()).eval();
const Eigen::MatrixXd BtP = Bt * P;
*k = -solveMatrix(costs.R + BtP * plant.B, BtP* plant.A);

// <variant last_charged_twice> caught by: horizon, other-horizons
// mistake: adds Q to the cost of the last state.
// <solution gainsOverTime>
// in place of: Eigen::MatrixXd P = F;
Eigen::MatrixXd P = F + costs.Q;

// <variant nothing_on_the_way> caught by: horizon, other-horizons
// mistake: the states on the way cost nothing.
// <solution gainsOverTime>
// in place of: P = costs.Q + At * both;
P = At * both;

// <variant uncontrolled_values> caught by: horizon, other-horizons
// mistake: P of a motion without control.
// <solution gainsOverTime>
// in place of: const Eigen::MatrixXd PBK = PB * *k, both = PA + PBK;
const Eigen::MatrixXd both = PA;

// <variant only_r_inverted> caught by: horizon, other-horizons
// mistake: leaves B^T P B out.
// <solution gainsOverTime>
// in place of: *k = -solveMatrix(costs.R + M, Bt * PA);
*k = -solveMatrix(costs.R, Bt* PA);

// <variant zero_hanging> caught by: energy, other-pendulums
// mistake: the energy is zero hanging.
// <solution energyOf>
// in place of: const double speed = pendulum.length * x[1], height = pendulum.length * (std::cos(x[0]) - 1);
const double speed = pendulum.length * x[1], height = pendulum.length * (std::cos(x[0]) + 1);

// <variant upside_down> caught by: energy, other-pendulums
// mistake: takes the angle for that from hanging.
// <solution energyOf>
// in place of: const double speed = pendulum.length * x[1], height = pendulum.length * (std::cos(x[0]) - 1);
const double speed = pendulum.length * x[1], height = pendulum.length * (1 - std::cos(x[0]));

// <variant rate_is_speed> caught by: energy, other-pendulums
// mistake: takes the rate for the speed of the mass.
// <solution energyOf>
// in place of: const double speed = pendulum.length * x[1],
const double speed = x[1], height = pendulum.length * (std::cos(x[0]) - 1);

// <variant not_halved> caught by: energy, other-pendulums
// mistake: m v^2.
// <solution energyOf>
// in place of: return pendulum.mass * (speed * speed / 2
return pendulum.mass * (speed * speed + pendulum.g * height);

// <variant mass_forgotten> caught by: energy, other-pendulums
// mistake: the energy of one kilogram.
// <solution energyOf>
// in place of: return pendulum.mass * (speed * speed / 2
return speed * speed / 2 + pendulum.g * height;

// <variant brakes> caught by: pump, other-pendulums, swing
// mistake: the sign is that of a brake.
// <solution pumpTorque>
// in place of: const double wanted = (pendulum.friction
const double wanted = (pendulum.friction + gain * energyOf(pendulum, x)) * x[1];

// <variant friction_forgotten> caught by: pump, other-pendulums
// mistake: leaves friction out.
// <solution pumpTorque>
// in place of: const double wanted = (pendulum.friction
const double wanted = -gain * energyOf(pendulum, x) * x[1];

// <variant friction_twice> caught by: pump, other-pendulums
// mistake: friction with the sign that it has in the equation of motion.
// <solution pumpTorque>
// in place of: const double wanted = (pendulum.friction
const double wanted = -(pendulum.friction + gain * energyOf(pendulum, x)) * x[1];

// <variant any_torque> caught by: pump, other-pendulums
// mistake: does not limit the torque.
// <solution pumpTorque>
// in place of: return std::clamp(wanted, -pendulum.strongest, pendulum.strongest);
return wanted;

// <variant rate_squared> caught by: pump, other-pendulums
// mistake: copies theta'^2 from the equation.
// <solution pumpTorque>
// in place of: const double wanted = (pendulum.friction
const double wanted = pendulum.friction * x[1] - gain * energyOf(pendulum, x) * x[1] * x[1];

// <variant full_strength> caught by: pump, other-pendulums
// mistake: always as strong as the motor is.
// <solution pumpTorque>
// in place of: return std::clamp(wanted, -pendulum.strongest, pendulum.strongest);
return wanted > 0 ? pendulum.strongest : -pendulum.strongest;

// <variant ends_of_the_axes> caught by: lyapunov
// mistake: Of each axis only its end is tested.
// <solution counterexample>
const Eigen::Index n = high.size();
const auto disproves = [&](const Eigen::VectorXd& x) { return x.dot(P * x) <= 0 || x.dot(P * f(x)) >= 0; };
for (Eigen::Index i = 0; i < n; ++i) {
  const Eigen::VectorXd x = high[i] * Eigen::VectorXd::Unit(n, i);
  if (disproves(x)) return x;
}
for (int k = 0; k < 10000; ++k) {
  const Eigen::VectorXd x = rng.uniformVector(static_cast<int>(n), -1, 1).cwiseProduct(high);
  if (disproves(x)) return x;
}
return {};

// <variant no_look_at_the_axes> caught by: lyapunov
// mistake: tries random points only, and takes V' = 0 for falling.
// <solution counterexample>
for (int k = 0; k < 10000; ++k) {
  const Eigen::VectorXd x = high.cwiseProduct(rng.uniformVector(static_cast<int>(high.size()), -1, 1));
  if (x.dot(P * x) <= 0 || x.dot(P * f(x)) > 0) return x;
}
return {};

// <variant only_the_slope> caught by: lyapunov
// mistake: does not check that V is positive.
// <solution counterexample>
const auto n = static_cast<int>(high.size());
for (int k = 0; k < 10000; ++k) {
  Eigen::VectorXd x = high.cwiseProduct(rng.uniformVector(n, -1, 1));
  if (k < n) x = high[k] * Eigen::VectorXd::Unit(n, k);
  if (x.dot(P * f(x)) >= 0) return x;
}
return {};

// <variant two_points_only> caught by: lyapunov, judges-others
// mistake: looks at one point of the first axis and at one corner of the box.
// <solution counterexample>
Eigen::VectorXd x = Eigen::VectorXd::Zero(high.size());
x[0] = high[0];
for (int i = 0; i < 2; ++i, x = high)
  if (x.dot(P * x) <= 0 || x.dot(P * f(x)) >= 0) return x;
return {};

// <variant level_along_the_axes> caught by: lyapunov, judges-others
// mistake: the level where the ellipsoid leaves the box along an axis. It leaves earlier elsewhere.
// <solution levelInside>
return (P.diagonal().array() * high.array().square()).minCoeff();

// <variant v_is_the_norm> caught by: lyapunov, judges-others
// mistake: tests whether the distance grows, whatever P.
// <solution counterexample>
// in place of: return x.dot(Px) <= 0 || Px.dot(f(x)) >= 0;
return x.dot(Px) <= 0 || x.dot(f(x)) >= 0;

// <variant finds_where_it_falls> caught by: lyapunov, judges-others
// mistake: returns a point at which V falls.
// <solution counterexample>
// in place of: return x.dot(Px) <= 0 || Px.dot(f(x)) >= 0;
return x.dot(Px) <= 0 || Px.dot(f(x)) <= 0;

// <variant reach_multiplied> caught by: lyapunov, judges-others
// mistake: multiplies where it should divide.
// <solution levelInside>
// in place of: for (Eigen::Index i = 0; i < high.size(); ++i) level
for (Eigen::Index i = 0; i < high.size(); ++i) level = std::min(level, high[i] * high[i] * inverseP(i, i));

// <variant box_of_the_diagonal> caught by: lyapunov, judges-others
// mistake: the square root is forgotten.
// <solution levelInside>
// in place of: for (Eigen::Index i = 0; i < high.size(); ++i) level
for (Eigen::Index i = 0; i < high.size(); ++i) level = std::min(level, high[i] / inverseP(i, i));

// <variant box_by_the_largest> caught by: lyapunov, judges-others
// mistake: the level at which the ellipsoid leaves the box on all sides.
// <solution levelInside>
double level = 0;
const Eigen::MatrixXd inverseP = inverse(P);
for (Eigen::Index i = 0; i < high.size(); ++i) level = std::max(level, high[i] * high[i] / inverseP(i, i));
return level;

// <variant four_rays> caught by: level, other-catches
// mistake: looks along the axes alone.
// <solution fallingLevel>
double level = most;
for (int k = 0; k < 4; ++k) {
  Eigen::Vector2d ray(0, 0);
  ray[k / 2] = k % 2 == 0 ? 1 : -1;
  for (double c = most / 1000; c < level; c += most / 1000) {
    const Eigen::Vector2d x = std::sqrt(c / P(k / 2, k / 2)) * ray, slope = P * x;
    if (slope.dot(f(x)) >= 0) level = c;
  }
}
return level;

// <variant coarse_steps> caught by: level, other-catches
// mistake: looks at ten places of each ray.
// <solution fallingLevel>
// in place of: constexpr int kRays
constexpr int kRays = 400, kPlaces = 10;

// <variant level_is_a_length> caught by: level, other-catches
// mistake: returns the root of the level.
// <solution fallingLevel>
// in place of: return .99 * level;
return std::sqrt(level);

// <variant best_ray> caught by: level, other-catches
// mistake: takes the ray along which V falls longest.
// <solution fallingLevel>
// in place of: double level = most;
double level = most, largest = 0;
// in place of: level = c;
largest = std::max(largest, c);
// in place of: return .99 * level;
return largest;

// <variant all_of_it> caught by: level, other-catches
// mistake: takes points at which V rises for points at which it falls.
// <solution fallingLevel>
// in place of: if (up.dot(f(std::sqrt(c) * ray)) < 0) continue;
if (up.dot(f(std::sqrt(c) * ray)) > 0) continue;

// <variant level_at_the_border> caught by: level, other-catches
// mistake: tests V' only on the largest ellipse, and halves it.
// <solution fallingLevel>
// in place of: const double c = level * i / kPlaces;
const double c = level;
// in place of: level = c;
level = c / 2;

// <variant only_pumps> caught by: swing
// shown by: swing
// mistake: forgets the catch.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
if (x.dot(Px) < 0) u = 0;

// <variant only_catches> caught by: swing
// mistake: u = K x from the start.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
u = std::clamp(swing.K.dot(x), -pendulum.strongest, pendulum.strongest);

// <variant catch_sign> caught by: swing
// mistake: u = -K x.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
if (x.dot(Px) < swing.level) u = std::clamp(-swing.K.dot(x), -pendulum.strongest, pendulum.strongest);

// <variant turns_counted> caught by: swing
// mistake: does not bring the angle back to -pi ... pi.
// <solution swungUp>
// in place of: const Eigen::Vector2d x(std::remainder(now[0]
const Eigen::Vector2d x = now, Px = swing.P * x;

// <variant states_wrapped> caught by: swing
// mistake: takes whole turns from the states.
// <solution swungUp>
// in place of: states.col(step + 1) = nextOf(pendulum, now, u, swing.tau);
states.col(step + 1) = nextOf(pendulum, x, u, swing.tau);

// <variant strong_catch> caught by: swing
// mistake: does not limit the torque of the catch.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
if (x.dot(Px) < swing.level) u = swing.K.dot(x);

// <variant level_above> caught by: swing
// mistake: catches above the level.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
if (x.dot(Px) > swing.level) u = std::clamp(swing.K.dot(x), -pendulum.strongest, pendulum.strongest);

// <variant catches_by_the_angle> caught by: swing
// mistake: catches wherever the rod is nearly upright, however fast.
// <solution swungUp>
// in place of: if (x.dot(Px) < swing.level) u
if (std::abs(x[0]) < .5) u = std::clamp(swing.K.dot(x), -pendulum.strongest, pendulum.strongest);

// <variant eulers_steps> caught by: swing
// mistake: makes steps of Euler.
// <solution swungUp>
// in place of: states.col(step + 1) = nextOf(pendulum, now, u, swing.tau);
states.col(step + 1) = now + swing.tau * rateOf(pendulum, now, u);

// <variant last_state_missing> caught by: swing
// mistake: returns one state too few.
// <solution swungUp>
// in place of: return states;
return states.leftCols(steps);

// <variant effort_only> caught by: slope, other-plans
// mistake: forgets that a torque moves what follows.
// <solution costSlope>
// in place of: slope[t] = 2 * journey.tau
slope[t] = 2 * journey.tau * journey.effort * U[t];

// <variant effort_forgotten> caught by: slope, other-plans
// mistake: forgets what a torque costs by itself.
// <solution costSlope>
// in place of: slope[t] = 2 * journey.tau
slope[t] = step.B.col(0).dot(worth);

// <variant last_forgotten> caught by: slope, other-plans
// mistake: begins with zero after the last step.
// <solution costSlope>
// in place of: worth = journey.last * ofCost;
worth.setZero();

// <variant last_alone> caught by: slope, other-plans
// mistake: the states on the way cost nothing.
// <solution costSlope>
// in place of: worth = journey.tau * ofCost + through;
worth = through;

// <variant a_not_transposed> caught by: slope, other-plans
// mistake: multiplies by A, not by its transpose.
// <solution costSlope>
// in place of: const Eigen::Vector2d through = step.A.transpose() * worth;
const Eigen::Vector2d through = step.A * worth;

// <variant one_step_late> caught by: slope, other-plans
// mistake: uses what the state before the step is worth.
// <solution costSlope>
// in place of: slope[t] = 2 * journey.tau ... worth = journey.tau * ofCost + through;
const Eigen::Vector2d through = step.A.transpose() * worth;
worth = journey.tau * ofCost + through;
slope[t] = 2 * journey.tau * journey.effort * U[t] + step.B.col(0).dot(worth);

// <variant one_step_downhill> caught by: plan, other-plans
// mistake: a single step along the slope.
// <solution planned>
best = U - .1 * costSlope(journey, U);

// <variant ends_early> caught by: plan, other-plans
// mistake: ends after three changes.
// <solution planned>
// in place of: const Eigen::MatrixXd X = statesOf(journey, best);
if (k == 3) break;
const Eigen::MatrixXd X = statesOf(journey, best);

// <variant goes_uphill> caught by: plan, other-plans
// mistake: follows the slope uphill.
// <solution planned>
for (int k = 0; k < 100; ++k) best += .01 * costSlope(journey, best);

// <variant few_small_steps> caught by: plan, other-plans
// mistake: a thousand small steps along the slope, which are too few.
// <solution planned>
for (int k = 0; k < 1000; ++k) best -= .001 * costSlope(journey, best);
