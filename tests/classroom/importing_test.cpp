// Each importer on a synthetic class: what every student handed in must lie in one folder, under their name,
// with the platform's time, and whatever was not taken must be told.
#include "classroom/importing.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/instant.h"
#include "base/text_file.h"
#include "classroom/gradebook_text.h"
#include "classroom/submission_folder.h"
#include "support/expect_error.h"
#include "support/file_text.h"
#include "support/rounds.h"
#include "support/synthetic_class.h"
#include "support/temporary_folder.h"

namespace rex::classroom::importing_test {

namespace fs = std::filesystem;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kExercise = "01-kinematics";

class ImportingTest : public ::testing::Test {
 protected:
  ImportingTest() : all_(syntheticClass(rounds(12, 200), {"int honest;\n", "int wrong;\n", "int {\n"})) {
    exercises_.resize(2);
    exercises_[0].name = kExercise;
    exercises_[1].name = "02-control";
  }
  fs::path in(const std::string& name) const { return folder_.path() / name; }
  fs::path handedIn() const { return in("handed-in"); }
  fs::path zip(const std::string& name, const std::vector<SampleMember>& members) const {
    writeTextFile(in(name), zipOf(members));
    return in(name);
  }
  fs::path unpacked(const std::string& name, const std::vector<SampleMember>& members) const {
    for (const SampleMember& member : members) writeTextFile(in(name) / member.name, member.text);
    return in(name);
  }
  fs::path write(const std::string& name, const std::string& text) const {
    writeTextFile(in(name), text);
    return in(name);
  }
  ImportReport import(const DownloadedSubmissions& submissions,
                      const std::string& exercise = kExercise) const {
    return importSubmissions(submissions, {.exercises = exercises_, .exercise = exercise, .handedOut = {}},
                             handedIn());
  }
  DownloadedSubmissions moodle(const fs::path& source, const std::string& worksheet,
                               const std::string& zone = "Europe/Berlin") const {
    return readMoodle(source, {.worksheet = write("worksheet.csv", worksheet), .timeZone = zone}, exercises_);
  }

  int count(const std::function<bool(const SyntheticStudent&)>& fits) const {
    return static_cast<int>(std::count_if(all_.begin(), all_.end(), fits));
  }
  int attacks() const {
    return count([](const auto& one) { return one.work == SyntheticWork::kAttack; });
  }
  int missing() const {
    return count([](const auto& one) { return one.work == SyntheticWork::kMissing; });
  }

  using FolderOf = std::function<std::string(const SyntheticStudent&)>;
  // `isListed`: the platform names those who handed in nothing, too.
  void expectAll(const FolderOf& folderOf, const std::string& timeFrom, bool isListed) const {
    const ImportTable table = readImportTable(handedIn() / kImportTable);
    for (const SyntheticStudent& student : all_) {
      const ImportedExercise* told = table.find(folderOf(student), kExercise);
      if (student.work == SyntheticWork::kMissing) {
        EXPECT_EQ(told != nullptr, isListed) << student.name;
        EXPECT_TRUE(told == nullptr || told->status == SubmissionStatus::kNothing) << student.name;
        continue;
      }
      ASSERT_NE(told, nullptr) << student.name << " " << folderOf(student);
      if (student.work == SyntheticWork::kAttack) {
        EXPECT_EQ(told->status, SubmissionStatus::kRejected);
        EXPECT_THAT(told->why, HasSubstr("not accepted")) << student.name;
        EXPECT_FALSE(fs::exists(handedIn() / folderOf(student)));
        continue;
      }
      EXPECT_EQ(told->status, SubmissionStatus::kHandedIn) << student.name;
      EXPECT_EQ(fileText(handedIn() / told->handedInBy / kExercise / "main.cpp"), student.text)
          << student.name;
      EXPECT_EQ(told->timeFrom, timeFrom);
      EXPECT_TRUE(timeFrom == "file" || told->submitted == student.time) << student.name;
    }
    expectGradable();
  }
  // What `rex grade` finds: one file for each student or pair, and nothing to complain about.
  void expectGradable() const {
    const SubmittedFiles found = readSubmittedFiles(handedIn(), exercises_);
    EXPECT_THAT(found.complaints, IsEmpty());
    EXPECT_THAT(found.notes, IsEmpty());
    EXPECT_EQ(static_cast<int>(found.files.size()), count([](const SyntheticStudent& one) {
                return one.work != SyntheticWork::kMissing && one.work != SyntheticWork::kAttack &&
                       !one.isSecond;
              }));
  }

