// rex run FILE.cpp: programs that are no exercises.
#include <chrono>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "commands/built_project.h"
#include "support/paths.h"

namespace rex::cli::run_file_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;

// Programs lie outside the project. Its build folder has the description of the real one, and a build.ninja
// that notes which targets were asked for.
class RunFile : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    addProgramDescription();
    std::ofstream ninja(build() / "build.ninja");
    ninja << "rule note\n  command = echo $out >> asked\n";
    const nlohmann::json described = nlohmann::json::parse(fileText(build() / "student/program.json"));
    for (const auto& library : described.at("libraries"))
      ninja << "build " << library.at("target").get<std::string>() << ": note\n";
    ninja << "build rex_student_prefix: note\nbuild 98-template_ready: note\n";
  }

  std::string in(const std::string& name) const { return (outside_.path() / name).string(); }
  void program(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(in(name)).parent_path());
    write(in(name), text);
  }
  std::set<std::string> asked() const {
    std::istringstream lines(fileText(build() / "asked"));
    std::set<std::string> targets;
    for (std::string line; std::getline(lines, line);) targets.insert(line);
    return targets;
  }

 private:
  TemporaryFolder outside_;
};

constexpr const char* kWritesItsArguments =
    "#include <fstream>\n"
    "int main(int argc, char** argv) {\n"
    "  std::ofstream out(\"arguments.txt\");\n"
    "  for (int i = 1; i < argc; ++i) out << argv[i] << '\\n';\n"
    "}\n";

TEST_F(RunFile, WarnsBeforeItRunsAHandIn) {
  program("in/zoe/98-template/main.cpp", kWritesItsArguments);
  const std::string warning = "runs with your rights: it may read and change all that you may.";
  EXPECT_THAT(flat(rex({"run", in("in/zoe/98-template/main.cpp"), "-o", in("shown")}).error),
              Not(HasSubstr(warning)));
  program("in/import.json", "{}");
  const Ended ended = rex({"run", in("in/zoe/98-template/main.cpp"), "-o", in("shown")});
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(flat(ended.error), HasSubstr(warning));
}

TEST_F(RunFile, CompilesADemonstrationOnceUntilAFileOfItChanges) {
  const fs::path folder = root() / "share" / "demonstrations";
  const fs::path kept = root() / ".rex" / "demonstrations" / "swing";
  fs::create_directories(folder);
  // The compiler of fixtures looks at no header.
  fs::copy_file(buildPath("student/program.json"), build() / "student" / "program.json",
                fs::copy_options::overwrite_existing);
  write(folder / "swing.cpp",
        "// Chapter 3: A swing. It swings.\n#include <cstdio>\n#include \"times.h\"\n"
        "int main() { std::printf(\"swings %d times\", times); }\n");
  write(folder / "times.h", "constexpr int times = 3;\n");
  const auto outputOfDemo = [&] { return rex({"demo", "swing", "-o", in("replay")}).output; };
  EXPECT_THAT(outputOfDemo(), HasSubstr("swings 3 times"));
  const auto compiled = fs::last_write_time(kept);
  EXPECT_THAT(outputOfDemo(), HasSubstr("swings 3 times"));
  EXPECT_EQ(fs::last_write_time(kept), compiled);
  write(folder / "times.h", "constexpr int times = 4;\n");
  // Older than the program, as the headers of another rex may be.
  fs::last_write_time(folder / "times.h", compiled - std::chrono::hours(1));
  EXPECT_THAT(outputOfDemo(), HasSubstr("swings 4 times"));
  write(folder / "times.h", "constexpr int ");
  EXPECT_NE(rex({"demo", "swing", "-o", in("replay")}).code, 0);
  fs::remove(kept.string() + ".made-from");  // as when a power cut came before it was written
  write(folder / "times.h", "constexpr int times = 5;\n");
  EXPECT_THAT(outputOfDemo(), HasSubstr("swings 5 times"));
  // As if it was saved while the compiler ran.
  fs::last_write_time(folder / "times.h", fs::file_time_type::clock::now() + std::chrono::hours(1));
  EXPECT_THAT(outputOfDemo(), HasSubstr("swings 5 times"));
  EXPECT_FALSE(fs::exists(kept.string() + ".made-from"));
}

