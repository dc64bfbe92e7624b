#include "cli/student/watch_page.h"

#include <gmock/gmock.h>

#include "base/text_file.h"
#include "support/temporary_folder.h"

namespace rex::cli::watch_page_test {

using grading::CheckResult;
using grading::GradeResult;
using grading::Outcome;
using testing::HasSubstr;
using testing::Not;

GradeResult resultWith(Outcome first, Outcome second) {
  GradeResult result;
  result.exerciseId = "98-template";
  result.outcome = first == Outcome::kPass && second == Outcome::kPass ? Outcome::kPass : Outcome::kFail;
  CheckResult hand{.id = "hand", .title = "the <b>hand</b>", .status = first, .maxPoints = 1};
  hand.picture = "checks/hand.png", hand.replay = "checks/hand.html";
  result.checks = {hand, {.id = "foot", .title = "the foot", .status = second, .maxPoints = 1}};
  return result;
}

TEST(WatchPage, ShowsChecksPicturesAndWhatHasChanged) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "checks");
  writeTextFile(folder.path() / "checks/hand.png", "picture");
  writeTextFile(folder.path() / "checks/hand.html", "replay");
  const GradeResult before = resultWith(Outcome::kPass, Outcome::kFail);
  const std::string page =
      watchPage(resultWith(Outcome::kFail, Outcome::kPass), before, "int main() {}", folder.path());
  EXPECT_THAT(page, HasSubstr("<meta http-equiv=\"refresh\" content=\"2\">"));
  EXPECT_THAT(page, HasSubstr("<li>Fails now: the &#60;b&#62;hand&#60;/b&#62;</li>"));
  EXPECT_THAT(page, HasSubstr("<li>Now passes: the foot</li>"));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,cGljdHVyZQ=="));
  EXPECT_THAT(page, HasSubstr("<a href=\"checks/hand.html\">"));
  EXPECT_THAT(page, HasSubstr("int main() {}"));
  EXPECT_THAT(page, Not(HasSubstr("<b>hand")));
}

TEST(WatchPage, SaysWhetherNothingHasChanged) {
  const TemporaryFolder folder;
  const GradeResult result = resultWith(Outcome::kPass, Outcome::kPass);
  EXPECT_THAT(watchPage(result, result, "", folder.path()), HasSubstr("As after the last save."));
  EXPECT_THAT(watchPage(result, {}, "", folder.path()), Not(HasSubstr("last save")));
}

TEST(WatchPage, WaitsForAResult) {
  const TemporaryFolder folder;
  WatchPage page(folder.path(), folder.path() / "main.cpp");
  EXPECT_FALSE(page.renew());
  EXPECT_FALSE(std::filesystem::exists(page.file()));
}

}  // namespace rex::cli::watch_page_test
