#include "cli/student/course_folder.h"

#include <cstdlib>

#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/sha256.h"
#include "cli/template_project.h"

namespace rex::cli {
namespace {

using ::testing::HasSubstr;

// An installed rex with one exercise, and a course folder beside it.
class CourseFolder : public TemplateProject {
 protected:
  void SetUp() override {
    TemplateProject::SetUp();
    ::setenv("XDG_CACHE_HOME", (root() / "cache").c_str(), 1);
    fs::create_directories(root() / "share" / "course" / ".vscode");
    write(root() / "share" / "course" / "README.md", "Exercises\n");
    write(root() / "share" / "course" / ".vscode" / "tasks.json", "{}\n");
    fs::copy(exercise() / "main.cpp", exercise() / "starter.cpp");
    // Courses in which something is compiled are in tests/commands.
    for (const char* folder : {"student", "exercises/98-template"}) fs::create_directories(build() / folder);
    write(
        build() / "exercises" / "98-template" / "build.json",
        R"({"compiler": "/bin/false", "compile_flags": ["-std=c++20"], "link_flags": [], "worker_object": "",
            "grader": "", "libraries": [], "functions": ["rotated"]})");
    write(
        build() / "student" / "program.json",
        R"({"compiler": "/bin/false", "compile_flags": [], "link_flags": [], "prefix": "", "source_folder": "",
            "libraries": []})");
  }

  fs::path course() const { return root() / "course"; }
  fs::path mine(const std::string& name) const { return course() / "exercises" / "98-template" / name; }

  // As from a folder of the course, or from the parent if there is none yet.
  Ended installed(const std::vector<std::string>& arguments) const {
    const fs::path here = fs::exists(course()) ? course() : root();
    return rexWith({.root = here, .build = build(), .installed = root()}, arguments);
  }
  void init() const {
    const Ended ended = installed({"init", course().string()});
    ASSERT_EQ(ended.code, 0) << ended.error;
  }
};

TEST_F(CourseFolder, GetsWhatStudentsNeedAndNothingElse) {
  init();
  for (const char* name : {"main.cpp", "exercise.h", "exercise.toml", "README.md"})
    EXPECT_TRUE(fs::exists(mine(name))) << name;
  for (const char* name : {"check.cpp", "solution.cpp", "starter.cpp", "wrong.cpp", "seen.txt"})
    EXPECT_FALSE(fs::exists(mine(name))) << name;
  EXPECT_TRUE(fs::exists(course() / ".vscode" / "tasks.json"));
  EXPECT_TRUE(fs::exists(course() / kCourseFile));
}

TEST_F(CourseFolder, TellsEditorsHowFilesAreCompiled) {
  init();
  const std::string commands = fileText(course() / "compile_commands.json");
  EXPECT_THAT(commands, HasSubstr(mine("main.cpp").string()));
  EXPECT_THAT(commands, HasSubstr("-std=c++20"));
}

TEST_F(CourseFolder, IsMadeOnlyWhereNothingIs) {
  write(root() / "course", "a file");
  EXPECT_THAT(flat(installed({"init", course().string()}).error), HasSubstr("will not overwrite"));
  fs::remove(root() / "course");
  init();
  const Ended again = installed({"init", course().string()});
  EXPECT_EQ(again.code, 64);
  EXPECT_THAT(flat(again.error), HasSubstr("is a course folder already: wanted `rex update` in it"));
}

TEST_F(CourseFolder, SaysWhyItCannotBeMade) {
  write(root() / "file", "text");
  const Ended ended = installed({"init", (root() / "file" / "course").string()});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("cannot fill the course folder: found Not a directory"));
}

TEST_F(CourseFolder, WorksWithoutAPreparedCompiler) {
  const Ended ended = installed({"init", course().string()});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(ended.output, HasSubstr("has 1 exercise, in"));
  EXPECT_THAT(flat(ended.error),
              HasSubstr("Compiling will take longer: /bin/false: the compiler cannot read the library"));
}

