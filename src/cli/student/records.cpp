#include "cli/student/records.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "grading/evidence.h"

namespace rex::cli {
namespace {

auto bestIn(const Attempts& attempts) {
  const auto& values = attempts.values;
  return attempts.isMoreBetter ? std::max_element(values.begin(), values.end())
                               : std::min_element(values.begin(), values.end());
}

std::string withUnit(double value, const Attempts& attempts) {
  return fmt::format("{:.4g}{}{}", value, attempts.unit.empty() ? "" : " ", attempts.unit);
}

void forgetTheOldest(Attempts& attempts) {
  const auto best = bestIn(attempts);
  attempts.values.erase(attempts.values.begin() + (best == attempts.values.begin() ? 1 : 0));
}

}  // namespace

void addRecords(Records& records, const grading::GradeResult& result) {
  for (const grading::CheckResult& check : result.checks) {
    if (!check.record) continue;
    Attempts& attempts = records[check.record->name];
    attempts.unit = check.record->unit;
    attempts.isMoreBetter = check.record->isMoreBetter;
    const bool isSameFile =
        std::exchange(attempts.fileSha256, result.snapshotSha256) == result.snapshotSha256;
    if (!attempts.values.empty() && (isSameFile || attempts.values.back() == check.record->value)) continue;
    attempts.values.push_back(check.record->value);
    if (attempts.values.size() > kMostAttempts) forgetTheOldest(attempts);
  }
}

double bestOf(const Attempts& attempts) { return *bestIn(attempts); }

std::string recordText(const std::string& name, const Attempts& attempts) {
  const double last = attempts.values.back(), best = bestOf(attempts);
  const std::string now = fmt::format("{}: {}", name, withUnit(last, attempts));
  if (attempts.values.size() == 1) return now;
  return now + (last == best ? std::string(", your best") : ", your best was " + withUnit(best, attempts)) +
         fmt::format(" ({} attempts)", attempts.values.size());
}

Figure recordFigure(const std::string& name, const Attempts& attempts) {
  Series values = grading::gotCurve("");
  for (const double value : attempts.values) values.add(static_cast<double>(values.y.size() + 1), value);
  values.style = SeriesStyle::kLinesPoints;
  Figure figure{.title = name,
                .xLabel = "attempt",
                .yLabel = attempts.unit.empty() ? "value" : "value [" + attempts.unit + "]",
                .series = {values}};
  figure.horizontalLines = {{.at = bestOf(attempts), .label = "best", .color = grading::kWantedColor}};
  return figure;
}

}  // namespace rex::cli
