#pragma once

#include <string>
#include <vector>

#include "base/rng.h"
#include "exercise.h"
#include "geometry/pose.h"
#include "scene/model.h"
#include "scene/scene_spec.h"

// Chains of links for part 7, and their counterparts in the library.

inline std::vector<ChainLink> randomChain(rex::Rng& rng, int n) {
  const auto turned = [&] { return rex::rotation(rng.uniform(-3, 3), rng.normalVector(3)).R; };
  std::vector<ChainLink> chain;
  for (int i = 0; i < n; ++i) {
    // Moments of an ellipsoid with random axes, about random directions.
    const Eigen::Vector3d squares = rng.uniformVector(3, 0.01, 0.2);
    const Eigen::Matrix3d R = turned();
    const double mass = rng.uniform(0.2, 3);
    const Eigen::Vector3d moments = mass / 5 * (Eigen::Vector3d::Constant(squares.sum()) - squares);
    chain.push_back({turned(), rng.uniformVector(3, -0.5, 0.5), rng.normalVector(3).normalized(), mass,
                     rng.uniformVector(3, -0.3, 0.3), R * moments.asDiagonal() * R.transpose()});
  }
  return chain;
}

// The same chain as a model of the library.
inline rex::Model modelOf(const std::vector<ChainLink>& chain) {
  rex::SceneSpec spec{.name = "chain", .bodies = {}, .joints = {}, .worldShapes = {}};
  std::string parent = "world";
  for (const ChainLink& link : chain) {
    rex::BodySpec body;
    body.name = "link" + std::to_string(spec.bodies.size());
    body.mass = link.mass;
    body.p_BBcm = link.center;
    body.inertia = link.inertia;
    rex::JointSpec joint;
    joint.name = "hinge" + std::to_string(spec.joints.size());
    joint.parent = parent;
    joint.child = parent = body.name;
    joint.X_PF = {link.R_PL0, link.p_PL};
    joint.axis = link.axis;
    spec.bodies.push_back(body);
    spec.joints.push_back(joint);
  }
  return rex::compile(spec);
}
