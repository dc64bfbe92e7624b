#include "cli/robot/posture_option.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "cli/numbers.h"
#include "cli/terminal.h"
#include "scene/state.h"

namespace rex::cli {

namespace {

std::vector<std::string> allHarmless(std::vector<std::string> names) {
  for (std::string& name : names) name = escapeForTerminal(name);
  return names;
}

}  // namespace

std::vector<std::string> printablePositionNames(const Model& model) {
  return allHarmless(positionNames(model));
}

std::vector<std::string> printableVelocityNames(const Model& model) {
  return allHarmless(velocityNames(model));
}

namespace {

constexpr double kLongestMotion = 120;  // seconds of a film

// Coordinates that an option gives: positions q, velocities v or forces u.
struct Coordinates {
  std::string option;  // "--q"
  std::string letter;  // "q"
  int Joint::*index;
  int Joint::*count;
};

const Coordinates kPositions{"--q", "q", &Joint::qIndex, &Joint::nq};
const Coordinates kVelocities{"--v", "v", &Joint::vIndex, &Joint::nv};
const Coordinates kForces{"--u", "u", &Joint::vIndex, &Joint::nv};

double requireNumber(const Coordinates& kind, std::string_view word) {
  if (const auto number = parseNumber<double>(word)) return *number;
  throw UsageError(
      {.what = kind.option, .found = fmt::format("'{}'", word), .wanted = "a number, or joint=number"});
}

Eigen::VectorXd zeroPositions(const Model& model) {
  Eigen::VectorXd q(model.nq());
  for (const Joint& joint : model.joints())
    if (!joint.mimics) q.segment(joint.qIndex, joint.nq) = jointCoordinates(joint.type, joint.axis, Pose{});
  return q;
}

void requireQuaternions(const Model& model, const Eigen::VectorXd& q, const Refusal& refuse) {
  forEachQuaternion(model, [&](int at, int) {
    if (q.segment<4>(at).isZero(0))
      refuse(fmt::format("(0, 0, 0, 0) for joint '{}'", jointOfPosition(model, at).name),
             "a quaternion w, x, y, z that is not zero");
  });
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  const std::size_t count = std::min(names.size(), kMost);
  std::string list = join(std::span(names).first(count), ", ");
  if (names.size() > count) list += fmt::format(" and {} more", names.size() - count);
  return list;
}

// The index of a joint's only coordinate.
int placeOf(const Model& model, const Coordinates& kind, const std::string& name, Eigen::Index all) {
  std::vector<std::string> movable;  // joints are in the order of q
  for (const Joint& joint : model.joints()) {
    const bool isMovable = joint.nq > 0 && !joint.mimics;
    if (joint.name == name && isMovable) {
      if (joint.*kind.count == 1) return joint.*kind.index;
      throw UsageError({.what = kind.option + ": joint '" + name + "'",
                        .found = fmt::format("{} coordinates", joint.*kind.count),
                        .wanted = fmt::format("one; give all {} numbers of {} instead", all, kind.letter)});
    }
    if (isMovable) movable.push_back(joint.name);
  }
  const std::vector<std::string> nearest = nearestNames(name, movable);
  throw UsageError({.what = kind.option + ": " + model.name() + " has no joint '" + name + "' that moves",
                    .wanted = nearest.empty() ? listed(movable) : "",
                    .nearest = nearest});
}

// Words end at blanks and commas, so a joint with these in its name cannot be set by name.
std::string pairWanted(const Model& model, Eigen::Index all) {
  const bool areWords = std::ranges::all_of(model.joints(), [](const Joint& joint) {
    return joint.name.find_first_of(" \t\r\n,") == std::string::npos;
  });
  return areWords
             ? "joint=number"
             : fmt::format("joint=number, or all {} numbers if a joint's name has blanks or commas", all);
}

// All numbers, or those of some joints; the others keep their values.
Eigen::VectorXd parseCoordinates(const Model& model, const Coordinates& kind, const std::string& text,
                                 Eigen::VectorXd x) {
  const std::vector<std::string_view> all = numberWords(text, optionRefusal(kind.option));
  if (text.find('=') != std::string::npos) {
    for (const std::string_view word : all) {
      const std::size_t sign = word.find('=');
      if (sign == std::string::npos)
        throw UsageError(
            {.what = kind.option, .found = fmt::format("'{}'", word), .wanted = pairWanted(model, x.size())});
      const std::string name(word.substr(0, sign));
      x[placeOf(model, kind, name, x.size())] = requireNumber(kind, word.substr(sign + 1));
    }
    return x;
  }
  if (static_cast<Eigen::Index>(all.size()) != x.size())
    throw UsageError({.what = kind.option,
                      .found = fmt::format("{} number{}", all.size(), all.size() == 1 ? "" : "s"),
                      .wanted = fmt::format("{}, one for each coordinate of {}", x.size(), model.name())});
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = requireNumber(kind, all[static_cast<std::size_t>(i)]);
  return x;
}

// Zero unless given.
Eigen::VectorXd parseRates(const Model& model, const Coordinates& kind, const std::string& text) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.nv());
  return text == "0" ? zero : parseCoordinates(model, kind, text, zero);
}

