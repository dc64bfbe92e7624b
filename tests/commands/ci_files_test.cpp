// The files of share/ci, run in a small tree: the template exercise, whose grader was built beforehand, and a
// `scripts/rex` that builds nothing.
#include <map>
#include <set>

#include <stdlib.h>
#include <unistd.h>

#include "base/sha256.h"
#include "commands/built_project.h"
#include "submission/exercise_info.h"
#include "support/paths.h"
#include "support/report_checker.h"

namespace rex::cli::ci_files_test {

using ::testing::AllOf;
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

class CiFiles : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    fs::copy(sourcePath("share/ci"), root() / "share" / "ci", fs::copy_options::recursive);
    for (const char* folder : {"bin", "scripts", ".rex"}) fs::create_directory(root() / folder);
    const std::string program = "exec '" + kRexOfTree + "' '" + root().string() + "' \"$@\"\n";
    writeProgram("scripts/rex", program);
    // A source tree makes no course folders, and apt-get installs nothing here.
    writeProgram("bin/rex", "[ \"$1\" != init ] || exec mkdir \"$2\"\n" + program);
    writeProgram("bin/apt-get", "echo \"$@\" >>'" + (root() / "installed").string() + "'\n");
    handOut("int main() {}  // as it was handed out\n");
    for (const char* tool : {"rex-sandbox", "rex-sandbox-probe"})
      fs::copy_file(ownFolder() / tool, build() / tool);
    ::setenv("PATH", ((root() / "bin").string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void writeProgram(const fs::path& name, const std::string& script) const {
    write(root() / name, "#!/bin/sh\n" + script);
    fs::permissions(root() / name, fs::perms::owner_all);
  }
  void handOut(const std::string& text) const {
    write(root() / kCourseFile,
          R"({"files": {"exercises/98-template/main.cpp": ")" + sha256(text) + "\"}}\n");
    write(main(), text);
  }
  fs::path main() const { return exercise() / "main.cpp"; }
  fs::path graded() const { return root() / "out" / "ci" / "98-template"; }

  ProcessResult shell(const std::string& commands) const {
    return runProcess({"/bin/sh", "-e", "-c", commands}, {.directory = root(), .timeout = 250});
  }
  // The commands of each step in share/ci/FILE, by name.
  static std::map<std::string, std::string> stepsOf(const std::string& kind, const std::string& file) {
    const ProcessResult read =
        runProcess({kPython, sourcePath("tests/commands/ci_steps.py"), kind, sourcePath("share/ci/" + file)});
    EXPECT_TRUE(read.ok()) << read.error;
    std::map<std::string, std::string> steps;
    std::istringstream lines(read.output);
    for (std::string line; std::getline(lines, line);)
      steps[line.substr(0, line.find('\t'))] = line.substr(line.find('\t') + 1);
    return steps;
  }
  // A step as it runs here: with the files of the source tree, and for the template in place of 01.
  std::string here(std::string step) const {
    for (const auto& [from, to] : {std::pair<std::string, std::string>{"/usr/share/rex", root() / "share"},
                                   {"01-kinematics", "98-template"}})
      for (std::size_t at = 0; (at = step.find(from, at)) != step.npos; at += to.size())
        step.replace(at, from.size(), to);
    return step;
  }
  void commit(const std::string& what) const {
    const ProcessResult made = shell(
        "[ -d .git ] || git init -q .\ngit add exercises\n"
        "git -c user.name=x -c user.email=x@y commit -q -m '" +
        what + "'\n");
    EXPECT_TRUE(made.ok()) << made.error;
  }

  std::string path_ = std::getenv("PATH");
};

bool hasYaml() {
  static const bool has = runProcess({kPython, "-c", "import yaml"}).ok();
  return has;
}

#define REX_NEEDS_YAML()      \
  REX_NEEDS_REPORT_CHECKER(); \
  if (!hasYaml()) GTEST_SKIP() << "python3-yaml is not installed"

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

TEST_F(CiFiles, HaveAStepForEachExerciseOfTheCourse) {
  REX_NEEDS_YAML();
  std::set<std::string> exercises;
  for (const submission::ExerciseInfo& one : submission::listExercises(sourcePath("exercises")))
    if (!one.isPrivate) exercises.insert(one.name);
  for (const auto& [kind, file] :
       {std::pair<const char*, const char*>{"github", "github-actions.yml"}, {"gitlab", "gitlab-ci.yml"}}) {
    std::set<std::string> named;
    for (const auto& [name, commands] : stepsOf(kind, file)) {
      named.insert(name);
      EXPECT_THAT(commands, HasSubstr(name)) << file;
    }
    EXPECT_EQ(named, exercises) << file;
  }
}

TEST_F(CiFiles, GitHubGetsAnnotationsAndASummaryAndNoForgedOnes) {
  REX_NEEDS_YAML();
  write(main(), kForger);
  ::setenv("GITHUB_STEP_SUMMARY", (root() / "summary.markdown").c_str(), 1);
  const ProcessResult run = shell(here(stepsOf("github", "github-actions.yml").at("01-kinematics")));
  ::unsetenv("GITHUB_STEP_SUMMARY");
  EXPECT_EQ(run.exitCode, 1) << run.error;
  EXPECT_THAT(run.output, HasSubstr("| "));
  write(root() / "log.github", commandsIn(run.output + run.error));
  EXPECT_EQ(fileText(root() / "log.github"), fileText(graded() / "github.txt"));
  EXPECT_THAT(fileText(root() / "log.github"), HasSubstr("file=exercises/98-template/main.cpp,line=5::"));
  EXPECT_EQ(schemaFaults("github", {root() / "log.github"}), "");
  EXPECT_EQ(schemaFaults("markdown", {root() / "summary.markdown"}), "");
  EXPECT_EQ(schemaFaults("junit", {graded() / "junit.xml"}), "");
}

TEST_F(CiFiles, GitLabGetsItsReport) {
  REX_NEEDS_YAML();
  write(main(), kGood);
  const ProcessResult run = shell(here(stepsOf("gitlab", "gitlab-ci.yml").at("01-kinematics")));
  EXPECT_EQ(run.exitCode, 0) << run.error;
  EXPECT_EQ(commandsIn(run.output + run.error), "");
  EXPECT_EQ(schemaFaults("junit", {graded() / "junit.xml"}), "");
  EXPECT_THAT(fileText(graded() / "junit.xml"), HasSubstr("<property name=\"score\" value=\"3\"/>"));
}

// Anything that may change the machine, or tell secrets to the work of strangers.
TEST_F(CiFiles, TheCheckerRefusesWorkflowsThatTrustTooMuch) {
  REX_NEEDS_YAML();
  const std::string sound = fileText(sourcePath("share/ci/github-actions.yml"));
  const std::pair<const char*, const char*> changes[] = {
      {"on: push", "on: pull_request_target"},
      {"contents: read", "contents: write"},
      {"run: /usr", "run: echo ${{ github.head_ref }}; /usr"},
      {"BEFORE: ${{ github.event.before }}", "BEFORE: ${{ secrets.TOKEN }}"},
      {"permissions:\n  contents: read\n", ""}};
  for (const auto& [from, to] : changes) {
    std::string text = sound;
    write(root() / "w.yml", text.replace(text.find(from), std::string(from).size(), to));
    EXPECT_FALSE(
        runProcess({kPython, sourcePath("tests/commands/ci_steps.py"), "github", (root() / "w.yml").string()})
            .ok())
        << to;
  }
}

TEST_F(CiFiles, GradeTakesWhatIsBegunAndHasChanged) {
  if (!runProcess({"git", "--version"}).ok()) GTEST_SKIP() << "git is not installed";
  commit("handed out");
  const auto grade = [&](const std::string& arguments) { return shell("share/ci/grade " + arguments); };
  const ProcessResult untouched = grade("");
  EXPECT_EQ(untouched.exitCode, 0) << untouched.error;
  EXPECT_EQ(untouched.output, "98-template: not graded: main.cpp is as it was handed out\n");
  EXPECT_FALSE(fs::exists(root() / "out" / "ci"));
  write(main(), kGood);
  commit("solved");
  EXPECT_THAT(grade("--since HEAD~1").output, HasSubstr("3 of 3 points"));
  write(root() / "exercises" / "98-template" / "notes.txt", "mine");
  commit("notes");
  const ProcessResult same = grade("--since HEAD~1 98-template");
  EXPECT_EQ(same.exitCode, 0) << same.error;
  EXPECT_EQ(same.output, "98-template: not graded: no change since HEAD~1\n");
  // A branch that is new has no commit before it, and after a forced push that commit is lost.
  EXPECT_THAT(grade("--since 0000000000000000000000000000000000000000").output, HasSubstr("3 of 3 points"));
  EXPECT_THAT(grade("--since '' 98-template").output, HasSubstr("3 of 3 points"));
}

TEST_F(CiFiles, GradeEndsByTheWorstExitCode) {
  write(main(), "int main() {");
  EXPECT_EQ(shell("share/ci/grade").exitCode, 2);
  const ProcessResult other = shell("share/ci/grade 77-none");
  EXPECT_EQ(other.exitCode, 0);
  EXPECT_EQ(other.output, "77-none: not graded: not in this course folder\n");
  fs::remove_all(exercise());
  EXPECT_EQ(shell("share/ci/grade").exitCode, 64);
}

// The layout that Gradescope makes: the zip in source, run_autograder also beside it.
class Gradescope : public CiFiles {
 protected:
  void SetUp() override {
    CiFiles::SetUp();
    useRealCompiler();
    for (const char* tool : {"git", "unzip", "dpkg-deb"})
      if (!runProcess({tool, "--help"}).started) GTEST_SKIP() << tool << " is not installed";
    const ProcessResult made = shell(
        "mkdir -p p/DEBIAN && printf 'Package: rex-instructor\\nVersion: 1\\nArchitecture: all\\n"
        "Maintainer: x <x@y>\\nDescription: x\\n' >p/DEBIAN/control && dpkg-deb --build p rex.deb "
        ">/dev/null\n"
        "echo 'Correct Horse Battery' >../secret.txt\n"
        "share/ci/gradescope/make-zip 98-template autograder.zip rex.deb ../secret.txt\n"
        "mkdir -p a/submission && unzip -q autograder.zip -d a/source && cp a/source/run_autograder a/\n");
    ASSERT_TRUE(made.ok()) << made.output << made.error;
    EXPECT_THAT(made.output, HasSubstr("grades 98-template, with hidden cases by the secret"));
    const ProcessResult prepared = shell("a/source/setup.sh");
    ASSERT_TRUE(prepared.ok()) << prepared.output << prepared.error;
  }
  fs::path source() const { return root() / "a" / "source"; }
  fs::path result() const { return root() / "a" / "results" / "results.json"; }
};

TEST_F(Gradescope, ZipHoldsWhatGradesAndNothingToCopyFrom) {
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(source())) files.insert(entry.path().filename());
  EXPECT_EQ(files, (std::set<std::string>{"course", "exercise", "run_autograder", "secret", "setup.sh"}))
      << "the package is removed when it is installed";
  EXPECT_THAT(fileText(root() / "installed"), HasSubstr("install -y --no-install-recommends ./rex.deb"));
  EXPECT_EQ(::access((source() / "run_autograder").c_str(), X_OK), 0);
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
  shell("a/run_autograder");
  EXPECT_TRUE(isPrivate(source() / "secret"));
}

