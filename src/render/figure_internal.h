#pragma once

#include <string>

namespace rex {
struct Figure;
}

namespace rex::internal {

/// encodeSvg() with further commands of gnuplot, such as margins, before those of the figure.
[[nodiscard]] std::string encodeSvg(const Figure& figure, const std::string& commands);

/// What gnuplot writes to standard output for `script`: a whole picture. `name` stands for the figure in
/// messages. Throws Error if gnuplot is missing, fails, or takes more than `patience` seconds.
[[nodiscard]] std::string runGnuplot(const std::string& script, const std::string& name,
                                     double patience = 60);

}  // namespace rex::internal
