#include "collision/clearance_watch.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_data_internal.h"
#include "collision/joint_travel_internal.h"
#include "kinematics/forward_kinematics.h"

namespace rex {
namespace {

constexpr double kCutoff = 0.5;  // metres: whoever is farther counts as this far
constexpr int kPause = 8;        // calls after a failure without measuring

// Adds what each hinge below `carrier` can do to the points of a ball of this radius about p_BS: no posture
// stretches the chain farther than the sum of its links.
void addLevers(const Model& model, BodyId body, BodyId carrier, double farthest,
               Eigen::Ref<Eigen::VectorXd> levers) {
  for (BodyId at = body; at != carrier; at = model[at].parent) {
    const JointId id = model[at].joint;
    if (id == kNoJoint) {
      farthest += model[at].X_PB.p.norm();
      continue;
    }
    const Joint& joint = model[id];
    farthest += joint.X_MC.p.norm();
    if (joint.type == JointType::kHinge) levers[joint.qIndex] += std::abs(joint.ratio) * farthest;
    farthest += joint.X_PF.p.norm();
  }
}

}  // namespace

ClearanceWatch::ClearanceWatch(const Model& model) {
  for (const Joint& joint : model.joints())
    isAble_ = isAble_ && (joint.type == JointType::kHinge || joint.type == JointType::kRigid);
  if (!isAble_) return;
  contacts_.emplace(model);
  const std::span<const ShapePair> all = contacts_->pairs();
  std::vector<Eigen::VectorXd> levers;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::VectorXd one = leversOf(model, all[i]);
    if (one.isZero(0)) continue;
    pairs_.push_back(i);
    levers.push_back(one);
  }
  levers_.resize(static_cast<Eigen::Index>(levers.size()), model.nq());
  for (std::size_t i = 0; i < levers.size(); ++i)
    levers_.row(static_cast<Eigen::Index>(i)) = levers[i].transpose();
  distances_.resize(levers_.rows());
}

Eigen::VectorXd ClearanceWatch::leversOf(const Model& model, const ShapePair& pair) const {
  const ContactModel::Data& data = contacts_->data();
  const auto solid = [&](int shape) -> const ContactSolid& {
    return data.solids[static_cast<std::size_t>(data.solidOf[static_cast<std::size_t>(shape)])];
  };
  const ContactSolid &a = solid(pair.a), &b = solid(pair.b);
  const BodyId common = internal::carrierOfBoth(model, a.body, b.body);
  Eigen::VectorXd levers = Eigen::VectorXd::Zero(model.nq());
  addLevers(model, a.body, common, a.X_BS.p.norm() + a.reach, levers);
  addLevers(model, b.body, common, b.X_BS.p.norm() + b.reach, levers);
  return levers;
}

void ClearanceWatch::reset() {
  isMeasured_ = false;
  wait_ = 0;
}

void ClearanceWatch::measure(const Model& model, const Eigen::VectorXd& q) {
  forwardKinematics(model, q, poses_);
  proxies(*contacts_, poses_, kCutoff, storage_);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    distances_[static_cast<Eigen::Index>(i)] = std::min(kCutoff, storage_.pairs[pairs_[i]].distance);
  at_ = q;
  isMeasured_ = true;
}

bool ClearanceWatch::isProven(const Eigen::VectorXd& way, double distance) {
  left_ = distances_;
  left_.noalias() -= levers_ * way;
  return (left_.array() > distance).all();
}

bool ClearanceWatch::isApart(const Model& model, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             double reserve, double distance) {
  if (!isAble_) return false;
  if (pairs_.empty()) return true;
  if (wait_ > 0) {
    --wait_;
    return false;
  }
  if (isMeasured_) {
    way_ = (q - at_).cwiseAbs() + reserve * v.cwiseAbs();
    if (isProven(way_, distance)) return true;
  }
  measure(model, q);
  way_ = reserve * v.cwiseAbs();
  if (isProven(way_, distance)) return true;
  wait_ = kPause - 1;
  return false;
}

}  // namespace rex
