// caught by: plan, more-plans, unseen-map
// shown by: plan
// mistake: does not look ahead.

// <solution plannedValues>
return discount < 0 ? model.visits : model.R;
// </solution>
