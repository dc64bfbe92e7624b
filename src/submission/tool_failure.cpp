#include "submission/tool_failure.h"

#include <algorithm>
#include <array>
#include <csignal>

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

// The driver and collect2 have the last word. Only the assembler can be made to end with any words, by a
// source with an error, but then it first announces that there are messages.
bool wasKilled(const ProcessResult& run) {
  if (run.timedOut) return false;
  if (run.signal == SIGKILL || run.exitCode == 128 + SIGKILL) return true;
  const std::vector<std::string_view> lines = splitLines(run.error);
  if (lines.size() < 2 || lines.back() != kDriversEnd || contains(run.error, "Assembler messages:"))
    return false;
  const std::string_view said = lines[lines.size() - 2];
  return contains(said, ": fatal error: Killed signal terminated program ") ||
         (said.starts_with("collect2: fatal error: ") &&
          said.ends_with(" terminated with signal 9 [Killed]"));
}

std::optional<std::string> fullDiskIn(const std::vector<CompileDiagnostic>& messages) {
  constexpr auto kOwnWords = std::to_array<const char*>(
      {"error writing to ", "error closing ", "cannot open ", "when writing output to ",
       "opening dependency file ", "closing dependency file "});
  std::optional<std::string> found;
  for (const CompileDiagnostic& message : messages) {
    const std::string& text = message.message;
    const auto starts = [&](const char* words) { return text.starts_with(words); };
    const auto ends = [&](const char* full) { return text.ends_with(full); };
    const bool isFull = std::any_of(kOwnWords.begin(), kOwnWords.end(), starts) &&
                        std::any_of(kFull.begin(), kFull.end(), ends);
    if (isFull) found = text;
    if (!isFull && message.severity == "error") return {};
  }
  return found;
}

// "student.o: in function `f':" introduces a line that explains it. Some lines start with the linker's name.
std::string complaintAbout(std::string_view object, std::string_view linkerText) {
  const std::string start = fmt::format("{}:", object), named = "ld: " + start;
  bool leads = false;
  for (const std::string_view line : splitLines(linkerText)) {
    if (tellsOfFullDisk(line)) return {};
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
