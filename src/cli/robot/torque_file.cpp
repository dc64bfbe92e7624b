#include "cli/robot/torque_file.h"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/numbers.h"
#include "cli/robot/coordinate_names.h"
#include "cli/terminal.h"
#include "scene/coordinates.h"

namespace rex::cli {
namespace {

constexpr const char* kHeadWanted = "'time', then names of joints, separated by commas";

class TorqueReader {
 public:
  TorqueReader(const Model& model, const NumberTable& numbers)
      : model_(model), names_(printableVelocityNames(model)), numbers_(numbers) {}

  TorqueTable read() {
    table_.nv = model_.nv();
    if (numbers_.namesLine == 0) refuse({}, "torques", "no line of column names", kHeadWanted);
    readNames();
    if (numbers_.rows.empty()) refuse({}, "torques", "no row of numbers", "a time and torques");
    for (const NumberTable::Row& row : numbers_.rows) addRow(row);
    return std::move(table_);
  }

 private:
  [[noreturn]] void refuse(std::pair<int, int> lineAndColumn, const std::string& what,
                           const std::string& found, const std::string& wanted,
                           std::vector<std::string> nearest = {}) const {
    throw UsageError({.what = what,
                      .where = {numbers_.file, lineAndColumn.first, lineAndColumn.second},
                      .found = found,
                      .wanted = wanted,
                      .nearest = std::move(nearest)});
  }

  void readNames() {
    const NumberTable::Name& first = numbers_.names.front();
    const auto at = [&](const NumberTable::Name& name) { return std::pair(numbers_.namesLine, name.column); };
    if (first.text != "time")
      refuse(at(first), "torques: first column", "'" + harmless(first.text) + "'", kHeadWanted);
    if (numbers_.names.size() == 1) refuse(at(first), "torques", "no joint after 'time'", kHeadWanted);
    for (const NumberTable::Name& name : std::span(numbers_.names).subspan(1)) {
      const int place = placeOf(name.text, at(name));
      if (std::ranges::find(table_.columns, place) != table_.columns.end())
        refuse(at(name), "torques", "'" + harmless(name.text) + "' twice", "a column per joint");
      table_.columns.push_back(place);
    }
  }

  int placeOf(const std::string& name, std::pair<int, int> at) const {
    for (const Joint& joint : model_.joints()) {
      if (joint.name != name) continue;
      const std::string what = "torques: joint '" + harmless(name) + "'";
      if (joint.mimics)
        refuse(at, what, "a joint that mimics another",
               "'" + harmless(jointOfVelocity(model_, joint.vIndex).name) + "', whose torque moves both");
      if (joint.type == JointType::kFree) refuse(at, what, "a free joint", "joints with a motor");
      if (joint.nv > 1)
        refuse(at, what, fmt::format("{} coordinates", joint.nv),
               fmt::format("'{} [0]' or another", harmless(name)));
    }
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end() && !name.empty()) {
      const int place = static_cast<int>(found - names_.begin());
      if (jointOfVelocity(model_, place).type != JointType::kFree) return place;
    }
    refuse(at, "torques", "'" + harmless(name) + "'",
           "a joint of " + harmless(model_.name()) + " with a motor", nearestNames(name, driven()));
  }

  std::vector<std::string> driven() const {
    std::vector<std::string> names;
    for (int i = 0; i < model_.nv(); ++i)
      if (jointOfVelocity(model_, i).type != JointType::kFree)
        names.push_back(names_[static_cast<std::size_t>(i)]);
    return names;
  }

  void addRow(const NumberTable::Row& row) {
    const std::pair at(row.line, row.column);
    if (row.values.size() != numbers_.names.size())
      refuse(at, "torques", fmt::format("{} number{}", row.values.size(), row.values.size() == 1 ? "" : "s"),
             fmt::format("{} as in line {}", numbers_.names.size(), numbers_.namesLine));
    const double time = row.values[0];
    if (time < 0) refuse(at, "torques: time", fmt::format("{:g}", time), "0 or later");
    if (!table_.times.empty() && time <= table_.times.back())
      refuse(at, "torques: time", fmt::format("{:g} after {:g}", time, table_.times.back()),
             "times that increase");
    table_.times.push_back(time);
    table_.rows.emplace_back(row.values.begin() + 1, row.values.end());
  }

  const Model& model_;
  std::vector<std::string> names_;
  const NumberTable& numbers_;
  TorqueTable table_{};
};

}  // namespace

Eigen::VectorXd TorqueTable::at(double time) const {
  constexpr double kRounding = 1e-9;  // seconds: times are sums of steps, which are not exact
  Eigen::VectorXd u = Eigen::VectorXd::Zero(nv);
  const auto next = std::upper_bound(times.begin(), times.end(), time + kRounding);
  if (next == times.begin()) return u;
  const std::vector<double>& row = rows[static_cast<std::size_t>(next - times.begin()) - 1];
  for (std::size_t i = 0; i < columns.size(); ++i) u[columns[i]] = row[i];
  return u;
}

TorqueTable readTorques(const Model& model, const std::filesystem::path& file) {
  const NumberTable numbers = readNumberTable(file, "torques");
  return TorqueReader(model, numbers).read();
}

}  // namespace rex::cli
