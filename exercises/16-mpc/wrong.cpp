// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant acts_on_the_past> caught by: predict, more-predictions
// mistake: rows and columns of the blocks are mixed up.
// ask: Do controls act on states before them? u_t acts from x_{t+1} on.
// <solution predicted>
Eigen::MatrixXd power = Eigen::MatrixXd::Identity(n, n);
for (int age = 0; age < N; ++age, power = (plant.A * power).eval()) {
  p.Sx.middleRows(age * n, n) = plant.A * power;
  for (int t = 0; t + age < N; ++t) p.Su.block(t * n, (t + age) * m, n, m) = power * plant.B;
}

// <variant acts_once> caught by: predict, more-predictions
// mistake: a control acts on the next state only.
// ask: Does a control act on the next state only? It acts on all later ones.
// <solution predicted>
Eigen::MatrixXd power = plant.A;
for (int t = 0; t < N; ++t, power = (power * plant.A).eval()) {
  p.Sx.middleRows(t * n, n) = power;
  p.Su.block(t * n, t * m, n, m) = plant.B;
}

// <variant one_step_late> caught by: predict, more-predictions
// mistake: the effect of a control is one power of A too high.
// ask: Is there one A too many? x_{t+1} contains B u_t.
// <solution predicted>
Eigen::MatrixXd power = plant.A;
for (int age = 0; age < N; ++age, power = (plant.A * power).eval()) {
  p.Sx.middleRows(age * n, n) = power;
  for (int k = 0; k + age < N; ++k) p.Su.block((k + age) * n, k * m, n, m) = power * plant.B;
}

// <variant all_like_the_first> caught by: predict, more-predictions
// mistake: a later control acts as long as the first one.
// ask: Does each control act like u_0? It acts for fewer steps.
// <solution predicted>
// in place of: p.Su.block(t * n, t * m, n, m) = plant.B;
for (int k = 1; k <= t; ++k) p.Su.block(t* n, k* m, n, m) = p.Su.block(t * n, 0, n, m).eval();

// <variant sx_begins_with_x0> caught by: predict, more-predictions
// shown by: predict
// mistake: the first rows are those of x_0.
// ask: Does Sx begin with x_0? It begins with x_1.
// <solution predicted>
// in place of: p.Sx.topRows(n) = plant.A;
p.Sx.topRows(n) = Eigen::MatrixXd::Identity(n, n);

// <variant free_controls> caught by: plan-cost, more-costs
// mistake: controls cost nothing.
// ask: Are controls for free? R belongs to H.
// <solution planCost>
const Eigen::Index n = plant.A.rows();
const Prediction p = predicted(plant, N);
Eigen::MatrixXd weighted = p.Su;
for (int t = 0; t < N; ++t)
  weighted.middleRows(t* n, n) = (t + 1 < N ? costs.Q : costs.F) * p.Su.middleRows(t * n, n);
return {2 * p.Su.transpose() * weighted, 2 * weighted.transpose() * (p.Sx * x)};

// <variant half_the_cost> caught by: plan-cost, more-costs
// mistake: forgets that the quadratic form has a factor of one half.
// ask: Is there a factor of 2 missing? The cost is 1/2 U^T H U + g^T U.
// <solution planCost>
// in place of: weighted.middleRows(t * n, n) = (t + 1 < N ? costs.Q : ... for (int t = 0; t < N; ++t)
weighted.middleRows(t* n, n) = (t + 1 < N ? costs.Q : costs.F) * p.Su.middleRows(t * n, n);
Quadratic cost{p.Su.transpose() * weighted, weighted.transpose() * (p.Sx * x)};
for (int t = 0; t < N; ++t) cost.H.block(t* m, t* m, m, m) += costs.R;

// <variant no_end> caught by: plan-cost, more-costs
// shown by: plan-cost
// mistake: weighs the last state like all others.
// ask: Is the last state weighted by Q? It is weighted by F.
// <solution planCost>
const Eigen::Index n = plant.A.rows(), m = plant.B.cols();
const Prediction p = predicted(plant, N);
Eigen::MatrixXd weighted = p.Su;
for (int t = 0; t < N; ++t) weighted.middleRows(t* n, n) = costs.Q * p.Su.middleRows(t * n, n);
Quadratic cost{2 * p.Su.transpose() * weighted, 2 * weighted.transpose() * (p.Sx * x)};
for (int t = 0; t < N; ++t) cost.H.block(t* m, t* m, m, m) += 2 * costs.R;
return cost;

