// caught by: slam-correct, slam-map, slam-any, names-found, names-any
// mistake: a sighting of a known landmark changes nothing.

// <solution jointCorrected>
static_cast<void>(car);
static_cast<void>(i);
static_cast<void>(y);
return joint;
// </solution>
