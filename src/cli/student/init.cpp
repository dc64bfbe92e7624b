#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/command_table.h"
#include "cli/student/course_folder.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void requireEmpty(const fs::path& folder) {
  std::error_code failed;
  if (fs::exists(folder / kCourseFile, failed))
    throw UsageError({.what = fmt::format("{} is a course folder already", shown(folder)),
                      .wanted = "`rex update` in it, which brings what is new"});
  if (fs::exists(folder, failed) && !(fs::is_directory(folder, failed) && fs::is_empty(folder, failed)))
    throw UsageError(
        {.what = "will not overwrite", .where = {shown(folder)}, .wanted = "an empty or new folder"});
}

ExitCode init(const Project& project, const fs::path& folder) {
  requireInstalled(project, "init");
  const fs::path place = fs::absolute(folder).lexically_normal();
  requireEmpty(place);
  const auto files = handOut(project.installed, place);
  const Project course{.root = fs::canonical(place), .build = project.build, .installed = project.installed};
  prepareTools(course);
  const std::vector<ExerciseInfo> exercises = course.exercises();
  say(fmt::format("{} has {} exercise{}, in {} files.", shown(place), exercises.size(),
                  exercises.size() == 1 ? "" : "s", files.size()));
  if (exercises.empty()) return ExitCode::kFull;
  const std::string first = exercises.front().name;
  say();
  say(fmt::format("  cd {}", shown(place)));
  say(fmt::format("  rex run {:<24} # draws what main.cpp shows, into out/{}", first, first));
  say(fmt::format("  rex test {:<23} # grades it", first));
  say();
  say(wrap(fmt::format("Read exercises/{}/README.md, then edit main.cpp beside it.", first), 0, 0));
  return ExitCode::kFull;
}

}  // namespace

void addInit(CLI::App* command, Action& action) {
  const auto folder = std::make_shared<fs::path>();
  command->footer(
      "Example: rex init course\n\n"
      "The folder gets the exercises, a README and settings for editors. `rex` then works\n"
      "in it and in all folders below it. Results go to out/.");
  command->add_option("FOLDER", *folder, "the new course folder")->type_name("")->required();
  command->callback([&action, folder] { action = [folder](const Project& p) { return init(p, *folder); }; });
}

}  // namespace rex::cli
