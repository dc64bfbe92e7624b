#include "learning/max_margin.h"

#include <algorithm>
#include <vector>

#include <Eigen/QR>

#include "base/error.h"
#include "base/require.h"

namespace rex {
namespace {

// A corner whose share would be smaller is not added, so that none enters and leaves for ever.
constexpr double kLeastShare = 1e-15;

// The point of the plane through some corners that is nearest to the origin, as shares of the corners, which
// may be negative. Subtracting the first corner makes it a plain least-squares problem.
Eigen::VectorXd nearestOfPlane(const Eigen::MatrixXd& points, const std::vector<int>& corners) {
  const auto count = static_cast<Eigen::Index>(corners.size());
  Eigen::VectorXd shares = Eigen::VectorXd::Ones(count);
  if (count == 1) return shares;
  const Eigen::VectorXd first = points.col(corners.front());
  Eigen::MatrixXd edges(points.rows(), count - 1);
  for (Eigen::Index i = 1; i < count; ++i)
    edges.col(i - 1) = points.col(corners[static_cast<std::size_t>(i)]) - first;
  const Eigen::VectorXd towardsOrigin = -first, others = edges.colPivHouseholderQr().solve(towardsOrigin);
  shares << 1 - others.sum(), others;
  return shares;
}

// Wolfe's active set: the corners of the hull of `points` whose own hull holds the point nearest to the
// origin.
class NearestPoint {
 public:
  explicit NearestPoint(const Eigen::MatrixXd& points) : points_(points) {
    int first = 0;
    points.colwise().squaredNorm().minCoeff(&first);
    corners_ = {first};
    shares_ = Eigen::VectorXd::Ones(1);
    scale_ = points.colwise().norm().maxCoeff();
  }

  // Adds the corner that lies farthest on the side of the origin; false if there is none.
  bool grow() {
    const Eigen::VectorXd x = point();
    int best = 0;
    const double lowest = (x.transpose() * points_).minCoeff(&best);
    const bool isKnown = std::find(corners_.begin(), corners_.end(), best) != corners_.end();
    if (isKnown || lowest >= x.squaredNorm() - 1e-13 * scale_ * scale_ || x.norm() <= 1e-13 * scale_)
      return false;
    corners_.push_back(best);
    shares_.conservativeResize(shares_.size() + 1);
    shares_[shares_.size() - 1] = 0;
    return true;
  }

  // Moves to the nearest point of the plane through the corners, dropping those that would have negative
  // shares.
  void settle() {
    for (;;) {
      const Eigen::VectorXd wanted = nearestOfPlane(points_, corners_);
      if (wanted.minCoeff() > kLeastShare) {
        shares_ = wanted;
        return;
      }
      double way = 1;
      Eigen::Index first = 0;
      for (Eigen::Index i = 0; i < wanted.size(); ++i) {
        if (wanted[i] > kLeastShare) continue;
        const double until = wanted[i] < shares_[i] ? shares_[i] / (shares_[i] - wanted[i]) : 0;
        if (until <= way) {
          way = until;
          first = i;
        }
      }
      shares_ += way * (wanted - shares_);
      leaveOut(first);
    }
  }

  Eigen::VectorXd point() const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(points_.rows());
    for (std::size_t i = 0; i < corners_.size(); ++i)
      x += shares_[static_cast<Eigen::Index>(i)] * points_.col(corners_[i]);
    return x;
  }

  Eigen::VectorXd shares() const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(points_.cols());
    for (std::size_t i = 0; i < corners_.size(); ++i)
      all[corners_[i]] = shares_[static_cast<Eigen::Index>(i)];
    return all;
  }

  double scale() const { return scale_; }

 private:
  void leaveOut(Eigen::Index i) {
    corners_.erase(corners_.begin() + i);
    const Eigen::Index after = shares_.size() - i - 1;
    shares_.segment(i, after) = shares_.tail(after).eval();
    shares_.conservativeResize(shares_.size() - 1);
  }

  const Eigen::MatrixXd& points_;
  std::vector<int> corners_{};
  Eigen::VectorXd shares_{};
  double scale_ = 0;
};

}  // namespace

MarginResult maxMargin(const VectorArg& teacher, const MatrixArg& candidates, int maxIterations) {
  requireFinite("teacher", teacher);
  if (candidates.cols() == 0) throw Error({.what = "candidates", .found = "none"});
  requireSize("rows of the candidates", candidates.rows(), teacher.size());
  requireFinite("candidates", Eigen::VectorXd(candidates.reshaped()));
  const Eigen::MatrixXd points = candidates.colwise() - teacher;
  NearestPoint nearest(points);
  MarginResult result;
  while (!result.converged && result.iterations < maxIterations) {
    result.converged = !nearest.grow();
    if (!result.converged) nearest.settle();
    ++result.iterations;
  }
  result.shares = nearest.shares();
  const Eigen::VectorXd x = nearest.point();
  result.w = Eigen::VectorXd::Zero(teacher.size());
  if (x.norm() <= 1e-12 * nearest.scale()) return result;
  result.w = -x.normalized();
  result.margin = -(result.w.transpose() * points).maxCoeff();
  return result;
}

}  // namespace rex
