#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "course/clearances.h"
#include "course/film.h"
#include "errands.h"
#include "interface.h"
#include "problems.h"
#include "scenes.h"
#include "trajectory/contact_terms.h"

using namespace rex;
using grading::Check;
using grading::Group;

namespace {

// Part 1.

const std::vector<std::string> kNames{"", "velocity", "acceleration", "jerk"};

std::string described(int n, int k, double tau) {
  return fmt::format("k = {}, n = {}, tau = {:.3g}", k, n, tau);
}

// The weights of x_{t-k}, ..., x_t in y, by repeated differences.
Eigen::VectorXd weightsOf(int k, double tau) {
  Eigen::VectorXd weights = Eigen::VectorXd::Unit(k + 1, k);
  for (int i = 0; i < k; ++i) weights.head(k) -= Eigen::VectorXd(weights.tail(k));
  return weights * std::sqrt(tau) / std::pow(tau, k);
}

void isDifference(Check& check, Student& student, int n, int k) {
  const double tau = check.rng().uniform(0.02, 3);
  check.input(described(n, k, tau));
  const Eigen::MatrixXd window = randomMatrix(check.rng(), n, k + 1);
  const Eigen::VectorXd weights = weightsOf(k, tau);
  const TermValue got = student.differenceTerm(window, tau);
  const double scale = weights.cwiseAbs().maxCoeff();
  check.shape("y", got.y, n, 1);
  check.near("y, relative to the largest weight", got.y / scale, window * weights / scale, 1e-9);
  check.shape("J", got.J, n, (k + 1) * n);
  for (int i = 0; i <= k; ++i)
    check.near("columns of one configuration in J, relative to the largest weight",
               got.J.middleCols(i * n, n) / scale, weights[i] / scale * Eigen::MatrixXd::Identity(n, n),
               1e-9);
}

void differences(Check& check, Student& student) {
  for (const int k : {1, 2, 3})
    for (const int n : {1, 2, 7}) isDifference(check, student, n, k);
}

// x(t) = a t^k / k! has the constant k-th derivative a, of which the integral of squares is known.
void costOfPowers(Check& check, Student& student) {
  for (const int k : {1, 2, 3})
    for (const double tau : {0.05, 2.}) {
      const int T = 10;
      const Eigen::Vector2d a = check.rng().normalVector(2);
      Eigen::MatrixXd path(2, 4 + T);
      for (int i = 0; i < 4 + T; ++i) path.col(i) = a * std::pow((i - 3) * tau, k) / std::tgamma(k + 1);
      check.input(described(2, k, tau) + ", constant " + kNames[static_cast<std::size_t>(k)] + ", T = 10");
      const double wanted = a.squaredNorm() * T * tau;
      check.near("cost, relative to the integral",
                 student.motionCost(path.leftCols(4), path.rightCols(T), k, tau) / wanted, 1, 1e-6);
    }
}

void isTaskDifference(Check& check, Student& student, int d, int n, int k) {
  Rng& rng = check.rng();
  const double tau = rng.uniform(0.02, 3);
  check.input(described(n, k, tau) + fmt::format(", d = {}", d));
  const Eigen::VectorXd weights = weightsOf(k, tau) / weightsOf(k, tau).cwiseAbs().maxCoeff();
  std::vector<TermValue> phi;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(d);
  for (int i = 0; i <= k; ++i) {
    phi.push_back({rng.normalVector(d), randomMatrix(rng, d, n)});
    y += weights[i] * phi.back().y;
  }
  const double scale = weightsOf(k, tau).cwiseAbs().maxCoeff();
  const TermValue got = student.taskDifference(phi, tau);
  check.near("y, relative to the largest weight", got.y / scale, y, 1e-9);
  check.shape("J", got.J, d, (k + 1) * n);
  for (int i = 0; i <= k; ++i)
    check.near("columns of one configuration in J, relative to the largest weight",
               got.J.middleCols(i * n, n) / scale, weights[i] * phi[static_cast<std::size_t>(i)].J, 1e-9);
}

void taskDifferences(Check& check, Student& student) {
  for (const int k : {1, 2, 3}) isTaskDifference(check, student, 3, 5, k);
  isTaskDifference(check, student, 4, 2, 2);
}

// <hidden>
void costsOfAnyPath(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    const int k = 1 + i % 3, n = 1 + rng.index(6), T = 1 + rng.index(30), prefix = k + rng.index(3);
    const double tau = rng.uniform(0.01, 2);
    const Eigen::MatrixXd path = randomMatrix(rng, n, prefix + T);
    double wanted = 0;
    for (int t = 0; t < T; ++t)
      wanted += (path.middleCols(prefix + t - k, k + 1) * weightsOf(k, tau)).squaredNorm();
    check.near("cost, relative to the wanted one",
               student.motionCost(path.leftCols(prefix), path.rightCols(T), k, tau) / wanted, 1, 1e-9);
    isDifference(check, student, n, k);
    isTaskDifference(check, student, 1 + rng.index(5), n, k);
  });
}
// </hidden>

