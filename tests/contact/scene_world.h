#pragma once

#include <functional>
#include <memory>

#include "scene/state.h"

namespace rex::contact {

inline constexpr double kStep = 1e-3;  ///< seconds, of all engines

struct Material {
  double friction = 0.6, restitution = 0;
};

/// A model in the hands of an engine, in its initial state at first. Coordinates, velocities and forces are
/// those of our model.
class SceneWorld {
 public:
  virtual ~SceneWorld() = default;
  [[nodiscard]] virtual State state() const = 0;
  virtual void setState(const State& state) = 0;
  /// Generalised forces until the next call; initially none.
  virtual void setForces(const Eigen::VectorXd& u) = 0;
  /// Advances by kStep.
  virtual void step() = 0;
  /// The sum of the normal forces of all contacts of a shape (index of Model::shapes()) in the last step, N.
  [[nodiscard]] virtual double normalForce(int shape) const = 0;

  void run(double seconds);
};

using Engine = std::function<std::unique_ptr<SceneWorld>(const Model& model, const Material& material)>;

/// PhysicsWorld.
[[nodiscard]] Engine rexEngine();
/// Bullet with the settings it has by itself: its contacts, its iterations, its constraints for mimics and
/// pins. The trees of joints are built by our code.
[[nodiscard]] Engine bulletEngine();
#ifdef REX_WITH_MUJOCO
/// MuJoCo with the contact settings it has by itself. It has no coefficient of restitution.
[[nodiscard]] Engine mujocoEngine();
#endif

}  // namespace rex::contact
