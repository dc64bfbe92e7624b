Checks all{{"far", "far", "Far away", 1, Group::kHidden, far}};
