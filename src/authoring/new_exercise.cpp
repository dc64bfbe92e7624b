#include "authoring/new_exercise.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "authoring/contract.h"
#include "base/text.h"
#include "base/text_file.h"
#include "submission/regions.h"

namespace rex::authoring {
namespace {

namespace fs = std::filesystem;

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

// Lines of at most 100 letters that begin with `prefix`.
std::string wrapped(std::string_view text, std::string_view prefix) {
  constexpr std::size_t kMost = 100;
  std::string lines, line(prefix);
  for (const std::string_view word : splitWords(text)) {
    if (line.size() > prefix.size() && line.size() + word.size() > kMost) {
      lines += line + '\n';
      line = prefix;
    }
    line += (line.size() > prefix.size() ? " " : "") + std::string(word);
  }
  return lines + line + '\n';
}

std::string capital(std::string text) {
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text;
}

// A type without const and references.
std::string plainType(std::string_view type) {
  if (type.starts_with("const ")) type.remove_prefix(6);
  while (type.ends_with('&') || type.ends_with(' ')) type.remove_suffix(1);
  return std::string(type);
}

// What is between the angle brackets of "std::vector<T>"; nothing for other types.
std::optional<std::string> elementOf(const std::string& type) {
  constexpr std::string_view kVector = "std::vector<";
  if (!type.starts_with(kVector) || !type.ends_with('>')) return {};
  return type.substr(kVector.size(), type.size() - kVector.size() - 1);
}

bool isIntegerType(const std::string& type) {
  return type == "int" || type == "long" || type == "unsigned" || type.ends_with("size_t") ||
         type.ends_with("Eigen::Index");
}
bool isNumberType(const std::string& type) {
  return isIntegerType(type) || type == "double" || type == "float";
}
bool isPose(const std::string& type) { return type == "rex::Pose" || type == "Pose"; }

enum class EigenType { kNone, kFixed, kVector, kMatrix };  // the last two have sizes of their own

EigenType eigenTypeOf(const std::string& type) {
  if (type == "Eigen::VectorXd") return EigenType::kVector;
  if (type == "Eigen::MatrixXd") return EigenType::kMatrix;
  const bool isFixed = (type.starts_with("Eigen::Vector") || type.starts_with("Eigen::RowVector") ||
                        type.starts_with("Eigen::Matrix") || type.ends_with("Vector6d")) &&
                       type.find('X') == std::string::npos && type.find("Dynamic") == std::string::npos;
  return isFixed ? EigenType::kFixed : EigenType::kNone;
}

// What the stub returns.
std::string zeroOf(const std::string& type) {
  if (type == "bool") return "false";
  if (isNumberType(type)) return "0";
  return eigenTypeOf(type) == EigenType::kFixed ? type + "::Zero()" : "{}";
}

// A random value; `rng` is a generator. Nothing for a type that has no usual one.
std::optional<std::string> randomOf(const std::string& type) {
  const std::string number = "[&] { return rng.uniform(-1, 1); }";
  if (type == "bool") return "rng.index(2) == 1";
  if (isIntegerType(type)) return "1 + rng.index(5)";
  if (isNumberType(type)) return "rng.uniform(-1, 1)";
  if (isPose(type)) return "rex::expSE3(rng.uniformVector(6, -1, 1))";
  switch (eigenTypeOf(type)) {
    case EigenType::kFixed:
      return fmt::format("{}::NullaryExpr({})", type, number);
    case EigenType::kVector:
      return "rng.uniformVector(3, -1, 1)";
    case EigenType::kMatrix:
      return fmt::format("Eigen::MatrixXd::NullaryExpr(3, 3, {})", number);
    case EigenType::kNone:
      break;
  }
  return {};
}

// What a check calls a parameter.
std::string inputName(const std::string& name) {
  constexpr std::array<std::string_view, 6> kTaken = {"check", "student", "rng", "got", "wanted", "k"};
  return std::find(kTaken.begin(), kTaken.end(), name) == kTaken.end() ? name : name + "Given";
}

// The declaration of an input of a check.
std::string inputLines(const std::string& type, const std::string& name) {
  if (const std::optional<std::string> value = randomOf(type))
    return fmt::format("    const {} {} = {};\n", type, name, *value);
  const std::optional<std::string> element = elementOf(type);
  if (const std::optional<std::string> value = element ? randomOf(*element) : std::nullopt) {
    constexpr std::size_t kWidth = 110;
    const std::string loop = "    for (int k = 0; k < 5; ++k)",
                      push = fmt::format("{}.push_back({});", name, *value);
    const char* const between = loop.size() + 1 + push.size() > kWidth ? "\n      " : " ";
    return fmt::format("    {} {};\n{}{}{}\n", type, name, loop, between, push);
  }
  if (type.ends_with("Simulator"))
    return fmt::format(
        "    const rex::SimulatorDescription {} = rex::Simulator(\"man.ors\").description();\n", name);
  return fmt::format("    const {} {}{{}};  // TODO: a value\n", type, name);
}

// Requirements that the stub does not meet.
std::string requirementLines(const ContractFunction& function) {
  const std::string type = plainType(function.result), what = splitName(function.name, ' ');
  if (type == "bool")
    return fmt::format("    check.that(\"{} says yes here\", got);  // TODO\n", function.name);
  if (isNumberType(type))
    return fmt::format(
        "    const {} wanted = 1;  // TODO: as it follows from the input\n"
        "    check.near(\"{}\", got, wanted, 1e-9);\n",
        type, what);
  if (isPose(type))
    return fmt::format(
        "    const {0} wanted = rex::translation(1, 1, 1);  // TODO: as it follows from the input\n"
        "    check.near(\"rotation of {1}()\", got.R, wanted.R, 1e-9);\n"
        "    check.near(\"position of {1}()\", got.p, wanted.p, 1e-9, \"m\");\n",
        type, function.name);
  const EigenType eigen = eigenTypeOf(type);
  if (eigen == EigenType::kNone) {
    const std::string holds = elementOf(type) ? "got.size() == 5" : "false && &got != nullptr";
    return fmt::format("    check.that(\"{}() returns the right values\", {});  // TODO\n", function.name,
                       holds);
  }
  const char* size = eigen == EigenType::kVector ? "3" : eigen == EigenType::kMatrix ? "3, 3" : "";
  return fmt::format(
      "    const {0} wanted = {0}::Ones({1});  // TODO: as it follows from the input\n"
      "    check.near(\"{2}\", got, wanted, 1e-9);\n",
      type, size, what);
}

std::string checkOf(const ContractFunction& function) {
  std::string inputs, shown;
  std::vector<std::string> arguments;
  for (const ContractParameter& parameter : function.parameters) {
    const std::string type = plainType(parameter.type), name = inputName(parameter.name);
    const bool isGenerator = type.ends_with("Rng");
    arguments.push_back(isGenerator ? fmt::format("check.split({})", arguments.size()) : name);
    if (isGenerator) continue;
    inputs += inputLines(type, name);
    if (isNumberType(type) || eigenTypeOf(type) != EigenType::kNone)
      shown += fmt::format("{}{{\"{}\", {}}}", shown.empty() ? "" : ", ", parameter.name, name);
  }
  const bool draws = inputs.find("rng.") != std::string::npos;
  return fmt::format(
      "void tries{}(Check& check, Student& student) {{\n"
      "  check.forEachCase(10, [&](int) {{\n{}{}"
      "    check.input(\"random values\"{});\n"
      "    const {} got = student.{}({});\n{}"
      "  }});\n}}\n\n",
      capital(function.name), draws ? "    rex::Rng& rng = check.rng();\n" : "", inputs,
      shown.empty() ? "" : ", {" + shown + "}", plainType(function.result), function.name,
      join(arguments, ", "), requirementLines(function));
}

/// Writes the files of one exercise.
class Maker {
 public:
  Maker(Contract contract, std::string name) : contract_(std::move(contract)), name_(std::move(name)) {
    std::vector<int> pointsOf(contract_.parts.size());
    for (const ContractFunction& function : contract_.functions)
      pointsOf[static_cast<std::size_t>(function.part)] += points();
    for (std::size_t k = 0; k < pointsOf.size(); ++k)
      parts_.push_back({idOf(k), contract_.parts[k], pointsOf[k]});
  }

