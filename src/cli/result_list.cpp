#include "cli/result_list.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/project.h"

namespace rex::cli {

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
