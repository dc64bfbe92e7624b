// Tries a sample of the gates of an exercise: the untouched file, the solution by one seed, and five wrong
// variants, which the number in REX_SAMPLE chooses.
//   rex-gates EXERCISE
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "authoring/wrong_variants.h"
#include "base/error.h"
#include "cli/instructor/dev_verbs.h"

namespace {

// Spread over the list, so that they belong to different parts.
std::vector<std::string> fiveOf(const std::vector<std::string>& names, std::size_t number) {
  constexpr std::size_t kWanted = 5;
  if (names.size() <= kWanted) return names;
  std::vector<std::string> chosen;
  for (std::size_t k = 0; k < kWanted; ++k)
    chosen.push_back(names[(number + k * names.size() / kWanted) % names.size()]);
  return chosen;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: rex-gates EXERCISE\n", stderr);
    return 64;
  }
  try {
    const rex::cli::Project project = rex::cli::findProject();
    const char* number = std::getenv("REX_SAMPLE");
    const rex::cli::CheckOptions options = {
        .exercise = argv[1],
        .gates = {"main-floor", "solution", "wrong"},
        .variants = fiveOf(rex::authoring::variantNames(project.exercise(argv[1])),
                           number == nullptr ? 0 : std::strtoul(number, nullptr, 10)),
        .runs = 1};
    return static_cast<int>(rex::cli::devCheck(project, options));
  } catch (const rex::Error& error) {
    std::fprintf(stderr, "rex-gates: %s\n", error.what());
    return 3;
  }
}
