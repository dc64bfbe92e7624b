#include <limits>
#include <utility>

#include "base/cpu_lanes.h"
#include "collision/contact_data_internal.h"
#include "collision/contacts.h"

namespace rex {
namespace {

using internal::ContactKernel;
using internal::CorePair;
using internal::kContactLanes;
using internal::kPoseNumbers;
using internal::kSizeNumbers;

// Pairs of one kind, one per lane, with solid a followed by solid b.
class PairsInLanes {
 public:
  explicit PairsInLanes(const internal::PairKernel& kernel) : kernel_(kernel) {}

  [[nodiscard]] bool isFull() const { return count_ == kContactLanes; }

  void add(const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
           const Pose& X_WB) {
    put(0, a, X_WA);
    put(1, b, X_WB);
    rows_[count_] = pair.row;
    swapped_[count_++] = b.shape < a.shape;
  }

  // Runs the kernel and empties the lanes.
  void measure(std::vector<Proximity>& found) {
    if (count_ == 0) return;
    internal::LaneProximities lanes;
    kernel_.proximities({.a = 0, .b = 1, .row = 0, .reach = 0}, count_, {X_WS_, sizes_}, lanes);
    for (int lane = 0; lane < count_; ++lane) {
      const auto vector = [&](const double* v) {
        return Eigen::Vector3d(v[lane], v[kContactLanes + lane], v[2 * kContactLanes + lane]);
      };
      Proximity& p = found[static_cast<std::size_t>(rows_[lane])];
      p = {lanes.distance[lane], vector(lanes.p_WA), vector(lanes.p_WB), vector(lanes.normal_W)};
      if (swapped_[lane]) {
        std::swap(p.p_WA, p.p_WB);
        p.normal_W = -p.normal_W;
      }
    }
    count_ = 0;
  }

 private:
  void put(int place, const ContactSolid& solid, const Pose& X_WS) {
    double* X = X_WS_ + place * kPoseNumbers + count_;
    for (int i = 0; i < 9; ++i) X[i * kContactLanes] = X_WS.R.data()[i];
    for (int i = 0; i < 3; ++i) X[(9 + i) * kContactLanes] = X_WS.p[i];
    double* size = sizes_ + place * kSizeNumbers + count_;
    for (int i = 0; i < 3; ++i) size[i * kContactLanes] = solid.core.half[i];
    size[3 * kContactLanes] = solid.core.radius;
  }

  const internal::PairKernel& kernel_;
  int count_ = 0;
  int rows_[kContactLanes] = {};
  bool swapped_[kContactLanes] = {};
  double X_WS_[2 * kPoseNumbers] = {}, sizes_[2 * kSizeNumbers] = {};
};

// Calls visit(pair, solid a, X_WA, solid b, X_WB) for the pairs whose bounding spheres are closer than the
// cutoff, up to rounding. Here and below, NaN never counts as far.
template <class Visit>
void forEachNear(const ContactModel::Data& data, const std::vector<CorePair>& pairs,
                 const std::vector<Pose>& X_WS, double cutoff, const Visit& visit) {
  for (const CorePair& pair : pairs) {
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    if (!((X_WS[a].p - X_WS[b].p).norm() >= pair.reach + cutoff + internal::kCullSlack))
      visit(pair, data.solids[a], X_WS[a], data.solids[b], X_WS[b]);
  }
}

}  // namespace

void proxies(const ContactModel& contacts, const BodyPoses& poses, double cutoff, ProxyStorage& storage) {
  const ContactModel::Data& data = contacts.data();
  auto& [near, X_WS, found] = storage;
  X_WS.clear();
  for (const ContactSolid& solid : data.solids) X_WS.push_back(poses[solid.body] * solid.X_BS);
  found.resize(data.pairs.size());
  for (Proximity& proximity : found) proximity.distance = std::numeric_limits<double>::infinity();

  const auto kernel = kernelFor<ContactKernel>(cpuLanes());
  for (std::size_t type = 0; type < data.cores.size(); ++type) {
    PairsInLanes lanes(kernel.pairs[type]);
    forEachNear(data, data.cores[type], X_WS, cutoff,
                [&](const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
                    const Pose& X_WB) {
                  lanes.add(pair, a, X_WA, b, X_WB);
                  if (lanes.isFull()) lanes.measure(found);
                });
    lanes.measure(found);
  }
  forEachNear(data, data.others, X_WS, cutoff,
              [&](const CorePair& pair, const ContactSolid& a, const Pose& X_WA, const ContactSolid& b,
                  const Pose& X_WB) {
                found[static_cast<std::size_t>(pair.row)] = proximity(a.form, X_WA, b.form, X_WB);
              });

  near.clear();
  for (std::size_t row = 0; row < found.size(); ++row)
    if (!(found[row].distance >= cutoff)) near.push_back({data.pairs[row], found[row]});
}

std::vector<Proxy> proxies(const ContactModel& contacts, const BodyPoses& poses, double cutoff) {
  ProxyStorage storage;
  proxies(contacts, poses, cutoff, storage);
  return std::move(storage.near);
}

}  // namespace rex
