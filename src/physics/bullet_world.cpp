#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <BulletCollision/CollisionDispatch/btCompoundCompoundCollisionAlgorithm.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>
#include <fmt/format.h>

#include "base/error.h"
#include "collision/contacts.h"
#include "dynamics/forward_dynamics.h"
#include "physics/articulation_internal.h"
#include "physics/bullet_shape_internal.h"
#include "physics/bullet_world_internal.h"
#include "physics/simulated_tree_internal.h"

namespace rex::internal {
namespace {

// kg or kg m^2; Bullet does not move joints with less than 2.2e-16.
constexpr double kLeastInertia = 1e-15;
// Contacts are slightly soft, relative to a body of mean mass, and remove a tenth of the overlap per step.
// The load of a stack is then distributed uniquely over its contacts, and the solver, which starts each
// step from the forces of the last one, comes to rest: 20 boxes of 0.2 m sink 0.3 mm at steps of 1 ms and
// then stay.
constexpr double kSoftness = 0.05, kOverlapShare = 0.1;
// Bodies in overlap are pushed apart at most this fast, m/s. They do not keep the speed, but the push lifts
// them, and what holds them must have time to give way.
constexpr double kPartingSpeed = 0.25;
// An iteration that changes no velocity along a contact or joint by more than this, in m/s or rad/s, is the
// last: what lies still is soon solved, as each step starts from the forces of the last one.
constexpr double kSettled = 1e-8;

// Joints with plain coordinates may mimic others, those with quaternions may not.
void requirePlainMimics(const Model& model) {
  for (const Joint& joint : model.joints()) {
    if (!joint.mimics || joint.nq == joint.nv) continue;
    throw Error({.what = fmt::format("physics: joint '{}'", joint.name),
                 .found = fmt::format("a {} joint that mimics another", toString(joint.type)),
                 .wanted = "mimics of joints without quaternions; without contact it can be simulated "
                           "(stepDynamics, rex simulate --engine rk4)"});
  }
}

[[noreturn]] void failForNoMass(const Model& model, const Joint& joint) {
  throw Error({.what = fmt::format("physics: joint '{}' moves no mass", joint.name),
               .wanted = fmt::format("some: give body '{}' a mass and an inertia", model[joint.child].name)});
}

// Everything that moves must have inertia: forwardDynamics() finds the joint that moves none, at any scale.
// Bullet also moves joints that mimic others on their own.
void requireMasses(const Model& model) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.nv());
  if (std::ranges::none_of(model.joints(), [](const Joint& joint) { return joint.mimics; }))
    static_cast<void>(forwardDynamics(model, model.initialPositions(), none, none));
  const std::vector<double> inertias = linkInertias(model);
  for (std::size_t i = 0; i < inertias.size(); ++i) {
    if (inertias[i] >= kLeastInertia) continue;
    const Joint& joint = model[model[BodyId{model.links()[i].body}].joint];
    if (inertias[i] == 0) failForNoMass(model, joint);
    throw Error({.what = fmt::format("physics: joint '{}'", joint.name),
                 .found = "too little mass or inertia to move",
                 .wanted = fmt::format("at least {:g} kg or kg m^2", kLeastInertia)});
  }
}

// For each body: whether nothing moves it, and the first body of its chain that moves.
struct Stillness {
  std::vector<bool> isStill;
  std::vector<Pose> X_WB;  // of what stands still
  std::vector<BodyId> root;
};

Stillness stillness(const Model& model) {
  const std::size_t count = model.bodies().size();
  Stillness all{std::vector<bool>(count, true), std::vector<Pose>(count), std::vector<BodyId>(count, kWorld)};
  for (std::size_t i = 1; i < count; ++i) {
    const Body& body = model.bodies()[i];
    const auto parent = static_cast<std::size_t>(body.parent);
    const bool hasJoint = body.joint != kNoJoint;
    all.isStill[i] = all.isStill[parent] && (!hasJoint || model[body.joint].nv == 0);
    if (all.isStill[i]) {
      const Pose X_PB = hasJoint ? model[body.joint].X_PF * model[body.joint].X_MC : body.X_PB;
      all.X_WB[i] = all.X_WB[parent] * X_PB;
    } else {
      all.root[i] = all.isStill[parent] ? BodyId{static_cast<int>(i)} : all.root[parent];
    }
  }
  return all;
}

