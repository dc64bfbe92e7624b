#include "grading/check.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "band_checks.h"
#include "collision/motion_clearance.h"
#include "course/clearances.h"
#include "course/film.h"
#include "errands.h"
#include "grading/evidence.h"
#include "grading/tolerance.h"
#include "interface.h"
#include "problems.h"
#include "scenes.h"
#include "term_checks.h"

using namespace rex;
using grading::Check;
using grading::Group;
using grading::Signal;

namespace {

// Part 1.

const std::vector<std::string> kNames{"", "velocity", "acceleration", "jerk"};

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
      check.input("x_t = a ((t + 1) tau)^k / k!, of constant " + kNames[static_cast<std::size_t>(k)],
                  {{"k", k}, {"tau", tau}, {"T", T}, {"a", a}});
      const double wanted = a.squaredNorm() * T * tau;
      check.near("motionCost, the integral over time",
                 student.motionCost(path.leftCols(4), path.rightCols(T), k, tau), wanted, 1e-6 * wanted);
    }
}

void taskDifferences(Check& check, Student& student) {
  for (const int k : {1, 2, 3}) isTaskDifference(check, student, 2, 3, k);
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
    check.near("motionCost", student.motionCost(path.leftCols(prefix), path.rightCols(T), k, tau), wanted,
               1e-9 * wanted);
    isDifference(check, student, n, k);
    isTaskDifference(check, student, 1 + rng.index(5), n, k);
  });
}
// </hidden>

// Part 2.

void assembles(Check& check, Student& student) {
  for (const int k : {0, 1, 2, 3}) isAssembled(check, student, 2, 7, k);
  isAssembled(check, student, 3, 1, 2);
}

void factors(Check& check, Student& student) {
  isFactor(check, student, 1, 4);
  isFactor(check, student, 3, 12);
  isFactor(check, student, 6, 6);
  isFactor(check, student, 9, 3);
  check.input("a band of 2 x 3 that is not positive definite: the diagonal 1, 1, 1 with 2 below");
  Eigen::MatrixXd band(2, 3);
  band << 1, 1, 1, 2, 2, 0;
  check.near("number of entries that bandCholesky returns where H is not positive definite",
             static_cast<double>(student.bandCholesky(band).size()), 0, 0);
}

// A dense matrix of 16000 x 16000 would take 2 GB, which is twice the memory available.
void longBands(Check& check, Student& student) { isFactor(check, student, 6, 16000); }

// Terms that each fix one configuration; some configurations are fixed by none. No singular value of A is
// below 1, so that steps stay long although they are damped.
Terms withGaps(Rng& rng, int n) {
  Eigen::MatrixXd A;
  do A = randomMatrix(rng, n, n) + 3 * Eigen::MatrixXd::Identity(n, n);
  while (rex::svd(A).s[n - 1] < 1);
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
           randomMatrix(rng, 2, 6), 300);
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
      descends(check, student, "", withGaps(rng, n), randomMatrix(rng, n, steps), 300);
  });
}
// </hidden>

// Part 3.

Term randomTerm(Rng& rng, Role role) {
  const int d = 1 + rng.index(3), n = 1 + rng.index(3);
  return {role, rng.index(9), rng.normalVector(d), randomMatrix(rng, d, n)};
}

// Of the size of 2 mu y, so that they decide about inequalities as often as y does.
Eigen::VectorXd randomMultipliers(Rng& rng, const Term& term, double mu) {
  const Eigen::VectorXd m = 2 * mu * rng.normalVector(static_cast<int>(term.y.size()));
  return term.role == Role::inequality ? Eigen::VectorXd(m.cwiseMax(0)) : m;
}

const std::vector<std::string> kRoles{"a cost", "an inequality", "an equality"};

