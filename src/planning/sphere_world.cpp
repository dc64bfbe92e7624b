#include <cmath>

#include <fmt/format.h>

#include "base/cpu_lanes.h"
#include "base/error.h"
#include "base/require.h"
#include "planning/sphere_world_internal.h"

namespace rex {
namespace {

using internal::SphereObstacle;
using ObstacleKind = SphereObstacle::Kind;

bool isUprightBox(const Eigen::Matrix3d& R) { return std::abs(R(2, 0)) < 1e-7 && std::abs(R(2, 1)) < 1e-7; }

SphereObstacle obstacleOf(const ShapeSpec& spec) {
  const Shape& shape = spec.shape;
  SphereObstacle obstacle{.radius = static_cast<float>(shape.radius)};
  for (int i = 0; i < 9; ++i) obstacle.R[i] = static_cast<float>(spec.X_BS.R(i % 3, i / 3));
  for (int i = 0; i < 3; ++i) obstacle.p[i] = static_cast<float>(spec.X_BS.p[i]);
  if (shape.type == ShapeType::kBox) {
    obstacle.kind = isUprightBox(spec.X_BS.R) ? ObstacleKind::kUprightBox : ObstacleKind::kBox;
    for (int i = 0; i < 3; ++i) obstacle.half[i] = static_cast<float>(shape.extent[i] / 2);
    return obstacle;
  }
  const bool isCylinder = shape.type == ShapeType::kCylinder, isSphere = shape.type == ShapeType::kSphere;
  if (!isCylinder && !isSphere && shape.type != ShapeType::kCapsule)
    throw Error({.what = fmt::format("obstacle '{}'", spec.name),
                 .found = fmt::format("a {}", toString(shape.type)),
                 .wanted = "a box, sphere, capsule or cylinder"});
  obstacle.kind = isCylinder ? ObstacleKind::kCylinder : ObstacleKind::kCapsule;
  if (!isSphere) obstacle.half[2] = static_cast<float>(shape.extent.z() / 2);
  return obstacle;
}

// How far an obstacle extends from the origin.
double extentOf(const ShapeSpec& spec) { return spec.X_BS.p.norm() + halfBounds(spec.shape).norm(); }

// Twenty times what double the roundings of a chain of ten links cost, in metres and radians of order one.
constexpr double kSlack = 2e-6;

constexpr float kFinest = 1e-3f;

void addGuards(SphereWorld::Data& data) {
  const SphereRobot::Data& robot = data.robot.data();
  const std::size_t count = data.obstacles.size(), guards = static_cast<std::size_t>(robot.guards);
  std::vector<unsigned> bits(count);
  data.reachable.resize(count * guards);
  for (std::size_t g = 0; g < guards; ++g) {
    const float* balls = robot.balls.data() + g / 8 * 32;
    if (g % 8 == 0)
      data.kernel.reached(data.obstacles.data(), static_cast<int>(count), balls, balls + 24, bits.data());
    int* const list = data.reachable.data() + g * count;
    int* end = list;
    for (std::size_t o = 0; o < count; ++o)
      if ((bits[o] >> g % 8 & 1u) != 0) *end++ = static_cast<int>(o);
    if (end > list) data.guards.push_back({static_cast<int>(g), static_cast<int>(end - list), list});
  }
}

}  // namespace

SphereWorld::SphereWorld(const SphereRobot& robot, std::span<const ShapeSpec> obstacles)
    : SphereWorld(robot, obstacles, cpuLanes()) {}

SphereWorld::SphereWorld(const SphereRobot& robot, std::span<const ShapeSpec> obstacles, int lanes)
    : data_(std::make_unique<Data>(robot, kernelFor<internal::SphereKernel>(lanes))) {
  const SphereRobot::Data& parts = robot.data();
  double size = parts.size;
  for (const ShapeSpec& obstacle : obstacles) {
    data_->obstacles.push_back(obstacleOf(obstacle));
    size = std::max(size, extentOf(obstacle));
  }
  addGuards(*data_);
  data_->scene = {.slack = static_cast<float>(kSlack * (1 + size) * std::max(1., parts.largestAngle / 4)),
                  .finest = kFinest,
                  .coordinates = robot.nq(),
                  .linkCount = static_cast<int>(parts.links.size()),
                  .nodeCount = static_cast<int>(parts.nodes.size()),
                  .guardCount = static_cast<int>(data_->guards.size()),
                  .linkPairCount = static_cast<int>(parts.linkPairs.size()),
                  .links = parts.links.data(),
                  .nodes = parts.nodes.data(),
                  .groups = parts.groups.data(),
                  .reach = parts.reach.data(),
                  .approach = parts.approach.data(),
                  .guards = data_->guards.data(),
                  .linkPairs = parts.linkPairs.data(),
                  .pairs = parts.pairs.data(),
                  .obstacles = data_->obstacles.data()};
}

SphereWorld::~SphereWorld() = default;

bool SphereWorld::isFree(const VectorArg& q) const { return isFree(q, q); }

bool SphereWorld::isFree(const VectorArg& from, const VectorArg& to) const {
  requireSize("q", from.size(), data_->scene.coordinates);
  requireSize("q", to.size(), data_->scene.coordinates);
  requireFinite("q", from);
  requireFinite("q", to);
  const Eigen::VectorXf a = from.cast<float>(), b = to.cast<float>();
  internal::SphereCount count;
  return data_->kernel.isFree(data_->scene, a.data(), b.data(), count);
}

double SphereWorld::slack() const { return data_->scene.slack; }

}  // namespace rex
