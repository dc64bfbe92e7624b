#include "bench/report_page.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/escape.h"

namespace rex::bench {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>rex measured</title>
<style>
body { font: 15px/1.45 system-ui, sans-serif; max-width: 75em; margin: 2em auto; padding: 0 1em; color: #222; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { padding: .15em .6em; text-align: right; border-bottom: 1px solid #ddd; }
th:first-child, td:first-child, .peer, .machine td { text-align: left; }
.met { color: #17692f; } .missed { color: #a3341f; }
svg { vertical-align: middle; }
</style></head><body>
<h1>rex measured</h1>
<p>Each row compares rex with a peer that does the same work, or with a fixed limit. Both sides are measured in turn
in one run. The times are processor times, except where a name or share/doc/benchmarks.md says otherwise. The bar
shows ours divided by the peer's: shorter is better, the grey line is 1, the dark one the target.</p>
)";

// 1 lies in the middle; what takes twice as long or more fills the bar.
std::string bar(double ratio, const std::optional<double>& target) {
  constexpr double kWidth = 160, kHeight = 12;
  const auto x = [&](double value) { return kWidth * std::clamp(value / 2, 0., 1.); };
  const bool isMissed = target && ratio > *target;
  std::string svg = fmt::format(
      "<svg width='{0}' height='{1}' role='img' aria-label='{2:.2f}'><rect width='{3:.1f}' height='{1}' "
      "fill='{4}'/>"
      "<path d='M{5} 0V{1}' stroke='#999'/>",
      kWidth, kHeight, ratio, x(ratio), isMissed ? "#d98b77" : "#7fb08e", kWidth / 2);
  if (target)
    svg += fmt::format("<path d='M{:.1f} 0V{}' stroke='#222' stroke-width='2'/>", x(*target), kHeight);
  return svg + "</svg>";
}

std::string figure(const std::optional<Spread>& spread, double Spread::*which) {
  return spread ? fmt::format("{:.4g}", (*spread).*which) : "";
}

std::string tableRow(const Line& line) {
  const auto& [group, row, result] = line;
  const std::optional<double> measured = ratio(row, result);
  std::string verdict;
  if (measured && row.target)
    verdict =
        *measured <= *row.target ? "<span class='met'>met</span>" : "<span class='missed'>not met</span>";
  return fmt::format(
      "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td "
      "class='peer'>{}</td><td>{}</td>"
      "<td class='peer'>{}</td><td>{}</td><td>{}</td></tr>\n",
      htmlText(row.name), figure(result.ours, &Spread::smallest), figure(result.ours, &Spread::median),
      figure(result.peer, &Spread::smallest), figure(result.peer, &Spread::median), row.unit,
      htmlText(peerWithVersion(row)), measured ? fmt::format("{:.2f}", *measured) : "",
      measured ? bar(*measured, row.target) : "", row.target ? fmt::format("{:.2f}", *row.target) : "",
      verdict);
}

}  // namespace

std::string reportPage(const std::vector<Line>& lines) {
  const Machine machine = thisMachine();
  std::string page = kHead;
  page += "<table class='machine'>";
  const auto about = [&](const char* name, const std::string& value) {
    page += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", name, value);
  };
  about("Day", fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))));
  about("Processor", htmlText(machine.cpu));
  about("Its vector extensions", htmlText(machine.flags));
  about("Lanes of our kernels", std::to_string(machine.lanes));
  about("Compiler", htmlText(machine.compiler));
  about("Kernels", htmlText(machine.kernels));
  page += "</table>\n";
  for (auto line = lines.begin(); line != lines.end();) {
    const std::string group = line->group;
    page += fmt::format(
        "<h2>{}</h2>\n<table><tr><th>row</th><th>ours</th><th>median</th><th>peer</th><th>median</"
        "th><th>unit</th>"
        "<th class='peer'></th><th>ratio</th><th></th><th>target</th><th></th></tr>\n",
        htmlText(group));
    for (; line != lines.end() && line->group == group; ++line) page += tableRow(*line);
    page += "</table>\n";
  }
  return page + "</body></html>\n";
}

}  // namespace rex::bench