// Part 2.

void isAssembled(Check& check, Student& student, int n, int steps, int k) {
  check.input(fmt::format("terms up to order {}, n = {}, T = {}", k, n, steps));
  const std::vector<Term> terms = randomTerms(check.rng(), n, steps, k);
  const BandSystem got = student.assembled(terms, n, steps);
  const FullSystem wanted = denseSystem(terms, n, steps);
  check.shape("band of H", got.band, (k + 1) * n, n * steps);
  check.near("band of H", got.band, bandOf(wanted.H, (k + 1) * n),
             1e-9 * (1 + wanted.H.cwiseAbs().maxCoeff()));
  check.near("gradient", got.g, wanted.g, 1e-9 * (1 + wanted.g.cwiseAbs().maxCoeff()));
}

void assembles(Check& check, Student& student) {
  for (const int k : {0, 1, 2, 3}) isAssembled(check, student, 2, 7, k);
  isAssembled(check, student, 3, 1, 2);
}

void isFactor(Check& check, Student& student, Eigen::Index rows, Eigen::Index columns) {
  check.input(fmt::format("a band of {} x {}", rows, columns));
  Rng& rng = check.rng();
  const Eigen::MatrixXd band = squared(randomFactor(rng, rows, columns));
  const Eigen::MatrixXd L = student.bandCholesky(band);
  check.shape("L", L, rows, columns);
  // Entries are at most a few times the largest, 4 + 0.16 (rows - 1).
  check.near("L L^T", squared(L), band, 1e-9 * static_cast<double>(rows));
  const Eigen::VectorXd b = rng.normalVector(static_cast<int>(columns));
  const Eigen::VectorXd x = student.bandSolve(L, b);
  check.shape("x", x, columns, 1);
  check.atMost("residual of L L^T x = b, relative",
               (times(band, x) - b).norm() / (b.norm() * (1 + band.cwiseAbs().maxCoeff())), 1e-9);
}

void factors(Check& check, Student& student) {
  isFactor(check, student, 1, 4);
  isFactor(check, student, 3, 12);
  isFactor(check, student, 6, 6);
  isFactor(check, student, 9, 3);
  check.input("a band of 2 x 3 that is not positive definite: the diagonal 1, 1, 1 with 2 below");
  Eigen::MatrixXd band(2, 3);
  band << 1, 1, 1, 2, 2, 0;
  check.near("size of L where H is not positive definite",
             static_cast<double>(student.bandCholesky(band).size()), 0, 0);
}

// A dense matrix of 16000 x 16000 would take 2 GB, which is twice the memory available.
void longBands(Check& check, Student& student) { isFactor(check, student, 6, 16000); }

double costOf(const std::vector<Term>& terms) {
  double cost = 0;
  for (const Term& term : terms) cost += term.y.squaredNorm();
  return cost;
}

grading::Evidence costsSeen(const Terms& terms, const std::vector<Eigen::MatrixXd>& path) {
  Series costs{.label = "F", .style = SeriesStyle::kLinesPoints};
  for (const Eigen::MatrixXd& X : path) costs.y.push_back(costOf(terms(X)));
  return {.figures = {
              {.title = "The cost after each step", .xLabel = "step", .yLabel = "F [1]", .series = {costs}}}};
}

