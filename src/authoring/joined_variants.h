#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rex::grading {

/// Wrong variants of a file in one, so that headers, and what they have in common, are compiled once: the
/// file itself, its main() empty, and after each function those of the variants that differ. There, f() of
/// variant 2 is called variant_2_f(), and the linker can put it in place of f(), whose callers know nothing
/// of what it does.
class JoinedVariants {
 public:
  /// Of whole files. Left out is a variant that differs from the reference by more than the bodies of
  /// functions that other files may call, or by nothing.
  JoinedVariants(std::string_view reference, const std::vector<std::string>& variants);

  const std::string& source() const { return source_; }
  /// How many functions of a variant there are; 0 if it is left out.
  std::size_t functions(std::size_t variant) const { return functions_[variant]; }
  /// Whose function a line, from 1, of the source belongs to; the number of variants if nobody's.
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

/// A function in place of another, as the linker calls both.
struct StandIn {
  std::string own, replaced;
};

/// Those of a variant among the symbols of the compiled source, which other files may refer to.
[[nodiscard]] std::vector<StandIn> standIns(const std::vector<std::string>& symbols, std::size_t variant);

}  // namespace rex::grading
