// `rex dev release`: the tree, what is said of it, and its proof on a tree whose build is a script.
#include "cli/command_schema.h"
#include "cli/instructor/dev_verbs.h"
#include "commands/built_project.h"
#include "support/expect_error.h"
#include "support/paths.h"

namespace rex::cli::dev_release_test {

using ::testing::HasSubstr;

class DevReleaseTest : public BuiltProject {
 protected:
  fs::path students() const { return root() / "students"; }
  Ended release(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"dev", "release", students().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  // A project whose program is the given script, with the name of the exercise as its second word.
  void makeBuildable(const std::string& script) const {
    write(root() / "CMakePresets.json",
          R"({"version": 3, "configurePresets": [{"name": "release", "generator": "Ninja",
              "binaryDir": "${sourceDir}/build/release"}]})");
    write(root() / "CMakeLists.txt",
          "cmake_minimum_required(VERSION 3.25)\nproject(small NONE)\n"
          "configure_file(src/program ${CMAKE_BINARY_DIR}/rex COPYONLY)\nadd_custom_target(rex)\n");
    write(root() / "src" / "program", "#!/bin/sh\n" + script);
    fs::permissions(root() / "src" / "program", fs::perms::owner_all);
  }
};

TEST_F(DevReleaseTest, WritesTheTreeAndSaysWhatItHolds) {
  const Ended ended = release();
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_TRUE(fs::exists(students() / "exercises/98-template/main.cpp"));
  EXPECT_FALSE(fs::exists(students() / "exercises/98-template/solution.cpp"));
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(students())) files += entry.is_regular_file();
  EXPECT_THAT(flat(ended.output), HasSubstr("holds 1 exercise, " + std::to_string(files) + " files, "));
  EXPECT_THAT(flat(ended.output), HasSubstr("lines of solutions, "));
  EXPECT_THAT(flat(ended.output), HasSubstr("no secret of the course (--secret-file)"));
  const Ended again = release();
  EXPECT_EQ(again.code, 64);
  EXPECT_THAT(flat(again.error), HasSubstr("will not overwrite: wanted an empty or new folder"));
}