void descends(Check& check, Student& student, const std::string& name, const Terms& terms,
              const Eigen::MatrixXd& start, std::size_t mostSteps) {
  const auto n = static_cast<int>(start.rows()), steps = static_cast<int>(start.cols());
  const double tolerance = 1e-6;
  check.input(name + fmt::format(", n = {}, T = {}, tolerance = {:g}", n, steps, tolerance));
  const std::vector<Eigen::MatrixXd> path = student.descended(terms, start, tolerance);
  check.atLeast("number of trajectories", static_cast<double>(path.size()), 2);
  check.atMost("number of steps", static_cast<double>(path.size()) - 1, static_cast<double>(mostSteps));
  for (const Eigen::MatrixXd& X : path) check.shape("trajectory", X, n, steps);
  const auto shown = check.show([&] { return costsSeen(terms, path); });
  check.near("first trajectory", path.front(), start, 0);
  for (std::size_t i = 1; i < path.size(); ++i)
    check.that("F falls with each step", costOf(terms(path[i])) < costOf(terms(path[i - 1])));
  check.atMost("largest entry of the gradient at the end",
               denseSystem(terms(path.back()), n, steps).g.cwiseAbs().maxCoeff(), tolerance);
}

// Terms that each fix one configuration; some configurations are fixed by none.
Terms withGaps(Rng& rng, int n) {
  const Eigen::MatrixXd A = randomMatrix(rng, n, n) + 3 * Eigen::MatrixXd::Identity(n, n);
  return [=](const Eigen::MatrixXd& X) {
    std::vector<Term> terms;
    for (int t = 0; t < X.cols(); t += 2)
      terms.push_back({Role::cost, t, A * X.col(t) - Eigen::VectorXd::Ones(n), A});
    return terms;
  };
}

void descents(Check& check, Student& student) {
  Rng& rng = check.rng();
  const std::vector<Term> at0 = randomTerms(rng, 2, 8, 2);
  const Terms linear = [&](const Eigen::MatrixXd& X) {
    std::vector<Term> terms = at0;
    for (Term& term : terms) term.y += overAll(term, 2, 8) * X.reshaped();
    for (int t = 0; t < 8; ++t) terms.push_back({Role::cost, t, X.col(t), Eigen::MatrixXd::Identity(2, 2)});
    return terms;
  };
  descends(check, student, "linear terms, for which one step suffices, up to rounding", linear,
           randomMatrix(rng, 2, 8), 5);
  descends(check, student, "arc tangents of all x, and differences", arcTangents(2, 0.1),
           rng.uniformVector(20, 2, 4).reshaped(2, 10), 300);
  descends(check, student, "terms that leave every other configuration free", withGaps(rng, 2),
           randomMatrix(rng, 2, 6), 50);
}

// <hidden>
void unseenDescents(Check& check, Student& student) {
  check.forEachCase(6, [&](int i) {
    Rng& rng = check.rng();
    const int n = 1 + rng.index(4), steps = 2 + rng.index(20);
    isAssembled(check, student, n, steps, rng.index(4));
    isFactor(check, student, 1 + rng.index(12), 1 + rng.index(60));
    if (i % 2 == 0)
      descends(check, student, "", arcTangents(n, rng.uniform(0.05, 0.3)),
               rng.uniformVector(n * steps, 2, 5).reshaped(n, steps), 300);
    else
      descends(check, student, "", withGaps(rng, n), randomMatrix(rng, n, steps), 50);
  });
}
// </hidden>

// Part 3.

Term randomTerm(Rng& rng, Role role) {
  const int d = 1 + rng.index(5), n = 1 + rng.index(4);
  return {role, rng.index(9), rng.normalVector(d), randomMatrix(rng, d, n)};
}

Eigen::VectorXd randomMultipliers(Rng& rng, const Term& term) {
  const Eigen::VectorXd m = 2 * rng.normalVector(static_cast<int>(term.y.size()));
  return term.role == Role::inequality ? Eigen::VectorXd(m.cwiseMax(0)) : m;
}

