#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <Eigen/Geometry>

#include "dynamics/joint_springs.h"
#include "geometry/rotation.h"
#include "physics/articulation_internal.h"
#include "physics/bullet_shape_internal.h"

namespace rex::internal {

JointRow::JointRow(btMultiBody& body, int link, int place)
    : btMultiBodyConstraint(&body, &body, link, body.getLink(link).m_parent, kJointPurposes, true,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR),
      place_(place) {
  JointRow::finalizeMultiDof();
}

JointRow::JointRow(btMultiBody& body)
    : btMultiBodyConstraint(&body, &body, -1, -1, kJointPurposes, true,
                            MULTIBODY_CONSTRAINT_1DOF_JOINT_MOTOR) {
  JointRow::finalizeMultiDof();
}

void JointRow::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  constexpr int kBaseVelocities = 6;
  if (m_linkA >= 0) jacobianA(0)[kBaseVelocities + m_bodyA->getLink(m_linkA).m_dofOffset + place_] = 1;
}

void JointRow::measureBase(const btVector3& angular, const btVector3& linear) {
  for (int i = 0; i < 3; ++i) {
    jacobianA(0)[i] = angular[i];
    jacobianA(0)[3 + i] = linear[i];
  }
}

void JointRow::forget() {
  setGoals({});
  for (int i = 0; i < kJointPurposes; ++i) internalSetAppliedImpulse(i, 0);
}

int JointRow::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }

void JointRow::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                    const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  for (int i = 0; i < kJointPurposes; ++i) {
    if (!goals_[i]) {
      internalSetAppliedImpulse(i, 0);
      continue;
    }
    const JointGoal& goal = *goals_[i];
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = i;
    fillMultiBodyConstraint(row, data, jacobianA(0), jacobianB(0), none, none, none, none, 0, info,
                            goal.lowest, goal.highest, false, 1, false, goal.velocity);
    const double stiffened = 1 / (1 + goal.softness * row.m_jacDiagABInv);
    row.m_rhs *= stiffened;
    row.m_jacDiagABInv *= stiffened;
    row.m_cfm = goal.softness * row.m_jacDiagABInv;
    row.m_contactNormal1 = row.m_contactNormal2 = none;
    row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = none;
    internalSetAppliedImpulse(i, std::clamp(getAppliedImpulse(i), goal.lowest, goal.highest));
  }
}

namespace {

using Kind = MotionStep::Kind;

constexpr int kBaseVelocities = 6;

int linkCount(const Model& model, std::span<const BodyId> bodies) {
  std::size_t count = 0;
  for (const BodyId body : bodies) count += movements(model[model[body].joint]).size();
  return static_cast<int>(count);
}

}  // namespace

Articulation::Articulation(const Model& model, std::span<const BodyId> bodies, const Pose& X_WP,
                           std::span<btCollisionShape* const> shapes, const PhysicsOptions& options)
    : options_(options) {
  const Joint& first = model[model[bodies.front()].joint];
  std::vector<Grown> grown(model.bodies().size(), {-1, X_WP.inverse()});
  const bool isFree = first.type == JointType::kFree;
  if (isFree) {
    const BulletLink link = bulletLink(model[first.child]);
    base_.emplace(first, X_WP, link.X_BL);
    baseJoint_ = first;
    baseLaw_ = jointLaw(model, first, 0, options);
    if (baseLaw_.stiffness > 0) baseState_ = initialState(model);
    grown[static_cast<std::size_t>(first.child)] = {-1, link.X_BL};
    links_.emplace(first.child, -1);
    addLift(model[first.child], -1);
    body_.emplace(linkCount(model, bodies.subspan(1)), link.mass, link.inertia, false, false);
  } else {
    body_.emplace(linkCount(model, bodies), 0, btVector3(0, 0, 0), true, false);
  }
  addCollider(-1, isFree ? first.child : kWorld, isFree ? shapes.front() : nullptr);
  for (std::size_t i = isFree ? 1 : 0; i < bodies.size(); ++i) {
    const JointId joint = model[bodies[i]].joint;
    const Grown& parent = grown[static_cast<std::size_t>(model[joint].parent)];
    Grown& child = grown[static_cast<std::size_t>(bodies[i])];
    child = grow(model, joint, bulletLink(model[bodies[i]]), parent);
    links_.emplace(bodies[i], child.link);
    addLift(model[bodies[i]], child.link);
    if (shapes[i] != nullptr) addCollider(child.link, bodies[i], shapes[i]);
  }
  body_->finalizeMultiDof();
  body_->setLinearDamping(0);
  body_->setAngularDamping(0);
  body_->setMaxCoordinateVelocity(kInfinity);
  body_->setHasSelfCollision(true);
  addRows();
  addArmature();
}

