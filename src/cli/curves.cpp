#include <cmath>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/json_internal.h"
#include "cli/posture_option.h"
#include "cli/wrong_use_internal.h"
#include "planning/dubins.h"
#include "planning/reeds_shepp.h"

namespace rex::cli {
namespace {

constexpr const char* kForm = "x,y,th";

Json jsonOf(const Curve& curve) {
  Json segments = Json::array();
  const std::string word = curve.word();
  for (std::size_t i = 0; i < word.size(); ++i)
    segments.push_back(Json::array({word.substr(i, 1), curve.segments()[i].length}));
  return {{"length", curve.length()}, {"word", word}, {"segments", std::move(segments)}};
}

std::string described(const std::string& name, const Curve& curve) {
  std::string text = fmt::format("{:<13} {:10.6f} m  {:<5}", name, curve.length(), curve.word());
  for (const CurveSegment& segment : curve.segments()) {
    const double metres = std::abs(segment.length) < 5e-5 ? 0 : segment.length;  // not "-0.0000"
    text += fmt::format(" {:9.4f}", metres);
  }
  return text;
}

}  // namespace

ExitCode curves(const CurvesOptions& options) {
  const Eigen::Vector3d from =
      options.from.empty() ? Eigen::Vector3d::Zero() : parsePoint(options.from, "--from", kForm);
  const Eigen::Vector3d to = parsePoint(options.to, "--to", kForm);
  const auto [dubins, reedsShepp] = asWrongUse([&] {
    return std::pair{dubinsCurve(from, to, options.radius), reedsSheppCurve(from, to, options.radius)};
  });
  if (options.json) {
    say(dump(Json{{"dubins", jsonOf(dubins)}, {"reeds_shepp", jsonOf(reedsShepp)}}));
    return ExitCode::kFull;
  }
  say("              length      word  metres of each segment, negative: backward");
  say(described("Dubins", dubins));
  say(described("Reeds-Shepp", reedsShepp));
  return ExitCode::kFull;
}

}  // namespace rex::cli
