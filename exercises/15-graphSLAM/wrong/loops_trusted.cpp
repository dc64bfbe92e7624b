// caught by: robust-few, robust-many
// shown by: robust-few
// mistake: adjusts the map as if all loops were right.

// <solution robustlyAdjusted>
now.poses = adjusted(map).poses;
// </solution>
