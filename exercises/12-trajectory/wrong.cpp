// Mistakes that students make, and the checks that catch them: a variant is solution.cpp with other regions.
// `rex dev check` reads this file; it does not compile as it is.

// <variant calls_the_library> caught by: forbidden-call
// mistake: uses the library's terms.
// <solution headers>
#include "trajectory/motion_terms.h"
// <solution differenceTerm>
const std::vector<TrajectoryTerm> terms{velocityTerm(), accelerationTerm(), jerkTerm()};
FunctionValue value;
terms[static_cast<std::size_t>(window.cols()) - 2].function({.t = 0, .tau = tau, .X = window}, value);
return {value.y, value.J};

// <variant time_step_forgotten> caught by: difference-terms, cost-of-powers, any-path
// mistake: differences as they stand on 5:4, whatever the time between two configurations.
// ask: Is tau missing?
// <solution differenceTerm>
// in place of: return taskDifference(identity, tau);
return taskDifference(identity, 1);
// <solution taskDifference>
// in place of: const double scale = std::sqrt(tau) / std::pow(tau, static_cast<double>(phi.size()) - 1);
const double scale = 1;

// <variant prefix_forgotten> caught by: cost-of-powers, any-path
// mistake: the first cost is at the first step that has k others before it in X.
// ask: Are the windows left out that reach into the prefix?
// <solution motionCost>
double cost = 0;
for (Eigen::Index t = k; t < X.cols(); ++t)
  cost += differenceTerm(X.middleCols(t - k, k + 1), tau).y.squaredNorm();
return cost;

// <variant columns_of_now_first> caught by: difference-terms, task-differences, any-path
// mistake: puts the columns of x_t first.
// ask: Does J begin with the columns of x_t? Those of x_{t-k} come first.
// <solution taskDifference>
// in place of: value.J.middleCols(static_cast<Eigen::Index>(i) * n, n) = scale * weights[i] * phi[i].J;
value.J.middleCols(static_cast<Eigen::Index>(phi.size() - 1 - i) * n, n) = scale * weights[i] * phi[i].J;

// <variant jacobian_of_now_for_all> caught by: task-differences, any-path
// mistake: one Jacobian for all configurations of the window.
// ask: Is the Jacobian at x_t used for the other configurations, too?
// <solution taskDifference>
// in place of: value.J.middleCols(static_cast<Eigen::Index>(i) * n, n) = scale * weights[i] * phi[i].J;
value.J.middleCols(static_cast<Eigen::Index>(i) * n, n) = scale * weights[i] * phi.back().J;

// <variant sum_instead_of_integral> caught by: difference-terms, cost-of-powers, task-differences
// mistake: difference quotients without sqrt(tau): twice as many steps cost twice as much.
// ask: Is the factor sqrt(tau) missing, which makes sums of squares integrals?
// <solution taskDifference>
// in place of: const double scale = std::sqrt(tau) / std::pow(tau, static_cast<double>(phi.size()) - 1);
const double scale = 1 / std::pow(tau, static_cast<double>(phi.size()) - 1);

// <variant columns_by_the_largest_order> caught by: assembled
// mistake: the J of each term begins k configurations back, with the largest order k.
// ask: Does the J of each term begin k configurations back, with the largest order k? That of a term of order
// ask: i begins i back.
// <solution assembled>
// in place of: const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - columns;
const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - rows;

// <variant gradient_without_two> caught by: assembled, unseen-descents
// mistake: combines the gradient of y^T y / 2 with the second derivatives of y^T y: steps are half as long.
// ask: Is the gradient that of y^T y / 2, beside the H of y^T y?
// <solution assembled>
// in place of: system.g[first + a] += 2 * term.J.col(a).dot(term.y);
system.g[first + a] += term.J.col(a).dot(term.y);

// <variant terms_at_the_prefix_dropped> caught by: assembled, unseen-descents, through-points
// mistake: leaves out the terms that reach into the prefix.
// ask: Are the terms left out that reach into the prefix? Only their columns of it do not count.
// <solution assembled>
// in place of: for (Eigen::Index a = std::max<Eigen::Index>(0, -first); a < ... }
if (first < 0) continue;
for (Eigen::Index a = 0; a < columns; ++a) {
  system.g[first + a] += 2 * term.J.col(a).dot(term.y);
  for (Eigen::Index b = a; b < columns; ++b)
    system.band(b - a, first + a) += 2 * term.J.col(a).dot(term.J.col(b));
}

