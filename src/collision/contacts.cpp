#include "collision/contacts.h"

#include <algorithm>
#include <cassert>
#include <memory>
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
