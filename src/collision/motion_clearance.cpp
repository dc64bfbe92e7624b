#include "collision/motion_clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "collision/contacts_internal.h"
#include "collision/motion_clearance_internal.h"
#include "collision/proximity.h"
#include "kinematics/forward_kinematics.h"

namespace rex::internal {
namespace {

using Eigen::VectorXd;

// A quaternion that moves along a line by d, and whose length is at least `least`, turns by at most 2 |d| /
// least.
double turn(const Joint& joint, const VectorXd& from, const VectorXd& to) {
  const VectorXd d = to - from;
  if (d.isZero(0)) return 0;
  const double t = std::clamp(-from.dot(d) / d.squaredNorm(), 0., 1.);
  const double least = (from + t * d).norm();
  if (!(least > 1e-6 * std::max(from.norm(), to.norm())))
    throw Error({.what = fmt::format("motion of joint '{}'", joint.name),
                 .found = "a quaternion that becomes zero on the way",
                 .wanted = "quaternions at both ends with a positive inner product"});
  return 2 * d.norm() / least;
}

}  // namespace

JointTravel jointTravel(const Joint& joint, const VectorArg& from, const VectorArg& to) {
  const double ratio = joint.nq == 1 ? joint.ratio : 1, offset = joint.nq == 1 ? joint.offset : 0;
  const VectorXd a = (ratio * from.segment(joint.qIndex, joint.nq)).array() + offset,
                 b = (ratio * to.segment(joint.qIndex, joint.nq)).array() + offset;
  JointTravel travel;
  // From the last movement to the first: a rotation carries everything after it, which is farthest from the
  // axis at one of the ends.
  Eigen::Vector3d moved = Eigen::Vector3d::Zero(), after_a = moved, after_b = moved;
  const JointMovements all = movements(joint);
  for (std::size_t k = all.size(); k-- > 0;) {
    const JointMovement& one = all[k];
    const int i = one.coordinate;
    switch (one.kind) {
      case JointMovement::Kind::kFixed:
        break;
      case JointMovement::Kind::kSlider:
        moved += (b[i] - a[i]) * one.axis;
        after_a += a[i] * one.axis;
        after_b += b[i] * one.axis;
        break;
      case JointMovement::Kind::kHinge: {
        const double reach = std::max(one.axis.cross(after_a).norm(), one.axis.cross(after_b).norm());
        travel.angle += std::abs(b[i] - a[i]);
        travel.way += std::abs(b[i] - a[i]) * reach;
        break;
      }
      case JointMovement::Kind::kQuaternion:
        travel.angle += turn(joint, a.segment<4>(i), b.segment<4>(i));
        break;
    }
  }
  travel.way += moved.norm();
  return travel;
}

BodyId carrierOfBoth(const Model& model, BodyId a, BodyId b) {
  std::vector<BodyId> above{a};
  while (above.back() != kWorld) above.push_back(model[above.back()].parent);
  while (std::find(above.begin(), above.end(), b) == above.end()) b = model[b].parent;
  return b;
}

}  // namespace rex::internal

namespace rex {
namespace {

using Eigen::Vector3d;
using internal::JointTravel;

constexpr double kLeastTolerance = 1e-9;  // metres: rounding does not allow less
constexpr double kFiner = 16;             // each pass divides the tolerance of the previous one by this
constexpr int kMostMeasurements = 500'000;

// The distances of one pair at the ends of a stretch of the motion, and later at its middle; metres.
struct Stretch {
  std::size_t pair;
  double atStart, atEnd, atMiddle = 0;
};

class MotionSearch {
 public:
  MotionSearch(const Model& model, const ContactModel& contacts, const VectorArg& from, const VectorArg& to)
      : model_(model), data_(contacts.data()), from_(from), to_(to) {
    for (const Joint& joint : model.joints()) travels_.push_back(internal::jointTravel(joint, from, to));
    forwardKinematics(model, (from + to) / 2, poses_);
    measureEnds();
  }

