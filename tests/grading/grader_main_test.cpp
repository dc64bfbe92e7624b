// Runs the sample's grader program on good and bad workers, as the desk will.
#include "grading/grader_main.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/exit_code.h"
#include "base/process.h"
#include "grading/results.h"
#include "support/paths.h"

namespace rex::grading::grader_main_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

#ifdef __SANITIZE_ADDRESS__
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

const fs::path kSample = ownFolder() / "tests" / "sample";

/// Grades workers with small limits, in a folder of its own.
class Grader : public ::testing::Test {
 protected:
  Grader() : folder_(kSample / ("run-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_ / "tmp");
  }
  ~Grader() override { fs::remove_all(folder_); }

  ProcessResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), {(kSample / "grader").string(), "--temporary", (folder_ / "tmp").string(),
                                     "--results", results().string()});
    return runProcess(options);
  }
  GradeResult grade(const std::string& worker, std::vector<std::string> options = {},
                    const std::string& cpuSeconds = "0.2") const {
    options.insert(options.end(),
                   {"--worker", (kSample / worker).string(), "--cpu-seconds", cpuSeconds, "--memory",
                    std::to_string(300 * kMegabyte), "--output", std::to_string(8 * kMegabyte)});
    const ProcessResult process = run(options);
    EXPECT_EQ(process.output + process.error, "");
    return loadResult(results());
  }
  fs::path results() const { return folder_ / "results.json"; }
  bool temporaryIsEmpty() const { return fs::is_empty(folder_ / "tmp"); }

 private:
  fs::path folder_;
};

int processesOf(const fs::path& program) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::error_code gone;
    if (fs::read_symlink(entry.path() / "exe", gone) == program) ++count;
  }
  return count;
}

const CheckResult& find(const GradeResult& result, const std::string& id) {
  return *std::find_if(result.checks.begin(), result.checks.end(), [&](const auto& c) { return c.id == id; });
}

TEST_F(Grader, GivesFullScoreToAGoodSolution) {
  const GradeResult result = grade("good");
  EXPECT_EQ(result.outcome, Outcome::kPass);
  EXPECT_EQ(result.score, 10);
  EXPECT_EQ(result.maxScore, 10);
  EXPECT_EQ(result.sandboxLevel, 0);
  EXPECT_THAT(result.sandboxWarnings, ::testing::ElementsAre(HasSubstr("sandbox level 0 of 3")));
  EXPECT_TRUE(temporaryIsEmpty());
}

// What a worker reads in a debugger.
TEST_F(Grader, WritesTheCallWithWhichACheckFails) {
  const fs::path call = results().parent_path() / "call";
  const auto find = [&](const std::string& worker, const std::string& check) {
    return run({"--worker", (kSample / worker).string(), "--check", check, "--failing-call", call.string()});
  };
  const ProcessResult passes = find("good", "step");
  EXPECT_EQ(passes.exitCode, 0) << passes.error;
  EXPECT_EQ(passes.output, "");
  EXPECT_FALSE(fs::exists(call));
  const ProcessResult fails = find("nan", "step");
  EXPECT_EQ(fails.exitCode, 1) << fails.error;
  EXPECT_EQ(fails.output, "ikStep\n");
  // The worker answers that call, and ends where there is no other.
  const ProcessResult repeated =
      runProcess({"sh", "-c", "\"$0\" 3<\"$1\" 4>\"$2\"", (kSample / "nan").string(), call.string(),
                  (call.parent_path() / "answers").string()});
  EXPECT_EQ(repeated.exitCode, 0) << repeated.error;
  EXPECT_GT(fs::file_size(call.parent_path() / "answers"), 48u) << "after its introduction";
  const ProcessResult crashes = find("segfault", "step");
  EXPECT_EQ(crashes.exitCode, 3);
  EXPECT_THAT(crashes.error, HasSubstr("grader: the program crashed with a segmentation fault in ikStep"));
  const ProcessResult two = run({"--worker", (kSample / "good").string(), "--failing-call", call.string()});
  EXPECT_THAT(two.error, HasSubstr("a failing call is that of one check"));
}

