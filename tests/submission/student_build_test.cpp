#include "submission/student_build.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "base/process.h"
#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/honest_styles.h"
#include "support/rounds.h"
#include "support/slow_sources.h"
#include "support/temporary_folder.h"
#include "support/tiny_disk.h"

namespace rex::submission::student_build_test {

using std::filesystem::path;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

// A tiny exercise: its library knows answer(), its worker prints what the student's twice(21) gives.
class StudentBuildTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryFolder>();
    write(shared_->path() / "lib.cpp", "namespace rex { int answer(int a) { return a + 1; } }\n");
    write(shared_->path() / "worker.cpp",
          "#include <cstdio>\nint twice(int);\nint studentMain();\nint main() { std::printf(\"%d\", "
          "twice(21)); }\n");
    write(shared_->path() / "exercise" / "exercise.h",
          "#pragma once\nint twice(int a);\nnamespace rex { int answer(int a); }\n");
    write(shared_->path() / "exercise" / "answer_internal.h",
          "inline int inlined(int a) { return a + 1; }\n");
    write(shared_->path() / "src" / "part" / "part.h", "#pragma once\ninline int part() { return 1; }\n");
    write(shared_->path() / "src" / "part" / "part.cpp", "namespace rex { int whole() { return 2; } }\n");
    build({"-shared", "-fPIC", "lib.cpp", "-o", "librex_student.so"});
    build({"-c", "worker.cpp", "-o", "worker.o"});
  }
  static void TearDownTestSuite() { shared_.reset(); }

  static void write(const path& file, const std::string& text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }

  static void build(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "g++");
    const ProcessResult result = runProcess(arguments, {.directory = shared_->path()});
    ASSERT_TRUE(result.ok()) << result.error;
  }

  Toolchain toolchain() const {
    return {.compiler = "g++",
            .flags = {"-std=c++20", "-O1", "-Wall", "-isystem", "/usr/include/eigen3", "-iquote",
                      shared_->path() / "exercise", "-isystem", shared_->path() / "src"},
            .linkFlags = {"-Wl,-rpath," + shared_->path().string()},
            .workerObject = shared_->path() / "worker.o",
            .grader = {},
            .libraries = {shared_->path() / "librex_student.so"}};
  }

  StudentObject compileFile(const path& file, bool debug = false) const {
    return compileStudent(
        toolchain(), {{"rex::answer", "it is what you find out"}, {"rex::internal", "it is not for use"}},
        {.main = file,
         .workFolder = temporary_.path() / "work",
         .debug = debug,
         .publicHeadersOnly = true,
         .graded = true});
  }

  StudentObject compile(const std::string& source) const {
    write(temporary_.path() / "main.cpp", source);
    return compileFile(temporary_.path() / "main.cpp");
  }

  // A program in place of one of the compiler's.
  path script(const path& file, const std::string& text) const {
    write(temporary_.path() / file, "#!/bin/sh\n" + text);
    std::filesystem::permissions(temporary_.path() / file, std::filesystem::perms::owner_all);
    return temporary_.path() / file;
  }

  static std::string first(const std::vector<grading::CompileDiagnostic>& messages) {
    return messages.empty() ? "" : toString(messages.front());
  }

  TemporaryFolder temporary_;
  static std::unique_ptr<TemporaryFolder> shared_;
};
std::unique_ptr<TemporaryFolder> StudentBuildTest::shared_;

constexpr const char* kGood =
    "#include \"exercise.h\"\n#include <cstdio>\nint twice(int a) { return 2 * a; }\nint main() { "
    "std::puts(\"mine\"); }\n";

TEST_F(StudentBuildTest, BuildsWorkerAndProgramFromOneObject) {
  const StudentObject object = compile(kGood);
  ASSERT_TRUE(object.ok) << object.log;
  EXPECT_TRUE(object.messages.empty());
  EXPECT_EQ(object.source, kGood);
  const StudentProgram worker = linkWorker(toolchain(), object);
  ASSERT_TRUE(worker.ok) << worker.log;
  EXPECT_EQ(runProcess({worker.program}).output, "42");
  const StudentProgram program = linkProgram(toolchain(), object);
  ASSERT_TRUE(program.ok) << program.log;
  EXPECT_EQ(runProcess({program.program}).output, "mine\n");
}

// What draws for main() is linked where main() calls it, and asks of nobody else for the contract's
// functions.
TEST_F(StudentBuildTest, LinksWhatDrawsForMain) {
  const path source = temporary_.path() / "show.cpp", object = temporary_.path() / "show.o";
  write(source,
        "#include <cstdio>\nint twice(int a);\nint thrice(int a);\n"
        "void show() { std::printf(\"drawn %d\\n\", twice(4)); }\n"
        "void showMore() { thrice(1); }\n");
  build({"-ffunction-sections", "-c", source, "-o", object});
  Toolchain drawing = toolchain();
  drawing.show = temporary_.path() / "show.a";
  ASSERT_TRUE(runProcess({"ar", "rcs", drawing.show, object}).ok());
  EXPECT_TRUE(linkProgram(drawing, compile(kGood)).ok) << "main() shows nothing";
  const std::string both = "int twice(int a) { return 2 * a; }\nint thrice(int a) { return 3 * a; }\n";
  const StudentProgram program =
      linkProgram(drawing, compile("void show();\n" + both + "int main() { show(); }\n"));
  ASSERT_TRUE(program.ok) << program.log;
  EXPECT_EQ(runProcess({program.program}).output, "drawn 8\n");
  // A build for the sanitizers keeps main() in the worker.
  const StudentObject whole = compileStudent(
      drawing, {}, {.main = temporary_.path() / "main.cpp", .workFolder = temporary_.path() / "whole"});
  ASSERT_TRUE(whole.graded.empty());
  const StudentProgram worker = linkWorker(drawing, whole);
  EXPECT_TRUE(worker.ok) << worker.log;
  const StudentProgram without =
      linkProgram(drawing, compile("void show();\nint twice(int a) { return a; }\nint main() { show(); }\n"));
  EXPECT_FALSE(without.ok);
  EXPECT_THAT(first(without.messages), HasSubstr("'thrice' is declared but not defined here"));
}

