#include "collision/contact_batch.h"

#include <algorithm>
#include <memory>

#include "base/cpu_lanes.h"
#include "collision/contact_data_internal.h"
#include "collision/convex_distance_internal.h"

namespace rex {
namespace {

using internal::ContactKernel;
using internal::CorePair;
using internal::kContactLanes;
using internal::kPoseNumbers;

static_assert(kContactLanes == PoseBatch::kLanes);

// Processes a batch, one block of configurations after another.
class Blocks {
 public:
  Blocks(const ContactModel& contacts, const PoseBatch& poses)
      : data_(contacts.data()),
        poses_(poses),
        kernel_(kernelFor<ContactKernel>(cpuLanes())),
        X_WS_(std::make_unique_for_overwrite<double[]>(data_.solids.size() * kPoseNumbers)) {}

  [[nodiscard]] int count() const { return (poses_.count() + kContactLanes - 1) / kContactLanes; }
  [[nodiscard]] int lanesOf(int block) const {
    return std::min(kContactLanes, poses_.count() - block * kContactLanes);
  }

  // The numbers of row i in all lanes go to [i * kContactLanes].
  void measure(int block, double* distances) {
    place(block);
    for (std::size_t type = 0; type < data_.cores.size(); ++type) {
      const std::vector<CorePair>& pairs = data_.cores[type];
      kernel_.pairs[type].distances(pairs.data(), static_cast<int>(pairs.size()), solids(), distances);
    }
    for (const CorePair& pair : data_.others) {
      const ContactSolid &a = solid(pair.a), &b = solid(pair.b);
      for (int lane = 0; lane < lanesOf(block); ++lane)
        distances[pair.row * kContactLanes + lane] =
            internal::convexProximity(a.form, pose(pair.a, lane), b.form, pose(pair.b, lane)).distance;
    }
  }

  // The lanes, as bits, in which some pair is closer than the margin; at least one of them if one is
  // enough.
  unsigned hits(int block, double margin, bool isOneEnough) {
    place(block);
    const unsigned all = (1u << lanesOf(block)) - 1;
    unsigned found = ~all & ((1u << kContactLanes) - 1);
    const auto isEnough = [&] { return isOneEnough && (found & all) != 0; };
    for (std::size_t type = 0; type < data_.cores.size() && !isEnough(); ++type) {
      const std::vector<CorePair>& pairs = data_.cores[type];
      found = kernel_.pairs[type].hits(pairs.data(), static_cast<int>(pairs.size()), solids(), margin, found,
                                       isOneEnough);
    }
    for (const CorePair& pair : data_.others) {
      if (isEnough()) break;
      for (int lane = 0; lane < lanesOf(block); ++lane)
        if ((found >> lane & 1) == 0 && isNearer(pair, lane, margin)) found |= 1u << lane;
    }
    return found & all;
  }

 private:
  [[nodiscard]] internal::LaneSolids solids() const { return {X_WS_.get(), data_.sizes.data()}; }

  void place(int block) {
    for (std::size_t i = 0; i < data_.solids.size(); ++i) {
      const ContactSolid& solid = data_.solids[i];
      kernel_.place(poses_.block(block, solid.body).data(), data_.X_BS.data() + 12 * i,
                    X_WS_.get() + i * kPoseNumbers);
    }
  }

  [[nodiscard]] const ContactSolid& solid(int i) const { return data_.solids[static_cast<std::size_t>(i)]; }

  // The pose of solid i in a lane of the current block.
  [[nodiscard]] Pose pose(int i, int lane) const {
    const double* numbers = X_WS_.get() + i * kPoseNumbers + lane;
    Pose X_WS;
    for (int k = 0; k < 9; ++k) X_WS.R.data()[k] = numbers[k * kContactLanes];
    for (int k = 0; k < 3; ++k) X_WS.p[k] = numbers[(9 + k) * kContactLanes];
    return X_WS;
  }

  // NaN never counts as far.
  [[nodiscard]] bool isNearer(const CorePair& pair, int lane, double margin) const {
    const Pose X_WA = pose(pair.a, lane), X_WB = pose(pair.b, lane);
    if ((X_WA.p - X_WB.p).norm() >= pair.reach + margin + internal::kCullSlack) return false;
    return internal::isNearer(solid(pair.a).form, X_WA, solid(pair.b).form, X_WB, margin);
  }

  const ContactModel::Data& data_;
  const PoseBatch& poses_;
  ContactKernel kernel_;
  std::unique_ptr<double[]> X_WS_;
};

}  // namespace

void contactDistancesBatch(const ContactModel& contacts, const PoseBatch& poses, Eigen::MatrixXd& distances) {
  using RowsInLanes = Eigen::Matrix<double, kContactLanes, Eigen::Dynamic>;
  Blocks blocks(contacts, poses);
  const auto rows = static_cast<Eigen::Index>(contacts.pairs().size());
  distances.resize(rows, poses.count());
  RowsInLanes measured(kContactLanes, rows);
  for (int block = 0; block < blocks.count(); ++block) {
    blocks.measure(block, measured.data());
    const int lanes = blocks.lanesOf(block);
    distances.middleCols(block * kContactLanes, lanes) = measured.topRows(lanes).transpose();
  }
}

void contactFreeBatch(const ContactModel& contacts, const PoseBatch& poses, double margin,
                      Eigen::Array<bool, Eigen::Dynamic, 1>& free) {
  Blocks blocks(contacts, poses);
  free.resize(poses.count());
  for (int block = 0; block < blocks.count(); ++block) {
    const unsigned hits = blocks.hits(block, margin, false);
    for (int lane = 0; lane < blocks.lanesOf(block); ++lane)
      free[block * kContactLanes + lane] = (hits >> lane & 1) == 0;
  }
}

bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin) {
  Blocks blocks(contacts, poses);
  for (int block = 0; block < blocks.count(); ++block)
    if (blocks.hits(block, margin, true) != 0) return false;
  return true;
}

}  // namespace rex
