#include "base/error.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/text.h"

namespace rex {

std::string toString(const Diagnostic& diagnostic) {
  const std::string where = toString(diagnostic.where);
  const char* severity = diagnostic.severity == Severity::kWarning ? "warning: " : "note: ";
  return (where.empty() ? "" : where + ": ") + severity + diagnostic.message;
}

namespace {

std::string format(const ErrorParts& parts) {
  std::string text = toString(parts.where);
  if (!text.empty()) text += ": ";
  text += parts.what;
  if (!parts.found.empty()) text += ": found " + parts.found;
  if (!parts.wanted.empty()) text += (parts.found.empty() ? ": wanted " : ", wanted ") + parts.wanted;
  if (!parts.nearest.empty()) {
    text += " (did you mean ";
    for (std::size_t i = 0; i < parts.nearest.size(); ++i) {
      if (i > 0) text += i + 1 == parts.nearest.size() ? " or " : ", ";
      text += "'" + parts.nearest[i] + "'";
    }
    text += "?)";
  }
  return text;
}

// Edits that turn a into b: insert, delete, replace, or swap two neighbours (optimal string alignment).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
    std::swap(beforeLast, last);
    std::swap(last, row);
  }
  return last.back();
}

}  // namespace

std::string toString(const SourceLocation& where) {
  if (where.file.empty()) return "";
  if (where.line <= 0) return where.file;
  if (where.column <= 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

Error::Error(ErrorParts parts) : parts_(std::move(parts)), text_(format(parts_)) {}

std::vector<std::string> nearestNames(std::string_view wanted, const std::vector<std::string>& known) {
  // Longer strings are not mistyped names, and comparing them would take long.
  constexpr std::size_t kLongestName = 256;
  if (wanted.empty() || wanted.size() > kLongestName) return {};
  const std::string target = lowerCase(wanted);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& name : known) {
    if (name.empty() || name.size() > kLongestName) continue;
    const std::string candidate = lowerCase(name);
    const std::size_t distance = editDistance(target, candidate);
    const bool sharesPrefix = std::min(target.size(), candidate.size()) >= 3 &&
                              (candidate.starts_with(target) || target.starts_with(candidate));
    const std::size_t tolerated = std::max<std::size_t>(1, std::max(target.size(), candidate.size()) / 3);
    if (distance <= tolerated || sharesPrefix) ranked.emplace_back(distance, name);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [distance, name] : ranked) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    if (names.size() == 3) break;
  }
  return names;
}

void requireSize(std::string_view what, long found, long wanted) {
  if (found == wanted) return;
  throw Error({.what = std::string(what),
               .found = fmt::format("a vector of size {}", found),
               .wanted = fmt::format("size {}", wanted)});
}

}  // namespace rex
