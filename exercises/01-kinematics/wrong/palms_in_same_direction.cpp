// caught by: palms-zero
// mistake: The difference of the palms is zero when they point the same way, as for two hands on a table.

// <solution opposePalms>
return {S.kinematicsVec(left, palm) - S.kinematicsVec(right, palm),
        S.jacobianVec(left, palm) - S.jacobianVec(right, palm)};
// </solution>
