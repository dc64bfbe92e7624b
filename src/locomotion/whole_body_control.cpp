#include "locomotion/whole_body_control.h"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/error.h"
#include "base/require.h"
#include "dynamics/equations_of_motion.h"
#include "dynamics/inverse_dynamics.h"
#include "dynamics/joint_springs.h"
#include "kinematics/center_of_mass.h"
#include "kinematics/jacobians.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Makes the trunk's six accelerations unique where no foot stands; too small to matter elsewhere.
constexpr double kTrunkWeight = 1e-4;
// Rows of the goals of bodies: both feet and the trunk.
constexpr Index kLeftRow = 0, kRightRow = 6, kTrunkRow = 12, kBodyRows = 15;

void bodyRows(const Legs& legs, const Posture& at, TaskValue& value) {
  value.y = VectorXd::Zero(kBodyRows);
  value.J.resize(kBodyRows, at.model.nv());
  value.J.middleRows<6>(kLeftRow) = poseJacobian(at.model, at.poses, legs.leftFoot, legs.p_FS);
  value.J.middleRows<6>(kRightRow) = poseJacobian(at.model, at.poses, legs.rightFoot, legs.p_FS);
  value.J.middleRows<3>(kTrunkRow) = angularJacobian(at.model, at.poses, legs.trunk);
}

Matrix3d crossWith(const Vector3d& p) {
  Matrix3d cross;
  cross << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
  return cross;
}

// The corners of the soles that stand, and the Jacobians of all of them, one below the other.
struct Corners {
  std::vector<Vector3d> p_WC{};
  MatrixXd J{};
};

Corners cornersOf(const Model& model, const Legs& legs, const Sole& sole, const BodyPoses& poses,
                  const WholeBodyGoal& goal) {
  Corners corners;
  corners.J.resize(12 * (goal.left.stands + goal.right.stands), model.nv());
  Index row = 0;
  for (const BodyId foot : {legs.leftFoot, legs.rightFoot}) {
    if (!(foot == legs.leftFoot ? goal.left : goal.right).stands) continue;
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        const Vector3d p_FC = legs.p_FS + Vector3d(x * sole.length, y * sole.width, 0);
        corners.p_WC.push_back(poses[foot] * p_FC);
        corners.J.middleRows<3>(row) = positionJacobian(model, poses, foot, p_FC);
        row += 3;
      }
    }
  }
  return corners;
}

// 1/2 |L x - r|^2 + ..., for x = (a, contact forces).
struct Cost {
  MatrixXd H;
  VectorXd g;

  explicit Cost(Index size) : H(MatrixXd::Zero(size, size)), g(VectorXd::Zero(size)) {}

  // weight/2 |A x - b|^2, where A has columns from `first` on only.
  void add(double weight, const MatrixXd& A, const VectorXd& b, Index first) {
    H.block(first, first, A.cols(), A.cols()) += weight * (A.transpose() * A);
    g.segment(first, A.cols()) -= weight * (A.transpose() * b);
  }
  // weight/2 (x_i - b)^2.
  void add(double weight, Index i, double b) {
    H(i, i) += weight;
    g[i] -= weight * b;
  }
};

void requirePositiveOptions(const Sole& sole, const WholeBodyOptions& options) {
  requirePositive("whole-body control: length of the sole", sole.length);
  requirePositive("whole-body control: width of the sole", sole.width);
  const std::pair<const char*, double> all[] = {{"friction", options.friction},
                                                {"weight of standing feet", options.standing},
                                                {"weight of swinging feet", options.swinging},
                                                {"weight of the centre of mass", options.center},
                                                {"weight of the angular momentum", options.angularMomentum},
                                                {"weight of the trunk", options.trunk},
                                                {"weight of legs", options.legs},
                                                {"weight of joints", options.joints},
                                                {"weight of forces", options.forces}};
  for (const auto& [name, number] : all) requirePositive(fmt::format("whole-body control: {}", name), number);
}

}  // namespace

WholeBodyControl::WholeBodyControl(const Model& model, const Legs& legs, const Sole& sole,
                                   const WholeBodyOptions& options)
    : model_(model), legs_(legs), sole_(sole), options_(options) {
  requirePositiveOptions(sole, options);
  requirePositive("whole-body control: mass of the robot", model.mass());
  const Body& trunk = model[legs.trunk];
  if (trunk.joint == kNoJoint || model[trunk.joint].type != JointType::kFree)
    throw Error({.what = fmt::format("whole-body control: trunk '{}'", trunk.name),
                 .found = "no free joint that moves it",
                 .wanted = "a robot with a free base"});
  base_ = model[trunk.joint].vIndex;
  effort_.resize(model.nv());
  weight_ = VectorXd::Constant(model.nv(), options.joints);
  for (const Joint& joint : model.joints())
    effort_.segment(joint.vIndex, joint.nv).setConstant(joint.maxEffort);
  effort_.segment<6>(base_).setZero();
  for (const BodyId foot : {legs.leftFoot, legs.rightFoot}) {
    for (BodyId body = foot; body != legs.trunk; body = model[body].parent) {
      if (body == kWorld)
        throw Error({.what = fmt::format("whole-body control: foot '{}'", model[foot].name),
                     .found = fmt::format("no way from it to the trunk '{}'", trunk.name),
                     .wanted = "feet at the ends of legs"});
      const Joint* joint = model[body].joint == kNoJoint ? nullptr : &model[model[body].joint];
      if (joint != nullptr) weight_.segment(joint->vIndex, joint->nv).setConstant(options.legs);
    }
  }
  weight_.segment<6>(base_).setConstant(kTrunkWeight);
}

