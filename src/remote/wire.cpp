#include "remote/wire.h"

#include <cmath>

#include <fmt/format.h>

namespace rex::remote {

void Reader::examine(const double* first, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k, ++examined_) {
    const double value = first[k];
    if (limits_->any || std::abs(value) <= limits_->magnitude || (limits_->infinite && std::isinf(value)))
      continue;
    // The sign of a NaN depends on the machine.
    const std::string got = std::isnan(value) ? "nan" : fmt::format("{:g}", value);
    throw AnswerRefused(*function_,
                        fmt::format("number {} is {}, wanted {}", examined_ + 1, got,
                                    std::isfinite(value) ? fmt::format("at most {:g}", limits_->magnitude)
                                                         : "finite numbers"));
  }
}

}  // namespace rex::remote
