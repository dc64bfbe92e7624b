#include "cli/student/check_order.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "submission/cpp_text.h"
#include "submission/graded_source.h"

namespace rex::cli {
namespace {

using grading::CheckResult;

std::map<std::string, std::string> functionsIn(const std::string& source) {
  const submission::CppText text(source);
  std::map<std::string, std::string> functions;
  for (const submission::CppPiece& piece : submission::cppPieces(text))
    if (!piece.function.empty())
      functions[std::string(piece.function)] += source.substr(piece.start, piece.end - piece.start);
  return functions;
}

std::set<std::string> changedFunctions(const SavedFile& file) {
  std::set<std::string> changed;
  if (file.before.empty() || file.before == file.now) return changed;
  const std::map<std::string, std::string> before = functionsIn(file.before);
  for (const auto& [name, text] : functionsIn(file.now))
    if (const auto was = before.find(name); was == before.end() || was->second != text) changed.insert(name);
  return changed;
}

}  // namespace

CheckOrder checkOrder(const std::vector<CheckResult>& listed, const SavedFile& file) {
  enum Rank { kBlamed, kOfPart, kFailed, kPassed, kSlow };
  const std::set<std::string> changed = changedFunctions(file);
  std::map<std::string, const CheckResult*> last;
  std::set<std::string> parts;
  for (const CheckResult& check : file.last) {
    last[check.id] = &check;
    if (changed.contains(check.function)) parts.insert(check.part);
  }
  const auto rankOf = [&](const CheckResult& check) {
    const auto found = last.find(check.id);
    if (found == last.end()) return kFailed;
    const CheckResult& was = *found->second;
    if (changed.contains(was.function)) return kBlamed;
    if (parts.contains(was.part)) return kOfPart;
    if (was.cpuSeconds >= kSlowCheck) return kSlow;
    return was.status == grading::Outcome::kPass ? kPassed : kFailed;
  };
  std::multimap<Rank, std::string> ranked;  // keeps the order of equals
  for (const CheckResult& check : listed) ranked.emplace(rankOf(check), check.id);
  CheckOrder order;
  for (const auto& [rank, id] : ranked) {
    order.ids.push_back(id);
    if (rank <= kOfPart) ++order.changed;
  }
  return order;
}

}  // namespace rex::cli