void replaces(Check& check, Student& student) {
  check.forEachCase(15, [&](int i) {
    Rng& rng = check.rng();
    const Term term = randomTerm(
        rng, std::vector{Role::cost, Role::inequality, Role::equality}[static_cast<std::size_t>(i % 3)]);
    const double mu = std::pow(10, rng.uniform(-1, 3));
    const Eigen::VectorXd m = randomMultipliers(rng, term, mu);
    check.input(kRoles[static_cast<std::size_t>(term.role)],
                {{"y", term.y}, {"J", term.J}, {"m", m}, {"mu", mu}});
    const Term got = student.asCost(term, term.role == Role::cost ? Eigen::VectorXd(0) : m, mu);
    check.that("asCost returns a cost, at the same t", got.role == Role::cost && got.t == term.t);
    check.shape("r of asCost", got.y, term.y.size(), 1);
    check.shape("J of asCost", got.J, term.J.rows(), term.J.cols());
    if (term.role == Role::cost) {
      check.near("r of asCost, for a cost", got.y, term.y, 1e-12);
      check.near("J of asCost, for a cost", got.J, term.J, 1e-12);
      return;
    }
    // Of an inequality, only rows count for which the sign is positive.
    const Eigen::VectorXd slope = 2 * mu * term.y + m, curve = Eigen::VectorXd::Constant(term.y.size(), mu);
    const auto counted = [&](const Eigen::VectorXd& value) -> Eigen::VectorXd {
      if (term.role == Role::equality) return value;
      return (slope.array() > 0).select(value, 0);
    };
    check.near("gradient 2 J^T r of r^T r, with r and J of asCost", 2 * got.J.transpose() * got.y,
               term.J.transpose() * counted(slope), 1e-9 * (1 + mu));
    check.near("J^T J of asCost", got.J.transpose() * got.J,
               term.J.transpose() * counted(curve).asDiagonal() * term.J, 1e-9 * (1 + mu));
    for (Eigen::Index row = 0; row < slope.size(); ++row)
      if (term.role == Role::inequality && slope[row] <= 0)
        check.near("r of asCost, for an inequality whose next multiplier is 0", got.y[row], 0, 1e-12);
  });
}

void updates(Check& check, Student& student) {
  check.forEachCase(12, [&](int i) {
    Rng& rng = check.rng();
    const Term term = randomTerm(rng, i % 2 == 0 ? Role::inequality : Role::equality);
    const double mu = std::pow(10, rng.uniform(-1, 3));
    const Eigen::VectorXd m = randomMultipliers(rng, term, mu);
    check.input(kRoles[static_cast<std::size_t>(term.role)], {{"y", term.y}, {"m", m}, {"mu", mu}});
    Eigen::VectorXd next = m + 2 * mu * term.y;
    if (term.role == Role::inequality) next = next.cwiseMax(0).eval();
    check.near("nextMultipliers", student.nextMultipliers(term, m, mu), next, 1e-9 * (1 + mu));
  });
}

// The violations that were reported, beside the measured one.
grading::Evidence roundsSeen(const Minimum& got, double measured, double limit) {
  const auto onScale = [](double v) { return std::isfinite(v) ? std::max(v, 1e-12) : 1e12; };
  Series violation = grading::gotCurve("Minimum::violation");
  violation.style = SeriesStyle::kLinesPoints;
  for (const double v : got.violation) violation.add(static_cast<double>(violation.x.size()), onScale(v));
  Figure figure{.title = "Largest violation of a constraint after each round",
                .xLabel = "round, from 0",
                .yLabel = "violation [1]",
                .logY = true};
  if (!violation.x.empty()) figure.series = {std::move(violation)};
  figure.horizontalLines = {
      {.at = limit, .label = "wanted: at most"},
      {.at = onScale(measured), .label = "measured at X", .color = grading::kWrongColor}};
  return {.figures = {std::move(figure)}};
}

// Costs and violations at the student's X make tolerances larger up to here.
constexpr double kMostSize = 1e4;

