#include <algorithm>
#include <cctype>
#include <fstream>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text_file.h"
#include "cli/instructor/dev_verbs.h"
#include "cli/terminal.h"
#include "submission/regions.h"

namespace rex::cli {
namespace {

namespace fs = std::filesystem;

// The functions that share/template/exercise.h declares.
constexpr const char* kFunctions = "rotated";

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

// Copies the template, with the exercise's name in place of the placeholder.
void instantiate(const fs::path& from, const fs::path& to, const std::string& name) {
  constexpr std::string_view kPlaceholder = "@EXERCISE@";
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (!entry.is_regular_file()) continue;
    std::string text = readTextFile(entry.path());
    for (std::size_t at = text.find(kPlaceholder); at != std::string::npos; at = text.find(kPlaceholder, at))
      text.replace(at, kPlaceholder.size(), name);
    writeTextFile(to / entry.path().lexically_relative(from), text);
  }
}

}  // namespace

ExitCode devNew(const Project& project, const std::string& name) {
  requireSourceTree(project, "new");
  requireGoodName(name);
  const fs::path source = project.root / "share" / "template", folder = project.root / "exercises" / name;
  if (fs::exists(folder))
    throw UsageError({.what = "this exercise exists already", .where = {shown(folder)}});
  instantiate(source, folder, name);
  const fs::path solution = folder / "solution.cpp";
  writeTextFile(folder / "main.cpp", submission::stripSolution(readTextFile(solution), shown(solution)));
  std::ofstream(project.root / "exercises" / "CMakeLists.txt", std::ios::app)
      << fmt::format("rex_exercise({} FUNCTIONS {})\n", name, kFunctions);
  say(fmt::format("Made {}, and its line in exercises/CMakeLists.txt, which names the", shown(folder)));
  say("functions that students complete. Now edit solution.cpp there, then:");
  say(fmt::format("  scripts/rex dev strip {}   makes main.cpp from it", name));
  say(fmt::format("  scripts/rex dev check {}   says what is still missing", name));
  return ExitCode::kFull;
}

}  // namespace rex::cli
