#pragma once

#include <functional>
#include <string>
#include <vector>

#include "contact/scene_world.h"
#include "physics/small_scenes.h"

namespace rex::contact {

inline constexpr double kGravity = 9.81;

/// A scene of which mechanics says in closed form what one measures.
struct ContactScene {
  std::string name{};      ///< "slope-stick"
  std::string quantity{};  ///< "steepest slope on which a box stays", for people
  std::string law{};       ///< "atan(mu)"
  std::string unit{};
  double formula = 0;  ///< the closed answer
  double reached = 0;  ///< |measured - formula| of ours is no larger
  std::function<double(const Engine&)> measured{};
  Model model;                 ///< for pictures
  Eigen::VectorXd shown{};     ///< posture of the picture
  bool bounces = false;        ///< needs a coefficient of restitution
  bool needsRigidity = false;  ///< soft contacts, or pyramids of friction, have another answer
  std::string remark{};        ///< what keeps an engine from the closed answer, if anything
};

[[nodiscard]] std::vector<ContactScene> slidingScenes();
[[nodiscard]] std::vector<ContactScene> rollingScenes();
[[nodiscard]] std::vector<ContactScene> impactScenes();
[[nodiscard]] std::vector<ContactScene> turningScenes();
[[nodiscard]] std::vector<ContactScene> grippingScenes();
/// All of them, in this order.
[[nodiscard]] std::vector<ContactScene> contactScenes();

/// Where a property of a number in [lower, upper] changes from false to true, by bisection to `width`.
[[nodiscard]] double turningPoint(double lower, double upper, double width,
                                  const std::function<bool(double)>& holds);

/// A capsule along z of the length between the centres of its ends.
[[nodiscard]] Shape capsuleShape(double radius, double length);
/// The index of the first shape of that name.
[[nodiscard]] int shapeNamed(const Model& model, const std::string& name);

}  // namespace rex::contact