  [[nodiscard]] std::string readme() const {
    std::string text = fmt::format(
        "# {}\n\nTODO: what is computed here, what for, and what you need to know.\n\n"
        "About 2 hours; {} points.\n\n"
        "Complete the functions marked TODO in `main.cpp`; `exercise.h` says what each one takes and "
        "returns. "
        "`main()` and\n`show.cpp` call them and show the results; you may change both, but no other file.\n\n"
        "    scripts/rex run {}     # runs main()\n    scripts/rex test {}    # grades it, part by part\n",
        name_, points() * static_cast<int>(contract_.functions.size()), name_, name_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      text += fmt::format("\n## Part {}: {} ({} point{})\n\n", k + 1, parts_[k].title, parts_[k].points,
                          parts_[k].points == 1 ? "" : "s");
      for (const ContractFunction& function : functionsOf(k))
        text += fmt::format("- `{}`: TODO, why it matters and how to begin.\n", function.name);
    }
    return text +
           "\n## What you will see\n\n"
           "- `result.png`: TODO.\n- `result.html`: the same as a motion in a browser.\n";
  }

  [[nodiscard]] std::string description() const {
    std::string text = fmt::format(
        "title = \"{}\"\nprofile = \"private\"  # needs no notes, evidence, or lines in documents of the "
        "course\n"
        "hours = 2\nallowed = [\"course\"]\n",
        capital(splitName(name_.substr(name_.find('-') + 1), ' ')));
    for (const Part& part : parts_)
      text += fmt::format("\n[[part]]\nid = \"{}\"\ntitle = \"{}\"\npoints = {}\n", part.id,
                          capital(part.title), part.points);
    return text;
  }

