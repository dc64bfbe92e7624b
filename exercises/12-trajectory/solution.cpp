#include <cmath>

#include "course/clearances.h"
#include "exercise.h"
#include "show.h"
// <solution headers>
// What a mistake in wrong.cpp takes from the library.
// <todo>
// </solution>

using namespace rex;

TermValue differenceTerm(const Eigen::MatrixXd& window, double tau) {
  // <solution differenceTerm>
  std::vector<TermValue> identity;
  for (Eigen::Index i = 0; i < window.cols(); ++i)
    identity.push_back({window.col(i), Eigen::MatrixXd::Identity(window.rows(), window.rows())});
  return taskDifference(identity, tau);
  // <todo>
  //| // TODO: the columns of the window, weighted; which power of tau belongs to order k?
  //| return {Eigen::VectorXd::Zero(window.rows()), Eigen::MatrixXd::Zero(window.rows(), window.size())};
  // </solution>
}

double motionCost(const Eigen::MatrixXd& prefix, const Eigen::MatrixXd& X, int k, double tau) {
  // <solution motionCost>
  Eigen::MatrixXd path(X.rows(), k + X.cols());
  path << prefix.rightCols(k), X;
  double cost = 0;
  for (Eigen::Index t = 0; t < X.cols(); ++t)
    cost += differenceTerm(path.middleCols(t, k + 1), tau).y.squaredNorm();
  return cost;
  // <todo>
  //| // TODO: one window for each t; the first ones reach into the prefix.
  //| return 0;
  // </solution>
}

TermValue taskDifference(const std::vector<TermValue>& phi, double tau) {
  // <solution taskDifference>
  const std::vector<std::vector<double>> binomials{{-1, 1}, {1, -2, 1}, {-1, 3, -3, 1}};
  const std::vector<double>& weights = binomials[phi.size() - 2];
  const double scale = std::sqrt(tau) / std::pow(tau, static_cast<double>(phi.size()) - 1);
  const Eigen::Index n = phi[0].J.cols();
  TermValue value{Eigen::VectorXd::Zero(phi[0].y.size()),
                  Eigen::MatrixXd(phi[0].y.size(), n * static_cast<Eigen::Index>(phi.size()))};
  for (std::size_t i = 0; i < phi.size(); ++i) {
    value.y += scale * weights[i] * phi[i].y;
    value.J.middleCols(static_cast<Eigen::Index>(i) * n, n) = scale * weights[i] * phi[i].J;
  }
  return value;
  // <todo>
  //| // TODO: the same weights as above. On which configuration does each phi depend?
  //| const auto k = static_cast<Eigen::Index>(phi.size()) - 1;
  //| const Eigen::Index d = phi[0].J.rows(), n = phi[0].J.cols();
  //| return {Eigen::VectorXd::Zero(d), Eigen::MatrixXd::Zero(d, (k + 1) * n)};
  // </solution>
}

BandSystem assembled(const std::vector<Term>& terms, int n, int steps) {
  // <solution assembled>
  const int rows = (orderOf(terms, n) + 1) * n;
  BandSystem system{Eigen::MatrixXd::Zero(rows, n * steps), Eigen::VectorXd::Zero(n * steps)};
  for (const Term& term : terms) {
    const Eigen::Index columns = term.J.cols(), first = n * (term.t + 1) - columns;
    for (Eigen::Index a = std::max<Eigen::Index>(0, -first); a < columns; ++a) {
      system.g[first + a] += 2 * term.J.col(a).dot(term.y);
      for (Eigen::Index b = a; b < columns; ++b)
        system.band(b - a, first + a) += 2 * term.J.col(a).dot(term.J.col(b));
    }
  }
  return system;
  // <todo>
  //| // TODO: each term adds to some columns of the band. What becomes of the columns of J that belong to the
  //| // prefix?
  //| return {Eigen::MatrixXd::Zero(n, n * steps), Eigen::VectorXd::Zero(n * steps)};
  // </solution>
}

Eigen::MatrixXd bandCholesky(const Eigen::MatrixXd& band) {
  // <solution bandCholesky>
  Eigen::MatrixXd L = band;
  const Eigen::Index rows = L.rows();
  for (Eigen::Index j = 0; j < L.cols(); ++j) {
    if (!(L(0, j) > 0)) return {};
    L.col(j) /= std::sqrt(L(0, j));
    for (Eigen::Index i = 1; i < rows && j + i < L.cols(); ++i)
      L.col(j + i).head(rows - i) -= L(i, j) * L.col(j).tail(rows - i);
  }
  return L;
  // <todo>
  //| // TODO: column by column. Which later columns does a column change?
  //| return {};
  // </solution>
}

