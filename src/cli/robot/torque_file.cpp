#include "cli/robot/torque_file.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "cli/number_words.h"
#include "cli/robot/coordinate_names.h"
#include "cli/terminal.h"
#include "scene/coordinates.h"

namespace rex::cli {
namespace {

struct Field {
  std::string text;
  int column = 1;  // of its first character in the line
};

std::vector<Field> fieldsOf(std::string_view line, int column) {
  constexpr std::string_view kBlanks = " \t\r";
  std::vector<Field> fields;
  while (true) {
    const std::size_t end = std::min(line.find(','), line.size());
    const std::size_t start = std::min(line.find_first_not_of(kBlanks), end);
    std::string_view text = line.substr(start, end - start);
    text = text.substr(0, text.find_last_not_of(kBlanks) + 1);
    if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
    fields.push_back({std::string(text), column + static_cast<int>(start)});
    if (end == line.size()) return fields;
    column += static_cast<int>(end) + 1;
    line.remove_prefix(end + 1);
  }
}

class TorqueReader {
 public:
  TorqueReader(const Model& model, std::string file)
      : model_(model), names_(printableVelocityNames(model)), where_({.file = std::move(file)}) {
    table_.nv = model.nv();
  }

  void readLine(std::string_view line) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    ++where_.line;
    int column = 1;
    if (where_.line == 1 && line.starts_with(kByteOrderMark)) {
      line.remove_prefix(kByteOrderMark.size());
      column += static_cast<int>(kByteOrderMark.size());
    }
    const std::size_t start = line.find_first_not_of(" \t\r");
    if (start == std::string_view::npos || line[start] == '#') return;
    const std::vector<Field> fields = fieldsOf(line, column);
    if (headLine_ == 0)
      readHead(fields);
    else
      readRow(fields);
  }

  TorqueTable finish() {
    where_ = {.file = where_.file};
    if (headLine_ == 0) refuse("torques", "no line of column names", kHeadWanted);
    if (table_.rows.empty()) refuse("torques", "no row of numbers", "a time and torques");
    return std::move(table_);
  }

 private:
  static constexpr const char* kHeadWanted = "'time', then names of joints, separated by commas";

  [[noreturn]] void refuse(const std::string& what, const std::string& found, const std::string& wanted,
                           std::vector<std::string> nearest = {}) const {
    throw UsageError(
        {.what = what, .where = where_, .found = found, .wanted = wanted, .nearest = std::move(nearest)});
  }

  void readHead(const std::vector<Field>& fields) {
    headLine_ = where_.line;
    where_.column = fields.front().column;
    if (fields.front().text != "time")
      refuse("torques: first column", "'" + harmless(fields.front().text) + "'", kHeadWanted);
    if (fields.size() == 1) refuse("torques", "no joint after 'time'", kHeadWanted);
    for (std::size_t i = 1; i < fields.size(); ++i) {
      where_.column = fields[i].column;
      const int place = placeOf(fields[i].text);
      if (std::ranges::find(table_.columns, place) != table_.columns.end())
        refuse("torques", "'" + harmless(fields[i].text) + "' twice", "a column per joint");
      table_.columns.push_back(place);
    }
  }

  int placeOf(const std::string& name) const {
    for (const Joint& joint : model_.joints()) {
      if (joint.name != name) continue;
      const std::string what = "torques: joint '" + harmless(name) + "'";
      if (joint.mimics)
        refuse(what, "a joint that mimics another",
               "'" + harmless(jointOfVelocity(model_, joint.vIndex).name) + "', whose torque moves both");
      if (joint.type == JointType::kFree) refuse(what, "a free joint", "joints with a motor");
      if (joint.nv > 1)
        refuse(what, fmt::format("{} coordinates", joint.nv),
               fmt::format("'{} [0]' or another", harmless(name)));
    }
    const auto found = std::ranges::find(names_, name);
    if (found != names_.end() && !name.empty()) {
      const int place = static_cast<int>(found - names_.begin());
      if (jointOfVelocity(model_, place).type != JointType::kFree) return place;
    }
    refuse("torques", "'" + harmless(name) + "'", "a joint of " + harmless(model_.name()) + " with a motor",
           nearestNames(name, driven()));
  }

  std::vector<std::string> driven() const {
    std::vector<std::string> names;
    for (int i = 0; i < model_.nv(); ++i)
      if (jointOfVelocity(model_, i).type != JointType::kFree)
        names.push_back(names_[static_cast<std::size_t>(i)]);
    return names;
  }

  void readRow(const std::vector<Field>& fields) {
    where_.column = fields.back().column;
    if (fields.size() != table_.columns.size() + 1)
      refuse("torques", fmt::format("{} field{}", fields.size(), fields.size() == 1 ? "" : "s"),
             fmt::format("{} as in line {}", table_.columns.size() + 1, headLine_));
    std::vector<double> row;
    for (const Field& field : fields) {
      where_.column = field.column;
      const auto value = numberIn(field.text);
      if (!value) refuse("torques", "'" + harmless(field.text) + "'", "a number");
      row.push_back(*value);
    }
    where_.column = fields.front().column;
    if (row[0] < 0) refuse("torques: time", fields.front().text, "0 or later");
    if (!table_.times.empty() && row[0] <= table_.times.back())
      refuse("torques: time", fmt::format("{:g} after {:g}", row[0], table_.times.back()),
             "times that increase");
    table_.times.push_back(row[0]);
    table_.rows.emplace_back(row.begin() + 1, row.end());
  }

  const Model& model_;
  std::vector<std::string> names_;
  SourceLocation where_;
  int headLine_ = 0;
  TorqueTable table_;
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
  std::ifstream input(file);
  std::error_code ignored;
  if (!input || std::filesystem::is_directory(file, ignored))
    throw UsageError({.what = "cannot read the torques", .where = {file.string()}});
  TorqueReader reader(model, file.string());
  for (std::string line; std::getline(input, line);) reader.readLine(line);
  return reader.finish();
}

}  // namespace rex::cli
