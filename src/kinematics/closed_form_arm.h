#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/model.h"

namespace rex {

struct ClosedFormOptions {
  /// Postures beyond the limits are left out; an angle is moved by full turns if that leads within them.
  bool withinLimits = true;
  /// Each posture is also listed with angles moved by full turns, as far as the limits of joints allow.
  /// Joints without limits are not moved.
  bool listsTurns = false;
};

struct ClosedFormPosture {
  Eigen::VectorXd q{};  ///< nq
  /// A singular posture: a line of postures leads to the same pose. The angle of this joint is that of the
  /// reference, or one of 31 others if that is out of reach, and the rest follow from it.
  JointId chosen = kNoJoint;
};

/// Inverse kinematics in closed form (Pieper 1968) of an arm of six hinges whose last or first three axes
/// meet in a point, or in which three neighbouring axes, the second to fourth or the third to fifth, are
/// parallel. The axes decide, to 1e-9 of their lengths, not names.
class ClosedFormArm {
 public:
  enum class Kind { kWrist, kParallel };

  /// The arm that moves `tip` relative to the world; empty, with the reason in `why`, if it is none of these:
  /// not six joints, others than hinges, a joint that mimics, or other axes. Throws Error for a missing body.
  static std::optional<ClosedFormArm> of(const Model& model, BodyId tip, std::string* why = nullptr);

  Kind kind() const { return kind_; }
  /// The six joints, from the world to the tip.
  const std::array<JointId, 6>& joints() const { return joints_; }

  /// All postures with the tip at X_WT, to 1e-10 in metres and radians relative to the arm's size: up to
  /// eight, where a line of them has one representative, with `chosen`. Joints that do not move
  /// the tip keep their positions in `reference` (nq). Two postures within 1e-6 rad of each other, as at the
  /// limits of reach, are one. Throws Error for a reference of another size, and a pose that is not finite or
  /// whose R is not a rotation.
  [[nodiscard]] std::vector<ClosedFormPosture> postures(const Pose& X_WT, const VectorArg& reference,
                                                        const ClosedFormOptions& options = {}) const;

 private:
  using Axes = std::array<Eigen::Vector3d, 6>;
  struct Angles6 {
    std::array<double, 6> angle{};
    int chosen = -1;
  };

  ClosedFormArm() = default;
  void orient(const Axes& axes, const Axes& points, bool isReversed);
  bool meetAtEnd();
  bool areParallelInTheMiddle();
  void addByWrist(const Pose& X, const Angles6& reference, std::vector<Angles6>& found) const;
  void addWrists(const Eigen::Matrix3d& R, Angles6 arm, const Angles6& reference,
                 std::vector<Angles6>& found) const;
  void addByParallels(const Pose& X, const Angles6& reference, std::vector<Angles6>& found) const;
  void addElbows(const Pose& X, Angles6 arm, const Angles6& reference, std::vector<Angles6>& found) const;
  void addPlanarTriples(const Pose& X, const Angles6& arm, const Angles6& reference,
                        std::vector<Angles6>& found) const;
  bool polish(const Pose& X, Angles6& arm) const;
  void addTurns(ClosedFormPosture& posture, const Angles6& arm, std::size_t i,
                const ClosedFormOptions& options, std::vector<ClosedFormPosture>& result) const;
  std::pair<double, double> turnsWithin(std::size_t joint, double angle) const;

  Kind kind_ = Kind::kWrist;
  bool isReversed_ = false;  ///< the axes below are those of the arm from its tip to the world
  std::array<JointId, 6> joints_{};
  std::array<int, 6> qIndex_{};
  std::array<double, 6> lower_{}, upper_{};
  Pose X_WT0_;       ///< where all six are zero
  Axes axis_, at_;   ///< directions, and a point of each, where all are zero
  double size_ = 0;  ///< metres
  int nq_ = 0;
};

}  // namespace rex
