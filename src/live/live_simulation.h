#pragma once
// The simulation behind a live page, its pushes, and recordings.
#include <optional>
#include <string>
#include <vector>

#include "dynamics/energy.h"
#include "live/hold.h"
#include "physics/physics_world.h"
#include "scene/model.h"
#include "scene/scene_spec.h"
#include "scene/state.h"

namespace rex {

/// Postures (nq each) and their times, seconds.
struct LiveRecording {
  std::vector<double> times{};
  std::vector<Eigen::VectorXd> postures{};
  std::optional<double> floor{};  ///< the height of the last one simulated on, metres
};

/// The recording as a page for browsers, as `rex simulate -o NAME.html` makes it. Throws Error as
/// reportPage(), and for an empty recording.
[[nodiscard]] std::string toReplay(const Model& model, const LiveRecording& recording);

/// A table with the names of the columns: time, then q. `rex render --motion` reads it.
[[nodiscard]] std::string toTable(const Model& model, const LiveRecording& recording);

struct LiveSimulationOptions {
  bool gravity = true;
  std::optional<double> floor{};  ///< its height, metres
  double friction = 0.6;
  Hold hold = Hold::kNone;
};

/// A push at a point of a body, p_BQ in its frame.
struct Push {
  BodyId body{};
  Eigen::Vector3d p_BQ{0, 0, 0};
  Eigen::Vector3d force_W{0, 0, 0};  ///< newtons
};

/// A scene that moves with contacts while somebody holds and pushes it.
class LiveSimulation {
 public:
  /// Joints are held where they are at the start. Throws Error as PhysicsWorld.
  LiveSimulation(const SceneSpec& spec, const LiveSimulationOptions& options, const State& start);

  /// From now on the joints are held at this posture (nq).
  void holdAt(const Eigen::VectorXd& q);
  /// Advances by this many milliseconds. Throws Error as PhysicsWorld::step().
  void advance(int milliseconds, const std::optional<Push>& push);
  [[nodiscard]] State state() const { return world_.state(); }
  [[nodiscard]] Energy energyNow() const;
  [[nodiscard]] std::vector<PhysicsContact> contacts() const { return world_.contacts(); }
  /// The model with its floor; bodies and coordinates are those of the scene.
  [[nodiscard]] const Model& model() const { return model_; }

 private:
  Model model_;
  LiveSimulationOptions options_;
  Eigen::Vector3d gravity_W_;
  PhysicsWorld world_;
  Holder holder_;
};

/// A slab under the scene, which is not drawn: the ground of pictures lies there.
[[nodiscard]] ShapeSpec floorAt(double height);

}  // namespace rex
