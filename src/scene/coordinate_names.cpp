#include "scene/coordinate_names.h"

#include <fmt/format.h>

namespace rex {
namespace {

std::vector<std::string> coordinateNames(const Model& model, int all, int Joint::*first, int Joint::*count) {
  std::vector<std::string> names(static_cast<std::size_t>(all));
  for (const Joint& joint : model.joints())
    for (int i = 0; i < joint.*count && !joint.mimics; ++i)
      names[static_cast<std::size_t>(joint.*first + i)] =
          joint.name + (joint.*count > 1 ? fmt::format(" [{}]", i) : "");
  return names;
}

}  // namespace

std::vector<std::string> positionNames(const Model& model) {
  return coordinateNames(model, model.nq(), &Joint::qIndex, &Joint::nq);
}

std::vector<std::string> velocityNames(const Model& model) {
  return coordinateNames(model, model.nv(), &Joint::vIndex, &Joint::nv);
}

}  // namespace rex
