#include "collision/contacts.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "collision/collision_pairs.h"
#include "collision/contacts_internal.h"
#include "collision/convex_distance_internal.h"
#include "kinematics/jacobians.h"

namespace rex {
namespace {

Eigen::Vector3d inBody(const Pose& X_WB, const Eigen::Vector3d& p_W) {
  return X_WB.R.transpose() * (p_W - X_WB.p);
}

// Adds weight times the derivative of the pair's distance to `row` (1 x nv); J is storage for 3 x nv numbers.
void addDistanceDerivative(const Model& model, const BodyPoses& poses, const Proxy& proxy,
                           const ContactModel& contacts, double weight, Eigen::Matrix3Xd& J,
                           Eigen::MatrixXd& row) {
  J.resize(3, model.nv());
  const Eigen::RowVector3d direction = weight * proxy.proximity.normal_W.transpose();
  const BodyId a = contacts.body(proxy.pair.a), b = contacts.body(proxy.pair.b);
  positionJacobian(model, poses, a, inBody(poses[a], proxy.proximity.p_WA), J);
  row.noalias() += direction * J;
  positionJacobian(model, poses, b, inBody(poses[b], proxy.proximity.p_WB), J);
  row.noalias() -= direction * J;
}

// NaN if the distance is NaN, because std::max then returns its first argument.
double costOf(const Proxy& proxy, double margin) {
  return std::max(1 - proxy.proximity.distance / margin, 0.);
}

}  // namespace

Eigen::RowVectorXd distanceJacobian(const Model& model, const BodyPoses& poses, const Proxy& proxy,
                                    const ContactModel& contacts) {
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, model.nv());
  Eigen::Matrix3Xd J;
  addDistanceDerivative(model, poses, proxy, contacts, 1, J, row);
  return row;
}

double contactCost(const ContactModel& contacts, const BodyPoses& poses, double margin) {
  requirePositive("margin of contact costs", margin, kMetres);
  double cost = 0;
  for (const Proxy& proxy : proxies(contacts, poses, margin)) cost += costOf(proxy, margin);
  return cost;
}

TaskMap contactTask(ContactModel contacts, double margin) {
  requirePositive("margin of contact costs", margin, kMetres);
  return [contacts = std::move(contacts), margin, storage = ProxyStorage(), J = Eigen::Matrix3Xd()](
             const Posture& at, TaskValue& value) mutable {
    value.y.setZero(1);
    value.J.setZero(1, at.model.nv());
    proxies(contacts, at.poses, margin, storage);
    for (const Proxy& proxy : storage.near) {
      value.y[0] += costOf(proxy, margin);
      addDistanceDerivative(at.model, at.poses, proxy, contacts, -1 / margin, J, value.J);
    }
  };
}

namespace {

void requirePair(const Model& model, const ShapePair& pair) {
  const int count = static_cast<int>(model.shapes().size());
  if (0 <= pair.a && pair.a < pair.b && pair.b < count) return;
  throw Error({.what = fmt::format("scene '{}': pair of shapes in contact", model.name()),
               .found = fmt::format("({}, {})", pair.a, pair.b),
               .wanted = fmt::format("0 <= a < b < {}", count)});
}

void addBox(ContactSolid& solid) {
  const internal::ConvexCore core(solid.form);
  for (int k = 0; k < 3; ++k) {
    const double high = core.support(Eigen::Vector3d::Unit(k))[k],
                 low = core.support(-Eigen::Vector3d::Unit(k))[k];
    solid.middle[k] = (high + low) / 2;
    solid.half[k] = (high - low) / 2 + core.radius();
  }
}

// The solid of a shape, which is added on first use.
int solidOf(ContactModel::Data& data, const Model& model, int place) {
  int& solid = data.solidOf[static_cast<std::size_t>(place)];
  if (solid >= 0) return solid;
  solid = static_cast<int>(data.solids.size());
  const ModelShape& shape = model.shapes()[static_cast<std::size_t>(place)];
  internal::requireSolid(
      fmt::format("scene '{}': shape '{}' of body '{}'", model.name(), shape.name, model[shape.body].name),
      shape.shape);
  const internal::Core core = internal::coreOf(shape.shape);
  data.solids.push_back({place, shape.body, shape.X_BS, shape.shape, core, halfBounds(shape.shape).norm()});
  addBox(data.solids.back());
  const Pose& X_BS = shape.X_BS;
  data.X_BS.insert(data.X_BS.end(), X_BS.R.data(), X_BS.R.data() + 9);
  data.X_BS.insert(data.X_BS.end(), X_BS.p.data(), X_BS.p.data() + 3);
  for (const double number : {core.half.x(), core.half.y(), core.half.z(), core.radius})
    data.sizes.insert(data.sizes.end(), internal::kContactLanes, number);
  return solid;
}

// Adds a pair to those of its kind; kernels expect segments before boxes.
void addPair(ContactModel::Data& data, int row, int a, int b) {
  const auto& solids = data.solids;
  const auto solid = [&](int i) -> const ContactSolid& { return solids[static_cast<std::size_t>(i)]; };
  const double reach = solid(a).reach + solid(b).reach;
  const auto [first, last] = std::minmax(solid(a).core.type, solid(b).core.type);
  if (last == internal::CoreType::kOther) {
    data.others.push_back({a, b, row, reach});
  } else {
    if (solid(a).core.type != first) std::swap(a, b);
    data.cores[static_cast<std::size_t>(first) + static_cast<std::size_t>(last)].push_back(
        {a, b, row, reach});
  }
}

}  // namespace

