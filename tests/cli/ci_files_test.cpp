// The files of share/ci, run in a small tree: the template exercise, whose grader was built beforehand, and a
// `scripts/rex` that builds nothing.
#include <stdlib.h>
#include <unistd.h>

#include "cli/template_project.h"
#include "support/report_checker.h"

namespace rex::cli::ci_files_test {

using ::testing::HasSubstr;
using ::testing::Not;

// Right for small angles only, and tries to be more than text everywhere it can.
constexpr const char* kForger = R"(#include "exercise.h"
#include <cmath>
#include <cstdio>
#include <stdexcept>
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  std::puts("\n::error title=forged::x\n ::notice::3 of 3 points\n##[error]forged\n</pre>| pass | all | 3/3 | |");
  if (a > 2) throw std::runtime_error("\n::notice title=forged::3 of 3 points\n##[error]forged ]]>");
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
)";

class CiFiles : public TemplateProject {
 protected:
  void SetUp() override {
    TemplateProject::SetUp();
    fs::copy(REX_SOURCE_DIR "/share/ci", root() / "share" / "ci", fs::copy_options::recursive);
    fs::create_directory(root() / "scripts");
    write(root() / "scripts" / "rex", "#!/bin/sh\nexec '" REX_OF_TREE "' \"$(dirname \"$0\")/..\" \"$@\"\n");
    fs::permissions(root() / "scripts" / "rex", fs::perms::owner_all);
    makeBuild(root() / "build");
  }

  // What building the tree would make.
  static void makeBuild(const fs::path& build) {
    fs::create_directory(build);
    fs::create_symlink(REX_BINARY_DIR "/tests/template/exercises", build / "exercises");
    for (const char* program : {"rex-sandbox", "rex-sandbox-probe"})
      fs::copy_file(fs::path(REX_BINARY_DIR) / program, build / program);
  }
  fs::path main() const { return exercise() / "main.cpp"; }
  fs::path graded() const { return root() / "out" / "ci" / "98-template"; }

  ProcessResult shell(const std::string& commands, const fs::path& folder) const {
    return runProcess({"/bin/sh", "-e", "-c", commands}, {.directory = folder, .timeout = 250});
  }
  static std::string stepsOf(const std::string& kind, const std::string& file) {
    const ProcessResult read = runProcess(
        {kPython, REX_SOURCE_DIR "/tests/cli/ci_steps.py", kind, REX_SOURCE_DIR "/share/ci/" + file});
    EXPECT_TRUE(read.ok()) << read.error;
    EXPECT_THAT(read.output, HasSubstr("share/ci/grade"));
    return read.output;
  }
};

#define REX_NEEDS_YAML()      \
  REX_NEEDS_REPORT_CHECKER(); \
  if (!runProcess({kPython, "-c", "import yaml"}).ok()) GTEST_SKIP() << "python3-yaml is not installed"

// Lines that GitHub takes for commands.
std::string commandsIn(const std::string& log) {
  std::istringstream lines(log);
  std::string commands;
  for (std::string line; std::getline(lines, line);)
    if (line.find("##[") != std::string::npos ||
        line.substr(std::min(line.find_first_not_of(" \t"), line.size())).starts_with("::"))
      commands += line + "\n";
  return commands;
}

TEST_F(CiFiles, GitHubGetsAnnotationsAndASummaryAndNoForgedOnes) {
  REX_NEEDS_YAML();
  write(main(), kForger);
  ::setenv("GITHUB_STEP_SUMMARY", (root() / "summary.markdown").c_str(), 1);
  const ProcessResult run = shell(stepsOf("github", "github-actions.yml"), root());
  ::unsetenv("GITHUB_STEP_SUMMARY");
  EXPECT_EQ(run.exitCode, 1) << run.error;
  EXPECT_THAT(run.output, HasSubstr("| "));
  write(root() / "log.github", commandsIn(run.output + run.error));
  EXPECT_EQ(fileText(root() / "log.github"),
            rex({"report", (graded() / "results.json").string(), "--format", "github"}).output);
  EXPECT_THAT(fileText(root() / "log.github"), HasSubstr("file=exercises/98-template/main.cpp,line=5::"));
  EXPECT_EQ(schemaFaults("github", {root() / "log.github"}), "");
  EXPECT_EQ(schemaFaults("markdown", {root() / "summary.markdown"}), "");
  EXPECT_EQ(schemaFaults("junit", {graded() / "junit.xml"}), "");
}