// <variant transposed_jacobian> caught by: assembled, unseen-descents
// mistake: the blocks of H between two configurations are transposed.
// ask: Are the blocks of H between two configurations transposed?
// <solution assembled>
// in place of: const Eigen::Index columns = term.J.cols(), first = n * ... }
const int k = static_cast<int>(term.J.cols()) / n - 1;
for (int p = 0; p <= k; ++p) {
  const int column = n * (term.t - k + p);
  if (column < 0) continue;
  const Eigen::MatrixXd Jp = term.J.middleCols(n * p, n);
  system.g.segment(column, n) += 2 * Jp.transpose() * term.y;
  for (int q = p; q <= k; ++q) {
    const Eigen::MatrixXd block = 2 * Jp.transpose() * term.J.middleCols(n * q, n);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        if (q > p || a >= b) system.band(n * (q - p) + a - b, column + b) += block(a, b);
  }
}

// <variant dense_matrix> caught by: long-band
// mistake: builds the dense matrix of the band, most of it zeros.
// <solution bandCholesky>
const Eigen::Index rows = band.rows(), N = band.cols();
Eigen::MatrixXd A = Eigen::MatrixXd::Zero(N, N);
for (Eigen::Index j = 0; j < N; ++j)
  for (Eigen::Index i = 0; i < rows && j + i < N; ++i) A(j + i, j) = band(i, j);
for (Eigen::Index j = 0; j < N; ++j) {
  if (!(A(j, j) > 0)) return {};
  A.col(j).tail(N - j) /= std::sqrt(A(j, j));
  for (Eigen::Index i = j + 1; i < N; ++i) A.col(i).tail(N - i) -= A(i, j) * A.col(j).tail(N - i);
}
Eigen::MatrixXd L = Eigen::MatrixXd::Zero(rows, N);
for (Eigen::Index j = 0; j < N; ++j)
  for (Eigen::Index i = 0; i < rows && j + i < N; ++i) L(i, j) = A(j + i, j);
return L;

// <variant diagonal_not_rooted> caught by: factored, long-band
// mistake: the factors of L D L^T, and D forgotten.
// ask: Is D forgotten? The diagonal of L is 1 only in L D L^T.
// <solution bandCholesky>
// in place of: if (!(L(0, j) > 0)) return {}; ... L.col(j) /= std::sqrt(L(0, j));
const double d = L(0, j);
if (!(d > 0)) return {};
L.col(j) /= d;
// in place of: L.col(j + i).head(rows - i) -= L(i, j) * L.col(j).tail(rows - i);
L.col(j + i).head(rows - i) -= d * L(i, j) * L.col(j).tail(rows - i);

// <variant one_sweep> caught by: factored
// mistake: solves L y = b, and takes y for x.
// ask: Is the second sweep missing, L^T x = y?
// <solution bandSolve>
// in place of: for (Eigen::Index j = N - 1; j >= 0; --j) { ... }

// <variant full_steps> caught by: descends, unseen-descents
// shown by: descends
// mistake: takes every step in full, whether the cost falls or not.
// <solution descended>
const auto n = static_cast<int>(start.rows()), steps = static_cast<int>(start.cols());
std::vector<Eigen::MatrixXd> path{start};
while (path.size() <= 100) {
  BandSystem system = assembled(terms(path.back()), n, steps);
  if (!(system.g.cwiseAbs().maxCoeff() > tolerance)) break;
  Eigen::MatrixXd L = bandCholesky(system.band);
  if (L.size() == 0) {
    system.band.row(0).array() += 1e-6;
    L = bandCholesky(system.band);
  }
  if (L.size() == 0) break;
  const Eigen::VectorXd step = -bandSolve(L, system.g);
  path.push_back(path.back() + step.reshaped(n, steps));
}
return path;

// <variant gives_up_where_singular> caught by: descends
// mistake: ends where H is singular.
// <solution descended>
// in place of: Eigen::MatrixXd L = bandCholesky(system.band); ... }
const Eigen::MatrixXd L = bandCholesky(system.band);
if (L.size() == 0) break;

// <variant counts_only_if_violated> caught by: as-cost
// mistake: an inequality counts only where it is violated, whatever its multiplier.
// ask: Does an inequality count only where y > 0, whatever its multiplier is?
// <solution asCost>
// in place of: if (rows.y[i] > 0) continue;
if (term.y[i] > 0) continue;

// <variant square_without_half> caught by: as-cost
// mistake: completes the square with m / mu.
// ask: Is it m / mu where m / (2 mu) completes the square?
// <solution asCost>
// in place of: Term rows{Role::cost, term.t, std::sqrt(mu) * (term.y + multipliers / (2 * mu)),
Term rows{Role::cost, term.t, std::sqrt(mu) * (term.y + multipliers / mu), std::sqrt(mu) * term.J};

// <variant inequality_always_counts> caught by: as-cost
// mistake: treats an inequality like an equality.
// ask: Does an inequality also count where its next multiplier is 0?
// <solution asCost>
if (term.role == Role::cost) return term;
return {Role::cost, term.t, std::sqrt(mu) * (term.y + multipliers / (2 * mu)), std::sqrt(mu) * term.J};

