// A class of 200 with names of twelve scripts, long, equal and empty ones, and with what spreadsheets add to
// them: from the release to the files for platforms, everyone is in every table and on every page.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/escape.h"
#include "base/process.h"
#include "base/text_file.h"
#include "commands/built_project.h"
#include "support/archive_samples.h"
#include "support/class_results.h"
#include "support/report_checker.h"

namespace rex::cli::real_names_test {

using ::testing::HasSubstr;
using Json = nlohmann::json;

constexpr int kPeople = 200;
constexpr const char* kExercise = "98-template";

struct RealPerson {
  std::string id{}, name{}, typed{};  // as people read it, and as the roster has it
  [[nodiscard]] std::string email() const { return id + "@uni.example"; }
  [[nodiscard]] std::string group() const {
    return id.ends_with('8') || id.ends_with('9') ? "team " + id.substr(1, 2) : "";
  }
};

std::vector<RealPerson> realClass() {
  // Persian and Sinhala with joiners, Hebrew with points, Japanese with a selector.
  const std::vector<std::string> names = {
      "Zoë O'Hara-Weiß",
      "\u0639\u0644\u06CC\u200C\u0631\u0636\u0627 \u062D\u0633\u06CC\u0646\u06CC",
      "\u05E9\u05B8\u05C1\u05E8\u05B8\u05D4",
      "\u0905\u0902\u0915\u093F\u0924 \u0936\u0930\u094D\u092E\u093E",
      "\u0DC1\u0DCA\u200D\u0DBB\u0DD3 \u0DBD\u0D82\u0D9A\u0DCF",
      "\u0E2A\u0E21\u0E0A\u0E32\u0E22",
      "\u738B\u5C0F\u660E",
      "\u845B\U000E0100\u57CE \u82B1",
      "\uAE40\uBBFC\uC218",
      "\u0416\u0430\u043D\u043D\u0430 \u0429\u0451\u0433\u043E\u043B\u0435\u0432\u0430",
      "\u0393\u03B9\u03CE\u03C1\u03B3\u03BF\u03C2",
      "\u10D2\u10D8\u10DD\u10E0\u10D2\u10D8 \u0531\u0580\u0561\u0574"};
  std::vector<RealPerson> all;
  for (int k = 0; k < kPeople; ++k) {
    RealPerson one{.id = fmt::format("s{:03}", k), .name = names[static_cast<std::size_t>(k) % names.size()]};
    if (k >= 12) one.name += fmt::format(" {}", k);
    if (k % 40 == 5) one.name = "Anna Schmidt";
    if (k % 40 == 6) one.name = std::string(180, 'l') + fmt::format("{}", k);
    if (k % 40 == 7) one.name = "=cmd|' /C calc'!A0";
    one.typed = k % 3 == 1   ? "\u200F" + one.name + "\u200E"
                : k % 3 == 2 ? "\uFEFF" + one.name + "\u00AD"
                             : one.name;
    all.push_back(std::move(one));
  }
  return all;
}

std::string quoted(std::string text) {
  for (std::size_t at = text.find('"'); at != text.npos; at = text.find('"', at + 2)) text.insert(at, 1, '"');
  return '"' + text + '"';
}

class RealNamesTest : public BuiltProject {
 protected:
  void SetUp() override {
    BuiltProject::SetUp();
    std::string roster = "id,name,email,group,number\n",
                sheet = "Identifier,Full name,Email address,Grade,Maximum Grade\n";
    std::vector<SampleMember> members;
    for (const RealPerson& one : all_) {
      // The roster of these does not know the name: Moodle does.
      roster += fmt::format("{},{},{},{},47{}\n", one.id, one.id.ends_with("50") ? "" : quoted(one.typed),
                            one.email(), one.group(), one.id.substr(1));
      sheet += fmt::format("Participant {},{},{},,10.00\n", 500 + std::stoi(one.id.substr(1)),
                           quoted(one.typed), one.email());
      std::string folder =
          fmt::format("{}_{}_assignsubmission_file_", one.typed, 500 + std::stoi(one.id.substr(1)));
      std::erase_if(folder,
                    [](char c) { return std::string_view("|'!/").find(c) != std::string_view::npos; });
      members.push_back(
          {.name = folder + "/" + std::string(100, 'd') + "/main.cpp", .text = "// " + one.id + "\n"});
    }
    write(root() / "students.csv", roster);
    write(root() / "sheet.csv", sheet);
    write(root() / "all.zip", zipOf(members));
    write(root() / "course.toml",
          "results = \"results\"\nstudents = \"students.csv\"\n[exercise.98-template]\n");
  }
  std::string in(const std::string& name) const { return (root() / name).string(); }
  // The results of a grading that did not compile anything.
  void gradeByHand() const {
    const Ended list = rex({"grade", in("handed-in"), "--course", in("course.toml"), "--manifest",
                            in("results/tasks.tsv"), "--level", "0", "--i-accept-level", "0"});
    EXPECT_EQ(list.code, 0) << list.error;
    for (const classroom::Task& task : classroom::readManifest(in("results/tasks.tsv")))
      saveSample(in("results"), task, classroom::sampleResult(3, 4, 3, kExercise),
                 readTextFile(root() / "results" / task.file));
  }
  Json csv(const std::string& file) const {
    const ProcessResult run =
        runProcess({kPython, sourcePath("tests/commands/instructor/read_exports.py"), "csv", in(file)});
    EXPECT_TRUE(run.ok()) << run.error;
    return Json::parse(run.output, nullptr, false);
  }
  // Everyone's name in that column, in rows that another column finds.
  void expectEveryone(const std::string& file, const std::string& key, const std::string& column,
                      const std::function<std::string(const RealPerson&)>& keyOf) const {
    const Json rows = csv(file);
    const auto indexOf = [&](const std::string& heading) {
      return static_cast<std::size_t>(std::find(rows[0].begin(), rows[0].end(), heading) - rows[0].begin());
    };
    std::map<std::string, std::string> names;
    for (const Json& row : rows) names[row.at(indexOf(key))] = row.at(indexOf(column));
    for (const RealPerson& one : all_) {
      const std::string shown = (one.name.starts_with('=') ? "'" : "") + one.name;
      EXPECT_EQ(names[keyOf(one)], shown) << file << " " << one.id;
    }
  }

