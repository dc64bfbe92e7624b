#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "scene/model.h"

namespace rex {

class Rng;

/// A part of a configuration space, one or four numbers of a configuration.
struct SpacePart {
  enum class Kind {
    kLine,       ///< a number x; distance |x - y|
    kCircle,     ///< an angle; distance the shorter way round, at most pi (slide 4:59 b)
    kChord,      ///< an angle; distance between the points of the unit circle, at most 2 (slide 4:59 a)
    kQuaternion  ///< a unit quaternion w, x, y, z; distance min(|r - s|, |r + s|) (slide 4:59)
  };
  Kind kind = Kind::kLine;
  double lower = -1,
         upper = 1;   ///< bounds of lines, for samples; angles and quaternions are not bounded
  double weight = 1;  ///< > 0; factor for the distances of this part
};

/// A configuration space with its metric and interpolation. The distance is the root of the sum of squares
/// of the parts' weighted distances. All functions throw Error for vectors of the wrong size.
class Space {
 public:
  /// Throws Error naming the part for bounds that are not finite or not in order, and weights that are not
  /// positive.
  explicit Space(std::vector<SpacePart> parts);
  /// R^n between bounds; SE(2) as x, y, heading; SE(3) as x, y, z, quaternion.
  static Space box(const VectorArg& lower, const VectorArg& upper);
  static Space se2(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper, double headingWeight = 1);
  static Space se3(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double rotationWeight = 1);

  int size() const { return size_; }
  std::span<const SpacePart> parts() const { return parts_; }

  [[nodiscard]] double distance(const VectorArg& a, const VectorArg& b) const;
  /// The length of the path from a to b that interpolate() follows. It exceeds distance() if that cuts
  /// through the circle or the sphere.
  [[nodiscard]] double wayLength(const VectorArg& a, const VectorArg& b) const;
  /// The configuration at the fraction t from a (0) to b (1): along a straight line, the shorter way round
  /// a circle, and by a rotation about one axis.
  void interpolate(const VectorArg& a, const VectorArg& b, double t, Eigen::Ref<Eigen::VectorXd> out) const;
  /// Draws a uniform configuration within the bounds.
  void sample(Rng& rng, Eigen::Ref<Eigen::VectorXd> out) const;
  /// Throws Error for a configuration that has a wrong size, is not finite, is not a rotation, or leaves the
  /// bounds, saying which number and by how much; `what` names it.
  void require(std::string_view what, const VectorArg& q) const;

 private:
  std::vector<SpacePart> parts_;
  int size_ = 0;
};

/// The same postures, one per column, without jumps: each angle is at most half a turn from the previous
/// one, and each quaternion has the sign nearer to the previous one. Throws Error for columns of the wrong
/// size.
[[nodiscard]] Eigen::MatrixXd unrolled(const Space& space, Eigen::MatrixXd path);

/// The number of coordinates of a part.
[[nodiscard]] constexpr int coordinateCount(SpacePart::Kind kind) {
  return kind == SpacePart::Kind::kQuaternion ? 4 : 1;
}

}  // namespace rex
