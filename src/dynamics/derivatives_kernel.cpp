#include "dynamics/kernels_internal.h"
#include "dynamics/tree_kernel_internal.h"

namespace rex::internal {
namespace {

// All in the axes of the world and about the origin O of the tree, as in Part. A motion is a twist, or the
// rate of one; a pull is a force, or a momentum, with its torque.
template <class T>
struct Twist {
  Vec3<T> angular, linear;
  friend Twist operator+(const Twist& a, const Twist& b) {
    return {a.angular + b.angular, a.linear + b.linear};
  }
  friend Twist operator*(const T& s, const Twist& a) { return {s * a.angular, s * a.linear}; }
};
template <class T>
struct Pull {
  Vec3<T> torque, force;
  friend Pull operator+(const Pull& a, const Pull& b) { return {a.torque + b.torque, a.force + b.force}; }
};
template <class T>
inline T dot(const Twist<T>& a, const Pull<T>& f) {
  return dot(a.angular, f.torque) + dot(a.linear, f.force);
}
// The rate of what moves with twist V.
template <class T>
inline Twist<T> cross(const Twist<T>& V, const Twist<T>& s) {
  return {cross(V.angular, s.angular), cross(V.angular, s.linear) + cross(V.linear, s.angular)};
}
template <class T>
inline Pull<T> cross(const Twist<T>& V, const Pull<T>& f) {
  return {cross(V.angular, f.torque) + cross(V.linear, f.force), cross(V.angular, f.force)};
}

// How a link moves, gravity as an upward acceleration; and from here to the momentum what moves it and all it
// carries, eighteen numbers.
struct Flow {
  Twist<double> V, A;
  Pull<double> force;
  Mat3<double> turning;   // torque per angular velocity that is added to V
  Vec3<double> momentum;  // linear
};
constexpr int kCarried = 18;

// Rows of each freedom after its twist s; V and A are those of the parent, V' is that of the link.
constexpr int kRate = 6;    // the angular part of s' = V x s
constexpr int kSecond = 9;  // A x s + V x s'
constexpr int kSum = 15;    // s' + V' x s
constexpr int kRows = 21;

template <class T>
inline Twist<T> loadTwist(const Freedoms& freedoms, int row, int i) {
  const double* from = freedoms.twists + row * freedoms.room + i;
  return {loadVec3<T>(from, freedoms.room), loadVec3<T>(from + 3 * freedoms.room, freedoms.room)};
}
template <class T>
inline Vec3<T> loadRate(const Freedoms& freedoms, int i) {
  return loadVec3<T>(freedoms.twists + kRate * freedoms.room + i, freedoms.room);
}
inline void storeTwist(const Twist<double>& s, const Freedoms& freedoms, int row, int i) {
  double* to = freedoms.twists + row * freedoms.room + i;
  storeVec3(s.angular, to, freedoms.room);
  storeVec3(s.linear, to + 3 * freedoms.room, freedoms.room);
}

// How the freedoms from `first` on move their link, whose parent moves so.
inline void addFreedoms(const Freedoms& freedoms, int first, const double* v, const double* a,
                        const Flow& parent, Flow& flow) {
  Twist<double> own{};
  flow.A = parent.A;
  for (int i = first; i < freedoms.count; ++i) {
    const int column = freedoms.columns[i];
    const Twist<double> s = loadTwist<double>(freedoms, 0, i), rate = cross(parent.V, s);
    storeVec3(rate.angular, freedoms.twists + kRate * freedoms.room + i, freedoms.room);
    storeTwist(cross(parent.A, s) + cross(parent.V, rate), freedoms, kSecond, i);
    storeTwist(2.0 * rate, freedoms, kSum, i);
    own = own + v[column] * s;
    flow.A = flow.A + a[column] * s + v[column] * rate;
  }
  flow.V = parent.V + own;
  if (freedoms.count - first == 1) return;  // s moves only itself
  for (int i = first; i < freedoms.count; ++i)
    storeTwist(loadTwist<double>(freedoms, kSum, i) + cross(own, loadTwist<double>(freedoms, 0, i)), freedoms,
               kSum, i);
}

// The momentum of a part, and what it carries, per unit of a freedom's rate.
inline Pull<double> momentum(const Part& part, const Twist<double>& s) {
  return {part.inertia * s.angular + cross(part.moment, s.linear),
          part.mass * s.linear + cross(s.angular, part.moment)};
}

// What it takes to move the link alone. Of points r with velocity r' it takes 2 w x r' per mass to turn them
// by w more: as a torque, turning w = 2 (w r.r' - r' r.w), summed by mass.
inline void setFlow(const Part& part, Flow& flow) {
  const Pull<double> h = momentum(part, flow.V);
  flow.force = momentum(part, flow.A) + cross(flow.V, h);
  flow.momentum = h.force;
  const Sym3<double>& I = part.inertia;
  const Vec3<double>&w = flow.V.angular, &v = flow.V.linear, &c = part.moment;
  const double half = 0.5 * (I.xx + I.yy + I.zz);  // the sum of r r^T is half 1 - I
  const Vec3<double> x = -2.0 * (c.x * v + cross(w, Vec3<double>{half - I.xx, -I.xy, -I.xz})),
                     y = -2.0 * (c.y * v + cross(w, Vec3<double>{-I.xy, half - I.yy, -I.yz})),
                     z = -2.0 * (c.z * v + cross(w, Vec3<double>{-I.xz, -I.yz, half - I.zz}));
  const double trace = x.x + y.y + z.z;
  flow.turning = {{x.x - trace, x.y, x.z}, {y.x, y.y - trace, y.z}, {z.x, z.y, z.z - trace}};
}

// How forces change when the link and what it carries accelerate by A more and turn by w more.
inline Pull<double> change(const Part& part, const Flow& flow, const Twist<double>& A,
                           const Vec3<double>& w) {
  return momentum(part, A) + Pull<double>{flow.turning * w, 2.0 * cross(w, flow.momentum)};
}

// The derivatives of the forces of inverse dynamics, column by column.
struct Columns {
  double *u_q, *u_v, *u_a;
  long stride;
};

// What a freedom, with all that its link carries, has to do with those above it.
template <class T>
struct Beside {
  Pull<T> momentum;                // per unit of its rate
  Vec3<T> turning;                 // its force per angular velocity of all that is carried
  Pull<T> byPosition, byVelocity;  // the changes of all forces
};
inline Beside<double> besideOf(const Part& part, const Flow& flow, const Freedoms& freedoms, int own) {
  const Twist<double> s = loadTwist<double>(freedoms, 0, own);
  return {momentum(part, s), transposedTimes(flow.turning, s.angular) + 2.0 * cross(flow.momentum, s.linear),
          change(part, flow, loadTwist<double>(freedoms, kSecond, own), loadRate<double>(freedoms, own)),
          change(part, flow, loadTwist<double>(freedoms, kSum, own), s.angular)};
}
template <class T>
inline Pull<T> inLanes(const Pull<double>& f) {
  return {broadcast<T>(f.torque), broadcast<T>(f.force)};
}

// The five entries of a freedom and the ones from i on, above it.
template <class T>
inline void addPairs(const Beside<T>& own, const Freedoms& freedoms, int column, int i, const Columns& out) {
  constexpr int kLanes = kLanesOf<T>;
  double entries[5][kLanes];
  const Twist<T> s = loadTwist<T>(freedoms, 0, i);
  store(dot(loadTwist<T>(freedoms, kSecond, i), own.momentum) + dot(loadRate<T>(freedoms, i), own.turning),
        entries[0]);
  store(dot(loadTwist<T>(freedoms, kSum, i), own.momentum) + dot(s.angular, own.turning), entries[1]);
  store(dot(s, own.byPosition), entries[2]);
  store(dot(s, own.byVelocity), entries[3]);
  store(dot(s, own.momentum), entries[4]);
  for (int lane = 0; lane < kLanes; ++lane) {
    const int above = freedoms.columns[i + lane];
    const long below = column + out.stride * above, beside = above + out.stride * column;
    out.u_q[below] += entries[0][lane];
    out.u_v[below] += entries[1][lane];
    out.u_q[beside] += entries[2][lane];
    out.u_v[beside] += entries[3][lane];
    out.u_a[below] += entries[4][lane];
    out.u_a[beside] += entries[4][lane];
  }
}

// The entries of a freedom with those of its own link, from `first` to `last`, and with those above.
template <class T>
inline void addColumns(const Part& part, const Flow& flow, const Freedoms& freedoms, int own, int first,
                       const Columns& out) {
  Beside<double> beside = besideOf(part, flow, freedoms, own);
  const int column = freedoms.columns[own];
  for (int i = first; i <= part.lastFreedom; ++i) {
    const Twist<double> s = loadTwist<double>(freedoms, 0, i);
    const long at = freedoms.columns[i] + out.stride * column;
    out.u_q[at] += dot(s, beside.byPosition);
    out.u_v[at] += dot(s, beside.byVelocity);
    out.u_a[at] += dot(s, beside.momentum);
  }
  // Forces turn with the link, against what is above it.
  beside.byPosition = beside.byPosition + cross(loadTwist<double>(freedoms, 0, own), flow.force);
  const Beside<T> inAll{inLanes<T>(beside.momentum), broadcast<T>(beside.turning),
                        inLanes<T>(beside.byPosition), inLanes<T>(beside.byVelocity)};
  for (int last = freedoms.parents[first]; last != kNone;) {
    const int start = freedoms.starts[last];
    for (; last - start + 1 >= kLanesOf<T>; last -= kLanesOf<T>)
      addPairs<T>(inAll, freedoms, column, last - kLanesOf<T> + 1, out);
    for (; last >= start; --last) addPairs<double>(beside, freedoms, column, last, out);
    last = freedoms.parents[start];
  }
}

// Carpentier, Mansard 2018, Analytical derivatives of rigid body dynamics algorithms, with the terms gathered
// as by Singh, Russell, Wensing 2022. A freedom that is displaced turns all it carries, but not the motion of
// its parent: relative to what it carries, that loses s x V and s x A.
template <class T>
void differentiate(const DynamicsTask& task) {
  if (task.nv == 0) return;
  Part* parts = static_cast<Part*>(task.memory);
  Flow* flows = reinterpret_cast<Flow*>(parts + task.linkCount) + 1;  // the world is Link::kNoParent
  Freedoms freedoms = freedomsIn(flows + task.linkCount, task.linkCount, kRows);
  const Columns out{task.result[0], task.result[1], task.result[2], task.nv};
  buildTree(task.links, task.linkCount, task.q[0], parts, freedoms);
  flows[Link::kNoParent] = {};
  flows[Link::kNoParent].A.linear = -broadcastVec3<double>(task.gravity_W);
  freedoms.count = 0;
  for (int i = 0; i < task.linkCount; ++i) {
    const int first = freedoms.count;
    freedoms.count = parts[i].lastFreedom + 1;
    addFreedoms(freedoms, first, task.v[0], task.given[0], flows[task.links[i].parent], flows[i]);
    setFlow(parts[i], flows[i]);
  }
  for (int i = 0; i < 3; ++i)
    __builtin_memset(task.result[i], 0, sizeof(double) * static_cast<unsigned long>(out.stride * task.nv));
  for (int i = task.linkCount - 1; i >= 0; --i) {
    const int first = i == 0 ? 0 : parts[i - 1].lastFreedom + 1;
    for (int own = parts[i].lastFreedom; own >= first; --own)
      addColumns<T>(parts[i], flows[i], freedoms, own, first, out);
    const int parent = task.links[i].parent;
    if (parent == Link::kNoParent) continue;
    addTo<T>(&parts[parent].inertia.xx, &parts[i].inertia.xx);
    addTo<T, kCarried>(&flows[parent].force.torque.x, &flows[i].force.torque.x);
  }
}

template <class T>
void solveByRows(const double* L, double* B, int n, int stride) {
  const auto divide = [&](int k) {
    const T inverse(1 / L[k + n * k]);
    for (int e = k * stride; e < (k + 1) * stride; e += kLanesOf<T>) store(inverse * load<T>(B + e), B + e);
  };
  const auto subtract = [&](double factor, const double* row, double* from) {
    const T times(factor);
    for (int e = 0; e < stride; e += kLanesOf<T>)
      store(load<T>(from + e) - times * load<T>(row + e), from + e);
  };
  for (int k = n - 1; k >= 0; --k) {
    divide(k);
    for (int i = 0; i < k; ++i)
      if (const double factor = L[k + n * i]; factor != 0) subtract(factor, B + k * stride, B + i * stride);
  }
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < k; ++i)
      if (const double factor = L[k + n * i]; factor != 0) subtract(factor, B + i * stride, B + k * stride);
    divide(k);
  }
}

}  // namespace

template <int kLanes>
DerivativesKernel DerivativesKernel::compiled() {
  return {&differentiate<InLanes<kLanes>>, kLanesOf<Part> + kLanesOf<Flow> + freedomNumbersPerLink(kRows), 0,
          &solveByRows<InLanes<kLanes>>};
}
template DerivativesKernel DerivativesKernel::compiled<REX_LANES>();

}  // namespace rex::internal