WholeBodyForces WholeBodyControl::forces(const State& state, const WholeBodyGoal& goal,
                                         const std::vector<int>& guess) const {
  const Index nv = model_.nv();
  requireSize("whole-body control: goals of joints", goal.joints.size(), model_.nv());
  for (const Vector3d& one : {goal.center_W, goal.angularMomentum_W, goal.trunk_W})
    requireFinite("whole-body control: goal", one);
  for (const FootGoal* foot : {&goal.left, &goal.right})
    requireFinite("whole-body control: goal of a foot", foot->acceleration);
  requireFinite("whole-body control: goals of joints", goal.joints);
  const BodyPoses poses = forwardKinematics(model_, state.q);
  const TaskMap map = [&](const Posture& at, TaskValue& value) { bodyRows(legs_, at, value); };
  const VectorXd drift = velocityAcceleration(model_, state, map);
  TaskValue bodies;
  map({model_, state.q, poses}, bodies);
  EquationOfMotion motion = equationOfMotion(model_, state.q, state.v);
  motion.F -= springForces(model_, state.q);
  const Vector3d center = centerOfMass(model_, poses);
  const Corners corners = cornersOf(model_, legs_, sole_, poses, goal);
  const Index nf = corners.J.rows(), size = nv + nf;

  Cost cost(size);
  const auto addBody = [&](Index row, Index count, double weight, const VectorXd& wanted) {
    cost.add(weight, bodies.J.middleRows(row, count), wanted - drift.segment(row, count), 0);
  };
  addBody(kLeftRow, 6, goal.left.stands ? options_.standing : options_.swinging, goal.left.acceleration);
  addBody(kRightRow, 6, goal.right.stands ? options_.standing : options_.swinging, goal.right.acceleration);
  addBody(kTrunkRow, 3, options_.trunk, goal.trunk_W);
  for (Index i = 0; i < nv; ++i) {
    const bool isTrunk = i >= base_ && i < base_ + 6;
    cost.add(weight_[i], i, isTrunk ? 0 : goal.joints[i]);
  }
  // The momenta change by the contact forces and gravity alone.
  MatrixXd push(3, nf), twist(3, nf);
  for (std::size_t i = 0; i < corners.p_WC.size(); ++i) {
    const auto column = static_cast<Index>(3 * i);
    push.middleCols<3>(column) = Matrix3d::Identity() / model_.mass();
    twist.middleCols<3>(column) = crossWith(corners.p_WC[i] - center);
  }
  cost.add(options_.center, push, goal.center_W - earthGravity(), nv);
  cost.add(options_.angularMomentum, twist, goal.angularMomentum_W, nv);
  for (Index i = nv; i < size; ++i) cost.add(options_.forces, i, 0);

  // Rows: M a - J^T f = u - F with u within the limits, and four faces of each friction pyramid.
  const Index rows = nv + 4 * static_cast<Index>(corners.p_WC.size());
  MatrixXd A = MatrixXd::Zero(rows, size);
  VectorXd lower = VectorXd::Zero(rows),
           upper = VectorXd::Constant(rows, std::numeric_limits<double>::infinity());
  A.topLeftCorner(nv, nv) = motion.M;
  A.topRightCorner(nv, nf) = -corners.J.transpose();
  lower.head(nv) = -effort_ - motion.F;
  upper.head(nv) = effort_ - motion.F;
  for (Index i = 0; i < rows - nv; ++i) {
    const Index point = nv + 3 * (i / 4);
    A(nv + i, point + i % 4 / 2) = i % 2 == 0 ? 1 : -1;
    A(nv + i, point + 2) = options_.friction;
  }
  std::vector<int> first;
  for (int i = 0; i < 6; ++i) first.push_back(base_ + i);
  for (const int row : guess)
    if (row >= 0 && row < rows && (row < base_ || row >= base_ + 6)) first.push_back(row);
  const QuadraticSolution solution = QuadraticProgram(cost.H, A).minimize(cost.g, lower, upper, first);

  WholeBodyForces out{.status = solution.status, .residual = solution.residual};
  if (solution.status != QuadraticStatus::kOptimal) return out;
  out.active = solution.active;
  out.a = solution.x.head(nv);
  const VectorXd f = solution.x.tail(nf);
  out.u = motion.M * out.a + motion.F - corners.J.transpose() * f;
  out.u = out.u.cwiseMax(-effort_).cwiseMin(effort_);
  for (std::size_t i = 0; i < corners.p_WC.size(); ++i)
    out.contacts.push_back({corners.p_WC[i], f.segment<3>(static_cast<Index>(3 * i))});
  return out;
}

}  // namespace rex
