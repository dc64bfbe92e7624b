// caught by: loop-rooms, loop-any
// mistake: takes whatever the alignment gives for a loop.

// <solution loopMotion>
return aligned(reference, moving, guess).motion;
// </solution>
