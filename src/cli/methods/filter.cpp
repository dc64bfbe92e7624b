#include "cli/methods/filter.h"

#include <cstdint>
#include <memory>
#include <numbers>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/json_internal.h"
#include "cli/methods/film_folder.h"
#include "cli/methods/filter_files.h"
#include "cli/methods/filter_run.h"
#include "cli/methods/filter_statistics.h"
#include "cli/methods/methods_room_internal.h"
#include "cli/option_value_internal.h"
#include "cli/shared_options_internal.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

void requireUse(bool isGiven, const char* option, bool isUsed, const char* wanted) {
  if (isGiven && !isUsed)
    throw UsageError({.what = option, .found = "no effect on its own", .wanted = wanted});
}

CarOptions carOf(const FilterOptions& options) {
  requireBetween("--dynamics-noise", options.dynamicsNoise, 0, 10);
  requireBetween("--observation-noise", options.observationNoise, 1e-6, 1e3);
  requireUse(options.bearingNoise.has_value(), "--bearing-noise", options.rangeBearing,
             "--range-bearing with it");
  CarOptions car{.dynamicsNoise = options.dynamicsNoise,
                 .observationNoise = options.observationNoise,
                 .rangeBearing = options.rangeBearing};
  car.bearingNoise = options.bearingNoise.value_or(car.bearingNoise);
  requireBetween("--bearing-noise", car.bearingNoise, 1e-6, std::numbers::pi);
  if (options.maxRange) requireBetween("--max-range", car.maxRange = *options.maxRange, 1e-3, 1e6);
  if (options.fieldOfView)
    requireBetween("--field-of-view", car.fieldOfView = *options.fieldOfView, 1e-3, 2 * std::numbers::pi);
  return car;
}

