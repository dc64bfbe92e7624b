#include <memory>

#include <kdl/chainiksolverpos_lma.hpp>

#include "bench/ik_peer.h"
#include "support/kdl_tree.h"

namespace rex::bench {
namespace {

constexpr double kTolerance = 1e-5;
constexpr int kMaxIterations = 500;  // its default

// Sized by KDL first: what its library frees must come from its library, not from our Eigen.
KDL::JntArray jointArray(const Eigen::VectorXd& values) {
  KDL::JntArray array(static_cast<unsigned>(values.size()));
  array.data = values;
  return array;
}

class Solver {
 public:
  explicit Solver(const ReachableRobot& robot)
      : middle_(robot.middle),
        chain_(kdlChain(robot.model, kdlTree(robot.model), robot.tip)),
        start_(jointArray(robot.middle(chain_.indices))),
        found_(start_),
        marquardt_(chain_.chain, Eigen::Matrix<double, 6, 1>::Ones(), kTolerance, kMaxIterations) {
    for (const Pose& X_WT : robot.targets) targets_.push_back(kdlFrame(X_WT));
  }

  Eigen::VectorXd solve(std::size_t k) {
    marquardt_.CartToJnt(start_, targets_[k], found_);
    Eigen::VectorXd q = middle_;
    q(chain_.indices) = found_.data;
    return q;
  }

 private:
  Eigen::VectorXd middle_;
  KdlChain chain_;
  KDL::JntArray start_, found_;
  KDL::ChainIkSolverPos_LMA marquardt_;
  std::vector<KDL::Frame> targets_;
};

}  // namespace

SolveIk kdlMarquardt(const ReachableRobot& robot) {
  return [kdl = std::make_shared<Solver>(robot)](std::size_t k) { return kdl->solve(k); };
}

}  // namespace rex::bench
