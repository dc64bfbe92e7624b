// caught by: camera-refined, camera-any
// mistake: returns the P that was given.

// <solution refined>
// </solution>