// N s on the first body. Without load there is none, and the directions may never have been set.
Eigen::Vector3d frictionOf(const btManifoldPoint& point) {
  if (point.getAppliedImpulse() == 0) return Eigen::Vector3d::Zero();
  return fromBullet(point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                    point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
}

bool isSolid(const ModelShape& shape) { return shape.contact && shape.shape.type != ShapeType::kMarker; }

bool isIdentity(const Pose& X) { return X.R.isIdentity(0) && X.p.isZero(0); }

}  // namespace

BodyPairs::BodyPairs(const Model& model, const std::vector<bool>& isStill)
    : bodies_(model.bodies().size()), collide_(bodies_ * bodies_) {
  const ContactModel contacts(model);
  for (const ShapePair& pair : contacts.pairs()) {
    const auto a = static_cast<std::size_t>(contacts.body(pair.a)),
               b = static_cast<std::size_t>(contacts.body(pair.b));
    collide_[a * bodies_ + b] = collide_[b * bodies_ + a] = !isStill[a] || !isStill[b];
  }
  std::vector<std::size_t> shapes(bodies_);
  for (const ModelShape& shape : model.shapes())
    if (isSolid(shape)) ++shapes[static_cast<std::size_t>(shape.body)];
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> counts;
  for (const ShapePair& pair : contacts.pairs())
    ++counts[std::minmax(static_cast<std::size_t>(contacts.body(pair.a)),
                         static_cast<std::size_t>(contacts.body(pair.b)))];
  const bool areWhole = std::ranges::all_of(counts, [&](const auto& count) {
    return count.second == shapes[count.first.first] * shapes[count.first.second];
  });
  if (areWhole) return;
  pairs_.assign(contacts.pairs().begin(), contacts.pairs().end());
  // Bullet asks for the parts of compounds by functions of the whole program.
  static const bool isSet = [] {
    gCompoundChildShapePairCallback = &BodyPairs::mayTouch;
    gCompoundCompoundChildShapePairCallback = &BodyPairs::mayTouch;
    return true;
  }();
  static_cast<void>(isSet);
}

void BodyPairs::watch(btCollisionShape& shape, int place) const {
  if (pairs_.empty()) return;
  shape.setUserPointer(const_cast<BodyPairs*>(this));
  shape.setUserIndex(place);
}

bool BodyPairs::mayTouch(const btCollisionShape* a, const btCollisionShape* b) {
  const auto* const all = static_cast<const BodyPairs*>(a->getUserPointer());
  if (all == nullptr || b->getUserPointer() == nullptr) return true;
  const auto [first, second] = std::minmax({a->getUserIndex(), b->getUserIndex()});
  return std::ranges::binary_search(all->pairs_, std::pair(first, second), {},
                                    [](const ShapePair& pair) { return std::pair(pair.a, pair.b); });
}

bool BodyPairs::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  const auto body = [](const btBroadphaseProxy* proxy) {
    return static_cast<std::size_t>(
        static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
  };
  return collide_[body(a) * bodies_ + body(b)];
}