ContactModel::ContactModel(const Model& model) : ContactModel(model, collidingPairs(model)) {}

ContactModel::ContactModel(const Model& model, std::span<const ShapePair> pairs) {
  auto data = std::make_shared<Data>();
  data->pairs.assign(pairs.begin(), pairs.end());
  data->solidOf.assign(model.shapes().size(), -1);
  for (std::size_t row = 0; row < pairs.size(); ++row) {
    requirePair(model, pairs[row]);
    const int a = solidOf(*data, model, pairs[row].a), b = solidOf(*data, model, pairs[row].b);
    addPair(*data, static_cast<int>(row), a, b);
  }
  data_ = std::move(data);
}

std::span<const ShapePair> ContactModel::pairs() const { return data_->pairs; }

BodyId ContactModel::body(int shape) const {
  const int solid = data_->solidOf[static_cast<std::size_t>(shape)];
  assert(solid >= 0 && "the shape takes no part");
  return data_->solids[static_cast<std::size_t>(solid)].body;
}

namespace {

using internal::ContactKernel;
using internal::CorePair;
using internal::kContactLanes;
using internal::kPoseNumbers;

static_assert(kContactLanes == PoseBatch::kLanes);

// Processes a batch, one block of configurations after another.
class Blocks {
  template <int kNumbers>
  using LaneArray = Eigen::Array<double, kContactLanes, kNumbers>;