  // Coarse passes find the least distance, so that fine ones can skip everything that stays farther away.
  ClearanceBounds run(double tolerance) {
    const std::vector<Stretch> whole = stretches_;
    double known = boundOf(whole);
    const auto isUseful = [&] { return std::isfinite(known) && least_ - known > tolerance && left_ > 0; };
    for (bool isFine = false; !isFine && isUseful();) {
      tolerance_ = std::max(tolerance, (least_ - known) / kFiner);
      isFine = tolerance_ == tolerance;
      bound_ = std::numeric_limits<double>::infinity();
      stretches_.clear();
      for (const Stretch& stretch : whole) keepUnlessBounded(stretch, 1);
      search(0, 1, 0);
      known = std::max(known, bound_);
    }
    return {known, least_};
  }

 private:
  // Only of pairs that may come as near as those measured before. Balls about the others prove that their
  // bounds are larger than the least distance, so they change no result.
  void measureEnds() {
    BodyPoses start, end;
    forwardKinematics(model_, from_, start);
    forwardKinematics(model_, to_, end);
    const std::vector<double> bounds = boundsOfBalls(start, end);
    const std::size_t nearest =
        static_cast<std::size_t>(std::min_element(bounds.begin(), bounds.end()) - bounds.begin());
    speeds_.resize(bounds.size());
    Stretch first{nearest, 0, 0};
    const auto measure = [&](std::size_t pair) {
      speeds_[pair] = speed(data_.pairs[pair]);
      return Stretch{pair, measured(pair, start), measured(pair, end)};
    };
    if (!bounds.empty()) first = measure(nearest);
    for (std::size_t i = 0; i < bounds.size(); ++i)
      if (!(bounds[i] > least_)) stretches_.push_back(i == nearest ? first : measure(i));
  }

  // Lower bounds on the distances of all pairs over the whole motion.
  std::vector<double> boundsOfBalls(const BodyPoses& start, const BodyPoses& end) const {
    struct Ball {
      Vector3d start, end;
      double reach;  // with half of its way
    };
    std::vector<Ball> balls;
    for (const ContactSolid& solid : data_.solids) {
      const Vector3d middle = solid.X_BS * solid.middle;
      balls.push_back({start[solid.body] * middle, end[solid.body] * middle,
                       solid.half.norm() + speedBelow(kWorld, solid) / 2 + internal::kCullSlack});
    }
    std::vector<double> bounds;
    for (const ShapePair& pair : data_.pairs) {
      const Ball &a = balls[place(pair.a)], &b = balls[place(pair.b)];
      bounds.push_back(std::min((a.start - b.start).norm(), (a.end - b.end).norm()) - a.reach - b.reach);
    }
    return bounds;
  }

  // A lower bound on the pair's distance over a stretch of this length.
  double bound(const Stretch& stretch, double length) const {
    const auto& [pair, atStart, atEnd, unused] = stretch;
    const double mayLose = std::max(0., speeds_[pair] * length - std::abs(atStart - atEnd)) / 2;
    return std::min(atStart, atEnd) - mayLose;
  }

  double boundOf(const std::vector<Stretch>& whole) const {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Stretch& stretch : whole) lowest = std::min(lowest, bound(stretch, 1));
    return lowest;
  }

  // The least distance can only decrease, so a bound that is close to it now stays close.
  void keepUnlessBounded(const Stretch& stretch, double length) {
    const double atLeast = bound(stretch, length);
    if (least_ - atLeast > tolerance_ && left_ > 0) {
      stretches_.push_back(stretch);
    } else {
      bound_ = std::min(bound_, atLeast);
    }
  }

  // Bisects stretches_[first..], which all span [start, end], and removes them.
  void search(double start, double end, std::size_t first) {
    const std::size_t last = stretches_.size();
    if (first == last) return;
    const double middle = (start + end) / 2, length = (end - start) / 2;
    moveTo(middle);
    for (std::size_t i = first; i < last; ++i) stretches_[i].atMiddle = measured(stretches_[i].pair, poses_);
    for (std::size_t i = first; i < last; ++i)
      keepUnlessBounded({stretches_[i].pair, stretches_[i].atStart, stretches_[i].atMiddle}, length);
    search(start, middle, last);
    for (std::size_t i = first; i < last; ++i)
      keepUnlessBounded({stretches_[i].pair, stretches_[i].atMiddle, stretches_[i].atEnd}, length);
    search(middle, end, last);
    stretches_.resize(first);
  }

