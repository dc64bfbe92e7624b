#include "submission/student_files.h"

#include <algorithm>
#include <array>

#include "base/text_file.h"
#include "submission/cpp_text.h"

namespace rex::submission {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> namesIncludedBy(const std::string& source) {
  const CppText text(source);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!text.startsDirective(i) || text.at(i + 1) != "include" || !text.isKind(i + 2, TokenKind::kText))
      continue;
    const std::string_view quoted = text.at(i + 2);
    if (quoted.size() > 2) names.emplace_back(quoted.substr(1, quoted.size() - 2));
  }
  return names;
}

bool isInFolder(const fs::path& folder, const std::string& name) {
  const fs::path inside = fs::path(name).lexically_normal();
  return inside.is_relative() && !inside.empty() && *inside.begin() != ".." &&
         fs::is_regular_file(fs::symlink_status(folder / inside));
}

// What only lecturers get, and all source: that is handed out if it is included.
bool isNoData(const fs::path& name) {
  constexpr std::array kSource = {".cpp", ".h", ".hpp", ".cc", ".hh", ".cxx", ".inl", ".ipp"};
  const std::string ending = name.extension().string();
  return isForLecturers(name) || std::find(kSource.begin(), kSource.end(), ending) != kSource.end();
}

}  // namespace

bool isForLecturers(const fs::path& name) {
  constexpr std::array kNames = {"solution.cpp", "wrong.cpp", "seen.txt", "equal_mutants.tsv"};
  return std::find(kNames.begin(), kNames.end(), name.filename()) != kNames.end();
}

std::vector<std::string> filesIncludedFrom(const fs::path& folder, std::vector<std::string> names) {
  std::erase_if(names, [&](const std::string& name) { return !isInFolder(folder, name); });
  for (std::size_t k = 0; k < names.size(); ++k)
    for (const std::string& written : namesIncludedBy(readTextFile(folder / names[k]))) {
      const std::string name = fs::path(written).lexically_normal().generic_string();
      const bool isNew = std::find(names.begin(), names.end(), name) == names.end();
      if (isNew && isInFolder(folder, name)) names.push_back(name);
    }
  return names;
}

std::vector<fs::path> studentFiles(const fs::path& exercise) {
  const std::vector<std::string> sources =
      filesIncludedFrom(exercise, {"main.cpp", "starter.cpp", "show.cpp", "exercise.h"});
  std::vector<fs::path> found(sources.begin(), sources.end());
  for (const char* name : {"README.md", "exercise.toml"})
    if (fs::exists(exercise / name)) found.emplace_back(name);
  std::string text;
  for (const fs::path& name : found) text += readTextFile(exercise / name);
  for (const auto& entry : fs::recursive_directory_iterator(exercise)) {
    const fs::path name = entry.path().lexically_relative(exercise);
    if (entry.is_regular_file() && !isNoData(name) &&
        std::find(found.begin(), found.end(), name) == found.end() &&
        text.find(name.generic_string()) != text.npos)
      found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace rex::submission
