#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/numbers.h"
#include "cli/wrong_use_internal.h"
#include "planning/dubins.h"
#include "planning/reeds_shepp.h"

namespace rex::cli {
namespace {

struct CurvesOptions {
  std::string from{}, to{};  ///< x,y,heading; metres and radians
  double radius = 1;         ///< metres
  bool json = false;
};

constexpr const char* kForm = "x,y,th";

Json jsonOf(const Curve& curve) {
  Json segments = Json::array();
  const std::string word = curve.word();
  for (std::size_t i = 0; i < word.size(); ++i)
    segments.push_back(Json::array({word.substr(i, 1), curve.segments()[i].length}));
  return {{"length", curve.length()}, {"word", word}, {"segments", std::move(segments)}};
}

// Leaves out segments that round to zero length: straight on is S, not LSL.
std::string described(const std::string& name, const Curve& curve) {
  std::string word, metres;
  const std::string whole = curve.word();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    const double length = curve.segments()[i].length;
    if (std::abs(length) < 5e-5) continue;
    word += whole[i];
    metres += fmt::format(" {:9.4f}", length);
  }
  return fmt::format("{:<13} {:10.6f} m  {:<5}{}", name, curve.length(), word.empty() ? "-" : word, metres);
}

// Prints the shortest curves for a car that drives forward only, and for one that may drive backward.
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

}  // namespace

void addCurves(CLI::App* command, Action& action) {
  const auto options = std::make_shared<CurvesOptions>();
  command->footer(
      "Examples:\n  scripts/rex curves --to 0,2,3.14159\n"
      "  scripts/rex curves --from 0,0,0 --to -1,1,0 --radius 2 --json\n\n"
      "The car of Dubins drives forward only, that of Reeds and Shepp also backward.");
  command->add_option("--from", options->from, "start pose (default: 0,0,0)")->type_name("x,y,th");
  command->add_option("--to", options->to, "goal pose: metres, and the heading in radians")
      ->type_name("x,y,th")
      ->required();
  command->add_option("--radius", options->radius, "smallest turning radius (default: 1)")
      ->type_name("METRES");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return curves(*options); }; });
}

}  // namespace rex::cli