TEST_F(CiFiles, GitLabGetsItsReport) {
  REX_NEEDS_YAML();
  write(main(), kGood);
  const ProcessResult run = shell(stepsOf("gitlab", "gitlab-ci.yml"), root());
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_EQ(commandsIn(run.output + run.error), "");
  EXPECT_EQ(schemaFaults("junit", {graded() / "junit.xml"}), "");
  EXPECT_THAT(fileText(graded() / "junit.xml"), HasSubstr("<property name=\"score\" value=\"3\"/>"));
}

// Anything that may change the machine, or tell secrets to the work of strangers.
TEST_F(CiFiles, TheCheckerRefusesWorkflowsThatTrustTooMuch) {
  REX_NEEDS_YAML();
  const std::string sound = fileText(REX_SOURCE_DIR "/share/ci/github-actions.yml");
  const std::pair<const char*, const char*> changes[] = {
      {"  pull_request:", "  pull_request_target:"},
      {"contents: read", "contents: write"},
      {"share/ci/grade", "echo ${{ github.head_ref }}"},
      {"        run:", "        env: {TOKEN: x}\n        run:"},
      {"permissions:\n  contents: read\n", ""}};
  for (const auto& [from, to] : changes) {
    std::string text = sound;
    write(root() / "w.yml", text.replace(text.find(from), std::string(from).size(), to));
    EXPECT_FALSE(
        runProcess({kPython, REX_SOURCE_DIR "/tests/cli/ci_steps.py", "github", (root() / "w.yml").string()})
            .ok())
        << to;
  }
}

TEST_F(CiFiles, GradeEndsByTheWorstExitCode) {
  write(main(), "int main() {");
  EXPECT_EQ(shell("share/ci/grade", root()).exitCode, 2);
  EXPECT_EQ(shell("share/ci/grade 77", root()).exitCode, 64);
  EXPECT_EQ(shell("share/ci/grade 98 77", root()).exitCode, 64);
}

// The layout that Gradescope makes: the zip in source, run_autograder also beside it.
class Gradescope : public CiFiles {
 protected:
  void SetUp() override {
    CiFiles::SetUp();
    if (!runProcess({"git", "--version"}).ok()) GTEST_SKIP() << "git is not installed";
    if (!runProcess({"unzip", "-v"}).ok()) GTEST_SKIP() << "unzip is not installed";
    const ProcessResult made = shell(
        "mkdir -p tests && echo x >tests/secret && echo build >.gitignore && git init -q . && git add -A\n"
        "git -c user.name=x -c user.email=x@y commit -q -m x\n"
        "echo 'Correct Horse Battery' >../secret.txt\n"
        "share/ci/gradescope/make-zip 98-template autograder.zip ../secret.txt\n"
        "mkdir -p a/submission && unzip -q autograder.zip -d a/source && cp a/source/run_autograder a/\n",
        root());
    ASSERT_TRUE(made.ok()) << made.output << made.error;
    makeBuild(source() / "rex" / "build");
    const ProcessResult prepared = shell("a/source/setup.sh", root());
    ASSERT_TRUE(prepared.ok()) << prepared.output << prepared.error;
  }
  fs::path source() const { return root() / "a" / "source"; }
  fs::path result() const { return root() / "a" / "results" / "results.json"; }
};

TEST_F(Gradescope, ZipHoldsWhatGradesAndNothingToCopyFrom) {
  for (const char* name :
       {"setup.sh", "run_autograder", "exercise", "rex/exercises/98-template/check.cpp", "rex/scripts/rex"})
    EXPECT_TRUE(fs::exists(source() / name)) << name;
  EXPECT_EQ(::access((source() / "run_autograder").c_str(), X_OK), 0);
  for (const char* name : {"solution.cpp", "wrong", "../../tests", "../../.git"})
    EXPECT_FALSE(fs::exists(source() / "rex/exercises/98-template" / name)) << name;
}

TEST_F(Gradescope, KeepsTheSecretToItsOwner) {
  const auto isPrivate = [](const fs::path& file) {
    return (fs::status(file).permissions() & (fs::perms::group_all | fs::perms::others_all)) ==
           fs::perms::none;
  };
  EXPECT_EQ(fileText(source() / "secret"), "Correct Horse Battery\n");
  EXPECT_TRUE(isPrivate(root() / "autograder.zip"));
  EXPECT_TRUE(isPrivate(source() / "secret")) << "setup.sh takes the rights away";
  fs::permissions(source() / "secret", fs::perms::all);
  write(root() / "a" / "submission" / "main.cpp", "int main() {");
  shell("a/run_autograder", root());
  EXPECT_TRUE(isPrivate(source() / "secret"));
}

