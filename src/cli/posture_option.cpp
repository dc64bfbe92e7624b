#include "cli/posture_option.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "scene/state.h"

namespace rex::cli {
namespace {

std::vector<std::string> words(std::string_view text) {
  constexpr std::string_view kSeparators = ", \t\r";
  std::vector<std::string> all;
  while (true) {
    const std::size_t start = text.find_first_not_of(kSeparators);
    if (start == std::string_view::npos) return all;
    text.remove_prefix(start);
    const std::size_t size = std::min(text.find_first_of(kSeparators), text.size());
    all.emplace_back(text.substr(0, size));
    text.remove_prefix(size);
  }
}

std::optional<double> numberIn(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double number = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(number)) return {};
  return number;
}

double requireNumber(const std::string& word) {
  if (const auto number = numberIn(word)) return *number;
  throw UsageError({.what = "--q", .found = "'" + word + "'", .wanted = "a number, or joint=number"});
}

const Joint& movableJoint(const Model& model, const std::string& name) {
  std::vector<std::string> movable;
  for (const Joint& joint : model.joints()) {
    const bool isMovable = joint.nq > 0 && !joint.mimics;
    if (joint.name == name && isMovable) {
      if (joint.nq == 1) return joint;
      throw UsageError({.what = "--q: joint '" + name + "'",
                        .found = fmt::format("{} coordinates", joint.nq),
                        .wanted = fmt::format("one; give all {} numbers of q instead", model.nq())});
    }
    if (isMovable) movable.push_back(joint.name);
  }
  throw UsageError({.what = "--q: " + model.name() + " has no joint '" + name + "' that moves",
                    .nearest = nearestNames(name, movable)});
}

// At each moment of a steady beat the posture last reached.
Motion evenly(const Motion& motion, double rate) {
  Motion even;
  const double start = motion.times.front(), length = motion.times.back() - start;
  const auto count = static_cast<std::size_t>(std::ceil(length * rate - 1e-9)) + 1;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = static_cast<double>(i) / rate;
    while (at + 1 < motion.times.size() && motion.times[at + 1] - start <= time + 1e-9) ++at;
    even.times.push_back(time);
    even.postures.push_back(motion.postures[at]);
  }
  return even;
}

}  // namespace

Eigen::VectorXd parsePosture(const Model& model, const std::string& text) {
  const std::vector<std::string> all = words(text);
  Eigen::VectorXd q = model.initialPositions();
  if (text.find('=') != std::string::npos) {
    for (const std::string& word : all) {
      const std::size_t sign = word.find('=');
      if (sign == std::string::npos)
        throw UsageError({.what = "--q", .found = "'" + word + "'", .wanted = "joint=number"});
      q[movableJoint(model, word.substr(0, sign)).qIndex] = requireNumber(word.substr(sign + 1));
    }
    return q;
  }
  if (static_cast<Eigen::Index>(all.size()) != q.size())
    throw UsageError({.what = "--q",
                      .found = fmt::format("{} numbers", all.size()),
                      .wanted = fmt::format("{}, one for each coordinate of {}", q.size(), model.name())});
  for (Eigen::Index i = 0; i < q.size(); ++i) q[i] = requireNumber(all[static_cast<std::size_t>(i)]);
  return q;
}

Motion readMotion(const Model& model, const std::filesystem::path& file, double rate) {
  std::ifstream input(file);
  if (!input || std::filesystem::is_directory(file))
    throw Error({.what = "cannot read the motion", .where = {file.string()}});
  const auto nq = static_cast<std::size_t>(model.nq());
  Motion motion;
  std::string line;
  for (int number = 1; std::getline(input, line); ++number) {
    const std::vector<std::string> all = words(line);
    if (all.empty() || all[0][0] == '#' || std::isalpha(static_cast<unsigned char>(all[0][0]))) continue;
    const auto refuse = [&](const std::string& found, const std::string& wanted) {
      throw Error({.what = "motion", .where = {file.string(), number}, .found = found, .wanted = wanted});
    };
    if (all.size() != nq && all.size() != nq + 1)
      refuse(fmt::format("{} numbers", all.size()),
             fmt::format("{} of a posture of {}, or a time before them", nq, model.name()));
    std::vector<double> row;
    for (const std::string& word : all) {
      const auto value = numberIn(word);
      if (!value) refuse("'" + word + "'", "a number");
      row.push_back(*value);
    }
    const bool hasTime = row.size() == nq + 1;
    const double time = hasTime ? row[0] : static_cast<double>(motion.times.size()) / rate;
    if (!motion.times.empty() && time <= motion.times.back())
      refuse(fmt::format("time {:g} after {:g}", time, motion.times.back()), "times that increase");
    motion.times.push_back(time);
    motion.postures.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(row.data() + (hasTime ? 1 : 0), model.nq()));
  }
  if (motion.postures.empty())
    throw Error(
        {.what = "motion", .where = {file.string()}, .found = "no posture", .wanted = "at least one"});
  constexpr double kLongest = 120;  // seconds
  const double length = motion.times.back() - motion.times.front();
  if (length > kLongest)
    throw Error({.what = "motion",
                 .where = {file.string()},
                 .found = fmt::format("{:g} s", length),
                 .wanted = fmt::format("at most {:g} s", kLongest)});
  return evenly(motion, rate);
}

Motion moveThrough(const Model& model, const std::vector<Eigen::VectorXd>& keys, double seconds,
                   double rate) {
  Motion motion{.times = {0}, .postures = {keys.front()}};
  const int steps = std::max(1, static_cast<int>(std::lround(seconds * rate)));
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const Eigen::VectorXd way = difference(model, keys[k], keys[k + 1]);
    for (int i = 1; i <= steps; ++i) {
      const double s = static_cast<double>(i) / steps;
      motion.postures.push_back(integrate(model, keys[k], s * s * (3 - 2 * s) * way));
      motion.times.push_back((static_cast<double>(k) + s) * seconds);
    }
  }
  return motion;
}

}  // namespace rex::cli