TEST_F(Gradescope, RefusesSecretsAndPackagesThatAreNone) {
  const auto make = [&](const std::string& rest) {
    return shell("share/ci/gradescope/make-zip 98-template other.zip " + rest);
  };
  EXPECT_EQ(make("rex.deb none.txt").exitCode, 64);
  EXPECT_THAT(make("rex.deb none.txt").error, HasSubstr("none.txt: cannot be read"));
  write(root() / "short.txt", "a b c d e f g h i j\n");
  EXPECT_THAT(make("rex.deb short.txt").error,
              HasSubstr("short.txt: too short: wanted at least 16 characters"));
  commit("all");
  write(root() / "told.txt", "int main() {}  // as it was handed out\n");
  EXPECT_THAT(make("rex.deb told.txt").error, HasSubstr("told.txt: is committed in this tree"));
  EXPECT_EQ(make("short.txt").exitCode, 64);
  EXPECT_THAT(make("short.txt").error, HasSubstr("short.txt: wanted a package that scripts/package made"));
  EXPECT_FALSE(fs::exists(root() / "other.zip"));
  const ProcessResult without = make("rex.deb");
  EXPECT_TRUE(without.ok()) << without.error;
  EXPECT_THAT(without.output, HasSubstr("with the same hidden cases for all"));
  ASSERT_TRUE(
      shell("sed -i s/rex-instructor/rex/ p/DEBIAN/control && dpkg-deb --build p s.deb >/dev/null").ok());
  EXPECT_THAT(make("s.deb").output, HasSubstr("without hidden checks: rex is the students' package"));
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
    if (file && name[0] == 'S') return {NAN, NAN};
  }
  return {std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y()};
}
int main() {}
)";

