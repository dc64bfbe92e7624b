#include "learning/inverse_rl.h"

#include <algorithm>
#include <vector>

#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "learning/dynamic_programming.h"

namespace rex {
namespace {

void requireStateFeatures(const MatrixArg& features) {
  if (features.size() == 0)
    throw Error({.what = "features",
                 .found = fmt::format("{} x {}", features.rows(), features.cols()),
                 .wanted = "one column for each state"});
  for (Eigen::Index s = 0; s < features.cols(); ++s)
    if (!features.col(s).allFinite())
      throw Error({.what = fmt::format("features of state {}", s), .found = "entries that are not finite"});
}

void require(const Mdp& mdp, const MatrixArg& features, const VectorArg& teacher,
             const InverseRlOptions& options) {
  requireMdp(mdp);
  if (mdp.discount == 1)
    throw Error({.what = "discount of inverse learning", .found = "1", .wanted = "less than 1"});
  requireStateFeatures(features);
  requireSize("expectations of the teacher", teacher.size(), features.rows());
  requireFinite("expectations of the teacher", teacher);
  requirePositive("tolerance of inverse learning", options.tolerance);
  requireCount("maxIterations of inverse learning", options.maxIterations, 1);
}

// The best policy where being in s pays w^T phi(s).
Eigen::MatrixXd bestUnder(Mdp mdp, const MatrixArg& features, const Eigen::VectorXd& w) {
  mdp.rewards.colwise() = features.transpose() * w;
  return deterministicPolicy(mdp, policyIteration(mdp).actions);
}

Eigen::MatrixXd asColumns(const std::vector<Eigen::VectorXd>& columns) {
  Eigen::MatrixXd matrix(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

}  // namespace

Eigen::VectorXd featureExpectations(const Mdp& mdp, const MatrixArg& policy, const MatrixArg& features,
                                    const VectorArg& start) {
  requireStateFeatures(features);
  requireSize("columns of the features, one for each state", features.cols(), mdp.states());
  return features * discountedVisits(mdp, policy, start);
}

Eigen::VectorXd featureExpectations(const std::vector<std::vector<int>>& demonstrations,
                                    const MatrixArg& features, double discount) {
  requireStateFeatures(features);
  if (!(discount >= 0 && discount <= 1))
    throw Error({.what = "discount", .found = fmt::format("{:g}", discount), .wanted = "a number in [0, 1]"});
  if (demonstrations.empty()) throw Error({.what = "demonstrations", .found = "none"});
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(features.rows());
  for (std::size_t i = 0; i < demonstrations.size(); ++i) {
    double weight = 1;
    for (const int s : demonstrations[i]) {
      if (s < 0 || s >= features.cols())
        throw Error({.what = fmt::format("state of demonstration {}", i),
                     .found = fmt::format("{}", s),
                     .wanted = fmt::format("one of 0 to {}", features.cols() - 1)});
      sum += weight * features.col(s);
      weight *= discount;
    }
  }
  return sum / static_cast<double>(demonstrations.size());
}

InverseRlResult inverseRl(const Mdp& mdp, const MatrixArg& features, const VectorArg& start,
                          const VectorArg& teacher, const InverseRlOptions& options) {
  require(mdp, features, teacher, options);
  InverseRlResult result;
  result.policies = {uniformPolicy(mdp)};
  result.w = Eigen::VectorXd::Zero(teacher.size());
  std::vector<Eigen::VectorXd> candidates{featureExpectations(mdp, result.policies.back(), features, start)};
  const double tolerance = options.tolerance * teacher.norm();
  for (int i = 0; i < options.maxIterations; ++i) {
    const MarginResult margin = maxMargin(teacher, asColumns(candidates));
    result.margins.push_back(margin.margin);
    result.shares = margin.shares;
    result.expectations = asColumns(candidates) * margin.shares;
    // Not the margin: it is too small for a point of the hull that is not yet the nearest one.
    if ((teacher - result.expectations).norm() <= tolerance) {
      result.status = InverseRlStatus::kMatched;
      break;
    }
    result.w = margin.w;
    const Eigen::MatrixXd policy = bestUnder(mdp, features, margin.w);
    const Eigen::VectorXd expectations = featureExpectations(mdp, policy, features, start);
    // If the best policy under w is no better than the mixture, w sets the teacher apart from all policies.
    if (margin.w.dot(expectations - result.expectations) <= .5 * tolerance) {
      result.status = InverseRlStatus::kUnmatched;
      break;
    }
    result.policies.push_back(policy);
    candidates.push_back(expectations);
  }
  result.shares.conservativeResizeLike(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(candidates.size())));
  constexpr const char* kWords[] = {"the teacher is matched", "no policy matches the teacher",
                                    "not converged"};
  result.message = fmt::format("{}: margin {:.3g} with {} policies", kWords[static_cast<int>(result.status)],
                               result.margins.back(), candidates.size());
  return result;
}

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