// <variant all_weighted_like_the_end> caught by: plan-cost, more-costs
// mistake: weighs all states like the last one.
// ask: Are all states weighted by F? Only the last one is.
// <solution planCost>
// in place of: weighted.middleRows(t * n, n) =
weighted.middleRows(t* n, n) = costs.F * p.Su.middleRows(t * n, n);

// <variant end_for_free> caught by: plan-cost, more-costs
// mistake: the last state costs nothing.
// ask: Does the last state cost nothing?
// <solution planCost>
// in place of: weighted.middleRows(t * n, n) =
weighted.middleRows(t* n, n) = (t + 1 < N ? 1. : 0.) * costs.Q * p.Su.middleRows(t * n, n);

// <variant control_forgotten_in_the_end> caught by: cost-to-go, more-to-go
// mistake: adds up what states cost under the best controller, and not its controls.
// ask: Are controls for free? They belong to the cost of all times, too.
// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
Eigen::MatrixXd F = Q, states = Q;
for (int k = 0; k < 2000; ++k) {
  const Eigen::MatrixXd FB = F * B, gain = solve(R + B.transpose() * FB, FB.transpose() * A);
  const Eigen::MatrixXd closed = A - B * gain;
  const Eigen::MatrixXd before = Q + A.transpose() * F * closed;
  F = .5 * (before + before.transpose());
  states = (Q + closed.transpose() * states * closed).eval();
}
return states;

// <variant five_steps_to_go> caught by: cost-to-go, more-to-go
// mistake: takes five steps for all times to come.
// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
Eigen::MatrixXd F = Q;
for (int k = 0; k < 5; ++k) {
  const Eigen::MatrixXd FB = F * B, gain = solve(R + B.transpose() * FB, FB.transpose() * A);
  F = Q + A.transpose() * F * (A - B * gain);
}
return F;

// <variant one_step_to_go> caught by: cost-to-go, more-to-go
// shown by: cost-to-go
// mistake: looks one step ahead only.
// ask: Is it the cost of a single step more? All later ones cost, too.
// <solution costToGo>
const auto &A = plant.A, &B = plant.B;
const Eigen::MatrixXd gain = solve(R + B.transpose() * Q * B, B.transpose() * Q * A);
return Q + A.transpose() * Q * (A - B * gain);

// <variant state_costs_to_go> caught by: cost-to-go, more-to-go
// mistake: takes what one state costs.
// ask: Is it Q? Q says what one state costs, F what all of them cost together.
// <solution costToGo>
return Q;

// <variant without_the_present> caught by: cost-to-go, more-to-go
// mistake: leaves out what the present state costs.
// ask: Does the cost begin one step later?
// <solution costToGo>
// in place of: return F;
return F - Q;

// <variant all_move_together> caught by: moves
// mistake: a Newton step of all numbers, cut off.
// ask: Do all numbers move together? Each moves alone, the others stay.
// <solution bestMoves>
const Eigen::VectorXd slope = cost.H * z + cost.g;
const Eigen::VectorXd best = z - solve(cost.H, slope);
return best.cwiseMax(lower).cwiseMin(upper) - z;

// <variant moves_without_bounds> caught by: moves
// shown by: moves
// mistake: forgets the bounds.
// ask: Are the bounds forgotten?
// <solution bestMoves>
return -Eigen::VectorXd(cost.H * z + cost.g).cwiseQuotient(cost.H.diagonal());

// <variant position_for_a_move> caught by: moves
// mistake: returns where the numbers would go.
// ask: Are these the best positions? Wanted is by how much z_i moves.
// <solution bestMoves>
const Eigen::VectorXd slope = cost.H * z + cost.g;
const Eigen::VectorXd best = z - slope.cwiseQuotient(cost.H.diagonal());
return best.cwiseMax(lower).cwiseMin(upper);