BulletWorld::BulletWorld(const Model& model, const PhysicsOptions& options)
    : shapesOf_(model.bodies().size()) {
  requirePlainMimics(model);
  requireMasses(model);
  const Stillness all = stillness(model);
  pairs_ = std::make_unique<BodyPairs>(model, all.isStill);
  for (std::size_t i = 0; i < model.shapes().size(); ++i) {
    const ModelShape& shape = model.shapes()[i];
    if (isSolid(shape)) shapesOf_[static_cast<std::size_t>(shape.body)].push_back(static_cast<int>(i));
  }
  world_.setGravity(toBullet(options.gravity_W));
  world_.getPairCache()->setOverlapFilterCallback(pairs_.get());
  setUpSolver(model, options);
  std::vector<Articulation*> trees;
  for (std::size_t i = 0; i < model.bodies().size(); ++i) {
    const BodyId body{static_cast<int>(i)};
    if (all.isStill[i]) addStill(model, body, all.X_WB[i], options);
    if (all.root[i] != body || body == kWorld) continue;
    std::vector<BodyId> tree;
    for (std::size_t j = i; j < model.bodies().size(); ++j)
      if (all.root[j] == body) tree.push_back(BodyId{static_cast<int>(j)});
    trees.push_back(addTree(model, tree, all.X_WB[static_cast<std::size_t>(model[body].parent)], options));
  }
  std::erase(trees, nullptr);
  addCouplings(model, trees, pinsOf(model, trees, all.X_WB));
  addAll();
}

BulletWorld::~BulletWorld() { removeAll(); }

void BulletWorld::setUpSolver(const Model& model, const PhysicsOptions& options) {
  btContactSolverInfo& info = world_.getSolverInfo();
  info.m_numIterations = options.iterations;
  info.m_leastSquaresResidualThreshold = kSettled * kSettled;
  info.m_solverMode |= SOLVER_USE_ARTICULATED_WARMSTARTING;
  info.m_warmstartingFactor = info.m_articulatedWarmstartingFactor = 1;
  info.m_erp2 = kOverlapShare;
  world_.setPartingSpeed(kPartingSpeed);
  // What bounces must not gain energy from soft contacts.
  if (options.restitution == 0 && model.mass() > 0) {
    double bodies = 0;
    for (const Body& body : model.bodies()) bodies += body.mass > 0 ? 1 : 0;
    softness_ = kSoftness * bodies / model.mass();
  }
}

// Leaders may come after their followers.
void BulletWorld::addCouplings(const Model& model, const std::vector<Articulation*>& trees,
                               const Couplings::Pins& pins) {
  std::vector<CoordinatePlace> leaders(static_cast<std::size_t>(model.nq()));
  std::vector<Follower> followers;
  std::vector<int> followed;
  for (Articulation* const tree : trees) {
    tree->forEachCoordinate([&](int qIndex, const CoordinatePlace& at, const Follower* follower) {
      if (follower == nullptr) {
        leaders[static_cast<std::size_t>(qIndex)] = at;
      } else {
        followers.push_back(*follower);
        followed.push_back(qIndex);
      }
    });
  }
  if (followers.empty() && pins.empty()) return;
  for (std::size_t i = 0; i < followers.size(); ++i)
    followers[i].leader = leaders[static_cast<std::size_t>(followed[i])];
  couplings_.emplace(followers, pins);
  world_.use(&*couplings_);
  solver_.use(&*couplings_);
  for (Articulation* const tree : trees) tree->place(initialState(model));
  if (const JointId joint = couplings_->massless(model); joint != kNoJoint)
    failForNoMass(model, model[joint]);
}

// `still` are the poses in W of bodies that stand still. Pins between two of these hold nothing.
Couplings::Pins BulletWorld::pinsOf(const Model& model, const std::vector<Articulation*>& trees,
                                    const std::vector<Pose>& still) {
  const auto endOf = [&](BodyId body, const Eigen::Vector3d& p_BP) {
    for (Articulation* const tree : trees)
      if (const std::optional<int> link = tree->linkOf(body))
        return PinEnd{&tree->body(), *link, toBullet(bulletLink(model[body]).X_BL.inverse() * p_BP)};
    return PinEnd{.point = toBullet(still[static_cast<std::size_t>(body)] * p_BP)};
  };
  Couplings::Pins pins;
  for (const Pin& pin : model.pins()) {
    PinEnd A = endOf(pin.a, pin.p_AP), B = endOf(pin.b, pin.p_BQ);
    if (A.body == nullptr) std::swap(A, B);
    if (A.body != nullptr) pins.emplace_back(A, B);
  }
  return pins;
}

void BulletWorld::step(double h, bool isApart) {
  world_.setApart(isApart);
  world_.getSolverInfo().m_globalCfm = softness_ * h;
  world_.stepSimulation(h, 0);
}

