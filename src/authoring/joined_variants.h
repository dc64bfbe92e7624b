#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Joins the wrong variants of a file into one source, so that headers and common code are compiled only
/// once: the reference with an empty main(), and after each function the variants' versions that differ.
/// Function f() of variant 2 is named variant_2_f(), and the linker can substitute it for f(), about which
/// callers assume nothing.
class JoinedVariants {
 public:
  /// All arguments are whole files. A variant is left out if it equals the reference or differs in more
  /// than the bodies of functions that other files may call.
  JoinedVariants(std::string_view reference, const std::vector<std::string>& variants);

  const std::string& source() const { return source_; }
  /// The number of functions of a variant; 0 if it is left out.
  std::size_t functions(std::size_t variant) const { return functions_[variant]; }
  /// The variant whose function contains a line, from 1, of the source; the number of variants if there is
  /// none.
  std::size_t variantAt(int line) const;

 private:
  struct Place {
    int first, last;  // lines
    std::size_t variant;
  };
  std::string source_;
  std::vector<std::size_t> functions_;
  std::vector<Place> places_;
};

/// A function that replaces another; both are linker names.
struct StandIn {
  std::string own, replaced;
};

/// The replacements of a variant among the global symbols of the compiled source.
[[nodiscard]] std::vector<StandIn> standIns(const std::vector<std::string>& symbols, std::size_t variant);

}  // namespace rex::grading