  [[nodiscard]] std::string solution() const {
    std::string text = fmt::format(
        "// <solution introduction>\n// Reference solution of {0}.\n// <todo>\n"
        "//| // Your solution of {0}. The task is in README.md, the contract in exercise.h.\n// </solution>\n"
        "#include \"exercise.h\"\n#include \"show.h\"\n",
        name_);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      text += fmt::format("\n// Part {}: {}.\n", k + 1, parts_[k].title);
      for (const ContractFunction& function : functionsOf(k)) text += '\n' + stubOf(function);
    }
    text += "\nint main() {\n";
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      std::vector<std::string> names;
      for (const ContractFunction& function : functionsOf(k)) names.push_back(function.name);
      text += fmt::format("  // Part {}: call {}, and print the values.\n", k + 1, join(names, ", "));
    }
    return text +
           "  showResult({0, 1, 4, 9}, {{0, 0, 0}, {0.2, 0, 0.3}, {0.4, 0, 0.4}, {0.6, 0, 0.3}});\n}\n";
  }

  [[nodiscard]] static std::string showHeader() {
    return "#pragma once\n\n#include \"exercise.h\"\n\n"
           "/// result.png: the values, step by step. result.html: a frame that moves along the path "
           "(metres).\n"
           "void showResult(const std::vector<double>& values, const std::vector<Eigen::Vector3d>& path);\n";
  }

