#pragma once

#include <span>
#include <string>

#include "collision/contacts.h"

namespace rex {

/// What to call a shape of the model, by its place in Model::shapes(): its own name, or that of its body. A
/// number counts the shapes without a name there, "hole#2", and those that share a name, as the collision
/// shapes of a URDF link do: "panda_link2#3" is the third of them.
[[nodiscard]] std::string shapeLabel(const Model& model, int shape);

/// A table of the pairs, nearest first, a line each under a headline: names, distance, the nearest points of
/// both shapes in W, metres. Distances that are not a number come before all others.
[[nodiscard]] std::string proxyReport(const Model& model, std::span<const Proxy> proxies);

}  // namespace rex