Eigen::VectorXd bandSolve(const Eigen::MatrixXd& L, const Eigen::VectorXd& b) {
  // <solution bandSolve>
  Eigen::VectorXd x = b;
  const Eigen::Index N = L.cols();
  for (Eigen::Index j = 0; j < N; ++j) {
    const Eigen::Index below = std::min(L.rows() - 1, N - 1 - j);
    x[j] /= L(0, j);
    x.segment(j + 1, below) -= x[j] * L.col(j).segment(1, below);
  }
  for (Eigen::Index j = N - 1; j >= 0; --j) {
    const Eigen::Index below = std::min(L.rows() - 1, N - 1 - j);
    x[j] = (x[j] - L.col(j).segment(1, below).dot(x.segment(j + 1, below))) / L(0, j);
  }
  return x;
  // <todo>
  //| // TODO: first L y = b from above, then L^T x = y from below.
  //| return Eigen::VectorXd::Zero(b.size());
  // </solution>
}

std::vector<Eigen::MatrixXd> descended(const Terms& terms, const Eigen::MatrixXd& start, double tolerance) {
  // <solution descended>
  const int n = static_cast<int>(start.rows()), T = static_cast<int>(start.cols());
  const auto costOf = [](const std::vector<Term>& all) {
    double cost = 0;
    for (const Term& term : all) cost += term.y.squaredNorm();
    return cost;
  };
  std::vector<Eigen::MatrixXd> path{start};
  std::vector<Term> here = terms(start);
  while (path.size() <= 300) {
    BandSystem system = assembled(here, n, T);
    if (system.g.cwiseAbs().maxCoeff() <= tolerance) break;
    Eigen::MatrixXd L = bandCholesky(system.band);
    for (double damping = 1e-9 * system.band.maxCoeff(); L.size() == 0; damping *= 10) {
      for (int j = 0; j < n * T; ++j) system.band(0, j) += damping;
      L = bandCholesky(system.band);
    }
    const Eigen::VectorXd down = bandSolve(L, system.g);
    const Eigen::MatrixXd step = down.reshaped(n, T);
    const double cost = costOf(here), slope = system.g.dot(down);
    double share = 1;
    Eigen::MatrixXd next;
    for (;; share /= 2) {
      next = path.back() - share * step;
      here = terms(next);
      if (share < 1e-10 || costOf(here) <= cost - 0.01 * share * slope) break;
    }
    if (!(costOf(here) < cost)) break;
    path.push_back(next);
  }
  return path;
  // <todo>
  //| // TODO: assemble, factor, solve, and go as far as the cost falls.
  //| return {start};
  // </solution>
}

Term asCost(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // <solution asCost>
  if (term.role == Role::cost) return term;
  Term rows{Role::cost, term.t, std::sqrt(mu) * (term.y + multipliers / (2 * mu)), std::sqrt(mu) * term.J};
  if (term.role == Role::equality) return rows;
  for (Eigen::Index i = 0; i < rows.y.size(); ++i) {
    if (rows.y[i] > 0) continue;
    rows.y[i] = 0;
    rows.J.row(i).setZero();
  }
  return rows;
  // <todo>
  //| // TODO: complete the square. When does an inequality still count?
  //| return term;
  // </solution>
}

Eigen::VectorXd nextMultipliers(const Term& term, const Eigen::VectorXd& multipliers, double mu) {
  // <solution nextMultipliers>
  if (term.role == Role::cost) return multipliers;
  const Eigen::VectorXd next = multipliers + 2 * mu * term.y;
  return term.role == Role::equality ? next : Eigen::VectorXd(next.cwiseMax(0));
  // <todo>
  //| // TODO: differentiate mu y^T y + m^T y. What multiplies dy/dx?
  //| return multipliers;
  // </solution>
}

Minimum minimised(const Terms& terms, const Eigen::MatrixXd& start, double mu, const Accuracy& accuracy) {
  // <solution minimised>
  Minimum result{start, {}, {}, {}};
  for (const Term& term : terms(start))
    result.multipliers.push_back(Eigen::VectorXd::Zero(term.role == Role::cost ? 0 : term.y.size()));
  const Terms augmented = [&](const Eigen::MatrixXd& X) {
    std::vector<Term> all = terms(X);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = asCost(all[i], result.multipliers[i], mu);
    return all;
  };
  for (int round = 0; round < 60; ++round) {
    result.X = descended(augmented, result.X, accuracy.gradient / 2).back();
    double cost = 0, violation = 0, gap = 0;
    const std::vector<Term> all = terms(result.X);
    for (std::size_t i = 0; i < all.size(); ++i) {
      Eigen::VectorXd& m = result.multipliers[i];
      m = nextMultipliers(all[i], m, mu);
      for (Eigen::Index row = 0; row < all[i].y.size(); ++row) {
        const double y = all[i].y[row];
        if (all[i].role == Role::cost) cost += y * y;
        if (all[i].role == Role::equality) violation = std::max(violation, std::abs(y));
        if (all[i].role == Role::inequality) violation = std::max(violation, y);
        if (all[i].role == Role::inequality) gap = std::max(gap, std::min(m[row], -y));
      }
    }
    const bool isSlow = round > 0 && violation > result.violation.back() / 4;
    result.cost.push_back(cost);
    result.violation.push_back(violation);
    if (std::max(violation, gap) <= accuracy.violation) break;
    if (isSlow) mu *= 10;
  }
  return result;
  // <todo>
  //| // TODO: minimise with asCost() in place of the terms, then new multipliers, and again. What if the
  //| // violation hardly falls?
  //| return {start, std::vector<Eigen::VectorXd>(terms(start).size()), {0}, {0}};
  // </solution>
}

