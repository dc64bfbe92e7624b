#include <memory>
#include <span>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/treejnttojacsolver.hpp>

#include "bench/kinematics_peer.h"
#include "kinematics/jacobians.h"
#include "support/kdl_tree.h"

namespace rex::bench {
namespace {

// A step of forward kinematics through a tree, for which KDL has no solver of its own.
struct Link {
  KDL::Segment segment;
  std::size_t parent;
  int qIndex;  // -1: fixed
};

class Solvers {
 public:
  Solvers(const Robot& robot, const KDL::Tree& tree)
      : chain_(kdlChain(robot.model, tree, robot.tip)),
        fk_(chain_.chain),
        jacobian_(tree),
        tip_(robot.model[robot.tip].name) {
    isChain_ = tree.getNrOfSegments() == chain_.chain.getNrOfSegments();
    const KDL::Tree renumbered(tree);  // as the solver's own copy
    columns_.resize(tree.getNrOfJoints());
    for (const Body& body : std::span(robot.model.bodies()).subspan(1)) {
      const bool moves = body.joint != kNoJoint && robot.model[body.joint].nv > 0;
      const int qIndex = body.joint == kNoJoint ? -1 : robot.model[body.joint].qIndex;
      links_.push_back(
          {tree.getSegment(body.name)->second.segment, static_cast<std::size_t>(body.parent), qIndex});
      if (moves) columns_[renumbered.getSegment(body.name)->second.q_nr] = qIndex;
    }
    // Sized by KDL first: what its library frees must come from its library, not from our Eigen.
    for (const auto& q : robot.Q.colwise()) {
      Q_.emplace_back(static_cast<unsigned>(q.size())).data = q;
      chainQ_.emplace_back(chain_.chain.getNrOfJoints()).data = q(chain_.indices);
      treeQ_.emplace_back(tree.getNrOfJoints()).data = q(columns_);
    }
    frames.resize(isChain_ ? links_.size() : links_.size() + 1);
    J.resize(tree.getNrOfJoints());
  }

  void forwardKinematics(int k) {
    if (isChain_) {
      fk_.JntToCart(chainQ_[k], frames);
      return;
    }
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const Link& link = links_[i];
      frames[i + 1] = frames[link.parent] * link.segment.pose(link.qIndex < 0 ? 0. : Q_[k](link.qIndex));
    }
  }

  void jacobian(int k) { jacobian_.JntToJac(treeQ_[k], J, tip_); }

  const KDL::Frame& frame(std::size_t body) const { return frames[isChain_ ? body - 1 : body]; }
  // Where the columns of its Jacobian stand in ours.
  const std::vector<int>& columns() const { return columns_; }

  std::vector<KDL::Frame> frames;
  KDL::Jacobian J;

 private:
  KdlChain chain_;
  KDL::ChainFkSolverPos_recursive fk_;
  KDL::TreeJntToJacSolver jacobian_;  // faster than the one for chains
  std::string tip_;
  bool isChain_ = false;
  std::vector<Link> links_;
  std::vector<int> columns_;
  std::vector<KDL::JntArray> Q_, chainQ_, treeQ_;
};

void requireSameResults(const Robot& robot, Solvers& kdl, int k) {
  const BodyPoses poses = forwardKinematics(robot.model, robot.Q.col(k));
  kdl.forwardKinematics(k);
  for (std::size_t i = 1; i < poses.X_WB.size(); ++i) {
    const Pose theirs = poseFrom(kdl.frame(i));
    requireAgreement(robot.name + ": KDL positions", poses.X_WB[i].p, theirs.p);
    requireAgreement(robot.name + ": KDL rotations", poses.X_WB[i].R, theirs.R);
  }
  Eigen::MatrixXd J(6, robot.model.nv());
  J << positionJacobian(robot.model, poses, robot.tip, Eigen::Vector3d::Zero()),
      angularJacobian(robot.model, poses, robot.tip);
  kdl.jacobian(k);
  requireAgreement(robot.name + ": KDL Jacobian", J(Eigen::all, kdl.columns()), kdl.J.data);
}

}  // namespace

KinematicsPeer kdlPeer(const Robot& robot) {
  const auto kdl = std::make_shared<Solvers>(robot, kdlTree(robot.model));
  for (int k = 0; k < Robot::kPostures; ++k) requireSameResults(robot, *kdl, k);
  return {.forwardKinematics = [kdl](int k) { kdl->forwardKinematics(k); },
          .jacobian = [kdl](int k) { kdl->jacobian(k); }};
}

}  // namespace rex::bench
