#include "cli/robot/path_timing.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/join.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

// The first few names, and how many more there are.
std::string listOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    shown.push_back("'" + harmless(names[i]) + "'");
  const std::string rest = names.size() > kMost ? fmt::format(" and {} more", names.size() - kMost) : "";
  return fmt::format("{}{}", join(shown, ", "), rest);
}

}  // namespace

PathTiming timingOf(const PathTask& task, const PlanOptions& options, const FoundPath& found) {
  PathTiming timing{
      .limits = jointLimits(task.model,
                            {.velocity = options.velocity, .ramp = options.ramp, .effort = options.effort})};
  timing.result = parametrizeTime(found.curve, timing.limits.limits);
  return timing;
}

std::string assumptionsOf(const PathTiming& timing, const PlanOptions& options) {
  std::string text;
  if (!timing.limits.assumedVelocity.empty())
    text = fmt::format("no velocity limit for {}: assuming {:g} rad/s or m/s, see --velocity",
                       listOf(timing.limits.assumedVelocity), options.velocity);
  if (!timing.limits.anyEffort.empty())
    text += fmt::format("{}no effort limit for {}: assuming any effort", text.empty() ? "" : "; ",
                        listOf(timing.limits.anyEffort));
  return text;
}

std::string limitsTextOf(const PathTiming& timing, const PlanOptions& options) {
  const auto all = timing.limits.limits.velocity.size();
  const auto assumed = static_cast<Eigen::Index>(timing.limits.assumedVelocity.size());
  const std::string velocity =
      assumed == 0     ? "velocities of the scene"
      : assumed == all ? fmt::format("velocities {:g} rad/s or m/s", options.velocity)
                       : fmt::format("velocities of the scene, for {} of {} coordinates {:g} rad/s or m/s",
                                     assumed, all, options.velocity);
  return fmt::format("{}; accelerations that reach them in {:g} s{}", velocity, options.ramp,
                     options.effort ? "; efforts of the scene" : "");
}

}  // namespace rex::cli