TEST_F(Gradescope, TakesHiddenCasesByASecretThatNoProgramSees) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers read and map what a sandbox forbids";
#endif
  if (rex({"doctor", "--sandbox", "--level", "1"}).code != 0) GTEST_SKIP() << "no sandbox can be had here";
  fs::create_directories(root() / "a" / "submission");
  const fs::path file = root() / "a" / "submission" / "main.cpp";
  std::string spy = kSpy;
  const std::string place = (source() / "secret").string();
  spy.replace(spy.find("SECRET"), 6, place)
      .replace(spy.find("name[0] == 'S'"), 14, "name == std::string(\"" + place + "\")");
  write(file, spy);
  const ProcessResult run = shell("a/run_autograder");
  EXPECT_TRUE(run.ok()) << run.output << run.error;
  const std::string told = fileText(result());
  EXPECT_THAT(told, HasSubstr("hidden:")) << "the result names the secret by its hash";
  EXPECT_THAT(told, HasSubstr("\"score\": 3,")) << "it could not be opened";
  EXPECT_THAT(told, Not(HasSubstr("secret: closed")))
      << "nothing that is printed is shown beside hidden checks";
  for (const std::string& text : {told, run.output, run.error}) EXPECT_THAT(text, Not(HasSubstr("Horse")));
  write(file, "#include \"" + (source() / "secret").string() + "\"\n" + kGood);
  EXPECT_TRUE(shell("a/run_autograder").ok());
  EXPECT_THAT(fileText(result()), HasSubstr("\"score\": 0,\n  \"exec"));
  EXPECT_THAT(fileText(result()), Not(HasSubstr("Horse")));
}

