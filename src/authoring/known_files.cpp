#include "authoring/known_files.h"

#include <fmt/format.h>

#include "base/error.h"
#include "base/process.h"

namespace rex::grading {
namespace {

// The names that `git ls-files` prints, each ended by a zero byte.
std::set<std::string> listed(const std::filesystem::path& root, std::vector<std::string> options) {
  // The user need not own the files, and a git hook points its children to another repository.
  std::vector<std::string> command = {"git",
                                      "-c",
                                      "safe.directory=*",
                                      "-C",
                                      root.string(),
                                      "--git-dir=" + (root / ".git").string(),
                                      "--work-tree=" + root.string(),
                                      "ls-files",
                                      "-z"};
  command.insert(command.end(), options.begin(), options.end());
  const ProcessResult run = runProcess(command, {.outputLimit = 64 << 20});
  if (!run.ok())
    throw Error({.what = "cannot ask git which files belong to the course",
                 .where = {root.string()},
                 .found = run.started ? run.error.substr(0, run.error.find('\n')) : "no git program",
                 .wanted = "git, or a folder without .git"});
  std::set<std::string> names;
  for (std::size_t at = 0, end = 0; (end = run.output.find('\0', at)) != std::string::npos; at = end + 1)
    names.insert(run.output.substr(at, end - at));
  return names;
}

}  // namespace

std::optional<std::set<std::string>> knownFiles(const std::filesystem::path& root,
                                                const std::vector<std::string>& places) {
  if (!std::filesystem::exists(root / ".git")) return std::nullopt;
  std::vector<std::string> others = {"--others", "--exclude-standard", "--"};
  others.insert(others.end(), places.begin(), places.end());
  const std::set<std::string> unknown = listed(root, others);
  if (!unknown.empty())
    throw Error(
        {.what = unknown.size() == 1
                     ? "a file that git does not know would reach students"
                     : fmt::format("{} files that git does not know would reach students, this one first",
                                   unknown.size()),
         .where = {*unknown.begin()},
         .wanted = "git add, a line in .gitignore, or another folder"});
  return listed(root, {});
}

}  // namespace rex::grading
