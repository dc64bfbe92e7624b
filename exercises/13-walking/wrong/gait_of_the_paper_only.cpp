// caught by: gait, other-gaits
// mistake: the numbers of the paper, whatever the slope is.

// <solution gaitNear>
if (!stepFrom(walker, guess)) return std::nullopt;
return Eigen::Vector4d(.218668802939, -.323388558059, -1.091826677490, -.377181558403);
// </solution>
// <solution multiplierSizes>
return Eigen::Vector4d(.579952, .579952, .131573, 0);
// </solution>
