#pragma once

#include "dynamics/inverse_dynamics.h"
#include "scene/model.h"

namespace rex::internal {

/// Memory for a kernel of so many lanes, aligned for it.
template <class Kernel>
[[nodiscard]] void* roomFor(const Kernel& kernel, const Model& model, int lanes,
                            DynamicsWorkspace& workspace) {
  constexpr std::size_t kPerLine = sizeof(DynamicsWorkspace::Line) / sizeof(double);
  const int perLane = kernel.numbersPerLink * static_cast<int>(model.links().size() + 1) +
                      kernel.numbersPerFreedom * model.nv();
  const std::size_t lines = static_cast<std::size_t>(lanes * perLane) / kPerLine + 1;
  if (workspace.lines.size() < lines) workspace.lines.resize(lines);
  return workspace.lines.data();
}

}  // namespace rex::internal