std::string described(const Term& term, double mu) {
  const std::vector<std::string> roles{"a cost", "an inequality", "an equality"};
  return fmt::format("{} of {} rows, mu = {:.3g}", roles[static_cast<std::size_t>(term.role)], term.y.size(),
                     mu);
}

void replaces(Check& check, Student& student) {
  check.forEachCase(15, [&](int i) {
    Rng& rng = check.rng();
    const Term term = randomTerm(
        rng, std::vector{Role::cost, Role::inequality, Role::equality}[static_cast<std::size_t>(i % 3)]);
    const Eigen::VectorXd m = randomMultipliers(rng, term);
    const double mu = std::pow(10, rng.uniform(-1, 3));
    check.input(described(term, mu));
    const Term got = student.asCost(term, term.role == Role::cost ? Eigen::VectorXd(0) : m, mu);
    check.that("the role is that of a cost, and t stays", got.role == Role::cost && got.t == term.t);
    check.shape("r", got.y, term.y.size(), 1);
    check.shape("J of r", got.J, term.J.rows(), term.J.cols());
    if (term.role == Role::cost) {
      check.near("r of a cost", got.y, term.y, 1e-12);
      check.near("J of a cost", got.J, term.J, 1e-12);
      return;
    }
    Eigen::VectorXd slope = 2 * mu * term.y + m, curve = Eigen::VectorXd::Constant(term.y.size(), mu);
    for (Eigen::Index row = 0; row < slope.size(); ++row) {
      if (term.role == Role::equality || slope[row] > 0) continue;
      slope[row] = curve[row] = 0;
      check.near("r of an inactive inequality", got.y[row], 0, 1e-12);
    }
    const double scale = 1 + mu;
    check.near("gradient of r^T r, over 1 + mu", 2 * got.J.transpose() * got.y / scale,
               term.J.transpose() * slope / scale, 1e-9);
    check.near("J^T J of r, over 1 + mu", got.J.transpose() * got.J / scale,
               term.J.transpose() * curve.asDiagonal() * term.J / scale, 1e-9);
  });
}

void updates(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    const Term term = randomTerm(rng, i % 2 == 0 ? Role::inequality : Role::equality);
    const Eigen::VectorXd m = randomMultipliers(rng, term);
    const double mu = std::pow(10, rng.uniform(-1, 3));
    check.input(described(term, mu));
    Eigen::VectorXd wanted = m + 2 * mu * term.y;
    if (term.role == Role::inequality) wanted = wanted.cwiseMax(0);
    check.near("multipliers, over 1 + mu", student.nextMultipliers(term, m, mu) / (1 + mu), wanted / (1 + mu),
               1e-9);
  });
}

// What a Minimum reports must hold for every problem.
void isStationary(Check& check, const Terms& terms, const Minimum& got, const Accuracy& accuracy) {
  const std::vector<Term> all = terms(got.X);
  const auto n = static_cast<int>(got.X.rows()), steps = static_cast<int>(got.X.cols());
  check.near("number of vectors of multipliers", static_cast<double>(got.multipliers.size()),
             static_cast<double>(all.size()), 0);
  double violation = 0, gap = 0, cost = 0;
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(n * steps);
  for (std::size_t j = 0; j < all.size(); ++j) {
    const Term& term = all[j];
    const Eigen::VectorXd& m = got.multipliers[j];
    const Eigen::MatrixXd J = overAll(term, n, steps);
    if (term.role == Role::cost) {
      cost += term.y.squaredNorm();
      gradient += 2 * J.transpose() * term.y;
      continue;
    }
    check.shape("multipliers of a constraint", m, term.y.size(), 1);
    gradient += J.transpose() * m;
    violation =
        std::max(violation, term.role == Role::equality ? term.y.cwiseAbs().maxCoeff() : term.y.maxCoeff());
    if (term.role == Role::equality) continue;
    check.atLeast("smallest multiplier of an inequality", m.minCoeff(), 0);
    gap = std::max(gap, m.cwiseMin(-term.y).maxCoeff());
  }
  check.atMost("largest violation of a constraint", violation, accuracy.violation * (1 + 1e-6));
  check.atMost("largest entry of the gradient of the Lagrangian", gradient.cwiseAbs().maxCoeff(),
               accuracy.gradient * (1 + 1e-6));
  check.atMost("the smaller of -y and the multiplier of an inequality", gap, accuracy.violation * (1 + 1e-6));
  check.atLeast("number of rounds", static_cast<double>(got.cost.size()), 1);
  check.near("number of violations", static_cast<double>(got.violation.size()),
             static_cast<double>(got.cost.size()), 0);
  check.near("cost after the last round", got.cost.back(), cost, 1e-9 * (1 + cost));
  check.near("violation after the last round", got.violation.back(), violation, 1e-9 * (1 + violation));
}