TEST_F(DevReleaseTest, HoldsTheExercisesThatWereAskedFor) {
  fs::copy(exercise(), root() / "exercises" / "99-other", fs::copy_options::recursive);
  const Ended ended = release({"98"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(flat(ended.output), HasSubstr("holds 1 exercise, "));
  EXPECT_FALSE(fs::exists(students() / "exercises/99-other"));
  EXPECT_THAT(rex({"dev", "release", (root() / "x").string(), "97"}).error, HasSubstr("98-template"));
}

TEST_F(DevReleaseTest, HoldsTheExercisesThatAreOpenByADay) {
  const fs::path file = root() / "deadlines.toml";
  const auto until = [&](const std::string& time) {
    return release({"--until", time, "--deadlines", file.string()});
  };
  write(file, "[exercise.98-template]\nopening = 2026-12-01T08:00:00+01:00\n");
  EXPECT_THAT(flat(until("2026-11-30").error),
              HasSubstr("--until: found no exercise that opens by 2026-11-30"));
  EXPECT_EQ(until("2026-12-01T07:59:00+01:00").code, 64);
  EXPECT_THAT(flat(until("soon").error), HasSubstr("--until: found soon, wanted a day such as 2026-12-01"));
  EXPECT_EQ(until("2026-12-01").code, 0);
  EXPECT_TRUE(fs::exists(students() / "exercises/98-template/main.cpp"));
  fs::remove_all(students());
  write(file, "[all]\ngrace_minutes = 5\n");
  EXPECT_THAT(flat(until("2026-12-01").error),
              HasSubstr("deadlines.toml says no `opening` for them: 98-template"));
  EXPECT_THAT(
      flat(rex({"dev", "release", "x", "--until", "2026-12-01"}).error),
      HasSubstr("--until: found no file with openings, wanted --course FILE.toml or --deadlines FILE.toml"));
}

// A student's name is nobody's business here, and the secret of the course must not be forgotten.
TEST_F(DevReleaseTest, TakesTheSecretOfTheCourseAndLeavesItsRoster) {
  write(root() / "secret", "the secret of the course\n");
  write(root() / "course.toml",
        "secret_file = \"secret\"\nstudents = \"none.csv\"\n[[student]]\nid = \"a/b\"\n"
        "[exercise.98-template]\n");
  const Ended ended = release({"--course", (root() / "course.toml").string()});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(ended.error, "");
  EXPECT_THAT(flat(ended.output), HasSubstr(", the secret of the course"));
  fs::remove_all(students());
  write(exercise() / "README.md", "The key: the secret of THE COURSE\n");
  EXPECT_EQ(release({"--course", (root() / "course.toml").string()}).code, 1);
}

// They would write into the installation, or find nothing there to look for.
TEST(DevVerbs, NeedTheSourceTree) {
  const Project installed{.root = "course", .build = "lib", .installed = "share"};
  EXPECT_REX_ERROR(devNew(installed, "96-mine", {}), "rex dev new needs the source tree of rex");
  EXPECT_REX_ERROR(devStrip(installed, "98"), "rex dev strip needs the source tree of rex");
  EXPECT_REX_ERROR(devCheck(installed, {}), "rex dev check needs the source tree of rex");
  EXPECT_REX_ERROR(devRelease(installed, {.out = "out"}), "rex dev release needs the source tree of rex");
  EXPECT_REX_ERROR(devSite(installed, {.out = "out"}), "rex dev site needs the source tree of rex");
}

// The template itself is public, so the exercise needs a secret of its own.
TEST_F(DevReleaseTest, WritesNothingThatLeaks) {
  replace(exercise() / "solution.cpp", "const double s = std::sin(angle);",
          "const double s = std::sin(angle + 0 * 1234567);");
  write(exercise() / "README.md", "Use:\n\n    const double s =\n      std::sin( ANGLE + 0 * 1234567 );\n");
  const Ended ended = release();
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(
      flat(ended.error),
      HasSubstr("exercises/98-template/README.md:3: a line of the solution would reach students: found "
                "'const double s = std::sin(angle + 0 * 1234567);' of "
                "exercises/98-template/solution.cpp:"));
  EXPECT_THAT(ended.error, HasSubstr("Nothing was written: found 1 leak."));
  EXPECT_FALSE(fs::exists(students()));
}

TEST_F(DevReleaseTest, PrintsJson) {
  const Ended written = release({"--json"});
  EXPECT_EQ(written.code, 0) << written.error;
  EXPECT_EQ(schemaFaultsOf(written.output, "dev_release"), "");
  EXPECT_THAT(written.output, HasSubstr("\"exercises\":1,"));
  EXPECT_THAT(written.output, HasSubstr("\"leaks\":[],\"proven\":false}\n"));
  write(students() / "solution.cpp", "");
  const Ended scanned = rex({"dev", "release", "--scan", students().string(), "--json"});
  EXPECT_EQ(scanned.code, 1);
  EXPECT_EQ(schemaFaultsOf(scanned.output, "dev_release"), "");
  EXPECT_THAT(scanned.output, HasSubstr("{\"written\":null,"));
  EXPECT_THAT(scanned.output, HasSubstr("\"leaks\":[\"solution.cpp: "));
}

TEST_F(DevReleaseTest, LooksThroughAnyFolder) {
  fs::create_directory(root() / "handouts");
  write(root() / "handouts" / "a.txt", "The key: the secret of THE COURSE\n");
  write(root() / "secret", "the secret of the course\n");
  const std::string handouts = (root() / "handouts").string(), secret = (root() / "secret").string();
  EXPECT_EQ(rex({"dev", "release", "--scan", handouts}).code, 0);
  const Ended ended = rex({"dev", "release", "--scan", handouts, "--secret-file", secret});
  EXPECT_EQ(ended.code, 1);
  EXPECT_THAT(flat(ended.error), HasSubstr("a.txt:1: the secret of the course would reach students"));
  EXPECT_THAT(flat(ended.output), HasSubstr(", the secret of the course found 1 leak"));
  EXPECT_EQ(rex({"dev", "release", "--scan", (root() / "none").string()}).code, 64);
}

TEST_F(DevReleaseTest, TellsWrongUse) {
  EXPECT_THAT(rex({"dev", "release"}).error, HasSubstr("DIR is required"));
  EXPECT_EQ(rex({"dev", "release", students().string(), "--scan", "x"}).code, 64);
  EXPECT_THAT(rex({"dev", "release", students().string(), "--prov"}).error, HasSubstr("'--prove'"));
  const Ended ended = rex({"dev", "release", "/proc/students"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(flat(ended.error), HasSubstr("cannot write the student release: found "));
  write(root() / "short", "x\n");
  EXPECT_THAT(release({"--secret-file", (root() / "short").string()}).error, HasSubstr("is too short"));
  EXPECT_FALSE(fs::exists(students()));
}

TEST_F(DevReleaseTest, ProvesThatTheTreeWorksAlone) {
  const std::string good = "case $1 in test) exit 1;; run) mkdir -p out/$2; : >out/$2/a.png;; esac\n";
  const std::pair<std::string, std::string> cases[] = {
      {good, ""},
      {"[ $1 != test ]\n", "drew no picture"},
      {"[ $1 = list ] || echo strange\n", "build/release/rex test 98-template: found exit code 0, wanted 1"},
      {"echo broken; exit 5\n", "build/release/rex list: found exit code 5, wanted 0"}};
  for (const auto& [script, message] : cases) {
    makeBuildable(script);
    fs::remove_all(students());
    const Ended ended = release({"--prove"});
    EXPECT_EQ(ended.code, message.empty() ? 0 : 3) << script;
    EXPECT_THAT(flat(ended.error), HasSubstr(message)) << script;
    EXPECT_EQ(ended.output.find("proven") != std::string::npos, message.empty());
    EXPECT_FALSE(fs::exists(students() / "build")) << "a copy is built";
  }
}

TEST_F(DevReleaseTest, TakesTheExercisesTheTitleAndTheDatesOfACourse) {
  fs::copy(exercise(), root() / "exercises" / "99-other", fs::copy_options::recursive);
  fs::copy(sourcePath("share/site"), root() / "share" / "site");
  const std::string course = (root() / "course.toml").string(), site = (root() / "site").string();
  write(course,
        "title = \"Robots <1>\"\ntime_zone = \"+01:00\"\n[exercise.98-template]\n"
        "opening = 2026-12-01T08:00:00+01:00\ndeadline = 2026-12-08T23:59:00+01:00\n");
  EXPECT_EQ(release({"--course", course}).code, 0);
  EXPECT_TRUE(fs::exists(students() / "exercises/98-template"));
  EXPECT_FALSE(fs::exists(students() / "exercises/99-other"));
  fs::remove_all(students());
  EXPECT_THAT(flat(release({"--course", course, "--until", "2026-11-30"}).error),
              HasSubstr("--until: found no exercise that opens by 2026-11-30"));
  EXPECT_EQ(release({"--course", course, "--until", "2026-12-01"}).code, 0);
  const Ended ended = rex({"dev", "site", site, "--course", course});
  EXPECT_EQ(ended.code, 0) << ended.error;
  const std::string index = fileText(root() / "site" / "index.html");
  EXPECT_THAT(index, HasSubstr("<h1>Robots &#60;1&#62;</h1>"));
  EXPECT_THAT(index, HasSubstr("<td>2026-12-01T08:00:00+01:00</td><td>2026-12-08T23:59:00+01:00</td>"));
  EXPECT_THAT(index, ::testing::Not(HasSubstr("99-other")));
  EXPECT_FALSE(fs::exists(root() / "site/exercises/99-other.html"));
}

TEST_F(DevReleaseTest, WritesPagesOfTheCourse) {
  fs::copy(sourcePath("share/site"), root() / "share" / "site");
  const std::string site = (root() / "site").string();
  const Ended ended = rex({"dev", "site", site, "--json"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(schemaFaultsOf(ended.output, "dev_site"), "");
  EXPECT_TRUE(fs::exists(root() / "site" / "exercises" / "98-template.html"));
  EXPECT_EQ(rex({"dev", "site", site}).code, 64);
  fs::remove_all(site);
  EXPECT_THAT(rex({"dev", "site", site}).output, HasSubstr("2 pages, 0.0 MB, nothing leaks: open "));
}

}  // namespace rex::cli::dev_release_test
