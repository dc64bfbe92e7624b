// Course files, adjustments and exports, on results that are made by hand.
#include <nlohmann/json.hpp>

#include "base/process.h"
#include "base/sha256.h"
#include "classroom/tutors.h"
#include "cli/command_schema.h"
#include "commands/built_project.h"
#include "support/class_results.h"
#include "support/file_openings.h"
#include "support/paths.h"
#include "support/report_checker.h"

namespace rex::cli::course_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;
const std::string kEx = "98-template";

class CourseTest : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    save("zoe", 3, 4), save("adam", 3, 1), save("dora", 0, 0);
    write(root() / "course.toml", R"(title = "Robotics & Müller"
results = "results"
adjustments = "adjustments.toml"
[exercise.98-template]
deadline = 2023-11-14T00:00:00Z
percent_per_day = 10
[exercise.98-template.extensions]
adam = 2023-12-01T00:00:00Z
[[student]]
id = "zoe"
name = "Zoë <b> \"Müller\""
email = "zoe@uni.example"
group = "pair"
[[student]]
id = "yan"
name = "Yan, Y."
email = "yan@uni.example"
group = "pair"
[[student]]
id = "adam"
name = "=1+2"
[[student]]
id = "carl"
name = "Carl C."
email = "carl@uni.example"
)");
    write(root() / "adjustments.toml", R"([[adjustment]]
student = "zoe"
exercise = "98"
add = 0.5
reason = "a good question"
author = "A. Tutor"
date = 2026-12-01
[[comment]]
group = "pair"
exercise = "98"
line = 1
text = "Short & good."
author = "A. Tutor"
)");
  }
  fs::path results() const { return root() / "results"; }
  std::string course() const { return (root() / "course.toml").string(); }
  void save(const std::string& student, int hand, int turn) {
    const classroom::Task task = classroom::sampleTask(student, kEx);
    grading::GradeResult result = classroom::sampleResult(hand, turn, 0, kEx);
    result.checks[1].message = "PLANTED-" + student;
    saveSample(results(), task, result, "// PLANTED-" + student + "\n");
    tasks_.push_back(task);
    write(results() / "tasks.tsv", classroom::toManifest(tasks_));
  }
  Ended collect(std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"grade",    "--collect", "-o", results().string(),
                                          "--course", course()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  Ended collectWithout(std::vector<std::string> more) const {
    more.insert(more.begin(), "grade");
    more.insert(more.end(), {"-o", results().string(), "--course", course()});
    return rex(more);
  }
  Ended exported(const std::string& target, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments = {"export", target, results().string(),        "--course",
                                          course(), "-o",   (root() / target).string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  }
  Json readBack(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {kPython, sourcePath("tests/commands/instructor/read_exports.py")});
    const ProcessResult run = runProcess(arguments);
    EXPECT_TRUE(run.ok()) << run.error;
    return Json::parse(run.output, nullptr, false);
  }

  std::vector<classroom::Task> tasks_{};
};

