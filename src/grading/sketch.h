#pragma once
// What a student's functions answered in a check, small enough to keep and to compare: by its answers a
// mistake is recognised, whatever the code looks like.
//   CallSketcher sketcher(layouts);
//   caller.listen([&](auto&&... call) { sketcher.hear(call...); });
//   std::vector<SketchedCall> calls = std::move(sketcher).take();
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rex::grading {

/// For each of the student's functions: the layout of its return value, then those of its arguments.
using CallLayouts = std::vector<std::vector<std::string>>;

/// An answer. Nobody can compute the numbers back from it, unless there are only a few.
struct Sketch {
  bool threw = false;            ///< there is no answer; the rest is empty
  bool isWhole = true;           ///< all numbers are whole, which many mistakes may give by chance
  std::uint32_t form = 0;        ///< a hash of sizes, texts, and which numbers are not finite
  double size = 0;               ///< the root of the sum of squares
  std::array<double, 3> sums{};  ///< of the numbers, with fixed weights between -1 and 1
};

/// Throws Error if the bytes are not one value of that layout.
[[nodiscard]] Sketch sketchOf(std::span<const std::byte> answer, const std::string& layout);

/// Whether two answers differ by no more than those of honest programs do: 1e-5 of their size.
[[nodiscard]] bool agree(const Sketch& a, const Sketch& b);

/// One call of a student's function.
struct SketchedCall {
  std::string function{};
  std::uint64_t key = 0;  ///< of the case, the function, the arguments, and how often they came before
  Sketch answer{};
};

/// Sketches the calls of one check, the first ones of each function in each case.
class CallSketcher {
 public:
  /// The layouts must outlive it.
  explicit CallSketcher(const CallLayouts& layouts) : layouts_(layouts) {}

  using Bytes = std::span<const std::byte>;
  /// Leaves out an answer that does not fit its layout, which is refused when it is read.
  void hear(std::uint32_t method, const std::string& function, Bytes arguments,
            const std::optional<Bytes>& answer);
  void nextCase();

  std::vector<SketchedCall> take() && { return std::move(calls_); }

 private:
  const CallLayouts& layouts_;
  std::uint64_t case_ = 0;
  std::size_t bytes_ = 0;
  std::map<std::uint32_t, int> callsInCase_{};
  std::map<std::uint64_t, std::uint64_t> asked_{};  // how often, by arguments
  std::vector<SketchedCall> calls_{};
};

}  // namespace rex::grading