  std::vector<RealPerson> all_ = realClass();
};

TEST_F(RealNamesTest, LeaveNobodyOutFromTheReleaseToThePlatforms) {
  EXPECT_EQ(rex({"dev", "release", in("students"), "--course", in("course.toml")}).code, 0);
  const Ended imported = rex({"import", "moodle", in("all.zip"), "-o", in("handed-in"), "--exercise", "98",
                              "--worksheet", in("sheet.csv")});
  EXPECT_EQ(imported.code, 0) << imported.error;
  EXPECT_THAT(flat(imported.output), HasSubstr("200 handed in, 0 nothing, 0 not taken. Files: 200 new"));
  gradeByHand();
  const Ended graded = rex(
      {"grade", "--collect", "-o", in("results"), "--course", in("course.toml"), "--report=markdown,junit"});
  EXPECT_EQ(graded.code, 0) << graded.error;
  EXPECT_THAT(flat(graded.error), HasSubstr("200 students: 200 graded"));
  EXPECT_THAT(flat(graded.error),
              HasSubstr("students.csv:3: left out of the name of 's001', where nobody sees it: "
                        "U+200E, U+200F"));
  const auto id = [](const RealPerson& one) { return one.id; };
  expectEveryone("results/grades.csv", "student", "name", id);
  expectEveryone("results/totals.csv", "student", "name", id);
  for (const std::vector<std::string>& target : {std::vector<std::string>{"gradescope"},
                                                 {"canvas"},
                                                 {"html"},
                                                 {"json"},
                                                 {"moodle", "98", "--worksheet", in("sheet.csv")}}) {
    std::vector<std::string> words = {"export",          target[0], in("results"), "--course",
                                      in("course.toml"), "-o",      in(target[0])};
    words.insert(words.end(), target.begin() + 1, target.end());
    const Ended ended = rex(words);
    EXPECT_EQ(ended.code, 0) << target[0] << ": " << ended.error;
  }
  expectEveryone("gradescope/grades.csv", "Email", "Name", [](const RealPerson& one) { return one.email(); });
  expectEveryone("canvas/grades.csv", "SIS Login ID", "Student", id);
  const Json sheet = csv("moodle/grades.csv");
  ASSERT_EQ(sheet.size(), all_.size() + 1);
  for (std::size_t k = 0; k < all_.size(); ++k) {
    EXPECT_EQ(sheet[k + 1][1], all_[k].typed) << "as Moodle has it";
    EXPECT_EQ(sheet[k + 1][3], "10") << all_[k].id;
  }
  const Json grades = Json::parse(fileText(root() / "json"));
  ASSERT_EQ(grades.at("students").size(), all_.size());
  for (std::size_t k = 0; k < all_.size(); ++k) {
    EXPECT_EQ(grades.at("students").at(k).at("name"), all_[k].name);
    const std::string page = fileText(root() / "html" / all_[k].id / kExercise / "feedback.html");
    EXPECT_THAT(page, HasSubstr("<bdi>" + htmlText(all_[k].name) + "</bdi>")) << all_[k].id;
  }
  const ProcessResult zip = runProcess(
      {kPython, "-c",
       "import sys, zipfile\nnames = zipfile.ZipFile(sys.argv[1]).namelist()\n"
       "assert all(len(p.encode()) <= 255 for n in names for p in n.split('/')), names\nprint(len(names))\n",
       in("moodle/feedback.zip")});
  EXPECT_EQ(zip.output, "200\n") << zip.error;
}

TEST_F(RealNamesTest, FindPeopleByAnyOfTheirKeys) {
  ASSERT_EQ(rex({"import", "moodle", in("all.zip"), "-o", in("handed-in"), "--exercise", "98", "--worksheet",
                 in("sheet.csv")})
                .code,
            0);
  gradeByHand();
  const auto explain = [&](const std::string& key) {
    return rex({"grade", "--explain", key, "98", "-o", in("results"), "--course", in("course.toml")});
  };
  const std::vector<std::string> keys = {"s001",       "S001",       "47001", "s001@uni.example",
                                         all_[1].name, all_[1].typed};
  for (const std::string& key : keys)
    EXPECT_THAT(explain(key).output, HasSubstr("(s001), 98-template: graded")) << key;
  EXPECT_THAT(flat(explain("Anna Schmidt").error),
              HasSubstr("several students are called 'Anna Schmidt': wanted one of the ids s005, "));
}

}  // namespace rex::cli::real_names_test