  TemporaryFolder folder_;
  std::vector<submission::ExerciseInfo> exercises_;
  std::vector<SyntheticStudent> all_;
};

std::string emailOf(const SyntheticStudent& student) { return student.email; }

TEST_F(ImportingTest, TakesMoodlesZipWithItsWorksheet) {
  const ImportReport report =
      import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  expectAll(emailOf, "platform", true);
  EXPECT_EQ(report.rejected, attacks());
  EXPECT_EQ(report.missing, missing());
  EXPECT_EQ(static_cast<int>(report.complaints.size()), attacks());
  EXPECT_EQ(report.timesOfPlatform, report.handedIn);
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.students.size(), all_.size());
  const ImportedStudent* twin = table.find(all_[7].email);
  ASSERT_NE(twin, nullptr);
  EXPECT_EQ(twin->name, "Jürgen Groß") << "composed";
  EXPECT_EQ(twin->exercises.at(kExercise).identifier, "Participant 507");
  EXPECT_EQ(twin->exercises.at(kExercise).maximumGrade, "100,00");
  EXPECT_EQ(table.find(all_[11].email, kExercise)->handedInBy, all_[10].email);
  EXPECT_EQ(table.find(all_[11].email, kExercise)->group, "Pair 0");
  EXPECT_FALSE(fs::exists(handedIn() / all_[11].email));
}

TEST_F(ImportingTest, TakesWhatWasUnpackedWithAFolderAroundAndAGermanWorksheet) {
  std::vector<SampleMember> members = moodleMembers(all_, kExercise);
  for (SampleMember& member : members) member.name = "Robotics-01-501/" + member.name;
  import(moodle(unpacked("all", members), moodleWorksheet(all_, true)));
  expectAll(emailOf, "platform", true);
}

TEST_F(ImportingTest, TakesMoodlesFlatFiles) {
  import(moodle(zip("all.zip", moodleMembers(all_, kExercise, true)), moodleWorksheet(all_)));
  expectAll(emailOf, "platform", true);
}

TEST_F(ImportingTest, TakesTheFolderNamesOfMoodleFrom4_1OnAlsoBesideOlderOnes) {
  std::vector<SampleMember> members = moodleMembers(all_, kExercise);
  for (SampleMember& member : members)  // all files of one person alike
    if (const std::size_t end = member.name.find("_/"); end % 4 != 3) member.name.erase(end, 1);
  import(moodle(zip("all.zip", members), moodleWorksheet(all_)));
  expectAll(emailOf, "platform", true);
}

