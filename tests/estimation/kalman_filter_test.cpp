#include "estimation/kalman_filter.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "estimation/consistency.h"
#include "random_gaussian.h"
#include "support/expect_error.h"

namespace rex::kalman_filter_test {

using test::randomGaussian;
using test::randomModel;

double apart(const Gaussian& a, const Gaussian& b) {
  return (a.mean - b.mean).cwiseAbs().maxCoeff() + (a.covariance - b.covariance).cwiseAbs().maxCoeff();
}

NonlinearModel asFunction(const LinearModel& model, bool withJacobian) {
  NonlinearModel result{
      .g = [=](const Eigen::VectorXd& x) -> Eigen::VectorXd { return model.C * x + model.c; }, .W = model.W};
  if (withJacobian) result.jacobian = [=](const Eigen::VectorXd&) { return model.C; };
  return result;
}

// A linear problem: prior at time 0, a transition to each later time, an observation at each time.
struct Problem {
  Gaussian prior;
  std::vector<LinearModel> transitions, observations;
  std::vector<Eigen::VectorXd> y;
};

Problem randomProblem(int n, int m, int steps, Rng& rng) {
  Problem problem{randomGaussian(n, rng), {}, {}, {}};
  Eigen::VectorXd x = sample(problem.prior, rng);
  for (int t = 0; t < steps; ++t) {
    LinearModel move = randomModel(n, n, rng);
    move.C = move.C / 2 / std::sqrt(n) + .7 * Eigen::MatrixXd::Identity(n, n);
    if (t > 0) {
      x = move.C * x + sample({move.c, move.W}, rng);
      problem.transitions.push_back(move);
    }
    problem.observations.push_back(randomModel(m, n, rng));
    const LinearModel& see = problem.observations.back();
    problem.y.push_back(see.C * x + sample({see.c, see.W}, rng));
  }
  return problem;
}

// All beliefs at once, without any recursion: least squares over all states.
std::vector<Gaussian> batch(const Problem& problem) {
  const Eigen::Index n = problem.prior.mean.size(), T = static_cast<Eigen::Index>(problem.y.size());
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n * T, n * T);
  Eigen::VectorXd a = Eigen::VectorXd::Zero(n * T);
  const auto add = [&](const Eigen::MatrixXd& J, const Eigen::VectorXd& wanted, const Eigen::MatrixXd& W) {
    A += J.transpose() * W.inverse() * J;
    a += J.transpose() * W.inverse() * wanted;
  };
  for (Eigen::Index t = 0; t < T; ++t) {
    const auto k = static_cast<std::size_t>(t);
    const Eigen::Index m = problem.y[k].size();
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n * T);
    J.middleCols(t * n, n).setIdentity();
    if (t == 0) {
      add(J, problem.prior.mean, problem.prior.covariance);
    } else {
      J.middleCols((t - 1) * n, n) = -problem.transitions[k - 1].C;
      add(J, problem.transitions[k - 1].c, problem.transitions[k - 1].W);
    }
    J = Eigen::MatrixXd::Zero(m, n * T);
    J.middleCols(t * n, n) = problem.observations[k].C;
    add(J, problem.y[k] - problem.observations[k].c, problem.observations[k].W);
  }
  const Gaussian all = {A.inverse() * a, A.inverse()};
  std::vector<Gaussian> result;
  for (Eigen::Index t = 0; t < T; ++t)
    result.push_back({all.mean.segment(t * n, n), all.covariance.block(t * n, t * n, n, n)});
  return result;
}

