#include "submission/symbol_scan.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <map>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "submission/mentions.h"

namespace rex::grading {
namespace {

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

// They find functions by name or by place while a program runs.
constexpr auto kLookups =
    std::to_array<const char*>({"dlsym", "dlvsym", "dlopen", "dlmopen", "dladdr", "dladdr1", "dlinfo",
                                "dl_iterate_phdr", "_dl_sym", "__libc_dlsym", "__libc_dlopen_mode"});

bool isLookup(std::string_view function) {
  return std::find(kLookups.begin(), kLookups.end(), function) != kLookups.end();
}

// Whether a demangled symbol is main() or something inside it, a lambda above all, or is made for such a
// thing: "std::function<...>::call<main::{lambda()#1}>".
bool isOfMain(std::string_view symbol) {
  if (symbol == "main" || symbol.starts_with("main.")) return true;
  for (std::size_t at = symbol.find("main::"); at != symbol.npos; at = symbol.find("main::", at + 1))
    if (at == 0 || (!isWord(symbol[at - 1]) && symbol[at - 1] != ':')) return true;
  return false;
}

bool isCode(std::string_view section) { return section.starts_with(".text"); }

// Which places of an object file are main's. Students choose the sections of their functions and the names of
// their symbols, but not which symbols a section has.
class Places {
 public:
  // Takes a line "000000000000000e g     F .text.main\t00000000000001d7 main" of the table of symbols.
  void add(std::string_view line) {
    const std::size_t tab = line.find('\t');
    constexpr std::size_t kDigits = 16, kFlags = kDigits + 1, kSection = kFlags + 8;
    if (tab == line.npos || tab < kSection || line.size() < tab + kDigits + 2) return;
    std::string_view name = line.substr(tab + kDigits + 2);
    const bool isSectionOrFile = line[kFlags + 5] == 'd' || line[kFlags + 6] == 'f';
    if (isSectionOrFile || name == "$x" || name == "$d") return;
    if (name.starts_with(".hidden ")) name.remove_prefix(8);
    const std::size_t start = hex(line), size = std::max<std::size_t>(hex(line.substr(tab + 1)), 1);
    symbols_[line.substr(kSection, tab - kSection)].push_back({start, start + size, isOfMain(name)});
  }

  // Whether main() or something inside it lies there: code in a section of its own, data under its own name.
  bool areMains(std::string_view section, std::size_t offset) const {
    const auto found = symbols_.find(section);
    if (found == symbols_.end()) return false;
    bool is = false;
    for (const Symbol& symbol : found->second) {
      if (!isCode(section) && (offset < symbol.start || offset >= symbol.end)) continue;
      if (!symbol.isOfMain) return false;
      is = true;
    }
    return is;
  }
  bool holdsCodeOfMain(std::string_view section) const {
    const auto found = symbols_.find(section);
    return isCode(section) && found != symbols_.end() &&
           std::any_of(found->second.begin(), found->second.end(),
                       [](const Symbol& s) { return s.isOfMain; });
  }

  static std::size_t hex(std::string_view digits) {
    std::size_t value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
  }

 private:
  struct Symbol {
    std::size_t start, end;
    bool isOfMain;
  };
  std::map<std::string_view, std::vector<Symbol>> symbols_;
};

// Tables for switches, for exceptions and for debuggers point into all code, but nobody calls through them.
bool isTableOfCompiler(std::string_view section) {
  for (const char* start : {".rodata", ".eh_frame", ".gcc_except_table", ".debug"})
    if (section.starts_with(start)) return true;
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

std::vector<ForbiddenFunction> forbiddenCalls(std::string_view listing,
                                              const std::vector<ForbiddenFunction>& forbidden) {
  // "RELOCATION RECORDS FOR [.text._Z4stepv]:" opens the references of one section, behind all symbols.
  constexpr std::string_view kSectionLine = "RELOCATION RECORDS FOR [";
  enum Caller { kMain, kOther };
  std::vector<std::array<bool, 2>> called(forbidden.size());
  std::set<std::string_view> lookups;
  bool mainIsCalled = false;
  Places places;
  std::string_view section;
  while (!listing.empty()) {
    const std::size_t end = std::min(listing.find('\n'), listing.size());
    const std::string_view line = listing.substr(0, end);
    listing.remove_prefix(std::min(end + 1, listing.size()));
    if (line.starts_with(kSectionLine))
      section = line.substr(kSectionLine.size(), line.rfind(']') - kSectionLine.size());
    else if (section.empty())
      places.add(line);
    const std::string_view name = referredTo(line);
    if (section.empty() || name.empty()) continue;
    const bool isMains = places.areMains(section, Places::hex(line));
    const Caller caller = isMains && isCode(section) ? kMain : kOther;
    for (std::size_t i = 0; i < forbidden.size(); ++i)
      if (isFunction(name, forbidden[i].function)) called[i][caller] = true;
    if (isLookup(name)) lookups.insert(name);
    if (!isMains && !isTableOfCompiler(section))
      mainIsCalled = mainIsCalled || isOfMain(name) || places.holdsCodeOfMain(name);
  }
  std::vector<ForbiddenFunction> found;
  for (std::size_t i = 0; i < forbidden.size(); ++i)
    if (called[i][kOther] || (mainIsCalled && called[i][kMain])) found.push_back(forbidden[i]);
  for (const std::string_view name : lookups)
    found.push_back({std::string(name), "it finds functions while the program runs"});
  return found;
}

std::vector<CompileDiagnostic> scanSymbols(const std::string& objdump, const std::filesystem::path& object,
                                           std::string_view source, const std::string& mainFile,
                                           const std::vector<ForbiddenFunction>& forbidden,
                                           const BuildTools& tools) {
  if (forbidden.empty()) return {};
  const ProcessResult listed = tools.run({objdump, "-t", "-r", "-C", "--", object.string()}, 256u << 20);
  if (!listed.ok())
    throw Error({.what = "cannot list what the compiled file refers to", .found = listed.error});
  std::vector<CompileDiagnostic> messages;
  for (const ForbiddenFunction& call : forbiddenCalls(listed.output, forbidden)) {
    const auto [line, column] = onlyMentionOf(call.function, source);
    const char* text = isLookup(call.function) ? "calls {}, which nobody may call in this exercise: {}"
                                               : "calls {}, which only main() may call in this exercise: {}. "
                                                 "Write it yourself instead";
    messages.push_back({mainFile, line, column, "error", "forbidden-call",
                        fmt::format(fmt::runtime(text), call.function, call.reason)});
  }
  return messages;
}

}  // namespace rex::grading
