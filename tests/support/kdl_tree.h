#pragma once

#include <vector>

#include <kdl/tree.hpp>

#include "scene/model.h"

namespace rex {

/// The scene as a tree of Orocos KDL, a segment per body of the same name. For scenes of hinges, sliders and
/// rigid joints; any other joint is an assertion. KDL renumbers the joints whenever it copies a tree, solvers
/// included: rely on chains.
KDL::Tree kdlTree(const Model& model);

/// The chain from the world to a body, and where its joints stand in q and v.
struct KdlChain {
  KDL::Chain chain;
  std::vector<int> indices;
};
KdlChain kdlChain(const Model& model, const KDL::Tree& tree, BodyId body);

KDL::Frame kdlFrame(const Pose& X);
Pose poseFrom(const KDL::Frame& frame);

}  // namespace rex
