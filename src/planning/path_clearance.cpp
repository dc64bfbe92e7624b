#include "planning/path_clearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "collision/motion_clearance.h"

namespace rex {
namespace {

// The same posture in numbers to which the way from another is straight.
Eigen::VectorXd unrolled(const Space& space, const VectorArg& from, const VectorArg& to) {
  Eigen::VectorXd q = to;
  Eigen::Index i = 0;
  for (const SpacePart& part : space.parts()) {
    if (part.kind == SpacePart::Kind::kQuaternion) {
      if (from.segment<4>(i).dot(to.segment<4>(i)) < 0) q.segment<4>(i) *= -1;
    } else if (part.kind != SpacePart::Kind::kLine) {
      q[i] = from[i] + std::remainder(to[i] - from[i], 2 * std::numbers::pi);
    }
    i += sizeOf(part.kind);
  }
  return q;
}

}  // namespace

double pathClearance(const Model& model, const ContactModel& contacts, const Space& space,
                     const MatrixArg& path, double tolerance) {
  requireSize("postures of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no postures", .wanted = "at least one"});
  double least = motionClearance(model, contacts, path.col(0), path.col(0), tolerance);
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    const Eigen::VectorXd to = unrolled(space, path.col(k - 1), path.col(k));
    least = std::min(least, motionClearance(model, contacts, path.col(k - 1), to, tolerance));
  }
  return least;
}

}  // namespace rex
