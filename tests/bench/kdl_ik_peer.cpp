#include <memory>

#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_pinv.hpp>

#include "bench/ik_peer.h"
#include "support/kdl_tree.h"

namespace rex::bench {
namespace {

constexpr double kTolerance = 1e-5;
constexpr int kMaxIterations = 500;  // the default of LMA; NR_JL has 100, and solves less with that

// Sized by KDL first: what its library frees must come from its library, not from our Eigen.
KDL::JntArray jointArray(const Eigen::VectorXd& values) {
  KDL::JntArray array(static_cast<unsigned>(values.size()));
  array.data = values;
  return array;
}

class Solvers {
 public:
  explicit Solvers(const ReachableRobot& robot)
      : middle_(robot.middle),
        chain_(kdlChain(robot.model, kdlTree(robot.model), robot.tip)),
        start_(jointArray(robot.middle(chain_.indices))),
        found_(start_),
        fk_(chain_.chain),
        velocity_(chain_.chain),
        marquardt_(chain_.chain, Eigen::Matrix<double, 6, 1>::Ones(), kTolerance, kMaxIterations),
        newton_(chain_.chain, jointArray(robot.model.lowerLimits()(chain_.indices)),
                jointArray(robot.model.upperLimits()(chain_.indices)), fk_, velocity_, kMaxIterations,
                kTolerance) {
    for (const Pose& X_WT : robot.targets) targets_.push_back(kdlFrame(X_WT));
  }

  Eigen::VectorXd marquardt(std::size_t k) {
    marquardt_.CartToJnt(start_, targets_[k], found_);
    return found();
  }

  Eigen::VectorXd newton(std::size_t k) {
    newton_.CartToJnt(start_, targets_[k], found_);
    return found();
  }

 private:
  Eigen::VectorXd found() const {
    Eigen::VectorXd q = middle_;
    q(chain_.indices) = found_.data;
    return q;
  }

  Eigen::VectorXd middle_;
  KdlChain chain_;
  KDL::JntArray start_, found_;
  KDL::ChainFkSolverPos_recursive fk_;
  KDL::ChainIkSolverVel_pinv velocity_;
  KDL::ChainIkSolverPos_LMA marquardt_;
  KDL::ChainIkSolverPos_NR_JL newton_;
  std::vector<KDL::Frame> targets_;
};

}  // namespace

IkPeer kdlIkPeer(const ReachableRobot& robot) {
  const auto kdl = std::make_shared<Solvers>(robot);
  return {.levenbergMarquardt = [kdl](std::size_t k) { return kdl->marquardt(k); },
          .newtonWithLimits = [kdl](std::size_t k) { return kdl->newton(k); }};
}

}  // namespace rex::bench