void requireLength(double seconds, const std::string& what, const SourceLocation& where) {
  if (seconds > kLongestMotion)
    throw UsageError({.what = what,
                      .where = where,
                      .found = fmt::format("{:g} s", seconds),
                      .wanted = fmt::format("at most {:g} s", kLongestMotion)});
}

// The postures as the file has them.
Motion motionIn(const NumberTable& numbers, const Model& model, double rate) {
  const auto nq = static_cast<std::size_t>(model.nq());
  SourceLocation where{numbers.file};
  const auto refuse = [&](const std::string& found, const std::string& wanted) {
    throw UsageError({.what = "motion", .where = where, .found = found, .wanted = wanted});
  };
  if (numbers.rows.empty()) refuse("no posture", "at least one");
  Motion motion;
  for (const NumberTable::Row& row : numbers.rows) {
    where.line = row.line, where.column = row.column;
    const std::size_t count = row.values.size();
    if (count != nq && count != nq + 1)
      refuse(fmt::format("{} number{}", count, count == 1 ? "" : "s"),
             fmt::format("{} for a posture of {}, or a time before these", nq, model.name()));
    const double time = count > nq ? row.values[0] : static_cast<double>(motion.times.size()) / rate;
    if (!motion.times.empty() && time <= motion.times.back())
      refuse(fmt::format("time {:g} after {:g}", time, motion.times.back()), "times that increase");
    motion.times.push_back(time);
    motion.postures.emplace_back(
        Eigen::Map<const Eigen::VectorXd>(row.values.data() + (count - nq), model.nq()));
    requireQuaternions(model, motion.postures.back(), refuse);
  }
  requireLength(motion.times.back() - motion.times.front(), "motion", {.file = numbers.file});
  return motion;
}

// Resamples at an even rate: at each moment the last posture reached.
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
  return parsePostureAsGiven(model, kPositions.option, text);
}

Eigen::VectorXd parsePostureAsGiven(const Model& model, const std::string& option, const std::string& text) {
  if (text == "0") return zeroPositions(model);
  if (text == "file") return model.initialPositions();
  if (text.starts_with("key:") || text.starts_with("state:"))
    return asWrongUse([&] { return model.posture(text); }, option + ": ");
  Coordinates kind = kPositions;
  kind.option = option;
  Eigen::VectorXd q = parseCoordinates(model, kind, text, model.initialPositions());
  requireQuaternions(model, q, optionRefusal(option));
  return q;
}

Eigen::VectorXd parseVelocities(const Model& model, const std::string& text) {
  return parseRates(model, kVelocities, text);
}

Eigen::VectorXd parseForces(const Model& model, const std::string& text) {
  return parseRates(model, kForces, text);
}

Motion readMotion(const Model& model, const std::filesystem::path& file, double rate) {
  return evenly(motionIn(readNumberTable(file, "motion"), model, rate), rate);
}

Motion moveThrough(const Model& model, const std::vector<Eigen::VectorXd>& keys, double seconds,
                   double rate) {
  requireLength(static_cast<double>(keys.size() - 1) * seconds, "motion through --q", {});
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

namespace {

void requireWithinLimits(const Model& model, const std::string& option, const VectorArg& q) {
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double lower = model.lowerLimits()[i], upper = model.upperLimits()[i];
    const double outside = std::max(lower - q[i], q[i] - upper);
    if (outside <= 0) continue;
    throw UsageError({.what = fmt::format("{}: joint '{}' (q{})", option,
                                          escapeForTerminal(jointOfPosition(model, i).name), i),
                      .found = fmt::format("{:g}, out of bounds by {:.4g}", q[i], outside),
                      .wanted = fmt::format("{:g} to {:g}", lower, upper)});
  }
}

}  // namespace

Eigen::VectorXd postureWithinLimits(const Model& model, const std::string& option, const std::string& text) {
  Eigen::VectorXd q = parsePostureAsGiven(model, option, text);
  forEachQuaternion(model, [&](int iq, int) { q.segment<4>(iq).normalize(); });
  requireWithinLimits(model, option, q);
  return q;
}

}  // namespace rex::cli
