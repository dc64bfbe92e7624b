// Files up to the size limit that are made to be slow, for each function that reads a student's text or what
// a tool wrote about it. The kernel's limit on processor time is the judge, not a clock.
#include <csignal>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "base/escape.h"
#include "base/isolated_call.h"
#include "base/text_file.h"
#include "submission/build_tools.h"
#include "submission/compiler_messages.h"
#include "submission/cpp_names.h"
#include "submission/graded_source.h"
#include "submission/included_files.h"
#include "submission/program_build.h"
#include "submission/reading_apart_internal.h"
#include "submission/sanitizer_rerun.h"
#include "submission/source_remarks.h"
#include "support/paths.h"
#include "support/rounds.h"
#include "support/slow_sources.h"

namespace rex::submission::slow_text_test {

using ::testing::AllOf;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::Le;

std::vector<grading::CheckResult> failedChecks() {
  std::vector<grading::CheckResult> checks;
  for (int k = 0; k < 40; ++k) {
    grading::CheckResult check{.id = std::to_string(k)};
    check.function = "f" + std::to_string(k < 20 ? k : 24'000 - k);
    check.status = grading::Outcome::kFail;
    checks.push_back(check);
  }
  return checks;
}

using Reader = std::function<std::size_t(const std::string&)>;

std::map<std::string, Reader> readersOfSource() {
  return {{"tokens", [](const std::string& text) { return CppText(text).size(); }},
          {"line markers",
           [](const std::string& text) {
             const std::string shown = "\n# 1 \"main.cpp\"\n" + sourceForMarkers(text);
             return lineMarkers(shown, text, text, "main.cpp", true).size();
           }},
          {"quotients", [](const std::string& text) { return integerDivisions(CppText(text), "a").size(); }},
          {"auto", [](const std::string& text) { return withAutoQuestions(CppText(text)).size(); }},
          {"answers about auto",
           [](const std::string& text) {
             std::vector<grading::CompileDiagnostic> messages(
                 1000, {"main.cpp", 1, 1, "warning", "", "rex::guard::auto"});
             explainAutoAnswers(messages, CppText(text));
             return messages.size();
           }},
          {"pieces", [](const std::string& text) { return cppPieces(CppText(text)).size(); }},
          {"graded part",
           [](const std::string& text) {
             return gradedSource(text, {"f0", "f9"}, {"solve"}).size();
           }},
          {"cascades",
           [](const std::string& text) {
             std::vector<grading::CheckResult> checks = failedChecks();
             explainCascades(checks, text);
             return checks.size();
           }},
          {"definitions",
           [](const std::string& source) {
             const CppText text(source);
             int sum = 0;
             for (int k = 0; k < 5; ++k) sum += definitionLine(k % 2 == 0 ? "f" : "a", text);
             return static_cast<std::size_t>(sum);
           }},
          {"mentions",
           [](const std::string& source) {
             const CppText text(source);
             int sum = 0;
             for (int k = 0; k < 5; ++k) sum += onlyMention(k % 2 == 0 ? "f" : "g", text).first;
             return static_cast<std::size_t>(sum);
           }},
          {"included files",
           [](const std::string& text) {
             const std::vector<std::filesystem::path> files(100, "/etc/passwd");
             return forbiddenIncludes(files, text, "main.cpp", "/tmp", {}).size();
           }},
          {"macros", [](const std::string& text) { return forbiddenMacros(text, "main.cpp").size(); }},
          {"standard input",
           [](const std::string& text) {
             return static_cast<std::size_t>(standardInputUse(CppText(text)).first);
           }},
          {"headers", [](const std::string& text) {
             return static_cast<std::size_t>(opensWithCourseHeader(text, {"-iquote", "/usr/include"}));
           }}};
}

std::map<std::string, std::string> slowOutputs() {
  constexpr std::size_t kMostOutput = 8u << 20;
  const auto array = [](const std::string& message) {
    return R"([{"kind": "error", "locations": [], "message": ")" + message + "\"}]";
  };
  return {{"openings of arrays", repeated("[\n", 1u << 20)},
          {"nested arrays", repeated("[", 1u << 20)},
          {"arrays that nearly end", repeated("[\n}]\n", 1u << 20)},
          {"arrays", repeated(array("x") + "\n", kMostOutput)},
          {"quotes in a message", array(repeated("\u2018", kMostOutput))},
          {"messages in an array",
           "[" + repeated(R"({"kind": "error", "locations": [], "message": "x"},)", kMostOutput) + "1]"},
          {"errors as text", repeated("a.h:1:1: error: x\n", kMostOutput)},
          {"errors of the assembler", repeated("main.cpp:1: Error: x\n", kMostOutput)},
          {"an error on a long line", repeated("main.cpp:1: Error: ", kMostOutput)},
          {"warnings of the assembler", "[]\n" + repeated("main.cpp:1: Warning: [\n", kMostOutput)},
          {"missing functions", repeated("a.o: undefined reference to `f'\n", kMostOutput)},
          {"complaints", repeated("ld: a.o: in function `f':\n", kMostOutput)},
          {"origins", repeated("main.cpp:1:1:   required from here\na.h:1:1: error: x\n", kMostOutput)},
          {"included files", "student.o: " + repeated("/etc/passwd ", kMostOutput)},
          {"one file with a long name", repeated("\\ ", kMostOutput)},
          {"folders in folders", repeated("../", kMostOutput)},
          {"frames", repeated("    #1 0x1 in f main.cpp:3\n", kMostOutput)},
          {"colons", repeated(":", kMostOutput)},
          {"line ends", repeated("\n", kMostOutput)}};
}

std::map<std::string, Reader> readersOfOutput() {
  return {{"JSON", [](const std::string& text) { return parseCompilerJson(text).size(); }},
          {"text", [](const std::string& text) { return parseCompilerText(text).size(); }},
          {"assembler", [](const std::string& text) { return parseAssemblerText(text).size(); }},
          {"linker", [](const std::string& text) { return parseLinkerText(text, "main.cpp").size(); }},
          {"dependencies", [](const std::string& text) { return filesOfAssembler(text, "/tmp").size(); }},
          {"quick look", [](const std::string& text) { return static_cast<std::size_t>(namesErrors(text)); }},
          {"complaint", [](const std::string& text) { return complaintAbout("a.o", text).size(); }},
          {"last words",
           [](const std::string& text) {
             return lastLine({.started = true, .output = {}, .error = text}).size();
           }},
          {"origins",
           [](const std::string& text) {
             std::vector<grading::CompileDiagnostic> messages(100, {"a.h", 1, 1, "error", "", "x"});
             blameMainFile(messages, "main.cpp", printable(text, 64u << 10));
             return messages.size();
           }},
          {"limits of messages",
           [](const std::string& text) {
             std::vector<grading::CompileDiagnostic> messages(
                 100, {"a.h", 1, 1, "error", "", text.substr(0, 1u << 20)});
             admitMessages(messages);
             return messages.size();
           }},
          {"crashes", [](const std::string& text) {
             return static_cast<std::size_t>(crashSiteIn(text, "main.cpp").has_value());
           }}};
}

// Calls the reader, and returns how many milliseconds of processor time this process has used.
std::string tellingTime(const Reader& read, const std::string& text) {
  static_cast<void>(read(text));
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return std::to_string(1000 * (used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                        (used.ru_utime.tv_usec + used.ru_stime.tv_usec) / 1000);
}

// Each reader ends with each text within the limits of rex.
void expectLinear(const std::map<std::string, Reader>& readers,
                  const std::map<std::string, std::string>& texts, const IsolationLimits& limits) {
  std::pair<int, std::string> slowest;
  for (const auto& [name, read] : readers)
    for (const auto& [shape, text] : texts) {
      const IsolatedResult result = callIsolated([&] { return tellingTime(read, text); }, limits);
      EXPECT_EQ(result.end, IsolatedEnd::kReturned) << name << ": " << shape << ": signal " << result.signal;
      if (result.end == IsolatedEnd::kReturned)
        slowest = std::max(slowest, {std::stoi(result.bytes), name + ": " + shape});
    }
  ::testing::Test::RecordProperty("slowest", slowest.second);
  ::testing::Test::RecordProperty("its_milliseconds", slowest.first);
}

// Short runs read a quarter of the largest files.
TEST(SlowText, OfAFileIsReadInTime) {
  const std::size_t size = isLongRun() ? kLargest : kLargest / 4;
  const std::map<std::string, std::string> sources = slowSources(size);
  for (const auto& [shape, text] : sources) EXPECT_THAT(text.size(), AllOf(Gt(size / 4), Le(size))) << shape;
  expectLinear(readersOfSource(), sources, kBeforeCompiling);
}

TEST(SlowText, OfToolsIsReadInTime) { expectLinear(readersOfOutput(), slowOutputs(), kAfterCompiling); }

TEST(SlowText, HasTheLimitsOfTheDocument) {
  const std::string page = readTextFile(homeFolder() / "share" / "doc" / "sandbox.md");
  EXPECT_THAT(page,
              HasSubstr(fmt::format("| {} MiB of text; {:g} s of processor time, {} MiB |", kLargest >> 20,
                                    kBeforeCompiling.cpuSeconds, kBeforeCompiling.memory >> 20)));
  EXPECT_THAT(page, HasSubstr(fmt::format("| 8 MiB; {:g} s, {} GiB for each reading |",
                                          kAfterCompiling.cpuSeconds, kAfterCompiling.memory >> 30)));
}

// The judge works: a reader that goes to the end from each line is stopped.
TEST(SlowText, IsNoticed) {
  const std::string text = repeated("#/*\n", kLargest);
  const auto slow = [&] {
    std::size_t sum = 0;
    for (std::size_t at = text.find('#'); at != text.npos; at = text.find('#', at + 1))
      sum += text.find("*/", at) == text.npos;
    return std::to_string(sum);
  };
  const IsolatedResult result = callIsolated(slow, {.cpuSeconds = 1});
  EXPECT_EQ(result.end, IsolatedEnd::kTookTooLong);
  EXPECT_EQ(result.signal, SIGXCPU);
}

}  // namespace rex::submission::slow_text_test