// What a Minimum reports must hold for every problem.
void isStationary(Check& check, const Terms& terms, const Minimum& got, const Accuracy& accuracy) {
  const std::vector<Term> all = terms(got.X);
  const auto n = static_cast<int>(got.X.rows()), steps = static_cast<int>(got.X.cols());
  check.near("number of vectors of multipliers of minimised", static_cast<double>(got.multipliers.size()),
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
    check.shape("multipliers of a constraint of minimised", m, term.y.size(), 1);
    gradient += J.transpose() * m;
    violation =
        std::max(violation, term.role == Role::equality ? term.y.cwiseAbs().maxCoeff() : term.y.maxCoeff());
    if (term.role == Role::equality) continue;
    check.atLeast("smallest multiplier of an inequality", m.minCoeff(), 0);
    gap = std::max(gap, m.cwiseMin(-term.y).maxCoeff());
  }
  {
    const auto shown = check.show([&] { return roundsSeen(got, violation, accuracy.violation); });
    double pull = 0;
    for (const Eigen::VectorXd& m : got.multipliers) pull += m.cwiseAbs().sum();
    const auto alone = check.ask("Are all multipliers zero? A penalty alone is never exact.", pull == 0);
    check.atMost("largest violation of a constraint at the X of minimised", violation,
                 accuracy.violation * (1 + 1e-6));
  }
  check.atMost("largest entry of the gradient of the Lagrangian at the X of minimised, with its multipliers",
               gradient.cwiseAbs().maxCoeff(), accuracy.gradient * (1 + 1e-6));
  check.atMost("the smaller of -y and the multiplier of an inequality", gap, accuracy.violation * (1 + 1e-6));
  check.atLeast("number of rounds that minimised reports", static_cast<double>(got.cost.size()), 1);
  check.near("number of violations that minimised reports", static_cast<double>(got.violation.size()),
             static_cast<double>(got.cost.size()), 0);
  check.near("cost that minimised reports for the last round", got.cost.back(), cost,
             1e-9 * grading::sizeUpTo(kMostSize, cost));
  check.near("violation that minimised reports for the last round", got.violation.back(), violation,
             1e-9 * grading::sizeUpTo(kMostSize, violation));
}