// Two compilers make the same of a file as one does.
TEST_F(StudentBuildTest, CompilesTheGradedPartAlone) {
  const auto build = [&](const std::string& source, bool part) {
    write(temporary_.path() / "main.cpp", source);
    Toolchain shared = toolchain();
    shared.functions = {"twice"};
    shared.flags.emplace_back("-ffunction-sections");  // by which main() is told from the rest
    return compileStudent(shared, {{"rex::answer", "it is what you find out"}},
                          {.main = temporary_.path() / "main.cpp",
                           .workFolder = temporary_.path() / "work",
                           .publicHeadersOnly = true,
                           .graded = true,
                           .part = part});
  };
  const std::string head = "#include \"exercise.h\"\n#include <cstdio>\n";
  const auto hasMain = [](const StudentObject& one) {
    return runProcess({"nm", one.object}).output.find(" T main") != std::string::npos;
  };
  EXPECT_TRUE(hasMain(build(head + "int twice(int a) { return 2 * a; }\nint main() {}\n", true)))
      << "so little is compiled as it is";
  std::string talk;
  for (int k = 0; k < 20; ++k) talk += "  std::puts(\"what only main() needs\");\n";
  for (const std::string& body :
       {std::string(
            "int half(int a) { return a; }\nint twice(int a) { return half(a) + half(a); }\nint main() {}\n"),
        std::string("static int count = 0;\nint twice(int a) { return 2 * a + count; }\nint main() {}\n"),
        std::string("namespace {\nvoid unused() {}\nint once(int a) { int b; return a; }\n}\n"
                    "int twice(int a) { return once(a) + once(a); }\nint main() { int c; }\n"),
        std::string(
            "int twice(int a) { int b; if (a > 100) b = 1; return b > 3 ? a : 2 * a; }\nint main() {}\n"),
        std::string("int twice(int a) { return a + b; }\nint main() {}\n"),
        std::string("int twice(int a) { return 2 * a; }\nint main() { if (twice(1) > 1) twice(2); }\n"),
        std::string(
            "int twice(int a) { return 2 * a; }\nint main() {\n  if (twice(1) > 1)\n twice(2);\n }\n"),
        std::string("int twice(int a) { return 2 * a; }\n#define TEN 10 /* for\n  main */\nint main() {}\n"),
        std::string("void draw(int);\nint twice(int a) { return 2 * a; }\nvoid draw(int a) { int d = a; }\n"
                    "[[maybe_unused]] int main(int count, char**) { draw(count); }\n"),
        std::string("int twice(int a) { return 2 * a; }\nvoid main() {}\n"),
        std::string("int twice(int a) { return 2 * a; }\nint main() { return c; }\n"),
        std::string("int twice(int a) { return 2 * a; }\n#if 0\n}\n#endif\nint main() {}\n"),
        std::string("int twice(int a) { return rex::answer(a); }\nint main() {}\n"),
        std::string("int twice(int a) { return 2 * a; }\nint main() { return rex::answer(1); }\n"),
        std::string(
            "void asks() { rex::answer(1); }\nint twice(int a) { return 2 * a; }\nint main() { asks(); }\n"),
        std::string("#include \"answer_internal.h\"\nint twice(int a) { return 2 * a; }\nint main() {}\n")}) {
    const std::string source = head + body + "void talk() {\n" + talk + "}\n";
    const StudentObject one = build(source, false);
    const std::string worker = one.ok ? runProcess({linkWorker(toolchain(), one).program}).output : "";
    const StudentObject two = build(source, true);
    EXPECT_EQ(two.ok, one.ok) << body << two.log;
    EXPECT_EQ(two.exitCode, one.exitCode) << body;
    EXPECT_EQ(two.log, one.log) << body;
    ASSERT_EQ(two.messages.size(), one.messages.size()) << body << two.log;
    if (!one.ok) continue;
    EXPECT_EQ(runProcess({linkWorker(toolchain(), two).program}).output, worker) << body;
    const bool isWhole = body.find_first_of("#[") != body.npos || body.find("asks") != body.npos;
    EXPECT_EQ(hasMain(two), isWhole) << body;
  }
}

TEST_F(StudentBuildTest, DebugInformationNamesTheStudentsOwnFile) {
  write(temporary_.path() / "main.cpp", kGood);
  const StudentObject object = compileFile(temporary_.path() / "main.cpp", true);
  ASSERT_TRUE(object.ok);
  const std::string lines = runProcess({"readelf", "--debug-dump=info", object.object.string()}).output;
  EXPECT_THAT(lines, HasSubstr(temporary_.path().string() + "\n"));
  EXPECT_THAT(lines, ::testing::Not(HasSubstr("/work\n")));
}

