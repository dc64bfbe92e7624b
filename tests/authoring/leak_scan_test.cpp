#include "authoring/leak_scan.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/process.h"
#include "base/rng.h"
#include "base/text_file.h"
#include "submission/zip_file.h"
#include "support/archive_samples.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::authoring::leak_scan_test {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kSolution =
    "#include \"exercise.h\"\n"
    "double area(double r) {\n"
    "  // <solution area>\n"
    "  const double square = r * r;  // squared\n"
    "  // Slide 3:1 has the formula.\n"
    "  return 3.14159265 * square;\n"
    "  // <todo>\n"
    "  //| // TODO: the area of the circle.\n"
    "  //| return 0;\n"
    "  // </solution>\n"
    "}\n";
constexpr const char* kCheck =
    "void growsWithRadius() { require(area(2) > area(1), \"area grows with the radius\"); }\n"
    "// <hidden>\n"
    "void quadruplesWhenDoubled() {\n"
    "  const double small = area(1);\n"
    "  require(area(2) == 4 * small, \"twice the radius, four times the area\");\n"
    "}\n"
    "// </hidden>\n";
constexpr const char* kWrong =
    "// <variant circumference>\n"
    "// caught by: grows\n"
    "// mistake: takes the circumference for the area.\n"
    "// <solution area>\n"
    "const double circumference = 2 * 3.14159265 * r;\n"
    "return circumference;\n";

class LeakScanTest : public ::testing::Test {
 protected:
  void SetUp() override {
    write("root/exercises/01-circle/solution.cpp", kSolution);
    write("root/exercises/01-circle/check.cpp", kCheck);
    write("root/exercises/01-circle/wrong.cpp", kWrong);
    write("tree/README.md", "Compute the area of a circle.\n");
  }
  void write(const std::string& name, const std::string& text) const {
    writeTextFile(folder_.path() / name, text);
  }
  fs::path tree() const { return folder_.path() / "tree"; }
  std::vector<Secret> secrets() const {
    return collectSecrets({folder_.path() / "root/exercises/01-circle"}, folder_.path() / "root");
  }
  std::vector<std::string> leaks() const {
    std::vector<std::string> told;
    for (const Leak& leak : scanForLeaks(tree(), secrets()).leaks) told.push_back(toString(leak));
    return told;
  }
  // The only leak of a tree that holds this file.
  std::string leakOf(const std::string& name, const std::string& bytes) const {
    write("tree/" + name, bytes);
    const std::vector<std::string> told = leaks();
    fs::remove(tree() / name);
    EXPECT_EQ(told.size(), 1u) << name << ": " << ::testing::PrintToString(told);
    return told.empty() ? "" : told.front();
  }

  TemporaryFolder folder_;
};

constexpr const char* kOfSolution =
    "a line of the solution would reach students: found 'return 3.14159265 * square;' of "
    "exercises/01-circle/solution.cpp:6";

TEST_F(LeakScanTest, FindsNothingInACleanTree) {
  write("tree/exercises/01-circle/main.cpp",
        "#include \"exercise.h\"\ndouble area(double r) {\n  // TODO: the area of the circle.\n  return "
        "0;\n}\n");
  write("tree/exercises/01-circle/check.cpp",
        "void growsWithRadius() { require(area(2) > area(1), \"area grows with the radius\"); }\n");
  const LeakScan scan = scanForLeaks(tree(), secrets());
  EXPECT_THAT(scan.leaks, IsEmpty());
  EXPECT_EQ(scan.files, 3);
  EXPECT_EQ(scan.packed, 0);
  EXPECT_GT(secrets().size(), 5u);
}

TEST_F(LeakScanTest, NamesBothPlaces) {
  EXPECT_EQ(leakOf("notes.md", "one\n\n    return 3.14159265 * square;\n"),
            std::string("notes.md:3: ") + kOfSolution);
}

