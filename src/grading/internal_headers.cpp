#include "grading/internal_headers.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace rex::grading {
namespace {

constexpr std::string_view kEnding = "_internal.h";

// The names after the last slash, each once.
std::set<std::string> namesIn(std::string_view dependencies) {
  std::set<std::string> names;
  for (std::size_t at = dependencies.find(kEnding); at != dependencies.npos;
       at = dependencies.find(kEnding, at + 1)) {
    const std::size_t end = at + kEnding.size();
    const std::size_t begin = dependencies.substr(0, at).find_last_of("/ \n") + 1;
    names.emplace(dependencies.substr(begin, end - begin));
  }
  return names;
}

int lineOf(std::string_view name, std::string_view source) {
  const std::size_t at = source.find(name);
  if (at == source.npos) return 0;
  return 1 +
         static_cast<int>(std::count(source.begin(), source.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace

std::vector<CompileDiagnostic> internalHeaders(std::string_view dependencies, std::string_view source,
                                               const std::string& mainFile,
                                               const std::vector<ForbiddenFunction>& forbidden) {
  const auto rule = std::find_if(forbidden.begin(), forbidden.end(), [](const ForbiddenFunction& one) {
    return one.function == "rex::internal";
  });
  std::vector<CompileDiagnostic> messages;
  if (rule == forbidden.end()) return messages;
  for (const std::string& name : namesIn(dependencies)) {
    const int line = lineOf(name, source);
    messages.push_back({mainFile, line, line > 0 ? 1 : 0, "error", "forbidden-call",
                        fmt::format("includes {}: {}", name, rule->reason)});
  }
  return messages;
}

}  // namespace rex::grading