TEST_F(StudentBuildTest, ReportsTheFirstErrorInOneLine) {
  const StudentObject object = compile("int twice(int a) {\n  return twce;\n}\n");
  EXPECT_FALSE(object.ok);
  EXPECT_EQ(object.exitCode, 1);
  EXPECT_EQ(first(object.messages),
            "main.cpp:2:10: error: 'twce' was not declared in this scope; did you mean 'twice'?");
  EXPECT_THAT(object.log, HasSubstr("main.cpp:2:10: error:"));
}

// The same file, the same program: on another day, in another folder's time, in another time zone.
TEST_F(StudentBuildTest, KnowsNoDate) {
  const std::string source =
      "#include \"exercise.h\"\nextern const char kDate[] = \"<\" __DATE__ \">\", kTime[] = \"<\" __TIME__ "
      "\">\", "
      "kFile[] = \"<\" __TIMESTAMP__ \">\";\nint twice(int a) { return 2 * a + (__TIME__[7] - '0'); }\nint "
      "main() {}\n";
  std::set<std::string> objects;
  const char* set = std::getenv("TZ");
  const std::string before = set != nullptr ? set : "";
  for (const char* zone : {"UTC0", "Asia/Tokyo", "<-11>11"}) {
    ::setenv("TZ", zone, 1);
    const StudentObject object = compile(source);
    ASSERT_TRUE(object.ok) << object.log;
    const std::string bytes = readTextFile(object.object);
    for (const char* text : {"<Jan  1 1970>", "<00:00:00>", "<Thu Jan  1 00:00:00 1970>"})
      EXPECT_THAT(bytes, HasSubstr(text)) << zone;
    objects.insert(bytes);
    EXPECT_EQ(runProcess({linkWorker(toolchain(), object).program}).output, "42");
  }
  set != nullptr ? ::setenv("TZ", before.c_str(), 1) : ::unsetenv("TZ");
  EXPECT_EQ(objects.size(), 1u);
}

// A second of waiting between two builds changes nothing either.
TEST_F(StudentBuildTest, GivesTheSameObjectLater) {
  const std::string source =
      "const char* now() { return __DATE__ __TIME__ __TIMESTAMP__; }\nint twice(int) { return 0; }\n";
  const std::string first = readTextFile(compile(source).object);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  EXPECT_EQ(readTextFile(compile(source).object), first);
}

TEST_F(StudentBuildTest, KeepsWarnings) {
  const StudentObject object = compile("int twice(int a) {\n  int b;\n  return a;\n}\n");
  EXPECT_TRUE(object.ok);
  EXPECT_EQ(first(object.messages), "main.cpp:2:7: warning: unused variable 'b' [-Wunused-variable]");
}

TEST_F(StudentBuildTest, BlamesTheStudentsLineForAnErrorInsideALibraryHeader) {
  const StudentObject object = compile(
      "#include <Eigen/Core>\nEigen::Vector3d f(Eigen::Vector3d a, Eigen::Vector2d b) {\n  return a + "
      "b;\n}\n");
  EXPECT_THAT(first(object.messages), HasSubstr("main.cpp:3:"));
  EXPECT_THAT(first(object.messages), HasSubstr("YOU_MIXED_MATRICES_OF_DIFFERENT_SIZES (in Eigen/src/Core/"));
}

TEST_F(StudentBuildTest, SaysWhichFunctionIsMissing) {
  const StudentObject object = compile("int main() {}\n");
  ASSERT_TRUE(object.ok);
  const StudentProgram worker = linkWorker(toolchain(), object);
  EXPECT_FALSE(worker.ok);
  EXPECT_EQ(first(worker.messages), "main.cpp: error: 'twice' is declared but not defined here");
}

// Else a warning would speak of another file, or be silent. Nothing is compiled then.
TEST_F(StudentBuildTest, RefusesLineMarkers) {
  const std::string warns = "int twice(int a) { int unused; return 2 * a; }\n";
  for (const char* marker : {"#line 1 \"other.h\"\n", "# 1 \"vector\" 3\n", "%:line 900\n", "#/**/line 5\n",
                             "#line 1 \"x\"\n#error\n"}) {
    const StudentObject object = compile("#include \"exercise.h\"\n" + (marker + warns));
    EXPECT_FALSE(object.ok);
    ASSERT_EQ(object.messages.size(), 1u);
    EXPECT_THAT(toString(object.messages[0]),
                MatchesRegex("main.cpp:2:[13]: error: found a #line directive.*"))
        << marker;
    EXPECT_EQ(object.exitCode, 1);
  }
}

// As a part of itself it could be a header of the system, about which the compiler keeps silent.
TEST_F(StudentBuildTest, RefusesAFileThatIncludesItself) {
  for (const std::string name : {"\"main.cpp\"", "\"./main.cpp\"", "\"../work/main.cpp\"",
                                 "\"/proc/self/cwd/main.cpp\"", "__FILE__"}) {
    const StudentObject object =
        compile("#ifndef ONCE\n#define ONCE\n#include " + name +
                "\nint twice(int a) { return 2 * a; }\n#else\n#define PRAGMA(x) _Pragma(#x)\n"
                "#define PASTED(x, y) PRAGMA(GCC x##y)\nPASTED(system, _header)\nint f() { int b; return 1; "
                "}\n#endif\n");
    EXPECT_FALSE(object.ok);
    EXPECT_EQ(first(object.messages),
              "main.cpp:3:1: error: found an include of the file itself, wanted each of its lines once "
              "[line-marker]")
        << name;
  }
}