TEST(KalmanFilter, AllFormsAgreeOnLinearProblems) {
  Rng rng(11);
  for (int round = 0; round < 30; ++round) {
    const int n = 1 + rng.index(4), m = 1 + rng.index(3);
    const Problem problem = randomProblem(n, m, 12, rng);
    Gaussian plain = problem.prior, extended = plain, numeric = plain, unscented = plain;
    CanonicalGaussian information = toCanonical(plain);
    RootGaussian root = toRoot(plain);
    for (std::size_t t = 0; t < problem.y.size(); ++t) {
      if (t > 0) {
        const LinearModel& move = problem.transitions[t - 1];
        plain = kalmanPredict(plain, move);
        information = informationPredict(information, move);
        root = rootPredict(root, move);
        extended = extendedPredict(extended, asFunction(move, true));
        numeric = extendedPredict(numeric, asFunction(move, false));
        unscented = unscentedPredict(unscented, asFunction(move, false));
      }
      const LinearModel& see = problem.observations[t];
      const KalmanUpdate update = kalmanUpdate(plain, see, problem.y[t]);
      const KalmanUpdate sigma = unscentedUpdate(unscented, asFunction(see, false), problem.y[t]);
      plain = update.belief;
      information = informationUpdate(information, see, problem.y[t]);
      root = rootUpdate(root, see, problem.y[t]);
      extended = extendedUpdate(extended, asFunction(see, true), problem.y[t]).belief;
      numeric = extendedUpdate(numeric, asFunction(see, false), problem.y[t]).belief;
      unscented = sigma.belief;
      EXPECT_LT(apart(plain, toNormal(information)), 1e-10);
      EXPECT_LT(apart(plain, toNormal(root)), 1e-10);
      EXPECT_LT(apart(plain, extended), 1e-10);
      EXPECT_LT(apart(plain, numeric), 1e-8) << "with Jacobians by differences";
      EXPECT_LT(apart(plain, unscented), 1e-10);
      EXPECT_NEAR(update.logLikelihood, sigma.logLikelihood, 1e-9);
      EXPECT_NEAR(update.squaredInnovation, sigma.squaredInnovation, 1e-9);
    }
    EXPECT_LT(apart(plain, batch(problem).back()), 1e-10) << "filtered is smoothed at the end";
  }
}

TEST(KalmanFilter, SmootherIsBatchLeastSquares) {
  Rng rng(12);
  for (int round = 0; round < 30; ++round) {
    const Problem problem = randomProblem(1 + rng.index(4), 1 + rng.index(3), 10, rng);
    std::vector<Gaussian> filtered;
    for (std::size_t t = 0; t < problem.y.size(); ++t) {
      const Gaussian predicted =
          t == 0 ? problem.prior : kalmanPredict(filtered.back(), problem.transitions[t - 1]);
      filtered.push_back(kalmanUpdate(predicted, problem.observations[t], problem.y[t]).belief);
    }
    const std::vector<Gaussian> together = batch(problem), later = smoothed(filtered, problem.transitions);
    for (std::size_t t = 0; t < together.size(); ++t) EXPECT_LT(apart(together[t], later[t]), 1e-10);
  }
}

TEST(KalmanFilter, LikelihoodIsThatOfTheObservation) {
  Rng rng(13);
  const Gaussian belief = randomGaussian(3, rng);
  const LinearModel see = randomModel(2, 3, rng);
  const Eigen::VectorXd y = rng.normalVector(2);
  const KalmanUpdate update = kalmanUpdate(belief, see, y);
  EXPECT_NEAR(update.logLikelihood, logDensity(propagated(belief, see.C, see.c, see.W), y), 1e-12);
}

// The information filter may start by knowing nothing.
TEST(KalmanFilter, InformationMayBeNone) {
  Rng rng(14);
  const LinearModel move = randomModel(2, 2, rng), first = randomModel(2, 2, rng),
                    second = randomModel(2, 2, rng);
  const Eigen::Vector2d y1 = rng.normalVector(2), y2 = rng.normalVector(2);
  CanonicalGaussian belief{Eigen::Vector2d::Zero(), Eigen::Matrix2d::Zero()};
  belief = informationUpdate(informationPredict(informationUpdate(belief, first, y1), move), second, y2);
  const Eigen::Matrix2d inverse = first.C.inverse();
  Gaussian plain{inverse * (y1 - first.c), inverse * first.W * inverse.transpose()};
  plain = kalmanUpdate(kalmanPredict(plain, move), second, y2).belief;
  EXPECT_LT(apart(plain, toNormal(belief)), 1e-8);
}

// Where variances differ by more than doubles have digits, the information filter keeps the more precise.
TEST(KalmanFilter, InformationKeepsWhatItKnows) {
  const auto number = [](double v) { return Eigen::MatrixXd::Constant(1, 1, v); };
  for (const double B : {1., 1e6, 1e12, 1e18}) {
    const CanonicalGaussian next =
        informationPredict({number(2 * B), number(B)}, {number(1), number(0), number(1)});
    EXPECT_NEAR(next.A(0, 0), 1 / (1 / B + 1), 1e-15);
    EXPECT_NEAR(next.a[0], 2 / (1 / B + 1), 1e-14);
  }
}

// The moments of a square of a normal number: 1 and 2.
TEST(KalmanFilter, UnscentedTransformSquares) {
  const NonlinearModel square{.g = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x.cwiseAbs2(); },
                              .W = Eigen::MatrixXd::Constant(1, 1, .01)};
  const Gaussian normal{Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)};
  const Gaussian squared = unscentedPredict(normal, square);
  EXPECT_NEAR(squared.mean[0], 1, 1e-12);
  EXPECT_NEAR(squared.covariance(0, 0), 2.01, 1e-12);
  EXPECT_REX_ERROR((void)unscentedPredict(normal, square, {.beta = 0, .kappa = -.5}),
                   "unscented transform with these options: covariance: found the eigenvalue -0.49");
}

