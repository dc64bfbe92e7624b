#include "grading/precompiled_prefix.h"

#include <algorithm>
#include <system_error>

#include "grading/text_file.h"

namespace rex::grading {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlanks = " \t\r";

// The name in `#include "name"` or `#include <name>`; empty for any other line.
std::string_view includedName(std::string_view line) {
  constexpr std::string_view kInclude = "#include";
  if (!line.starts_with(kInclude)) return {};
  line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks, kInclude.size())));
  if (line.empty() || (line.front() != '"' && line.front() != '<')) return {};
  const std::size_t end = line.find(line.front() == '"' ? '"' : '>', 1);
  return end == line.npos ? std::string_view{} : line.substr(1, end - 1);
}

// The files that a rule of make, as g++ writes it, names behind the colon. A blank in a name stands behind a
// backslash.
std::vector<std::string> prerequisites(const std::string& rule) {
  std::vector<std::string> files(1);
  for (std::size_t i = rule.find(": "); i < rule.size(); ++i) {
    const bool escaped = rule[i] == '\\' && i + 1 < rule.size();
    if (escaped && rule[i + 1] != '\n')
      files.back() += rule[++i];
    else if (escaped || rule[i] == ' ' || rule[i] == '\n')
      files.emplace_back();
    else
      files.back() += rule[i];
  }
  std::erase(files, "");
  std::erase(files, ":");
  return files;
}

bool isCurrent(const fs::path& precompiled, const fs::path& rule) {
  std::error_code missing;
  const auto made = fs::last_write_time(precompiled, missing);
  if (missing || !fs::exists(rule)) return false;
  const std::vector<std::string> files = prerequisites(readTextFile(rule));
  return !files.empty() && std::all_of(files.begin(), files.end(), [&](const std::string& file) {
    const auto changed = fs::last_write_time(file, missing);
    return !missing && changed <= made;
  });
}

}  // namespace

bool opensWithExerciseHeader(std::string_view source) {
  while (!source.empty()) {
    const std::size_t end = std::min(source.find('\n'), source.size());
    std::string_view line = source.substr(0, end);
    source.remove_prefix(std::min(end + 1, source.size()));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of(kBlanks)));
    // A line that ends in a backslash goes on in the next.
    if (line.find('\\') != line.npos) return false;
    if (line.empty() || line.starts_with("//")) continue;
    const std::string_view name = includedName(line);
    if (name == "exercise.h") return true;
    if (name.empty() || name.starts_with('/') || name.find("..") != name.npos || name.ends_with(".cpp"))
      return false;
  }
  return false;
}

std::vector<std::string> prefixFlags(const fs::path& prefix, std::string_view source) {
  if (prefix.empty() || !opensWithExerciseHeader(source)) return {};
  if (!isCurrent(prefix.string() + ".gch", prefix.string() + ".d")) return {};
  return {"-include", prefix.string()};
}

}  // namespace rex::grading
