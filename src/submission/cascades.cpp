#include "submission/cascades.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "submission/file_pieces.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

// What the functions of each name mention in their bodies.
using Uses = std::map<std::string, Names, std::less<>>;

// The word before the first parenthesis of a piece: for a definition its name, be it static, inline or a
// template.
Uses usesIn(std::string_view source) {
  const CppText text(source);
  Uses uses;
  for (const FilePiece& piece : filePieces(text)) {
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

bool hasFailed(const CheckResult& check) {
  return check.group == Group::kVisible && check.status && *check.status != Outcome::kPass &&
         !check.function.empty();
}

}  // namespace

void explainCascades(std::vector<CheckResult>& checks, std::string_view source) {
  const Uses uses = usesIn(source);
  std::map<std::string, Names> reached;
  std::map<std::string, std::string> failed;  // functions, with the check
  for (CheckResult& check : checks) {
    if (!hasFailed(check)) continue;
    const auto [used, isNew] = reached.try_emplace(check.function);
    if (isNew) used->second = reachedFrom(check.function, uses);
    const auto cause = std::find_if(failed.begin(), failed.end(), [&](const auto& one) {
      return one.first != check.function && used->second.contains(one.first);
    });
    if (cause != failed.end())
      check.message +=
          fmt::format("{} {} uses {}, which fails above [{}].", check.message.ends_with(')') ? "." : "",
                      check.function, cause->first, cause->second);
    failed.try_emplace(check.function, check.id);
  }
}

}  // namespace rex::grading
