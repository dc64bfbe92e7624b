#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/numbers.h"
#include "cli/results_internal.h"
#include "cli/robot/scene_option.h"
#include "cli/robot/scene_verbs.h"
#include "cli/terminal.h"
#include "collision/touch_sample.h"
#include "formats/srdf.h"

namespace rex::cli {
namespace {

std::string pairNames(const Model& model, const PairVerdict& verdict) {
  return fmt::format("{} - {}", model[verdict.a].name, model[verdict.b].name);
}

Json jsonOfVerdict(const Model& model, const PairVerdict& verdict) {
  return {{"a", model[verdict.a].name},
          {"b", model[verdict.b].name},
          {"may_collide", verdict.mayCollide},
          {"reason", toString(verdict, model)}};
}

Results resultsOf(const Model& model, const std::vector<PairVerdict>& verdicts) {
  Results all{.json = {{"rule", toString(model.collisionRule())}, {"pairs", Json::array()}}};
  for (const PairVerdict& verdict : verdicts) all.json["pairs"].push_back(jsonOfVerdict(model, verdict));
  all.line("rule {}: {} of {} pairs of bodies may collide", toString(model.collisionRule()),
           std::ranges::count_if(verdicts, &PairVerdict::mayCollide), verdicts.size());
  Table table;
  for (const bool mayCollide : {false, true})
    for (const PairVerdict& verdict : verdicts)
      if (verdict.mayCollide == mayCollide)
        table.add(
            {escapeForTerminal(pairNames(model, verdict)), escapeForTerminal(toString(verdict, model))});
  if (!verdicts.empty()) all.line("{}", table.text());
  return all;
}

Json jsonOfSample(const Model& model, const TouchSample& sample, std::uint64_t seed) {
  Json pairs = Json::array();
  for (const auto& [verdict, touches] : sample.pairs)
    pairs.push_back({{"a", model[verdict.a].name}, {"b", model[verdict.b].name}, {"touches", touches}});
  return {{"postures", sample.postures}, {"seed", seed}, {"held", sample.held}, {"pairs", pairs}};
}

}  // namespace

ExitCode scenePairs(const Project& project, const PairsOptions& options) {
  const Model model = loadScene(project, options.scene.scene);
  static_cast<void>(sceneContactModel(model));  // not too large, and with its warnings
  const std::vector<PairVerdict> verdicts = pairVerdicts(model);
  resultsOf(model, verdicts).print(options.scene.json);
  return ExitCode::kFull;
}

ExitCode sceneNeverTouching(const Project& project, const PairsOptions& options) {
  SceneSpec spec = loadSpec(project, options.scene.scene);
  const Model model = asWrongUse([&] { return compile(spec); });
  static_cast<void>(sceneContactModel(model));
  Rng rng(options.seed);
  const TouchSample sample = asWrongUse([&] { return sampleTouches(model, options.samples, rng); });
  if (!sample.held.empty())
    note(escapeForTerminal(
        fmt::format("joints without limits to draw random positions from, kept at their start: {}",
                    join(sample.held, ", "))));
  if (options.scene.json) {
    say(dump(jsonOfSample(model, sample, options.seed)));
    return ExitCode::kFull;
  }
  // Keeps the choices that the scene already makes, as this file may replace its SRDF.
  std::vector<CollisionChoice> choices = std::move(spec.collisionChoices);
  for (const PairVerdict& verdict : pairVerdicts(model))
    if (verdict.reason == PairReason::kMasks)
      choices.push_back({model[verdict.a].name, model[verdict.b].name, false, toString(verdict, model), {}});
  const std::vector<CollisionChoice> suggested = suggestedChoices(model, sample);
  choices.insert(choices.end(), suggested.begin(), suggested.end());
  const std::string about = fmt::format(
      "A sample of {} random postures, seed {}, not a proof: a pair that never touched may touch in others.",
      sample.postures, options.seed);
  const std::string robot = options.scene.scene.file.stem().string();
  std::string text = asWrongUse([&] { return writeSrdf(robot, choices, about); });
  if (text.ends_with('\n')) text.pop_back();
  say(text);
  return ExitCode::kFull;
}

}  // namespace rex::cli