Eigen::MatrixXd throughPoints(const Eigen::VectorXd& start, const Eigen::MatrixXd& points,
                              const std::vector<int>& when, double tau) {
  // <solution throughPoints>
  const Eigen::Index n = start.size();
  const Terms terms = [&](const Eigen::MatrixXd& X) {
    Eigen::MatrixXd path(n, 2 + X.cols());
    path << start, start, X;
    std::vector<Term> all;
    const auto add = [&](Role role, int t, const TermValue& value) {
      all.push_back({role, t, value.y, value.J});
    };
    for (int t = 0; t < X.cols(); ++t) add(Role::cost, t, differenceTerm(path.middleCols(t, 3), tau));
    for (std::size_t i = 0; i < when.size(); ++i)
      add(Role::equality, when[i],
          {X.col(when[i]) - points.col(static_cast<Eigen::Index>(i)), Eigen::MatrixXd::Identity(n, n)});
    add(Role::equality, when.back(), differenceTerm(X.rightCols(2), 1));
    return all;
  };
  return minimised(terms, start.replicate(1, when.back() + 1), 10 / std::pow(tau, 3), {1e-9, 1e-6}).X;
  // <todo>
  //| // TODO: which terms are costs, and which are equalities?
  //| return start.replicate(1, when.back() + 1);
  // </solution>
}

TermValue keptApart(Simulator& S, const Eigen::MatrixXd& window, double margin, int samples) {
  // <solution keptApart>
  const Eigen::Index n = window.rows();
  TermValue all;
  for (int i = 0; i < samples; ++i) {
    const double s = (i + 1.) / samples;
    S.setJointAngles((1 - s) * window.col(0) + s * window.col(1));
    const Clearances d = clearances(S);
    const Eigen::Index pairs = d.y.size();
    if (i == 0) all = {Eigen::VectorXd(samples * pairs), Eigen::MatrixXd(samples * pairs, 2 * n)};
    for (Eigen::Index k = 0; k < pairs; ++k) all.y[i * pairs + k] = 1 - d.y[k] / margin;
    all.J.block(i * pairs, 0, pairs, n) = -(1 - s) / margin * d.J;
    all.J.block(i * pairs, n, pairs, n) = -s / margin * d.J;
  }
  return all;
  // <todo>
  //| // TODO: move S along the way; how does the posture at s depend on both ends?
  //| const Eigen::Index rows = samples * clearances(S).y.size();
  //| return {Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, window.size())};
  // </solution>
}

Eigen::MatrixXd aroundObstacle(Simulator& S, const Errand& errand) {
  // <solution aroundObstacle>
  constexpr int kSamples = 8;
  const Eigen::VectorXd start = S.getJointAngles();
  const Eigen::Index n = start.size();
  const int last = errand.steps - 1;
  const Terms terms = [&](const Eigen::MatrixXd& X) {
    Eigen::MatrixXd path(n, 2 + X.cols());
    path << start, start, X;
    std::vector<Term> all;
    const auto add = [&](Role role, int t, const TermValue& value) {
      all.push_back({role, t, value.y, value.J});
    };
    for (int t = 0; t <= last; ++t) {
      add(Role::cost, t, differenceTerm(path.middleCols(t, 3), errand.tau));
      add(Role::inequality, t, keptApart(S, path.middleCols(t + 1, 2), errand.margin, kSamples));
    }
    add(Role::equality, last, {X.col(last) - errand.goal, Eigen::MatrixXd::Identity(n, n)});
    add(Role::equality, last, differenceTerm(X.rightCols(2), 1));
    return all;
  };
  Eigen::MatrixXd points(n, 2);
  points << errand.detour, errand.goal;
  const Eigen::MatrixXd guess = throughPoints(start, points, {last / 2, last}, errand.tau);
  const Eigen::MatrixXd X = minimised(terms, guess, 1000, {1e-4, 1e-3}).X;
  S.setJointAngles(start);
  return X;
  // <todo>
  //| // TODO: start through the detour; then costs, ends, and keptApart() at each step.
  //| return S.getJointAngles().replicate(1, errand.steps);
  // </solution>
}

// What follows is given, and never graded: change it as you like. show.h says what each line draws.

int main() {
  // Part 1: a motion from 0 to 1 in a second, cut into more and more steps.
  showCosts();

  // Parts 2 and 3: a point goes past a disc, whose inside has a price at first, and then is forbidden.
  showDescent();
  showDisc();

  // Part 4: from (0, 0) through four points, one after each second.
  Eigen::MatrixXd points(2, 4);
  points << 1, 2, 3, 4, 1, -1, .5, 0;
  showReach();
  showVia(points, {19, 39, 59, 79}, .05);

  // Part 5: an arm and a ball.
  showArm();
}
