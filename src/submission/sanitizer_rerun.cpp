#include "submission/sanitizer_rerun.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "base/text_file.h"
#include "grading/limits.h"

namespace rex::submission {
namespace {

// The options are part of the program because its environment is empty. The library that it calls is built
// without the sanitizers, so reports about containers that both use are no findings. Memory that a killed
// program leaves behind is not a leak.
constexpr const char* kOptionsHeader = R"(
extern "C" __attribute__((no_sanitize("address", "undefined"))) const char* __asan_default_options() {
  return "abort_on_error=1:handle_abort=1:detect_leaks=0:detect_container_overflow=0:detect_odr_violation=0:"
         "print_legend=0:hard_rss_limit_mb=" REX_MEMORY_MEGABYTES REX_ASKING;
}
extern "C" __attribute__((no_sanitize("address", "undefined"))) const char* __ubsan_default_options() {
  return "print_stacktrace=1";
}
)";

// The report itself takes some time, so the kernel's limit has to be far away.
constexpr const char* kTimeHeader = R"(
#include <csignal>
#include <cstdlib>
#include <sys/time.h>
namespace {
__attribute__((constructor)) void abortWhenTimeIsUp() {
  std::signal(SIGPROF, [](int) { std::abort(); });
  const itimerval time{{}, {REX_MICROSECONDS / 1000000, REX_MICROSECONDS % 1000000}};
  setitimer(ITIMER_PROF, &time, nullptr);
}
}
)";

// An assertion of Eigen that fails prints the two sides of its first comparison: sizes, or an index. The
// operator <= binds as tightly as any that an assertion begins with.
constexpr const char* kAssertionHeader = R"(
#include <cstdio>
#include <cstdlib>
#include <type_traits>
namespace rex_assertion {
struct Sides {
  double left = 0, right = 0;
  bool known = false;
  explicit operator bool() const { return false; }
};
template <class T>
struct Left {
  const T& value;
  explicit operator bool() const { return false; }
  template <class U>
  Sides with(const U& right) const {
    if constexpr (std::is_arithmetic_v<T> && std::is_arithmetic_v<U>)
      return {static_cast<double>(value), static_cast<double>(right), true};
    return {};
  }
  template <class U> Sides operator==(const U& right) const { return with(right); }
  template <class U> Sides operator!=(const U& right) const { return with(right); }
  template <class U> Sides operator<(const U& right) const { return with(right); }
  template <class U> Sides operator<=(const U& right) const { return with(right); }
  template <class U> Sides operator>(const U& right) const { return with(right); }
  template <class U> Sides operator>=(const U& right) const { return with(right); }
};
struct First {
  template <class T> Left<T> operator<=(const T& value) const { return {value}; }
};
template <class T> Sides operator&&(const Sides& sides, const T&) { return sides; }
inline Sides sidesOf(const Sides& sides) { return sides; }
template <class T> Sides sidesOf(const T&) { return {}; }
[[noreturn]] inline void fail(const char* condition, const Sides& sides) {
  if (sides.known) std::fprintf(stderr, "rex: the sides are %.10g and %.10g\n", sides.left, sides.right);
  std::fprintf(stderr, "Assertion `%s' failed.\n", condition);
  std::abort();
}
}
#define eigen_assert(x) \
  ((x) ? void() : ::rex_assertion::fail(#x, ::rex_assertion::sidesOf(::rex_assertion::First() <= x)))
)";

constexpr const char* kSanitizers = "-fsanitize=address,undefined";
constexpr std::string_view kStackOverflow = "stack-overflow";
constexpr const char* kAsked = "asked for more: does a loop never end, or is a size wrong?";

std::string plainWords(std::string_view kind) {
  constexpr std::pair<std::string_view, const char*> kWords[] = {
      {"heap-buffer-overflow", "reads or writes outside an array on the heap"},
      {"stack-buffer-overflow", "reads or writes outside a local array"},
      {"dynamic-stack-buffer-overflow", "reads or writes outside a local array"},
      {"stack-buffer-underflow", "reads or writes before a local array"},
      {"global-buffer-overflow", "reads or writes outside a global array"},
      {"heap-use-after-free", "uses memory after freeing it"},
      {"stack-use-after-return", "uses a local variable after its function has ended"},
      {"stack-use-after-scope", "uses a local variable after its block has ended"},
      {kStackOverflow, "uses up the stack: infinite recursion?"},
      {"attempting double-free", "frees memory twice"},
      {"attempting free", "frees memory that was not allocated"},
      {"SEGV", "uses an invalid address: a null pointer, or an index far out of range?"},
      {"FPE", "divides an integer by zero"},
      {"specified RSS limit", kAsked},
      {"requested allocation size", kAsked},
      {"ABRT", "aborts"},
  };
  for (const auto& [name, words] : kWords)
    if (kind.starts_with(name)) return words;
  return std::string(kind.substr(0, kind.find(' ')));
}

// What a line reports, and the source line that it names; the finding is empty if it reports nothing.
CrashSite findingIn(std::string_view line, const std::string& mainFile) {
  constexpr std::string_view kAddress = "ERROR: AddressSanitizer: ", kUndefined = ": runtime error: ";
  if (const std::size_t at = line.find(kAddress); at != line.npos)
    return {.finding = plainWords(line.substr(at + kAddress.size()))};
  const std::size_t at = line.find(kUndefined);
  if (at == line.npos) return {};
  CrashSite site{.finding = std::string(line.substr(at + kUndefined.size()))};
  const std::string name = mainFile + ":";
  const std::size_t own = line.substr(0, at).rfind(name);
  if (own == line.npos || (own != 0 && line[own - 1] != '/')) return site;
  std::string_view number = line.substr(own + name.size());
  site.line = takeNumber<int>(number).value_or(0);
  return site;
}

struct Frame {
  std::string function;
  int line = 0;
};

// Reads "    #2 0x55d0 in ikStep(int) /folder/main.cpp:47:3" if it is about the student's file.
std::optional<Frame> frameIn(std::string_view line, const std::string& mainFile) {
  const std::size_t name = line.find(" in "), file = line.rfind("/" + mainFile + ":");
  if (line.find(" #") == line.npos || name == line.npos || file == line.npos) return {};
  std::string_view number = line.substr(file + mainFile.size() + 2);
  const int row = takeNumber<int>(number).value_or(0);
  if (row == 0) return {};
  const std::string_view function = line.substr(name + 4);
  return Frame{std::string(function.substr(0, function.find_first_of("( "))), row};
}

// The line of a recursion in which the stack ends is a matter of chance. A line that occurs twice on the
// stack makes the recursive call; of several, the first in the file counts; without any, the innermost line.
const Frame& recursionIn(const std::vector<Frame>& stack) {
  std::set<int> seen;
  const Frame* found = nullptr;
  for (const Frame& frame : stack)
    if (!seen.insert(frame.line).second && (found == nullptr || frame.line < found->line)) found = &frame;
  return found != nullptr ? *found : stack.front();
}

Toolchain withReports(const Toolchain& toolchain, const std::filesystem::path& folder, std::size_t memory,
                      const std::string& code) {
  const std::filesystem::path header = folder / "sanitizer_options.h";
  // As a header of the system: Eigen's assertions warn in the words of our macro.
  writeTextFile(header, fmt::format("#pragma GCC system_header\n#define REX_MEMORY_MEGABYTES \"{}\"\n",
                                    memory / grading::kMegabyte) +
                            code);
  Toolchain changed = toolchain;
  changed.prefix.clear();
  for (const std::string& flag :
       std::vector<std::string>{"-g1", "-fno-omit-frame-pointer", "-include", header})
    changed.flags.push_back(flag);
  changed.linkFlags.emplace_back(kSanitizers);
  return changed;
}

}  // namespace