TEST_F(Gradescope, RefusesSecretsThatAreNone) {
  const auto make = [&](const std::string& secret) {
    return shell("share/ci/gradescope/make-zip 98-template other.zip " + secret, root());
  };
  EXPECT_EQ(make("none.txt").exitCode, 64);
  EXPECT_THAT(make("none.txt").error, HasSubstr("none.txt: cannot be read"));
  write(root() / "short.txt", "a b c d e f g h i j\n");
  EXPECT_THAT(make("short.txt").error, HasSubstr("short.txt: too short: wanted at least 16 characters"));
  write(root() / "told.txt", fileText(root() / "scripts" / "rex").substr(10));
  EXPECT_THAT(make("told.txt").error, HasSubstr("told.txt: is committed in this tree"));
  EXPECT_FALSE(fs::exists(root() / "other.zip"));
  const ProcessResult without = make("");
  EXPECT_TRUE(without.ok()) << without.error;
  EXPECT_THAT(without.output, HasSubstr("with the same hidden cases for all"));
}

// A program that looks for it everywhere, while it is compiled and while it runs.
constexpr const char* kSpy = R"(#include "exercise.h"
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
Eigen::Vector2d rotated(const Eigen::Vector2d& p, double a) {
  for (const char* name : {"SECRET", "/proc/self/environ", "/proc/self/cmdline", "/proc/1/cmdline"}) {
    std::ifstream file(name);
    std::cout << name << ": " << (file ? "open " : "closed ") << file.rdbuf() << "\n";
    std::cout.clear();
  }
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
)";

TEST_F(Gradescope, TakesHiddenCasesByASecretThatNoProgramSees) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers read and map what a sandbox forbids";
#endif
  if (rexIn(root() / "build", {"doctor", "--sandbox", "--level", "1"}).code != 0)
    GTEST_SKIP() << "no sandbox can be had here";
  fs::create_directories(root() / "a" / "submission");
  const fs::path file = root() / "a" / "submission" / "main.cpp";
  std::string spy = kSpy;
  spy.replace(spy.find("SECRET"), 6, (source() / "secret").string());
  write(file, spy);
  const ProcessResult run = shell("a/run_autograder", root());
  EXPECT_TRUE(run.ok()) << run.output << run.error;
  const std::string told = fileText(result());
  EXPECT_THAT(told, HasSubstr("hidden:")) << "the result names the secret by its hash";
  EXPECT_THAT(told, HasSubstr("secret: closed"));
  for (const std::string& text : {told, run.output, run.error}) EXPECT_THAT(text, Not(HasSubstr("Horse")));
  write(file, "#include \"" + (source() / "secret").string() + "\"\n" + kGood);
  EXPECT_TRUE(shell("a/run_autograder", root()).ok());
  EXPECT_THAT(fileText(result()), HasSubstr("\"score\": 0,\n  \"exec"));
  EXPECT_THAT(fileText(result()), Not(HasSubstr("Horse")));
}

TEST_F(Gradescope, GradesWhatIsHandedIn) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers read and map what a sandbox forbids";
#endif
  REX_NEEDS_REPORT_CHECKER();
  if (rexIn(root() / "build", {"doctor", "--sandbox", "--level", "1"}).code != 0)
    GTEST_SKIP() << "no sandbox can be had here";
  const auto score = [&](const std::string& place, const std::string& text) {
    fs::remove_all(root() / "a" / "submission");
    fs::create_directories((root() / "a" / "submission" / place).parent_path());
    write(root() / "a" / "submission" / place, text);
    const ProcessResult run = shell("a/run_autograder", root());
    EXPECT_TRUE(run.ok()) << run.output << run.error;
    EXPECT_EQ(schemaFaults("gradescope", {result()}), "");
    return fileText(result());
  };
  EXPECT_THAT(score("main.cpp", kGood), HasSubstr("\"score\": 3,\n  \"exec"));
  EXPECT_THAT(score("98-template/main.cpp", kForger), Not(HasSubstr("\"score\": 3,\n  \"exec")));
  EXPECT_THAT(score("main.cpp", "int main() {"), HasSubstr("\"score\": 0,\n  \"exec"));
  EXPECT_THAT(score("other.cpp", kGood), HasSubstr("found no file"));
}