// <variant slope_for_a_move> caught by: moves
// mistake: takes the slope for the move.
// ask: Is the slope taken for the way? A steep parabola has a near minimum.
// <solution bestMoves>
const Eigen::VectorXd best = z - (cost.H * z + cost.g);
return best.cwiseMax(lower).cwiseMin(upper) - z;

// <variant moves_between_the_bounds> caught by: moves
// mistake: takes the bounds of a position for those of a move.
// ask: Is the move cut off by the bounds? They hold for the position after it.
// <solution bestMoves>
const Eigen::VectorXd slope = cost.H * z + cost.g;
return (-slope.cwiseQuotient(cost.H.diagonal())).cwiseMax(lower).cwiseMin(upper);

// <variant all_at_once> caught by: box
// mistake: corrects the guess of what is held everywhere at once, and gives up in the end.
// <solution boxed>
const int size = static_cast<int>(lower.size());
Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
std::vector<int> held(static_cast<std::size_t>(size), 0);  // -1 at the lower bound, 1 at the upper one
for (int round = 0; round < 200; ++round) {
  Eigen::MatrixXd rows = cost.H;
  Eigen::VectorXd right = -cost.g;
  for (int i = 0; i < size; ++i) {
    const int side = held[static_cast<std::size_t>(i)];
    if (side == 0) continue;
    rows.row(i) = Eigen::RowVectorXd::Unit(size, i);
    right[i] = side < 0 ? lower[i] : upper[i];
  }
  z = solve(rows, right);
  const Eigen::VectorXd slope = cost.H * z + cost.g;
  bool isSame = true;
  for (int i = 0; i < size; ++i) {
    int& side = held[static_cast<std::size_t>(i)];
    const int before = side;
    if (side == 0)
      side = z[i] < lower[i] ? -1 : z[i] > upper[i] ? 1 : 0;
    else if (side * slope[i] > 0)
      side = 0;
    isSame = isSame && side == before;
  }
  if (isSame) break;
}
return z.cwiseMax(lower).cwiseMin(upper);

// <variant cut_off> caught by: box, more-boxes, plan, more-plans
// shown by: box, plan
// mistake: cuts off the minimum without bounds.
// <solution boxed>
return Eigen::VectorXd(-solve(cost.H, cost.g)).cwiseMax(lower).cwiseMin(upper);

// <variant few_rounds> caught by: more-boxes
// mistake: moves each number in turn, but only a hundred times.
// <solution boxed>
Eigen::VectorXd z = Eigen::VectorXd::Zero(lower.size()).cwiseMax(lower).cwiseMin(upper);
for (int round = 0; round < 100; ++round)
  for (Eigen::Index i = 0; i < z.size(); ++i)
    z[i] = std::clamp(z[i] - (cost.H.row(i).dot(z) + cost.g[i]) / cost.H(i, i), lower[i], upper[i]);
return z;

// <variant never_lets_go> caught by: box, more-boxes
// mistake: a number that was held once is held for ever.
// <solution boxed>
const int size = static_cast<int>(lower.size());
Eigen::VectorXd z = Eigen::VectorXd::Zero(size);
std::vector<bool> isHeld(static_cast<std::size_t>(size), false);
for (;;) {
  std::vector<int> free, held;
  for (int i = 0; i < size; ++i) (isHeld[static_cast<std::size_t>(i)] ? held : free).push_back(i);
  if (free.empty()) return z;
  Eigen::VectorXd right = -cost.g(free);
  if (!held.empty()) right -= cost.H(free, held) * z(held);
  z(free) = solve(cost.H(free, free), right);
  bool isInside = true;
  for (const int i : free) {
    if (z[i] >= lower[i] && z[i] <= upper[i]) continue;
    z[i] = std::clamp(z[i], lower[i], upper[i]);
    isHeld[static_cast<std::size_t>(i)] = true;
    isInside = false;
  }
  if (isInside) return z;
}

// <variant bounds_of_the_first_step> caught by: plan, more-plans
// mistake: only the first control has bounds.
// <solution planned>
const Eigen::Index m = task.uMin.size();
Eigen::VectorXd lower = Eigen::VectorXd::Constant(m * task.N, -1e6), upper = -lower;
lower.head(m) = task.uMin;
upper.head(m) = task.uMax;
return boxed(planCost(task.plant, task.costs, task.N, x), lower, upper).reshaped(m, task.N);