std::optional<CrashSite> crashSiteIn(std::string_view standardError, const std::string& mainFile) {
  constexpr std::string_view kSides = "rex: the sides are ";
  CrashSite site;
  std::vector<Frame> stack;  // innermost first
  std::string sides;
  for (const std::string_view line : splitLines(standardError)) {
    if (line.starts_with(kSides)) sides = line.substr(kSides.size());
    if (site.finding.empty()) {
      site = findingIn(line, mainFile);
    } else if (auto frame = frameIn(line, mainFile)) {
      stack.push_back(std::move(*frame));
    }
  }
  if (site.finding.empty()) return {};
  site.sides = sides;
  if (stack.empty()) return site;
  const Frame& frame = site.finding == plainWords(kStackOverflow) ? recursionIn(stack) : stack.front();
  site.function = frame.function;
  if (site.line == 0) site.line = frame.line;
  return site;
}

Toolchain sanitizedToolchain(const Toolchain& toolchain, const std::filesystem::path& folder,
                             std::size_t memory) {
  Toolchain sanitized = withReports(toolchain, folder, memory,
                                    std::string("#define REX_ASKING\n") + kOptionsHeader + kAssertionHeader);
  // What is left out would test each use of a pointer, of which the address sanitizer finds those that
  // matter; compiling takes a fifth less time without.
  for (const char* flag :
       {"-O0", kSanitizers, "-fno-sanitize=vptr,null,alignment,object-size,pointer-overflow",
        "-fno-sanitize-recover=all"})
    sanitized.flags.emplace_back(flag);
  // Eigen allocates differently under the address sanitizer, but memory that passes between the program and
  // the library must be freed the way it was allocated.
  const auto isSanitizer = [](const std::string& flag) { return flag.starts_with("-fsanitize="); };
  if (std::none_of(toolchain.flags.begin(), toolchain.flags.end(), isSanitizer))
    sanitized.flags.emplace_back("-DEIGEN_MALLOC_ALREADY_ALIGNED=1");
  return sanitized;
}

// Only the sanitizer's runtime is there, for its report. It measures the memory ten times a second, so what
// ends a program without a report is farther away.
Toolchain locatingToolchain(const Toolchain& toolchain, const std::filesystem::path& folder,
                            std::size_t memory, double seconds) {
  const std::string limits = fmt::format(
      "#define REX_MICROSECONDS {0:.0f}\n"
      "#define REX_ASKING \":soft_rss_limit_mb={1}:max_allocation_size_mb={1}\"\n",
      1e6 * seconds, memory / 2 / grading::kMegabyte);
  return withReports(toolchain, folder, memory, limits + kOptionsHeader + kTimeHeader);
}

}  // namespace rex::submission
