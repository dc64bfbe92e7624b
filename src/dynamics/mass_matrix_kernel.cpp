#include "dynamics/kernels_internal.h"
#include "dynamics/tree_kernel_internal.h"

namespace rex::internal {
namespace {

constexpr int kRows = 6;  // of each freedom: its twist

// The momentum that a freedom gives to a part and all it carries, projected onto that freedom and those above
// it. Joints that share a column add up in it.
template <class T>
inline void addRow(const Part& part, const Freedoms& freedoms, int own, double* M, long stride) {
  const Vec3<double> w = freedoms.angular<double>(own), v = freedoms.linear<double>(own);
  const Vec3<double> torque = part.inertia * w + cross(part.moment, v);
  const Vec3<double> force = part.mass * v + cross(w, part.moment);
  const int column = freedoms.columns[own];
  M[stride * column + column] += dot(w, torque) + dot(v, force);
  const auto add = [&](int i, double seen) {
    const int row = freedoms.columns[i];
    M[stride * column + row] += seen;
    M[stride * row + column] += seen;
  };
  const Vec3<T> torques = broadcast<T>(torque), forces = broadcast<T>(force);
  for (int last = freedoms.parents[own]; last != kNone;) {
    const int start = freedoms.starts[last];
    for (; last - start + 1 >= kLanesOf<T>; last -= kLanesOf<T>) {
      const int first = last - kLanesOf<T> + 1;
      double seen[kLanesOf<T>];
      store(dot(freedoms.angular<T>(first), torques) + dot(freedoms.linear<T>(first), forces), seen);
      for (int i = 0; i < kLanesOf<T>; ++i) add(first + i, seen[i]);
    }
    for (; last >= start; --last)
      add(last, dot(freedoms.angular<double>(last), torque) + dot(freedoms.linear<double>(last), force));
    last = freedoms.parents[start];
  }
}

// Composite rigid bodies.
template <class T>
void compute(const Link* links, int linkCount, const double* q, void* memory, double* M, long stride,
             int nv) {
  if (nv == 0) return;
  Part* parts = static_cast<Part*>(memory);
  Freedoms freedoms = freedomsIn(parts + linkCount, linkCount, kRows);
  buildTree(links, linkCount, q, parts, freedoms);
  const bool isDense = stride == nv;  // one long column
  const long rows = isDense ? stride * nv : nv;
  for (int k = 0; k < (isDense ? 1 : nv); ++k)
    __builtin_memset(M + stride * k, 0, sizeof(double) * static_cast<unsigned long>(rows));
  for (int i = linkCount - 1; i >= 0; --i) {
    const Part& part = parts[i];
    for (int own = part.lastFreedom; own != lastFreedomAbove(links, parts, i); own = freedoms.parents[own])
      addRow<T>(part, freedoms, own, M, stride);
    if (links[i].parent == Link::kNoParent) continue;
    addTo<T>(&parts[links[i].parent].inertia.xx, &part.inertia.xx);
  }
}

}  // namespace

template <int kLanes>
MassMatrixKernel MassMatrixKernel::compiled() {
  return {&compute<InLanes<kLanes>>, kLanesOf<Part> + freedomNumbersPerLink(kRows), 0};
}
template MassMatrixKernel MassMatrixKernel::compiled<REX_LANES>();

}  // namespace rex::internal
