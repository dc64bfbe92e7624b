#pragma once

#include <vector>

namespace rex {

/// Memory that functions of this module work in, kept by the caller of a hot loop: they allocate nothing once
/// it has been used with a model.
struct DynamicsWorkspace {
  std::vector<double> numbers{};
};

}  // namespace rex