Articulation::Grown Articulation::grow(const Model& model, JointId id, const BulletLink& link, Grown parent) {
  const Joint& joint = model[id];
  const JointMovements moves = movements(joint);
  Pose X_LF = parent.X_BL.inverse() * joint.X_PF;
  int at = parent.link;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const bool isLast = i + 1 == moves.size();
    const Pose X_ML = isLast ? joint.X_MC * link.X_BL : Pose{};
    const double mass = isLast ? link.mass : 0;
    const btVector3 inertia = isLast ? link.inertia : btVector3(0, 0, 0);
    const btQuaternion R_LF = bulletQuaternion((X_LF.R * X_ML.R).transpose());
    const btVector3 axis = toBullet(X_ML.R.transpose() * moves[i].axis.stableNormalized());
    const btVector3 toPivot = toBullet(X_LF.p), toCenter = toBullet(X_ML.R.transpose() * X_ML.p);
    switch (moves[i].kind) {
      case Kind::kHinge:
        body_->setupRevolute(next_, mass, inertia, at, R_LF, axis, toPivot, toCenter);
        break;
      case Kind::kSlider:
        body_->setupPrismatic(next_, mass, inertia, at, R_LF, axis, toPivot, toCenter, false);
        break;
      case Kind::kQuaternion:
        body_->setupSpherical(next_, mass, inertia, at, R_LF, toPivot, toCenter);
        break;
      case Kind::kFixed:
        body_->setupFixed(next_, mass, inertia, at, R_LF, toPivot, toCenter, false);
        break;
    }
    if (moves[i].kind != Kind::kFixed) addCoordinate(model, id, moves[i], X_ML.R);
    at = next_++;
    X_LF = Pose{};
  }
  return {at, link.X_BL};
}

// The rise of a screw is a slider that follows its turn.
void Articulation::addCoordinate(const Model& model, JointId id, const JointMovement& move,
                                 const Eigen::Matrix3d& R_ML) {
  const Joint& joint = model[id];
  const double way = move.isRise ? move.axis.norm() : 1;
  Coordinate coordinate{.link = next_,
                        .qIndex = joint.qIndex + move.coordinate,
                        .vIndex = joint.vIndex + move.coordinate,
                        .isBall = move.kind == Kind::kQuaternion,
                        .R_ML = R_ML,
                        .follows = joint.mimics || move.isRise,
                        .ratio = way * joint.ratio,
                        .offset = way * joint.offset,
                        .joint = id};
  if (!move.isRise) {
    coordinate.law = jointLaw(model, joint, move.coordinate, options_);
    if (coordinate.isBall)
      coordinate.R_rest = rotationFromQuaternion(joint.springReference.segment<4>(move.coordinate));
    else
      coordinate.rest = joint.springReference[move.coordinate];
  }
  // What it follows has limits.
  if (coordinate.follows) {
    coordinate.law.lower = -kInfinity;
    coordinate.law.upper = kInfinity;
  }
  coordinates_.push_back(coordinate);
}

