#include "submission/made_from.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"

namespace rex::submission {

namespace fs = std::filesystem;

namespace {

std::string timeStamp(const fs::path& file, fs::file_time_type changed) {
  return fmt::format("{} {}", changed.time_since_epoch().count(), file.string());
}

}  // namespace

fs::path recordFile(const fs::path& kept) { return kept.string() + ".made-from"; }

std::string timeStamps(const std::vector<fs::path>& files, fs::file_time_type started) {
  std::string stamps;
  for (const fs::path& one : files) {
    std::error_code missing;
    const auto changed = fs::last_write_time(one, missing);
    if (missing || changed > started) return "";
    stamps += timeStamp(one, changed) + "\n";
  }
  return stamps;
}

bool haveStamps(std::string_view stamps) {
  const std::vector<std::string_view> lines = splitLines(stamps);
  return !lines.empty() && std::ranges::all_of(lines, [](std::string_view line) {
    const fs::path file = line.substr(line.find(' ') + 1);
    std::error_code missing;
    const auto changed = fs::last_write_time(file, missing);
    return !missing && timeStamp(file, changed) == line;
  });
}

}  // namespace rex::submission
