#include "cli/robot/path_motion.h"

#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "cli/robot/coordinate_names.h"

namespace rex::cli {
namespace {

// As a field of a table.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"; ") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

Motion timedPath(const Space& space, const MatrixArg& path, double speed, double gap) {
  Motion motion{.times = {0}, .postures = {path.col(0)}};
  Eigen::VectorXd q(path.rows());
  double start = 0;
  for (Eigen::Index k = 1; k < path.cols(); ++k) {
    const double seconds = space.distance(path.col(k - 1), path.col(k)) / speed;
    if (start + seconds <= start) {  // no time passes
      motion.postures.back() = path.col(k);
      continue;
    }
    const int pieces = static_cast<int>(std::ceil(seconds / gap));
    for (int i = 1; i <= pieces; ++i) {
      const double share = static_cast<double>(i) / pieces;
      space.interpolate(path.col(k - 1), path.col(k), share, q);
      motion.times.push_back(start + share * seconds);
      motion.postures.push_back(q);
    }
    start += seconds;
  }
  return motion;
}

Motion resampled(const Space& space, const Motion& motion, double rate) {
  const auto count = static_cast<std::size_t>(std::ceil(motion.times.back() * rate - 1e-9));
  Motion even;
  Eigen::VectorXd q(space.size());
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / rate;
    while (at + 2 < motion.times.size() && motion.times[at + 1] <= time) ++at;
    const double from = motion.times[at], to = motion.times[at + 1];
    space.interpolate(motion.postures[at], motion.postures[at + 1], (time - from) / (to - from), q);
    even.times.push_back(time);
    even.postures.push_back(q);
  }
  even.times.push_back(static_cast<double>(count) / rate);
  even.postures.push_back(motion.postures.back());
  return even;
}

std::string csvOf(const Model& model, const Motion& motion) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(out, "time");
  for (const std::string& name : positionNames(model)) fmt::format_to(out, ",{}", quoted(name));
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    fmt::format_to(out, "\n{}", motion.times[i]);
    for (const double x : motion.postures[i]) fmt::format_to(out, ",{}", x);
  }
  return fmt::to_string(table) + "\n";
}

}  // namespace rex::cli
