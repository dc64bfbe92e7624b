#pragma once

#include <memory>
#include <string>

#include "scene/model.h"

struct mjModel_;

namespace rex::bench {

struct MujocoDeleter {
  void operator()(mjModel_* model) const;
};
using MujocoModel = std::unique_ptr<mjModel_, MujocoDeleter>;

/// MuJoCo's model of an MJCF text. Throws std::logic_error with its message.
[[nodiscard]] MujocoModel loadMujoco(const std::string& xml);

/// The scene as a MuJoCo model file (MJCF): bodies with their joints and masses under our names, no shapes.
/// For hinges and sliders; a body with any other joint is welded to its parent.
[[nodiscard]] std::string mujocoXml(const Model& model);

}  // namespace rex::bench
