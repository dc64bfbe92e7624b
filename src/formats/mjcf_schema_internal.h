#pragma once

#include <string_view>

#include "formats/urdf_tag_internal.h"

namespace rex::mjcf {

/// What becomes of the attributes and children of an element of MJCF, by the one table of all that MuJoCo
/// knows: it is read, has no effect here, or is left out, with what will differ from MuJoCo then. `element`
/// is its name, if that has several meanings after that of the section: "joint" is in a body,
/// "equality/joint" and "fixed/joint" are not. All kinds of actuators that are read share "motor". Empty for
/// names that are not in the table.
[[nodiscard]] const urdf::Known& knownOf(std::string_view element);

}  // namespace rex::mjcf
