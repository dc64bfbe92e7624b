#include <cstdlib>

#include <fmt/format.h>

#include "cli/option_table_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

std::string wrongSeed(const std::string& text) {
  constexpr std::size_t kMostDigits = 18;
  const bool isOne =
      !text.empty() && text.size() <= kMostDigits && text.find_first_not_of("0123456789") == text.npos;
  return isOne ? ""
               : fmt::format("found {}, wanted a whole number of at most {} digits", escapeForTerminal(text),
                             kMostDigits);
}

CLI::Option* addLevel(CLI::App* command, std::optional<sandbox::Level>& level) {
  return command->add_option("--level", level, "sandbox level that must hold, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->type_name("N");
}

namespace {

// As many lines as the column of descriptions needs, which CLI11 indents.
std::string inColumn(const std::string& text) {
  constexpr std::size_t kColumn = 22;
  std::string lines = wrap(text, kColumn, kColumn);
  const std::string indent = "\n" + std::string(kColumn, ' ');
  for (std::size_t at = 0; (at = lines.find(indent, at)) != lines.npos; ++at) lines.erase(at + 1, kColumn);
  return lines;
}

// A text that is not a number is left to the conversion, which complains.
std::string checkedNumber(const std::string& flag, const Range& range, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end != text.c_str() && *end == '\0')
    requireBetween(OptionRow::longName(flag).c_str(), number, range.least, range.most);
  return "";
}

}  // namespace

OptionRow::OptionRow(const char* flag, const char* unit, const std::string& help, const Range& range,
                     const Add& add)
    : add_([=](CLI::App* command) {
        const std::string name = flag;
        return add(command)
            ->description(help)
            ->check([name, range](const std::string& text) { return checkedNumber(name, range, text); })
            ->type_name(unit);
      }) {}

OptionRow::OptionRow(const char* flag, bool& value, const std::string& help)
    : add_([=, &value](CLI::App* command) { return command->add_flag(flag, value, help); }) {}

OptionRow::OptionRow(const char* flag, std::string& value, const char* unit, const std::string& help)
    : add_([=, &value](CLI::App* command) {
        const std::string usual = value.empty() ? "" : fmt::format(" (default: {})", value);
        return command->add_option(flag, value, help + usual)->type_name(unit);
      }) {}

OptionRow::OptionRow(const char* flag, std::filesystem::path& value, const char* unit,
                     const std::string& help)
    : add_([=, &value](CLI::App* command) {
        const std::string usual = value.empty() ? "" : fmt::format(" (default: {})", value.string());
        return command->add_option(flag, value, help + usual)->type_name(unit);
      }) {}

OptionRow::OptionRow(const char* flag, std::vector<std::string>& value, const char* unit,
                     const std::string& help)
    : add_([=, &value](CLI::App* command) {
        return command->add_option(flag, value, help)->allow_extra_args(false)->type_name(unit);
      }) {}

OptionRow OptionRow::required() && {
  add_ = [add = std::move(add_)](CLI::App* command) { return add(command)->required(); };
  return std::move(*this);
}

std::vector<CLI::Option*> addOptions(CLI::App* command, std::initializer_list<OptionRow> table,
                                     const std::string& group) {
  std::vector<CLI::Option*> options;
  for (const OptionRow& row : table) {
    options.push_back(row.addTo(command));
    options.back()->description(inColumn(options.back()->get_description()));
    if (!group.empty()) options.back()->group(group);
  }
  return options;
}

}  // namespace rex::cli
