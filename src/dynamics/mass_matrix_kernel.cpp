#include "dynamics/link_kernel_internal.h"
#include "dynamics/mass_matrix_kernel_internal.h"

namespace rex::internal {
namespace {

// A link, in the axes of the world and about the origin O of its tree; mass, moment and inertia are in the
// end those of all that it carries.
struct Part {
  KernelPose<double> X;  // in the parent, then in the world
  double mass;
  Vec3<double> moment;
  Sym3<double> inertia;
  int root;         // of its tree
  int origin;       // of a root: the part whose origin is O
  int lastFreedom;  // its own last
};

// A coordinate's twist at O, per unit of v.
struct Freedom {
  Vec3<double> angular, linear;
  int parent;  // the one before on the way to the world, or kNone
  int column;
};
constexpr int kNone = -1;

// a b^T + b a^T.
inline Sym3<double> symmetricProduct(const Vec3<double>& a, const Vec3<double>& b) {
  return {2 * a.x * b.x, a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x,
          2 * a.y * b.y, a.y * b.z + a.z * b.y, 2 * a.z * b.z};
}

// Poses do not wait for one another until they are multiplied: first all sines, then the chain. O is the
// origin of the first link with a mass: far from the world's origin too, inertias stay small.
inline void place(const Link* links, int count, const double* q, Part* parts) {
  for (int i = 0; i < count; ++i) parts[i].X = poseInParent<double>(links[i], &q);
  for (int i = 0; i < count; ++i) {
    const int parent = links[i].parent;
    Part& part = parts[i];
    if (parent == Link::kNoParent) {
      part.root = part.origin = i;
      continue;
    }
    part.X = parts[parent].X * part.X;
    part.root = parts[parent].root;
    Part& root = parts[part.root];
    if (links[root.origin].mass == 0) root.origin = i;
  }
}

// What the link weighs alone.
inline void weigh(const Link& link, const Vec3<double>& p_OL, Part& part) {
  const Vec3<double> h = part.X.R * broadcastVec3<double>(link.moment);
  // About O, from the squares of r = p + d with the link's d: r r = p p + (p d + d p) + d d, summed by mass.
  const Vec3<double> twice = link.mass * p_OL + 2.0 * h;
  const Sym3<double> moved = symmetricProduct(0.5 * p_OL, twice);
  const double trace = moved.xx + moved.yy + moved.zz;
  const Sym3<double> I = rotated(part.X.R, broadcastSym3<double>(link.inertia));
  part.mass = link.mass;
  part.moment = h + link.mass * p_OL;
  part.inertia = {I.xx + (trace - moved.xx), I.xy - moved.xy, I.xz - moved.xz,
                  I.yy + (trace - moved.yy), I.yz - moved.yz, I.zz + (trace - moved.zz)};
}

// Appends the freedoms of the link.
inline int appendFreedoms(const Link& link, const KernelPose<double>& X, const Vec3<double>& p_OL, int parent,
                          Freedom* freedoms, int count) {
  const auto turn = [&](const Vec3<double>& axis, int column) {
    freedoms[count] = {axis, cross(p_OL, axis), parent, column};
    parent = count++;
  };
  const Vec3<double> zero{0, 0, 0}, axis = link.ratio * X.R.c2;
  switch (link.kind) {
    case Link::Kind::kHinge:
      turn(axis, link.vIndex);
      break;
    case Link::Kind::kScrew:
      turn(axis, link.vIndex);
      freedoms[parent].linear = freedoms[parent].linear + link.pitch * axis;
      break;
    case Link::Kind::kSlider:
      freedoms[count] = {zero, axis, parent, link.vIndex};
      ++count;
      break;
    case Link::Kind::kQuaternion:
      turn(X.R.c0, link.vIndex);
      turn(X.R.c1, link.vIndex + 1);
      turn(X.R.c2, link.vIndex + 2);
      break;
  }
  return count;
}

// The momentum that a freedom gives to a part and what that carries, seen by the freedoms above. Joints that
// share a column add up there.
inline void addRow(const Part& part, const Freedom* freedoms, int own, double* M, long stride) {
  const Freedom& f = freedoms[own];
  const Vec3<double> torque = part.inertia * f.angular + cross(part.moment, f.linear);
  const Vec3<double> force = part.mass * f.linear + cross(f.angular, part.moment);
  double* column = M + stride * f.column;
  column[f.column] += dot(f.angular, torque) + dot(f.linear, force);
  for (int i = f.parent; i != kNone; i = freedoms[i].parent) {
    const double x = dot(freedoms[i].angular, torque) + dot(freedoms[i].linear, force);
    column[freedoms[i].column] += x;
    M[stride * freedoms[i].column + f.column] += x;
  }
}

// Composite rigid bodies.
void compute(const Link* links, int linkCount, const double* q, void* memory, double* M, long stride,
             int nv) {
  Part* parts = static_cast<Part*>(memory);
  Freedom* freedoms = reinterpret_cast<Freedom*>(parts + linkCount);
  place(links, linkCount, q, parts);
  int count = 0;
  for (int i = 0; i < linkCount; ++i) {
    const int parent = links[i].parent;
    Part& part = parts[i];
    const Vec3<double> p_OL = part.X.p - parts[parts[part.root].origin].X.p;
    weigh(links[i], p_OL, part);
    const int above = parent == Link::kNoParent ? kNone : parts[parent].lastFreedom;
    count = appendFreedoms(links[i], part.X, p_OL, above, freedoms, count);
    part.lastFreedom = count - 1;
  }
  for (int k = 0; k < nv; ++k)
    __builtin_memset(M + stride * k, 0, sizeof(double) * static_cast<unsigned long>(nv));
  for (int i = linkCount - 1; i >= 0; --i) {
    const Part& part = parts[i];
    const int parent = links[i].parent;
    const int above = parent == Link::kNoParent ? kNone : parts[parent].lastFreedom;
    for (int own = part.lastFreedom; own != above; own = freedoms[own].parent)
      addRow(part, freedoms, own, M, stride);
    if (parent == Link::kNoParent) continue;
    Part& carrier = parts[parent];
    carrier.mass += part.mass;
    carrier.moment = carrier.moment + part.moment;
    carrier.inertia = carrier.inertia + part.inertia;
  }
}

}  // namespace

template <int kLanes>
MassMatrixKernel MassMatrixKernel::compiled() {
  return {&compute, kLanesOf<Part> + 3 * kLanesOf<Freedom>, 0};
}
template MassMatrixKernel MassMatrixKernel::compiled<REX_LANES>();

}  // namespace rex::internal
