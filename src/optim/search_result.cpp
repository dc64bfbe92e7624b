#include "optim/search_result.h"

#include <cmath>

#include <fmt/format.h>

namespace rex {

const char* nameOf(SearchStatus status) {
  switch (status) {
    case SearchStatus::kTargetReached:
      return "target reached";
    case SearchStatus::kBudgetSpent:
      return "budget spent";
    case SearchStatus::kSmallSteps:
      return "small steps";
    case SearchStatus::kFlat:
      return "flat";
    case SearchStatus::kNoEffect:
      return "no effect";
    case SearchStatus::kStagnated:
      return "stagnated";
    case SearchStatus::kIllConditioned:
      return "ill-conditioned";
    case SearchStatus::kDiverged:
      return "diverged";
  }
  return "";
}

void SearchResult::add(const Eigen::Ref<const Eigen::VectorXd>& point, double valueThere) {
  ++evaluations;
  if (!std::isfinite(valueThere)) {
    ++invalid;
  } else if (valueThere < value) {
    value = valueThere;
    x = point;
  }
}

void SearchResult::end(SearchStatus why) {
  status = why;
  message = fmt::format("{}: {:.6g} after {} evaluations in {} iterations", nameOf(why), value, evaluations,
                        iterations);
  if (invalid > 0) message += fmt::format("; {} evaluations gave no finite value", invalid);
}

}  // namespace rex
