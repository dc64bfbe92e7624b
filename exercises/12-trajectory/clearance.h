#pragma once

#include "collision/contacts.h"
#include "exercise.h"
#include "kinematics/forward_kinematics.h"
#include "scene/model.h"

// Given for part 4.

/// The distance y of each pair of shapes of the scene that may touch, metres, negative in overlap, and its
/// Jacobian by q (pairs x n), at S's configuration.
inline TermValue clearances(const rex::Simulator& S) {
  const rex::Model& model = S.model();
  const rex::ContactModel contacts(model);
  const rex::BodyPoses poses = rex::forwardKinematics(model, S.getJointAngles());
  const std::vector<rex::Proxy> near = rex::proxies(contacts, poses, 1e3);
  const auto pairs = static_cast<Eigen::Index>(near.size());
  TermValue value{Eigen::VectorXd(pairs), Eigen::MatrixXd(pairs, model.nv())};
  for (Eigen::Index i = 0; i < pairs; ++i) {
    const rex::Proxy& pair = near[static_cast<std::size_t>(i)];
    value.y[i] = pair.proximity.distance;
    value.J.row(i) = rex::distanceJacobian(model, poses, pair, contacts);
  }
  return value;
}
