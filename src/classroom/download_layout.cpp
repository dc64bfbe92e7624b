#include "classroom/download_layout.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "base/opened_folder.h"
#include "base/printable.h"
#include "classroom/archive.h"
#include "classroom/download.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMoodleMark = "_assignsubmission_";

bool isExerciseName(const std::vector<ExerciseInfo>& exercises, const std::string& name) {
  try {
    return !findExercise(exercises, name).name.empty();
  } catch (const Error&) {
    return false;
  }
}

std::string wantedBy(Platform platform) {
  switch (platform) {
    case Platform::kMoodle:
      return "the zip of \"Download all submissions\", with folders such as 'Zoe "
             "Miller_501_assignsubmission_file_'";
    case Platform::kGit:
      return "a folder of clones, such as 'kinematics-zoe/.git'";
    case Platform::kGradescope:
      return fmt::format("the zip of \"Export Submissions\", with '{}'", kGradescopeMetadata);
    case Platform::kFolders:
      return "'NAME/main.cpp', 'NAME.cpp' or 'NAME.zip' for each student";
  }
  return {};
}

// The names of a folder, four levels deep, without what repositories hold.
void collectNames(const OpenedFolder& folder, const std::string& prefix, int depth,
                  std::vector<std::string>& names) {
  constexpr int kDeep = 4;
  constexpr std::size_t kMost = 20'000;
  for (const OpenedFolder::Entry& entry : folder.entries()) {
    if (names.size() >= kMost) return;
    if (entry.name == ".git")
      names.push_back(prefix + ".git/HEAD");
    else if (entry.type == fs::file_type::directory && depth < kDeep)
      collectNames(folder.folder(entry.name), prefix + entry.name + "/", depth + 1, names);
    else
      names.push_back(prefix + entry.name);
  }
}

std::string describe(const std::vector<std::string>& names) {
  std::set<std::string> tops;
  for (const std::string& name : names) tops.insert(name.substr(0, name.find('/')));
  if (tops.empty()) return "nothing";
  if (tops.size() == 1)
    return fmt::format("{} file{} such as '{}'", names.size(), names.size() == 1 ? "" : "s",
                       printable(names.front(), 120));
  return fmt::format("{} entries such as '{}'", tops.size(), printable(*tops.begin(), 120));
}

UsageError refusal(const fs::path& path, Platform wanted, const Layout& found) {
  std::string advice = wantedBy(wanted);
  if (found.platform && *found.platform != wanted)
    advice += fmt::format("; `rex import {}` takes what is there", toString(*found.platform));
  if (found.isReady) advice += "; `rex grade` takes what is there as it is";
  return UsageError({.what = fmt::format("nothing that `rex import {}` knows", toString(wanted)),
                     .where = {path.string()},
                     .found = found.found,
                     .wanted = std::move(advice)});
}

}  // namespace

std::string_view toString(Platform platform) {
  constexpr std::string_view kNames[] = {"moodle", "git", "gradescope", "folders"};
  return kNames[static_cast<int>(platform)];
}

Layout layoutOf(const std::vector<std::string>& names, const std::vector<ExerciseInfo>& exercises) {
  Layout layout;
  std::vector<std::string> real;
  for (const std::string& name : names)
    if (!isOfSystem(name)) real.push_back(name);
  layout.found = describe(real);
  bool isFlat = false, isClass = false;
  for (const std::string& name : real) {
    const fs::path path(name);
    const std::vector<std::string> parts(path.begin(), path.end());
    const auto has = [&](const std::string& part) {
      return std::find(parts.begin(), parts.end(), part) != parts.end();
    };
    if (path.filename() == kGradescopeMetadata) layout.platform = Platform::kGradescope;
    if (layout.platform) continue;
    if (std::any_of(parts.begin(), parts.end(), [](const auto& part) { return parseMoodleName(part); }))
      layout.platform = Platform::kMoodle;
    else if (parts.size() > 2 && has(".git"))
      layout.platform = Platform::kGit;
    const bool isInExercise = parts.size() > 1 && isExerciseName(exercises, parts[parts.size() - 2]);
    isClass = isClass || (parts.size() == 3 && parts[2] == "main.cpp" && isInExercise);
    isFlat = isFlat || ((isSourceName(name) || isArchiveName(name)) && (parts.size() > 3 || !isInExercise));
  }
  layout.isReady = !layout.platform && isClass;
  if (!layout.platform && isFlat && !isClass) layout.platform = Platform::kFolders;
  return layout;
}

Layout layoutOfFolder(const fs::path& folder, const std::vector<ExerciseInfo>& exercises) {
  std::vector<std::string> names;
  collectNames(OpenedFolder(folder), "", 1, names);
  return layoutOf(names, exercises);
}

void requireLayout(Platform platform, const fs::path& folder, const std::vector<ExerciseInfo>& exercises) {
  if (const Layout layout = layoutOfFolder(folder, exercises); layout.platform != platform)
    throw refusal(folder, platform, layout);
}

Download readDownloadOf(Platform platform, const fs::path& path, const std::vector<ExerciseInfo>& exercises) {
  if (fs::is_directory(path)) {
    requireLayout(platform, path, exercises);
    return readDownload(path);
  }
  Download download = readDownload(path);
  std::vector<std::string> names;
  for (const DownloadedFile& file : download.files) names.push_back(file.name);
  if (const Layout layout = layoutOf(names, exercises); layout.platform != platform)
    throw refusal(path, platform, layout);
  return download;
}

std::optional<MoodleName> parseMoodleName(const std::string& name) {
  const std::size_t mark = name.find(kMoodleMark);
  if (mark == name.npos || mark == 0) return {};
  const std::size_t number = name.rfind('_', mark - 1);
  if (number == name.npos || number + 1 == mark) return {};
  const std::string digits = name.substr(number + 1, mark - number - 1);
  if (digits.find_first_not_of("0123456789") != digits.npos) return {};
  const std::string rest = name.substr(mark + std::string_view(kMoodleMark).size());
  const std::size_t kind = rest.find('_');
  if (kind == rest.npos) return {};
  return MoodleName{.person = name.substr(0, number),
                    .number = digits,
                    .kind = rest.substr(0, kind),
                    .file = rest.substr(kind + 1)};
}

}  // namespace rex::grading