// Two readings of the same number without noise contradict each other; rounding must not hide it.
TEST(KalmanFilter, RefusesReadingsWithoutNoiseThatRepeat) {
  Rng rng(16);
  for (int i = 0; i < 300; ++i) {
    const Gaussian belief{Eigen::Vector2d(0, 0), rng.uniform(.1, 2) * Eigen::Matrix2d::Identity()};
    const Eigen::Vector2d row = rng.normalVector(2);
    Eigen::MatrixXd C(2, 2);
    C << row.transpose(), rng.uniform(.5, 2) * row.transpose();
    const LinearModel see{C, Eigen::Vector2d(0, 0), Eigen::Matrix2d::Zero()};
    EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, Eigen::Vector2d(1, 1.1)),
                     "covariance of the innovation");
    EXPECT_REX_ERROR((void)rootUpdate(toRoot(belief), see, Eigen::Vector2d(1, 1.1)),
                     "covariance of the innovation");
  }
}

// A pendulum seen from the side: NEES must lie in its band over many runs, for both filters.
TEST(KalmanFilter, ExtendedAndUnscentedAreConsistent) {
  const double h = .05;
  const Eigen::Matrix2d Q = Eigen::Vector2d(1e-6, 1e-4).asDiagonal();
  const NonlinearModel move{.g = [=](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                              return Eigen::Vector2d(x[0] + h * x[1], x[1] - h * 9.81 * std::sin(x[0]));
                            },
                            .W = Q};
  const NonlinearModel see{.g = [](const Eigen::VectorXd& x) -> Eigen::VectorXd {
                             return Eigen::VectorXd::Constant(1, std::sin(x[0]));
                           },
                           .W = Eigen::MatrixXd::Constant(1, 1, .0025)};
  const int runs = 50, steps = 40;
  Rng rng(15);
  Eigen::VectorXd extended = Eigen::VectorXd::Zero(steps), unscented = extended;
  for (int run = 0; run < runs; ++run) {
    Gaussian a{Eigen::Vector2d(.4, 0), .0025 * Eigen::Matrix2d::Identity()}, b = a;
    Eigen::VectorXd x = sample(a, rng);
    for (int t = 0; t < steps; ++t) {
      x = move.g(x) + sample({Eigen::Vector2d::Zero(), Q}, rng);
      const Eigen::VectorXd y = see.g(x) + .05 * rng.normalVector(1);
      a = extendedUpdate(extendedPredict(a, move), see, y).belief;
      b = unscentedUpdate(unscentedPredict(b, move), see, y).belief;
      extended[t] += estimationErrorSquared(a, x) / runs;
      unscented[t] += estimationErrorSquared(b, x) / runs;
    }
  }
  const ConsistencyBand band = consistencyBand(runs, 2);
  const auto inside = [&](const Eigen::VectorXd& nees) {
    return ((nees.array() > band.lower) && (nees.array() < band.upper)).count();
  };
  EXPECT_GT(inside(extended), .8 * steps);
  EXPECT_GT(inside(unscented), .8 * steps);
}

TEST(KalmanFilter, ComparesAnglesTheShorterWay) {
  NonlinearModel compass{
      .g = [](const Eigen::VectorXd& x) { return x; },
      .W = Eigen::MatrixXd::Identity(1, 1),
      .difference = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
        return Eigen::VectorXd::Constant(1, std::remainder(a[0] - b[0], 2 * M_PI));
      }};
  const Gaussian belief{Eigen::VectorXd::Constant(1, 3.1), Eigen::MatrixXd::Identity(1, 1)};
  const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, -3.1);
  const double wanted = 3.1 + (M_PI - 3.1);
  EXPECT_NEAR(extendedUpdate(belief, compass, y).belief.mean[0], wanted, 1e-9);
  EXPECT_NEAR(unscentedUpdate(belief, compass, y).belief.mean[0], wanted, 1e-9);
}

