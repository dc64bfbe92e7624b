#pragma once

#include "collision/contact_model.h"
#include "collision/core_internal.h"

namespace rex {

/// A shape of the model as queries need it.
struct ContactShape {
  BodyId body = kWorld;
  Pose X_BS{};
  Shape shape{};
  internal::Core core{};
  double reach = 0;  ///< radius of a sphere about its origin that holds it, metres
};

struct ContactModel::Data {
  std::vector<ShapePair> pairs;
  std::vector<ContactShape> shapes;  ///< at the places of Model::shapes()
};

}  // namespace rex