// No way around: what cannot be preprocessed is refused even if it compiles.
TEST_F(StudentBuildTest, RefusesWhatOnlyCompiles) {
  Toolchain odd = toolchain();
  odd.compiler =
      script("odd", "case \"$*\" in *' -E '*) echo 'error: no' >&2; exit 1;; esac\nexec g++ \"$@\"\n");
  write(temporary_.path() / "main.cpp", kGood);
  const StudentObject object = compileStudent(odd, {},
                                              {.main = temporary_.path() / "main.cpp",
                                               .workFolder = temporary_.path() / "work",
                                               .publicHeadersOnly = true});
  EXPECT_FALSE(object.ok);
  EXPECT_EQ(first(object.messages), "main.cpp: error: the compiler gave up: error: no");
}

TEST_F(StudentBuildTest, TakesWhatHonestPeopleWrite) {
  const auto styles = honestStyles();
  for (std::size_t k = 0; k < styles.size(); k += static_cast<std::size_t>(rounds(9, 1))) {
    const StudentObject object = compile(styles[k].second);
    EXPECT_TRUE(object.ok) << styles[k].first << "\n" << object.log;
  }
}

TEST_F(StudentBuildTest, RefusesForbiddenCalls) {
  const StudentObject object =
      compile("#include \"exercise.h\"\n\nint twice(int a) { return rex::answer(a); }\nint main() {}\n");
  EXPECT_FALSE(object.ok);
  EXPECT_EQ(
      first(object.messages),
      "main.cpp:3:32: error: calls rex::answer, which only main() may call in this exercise: it is what "
      "you find out. Write it yourself instead [forbidden-call]");
}

constexpr const char* kNotPublic =
    ": only public headers of the library, of the system, and those that the handed-out main.cpp includes "
    "may "
    "be included [forbidden-call]";

TEST_F(StudentBuildTest, RefusesInternalHeadersHoweverTheyAreIncluded) {
  const std::string rest = "int twice(int a) { return inlined(a); }\nint main() {}\n";
  const StudentObject plain = compile("#include \"exercise.h\"\n#include \"answer_internal.h\"\n" + rest);
  EXPECT_FALSE(plain.ok);
  EXPECT_EQ(first(plain.messages),
            std::string("main.cpp:2:1: error: includes answer_internal.h") + kNotPublic);
  const StudentObject pasted = compile(
      "#define QUOTED(x) #x\n#define NAME(x, y) QUOTED(x##y)\n"
      "#include NAME(answer_int, ernal.h)\n" +
      rest);
  EXPECT_FALSE(pasted.ok);
  EXPECT_EQ(first(pasted.messages), std::string("main.cpp: error: includes answer_internal.h") + kNotPublic);
}

TEST_F(StudentBuildTest, TakesPublicHeadersOnly) {
  const std::string rest = "int twice(int a) { return 2 * a; }\nint main() {}\n";
  const StudentObject fine = compile(
      "#include \"exercise.h\"\n#include <Eigen/Core>\n#include <vector>\n#include <unistd.h>\n"
      "#include \"part/part.h\"\n#include \"../src/part/part.h\"\n" +
      rest);
  EXPECT_TRUE(fine.ok) << first(fine.messages);
  write(temporary_.path() / "stolen file.txt", "// all of it\n");
  const std::pair<std::string, std::string> refused[] = {
      {"part/part.cpp", "part.cpp"},
      {"../exercise/../src/part/part.cpp", "part.cpp"},
      {(temporary_.path() / "stolen file.txt").string(), "stolen file.txt"},
      {"/dev/null", "null"},
      {"answer_internal.h", "answer_internal.h"}};
  for (const auto& [name, shown] : refused) {
    const StudentObject object = compile("#include \"exercise.h\"\n#include \"" + name + "\"\n" + rest);
    EXPECT_FALSE(object.ok) << name;
    EXPECT_EQ(first(object.messages), "main.cpp:2:1: error: includes " + shown + kNotPublic);
  }
}

// A file is what it is, by whatever name: through links, dots behind links, and folders of the kernel.
TEST_F(StudentBuildTest, JudgesIncludesByWhatTheyAre) {
  const path library = shared_->path() / "src", own = temporary_.path() / "own" / "deep";
  write(own / "x.h", "// below\n");
  write(own.parent_path() / "secret.h", "// all of it\n");
  write(library / "part" / "hidden_internal.h", "// internal\n");
  const auto link = [](const path& target, const path& name) {
    std::filesystem::remove(name);
    std::filesystem::create_symlink(target, name);
  };
  link(shared_->path() / "exercise" / "answer_internal.h", library / "part" / "alias.h");
  link(library / "part" / "hidden_internal.h", library / "part" / "plain.h");
  link(own.parent_path() / "secret.h", library / "secret.h");
  link(own, library / "out");
  const std::string rest = "int twice(int a) { return 2 * a; }\nint main() {}\n";
  for (const std::string& name :
       {std::string("part/alias.h"), std::string("part/plain.h"), std::string("secret.h"),
        std::string("out/x.h"), std::string("out/../secret.h"),
        std::string("/usr/include/../../") + own.string() + "/x.h", "/proc/self/root" + own.string() + "/x.h",
        "/usr/lib/../.." + own.parent_path().string() + "/secret.h"}) {
    const StudentObject object = compile("#include \"exercise.h\"\n#if __INCLUDE_LEVEL__ == 0\n#include \"" +
                                         name + "\"\n" + rest + "#endif\n");
    EXPECT_FALSE(object.ok) << name;
    EXPECT_THAT(first(object.messages), HasSubstr(kNotPublic)) << name;
  }
  for (const char* name : {"alias.h", "plain.h"}) std::filesystem::remove(library / "part" / name);
  for (const char* name : {"secret.h", "out"}) std::filesystem::remove(library / name);
  // A library that is itself reached by a link is one.
  link(library, temporary_.path() / "library");
  write(temporary_.path() / "main.cpp", "#include \"exercise.h\"\n#include \"part/part.h\"\n" + rest);
  Toolchain linked = toolchain();
  linked.flags.back() = temporary_.path() / "library";
  EXPECT_TRUE(compileStudent(linked, {},
                             {.main = temporary_.path() / "main.cpp",
                              .workFolder = temporary_.path() / "work",
                              .publicHeadersOnly = true,
                              .graded = true})
                  .ok);
}

