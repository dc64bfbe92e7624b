#include <fmt/format.h>

#include "cli/shared_options_internal.h"
#include "cli/terminal.h"

namespace rex::cli {

std::string wrongSeed(const std::string& text) {
  constexpr std::size_t kMostDigits = 18;
  const bool isOne =
      !text.empty() && text.size() <= kMostDigits && text.find_first_not_of("0123456789") == text.npos;
  return isOne ? ""
               : fmt::format("found {}, wanted a whole number of at most {} digits", harmless(text),
                             kMostDigits);
}

CLI::Option* addLevel(CLI::App* command, std::optional<sandbox::Level>& level) {
  return command->add_option("--level", level, "sandbox level that must hold, 0 to 3")
      ->check(CLI::Range(0, 3))
      ->type_name("N");
}

}  // namespace rex::cli
