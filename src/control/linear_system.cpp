#include "control/linear_system.h"

#include <fmt/format.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "base/derivative_check.h"
#include "base/error.h"
#include "control/linear_system_internal.h"
#include "control/require_internal.h"

namespace rex::internal {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& M) { return M.exp(); }

}  // namespace rex::internal

namespace rex {

LinearSystem completed(const LinearSystem& system) {
  LinearSystem result = system;
  const Eigen::Index n = system.A.rows(), m = system.B.cols();
  if (n == 0) throw Error({.what = "linear system", .found = "no state"});
  requireSize("columns of A", system.A.cols(), n);
  requireSize("rows of B", system.B.rows(), n);
  if (system.C.size() == 0) result.C = Eigen::MatrixXd::Identity(n, n);
  requireSize("columns of C", result.C.cols(), n);
  if (system.D.size() == 0) result.D = Eigen::MatrixXd::Zero(result.C.rows(), m);
  requireSize("rows of D", result.D.rows(), result.C.rows());
  requireSize("columns of D", result.D.cols(), m);
  internal::requireFiniteMatrix("A", result.A);
  internal::requireFiniteMatrix("B", result.B);
  internal::requireFiniteMatrix("C", result.C);
  internal::requireFiniteMatrix("D", result.D);
  if (system.step) requirePositive("step of a linear system", *system.step);
  return result;
}

LinearSystem discretized(const LinearSystem& system, double step) {
  LinearSystem result = completed(system);
  if (system.step)
    throw Error({.what = "linear system", .found = "discrete time", .wanted = "continuous time"});
  requirePositive("step of a linear system", step);
  const Eigen::Index n = system.A.rows(), m = system.B.cols();
  // Next to a large B the exponential would lose digits of A: hence units of the controls that make B small.
  const double largest = m == 0 ? 0 : system.B.cwiseAbs().maxCoeff(), unit = largest > 0 ? largest : 1;
  Eigen::MatrixXd generator = Eigen::MatrixXd::Zero(n + m, n + m);
  generator.topLeftCorner(n, n) = step * system.A;
  generator.topRightCorner(n, m) = system.B / unit;
  const Eigen::MatrixXd motion = internal::exponential(generator);
  result.A = motion.topLeftCorner(n, n);
  result.B = unit * (step * motion.topRightCorner(n, m));
  if (!result.A.allFinite() || !result.B.allFinite())
    throw Error({.what = fmt::format("motion of the system in {:g} s", step),
                 .found = "numbers that are not finite",
                 .wanted = "a shorter step"});
  result.step = step;
  return result;
}

Linearization linearized(const ControlledMotion& f, const Eigen::VectorXd& x, const Eigen::VectorXd& u,
                         const MotionDerivative& exact) {
  if (!f) throw Error({.what = "motion", .found = "no function"});
  rex::requireFinite("state x", x);
  rex::requireFinite("control u", u);
  Linearization result{.A = {}, .B = {}, .value = f(x, u)};
  const Eigen::Index n = x.size(), m = u.size();
  requireSize("value of the motion", result.value.size(), n);
  rex::requireFinite("value of the motion", result.value);
  if (!exact) {
    result.A = numericJacobian([&](const Eigen::VectorXd& moved) { return f(moved, u); }, x);
    result.B = numericJacobian([&](const Eigen::VectorXd& moved) { return f(x, moved); }, u);
    return result;
  }
  MotionJacobians jacobians = exact(x, u);
  requireSize("rows of df/dx", jacobians.A.rows(), n);
  requireSize("columns of df/dx", jacobians.A.cols(), n);
  requireSize("rows of df/du", jacobians.B.rows(), n);
  requireSize("columns of df/du", jacobians.B.cols(), m);
  internal::requireFiniteMatrix("df/dx", jacobians.A);
  internal::requireFiniteMatrix("df/du", jacobians.B);
  result.A = std::move(jacobians.A);
  result.B = std::move(jacobians.B);
  return result;
}

}  // namespace rex
