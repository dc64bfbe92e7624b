#pragma once

#include <array>

#include "collision/contact_kernel_internal.h"
#include "collision/contacts.h"
#include "collision/convex_core_internal.h"

namespace rex {

/// A shape that takes part, as queries need it.
struct ContactSolid {
  int shape = 0;  ///< its place in Model::shapes()
  BodyId body = kWorld;
  Pose X_BS{};
  Shape form{};
  internal::Core core{};
  double reach = 0;  ///< radius of a sphere about its origin that holds it, metres
  Eigen::Vector3d middle{0, 0, 0}, half{0, 0, 0};  ///< of a box along its axes that holds it
};

/// Rows are places in `pairs`; the other pairs name solids by their places here.
struct ContactModel::Data {
  std::vector<ShapePair> pairs;
  std::vector<ContactSolid> solids;
  std::vector<int> solidOf;   ///< of each shape of the model, -1: it takes no part
  std::vector<double> X_BS;   ///< 12 numbers of each solid
  std::vector<double> sizes;  ///< kSizeNumbers of each solid, the same in all lanes
  std::array<std::vector<internal::CorePair>, 3> cores;  ///< as in ContactKernel::pairs
  std::vector<internal::CorePair> others;                ///< for convexProximity()
};

}  // namespace rex
