#include "cli/out_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "base/error.h"
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
               .found = fmt::format("'{}'", harmless(chosen == nullptr ? "/tmp" : chosen)),
               .wanted = "a folder"});
}

}  // namespace rex::cli
