#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "submission/exercise_info.h"

namespace rex::classroom {

/// A time as a platform writes it, perhaps without a zone.
struct PlatformTime {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  std::optional<int> zoneSeconds{};  ///< east of Greenwich; empty: the text does not say

  bool operator==(const PlatformTime&) const = default;
};

/// Reads "2026-11-20T23:58:00Z", "2026-11-20 23:58:00.123 +0100", "Friday, 20 November 2026, 11:58 PM",
/// "Friday, November 20, 2026, 11:58 PM", "Freitag, 20. November 2026, 23:58" or "20.11.2026 23:58". Nothing
/// for any other text, for a day that does not exist, and for a weekday that is not that of the day.
[[nodiscard]] std::optional<PlatformTime> parsePlatformTime(std::string_view text);

/// The zone in which a platform writes times without one.
class PlatformZone {
 public:
  /// "Europe/Berlin", "UTC", "+01:00"; empty: unknown. Throws UsageError for a zone that this machine does
  /// not know.
  explicit PlatformZone(std::string name);

  /// Seconds since 1970 in UTC. An hour that exists twice when summer ends is the earlier one. Throws Error
  /// for text that is no time, for a time without a zone if the zone is unknown, and for an hour that does
  /// not exist; `place` is for messages.
  [[nodiscard]] std::int64_t toInstant(const std::string& text, const std::string& place) const;

  /// "2026-11-20T23:58:00+01:00"; in UTC, "2026-11-20T22:58:00Z", if the zone is unknown.
  [[nodiscard]] std::string toText(std::int64_t instant) const;

 private:
  std::string name_;
  std::optional<int> fixedSeconds_{};
};

/// When students handed in, as a learning platform records it.
class SubmissionTimes {
 public:
  /// Reads a CSV file with the columns student, submitted (a time with its zone, or empty) and, if
  /// exercises differ, exercise. Throws Error with the line for anything else and for two times of one
  /// submission.
  SubmissionTimes(const std::filesystem::path& file, const std::vector<submission::ExerciseInfo>& exercises);

  /// Seconds since 1970 in UTC; empty if the file does not have it.
  [[nodiscard]] std::optional<std::int64_t> of(const std::string& student, const std::string& exercise) const;

 private:
  std::map<std::pair<std::string, std::string>, std::int64_t> times_;  ///< exercise "": all
};

}  // namespace rex::classroom
