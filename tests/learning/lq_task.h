#pragma once

#include <cmath>

#include "learning/linear_gaussian_policy.h"

namespace rex {

/// x' = A x + B a + w with w ~ N(0, W), reward -(x^T Q x + R a^2), features x: the one continuous task whose
/// returns and gradients are known. Start at x ~ N(mean, start).
struct LqTask {
  Eigen::Matrix2d A{{1, .1}, {-.1, .98}};
  Eigen::Vector2d B{.02, .1};
  Eigen::Matrix2d Q{{1, .2}, {.2, .5}};
  double R = .3;
  Eigen::Matrix2d W = 1e-3 * Eigen::Matrix2d::Identity();
  Eigen::Vector2d mean{1, -.5};
  Eigen::Matrix2d start = .2 * Eigen::Matrix2d::Identity();
  int horizon = 20;
  double discount = .95;
  double bonus = 0;  ///< added to each reward

  RolloutSource rollouts() const {
    ControlTask task;
    task.horizon = horizon;
    task.start = [*this](Rng& rng) -> Eigen::VectorXd {
      return mean + std::sqrt(start(0, 0)) * rng.normalVector(2);
    };
    task.features = [](const Eigen::VectorXd& x) { return x; };
    task.step = [*this](const Eigen::VectorXd& x, double a, Rng& rng) {
      const Eigen::VectorXd next = A * x + B * a + std::sqrt(W(0, 0)) * rng.normalVector(2);
      return ControlTask::Outcome{next, bonus - x.dot(Q * x) - R * a * a, false};
    };
    return rolloutSource(task);
  }

  /// The expected return without bonus, by the second moments of x over time.
  double expectedReturn(const Eigen::Vector2d& beta, const Eigen::Matrix2d& Sigma) const {
    Eigen::Matrix2d X = start + mean * mean.transpose();
    const Eigen::Matrix2d closed = A + B * beta.transpose();
    double sum = 0, weight = 1;
    for (int t = 0; t < horizon; ++t) {
      const double noise = (Sigma * X).trace();  // E (x^T epsilon)^2
      sum -= weight * ((Q * X).trace() + R * (beta.dot(X * beta) + noise));
      X = closed * X * closed.transpose() + B * B.transpose() * noise + W;
      weight *= discount;
    }
    return sum;
  }

  /// Its gradient by beta: adjoint P of the second moments, backwards.
  Eigen::Vector2d gradient(const Eigen::Vector2d& beta, const Eigen::Matrix2d& Sigma) const {
    const Eigen::Matrix2d closed = A + B * beta.transpose();
    std::vector<Eigen::Matrix2d> X{start + mean * mean.transpose()};
    for (int t = 0; t + 1 < horizon; ++t)
      X.push_back(closed * X.back() * closed.transpose() + B * B.transpose() * (Sigma * X.back()).trace() +
                  W);
    Eigen::Matrix2d P = Eigen::Matrix2d::Zero();  // the cost to go from t + 1 is x^T P x
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (int t = horizon - 1; t >= 0; --t) {
      const Eigen::Matrix2d& now = X[static_cast<std::size_t>(t)];
      gradient -= 2 * std::pow(discount, t) * (R * now * beta + discount * now * closed.transpose() * P * B);
      P = Q + R * (beta * beta.transpose() + Sigma) +
          discount * (closed.transpose() * P * closed + Sigma * B.dot(P * B));
    }
    return gradient;
  }
};

}  // namespace rex
