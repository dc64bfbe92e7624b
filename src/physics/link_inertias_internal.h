#pragma once

#include "scene/model.h"

namespace rex::internal {

/// What each of Model::links() has to move along its coordinate with all that hangs on it, were all other
/// joints locked: kg m^2, of sliders kg, of quaternions the least of their three. In the initial posture.
[[nodiscard]] std::vector<double> linkInertias(const Model& model);

}  // namespace rex::internal