// Until 0.3.0 each folder had its own.
TEST_F(CourseFolder, SharesThePreparedCompilerWithOthersOfItsUser) {
  write(course() / ".rex" / "prefix.h", "old");
  write(course() / ".rex" / "prefix.h.gch", "old");
  EXPECT_EQ(installed({"init", course().string()}).code, 0);
  EXPECT_FALSE(fs::exists(course() / ".rex" / "prefix.h"));
  EXPECT_FALSE(fs::exists(course() / ".rex" / "prefix.h.gch"));
  const Project here{.root = course(), .build = build(), .installed = root()};
  EXPECT_EQ(fileText(prefixFile(here)), "#include \"course/course.h\"\n");
  EXPECT_THAT(prefixFile(here).string(), ::testing::StartsWith((root() / "cache" / "rex").string()));
  const Project other{.root = course(), .build = build(), .installed = "elsewhere"};
  EXPECT_NE(prefixFile(other), prefixFile(here)) << "another rex";
  const Project tree{.root = root(), .build = build()};
  EXPECT_EQ(prefixFile(tree), "");
}

TEST_F(CourseFolder, IsMadeByAnInstalledRexOnly) {
  for (const char* command : {"update", "init"}) {
    const Ended ended = command == std::string("init") ? rex({command, course().string()}) : rex({command});
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error), HasSubstr("found a source tree"));
  }
}

TEST_F(CourseFolder, IsNeededForExercises) {
  fs::create_directories(course());
  EXPECT_THAT(flat(installed({"test", "98"}).error), HasSubstr("there are no exercises here"));
  EXPECT_EQ(installed({"test", "98"}).code, 64);
  EXPECT_THAT(installed({}).output, HasSubstr("`rex init course` makes a folder"));
  EXPECT_THAT(installed({"list"}).output, HasSubstr("`rex init course` makes a folder"));
  EXPECT_THAT(flat(installed({"update"}).error), HasSubstr("there is no course folder here"));
}

TEST_F(CourseFolder, IsUpdatedWithoutTouchingTheStudentsFile) {
  init();
  write(mine("main.cpp"), kGood);
  EXPECT_THAT(installed({"update"}).output, HasSubstr("Everything is as rex"));
  write(exercise() / "README.md", "new text\n");
  write(exercise() / "main.cpp", "// a new start\n");
  fs::create_directories(root() / "exercises" / "97-new");
  fs::copy(exercise() / "exercise.toml", root() / "exercises" / "97-new" / "exercise.toml");
  const Ended ended = installed({"update"});
  EXPECT_THAT(ended.output, HasSubstr("new        exercises/97-new/exercise.toml"));
  EXPECT_THAT(ended.output, HasSubstr("changed    exercises/98-template/README.md"));
  EXPECT_THAT(ended.output, HasSubstr("exercises/98-template/main.cpp is handed out differently now"));
  EXPECT_EQ(fileText(mine("main.cpp")), kGood);
  EXPECT_EQ(fileText(mine("README.md")), "new text\n");
}

TEST_F(CourseFolder, KeepsContractsAndChangedFilesBesideNewOnes) {
  init();
  const std::string contract = fileText(mine("exercise.h"));
  write(mine("README.md"), "my notes\n");
  EXPECT_THAT(flat(installed({"update"}).output),
              HasSubstr("yours exercises/98-template/README.md is not as it was handed out; it stays"));
  EXPECT_EQ(fileText(mine("README.md")), "my notes\n");
  write(exercise() / "exercise.h", contract + "// more\n");
  write(exercise() / "README.md", "new text\n");
  const Ended ended = installed({"update"});
  EXPECT_THAT(ended.output, HasSubstr("exercise.h; the one before is exercise-" REX_VERSION ".h"));
  EXPECT_EQ(fileText(mine("exercise-" REX_VERSION ".h")), contract);
  EXPECT_EQ(fileText(mine("README-" REX_VERSION ".md")), "my notes\n");
  write(exercise() / "exercise.h", contract);
  EXPECT_THAT(installed({"update"}).output, HasSubstr("exercise-" REX_VERSION "-2.h"));
}

