#pragma once

namespace rex {

/// A joint's motion, or a part of it, in plain numbers for kernels. It leads from the pose of body `from`
/// to that of body `to`: X_W,to = X_W,from * X. The steps of a joint are consecutive, and all but the first
/// go from the body to itself. Poses are stored by columns as in rex::Pose: three of R, then p.
struct MotionStep {
  /// How X moves with x = ratio * q[qIndex] + offset:
  enum class Kind {
    kFixed,       ///< X = constant
    kHinge,       ///< X = constant + cos(x) first + sin(x) second
    kSlider,      ///< X = constant + x first
    kQuaternion,  ///< X = constant * R(q[qIndex] to q[qIndex + 3]) * first
  };
  static constexpr int kPoseSize = 12;

  Kind kind = Kind::kFixed;
  int from = 0, to = 0;
  int qIndex = 0;
  double ratio = 1, offset = 0;
  double constant[kPoseSize]{}, first[kPoseSize]{}, second[kPoseSize]{};
};

}  // namespace rex
