// caught by: car-view
// mistake: wraps the second difference for either sensor, even if these are metres.

// <solution viewGap>
gap[1] = std::remainder(gap[1], 2 * std::numbers::pi);
// </solution>