// Heads of loops and declarations are the same in many exercises.
TEST_F(LeakScanTest, WantsLongerLinesInFoldersOfOtherExercises) {
  const std::string whole = "const double circumference = 2 * 3.14159265 * std::sqrt(square);";
  write("root/exercises/01-circle/solution.cpp", "// <solution area>\nreturn 3.14159265 * square;\n" + whole +
                                                     "\n// <todo>\n//| // none\n// </solution>\n");
  write("tree/exercises/02-square/main.cpp", "return 3.14159265 * square;\n");
  EXPECT_THAT(leaks(), IsEmpty());
  write("tree/exercises/02-square/main.cpp", whole + "\n");
  EXPECT_EQ(leaks().size(), 1u);
  write("tree/exercises/02-square/main.cpp", "\n");
  write("tree/exercises/01-circle/help.h", "return 3.14159265 * square;\n");
  EXPECT_EQ(leaks().size(), 1u);
}

TEST_F(LeakScanTest, SeesThroughLayoutCaseAndComments) {
  for (const char* text :
       {"return 3.14159265\n  * square;", "RETURN 3.14159265*SQUARE;", "// return 3.14159265 * square;",
        "return 3.14159265 /* pi */ * square;", "return 3.14159265 *  // pi\n  square;",
        "// return 3.14159265\n//   * square;", "{\"cell\": [\"return 3.14159265 *\\n square;\"]}",
        "<b>return 3.14159265 * square; &amp; so on</b>"})
    EXPECT_THAT(leakOf("a.txt", text), HasSubstr("return 3.14159265 * square;")) << text;
  std::string wide;
  for (const char c : std::string("return 3.14159265 * square;")) wide += {c, '\0'};
  EXPECT_THAT(leakOf("wide.txt", wide), HasSubstr(kOfSolution));
}

TEST_F(LeakScanTest, FindsALineWithoutItsComment) {
  EXPECT_EQ(leakOf("a.txt", "const double square = r * r;"),
            "a.txt:1: a line of the solution would reach students: found 'const double square = r * r;  // "
            "squared' of exercises/01-circle/solution.cpp:4");
  EXPECT_THAT(leakOf("a.txt", "Slide 3:1 has the formula."), HasSubstr("solution.cpp:5"));
}

TEST_F(LeakScanTest, FindsHiddenChecksAndTheirTexts) {
  EXPECT_EQ(leakOf("a.cpp", "\nvoid quadruplesWhenDoubled() {\n\n  const double small = area(1); }"),
            "a.cpp:2: a hidden check would reach students: found 'void quadruplesWhenDoubled() {' of "
            "exercises/01-circle/check.cpp:3");
  EXPECT_EQ(leakOf("a.md", "It fails \"Twice the radius, four times the area\"."),
            "a.md:1: a text of a hidden check would reach students: found 'twice the radius, four times the "
            "area' of exercises/01-circle/check.cpp:5");
}

TEST_F(LeakScanTest, FindsWrongVariants) {
  EXPECT_EQ(leakOf("a.txt", "const double circumference = 2 * 3.14159265 * r;\nreturn circumference;"),
            "a.txt:1: a wrong variant would reach students: found 'const double circumference = 2 * "
            "3.14159265 * r;' of exercises/01-circle/wrong.cpp:5");
  EXPECT_THAT(leakOf("a.txt", "Mistake: takes the circumference for the area."), HasSubstr("wrong.cpp:3"));
  write("root/exercises/01-circle/seen.txt",
        "circumference\n    grows: the area of a circle of twice the radius: got 12.56 m, wanted 50.24 m\n");
  EXPECT_THAT(leakOf("a.txt", "grows: the area of a circle of twice the radius: got 12.56 m, wanted 50.24 m"),
              HasSubstr("exercises/01-circle/seen.txt:2"));
}

TEST_F(LeakScanTest, LooksAtNames) {
  EXPECT_EQ(leakOf("return 3.14159265 * square;.txt", ""),
            std::string("return 3.14159265 * square;.txt: ") + kOfSolution);
  for (const std::string name : {"solution.cpp", "wrong.cpp", "seen.txt", "equal_mutants.tsv"})
    EXPECT_EQ(leakOf("exercises/01-circle/" + name, "int a;"),
              "exercises/01-circle/" + name + ": a file of that name would reach students");
  EXPECT_EQ(leakOf("exercises/01-circle/wrong/a.cpp", ""),
            "exercises/01-circle/wrong/a.cpp: a file in a folder of that name would reach students");
}

