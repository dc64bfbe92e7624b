#include "classroom/late_policy.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/rng.h"
#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace rex::classroom::late_policy_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::int64_t kDay = 86400, kDeadline = 1'000'000'000;

class LatePolicyTest : public ::testing::Test {
 protected:
  LatePolicy read(const std::string& text) const {
    std::ofstream(file()) << text;
    return readLatePolicy(file(), {"01-kinematics", "02-control"});
  }
  std::string messageFor(const std::string& text) const {
    return messageOf([&] { return read(text); });
  }
  std::string file() const { return (folder_.path() / "deadlines.toml").string(); }

  TemporaryFolder folder_;
};

TEST_F(LatePolicyTest, ReadsWhatHoldsForAllAndForOne) {
  const LatePolicy policy = read(R"(
[all]
deadline = 2026-11-20T23:59:00+01:00
grace_minutes = 15
percent_per_day = 12.5
cap_percent = 50
[exercise.02-control]
opening = 2026-11-18T08:00:00+01:00
deadline = 2026-12-01T12:00:00Z
points_per_day = 2
cap_points = 5
[exercise.02-control.extensions]
alice = 2026-12-03T12:00:00Z
)");
  const LateRule& first = policy.at("01-kinematics");
  EXPECT_EQ(instantText(first.deadline.value()), "2026-11-20T22:59:00Z");
  EXPECT_EQ(first.graceSeconds, 900);
  EXPECT_TRUE(first.isPercent);
  EXPECT_EQ(first.perDay, 1250);
  EXPECT_EQ(first.cap, 5000);
  const LateRule& second = policy.at("02-control");
  EXPECT_FALSE(first.opening.has_value());
  EXPECT_EQ(instantText(second.opening.value()), "2026-11-18T07:00:00Z");
  EXPECT_EQ(instantText(second.deadline.value()), "2026-12-01T12:00:00Z");
  EXPECT_EQ(second.graceSeconds, 900);
  EXPECT_FALSE(second.isPercent);
  EXPECT_EQ(second.perDay, 200);
  EXPECT_EQ(second.cap, 500);
  EXPECT_EQ(instantText(second.extensions.at("alice")), "2026-12-03T12:00:00Z");
}

TEST_F(LatePolicyTest, KeepsTheCapOfAllUnlessItsUnitIsAnother) {
  const std::string all = "[all]\npercent_per_day = 10\ncap_percent = 50\n[exercise.01-kinematics]\n";
  EXPECT_EQ(read(all + "percent_per_day = 20\n").at("01-kinematics").cap, 5000);
  EXPECT_EQ(read(all + "points_per_day = 1\n").at("01-kinematics").cap, std::nullopt);
}

TEST_F(LatePolicyTest, NamesThePlaceOfWhatIsWrong) {
  const std::string at = file() + ":";
  EXPECT_EQ(messageFor("[exercise.01-kinematic]\n"),
            at + "1:1: no exercise is called '01-kinematic' (did you mean '01-kinematics'?)");
  EXPECT_THAT(messageFor("[all]\ndeadline = 2026-11-20T23:59:00\n"),
              HasSubstr("wanted a time with its zone, such as 2026-11-20T23:59:00+01:00"));
  EXPECT_THAT(messageFor("[all]\ndeadline = \"tomorrow\"\n"), HasSubstr(at + "2:12"));
  EXPECT_THAT(messageFor("[all]\ngrace_minutes = -1\n"), HasSubstr("a whole number from 0 to 525600"));
  EXPECT_THAT(messageFor("[all]\npercent_per_day = 101\n"), HasSubstr("at most 100"));
  EXPECT_THAT(messageFor("[all]\npercent_per_day = 10\npoints_per_day = 1\n"),
              HasSubstr("both percent_per_day and points_per_day: wanted one of them"));
  EXPECT_THAT(messageFor("[all]\npercent_per_day = 10\ncap_points = 1\n"),
              HasSubstr("'cap_points': wanted cap_percent, as lateness costs percent"));
  EXPECT_THAT(messageFor("[all]\nper_day = 1\n"), HasSubstr("unknown key 'per_day' in [all]"));
  EXPECT_THAT(messageFor("all = 3\n"), HasSubstr("'all': wanted a table"));
  EXPECT_THAT(messageFor("[al]\n"), HasSubstr("unknown key 'al' in the file of deadlines"));
  EXPECT_THAT(messageFor("[all\n"), HasSubstr(at + "1"));
  EXPECT_REX_ERROR((readLatePolicy("none.toml", {})), "none.toml: no such file: wanted a file of deadlines");
}