void Articulation::addCollider(int link, BodyId body, btCollisionShape* shape) {
  auto object = std::make_unique<btMultiBodyLinkCollider>(&*body_, link);
  object->setCollisionShape(shape != nullptr ? shape : &nothing_);
  object->setActivationState(DISABLE_DEACTIVATION);
  if (link < 0) {
    body_->setBaseCollider(object.get());
  } else {
    body_->getLink(link).m_collider = object.get();
  }
  colliders_.push_back({std::move(object), body});
}

void Articulation::addLift(const Body& body, int link) {
  if (body.buoyancy == 0 || body.mass == 0) return;
  lifts_.emplace_back(link, toBullet(-body.buoyancy * body.mass * options_.gravity_W));
}

bool Articulation::hasBaseRows() const {
  return base_ && (baseLaw_.damping > 0 || baseLaw_.armature > 0 || baseLaw_.stiffness > 0);
}

void Articulation::addRows() {
  if (hasBaseRows()) {
    for (int i = 0; i < kBaseVelocities; ++i) rows_.push_back(std::make_unique<JointRow>(*body_));
  }
  for (const Coordinate& coordinate : coordinates_) {
    for (int place = 0; place < (coordinate.isBall ? 3 : 1); ++place)
      rows_.push_back(std::make_unique<JointRow>(*body_, coordinate.link, place));
  }
}

void Articulation::addArmature() {
  const auto counts = [](const JointLaw& law) { return law.armature > 0 || law.stiffness > 0; };
  std::vector<std::pair<int, double>> all(counts(baseLaw_) ? kBaseVelocities : 0, {0, baseLaw_.armature});
  const std::size_t ofBase = all.size();
  for (Coordinate& one : coordinates_) {
    if (!counts(one.law)) continue;
    one.armatureRow = static_cast<int>(all.size());
    for (int place = 0; place < (one.isBall ? 3 : 1); ++place)
      all.emplace_back(kBaseVelocities + body_->getLink(one.link).m_dofOffset + place, one.law.armature);
  }
  if (all.empty()) return;
  armature_.emplace(*body_, static_cast<int>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int row = static_cast<int>(i);
    armature_->setInertia(row, all[i].second);
    if (i >= ofBase) armature_->measure(row, all[i].first);
  }
}

void Articulation::addTo(btMultiBodyDynamicsWorld& world) {
  world.addMultiBody(&*body_);
  for (const Collider& collider : colliders_) world.addCollisionObject(collider.object.get());
  for (const auto& row : rows_) world.addMultiBodyConstraint(row.get());
}

void Articulation::removeFrom(btMultiBodyDynamicsWorld& world) {
  for (const auto& row : rows_) world.removeMultiBodyConstraint(row.get());
  for (const Collider& collider : colliders_) world.removeCollisionObject(collider.object.get());
  world.removeMultiBody(&*body_);
}

void Articulation::place(const State& state) {
  if (base_) setBase(base_->linkMotion(state));
  for (const Coordinate& one : coordinates_) {
    if (one.isBall) {
      const Quaternion q = state.q.segment<4>(one.qIndex).stableNormalized();
      const Eigen::Vector3d turn = one.R_ML.transpose() * q.tail<3>();
      const Eigen::Vector3d v = one.R_ML.transpose() * state.v.segment<3>(one.vIndex);
      const double position[4] = {turn.x(), turn.y(), turn.z(), q[0]};
      body_->setJointPosMultiDof(one.link, position);
      body_->setJointVelMultiDof(one.link, v.data());
    } else {
      body_->setJointPos(one.link, one.ratio * state.q[one.qIndex] + one.offset);
      body_->setJointVel(one.link, one.ratio * state.v[one.vIndex]);
    }
  }
  update();
}

void Articulation::read(State& state) const {
  if (base_) base_->read(baseMotion(), state);
  for (const Coordinate& one : coordinates_) {
    if (one.follows) continue;
    const double* const q = body_->getJointPosMultiDof(one.link);
    const double* const v = body_->getJointVelMultiDof(one.link);
    if (one.isBall) {
      state.q[one.qIndex] = q[3];
      state.q.segment<3>(one.qIndex + 1) = one.R_ML * Eigen::Vector3d(q[0], q[1], q[2]);
      state.v.segment<3>(one.vIndex) = one.R_ML * Eigen::Vector3d(v[0], v[1], v[2]);
    } else {
      state.q[one.qIndex] = q[0];
      state.v[one.vIndex] = v[0];
    }
  }
}

