#pragma once

#include "dynamics/link_kernel_internal.h"
#include "geometry/kernel_columns.h"

// See base/pack.h for why all is anonymous.
#ifdef __AVX__
namespace rex {
namespace {

/// Where the frame of a link stands in that of its parent, as poseInParent(), with these functions of its
/// coordinate x; not of a quaternion.
inline PoseColumns columnsInParent(const Link& link, double x, double sine, double cosine) {
  PoseColumns X = loadColumns(link.X_PL);
  if (link.kind == Link::Kind::kSlider) {
    X.p = X.p + Quad(x) * X.z;
    return X;
  }
  if (link.kind == Link::Kind::kScrew) X.p = X.p + Quad(link.pitch * x) * X.z;
  const Quad c0 = X.x;
  X.x = Quad(cosine) * c0 + Quad(sine) * X.y;
  X.y = Quad(cosine) * X.y - Quad(sine) * c0;
  return X;
}

/// Places the links in the world, one posture in lanes: four sines at once, and poses by columns, which stay
/// in registers as long as the next link hangs on the one before. pose(i) is where the twelve numbers of link
/// i go.
template <class PoseOf>
inline void placeByColumns(const Link* links, int count, const double* q, const PoseOf& pose) {
  constexpr int kAhead = 16;
  PoseColumns X{};
  for (int begin = 0; begin < count; begin += kAhead) {
    const int end = begin + kAhead < count ? begin + kAhead : count;
    double x[kAhead] = {}, sines[kAhead], cosines[kAhead];
    for (int i = begin; i < end; ++i)
      if (links[i].kind != Link::Kind::kQuaternion)
        x[i - begin] = links[i].ratio * q[links[i].qIndex] + links[i].offset;
    sinesOf(x, end - begin, sines, cosines);
    for (int i = begin; i < end; ++i) {
      const Link& link = links[i];
      double motion[12];
      if (link.kind == Link::Kind::kQuaternion)
        storePose(poseInParent<double>(link, &q), motion, 1);
      else
        storeColumns(columnsInParent(link, x[i - begin], sines[i - begin], cosines[i - begin]), motion);
      if (link.parent == Link::kNoParent) {
        X = loadColumns(motion);
      } else {
        if (link.parent != i - 1) X = loadColumns(pose(link.parent));
        X = times(X, motion);
      }
      storeColumns(X, pose(i));
    }
  }
}

}  // namespace
}  // namespace rex
#endif
