#include <algorithm>

#include <fmt/format.h>

#include "base/join.h"
#include "geometry/inertia.h"
#include "scene/urdf_parts_internal.h"

namespace rex::urdf {
namespace {

// Negative moments count as rounding error up to a millionth of the sum of moments, as files give some six
// digits, or up to mass times the square of a micrometre, as no file means lengths below that.
constexpr double kRelativeRounding = 1e-6, kRoundingLength = 1e-6;
constexpr double kOwnRounding = 1e-14;

std::string whatIsDone(const Eigen::Vector3d& moments, double mass) {
  const double sum = moments.cwiseAbs().sum();
  const bool isRounding =
      moments[0] >= -std::max(kRelativeRounding * sum, kRoundingLength * kRoundingLength * mass);
  std::vector<std::string> negative;
  for (const double moment : moments)
    if (moment < -kOwnRounding * sum) negative.push_back(fmt::format("{:.6g}", moment));
  const bool isOne = negative.size() == 1;
  return fmt::format("{} kg m^2 {} and {} as 0", join(negative, " and "),
                     isRounding ? (isOne ? "is within rounding error" : "are within rounding error")
                                : (isOne ? "is physically impossible" : "are physically impossible"),
                     isOne ? "counts" : "count");
}

}  // namespace

Eigen::Matrix3d judgedMoments(Reading& reading, const SourceLocation& where, const std::string& subject,
                              const Eigen::Matrix3d& I, double mass) {
  const InertiaFault fault = inertiaFault(I);
  const auto warn = [&](const std::string& message) { reading.notes.warn(where, subject + ": " + message); };
  if (fault == InertiaFault::kTriangle)
    warn("no body has this inertia: one principal moment exceeds the sum of the others");
  const Eigen::Vector3d moments = principalMoments(I);
  if (moments[0] >= -kOwnRounding * moments.cwiseAbs().sum()) return I;
  const std::string instead = whatIsDone(moments, mass);
  if (fault == InertiaFault::kNegative) {
    reading.forgive({subject + ": a negative principal moment", where, "", "principal moments >= 0"},
                    instead);
  } else {
    warn("a negative principal moment; " + instead);
  }
  return nearestWithoutNegativeMoments(I);
}

}  // namespace rex::urdf