TEST_F(LeakScanTest, FindsMarksThatWereNotTakenAway) {
  EXPECT_EQ(leakOf("exercises/01-circle/a.h", "int a;\n  // <hidden>\n"),
            "exercises/01-circle/a.h:2: a mark of a region would reach students");
  write("tree/share/template/check.cpp", "// <hidden>\n");
  write("tree/share/doc/a.md", "`// <hidden>`\n");
  EXPECT_THAT(leaks(), IsEmpty());
}

TEST_F(LeakScanTest, OpensArchivesInsideOfArchives) {
  submission::writeZip(folder_.path() / "inner.zip", {{"deep/a.txt", "one\nreturn 3.14159265 * square;\n"}});
  submission::writeZip(folder_.path() / "outer.zip",
                       {{"inner.zip", readTextFile(folder_.path() / "inner.zip")}});
  const std::string outer = readTextFile(folder_.path() / "outer.zip");
  EXPECT_EQ(leakOf("old.bak", outer), std::string("old.bak: inner.zip: deep/a.txt:2: ") + kOfSolution);
  submission::writeZip(folder_.path() / "named.zip", {{"x/solution.cpp", "int a;"}});
  EXPECT_THAT(leakOf("a.zip", readTextFile(folder_.path() / "named.zip")),
              HasSubstr("a.zip: x/solution.cpp: a file of that name"));
  write("tree/outer.zip", outer);
  const LeakScan scan = scanForLeaks(tree(), {});
  EXPECT_EQ(scan.packed, 2);
  EXPECT_EQ(scan.files, 4) << "README.md, outer.zip, inner.zip, deep/a.txt";
}

TEST_F(LeakScanTest, OpensCompressedFiles) {
  write("a.txt", "\nreturn 3.14159265 * square;\n");
  ASSERT_TRUE(runProcess({"gzip", "a.txt"}, {.directory = folder_.path()}).ok());
  EXPECT_EQ(leakOf("a.gz", readTextFile(folder_.path() / "a.txt.gz")),
            std::string("a.gz: (unpacked):2: ") + kOfSolution);
}

TEST_F(LeakScanTest, RefusesWhatNobodyCanLookThrough) {
  EXPECT_THAT(leakOf("a.zip", "PK\x03\x04 and nothing more"),
              HasSubstr("a.zip: an archive that cannot be opened ("));
  std::string nested = "text";
  for (int k = 0; k < 6; ++k) {
    submission::writeZip(folder_.path() / "n.zip", {{"n.zip", nested}});
    nested = readTextFile(folder_.path() / "n.zip");
  }
  EXPECT_THAT(leakOf("n.zip", nested),
              HasSubstr("cannot be opened (more than 4 inside each other), would reach"));
  fs::create_directories(tree() / ".git");
  EXPECT_THAT(leaks(), ElementsAre(".git: a history, which is not scanned, would reach students"));
  fs::remove(tree() / ".git");
  fs::create_symlink("/etc/hostname", tree() / "link");
  EXPECT_THAT(leaks(), ElementsAre("link: a link, whose target is not scanned, would reach students"));
}

TEST_F(LeakScanTest, RefusesCompiledFilesAndNamesTheirOriginWhereItCan) {
  write("check.cpp", "const char* told() { return \"twice the radius, four times the area\"; }\n");
  write("clean.cpp", "int four() { return 4; }\n");
  ASSERT_TRUE(runProcess({"c++", "-c", "check.cpp", "clean.cpp"}, {.directory = folder_.path()}).ok());
  EXPECT_THAT(leakOf("check.o", readTextFile(folder_.path() / "check.o")),
              HasSubstr("a text of a hidden check would reach students: found 'twice the radius, four times "
                        "the area' of exercises/01-circle/check.cpp:5"));
  EXPECT_EQ(leakOf("clean.o", readTextFile(folder_.path() / "clean.o")),
            "clean.o: a compiled file of unknown origin would reach students");
}