TEST_F(CourseTest, CollectsARowForEveryoneAndListsOthersApart) {
  const Ended ended = collect({"--csv"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(ended.output, fileText(results() / "grades.csv"));
  EXPECT_THAT(
      ended.output,
      AllOf(
          HasSubstr("\nadam,'=1+2,,,98-template,graded,4,10,fail,,0,0,4,2023-11-14T22:13:20Z,table,adam,\n"),
          HasSubstr(",yan@uni.example,pair,98-template,late,7,10,fail,,1,0.7,6.3,"),
          HasSubstr(",late,7,10,fail,0.5,1,0.7,6.8,"),
          HasSubstr("\ncarl,Carl C.,carl@uni.example,,98-template,missing,,"), Not(HasSubstr("dora"))));
  EXPECT_THAT(fileText(results() / "not_on_roster.csv"), HasSubstr("\ndora,,,,98-template,late,0,10,"));
  EXPECT_THAT(fileText(results() / "totals.csv"), HasSubstr("\ncarl,Carl C.,carl@uni.example,,,0,"));
  EXPECT_THAT(flat(ended.error),
              AllOf(HasSubstr("'dora' is not on the roster: 98-template is graded and listed in"),
                    HasSubstr("4 students: 1 graded, 2 late, 1 missing")));
  EXPECT_EQ(rex({"grade", "--collect", "-o", results().string()}).code, 0);
  EXPECT_FALSE(fs::exists(results() / "totals.csv")) << "of a grade book that is no more";
}

TEST_F(CourseTest, ExplainsAGrade) {
  const Ended ended = collect({"--explain", "zoe", "98"});
  EXPECT_EQ(ended.code, 0) << ended.error;
  EXPECT_THAT(
      flat(ended.output),
      AllOf(HasSubstr("Checks: 7 of 10 points (fail)"), HasSubstr("1 day late: 0.7 of 7 points"),
            HasSubstr("Final points: 6.8 instead of 6.3 points: a good question (A. Tutor, 2026-12-01)"),
            HasSubstr("Final: 6.8 of 10 points")));
  EXPECT_THAT(collect({"--explain", "adam", "98"}).output,
              HasSubstr("Deadline 2023-12-01T00:00:00Z, an extension"));
  EXPECT_THAT(collect({"--explain", "dora", "98"}).output, HasSubstr("Remark: not on the roster"));
  const std::vector<std::string> byGrade = {"grade", "--explain", "zoe", "98", "--course", course()};
  EXPECT_EQ(rex(byGrade).output, ended.output) << "the results are those of the course file";
  const std::string json = collect({"--explain", "zoe", "98", "--json"}).output;
  EXPECT_EQ(schemaFaultsOf(json, "explain"), "");
  EXPECT_EQ(Json::parse(json).at("lines").back(), "Final: 6.8 of 10 points");
  const Ended nobody = collect({"--explain", "zo", "98"});
  EXPECT_EQ(nobody.code, 64);
  EXPECT_THAT(flat(nobody.error),
              HasSubstr("no grade of 'zo' for 98-template: wanted the id, number or name of a student, "
                        "and an exercise that was graded (did you mean 'zoe'?)"));
  EXPECT_EQ(collect({"--explain", "ZOË <b> \"müller\"", "98"}).output, ended.output);
  replace(course(), "Carl C.", "Yan, Y.");
  EXPECT_THAT(flat(collect({"--explain", "yan, y.", "98"}).error),
              HasSubstr("several students are called 'yan, y.': wanted one of the ids carl, yan"));
}

TEST_F(CourseTest, SharesTheClassAmongTutors) {
  const std::string secret = "the secret of the course", blind = classroom::blindId(secret, "adam");
  write(root() / "secret", secret + "\n");
  replace(course(), "results = \"results\"", "results = \"results\"\nsecret_file = \"secret\"");
  write(course(), fileText(course()) +
                      "[[tutor]]\nname = \"Ann\"\nadjustments = \"ann.toml\"\n[[tutor]]\n"
                      "name = \"Ben\"\nadjustments = \"ben.toml\"\n");
  EXPECT_EQ(exported("html", {"--tutor", "Ann"}).code, 0);
  EXPECT_TRUE(fs::exists(root() / "html/adam") && fs::exists(root() / "html/yan") &&
              !fs::exists(root() / "html/carl"));
  EXPECT_THAT(flat(exported("html", {"--tutor", "An"}).error),
              HasSubstr("--tutor: found 'An', wanted Ann, Ben (did you mean 'Ann'?)"));
  fs::remove_all(root() / "html");
  const Ended pages = exported("html", {"--tutor", "Ann", "--blind"});
  EXPECT_THAT(pages.output, HasSubstr("3 pages"));
  EXPECT_THAT(flat(pages.error), HasSubstr("Ben has not written"));
  EXPECT_FALSE(fs::exists(root() / "html/adam"));
  EXPECT_THAT(fileText(root() / "html" / blind / kEx / "feedback.html"),
              AllOf(HasSubstr(blind), Not(HasSubstr("=1+2"))));
  const auto decides = [&](const std::string& tutor, const std::string& student, int points) {
    return "[[adjustment]]\nstudent = \"" + student +
           "\"\nexercise = \"98\"\npoints = " + std::to_string(points) + "\nreason = \"r\"\nauthor = \"" +
           tutor + "\"\ndate = 2026-12-01\n";
  };
  write(root() / "ann.toml", decides("Ann", blind, 5));
  write(root() / "ben.toml",
        decides("Ben", "carl", 6) +
            "[[complaint]]\nstudent = \"zoe\"\nexercise = \"98\"\ndate = 2026-12-02\n"
            "text = \"It turns.\"\n[[complaint]]\nstudent = \"adam\"\nexercise = \"98\"\n"
            "date = 2026-12-01\ntext = \"x\"\nanswer = \"y\"\n");
  EXPECT_EQ(collect().code, 0);
  EXPECT_THAT(fileText(results() / "totals.csv"), AllOf(HasSubstr(",5,5,10\n"), HasSubstr(",6,6,")));
  const Ended complaints = collectWithout({"--complaints"});
  EXPECT_THAT(flat(complaints.output),
              AllOf(HasSubstr("zoe 98-template, 2026-12-02 (Ann, "), HasSubstr("It turns."),
                    HasSubstr("Final: 6.8 of 10 points"), HasSubstr("1 open, 1 answered")));
  write(root() / "ben.toml", decides("Ben", "adam", 6));
  const Ended conflict = collect();
  EXPECT_EQ(conflict.code, 2);
  EXPECT_THAT(flat(conflict.error),
              AllOf(HasSubstr("adam 98-template: 5 points (Ann: "), HasSubstr("6 points (Ben: "),
                    HasSubstr("none of it counts until the adjustments of the course decide")));
  EXPECT_EQ(exported("canvas").code, 2);
  replace(course(), "secret_file = \"secret\"", "");
  EXPECT_THAT(flat(exported("html", {"--blind"}).error), HasSubstr("wanted the secret_file of the course"));
  fs::remove(root() / "ann.toml");
  EXPECT_THAT(flat(exported("html", {"--blind"}).error), HasSubstr("--blind: found no secret of the course"));
}

TEST_F(CourseTest, ShowsItsRulesOnItsPages) {
  fs::create_directories(root() / "share" / "site");
  for (const char* file : {"style.css", "search.js"}) write(root() / "share" / "site" / file, "\n");
  const auto site = [&](const std::string& rules) {
    const std::string before = fileText(root() / "course.toml");
    replace(root() / "course.toml", "percent_per_day = 10\n", rules + "percent_per_day = 10\n");
    fs::remove_all(root() / "site");
    const Ended ended = rex({"dev", "site", "--course", course(), (root() / "site").string()});
    EXPECT_EQ(ended.code, 0) << ended.error;
    write(root() / "course.toml", before);
    return fileText(root() / "site" / "index.html");
  };
  const std::string page = (root() / "site" / "exercises" / (kEx + ".html")).string();
  EXPECT_THAT(site("bonus = true\n"), HasSubstr("<td>3, bonus</td><td></td><td>2023-11-14"));
  EXPECT_THAT(fileText(page), HasSubstr("The exercise is a bonus: its points come on top."));
  EXPECT_THAT(
      site("parts = [\"rotate\"]\nminimum_percent = 40\n"),
      AllOf(HasSubstr("<td>3</td><td>40 %</td><td></td><td>2023-11-14"),
            HasSubstr("<li>To pass, the minimum of every exercise that has one must be reached.</li>")));
  EXPECT_THAT(fileText(page), HasSubstr("The minimum is 40 % of these points."));
  write(root() / "course.toml",
        "[total]\npass_percent = 50.5\npass_exercises = 1\n[exercise.98-template]\n"
        "minimum_percent = 40\npercent_per_day = 10\n");
  EXPECT_THAT(site(""),
              HasSubstr("<ul>\n<li>To pass, 50.5 % of the possible points are needed.</li>\n"
                        "<li>To pass, the minimum must be reached in 1 of the exercises.</li>\n</ul>"));
}

TEST_F(CourseTest, ForgetsOnePersonOrAnOldTerm) {
  EXPECT_EQ(collect().code, 0);
  const auto forget = [&](std::vector<std::string> more) { return collectWithout(std::move(more)); };
  const Ended listed = forget({"--forget", "=1+2"});
  EXPECT_EQ(listed.code, 2) << listed.error;
  EXPECT_THAT(flat(listed.output),
              AllOf(HasSubstr("To be removed"), HasSubstr("results/adam"),
                    HasSubstr("tasks.tsv: rows of this table"), HasSubstr("Lines for you to take out (3)"),
                    HasSubstr("course.toml:8"), HasSubstr("Nothing is removed yet: with --accept, it is.")));
  EXPECT_TRUE(fs::exists(results() / "adam"));
  EXPECT_THAT(flat(forget({"--forget", "adam", "--accept"}).output),
              HasSubstr("Copies elsewhere stay: exports, backups, platforms."));
  EXPECT_FALSE(fs::exists(results() / "adam"));
  EXPECT_THAT(fileText(results() / "grades.csv"),
              AllOf(HasSubstr("\nadam,'=1+2,,,98-template,missing,"), HasSubstr("\nzoe,")));
  EXPECT_THAT(flat(forget({"--forget", "zoe"}).output), HasSubstr("it counts for yan, too"));
  EXPECT_THAT(
      flat(forget({"--forget", "dorra"}).error),
      HasSubstr("--forget: nobody is called 'dorra': wanted the id, number, e-mail, name or folder of "
                "a student (did you mean 'dora'?)"));
  EXPECT_THAT(flat(forget({"--forget-before", "2026-13-01"}).error),
              HasSubstr("--forget-before: found '2026-13-01', wanted a day such as 2026-03-31"));
  EXPECT_THAT(flat(forget({"--forget-before", "2020-01-01"}).output), HasSubstr("Nothing is to be removed."));
  EXPECT_EQ(forget({"--forget-before", "2024-01-01", "--accept"}).code, 0);
  EXPECT_FALSE(fs::exists(results() / "zoe") || fs::exists(results() / "grades.csv"));
}

// Reports say what people and lateness make of a result; results.json stays as it is.
TEST_F(CourseTest, ShowsAdjustmentsInEveryReport) {
  const std::string before = fileText(results() / "zoe/98-template/results.json");
  EXPECT_EQ(collect({"--report=markdown,gradescope,junit,github"}).code, 0);
  const fs::path zoe = results() / "zoe/98-template";
  EXPECT_EQ(fileText(zoe / "results.json"), before);
  for (const char* file : {"summary.md", "gradescope.json", "junit.xml", "github.txt"})
    EXPECT_THAT(fileText(zoe / file), AllOf(HasSubstr("a good question"), HasSubstr("6.8 of 10 points")))
        << file;
  EXPECT_THAT(fileText(zoe / "summary.md"),
              HasSubstr("## 98-template: 7 of 10 points\n\nYan, Y., Zoë &#60;b&#62; \"Müller\"\n\n- Final "
                        "points: 6.8 instead of"));
  EXPECT_EQ(Json::parse(fileText(zoe / "gradescope.json")).at("score"), 6.8);
  REX_NEEDS_REPORT_CHECKER();
  for (const auto& [format, file] : std::map<std::string, std::string>{{"markdown", "summary.md"},
                                                                       {"gradescope", "gradescope.json"},
                                                                       {"junit", "junit.xml"},
                                                                       {"github", "github.txt"}})
    EXPECT_EQ(schemaFaults(format, {zoe / file}), "") << format;
}

TEST_F(CourseTest, PrintsTheStateOfEachTaskAsJson) {
  fs::remove(results() / "adam/98-template/results.json");
  const Ended ended = collect({"--json"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_EQ(schemaFaultsOf(ended.output, "collect"), "");
  const Json json = Json::parse(ended.output);
  EXPECT_FALSE(json.at("complete"));
  EXPECT_EQ(json.at("tasks").at(0), (Json{{"task", 1},
                                          {"student", "zoe"},
                                          {"exercise", kEx},
                                          {"state", "graded"},
                                          {"points", 7},
                                          {"possible", 10},
                                          {"waiting", nullptr}}));
  EXPECT_EQ(json.at("tasks").at(1).at("state"), "missing");
  EXPECT_EQ(json.at("tasks").at(1).at("points"), nullptr);
  EXPECT_EQ(collect({"--json", "--csv"}).code, 64);
}

TEST_F(CourseTest, OpensEachResultOnce) {
  FileOpenings zoe(results() / "zoe" / kEx);
  int commands = 0;
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--report=markdown,gradescope,junit,github", "--json"},
        {"--explain", "zoe", "98"}}) {
    collect(more);
    EXPECT_EQ(zoe.of("results.json"), ++commands) << more[0];
  }
  for (const std::string target : {"json", "html", "canvas"}) {
    EXPECT_EQ(exported(target).code, 0);
    EXPECT_EQ(zoe.of("results.json"), ++commands) << target;
  }
  EXPECT_EQ(rex({"dev", "stats", results().string(), "--course", course()}).code, 0);
  EXPECT_EQ(zoe.of("results.json"), ++commands);
}

TEST_F(CourseTest, SaysThatAFolderOfResultsIsMissing) {
  for (const char* verb : {"grade", "export", "dev"}) {
    std::vector<std::string> words = {verb};
    if (words[0] == "grade") words.insert(words.end(), {"--collect", "-o"});
    if (words[0] == "export") words.emplace_back("json");
    if (words[0] == "dev") words.emplace_back("stats");
    words.push_back((root() / "result").string());
    const Ended ended = rex(words);
    EXPECT_EQ(ended.code, 64) << verb;
    EXPECT_THAT(flat(ended.error),
                HasSubstr("result: no such folder: wanted the folder of results that rex grade "
                          "wrote (did you mean 'results'?)"))
        << verb;
  }
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", course()}).error),
              HasSubstr("course.toml: not a folder: wanted the folder of"));
  EXPECT_THAT(flat(rex({"grade", "--collect", "-o", root().string()}).error),
              HasSubstr("no folder of results: wanted the one"));
  const Ended list =
      rex({"grade", "--collect", "-o", results().string(), "--manifest", (root() / "none.tsv").string()});
  EXPECT_EQ(list.code, 64);
  EXPECT_THAT(flat(list.error),
              HasSubstr("none.tsv: no such list of tasks: wanted one that rex grade --manifest"));
}

TEST_F(CourseTest, NamesThePlaceOfWhatIsWrong) {
  replace(root() / "course.toml", "id = \"yan\"", "id = \"ZOE\"");
  EXPECT_EQ(collect().code, 2);
  EXPECT_THAT(flat(collect().error), HasSubstr("course.toml:15:6: a second student with the id 'ZOE'"));
  replace(root() / "course.toml", "id = \"ZOE\"", "id = \"yan\"");
  replace(root() / "adjustments.toml", "student = \"zoe\"", "student = \"zo\"");
  EXPECT_THAT(flat(collect().error), HasSubstr("adjustments.toml:2:11: no student 'zo'"));
  EXPECT_EQ(collect({"--deadlines", course()}).code, 64) << "the dates are in the course file";
}

TEST_F(CourseTest, WritesFeedbackAndGradesForMoodle) {
  write(root() / "sheet.csv",
        "Identifier,\"Full name\",\"Email address\",Grade,\"Maximum Grade\",\"Last modified (grade)\"\n"
        "\"Participant 501\",Zoë_M,zoe@uni.example,,10.00,-\n\"Participant 502\",\"Yan, Y.\",,,10.00,-\n");
  const Ended ended = exported("moodle", {"98", "--worksheet", (root() / "sheet.csv").string()});
  EXPECT_EQ(ended.code, 2) << ended.error;
  EXPECT_THAT(flat(ended.error), HasSubstr("'adam' has a grade and no row in"));
  EXPECT_EQ(
      readBack({"moodle", (root() / "moodle").string()}),
      Json::parse(
          R"([["501", "assignsubmission_file", "feedback.html"], ["502", "assignsubmission_file", "feedback.html"]])"));
  const Json rows = readBack({"csv", (root() / "moodle/grades.csv").string()});
  EXPECT_EQ(rows[1], Json::parse(R"(["Participant 501", "Zoë_M", "zoe@uni.example", "6.8", "10.00", "-"])"));
  EXPECT_EQ(rows[2][3], "6.3");
  const Ended without = exported("moodle", {"98"});
  EXPECT_EQ(without.code, 2);
  EXPECT_THAT(flat(without.error),
              AllOf(HasSubstr("no grades are written without --worksheet"),
                    HasSubstr("no feedback is written: nobody's number in Moodle is known")));
}

TEST_F(CourseTest, WritesPagesThatHoldNothingOfOthers) {
  EXPECT_EQ(exported("html").code, 0);
  const Json pages = readBack({"html", (root() / "html").string()});
  EXPECT_EQ(pages.size(), 3u) << "carl handed in nothing, dora is not on the roster";
  for (const auto& [name, page] : pages.items()) {
    EXPECT_EQ(page.at("faults"), Json::array()) << name;
    const std::string text = page.at("text"), own = name.starts_with("adam") ? "adam" : "zoe",
                      other = own == "zoe" ? "adam" : "zoe";
    EXPECT_THAT(text, AllOf(HasSubstr("PLANTED-" + own), Not(HasSubstr("PLANTED-" + other)),
                            Not(HasSubstr("SECRET"))));
    EXPECT_THAT(page.at("tags"), Not(::testing::Contains("b"))) << "of the name";
    EXPECT_EQ(text.find("Short & good. (A. Tutor)") != std::string::npos, own == "zoe");
  }
  EXPECT_THAT(std::string(pages.at("zoe/98-template").at("text")), HasSubstr("Zoë <b> \"Müller\""));
  EXPECT_THAT(std::string(pages.at("yan/98-template").at("text")), Not(HasSubstr("a good question")));
}

TEST_F(CourseTest, WritesTablesForOtherPlatforms) {
  for (const char* target : {"gradescope", "canvas"}) {
    exported(target);
    const Json rows = readBack({"csv", (root() / target / "grades.csv").string()});
    for (const Json& row : rows) EXPECT_EQ(row.size(), rows[0].size()) << target;
    EXPECT_EQ(rows.size(), std::string(target) == "canvas" ? 6u : 5u);
  }
  EXPECT_EQ(readBack({"csv", (root() / "canvas/grades.csv").string()})[2],
            Json::parse(R"(["'=1+2", "", "adam", "adam", "", "4"])"));
}

TEST_F(CourseTest, WritesAllGradesForPrograms) {
  REX_NEEDS_REPORT_CHECKER();
  EXPECT_EQ(exported("json").code, 0);
  EXPECT_EQ(readBack({"json", (root() / "json").string(), sourcePath("share/grading/grades.schema.json")}),
            "valid");
  const Ended printed = rex({"export", "json", results().string(), "--course", course()});
  EXPECT_EQ(printed.output, fileText(root() / "json"));
}

TEST_F(CourseTest, TellsWrongUseOfExports) {
  const Ended none = rex({"export", "json", root().string()});
  EXPECT_EQ(none.code, 64);
  EXPECT_THAT(flat(none.error),
              HasSubstr("no folder of results: wanted the one that rex grade wrote, with tasks.tsv"));
  for (const fs::path& out : {results(), results() / "pages"}) {
    const Ended inside = rex({"export", "html", results().string(), "-o", out.string()});
    EXPECT_EQ(inside.code, 64);
    EXPECT_THAT(flat(inside.error),
                HasSubstr("--out: found " + out.string() + ", wanted a folder outside of the"));
  }
  write(results() / "tasks.tsv", classroom::toManifest({}));
  EXPECT_THAT(flat(exported("html").error),
              HasSubstr("nothing to export: found no grades, wanted an exercise"));
  EXPECT_THAT(flat(exported("html", {"98"}).error), HasSubstr("found no grades for 98-template"));
  EXPECT_EQ(rex({"export", "moodle", results().string(), "-o", "x"}).code, 64) << "without an exercise";
  EXPECT_THAT(rex({"export"}).output, HasSubstr("gradescope"));
}

// The same text, fewer points: people decide.
TEST_F(CourseTest, KeepsOldPointsUntilFewerAreAccepted) {
  fs::remove_all(results());
  const std::string broken = "int main() { return }\n";
  classroom::Task old = classroom::sampleTask("adam", kEx);
  old.sourceSha256 = sha256(broken);
  saveSample(results(), old, classroom::sampleResult(3, 4, 3, kEx), broken);
  fs::create_directories(root() / "in/adam/98-template");
  write(root() / "in/adam/98-template/main.cpp", broken);
  fs::create_directories(root() / "in/carl/98-tempalte");
  const auto grade = [&](std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {
        "grade", (root() / "in").string(), "--level", "0", "--i-accept-level", "0", "--course", course()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return rex(arguments);
  };
  const Ended held = grade();
  EXPECT_EQ(held.code, 1) << held.error;
  EXPECT_THAT(
      flat(held.error),
      AllOf(HasSubstr("adam 98-template: 0 points, 10 before; the points from before count until --accept"),
            HasSubstr("Graded again: 1 with other points, 0 with the same."),
            HasSubstr("fewer points than before wait for `rex grade --accept`: tasks 1")));
  EXPECT_THAT(fileText(results() / "regraded.csv"), HasSubstr("adam,98-template,10,0,before\n"));
  EXPECT_THAT(fileText(results() / "grades.csv"),
              AllOf(HasSubstr("98-template,late,10,10,pass,"),
                    HasSubstr("carl@uni.example,,98-template,not taken,")));
  write(results() / "regraded.csv", "of an earlier run");
  const Ended again = grade();
  EXPECT_EQ(again.code, 1);
  EXPECT_THAT(flat(again.error), HasSubstr("0 graded, 1 kept"));
  EXPECT_EQ(fileText(results() / "regraded.csv"), "of an earlier run") << "nothing was graded again";
  EXPECT_EQ(collect().code, 1);
  const Json task = Json::parse(collect({"--json"}).output).at("tasks").at(0);
  EXPECT_EQ(task.at("points"), 10);
  EXPECT_EQ(task.at("waiting"), 0);
  const Ended accepted = grade({"--accept"});
  EXPECT_EQ(accepted.code, 2) << "carl's folder could not be taken";
  EXPECT_THAT(flat(accepted.error), HasSubstr("adam 98-template: 0 points, 10 before Graded again"));
  EXPECT_THAT(fileText(results() / "grades.csv"), HasSubstr("98-template,late,0,"));
  EXPECT_FALSE(fs::exists(results() / "adam/98-template/regraded"));
  // Killed when the result had moved already.
  fs::create_directories(results() / "adam/98-template/regraded");
  write(results() / "adam/98-template/regraded/build.log", "the same");
  EXPECT_EQ(grade({"--accept"}).code, 2);
  EXPECT_FALSE(fs::exists(results() / "adam/98-template/regraded"));
  EXPECT_THAT(collect({"--explain", "carl", "98"}).output, HasSubstr("no exercise is called '98-tempalte'"));
}

TEST_F(CourseTest, AsksForAFolderOfResults) {
  fs::create_directories(root() / "in");
  const Ended ended = rex({"grade", (root() / "in").string()});
  EXPECT_EQ(ended.code, 64);
  EXPECT_THAT(flat(ended.error),
              HasSubstr("--out: found no folder, wanted one for the results, here or in the course file"));
}

}  // namespace rex::cli::course_test