// What the assembler reads becomes a part of the program as well.
TEST_F(StudentBuildTest, JudgesFilesOfTheAssembler) {
  const path file = temporary_.path() / "reference.txt";
  write(file, "# all of it\n");
  const std::string rest = "int twice(int a) { return 2 * a; }\nint main() {}\n";
  for (const std::string& line :
       {".incbin \\\"" + file.string() + "\\\"", ".include \\\"" + file.string() + "\\\"",
        std::string(".incbin \\\"/proc/self/environ\\\"")}) {
    const StudentObject object = compile("asm(\"" + line + "\");\n" + rest);
    EXPECT_FALSE(object.ok) << line;
    EXPECT_THAT(first(object.messages), HasSubstr(kNotPublic)) << line;
  }
  EXPECT_TRUE(compile("asm(\"nop\");\n" + rest).ok);
}

TEST_F(StudentBuildTest, RefusesAnotherNameForTheLibrary) {
  const StudentObject object = compile(
      "#define rex mine\n#include \"exercise.h\"\nint twice(int a) { return 2 * a; }\nint main() {}\n");
  EXPECT_FALSE(object.ok);
  EXPECT_EQ(first(object.messages),
            "main.cpp:1:1: error: defines a macro 'rex', which is the name of the library [forbidden-call]");
}

TEST_F(StudentBuildTest, IncludesNothingThatLiesBesideTheFile) {
  write(temporary_.path() / "exercise.h", "#error taken from the submission\n");
  EXPECT_TRUE(compile(kGood).ok);
}

TEST_F(StudentBuildTest, CompilesUnderAPlainNameWhateverTheFileIsCalled) {
  const path odd = temporary_.path() / "-o $(touch x)\n.cpp";
  write(odd, kGood);
  const StudentObject object = compileFile(odd);
  EXPECT_TRUE(object.ok) << object.log;
  EXPECT_EQ(object.name, "main.cpp");
}

TEST_F(StudentBuildTest, CopesWithCountlessErrors) {
  std::string hundred, storm;
  for (int k = 0; k < 100; ++k) hundred += "int f" + std::to_string(k) + "() { return unknown; }\n";
  EXPECT_THAT(first(compile(hundred).messages),
              HasSubstr("main.cpp:1:19: error: 'unknown' was not declared"));
  EXPECT_TRUE(compile(hundred).truncated);
  for (int k = 0; k < 20000; ++k) storm += "int a" + std::to_string(k) + " = b;";
  write(temporary_.path() / "main.cpp", storm);
  const StudentObject stopped = compileStudent(
      toolchain(), {},
      {.main = temporary_.path() / "main.cpp", .workFolder = temporary_.path() / "work", .seconds = .4});
  EXPECT_THAT(first(stopped.messages), HasSubstr("main.cpp:1:10: error: 'b' was not declared"));
}

TEST_F(StudentBuildTest, StopsACompilationThatExplodes) {
  const StudentObject deep = compile("#include __FILE__\n");
  EXPECT_THAT(first(deep.messages), HasSubstr("found an include of the file itself"));
  const StudentObject large = compile("char a[3000000000] = {1};\nint main() { return a[5]; }\n");
  EXPECT_FALSE(large.ok);
  EXPECT_FALSE(large.messages.empty());
  EXPECT_FALSE(std::filesystem::exists(large.object) &&
               std::filesystem::file_size(large.object) > (65u << 20));
  EXPECT_FALSE(compile("#include \"/dev/stdin\"\nint x = y;\n").ok);
}

TEST_F(StudentBuildTest, SaysWhichLimitACompilationHit) {
  const auto refusal = [&](const std::string& source, StudentBuildOptions options) {
    write(temporary_.path() / "main.cpp", source);
    options.main = temporary_.path() / "main.cpp";
    options.workFolder = temporary_.path() / "work";
    return first(compileStudent(toolchain(), {}, options).messages);
  };
  EXPECT_EQ(refusal("template <int N, long M> struct F { static const int v = F<N - 1, 2 * M>::v + F<N - 1, "
                    "2 * M + 1>::v; };\n"
                    "template <long M> struct F<0, M> { static const int v = 1; };\nint x = F<40, 0>::v;\n",
                    {.main = {}, .workFolder = {}, .seconds = 1}),
            "main.cpp: error: compiling took more than 1 s of processor time and was stopped");
  EXPECT_EQ(refusal("#include <Eigen/Core>\n", {.main = {}, .workFolder = {}, .memory = 150u << 20}),
            "main.cpp: error: compiling needed more than 150 MiB of memory and was stopped");
}

