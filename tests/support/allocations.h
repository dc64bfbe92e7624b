#pragma once

namespace rex {

/// How many allocations this program has made, with new or malloc, in our code or in Eigen's. Not under the
/// sanitizers, which bring an allocator of their own.
[[nodiscard]] long allocations();

}  // namespace rex
