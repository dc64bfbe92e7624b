#include "cli/point_option.h"

#include <vector>

#include <fmt/format.h>

#include "cli/number_words.h"

namespace rex::cli {

Eigen::Vector3d parsePoint(const std::string& text, const std::string& option, const std::string& form) {
  const Refusal refuse = refusalOf(option);
  const std::vector<std::string> all = numberWords(text, refuse);
  if (all.size() != 3) refuse(fmt::format("{} numbers", all.size()), "three: " + form);
  Eigen::Vector3d point;
  for (int i = 0; i < 3; ++i) {
    const auto number = numberIn(all[static_cast<std::size_t>(i)]);
    if (!number) refuse("'" + all[static_cast<std::size_t>(i)] + "'", "a number");
    point[i] = *number;
  }
  return point;
}

}  // namespace rex::cli