btCollisionShape* BulletWorld::addShape(const Model& model, BodyId body, const Pose& X_BL) {
  auto compound = std::make_unique<btCompoundShape>();
  std::vector<int>& places = shapesOf_[static_cast<std::size_t>(body)];
  std::erase_if(places, [&](int place) {
    const ModelShape& shape = model.shapes()[static_cast<std::size_t>(place)];
    std::unique_ptr<btCollisionShape> solid = bulletShape(shape.shape);
    if (solid == nullptr) return true;
    pairs_->watch(*solid, place);
    compound->addChildShape(toBullet(X_BL.inverse() * shape.X_BS), solid.get());
    shapes_.push_back(std::move(solid));
    return false;
  });
  if (places.empty()) return nullptr;
  if (places.size() == 1 &&
      isIdentity(X_BL.inverse() * model.shapes()[static_cast<std::size_t>(places.front())].X_BS))
    return shapes_.back().get();
  return shapes_.emplace_back(std::move(compound)).get();
}

// When two objects touch, Bullet multiplies their coefficients.
void BulletWorld::setUp(btCollisionObject& object, BodyId body, const PhysicsOptions& options) {
  object.setUserIndex(static_cast<int>(body));
  object.setFriction(std::sqrt(options.friction));
  object.setRestitution(std::sqrt(options.restitution));
}

void BulletWorld::addStill(const Model& model, BodyId body, const Pose& X_WB, const PhysicsOptions& options) {
  btCollisionShape* const shape = addShape(model, body, {});
  if (shape == nullptr) return;
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(shape);
  object->setWorldTransform(toBullet(X_WB));
  setUp(*object, body, options);
  still_.push_back(std::move(object));
}

Articulation* BulletWorld::addTree(const Model& model, std::span<const BodyId> bodies, const Pose& X_WP,
                                   const PhysicsOptions& options) {
  const Joint& joint = model[model[bodies.front()].joint];
  std::vector<btCollisionShape*> shapes;
  for (const BodyId body : bodies) shapes.push_back(addShape(model, body, bulletLink(model[body]).X_BL));
  const bool hasLaw =
      (options.jointFriction && joint.damping > 0) || joint.armature > 0 || joint.stiffness > 0;
  const bool isPinned = std::ranges::any_of(
      model.pins(), [&](const Pin& pin) { return pin.a == bodies.front() || pin.b == bodies.front(); });
  if (bodies.size() == 1 && joint.type == JointType::kFree && !hasLaw && !isPinned) {
    if (shapes.front() == nullptr) shapes.front() = &nothing_;
    const Body& own = model[joint.child];
    auto body = std::make_unique<FreeBody>(joint, bulletLink(own), X_WP, shapes.front(),
                                           -own.buoyancy * own.mass * options.gravity_W);
    setUp(body->object(), joint.child, options);
    trees_.push_back(std::move(body));
    return nullptr;
  }
  auto tree = std::make_unique<Articulation>(model, bodies, X_WP, shapes, options);
  tree->forEachObject([&](btCollisionObject& object, BodyId body) { setUp(object, body, options); });
  Articulation* const added = tree.get();
  trees_.push_back(std::move(tree));
  return added;
}

void BulletWorld::addAll() {
  for (const auto& object : still_) world_.addCollisionObject(object.get());
  for (const auto& tree : trees_) tree->addTo(world_);
  if (couplings_) couplings_->addTo(world_);
}

void BulletWorld::removeAll() {
  if (couplings_) couplings_->removeFrom(world_);
  for (const auto& tree : trees_) tree->removeFrom(world_);
  for (const auto& object : still_) world_.removeCollisionObject(object.get());
}

void BulletWorld::reset(const State& state) {
  world_.setApart(false);
  removeAll();
  broadphase_.resetPool(&dispatcher_);
  solver_.reset();
  for (const auto& tree : trees_) tree->place(state);
  if (couplings_) couplings_->forget();
  addAll();
}

