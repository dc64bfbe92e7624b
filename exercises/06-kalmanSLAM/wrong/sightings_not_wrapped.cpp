// caught by: slam-correct
// mistake: subtracts bearings without wrapping them in the joint filter.

// <solution jointCorrected>
const ExpectedView expected = expectedView(car, joint, i);
return corrected(joint, y - expected.y, expected.C, viewNoise(car));
// </solution>
