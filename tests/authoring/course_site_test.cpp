#include "authoring/course_site.h"

#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/text_file.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/paths.h"
#include "support/temporary_folder.h"

namespace rex::authoring::course_site_test {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class CourseSiteTest : public ::testing::Test {
 protected:
  fs::path out() const { return temporary_.path() / "site"; }
  TemporaryFolder temporary_;
};

// Every link and picture leads to a file of the site, and every anchor exists. Returns the number of pages.
int expectLiveLinks(const fs::path& site, int fewest) {
  int links = 0, pages = 0;
  // Shorter than what a page embeds: std::regex calls itself for each character.
  static const std::regex kTarget(R"re((href|src)="([^"#]{0,300})(#([^"]{0,300}))?")re");
  for (const auto& entry : fs::recursive_directory_iterator(site)) {
    const bool isReplay = entry.path().parent_path().filename() == "demonstrations";  // if there are some
    if (entry.path().extension() != ".html" || isReplay) continue;
    ++pages;
    const std::string html = fileText(entry.path());
    for (std::sregex_iterator found(html.begin(), html.end(), kTarget), end; found != end; ++found) {
      const std::string target = (*found)[2], anchor = (*found)[4];
      if (target.starts_with("http")) continue;
      ++links;
      const fs::path file = target.empty() ? entry.path() : entry.path().parent_path() / target;
      EXPECT_TRUE(fs::is_regular_file(file)) << entry.path() << ": " << (*found)[0];
      const std::string id = anchor.empty() ? "" : "id=\"" + anchor + "\"";
      EXPECT_THAT(fileText(file), HasSubstr(id)) << entry.path();
    }
  }
  EXPECT_GT(links, fewest);
  return pages;
}

// The project itself.
TEST_F(CourseSiteTest, HasNoDeadLinks) {
  const CourseSite site = writeCourseSite(homeFolder(), out());
  ASSERT_TRUE(site.scan.leaks.empty()) << toString(site.scan.leaks.front());
  EXPECT_EQ(expectLiveLinks(out(), 200), site.pages);
  EXPECT_GT(site.pages, 25);
  EXPECT_THAT(fileText(out() / "index.html"), HasSubstr("<a href=\"exercises/05-car.html\">05-car</a>"));
  EXPECT_THAT(fileText(out() / "exercises" / "05-car.html"), HasSubstr("exercise.h</h2>"));
  EXPECT_TRUE(fs::exists(out() / "documents" / "gallery" / "motion.png"));
  EXPECT_THAT(fileText(out() / "entries.js"),
              HasSubstr("\"url\":\"exercises/05-car.html#part-4-resampling-723-3-points\""));
  EXPECT_THAT(fileText(out() / "entries.js"), Not(HasSubstr("</")));
  EXPECT_THAT(fileText(out() / "documents" / "course-map.html"),
              HasSubstr("<a href=\"../exercises/00b-frames.html\"><code>00b</code></a> 3"));
  const std::string demonstrations = fileText(out() / "documents" / "demonstrations.html");
  EXPECT_THAT(demonstrations, HasSubstr("u = Kp (q* - q)"));
  EXPECT_THAT(demonstrations, HasSubstr("3:15 to 3:17"));
  EXPECT_FALSE(fs::exists(out() / "notes"));
  EXPECT_THAT(fileText(out() / "index.html"), Not(HasSubstr("notes/")));
}

TEST_F(CourseSiteTest, HasOnlyWhatTheCourseHas) {
  const SitePlan plan{.title = "Winter",
                      .exercises = {{.name = "01-kinematics", .deadline = "1 May"}, {.name = "05-car"}}};
  const CourseSite site = writeCourseSite(homeFolder(), out(), {}, SiteReaders::kEverybody, plan);
  ASSERT_TRUE(site.scan.leaks.empty()) << toString(site.scan.leaks.front());
  EXPECT_EQ(expectLiveLinks(out(), 50), site.pages);
  const std::string index = fileText(out() / "index.html");
  EXPECT_THAT(index, HasSubstr("<h1>Winter</h1>"));
  EXPECT_THAT(index, HasSubstr("<td>1 May</td>"));
  EXPECT_THAT(index, Not(HasSubstr("06-kalmanSLAM")));
  for (const char* file :
       {"documents/grading.html", "documents/sandbox.html", "exercises/06-kalmanSLAM.html"})
    EXPECT_FALSE(fs::exists(out() / file)) << file;
  EXPECT_THAT(index, AllOf(Not(HasSubstr("minimum")), Not(HasSubstr("What counts"))));
  const std::string exercise = fileText(out() / "exercises/05-car.html");
  EXPECT_THAT(exercise, AllOf(HasSubstr("rex run 05-car"), Not(HasSubstr("scripts/rex "))));
}

