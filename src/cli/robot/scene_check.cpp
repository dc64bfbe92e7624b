#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/results_internal.h"
#include "cli/robot/scene_verbs.h"
#include "cli/terminal.h"
#include "formats/difference.h"

namespace rex::cli {
namespace {

struct Verdict {
  std::string file;
  Diagnostics notes{};
  std::optional<ErrorParts> error{};
};

Verdict judge(const Project& project, const SceneOption& option) {
  Verdict verdict{.file = option.file.string()};
  ReadOptions options = option.reading;
  options.notesOfFailure = &verdict.notes;
  try {
    verdict.file = sceneFilePath(project, option).string();
    SceneFile scene = readScene(verdict.file, options);
    verdict.notes = std::move(scene.notes);
    static_cast<void>(compile(scene.spec));
  } catch (const Error& error) {
    verdict.error = error.parts();
  }
  return verdict;
}

Json message(const char* severity, const SourceLocation& where, const std::string& text) {
  return {{"severity", severity},
          {"file", where.file},
          {"line", where.line},
          {"column", where.column},
          {"text", text}};
}

// " What will differ: motion (2), picture (1); ..." by the number of findings, or nothing.
std::string differences(const Diagnostics& notes) {
  constexpr std::pair<Difference, const char*> kKinds[] = {
      {Difference::kMotion, "motion"}, {Difference::kContact, "contact"}, {Difference::kPicture, "picture"}};
  std::vector<std::string> counts;
  bool isRefused = false;
  for (const auto& [difference, word] : kKinds) {
    const auto count = std::ranges::count(notes, difference, differenceIn);
    if (count == 0) continue;
    counts.push_back(fmt::format("{} ({})", word, count));
    isRefused = isRefused || difference != Difference::kPicture;
  }
  if (counts.empty()) return "";
  return fmt::format(". What will differ: {}{}", join(counts, ", "),
                     isRefused ? "; --strict refuses what differs in motion or contact" : "");
}

Results resultsOf(const Verdict& verdict) {
  Results all{.json = {{"file", verdict.file}, {"ok", !verdict.error}, {"messages", Json::array()}}};
  Json& messages = all.json["messages"];
  int warnings = 0;
  for (const Diagnostic& one : verdict.notes) {
    const bool isWarning = one.severity == Severity::kWarning;
    warnings += isWarning ? 1 : 0;
    messages.push_back(message(isWarning ? "warning" : "note", one.where, one.message));
    all.line("{}", wrap(escapeForTerminal(toString(one)), 2, 0));
  }
  if (verdict.error) {
    ErrorParts parts = *verdict.error;
    all.line("{}", wrap(escapeForTerminal(Error(parts).what()), 2, 0));
    const SourceLocation where = std::exchange(parts.where, {});
    messages.push_back(message("error", where, Error(std::move(parts)).what()));
  } else {
    all.line("{}: loads{}{}", escapeForTerminal(verdict.file),
             warnings == 0 ? "" : fmt::format(", with {} warning{}", warnings, warnings == 1 ? "" : "s"),
             differences(verdict.notes));
  }
  return all;
}

}  // namespace

ExitCode sceneCheck(const Project& project, const SceneOptions& options) {
  const Verdict verdict = judge(project, options.scene);
  requireMeaning(verdict.file, options.scene.reading);
  resultsOf(verdict).print(options.json);
  return verdict.error ? ExitCode::kBelow : ExitCode::kFull;
}

}  // namespace rex::cli
