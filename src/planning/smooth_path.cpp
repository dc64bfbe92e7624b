#include "planning/smooth_path.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/rng.h"
#include "planning/path_problem.h"

namespace rex {
namespace {

void requirePath(const PathProblem& problem, const MatrixArg& path) {
  requireSize("configurations of a path", path.rows(), problem.space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no configurations", .wanted = "at least one"});
}

Eigen::MatrixXd joined(const std::vector<Eigen::VectorXd>& points) {
  Eigen::MatrixXd path(points.front().size(), static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < path.cols(); ++k) path.col(k) = points[static_cast<std::size_t>(k)];
  return path;
}

// A point of a path, and on which of its segments it lies.
struct PathPoint {
  Eigen::Index segment;
  Eigen::VectorXd q;
};

PathPoint pointAt(const Space& space, const MatrixArg& path, double way) {
  Eigen::VectorXd q = path.col(path.cols() - 1);
  for (Eigen::Index k = 0; k + 1 < path.cols(); ++k) {
    const double length = space.distance(path.col(k), path.col(k + 1));
    if (way <= length && length > 0) {
      space.interpolate(path.col(k), path.col(k + 1), way / length, q);
      return {k, q};
    }
    way -= length;
  }
  return {std::max<Eigen::Index>(0, path.cols() - 2), q};
}

}  // namespace

Eigen::MatrixXd shortcut(const PathProblem& problem, const MatrixArg& path, int rounds, Rng& rng) {
  requirePath(problem, path);
  EdgeChecker edges(problem.space, problem.allValid, problem.resolution);
  Eigen::MatrixXd best = path;
  for (int i = 0; i < rounds; ++i) {
    const double length = pathLength(problem.space, best);
    double from = length * rng.uniform(), to = length * rng.uniform();
    if (from > to) std::swap(from, to);
    const PathPoint a = pointAt(problem.space, best, from), b = pointAt(problem.space, best, to);
    // The remaining pieces are new motions, too: they are checked at other points than the whole was.
    const bool isShort = a.segment == b.segment;
    if (isShort || !edges.isValid(a.q, b.q) || !edges.isValid(best.col(a.segment), a.q) ||
        !edges.isValid(b.q, best.col(b.segment + 1)))
      continue;
    Eigen::MatrixXd next(best.rows(), a.segment + 3 + best.cols() - b.segment - 1);
    next << best.leftCols(a.segment + 1), a.q, b.q, best.rightCols(best.cols() - b.segment - 1);
    if (pathLength(problem.space, next) < length) best = std::move(next);
  }
  return best;
}

Eigen::MatrixXd roundCorners(const PathProblem& problem, const MatrixArg& path, int rounds) {
  requirePath(problem, path);
  EdgeChecker edges(problem.space, problem.allValid, problem.resolution);
  Eigen::MatrixXd round = path;
  for (int i = 0; i < rounds; ++i) {
    std::vector<Eigen::VectorXd> points{round.col(0)};
    Eigen::VectorXd before(round.rows()), after(round.rows());
    for (Eigen::Index k = 1; k + 1 < round.cols(); ++k) {
      problem.space.interpolate(round.col(k - 1), round.col(k), .75, before);
      problem.space.interpolate(round.col(k), round.col(k + 1), .25, after);
      if (edges.isValid(before, after) && edges.isValid(points.back(), before) &&
          edges.isValid(after, round.col(k + 1))) {
        points.push_back(before);
        points.push_back(after);
      } else {
        points.push_back(round.col(k));
      }
    }
    points.push_back(round.col(round.cols() - 1));
    round = joined(points);
  }
  return round;
}

}  // namespace rex