TEST_F(CourseSiteTest, SaysWhatCountsInTheCourse) {
  const SitePlan plan{.exercises = {{.name = "10-planning2d", .parts = {"bug", "field"}, .minimum = "40 %"},
                                    {.name = "12-trajectory", .isBonus = true}},
                      .rules = {"The best 3 count."}};
  static_cast<void>(writeCourseSite(homeFolder(), out(), {}, SiteReaders::kEverybody, plan));
  const std::string index = fileText(out() / "index.html");
  EXPECT_THAT(index, HasSubstr("<th>points</th><th>minimum</th></tr>"));
  EXPECT_THAT(index, HasSubstr("<td>7</td><td>40 %</td></tr>"));
  EXPECT_THAT(index, HasSubstr("<td>20, bonus</td><td></td></tr>"));
  EXPECT_THAT(index, HasSubstr("<h2>What counts</h2>\n<ul>\n<li>The best 3 count.</li>"));
  const std::string parts = fileText(out() / "exercises/10-planning2d.html");
  EXPECT_THAT(parts, HasSubstr("<td>does not count</td>"));
  EXPECT_THAT(parts, HasSubstr("<tr><th>together</th><th>7</th></tr>\n</table>\n"
                               "<p>The minimum is 40 % of these points.</p>"));
  EXPECT_THAT(fileText(out() / "exercises/12-trajectory.html"),
              HasSubstr("<p>The exercise is a bonus: its points come on top.</p>"));
}

TEST_F(CourseSiteTest, HasNotesForLecturers) {
  const CourseSite site = writeCourseSite(homeFolder(), out(), {}, SiteReaders::kLecturers);
  ASSERT_TRUE(site.scan.leaks.empty()) << toString(site.scan.leaks.front());
  EXPECT_EQ(expectLiveLinks(out(), 200), site.pages);
  EXPECT_THAT(fileText(out() / "index.html"), HasSubstr("<a href=\"notes/05-car.html\">Notes on 05 "));
  int notes = 0;
  for (const auto& entry : fs::directory_iterator(out() / "notes")) {
    ++notes;
    const std::string html = fileText(entry.path());
    EXPECT_THAT(html, HasSubstr("students must not get this page"));
    EXPECT_THAT(html, HasSubstr("<math"));
    EXPECT_THAT(html, Not(HasSubstr("$"))) << entry.path() << ": a formula that was not recognised";
    EXPECT_THAT(html, Not(HasSubstr("\\frac"))) << entry.path();
  }
  const auto count = std::distance(fs::directory_iterator(sourcePath("notes")), fs::directory_iterator());
  EXPECT_EQ(notes, count);
}

TEST_F(CourseSiteTest, SaysWhatIsWrongWithNotes) {
  const fs::path root = temporary_.path() / "course";
  fs::create_directories(root / "exercises");
  const auto written = [&] { static_cast<void>(writeCourseSite(root, out(), {}, SiteReaders::kLecturers)); };
  EXPECT_REX_ERROR(written(), "notes: no lecturer's notes: wanted files such as 01-kinematics.md");
  writeTextFile(root / "notes" / "01-a.md", "# A\n\n$\\fraq{1}{2}$\n");
  EXPECT_REX_ERROR(written(), "notes/01-a.md: cannot read the formula '\\fraq{1}{2}'");
  EXPECT_FALSE(fs::exists(out()));
}

