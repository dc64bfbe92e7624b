#include "submission/work_time.h"

#include <nlohmann/json.hpp>

namespace rex::submission {

namespace {

using Object = nlohmann::ordered_json;

std::optional<std::int64_t> secondsIn(const Object& json) {
  constexpr std::int64_t kMost = 366 * 24 * 3600;
  if (!json.is_number_integer()) return {};
  const auto seconds = json.get<std::int64_t>();
  if (seconds < 0 || seconds > kMost) return {};
  return seconds;
}

}  // namespace

std::string workTimeText(const WorkTime& work) {
  Object parts = Object::object();
  for (const auto& [part, seconds] : work.parts) parts[part] = seconds;
  return Object{{"seconds", work.seconds}, {"parts", parts}}.dump();
}

std::optional<WorkTime> readWorkTime(const std::string& text) {
  const Object json = Object::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("seconds") || !json.contains("parts") || !json["parts"].is_object())
    return {};
  const std::optional<std::int64_t> whole = secondsIn(json["seconds"]);
  if (!whole) return {};
  WorkTime work{.seconds = *whole};
  for (const auto& [id, entry] : json["parts"].items()) {
    const std::optional<std::int64_t> seconds = secondsIn(entry);
    if (!seconds || *seconds > *whole) return {};
    work.parts[id] = *seconds;
  }
  return work;
}

}  // namespace rex::submission