// Teams have one folder, with the name and the number of the group, which a participant may have, too.
TEST_F(ImportingTest, TakesTheTeamsOfMoodleByTheColumnGroupOfTheWorksheet) {
  const std::vector<SampleMember> members = {
      {.name = "Pair one  best_12_assignsubmission_file/main.cpp", .text = "int pair;\n"},
      {.name = "Zoe OHara_12_assignsubmission_file/main.cpp", .text = "int zoe;\n"}};
  const std::pair<const char*, const char*> languages[] = {
      {"Identifier,Full name,Email address,Status,Group,Grade,Maximum Grade,Last modified (submission)",
       "\"Friday, 20 November 2026, 11:58 PM\""},
      {"ID,Vollständiger Name,E-Mail-Adresse,Status,Gruppe,Bewertung,Bestwertung,Zuletzt geändert (Abgabe)",
       "\"Freitag, 20. November 2026, 23:58\""},
      {"Identifiant,Nom complet,Adresse de courriel,Statut,Groupe,Note,Note maximale,Dernière modification "
       "(travail remis)",
       "\"vendredi 20 novembre 2026, 23:58\""}};
  for (const auto& [headings, time] : languages) {
    fs::remove_all(handedIn());
    std::string sheet = std::string(headings) + "\n";
    sheet += fmt::format("Participant 11,Ann,ann@x,s,Pair_one & best,,20,{}\n", time);
    sheet += fmt::format("Participant 12,Zoe O'Hara,zoe@x,s,,,20,{}\n", time);
    sheet += fmt::format("Participant 13,Bob,bob@x,s,Pair_one & best,,20,{}\n", time);
    sheet += "Participant 14,Cid,cid@x,s,,,20,-\n";
    const ImportReport report = import(moodle(zip("teams.zip", members), sheet));
    EXPECT_THAT(report.complaints, IsEmpty());
    EXPECT_EQ(report.handedIn, 3) << headings;
    EXPECT_EQ(report.missing, 1);
    const ImportTable table = readImportTable(handedIn() / kImportTable);
    for (const char* member : {"ann@x", "bob@x"}) {
      ASSERT_NE(table.find(member, kExercise), nullptr) << member;
      EXPECT_EQ(table.find(member, kExercise)->handedInBy, "ann@x");
      EXPECT_EQ(table.find(member, kExercise)->group, "Pair_one & best");
      EXPECT_EQ(table.find(member, kExercise)->submitted, parseInstant("2026-11-20T22:58:00Z"));
    }
    EXPECT_EQ(fileText(handedIn() / "ann@x" / kExercise / "main.cpp"), "int pair;\n");
    EXPECT_EQ(fileText(handedIn() / "zoe@x" / kExercise / "main.cpp"), "int zoe;\n");
  }
  fs::remove_all(handedIn());
  import(readMoodle(zip("teams.zip", members), {}, exercises_));
  EXPECT_EQ(fileText(handedIn() / "Pair one  best" / kExercise / "main.cpp"), "int pair;\n")
      << "the folder of a group, which counts for the members on the roster";
}

TEST_F(ImportingTest, TellsTwoOfOneNameApartByTheirNumbers) {
  const ImportReport report =
      import(readMoodle(zip("all.zip", moodleMembers(all_, kExercise)), {}, exercises_));
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  for (const char* name : {"Zoe Miller", "Jürgen Groß-506", "Jürgen Groß-507", "Adam O'Hara"})
    EXPECT_NE(table.find(name), nullptr) << name;
  EXPECT_EQ(fileText(handedIn() / "Jürgen Groß-507" / kExercise / "main.cpp"), all_[7].text);
  EXPECT_EQ(report.timesOfFiles, report.handedIn);
  EXPECT_THAT(report.notes, Contains(HasSubstr("known by the name alone")));
}

TEST_F(ImportingTest, TakesGradescopesExport) {
  const auto idOf = [](const SyntheticStudent& student) { return student.id; };
  const ImportReport report =
      import(readGradescope(zip("g.zip", gradescopeMembers(all_, kExercise)), exercises_));
  expectAll(idOf, "platform", false);
  EXPECT_EQ(static_cast<int>(report.complaints.size()), attacks());
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.find(all_[11].id, kExercise)->handedInBy, all_[10].id);
  EXPECT_EQ(table.find(all_[11].id, kExercise)->identifier, all_[11].id);
  EXPECT_EQ(table.find(all_[11].id)->email, all_[11].email);
}