int BulletWorld::shapeOf(const btCollisionObject& object, int child) const {
  const std::vector<int>& shapes = shapesOf_[static_cast<std::size_t>(object.getUserIndex())];
  return shapes[static_cast<std::size_t>(std::max(child, 0))];
}

// Calls visit(manifold, point) for all contact points.
template <class Visit>
void BulletWorld::forEachContact(const Visit& visit) const {
  for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      if (point.getDistance() <= 0 || point.getAppliedImpulse() != 0) visit(manifold, point);
    }
  }
}

void BulletWorld::collectTouching(std::vector<std::pair<int, int>>& pairs) const {
  pairs.clear();
  forEachContact([&](const btPersistentManifold& manifold, const btManifoldPoint& point) {
    const std::pair<int, int> pair = std::minmax(
        {shapeOf(*manifold.getBody0(), point.m_index0), shapeOf(*manifold.getBody1(), point.m_index1)});
    if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);
  });
}

std::vector<PhysicsContact> BulletWorld::contacts() const {
  std::vector<PhysicsContact> all;
  forEachContact([&](const btPersistentManifold& manifold, const btManifoldPoint& point) {
    PhysicsContact contact{.shapeA = shapeOf(*manifold.getBody0(), point.m_index0),
                           .shapeB = shapeOf(*manifold.getBody1(), point.m_index1),
                           .p_WA = fromBullet(point.getPositionWorldOnA()),
                           .p_WB = fromBullet(point.getPositionWorldOnB()),
                           .normal_W = fromBullet(point.m_normalWorldOnB),
                           .distance = point.getDistance(),
                           .impulse = point.getAppliedImpulse(),
                           .friction_W = frictionOf(point)};
    if (contact.shapeA > contact.shapeB) {
      std::swap(contact.shapeA, contact.shapeB);
      std::swap(contact.p_WA, contact.p_WB);
      contact.normal_W = -contact.normal_W;
      contact.friction_W = -contact.friction_W;
    }
    all.push_back(contact);
  });
  const auto key = [](const PhysicsContact& one) {
    return std::tuple(one.shapeA, one.shapeB, one.p_WA.x(), one.p_WA.y(), one.p_WA.z());
  };
  std::sort(all.begin(), all.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  return all;
}

std::vector<PhysicsContact> BulletWorld::overlaps(const State& state, double depth) {
  reset(state);
  world_.performDiscreteCollisionDetection();
  std::vector<PhysicsContact> deepest;
  for (const PhysicsContact& one : contacts()) {
    if (one.distance > -depth) continue;
    const bool isKnown =
        !deepest.empty() && deepest.back().shapeA == one.shapeA && deepest.back().shapeB == one.shapeB;
    if (!isKnown) deepest.push_back(one);
    if (one.distance < deepest.back().distance) deepest.back() = one;
  }
  reset(state);
  return deepest;
}

std::optional<RayHit> BulletWorld::rayCast(const Eigen::Vector3d& from_W, const Eigen::Vector3d& to_W) const {
  struct Closest : btCollisionWorld::ClosestRayResultCallback {
    using ClosestRayResultCallback::ClosestRayResultCallback;
    int child = -1;
    btScalar addSingleResult(btCollisionWorld::LocalRayResult& result, bool isNormalInWorld) override {
      child = result.m_localShapeInfo != nullptr ? result.m_localShapeInfo->m_triangleIndex : -1;
      return ClosestRayResultCallback::addSingleResult(result, isNormalInWorld);
    }
  } closest(toBullet(from_W), toBullet(to_W));
  closest.m_flags = btTriangleRaycastCallback::kF_UseGjkConvexCastRaytest;
  world_.rayTest(toBullet(from_W), toBullet(to_W), closest);
  if (!closest.hasHit()) return std::nullopt;
  return RayHit{.shape = shapeOf(*closest.m_collisionObject, closest.child),
                .p_WQ = fromBullet(closest.m_hitPointWorld),
                .normal_W = fromBullet(closest.m_hitNormalWorld),
                .distance = closest.m_closestHitFraction * (to_W - from_W).norm()};
}

}  // namespace rex::internal
