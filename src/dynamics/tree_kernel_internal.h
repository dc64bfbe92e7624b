#pragma once

#include "dynamics/link_kernel_internal.h"

// What kernels share that see the whole tree in the axes of the world: its masses and the twists of its
// freedoms. See base/pack.h for why all is anonymous.
namespace rex::internal {
namespace {

// A link, in the axes of the world and about the origin O of its tree.
struct Part {
  KernelPose<double> X;  // in the parent, then in the world
  Sym3<double> inertia;  // from here to `mass`, ten numbers: later with all descendants
  Vec3<double> moment;
  double mass;
  int root;         // of its tree
  int origin;       // of a root: the part whose origin is O
  int lastFreedom;  // its own last
};

constexpr int kNone = -1;

// The coordinates, in the order of the links. Entry e of the twist of freedom i, at O and per unit of v, is
// twists[e * room + i]: so a run, in which each freedom is the parent of the next, is one load. Further rows
// are left to the kernel.
struct Freedoms {
  double* twists;  // angular, then linear
  int* parents;    // the one before on the way to the world, or kNone
  int* starts;     // the first of the run
  int* columns;
  int room, count;

  void add(const Vec3<double>& angular, const Vec3<double>& linear, int parent, int column) {
    const int i = count++;
    storeVec3(angular, twists + i, room);
    storeVec3(linear, twists + 3 * room + i, room);
    parents[i] = parent;
    starts[i] = parent == i - 1 && parent != kNone ? starts[parent] : i;
    columns[i] = column;
  }
  template <class T>
  Vec3<T> angular(int i) const {
    return loadVec3<T>(twists + i, room);
  }
  template <class T>
  Vec3<T> linear(int i) const {
    return loadVec3<T>(twists + 3 * room + i, room);
  }
};

// Memory for the freedoms of a link, in numbers, with so many rows.
inline constexpr int freedomNumbersPerLink(int rows) { return 3 * (rows + 2); }
inline Freedoms freedomsIn(void* memory, int linkCount, int rows) {
  const int room = 3 * linkCount;
  double* twists = static_cast<double*>(memory);
  int* parents = reinterpret_cast<int*>(twists + rows * room);
  return {twists, parents, parents + room, parents + 2 * room, room, 0};
}

// a b^T + b a^T.
inline Sym3<double> symmetricProduct(const Vec3<double>& a, const Vec3<double>& b) {
  return {2 * a.x * b.x, a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x,
          2 * a.y * b.y, a.y * b.z + a.z * b.y, 2 * a.z * b.z};
}

// Poses are independent of one another until they are multiplied: first all sines, then the chain.
[[gnu::flatten]] inline void place(const Link* links, int count, const double* q, Part* parts) {
#ifdef __AVX__
  placeByColumns(links, count, q, [&](int i) { return reinterpret_cast<double*>(&parts[i].X); });
#else
  for (int i = 0; i < count; ++i) parts[i].X = poseInParent<double>(links[i], &q);
  for (int i = 0; i < count; ++i)
    if (links[i].parent != Link::kNoParent) parts[i].X = parts[links[i].parent].X * parts[i].X;
#endif
}

// O is the origin of the first link with a mass, so that inertias stay small even far from the world's
// origin: usually the root, otherwise its first descendant with a mass.
inline void chooseOrigins(const Link* links, int count, Part* parts) {
  bool areRoots = true;
  for (int i = 0; i < count; ++i) {
    const int parent = links[i].parent;
    parts[i].root = parent == Link::kNoParent ? i : parts[parent].root;
    parts[i].origin = i;
    areRoots = areRoots && (parent != Link::kNoParent || links[i].mass != 0);
  }
  for (int i = 0; i < count && !areRoots; ++i)
    if (Part& root = parts[parts[i].root]; links[root.origin].mass == 0) root.origin = i;
}

// Mass, moment and inertia of the link alone. The inertia about O comes from the squares of r = p + d with
// the link's d: r r = p p + (p d + d p) + d d, summed by mass.
#ifdef __AVX__
inline void weigh(const Link& link, const Vec3<double>& p_OL, Part& part) {
  const double* const R = reinterpret_cast<const double*>(&part.X);
  const double* const S = link.inertia;
  const double Sy[] = {S[1], S[3], S[4]}, Sz[] = {S[2], S[4], S[5]};
  const PoseColumns X = loadColumns(R);
  const Quad p(Quad::Numbers{p_OL.x, p_OL.y, p_OL.z, 0}), h = turned(X, link.moment), mass(link.mass);
  const Quad half = Quad(0.5) * p, twice = mass * p + Quad(2.0) * h;
  const Quad RS[] = {turned(X, S), turned(X, Sy), turned(X, Sz)};
  double a[4], b[4];
  store(half, a);
  store(twice, b);
  const double trace = 2 * a[0] * b[0] + 2 * a[1] * b[1] + 2 * a[2] * b[2];
  const auto column = [&](int k, Quad traceAtK) {
    const Quad turnedBack = RS[0] * Quad(R[k]) + RS[1] * Quad(R[3 + k]) + RS[2] * Quad(R[6 + k]);
    return turnedBack + (traceAtK - (half * Quad(b[k]) + twice * Quad(a[k])));
  };
  const Quad x = column(0, Quad::Numbers{trace, 0, 0, 0}), y = column(1, Quad::Numbers{0, trace, 0, 0}),
             z = column(2, Quad::Numbers{0, 0, trace, 0});
  const auto xy = __builtin_shufflevector(x.numbers, y.numbers, 0, 4, 5, 5);
  store(Quad(__builtin_shufflevector(xy, z.numbers, 0, 1, 4, 2)), &part.inertia.xx);
  // The stores spill numbers, which the next ones overwrite.
  store(Quad(__builtin_shufflevector(z.numbers, z.numbers, 1, 2, 2, 2)), &part.inertia.yz);
  store(h + mass * p, &part.moment.x);
  part.mass = link.mass;
}
#else
inline void weigh(const Link& link, const Vec3<double>& p_OL, Part& part) {
  const Vec3<double> h = part.X.R * broadcastVec3<double>(link.moment);
  const Vec3<double> twice = link.mass * p_OL + 2.0 * h;
  const Sym3<double> moved = symmetricProduct(0.5 * p_OL, twice);
  const double trace = moved.xx + moved.yy + moved.zz;
  const Sym3<double> I = rotated(part.X.R, broadcastSym3<double>(link.inertia));
  part.mass = link.mass;
  part.moment = h + link.mass * p_OL;
  part.inertia = {I.xx + (trace - moved.xx), I.xy - moved.xy, I.xz - moved.xz,
                  I.yy + (trace - moved.yy), I.yz - moved.yz, I.zz + (trace - moved.zz)};
}
#endif

// Appends the freedoms of the link, below freedom `parent`.
inline void appendFreedoms(const Link& link, const KernelPose<double>& X, const Vec3<double>& p_OL,
                           int parent, Freedoms& freedoms) {
  const Vec3<double> zero{0, 0, 0}, axis = link.ratio * X.R.c2;
  const int i = freedoms.count, column = link.vIndex;
  switch (link.kind) {
    case Link::Kind::kHinge:
      freedoms.add(axis, cross(p_OL, axis), parent, column);
      return;
    case Link::Kind::kScrew:
      freedoms.add(axis, cross(p_OL, axis) + link.pitch * axis, parent, column);
      return;
    case Link::Kind::kSlider:
      freedoms.add(zero, axis, parent, column);
      return;
    case Link::Kind::kQuaternion:
      freedoms.add(X.R.c0, cross(p_OL, X.R.c0), parent, column);
      freedoms.add(X.R.c1, cross(p_OL, X.R.c1), i, column + 1);
      freedoms.add(X.R.c2, cross(p_OL, X.R.c2), i + 1, column + 2);
      return;
  }
}

// The last freedom above link i, or kNone.
inline int lastFreedomAbove(const Link* links, const Part* parts, int i) {
  return links[i].parent == Link::kNoParent ? kNone : parts[links[i].parent].lastFreedom;
}

// Places and weighs the links, and lists their freedoms.
inline void buildTree(const Link* links, int linkCount, const double* q, Part* parts, Freedoms& freedoms) {
  place(links, linkCount, q, parts);
  chooseOrigins(links, linkCount, parts);
  for (int i = 0; i < linkCount; ++i) {
    Part& part = parts[i];
    const Vec3<double> p_OL = part.X.p - parts[parts[part.root].origin].X.p;
    weigh(links[i], p_OL, part);
    appendFreedoms(links[i], part.X, p_OL, lastFreedomAbove(links, parts, i), freedoms);
    part.lastFreedom = freedoms.count - 1;
  }
}

// Adds kNumbers of what is carried to those of the carrier: ten are inertia, moment and mass of a part.
template <class T, int kNumbers = 10>
inline void addTo(double* carrier, const double* carried) {
  constexpr int kPacked = kNumbers / kLanesOf<T> * kLanesOf<T>;
  for (int e = 0; e < kPacked; e += kLanesOf<T>)
    store(load<T>(carrier + e) + load<T>(carried + e), carrier + e);
  for (int e = kPacked; e < kNumbers; ++e) carrier[e] += carried[e];
}

}  // namespace
}  // namespace rex::internal