grading::Evidence roundsSeen(const Minimum& got) {
  Series violation{.label = "largest violation", .style = SeriesStyle::kLinesPoints};
  for (const double v : got.violation) violation.y.push_back(std::isfinite(v) ? std::max(v, 1e-12) : 1e12);
  if (violation.y.empty()) return {};
  return {.figures = {{.title = "The largest violation of a constraint after each round",
                       .xLabel = "round, from 0",
                       .yLabel = "violation [1]",
                       .logY = true,
                       .series = {violation}}}};
}

// The curvature of the costs along constraints is 2 or more, so that with these accuracies x is accurate to
// 1e-2 at least.
void findsMinimum(Check& check, Student& student, const KnownProblem& problem) {
  const Accuracy accuracy;
  check.input(problem.name);
  const Minimum got = student.minimised(problem.terms, problem.start, problem.mu, accuracy);
  const auto shown = check.show([&] { return roundsSeen(got); });
  check.shape("X", got.X, problem.start.rows(), problem.start.cols());
  isStationary(check, problem.terms, got, accuracy);
  check.near("X", got.X, problem.minimum, 1e-2);
}

void knownMinima(Check& check, Student& student) {
  findsMinimum(check, student, rosenSuzuki());
  findsMinimum(check, student, curvedEquality());
  findsMinimum(check, student, nearestOnBall(check.rng(), Role::inequality));
}

// <hidden>
void unseenMinima(Check& check, Student& student) {
  check.forEachCase(8, [&](int i) {
    Rng& rng = check.rng();
    if (i == 0)
      findsMinimum(check, student, nearestOnBall(rng, Role::equality));
    else
      findsMinimum(check, student, linearMotion(rng, 1 + rng.index(3), 4 + rng.index(12)));
  });
}
// </hidden>

// Part 4.

void goesThrough(Check& check, Student& student, const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                 const std::vector<int>& when, double tau) {
  check.input(fmt::format("n = {}, {} via points, T = {}, tau = {:.3g}", start.size(), points.cols(),
                          when.back() + 1, tau));
  const Eigen::MatrixXd wanted = leastAcceleration(start, points, when);
  const Eigen::MatrixXd got = student.throughPoints(start, points, when, tau);
  check.shape("X", got, start.size(), when.back() + 1);
  const double reach = (points.colwise() - start).cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < when.size(); ++k)
    check.near("configuration at the step of a point, relative to the greatest distance",
               got.col(when[k]) / reach, points.col(static_cast<Eigen::Index>(k)) / reach, 1e-6);
  check.near("configuration before the last one, relative to the greatest distance",
             got.col(got.cols() - 2) / reach, got.col(got.cols() - 1) / reach, 2e-6);
  check.near("X, relative to the greatest distance", got / reach, wanted / reach, 2e-6);
}

void through(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (const int T : {2, 5, 40})
    goesThrough(check, student, Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Ones(1, 1), {T - 1}, 1. / T);
  goesThrough(check, student, rng.normalVector(2), randomMatrix(rng, 2, 3), {7, 15, 24}, 0.1);
}

