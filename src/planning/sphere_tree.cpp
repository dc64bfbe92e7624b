#include <algorithm>
#include <span>

#include "planning/sphere_tree_internal.h"

namespace rex::internal {
namespace {

using Spheres = std::span<LinkSphere>;

struct Ball {
  Eigen::Vector3d center;
  double radius;
};

double farthestFrom(const LinkSphere& sphere, const Eigen::Vector3d& from) {
  return (sphere.center - from).norm() + sphere.radius;
}

// A ball around all spheres, nearly the smallest: its centre moves towards the farthest point by ever smaller
// steps (Badoiu and Clarkson 2003).
Ball ballAround(Spheres spheres) {
  if (spheres.size() == 1) return {spheres[0].center, spheres[0].radius};
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const LinkSphere& sphere : spheres) center += sphere.center / static_cast<double>(spheres.size());
  const auto isNearer = [&](const LinkSphere& a, const LinkSphere& b) {
    return farthestFrom(a, center) < farthestFrom(b, center);
  };
  for (int i = 2; i < 500; ++i) {
    const LinkSphere& last = *std::max_element(spheres.begin(), spheres.end(), isNearer);
    const Eigen::Vector3d apart = last.center - center;
    const double distance = apart.norm();
    if (distance == 0) break;
    center += apart * ((distance + last.radius) / distance / i);
  }
  return {center, farthestFrom(*std::max_element(spheres.begin(), spheres.end(), isNearer), center)};
}

// Sorts the spheres along the direction in which they spread most, and returns where to divide them.
std::size_t middleOf(Spheres spheres) {
  Eigen::Vector3d low = spheres[0].center, high = low;
  for (const LinkSphere& sphere : spheres) {
    low = low.cwiseMin(sphere.center);
    high = high.cwiseMax(sphere.center);
  }
  Eigen::Index axis;
  (high - low).maxCoeff(&axis);
  std::stable_sort(spheres.begin(), spheres.end(), [axis](const LinkSphere& a, const LinkSphere& b) {
    return a.center[axis] < b.center[axis];
  });
  return spheres.size() / 2;
}

bool isOneBody(Spheres spheres) {
  return std::all_of(spheres.begin(), spheres.end(),
                     [&](const LinkSphere& sphere) { return sphere.body == spheres[0].body; });
}

// Where the second half of the bodies begins; spheres of a body are adjacent.
std::size_t middleOfBodies(Spheres spheres) {
  std::size_t middle = spheres.size() / 2, after = middle;
  while (middle > 0 && spheres[middle - 1].body == spheres[middle].body) --middle;
  while (after < spheres.size() && spheres[after].body == spheres[spheres.size() / 2].body) ++after;
  return middle > 0 ? middle : after;
}

int appendTree(Spheres spheres, bool isPartOfBody, std::vector<SphereNode>& nodes,
               std::vector<int>& rootOfBody) {
  const int root = static_cast<int>(nodes.size());
  const Ball ball = ballAround(spheres);
  SphereNode node{.radius = static_cast<float>(ball.radius), .isLeaf = spheres.size() == 1};
  for (int i = 0; i < 3; ++i) node.center[i] = static_cast<float>(ball.center[i]);
  nodes.push_back(node);
  const bool isOne = isOneBody(spheres);
  if (isOne && !isPartOfBody) rootOfBody[static_cast<std::size_t>(spheres[0].body)] = root;
  if (spheres.size() > 1) {
    const std::size_t middle = isOne ? middleOf(spheres) : middleOfBodies(spheres);
    appendTree(spheres.subspan(0, middle), isOne, nodes, rootOfBody);
    appendTree(spheres.subspan(middle), isOne, nodes, rootOfBody);
  }
  nodes[static_cast<std::size_t>(root)].next = static_cast<int>(nodes.size());
  return root;
}

}  // namespace

int appendSphereTree(std::vector<LinkSphere> spheres, std::vector<SphereNode>& nodes,
                     std::vector<int>& rootOfBody) {
  return appendTree(spheres, false, nodes, rootOfBody);
}

}  // namespace rex::internal
