// caught by: forbidden-call
// mistake: The library knows strict priority, so nothing was learnt.

// <solution priorityStep>
return hierarchicalStep({{J1, dy1}, {J2, dy2}});
// </solution>
