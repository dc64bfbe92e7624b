#pragma once

#include <span>

#include "kinematics/lane_blocks.h"
#include "scene/model.h"

namespace rex {

/// World poses of all bodies at many configurations, in blocks of 8: [block][body][12][8]. The 12 numbers
/// are those of a Pose: R by columns, then p.
class PoseBatch {
 public:
  static constexpr int kLanes = LaneBlocks<12>::kLanes;

  /// Sets the pose of the world, body 0, to the identity, and does not keep those of bodies. Allocates
  /// nothing if there were at least as many before.
  void resize(int bodies, int count);
  int bodies() const { return numbers_.items(); }
  /// The number of configurations, and of the blocks that hold them; lanes after the last one repeat it.
  int count() const { return numbers_.count(); }
  int blocks() const { return numbers_.blocks(); }

  /// X_WB of a body at configuration k.
  [[nodiscard]] Pose pose(BodyId body, int k) const;

  /// The numbers of a body in block b; those of the next body follow.
  std::span<const double, 12 * kLanes> block(int b, BodyId body) const {
    return std::span<const double, 12 * kLanes>(numbers_.block(b, static_cast<int>(body)), 12 * kLanes);
  }
  std::span<double, 12 * kLanes> block(int b, BodyId body) {
    return std::span<double, 12 * kLanes>(numbers_.block(b, static_cast<int>(body)), 12 * kLanes);
  }

 private:
  LaneBlocks<12> numbers_;
};

/// The poses of all bodies at each column of Q (nq x N), bitwise equal to those of forwardKinematics() but
/// several times as fast. Allocates nothing once `out` has been used with this model and as many columns.
/// Throws as forwardKinematics().
void forwardKinematicsBatch(const Model& model, const MatrixArg& Q, PoseBatch& out);

}  // namespace rex
