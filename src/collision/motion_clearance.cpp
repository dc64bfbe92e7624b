#include "collision/motion_clearance.h"

#include <algorithm>
#include <queue>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/error.h"
#include "collision/contact_data_internal.h"
#include "collision/joint_travel_internal.h"
#include "collision/proximity.h"
#include "kinematics/forward_kinematics.h"

namespace rex {
namespace {

using Eigen::Vector3d;
using internal::JointTravel;

constexpr double kLeastTolerance = 1e-9;  // metres: rounding does not allow for less

// A stretch of the motion, 0 <= start < end <= 1, of one pair.
struct Stretch {
  double bound;  // no distance in it is below
  std::size_t pair;
  double start, end, atStart, atEnd;
  bool operator<(const Stretch& other) const { return bound > other.bound; }
};

class MotionSearch {
 public:
  MotionSearch(const Model& model, const ContactModel& contacts, const VectorArg& from, const VectorArg& to)
      : model_(model), data_(contacts.data()), from_(from), to_(to) {
    for (const Joint& joint : model.joints()) travels_.push_back(internal::jointTravel(joint, from, to));
    forwardKinematics(model, (from + to) / 2, middle_);
    for (const ShapePair& pair : data_.pairs) speeds_.push_back(speed(pair));
  }

  double run(double tolerance) {
    std::priority_queue<Stretch> stretches;
    double least = std::numeric_limits<double>::infinity();
    const auto add = [&](std::size_t pair, double start, double end, double atStart, double atEnd) {
      least = std::min({least, atStart, atEnd});
      const double mayLose = std::max(0., speeds_[pair] * (end - start) - std::abs(atStart - atEnd)) / 2;
      stretches.push({std::min(atStart, atEnd) - mayLose, pair, start, end, atStart, atEnd});
    };
    for (std::size_t i = 0; i < speeds_.size(); ++i) add(i, 0, 1, distance(i, 0), distance(i, 1));
    if (stretches.empty()) return least;
    while (least - stretches.top().bound > tolerance) {
      const Stretch at = stretches.top();
      stretches.pop();
      const double middle = (at.start + at.end) / 2, atMiddle = distance(at.pair, middle);
      add(at.pair, at.start, middle, at.atStart, atMiddle);
      add(at.pair, middle, at.end, atMiddle, at.atEnd);
    }
    return stretches.top().bound;
  }

 private:
  // Of the distance of a pair: metres per whole motion. Joints that carry both shapes do not count.
  double speed(const ShapePair& pair) const {
    const ContactShape& a = shape(pair.a);
    const ContactShape& b = shape(pair.b);
    std::vector<BodyId> above = {a.body};
    while (above.back() != kWorld) above.push_back(model_[above.back()].parent);
    BodyId common = b.body;
    while (std::find(above.begin(), above.end(), common) == above.end()) common = model_[common].parent;
    return speedBelow(common, a) + speedBelow(common, b);
  }

  // Of the points of a shape, seen from a body that carries it. From where they are in the middle of the
  // motion they never go farther than half of their way, so a ball of growing radius holds them.
  double speedBelow(BodyId carrier, const ContactShape& shape) const {
    const Vector3d centre = middle_[shape.body] * shape.X_BS.p;
    double sum = 0;
    for (BodyId at = shape.body; at != carrier && model_[at].joint != kNoJoint; at = model_[at].parent) {
      const Joint& joint = model_[model_[at].joint];
      const JointTravel& travel = travels_[static_cast<std::size_t>(model_[at].joint)];
      const Pose X_WM = middle_[at] * joint.X_MC.inverse();
      sum += travel.way + travel.angle * (lever(joint, X_WM.inverse() * centre) + shape.reach + sum / 2);
    }
    return sum;
  }

  static double lever(const Joint& joint, const Vector3d& p_MQ) {
    const bool turnsAboutAxis = joint.type == JointType::kHinge || joint.type == JointType::kScrew ||
                                joint.type == JointType::kCylindrical;
    return turnsAboutAxis ? joint.axis.cross(p_MQ).norm() : p_MQ.norm();
  }

  double distance(std::size_t pair, double t) {
    forwardKinematics(model_, (1 - t) * from_ + t * to_, poses_);
    const ContactShape& a = shape(data_.pairs[pair].a);
    const ContactShape& b = shape(data_.pairs[pair].b);
    return proximity(a.shape, poses_[a.body] * a.X_BS, b.shape, poses_[b.body] * b.X_BS).distance;
  }

  const ContactShape& shape(int place) const { return data_.shapes[static_cast<std::size_t>(place)]; }

  const Model& model_;
  const ContactModel::Data& data_;
  const Eigen::VectorXd from_, to_;
  std::vector<JointTravel> travels_;
  std::vector<double> speeds_;
  BodyPoses middle_, poses_;
};

void requirePosture(const char* what, const VectorArg& q, const Model& model) {
  requireSize(what, q.size(), model.nq());
  if (!q.allFinite()) throw Error({.what = what, .found = "a number that is not finite"});
}

}  // namespace

double motionClearance(const Model& model, const ContactModel& contacts, const VectorArg& from,
                       const VectorArg& to, double tolerance) {
  requirePosture("start of the motion", from, model);
  requirePosture("end of the motion", to, model);
  if (!(tolerance >= kLeastTolerance))
    throw Error({.what = "tolerance of the clearance",
                 .found = fmt::format("{} m", tolerance),
                 .wanted = fmt::format("at least {} m", kLeastTolerance)});
  return MotionSearch(model, contacts, from, to).run(tolerance);
}

}  // namespace rex