TEST_F(LeakScanTest, FindsSecretsInTheProgramsOfAnInstalledTree) {
  write("check.cpp", "const char* told() { return \"twice the radius, four times the area\"; }\n");
  write("clean.cpp", "int four() { return 4; }\n");
  ASSERT_TRUE(runProcess({"c++", "-c", "check.cpp", "clean.cpp"}, {.directory = folder_.path()}).ok());
  write("tree/lib/rex/exercises/01-circle/clean.o", readTextFile(folder_.path() / "clean.o"));
  write("tree/include/rex/area.h", "return 3.14159265 * square;\n");
  write("library/area.h", "return 3.14159265 * square;\n");
  fs::create_symlink("rex/exercises", tree() / "lib" / "link");
  const auto found = [&] {
    return scanForLeaks(tree(), secrets(), folder_.path() / "library", TreeKind::kInstalled).leaks;
  };
  EXPECT_THAT(found(), IsEmpty());
  write("tree/lib/rex/exercises/01-circle/grader", readTextFile(folder_.path() / "check.o"));
  ASSERT_EQ(found().size(), 1u);
  EXPECT_THAT(toString(found()[0]), HasSubstr("lib/rex/exercises/01-circle/grader"));
  fs::remove(tree() / "lib/rex/exercises/01-circle/grader");
  write("tree/share/rex/exercises/01-circle/solution.cpp", "int main() {}\n");
  fs::create_symlink("/etc/hostname", tree() / "outside");
  EXPECT_EQ(found().size(), 2u);
}

// A package has compiled graders; a source tree, from which it is built, has visible checks.
TEST_F(LeakScanTest, FindsVisibleChecksAndTheirHelpersInAnInstalledTree) {
  const std::string helper =
      "inline double wantedArea(double radius) {\n  return std::numbers::pi * std::pow(radius, 2);\n}\n";
  write("root/exercises/01-circle/area_checks.h", "#pragma once\n" + helper);
  write("root/exercises/01-circle/round.h",
        "inline double half(double diameter) { return diameter / 2 + 0 * std::sqrt(2.); }\n");
  write("root/exercises/01-circle/show.cpp", "#include \"round.h\"\n");
  write("tree/share/rex/exercises/01-circle/round.h",
        readTextFile(folder_.path() / "root/exercises/01-circle/round.h"));
  const auto told = [&](const std::string& name, const std::string& text) {
    write("tree/" + name, text);
    std::vector<std::string> all;
    for (const Leak& leak : scanForLeaks(tree(), secrets(), {}, TreeKind::kInstalled).leaks)
      all.push_back(toString(leak));
    EXPECT_THAT(leaks(), IsEmpty()) << "as a source tree";
    fs::remove(tree() / name);
    return all;
  };
  EXPECT_THAT(told("share/doc/rex/a.md", "Nothing.\n"), IsEmpty());
  EXPECT_THAT(
      told("share/rex/exercises/01-circle/area_checks.h", helper),
      ElementsAre(
          "share/rex/exercises/01-circle/area_checks.h:1: a check or its helper would reach students: "
          "found 'inline double wantedArea(double radius) {' of exercises/01-circle/area_checks.h:2"));
  EXPECT_THAT(told("share/doc/rex/a.md",
                   "void growsWithRadius() { require(area(2) > area(1), \"area grows with the radius\"); }"),
              ElementsAre(HasSubstr("a check or its helper would reach students")));
  EXPECT_THAT(told("share/rex/exercises/01-circle/check.cpp", "int main() {}\n"),
              ElementsAre(HasSubstr("a file of that name")));
  const std::string scene =
      "  body post {} body left { mass=1 } body right { mass=1 } joint (post left) {}\n";
  write("root/exercises/01-circle/area_checks.h", "constexpr const char* kScene = R\"(\n" + scene +
                                                      "  joint (post right) { type=hingeX })\";\n" + helper);
  EXPECT_THAT(told("lib/rex/exercises/01-circle/data", scene), IsEmpty()) << "a compiled grader holds it";
  EXPECT_THAT(told("share/doc/rex/a.md", helper), SizeIs(1)) << "after the end of the literal";
}