TEST_F(RunFile, WritesAPageOfEachDemonstrationAndAnIndex) {
  const fs::path folder = root() / "share" / "demonstrations";
  fs::create_directories(folder);
  const std::string program =
      "#include <cstdlib>\n#include <fstream>\n"
      "int main() { std::ofstream(\"swing.html\") << std::getenv(\"REX_LIVE_ABOUT\"); }\n";
  write(folder / "swing.cpp",
        "// Chapter 3: A swing. It swings.\n// Slides: 3:4\n// Formula: |x| = a\n"
        "// Try: Push it.\n" +
            program);
  write(folder / "broken.cpp", "// Chapter 4: None. Nothing.\nint main() { return 1; }\n");
  write(folder / "unfinished.cpp", "// Chapter 5: None. Nothing.\nint main() {\n");
  const Ended ended = rex({"demo", "-o", in("pages")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(flat(ended.error), HasSubstr("Full log: " + in("pages/unfinished.build.log")));
  EXPECT_THAT(fileText(in("pages/unfinished.build.log")), HasSubstr("error: "));
  EXPECT_FALSE(fs::exists(in("pages/broken.build.log")));
  EXPECT_EQ(fileText(in("pages/swing.html")),
            "A swing\nabout\tIt swings.\ntry\tPush it.\nformula\t|x| = a\nslides\t3:4");
  const std::string index = fileText(in("pages/index.html"));
  EXPECT_THAT(index, HasSubstr("<a href=\"swing.html\">A swing</a>: |x| = a"));
  EXPECT_THAT(index, HasSubstr("Push it."));
  EXPECT_THAT(index, AllOf(HasSubstr("None"), Not(HasSubstr("broken.html"))));
}

TEST_F(RunFile, NamesResultsByTheFileOrByTheFolderOfAMain) {
  program("try.cpp", kWritesItsArguments);
  program("prog/main.cpp", kWritesItsArguments);
  const Ended ended = rex({"run", in("try.cpp"), "--", "--fast", "3", "-o"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(ended.output, HasSubstr("arguments.txt"));
  EXPECT_EQ(fileText(outOf("try") / "arguments.txt"), "--fast\n3\n-o\n");
  EXPECT_EQ(rex({"run", in("prog/main.cpp")}).code, 0);
  EXPECT_EQ(fileText(outOf("prog") / "arguments.txt"), "");
  EXPECT_EQ(rex({"run", in("try.cpp"), "-o", in("there")}).code, 0);
  EXPECT_TRUE(fs::exists(in("there/arguments.txt")));
  for (const auto& entry : fs::directory_iterator(build() / "student"))
    EXPECT_FALSE(entry.path().filename().string().starts_with("rex-work-")) << "it tidies up";
}

// A program finds headers beside it, and starts from the precompiled header of all students.
TEST_F(RunFile, UsesTheLibraryAndHeadersBesideIt) {
  program("prog/mine.h", "#pragma once\ninline int mine() { return 7; }\n");
  program("prog/main.cpp",
          "#include <fstream>\n#include \"course/course.h\"\n#include \"estimation/kalman_filter.h\"\n"
          "#include \"mine.h\"\n"
          "int main() {\n"
          "  rex::Simulator S(\"pegArm.ors\");\n"
          "  const rex::Gaussian x{.mean = Eigen::VectorXd::Zero(1), .covariance = "
          "Eigen::MatrixXd::Identity(1, 1)};\n"
          "  std::ofstream(\"sum.txt\") << S.getJointDimension() + mine() + rex::toRoot(x).L(0, 0);\n"
          "}\n");
  const Ended ended = rex({"run", in("prog/main.cpp")});
  EXPECT_EQ(ended.code, 0) << ended.error << fileText(outOf("prog") / "build.log");
  EXPECT_EQ(fileText(outOf("prog") / "sum.txt"), "11");
  EXPECT_THAT(asked(), IsSupersetOf({"rex_course", "rex_render", "rex_estimation"}));
  if (fs::exists(buildPath("student/prefix.h"))) {  // not with the sanitizers
    EXPECT_THAT(asked(), Contains("rex_student_prefix"));
  }
  for (const char* other : {"rex_planning", "rex_locomotion", "rex_inverse_kinematics", "98-template_ready"})
    EXPECT_THAT(asked(), Not(Contains(other)));
}

TEST_F(RunFile, BuildsLittleForLittle) {
  program("plain.cpp", "#include \"base/rng.h\"\nint main() { return rex::Rng(1).uniform(0, 1) > 1; }\n");
  EXPECT_EQ(rex({"run", in("plain.cpp")}).code, 0);
  EXPECT_EQ(asked(), (std::set<std::string>{"rex_base"}));
  program("none.cpp", "int main() {}\n");
  fs::remove(build() / "asked");
  EXPECT_EQ(rex({"run", in("none.cpp")}).code, 0);
  EXPECT_FALSE(fs::exists(build() / "asked"));
}

// A member of Simulator whose body is in a library of its own.
TEST_F(RunFile, FindsLibrariesByTheirSymbols) {
  program("reach.cpp",
          "#include \"course/course.h\"\n"
          "int main() {\n"
          "  const rex::Simulator S(\"pegArm.ors\");\n"
          "  return S.inverseKinematics(\"peg\", S.kinematicsPos(\"peg\")).isReached ? 0 : 1;\n"
          "}\n");
  const Ended ended = rex({"run", in("reach.cpp")});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(asked(), IsSupersetOf({"rex_course_inverse_kinematics", "rex_inverse_kinematics"}));
}

TEST_F(RunFile, ExplainsErrorsAsForExercises) {
  program("wrong.cpp", "#include \"course/course.h\"\nint main() {\n  rex::Simulatr S(\"man.ors\");\n}\n");
  const Ended ended = rex({"run", in("wrong.cpp")});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.error, HasSubstr("wrong.cpp:3:8: error: "));
  EXPECT_THAT(ended.error, HasSubstr("    rex::Simulatr S(\"man.ors\");\n"));
  EXPECT_THAT(ended.error, HasSubstr("build.log"));
  EXPECT_THAT(fileText(outOf("wrong") / "build.log"), HasSubstr("Simulatr"));
  program("open.cpp", "int missing();\nint main() { return missing(); }\n");
  EXPECT_THAT(rex({"run", in("open.cpp")}).error, HasSubstr("'missing' is declared but not defined here"));
}

TEST_F(RunFile, SaysHowTheProgramEnded) {
  program("ends.cpp",
          "#include <csignal>\nint main(int argc, char**) {\n  if (argc > 1) return 5;\n"
          "  std::raise(SIGKILL);\n}\n");
  const Ended crashed = rex({"run", in("ends.cpp")});
  EXPECT_EQ(crashed.code, 1);
  EXPECT_THAT(crashed.error, HasSubstr("signal 9 (Killed)"));
  EXPECT_THAT(crashed.error, Not(HasSubstr("rex debug")));
  EXPECT_THAT(rex({"run", in("ends.cpp"), "once"}).error, HasSubstr("exit code 5"));
}

TEST_F(RunFile, SaysInWhichLineAProgramWasWhenItEnded) {
  program("lost.cpp",
          "#include <vector>\nnamespace {\nint searched(const std::vector<int>& all, int start) {\n"
          "  int found = start;\n  while (all[found % 3] > 0)\n    found = (found + 3) % 9;\n  return "
          "found;\n}\n}\n"
          "int main(int argc, char**) {\n  const std::vector<int> all = {1, 1, argc > 1};\n"
          "  return argc > 1 ? all.at(argc + 5) : searched(all, argc);\n}\n");
  const Ended late = rex({"run", in("lost.cpp"), "--time-limit", "1"});
  EXPECT_EQ(late.code, 1);
  EXPECT_THAT(late.error, HasSubstr("stopped after 1 s of CPU time"));
  EXPECT_THAT(
      flat(late.error),
      ::testing::ContainsRegex("After 1 s it is in line [56] of lost.cpp, in .*searched.*: an endless loop"));
  const Ended crashed = rex({"run", in("lost.cpp"), "--", "argument"});
  EXPECT_EQ(crashed.code, 1);
  EXPECT_THAT(flat(crashed.error), HasSubstr("It was in line 12 of lost.cpp, in main."));
}

TEST_F(RunFile, AMainOfAnExerciseIsThatExercise) {
  write(exercise() / "main.cpp", kGood);
  for (const std::string& path : {(exercise() / "main.cpp").string(), std::string("98-template/main.cpp")}) {
    EXPECT_EQ(rex({"run", path}).code, 0) << path;
    EXPECT_TRUE(fs::exists(out())) << path;
    fs::remove_all(out());
  }
  // Another file of its folder is a program like any other.
  write(exercise() / "try.cpp", "#include \"exercise.h\"\nint main() {}\n");
  EXPECT_EQ(rex({"run", exercise() / "try.cpp"}).code, 0);
  EXPECT_TRUE(fs::exists(outOf("try")));
}

TEST_F(RunFile, AnswersWrongUse) {
  program("try.cpp", "int main() {}\n");
  program("98-template.cpp", "int main() {}\n");
  const auto expectUsage = [&](std::vector<std::string> arguments, const std::string& text) {
    arguments.insert(arguments.begin(), "run");
    const Ended ended = rex(arguments);
    EXPECT_EQ(ended.code, 64);
    EXPECT_THAT(flat(ended.error), HasSubstr(text));
  };
  expectUsage({"98-tempalte"}, "no exercise is called '98-tempalte'");
  expectUsage({"98-tempalte"}, "did you mean '98-template'");
  expectUsage({in("tri.cpp")},
              "tri.cpp': found no such file, wanted an exercise, or the path of a .cpp file "
              "(did you mean 'try.cpp'?)");
  fs::create_directories(in("folder.cpp"));
  expectUsage({in("folder.cpp")}, "found a folder or device");
  expectUsage({in("98-template.cpp")}, "with those of the exercise 98-template: wanted another folder");
  expectUsage({in("try.cpp"), "--solution"}, "--solution: found ");
  expectUsage({"98", "more"}, "rex run: unknown argument 'more'");
  EXPECT_EQ(rex({"run", in("98-template.cpp"), "-o", in("there")}).code, 0);
}

}  // namespace rex::cli::run_file_test