// <hidden>
void throughOthers(Check& check, Student& student) {
  check.forEachCase(8, [&](int) {
    Rng& rng = check.rng();
    const int n = 1 + rng.index(4), count = 1 + rng.index(4);
    std::vector<int> when;
    for (int i = 0; i < count; ++i) when.push_back((i == 0 ? 0 : when.back()) + 2 + rng.index(10));
    const Eigen::VectorXd start = rng.normalVector(n);
    Eigen::MatrixXd points = randomMatrix(rng, n, count);
    points(0, count - 1) = start[0] + 1;
    goesThrough(check, student, start, points, when, rng.uniform(0.02, 0.5));
  });
}
// </hidden>

// Part 5.

void isKeptApart(Check& check, Student& student, const std::vector<Ball>& balls, int samples) {
  Rng& rng = check.rng();
  const Eigen::MatrixXd window = randomMatrix(rng, 3, 2);
  const double margin = rng.uniform(0.01, 0.2);
  Simulator S(armAmong(balls, window.col(1)));
  check.input(fmt::format("{} balls, {} samples, margin = {:.3g}", balls.size(), samples, margin));
  const TermValue got = student.keptApart(S.description(), window, margin, samples);
  const Eigen::Index pairs = clearances(S).y.size();
  check.shape("y", got.y, samples * pairs, 1);
  check.shape("J", got.J, samples * pairs, 6);
  for (int k = 0; k < samples; ++k) {
    const double share = (k + 1.) / samples;
    S.setJointAngles(window.col(0) + share * (window.col(1) - window.col(0)));
    const Clearances near = clearances(S);
    check.near("distances that y stands for, in margins",
               (1 - got.y.segment(k * pairs, pairs).array()).matrix(), near.y / margin, 1e-7);
    check.near("columns of x_{t-1} in J, times the margin", margin * got.J.block(k * pairs, 0, pairs, 3),
               (share - 1) * near.J, 1e-7);
    check.near("columns of x_t in J, times the margin", margin * got.J.block(k * pairs, 3, pairs, 3),
               -share * near.J, 1e-7);
  }
}

void keepsApart(Check& check, Student& student) {
  for (const int samples : {1, 2, 5}) isKeptApart(check, student, kBall, samples);
}

grading::Evidence motionSeen(const Simulator& S, const Eigen::MatrixXd& path, int step) {
  std::vector<Eigen::VectorXd> postures;
  Simulator moved = S;
  Series nearest{.label = "nearest pair"};
  for (Eigen::Index i = 0; i + 1 < path.cols(); ++i)
    for (int k = 0; k < 4; ++k) {
      postures.emplace_back(path.col(i) + k / 4. * (path.col(i + 1) - path.col(i)));
      moved.setJointAngles(postures.back());
      nearest.x.push_back(static_cast<double>(i) + k / 4.);
      nearest.y.push_back(clearances(moved).y.minCoeff());
    }
  const Film film = filmOf(S, postures, {.traces = {"eff"}, .view = {2, -0.6, 0.5}});
  const auto moment = std::min(static_cast<std::size_t>(4 * step + 2), film.size() - 1);
  return {.figures = {{.title = "Distance of the nearest pair",
                       .xLabel = "step",
                       .yLabel = "distance [m]",
                       .series = {nearest}}},
          .film = film,
          .view = {2, -0.6, 0.5},
          .moment = film[moment].time};
}

void getsAround(Check& check, Student& student, const Scene& scene) {
  const Eigen::VectorXd& start = scene.start;
  const Errand& errand = scene.errand;
  const Simulator S(armAmong(scene.balls, start));
  std::string input = fmt::format("T = {}, tau = {:.3g}, margin {:.3g}, budget {:.3g}", errand.steps,
                                  errand.tau, errand.margin, errand.budget);
  for (const Ball& ball : scene.balls)
    input += fmt::format(", a ball at y = {:.3g}, z = {:.3g} of radius {:.3g}", ball.y, ball.z, ball.radius);
  check.input(input);
  const Eigen::MatrixXd X = student.aroundObstacle(S.description(), errand);
  const Eigen::Index T = errand.steps;
  check.shape("X", X, start.size(), T);
  Eigen::MatrixXd path(start.size(), T + 1);
  path << start, X;
  TrajectoryClearance clearance;
  const auto shown = check.show([&] { return motionSeen(S, path, clearance.step); });
  check.near("configuration at the end", X.col(T - 1), errand.goal, 1e-3, "rad");
  check.near("configuration before the end", X.col(T - 2), errand.goal, 2e-3, "rad");
  double cost = 0;
  Eigen::MatrixXd all(start.size(), T + 2);
  all << start, path;
  for (Eigen::Index t = 0; t < T; ++t)
    cost += (all.middleCols(t, 3) * weightsOf(2, errand.tau)).squaredNorm();
  check.atMost("cost of the motion", cost, errand.budget);
  // Last, for it takes the longer the further the motion leads.
  clearance = trajectoryClearance(S.model(), ContactModel(S.model()), path, 1e-4);
  check.atLeast("least distance of any pair, also between steps", clearance.distance,
                0.8 * errand.margin - 1e-4, "m");
}