CarScenario scenarioOf(const FilterOptions& options) {
  CarScenario scenario{.filter = carFilterOf(options.filter), .car = carOf(options)};
  requireBetween("--landmarks", options.landmarks, 0, 1000);
  requireBetween("--steps", options.steps, 2, 100'000);
  requireBetween("--assume-dynamics", options.assumeDynamics, 1e-3, 1e3);
  requireBetween("--assume-observation", options.assumeObservation, 1e-3, 1e3);
  requireBetween("--seeds", options.seeds, 1, 10'000);
  requireUse(options.particles.has_value(), "--particles", hasParticles(scenario.filter),
             "--filter particles, fast-slam, fast-slam-2 or fast-slam-unnamed with it");
  requireUse(options.noFilm, "--no-film", !options.out.empty(), "-o with it");
  scenario.landmarks = options.landmarks;
  scenario.steps = options.steps;
  scenario.assumeDynamics = options.assumeDynamics;
  scenario.assumeObservation = options.assumeObservation;
  scenario.particles = options.particles.value_or(scenario.particles);
  requireBetween("--particles", scenario.particles, 2, 100'000);
  return scenario;
}

std::string textOf(const FilterOptions& options, const FilterStatistics& all) {
  std::string text = fmt::format("{}, {} landmarks, {} steps, {} {}\n", options.filter, options.landmarks,
                                 options.steps, all.runs.size(), all.runs.size() == 1 ? "run" : "runs");
  text += fmt::format("error      {:.4g} m, {:.4g} rad (root mean square); dead reckoning {:.4g} m\n",
                      all.position, all.heading, all.deadReckoning);
  if (all.foundLandmarks > 0)
    text += fmt::format("map        {:.4g} of {} landmarks{}, {:.4g} m (root mean square)\n",
                        all.foundLandmarks / static_cast<double>(all.runs.size()), options.landmarks,
                        all.runs.size() == 1 ? "" : " in each run on average", all.map);
  text += fmt::format(
      "NEES       {}, consistent: 3; means over the runs lie within {:.4g} to {:.4g}\n"
      "           in {:.1f} % of the steps, consistent: about 95 %",
      all.nees ? fmt::format("{:.4g}", *all.nees) : "none", all.stepBand.lower, all.stepBand.upper,
      100 * all.insideBand);
  if (all.innovations > 0)
    text += fmt::format("\nNIS        {:.4g} per observed number, consistent: {:.4g} to {:.4g}", all.nis,
                        all.nisBand.lower, all.nisBand.upper);
  if (all.singular > 0) text += fmt::format("\nsingular   covariances, left out of NEES: {}", all.singular);
  return text;
}

Json jsonOf(std::optional<double> number) { return number ? Json(*number) : Json(); }
Json jsonOf(const ConsistencyBand& band) { return {band.lower, band.upper}; }

std::string jsonTextOf(const FilterOptions& options, const FilterStatistics& all,
                       const std::vector<std::string>& files) {
  Json runs = Json::array();
  for (const RunErrors& run : all.runs)
    runs.push_back({{"seed", run.seed},
                    {"position", run.position},
                    {"heading", run.heading},
                    {"nees", jsonOf(run.nees)}});
  Json json{
      {"filter", options.filter},
      {"landmarks", options.landmarks},
      {"steps", options.steps},
      {"position", all.position},
      {"heading", all.heading},
      {"dead_reckoning", all.deadReckoning},
      {"map", all.foundLandmarks > 0 ? Json(all.map) : Json()},
      {"found_landmarks", all.foundLandmarks},
      {"nees", {{"mean", jsonOf(all.nees)}, {"band", jsonOf(all.stepBand)}, {"inside", all.insideBand}}},
      {"nis", Json()},
      {"singular", all.singular},
      {"runs", std::move(runs)},
      {"files", files}};
  if (all.innovations > 0) json["nis"] = {{"mean", all.nis}, {"band", jsonOf(all.nisBand)}};
  return dump(json);
}

// Lets a filter track the car of the course. Prints its errors and consistency.
ExitCode filter(const FilterOptions& options) {
  const CarScenario scenario = scenarioOf(options);
  const bool writes = !options.out.empty();
  if (writes) makeFilmFolder(options.out, "filter");
  ShownRun shownRun;
  const OnStep watch = [&](int step, const auto& view) {
    if (isFilmed(step, scenario.steps)) shownRun.frames.push_back(view());
    if (step == scenario.steps) shownRun.end = view();
  };
  FilterStatisticsBuilder builder;
  FilterRun first;
  for (int i = 0; i < options.seeds; ++i) {
    FilterRun run = runFilter(scenario, options.seed + static_cast<std::uint64_t>(i),
                              i == 0 && writes ? watch : OnStep{});
    builder.add(run);
    if (i == 0) first = std::move(run);
  }
  const FilterStatistics all = builder.statistics();
  std::vector<std::string> files;
  if (writes) files = writeFilterFiles(options, first, all, std::move(shownRun));
  if (options.json) {
    say(jsonTextOf(options, all, files));
  } else {
    say(textOf(options, all));
    for (const std::string& file : files) say(file);
  }
  return ExitCode::kFull;
}

}  // namespace

void addFilter(CLI::App* command, Action& action) {
  const auto options = std::make_shared<FilterOptions>();
  command->footer(
      "Examples:\n  scripts/rex filter --filter ukf --seeds 50\n"
      "  scripts/rex filter --filter ekf-slam --landmarks 12 -o slam\n"
      "  scripts/rex filter --filter particles --range-bearing --max-range 15 -o lost --no-film\n"
      "  scripts/rex filter --filter ekf --assume-observation 0.3 --seeds 50 --json\n\n"
      "The car drives with u = (0.1, 0.2) from a known start. Filters: ekf, ukf, information, root,\n"
      "rts (ekf, then smoothed), particles; without a map ekf-slam, fast-slam, fast-slam-2 and\n"
      "fast-slam-unnamed, which is not told which landmark it sees; dead-reckoning.\n"
      "DIR gets filter.csv, figures of errors, NEES and map, and the film filter.mp4 of the first run.");
  const auto number = [&](const char* name, auto& value, const char* help, const char* unit) {
    command->add_option(name, value, help)->type_name(unit);
  };
  number("--filter", options->filter, "filter to run (default: ekf)", "NAME");
  number("--landmarks", options->landmarks, "number of landmarks (default: 5)", "N");
  number("--steps", options->steps, "number of steps of one second (default: 300)", "N");
  number("--dynamics-noise", options->dynamicsNoise, "noise of a step, metres and radians (default: 0.03)",
         "X");
  number("--observation-noise", options->observationNoise, "noise of observations (default: 0.5)", "METRES");
  command->add_flag("--range-bearing", options->rangeBearing,
                    "observe range and bearing instead of (ahead, left)");
  number("--bearing-noise", options->bearingNoise, "noise of bearings (default: 0.02)", "RADIANS");
  number("--max-range", options->maxRange, "how far the car sees (default: any distance)", "METRES");
  number("--field-of-view", options->fieldOfView,
         "angle that the car sees, around its heading (default: all)", "RADIANS");
  number("--assume-dynamics", options->assumeDynamics, "the filter assumes X times the dynamics noise", "X");
  number("--assume-observation", options->assumeObservation,
         "the filter assumes X times the observation noise", "X");
  number("--particles", options->particles, "number of particles (default: 1000)", "N");
  addSeed(command, options->seed, "seed of landmarks and noise (default: 0)");
  number("--seeds", options->seeds, "number of runs, each with its own seed", "N");
  number("-o,--out", options->out, "folder for the results", "DIR");
  command->add_flag("--no-film", options->noFilm, "do not make filter.mp4");
  command->add_flag("--json", options->json, "print JSON");
  command->callback([&action, options] { action = [options](const Project&) { return filter(*options); }; });
}

}  // namespace rex::cli