TEST_F(ImportingTest, TakesFoldersOfFiles) {
  const auto nameOf = [](const SyntheticStudent& student) {
    return student.email.substr(0, student.email.find('@'));
  };
  for (SyntheticStudent& student : all_) student.isSecond = false, student.partner = -1;
  const ImportReport report = import(readFolders(unpacked("mails", folderMembers(all_)), exercises_));
  expectAll(nameOf, "file", false);
  EXPECT_EQ(static_cast<int>(report.complaints.size()), attacks());
  fs::remove_all(handedIn());
  std::vector<SampleMember> members = folderMembers(all_);
  for (SampleMember& member : members) member.name = "mails/" + member.name;
  import(readFolders(zip("mails.zip", members), exercises_));
  expectAll(nameOf, "file", false);
}

TEST_F(ImportingTest, BringsUpToDateAndSaysWhatHasChanged) {
  const auto again = [&] {
    return import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  };
  again();
  const std::string table = fileText(handedIn() / kImportTable);
  const ImportReport same = again();
  EXPECT_EQ(same.added + same.changed, 0);
  EXPECT_EQ(fileText(handedIn() / kImportTable), table);
  all_[0].text += "// better\n";
  all_[0].time += 3600;
  const ImportReport newer = again();
  EXPECT_EQ(newer.changed, 1);
  EXPECT_THAT(newer.changes,
              ElementsAre("student0@uni.example 01-kinematics: handed in " + syntheticInstant(all_[0].time) +
                          ", at the import before: " + syntheticInstant(all_[0].time - 3600)));
  expectAll(emailOf, "platform", true);
}

// As a process leaves it that was killed in the middle of an import which changes three files.
TEST_F(ImportingTest, GoesOnAfterAnInterruption) {
  const auto again = [&] {
    return import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  };
  const fs::path table = handedIn() / kImportTable, begun = handedIn() / kBegunTable;
  again();
  const std::string before = fileText(table),
                    old = fileText(handedIn() / all_[4].email / kExercise / "main.cpp");
  for (const std::size_t k : {0u, 1u, 4u}) all_[k].text += "// better\n";
  again();
  const std::string whole = fileText(table);
  EXPECT_FALSE(fs::exists(begun));
  fs::rename(table, begun);
  writeTextFile(table, before);
  writeTextFile(handedIn() / all_[4].email / kExercise / "main.cpp", old);  // not yet
  fs::remove(handedIn() / all_[1].email / kExercise / "main.cpp");          // lost
  writeTextFile(handedIn() / all_[0].email / kExercise / "main.cpp.999999999.new", "half");
  const ImportReport report = again();
  EXPECT_THAT(report.notes, Contains(HasSubstr("continues an interrupted import that had written ")));
  EXPECT_EQ(static_cast<int>(report.complaints.size()), attacks());
  EXPECT_EQ(fileText(table), whole);
  EXPECT_FALSE(fs::exists(begun));
  expectAll(emailOf, "platform", true);
  EXPECT_EQ(readImportTable(table).find(all_[0].email, kExercise)->attempts, 2);
  EXPECT_EQ(readImportTable(table).find(all_[5].email, kExercise)->attempts, 1);
}

// The first import of all was interrupted, and by the next one a student has handed in another file.
TEST_F(ImportingTest, KnowsItsFilesEvenIfTheDownloadHasChangedSince) {
  const auto again = [&] {
    return import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  };
  again();
  fs::rename(handedIn() / kImportTable, handedIn() / kBegunTable);
  all_[0].text += "// better\n";
  EXPECT_EQ(static_cast<int>(again().complaints.size()), attacks());
  expectAll(emailOf, "platform", true);
}

