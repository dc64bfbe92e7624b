#include "classroom/platform_time.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <regex>
#include <stdexcept>
#include <vector>

#include <date/tz.h>
#include <fmt/format.h>

#include "base/error.h"
#include "base/instant.h"
#include "base/text.h"
#include "classroom/csv.h"
#include "classroom/gradebook_text.h"

namespace rex::classroom {
namespace {

using namespace std::chrono;

constexpr const char* kTimeExamples =
    "a time such as '2026-11-20T23:58:00+01:00', 'Friday, 20 November 2026, 11:58 PM' or 'Freitag, 20. "
    "November "
    "2026, 23:58'";

int valueOf(const std::ssub_match& digits) { return parseNumber<int>(digits.str()).value_or(0); }

// Of a word with at least three letters; 0: none. English, German and French, whole or cut.
int monthOf(const std::string& word) {
  static constexpr std::array<std::array<std::string_view, 4>, 12> kMonths = {
      {{"january", "januar", "jänner", "janvier"},
       {"february", "februar", "février", "fevrier"},
       {"march", "märz", "maerz", "mars"},
       {"april", "avril", "", ""},
       {"may", "mai", "", ""},
       {"june", "juni", "juin", ""},
       {"july", "juli", "juillet", ""},
       {"august", "août", "aout", ""},
       {"september", "sept", "septembre", ""},
       {"october", "oktober", "octobre", ""},
       {"november", "novembre", "", ""},
       {"december", "dezember", "décembre", "decembre"}}};
  if (word.size() < 3) return 0;
  for (std::size_t k = 0; k < kMonths.size(); ++k)
    for (const std::string_view name : kMonths[k])
      if (name.starts_with(word)) return static_cast<int>(k) + 1;
  return 0;
}

// 1 for Monday to 7 for Sunday; 0: no weekday.
int weekdayOf(const std::string& word) {
  static constexpr std::array<std::array<std::string_view, 3>, 7> kDays = {
      {{"monday", "montag", "lundi"},
       {"tuesday", "dienstag", "mardi"},
       {"wednesday", "mittwoch", "mercredi"},
       {"thursday", "donnerstag", "jeudi"},
       {"friday", "freitag", "vendredi"},
       {"saturday", "samstag", "samedi"},
       {"sunday", "sonntag", "dimanche"}}};
  if (word.size() < 2) return 0;
  for (std::size_t k = 0; k < kDays.size(); ++k)
    for (const std::string_view name : kDays[k])
      if (name.starts_with(word)) return static_cast<int>(k) + 1;
  return word == "sonnabend" ? 6 : 0;
}

// Seconds of "Z", "UTC", "+01:00" or "+0100"; nothing for other texts.
std::optional<int> zoneOf(const std::string& text) {
  static const std::regex kZone("([+-])([0-9]{2}):?([0-9]{2})");
  if (text == "z" || text == "utc" || text == "gmt") return 0;
  std::smatch match;
  if (!std::regex_match(text, match, kZone)) return {};
  const int hours = valueOf(match[2]), minutes = valueOf(match[3]);
  if (hours > 23 || minutes > 59) return {};
  return (match[1] == "-" ? -60 : 60) * (60 * hours + minutes);
}

std::optional<PlatformTime> parseIso(const std::string& text) {
  static const std::regex kIso(
      "([0-9]{4})-([0-9]{2})-([0-9]{2})[t ]+([0-9]{2}):([0-9]{2})(:([0-9]{2})([.][0-9]+)?)? *(.*)");
  static const std::regex kDotted(
      "([0-9]{1,2})[.]([0-9]{1,2})[.]([0-9]{4}),? +([0-9]{1,2}):([0-9]{2})(:([0-9]{2}))?( uhr)?");
  std::smatch match;
  const auto number = [&](std::size_t k) { return valueOf(match[k]); };
  if (std::regex_match(text, match, kDotted))
    return PlatformTime{number(3), number(2), number(1), number(4), number(5), number(7)};
  if (!std::regex_match(text, match, kIso)) return {};
  PlatformTime time{number(1), number(2), number(3), number(4), number(5), number(7)};
  time.zoneSeconds = zoneOf(match[9].str());
  if (!time.zoneSeconds && match[9].length() > 0) return {};
  return time;
}

/// Reads words and numbers in the orders in which English, German and French write them.
class WordedTime {
 public:
  explicit WordedTime(const std::string& text) {
    static const std::regex kWord("([0-9]{1,2}):([0-9]{2})(:([0-9]{2}))?|[0-9]+|[^0-9:,. \t]+");
    for (auto word = std::sregex_iterator(text.begin(), text.end(), kWord); word != std::sregex_iterator();
         ++word)
      take(*word);
  }

