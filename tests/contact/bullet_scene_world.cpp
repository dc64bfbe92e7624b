#include <cmath>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyGearConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyPoint2Point.h>
#include <btBulletCollisionCommon.h>

#include "contact/scene_world.h"
#include "physics/articulation_internal.h"
#include "physics/bullet_shape_internal.h"
#include "physics/simulated_tree_internal.h"

namespace rex::contact {
namespace {

using internal::Articulation;
using internal::bulletLink;
using internal::FreeBody;
using internal::SimulatedTree;
using internal::toBullet;

std::unique_ptr<btCollisionShape> plainShape(const Shape& shape) {
  if (shape.type == ShapeType::kBox)
    return std::make_unique<btBoxShape>(toBullet(Eigen::Vector3d(shape.extent / 2)));
  if (shape.type == ShapeType::kSphere) return std::make_unique<btSphereShape>(shape.radius);
  return std::make_unique<btCapsuleShapeZ>(shape.radius, shape.extent.z());
}

// Bullet finds the island of a constraint by the shapes of its links, and does not solve it where they have
// none.
class PlainPin : public btMultiBodyPoint2Point {
 public:
  using btMultiBodyPoint2Point::btMultiBodyPoint2Point;
  int getIslandIdA() const override { return m_bodyA->getBaseCollider()->getIslandTag(); }
  int getIslandIdB() const override {
    return m_bodyB != nullptr ? m_bodyB->getBaseCollider()->getIslandTag() : -1;
  }
};

// Links are added as if they stood still, which Bullet takes for what need not collide with each other.
struct AllPairs : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

class BulletSceneWorld : public SceneWorld {
 public:
  BulletSceneWorld(const Model& model, const Material& material) : model_(model), material_(material) {
    world_.setGravity({0, 0, -9.81});
    world_.getPairCache()->setOverlapFilterCallback(&pairs_);
    for (std::size_t i = 0; i < model_.shapes().size(); ++i)
      if (model_.shapes()[i].contact && model_.shapes()[i].body == kWorld) addStill(i);
    for (int i = 1; i < static_cast<int>(model_.bodies().size()); ++i)
      if (model_[BodyId{i}].parent == kWorld) addTree(BodyId{i});
    for (const auto& mover : movers_) mover->addTo(world_);
    addCouplings();
    motors_.resize(static_cast<std::size_t>(model_.nv()));
    setState(initialState(model_));
  }
  ~BulletSceneWorld() override {
    for (const auto& one : couplings_) world_.removeMultiBodyConstraint(one.get());
    for (const auto& mover : movers_) mover->removeFrom(world_);
    for (const auto& object : still_) world_.removeCollisionObject(object.get());
  }
  BulletSceneWorld(const BulletSceneWorld&) = delete;
  BulletSceneWorld& operator=(const BulletSceneWorld&) = delete;

  [[nodiscard]] State state() const override {
    State state = initialState(model_);
    for (const auto& mover : movers_) mover->read(state);
    state.time = time_;
    return state;
  }
  void setState(const State& state) override {
    for (const auto& mover : movers_) mover->place(state);
    time_ = state.time;
  }
  void setForces(const Eigen::VectorXd& u) override {
    for (std::size_t i = 0; i < motors_.size(); ++i) motors_[i].target = u[static_cast<Eigen::Index>(i)];
  }
  void step() override {
    for (const auto& mover : movers_) mover->drive(motors_, kStep);
    world_.stepSimulation(kStep, 0);
    time_ += kStep;
  }
  [[nodiscard]] double normalForce(int shape) const override {
    double impulse = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold =
          *const_cast<btCollisionDispatcher&>(dispatcher_).getManifoldByIndexInternal(i);
      if (manifold.getBody0()->getUserIndex() != shape && manifold.getBody1()->getUserIndex() != shape)
        continue;
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        impulse += manifold.getContactPoint(k).getAppliedImpulse();
    }
    return impulse / kStep;
  }

 private:
  // Each body of the scenes has one contact shape at most, which its object is named after.
  void setUp(btCollisionObject& object, int shape) {
    object.setUserIndex(shape);
    object.setFriction(std::sqrt(material_.friction));
    object.setRestitution(std::sqrt(material_.restitution));
  }

  [[nodiscard]] int shapeOf(BodyId body) const {
    for (std::size_t i = 0; i < model_.shapes().size(); ++i)
      if (model_.shapes()[i].contact && model_.shapes()[i].body == body) return static_cast<int>(i);
    return -1;
  }

