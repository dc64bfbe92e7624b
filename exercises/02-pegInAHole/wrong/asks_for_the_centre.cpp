// caught by: forbidden-call
// mistake: The simulator knows the centre of mass, so nothing was learnt.

// <solution massCenter>
y.head(2) = S.kinematicsCOM();
J.topRows(2) = S.jacobianCOM();
// </solution>
