#include "grading/symbol_scan.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "base/error.h"
#include "grading/mentions.h"

namespace rex::grading {
namespace {

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Whether a demangled symbol is the function or, for a class, one of its members: its name outside template
// and call arguments, which may mention anything.
bool isFunction(std::string_view symbol, std::string_view function) {
  int depth = 0;
  for (std::size_t i = 0; i < symbol.size(); ++i) {
    const char c = symbol[i];
    if (c == '(' && depth == 0 && !symbol.substr(i).starts_with("(anonymous namespace)")) return false;
    if (c == '<' || c == '(') ++depth;
    if (c == '>' || c == ')') --depth;
    const bool starts = depth == 0 && (i == 0 || (!isWord(symbol[i - 1]) && symbol[i - 1] != ':'));
    if (!starts || !symbol.substr(i).starts_with(function)) continue;
    const std::size_t end = i + function.size();
    if (end == symbol.size() || !isWord(symbol[end])) return true;
  }
  return false;
}

// "RELOCATION RECORDS FOR [.text._Z4stepv]:" opens the references of one section.
constexpr std::string_view kSectionLine = "RELOCATION RECORDS FOR [";

// Whether such a line is about the code of main() or of a function inside it, a lambda above all.
bool isMainSection(std::string_view line) {
  line.remove_prefix(kSectionLine.size());
  // "Z4mainE" in a mangled name says "inside main()", unless it is part of a longer name, behind its length.
  for (std::size_t at = line.find("Z4mainE"); at != line.npos; at = line.find("Z4mainE", at + 1)) {
    if (std::isdigit(static_cast<unsigned char>(line[at - 1])) == 0) return true;
  }
  for (const std::string_view section : {".text.main]", ".text.startup.main]", ".text.unlikely.main]"}) {
    if (line.starts_with(section)) return true;
  }
  return false;
}

// The demangled name in a line "0000000000000005 R_X86_64_PLT32    name-0x0000000000000004".
std::string_view referredTo(std::string_view line) {
  for (int column = 0; column < 2; ++column) {
    const std::size_t blank = line.find(' ');
    if (blank == line.npos) return {};
    line.remove_prefix(std::min(line.find_first_not_of(' ', blank), line.size()));
  }
  const std::size_t addend = line.find_last_of("+-");
  return addend != line.npos && line.substr(addend + 1).starts_with("0x") ? line.substr(0, addend) : line;
}

}  // namespace

std::vector<ForbiddenFunction> forbiddenCalls(std::string_view relocations,
                                              const std::vector<ForbiddenFunction>& forbidden) {
  std::vector<bool> called(forbidden.size());
  bool inMain = false;
  while (!relocations.empty()) {
    const std::size_t end = std::min(relocations.find('\n'), relocations.size());
    const std::string_view line = relocations.substr(0, end);
    relocations.remove_prefix(std::min(end + 1, relocations.size()));
    if (line.starts_with(kSectionLine)) inMain = isMainSection(line);
    if (inMain) continue;
    const std::string_view name = referredTo(line);
    for (std::size_t i = 0; i < forbidden.size(); ++i) {
      if (isFunction(name, forbidden[i].function)) called[i] = true;
    }
  }
  std::vector<ForbiddenFunction> found;
  for (std::size_t i = 0; i < forbidden.size(); ++i) {
    if (called[i]) found.push_back(forbidden[i]);
  }
  return found;
}

std::vector<CompileDiagnostic> scanSymbols(const std::string& objdump, const std::filesystem::path& object,
                                           std::string_view source, const std::string& mainFile,
                                           const std::vector<ForbiddenFunction>& forbidden,
                                           const BuildTools& tools) {
  if (forbidden.empty()) return {};
  const ProcessResult listed = tools.run({objdump, "-r", "-C", "--", object.string()}, 256u << 20);
  if (!listed.ok())
    throw Error({.what = "cannot list what the compiled file refers to", .found = listed.error});
  std::vector<CompileDiagnostic> messages;
  for (const ForbiddenFunction& call : forbiddenCalls(listed.output, forbidden)) {
    const auto [line, column] = onlyMentionOf(call.function, source);
    messages.push_back({mainFile, line, column, "error", "forbidden-call",
                        fmt::format("calls {}, which only main() may call in this exercise: {}. Write it "
                                    "yourself instead",
                                    call.function, call.reason)});
  }
  return messages;
}

}  // namespace rex::grading