TEST_F(LeakScanTest, LetsTheLibraryHoldAllButTheSecretOfTheCourse) {
  write("tree/src/area.cpp", "return 3.14159265 * square;\n");
  write("tree/src/solution.cpp", "// how the program shows one\n");
  EXPECT_EQ(scanForLeaks(tree(), secrets()).leaks.size(), 2u) << "unknown files";
  EXPECT_THAT(scanForLeaks(tree(), secrets(), folder_.path() / "tree/src").leaks, IsEmpty());
  write("library/area.cpp", "return 3.14159265 * square; // changed\n");
  write("library/solution.cpp", "// how the program shows one\n");
  EXPECT_EQ(scanForLeaks(tree(), secrets(), folder_.path() / "library").leaks.size(), 1u);
  write("secret", "Correct/Horse+Battery//Staple==\n");
  write("tree/src/key.h", "key = \"CORRECT/Horse+Battery//Staple==\"\n");
  const LeakScan scan =
      scanForLeaks(tree(), {courseSecretIn(folder_.path() / "secret")}, folder_.path() / "tree/src");
  ASSERT_EQ(scan.leaks.size(), 1u);
  const std::string told = toString(scan.leaks[0]);
  EXPECT_THAT(told, HasSubstr("src/key.h:1: the secret of the course would reach students: found of "));
  EXPECT_THAT(told, ::testing::Not(HasSubstr("Horse"))) << "a log must not tell it";
}

TEST_F(LeakScanTest, NeedsASecretThatCanBeLookedFor) {
  write("secret", "a a a a a a a a a a a a\n");
  EXPECT_REX_ERROR(courseSecretIn(folder_.path() / "secret"),
                   "cannot scan for the secret of the course: found 12 non-blank characters, "
                   "wanted at least 16");
}

TEST_F(LeakScanTest, SaysWhatItCannotRead) {
  EXPECT_REX_ERROR(scanForLeaks(folder_.path() / "none", {}),
                   "none: cannot look through this folder: found ");
}

// What stands in headers and visible checks is public; a line of the solution there is a mistake.
TEST_F(LeakScanTest, TakesHeadersForPublicButNotWithLinesOfTheSolution) {
  write("root/exercises/01-circle/exercise.h",
        "const double small = area(1); require(area(2) == 4 * small, \"twice the radius, four times the "
        "area\");\n"
        "// return 3.14159265 * square;\n");
  fs::copy_file(folder_.path() / "root/exercises/01-circle/exercise.h", tree() / "exercise.h");
  EXPECT_THAT(leaks(), ElementsAre(std::string("exercise.h:2: ") + kOfSolution));
}

std::string letters(std::string_view text, Comments comments = Comments::kKeep) {
  return normalText(text, comments).letters;
}

TEST(NormalText, KnowsNoLayoutAndNoCase) {
  for (const char* text : {"x = A * b;", "X=a*B;", "  x\t=\n\r\n A *\n b ;", "// x = A\n//   * b;",
                           "/* x = A */ * /* b; */", "x = A \\\n * b;", "x =\\n A\\t * b;", "\x01x = A * b;"})
    EXPECT_EQ(letters(text), "x=a*b;") << text;
}

TEST(NormalText, DropsCommentsWhereAsked) {
  for (const char* text :
       {"x = A /* why */ * b; // because", "// why\nx =\n// why\nA * b;", "x = A * b; /* open"})
    EXPECT_EQ(letters(text, Comments::kDrop), "x=a*b;") << text;
  EXPECT_EQ(letters("// only\n/**/", Comments::kDrop), "");
  EXPECT_EQ(letters("a / b * c", Comments::kDrop), "a/b*c");
}

