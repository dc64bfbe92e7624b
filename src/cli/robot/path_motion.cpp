#include "cli/robot/path_motion.h"

#include <cmath>
#include <cstddef>
#include <iterator>

#include <fmt/format.h>

#include "cli/robot/coordinate_names.h"

namespace rex::cli {
namespace {

// Quoted as a CSV field if necessary.
std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"; ") == std::string::npos) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + "\"";
}

}  // namespace

Motion motionOf(const TimedPath& timed, double rate) {
  const double end = timed.duration();
  const auto count = static_cast<std::size_t>(std::ceil(end * rate - 1e-9));
  Motion motion;
  for (std::size_t i = 0; i < count; ++i) {
    motion.times.push_back(static_cast<double>(i) / rate);
    motion.postures.push_back(timed.at(motion.times.back()).q);
  }
  motion.times.push_back(end);
  motion.postures.push_back(timed.at(end).q);
  return motion;
}

std::string csvOf(const Model& model, const Motion& motion) {
  fmt::memory_buffer table;
  const auto out = std::back_inserter(table);
  fmt::format_to(out, "time");
  for (const std::string& name : printablePositionNames(model)) fmt::format_to(out, ",{}", quoted(name));
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    fmt::format_to(out, "\n{}", motion.times[i]);
    for (const double x : motion.postures[i]) fmt::format_to(out, ",{}", x);
  }
  return fmt::to_string(table) + "\n";
}

}  // namespace rex::cli
