#include "cli/robot/coordinate_names.h"

#include <algorithm>

#include <fmt/format.h>

#include "cli/terminal.h"

namespace rex::cli {
namespace {

std::vector<std::string> namesOf(const Model& model, int all, int Joint::*first, int Joint::*count) {
  std::vector<std::string> names(static_cast<std::size_t>(all));
  for (const Joint& joint : model.joints())
    for (int i = 0; i < joint.*count && !joint.mimics; ++i)
      names[static_cast<std::size_t>(joint.*first + i)] =
          harmless(joint.name) + (joint.*count > 1 ? fmt::format(" [{}]", i) : "");
  return names;
}

}  // namespace

std::vector<std::string> positionNames(const Model& model) {
  return namesOf(model, model.nq(), &Joint::qIndex, &Joint::nq);
}

std::vector<std::string> velocityNames(const Model& model) {
  return namesOf(model, model.nv(), &Joint::vIndex, &Joint::nv);
}

std::size_t widestOf(const std::vector<std::string>& names, std::size_t least) {
  for (const std::string& name : names) least = std::max(least, name.size());
  return least;
}

}  // namespace rex::cli
