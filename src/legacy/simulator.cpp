#include "legacy/simulator.h"

#include <cstdio>

#include <fmt/format.h>

#include "base/error.h"

namespace rex::legacy {
namespace {

constexpr int kMostPictures = 20;

Eigen::Vector3d inFrame(const char* what, const arr& x) {
  requireSize(what, x.vector().size(), 3);
  return x.vector();
}

Eigen::Vector3d point(const arr* rel) { return rel ? inFrame("rel", *rel) : Eigen::Vector3d::Zero(); }

Eigen::Vector3d direction(const arr* vec) { return vec ? inFrame("vec", *vec) : Eigen::Vector3d::UnitZ(); }

arr fromPoint(const Eigen::Vector3d& p) { return arr(Eigen::VectorXd(p)); }

}  // namespace

void Simulator::getJointAnglesAndVels(arr& q, arr& qdot) const {
  q = arr(simulator_.getJointAngles());
  qdot = arr(simulator_.getJointVels());
}

void Simulator::setJointAnglesAndVels(const arr& q, const arr& qdot) {
  simulator_.setJointAnglesAndVels(q.vector(), qdot.vector());
}

void Simulator::kinematicsPos(arr& y, const char* body, const arr* rel) const {
  y = fromPoint(simulator_.kinematicsPos(body, point(rel)));
}

void Simulator::jacobianPos(arr& J, const char* body, const arr* rel) const {
  J = arr(simulator_.jacobianPos(body, point(rel)));
}

void Simulator::kinematicsVec(arr& y, const char* body, const arr* vec) const {
  y = fromPoint(simulator_.kinematicsVec(body, direction(vec)));
}

void Simulator::jacobianVec(arr& J, const char* body, const arr* vec) const {
  J = arr(simulator_.jacobianVec(body, direction(vec)));
}

void Simulator::getDynamics(arr& M, arr& F) const {
  Eigen::MatrixXd mass;
  Eigen::VectorXd force;
  simulator_.getDynamics(mass, force);
  M = arr(mass);
  F = arr(force);
}

void Simulator::watch(bool, const char* text) {
  static int drawn = 0;
  if (text) std::printf("%s\n", text);
  ++drawn;
  if (drawn <= kMostPictures) simulator_.watch(fmt::format("watch-{:02}", drawn));
  if (drawn == kMostPictures + 1)
    std::fprintf(stderr, "watch: %d pictures have been drawn; later calls draw none\n", kMostPictures);
}

}  // namespace rex::legacy
