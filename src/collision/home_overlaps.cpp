#include <algorithm>
#include <limits>
#include <utility>

#include "collision/home_overlaps_internal.h"
#include "collision/proximity.h"
#include "kinematics/forward_kinematics.h"

namespace rex::internal {
namespace {

using Eigen::Vector3d;

// A shape at its pose, and its axis-aligned bounding box.
struct Standing {
  int shape;
  BodyId body;
  Pose X_WS;
  Vector3d low, high;
};

std::vector<Standing> standing(const Model& model) {
  const BodyPoses poses = forwardKinematics(model, model.initialPositions());
  std::vector<Standing> all;
  for (std::size_t i = 0; i < model.shapes().size(); ++i) {
    const ModelShape& shape = model.shapes()[i];
    if (!takesPart(shape) || (usesMesh(shape.shape.type) && shape.shape.mesh.isEmpty())) continue;
    const Pose X_WS = poses[shape.body] * shape.X_BS;
    const Vector3d half = X_WS.R.cwiseAbs() * halfBounds(shape.shape);
    all.push_back({static_cast<int>(i), shape.body, X_WS, X_WS.p - half, X_WS.p + half});
  }
  return all;
}

// The axis along which the boxes are spread most, so that few of them overlap along it.
int widestAxis(const std::vector<Standing>& all) {
  Vector3d low = Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Standing& one : all) {
    low = low.cwiseMin(one.X_WS.p);
    high = high.cwiseMax(one.X_WS.p);
  }
  int axis = 0;
  if (!all.empty()) (high - low).maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<HomeOverlap> homeOverlaps(
    const Model& model, double tolerance,
    const std::function<bool(const ModelShape&, const ModelShape&)>& isAsked) {
  const auto shapeOf = [&](const Standing& one) -> const ModelShape& {
    return model.shapes()[static_cast<std::size_t>(one.shape)];
  };
  std::vector<Standing> all = standing(model);
  const int axis = widestAxis(all);
  std::ranges::sort(all, {}, [&](const Standing& one) { return std::pair(one.low[axis], one.shape); });
  std::vector<HomeOverlap> found;
  for (auto a = all.begin(); a != all.end(); ++a) {
    for (auto b = a + 1; b != all.end() && b->low[axis] < a->high[axis]; ++b) {
      const bool isNear =
          (a->low.array() < b->high.array()).all() && (b->low.array() < a->high.array()).all();
      if (!isNear || a->body == b->body || !isAsked(shapeOf(*a), shapeOf(*b))) continue;
      const Standing& first = a->shape < b->shape ? *a : *b;
      const Standing& second = a->shape < b->shape ? *b : *a;
      const double depth =
          -proximity(shapeOf(first).shape, first.X_WS, shapeOf(second).shape, second.X_WS).distance;
      if (depth > tolerance) found.push_back({{first.shape, second.shape}, depth});
    }
  }
  std::ranges::sort(found, {}, [](const HomeOverlap& one) { return std::pair(one.pair.a, one.pair.b); });
  return found;
}

}  // namespace rex::internal
