#include "trajectory/b_spline.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/require.h"

namespace rex {

BSpline::BSpline(const Eigen::MatrixXd& control, int degree, double duration)
    : control_(control), degree_(degree), duration_(duration) {
  requireCount("degree of a B-spline", degree, 0);
  requireCount(fmt::format("control points of a B-spline of degree {}", degree), control.cols(), degree + 1);
  requireFinite("control points of a B-spline", Eigen::VectorXd(control.reshaped()));
  requirePositive("duration of a B-spline", duration, kSeconds);
}

// Knots 0 ... N + p: the first p + 1 are at 0, the last at the end.
double BSpline::knot(Eigen::Index i) const {
  const Eigen::Index spans = control_.cols() - degree_;
  const Eigen::Index k = std::clamp<Eigen::Index>(i - degree_, 0, spans);
  return duration_ * static_cast<double>(k) / static_cast<double>(spans);
}

// De Boor: mixes the p + 1 control points of a span until one is left.
Eigen::VectorXd BSpline::value(double t) const {
  requireFinite("time on a spline", t);
  t = std::clamp(t, 0., duration_);
  const Eigen::Index spans = control_.cols() - degree_;
  const auto way = static_cast<Eigen::Index>(t / duration_ * static_cast<double>(spans));
  const Eigen::Index span = std::min(way, spans - 1);
  Eigen::MatrixXd points = control_.middleCols(span, degree_ + 1);
  for (int level = 1; level <= degree_; ++level) {
    for (int j = degree_; j >= level; --j) {
      const double left = knot(span + j), right = knot(span + j + 1 + degree_ - level);
      const double share = (t - left) / (right - left);
      points.col(j) = (1 - share) * points.col(j - 1) + share * points.col(j);
    }
  }
  return points.col(degree_);
}

BSpline BSpline::derivative() const {
  if (degree_ == 0) return {Eigen::MatrixXd::Zero(control_.rows(), control_.cols()), 0, duration_};
  Eigen::MatrixXd differences(control_.rows(), control_.cols() - 1);
  for (Eigen::Index i = 0; i < differences.cols(); ++i)
    differences.col(i) =
        degree_ / (knot(i + degree_ + 1) - knot(i + 1)) * (control_.col(i + 1) - control_.col(i));
  return {differences, degree_ - 1, duration_};
}

}  // namespace rex
