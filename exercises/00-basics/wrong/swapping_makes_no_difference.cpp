// caught by: boxes, bayes-elsewhere
// mistake: All boxes that are still closed are taken to be equally likely, whatever the host knows.

// <solution montyHall>
return {1. / (boxes - opened), 1. / (boxes - opened)};
// </solution>
