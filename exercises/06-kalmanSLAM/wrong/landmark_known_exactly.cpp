// caught by: slam-correct, slam-map
// mistake: linearises a sighting with respect to the car only.

// <solution jointCorrected>
ExpectedView expected = expectedView(car, joint, i);
expected.C.rightCols(joint.mean.size() - 3).setZero();
return corrected(joint, viewGap(car, y, expected.y), expected.C, viewNoise(car));
// </solution>