// <variant inequalities_pull> caught by: multipliers, known-minima
// mistake: multipliers of inequalities may become negative.
// ask: Does a multiplier of an inequality become negative? Then it would pull.
// <solution nextMultipliers>
return term.role == Role::cost ? multipliers : Eigen::VectorXd(multipliers + 2 * mu * term.y);

// <variant multiplier_sign> caught by: multipliers, known-minima, unseen-minima
// mistake: multipliers go against the violation.
// ask: Is 2 mu y subtracted instead of added?
// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = multipliers - 2 * mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));

// <variant multiplier_without_two> caught by: multipliers, unseen-minima
// mistake: adds mu y where the gradient has 2 mu y, so that multipliers lag behind.
// ask: Is it mu y where the derivative of mu y^2 has 2 mu y?
// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = multipliers + mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));

// <variant multipliers_forgotten> caught by: multipliers
// mistake: begins with zero in each round.
// ask: Are the multipliers of the round before forgotten?
// <solution nextMultipliers>
if (term.role == Role::cost) return multipliers;
const Eigen::VectorXd next = 2 * mu * term.y;
return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));

// <variant penalty_alone> caught by: known-minima, unseen-minima
// shown by: known-minima
// mistake: squared penalties with one mu, and no multipliers: constraints are violated.
// <solution minimised>
Minimum result{start, {}, {}, {}};
for (const Term& term : terms(start))
  result.multipliers.push_back(Eigen::VectorXd::Zero(term.role == Role::cost ? 0 : term.y.size()));
const Terms penalised = [&](const Eigen::MatrixXd& X) {
  std::vector<Term> all = terms(X);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = asCost(all[i], result.multipliers[i], 100 * mu);
  return all;
};
result.X = descended(penalised, start, accuracy.gradient).back();
result.cost = result.violation = {0};
return result;

// <variant rest_forgotten> caught by: through-points, other-points
// mistake: the motion ends at the last point, but not at rest.
// ask: Which constraint keeps the motion at rest at the last point?
// <solution throughPoints>
// in place of: add(Role::equality, when.back(), differenceTerm(X.rightCols(2), 1));

// <variant straight_between_points> caught by: through-points, other-points
// mistake: goes straight from point to point.
// ask: Does the motion lead straight from point to point? Then its velocity jumps at each of them.
// <solution throughPoints>
Eigen::MatrixXd X(start.size(), when.back() + 1);
Eigen::VectorXd from = start;
int before = -1;
for (std::size_t i = 0; i < when.size(); ++i) {
  const Eigen::VectorXd to = points.col(static_cast<Eigen::Index>(i));
  for (int t = before + 1; t <= when[i]; ++t)
    X.col(t) = from + (t - before) / static_cast<double>(when[i] - before) * (to - from);
  from = to;
  before = when[i];
}
return X;

// <variant ends_of_the_way_swapped> caught by: kept-apart
// mistake: the derivatives by both ends of the way are swapped.
// ask: Are the columns of x_{t-1} and x_t exchanged?
// <solution keptApart>
// in place of: for (Eigen::Index k = 0; k < pairs; ++k) all.y[i * pairs + ... all.J.block(i * pairs, n,
all.y.segment(i* pairs, pairs) = (1 - d.y.array() / margin).matrix();
all.J.block(i* pairs, 0, pairs, n) = -s / margin * d.J;
all.J.block(i* pairs, n, pairs, n) = -(1 - s) / margin * d.J;

// <variant one_sample_early> caught by: kept-apart
// mistake: looks at x_{t-1} first, and never at x_t.
// ask: Is the first instant x_{t-1}? It should be one sample later.
// <solution keptApart>
// in place of: const double s = (i + 1.) / samples;
const double s = 1. * i / samples;

// <variant looks_at_steps_only> caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: looks at the configurations only: thin obstacles fit between two of them.
// <solution aroundObstacle>
// in place of: constexpr int kSamples = 8;
constexpr int kSamples = 1;

// <variant takes_the_detour> caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: takes the detour, and optimises nothing.
// ask: Is it the guess that leads through the detour, before anything improves it?
// <solution aroundObstacle>
const Eigen::VectorXd start = S.getJointAngles();
const int last = errand.steps - 1;
Eigen::MatrixXd points(start.size(), 2);
points << errand.detour, errand.goal;
return throughPoints(start, points, {last / 2, last}, errand.tau);

// <variant way_from_elsewhere> caught by: around-the-ball, around-others
// shown by: around-the-ball
// mistake: takes the postures that once led around the ball of the README, wherever the ball is.
// <solution aroundObstacle>
Eigen::MatrixXd points(3, 5);
points.transpose() << 0.5061, 0.3163, 0.3709, -0.0256, 0.4863, 0.6209, -0.5335, 0.5545, 0.7219, -0.7752,
    0.3907, 0.4814, errand.goal.transpose();
return throughPoints(S.getJointAngles(), points, {2, 5, 8, 11, errand.steps - 1}, errand.tau);
