#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "course/car_marks_internal.h"
#include "estimation/covariance.h"

namespace rex::internal {

std::vector<ParticleGroup> particleGroups(const CarView& view) {
  constexpr Eigen::Index kMost = 3000;
  constexpr int kGroups = 4;
  const Eigen::Index count = view.particles.cols(), shown = std::min(count, kMost);
  const double heaviest = view.weights.size() > 0 ? view.weights.maxCoeff() : 0;
  std::array<ParticleGroup, kGroups> groups;
  for (Eigen::Index k = 0; k < shown; ++k) {
    const Eigen::Index i = k * count / shown;
    const double share = heaviest > 0 ? view.weights[i] / heaviest : 1;
    const int group = std::clamp(static_cast<int>(std::ceil(share * kGroups)) - 1, 0, kGroups - 1);
    groups[static_cast<std::size_t>(group)].poses.emplace_back(view.particles.col(i));
  }
  std::vector<ParticleGroup> result;
  for (int g = 0; g < kGroups; ++g) {
    ParticleGroup& group = groups[static_cast<std::size_t>(g)];
    group.strength = (g + 1.0) / kGroups;
    if (!group.poses.empty()) result.push_back(std::move(group));
  }
  return result;
}

Eigen::Matrix2Xd outlineOf(const PlanarGaussian& belief, double sigmas) {
  constexpr int kSides = 72;
  const Eigen::Matrix2d root = covarianceRoot(belief.covariance);
  Eigen::Matrix2Xd corners(2, kSides + 1);
  for (int i = 0; i <= kSides; ++i) {
    const double angle = 2 * std::numbers::pi * (i % kSides) / kSides;
    corners.col(i) = belief.mean + sigmas * (root * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

Eigen::Vector2d placeAt(const Eigen::Vector3d& pose, double ahead, double left) {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  return {pose[0] + c * ahead - s * left, pose[1] + s * ahead + c * left};
}

}  // namespace rex::internal
