// caught by: distance-zero, maps-other-robot
// mistake: Three differences are a fine task map, but the task asks for one number.

// <solution distanceToGoal>
return {S.kinematicsPos(body) - goal, S.jacobianPos(body)};
// </solution>