TEST(KalmanFilter, SaysWhatIsWrong) {
  const Gaussian belief{Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  LinearModel see{Eigen::RowVector2d(1, 0), Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1)};
  const Eigen::VectorXd y = Eigen::VectorXd::Zero(1);
  EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, Eigen::Vector2d(0, 0)),
                   "observation: found a vector of size 2, wanted size 1");
  EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, Eigen::VectorXd::Constant(1, std::nan(""))),
                   "observation: number 0: found nan");
  const Gaussian wrong{Eigen::Vector2d(0, 0), -Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)kalmanUpdate(wrong, see, y), "covariance of the belief: found the eigenvalue -1");
  see.W(0, 0) = -1;
  EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, y),
                   "observation model: covariance of the noise: found the eigenvalue -1");
  see.W(0, 0) = 0;
  see.C.setZero();
  EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, y),
                   "covariance of the innovation: found the eigenvalue 0");
  EXPECT_REX_ERROR((void)rootUpdate(toRoot(belief), see, y),
                   "covariance of the innovation: found a singular matrix");
  EXPECT_REX_ERROR((void)informationUpdate(toCanonical(belief), see, y),
                   "observation model: covariance of the noise: found the eigenvalue 0");
  see.C = Eigen::RowVector3d(1, 0, 0);
  EXPECT_REX_ERROR((void)kalmanUpdate(belief, see, y),
                   "observation model: columns of the matrix: found a vector of size 3, wanted size 2");
  const LinearModel still{Eigen::Matrix2d::Zero(), Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)informationPredict(toCanonical(belief), still),
                   "transition: matrix: found rank 0, wanted an invertible matrix");
  const NonlinearModel none{};
  EXPECT_REX_ERROR((void)extendedPredict(belief, none), "model: found no function g");
  EXPECT_REX_ERROR((void)unscentedPredict(belief, none), "model: found no function g");
  const NonlinearModel same{
      .g = [](const Eigen::VectorXd& x) { return x; },
      .jacobian = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Identity(1, 2); },
      .W = Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)extendedPredict(belief, same),
                   "Jacobian of the model: found 1 rows, wanted 2, one for each value of the model");
  const NonlinearModel wrongDifference{
      .g = [](const Eigen::VectorXd& x) { return x; },
      .W = Eigen::Matrix2d::Identity(),
      .difference = [](const Eigen::VectorXd&, const Eigen::VectorXd&) -> Eigen::VectorXd {
        return Eigen::Vector2d(NAN, 0);
      }};
  EXPECT_REX_ERROR((void)extendedUpdate(belief, wrongDifference, Eigen::Vector2d(0, 0)),
                   "difference of values of the model: number 0: found nan");
  const Gaussian negative{Eigen::Vector2d(0, 0), -5 * Eigen::Matrix2d::Identity()};
  const LinearModel stay{Eigen::Matrix2d::Identity(), Eigen::Vector2d(0, 0), Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)smoothed(std::vector{belief, negative}, std::vector{stay}),
                   "covariance of the belief: found the eigenvalue -5");
  EXPECT_REX_ERROR((void)smoothed({}, std::vector{stay}),
                   "transitions between the beliefs: found a vector of size 1, wanted size 0");
  EXPECT_REX_ERROR((void)unscentedPredict(belief, same, {.alpha = 0}), "unscented transform: alpha: found 0");
  EXPECT_REX_ERROR((void)unscentedPredict(belief, same, {.kappa = -2}),
                   "unscented transform: kappa: found -2");
  EXPECT_REX_ERROR((void)unscentedPredict(belief, same, {.beta = NAN}),
                   "unscented transform: beta: found nan, wanted a finite number");
  const NonlinearModel lost{
      .g = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return x + Eigen::Vector2d(0, NAN); },
      .W = Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)extendedPredict(belief, lost), "value of the model: number 1: found nan");
  EXPECT_REX_ERROR((void)unscentedPredict(belief, lost), "value of the model: number 1: found nan");
  const Gaussian nowhere{Eigen::Vector2d(NAN, 0), Eigen::Matrix2d::Identity()};
  EXPECT_REX_ERROR((void)smoothed(std::vector{nowhere, nowhere}, std::vector{stay}),
                   "mean of the belief: number 0: found nan");
  EXPECT_REX_ERROR((void)informationPredict({nowhere.mean, nowhere.covariance}, stay),
                   "coefficient of the belief: number 0: found nan");
  RootGaussian root = toRoot(belief);
  root.mean[1] = NAN;
  EXPECT_REX_ERROR((void)rootPredict(root, still), "mean of the belief: number 1: found nan");
  root = toRoot(belief);
  root.L(0, 0) = INFINITY;
  EXPECT_REX_ERROR((void)rootPredict(root, still), "root of the belief: found entries that are not finite");
  EXPECT_REX_ERROR((void)smoothed(std::vector{belief, belief}, {}),
                   "transitions between the beliefs: found a vector of size 0, wanted size 1");
}

}  // namespace rex::kalman_filter_test
