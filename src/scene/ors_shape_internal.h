#pragma once

#include "scene/ors_attributes_internal.h"
#include "scene/scene_spec.h"

namespace rex::ors {

/// The attributes that a shape has, and the ones it may have without effect.
[[nodiscard]] const std::vector<std::string>& shapeAttributes();

/// The shape that the attributes describe; they may also be those of a body. `where` is its statement.
[[nodiscard]] ShapeSpec readShape(const Attributes& attributes, std::string name, const Place& where,
                                  Diagnostics& notes);

}  // namespace rex::ors