// The curvature of the costs along constraints is 2 or more, so that with these accuracies x is accurate to
// 1e-2 at least.
void findsMinimum(Check& check, Student& student, const KnownProblem& problem) {
  const Accuracy accuracy;
  check.input(problem.name);
  const Minimum got = student.minimised(problem.terms, problem.start, problem.mu, accuracy);
  check.shape("X of minimised", got.X, problem.start.rows(), problem.start.cols());
  isStationary(check, problem.terms, got, accuracy);
  check.near("X of minimised", got.X, problem.minimum, 1e-2);
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

// The configurations x_0, x_1, ...
Signal configurations(const Eigen::MatrixXd& X) {
  Signal signal;
  for (const auto& x : X.colwise()) signal.add(static_cast<double>(signal.at.size()), x);
  return signal;
}

void goesThrough(Check& check, Student& student, const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                 const std::vector<int>& when, double tau) {
  Eigen::VectorXd steps(points.cols());
  std::copy(when.begin(), when.end(), steps.begin());
  check.input("via points", {{"start", start}, {"points", points}, {"when", steps}, {"tau", tau}});
  const Eigen::MatrixXd wanted = leastAcceleration(start, points, when);
  const Eigen::MatrixXd got = student.throughPoints(start, points, when, tau);
  const int T = when.back() + 1;
  check.shape("X of throughPoints", got, start.size(), T);
  const double reach = (points.colwise() - start).cwiseAbs().maxCoeff();
  const Signal motion = configurations(got), best = configurations(wanted);
  const auto seen = [&](int t) {
    return grading::Evidence{.figures = {grading::signalFigure(
                                 "Configurations of throughPoints", motion, best.values,
                                 Eigen::VectorXd::Zero(start.size()), static_cast<std::size_t>(t), "")}};
  };
  for (std::size_t k = 0; k < when.size(); ++k) {
    const auto shown = check.show([&] { return seen(when[k]); });
    check.near(fmt::format("x_{} of throughPoints, at a via point", when[k]), got.col(when[k]),
               points.col(static_cast<Eigen::Index>(k)), 1e-6 * reach);
  }
  {
    const auto shown = check.show([&] { return seen(T - 2); });
    check.near(fmt::format("x_{} of throughPoints, at rest like x_{}", T - 2, T - 1), got.col(T - 2),
               got.col(T - 1), 2e-6 * reach);
  }
  check.nearAlong("configuration of throughPoints", motion, best.values, 2e-6 * reach);
}

void passesPoints(Check& check, Student& student) {
  Rng& rng = check.rng();
  for (const int T : {5, 2, 40})
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
  Eigen::MatrixXd places(3, balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i)
    places.col(static_cast<Eigen::Index>(i)) << balls[i].y, balls[i].z, balls[i].radius;
  check.input("columns of balls: y, z, radius",
              {{"balls", places}, {"window", window}, {"margin", margin}, {"samples", samples}});
  const TermValue got = student.keptApart(S.description(), window, margin, samples);
  const auto pairs = static_cast<int>(clearances(S).y.size());
  Eigen::VectorXd y(samples * pairs);
  Eigen::MatrixXd J(samples * pairs, 6);
  for (int k = 0; k < samples; ++k) {
    const double share = (k + 1.) / samples;
    S.setJointAngles(window.col(0) + share * (window.col(1) - window.col(0)));
    const Clearances near = clearances(S);
    y.segment(k * pairs, pairs) = (1 - near.y.array() / margin).matrix();
    J.middleRows(k * pairs, pairs) << (share - 1) / margin * near.J, -share / margin * near.J;
  }
  check.near("y of keptApart", got.y, y, 1e-7);
  check.near("J of keptApart", got.J, J, 1e-7 / margin);
}

void keepsApart(Check& check, Student& student) {
  for (const int samples : {1, 2, 5}) isKeptApart(check, student, kBall, samples);
}

// The motion, with four postures for each step, as a film.
grading::Evidence motionSeen(const Simulator& S, const Eigen::MatrixXd& path) {
  std::vector<Eigen::VectorXd> postures;
  for (Eigen::Index i = 0; i + 1 < path.cols(); ++i)
    for (int k = 0; k < 4; ++k) postures.emplace_back(path.col(i) + k / 4. * (path.col(i + 1) - path.col(i)));
  postures.emplace_back(path.col(path.cols() - 1));
  const Eigen::Vector3d view(2, -0.6, 0.5);
  Film film = makeFilm(S, postures, {.traces = {"eff"}, .view = view});
  const double end = film.back().time;
  return {.film = std::move(film), .view = view, .moment = end};
}

// Returns the cost.
double getsAround(Check& check, Student& student, const Scene& scene) {
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
  const auto shown = check.show([&] { return motionSeen(S, path); });
  check.near("last configuration of aroundObstacle", X.col(T - 1), errand.goal, 1e-3, "rad");
  check.near("last but one configuration of aroundObstacle, at rest at the goal", X.col(T - 2), errand.goal,
             2e-3, "rad");
  Eigen::MatrixXd all(start.size(), T + 2);
  all << start, path;
  double cost = 0;
  Signal costs, clearancesAt, clearancesBetween;
  for (Eigen::Index t = 0; t < T; ++t) {
    cost += (all.middleCols(t, 3) * weightsOf(2, errand.tau)).squaredNorm();
    costs.add(static_cast<double>(t), cost);
  }
  check.atMostAlong("cost of the motion of aroundObstacle up to a step", costs, errand.budget);
  const ContactModel contacts(S.model());
  const auto clearance = [&](Eigen::Index from, Eigen::Index to) {
    return motionClearance(S.model(), contacts, path.col(from), path.col(to), 1e-4);
  };
  // Last, for it takes the longer the further the motion leads.
  for (Eigen::Index t = 0; t < T; ++t) {
    clearancesAt.add(static_cast<double>(t), clearance(t + 1, t + 1));
    clearancesBetween.add(static_cast<double>(t), clearance(t, t + 1));
  }
  const double least = 0.8 * errand.margin - 1e-4;
  check.atLeastAlong("clearance of a configuration of aroundObstacle", clearancesAt, least, "m");
  const auto between =
      check.ask("Are only the configurations kept apart, and not what lies between them?", true);
  check.atLeastAlong("clearance on the way from x_{t-1} to x_t of aroundObstacle", clearancesBetween, least,
                     "m");
  return cost;
}

void aroundTheBall(Check& check, Student& student) {
  check.record("cost of the motion of aroundObstacle",
               getsAround(check, student, drawnLike({kBall, kArmStart, kErrand}, check.rng())));
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
      {"through-points", "via", "Via points, and rest", 1, Group::kVisible, passesPoints},
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
