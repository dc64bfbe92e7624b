#include <algorithm>

#include <fmt/format.h>

#include "authoring/course_site.h"
#include "classroom/platform_time.h"
#include "cli/instructor/class_grades.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/json_internal.h"
#include "cli/terminal.h"
#include "reports/report.h"

namespace rex::cli {

namespace {

std::string percentText(std::int64_t hundredths) { return reports::hundredthsText(hundredths) + " %"; }

std::vector<std::string> rulesOf(const classroom::Course& course) {
  const classroom::TotalRules& total = course.total;
  const bool hasMinima =
      std::ranges::any_of(course.exercises, [](const auto& one) { return one.second.minimum.has_value(); });
  std::vector<std::string> rules;
  if (total.best)
    rules.push_back(
        fmt::format("The best {} exercises without bonus count; bonuses come on top.", *total.best));
  if (total.passPercent)
    rules.push_back(
        fmt::format("To pass, {} of the possible points are needed.", percentText(*total.passPercent)));
  if (total.passExercises)
    rules.push_back(
        fmt::format("To pass, the minimum must be reached in {} of the exercises.", *total.passExercises));
  else if (hasMinima)
    rules.emplace_back("To pass, the minimum of every exercise that has one must be reached.");
  return rules;
}

authoring::SitePlan planOf(const Project& project, const classroom::Course& course) {
  const classroom::PlatformZone zone(course.timeZone);
  const auto shownTime = [&](const std::optional<std::int64_t>& time) {
    return time ? zone.toText(*time) : "";
  };
  authoring::SitePlan plan{.rules = rulesOf(course)};
  if (!course.title.empty()) plan.title = course.title;
  for (const std::string& name : courseExercises(project, course)) {
    const auto rule = course.policy.find(name);
    const classroom::CourseExercise worth = course.exercise(name);
    plan.exercises.push_back({.name = name,
                              .opening = rule == course.policy.end() ? "" : shownTime(rule->second.opening),
                              .deadline = rule == course.policy.end() ? "" : shownTime(rule->second.deadline),
                              .parts = worth.parts,
                              .isBonus = worth.isBonus,
                              .minimum = worth.minimum ? percentText(*worth.minimum) : ""});
  }
  return plan;
}

}  // namespace

ExitCode devSite(const Project& project, const SiteOptions& options) {
  using authoring::SiteReaders;
  requireSourceTree(project, "site");
  const classroom::Course course =
      readClassCourse(project, {.course = options.course}, classroom::RosterUse::kLeave);
  const authoring::CourseSite site =
      authoring::writeCourseSite(project.root, std::filesystem::absolute(options.out),
                                 options.secret.empty() ? course.settings.secret : options.secret,
                                 options.notes ? SiteReaders::kLecturers : SiteReaders::kEverybody,
                                 options.course.empty() ? authoring::SitePlan{} : planOf(project, course));
  const bool leaks = !site.scan.leaks.empty();
  if (options.json) {
    Json list = Json::array();
    for (const authoring::Leak& leak : site.scan.leaks) list.push_back(toString(leak));
    say(dump(Json{{"written", leaks ? Json() : Json(shown(options.out))},
                  {"pages", site.pages},
                  {"replays", site.playing},
                  {"pictures", site.drawn},
                  {"leaks", list}}));
  } else if (leaks) {
    for (const authoring::Leak& leak : site.scan.leaks) note(wrap(escapeForTerminal(toString(leak)), 2, 0));
    note("Nothing was written.");
  } else {
    say(fmt::format("{} pages, {:.1f} MB, nothing leaks: open {}", site.pages,
                    static_cast<double>(site.scan.bytes) / 1e6, shown(options.out / "index.html")));
    if (site.playing < site.demonstrations || site.drawn < site.exercises)
      say(wrap(fmt::format("{} of {} demonstrations play, and {} of {} exercises have a picture. For more: "
                           "rex demo -o out/demonstrations, and rex run NAME --solution",
                           site.playing, site.demonstrations, site.drawn, site.exercises),
               0, 0));
  }
  return leaks ? ExitCode::kBelow : ExitCode::kFull;
}

}  // namespace rex::cli