// A course with one exercise, whose README is that text.
fs::path writeSmallCourse(const fs::path& root, const std::string& readme) {
  const fs::path exercise = root / "exercises" / "98-a";
  writeTextFile(
      exercise / "exercise.toml",
      "title = \"T\"\nscript = \"1\"\n[[part]]\nid = \"p\"\ntitle = \"P\"\npoints = 1\nhints = [\"h?\"]\n");
  writeTextFile(exercise / "exercise.h", "double f(double x);\n");
  writeTextFile(exercise / "solution.cpp",
                "// <solution f>\ndouble f(double x) {\n  return 7 * std::sin(x) + 31 * std::cos(x);\n}\n// "
                "<todo>\n// </solution>\n");
  writeTextFile(exercise / "check.cpp", "\n");
  for (const char* file : {"style.css", "search.js"}) writeTextFile(root / "share" / "site" / file, "");
  writeTextFile(exercise / "README.md", "# 98\n\n" + readme + "\n");
  return root;
}

TEST_F(CourseSiteTest, WritesNothingThatLeaks) {
  const fs::path root =
      writeSmallCourse(temporary_.path() / "course", "    return 7 * std::sin(x) + 31 * std::cos(x);");
  const CourseSite site = writeCourseSite(root, out());
  ASSERT_FALSE(site.scan.leaks.empty());
  std::string leaks;
  for (const Leak& leak : site.scan.leaks) leaks += toString(leak) + "\n";
  EXPECT_THAT(leaks, HasSubstr("98-a.html:"));
  EXPECT_THAT(leaks, HasSubstr("entries.js:")) << "the search would give it away, too";
  EXPECT_FALSE(fs::exists(out()));
}

// The solution has drawn the second and the third picture named in the README, and one of two demonstrations
// was played.
TEST_F(CourseSiteTest, ShowsPicturesOfExercisesAndPlaysDemonstrations) {
  const fs::path root =
      writeSmallCourse(temporary_.path() / "course", "`none.png` and `curve.png`, `last.png`");
  for (const char* picture : {"curve", "last"})
    writeTextFile(root / "out" / "98-a-solution" / (std::string(picture) + ".png"), picture);
  writeTextFile(root / "share" / "demonstrations" / "pid.cpp", "// Chapter 3: PID <now>. It & overshoots.\n");
  writeTextFile(root / "share" / "demonstrations" / "tree.cpp", "// Chapter 4: A tree. It grows.\n");
  writeTextFile(root / "out" / "demonstrations" / "pid.html", "it plays");
  const CourseSite site = writeCourseSite(root, out());
  ASSERT_TRUE(site.scan.leaks.empty()) << toString(site.scan.leaks.front());
  EXPECT_EQ(site.drawn, 1);
  EXPECT_EQ(site.exercises, 1);
  EXPECT_EQ(site.playing, 1);
  EXPECT_EQ(site.demonstrations, 2);
  EXPECT_EQ(site.pages, 4) << "first page, exercise, list of demonstrations, one that plays";
  EXPECT_EQ(fileText(out() / "exercises" / "98-a.png"), "curve");
  EXPECT_THAT(fileText(out() / "index.html"), HasSubstr("src=\"exercises/98-a.png\""));
  EXPECT_EQ(fileText(out() / "demonstrations" / "replays" / "pid.html"), "it plays");
  EXPECT_THAT(fileText(out() / "demonstrations" / "pid.html"),
              AllOf(HasSubstr("<iframe src=\"replays/pid.html\""), HasSubstr("It &amp; overshoots.")));
  EXPECT_THAT(fileText(out() / "documents" / "demonstrations.html"),
              AllOf(HasSubstr("href=\"../demonstrations/pid.html\""), HasSubstr("<strong>A tree</strong>"),
                    Not(HasSubstr("tree.html"))));
  EXPECT_THAT(fileText(out() / "entries.js"), HasSubstr("\"url\":\"demonstrations/pid.html#"));
  EXPECT_EQ(fileText(root / "out" / "demonstrations" / "pid.html"), "it plays") << "copied";
}

TEST_F(CourseSiteTest, OverwritesNothing) {
  writeTextFile(out() / "notes.txt", "mine");
  EXPECT_REX_ERROR(static_cast<void>(writeCourseSite(homeFolder(), out())),
                   "will not overwrite: wanted an empty or new folder");
  EXPECT_REX_ERROR(static_cast<void>(writeCourseSite(homeFolder(), "/proc/site")), "cannot write");
  EXPECT_REX_ERROR(static_cast<void>(writeCourseSite(homeFolder(), out() / std::string(300, 'x'))),
                   "cannot write the pages of the course: found File name too long");
  EXPECT_EQ(fileText(out() / "notes.txt"), "mine");
}

}  // namespace rex::authoring::course_site_test
