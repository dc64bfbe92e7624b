// caught by: wall, more-walls
// mistake: plans as if there were no corridor.

// <solution plannedWithin>
return planned(task, x);
// </solution>
