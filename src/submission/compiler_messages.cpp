#include "submission/compiler_messages.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/escape.h"
#include "base/text.h"
#include "submission/cpp_names.h"
#include "submission/graded_source.h"

namespace rex::submission {
namespace {

using Json = nlohmann::json;

// One line, plain quotes.
std::string tidy(std::string_view text) {
  constexpr std::string_view kOpening = "\u2018", kClosing = "\u2019";
  std::string plain;
  while (!text.empty()) {
    const bool isQuote = text.starts_with(kOpening) || text.starts_with(kClosing);
    plain += isQuote ? '\'' : text.front() == '\n' ? ' ' : text.front();
    text.remove_prefix(isQuote ? kOpening.size() : 1);
  }
  return plain;
}

// The end of the JSON array that begins a text, after its bracket; npos if it is not closed.
std::size_t arrayEnd(std::string_view text) {
  int depth = 0;
  bool isQuoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') isQuoted = !isQuoted;
    if (isQuoted) {
      at += c == '\\' ? 1 : 0;
      continue;
    }
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    if (depth == 0) return at + 1;
  }
  return text.npos;
}

// The arrays in a text, which begin with their lines and end before the line with which the next one begins.
std::vector<std::string_view> arraysIn(std::string_view text) {
  std::vector<std::string_view> arrays;
  for (std::size_t at = text.starts_with('[') ? 0 : text.find("\n["); at != text.npos;) {
    if (text[at] == '\n') ++at;
    const std::size_t next = text.find("\n[", at);
    const std::string_view array = text.substr(at, next - at);
    if (const std::size_t end = arrayEnd(array); end != array.npos) arrays.push_back(array.substr(0, end));
    at = next;
  }
  return arrays;
}

// What could have been called: "; there is 'void Robot::move(const Pose&, double)', which takes 2 arguments".
std::string candidateText(const Json& children) {
  constexpr std::string_view kCandidate = "candidate: ", kExpects = "candidate expects ";
  constexpr std::size_t kLongest = 200;  // templates fill the screen
  std::string text;
  for (const Json& child : children) {
    const std::string note = tidy(child.at("message").get<std::string>());
    const std::size_t expects = note.find(kExpects);
    if (note.starts_with(kCandidate) && !text.empty()) return text + ", and others";
    if (note.starts_with(kCandidate) && note.size() <= kLongest)
      text = "; there is " + note.substr(kCandidate.size());
    if (expects != note.npos && !text.empty())
      text += ", which takes " +
              note.substr(expects + kExpects.size(), note.find(',', expects) - expects - kExpects.size());
  }
  return text;
}

grading::CompileDiagnostic readMessage(const Json& json) {
  grading::CompileDiagnostic message;
  const std::string kind = json.at("kind").get<std::string>();
  message.severity = kind == "warning" ? "warning" : "error";
  message.rule = json.value("option", "");
  message.message = tidy(json.at("message").get<std::string>());
  if (message.message.starts_with("no matching function") && json.contains("children"))
    message.message += candidateText(json["children"]);
  const Json& locations = json.at("locations");
  if (!locations.empty()) {
    const Json& caret = locations.at(0).at("caret");
    message.file = caret.at("file").get<std::string>();
    message.line = caret.at("line").get<int>();
    message.column = caret.at("column").get<int>();
  }
  return message;
}

// The line and column after "main.cpp:" in a line that names an origin; {0, 0} for any other line.
std::pair<int, int> originIn(std::string_view line, const std::string& mainFile) {
  std::size_t place = line.npos;  // of the name
  if (line.starts_with(mainFile + ":") && line.find("required from") != line.npos) place = 0;
  const std::size_t included = line.find("from " + mainFile + ":"),
                    inlined = line.find(" at " + mainFile + ":");
  if (included != line.npos) place = included + 5;
  if (inlined != line.npos && line.find("inlined from") != line.npos) place = inlined + 4;
  if (place == line.npos) return {0, 0};
  std::string_view rest = line.substr(place + mainFile.size() + 1);
  const int row = takeNumber<int>(rest).value_or(0);
  if (!rest.starts_with(':')) return {row, 0};
  rest.remove_prefix(1);
  return {row, takeNumber<int>(rest).value_or(0)};
}

// GCC spells a part of a matrix as an expression that fills the screen.
void shortenNames(grading::CompileDiagnostic& message) {
  const std::size_t end = std::min(message.message.find("' is used uninitialized"),
                                   message.message.find("' may be used uninitialized"));
  if (end == std::string::npos || message.message.find("<unnamed>") > end) return;
  message.message.replace(
      0, end + 1, "a part of a matrix that was never set, or is gone (a temporary that 'auto' refers to?),");
}

// The part of a header's path that a student knows: after the last include folder.
std::string headerName(const std::string& file) {
  constexpr std::string_view kStandard = "/include/c++/";
  if (const std::size_t at = file.rfind(kStandard); at != std::string::npos)  // "/include/c++/12/vector"
    return file.substr(std::min(file.find('/', at + kStandard.size()), file.size() - 1) + 1);
  for (const std::string_view folder : {"/eigen3/", "/src/", "/include/"}) {
    const std::size_t at = file.rfind(folder);
    if (at != std::string::npos) return file.substr(at + folder.size());
  }
  return file.substr(file.rfind('/') + 1);
}

}  // namespace

