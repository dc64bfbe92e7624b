#include "dynamics/kernels_internal.h"

namespace rex::internal {
namespace {

// A force with its torque about the origin of a frame, and the angular acceleration of a frame with the
// linear acceleration of its origin.
template <class T>
struct SpatialForce {
  Vec3<T> torque, force;
  friend SpatialForce operator+(const SpatialForce& a, const SpatialForce& b) {
    return {a.torque + b.torque, a.force + b.force};
  }
  friend SpatialForce operator*(const T& s, const SpatialForce& a) { return {s * a.torque, s * a.force}; }
};
template <class T>
struct SpatialMotion {
  Vec3<T> angular, linear;
};
template <class T>
inline T dot(const SpatialForce<T>& f, const SpatialMotion<T>& a) {
  return dot(f.torque, a.angular) + dot(f.force, a.linear);
}

// An articulated body: the torque and force it takes to accelerate a link while the joints below it yield to
// their forces, torque = A angular + B linear, force = B^T angular + D linear.
template <class T>
struct Inertia {
  Sym3<T> A, D;
  Mat3<T> B;

  friend Inertia operator+(const Inertia& a, const Inertia& b) { return {a.A + b.A, a.D + b.D, a.B + b.B}; }
  friend SpatialForce<T> operator*(const Inertia& I, const SpatialMotion<T>& a) {
    return {I.A * a.angular + I.B * a.linear, transposedTimes(I.B, a.angular) + I.D * a.linear};
  }
};

// All in the frame of the link, about its origin.
template <class T>
struct State {
  KernelPose<T> X_PL;
  Vec3<T> angularVelocity;
  SpatialMotion<T> bias;  // what the velocities add to the acceleration of the parent
  SpatialMotion<T> acceleration;
  Inertia<T> inertia;
  SpatialForce<T> resistance;  // what it takes even without acceleration
};

// The equation of one coordinate: its acceleration is (rest - column * all other accelerations) / inertia.
template <class T>
struct Freedom {
  SpatialForce<T> column;  // what a unit acceleration of it takes
  T perInertia, rest;
};

// The force that a unit acceleration of the coordinate takes, the part of a force that acts along the
// coordinate, and the motion that its acceleration adds.
template <class T>
inline SpatialForce<T> columnOf(const Link& link, const Inertia<T>& I) {
  const SpatialForce<T> turning{{I.A.xz, I.A.yz, I.A.zz}, {I.B.c0.z, I.B.c1.z, I.B.c2.z}};
  if (link.kind == Link::Kind::kHinge) return turning;
  const SpatialForce<T> moving{I.B.c2, {I.D.xz, I.D.yz, I.D.zz}};
  return link.kind == Link::Kind::kSlider ? moving : turning + T(link.pitch) * moving;
}
template <class T>
inline T borne(const Link& link, const SpatialForce<T>& f) {
  if (link.kind == Link::Kind::kHinge) return f.torque.z;
  return link.kind == Link::Kind::kSlider ? f.force.z : f.torque.z + T(link.pitch) * f.force.z;
}
template <class T>
inline void accelerate(const Link& link, const T& x, SpatialMotion<T>& a) {
  if (link.kind != Link::Kind::kHinge)
    a.linear.z = a.linear.z + (link.kind == Link::Kind::kSlider ? x : T(link.pitch) * x);
  if (link.kind != Link::Kind::kSlider) a.angular.z = a.angular.z + x;
}

// Lets a coordinate yield to its force: what is left resists the other accelerations. Inlined, like the other
// functions with several callers: forward dynamics of one state is 7 % faster.
template <class T>
[[gnu::always_inline]] inline void eliminate(const Freedom<T>& freedom, Inertia<T>& I,
                                             SpatialForce<T>& resistance) {
  const Vec3<T> t = freedom.column.torque, f = freedom.column.force;
  const Vec3<T> dt = freedom.perInertia * t, df = freedom.perInertia * f;
  I.A = {I.A.xx - dt.x * t.x, I.A.xy - dt.x * t.y, I.A.xz - dt.x * t.z,
         I.A.yy - dt.y * t.y, I.A.yz - dt.y * t.z, I.A.zz - dt.z * t.z};
  I.D = {I.D.xx - df.x * f.x, I.D.xy - df.x * f.y, I.D.xz - df.x * f.z,
         I.D.yy - df.y * f.y, I.D.yz - df.y * f.z, I.D.zz - df.z * f.z};
  I.B = {I.B.c0 - f.x * dt, I.B.c1 - f.y * dt, I.B.c2 - f.z * dt};
  resistance = resistance + freedom.rest * SpatialForce<T>{dt, df};
}

// An articulated body with A, B^T and D in the axes of a frame, about its origin p below.
template <class T>
[[gnu::always_inline]] inline Inertia<T> moved(const Vec3<T>& p, const Sym3<T>& A, const Mat3<T>& Bt,
                                               const Sym3<T>& D) {
  const Mat3<T> B = transposed(Bt) + cross(p, full(D));
  return {A + symmetric(transposed(cross(p, transposed(B))) + cross(p, Bt)), D, B};
}

// The same seen from the parent's frame.
template <class T>
inline Inertia<T> inParent(const KernelPose<T>& X, const Inertia<T>& I) {
  return moved(X.p, rotated(X.R, I.A), X.R * transposed(I.B) * transposed(X.R), rotated(X.R, I.D));
}

// The same for a link whose hinge has yielded and has no armature: it resists no torque about z, so a third
// of the products are zero.
template <class T>
inline Inertia<T> inParentOfHinge(const KernelPose<T>& X, const Inertia<T>& I) {
  const Vec3<T>&x = X.R.c0, &y = X.R.c1;
  const Vec3<T> Ax = I.A.xx * x + I.A.xy * y, Ay = I.A.xy * x + I.A.yy * y;
  const Sym3<T> A{x.x * Ax.x + y.x * Ay.x, x.x * Ax.y + y.x * Ay.y, x.x * Ax.z + y.x * Ay.z,
                  x.y * Ax.y + y.y * Ay.y, x.y * Ax.z + y.y * Ay.z, x.z * Ax.z + y.z * Ay.z};
  const Vec3<T> Bx = X.R * Vec3<T>{I.B.c0.x, I.B.c1.x, I.B.c2.x},
                By = X.R * Vec3<T>{I.B.c0.y, I.B.c1.y, I.B.c2.y};
  const Mat3<T> Bt{x.x * Bx + y.x * By, x.y * Bx + y.y * By, x.z * Bx + y.z * By};
  return moved(X.p, A, Bt, rotated(X.R, I.D));
}

template <class T>
inline SpatialForce<T> inParent(const KernelPose<T>& X, const SpatialForce<T>& f) {
  const Vec3<T> force = X.R * f.force;
  return {X.R * f.torque + cross(X.p, force), force};
}

// How the velocities move the link.
template <class T>
inline void setVelocity(const Link& link, const State<T>& parent, const double* const* v, State<T>& state) {
  const Vec3<T>& w_P = parent.angularVelocity;
  const int i = link.vIndex;
  Vec3<T> w = transposedTimes(state.X_PL.R, w_P);
  state.bias = {{}, transposedTimes(state.X_PL.R, cross(w_P, cross(w_P, state.X_PL.p)))};
  if (link.kind == Link::Kind::kQuaternion) {
    const Vec3<T> rate{gathered<T>(v, i), gathered<T>(v, i + 1), gathered<T>(v, i + 2)};
    state.bias.angular = cross(w, rate);
    state.angularVelocity = w + rate;
    return;
  }
  const T rate = gathered<T>(v, i);
  const Vec3<T> sideways = rate * crossZ(w);
  if (link.kind != Link::Kind::kHinge) {
    const T perRate(link.kind == Link::Kind::kSlider ? 1 : link.pitch);
    state.bias.linear = state.bias.linear + T(2.0) * perRate * sideways;  // Coriolis'
  }
  if (link.kind != Link::Kind::kSlider) {
    state.bias.angular = sideways;
    w.z = w.z + rate;
  }
  state.angularVelocity = w;
}

// The link alone.
template <class T>
inline void setInertia(const Link& link, State<T>& state) {
  const T zero(0.0), mass(link.mass);
  const Vec3<T> h = broadcastVec3<T>(link.moment), w = state.angularVelocity;
  const Sym3<T> I = broadcastSym3<T>(link.inertia);
  state.inertia = {
      I, {mass, zero, zero, mass, zero, mass}, {{zero, h.z, -h.y}, {-h.z, zero, h.x}, {h.y, -h.x, zero}}};
  state.resistance = {cross(w, I * w), cross(w, cross(w, h))};
}

// Removes the link's freedoms from what it resists. Returns whether each of them moves some inertia.
template <class T>
inline bool solveForFreedoms(const Link& link, const double* const* u, State<T>& state, Freedom<T>* own) {
  const T least(ForwardDynamicsKernel::kLeastShare * link.largestInertia);
  const auto solve = [&](Freedom<T>& freedom, int i, T inertia, T resistance) {
    if (link.armature != 0) inertia = inertia + T(link.armature);
    freedom.perInertia = T(1.0) / inertia;
    freedom.rest = gathered<T>(u, link.vIndex + i) - resistance;
    eliminate(freedom, state.inertia, state.resistance);
    return !any(inertia <= least);
  };
  const Inertia<T>& I = state.inertia;
  if (link.kind != Link::Kind::kQuaternion) {
    own->column = columnOf(link, I);
    return solve(*own, 0, borne(link, own->column), borne(link, state.resistance));
  }
  own[0].column = {{I.A.xx, I.A.xy, I.A.xz}, {I.B.c0.x, I.B.c1.x, I.B.c2.x}};
  bool regular = solve(own[0], 0, I.A.xx, state.resistance.torque.x);
  own[1].column = {{I.A.xy, I.A.yy, I.A.yz}, {I.B.c0.y, I.B.c1.y, I.B.c2.y}};
  regular = solve(own[1], 1, I.A.yy, state.resistance.torque.y) && regular;
  own[2].column = {{I.A.xz, I.A.yz, I.A.zz}, {I.B.c0.z, I.B.c1.z, I.B.c2.z}};
  return solve(own[2], 2, I.A.zz, state.resistance.torque.z) && regular;
}

template <class T>
inline void setAcceleration(const Link& link, const Freedom<T>* own, double* const* a,
                            SpatialMotion<T>& all) {
  const auto solved = [&](int i) {
    const T x = own[i].perInertia * (own[i].rest - dot(own[i].column, all));
    scatter(x, a, link.vIndex + i);
    return x;
  };
  if (link.kind != Link::Kind::kQuaternion) {
    accelerate(link, solved(0), all);
    return;
  }
  all.angular.z = all.angular.z + solved(2);
  all.angular.y = all.angular.y + solved(1);
  all.angular.x = all.angular.x + solved(0);
}

// Featherstone, Rigid Body Dynamics Algorithms, table 7.1, but with the accelerations of the origins, which
// need no linear velocities. An upward acceleration of everything stands for gravity.
template <class T>
inline int solve(const DynamicsTask& task, const double* const* q, const double* const* v,
                 const double* const* u, double* const* a) {
  State<T>* world = static_cast<State<T>*>(task.memory);
  State<T>* states = world + 1;  // so that the world is the parent Link::kNoParent
  Freedom<T>* freedoms = reinterpret_cast<Freedom<T>*>(states + task.linkCount);
  *world = {};
  world->acceleration.linear = -broadcastVec3<T>(task.gravity_W);

  // In a loop of their own, because sines are independent of one another, but velocities are not.
  for (int i = 0; i < task.linkCount; ++i) states[i].X_PL = poseInParent<T>(task.links[i], q);
  for (int i = 0; i < task.linkCount; ++i) {
    const Link& link = task.links[i];
    setVelocity(link, states[link.parent], v, states[i]);
    setInertia(link, states[i]);
  }
  for (int i = task.linkCount - 1; i >= 0; --i) {
    const Link& link = task.links[i];
    State<T>& state = states[i];
    if (!solveForFreedoms(link, u, state, freedoms + link.vIndex)) return i;
    if (link.parent == Link::kNoParent) continue;
    State<T>& parent = states[link.parent];
    parent.inertia = parent.inertia + (link.kind == Link::Kind::kHinge && link.armature == 0
                                           ? inParentOfHinge(state.X_PL, state.inertia)
                                           : inParent(state.X_PL, state.inertia));
    parent.resistance =
        parent.resistance + inParent(state.X_PL, state.resistance + state.inertia * state.bias);
  }
  for (int i = 0; i < task.linkCount; ++i) {
    const Link& link = task.links[i];
    const KernelPose<T>& X = states[i].X_PL;
    const SpatialMotion<T>& parent = states[link.parent].acceleration;
    SpatialMotion<T>& all = states[i].acceleration;
    all.angular = transposedTimes(X.R, parent.angular) + states[i].bias.angular;
    all.linear = transposedTimes(X.R, parent.linear + cross(parent.angular, X.p)) + states[i].bias.linear;
    setAcceleration(link, freedoms + link.vIndex, a, all);
  }
  return ForwardDynamicsKernel::kRegular;
}

template <class T, int kCount>
int solveAll(const DynamicsTask& task) {
  for (int k = 0; k < kCount; k += kLanesOf<T>) {
    const int link = solve<T>(task, task.q + k, task.v + k, task.given + k, task.result + k);
    if (link != ForwardDynamicsKernel::kRegular) return link;
  }
  return ForwardDynamicsKernel::kRegular;
}

}  // namespace

template <int kLanes>
ForwardDynamicsKernel ForwardDynamicsKernel::compiled() {
  return {&solveAll<double, 1>, &solveAll<InLanes<kLanes>, DynamicsTask::kBlock>, kLanesOf<State<double>>,
          kLanesOf<Freedom<double>>};
}
template ForwardDynamicsKernel ForwardDynamicsKernel::compiled<REX_LANES>();

}  // namespace rex::internal
