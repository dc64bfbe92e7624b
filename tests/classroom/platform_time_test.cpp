#include "classroom/platform_time.h"

#include <ctime>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include "base/instant.h"
#include "base/rng.h"
#include "classroom/gradebook_text.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::platform_time_test {

std::string instant(const std::string& text, const std::string& zone) {
  return instantText(PlatformZone(zone).toInstant(text, "grades.csv:3"));
}

TEST(PlatformTime, ReadsWhatPlatformsWrite) {
  const PlatformTime wanted{2026, 11, 20, 23, 58, 0, {}};
  for (const char* text :
       {"Friday, 20 November 2026, 11:58 PM", "Friday, November 20, 2026, 11:58 PM", "20 Nov 2026, 23:58",
        "Freitag, 20. November 2026, 23:58", "Fr, 20. Nov. 2026, 23:58 Uhr", "20.11.2026 23:58",
        "20.11.2026, 23:58", "2026-11-20 23:58", "2026-11-20T23:58:00",
        "Friday, 20 November 2026 at 11:58 PM", "Freitag, 20. November 2026 um 23:58 Uhr",
        " Friday, 20 November 2026, 11:58\u202FPM "})
    EXPECT_EQ(parsePlatformTime(text), wanted) << text;
  EXPECT_EQ(parsePlatformTime("Montag, 1. Ma\u0308rz 2027, 00:05"), (PlatformTime{2027, 3, 1, 0, 5, 0, {}}));
  EXPECT_EQ(parsePlatformTime("lundi 1 mars 2027, 00:05"), (PlatformTime{2027, 3, 1, 0, 5, 0, {}}));
  EXPECT_EQ(parsePlatformTime("dimanche 15 ao\u00FBt 2027, 14:05"),
            (PlatformTime{2027, 8, 15, 14, 5, 0, {}}));
  EXPECT_EQ(parsePlatformTime("Samstag, 2. Jänner 2027, 12:00"), (PlatformTime{2027, 1, 2, 12, 0, 0, {}}));
  EXPECT_EQ(parsePlatformTime("1 May 2026, 12:05 AM"), (PlatformTime{2026, 5, 1, 0, 5, 0, {}}));
  EXPECT_EQ(parsePlatformTime("1 May 2026, 12:05 PM"), (PlatformTime{2026, 5, 1, 12, 5, 0, {}}));
  EXPECT_EQ(parsePlatformTime("2026-11-20 23:58:01.250000000 -08:00"),
            (PlatformTime{2026, 11, 20, 23, 58, 1, -8 * 3600}));
  EXPECT_EQ(parsePlatformTime("2026-11-20 23:58:01 UTC"), (PlatformTime{2026, 11, 20, 23, 58, 1, 0}));
}

TEST(PlatformTime, GuessesNothing) {
  for (const char* text : {"", "-", "yesterday", "11/10/2026 11:58", "20 November 2026",
                           "31 November 2026, 11:58 PM", "Monday, 20 November 2026, 11:58 PM",
                           "20 November 2026, 13:58 PM", "20 November 2026, 25:00", "20 Brumaire 2026, 10:00",
                           "2026-11-20 23:58 CET", "20 November 26, 10:00", "20 20 November 2026, 10:00"})
    EXPECT_EQ(parsePlatformTime(text), std::nullopt) << text;
}

TEST(PlatformZone, KnowsSummerAndWinter) {
  EXPECT_EQ(instant("20.11.2026 23:58", "Europe/Berlin"), "2026-11-20T22:58:00Z");
  EXPECT_EQ(instant("20.07.2026 23:58", "Europe/Berlin"), "2026-07-20T21:58:00Z");
  EXPECT_EQ(instant("20.11.2026 23:58", "+05:30"), "2026-11-20T18:28:00Z");
  EXPECT_EQ(instant("20.11.2026 23:58", "UTC"), "2026-11-20T23:58:00Z");
  EXPECT_EQ(instant("2026-11-20 23:58:00 -0100", "Europe/Berlin"), "2026-11-21T00:58:00Z")
      << "it says its zone";
  // The hour that exists twice is the earlier one, in favour of the student.
  EXPECT_EQ(instant("25.10.2026 02:30", "Europe/Berlin"), "2026-10-25T00:30:00Z");
  EXPECT_REX_ERROR(instant("29.03.2026 02:30", "Europe/Berlin"),
                   "grades.csv:3: an hour that does not exist in Europe/Berlin: found '29.03.2026 02:30'");
}

