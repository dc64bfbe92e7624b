#include "authoring/seen_messages.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "base/text_file.h"

namespace rex::authoring {
namespace {

constexpr std::string_view kIndent = "    ";

std::string withoutNumbers(const std::string& text) {
  static const std::regex number(R"([-+]?(\d+(\.\d+)?(e[-+]?\d+)?|nan|inf)\b)");
  return std::regex_replace(text, number, "#");
}

}  // namespace

std::filesystem::path seenMessagesFile(const std::filesystem::path& exercise) {
  return exercise / "seen.txt";
}

std::string seenMessage(const grading::GradeResult& result, const std::vector<std::string>& ids) {
  for (const grading::Group group : {grading::Group::kVisible, grading::Group::kHidden})
    for (const grading::CheckResult& check : result.checks)
      if (check.group == group && check.status != grading::Outcome::kPass &&
          std::find(ids.begin(), ids.end(), check.id) != ids.end())
        return fmt::format("{}{}: {}", check.id, group == grading::Group::kHidden ? " (hidden)" : "",
                           check.message);
  for (const grading::CompileDiagnostic& one : result.compile.diagnostics)
    if (one.severity == "error") return toString(one);
  return result.message;
}

SeenMessages readSeenMessages(const std::filesystem::path& file) {
  SeenMessages messages;
  std::string name;
  int number = 0;
  const std::string text = readTextFile(file);
  for (const std::string_view line : splitLines(text)) {
    ++number;
    if (!line.starts_with(kIndent)) {
      name = line;
    } else if (name.empty()) {
      throw Error(
          {.what = "a message without the name of a wrong variant", .where = {file.string(), number}});
    } else {
      messages[name] = line.substr(kIndent.size());
    }
  }
  return messages;
}

void writeSeenMessages(const SeenMessages& messages, const std::filesystem::path& file) {
  std::string text;
  for (const auto& [name, message] : messages) text += fmt::format("{}\n{}{}\n", name, kIndent, message);
  writeTextFile(file, text);
}

std::vector<std::string> changedMessages(const SeenMessages& now, const SeenMessages& stored) {
  std::vector<std::string> changes;
  for (const auto& [name, message] : now) {
    const auto before = stored.find(name);
    if (before == stored.end())
      changes.push_back(fmt::format("{}: seen.txt does not say what a student reads: {}", name, message));
    else if (withoutNumbers(before->second) != withoutNumbers(message))
      changes.push_back(
          fmt::format("{}: a student reads: {}\n  seen.txt says: {}", name, message, before->second));
  }
  for (const auto& [name, message] : stored)
    if (!now.contains(name))
      changes.push_back(fmt::format("{}: is in seen.txt, but there is no such variant", name));
  if (!changes.empty())
    changes.emplace_back("If the new words are better, store them with REX_UPDATE_GOLDEN=1.");
  return changes;
}

std::vector<std::string> messagesThatExplainNothing(const SeenMessages& messages) {
  // As Check prints them: a value along a motion has its place, and what is wanted may be a limit.
  static const std::regex alike(R"(\bgot (.+?)(?: at [^,]*)?, wanted (?:at most |at least )?\1(?:,| \())");
  std::vector<std::string> complaints;
  for (const auto& [name, message] : messages)
    if (std::regex_search(message, alike))
      complaints.push_back(fmt::format("{}: got and wanted are printed alike: {}", name, message));
  return complaints;
}

}  // namespace rex::authoring
