// caught by: conjugate, beliefs-elsewhere
// shown by: conjugate
// mistake: Counts the ones where the zeros belong.

// <solution betaPosterior>
for (const int x : data) (x == 1 ? belief.b : belief.a) += 1;
// </solution>