  // How fast a pair's distance may change, metres per whole motion. Joints that carry both shapes do not
  // contribute.
  double speed(const ShapePair& pair) const {
    const ContactSolid& a = solid(pair.a);
    const ContactSolid& b = solid(pair.b);
    const BodyId common = internal::carrierOfBoth(model_, a.body, b.body);
    return speedBelow(common, a) + speedBelow(common, b);
  }

  // How fast points of a solid may move, seen from a body that carries it. From the middle of the motion,
  // where they are now, no point moves farther than half of its way, so a ball of growing radius contains
  // them.
  double speedBelow(BodyId carrier, const ContactSolid& solid) const {
    const Vector3d centre = poses_[solid.body] * solid.X_BS.p;
    double sum = 0;
    for (BodyId at = solid.body; at != carrier && model_[at].joint != kNoJoint; at = model_[at].parent) {
      const Joint& joint = model_[model_[at].joint];
      const JointTravel& travel = travels_[static_cast<std::size_t>(model_[at].joint)];
      const Pose X_WM = poses_[at] * joint.X_MC.inverse();
      sum += travel.way + travel.angle * (lever(joint, X_WM.inverse() * centre) + solid.reach + sum / 2);
    }
    return sum;
  }

  static double lever(const Joint& joint, const Vector3d& p_MQ) {
    return hasAxis(joint.type) ? joint.axis.cross(p_MQ).norm() : p_MQ.norm();
  }

  void moveTo(double t) { forwardKinematics(model_, (1 - t) * from_ + t * to_, poses_); }

  double measured(std::size_t pair, const BodyPoses& poses) {
    const ContactSolid& a = solid(data_.pairs[pair].a);
    const ContactSolid& b = solid(data_.pairs[pair].b);
    const double distance =
        proximity(a.form, poses[a.body] * a.X_BS, b.form, poses[b.body] * b.X_BS).distance;
    least_ = std::min(least_, distance);
    --left_;
    return distance;
  }

  std::size_t place(int shape) const {
    return static_cast<std::size_t>(data_.solidOf[static_cast<std::size_t>(shape)]);
  }
  const ContactSolid& solid(int shape) const { return data_.solids[place(shape)]; }

  const Model& model_;
  const ContactModel::Data& data_;
  const Eigen::VectorXd from_, to_;
  std::vector<JointTravel> travels_;
  std::vector<double> speeds_;  // of pairs in stretches_
  BodyPoses poses_;
  std::vector<Stretch> stretches_;
  double least_ = std::numeric_limits<double>::infinity();  // distance measured
  double bound_ = 0, tolerance_ = 0;                        // of this pass
  int left_ = kMostMeasurements;
};

void requirePosture(const char* what, const VectorArg& q, const Model& model) {
  requireSize(what, q.size(), model.nq());
  if (!q.allFinite()) throw Error({.what = what, .found = "a number that is not finite"});
}

}  // namespace

ClearanceBounds clearanceBounds(const Model& model, const ContactModel& contacts, const VectorArg& from,
                                const VectorArg& to, double tolerance) {
  requirePosture("start of the motion", from, model);
  requirePosture("end of the motion", to, model);
  if (!(tolerance >= kLeastTolerance))
    throw Error({.what = "tolerance of the clearance",
                 .found = fmt::format("{} m", tolerance),
                 .wanted = fmt::format("at least {} m", kLeastTolerance)});
  return MotionSearch(model, contacts, from, to).run(tolerance);
}

double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                       const VectorArg& to, double tolerance) {
  return clearanceBounds(model, contacts, from, to, tolerance).atLeast;
}

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
    const Eigen::VectorXd one = motionLevers(model, all[i]);
    if (one.isZero(0)) continue;
    pairs_.push_back(i);
    levers.push_back(one);
  }
  levers_.resize(static_cast<Eigen::Index>(levers.size()), model.nq());
  for (std::size_t i = 0; i < levers.size(); ++i)
    levers_.row(static_cast<Eigen::Index>(i)) = levers[i].transpose();
  distances_.resize(levers_.rows());
}

Eigen::VectorXd ClearanceWatch::motionLevers(const Model& model, const ShapePair& pair) const {
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
