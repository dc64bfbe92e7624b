#pragma once

#include <array>
#include <cassert>
#include <span>
#include <vector>

#include "scene/model.h"

namespace rex {

/// Numbers of many configurations for kernels, in blocks of 8 configurations: [block][item][number][8], the
/// same on every machine, with each item of a block aligned to 64 bytes. The last block is padded. All
/// numbers are initially zero.
template <int kNumbers>
class LaneBlocks {
 public:
  static constexpr int kLanes = 8;

  /// Does not keep the numbers. Allocates nothing if there were at least as many before.
  void resize(int items, int count) {
    assert(items >= 0 && count >= 0);
    items_ = items;
    count_ = count;
    blocks_.resize(static_cast<std::size_t>(items) * static_cast<std::size_t>(blocks()));
  }
  int items() const { return items_; }
  int count() const { return count_; }
  int blocks() const { return (count_ + kLanes - 1) / kLanes; }

  /// The numbers of an item, kNumbers times 8; the next item follows.
  double* block(int b, int item) { return blocks_[index(b, item)].numbers.data(); }
  const double* block(int b, int item) const { return blocks_[index(b, item)].numbers.data(); }

  /// The numbers of an item at configuration k.
  std::array<double, kNumbers> at(int item, int k) const {
    assert(0 <= k && k < count_);
    const double* from = block(k / kLanes, item) + k % kLanes;
    std::array<double, kNumbers> numbers;
    for (std::size_t i = 0; i < kNumbers; ++i) numbers[i] = from[kLanes * i];
    return numbers;
  }

 private:
  struct alignas(64) Block {
    std::array<double, kNumbers * kLanes> numbers;
  };
  std::size_t index(int b, int item) const {
    assert(0 <= b && b < blocks() && 0 <= item && item < items_);
    return static_cast<std::size_t>(b) * static_cast<std::size_t>(items_) + static_cast<std::size_t>(item);
  }

  std::vector<Block> blocks_;
  int items_ = 0, count_ = 0;
};

/// World poses of all bodies, indexed by BodyId; the world itself comes first.
struct BodyPoses {
  std::vector<Pose> X_WB;
  const Pose& operator[](BodyId id) const { return X_WB[static_cast<std::size_t>(id)]; }
};

/// The poses of all bodies at posture q (nq). Throws Error naming both sizes if that of q is wrong, and for
/// quaternions that are zero or not finite. Slide 2:18.
[[nodiscard]] BodyPoses forwardKinematics(const Model& model, const VectorArg& q);
/// The same into storage of the caller; allocates nothing once `out` has been used with this model.
void forwardKinematics(const Model& model, const VectorArg& q, BodyPoses& out);

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
