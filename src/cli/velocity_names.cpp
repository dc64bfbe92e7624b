#include "cli/velocity_names.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/terminal.h"

namespace rex::cli {

std::vector<std::string> velocityNames(const Model& model) {
  std::vector<std::string> names(static_cast<std::size_t>(model.nv()));
  for (const Joint& joint : model.joints())
    for (int i = 0; i < joint.nv && !joint.mimics; ++i)
      names[static_cast<std::size_t>(joint.vIndex + i)] =
          harmless(joint.name) + (joint.nv > 1 ? fmt::format(" [{}]", i) : "");
  return names;
}

std::size_t widestOf(const std::vector<std::string>& names, std::size_t least) {
  for (const std::string& name : names) least = std::max(least, name.size());
  return least;
}

}  // namespace rex::cli
