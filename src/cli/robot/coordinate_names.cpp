#include "cli/robot/coordinate_names.h"

#include <algorithm>

#include "cli/terminal.h"
#include "scene/coordinate_names.h"

namespace rex::cli {
namespace {

std::vector<std::string> allHarmless(std::vector<std::string> names) {
  for (std::string& name : names) name = harmless(name);
  return names;
}

}  // namespace

std::vector<std::string> printablePositionNames(const Model& model) {
  return allHarmless(positionNames(model));
}

std::vector<std::string> printableVelocityNames(const Model& model) {
  return allHarmless(velocityNames(model));
}

std::size_t widestOf(const std::vector<std::string>& names, std::size_t least) {
  for (const std::string& name : names) least = std::max(least, name.size());
  return least;
}

}  // namespace rex::cli
