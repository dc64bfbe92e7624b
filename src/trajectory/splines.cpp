#include "trajectory/splines.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
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

namespace {

void requireSound(const VectorArg& times, const MatrixArg& points, const SplineEnds& ends) {
  requireSize("times of a spline", times.size(), points.cols());
  requireCount("points of a spline", times.size(), 2);
  requireFinite("times of a spline", times);
  requireFinite("points of a spline", Eigen::VectorXd(points.reshaped()));
  for (Eigen::Index i = 1; i < times.size(); ++i)
    if (!(times[i] > times[i - 1]))
      throw Error({.what = fmt::format("times of a spline: number {}", i),
                   .found = fmt::format("{:g} after {:g}", times[i], times[i - 1]),
                   .wanted = "a later one"});
  for (const auto& velocity : {ends.startVelocity, ends.endVelocity}) {
    if (!velocity) continue;
    requireSize("velocity at an end of a spline", velocity->size(), points.rows());
    requireFinite("velocity at an end of a spline", *velocity);
  }
}

// Row i: lower v_{i-1} + diagonal v_i + upper v_{i+1} = right (n numbers).
struct Tridiagonal {
  Eigen::VectorXd lower, diagonal, upper;
  Eigen::MatrixXd right;  // n x N

  // Thomas; stable, because the diagonal is larger than the others together.
  Eigen::MatrixXd solve() {
    const Eigen::Index N = diagonal.size();
    for (Eigen::Index i = 1; i < N; ++i) {
      const double factor = lower[i] / diagonal[i - 1];
      diagonal[i] -= factor * upper[i - 1];
      right.col(i) -= factor * right.col(i - 1);
    }
    right.col(N - 1) /= diagonal[N - 1];
    for (Eigen::Index i = N - 2; i >= 0; --i)
      right.col(i) = (right.col(i) - upper[i] * right.col(i + 1)) / diagonal[i];
    return right;
  }
};

}  // namespace

// Accelerations on both sides of each point agree; those of a natural end are zero.
CubicSpline::CubicSpline(const VectorArg& times, const MatrixArg& points, const SplineEnds& ends)
    : times_(times), points_(points) {
  requireSound(times, points, ends);
  const Eigen::Index N = times.size();
  const Eigen::VectorXd h = times.tail(N - 1) - times.head(N - 1);
  Tridiagonal rows{Eigen::VectorXd::Zero(N), Eigen::VectorXd::Ones(N), Eigen::VectorXd::Zero(N),
                   Eigen::MatrixXd::Zero(points.rows(), N)};
  const auto slope = [&](Eigen::Index i) -> Eigen::VectorXd {
    return (points.col(i + 1) - points.col(i)) / h[i];
  };
  for (Eigen::Index i = 1; i + 1 < N; ++i) {
    rows.lower[i] = 1 / h[i - 1];
    rows.upper[i] = 1 / h[i];
    rows.diagonal[i] = 2 * (rows.lower[i] + rows.upper[i]);
    rows.right.col(i) = 3 * (slope(i - 1) / h[i - 1] + slope(i) / h[i]);
  }
  if (ends.startVelocity) {
    rows.right.col(0) = *ends.startVelocity;
  } else {
    rows.diagonal[0] = 2, rows.upper[0] = 1;
    rows.right.col(0) = 3 * slope(0);
  }
  if (ends.endVelocity) {
    rows.right.col(N - 1) = *ends.endVelocity;
  } else {
    rows.diagonal[N - 1] = 2, rows.lower[N - 1] = 1;
    rows.right.col(N - 1) = 3 * slope(N - 2);
  }
  velocities_ = rows.solve();
}

// Each piece in Newton's form: its two ends, each with position and velocity.
Eigen::VectorXd CubicSpline::value(double t, int derivative) const {
  requireFinite("time on a spline", t);
  if (derivative < 0 || derivative > 3)
    throw Error(
        {.what = "derivative of a cubic spline", .found = fmt::format("{}", derivative), .wanted = "0 to 3"});
  const auto after = std::upper_bound(times_.begin() + 1, times_.end() - 1, t);
  const Eigen::Index i = after - times_.begin() - 1;
  const double h = times_[i + 1] - times_[i], s = t - times_[i];
  const Eigen::VectorXd v = velocities_.col(i), mean = (points_.col(i + 1) - points_.col(i)) / h;
  const Eigen::VectorXd a = (3 * mean - 2 * v - velocities_.col(i + 1)) / h;
  const Eigen::VectorXd b = (v + velocities_.col(i + 1) - 2 * mean) / (h * h);
  switch (derivative) {
    case 0:
      return points_.col(i) + s * (v + s * (a + s * b));
    case 1:
      return v + s * (2 * a + 3 * s * b);
    case 2:
      return 2 * a + 6 * s * b;
    default:
      return 6 * b;
  }
}

}  // namespace rex