TEST_F(ImportingTest, CountsWhatGradescopeKeepsAsAttempts) {
  const std::string metadata =
      "submission_1:\n  :submitters:\n  - :name: Zoe\n    :sid: '31'\n  :history:\n  - :id: 7\n  - :id: 8\n"
      "submission_2:\n  :submitters:\n  - :name: Yan\n    :sid: '32'\n";
  import(readGradescope(zip("g.zip", {{.name = "submission_metadata.yml", .text = metadata},
                                      {.name = "submission_1/main.cpp", .text = "a"},
                                      {.name = "submission_2/w.zip",
                                       .text = zipOf(
                                           {{.name = "main.cpp",
                                             .text = "b" }}) }}),
                        exercises_));
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.find("31", kExercise)->attempts, 3);
  EXPECT_EQ(table.find("31", kExercise)->attemptsFrom, "platform");
  EXPECT_EQ(table.find("32", kExercise)->attempts, 1);
}

TEST_F(ImportingTest, BlamesNoExerciseForTheFaultOfAnother) {
  const auto received = [&](DownloadedFile file) {
    file.place = file.name;
    return DownloadedSubmissions{
        .platform = Platform::kFolders,
        .all = {{.people = {{.name = "Zoe"}},
                 .files = {{.name = "02/main.cpp", .place = "02/main.cpp", .text = "b"}, std::move(file)}},
                {.people = {{.name = "Yan"}},
                 .files = {{.name = "01/main.cpp", .place = "01/main.cpp", .text = "a"}}}}};
  };
  import(received({.name = "01/main.cpp", .whyNot = "a symbolic link"}), "");
  EXPECT_EQ(readImportTable(handedIn() / kImportTable).find("Zoe", "01-kinematics")->status,
            SubmissionStatus::kRejected);
  EXPECT_EQ(readImportTable(handedIn() / kImportTable).find("Zoe", "02-control")->status,
            SubmissionStatus::kHandedIn);
  fs::remove_all(handedIn());
  import(received({.name = "03/main.cpp", .text = "c"}), "");
  EXPECT_EQ(readImportTable(handedIn() / kImportTable).find("Zoe", "01-kinematics")->status,
            SubmissionStatus::kRejected)
      << "nobody knows which one was meant";
}

TEST_F(ImportingTest, ReplacesNothingThatNoImportWrote) {
  const auto again = [&] {
    return import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  };
  const fs::path foreign = handedIn() / all_[0].email / kExercise / "main.cpp",
                 edited = handedIn() / all_[4].email / kExercise / "main.cpp";
  writeTextFile(foreign, "foreign");
  EXPECT_THAT(again().complaints,
              Contains(HasSubstr("found a file that no import wrote, wanted none: remove it")));
  EXPECT_EQ(fileText(foreign), "foreign");
  writeTextFile(edited, "edited");
  EXPECT_THAT(again().complaints, Contains(HasSubstr("found a file that was edited since")));
  EXPECT_EQ(fileText(edited), "edited");
  fs::remove(edited), fs::remove(foreign);
  again();
  expectAll(emailOf, "platform", true);
}

TEST_F(ImportingTest, KeepsWhatIsNoLongerInTheDownload) {
  import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  all_[0].work = SyntheticWork::kMissing;
  const ImportReport report =
      import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  EXPECT_THAT(report.notes,
              Contains("student0@uni.example 01-kinematics: no longer in the download; the file of an "
                       "earlier import stays"));
  EXPECT_EQ(fileText(handedIn() / all_[0].email / kExercise / "main.cpp"), all_[0].text);
}

