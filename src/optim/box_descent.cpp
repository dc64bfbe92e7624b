#include <cmath>

#include "optim/box_descent_internal.h"

namespace rex::internal {
namespace {

// One for coordinates that may move downhill, zero for those that a bound holds.
Eigen::VectorXd freeCoordinates(const Eigen::VectorXd& x, const Eigen::VectorXd& gradient,
                                const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  return 1 - ((x.array() <= low.array() && gradient.array() > 0) ||
              (x.array() >= high.array() && gradient.array() < 0))
                 .cast<double>();
}

// The inverse of second derivatives after a step that changed the gradient by `change`.
void updateInverse(Eigen::MatrixXd& H, const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
  const double product = step.dot(change);
  if (!(product > 1e-10 * step.norm() * change.norm())) return;
  const Eigen::VectorXd Hy = H * change;
  const double weight = (1 + change.dot(Hy) / product) / product;
  for (Eigen::Index i = 0; i < step.size(); ++i)
    for (Eigen::Index j = 0; j < step.size(); ++j)
      H(i, j) += weight * step[i] * step[j] - (Hy[i] * step[j] + step[i] * Hy[j]) / product;
}

}  // namespace

BoxMinimum minimizeInBox(const ValueAndGradient& f, const Eigen::VectorXd& start, const Eigen::VectorXd& low,
                         const Eigen::VectorXd& high, double tolerance, int maxEvaluations) {
  const Eigen::Index n = start.size();
  BoxMinimum best{.x = start.cwiseMax(low).cwiseMin(high), .evaluations = 1};
  Eigen::VectorXd gradient(n), nextGradient(n);
  best.value = f(best.x, gradient);
  Eigen::MatrixXd H;
  bool isFresh = true;
  while (best.evaluations < maxEvaluations) {
    const Eigen::VectorXd isFree = freeCoordinates(best.x, gradient, low, high);
    const Eigen::VectorXd downhill = -gradient.cwiseProduct(isFree);
    const double steepest = downhill.cwiseAbs().maxCoeff();
    if (!(steepest > tolerance)) break;
    // The first step goes a tenth of the box.
    if (isFresh) H = Eigen::MatrixXd::Identity(n, n) * (0.1 * (high - low).maxCoeff() / steepest);
    const Eigen::VectorXd newton = H * downhill;
    const Eigen::VectorXd direction = newton.cwiseProduct(isFree);
    bool isLower = false;
    for (double length = 1; !isLower && length > 1e-8 && best.evaluations < maxEvaluations; length /= 4) {
      const Eigen::VectorXd next = (best.x + length * direction).cwiseMax(low).cwiseMin(high);
      const double value = f(next, nextGradient);
      ++best.evaluations;
      isLower = value < best.value && value <= best.value + 1e-4 * gradient.dot(next - best.x);
      if (!isLower) continue;
      updateInverse(H, next - best.x, nextGradient - gradient);
      best.x = next;
      best.value = value;
      gradient.swap(nextGradient);
    }
    if (!isLower && isFresh) break;
    isFresh = !isLower;
  }
  return best;
}

}  // namespace rex::internal
