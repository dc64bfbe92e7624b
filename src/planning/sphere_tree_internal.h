#pragma once

#include <vector>

#include <Eigen/Core>

#include "planning/sphere_kernel_internal.h"

namespace rex::internal {

/// A sphere of a robot in the frame of a link, and the body that it belongs to.
struct LinkSphere {
  Eigen::Vector3d center;
  double radius;
  int body;
};

/// Appends a tree of bounding spheres to `nodes` and returns its root. The spheres of one body make a tree of
/// their own, of which `rootOfBody`, indexed by body, gets the root.
int appendSphereTree(std::vector<LinkSphere> spheres, std::vector<SphereNode>& nodes,
                     std::vector<int>& rootOfBody);

}  // namespace rex::internal
