#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/json_internal.h"
#include "cli/robot/scene_verbs.h"
#include "cli/terminal.h"

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
    verdict.file = fileOf(project, option).string();
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

void sayJson(const Verdict& verdict) {
  Json messages = Json::array();
  for (const Diagnostic& one : verdict.notes)
    messages.push_back(
        message(one.severity == Severity::kWarning ? "warning" : "note", one.where, one.message));
  if (verdict.error) {
    ErrorParts parts = *verdict.error;
    const SourceLocation where = std::exchange(parts.where, {});
    messages.push_back(message("error", where, Error(std::move(parts)).what()));
  }
  say(dump(Json{{"file", verdict.file}, {"ok", !verdict.error}, {"messages", messages}}));
}

void sayText(const Verdict& verdict) {
  for (const Diagnostic& one : verdict.notes) say(wrap(escapeForTerminal(toString(one)), 2, 0));
  if (verdict.error) {
    say(wrap(escapeForTerminal(Error(*verdict.error).what()), 2, 0));
    return;
  }
  const auto warnings = std::count_if(verdict.notes.begin(), verdict.notes.end(), [](const Diagnostic& one) {
    return one.severity == Severity::kWarning;
  });
  say(fmt::format(
      "{}: loads{}", escapeForTerminal(verdict.file),
      warnings == 0 ? "" : fmt::format(", with {} warning{}", warnings, warnings == 1 ? "" : "s")));
}

}  // namespace

ExitCode sceneCheck(const Project& project, const SceneOptions& options) {
  const Verdict verdict = judge(project, options.scene);
  requireMeaning(verdict.file, options.scene.reading);
  options.json ? sayJson(verdict) : sayText(verdict);
  return verdict.error ? ExitCode::kBelow : ExitCode::kFull;
}

}  // namespace rex::cli
