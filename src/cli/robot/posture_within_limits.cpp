#include "cli/robot/posture_within_limits.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/terminal.h"
#include "scene/coordinates.h"

namespace rex::cli {
namespace {

void requireWithinLimits(const Model& model, const std::string& option, const VectorArg& q) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double lower = model.lowerLimits()[i], upper = model.upperLimits()[i];
    const double outside = std::max(lower - q[i], q[i] - upper);
    if (outside <= 0) continue;
    throw UsageError(
        {.what = fmt::format("{}: joint '{}' (q{})", option, harmless(jointOfPosition(model, i).name), i),
         .found = fmt::format("{:g}, out of bounds by {:.4g}", q[i], outside),
         .wanted = fmt::format("{:g} to {:g}", lower, upper)});
  }
}

}  // namespace

Eigen::VectorXd postureWithinLimits(const Model& model, const std::string& option, const std::string& text) {
  Eigen::VectorXd q = parsePostureOf(model, option, text);
  forEachQuaternion(model, [&](int iq, int) { q.segment<4>(iq).normalize(); });
  requireWithinLimits(model, option, q);
  return q;
}

}  // namespace rex::cli
