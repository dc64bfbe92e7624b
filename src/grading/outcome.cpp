#include "grading/outcome.h"

#include <algorithm>
#include <array>

namespace rex::grading {
namespace {

constexpr std::array<std::string_view, 10> kNames = {
    "pass",         "fail",         "compile_error",  "runtime_error",  "time_limit",
    "memory_limit", "output_limit", "protocol_error", "security_event", "grader_error"};

}  // namespace

std::string_view toString(Outcome outcome) { return kNames.at(static_cast<std::size_t>(outcome)); }

std::optional<Outcome> outcomeFromString(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Outcome>(found - kNames.begin());
}

}  // namespace rex::grading