TEST(NormalText, ReadsEscapesEntitiesAndWideText) {
  EXPECT_EQ(letters("if (a &lt; b &amp;&amp; c &gt; d) &quot;&#39;"), "if(a<b&&c>d)\"'");
  EXPECT_EQ(letters("a &#60; b &#38;&#38; c &#62; d &#34;"), "a<b&&c>d\"") << "as htmlText() writes it";
  EXPECT_EQ(letters(R"({"code": "say(\"hello\");\n"})"), R"({"code":"say("hello");"})");
  EXPECT_EQ(letters(std::string_view("x\0 \0=\0A\0", 8)), "x=a");
  EXPECT_EQ(letters("&lt"), "&lt");
}

TEST(NormalText, TellsTheLineOfEachLetter) {
  const NormalText text = normalText("a\n/* b\nc */ d\\\ne\n", Comments::kDrop);
  EXPECT_EQ(text.letters, "ade");
  EXPECT_EQ(text.lines, (std::vector<int>{1, 3, 4}));
  EXPECT_TRUE(normalText("", Comments::kKeep).letters.empty());
}

// Programs that share no code with us pack them.
TEST(Unpack, ReadsWhatOthersPack) {
  const TemporaryFolder folder;
  writeTextFile(folder.path() / "a.txt", "the text\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> ways = {
      {{"tar", "cf", "p", "a.txt"}, "a.txt"},  {{"tar", "czf", "p", "a.txt"}, "a.txt"},
      {{"tar", "cJf", "p", "a.txt"}, "a.txt"}, {{"tar", "cjf", "p", "a.txt"}, "a.txt"},
      {{"sh", "-c", "gzip -c a.txt >p"}, ""},  {{"sh", "-c", "xz -c a.txt >p"}, ""},
      {{"sh", "-c", "bzip2 -c a.txt >p"}, ""}};
  int tried = 0;
  for (const auto& [command, name] : ways) {
    if (!runProcess(command, {.directory = folder.path()}).ok()) continue;
    const std::string bytes = readTextFile(folder.path() / "p");
    EXPECT_TRUE(isPacked(bytes)) << command.back();
    const auto files = unpack(bytes, "p");
    ASSERT_EQ(files.size(), 1u) << command.back();
    EXPECT_EQ(files[0].name, name) << command.back();
    EXPECT_EQ(files[0].bytes, "the text\n");
    ++tried;
  }
  EXPECT_GE(tried, 2) << "tar is always there";
}

TEST(Unpack, ReadsZipFiles) {
  const TemporaryFolder folder;
  submission::writeZip(folder.path() / "a.zip", {{"b/c.txt", "one"}, {"d", ""}});
  const std::string bytes = readTextFile(folder.path() / "a.zip");
  EXPECT_TRUE(isPacked(bytes));
  const auto files = unpack(bytes, "a.zip");
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0].name, "b/c.txt");
  EXPECT_EQ(files[0].bytes, "one");
}

TEST(Unpack, LeavesOtherFilesAlone) {
  for (const char* text : {"", "text", "BZ", "PK and more",
                           "\x7f"
                           "ELF",
                           "\x89PNG\r\n\x1a\n"})
    EXPECT_FALSE(isPacked(text)) << text;
}

TEST(Unpack, RefusesWhatIsBroken) {
  std::string bytes = zipOf({{.name = "a", .text = std::string(3000, 'x')}});
  EXPECT_REX_ERROR(unpack(bytes.substr(0, 200), "a.zip"), "a.zip: cannot look into this archive: found ");
  EXPECT_REX_ERROR(unpack("BZh nothing of that kind", "b"), "b: cannot look into this archive: found ");
  Rng rng(3);
  for (int k = 0; k < 200; ++k) {
    std::string bad = bytes;
    for (int n = 0; n < 5; ++n)
      bad[static_cast<std::size_t>(rng.index(static_cast<int>(bad.size())))] =
          static_cast<char>(rng.index(256));
    try {
      static_cast<void>(unpack(bad, "c"));
    } catch (const Error&) {
    }
  }
}

}  // namespace rex::authoring::leak_scan_test
