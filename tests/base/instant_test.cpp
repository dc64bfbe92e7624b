#include "base/instant.h"

#include <ctime>

#include <gtest/gtest.h>

#include "base/rng.h"

namespace rex::instant_test {

TEST(Instant, ReadsTimesWithTheirZones) {
  EXPECT_EQ(parseInstant("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(parseInstant("1970-01-01 01:00+01:00"), 0);
  EXPECT_EQ(parseInstant("1969-12-31T20:30:00-03:30"), 0);
  EXPECT_EQ(parseInstant("2024-02-29T12:00:01z"), 1709208001);
}

TEST(Instant, ReadsNothingElse) {
  for (const char* text :
       {"", "today", "2026-11-20", "2026-11-20T23:59:00", "2026-02-29T00:00:00Z", "2026-13-01T00:00:00Z",
        "2026-11-20T24:00:00Z", "2026-11-20T23:60:00Z", "2026-11-20T23:59:60Z", "2026-11-20T23:59:00+1:00",
        "2026-11-20T23:59:00+01:60", "2026-11-20T23:59:00Z ", "-026-11-20T23:59:00Z", "2026-11-20T23:59:00"})
    EXPECT_FALSE(parseInstant(text)) << text;
}

// The C library has a calendar of its own.
TEST(Instant, AgreesWithTheSystem) {
  Rng rng(3);
  for (int k = 0; k < 2000; ++k) {
    const auto time = static_cast<std::time_t>(rng.uniform(-2e9, 8e9));
    std::tm calendar{};
    ::gmtime_r(&time, &calendar);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &calendar);
    EXPECT_EQ(instantText(time), text);
    EXPECT_EQ(parseInstant(text), std::int64_t{time});
  }
}

}  // namespace rex::instant_test