// The C library reads the same files by code of its own.
TEST(PlatformZone, AgreesWithTheCLibrary) {
  Rng rng(1);
  for (const char* zone : {"Europe/Berlin", "America/New_York", "Australia/Lord_Howe", "Asia/Kathmandu"}) {
    ::setenv("TZ", zone, 1);
    ::tzset();
    int same = 0;
    for (int k = 0; k < 500; ++k) {
      const std::time_t time = 1'500'000'000 + 60 * rng.index(10'000'000);
      std::tm local{};
      ::localtime_r(&time, &local);
      char text[32];
      std::strftime(text, sizeof text, "%d.%m.%Y %H:%M", &local);
      const std::int64_t found = PlatformZone(zone).toInstant(text, "x");
      EXPECT_TRUE(found == time || (found < time && time - found <= 3600)) << zone << " " << text;
      same += found == time ? 1 : 0;
    }
    EXPECT_GT(same, 490) << "an hour a year exists twice";
  }
  ::unsetenv("TZ");
}

TEST(PlatformZone, WritesTheOffsetOfAZone) {
  for (const auto& [zone, text] : {std::pair("", "2026-11-20T22:58:00Z"),
                                   {"UTC", "2026-11-20T22:58:00+00:00"},
                                   {"Europe/Berlin", "2026-11-20T23:58:00+01:00"},
                                   {"America/New_York", "2026-11-20T17:58:00-05:00"},
                                   {"-03:30", "2026-11-20T19:28:00-03:30"}})
    EXPECT_EQ(PlatformZone(zone).toText(parseInstant("2026-11-20T22:58:00Z").value()), text);
}

TEST(PlatformZone, SaysWhatItWants) {
  EXPECT_REX_ERROR(instant("20.11.2026 23:58", ""),
                   "grades.csv:3: a time without a zone: found '20.11.2026 23:58', wanted --time-zone ZONE");
  EXPECT_REX_ERROR(instant("soon", "UTC"), "grades.csv:3: not a time: found 'soon', wanted a time such as");
  for (const char* zone : {"Europe/Belin", "../../etc/passwd", "/etc/passwd", "+25:00", "Europe"})
    EXPECT_REX_ERROR(PlatformZone{zone},
                     "not a time zone: found '" + std::string(zone) + "', wanted a name such as");
}

TEST(ComposedText, MakesOneOfTwoWaysToTypeAnUmlaut) {
  EXPECT_EQ(composed("Ju\u0308rgen"), "Jürgen");
  EXPECT_EQ(composed("Jürgen"), "Jürgen");
  EXPECT_EQ(caseless("JU\u0308RGEN"), caseless("jürgen"));
  EXPECT_NE(caseless("Jurgen"), caseless("Jürgen"));
  EXPECT_EQ(composed("\xff"), "\xff");
  EXPECT_TRUE(isUtf8("ü"));
  EXPECT_FALSE(isUtf8("\xfc"));
}

class SubmissionTimesTest : public ::testing::Test {
 protected:
  SubmissionTimes read(const std::string& text) const {
    std::ofstream(file()) << text;
    std::vector<submission::ExerciseInfo> exercises(2);
    exercises[0].name = "01-kinematics";
    exercises[1].name = "02-control";
    return {file(), exercises};
  }
  void expectError(const std::string& text, const std::string& message) const {
    EXPECT_REX_ERROR(read(text), file() + message);
  }
  std::string file() const { return (folder_.path() / "times.csv").string(); }

  TemporaryFolder folder_;
};

TEST_F(SubmissionTimesTest, TellsThoseOfOneExerciseBeforeThoseOfAll) {
  const SubmissionTimes times = read(
      "name,student,exercise,submitted\n"
      "A,alice,kinematics,2026-11-20T10:00:00+01:00\n"
      "A,alice,,2026-11-21T10:00:00+01:00\n"
      "B,bob,01,\n");
  EXPECT_EQ(instantText(times.of("alice", "01-kinematics").value()), "2026-11-20T09:00:00Z");
  EXPECT_EQ(instantText(times.of("alice", "02-control").value()), "2026-11-21T09:00:00Z");
  EXPECT_FALSE(times.of("bob", "01-kinematics"));
}

TEST_F(SubmissionTimesTest, RefusesOtherTables) {
  expectError("who,when\n",
              ":1: not a table of submission times: found the columns who, when, wanted a column 'student'");
  expectError("student,submitted\nalice\n", ":2: not a table of submission times: found 1 fields, wanted 2");
  expectError("student,submitted\nalice,2026-11-20 10:00\n",
              ":2: not a time: found '2026-11-20 10:00', wanted a time with its zone, such as "
              "2026-11-20T23:59:00+01:00");
  expectError("student,submitted,exercise\na,2026-11-20T10:00:00Z,03\n",
              ":2: no exercise is called '03': wanted one of 01-kinematics, 02-control");
  expectError("student,submitted\na,2026-11-20T10:00:00Z\na,2026-11-20T11:00:00Z\n",
              ":3: a second time for the same submission: found 'a' again, wanted one row");
}

}  // namespace rex::classroom::platform_time_test
