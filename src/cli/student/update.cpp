#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/error.h"
#include "cli/command_table.h"
#include "cli/student/course_folder.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

std::string describe(const HandedOut& one) {
  using enum HandedOut::Change;
  const std::string file = one.file.generic_string();
  switch (one.change) {
    case kNew:
      return "new        " + file;
    case kReplaced:
      return "changed    " + file;
    case kKeptBeside:
      return fmt::format("changed    {}; the one before is {}", file, one.kept.filename().string());
    case kOwnChange:
      return fmt::format(
          "yours      {} is not as it was handed out; it stays, and without it this command "
          "brings the original",
          file);
    case kNotTouched:
      return fmt::format("not yours  {} is handed out differently now; yours stays as it is", file);
    case kRemoved:
      return fmt::format("removed    {}: it belongs to the checks, which are no longer handed out", file);
    case kNoLongerPart:
      return fmt::format("left       {} is no longer part of the course; it stays", file);
  }
  return file;
}

ExitCode update(const Project& project) {
  requireInstalled(project, "update");
  if (!fs::exists(project.root / kCourseFile))
    throw UsageError({.what = "there is no course folder here",
                      .where = {project.root.string()},
                      .wanted = "a folder that `rex init` made, or one in it"});
  const auto changes = handOut(project.installed, project.root);
  for (const HandedOut& one : changes) say(describe(one));
  if (changes.empty()) say("Everything is as rex " REX_VERSION " hands it out.");
  prepareTools(project);
  return ExitCode::kFull;
}

}  // namespace

void addUpdate(CLI::App* command, Action& action) {
  command->footer(
      "Example: rex update\n\n"
      "Brings exercises and texts of the installed version. It never changes a main.cpp. If you\n"
      "changed another file that is new now, or if it is a header with a contract, the one before\n"
      "is kept beside the new one. Headers of checks that earlier versions handed out are removed,\n"
      "unless you changed them.");
  command->callback([&action] { action = update; });
}

}  // namespace rex::cli
