#include "dynamics/kernels_internal.h"

namespace rex::internal {
namespace {

// All in the frame of the link; accelerations and torques are those of its origin.
template <class T>
struct Motion {
  KernelPose<T> X_PL;
  Vec3<T> angularVelocity, angularAcceleration, acceleration;
  Mat3<T> spin;           // how much more a point accelerates than the origin, per metre
  Vec3<T> torque, force;  // needed to move the link and what it carries
};

// [dw]x + [w]x [w]x.
template <class T>
inline Mat3<T> spinOf(const Vec3<T>& w, const Vec3<T>& dw) {
  const T xx = w.x * w.x, yy = w.y * w.y, zz = w.z * w.z;
  const T xy = w.x * w.y, xz = w.x * w.z, yz = w.y * w.z;
  return {
      {-yy - zz, xy + dw.z, xz - dw.y}, {xy - dw.z, -xx - zz, yz + dw.x}, {xz + dw.y, yz - dw.x, -xx - yy}};
}

// Adds the motion of the link's own coordinate to the one that it gets from its parent.
template <class T>
inline void addFreedom(const Link& link, const double* const* v, const double* const* a, Motion<T>& m) {
  const int i = link.vIndex;
  if (link.kind == Link::Kind::kQuaternion) {
    const Vec3<T> w{gathered<T>(v, i), gathered<T>(v, i + 1), gathered<T>(v, i + 2)};
    const Vec3<T> dw{gathered<T>(a, i), gathered<T>(a, i + 1), gathered<T>(a, i + 2)};
    m.angularAcceleration = m.angularAcceleration + cross(m.angularVelocity, w) + dw;
    m.angularVelocity = m.angularVelocity + w;
    return;
  }
  const T rate = T(link.ratio) * gathered<T>(v, i), acceleration = T(link.ratio) * gathered<T>(a, i);
  const Vec3<T> sideways = rate * crossZ(m.angularVelocity);
  if (link.kind != Link::Kind::kHinge) {
    const T perRate(link.kind == Link::Kind::kSlider ? 1 : link.pitch);
    m.acceleration = m.acceleration + T(2.0) * perRate * sideways;  // Coriolis'
    m.acceleration.z = m.acceleration.z + perRate * acceleration;
    if (link.kind == Link::Kind::kSlider) return;
  }
  m.angularAcceleration = m.angularAcceleration + sideways;
  m.angularAcceleration.z = m.angularAcceleration.z + acceleration;
  m.angularVelocity.z = m.angularVelocity.z + rate;
}

// What it takes to move the link alone.
template <class T>
inline void setForces(const Link& link, Motion<T>& m) {
  const Vec3<T> moment = broadcastVec3<T>(link.moment);
  const Sym3<T> I = broadcastSym3<T>(link.inertia);
  m.force = T(link.mass) * m.acceleration + m.spin * moment;
  m.torque = I * m.angularAcceleration + cross(m.angularVelocity, I * m.angularVelocity) +
             cross(moment, m.acceleration);
}

template <class T>
inline void addToForces(const Link& link, const Motion<T>& m, T* forces) {
  T* own = forces + link.vIndex;
  const T ratio(link.ratio);
  switch (link.kind) {
    case Link::Kind::kHinge:
      own[0] = own[0] + ratio * m.torque.z;
      return;
    case Link::Kind::kScrew:
      own[0] = own[0] + ratio * (m.torque.z + T(link.pitch) * m.force.z);
      return;
    case Link::Kind::kSlider:
      own[0] = own[0] + ratio * m.force.z;
      return;
    case Link::Kind::kQuaternion:
      own[0] = own[0] + m.torque.x;
      own[1] = own[1] + m.torque.y;
      own[2] = own[2] + m.torque.z;
      return;
  }
}

// What it takes to move what turns with the coordinate only.
template <class T>
inline void addArmature(const Link& link, const double* const* a, T* forces) {
  const int count = link.kind == Link::Kind::kQuaternion ? 3 : 1;
  for (int i = link.vIndex; i < link.vIndex + count; ++i)
    forces[i] = forces[i] + T(link.armature) * gathered<T>(a, i);
}

// The recursion of Newton and Euler: outwards with accelerations of origins, inwards with forces. An upward
// acceleration of everything stands for gravity.
template <class T>
inline void solve(const DynamicsTask& task, const double* const* q, const double* const* v,
                  const double* const* a, double* const* u) {
  Motion<T>* world = static_cast<Motion<T>*>(task.memory);
  Motion<T>* motions = world + 1;  // so that the world is the parent Link::kNoParent
  T* forces = reinterpret_cast<T*>(motions + task.linkCount);
  const T zero(0.0);
  *world = {};
  world->acceleration = -broadcastVec3<T>(task.gravity_W);
  for (int i = 0; i < task.nv; ++i) forces[i] = zero;

  // In a loop of their own, because sines are independent of one another, but motions are not.
  for (int i = 0; i < task.linkCount; ++i) motions[i].X_PL = poseInParent<T>(task.links[i], q);
  for (int i = 0; i < task.linkCount; ++i) {
    const Link& link = task.links[i];
    const Motion<T>& parent = motions[link.parent];
    Motion<T>& m = motions[i];
    m.angularVelocity = transposedTimes(m.X_PL.R, parent.angularVelocity);
    m.angularAcceleration = transposedTimes(m.X_PL.R, parent.angularAcceleration);
    m.acceleration = transposedTimes(m.X_PL.R, parent.acceleration + parent.spin * m.X_PL.p);
    addFreedom(link, v, a, m);
    m.spin = spinOf(m.angularVelocity, m.angularAcceleration);
    setForces(link, m);
  }
  for (int i = task.linkCount - 1; i >= 0; --i) {
    const Link& link = task.links[i];
    const Motion<T>& m = motions[i];
    addToForces(link, m, forces);
    if (link.armature != 0) addArmature(link, a, forces);
    if (link.parent == Link::kNoParent) continue;
    Motion<T>& parent = motions[link.parent];
    const Vec3<T> force = m.X_PL.R * m.force;
    parent.force = parent.force + force;
    parent.torque = parent.torque + m.X_PL.R * m.torque + cross(m.X_PL.p, force);
  }
  for (int i = 0; i < task.nv; ++i) scatter(forces[i], u, i);
}

template <class T, int kCount>
void solveAll(const DynamicsTask& task) {
  for (int k = 0; k < kCount; k += kLanesOf<T>)
    solve<T>(task, task.q + k, task.v + k, task.given + k, task.result + k);
}

}  // namespace

template <int kLanes>
InverseDynamicsKernel InverseDynamicsKernel::compiled() {
  return {&solveAll<double, 1>, &solveAll<InLanes<kLanes>, DynamicsTask::kBlock>, kLanesOf<Motion<double>>,
          1};
}
template InverseDynamicsKernel InverseDynamicsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