 public:
  Blocks(const ContactModel& contacts, const PoseBatch& poses)
      : data_(contacts.data()),
        poses_(poses),
        kernel_(kernelFor<ContactKernel>(cpuLanes())),
        X_WS_(std::make_unique_for_overwrite<double[]>(data_.solids.size() * kPoseNumbers)),
        middles_(data_.others.empty() ? 0 : data_.solids.size()) {}

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
  // enough. Pairs outside the kernels are asked in an order, if there is one, and one that suffices moves to
  // its front.
  unsigned hits(int block, double margin, bool isOneEnough, std::span<int> order = {}) {
    place(block);
    const unsigned all = (1u << lanesOf(block)) - 1;
    unsigned found = ~all & ((1u << kContactLanes) - 1);
    const auto isEnough = [&] { return isOneEnough && (found & all) != 0; };
    for (std::size_t type = 0; type < data_.cores.size() && !isEnough(); ++type) {
      const std::vector<CorePair>& pairs = data_.cores[type];
      found = kernel_.pairs[type].hits(pairs.data(), static_cast<int>(pairs.size()), solids(), margin, found,
                                       isOneEnough);
    }
    for (std::size_t i = 0; i < data_.others.size() && !isEnough(); ++i) {
      const std::size_t next = order.empty() ? i : static_cast<std::size_t>(order[i]);
      found |= otherHits(data_.others[next], margin, found, isOneEnough);
      if (isEnough() && !order.empty()) std::rotate(&order[0], &order[i], &order[i] + 1);
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
    for (std::size_t i = 0; i < middles_.size(); ++i) {
      const auto X_WS = posesOf(i);
      const Eigen::Vector3d& middle = data_.solids[i].middle;
      middles_[i] = X_WS.rightCols<3>();
      for (int k = 0; k < 3; ++k) middles_[i] += middle[k] * X_WS.middleCols<3>(3 * k);
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

  [[nodiscard]] Eigen::Map<const LaneArray<12>> posesOf(std::size_t i) const {
    return Eigen::Map<const LaneArray<12>>(X_WS_.get() + i * kPoseNumbers);
  }

  // How far the box about a solid extends to one side along directions, times their lengths.
  [[nodiscard]] LaneArray<1> extent(int i, const LaneArray<3>& directions) const {
    const auto X_WS = posesOf(static_cast<std::size_t>(i));
    LaneArray<1> sum = LaneArray<1>::Zero();
    for (int k = 0; k < 3; ++k)
      sum +=
          solid(i).half[k] * (X_WS.col(3 * k) * directions.col(0) + X_WS.col(3 * k + 1) * directions.col(1) +
                              X_WS.col(3 * k + 2) * directions.col(2))
                                 .abs();
    return sum;
  }

  // The lanes, as bits, in which a pair is nearer than the margin and which are not in `known`; the first of
  // them if one is enough. Balls, then boxes along the line of their middles, prove most of them apart. NaN
  // never counts as far.
  [[nodiscard]] unsigned otherHits(const CorePair& pair, double margin, unsigned known,
                                   bool isOneEnough) const {
    const ContactSolid &a = solid(pair.a), &b = solid(pair.b);
    const double far = margin + internal::kCullSlack, reach = a.half.norm() + b.half.norm() + far;
    const LaneArray<3> between =
        middles_[static_cast<std::size_t>(pair.a)] - middles_[static_cast<std::size_t>(pair.b)];
    const LaneArray<1> squares = between.col(0).square() + between.col(1).square() + between.col(2).square();
    if ((squares >= reach * reach).all()) return 0;
    const LaneArray<1> lengths = squares.sqrt(),
                       gaps = squares - extent(pair.a, between) - extent(pair.b, between) - far * lengths;
    unsigned found = 0;
    Eigen::Vector3d apart_A = Eigen::Vector3d::Zero();
    for (int lane = 0; lane < kContactLanes; ++lane) {
      if ((known >> lane & 1) != 0 || gaps[lane] > 0) continue;
      const Pose X_WA = pose(pair.a, lane), X_WB = pose(pair.b, lane);
      const Eigen::Matrix3d R_AW = X_WA.R.transpose();
      const Eigen::Vector3d way = R_AW * between.row(lane).matrix().transpose();
      if (apart_A.isZero(0)) apart_A = way / lengths[lane];
      const double widths =
          apart_A.cwiseAbs().dot(a.half) + (X_WB.R.transpose() * (X_WA.R * apart_A)).cwiseAbs().dot(b.half);
      if (apart_A.dot(way) - widths >= far) continue;
      if (internal::isNearer(a.form, X_WA, b.form, X_WB, margin, apart_A)) found |= 1u << lane;
      if (isOneEnough && found != 0) break;
    }
    return found;
  }

  const ContactModel::Data& data_;
  const PoseBatch& poses_;
  ContactKernel kernel_;
  std::unique_ptr<double[]> X_WS_;
  std::vector<LaneArray<3>> middles_;  // of the boxes about all solids
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

bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin,
                    std::vector<int>& order) {
  if (const std::size_t others = contacts.data().others.size(); order.size() != others) {
    order.resize(others);
    std::iota(order.begin(), order.end(), 0);
  }
  Blocks blocks(contacts, poses);
  for (int block = 0; block < blocks.count(); ++block)
    if (blocks.hits(block, margin, true, order) != 0) return false;
  return true;
}

bool allContactFree(const ContactModel& contacts, const PoseBatch& poses, double margin) {
  std::vector<int> order;
  return allContactFree(contacts, poses, margin, order);
}

}  // namespace rex
