#pragma once

#include <span>
#include <string>

#include "collision/contacts.h"

namespace rex {

/// The label of a shape of the model, given its index in Model::shapes(): its own name, or that of its
/// body. A number counts a body's shapes without a name, "hole#2", and shapes that share a name, as the
/// collision shapes of a URDF link do: "panda_link2#3" is the third of them.
[[nodiscard]] std::string shapeLabel(const Model& model, int shape);

/// A table of the pairs, nearest first, with a headline and a line for each: names, distance, and the
/// nearest points of both shapes in W, metres. Distances that are not a number come first.
[[nodiscard]] std::string proxyReport(const Model& model, std::span<const Proxy> proxies);

}  // namespace rex