TEST_F(Gradescope, LeavesAResultWithoutAScoreWhereTheGraderBreaks) {
  REX_NEEDS_REPORT_CHECKER();
  fs::remove(source() / "rex" / "build" / "exercises");
  write(source() / "rex" / "build" / "exercises", "not a folder");
  write(root() / "a" / "submission" / "main.cpp", kGood);
  EXPECT_EQ(shell("a/run_autograder", root()).exitCode, 3);
  EXPECT_EQ(schemaFaults("gradescope", {result()}), "");
  EXPECT_THAT(fileText(result()), Not(HasSubstr("score")));
}

// Two students, listed as tasks that an engine takes one by one.
class ManyByEngines : public CiFiles {
 protected:
  void SetUp() override {
    CiFiles::SetUp();
    for (const char* student : {"adam", "zoe \"x\" $(touch y)"}) {
      fs::create_directories(root() / "in" / student / "98");
      write(root() / "in" / student / "98" / "main.cpp", "int main() { return }\n");
    }
    const std::string common = "scripts/rex grade in --level 0 --i-accept-level 0 --out ";
    const ProcessResult listed = shell(
        "mkdir results; " + common + "whole; " + common + "results --manifest results/tasks.tsv", root());
    ASSERT_TRUE(listed.ok()) << listed.error;
  }
};

TEST_F(ManyByEngines, GradesByGnuParallel) {
  if (!runProcess({"parallel", "--version"}).started) GTEST_SKIP() << "GNU parallel is not installed";
  const ProcessResult run = shell("share/ci/grade-parallel results 2", root());
  EXPECT_TRUE(run.ok()) << run.output << run.error;
  EXPECT_EQ(fileText(root() / "results" / "grades.csv"), fileText(root() / "whole" / "grades.csv"));
}

// A stand-in for Slurm runs each job of the array as Slurm would, the second one twice.
TEST_F(ManyByEngines, HandsAnArrayToSlurm) {
  fs::create_directory(root() / "bin");
  write(root() / "bin" / "sbatch",
        "#!/bin/bash\necho \"$@\" >arguments\ncat >job\nchmod +x job\n"
        "for k in 1 2 2; do SLURM_ARRAY_TASK_ID=$k ./job || exit 1; done\n");
  fs::permissions(root() / "bin" / "sbatch", fs::perms::owner_all);
  const ProcessResult run = shell("PATH=$PWD/bin:$PATH share/ci/grade-slurm results 5", root());
  EXPECT_TRUE(run.ok()) << run.error;
  EXPECT_THAT(run.output, HasSubstr("98-template: kept"));
  EXPECT_THAT(fileText(root() / "arguments"), HasSubstr("--requeue --array=1-2%5 "));
  EXPECT_TRUE(shell("scripts/rex collect results", root()).ok());
  EXPECT_EQ(fileText(root() / "results" / "grades.csv"), fileText(root() / "whole" / "grades.csv"));
}

// Numbers beyond the largest of the cluster come in arrays of their own; only those that were asked for.
TEST_F(ManyByEngines, CutsArraysThatAreTooLongForSlurm) {
  fs::create_directories(root() / "bin");
  write(root() / "bin" / "sbatch", "#!/bin/bash\necho \"$2\"; grep -o 'ID + [0-9]*'\n");
  write(root() / "bin" / "scontrol", "#!/bin/bash\necho 'MaxArraySize            = 101'\n");
  for (const char* name : {"sbatch", "scontrol"})
    fs::permissions(root() / "bin" / name, fs::perms::owner_all);
  write(root() / "results" / "tasks.tsv", std::string(251, '\n'));
  const auto handIn = [&](const std::string& more) {
    return shell("PATH=$PWD/bin:$PATH share/ci/grade-slurm results 5" + more, root());
  };
  EXPECT_EQ(handIn("").output,
            "--array=1-100%5\nID + 0\n--array=1-100%5\nID + 100\n--array=1-50%5\nID + 200\n");
  EXPECT_EQ(handIn(" --tasks 3,7-9,99-102,250").output,
            "--array=3,7-9,99-100%5\nID + 0\n--array=1-2%5\nID + 100\n--array=50%5\nID + 200\n");
  const ProcessResult refused = handIn(" --tasks 'x;y'");
  EXPECT_EQ(refused.exitCode, 64);
  EXPECT_THAT(refused.error, HasSubstr("--tasks: found 'x;y', wanted numbers such as 3,7-9"));
}

}  // namespace rex::cli::ci_files_test
