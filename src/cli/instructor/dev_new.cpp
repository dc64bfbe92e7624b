#include <algorithm>
#include <cctype>
#include <fstream>

#include <fmt/format.h>

#include "authoring/new_exercise.h"
#include "base/error.h"
#include "base/text_file.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/terminal.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

void requireGoodName(const std::string& name) {
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const std::size_t dash = name.find('-');
  const bool good = name.size() <= 40 && (dash == 2 || (dash == 3 && letter(name[2]))) &&
                    dash + 1 < name.size() && digit(name[0]) && digit(name[1]) && letter(name[dash + 1]) &&
                    std::all_of(name.begin() + static_cast<std::ptrdiff_t>(dash) + 1, name.end(),
                                [&](char c) { return digit(c) || letter(c); });
  if (!good)
    throw UsageError(
        {.what = "not a name for an exercise",
         .found = "'" + name + "'",
         .wanted = "two digits (and a letter), a dash, then letters and digits, like 01-kinematics"});
}

}  // namespace

ExitCode devNew(const Project& project, const std::string& name, const fs::path& header) {
  requireSourceTree(project, "new");
  requireGoodName(name);
  const fs::path folder = project.root / "exercises" / name;
  if (fs::exists(folder))
    throw UsageError({.what = "this exercise exists already", .where = {shown(folder)}});
  const authoring::ExerciseFiles files =
      header.empty() ? authoring::templateExercise(project.root, name)
                     : authoring::exerciseFor(readTextFile(header), header.string(), name);
  for (const auto& [file, text] : files) writeTextFile(folder / file, text);
  std::ofstream(project.root / "exercises" / "CMakeLists.txt", std::ios::app)
      << authoring::buildLine(files, name);
  say(fmt::format("Made {}, and its line in exercises/CMakeLists.txt, which names the", shown(folder)));
  say("functions that students complete. Now edit solution.cpp and check.cpp there, then:");
  say(fmt::format("  scripts/rex dev strip {}   makes main.cpp from solution.cpp", name));
  say(fmt::format("  scripts/rex dev check {}   says what is still missing", name));
  return ExitCode::kFull;
}

}  // namespace rex::cli