TEST_F(ImportingTest, RemovesTheOwnFileOfWhoJoinsAGroup) {
  const auto members = [&](bool isPair) {
    return std::vector<SampleMember>{
        {.name = isPair ? "A-Zoe_1_assignsubmission_file_/main.cpp" : "Zoe_1_assignsubmission_file_/main.cpp",
         .text = "// both"},
        {.name = isPair ? "A-Yan_2_assignsubmission_file_/main.cpp" : "Yan_2_assignsubmission_file_/main.cpp",
         .text = isPair ? "// both" : "// yan"}};
  };
  const std::string sheet =
      "Identifier,Full name,Email address\nParticipant 1,Zoe,zoe@x\nParticipant 2,Yan,yan@x\n";
  import(moodle(zip("a.zip", members(false)), sheet));
  EXPECT_TRUE(fs::exists(handedIn() / "yan@x"));
  const ImportReport pair = import(moodle(zip("a.zip", members(true)), sheet));
  EXPECT_FALSE(fs::exists(handedIn() / "zoe@x") && fs::exists(handedIn() / "yan@x"));
  EXPECT_THAT(pair.changes, Contains(HasSubstr("removed, now handed in by the group")));
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.find("zoe@x", kExercise)->handedInBy, table.find("yan@x", kExercise)->handedInBy);
}

TEST_F(ImportingTest, KnowsPeopleAgainInAnotherAssignment) {
  import(moodle(zip("all.zip", moodleMembers(all_, kExercise)), moodleWorksheet(all_)));
  for (SyntheticStudent& student : all_) student.number += 1000;
  import(moodle(zip("all.zip", moodleMembers(all_, "02-control")), moodleWorksheet(all_)), "02-control");
  const ImportTable table = readImportTable(handedIn() / kImportTable);
  EXPECT_EQ(table.students.size(), all_.size());
  EXPECT_EQ(table.find(all_[6].email, "01-kinematics")->identifier, "Participant 506");
  EXPECT_EQ(table.find(all_[6].email, "02-control")->identifier, "Participant 1506");
}

TEST_F(ImportingTest, FindsNamesThatCanBeFolders) {
  DownloadedSubmissions submissions{.platform = Platform::kGradescope};
  const auto arrive = [&](Person person) { submissions.all.push_back({.people = {std::move(person)}}); };
  arrive({.id = "../etc", .name = "A/B", .email = "X@Uni.Example", .number = "1"});
  arrive({.name = std::string("evil\nname"), .number = "2"});
  arrive({.name = "table.csv", .number = "3"});
  arrive({.name = "Bo", .number = "4"}), arrive({.name = "bO", .number = "5"});
  arrive({});
  import(submissions);
  std::vector<std::string> names;
  for (const ImportedStudent& student : readImportTable(handedIn() / kImportTable).students)
    names.push_back(student.student);
  EXPECT_THAT(names,
              ElementsAre("Bo-4", "bO-5", "participant-2", "student-1", "table.csv-3", "x@uni.example"));
}

TEST_F(ImportingTest, TellsWhatContradictsItself) {
  const std::string sheet =
      "Identifier,Full name,Email address\nParticipant 1,Zoe,zoe@x\nParticipant 2,Yan,zoe@x\n";
  const ImportReport twice =
      import(moodle(zip("a.zip", {{.name = "Zoe_1_assignsubmission_file_/main.cpp", .text = "a"},
                                  {.name = "Yan_2_assignsubmission_file_/main.cpp", .text = "b"}}),
                    sheet));
  EXPECT_THAT(twice.complaints, Contains(HasSubstr("a second file of zoe@x for 01-kinematics: not taken")));
  const DownloadedSubmissions group =
      moodle(zip("b.zip", {{.name = "A-Zoe_1_assignsubmission_file_/main.cpp", .text = "a"},
                           {.name = "A-Yan_2_assignsubmission_file_/main.cpp", .text = "b"},
                           {.name = "Xi_3_assignsubmission_file_/main.cpp", .text = "c"},
                           {.name = "Wu_4_assignsubmission_onlinetext_/onlinetext.html", .text = "<p>d"}}),
             sheet);
  EXPECT_THAT(group.complaints, IsEmpty()) << "all is taken";
  EXPECT_THAT(group.doubts, Contains(HasSubstr("other files than in 'A-Zoe_1_assignsubmission_file_'")));
  EXPECT_THAT(group.doubts, Contains(HasSubstr("participant 3 is not in the grading worksheet")));
  EXPECT_THAT(import(group).complaints, Contains(HasSubstr("not taken: an online text, no uploaded file")));
  const DownloadedSubmissions spelt = readFolders(unpacked("f", {{.name = "zoe.cpp", .text = "a"},
                                                                 {.name = "Zoe.zip", .text = "b"},
                                                                 {.name = "main.cpp", .text = "c"}}),
                                                  exercises_);
  EXPECT_THAT(spelt.complaints, Contains(HasSubstr("the same name as 'Zoe', spelt differently")));
  EXPECT_THAT(spelt.complaints, Contains(HasSubstr("main.cpp: whose?")));
}