TEST_F(Gradescope, GradesWhatIsHandedIn) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizers read and map what a sandbox forbids";
#endif
  REX_NEEDS_REPORT_CHECKER();
  if (rex({"doctor", "--sandbox", "--level", "1"}).code != 0) GTEST_SKIP() << "no sandbox can be had here";
  const auto score = [&](const std::string& place, const std::string& text) {
    fs::remove_all(root() / "a" / "submission");
    fs::create_directories((root() / "a" / "submission" / place).parent_path());
    write(root() / "a" / "submission" / place, text);
    const ProcessResult run = shell("a/run_autograder");
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
  fs::remove_all(build() / "exercises");
  write(build() / "exercises", "not a folder");
  write(root() / "a" / "submission" / "main.cpp", kGood);
  EXPECT_EQ(shell("a/run_autograder").exitCode, 3);
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
    const ProcessResult listed =
        shell("mkdir results; " + common + "whole; " + common + "results --manifest results/tasks.tsv");
    ASSERT_TRUE(listed.ok()) << listed.error;
  }
};

TEST_F(ManyByEngines, GradesByGnuParallel) {
  if (!runProcess({"parallel", "--version"}).started) GTEST_SKIP() << "GNU parallel is not installed";
  const ProcessResult run = shell("share/ci/grade-parallel results 2");
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
  const ProcessResult run = shell("PATH=$PWD/bin:$PATH share/ci/grade-slurm results 5");
  EXPECT_TRUE(run.ok()) << run.error;
  EXPECT_THAT(run.output, HasSubstr("98-template: kept"));
  EXPECT_THAT(fileText(root() / "arguments"), HasSubstr("--requeue --array=1-2%5 "));
  EXPECT_TRUE(shell("scripts/rex grade --collect -o results").ok());
  EXPECT_EQ(fileText(root() / "results" / "grades.csv"), fileText(root() / "whole" / "grades.csv"));
  const ProcessResult chunk = shell(
      "sed -i 's/1 2 2/1/' bin/sbatch; export REX=$PWD/scripts/rex; "
      "PATH=$PWD/bin:$PATH share/ci/grade-slurm results 5 --chunk 20");
  EXPECT_THAT(fileText(root() / "arguments"), HasSubstr("--array=1%5 "));
  EXPECT_THAT(chunk.output,
              AllOf(HasSubstr("adam 98-template: kept"), HasSubstr("$(touch y) 98-template: kept")));
}

TEST(PackageVersions, SortByTheTimeOfTheCommitAndBeforeTheNextRelease) {
  const ProcessResult sorted =
      runProcess({"/bin/bash", "-ec",
                  "source scripts/bootstrap; a=$(package_version 0.2.0 1795900000 fff v0.2.0); "
                  "b=$(package_version 0.3.0 1795900001 abc ''); for c in 0.2.0 $a $b 0.3.0; do test -z "
                  "\"$p\" || dpkg --compare-versions $p lt $c; p=$c; done; echo $a $b"},
                 {.directory = sourcePath("")});
  EXPECT_EQ(sorted.output, "0.3.0~git20261128210640.fff 0.3.0~git20261128210641.abc\n") << sorted.error;
}