// A force on a shared coordinate acts on its leader. The couplings pass it on, because it does the same
// work.
void Articulation::drive(std::span<const Motor> motors, double h) {
  if (base_) driveBase(motors, h);
  for (const auto& [link, force] : lifts_)
    link < 0 ? body_->addBaseForce(force) : body_->addLinkForce(link, force);
  std::size_t row = hasBaseRows() ? kBaseVelocities : 0;
  for (const Coordinate& one : coordinates_) {
    const Motor* const motor = &motors[static_cast<std::size_t>(one.vIndex)];
    if (one.isBall) {
      const Eigen::Vector3d force =
          one.R_ML.transpose() * Eigen::Vector3d(motor[0].target, motor[1].target, motor[2].target);
      for (int i = 0; i < 3; ++i) {
        body_->addJointTorqueMultiDof(one.link, i, force[i]);
        pull(one, i, Motor{}, h, *rows_[row++]);
      }
    } else if (one.follows) {
      pull(one, 0, Motor{}, h, *rows_[row++]);
    } else {
      if (motor->kind == Motor::Kind::kForce) body_->addJointTorque(one.link, motor->target);
      pull(one, 0, *motor, h, *rows_[row++]);
    }
  }
  if (armature_) armature_->begin();
}

// The laws are the same in all directions, so the rows can use the axes of W.
void Articulation::driveBase(std::span<const Motor> motors, double h) {
  const FreeMotion::LinkMotion motion = baseMotion();
  std::vector<Motor> forces;
  if (baseLaw_.stiffness > 0) {
    forces.assign(motors.begin(), motors.end());
    motors = forces;
    base_->read(motion, baseState_);
    const SpringStretch stretch = springStretch(baseJoint_, baseState_.q.segment<7>(baseJoint_.qIndex));
    for (int i = 0; i < kBaseVelocities; ++i)
      forces[static_cast<std::size_t>(baseJoint_.vIndex + i)].target -= baseLaw_.stiffness * stretch[i];
  }
  const FreeMotion::Wrench wrench = base_->wrench(motors, motion);
  body_->addBaseForce(toBullet(wrench.force_W));
  body_->addBaseTorque(toBullet(wrench.torque_W));
  if (!hasBaseRows()) return;
  const Eigen::Vector3d arm = base_->p_LM_W(motion), w = motion.angular_W;
  const Eigen::Vector3d drift = h * w.cross(w.cross(arm));
  for (int i = 0; i < kBaseVelocities; ++i) {
    JointRow& row = *rows_[static_cast<std::size_t>(i)];
    const bool isLinear = i < 3;
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i % 3), zero = Eigen::Vector3d::Zero();
    const Eigen::Vector3d angular = isLinear ? arm.cross(axis) : axis, linear = isLinear ? axis : zero;
    row.measureBase(toBullet(angular), toBullet(linear));
    JointPlace at;
    if (baseLaw_.armature > 0 || baseLaw_.stiffness > 0) {
      armature_->measureBase(i, angular, linear, isLinear ? drift.dot(axis) : 0);
      at.inertia = armature_->met(i) + baseLaw_.armature;
    }
    JointGoals goals;
    goals[kDamping] = jointGoals(baseLaw_, Motor{}, at, h)[kDamping];
    row.setGoals(withoutSpring(baseLaw_, goals, i));
  }
}

double Articulation::stretchOf(const Coordinate& one, int place) const {
  const double* const q = body_->getJointPosMultiDof(one.link);
  if (!one.isBall) return q[0] - one.rest;
  Quaternion turn;
  turn << q[3], one.R_ML * Eigen::Vector3d(q[0], q[1], q[2]);
  const Eigen::Vector3d stretch_M = logSO3(one.R_rest.transpose() * rotationFromQuaternion(turn));
  return one.R_ML.col(place).dot(stretch_M);
}