TEST_F(ImportingTest, RefusesWorksheetsOfOtherKinds) {
  const fs::path source = zip("a.zip", {{.name = "Zoe_1_assignsubmission_file_/main.cpp", .text = "a"}});
  const auto expectRefusal = [&](const std::string& sheet, const std::string& text,
                                 const std::string& zone = "UTC") {
    EXPECT_REX_ERROR(moodle(source, sheet, zone), text);
  };
  expectRefusal("a,b\n1,2\n",
                "worksheet.csv:1: not Moodle's grading worksheet: found the columns a, b, wanted a column "
                "'Identifier' or 'ID'");
  expectRefusal("", "found an empty file, wanted a CSV file in UTF-8");
  expectRefusal("ID\n\xfc\n", "found text in another encoding than UTF-8");
  expectRefusal("ID\nZoe\n",
                "worksheet.csv:2: not Moodle's grading worksheet: found 'Zoe', wanted an identifier such as");
  expectRefusal("ID\nParticipant 1\nParticipant 1\n",
                "a second row for the same participant: found '1' again");
  expectRefusal("ID\nParticipant 2\n", "a grading worksheet of another assignment: found no participant 1");
  expectRefusal("ID;Last modified (submission)\nParticipant 1;soon\n",
                "worksheet.csv:2: not a time: found 'soon'");
  expectRefusal("ID,Last modified (submission)\nParticipant 1,20.11.2026 10:00\n", "a time without a zone",
                "");
}