// An instructor's rex keeps no starter.cpp: its main.cpp is the copy.
TEST_F(CourseFolder, ResetsFromTheMainOfTheInstalledRex) {
  fs::remove(exercise() / "starter.cpp"), fs::remove(exercise() / "solution.cpp");
  init();
  const std::string handedOut = fileText(mine("main.cpp"));
  write(mine("main.cpp"), kGood);
  const Ended ended = installed({"reset", "98"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(fileText(mine("main.cpp")), handedOut);
  EXPECT_EQ(fileText(mine("main.backup-1.cpp")), kGood);
}

TEST_F(CourseFolder, NamesWhatIsNotBuiltAndTakesNoWorkFolders) {
  fs::create_directories(root() / "exercises" / "97-new");
  fs::copy(exercise() / "exercise.toml", root() / "exercises" / "97-new" / "exercise.toml");
  fs::create_directories(exercise() / "rex-work-abc123");
  write(exercise() / "checks.h", "double answer();\n");
  write(exercise() / "rex-work-abc123" / "main.cpp", "int main() {}\n");
  const Ended made = installed({"init", course().string()});
  EXPECT_EQ(made.code, 0) << made.error;
  EXPECT_THAT(flat(made.error),
              HasSubstr("97-new is not built in this rex: it can be read, not run or graded"));
  EXPECT_FALSE(fs::exists(mine("rex-work-abc123")) || fs::exists(mine("checks.h")));
  EXPECT_THAT(flat(installed({"list"}).output), HasSubstr("(not built in this rex)"));
}

TEST_F(CourseFolder, HasTextsForAnInstalledRex) {
  write(exercise() / "README.md", "`scripts/rex hint 98`\n\n    scripts/rex run 98\n");
  write(exercise() / "exercise.h", "// scripts/rex run 98\n");
  init();
  EXPECT_EQ(fileText(mine("README.md")), "`rex hint 98`\n\n    rex run 98\n");
  EXPECT_EQ(fileText(mine("exercise.h")), "// scripts/rex run 98\n");
}

TEST_F(CourseFolder, HasDocumentsThatNameOnlyWhatIsInIt) {
  EXPECT_FALSE(handOut(homeFolder(), course()).empty());
  const std::vector<std::string> command = {sourcePath("scripts/check-links").string(), course().string()};
  const ProcessResult whole = runProcess(command);
  EXPECT_TRUE(whole.ok()) << whole.output;
  fs::remove(course() / "exercises" / "01-kinematics" / "show.cpp");
  EXPECT_EQ(runProcess(command).output,
            "exercises/01-kinematics/README.md: no such file beside it: show.cpp\n");
}

TEST_F(CourseFolder, SaysWhatIsNoLongerPartOfTheCourse) {
  init();
  fs::remove(exercise() / "README.md");
  EXPECT_THAT(installed({"update"}).output, HasSubstr("README.md is no longer part of the course"));
  EXPECT_TRUE(fs::exists(mine("README.md")));
}

// As rex 0.3.0 did.
TEST_F(CourseFolder, LosesHeadersOfChecksThatNobodyChanged) {
  init();
  nlohmann::json record = nlohmann::json::parse(fileText(course() / kCourseFile));
  for (const char* name : {"check.cpp", "old_checks.h", "my_checks.h", "pictures.csv"}) {
    write(mine(name), "double answer();\n");
    record["files"][std::string("exercises/98-template/") + name] = sha256("double answer();\n");
  }
  write(course() / kCourseFile, record.dump());
  write(mine("my_checks.h"), "double answer();  // mine\n");
  write(mine("own.h"), "double own();\n");
  const Ended ended = installed({"update"});
  EXPECT_THAT(ended.output,
              HasSubstr("removed    exercises/98-template/check.cpp: it belongs to the checks"));
  EXPECT_THAT(ended.output,
              HasSubstr("removed    exercises/98-template/old_checks.h: it belongs to the checks"));
  EXPECT_THAT(ended.output, HasSubstr("left       exercises/98-template/my_checks.h is no longer part"));
  EXPECT_THAT(ended.output, HasSubstr("left       exercises/98-template/pictures.csv is no longer part"));
  EXPECT_FALSE(fs::exists(mine("old_checks.h")) || fs::exists(mine("check.cpp")));
  EXPECT_TRUE(fs::exists(mine("my_checks.h")) && fs::exists(mine("own.h")) &&
              fs::exists(mine("pictures.csv")));
  EXPECT_THAT(installed({"update"}).output, HasSubstr("Everything is as rex"));
}

TEST_F(CourseFolder, ReportsADamagedRecord) {
  init();
  write(course() / kCourseFile, "{");
  const Ended ended = installed({"update"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("cannot read what was handed out"));
}

}  // namespace
}  // namespace rex::cli