TEST_F(StudentBuildTest, SaysWhatTheAssemblerRefuses) {
  const StudentObject object = compile("int main() {\n  asm(\"no such thing\");\n}\n");
  EXPECT_FALSE(object.ok);
  EXPECT_EQ(first(object.messages), "main.cpp:2: error: no such instruction: `no such thing'");
  EXPECT_EQ(first(compile("int a __attribute__((section(\".bss,\\\"awx\\\",@nobits#\"))) = 1;\n"
                          "int b __attribute__((section(\".text,\\\"q\\\"#\"))) = 1;\n")
                      .messages)
                .find("[]"),
            std::string::npos);
}

TEST_F(StudentBuildTest, SaysWhatTheLinkerRefuses) {
  const StudentObject object = compile(
      "static char big[3000000000], more[3000000000];\nint last;\n"
      "int twice(int a) { big[a] = 1; more[a] = 2; last = a; return big[0] + more[5]; }\n"
      "int main() { return twice(1); }\n");
  ASSERT_TRUE(object.ok) << first(object.messages);
  const StudentProgram program = linkProgram(toolchain(), object);
  EXPECT_FALSE(program.ok);
  EXPECT_THAT(first(program.messages), HasSubstr("main.cpp: error: cannot be linked: main.cpp:"));
  EXPECT_THAT(first(program.messages), HasSubstr("relocation truncated to fit"));
}

TEST_F(StudentBuildTest, BlamesTheMachineForALinkerThatExplainsNothing) {
  Toolchain broken = toolchain();
  broken.libraries = {"/no/such/library.so"};
  EXPECT_REX_ERROR(linkProgram(broken, compile(kGood)),
                   "g++ failed twice through no fault of the file: found no file /no/such/library.so; ");
}

TEST_F(StudentBuildTest, BlamesTheMachineForACompilerThatExplainsNothing) {
  write(temporary_.path() / "main.cpp", kGood);
  Toolchain broken = toolchain();
  const StudentBuildOptions options{.main = temporary_.path() / "main.cpp",
                                    .workFolder = temporary_.path() / "work"};
  broken.compiler = script("mute", "exit 1\n");
  EXPECT_REX_ERROR(compileStudent(broken, {}, options),
                   "mute failed twice through no fault of the file: found an empty program cannot be built "
                   "either; exit code 1");
  broken.compiler = script("empty", "echo '[]' >&2\nkill -ABRT $$\n");
  EXPECT_REX_ERROR(compileStudent(broken, {}, options), "either; signal 6");
}

// Whatever is full first, the copy of the file, the compiler's own file, the object or the program, the file
// is fine.
TEST_F(StudentBuildTest, BlamesTheMachineForAFullDisk) {
  const std::string padding = "// " + std::string(20000, 'x') + "\n";
  write(temporary_.path() / "main.cpp",
        padding + "#include <map>\n#include <string>\n" + kGood +
            "int count() { std::map<int, std::string> m; m[1] = \"x\"; return "
            "static_cast<int>(m.size()); }\n");
  const char* set = std::getenv("TMPDIR");
  const std::string before = set != nullptr ? set : "/tmp";
  std::set<std::string> reasons;
  for (const int kilobytes : {16, 40, 60, 90, 120, 160, 200, 240, 280, 340, 420, 4000}) {
    const TinyDisk disk(kilobytes);
    REX_NEEDS_DISK(disk);
    ::setenv("TMPDIR", disk.path().c_str(), 1);
    try {
      const StudentObject object = compileStudent(
          toolchain(), {}, {.main = temporary_.path() / "main.cpp", .workFolder = disk.path()});
      EXPECT_TRUE(object.ok) << kilobytes << ": " << first(object.messages);
      // Once there is room for the object without main(), but not for the program.
      const auto space = std::filesystem::space(disk.path()).available;
      const auto left = kilobytes == 420 ? std::filesystem::file_size(object.object) + 16384 : 0;
      if (kilobytes < 4000) std::ofstream(disk.path() / "rest") << std::string(space - left, '.');
      const StudentProgram worker = linkWorker(toolchain(), object);
      EXPECT_TRUE(worker.ok) << kilobytes << ": " << first(worker.messages);
      reasons.insert("built");
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("No space left on device")) << kilobytes;
      reasons.insert(error.parts().what);
    }
    ::setenv("TMPDIR", before.c_str(), 1);
  }
  if (set == nullptr) ::unsetenv("TMPDIR");
  EXPECT_THAT(reasons, ::testing::IsSupersetOf({"built", "cannot write this file",
                                                "the compiler failed through no fault of the file",
                                                "objcopy failed twice through no fault of the file",
                                                "g++ failed twice through no fault of the file"}));
}