  std::optional<PlatformTime> time() const {
    if (!isUnderstood_ || month_ == 0 || numbers_.size() != 2 || !hasClock_) return {};
    PlatformTime time = clock_;
    time.month = month_, time.day = numbers_[0], time.year = numbers_[1];
    if (half_ != 0 && (time.hour < 1 || time.hour > 12)) return {};
    if (half_ != 0) time.hour = time.hour % 12 + (half_ == 'p' ? 12 : 0);
    const sys_days day = year(time.year) / time.month / time.day;
    if (weekday_ != 0 && static_cast<int>(weekday(day).iso_encoding()) != weekday_) return {};
    return time;
  }

 private:
  void take(const std::smatch& match) {
    const std::string word = match.str();
    if (match[1].matched) {
      isUnderstood_ = isUnderstood_ && !hasClock_;
      hasClock_ = true;
      clock_.hour = valueOf(match[1]), clock_.minute = valueOf(match[2]);
      clock_.second = valueOf(match[4]);
    } else if (word.find_first_not_of("0123456789") == word.npos) {
      numbers_.push_back(valueOf(match[0]));
    } else if (word == "am" || word == "pm") {
      half_ = word.front();
    } else if (const int month = monthOf(word); month != 0 && month_ == 0) {
      month_ = month;
    } else if (const int day = weekdayOf(word); day != 0 && weekday_ == 0) {
      weekday_ = day;
    } else if (word != "uhr" && word != "at" && word != "um") {
      isUnderstood_ = false;
    }
  }