struct Trouble {
  std::string worker;
  Outcome outcome;
  std::string message;             ///< in the report of the visible check
  std::string cpuSeconds = "0.2";  ///< its limit
};

// Some machines need more than a second to touch 300 MB.
Trouble memoryEater(std::string worker) {
  return {std::move(worker), Outcome::kMemoryLimit, "used more than 300 MB of memory in ikStep", "4"};
}

void PrintTo(const Trouble& trouble, std::ostream* out) { *out << trouble.worker; }

class Troubled : public Grader, public ::testing::WithParamInterface<Trouble> {};

TEST_P(Troubled, EndsInItsOutcomeAndHarmsNothingElse) {
  const Trouble& trouble = GetParam();
  const GradeResult result = grade(trouble.worker, {}, trouble.cpuSeconds);
  for (const char* id : {"step", "step-unseen"}) {
    EXPECT_EQ(find(result, id).status, trouble.outcome) << find(result, id).message;
    EXPECT_EQ(find(result, id).points, 0);
    // The limit is 2.4 s; a busy machine may stretch it four times.
    EXPECT_LE(find(result, id).wallSeconds, 4 * 2.4 + 2);
  }
  EXPECT_EQ(result.outcome, trouble.outcome);
  // The sanitizers notice a crash before it happens.
  if (!kSanitized) {
    EXPECT_THAT(find(result, "step").message, HasSubstr(trouble.message));
  }
  EXPECT_EQ(find(result, "square").points, 2);
  EXPECT_EQ(find(result, "search").points, 1);
  EXPECT_EQ(result.score, 3);
  EXPECT_EQ(processesOf(kSample / trouble.worker), 0);
  EXPECT_TRUE(temporaryIsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Workers, Troubled,
    ::testing::Values(
        Trouble{
            "assertion", Outcome::kRuntimeError,
            "aborted in ikStep: an index is outside of a vector (Assertion `index >= 0 && index < size()'"},
        Trouble{"closed", Outcome::kProtocolError, "lost its connection to the grader in ikStep"},
        Trouble{"closed_and_asleep", Outcome::kProtocolError,
                "closed its connection to the grader in ikStep"},
        Trouble{"exit_in_call", Outcome::kRuntimeError, "called exit(0) in ikStep"},
        Trouble{"flood", Outcome::kOutputLimit, "printed more than 8 MB in ikStep"},
        Trouble{"ignored_signals", Outcome::kTimeLimit, "stopped after"},
        Trouble{"junk", Outcome::kProtocolError, "corrupted the connection to the grader in ikStep"},
        Trouble{"loop", Outcome::kTimeLimit, "stopped after"},
        Trouble{"nan", Outcome::kFail, "what ikStep returned: number 2 is nan, wanted finite numbers"},
        Trouble{"noexcept_throw", Outcome::kRuntimeError,
                "aborted in ikStep: terminate called after throwing"},
        Trouble{"recursion", Outcome::kRuntimeError, "crashed with a segmentation fault in ikStep"},
        Trouble{"secrets", Outcome::kRuntimeError, "threw std::runtime_error in ikStep: the target is"},
        Trouble{"segfault", Outcome::kRuntimeError, "crashed with a segmentation fault in ikStep"},
        Trouble{"shape", Outcome::kFail, "position after the step: wrong shape: got 7 x 1, wanted 3 x 1"},
        Trouble{"sleep", Outcome::kTimeLimit, "stopped after 2.4 s in ikStep"},
        Trouble{"throws_number", Outcome::kRuntimeError, "threw int in ikStep"}),
    [](const auto& trouble) { return trouble.param.worker; });

// The sanitizers need an unlimited address space: under them there is no limit to break.
#ifndef __SANITIZE_ADDRESS__
INSTANTIATE_TEST_SUITE_P(MemoryEaters, Troubled,
                         ::testing::Values(memoryEater("memory"), memoryEater("memory_crumbs"),
                                           memoryEater("memory_noexcept")),
                         [](const auto& trouble) { return trouble.param.worker; });

TEST_F(Grader, SurvivesGlobalsThatDoNotFit) {
  const GradeResult result = grade("globals");
  EXPECT_EQ(result.outcome, Outcome::kRuntimeError);
  EXPECT_THAT(result.checks[0].message, HasSubstr("do the global variables need more than 300 MB?"));
}
#endif

TEST_F(Grader, SurvivesAWorkerThatEndsBeforeItStarts) {
  const GradeResult result = grade("exit_at_start");
  EXPECT_EQ(result.score, 0);
  EXPECT_EQ(result.outcome, Outcome::kRuntimeError);
  EXPECT_THAT(result.checks[0].message, HasSubstr("called exit(0) before the first call"));
  EXPECT_THAT(result.output.text, HasSubstr("ALL TESTS PASSED"));
}

TEST_F(Grader, LeavesNoOrphanAndNoFile) {
  EXPECT_EQ(grade("orphan").score, 10);
  EXPECT_EQ(processesOf(kSample / "orphan"), 0);
  EXPECT_EQ(grade("litter").score, 10);
  EXPECT_TRUE(temporaryIsEmpty());
}

TEST_F(Grader, KeepsHiddenInputsFromTheStudent) {
  const GradeResult result = grade("secrets");
  EXPECT_EQ(find(result, "step-unseen").message, "0 of 3 cases hold; case 1: threw an exception in ikStep");
  EXPECT_EQ(find(result, "step-unseen").input, "");
  const GradeResult hidden = grade("secrets", {"--check", "step-unseen"});
  EXPECT_EQ(hidden.output.text, "");
  EXPECT_GT(hidden.usage.outputBytes, 0u);
  for (const char* worker : {"assertion", "exit_in_call", "segfault"})
    EXPECT_EQ(find(grade(worker), "step-unseen").message,
              "crashed, threw an exception or ended the program in ikStep");
  EXPECT_EQ(find(grade("flood"), "step-unseen").message, "printed too much in ikStep");
  EXPECT_EQ(find(grade("exit_at_start"), "step-unseen").message,
            "crashed, threw an exception or ended the program outside your functions");
}

TEST_F(Grader, GivesTheSameBytesTwice) {
  const auto stable = [&](const std::string& seed) {
    auto json = nlohmann::json::parse(toJson(grade("nan", {"--seed", seed})));
    json.erase("volatile");
    return json.dump();
  };
  EXPECT_EQ(stable("5"), stable("5"));
  EXPECT_NE(stable("5"), stable("6"));
}

TEST_F(Grader, FillsAPreparedResultFile) {
  GradeResult prepared;
  prepared.submissionId = "alice";
  prepared.compiler = "g++ 12";
  saveResult(prepared, results());
  const GradeResult result = grade("good", {"--check", "search", "--check", "step"});
  EXPECT_EQ(result.submissionId, "alice");
  EXPECT_EQ(result.compiler, "g++ 12");
  ASSERT_EQ(result.checks.size(), 2u);
  EXPECT_EQ(result.checks[0].id, "step");
  EXPECT_EQ(result.score, 5);
  EXPECT_EQ(result.maxScore, 5);
}

TEST_F(Grader, ListsAllChecksAsNotRunWithoutAWorker) {
  GradeResult prepared;
  prepared.outcome = Outcome::kCompileError;
  saveResult(prepared, results());
  EXPECT_EQ(run({}).exitCode, numberOf(ExitCode::kBelow));
  const GradeResult result = loadResult(results());
  EXPECT_EQ(result.outcome, Outcome::kCompileError);
  EXPECT_EQ(result.maxScore, 10);
  EXPECT_EQ(result.checks.size(), 4u);
  EXPECT_EQ(result.checks[3].status, std::nullopt);
}

TEST_F(Grader, HasExitCodes) {
  EXPECT_EQ(run({"--worker", (kSample / "good").string()}).exitCode, numberOf(ExitCode::kFull));
  EXPECT_EQ(run({"--worker", (kSample / "shape").string()}).exitCode, numberOf(ExitCode::kBelow));
  EXPECT_EQ(run({"--worker", (kSample / "missing").string()}).exitCode, numberOf(ExitCode::kGraderFault));
  const GradeResult result = loadResult(results());
  EXPECT_EQ(result.outcome, Outcome::kGraderError);
  EXPECT_THAT(result.checks[0].message,
              HasSubstr("the grader failed, which is not your fault: cannot start the worker"));
  EXPECT_EQ(result.checks[2].message,
            "the grader failed, which is not your fault: the check ended with an exception");
  const ProcessResult unknown = run({"--check", "stepp"});
  EXPECT_EQ(unknown.exitCode, numberOf(ExitCode::kUsage));
  EXPECT_EQ(unknown.error, "grader: no check is called 'stepp' (did you mean 'step'?)\n");
  EXPECT_EQ(run({"--cpu-seconds", "-1"}).exitCode, numberOf(ExitCode::kUsage));
  EXPECT_EQ(run({"--nonsense"}).exitCode, numberOf(ExitCode::kUsage));
  std::ofstream(results().string() + ".secret") << "short\n";
  const ProcessResult weak = run({"--secret", results().string() + ".secret"});
  EXPECT_EQ(weak.exitCode, numberOf(ExitCode::kGraderFault));
  EXPECT_THAT(weak.error,
              HasSubstr("the secret of the course is too short: found 5 characters, wanted at least 16"));
  std::ofstream(results()) << "spoilt";
  EXPECT_EQ(run({}).exitCode, numberOf(ExitCode::kGraderFault));
}

// build.json alone must tell how a student's program becomes a worker.
TEST_F(Grader, IsDescribedWellEnoughToBuildAWorker) {
  std::ifstream file(kSample / "build.json");
  const auto build = nlohmann::json::parse(file);
  const fs::path source = homeFolder() / "tests" / "grading" / "sample";
  const fs::path worker = results().parent_path() / "worker";
  std::vector<std::string> command = {build.at("compiler").get<std::string>()};
  for (const std::string flag : build.at("compile_flags")) command.push_back(flag);
  for (const char* name : {"good.cpp", "rest.cpp"}) command.push_back((source / name).string());
  command.push_back(build.at("worker_object").get<std::string>());
  for (const std::string library : build.at("libraries")) command.push_back(library);
  for (const std::string flag : build.at("link_flags")) command.push_back(flag);
  command.insert(command.end(), {"-o", worker.string()});
  const ProcessResult compiled = runProcess(command);
  ASSERT_TRUE(compiled.ok()) << compiled.error;
  EXPECT_EQ(compiled.error, "");
  EXPECT_EQ(run({"--worker", worker.string()}).exitCode, numberOf(ExitCode::kFull));
  EXPECT_EQ(fs::path(build.at("grader").get<std::string>()), kSample / "grader");
}

TEST_F(Grader, TellsItsSeed) {
  EXPECT_EQ(grade("good").seedId, "public:1");
  EXPECT_EQ(grade("good", {"--seed", "7"}).seedId, "public:7");
}

TEST(RunGrader, RefusesTwoChecksOfOneName) {
  const std::vector<RunnableCheck> checks(2, {.info = {.id = "step"}});
  const std::array<const char*, 2> arguments = {"grader", "--list"};
  ::testing::internal::CaptureStderr();
  const int code = runGrader(2, arguments.data(), checks, 0, {});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "grader: two checks have the id 'step'\n");
  EXPECT_EQ(code, numberOf(ExitCode::kGraderFault));
}

TEST_F(Grader, ListsItsChecks) {
  const ProcessResult process = run({"--list"});
  EXPECT_EQ(process.exitCode, numberOf(ExitCode::kFull));
  const auto list = nlohmann::json::parse(process.output);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_EQ(list[2],
            nlohmann::json::parse(R"({"id": "step-unseen", "part": "a", "points": 3, "group": "hidden",
                                               "title": "One step reaches unseen targets"})"));
}

}  // namespace rex::grading::grader_main_test