// <variant calls_the_library> caught by: forbidden-call
// mistake: lets the library plan.
// <solution headers>
#include "control/predictive_controller.h"
// <solution planned>
const PredictiveController controller({.A = task.plant.A, .B = task.plant.B, .step = 1.},
                                      {.Q = task.costs.Q,
                                       .R = task.costs.R,
                                       .F = task.costs.F,
                                       .horizon = task.N,
                                       .uMin = task.uMin,
                                       .uMax = task.uMax});
return controller.plan(x).U;

// <variant read_row_by_row> caught by: plan, more-plans
// mistake: takes the first N numbers for the first control.
// <solution planned>
const Eigen::VectorXd U = boxed(planCost(task.plant, task.costs, task.N, x), task.uMin.replicate(task.N, 1),
                                task.uMax.replicate(task.N, 1));
return U.reshaped(task.N, task.uMin.size()).transpose();

// <variant follows_plans_to_their_end> caught by: drive, more-drives
// mistake: plans again only when a plan is used up.
// <solution driven>
Eigen::MatrixXd plan;
for (Eigen::Index t = 0; t < T; ++t) {
  if (t % task.N == 0) plan = planned(task, drive.X.col(t));
  drive.U.col(t) = plan.col(t % task.N);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
}

// <variant follows_the_first_plan> caught by: drive, more-drives
// shown by: drive
// mistake: plans once, and follows this plan to its end.
// <solution driven>
const Eigen::MatrixXd plan = planned(task, start);
for (Eigen::Index t = 0; t < T; ++t) {
  if (t < task.N) drive.U.col(t) = plan.col(t);
  drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) + pushes.col(t);
}

// <variant last_of_the_plan> caught by: drive, more-drives
// mistake: uses the last control of each plan.
// <solution driven>
// in place of: drive.U.col(t) = planned(task, drive.X.col(t)).col(0);
drive.U.col(t) = planned(task, drive.X.col(t)).rightCols(1);

// <variant nobody_pushes> caught by: drive, more-drives
// mistake: leaves out the pushes.
// <solution driven>
// in place of: drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t) +
drive.X.col(t + 1) = task.plant.A * drive.X.col(t) + task.plant.B * drive.U.col(t);

// <variant distance_for_a_rate> caught by: rate-bounds, rates, line, more-hands
// mistake: lets a joint cover the distance to its limit in a second, not in a step.
// ask: Is the distance to a limit taken for a rate? It must not be covered before the step ends.
// <solution rateBounds>
const Eigen::VectorXd &most = limits.rateMax, least = -most;
return {(limits.qMin - q).cwiseMax(least).cwiseMin(most), (limits.qMax - q).cwiseMax(least).cwiseMin(most)};

// <variant distance_times_tau> caught by: rate-bounds, rates, line, more-hands
// mistake: multiplies by the time instead of dividing by it.
// ask: Is the distance to a limit multiplied by tau? A rate is a distance divided by a time.
// <solution rateBounds>
const Eigen::VectorXd &most = limits.rateMax, least = -most;
return {((limits.qMin - q) * tau).cwiseMax(least).cwiseMin(most),
        ((limits.qMax - q) * tau).cwiseMax(least).cwiseMin(most)};

// <variant limit_for_a_distance> caught by: rate-bounds, rates, line, more-hands
// mistake: leaves out where the joints are.
// ask: Are the limits of q forgotten, or where q is? Only what is left up to the limit counts.
// <solution rateBounds>
const Eigen::VectorXd &most = limits.rateMax, least = -most;
return {(limits.qMin / tau).cwiseMax(least).cwiseMin(most),
        (limits.qMax / tau).cwiseMax(least).cwiseMin(most)};

// <variant any_speed> caught by: rate-bounds, more-hands
// mistake: forgets how fast joints may turn.
// ask: Are the limits of speed forgotten?
// <solution rateBounds>
return {(limits.qMin - q) / tau, (limits.qMax - q) / tau};