  btCollisionShape* addShape(const Shape& shape, const Pose& X_LS) {
    shapes_.push_back(plainShape(shape));
    if (X_LS.R.isIdentity(0) && X_LS.p.isZero(0)) return shapes_.back().get();
    auto compound = std::make_unique<btCompoundShape>();
    compound->addChildShape(toBullet(X_LS), shapes_.back().get());
    return shapes_.emplace_back(std::move(compound)).get();
  }

  void addStill(std::size_t i) {
    const ModelShape& shape = model_.shapes()[i];
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(addShape(shape.shape, {}));
    object->setWorldTransform(toBullet(shape.X_BS));
    setUp(*object, static_cast<int>(i));
    world_.addCollisionObject(object.get());
    still_.push_back(std::move(object));
  }

  void addTree(BodyId root) {
    std::vector<BodyId> bodies{root};
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (int child = 1; child < static_cast<int>(model_.bodies().size()); ++child)
        if (model_[BodyId{child}].parent == bodies[i]) bodies.push_back(BodyId{child});
    std::vector<btCollisionShape*> shapes;
    for (const BodyId body : bodies) {
      const int index = shapeOf(body);
      shapes.push_back(nullptr);
      if (index < 0) continue;
      const ModelShape& shape = model_.shapes()[static_cast<std::size_t>(index)];
      shapes.back() = addShape(shape.shape, bulletLink(model_[body]).X_BL.inverse() * shape.X_BS);
    }
    const Joint& joint = model_[model_[root].joint];
    if (bodies.size() == 1 && joint.type == JointType::kFree) {
      btCollisionShape* const shape = shapes[0] != nullptr ? shapes[0] : &nothing_;
      auto body = std::make_unique<FreeBody>(joint, bulletLink(model_[root]), Pose{}, shape);
      setUp(body->object(), shapeOf(root));
      movers_.push_back(std::move(body));
      return;
    }
    auto tree = std::make_unique<Articulation>(model_, bodies, Pose{}, shapes, PhysicsOptions{});
    tree->forEachObject([&](btCollisionObject& object, BodyId body) { setUp(object, shapeOf(body)); });
    trees_.push_back(tree.get());
    movers_.push_back(std::move(tree));
  }

  // The tree and the link of a body.
  [[nodiscard]] std::pair<btMultiBody*, int> linkOf(BodyId body) const {
    for (Articulation* const tree : trees_)
      if (const std::optional<int> link = tree->linkOf(body)) return {&tree->body(), *link};
    return {nullptr, 0};
  }

  void addCouplings() {
    for (const Joint& joint : model_.joints()) {
      if (!joint.mimics) continue;
      for (const Joint& leader : model_.joints()) {
        if (leader.mimics || leader.qIndex != joint.qIndex) continue;
        const auto [a, linkA] = linkOf(joint.child);
        const auto [b, linkB] = linkOf(leader.child);
        auto gear = std::make_unique<btMultiBodyGearConstraint>(
            a, linkA, b, linkB, btVector3(0, 0, 0), btVector3(0, 0, 0), btMatrix3x3::getIdentity(),
            btMatrix3x3::getIdentity());
        gear->setGearRatio(-joint.ratio);
        couplings_.push_back(std::move(gear));
      }
    }
    const auto inLink = [&](BodyId body, const Eigen::Vector3d& p) {
      return toBullet(Eigen::Vector3d(bulletLink(model_[body]).X_BL.inverse() * p));
    };
    for (const Pin& pin : model_.pins()) {
      const auto [a, linkA] = linkOf(pin.a);
      const auto [b, linkB] = linkOf(pin.b);
      if (a != nullptr && b != nullptr)
        couplings_.push_back(
            std::make_unique<PlainPin>(a, linkA, b, linkB, inLink(pin.a, pin.p_AP), inLink(pin.b, pin.p_BQ)));
      else
        couplings_.push_back(std::make_unique<PlainPin>(a, linkA, static_cast<btRigidBody*>(nullptr),
                                                        inLink(pin.a, pin.p_AP), toBullet(pin.p_BQ)));
    }
    for (const auto& one : couplings_) {
      one->finalizeMultiDof();
      world_.addMultiBodyConstraint(one.get());
    }
  }

  Model model_;
  Material material_;
  AllPairs pairs_;
  btEmptyShape nothing_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> still_;
  std::vector<std::unique_ptr<SimulatedTree>> movers_;
  std::vector<Articulation*> trees_;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> couplings_;
  std::vector<Motor> motors_;
  double time_ = 0;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btMultiBodyConstraintSolver solver_;
  btMultiBodyDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

}  // namespace

Engine bulletEngine() {
  return [](const Model& model, const Material& material) {
    return std::make_unique<BulletSceneWorld>(model, material);
  };
}

}  // namespace rex::contact
