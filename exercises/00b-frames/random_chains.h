#pragma once

#include "base/rng.h"
#include "chains.h"
#include "geometry/rotation.h"

// Random chains, and where they end.

/// X_WE by the library's poses.
inline rex::Pose trueEnd(const Chain& chain, const Eigen::VectorXd& q) {
  rex::Pose X;
  int k = 0;
  for (const ChainJoint& one : chain.joints) {
    const Eigen::Vector3d move = q[k++] * one.axis;
    const bool slides = one.kind == JointKind::kPrismatic;
    X = X * poseOf(one.X_PJ) *
        (slides ? rex::translation(move.x(), move.y(), move.z()) : rex::Pose{rex::expSO3(move)});
  }
  return X * poseOf(chain.X_ME);
}

inline Eigen::Vector3d randomDirection(rex::Rng& rng) { return rng.normalVector(3).normalized(); }

inline rex::Pose randomPose(rex::Rng& rng) {
  return {rex::expSO3(rng.uniform(0.3, 2.8) * randomDirection(rng)), rng.uniformVector(3, -1, 1)};
}

/// A chain of `size` joints; the second, and some of the others, are prismatic.
inline Chain randomChain(rex::Rng& rng, int size) {
  Chain chain;
  chain.X_ME = matrixOf(randomPose(rng));
  for (int i = 0; i < size; ++i) {
    const bool slides = i == 1 || (i > 2 && rng.index(3) == 0);
    chain.joints.push_back({matrixOf(randomPose(rng)), slides ? JointKind::kPrismatic : JointKind::kRevolute,
                            randomDirection(rng)});
  }
  return chain;
}
