#pragma once

#include <memory>
#include <span>

#include "scene/model.h"

namespace rex {

/// A robot whose shapes in contact are all spheres, prepared for checking its motions in single precision.
/// Copies share their data.
class SphereRobot {
 public:
  /// Pairs of its bodies may collide as pairVerdicts() says. Throws Error naming what it is for a shape in
  /// contact that is not a sphere, a joint that is neither a hinge nor a slider, a coordinate without limits,
  /// and a robot that is too large: more than 16 coordinates, 24 moving links, 128 pairs of links or 512
  /// nodes of its sphere trees.
  explicit SphereRobot(const Model& model);

  [[nodiscard]] int nq() const;
  [[nodiscard]] const Eigen::VectorXd& lowerLimits() const;
  [[nodiscard]] const Eigen::VectorXd& upperLimits() const;

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// A robot of spheres among obstacles at rest. It checks eight postures at once, and proves motions: their
/// stretches are halved until no sphere can move far enough to touch anything, given its speed in the middle
/// and a bound of its acceleration. Results are the same on every machine.
class SphereWorld {
 public:
  /// Obstacles are boxes, spheres, capsules and cylinders in the world, which may collide with all bodies
  /// that move. `lanes` as in kernelFor(). Throws Error naming the obstacle for another shape.
  SphereWorld(const SphereRobot& robot, std::span<const ShapeSpec> obstacles);
  SphereWorld(const SphereRobot& robot, std::span<const ShapeSpec> obstacles, int lanes);
  ~SphereWorld();

  /// Whether all pairs are apart. If so, they are so exactly; if not, they overlap or are nearer than
  /// slack(). Throws Error for a wrong size and numbers that are not finite.
  [[nodiscard]] bool isFree(const VectorArg& q) const;
  /// Whether all pairs stay apart while q moves straight from `from` to `to`: then that is proven. If not,
  /// they overlap or come nearer than 3 mm somewhere. Throws as above.
  [[nodiscard]] bool isFree(const VectorArg& from, const VectorArg& to) const;
  /// More than rounding to single precision changes any distance, metres: some 1e-5 within a few metres.
  [[nodiscard]] double slack() const;

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rex
