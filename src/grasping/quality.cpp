#include "grasping/quality.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "base/require.h"
#include "geometry/facet_hull.h"

namespace rex {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBorder = 1e-12;  // of the longest wrench

constexpr std::size_t kMostNewWrenches = 32;

// The wrench of the cones that lies farthest along a direction.
VectorXd farthest(std::span<const WrenchCone> cones, const VectorXd& direction, ForceBudget budget) {
  if (budget == ForceBudget::kPerFinger) {
    VectorXd sum = VectorXd::Zero(direction.size());
    for (const WrenchCone& cone : cones)
      if (const VectorXd one = cone.lowest(-direction); direction.dot(one) > 0) sum += one;
    return sum;
  }
  VectorXd best = cones[0].lowest(-direction);
  for (const WrenchCone& cone : cones.subspan(1))
    if (VectorXd other = cone.lowest(-direction); direction.dot(other) > direction.dot(best))
      best = std::move(other);
  return best;
}

// Facets with offsets below `limit`, lowest first.
std::vector<Index> lowFacets(const FacetHull& hull, double limit) {
  std::vector<Index> facets;
  for (Index f = 0; f < hull.offsets.size(); ++f)
    if (hull.offsets[f] < limit) facets.push_back(f);
  std::stable_sort(facets.begin(), facets.end(),
                   [&](Index a, Index b) { return hull.offsets[a] < hull.offsets[b]; });
  return facets;
}

// Lowers the upper bound by what the cones reach along low facets, and adds those wrenches to the hull's.
void refine(std::span<const WrenchCone> cones, const FacetHull& hull, double tolerance, ForceBudget budget,
            EpsilonBounds& bounds, MatrixXd& wrenches) {
  std::vector<VectorXd> more;
  for (const Index f : lowFacets(hull, bounds.atMost - tolerance)) {
    if (more.size() == kMostNewWrenches || hull.offsets[f] >= bounds.atMost - tolerance) break;
    const VectorXd direction = hull.normals.col(f);
    more.push_back(farthest(cones, direction, budget));
    const double reached = std::max(0.0, direction.dot(more.back()));
    if (reached < bounds.atMost) bounds.atMost = reached, bounds.weakest = direction;
  }
  wrenches.conservativeResize(Eigen::NoChange, wrenches.cols() + static_cast<Index>(more.size()));
  for (std::size_t k = 0; k < more.size(); ++k)
    wrenches.col(wrenches.cols() - 1 - static_cast<Index>(k)) = more[k];
}

}  // namespace

GraspQuality graspQuality(const MatrixArg& wrenches) {
  if (wrenches.cols() == 0) return {};
  const FacetHull hull = facetHull(wrenches);
  GraspQuality quality;
  quality.dimension = hull.dimension;
  if (hull.dimension < 0) return quality;
  quality.status = HullStatus::kFlat;
  if (hull.normals.cols() == 0) return quality;
  Index facet = 0;
  const double least = hull.offsets.minCoeff(&facet);
  quality.volume = hull.volume;
  quality.weakest = hull.normals.col(facet);
  quality.status =
      least > kBorder * wrenches.colwise().norm().maxCoeff() ? HullStatus::kInside : HullStatus::kOutside;
  if (quality.status == HullStatus::kInside) quality.epsilon = least;
  return quality;
}

EpsilonBounds exactEpsilon(std::span<const WrenchCone> cones, double tolerance, int mostRounds,
                           ForceBudget budget) {
  requirePositive("epsilon: tolerance", tolerance);
  requireCount("epsilon: rounds", mostRounds, 0);
  EpsilonBounds bounds;
  if (cones.empty()) return bounds;
  MatrixXd wrenches = primitiveWrenches(cones).wrenches;
  bounds.atMost = std::numeric_limits<double>::infinity();
  for (int round = 0; round <= mostRounds; ++round) {
    const FacetHull hull = facetHull(wrenches);
    if (hull.normals.cols() == 0) return {.status = HullStatus::kFlat};
    bounds.atLeast = std::max(0.0, hull.offsets.minCoeff());
    bounds.status = bounds.atLeast > 0 ? HullStatus::kInside : HullStatus::kOutside;
    refine(cones, hull, tolerance, budget, bounds, wrenches);
    if (bounds.atMost - bounds.atLeast <= tolerance) break;
  }
  return bounds;
}

}  // namespace rex
