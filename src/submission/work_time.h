#pragma once
// How long a student worked on an exercise, as far as saves tell. `rex` counts it in a course folder; the
// receipt of `rex submit --progress` hands it in.
//   const WorkTime work{.seconds = 5400, .parts = {{"lagrange", 3600}}};
//   workTimeText(work);                        // {"seconds":5400,"parts":{"lagrange":3600}}
//   readWorkTime(text) == work;
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace rex::submission {

struct WorkTime {
  std::int64_t seconds = 0;                     ///< until the last save
  std::map<std::string, std::int64_t> parts{};  ///< by id: how much of that when the part first passed

  bool operator==(const WorkTime&) const = default;
};

/// As JSON.
[[nodiscard]] std::string workTimeText(const WorkTime& work);

/// Reads it back. Returns nothing for another text, for times that are negative or longer than a
/// year, and for parts that passed after the last save.
[[nodiscard]] std::optional<WorkTime> readWorkTime(const std::string& text);

}  // namespace rex::submission
