#include "sandbox/confinement.h"

#include <functional>
#include <map>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace rex::sandbox {

Level parseLevel(int number) {
  if (number < 0 || number > numberOf(Level::kControlGroup))
    throw Error({.what = "sandbox level", .found = fmt::format("{}", number), .wanted = "0, 1, 2 or 3"});
  return static_cast<Level>(number);
}

std::string describe(Level level) { return fmt::format("sandbox level {} of 3", numberOf(level)); }

std::string levelWarning(Level level) {
  switch (level) {
    case Level::kControlGroup:
      return "";
    case Level::kNamespaces:
      return describe(level) + ": memory is limited per process, not in total";
    case Level::kFiles:
      return describe(level) +
             ": the student's program can read the system's files under /usr and see which files exist; "
             "grade "
             "other people's code at level 2 or 3";
    case Level::kLimitsOnly:
      return describe(level) +
             ": the student's program runs with the rights of the grader and sees its files; grade only your "
             "own code this way";
  }
  return "";
}

namespace {

// Reads the arguments one by one.
class Reader {
 public:
  explicit Reader(const std::vector<std::string>& arguments) : arguments_(arguments) {}
  bool atEnd() const { return next_ == arguments_.size(); }
  std::string text() {
    if (atEnd()) throw Error({.what = "an option of the sandbox lacks its value"});
    return arguments_[next_++];
  }
  double number() {
    const std::string value = text();
    const std::optional<double> number = parseNumber<double>(value);
    if (!number || *number < 0)
      throw Error({.what = "an option of the sandbox", .found = value, .wanted = "a number"});
    return *number;
  }
  template <class T>
  T whole() {
    return static_cast<T>(number());
  }
  std::vector<std::string> rest() const {
    return {arguments_.begin() + static_cast<long>(next_), arguments_.end()};
  }

 private:
  const std::vector<std::string>& arguments_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<std::string> toArguments(const Confinement& c) {
  std::vector<std::string> list;
  const auto add = [&](const char* name, const auto& value) {
    list.insert(list.end(), {name, fmt::format("{}", value)});
  };
  add("--level", numberOf(c.level));
  for (const Readable& readable : c.readable)
    list.insert(list.end(), {"--read", readable.path.string(), readable.inside.string()});
  if (!c.writable.empty()) add("--write", c.writable.string());
  for (const std::string& variable : c.environment) add("--env", variable);
  if (c.mayStartProgramsOfItsOwn) list.emplace_back("--programs");
  add("--cpu", c.cpuSeconds);
  add("--wall", c.wallSeconds);
  add("--memory", c.addressSpace);
  add("--file-size", c.fileSize);
  add("--files", c.openFiles);
  add("--processes", c.processes);
  if (c.user) add("--user", *c.user);
  for (const auto& group : c.controlGroups) add("--group", group.string());
  if (c.reports) list.emplace_back("--report");
  list.emplace_back("--");
  return list;
}

Order orderFromArguments(const std::vector<std::string>& arguments) {
  Confinement c;
  Reader reader(arguments);
  const std::map<std::string, std::function<void()>> options = {
      {"--level", [&] { c.level = parseLevel(reader.whole<int>()); }},
      {"--read",
       [&] {
         const std::string path = reader.text();
         c.readable.push_back({path, reader.text()});
       }},
      {"--write", [&] { c.writable = reader.text(); }},
      {"--env", [&] { c.environment.push_back(reader.text()); }},
      {"--programs", [&] { c.mayStartProgramsOfItsOwn = true; }},
      {"--cpu", [&] { c.cpuSeconds = reader.number(); }},
      {"--wall", [&] { c.wallSeconds = reader.number(); }},
      {"--memory", [&] { c.addressSpace = reader.whole<std::size_t>(); }},
      {"--file-size", [&] { c.fileSize = reader.whole<std::size_t>(); }},
      {"--files", [&] { c.openFiles = reader.whole<int>(); }},
      {"--processes", [&] { c.processes = reader.whole<int>(); }},
      {"--user", [&] { c.user = reader.whole<unsigned>(); }},
      {"--report", [&] { c.reports = true; }},
      {"--group", [&] { c.controlGroups.emplace_back(reader.text()); }}};
  for (;;) {
    const std::string name = reader.text();
    if (name == "--") break;
    const auto option = options.find(name);
    if (option == options.end()) throw Error({.what = "the sandbox has no option " + name});
    option->second();
  }
  if (reader.atEnd()) throw Error({.what = "the sandbox got no program"});
  return {std::move(c), reader.rest()};
}

}  // namespace rex::sandbox
