#include "submission/cascades.h"

#include <algorithm>
#include <map>
#include <string>

#include <fmt/format.h>

#include "submission/file_pieces.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

// The word before the first parenthesis: for a definition its name, be it static, inline or a template.
std::string nameOf(std::string_view definition) {
  const std::size_t end = std::min(definition.find('('), definition.size());
  std::size_t start = end;
  while (start > 0 && isWord(definition[start - 1])) --start;
  return std::string(definition.substr(start, end - start));
}

// What each function of the file names, itself and through the functions that it names.
std::map<std::string, Names> usesIn(std::string_view source) {
  std::map<std::string, Names> uses;
  const std::string code = codeOf(source);
  for (const FilePiece& piece : filePieces(source)) {
    const std::string_view text = std::string_view(code).substr(piece.start, piece.end - piece.start);
    if (const std::size_t body = text.find('{'); body != text.npos)
      uses[nameOf(text.substr(0, body))].merge(namesIn(text.substr(body)));
  }
  for (bool isNew = true; isNew;) {
    isNew = false;
    for (auto& [function, names] : uses) {
      const Names own = names;
      for (const std::string& name : own)
        if (const auto used = uses.find(name); used != uses.end() && name != function)
          names.insert(used->second.begin(), used->second.end());
      isNew = isNew || names.size() > own.size();
    }
  }
  return uses;
}

bool hasFailed(const CheckResult& check) {
  return check.group == Group::kVisible && check.status && *check.status != Outcome::kPass &&
         !check.function.empty();
}

}  // namespace

void explainCascades(std::vector<CheckResult>& checks, std::string_view source) {
  const std::map<std::string, Names> uses = usesIn(source);
  std::map<std::string, std::string> failed;  // functions, with the check
  for (CheckResult& check : checks) {
    if (!hasFailed(check)) continue;
    const auto used = uses.find(check.function);
    const auto cause = std::find_if(failed.begin(), failed.end(), [&](const auto& one) {
      return used != uses.end() && one.first != check.function && used->second.contains(one.first);
    });
    if (cause != failed.end())
      check.message +=
          fmt::format("{} {} uses {}, which fails above [{}].", check.message.ends_with(')') ? "." : "",
                      check.function, cause->first, cause->second);
    failed.try_emplace(check.function, check.id);
  }
}

}  // namespace rex::grading
