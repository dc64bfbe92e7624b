#include "base/instant.h"

#include <chrono>

#include <fmt/format.h>

#include "base/text.h"

namespace rex {
namespace {

using namespace std::chrono;

/// Reads a fixed format from the front of a text; `ok` says whether it matched.
struct Scanner {
  std::string_view text;
  bool ok = true;

  int number(std::size_t digits) {
    std::string_view part = text.substr(0, digits);
    ok = ok && part.size() == digits;
    text.remove_prefix(part.size());
    const int value = takeNumber<int>(part).value_or(-1);
    ok = ok && part.empty() && value >= 0;
    return value;
  }
  char sign(std::string_view choices) {
    ok = ok && !text.empty() && choices.find(text.front()) != std::string_view::npos;
    if (!ok) return choices.front();
    const char found = text.front();
    text.remove_prefix(1);
    return found;
  }
};

int zoneSeconds(Scanner& scanner) {
  const char sign = scanner.sign("Zz+-");
  if (sign == 'Z' || sign == 'z') return 0;
  const int hours = scanner.number(2);
  scanner.sign(":");
  const int minutes = scanner.number(2);
  scanner.ok = scanner.ok && hours < 24 && minutes < 60;
  return (sign == '-' ? -60 : 60) * (60 * hours + minutes);
}

}  // namespace

std::optional<std::int64_t> parseInstant(std::string_view text) {
  Scanner scanner{text};
  const int y = scanner.number(4);
  scanner.sign("-");
  const int m = scanner.number(2);
  scanner.sign("-");
  const int d = scanner.number(2);
  scanner.sign("Tt ");
  const int hour = scanner.number(2);
  scanner.sign(":");
  const int minute = scanner.number(2);
  int second = 0;
  if (scanner.text.starts_with(':')) {
    scanner.sign(":");
    second = scanner.number(2);
  }
  const int zone = zoneSeconds(scanner);
  const year_month_day date{year(y), month(static_cast<unsigned>(m)), day(static_cast<unsigned>(d))};
  if (!scanner.ok || !scanner.text.empty() || !date.ok() || hour > 23 || minute > 59 || second > 59)
    return std::nullopt;
  const std::int64_t days = sys_days(date).time_since_epoch().count();
  return days * 86400 + hour * 3600 + minute * 60 + second - zone;
}

std::string instantText(std::int64_t seconds) {
  const sys_seconds time{std::chrono::seconds(seconds)};
  const sys_days today = floor<days>(time);
  const year_month_day date(today);
  const hh_mm_ss clock(time - today);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     clock.hours().count(), clock.minutes().count(), clock.seconds().count());
}

}  // namespace rex