// Sets the goals of a row, and applies the force of its spring.
void Articulation::pull(const Coordinate& one, int place, const Motor& motor, double h, JointRow& row) {
  JointPlace at{.q = body_->getJointPosMultiDof(one.link)[place],
                .v = body_->getJointVelMultiDof(one.link)[place]};
  if (one.law.stiffness > 0) {
    at.stretch = stretchOf(one, place);
    at.inertia = armature_->met(one.armatureRow + place) + one.law.armature;
    body_->addJointTorqueMultiDof(one.link, place, springImpulse(one.law, at.stretch, h) / h);
  }
  row.setGoals(withoutSpring(one.law, jointGoals(one.law, motor, at, h), one.armatureRow + place));
}

// What damps a stiff spring is left to the armature.
JointGoals Articulation::withoutSpring(const JointLaw& law, JointGoals goals, int armatureRow) {
  if (law.stiffness == 0) return goals;
  armature_->setResistance(armatureRow, goals[kDamping] ? 1 / goals[kDamping]->softness : 0);
  goals[kDamping].reset();
  return goals;
}

FreeMotion::LinkMotion Articulation::baseMotion() const {
  return {fromBullet(body_->getBaseWorldTransform()), fromBullet(body_->getBaseVel()),
          fromBullet(body_->getBaseOmega())};
}

void Articulation::setBase(const FreeMotion::LinkMotion& motion) {
  body_->setBasePos(toBullet(motion.X_WL.p));
  body_->setWorldToBaseRot(bulletQuaternion(motion.X_WL.R.transpose()));
  body_->setBaseVel(toBullet(motion.linear_W));
  body_->setBaseOmega(toBullet(motion.angular_W));
}

void Articulation::update() {
  body_->clearForcesAndTorques();
  body_->clearConstraintForces();
  for (const auto& row : rows_) row->forget();
  if (armature_) armature_->forget();
  body_->forwardKinematics(rotations_, origins_);
  body_->updateCollisionObjectWorldTransforms(rotations_, origins_);
  body_->updateCollisionObjectInterpolationWorldTransforms(rotations_, origins_);
}

void Articulation::remember() {
  const int velocities = kBaseVelocities + body_->getNumDofs();
  rememberedBase_ = body_->getBaseWorldTransform();
  remembered_.assign(body_->getVelocityVector(), body_->getVelocityVector() + velocities);
  for (const Coordinate& one : coordinates_) {
    const double* const q = body_->getJointPosMultiDof(one.link);
    remembered_.insert(remembered_.end(), q, q + (one.isBall ? 4 : 1));
  }
}

void Articulation::undo() {
  const double* v = remembered_.data();
  const double* q = v + kBaseVelocities + body_->getNumDofs();
  body_->setBaseWorldTransform(rememberedBase_);
  body_->setBaseOmega({v[0], v[1], v[2]});
  body_->setBaseVel({v[3], v[4], v[5]});
  for (const Coordinate& one : coordinates_) {
    body_->setJointPosMultiDof(one.link, q);
    body_->setJointVelMultiDof(one.link, v + kBaseVelocities + body_->getLink(one.link).m_dofOffset);
    q += one.isBall ? 4 : 1;
  }
  update();
}

int Articulation::runaway(double limit) const {
  const auto isTame = [&](const double* v, int count) {
    return std::all_of(v, v + count, [&](double x) { return std::abs(x) < limit; });
  };
  if (base_ && !isTame(body_->getVelocityVector(), kBaseVelocities)) return baseJoint_.vIndex;
  for (const Coordinate& one : coordinates_) {
    if (!isTame(body_->getJointVelMultiDof(one.link), one.isBall ? 3 : 1)) return one.vIndex;
  }
  return -1;
}

}  // namespace rex::internal
