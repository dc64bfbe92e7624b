// caught by: trailer-moves
// mistake: lets the angle at the hitch grow forward.

// <solution hitchGrowth>
return speed / rig.hitchLength;
// </solution>