  [[nodiscard]] static std::string showSource() {
    return R"(#include "show.h"

#include "render/report.h"

using namespace rex;

void showResult(const std::vector<double>& values, const std::vector<Eigen::Vector3d>& path) {
  const Figure figure{.title = "Result",
                      .xLabel = "step",
                      .yLabel = "value [1]",
                      .series = {{.label = "yours", .y = values}}};
  plot("result", figure);
  const Film film = makeFilm(static_cast<int>(path.size()), 0.5, [&](int k) {
    const Eigen::Vector3d& p = path[static_cast<std::size_t>(k)];
    return Picture{.polylines = {{.points = path}}, .axes = {{.X_WF = translation(p.x(), p.y(), p.z())}}};
  });
  writeReport({.title = "Result", .film = film, .figures = {{.figure = figure}}}, "result.html");
}
)";
  }

  [[nodiscard]] std::string checks() const {
    std::string text =
        "#include \"interface.h\"\n\nnamespace {\n\n"
        "using rex::grading::Check;\nusing rex::grading::Group;\n\n";
    for (const ContractFunction& function : contract_.functions) text += checkOf(function);
    text += "}  // namespace\n\nrex::grading::Checks<Student> checks() {\n  return {\n";
    for (const ContractFunction& function : contract_.functions)
      text += fmt::format("      {{\"{}\", \"{}\", \"{}\", {}, Group::kVisible, tries{}}},\n",
                          splitName(function.name, '-'), parts_[static_cast<std::size_t>(function.part)].id,
                          capital(splitName(function.name, ' ')), points(), capital(function.name));
    return text + "  };\n}\n";
  }

 private:
  struct Part {
    std::string id, title;
    int points = 0;
  };

  // Of each function: an exercise has at most 20.
  [[nodiscard]] int points() const {
    constexpr int kAll = 20, kMost = 4;
    return std::clamp(kAll / static_cast<int>(contract_.functions.size()), 1, kMost);
  }

  [[nodiscard]] std::vector<ContractFunction> functionsOf(std::size_t part) const {
    std::vector<ContractFunction> all;
    for (const ContractFunction& function : contract_.functions)
      if (static_cast<std::size_t>(function.part) == part) all.push_back(function);
    return all;
  }

  // That of its first function.
  [[nodiscard]] std::string idOf(std::size_t part) const {
    const std::vector<ContractFunction> functions = functionsOf(part);
    return functions.empty() ? fmt::format("part-{}", part + 1) : splitName(functions.front().name, '-');
  }

  static std::string stubOf(const ContractFunction& function) {
    std::vector<std::string> parameters;
    for (const ContractParameter& parameter : function.parameters)
      parameters.push_back(fmt::format("{} {}", parameter.type, parameter.name));
    const std::string zero = zeroOf(plainType(function.result));
    // The scan for leaks would take a line that both the solution and the stub have for one.
    return fmt::format(
        "{} {}({}) {{\n  // <solution {}>\n  {} missing = {};  // instead of this, the solution\n"
        "  return missing;\n  // <todo>\n{}  //| return {};\n  // </solution>\n}}\n",
        function.result, function.name, join(parameters, ", "), function.name, plainType(function.result),
        zero, wrapped("TODO: " + function.comment, "  //| // "), zero);
  }

  Contract contract_;
  std::string name_;
  std::vector<Part> parts_;
};

// With the main.cpp that its solution makes.
ExerciseFiles withMain(ExerciseFiles files) {
  files["main.cpp"] = submission::stripSolution(files.at("solution.cpp"), "solution.cpp");
  return files;
}

}  // namespace

ExerciseFiles templateExercise(const fs::path& root, const std::string& name) {
  const fs::path folder = root / "share" / "template";
  ExerciseFiles files;
  for (const auto& entry : fs::directory_iterator(folder))
    files[entry.path().filename().string()] = replaced(readTextFile(entry.path()), "@EXERCISE@", name);
  return withMain(std::move(files));
}

ExerciseFiles exerciseFor(std::string_view header, const std::string& file, const std::string& name) {
  const Maker maker(readContract(header, file), name);
  return withMain({{"README.md", maker.readme()},
                   {"exercise.toml", maker.description()},
                   {"exercise.h", std::string(header)},
                   {"solution.cpp", maker.solution()},
                   {"show.h", maker.showHeader()},
                   {"show.cpp", maker.showSource()},
                   {"check.cpp", maker.checks()}});
}

std::string buildLine(const ExerciseFiles& files, const std::string& name) {
  std::string line = fmt::format("rex_exercise({} FUNCTIONS", name);
  for (const ContractFunction& function : readContract(files.at("exercise.h"), "exercise.h").functions)
    line += ' ' + function.name;
  return line + ")\n";
}

}  // namespace rex::authoring
