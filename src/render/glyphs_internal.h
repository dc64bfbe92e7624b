#pragma once

namespace rex::internal {

/// The strokes of a character, ' ' to '~', '?' for any other. Strokes are words: a kind and points of two
/// digits, x then y. Kinds: '-' straight lines, '~' a curve and 'o' a closed curve (quadratic B-splines with
/// these control points), '.' a dot. Baseline y = 2, small letters reach y = 6, capitals 8, descenders 0.
[[nodiscard]] const char* glyphStrokes(char32_t character);

}  // namespace rex::internal