// Of a machine short of memory: the driver, or a tool of its own.
TEST_F(StudentBuildTest, BuildsOnceMoreWhenAToolIsKilled) {
  write(temporary_.path() / "main.cpp", kGood);
  const StudentBuildOptions options{.main = temporary_.path() / "main.cpp",
                                    .workFolder = temporary_.path() / "work"};
  const std::string mark = (temporary_.path() / "mark").string(),
                    once = "[ -e " + mark + " ] || { : >" + mark + "; kill -KILL $$; }\n";
  Toolchain killed = toolchain();
  killed.compiler = script("driver", once + "exec g++ \"$@\"\n");
  EXPECT_TRUE(compileStudent(killed, {}, options).ok);
  EXPECT_TRUE(std::filesystem::remove(mark));

  killed = toolchain();
  script("tools/as", once + "exec as \"$@\"\n");
  killed.flags.push_back("-B" + (temporary_.path() / "tools").string());
  const StudentObject object = compileStudent(killed, {}, options);
  EXPECT_TRUE(object.ok) << first(object.messages);
  EXPECT_TRUE(std::filesystem::remove(mark));

  script("tools/ld", once + "exec ld \"$@\"\n");
  killed.linkFlags.push_back("-B" + (temporary_.path() / "tools").string());
  const StudentProgram worker = linkWorker(killed, object);
  EXPECT_TRUE(worker.ok) << first(worker.messages);
  EXPECT_TRUE(std::filesystem::remove(mark));
}

TEST_F(StudentBuildTest, BlamesTheMachineForToolsThatAreKilledTwice) {
  write(temporary_.path() / "main.cpp", kGood);
  const StudentBuildOptions options{.main = temporary_.path() / "main.cpp",
                                    .workFolder = temporary_.path() / "work"};
  for (const char* tool : {"cc1plus", "as", "ld"}) script(path(tool) / tool, "kill -KILL $$\n");
  script("ld/ld.bfd", "kill -KILL $$\n");
  for (const char* tool : {"cc1plus", "as"}) {
    Toolchain killed = toolchain();
    killed.flags.push_back("-B" + (temporary_.path() / tool).string());
    EXPECT_REX_ERROR(
        compileStudent(killed, {}, options),
        std::string("g++ failed twice through no fault of the file: found an empty program cannot be built "
                    "either; g++: fatal error: Killed signal terminated program ") +
            tool);
  }
  const StudentObject object = compileFile(temporary_.path() / "main.cpp");
  Toolchain killed = toolchain();
  killed.linkFlags.push_back("-B" + (temporary_.path() / "ld").string());
  EXPECT_REX_ERROR(linkWorker(killed, object),
                   "g++ failed twice through no fault of the file: found an empty program cannot be built "
                   "either; collect2: fatal error: ld");
}

// What a file lets a tool say about the machine counts for nothing, as the machine can build an empty
// program.
TEST_F(StudentBuildTest, BelievesNothingThatAFileSaysAboutTheMachine) {
  const std::string killed = "g++: fatal error: Killed signal terminated program cc1plus",
                    full = "error writing to /tmp/ccM6QBox.s: No space left on device";
  for (const std::string& source :
       {"#include \"" + killed + "\"\n", "#include \"x\\\n" + killed + "\"\n", "#error " + killed + "\n",
        "#pragma GCC error \"" + full + "\"\n",
        std::string("#pragma GCC error \"cannot open x: Disk quota exceeded\"\n"),
        "asm(\".error \\\"" + full + "\\\"\");\n",
        "asm(\".print \\\"" + killed + "\\ncompilation terminated.\\\"\\n.error \\\"x\\\"\");\n"}) {
    const StudentObject object = compile(kGood + source);
    EXPECT_FALSE(object.ok) << source;
    EXPECT_FALSE(object.messages.empty()) << source;
  }
}

// A compiler that fails on this file alone, twice and without a reason.
TEST_F(StudentBuildTest, BlamesTheFileForToolsThatFailOnItAlone) {
  write(temporary_.path() / "main.cpp", kGood);
  const StudentBuildOptions options{.main = temporary_.path() / "main.cpp",
                                    .workFolder = temporary_.path() / "work"};
  const std::string once = "case \"$*\" in *_control*) exec g++ \"$@\";; esac\n";
  Toolchain odd = toolchain();
  odd.compiler = script("killed", once + "kill -KILL $$\n");
  EXPECT_EQ(first(compileStudent(odd, {}, options).messages),
            "main.cpp: error: the compiler gave up: signal 9");
  odd.compiler = script("full", once + "echo 'error: No space left on device' >&2; exit 1\n");
  EXPECT_EQ(first(compileStudent(odd, {}, options).messages),
            "main.cpp: error: the compiler gave up: error: No space left on device");
  const StudentObject object = compileFile(temporary_.path() / "main.cpp");
  EXPECT_EQ(first(linkWorker(odd, object).messages),
            "main.cpp: error: cannot be linked: error: No space left on device");
  odd.compiler = script("slow", once + "i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done; exec sleep 60\n");
  StudentBuildOptions hurried = options;
  hurried.seconds = .4;
  EXPECT_THAT(first(compileStudent(odd, {}, hurried).messages),
              HasSubstr("compiling did not end within 6 s"));
}

