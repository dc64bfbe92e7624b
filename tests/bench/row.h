#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rex::bench {

/// Measures some work once and returns its CPU time in seconds.
using Measurement = std::function<double()>;

/// Measures one call of `work` with Google Benchmark, as the mean of as many calls as take 20 ms.
[[nodiscard]] Measurement timed(std::function<void()> work);
/// Measures the wall time of one call, for work that other processes share.
[[nodiscard]] Measurement timedByWall(std::function<void()> work);

/// One line of the table: ours against a peer that does the same, or against a fixed limit.
struct Row {
  std::string name;
  Measurement ours{};      ///< empty: what it needs is absent, as peerName says
  std::string peerName{};  ///< empty: nothing to compare with; "limit": `peer` returns a fixed number; a
                           ///< library that Debian packages is shown with its version
  Measurement peer{};      ///< empty: the peer is not installed
  std::optional<double> target{};  ///< what ours / peer should not exceed
  std::string unit = "ns";         ///< ns, us, ms, s; MB; % of shares
  int repetitions = 15;            ///< measurements of each side
  bool isMedian = false;           ///< each measurement is of another case: compare medians, not the smallest
};

/// The smallest and the median of several measurements of one side, in the row's unit.
struct Spread {
  double smallest = 0, median = 0;
};
/// Both sides, measured in turn; empty: not measured.
struct Result {
  std::optional<Spread> ours{}, peer{};
};
[[nodiscard]] Result measure(const Row& row);
/// Ours divided by the peer's: of medians where the row says so, else of the smallest; what `target` limits.
[[nodiscard]] std::optional<double> ratio(const Row& row, const Result& result);

/// The groups, a file each. Setting one up takes little time; it throws std::logic_error where ours and a
/// peer do not compute the same.
[[nodiscard]] std::vector<Row> cmaRows();
[[nodiscard]] std::vector<Row> collisionRows();
[[nodiscard]] std::vector<Row> controlRows();
[[nodiscard]] std::vector<Row> dynamicsRows();
[[nodiscard]] std::vector<Row> estimationRows();
[[nodiscard]] std::vector<Row> gradingRows();
[[nodiscard]] std::vector<Row> ikRows();
[[nodiscard]] std::vector<Row> kinematicsRows();
[[nodiscard]] std::vector<Row> physicsRows();
[[nodiscard]] std::vector<Row> planningRows();
[[nodiscard]] std::vector<Row> renderRows();
[[nodiscard]] std::vector<Row> sceneRows();
[[nodiscard]] std::vector<Row> trajectoryRows();

}  // namespace rex::bench
