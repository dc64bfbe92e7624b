#include "submission/tool_failure.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/lines.h"

namespace rex::grading {
namespace {

constexpr const char* kDriversEnd = "compilation terminated.";
constexpr auto kFull = std::to_array<const char*>({"No space left on device", "Disk quota exceeded"});

bool contains(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

bool tellsOfFullDisk(std::string_view line) {
  return std::any_of(kFull.begin(), kFull.end(), [&](const char* full) { return contains(line, full); });
}

// Whether a line is no help to a reader: an array of messages, perhaps empty, or one that introduces others.
bool tellsNothing(std::string_view line) {
  return line.empty() || line.starts_with('[') || line == kDriversEnd ||
         line.ends_with("Assembler messages:");
}

}  // namespace

// "student.o: in function `f':" introduces a line that explains it. Some lines start with the linker's name.
std::string complaintAbout(std::string_view object, std::string_view linkerText) {
  const std::string start = fmt::format("{}:", object), named = "ld: " + start;
  bool leads = false;
  for (const std::string_view line : splitLines(linkerText)) {
    if (contains(line, ": warning: ")) continue;
    if (leads) return std::string(line);
    const bool isAbout = line.starts_with(start) || contains(line, named);
    leads = isAbout && line.ends_with(':');
    if (isAbout && !leads) return std::string(line);
  }
  // The linker may then complain about other files, from which addresses are too far away.
  for (const char* words : {"relocation truncated to fit", "failed to convert GOTPCREL relocation"})
    if (contains(linkerText, words)) return "its global variables take more than 2 GB";
  return {};
}

bool blamesObject(std::string_view linkerText, std::string_view object) {
  return contains(linkerText, "undefined reference to `") ||
         contains(linkerText, "multiple definition of `") || !complaintAbout(object, linkerText).empty();
}

std::string lastWordsOf(const ProcessResult& run) {
  std::string found;
  for (const std::string_view line : splitLines(run.error)) {
    if (tellsNothing(line)) continue;
    if (tellsOfFullDisk(line)) return std::string(line);
    if (found.empty()) found = line;
  }
  if (!found.empty()) return found;
  return run.signal != 0 ? fmt::format("signal {}", run.signal) : fmt::format("exit code {}", run.exitCode);
}

}  // namespace rex::grading