void aroundTheBall(Check& check, Student& student) {
  getsAround(check, student, drawnLike({kBall, kArmStart, kErrand}, check.rng()));
}

// <hidden>
void aroundOthers(Check& check, Student& student) {
  check.forEachCase(4, [&](int i) {
    Scene scene{{{-0.85, 0.95, 0.02}}, kArmStart, kErrand};
    if (i == 1) {
      scene = {{{-0.88, 1.1, 0.03}}, Eigen::Vector3d(0.9, 0.1, 0.1), kErrand};
      scene.errand.goal = Eigen::Vector3d(-0.9, 0.3, 0.1);
      scene.errand.detour = Eigen::Vector3d(-0.5, 1, 0.5);
    } else if (i == 2) {
      scene = {{{-0.85, 1, 0.02}}, Eigen::Vector3d(0.8, -0.2, -0.2), kErrand};
      scene.errand.goal = Eigen::Vector3d(-0.8, -0.2, -0.2);
      scene.errand.detour = Eigen::Vector3d(0.7, -1.4, 0);
    } else if (i == 3) {
      scene.balls.push_back({-0.92, 1.05, 0.02});
    }
    getsAround(check, student, drawnLike(scene, check.rng()));
  });
}
// </hidden>

}  // namespace

rex::grading::Checks<Student> checks() {
  return {
      {"difference-terms", "terms", "Velocity, acceleration, jerk", 1, Group::kVisible, differences},
      {"task-differences", "terms", "The same for task maps", 1, Group::kVisible, taskDifferences},
      {"cost-of-powers", "terms", "Costs are integrals", 1, Group::kVisible, costOfPowers},
      // <hidden>
      {"any-path", "terms", "Other sizes, paths and prefixes", 1, Group::kHidden, costsOfAnyPath},
      // </hidden>
      {"assembled", "band", "Gradient and band", 1, Group::kVisible, assembles},
      {"factored", "band", "The factor of a band", 1, Group::kVisible, factors},
      {"long-band", "band", "A motion of thousands of steps", 1, Group::kVisible, longBands},
      {"descends", "band", "Gauss-Newton steps lower the cost", 1, Group::kVisible, descents},
      // <hidden>
      {"unseen-descents", "band", "Other terms and sizes", 1, Group::kHidden, unseenDescents},
      // </hidden>
      {"as-cost", "constraints", "Constraints as costs", 1, Group::kVisible, replaces},
      {"multipliers", "constraints", "New multipliers", 1, Group::kVisible, updates},
      {"known-minima", "constraints", "Problems with a known minimum", 1, Group::kVisible, knownMinima},
      // <hidden>
      {"unseen-minima", "constraints", "Other problems with a known minimum", 2, Group::kHidden,
       unseenMinima},
      // </hidden>
      {"through-points", "via", "Via points, and rest", 1, Group::kVisible, through},
      // <hidden>
      {"other-points", "via", "Other via points", 1, Group::kHidden, throughOthers},
      // </hidden>
      {"kept-apart", "arm", "Clearance between steps", 1, Group::kVisible, keepsApart},
      {"around-the-ball", "arm", "Around the ball", 1, Group::kVisible, aroundTheBall},
      // <hidden>
      {"around-others", "arm", "Around other balls", 2, Group::kHidden, aroundOthers},
      // </hidden>
  };
}