// <variant only_speeds> caught by: rate-bounds, rates, line, more-hands
// mistake: forgets that joints have limits.
// ask: Are the limits of q forgotten, or where q is? Only what is left up to the limit counts.
// <solution rateBounds>
return {-limits.rateMax, limits.rateMax};

// <variant returns_at_once> caught by: rate-bounds, more-hands
// mistake: bounds cross if a joint is too far beyond its limit.
// ask: Is a joint beyond its limit asked to return faster than it may?
// <solution rateBounds>
return {((limits.qMin - q) / tau).cwiseMax(-limits.rateMax),
        ((limits.qMax - q) / tau).cwiseMin(limits.rateMax)};

// <variant stays_outside> caught by: rate-bounds, rates, more-hands
// mistake: a joint beyond its limit need not return.
// ask: May a joint beyond its limit stay where it is? It must return.
// <solution rateBounds>
const Eigen::VectorXd none = Eigen::VectorXd::Zero(q.size());
return {((limits.qMin - q) / tau).cwiseMax(-limits.rateMax).cwiseMin(none),
        ((limits.qMax - q) / tau).cwiseMin(limits.rateMax).cwiseMax(none)};

// <variant against_the_hand> caught by: rates, line, more-hands
// mistake: the wrong sign between rates and speed.
// ask: Is it J w + s v? The hand shall move at s v.
// <solution rateCost>
// in place of: rows << task.J, -task.v;
rows << task.J, task.v;

// <variant half_the_rates> caught by: rates, more-hands
// mistake: forgets that the quadratic form has a factor of one half.
// ask: Is there a factor of 2 missing? The cost is 1/2 z^T H z + g^T z.
// <solution rateCost>
// in place of: cost.H = 2 * rows.transpose() * task.W * rows; ... cost.g[n]
cost.H = rows.transpose() * task.W * rows;
cost.H.diagonal().head(n).array() += task.damping;
cost.H(n, n) += task.slowness;
cost.g[n] = -task.slowness;

// <variant half_the_slope> caught by: rates, more-hands
// mistake: forgets the factor in g.
// ask: Is there a factor of 2 missing? The cost is 1/2 z^T H z + g^T z.
// <solution rateCost>
// in place of: cost.g[n] = -2 * task.slowness;
cost.g[n] = -task.slowness;

// <variant rates_for_free> caught by: rates, more-hands
// mistake: leaves out the damping.
// ask: Are rates for free? The damping belongs to H.
// <solution rateCost>
// in place of: cost.H.diagonal().head(n).array() += 2 * task.damping;

// <variant damping_squared> caught by: rates, more-hands
// mistake: squares the damping.
// ask: Is the damping squared?
// <solution rateCost>
// in place of: cost.H.diagonal().head(n).array() += 2 * task.damping;
cost.H.diagonal().head(n).array() += 2 * task.damping * task.damping;

// <variant slowness_not_in_h> caught by: rates, more-hands
// mistake: expands (1 - s)^2 without s^2.
// ask: Is slowness s^2 missing in H?
// <solution rateCost>
// in place of: cost.H(n, n) += 2 * task.slowness;

// <variant share_damped> caught by: rates, more-hands
// mistake: damps all numbers of z.
// ask: Is the share damped, too?
// <solution rateCost>
// in place of: cost.H.diagonal().head(n).array() += 2 * task.damping;
cost.H.diagonal().array() += 2 * task.damping;

// <variant unweighted> caught by: rates, more-hands
// mistake: leaves out W.
// ask: Is W left out?
// <solution rateCost>
// in place of: cost.H = 2 * rows.transpose() * task.W * rows;
cost.H = 2 * rows.transpose() * rows;

// <variant all_slower> caught by: rates, line, more-hands
// mistake: makes all rates smaller until the last one is within its bounds.
// <solution limitedRates>
const Quadratic cost = rateCost(task);
const RateBounds rates = rateBounds(limits, q, tau);
const Eigen::VectorXd z = -solve(cost.H, cost.g);
double factor = 1;
for (Eigen::Index i = 0; i < q.size(); ++i)
  factor = std::min(factor, std::max(0., (z[i] > 0 ? rates.upper : rates.lower)[i] / z[i]));
return factor * z;