TEST_F(ImportingTest, RefusesMetadataOfOtherKinds) {
  const auto expectRefusal = [&](const std::string& metadata, const std::string& text) {
    EXPECT_REX_ERROR(
        readGradescope(zip("g.zip", {{.name = "submission_metadata.yml", .text = metadata}}), exercises_),
        text);
  };
  expectRefusal("- a\n", "not Gradescope's metadata: found no table of submissions");
  expectRefusal("a: [\n", "submission_metadata.yml:2:1: not Gradescope's metadata: found ");
  expectRefusal(std::string(200'000, '['), "not Gradescope's metadata: found ");
  expectRefusal("submission_1:\n  :submitters:\n  - :name: Zoe\n  :created_at: soon\n",
                "not a time: found 'soon'");
  const DownloadedSubmissions odd = readGradescope(
      zip("g.zip",
          {{.name = "submission_metadata.yml",
            .text = "submission_1:\n  :submitters: []\nsubmission_2:\n  :submitters:\n  - :name: Zoe\n"},
           {.name = "submission_3/main.cpp", .text = "a"},
           {.name = "other.txt"}}),
      exercises_);
  EXPECT_THAT(odd.complaints, Contains(HasSubstr("submission_1: nobody handed this in")));
  EXPECT_THAT(odd.complaints,
              Contains("submission_3/main.cpp: of a submission that submission_metadata.yml does not name"));
  EXPECT_THAT(odd.notes, Contains("other.txt: ignored"));
  EXPECT_THAT(import(odd).complaints, Contains("submission_2: not taken: no files in the export"));
}

TEST_F(ImportingTest, SaysWhichImporterFits) {
  const fs::path moodles = zip("m.zip", moodleMembers(all_, kExercise)),
                 gradescopes = unpacked("g", gradescopeMembers(all_, kExercise)),
                 mails = unpacked("f", folderMembers(all_)),
                 ready = unpacked("r", {{.name = "zoe/01/main.cpp"}}),
                 other = unpacked("o", {{.name = "a/b.txt"}});
  unpacked("c", {{.name = "kinematics-zoe/.git/HEAD"}, {.name = "kinematics-zoe/01/main.cpp"}});
  EXPECT_REX_ERROR(readMoodle(gradescopes, {}, exercises_), "nothing that `rex import moodle` knows: found ");
  EXPECT_REX_ERROR(readMoodle(gradescopes, {}, exercises_), "`rex import gradescope` takes what is there");
  EXPECT_REX_ERROR(readFolders(moodles, exercises_), "`rex import moodle` takes what is there");
  EXPECT_REX_ERROR(readGradescope(mails, exercises_), "`rex import folders` takes what is there");
  EXPECT_REX_ERROR(readFolders(in("c"), exercises_), "`rex import git` takes what is there");
  EXPECT_REX_ERROR(readClones(ready, {}, exercises_), "`rex grade` takes what is there as it is");
  EXPECT_REX_ERROR(readMoodle(other, {}, exercises_),
                   "o: nothing that `rex import moodle` knows: found 1 file such as 'a");
  EXPECT_REX_ERROR(readMoodle(in("none"), {}, exercises_), "no such file or folder");
  EXPECT_REX_ERROR(readMoodle(write("a.txt", "a"), {}, exercises_),
                   "a.txt: not a download: found a file, wanted a .zip");
  EXPECT_REX_ERROR(readMoodle(write("broken.zip", "a"), {}, exercises_),
                   "broken.zip: this archive is not accepted");
  EXPECT_REX_ERROR(readClones(in("m.zip"), {}, exercises_), "no such folder");
}

TEST_F(ImportingTest, LeavesOutWhatIsHostileAndTakesTheRest) {
  const std::string zoe = "Zoe_1_assignsubmission_file_/", yan = "Yan_2_assignsubmission_file_/";
  const ImportReport report =
      import(readMoodle(zip("m.zip", {{.name = zoe + "main.cpp", .text = "int zoe;"},
                                      {.name = yan + "main.cpp", .text = "/etc/passwd", .mode = 0120777},
                                      {.name = "Xi_3_assignsubmission_file_/../../main.cpp", .text = "x"},
                                      {.name = "Wu_4_assignsubmission_file_/main.cpp", .text = "a"},
                                      {.name = "Wu_4_assignsubmission_file_/main.cpp", .text = "b"},
                                      {.name = "Vi\n_5_assignsubmission_file_/main.cpp", .text = "int vi;"},
                                      {.name = "Ud_6_assignsubmission_file_/main.cpp",
                                       .text = std::string(std::size_t{21} << 20, ' ')}}),
                        {}, exercises_));
  for (const char* why : {"found a symbolic link", "found a path out of its folder",
                          "found a second file of that name", "found more than 20 MiB"})
    EXPECT_THAT(report.complaints, Contains(HasSubstr(why)));
  EXPECT_EQ(fileText(handedIn() / "Zoe" / kExercise / "main.cpp"), "int zoe;");
  EXPECT_EQ(fileText(handedIn() / "Vi\n-5" / kExercise / "main.cpp"), "") << "no control characters";
  EXPECT_EQ(fileText(handedIn() / "participant-5" / kExercise / "main.cpp"), "int vi;");
  EXPECT_EQ(report.added, 2);
  EXPECT_FALSE(fs::exists(in("main.cpp")));
  fs::create_directories(in("l") / zoe);
  fs::create_symlink("/etc/passwd", in("l") / zoe / "main.cpp");
  EXPECT_THAT(import(readMoodle(in("l"), {}, exercises_)).complaints,
              Contains(HasSubstr("found a symbolic link")));
}

}  // namespace rex::classroom::importing_test
