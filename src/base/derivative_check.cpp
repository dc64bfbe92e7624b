#include "base/derivative_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"

namespace rex {
namespace {

Eigen::VectorXd evaluate(const VectorFunction& f, const Eigen::VectorXd& x, Eigen::Index size) {
  Eigen::VectorXd y = f(x);
  if (size >= 0) requireSize("value of the function to differentiate", y.size(), size);
  if (!y.allFinite()) {
    throw Error({.what = "value of the function to differentiate",
                 .found = "a number that is not finite",
                 .wanted = "finite numbers"});
  }
  return y;
}

}  // namespace

Eigen::MatrixXd numericJacobian(const VectorFunction& f, const Eigen::VectorXd& x, double step) {
  const Eigen::Index rows = evaluate(f, x, -1).size();
  Eigen::MatrixXd J(rows, x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const auto central = [&](double h) -> Eigen::VectorXd {
      Eigen::VectorXd ahead = x, behind = x;
      ahead[i] += h;
      behind[i] -= h;
      // Divided by the step actually taken, which differs from 2 h by rounding.
      return (evaluate(f, ahead, rows) - evaluate(f, behind, rows)) / (ahead[i] - behind[i]);
    };
    const double h = step * std::max(1., std::abs(x[i]));
    // The error of central differences is c h^2 + O(h^4): two steps cancel c.
    J.col(i) = (4 * central(h / 2) - central(h)) / 3;
  }
  return J;
}

JacobianCheck checkJacobian(const VectorFunction& f, const Eigen::MatrixXd& J, const Eigen::VectorXd& x,
                            double tolerance) {
  const Eigen::MatrixXd numeric = numericJacobian(f, x);
  JacobianCheck check;
  if (J.rows() != numeric.rows() || J.cols() != numeric.cols()) {
    check.message = fmt::format("the Jacobian is {} x {}, wanted {} x {}", J.rows(), J.cols(), numeric.rows(),
                                numeric.cols());
    return check;
  }
  check.ok = true;
  check.error = -1;
  for (int row = 0; row < J.rows(); ++row) {
    for (int column = 0; column < J.cols(); ++column) {
      const double wanted = numeric(row, column), got = J(row, column);
      double error = std::abs(got - wanted) / std::max(1., std::abs(wanted));
      if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
      check.ok = check.ok && error <= tolerance;
      if (error > check.error) {
        check.error = error;
        check.row = row, check.column = column;
        check.given = got, check.numeric = wanted;
      }
    }
  }
  check.error = std::max(check.error, 0.);
  check.message =
      check.ok ? fmt::format("the Jacobian agrees with finite differences within {:.1e}", check.error)
               : fmt::format(
                     "entry ({}, {}) of the Jacobian is {:.6g}, finite differences give {:.6g} (rows and "
                     "columns count from 0)",
                     check.row, check.column, check.given, check.numeric);
  return check;
}

}  // namespace rex