// <variant never_slower> caught by: rates, line, more-hands
// mistake: insists on the full speed.
// <solution limitedRates>
// in place of: lower << rates.lower, 0;
lower << rates.lower, 1;

// <variant pseudo_inverse> caught by: rates, line, more-hands
// shown by: line
// mistake: cuts off the rates of the damped pseudo-inverse.
// <solution limitedRates>
const RateBounds rates = rateBounds(limits, q, tau);
const Eigen::MatrixXd damped = task.J * task.J.transpose() + task.damping * inverse(task.W);
const Eigen::VectorXd w = task.J.transpose() * solve(damped, task.v);
Eigen::VectorXd z(q.size() + 1);
z << w.cwiseMax(rates.lower).cwiseMin(rates.upper), 1;
return z;

// <variant share_without_bounds> caught by: rates
// mistake: takes for granted that the share is between 0 and 1.
// <solution limitedRates>
// in place of: lower << rates.lower, 0;
// in place of: upper << rates.upper, 1;
lower << rates.lower, -1e3;
upper << rates.upper, 1e3;

// <variant always_along_the_line> caught by: line, more-hands
// mistake: does not look where the hand is.
// <solution traced>
// in place of: const Eigen::VectorXd v = (start + next * (goal - start) - hand.p) / tau;
const Eigen::VectorXd v = (next - r) * (goal - start) / tau;

// <variant by_the_clock> caught by: line, more-hands
// mistake: the next point of the line does not wait for the hand.
// <solution traced>
// in place of: r += z[joints] * (next - r);
r = next;

// <variant jacobian_of_the_start> caught by: line, more-hands
// mistake: never computes the Jacobian again.
// <solution traced>
// in place of: const HandTask task{.J = hand.J, .v = v, .W = Eigen::MatrixXd::Identity(v.size(), v.size())};
const HandTask task{.J = arm(q).J, .v = v, .W = Eigen::MatrixXd::Identity(v.size(), v.size())};

// <variant half_the_wall> caught by: wall, more-walls
// shown by: wall
// mistake: forgets the factor of one half in the quadratic form.
// <solution plannedWithin>
// in place of: const double w = 2 * corridor.weight;
// in place of: Quadratic cost{Eigen::MatrixXd::Identity(controls + states, ... cost.g << plain.g + w *
const Eigen::MatrixXd cross = -corridor.weight * p.Su;
Quadratic both{Eigen::MatrixXd::Zero(controls + states, controls + states),
               Eigen::VectorXd(controls + states)};
both.H << plain.H - cross.transpose() * p.Su,
    cross.transpose(), cross, corridor.weight* Eigen::MatrixXd::Identity(states, states);
both.g << plain.g - cross.transpose() * drift, -corridor.weight* drift;
// in place of: return boxed(cost, lower, upper).head(controls).reshaped(task.uMin.size(), task.N);
return boxed(both, lower, upper).head(controls).reshaped(task.uMin.size(), task.N);

// <variant no_wall> caught by: wall, more-walls
// mistake: plans as if there were no corridor.
// <solution plannedWithin>
return planned(task, x);

// <variant only_the_upper_wall> caught by: wall, more-walls
// mistake: only states above the corridor cost.
// <solution plannedWithin>
const Prediction p = predicted(task.plant, task.N);
const Eigen::VectorXd most = corridor.xMax.replicate(task.N, 1);
Quadratic cost = planCost(task.plant, task.costs, task.N, x);
const Quadratic plain = cost;
const Eigen::VectorXd lower = task.uMin.replicate(task.N, 1), upper = task.uMax.replicate(task.N, 1);
Eigen::VectorXd U = boxed(plain, lower, upper);
for (int round = 0; round < 50; ++round) {
  const Eigen::VectorXd X = p.Sx * x + p.Su * U;
  cost = plain;
  for (Eigen::Index i = 0; i < X.size(); ++i) {
    if (X[i] <= most[i]) continue;
    const Eigen::VectorXd row = p.Su.row(i);
    cost.H += 2 * corridor.weight * row * row.transpose();
    cost.g += 2 * corridor.weight * ((p.Sx.row(i) * x)(0) - most[i]) * row;
  }
  U = boxed(cost, lower, upper);
}
return U.reshaped(task.uMin.size(), task.N);
