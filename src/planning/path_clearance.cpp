#include "planning/path_clearance.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace rex {
namespace {

// The number of pieces that a motion is cut into, so that no ball joint turns by more than 0.05 rad in any of
// them: then the chord of the quaternions, which a straight motion follows, and their arc nearly coincide at
// any time.
int piecesOf(const Space& space, const VectorArg& from, const VectorArg& to) {
  constexpr double kTurn = 0.05;
  double longest = 0;
  Eigen::Index i = 0;
  for (const SpacePart& part : space.parts()) {
    if (part.kind == SpacePart::Kind::kQuaternion) {
      const double cosine = std::abs(from.segment<4>(i).dot(to.segment<4>(i)));
      longest = std::max(longest, 2 * std::acos(std::min(1., cosine)));
    }
    i += sizeOf(part.kind);
  }
  return std::max(1, static_cast<int>(std::ceil(longest / kTurn)));
}

}  // namespace

ClearanceBounds pathClearance(const Model& model, const ContactModel& contacts, const Space& space,
                              const MatrixArg& path, double tolerance) {
  requireSize("postures of a path", path.rows(), space.size());
  if (path.cols() == 0) throw Error({.what = "path", .found = "no postures", .wanted = "at least one"});
  ClearanceBounds least = clearanceBounds(model, contacts, path.col(0), path.col(0), tolerance);
  const Eigen::MatrixXd postures = unrolled(space, path);
  Eigen::VectorXd from = postures.col(0), to = from;
  for (Eigen::Index k = 1; k < postures.cols(); ++k) {
    const auto start = postures.col(k - 1), end = postures.col(k);
    const int pieces = piecesOf(space, start, end);
    for (int i = 1; i <= pieces; ++i, from = to) {
      if (i < pieces)
        space.interpolate(start, end, static_cast<double>(i) / pieces, to);
      else
        to = end;
      const ClearanceBounds piece = clearanceBounds(model, contacts, from, to, tolerance);
      least = {std::min(least.atLeast, piece.atLeast), std::min(least.atMost, piece.atMost)};
    }
  }
  return least;
}

}  // namespace rex