// The whole of what is read before a compiler starts has two seconds of processor time; the compiler here
// only refuses everything.
TEST_F(StudentBuildTest, ReadsAnyFileInTimeBeforeItIsCompiled) {
  Toolchain refusing = toolchain();
  refusing.functions = {"f0", "f9"};
  refusing.compiler =
      script("refusing",
             "echo 'error: refused' >&2\n"
             "echo '[{\"kind\": \"error\", \"locations\": [], \"message\": \"refused\"}]' >&2\nexit 1\n");
  for (const auto& [shape, source] : slowSources()) {
    write(temporary_.path() / "main.cpp", source);
    const StudentObject object = compileStudent(refusing, {{"rex::answer", "it is what you find out"}},
                                                {.main = temporary_.path() / "main.cpp",
                                                 .workFolder = temporary_.path() / "work",
                                                 .publicHeadersOnly = true,
                                                 .graded = true,
                                                 .part = true});
    EXPECT_FALSE(object.ok) << shape;
    EXPECT_THAT(first(object.messages), ::testing::Not(HasSubstr("reading"))) << shape;
  }
}

TEST_F(StudentBuildTest, RefusesWhatIsNoSourceFile) {
  const path folder = temporary_.path();
  const auto refusal = [&](const char* name) { return first(compileFile(folder / name).messages); };
  EXPECT_EQ(refusal("none.cpp"),
            "none.cpp: error: cannot be graded: found no file, wanted a C++ source file");
  std::filesystem::create_directory(folder / "folder.cpp");
  EXPECT_THAT(refusal("folder.cpp"), HasSubstr("found a folder"));
  std::filesystem::create_symlink("/etc/passwd", folder / "link.cpp");
  EXPECT_THAT(refusal("link.cpp"), HasSubstr("found a symbolic link"));
  ASSERT_EQ(::mkfifo((folder / "pipe.cpp").c_str(), 0600), 0);
  EXPECT_THAT(refusal("pipe.cpp"), HasSubstr("found a pipe or device"));
  write(folder / "big.cpp", std::string((1u << 20) + 1, ' '));
  EXPECT_THAT(refusal("big.cpp"), HasSubstr("found more than 1 MiB"));
  write(folder / "nul.cpp", std::string("int a;\0", 7));
  EXPECT_THAT(refusal("nul.cpp"), HasSubstr("found NUL bytes"));
}

TEST_F(StudentBuildTest, ThrowsWhenTheToolsAreMissing) {
  write(temporary_.path() / "main.cpp", kGood);
  Toolchain broken = toolchain();
  broken.compiler = "no-such-compiler";
  EXPECT_REX_ERROR(compileStudent(broken, {}, {temporary_.path() / "main.cpp", temporary_.path() / "w"}),
                   "cannot run no-such-compiler");
  broken = toolchain();
  broken.objcopy = "false";
  const StudentObject object = compileFile(temporary_.path() / "main.cpp");
  EXPECT_REX_ERROR(linkWorker(broken, object), "cannot rename main in the compiled file");
}

TEST_F(StudentBuildTest, BlamesTheMachineForACompilerThatDoesNotGetOn) {
  const path slow = temporary_.path() / "compiler";
  write(slow, "#!/bin/sh\ni=0\nwhile [ $i -lt 200000 ]; do i=$((i+1)); done\nexec sleep 60\n");
  std::filesystem::permissions(slow, std::filesystem::perms::owner_all);
  write(temporary_.path() / "main.cpp", kGood);
  Toolchain busy = toolchain();
  busy.compiler = slow;
  EXPECT_REX_ERROR(
      compileStudent(
          busy, {},
          {.main = temporary_.path() / "main.cpp", .workFolder = temporary_.path() / "work", .seconds = 0.1}),
      "compiler did not end within 3 s through no fault of the file: found an empty program cannot be "
      "built either; ");
}

TEST_F(StudentBuildTest, BlamesTheFileForACompilerThatWaits) {
  write(temporary_.path() / "main.cpp", "#include \"/dev/stdout\"\n");
  const StudentObject object = compileStudent(
      toolchain(), {},
      {.main = temporary_.path() / "main.cpp", .workFolder = temporary_.path() / "work", .seconds = .4});
  ASSERT_FALSE(object.ok);
  EXPECT_THAT(
      toString(object.messages.at(0)),
      HasSubstr(
          "compiling did not end within 6 s: does it include a pipe or a device, or is this machine busy?"));
}

TEST_F(StudentBuildTest, ReadsBuildJson) {
  const path file = temporary_.path() / "build.json";
  EXPECT_REX_ERROR(readToolchain(file), "build.json: the exercise is not built");
  write(file, "{\"compiler\": \"g++\"}");
  EXPECT_REX_ERROR(readToolchain(file), "not a build description");
  write(
      file,
      R"({"compiler": "g++", "compile_flags": ["-O1"], "link_flags": ["-g"], "worker_object": "w.o", "grader": "g",
                  "show": "s.a", "libraries": ["s.so", "t.so"], "functions": ["f"], "prefix": "p.h", "objcopy": "oc", "objdump": "od"})");
  const Toolchain read = readToolchain(file);
  EXPECT_EQ(read.compiler, "g++");
  EXPECT_EQ(read.flags, std::vector<std::string>{"-O1"});
  EXPECT_EQ(read.linkFlags, std::vector<std::string>{"-g"});
  EXPECT_EQ(read.workerObject, "w.o");
  EXPECT_EQ(read.grader, "g");
  EXPECT_THAT(read.libraries, testing::ElementsAre("s.so", "t.so"));
  EXPECT_THAT(read.functions, testing::ElementsAre("f"));
  EXPECT_EQ(read.prefix, "p.h");
  EXPECT_EQ(read.show, "s.a");
  EXPECT_EQ(read.objcopy, "oc");
  EXPECT_EQ(read.objdump, "od");
}

}  // namespace rex::submission::student_build_test