TEST_F(CiFiles, NameTheImageOfTheCourse) {
  fs::copy(sourcePath("share/course"), root() / "share" / "course", fs::copy_options::recursive);
  const auto named = [&](const std::string& image) {
    return runProcess({"/bin/bash", "-ec",
                       "source scripts/bootstrap; name_image '" + root().string() + "' '" + image + "'"},
                      {.directory = sourcePath("")});
  };
  EXPECT_EQ(named("a|b").exitCode, 64);
  const ProcessResult run = named("ghcr.io/course/rex:2026");
  EXPECT_TRUE(run.ok()) << run.error;
  for (const char* file :
       {"ci/github-actions.yml", "ci/gitlab-ci.yml", "course/.devcontainer/devcontainer.json"})
    EXPECT_THAT(fileText(root() / "share" / file), HasSubstr("ghcr.io/course/rex:2026")) << file;
  EXPECT_NE(shell("grep -rl registry.example.org share").exitCode, 0);
}

// The environment that Classroom 50's runner sets.
TEST_F(CiFiles, GradeForClassroom50) {
  const auto graded = [&](const std::string& text) {
    write(main(), text);
    const std::string environment =
        "export CLASSROOM=robotics ASSIGNMENT=98-template SUBMISSION_TAG=submit/2026-11-20T12-00-10Z-abcdef0 "
        "COMMIT_URL=https://x/commit/1 RELEASE_URL=https://x/releases/1; rm -f result.json; exec ";
    const ProcessResult run = shell(environment + kPython + " share/ci/classroom50/autograder.py");
    EXPECT_TRUE(run.ok()) << run.error;
    return nlohmann::json::parse(fileText(root() / "result.json"));
  };
  const nlohmann::json full = graded(kGood);
  EXPECT_EQ(full.at("schema"), "classroom50/result/v1");
  EXPECT_EQ(full.at("classroom"), "robotics");
  EXPECT_EQ(full.at("assignment"), "98-template");
  EXPECT_EQ(full.at("review"), "https://x/commit/1");
  EXPECT_EQ(
      full.at("tests")[0],
      (nlohmann::json{{"test-name", "A quarter turn"}, {"passed", true}, {"score", 1}, {"max-score", 1}}));
  EXPECT_EQ(full.at("score"), full.at("max-score"));
  EXPECT_EQ(full.dump().find("Two turns"), std::string::npos) << "a hidden check";
  const nlohmann::json none = graded("int main() {");
  EXPECT_EQ(none.at("score"), 0);
  EXPECT_EQ(none.at("tests")[0].at("passed"), false) << "it does not compile";
  EXPECT_EQ(none.at("max-score"), full.at("max-score"));
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
    return shell("PATH=$PWD/bin:$PATH share/ci/grade-slurm results 5" + more);
  };
  EXPECT_EQ(handIn("").output,
            "--array=1-100%5\nID + 0\n--array=1-100%5\nID + 100\n--array=1-50%5\nID + 200\n");
  EXPECT_EQ(handIn(" --tasks 3,7-9,99-102,250").output,
            "--array=3,7-9,99-100%5\nID + 0\n--array=1-2%5\nID + 100\n--array=50%5\nID + 200\n");
  EXPECT_EQ(handIn(" --chunk 2").output, "--array=1-100%5\nID + 0\n--array=1-25%5\nID + 100\n");
  EXPECT_EQ(handIn(" --chunk 20 --tasks 3,7-9,99-102,250").output, "--array=1,5-6,13%5\nID + 0\n");
  EXPECT_THAT(handIn(" --chunk x").error, HasSubstr("--chunk: found 'x', wanted a number from 1 to 9999"));
  EXPECT_THAT(shell("REX=/nowhere share/ci/grade-slurm results 5").error,
              HasSubstr("REX: found '/nowhere', wanted the path of rex, such as /usr/bin/rex"));
  const ProcessResult refused = handIn(" --tasks 'x;y'");
  EXPECT_EQ(refused.exitCode, 64);
  EXPECT_THAT(refused.error, HasSubstr("--tasks: found 'x;y', wanted numbers such as 3,7-9"));
}

}  // namespace rex::cli::ci_files_test
