#include "contact/scene_world.h"

#include <cmath>

#include "physics/physics_world.h"

namespace rex::contact {
namespace {

class RexWorld : public SceneWorld {
 public:
  RexWorld(const Model& model, const Material& material)
      : world_(model, {.friction = material.friction, .restitution = material.restitution}) {}

  [[nodiscard]] State state() const override { return world_.state(); }
  void setState(const State& state) override { world_.setState(state); }
  void setForces(const Eigen::VectorXd& u) override {
    std::vector<Motor> motors;
    for (const double force : u) motors.push_back({.target = force});
    world_.setMotors(motors);
  }
  void step() override { world_.step(kStep); }
  [[nodiscard]] double normalForce(int shape) const override {
    double impulse = 0;
    for (const PhysicsContact& one : world_.contacts())
      if (one.shapeA == shape || one.shapeB == shape) impulse += one.impulse;
    return impulse / kStep;
  }

 private:
  PhysicsWorld world_;
};

}  // namespace

void SceneWorld::run(double seconds) {
  for (long i = 0; i < std::lround(seconds / kStep); ++i) step();
}

Engine rexEngine() {
  return [](const Model& model, const Material& material) {
    return std::make_unique<RexWorld>(model, material);
  };
}

}  // namespace rex::contact