bool namesErrors(std::string_view standardError) {
  constexpr auto kSigns = std::to_array<std::string_view>(
      {"\"kind\": \"error\"", "\"kind\": \"fatal error\"", ": Error: ", ": Fatal error: "});
  return std::any_of(kSigns.begin(), kSigns.end(),
                     [&](std::string_view sign) { return standardError.find(sign) != standardError.npos; });
}

// An array is on one line or, from g++ 14 on, on several; the driver adds lines of plain text.
std::vector<grading::CompileDiagnostic> parseCompilerJson(std::string_view standardError) {
  std::vector<grading::CompileDiagnostic> messages;
  for (const std::string_view text : arraysIn(standardError)) {
    const Json array = Json::parse(text, nullptr, false);
    if (!array.is_array()) continue;
    try {
      for (const Json& entry : array)
        if (entry.at("kind") != "note") messages.push_back(readMessage(entry));
    } catch (const Json::exception&) {
      continue;
    }
  }
  return messages;
}

std::vector<grading::CompileDiagnostic> parseCompilerText(std::string_view standardError) {
  std::vector<grading::CompileDiagnostic> messages;
  for (const std::string_view line : splitLines(standardError)) {
    const std::size_t label = std::min(line.find(": error: "), line.find(": fatal error: "));
    if (label == line.npos || label == 0) continue;
    const std::size_t column = line.rfind(':', label - 1);
    const std::size_t row = column == line.npos || column == 0 ? line.npos : line.rfind(':', column - 1);
    if (row == line.npos) continue;
    grading::CompileDiagnostic message{.file = std::string(line.substr(0, row)), .severity = "error"};
    message.line = parseNumber<int>(line.substr(row + 1, column - row - 1)).value_or(0);
    message.column = parseNumber<int>(line.substr(column + 1, label - column - 1)).value_or(0);
    message.message = tidy(line.substr(line.find("error: ", label) + 7));
    messages.push_back(std::move(message));
  }
  return messages;
}

// Errors for which the assembler knows no line of the source name a line of a temporary file that is gone.
std::vector<grading::CompileDiagnostic> parseAssemblerText(std::string_view standardError) {
  std::vector<grading::CompileDiagnostic> messages;
  for (const std::string_view line : splitLines(standardError)) {
    const std::size_t label = std::min(line.find(": Error: "), line.find(": Fatal error: "));
    const std::size_t row = label == line.npos || label == 0 ? line.npos : line.rfind(':', label - 1);
    if (row == line.npos) continue;
    grading::CompileDiagnostic message{.file = std::string(line.substr(0, row)), .severity = "error"};
    message.line = parseNumber<int>(line.substr(row + 1, label - row - 1)).value_or(0);
    message.message = tidy(line.substr(line.find("rror: ", label) + 6));
    if (message.line == 0) continue;
    if (message.file.ends_with(".s")) message.file.clear(), message.line = 0;
    messages.push_back(std::move(message));
  }
  return messages;
}

void blameMainFile(std::vector<grading::CompileDiagnostic>& messages, const std::string& mainFile,
                   std::string_view plainText) {
  const std::vector<std::string_view> lines = splitLines(plainText);
  for (grading::CompileDiagnostic& message : messages) {
    shortenNames(message);
    if (message.file == mainFile) continue;
    const std::string start = toString(SourceLocation{message.file, message.line, message.column}) + ": ";
    auto at = std::find_if(lines.begin(), lines.end(), [&](auto line) { return line.starts_with(start); });
    std::pair<int, int> origin{0, 0};
    while (origin.first == 0 && at != lines.end() && at != lines.begin()) origin = originIn(*--at, mainFile);
    if (!message.file.empty())
      message.message += fmt::format(" (in {}:{})", headerName(message.file), message.line);
    message.file = mainFile;
    message.line = origin.first;
    message.column = origin.second;
  }
  // GCC finds something inside of a library which no line of the student's can change.
  std::erase_if(messages, [](const auto& one) { return one.severity == "warning" && one.line == 0; });
}

