#include "dynamics/lagrange.h"

#include <algorithm>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

// The step size for functions that change over one unit; twice or half of it gives larger errors.
constexpr double kStep = 1. / 32;

// f'(0) by central differences of eighth order.
template <class Function>
double derivative(const Function& f, double step) {
  constexpr double kWeights[] = {4. / 5, -1. / 5, 4. / 105, -1. / 280};
  double sum = 0;
  for (int i = 0; i < 4; ++i) sum += kWeights[i] * (f((i + 1) * step) - f(-(i + 1) * step));
  return sum / step;
}

template <class Function>
double partialDerivative(const Function& f, Eigen::VectorXd at, Eigen::Index i) {
  const double x = at[i];
  return derivative(
      [&](double by) {
        at[i] = x + by;
        return f(at);
      },
      kStep);
}

}  // namespace

Eigen::VectorXd eulerLagrangeForce(const Lagrangian& L, const VectorArg& q, const VectorArg& v,
                                   const VectorArg& a) {
  requireSize("velocities v", v.size(), q.size());
  requireSize("accelerations a", a.size(), q.size());
  const auto value = [&](const Eigen::VectorXd& atQ, const Eigen::VectorXd& atV) {
    const double energy = L(atQ, atV);
    requireFinite("Lagrangian", energy);
    return energy;
  };
  // In that time neither q nor v changes by more than a step.
  const double speed = std::max({1., v.lpNorm<Eigen::Infinity>(), a.lpNorm<Eigen::Infinity>()});
  Eigen::VectorXd u(q.size());
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const auto momentum = [&](double t) {
      const Eigen::VectorXd atQ = q + t * v + t * t / 2 * a;
      return partialDerivative([&](const Eigen::VectorXd& atV) { return value(atQ, atV); }, v + t * a, i);
    };
    const double push = partialDerivative([&](const Eigen::VectorXd& atQ) { return value(atQ, v); }, q, i);
    u[i] = derivative(momentum, kStep / speed) - push;
  }
  return u;
}

EquationOfMotion equationOfMotion(const Lagrangian& L, const VectorArg& q, const VectorArg& v) {
  const Eigen::Index n = q.size();
  EquationOfMotion motion{Eigen::MatrixXd(n, n), eulerLagrangeForce(L, q, v, Eigen::VectorXd::Zero(n))};
  for (Eigen::Index i = 0; i < n; ++i)
    motion.M.col(i) = eulerLagrangeForce(L, q, v, Eigen::VectorXd::Unit(n, i)) - motion.F;
  return motion;
}

}  // namespace rex
