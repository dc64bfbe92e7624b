#include <memory>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "bench/physics_peer.h"

namespace rex::bench {
namespace {

class BoxWorld {
 public:
  BoxWorld(const Boxes& boxes, int iterations) {
    world_.setGravity({0, 0, -9.81});
    world_.getSolverInfo().m_numIterations = iterations;
    world_.getSolverInfo().m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
    add(0, ground_, {0, 0, -0.5});
    for (int row = 0; row < boxes.rows; ++row) {
      for (int column = 0; column < boxes.columns; ++column) {
        const Eigen::Vector3d p = boxes.center(row, column);
        add(kBoxMass, box_, {p.x(), p.y(), p.z()});
      }
    }
  }
  ~BoxWorld() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  BoxWorld(const BoxWorld&) = delete;
  BoxWorld& operator=(const BoxWorld&) = delete;

  void step() { world_.stepSimulation(kPhysicsStep, 0); }
  double height() const { return bodies_.back()->getCenterOfMassPosition().z(); }

 private:
  void add(double mass, btBoxShape& shape, const btVector3& place) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    auto& body = bodies_.emplace_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    body->setCenterOfMassTransform(btTransform(btQuaternion::getIdentity(), place));
    body->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(body.get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  btBoxShape ground_{btVector3(50, 50, 0.5)};
  btBoxShape box_{btVector3(kBoxEdge / 2, kBoxEdge / 2, kBoxEdge / 2)};
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

}  // namespace

PhysicsPeer bulletBoxes(const Boxes& boxes, int iterations) {
  const auto world = std::make_shared<BoxWorld>(boxes, iterations);
  return {[world] { world->step(); }, [world] { return world->height(); }};
}

}  // namespace rex::bench
