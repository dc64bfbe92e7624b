#pragma once

#include "scene/ors_cursor_internal.h"

namespace rex::ors {

/// [1 2 3], [1 2; 3 4], rows also by line ends, or [<2 2> 1 2 3 4] with explicit dimensions. The cursor
/// stands on the '['.
[[nodiscard]] Eigen::MatrixXd readArray(Cursor& cursor);

/// <T ...> is a pose; the text of any other type is kept as it stands. The cursor stands on the '<'.
[[nodiscard]] Value readTyped(Cursor& cursor);

}  // namespace rex::ors
