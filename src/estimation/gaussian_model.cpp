#include "estimation/gaussian_model.h"

#include <string>

#include <fmt/format.h>

#include "base/derivative_check.h"
#include "base/error.h"
#include "base/require.h"
#include "estimation/covariance.h"

namespace rex {

void requireModel(const char* what, const LinearModel& model, Eigen::Index n) {
  const std::string name(what);
  requireSize(name + ": columns of the matrix", model.C.cols(), n);
  requireSize(name + ": offset", model.c.size(), model.C.rows());
  requireFinite(name + ": offset", model.c);
  if (!model.C.allFinite()) throw Error({.what = name + ": matrix", .found = "entries that are not finite"});
  requireCovariance(name + ": covariance of the noise", model.W, model.C.rows());
}

Eigen::VectorXd difference(const NonlinearModel& model, const Eigen::VectorXd& y1,
                           const Eigen::VectorXd& y2) {
  requireSize("value of the model", y1.size(), y2.size());
  const Eigen::VectorXd result = model.difference ? model.difference(y1, y2) : Eigen::VectorXd(y1 - y2);
  requireSize("difference of values of the model", result.size(), y2.size());
  requireFinite("difference of values of the model", result);
  return result;
}

LinearModel linearized(const NonlinearModel& model, const VectorArg& x) {
  if (!model.g) throw Error({.what = "model", .found = "no function g"});
  const Eigen::VectorXd point = x, value = model.g(point);
  requireFinite("value of the model", value);
  LinearModel tangent;
  if (model.jacobian) {
    tangent.C = model.jacobian(point);
  } else {
    // Differences to the value here are small, so that angles cannot jump.
    tangent.C = numericJacobian(
        [&](const Eigen::VectorXd& at) -> Eigen::VectorXd { return difference(model, model.g(at), value); },
        point);
  }
  if (tangent.C.rows() != value.size())
    throw Error({.what = "Jacobian of the model",
                 .found = fmt::format("{} rows", tangent.C.rows()),
                 .wanted = fmt::format("{}, one for each value of the model", value.size())});
  requireSize("columns of the Jacobian of the model", tangent.C.cols(), x.size());
  tangent.c = value - tangent.C * x;
  tangent.W = model.W;
  requireModel("model", tangent, x.size());
  return tangent;
}

}  // namespace rex
