// caught by: slam-correct, slam-map, slam-any, names-found, names-any
// mistake: a sighting of a known landmark changes nothing.

// <solution jointCorrected>
return joint;
// </solution>
