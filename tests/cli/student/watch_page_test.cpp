#include "cli/student/watch_page.h"

#include <gmock/gmock.h>

#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::cli::watch_page_test {

using grading::CheckResult;
using grading::GradeResult;
using grading::Outcome;
using submission::ExerciseInfo;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

GradeResult resultWith(Outcome first, Outcome second) {
  GradeResult result;
  result.exerciseId = "98-template";
  result.outcome = first == Outcome::kPass && second == Outcome::kPass ? Outcome::kPass : Outcome::kFail;
  CheckResult hand{.id = "hand", .title = "the <b>hand</b>", .status = first, .maxPoints = 1, .line = 1};
  hand.picture = "checks/hand.png", hand.replay = "checks/hand.html", hand.message = "1 < 2";
  result.checks = {hand, {.id = "foot", .title = "the foot", .status = second, .maxPoints = 1}};
  return result;
}

TEST(WatchParts, ShowTheTaskWithFormulasAndTheFunctions) {
  const TemporaryFolder folder;
  ExerciseInfo exercise;
  exercise.name = "98-template", exercise.folder = exercise.definition = folder.path();
  exercise.parts = {{.id = "turn", .title = "Turns & more", .points = 3, .hints = {}}};
  writeTextFile(folder.path() / "README.md", "# Turn\n\nWith $a < b$: [web](https://a.b) [file](main.cpp)\n");
  writeTextFile(folder.path() / "exercise.h", "/// {{task}}\nstd::vector<int> turned();\n");
  const std::string page = emptyWatchPage(exercise);
  EXPECT_THAT(page, HasSubstr("<h1 id=\"turn\">Turn</h1>"));
  EXPECT_THAT(page, HasSubstr("<math"));
  EXPECT_THAT(page, HasSubstr("<a href=\"https://a.b\">web</a> file"));
  EXPECT_THAT(page, HasSubstr("<td>Turns &#38; more</td><td>3</td>"));
  EXPECT_THAT(page, HasSubstr("<pre>/// {{task}}\nstd::vector&#60;int&#62; turned();"));
  EXPECT_THAT(page, HasSubstr("data-exercise=\"98-template\""));
  writeTextFile(folder.path() / "README.md", "$\\nonsense <b>$\n");
  EXPECT_THAT(emptyWatchPage(exercise), HasSubstr("<pre>$\\nonsense &#60;b&#62;$"));
}

TEST(WatchParts, SayWhatHasChanged) {
  const GradeResult before = resultWith(Outcome::kPass, Outcome::kFail);
  const std::string news = newsPart(resultWith(Outcome::kFail, Outcome::kPass), before);
  EXPECT_THAT(news, HasSubstr("<li>Fails now: the &#60;b&#62;hand&#60;/b&#62;</li>"));
  EXPECT_THAT(news, HasSubstr("<li>Now passes: the foot</li>"));
  EXPECT_EQ(newsPart(before, before), "As after the last save.");
  EXPECT_THAT(newsPart(before, {}), IsEmpty());
}

TEST(WatchParts, ShowPicturesAndReplaysOfChecksAndOfTheProgram) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "checks");
  for (const char* name : {"checks/hand.png", "checks/hand.html", "own.png", "results.json"})
    writeTextFile(folder.path() / name, name);
  std::filesystem::create_symlink("/etc/passwd", folder.path() / "linked.html");
  const GradeResult result = resultWith(Outcome::kFail, Outcome::kPass);
  const std::vector<WatchFile> files = filesOfChecks(result, folder.path());
  const std::string evidence = evidencePart(result, files);
  EXPECT_THAT(evidence, HasSubstr("<h3>the &#60;b&#62;hand&#60;/b&#62;</h3>"));
  EXPECT_THAT(evidence, HasSubstr("src=\"checks/hand.png?v="));
  EXPECT_THAT(evidence, HasSubstr("data-src=\"checks/hand.html?v="));
  const std::vector<WatchFile> own = filesOfProgram(folder.path());
  ASSERT_EQ(own.size(), 1u);
  EXPECT_EQ(own[0].bytes, "own.png");
  EXPECT_THAT(ownPart(own), HasSubstr("src=\"own.png?v="));
  EXPECT_THAT(filesOfProgram(folder.path() / "none"), IsEmpty());
}

TEST(WatchParts, OfferTheNextHintOfEachPart) {
  ExerciseInfo exercise;
  exercise.parts = {{.id = "a", .title = "A", .hints = {"one <", "two"}},
                    {.id = "b", .title = "B", .hints = {"b1"}}};
  EXPECT_THAT(hintsPart(exercise, {}), Not(HasSubstr("one")));
  EXPECT_THAT(hintsPart(exercise, {}), HasSubstr("data-hint=\"a\">Open hint 1 of 2"));
  const std::string later = hintsPart(exercise, {{"a", 1}, {"b", 99}});
  EXPECT_THAT(later, HasSubstr("<li>one &#60;</li>"));
  EXPECT_THAT(later, HasSubstr("data-hint=\"a\">Open hint 2 of 2"));
  EXPECT_THAT(later, Not(HasSubstr("data-hint=\"b\"")));
  EXPECT_THAT(hintsPart({}, {}), IsEmpty());
}

TEST(WatchParts, LeadToLinesInAnEditor) {
  GradeResult result = resultWith(Outcome::kFail, Outcome::kPass);
  result.compile.diagnostics = {
      {.file = "main.cpp", .line = 2, .severity = "warning", .message = "unused <x>"}};
  const std::string source = sourcePart(result, "int a;\nint b;\n", "/my course/main.cpp");
  EXPECT_THAT(source, HasSubstr("<a class=\"line\" href=\"vscode://file/my%20course/main.cpp:1\""));
  EXPECT_THAT(source, HasSubstr("Fails: the &#60;b&#62;hand&#60;/b&#62;"));
  EXPECT_THAT(source, HasSubstr("warning: unused &#60;x&#62;"));
}

}  // namespace rex::cli::watch_page_test