  std::vector<int> numbers_{};
  PlatformTime clock_{};
  int month_ = 0, weekday_ = 0;
  char half_ = 0;  // a or p
  bool hasClock_ = false, isUnderstood_ = true;
};

// Files of zones list changes until 2037.
bool exists(const PlatformTime& time) {
  const year_month_day day{year(time.year), month(static_cast<unsigned>(time.month)),
                           std::chrono::day(static_cast<unsigned>(time.day))};
  return day.ok() && time.year >= 1970 && time.year < 2038 && time.hour < 24 && time.minute < 60 &&
         time.second < 60;
}

std::int64_t asIfUtc(const PlatformTime& time) {
  const sys_days day = year(time.year) / time.month / time.day;
  return std::int64_t{day.time_since_epoch().count()} * 86400 + time.hour * 3600 + time.minute * 60 +
         time.second;
}

// Nothing if the machine does not know a zone of that name.
const date::time_zone* zoneNamed(const std::string& name) {
  try {
    return date::locate_zone(name);
  } catch (const std::runtime_error&) {
    return nullptr;
  }
}

// Nothing if the hour does not exist there.
std::optional<std::int64_t> instantIn(const std::string& zone, const PlatformTime& time) {
  const std::int64_t local = asIfUtc(time);
  const date::local_info info =
      date::locate_zone(zone)->get_info(date::local_seconds(std::chrono::seconds(local)));
  if (info.result == date::local_info::nonexistent) return {};
  return local - info.first.offset.count();
}

}  // namespace

std::optional<PlatformTime> parsePlatformTime(std::string_view text) {
  std::string plain = caseless(text);
  for (const std::string blank : {"\u00A0", "\u202F"})  // some write them before AM and PM
    for (std::size_t at; (at = plain.find(blank)) != plain.npos;) plain.replace(at, blank.size(), " ");
  if (plain.size() > 100) return {};
  const std::string words(trimmed(plain));
  std::optional<PlatformTime> time = parseIso(words);
  if (!time) time = WordedTime(words).time();
  return time && exists(*time) ? time : std::nullopt;
}

PlatformZone::PlatformZone(std::string name) : name_(std::move(name)) {
  if (name_.empty()) return;
  fixedSeconds_ = zoneOf(caseless(name_));
  if (!fixedSeconds_ && zoneNamed(name_) == nullptr)
    throw UsageError({.what = "not a time zone",
                      .found = "'" + name_ + "'",
                      .wanted = "a name such as Europe/Berlin, or a difference such as +01:00"});
}

std::int64_t PlatformZone::toInstant(const std::string& text, const std::string& place) const {
  const std::optional<PlatformTime> time = parsePlatformTime(text);
  if (!time)
    throw Error({.what = "not a time", .where = {place}, .found = "'" + text + "'", .wanted = kTimeExamples});
  const std::optional<int> fixed = time->zoneSeconds ? time->zoneSeconds : fixedSeconds_;
  if (fixed) return asIfUtc(*time) - *fixed;
  if (name_.empty())
    throw UsageError({.what = "a time without a zone",
                      .where = {place},
                      .found = "'" + text + "'",
                      .wanted = "--time-zone ZONE, such as Europe/Berlin: that of the platform"});
  if (const auto instant = instantIn(name_, *time)) return *instant;
  throw Error({.what = "an hour that does not exist in " + name_,
               .where = {place},
               .found = "'" + text + "'",
               .wanted = "another time, or another zone"});
}

std::string PlatformZone::toText(std::int64_t instant) const {
  if (name_.empty()) return instantText(instant);
  const auto offset =
      fixedSeconds_
          ? std::int64_t{*fixedSeconds_}
          : zoneNamed(name_)->get_info(date::sys_seconds(std::chrono::seconds(instant))).offset.count();
  std::string text = instantText(instant + offset);
  text.pop_back();
  return text + fmt::format("{}{:02}:{:02}", offset < 0 ? '-' : '+', std::abs(offset) / 3600,
                            std::abs(offset) / 60 % 60);
}

SubmissionTimes::SubmissionTimes(const std::filesystem::path& file,
                                 const std::vector<submission::ExerciseInfo>& exercises) {
  const CsvTable table(file, "a table of submission times");
  table.require({"student"}), table.require({"submitted"});
  table.requireWholeRows();
  for (std::size_t k = 0; k < table.size(); ++k) {
    const auto fail = [&](std::string what, std::string found, std::string wanted) {
      return Error({.what = std::move(what),
                    .where = {table.place(k)},
                    .found = std::move(found),
                    .wanted = std::move(wanted)});
    };
    const std::string student = table.text(k, {"student"}), submitted = table.text(k, {"submitted"}),
                      exercise = table.text(k, {"exercise"});
    if (submitted.empty()) continue;
    const auto time = parseInstant(submitted);
    if (!time)
      throw fail("not a time", "'" + submitted + "'",
                 "a time with its zone, such as 2026-11-20T23:59:00+01:00");
    std::string name;
    try {
      if (!exercise.empty()) name = submission::findExercise(exercises, exercise).name;
    } catch (const Error& error) {
      throw fail(error.parts().what, "", error.parts().wanted);
    }
    if (!times_.emplace(std::pair(student, name), *time).second)
      throw fail("a second time for the same submission", "'" + student + "' again", "one row");
  }
}

std::optional<std::int64_t> SubmissionTimes::of(const std::string& student,
                                                const std::string& exercise) const {
  for (const std::string& name : {exercise, std::string()})
    if (const auto found = times_.find({student, name}); found != times_.end()) return found->second;
  return std::nullopt;
}

}  // namespace rex::classroom