bool admitMessages(std::vector<grading::CompileDiagnostic>& messages) {
  constexpr std::size_t kLongest = 2000;
  const bool tooMany = messages.size() > kMostMessages;
  if (tooMany) messages.resize(kMostMessages);
  for (grading::CompileDiagnostic& message : messages)
    for (std::string* text : {&message.file, &message.rule, &message.message})
      *text = tidy(printable(*text, kLongest));
  return tooMany;
}

std::vector<grading::CompileDiagnostic> parseLinkerText(std::string_view standardError,
                                                        const std::string& mainFile) {
  struct Phrase {
    std::string_view text, explanation;
  };
  constexpr Phrase kPhrases[] = {
      {"undefined reference to `", "is declared but not defined here"},
      {"multiple definition of `", "is defined, but the exercise already defines it"}};
  std::vector<grading::CompileDiagnostic> messages;
  std::set<std::string> seen;
  for (const std::string_view line : splitLines(standardError)) {
    for (const Phrase& phrase : kPhrases) {
      const std::size_t at = line.find(phrase.text);
      if (at == line.npos) continue;
      const std::string_view rest = line.substr(at + phrase.text.size());
      // The name alone: argument types of Eigen fill the screen.
      const std::string symbol(rest.substr(0, rest.find_first_of("(\'")));
      if (seen.insert(symbol).second)
        messages.push_back({mainFile, 0, 0, "error", "", fmt::format("'{}' {}", symbol, phrase.explanation)});
    }
  }
  return messages;
}

namespace {

// What the functions of each name mention in their bodies.
using Uses = std::map<std::string, Names, std::less<>>;

// The word before the first parenthesis of a piece: for a definition its name, be it static, inline or a
// template.
Uses usesIn(std::string_view source) {
  const CppText text(source);
  Uses uses;
  for (const CppPiece& piece : cppPieces(text)) {
    std::size_t name = piece.last, body = piece.first;
    for (; body < piece.last && !text.isSign(body, '{'); ++body)
      if (name == piece.last && text.isSign(body, '(') && body > piece.first) name = body - 1;
    if (body < piece.last && name < body && text.isName(name))
      uses[std::string(text.at(name))].merge(namesIn(text, body, piece.last));
  }
  return uses;
}

// All that a function mentions, itself and through the functions that it mentions.
Names reachedFrom(const std::string& function, const Uses& uses) {
  Names reached;
  std::vector<std::string> open = {function};
  std::set<std::string> visited = {function};
  while (!open.empty()) {
    const auto next = uses.find(open.back());
    open.pop_back();
    if (next == uses.end()) continue;
    for (const std::string& name : next->second) {
      reached.insert(name);
      if (visited.insert(name).second) open.push_back(name);
    }
  }
  return reached;
}

bool hasFailed(const grading::CheckResult& check) {
  return check.group == grading::Group::kVisible && check.status &&
         *check.status != grading::Outcome::kPass && !check.function.empty();
}

// A question would guess at what is known: that of a function which is wrong itself.
std::string withoutQuestion(const std::string& message) {
  if (!message.ends_with('?')) return message;
  for (std::size_t at = message.rfind(". "); at != message.npos && at > 0; at = message.rfind(". ", at - 1))
    if (at + 2 < message.size() && message[at + 2] >= 'A' && message[at + 2] <= 'Z')
      return message.substr(0, at + 1);
  return message;
}

std::string asSentence(const std::string& text) {
  const bool isEnded =
      text.ends_with('.') || text.ends_with('?') || text.ends_with(".)") || text.ends_with("?)");
  return isEnded ? text : text + ".";
}

}  // namespace

void explainCascades(std::vector<grading::CheckResult>& checks, std::string_view source) {
  const Uses uses = usesIn(source);
  std::map<std::string, Names> reached;
  std::map<std::string, std::string> failed;  // functions, with the check
  for (grading::CheckResult& check : checks) {
    if (!hasFailed(check)) continue;
    const auto [used, isNew] = reached.try_emplace(check.function);
    if (isNew) used->second = reachedFrom(check.function, uses);
    const auto cause = std::find_if(failed.begin(), failed.end(), [&](const auto& one) {
      return one.first != check.function && used->second.contains(one.first);
    });
    if (cause != failed.end())
      check.message =
          asSentence(withoutQuestion(check.message)) +
          fmt::format(" {} uses {}, which fails above [{}].", check.function, cause->first, cause->second);
    failed.try_emplace(check.function, check.id);
  }
}

}  // namespace rex::submission
