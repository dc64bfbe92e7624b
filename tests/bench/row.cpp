#include "bench/row.h"

#include <algorithm>
#include <chrono>
#include <map>

#include <benchmark/benchmark.h>

namespace rex::bench {
namespace {

constexpr double kSecondsPerMeasurement = 0.02;

// Keeps the mean CPU time of the one benchmark that runs, and prints nothing.
class Collector : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
  }
  double seconds = 0;
};

double perSecond(const std::string& unit) {
  static const std::map<std::string, double> kPerSecond{{"ns", 1e9}, {"us", 1e6}, {"ms", 1e3},
                                                        {"s", 1},    {"%", 100},  {"MB", 1e-6}};
  return kPerSecond.at(unit);
}

}  // namespace

Measurement timed(std::function<void()> work) {
  return [work = std::move(work)] {
    benchmark::ClearRegisteredBenchmarks();
    benchmark::RegisterBenchmark("work",
                                 [&](benchmark::State& state) {
                                   for ([[maybe_unused]] auto _ : state) work();
                                 })
        ->MinTime(kSecondsPerMeasurement)
        ->MeasureProcessCPUTime();
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);
    return collector.seconds;
  };
}

Measurement timedByWall(std::function<void()> work) {
  return [work = std::move(work)] {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
}

std::optional<double> ratio(const Row& row, const Result& result) {
  if (!result.ours || !result.peer) return std::nullopt;
  const auto compared = row.isMedian ? &Spread::median : &Spread::smallest;
  const double ours = (*result.ours).*compared, peer = (*result.peer).*compared;
  return peer > 0 ? std::optional(ours / peer) : std::nullopt;
}

Result measure(const Row& row) {
  if (!row.ours) return {};
  // In turn, so that a slow moment of the machine meets both sides.
  std::vector<double> ours, peer;
  for (int i = 0; i < row.repetitions; ++i) {
    ours.push_back(row.ours());
    if (row.peer) peer.push_back(row.peer());
  }
  const auto spread = [&](std::vector<double>& measured) {
    std::sort(measured.begin(), measured.end());
    const double scale = perSecond(row.unit);
    return Spread{scale * measured.front(), scale * measured[measured.size() / 2]};
  };
  return {.ours = spread(ours), .peer = row.peer ? std::optional(spread(peer)) : std::nullopt};
}

}  // namespace rex::bench
