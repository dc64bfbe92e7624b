#pragma once

#include <string_view>

namespace rex {

/// Throws Error "what: found -1, wanted a positive number" unless it is one, and finite.
void requirePositive(std::string_view what, double number);

/// Throws Error "what: found -1, wanted a number that is not negative" unless it is one, and finite.
void requireNotNegative(std::string_view what, double number);

}  // namespace rex
