#include "cli/out_folder.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
#include "cli/project.h"
#include "cli/terminal.h"

namespace rex::cli {

void makeOutFolder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem)
    throw Error({.what = "cannot make the folder for results",
                 .where = {folder.string()},
                 .found = problem.message()});
}

void makeOutPlace(const std::filesystem::path& out) {
  const std::filesystem::path target = std::filesystem::absolute(out);
  makeOutFolder(target.parent_path());
  const std::string what = fmt::format("cannot write '{}'", out.string());
  std::error_code ignored;
  const bool isFolder = std::filesystem::is_directory(target, ignored);
  if (isFolder && target.has_extension()) throw Error({.what = what, .found = "a folder of that name"});
  std::filesystem::path trial = isFolder ? target / "" : target;
  trial += fmt::format(".trial-{}", ::getpid());
  if (!std::ofstream(trial)) throw Error({.what = what, .found = std::strerror(errno)});
  std::filesystem::remove(trial, ignored);
}

std::filesystem::path temporaryFolder() {
  std::error_code problem;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(problem);
  if (!problem) return folder;
  const char* chosen = std::getenv("TMPDIR");
  throw Error({.what = "TMPDIR, where temporary files go",
               .found = fmt::format("'{}'", escapeForTerminal(chosen == nullptr ? "/tmp" : chosen)),
               .wanted = "a folder"});
}

namespace fs = std::filesystem;

std::vector<fs::path> filesIn(const fs::path& folder, std::string_view ending) {
  std::vector<fs::path> files;
  std::error_code missing;
  for (const auto& entry : fs::recursive_directory_iterator(folder, missing)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file() && !name.starts_with('.') &&
        (ending.empty() || entry.path().extension() == ending))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> shortList(const std::vector<fs::path>& files) {
  constexpr std::size_t kListed = 6;
  std::map<std::pair<fs::path, fs::path>, std::vector<fs::path>> kinds;
  for (const fs::path& file : files) kinds[{file.parent_path(), file.extension()}].push_back(file);
  std::vector<std::string> lines;
  for (const auto& [kind, alike] : kinds) {
    if (alike.size() > kListed)
      lines.push_back(fmt::format("{} ... {} ({} files)", shown(alike.front()),
                                  alike.back().filename().string(), alike.size()));
    else
      for (const fs::path& file : alike) lines.push_back(shown(file));
  }
  return lines;
}

}  // namespace rex::cli