TEST(Lateness, CountsDaysBegunAfterTheDeadline) {
  const LateRule rule{.deadline = kDeadline, .graceSeconds = 900, .perDay = 1000};
  const auto daysAt = [&](std::int64_t late) {
    return computeLateness(rule, "a", kDeadline + late, 10).days;
  };
  EXPECT_EQ(daysAt(-kDay), 0);
  EXPECT_EQ(daysAt(0), 0);
  EXPECT_EQ(daysAt(900), 0) << "the last second of grace";
  EXPECT_EQ(daysAt(901), 1);
  EXPECT_EQ(daysAt(kDay), 1);
  EXPECT_EQ(daysAt(kDay + 1), 2);
  EXPECT_EQ(daysAt(10 * kDay), 10);
}

TEST(Lateness, CostsNothingWithoutADeadline) {
  const Lateness lateness = computeLateness({.perDay = 1000}, "a", kDeadline, 10);
  EXPECT_EQ(lateness.days, 0);
  EXPECT_EQ(lateness.penalty, 0);
}

TEST(Lateness, TakesTheOwnDeadlineOfAStudent) {
  const LateRule rule{.deadline = kDeadline, .extensions = {{"alice", kDeadline + 2 * kDay}}, .perDay = 1000};
  EXPECT_EQ(computeLateness(rule, "alice", kDeadline + 2 * kDay, 10).days, 0);
  EXPECT_EQ(computeLateness(rule, "alice", kDeadline + 2 * kDay + 1, 10).days, 1);
  EXPECT_EQ(computeLateness(rule, "bob", kDeadline + 2 * kDay, 10).days, 2);
}

// The same in floating-point numbers, from the words of the manual.
TEST(Lateness, CostsWhatTheClosedFormSays) {
  const std::uint64_t seed = 7;
  Rng rng(seed);
  for (int k = 0; k < 20000; ++k) {
    const int points = rng.index(41), days = 1 + rng.index(20);
    const bool isPercent = rng.index(2) == 1, hasCap = rng.index(2) == 1;
    LateRule rule{.deadline = kDeadline, .isPercent = isPercent, .perDay = 1 + rng.index(10000)};
    if (hasCap) rule.cap = 1 + rng.index(10000);
    const Lateness lateness = computeLateness(rule, "a", kDeadline + days * kDay, points);
    double cost = 0.01 * static_cast<double>(rule.perDay) * days;
    if (hasCap) cost = std::min(cost, 0.01 * static_cast<double>(*rule.cap));
    const double penalty = std::min<double>(isPercent ? points * cost / 100 : cost, points);
    EXPECT_EQ(lateness.days, days);
    EXPECT_NEAR(static_cast<double>(lateness.penalty), 100 * penalty, 0.5 + 1e-6)
        << "seed " << seed << ", case " << k;
  }
}

TEST(Lateness, RoundsHalvesUp) {
  const LateRule rule{.deadline = kDeadline, .perDay = 50};  // half a percent
  EXPECT_EQ(computeLateness(rule, "a", kDeadline + 1, 1).penalty, 1) << "half a hundredth";
  EXPECT_EQ(computeLateness(rule, "a", kDeadline + 1, 3).penalty, 2) << "one and a half";
}

// One for all exercises is written for those that are due soon.
TEST(Lateness, DoesNotGrowByAnExtension) {
  const LateRule rule{.deadline = kDeadline, .extensions = {{"alice", kDeadline - 2 * kDay}}, .perDay = 1000};
  EXPECT_EQ(computeLateness(rule, "alice", kDeadline, 20).days, 0);
  EXPECT_EQ(computeLateness(rule, "alice", kDeadline + 1, 20).days, 1);
  EXPECT_EQ(computeLateness({.extensions = {{"alice", kDeadline}}}, "alice", kDeadline + 1, 20).days, 0);
}

TEST_F(LatePolicyTest, TellsOfExtensionsForNobody) {
  const LatePolicy policy =
      read("[exercise.01-kinematics.extensions]\nalise = 2026-12-03T12:00:00Z\nbob = 2026-12-03T12:00:00Z\n");
  EXPECT_THAT(unknownExtensions(policy, {"alice", "bob"}),
              ElementsAre("'alise' has an extension for 01-kinematics and handed in nothing "
                          "(did you mean 'alice'?)"));
}

}  // namespace rex::classroom::late_policy_test
